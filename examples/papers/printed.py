"""The multi-source paper's equations on the paper's own system: rings on a soft pedestal.

The paper writes its equations for the bearing's parts alone (eqs. 1 to 6) and calls 28,000 r/min critical.
Both rings then have to be on 3.3e5 N/m: 467 Hz with their 38 g. Two readings of its sound:

``printed``   eqs. 16 and 41 take magnitudes |v|, which turn a sine into a constant and twice its frequency
``energies``  at each frequency the energies of the vector's components, all cosines 1

In both the energies of a component's sources add, and so do the components' (eqs. 43 and 46). Neither has
angles: P1 and P3 are the same.
"""

from typing import Any

import numpy as np

from examples.papers import page, values
from examples.papers.case import Case
from examples.papers.hearing import Ear, Places, Sources, below, line
from examples.papers.lines import LAST, LINES, PARTS, POINTS, SPECTRA, SPEEDS, frequencies, orderings, ours
from examples.papers.page import Output
from examples.papers.runs import Results, Runs
from examples.papers.statements import classed, counts
from fmu_bearing.engine.layout import SD
from fmu_bearing.results.table import markdown

NAME = "printed"
MODULES = ("printed", "lines", "hearing", "values")
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
#: Radiation model behind each reading, and over how many seeds it is run.
READINGS = {"energies": ("paper_vector", 8), "printed": ("paper", 2)}


def cases(seeds: tuple[int, ...], quick: bool) -> list[Case]:
    """Operating points of one reading."""
    if quick:
        return [Case(SCENE, 28000, CHANGES, seed, 0.01, 0.052) for seed in seeds]
    # every second speed and the speeds of the values: 144 runs of the reading, not 248;
    # a mode at 467 Hz with a damping ratio of 0.05 falls by 60 dB in 50 ms
    speeds = sorted({*SPEEDS[::2], *SPECTRA, *(int(value.rpm) for value in VALUES)})
    return [Case(SCENE, rpm, CHANGES, seed) for rpm in speeds for seed in seeds]


def directions(distance: float) -> Places:
    """Three places at one distance (m) in the directions of the axes.

    A vector's direction cosines towards them are 1 for one of its components each, so the sum of energies
    there is that of all components with all cosines 1.
    """
    return [(-distance, 0.0, 0.0), (0.0, distance, 0.0), (0.0, 0.0, distance)]


def sources_at(ear: Ear, distance: float) -> Sources:
    """Return each component's sources at a distance, shape (sources, 1, size), and ``total``."""
    if ear.radiation_model == "paper":
        return ear.sources([(0.0, distance, 0.0)])
    many = len(SD.KINDS)
    parts = ear.parts(directions(distance), lambda path: many * path.component + path.kind)
    found = {
        name: np.concatenate([part[:, None] for key, part in parts.items() if key // many == k])
        for k, name in enumerate(SD.COMPONENTS)
        if any(key // many == k for key in parts)
    }
    return found | {"total": np.concatenate(list(found.values()))}


def reduce(ear: Ear, quick: bool) -> dict[str, Any]:
    """Levels up to 4 kHz at the four distances by component, and lines at P1."""
    rate = ear.recording.rate
    at = frequencies(ear)
    levels: dict[str, list[float]] = {}
    lines: dict[str, dict[str, float]] = {}
    apart = (0.105, 0.150, 0.105, 0.0805)  # m, of P1 to P4 from the bearing's centre
    by_distance = {distance: sources_at(ear, distance) for distance in set(apart)}
    for distance in apart:
        for name, found in by_distance[distance].items():
            levels.setdefault(name, []).append(float(below(found, rate, LAST)[0]))
    for name, found in by_distance[apart[0]].items():
        lines[name] = {key: line(found[:, 0], rate, at[key]) for key in LINES}
    return {"levels": levels, "lines": lines, "frequencies": at}


def page_part(runs: Runs, output: Output) -> str:
    """Run both readings, write their CSV, return their part of the multi-source paper's page."""
    found = {
        reading: runs.all(
            NAME, cases(runs.seeds[:seeds], runs.quick), f"{NAME}: {reading}", radiation_model=model
        )
        for reading, (model, seeds) in READINGS.items()
    }
    words, rows = [], []
    for reading, by_case in found.items():
        now: dict[int, dict[int, dict[str, Any]]] = {}
        for case, result in by_case.items():
            now.setdefault(case.seed, {})[int(case.rpm)] = result
        met = values.met(VALUES, [ours(VALUES, now[seed]) for seed in sorted(now)])
        judged = classed([orderings(now[seed]) for seed in sorted(now)], {})
        held = [str(number) for number, one in enumerate(judged, 1) if one.kind == "holds"]
        words.append(
            f"Reading `{reading}`. {counts(judged)}; those that hold: {', '.join(held) or 'none'}.\n\n"
            f"{page.values_table(met)}"
        )
        rows += [
            [reading, str(seed), str(rpm), name, *(f"{v:.2f}" for v in levels)]
            for seed in sorted(now)
            for rpm in sorted(now[seed])
            for name, levels in now[seed][rpm]["levels"].items()
        ]
    output.csv("multi-source-printed", ["reading", "seed", "rpm", "component", *POINTS], rows)
    return "\n".join(words) + "\n" + _levels(found)


def _levels(found: dict[str, Results]) -> str:
    """Mean level over the seeds at P1, which is P3's, by reading and component."""
    rows = []
    for reading, by_case in found.items():
        for rpm in sorted({int(case.rpm) for case in by_case}):
            own = [result["levels"] for case, result in by_case.items() if int(case.rpm) == rpm]
            means = [sum(one[name][0] for one in own) / len(own) for name in ("total", *PARTS)]
            rows.append([reading, f"{rpm:,}", *(f"{mean:.1f}" for mean in means)])
    return markdown(["reading", "r/min", "P1 = P3", "outer ring", "inner ring", "balls", "cage"], rows)
