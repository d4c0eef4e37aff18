"""The multi-source paper: hybrid 7003C in a motorised spindle, four points, 10,000 to 40,000 r/min."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from examples.papers import charts, page, printed, printed_motion, values
from examples.papers.case import Case, Changes, changed, code_hash
from examples.papers.hearing import NAMES
from examples.papers.identification import Answer, Number, amplitude, identify
from examples.papers.lines import PARTS, POINTS, REMARKS, SPECTRA, SPEEDS, loudest_line, orderings, ours
from examples.papers.medians import by_seed
from examples.papers.page import Output, Slope
from examples.papers.reduced import LINES, STEP
from examples.papers.runs import Results, Runs
from examples.papers.statements import classed, classes_table, counts
from examples.papers.values import CHECK, FIT, Met
from fmu_bearing import modes
from fmu_bearing.engine.sources import source_hash
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.results.table import markdown

NAME = "multi-source"
STATEMENTS = f"{NAME}-statements"
TITLE = "Multi-source paper: 7003C in a spindle, 10,000 to 40,000 r/min"
SCENE = "7003C-spindle"
VALUES = values.read(NAME)
#: The pedestal's axis y' up and z' across: its stiffness is K_oy of eq. 5, and the ratio K_oz over K_oy.
AXES: Changes = (("mounting.pedestal_axis_angle_deg", 90.0),)
_CRITICAL_HZ = 28000 / 60.0  # of the first lateral mode, which the pedestal is tuned to


def _grade(unbalance: float) -> str:
    """Balance grade (ISO 21940-11) of an unbalance (um) at 28,000 r/min."""
    grade = unbalance * 1e-3 * 2.0 * math.pi * _CRITICAL_HZ
    return f"balance grade G {grade:.1f} at 28,000 r/min: spindles have 0.4 to 1"


#: The exponent of the waviness stays the catalogue's: no two values determine it beside A_1.
NUMBERS = (
    amplitude("P3, 10,000 r/min"),
    Number(
        "unbalance", "um", ("imperfections.unbalance_um",), "P1, line f_r, 28,000 r/min", (0.05, 20.0), _grade
    ),
    Number(
        "K_oz over K_oy of the pedestal", "", ("mounting.pedestal_stiffness_ratio",), "P3, 30,000 r/min",
        (0.5, 1.1), lambda ratio: "a machine's bed is seldom as stiff up as across; nobody measured this one",
        24.0, "P1, line f_r, 28,000 r/min",
    ),
)  # fmt: skip
#: Masses (kg) of rotor and housing at the ends of what the paper's dimensions leave open: a shaft of about
#: 0.5 kg with a motor's rotor on it, a housing of d100 x 160 mm. The scene has them between these. The mode
#: of rotor against housing is at its highest and its lowest with them.
CORNERS = ((1.0, 6.0), (1.5, 8.0))
SHOWN = (*range(10000, 40001, 5000), 28000)  # r/min, in the table of levels
FRICTION_SPEEDS = (10000, 20000, 28000, 40000)
#: No friction between any two bodies. Without traction nothing drives the balls, so what brakes them is taken
#: away, too; what gyroscopic moments do is friction's work alone.
FRICTIONLESS: Changes = (
    ("lubricant.traction_max", 0.0),
    ("fidelity.terms.pocket_friction", False),
    ("fidelity.terms.land_film", False),
    ("fidelity.terms.rolling_resistance", False),
    ("fidelity.terms.drag", False),
    ("fidelity.terms.gyroscopic", False),
)
_UNKNOWN = (
    "the masses of rotor and housing, the pedestal and what else has modes, on which the places of the peaks "
    "over speed depend; the waves of the measured races; what the motor sounds."
)
BySeed = dict[int, dict[int, dict[str, Any]]]  # then by speed


@dataclass(frozen=True)
class Masses:
    """Checked values with some masses (kg) of rotor and housing, and the numbers identified with these."""

    rotor: float
    housing: float
    numbers: tuple[float, ...]
    checked: tuple[Met, ...]
    runs: str


def _points(runs: Runs, speeds: Iterable[float], changes: Changes) -> list[Case]:
    """Operating points with some changes of the scene."""
    own = (*AXES, *changes)
    if runs.quick:
        return [Case(SCENE, rpm, own, 1, 0.01, 0.052) for rpm in speeds if rpm in (10000, 28000, 30000)]
    return [Case(SCENE, rpm, own) for rpm in speeds]


def _speeds_of(*roles: str) -> list[int]:
    return sorted({int(value.rpm) for value in VALUES if value.role in roles})


def met_of(found: Results) -> list[Met]:
    """Join the values and ours."""
    return values.met(VALUES, ((one.seed, ours(VALUES, one.rpm, result)) for one, result in found.items()))


def identified(runs: Runs) -> Answer:
    """Identify A_1 and the unbalance from the fitted values."""

    def levels(changes: Changes) -> dict[str, Met]:
        own = runs.around(_points(runs, _speeds_of(FIT), changes))
        return {m.value.name: m for m in met_of(runs.all("spindle", own, f"{NAME}: {_amounts(changes)}"))}

    return identify(SCENE, AXES, NUMBERS, VALUES, levels, *([1] if runs.quick else []))


def _amounts(changes: Changes) -> str:
    """Say what is tried."""
    tried = dict(changes)
    return ", ".join(f"{tried[number.keys[0]]:.3g} {number.unit}".strip() for number in NUMBERS)


def with_masses(rotor: float, housing: float) -> Changes:
    """Return the changes that other masses (kg) need: the pedestal keeps the lateral mode at 467 Hz."""
    scene = changed(SCENE, ())
    # all that the pedestal holds moves as one in that mode: stiffness over mass stays
    assert scene.mounting.rotor is not None and scene.mounting.housing is not None
    own = scene.mounting.rotor.mass_kg + scene.mounting.housing.mass_kg
    effective = scene.mounting.pedestal_stiffness_N_m / (2.0 * math.pi * _CRITICAL_HZ) ** 2
    stiffness = (effective + rotor + housing - own) * (2.0 * math.pi * _CRITICAL_HZ) ** 2
    return (
        ("mounting.rotor.mass_kg", rotor),
        ("mounting.housing.mass_kg", housing),
        ("mounting.pedestal_stiffness_N_m", stiffness),
    )


def corners(runs: Runs, answer: Answer) -> list[Masses]:
    """Identify again with other assumed masses, from the same fitted values; what the checked ones become."""
    found = []
    for rotor, housing in () if runs.quick else CORNERS:
        words = f"{NAME}: rotor {rotor:g} kg, housing {housing:g} kg"
        # the search starts at the page's own answer: fewer steps to the same end
        fixed = (*AXES, *answer.changes, *with_masses(rotor, housing))

        def levels(changes: Changes, fixed: Changes = fixed, words: str = words) -> dict[str, Met]:
            own = runs.few(_points(runs, _speeds_of(FIT), (*fixed, *changes)))
            return {m.value.name: m for m in met_of(runs.all("spindle", own, words))}

        own = identify(SCENE, fixed, NUMBERS, VALUES, levels, 4)
        cases = runs.few(_points(runs, _speeds_of(FIT, CHECK), (*fixed, *own.changes)))
        met = met_of(runs.all("spindle", cases, words))
        found.append(
            Masses(rotor, housing, tuple(one.after for one in own.found), _counted(met), "2 seeds x 5 speeds")
        )
    return found


def _counted(met: Iterable[Met]) -> tuple[Met, ...]:
    """Return the checked values that averages count."""
    return tuple(one for one in met if one.value.role == CHECK and not one.value.without)


def own_masses(answer: Answer, met: Iterable[Met]) -> Masses:
    """Return the page's own values with the scene's masses."""
    mounting = changed(SCENE, ()).mounting
    assert mounting.rotor is not None and mounting.housing is not None
    numbers = tuple(one.after for one in answer.found)
    return Masses(
        mounting.rotor.mass_kg, mounting.housing.mass_kg, numbers, _counted(met),
        "the scene's, 4 seeds x 9 speeds",
    )  # fmt: skip


def over_masses(found: Sequence[Masses]) -> str:
    """Say in one point how far the checked values move over the assumed masses."""
    if len(found) < 2:
        return "* **Over the assumed masses:** not run.\n"
    residuals = [
        f"{same[0].value.name} {min(one.residual for one in same):+.1f} to "
        f"{max(one.residual for one in same):+.1f}"
        for same in zip(*(one.checked for one in found), strict=True)
    ]
    rms = [values.rms(one.checked) for one in found]
    (rotors, housings) = ([getattr(one, key) for one in found] for key in ("rotor", "housing"))
    return page.wrapped(
        f"* **Over the assumed masses** (rotor {min(rotors):g} to {max(rotors):g} kg, housing "
        f"{min(housings):g} to {max(housings):g} kg, identified again each time): {page.spread(rms)} dB rms; "
        f"{'; '.join(residuals)}."
    )


def _corner_table(found: Sequence[Masses]) -> str:
    """Numbers identified and residuals of the checked values, by masses."""
    if len(found) < 2:
        return "Not run.\n"
    rows = [
        [
            f"{one.rotor:g}", f"{one.housing:g}", one.runs, *(f"{number:.3g}" for number in one.numbers),
            *(f"{met.residual:+.1f}" for met in one.checked), f"{values.rms(one.checked):.1f}",
        ]
        for one in found
    ]  # fmt: skip
    names = [met.value.name for met in found[0].checked]
    return markdown(
        ["rotor, kg", "housing, kg", "runs", *(n.name for n in NUMBERS), *names, "rms, dB"],
        rows,
    )


#: What breaks the symmetry about the axis, one at a time; loads and angles are chosen.
ASKEW: dict[str, Changes] = {
    "as it is": (),
    "misalignment 2 mrad": (("mounting.misalignment_y_mrad", 2.0),),
    "300 N across": (("mounting.radial_load_y_N", 300.0),),
}


def _axis_table(runs: Runs, answer: Answer) -> str:
    """Level at P4 with what breaks the symmetry of the scene."""
    rows = []
    for name, changes in ({} if runs.quick else ASKEW).items():
        own = runs.few(_points(runs, (28000,), (*answer.changes, *changes)))
        found = [one["floors"] for one in runs.all("floors", own, f"{NAME}: {name}").values()]
        for height in found[0] if not changes else ("free",):
            levels = np.median([one[height] for one in found], axis=0)
            what = name if height == "free" else f"floor {height} mm below the axis"
            rows.append([what, *(f"{levels[k]:.1f}" for k in (3, 0, 2))])
    return markdown(["28,000 r/min", "P4, dB", "P1, dB", "P3, dB"], rows) if rows else "Not run.\n"


def without_friction(runs: Runs, answer: Answer) -> tuple[BySeed, BySeed]:
    """Medians of the same cases with friction and without it."""
    pair = []
    for changes, words in ((answer.changes, "friction"), ((*answer.changes, *FRICTIONLESS), "no friction")):
        own = runs.few(_points(runs, FRICTION_SPEEDS, changes))
        pair.append(by_seed(runs.all("spindle", own, f"{NAME}: {words}").items()))
    return pair[0], pair[1]


def _friction_table(rubbed: BySeed, smooth: BySeed) -> str:
    """Change of the level at P1 by friction, by component and speed, over the seeds."""
    rows = []
    for name in ("total", *PARTS):
        cells = []
        for rpm in smooth[min(smooth)]:
            both = [(rubbed[seed][rpm], smooth[seed][rpm]) for seed in smooth]
            change = [on["levels"][name][0] - off["levels"][name][0] for on, off in both]
            cells.append(f"{min(change):+.1f} to {max(change):+.1f}")
        rows.append([NAMES.get(name, name), *cells])
    return markdown(["with friction less without, dB", *(f"{n:,}" for n in smooth[min(smooth)])], rows)


def page_of(runs: Runs, output: Output) -> str:
    """Run all cases, write pictures and CSV; return the page."""
    answer = identified(runs)
    at_values = runs.around(_points(runs, _speeds_of(FIT, CHECK), answer.changes))
    between = runs.few(_points(runs, set(SPEEDS) - set(_speeds_of(FIT, CHECK)), answer.changes))
    found = runs.all("spindle", [*at_values, *between], NAME)
    now = by_seed(found.items())
    met = met_of(found)
    lines = slopes(met)
    masses = [own_masses(answer, met), *corners(runs, answer)]
    rubbed, smooth = without_friction(runs, answer)
    # seeds that were run at every speed; the others at those of the values alone
    whole = {seed: one for seed, one in now.items() if len(one) == len(now[min(now)])}
    judged = classed([orderings(one, smooth[seed]) for seed, one in whole.items()], REMARKS)
    exact = {
        int(one.rpm): result
        for one, result in found.items()
        if one.seed == min(now) and one.around == 1.0 and one.rpm in SPECTRA
    }
    _pictures(whole[min(whole)], exact, runs.radiation_model, output)
    _csv(now, exact, output)
    _lines_csv(whole, output)
    _write_motion(runs, output)
    statements = page.template(STATEMENTS).format(seeds=len(whole), statements=page.statements_table(judged))
    output.write(STATEMENTS, statements, output.results)
    any_case = next(iter(found))
    return page.template(NAME).format(
        timing=page.timing(any_case.settle, any_case.duration),
        title=TITLE, caution=page.caution(runs.radiation_model), radiation_model=runs.radiation_model,
        verdict=page.verdict_part(answer, met, lines, judged, _UNKNOWN, _missed(met)),
        over_masses=over_masses(masses),
        identified=answer.words, values=page.values_part(met),
        form=_form(met, any_case.build().imperfections.ball_form_nm),
        slope=page.slope_table(lines), rotor_mode=_rotor_mode(), masses=_corner_table(masses),
        counts=counts(judged), classes=classes_table(), seeds=len(whole), axis=_axis_table(runs, answer),
        friction=_friction_table(rubbed, smooth), printed=printed.page_part(runs, output),
        levels=_level_table(whole), carriers=_carrier_table(found),
    )  # fmt: skip


def slopes(met: Iterable[Met]) -> list[Slope]:
    """Slope through the levels at P3."""
    return page.slopes("P3", [m for m in met if m.value.quantity == "leq" and m.value.place == "P3"])


def _write_motion(runs: Runs, output: Output) -> None:
    """Write the page on the paper's equations of motion."""
    if runs.quick:
        return
    code = code_hash("printed_motion", "printed_runs", "printed_equations", "printed_forces")
    place = runs.cache / "printed_motion" / f"{code}-{source_hash()}.json"
    found = runs.one(place, printed_motion.results, "printed equations of motion")
    output.write("printed-motion", printed_motion.page_of(found))


