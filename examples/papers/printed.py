"""The multi-source paper's equations of sound on the paper's own system: rings on a soft pedestal.

The paper writes its equations for the bearing's parts alone (eqs. 1 to 6) and calls 28,000 r/min critical.
Both rings then have to be on 3.3e5 N/m: 467 Hz with their 38 g. Two readings of its sound:

``printed``   eqs. 16 and 41 take magnitudes |v|, which turn a sine into a constant and twice its frequency
``energies``  at each frequency the energies of the vector's components, all cosines 1

In both the energies of a component's sources add, and so do the components' (eqs. 43 and 46). Neither has
angles: P1 and P3 are the same.
"""

from examples.papers import page, values
from examples.papers.case import Case
from examples.papers.lines import POINTS, SPECTRA, SPEEDS, orderings, ours
from examples.papers.medians import by_seed
from examples.papers.page import Output
from examples.papers.runs import Runs
from examples.papers.statements import HOLDS, classed, counts
from fmu_bearing.results.table import markdown

NAME = "printed"
SCENE = "7003C-bare"
#: All assumed: the paper prints none of them. Chosen once so that the line f_r is the paper's 87 dB and its
#: level at 10,000 r/min is near the paper's; they are no prediction.
CHANGES = (
    ("mounting.pedestal_stiffness_N_m", 3.3e5),
    ("imperfections.unbalance_um", 2.0),
    ("imperfections.inner_race_amplitude_um", 0.3),
    ("imperfections.outer_race_amplitude_um", 0.3),
    ("imperfections.waviness_exponent", 1.5),
)
VALUES = values.read(NAME)
#: Radiation model behind each reading.
READINGS = {"energies": "paper_vector", "printed": "paper"}


def cases(runs: Runs) -> list[Case]:
    """Operating points of one reading: every second speed, the speeds of the spectra and of the values."""
    if runs.quick:
        return runs.few([Case(SCENE, 28000, CHANGES, 1, 0.01, 0.052)])
    speeds = sorted({*SPEEDS[::2], *SPECTRA, *(int(value.rpm) for value in VALUES)})
    # a mode at 467 Hz with a damping ratio of 0.05 falls by 60 dB in the 50 ms left out
    return runs.few([Case(SCENE, rpm, CHANGES) for rpm in speeds])


def page_part(runs: Runs, output: Output) -> str:
    """Run both readings, write their CSV, return their part of the multi-source paper's page."""
    words, rows, cells = [], [], {}
    for reading, model in READINGS.items():
        found = runs.all(NAME, cases(runs), f"{NAME}: {reading}", radiation_model=model)
        now = by_seed(found.items())
        for met in values.met(VALUES, ((c.seed, ours(VALUES, c.rpm, one)) for c, one in found.items())):
            cells.setdefault(met.value.name, [met.value.name, page.printed(met.value.paper)]).extend(
                [f"{met.level:.1f}", page.spread(met.by_seed), f"{met.residual:+.1f}"]
            )
        judged = classed([orderings(one) for one in now.values()], {})
        held = [str(number) for number, one in enumerate(judged, 1) if one.kind == HOLDS]
        words.append(f"* `{reading}`. {counts(judged)}; those that hold: {', '.join(held) or 'none'}.\n")
        rows += [
            [reading, str(seed), str(rpm), name, *(f"{v:.2f}" for v in levels)]
            for seed, results in now.items()
            for rpm, result in results.items()
            for name, levels in result["levels"].items()
        ]
    output.csv("multi-source-printed", ["reading", "seed", "rpm", "component", *POINTS], rows)
    columns = [
        "value, dB", "paper", *(c for reading in READINGS for c in (f"`{reading}`", "seeds", "residual")),
    ]  # fmt: skip
    return f"{markdown(columns, list(cells.values()))}\n{''.join(words)}"