def _rotor_mode() -> str:
    """Say where the mode of the rotor against the housing lies, and where other rotors have it."""
    housing = changed(SCENE, ()).mounting.housing
    assert housing is not None
    found: list[tuple[float, Mode]] = []
    for rotor in (0.0, *sorted({rotor for rotor, _ in CORNERS})):
        changes = with_masses(rotor, housing.mass_kg) if rotor else ()
        scene = changed(SCENE, (*changes, ("operation.speed_rpm", 15000.0)))
        found.append((rotor, next(one for one in modes(scene).modes if one.name == "inner radial")))
    (_, own), *others = found
    words = ", ".join(f"{rotor:g} kg at {mode.frequency:,.0f} Hz" for rotor, mode in others)
    return (
        f"at {own.frequency:,.0f} Hz with {100.0 * own.damping:.1f} % damping (`fmu-bearing modes`; with a "
        f"rotor of {words})"
    )


def _missed(met: Iterable[Met]) -> str:
    """Say by how much the goal is missed, and by which values."""
    checked = _counted(met)
    off = values.rms(checked) - page.GOAL_DB
    if not checked or off <= 0.0:
        return ""
    worst = [one for one in checked if abs(one.residual) > page.GOAL_DB]
    far = ", ".join(f"{one.value.name} ({one.residual:+.1f} dB)" for one in worst)
    return (
        f"the goal, by {off:.1f} dB: {far}. P4 lies on the axis of a scene that has no foot, floor or front"
        " cover ([what they would have to give](#p4)); the levels at 15,000 and 20,000 r/min are "
        "[one line on one mode](#what-the-assumed-masses-decide)."
    )


def _form(met: list[Met], own_nm: float) -> str:
    """Say how far balls would have to be from spheres for the paper's line at f_b."""
    found = [one for one in met if one.value.quantity == "line f_b"]
    if not found:
        return "not run"
    needed = own_nm * 10.0 ** ((found[0].value.paper.middle - found[0].level) / 20.0)
    return f"{1e-3 * needed:.0f} um"


def _level_table(now: BySeed) -> str:
    """Levels at the four points and of the components at P1, with P3's range over the seeds."""
    rows = []
    for rpm in (n for n in sorted(SHOWN) if n in now[min(now)]):
        levels = [one[rpm]["levels"] for one in now.values()]
        total = np.array([one["total"] for one in levels])
        parts = [np.median([one[c][0] for one in levels]) for c in PARTS]
        rows.append([f"{rpm:,}", *(f"{v:.1f}" for v in np.median(total, axis=0)), page.spread(total[:, 2]),
                     *(f"{v:.1f}" for v in parts)])  # fmt: skip
    return markdown(["r/min", *POINTS, "P3, seeds", *(f"P1 {NAMES[c]}" for c in PARTS)], rows)


def _carrier_table(found: Results) -> str:
    """Return the line that is loudest in most runs at each speed that has a level."""
    rows = []
    for rpm in sorted({int(value.rpm) for value in VALUES if value.quantity == "leq"}):
        seen = [loudest_line(result) for one, result in found.items() if one.rpm == rpm]
        if not seen:
            continue
        name, count = Counter(name for name, _, _ in seen).most_common(1)[0]
        at, over = np.median([one[1:] for one in seen if one[0] == name], axis=0)
        rows.append([f"{rpm:,}", name, f"{at:,.0f}", f"{count} of {len(seen)}", f"{over:+.1f}"])
    return markdown(["r/min", "loudest line at P1", "Hz, median", "runs", "less the total, dB"], rows)


def _lines_csv(now: BySeed, output: Output) -> None:
    """Write levels of lines at P1, and their frequencies, medians over the seeds."""
    rows = []
    for rpm in (n for n in SPECTRA if n in now[min(now)]):
        results = [one[rpm] for one in now.values()]
        by_name = {"frequency, Hz": [one["frequencies"] for one in results]}
        by_name |= {f"{c}, dB": [one["lines"][c] for one in results] for c in (*PARTS, "total")}
        for name, lines in by_name.items():
            rows.append([str(rpm), name, *(f"{np.median([one[key] for one in lines]):.1f}" for key in LINES)])
    output.csv("multi-source-lines", ["rpm", "of", *LINES], rows)


def _csv(now: BySeed, exact: dict[int, dict[str, Any]], output: Output) -> None:
    rows = [
        [str(seed), str(rpm), name, *(f"{value:.2f}" for value in levels)]
        for seed, results in now.items()
        for rpm, result in results.items()
        for name, levels in result["levels"].items()
    ]
    output.csv("multi-source-levels", ["seed", "rpm", "component", *POINTS], rows)
    columns = {
        f"{rpm} {name}": levels
        for rpm in SPECTRA
        if rpm in exact
        for name, levels in exact[rpm]["spectra"].items()
    }
    rows = [
        [f"{STEP * k:g}", *(f"{value:.1f}" for value in levels)]
        for k, levels in enumerate(zip(*columns.values(), strict=True))
    ]
    output.csv("multi-source-spectra", ["frequency_Hz", *columns], rows)


def _pictures(
    first: dict[int, dict[str, Any]], exact: dict[int, dict[str, Any]], radiation_model: str, output: Output
) -> None:
    """Levels over speed; spectra of each component at the paper's four speeds; of the first seed."""
    drawn, axes = charts.figure(10.5, 3.6, 1, 2)
    speeds = sorted(first)
    lines = {p: [first[n]["levels"]["total"][k] for n in speeds] for k, p in enumerate(POINTS)}
    charts.curves(axes[0], speeds, lines, f"total, radiation model {radiation_model}", "r/min")
    for value in VALUES:
        if value.quantity == "leq":
            low, high = value.paper.low, min(value.paper.high, value.paper.low + 3.0)  # of a bound: its end
            place = POINTS.index(value.place)
            axes[0].plot(
                [value.rpm] * 2, [low - 0.2, high + 0.2], color=charts.COLOURS[place], linewidth=5, alpha=0.4
            )
    parts = {NAMES[c]: [first[n]["levels"][c][0] for n in speeds] for c in PARTS}
    charts.curves(axes[1], speeds, parts, f"components at P1, radiation model {radiation_model}", "r/min")
    axes[0].legend(fontsize=8)
    axes[1].legend(fontsize=8)
    charts.save(drawn, output.images / "multi-source-levels.png")
    speeds = sorted(exact)
    drawn, axes = charts.figure(11.0, 2.6 * len(PARTS), len(PARTS), max(len(speeds), 1))
    for i, part in enumerate(PARTS):
        for k, rpm in enumerate(speeds):
            ax = axes[i * len(speeds) + k]
            levels = np.array(exact[rpm]["spectra"][part])
            ax.plot(STEP * np.arange(len(levels)), levels, color=charts.COLOURS[i], linewidth=0.8)
            bottom = np.percentile(levels[1:], 10) - 10.0
            ax.set_ylim(bottom, levels[1:].max() + 20.0)
            for j, (key, f) in enumerate(exact[rpm]["frequencies"].items()):
                ax.axvline(f, color="0.6", linewidth=0.6, linestyle=":")
                place = levels[1:].max() + (2.0, 8.0, 14.0)[j % 3]
                ax.annotate(key, (f, place), fontsize=6, ha="center", color="0.3")
            ax.set_title(f"{NAMES[part]}, {rpm:,} r/min", fontsize=8)
            ax.tick_params(labelsize=7)
    charts.save(drawn, output.images / "multi-source-spectra.png")
