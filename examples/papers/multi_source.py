"""The multi-source paper: hybrid 7003C in a motorised spindle, four points, 10,000 to 40,000 r/min."""

import math
from typing import Any

import numpy as np

from examples.papers import charts, page, printed, values
from examples.papers.case import Case, Changes, changed
from examples.papers.hearing import NAMES, Ear, equivalent, line, spectrum
from examples.papers.identification import (
    AMPLITUDE,
    AMPLITUDE_UM,
    EXPONENT,
    Answer,
    by_identify,
    measured_row,
)
from examples.papers.lines import (
    LAST,
    LINES,
    PARTS,
    POINTS,
    REASONS,
    SPECTRA,
    SPEEDS,
    STEP,
    frequencies,
    orderings,
    ours,
)
from examples.papers.page import Output
from examples.papers.runs import Results, Runs
from examples.papers.statements import classed, counts
from fmu_bearing.results.table import markdown

NAME = "multi-source"
TITLE = "Multi-source paper: 7003C in a spindle, 10,000 to 40,000 r/min"
MODULES = ("multi_source", "lines", "hearing", "values")
SCENE = "7003C-spindle"
CHANGES: Changes = ()  # to the scene, besides what is identified
VALUES = values.read(NAME)
FREE = {
    AMPLITUDE: AMPLITUDE_UM,
    EXPONENT: (0.8, 2.0),
    "imperfections.unbalance_um": (0.05, 20.0),
}
IDENTIFIED, BEFORE = "identified", "before"
#: Masses (kg) of rotor and housing at the ends of what the paper's dimensions leave open: a shaft of about
#: 0.5 kg with a motor's rotor on it, a housing of d100 x 160 mm. The scene has them in the middle.
CORNERS = ((1.0, 6.0), (1.0, 8.0), (1.5, 6.0), (1.5, 8.0))
_CORNER_SEEDS = 4
_CRITICAL_HZ = 28000 / 60.0  # of the first lateral mode, which the pedestal is tuned to


def cases(found: Changes, seeds: tuple[int, ...], quick: bool) -> list[Case]:
    """Operating points: all speeds with what is identified, the speeds of the values with the scene's own."""
    if quick:
        return [Case(SCENE, 28000, (*CHANGES, *found), seed, 0.01, 0.052, IDENTIFIED) for seed in seeds]
    own = sorted({int(value.rpm) for value in VALUES})
    return [
        Case(SCENE, rpm, (*CHANGES, *changes), seed, label=label)
        for label, changes, speeds in ((BEFORE, (), own), (IDENTIFIED, found, SPEEDS))
        for rpm in speeds
        for seed in seeds
    ]


def identified(runs: Runs) -> Answer:
    """Identify the free numbers from the fitted values."""
    return by_identify(
        SCENE, CHANGES, FREE, measured(values.FIT), VALUES, seeds=len(runs.seeds),
        folder=runs.cache / NAME / "identify", workers=runs.jobs, radiation_model=runs.radiation_model,
        quick=runs.quick,
    )  # fmt: skip


def with_masses(rotor: float, housing: float) -> Changes:
    """Return the changes that other masses (kg) need: the pedestal keeps the lateral mode at 467 Hz."""
    scene = changed(SCENE, CHANGES)
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


def _corner_table(runs: Runs) -> str:
    """Identify again with other assumed masses, from the same fitted values; what the checked ones become."""
    if runs.quick:
        return "Not run.\n"
    checked = [value for value in VALUES if value.role == values.CHECK and not value.without]
    seeds, rows = runs.seeds[:_CORNER_SEEDS], []
    for rotor, housing in CORNERS:
        fixed = (*CHANGES, *with_masses(rotor, housing))
        answer = by_identify(
            SCENE, fixed, FREE, measured(values.FIT), VALUES, seeds=len(seeds),
            folder=runs.cache / NAME / "identify", workers=runs.jobs, radiation_model=runs.radiation_model,
        )  # fmt: skip
        cases = [
            Case(SCENE, value.rpm, (*fixed, *answer.changes), seed) for value in checked for seed in seeds
        ]
        words = f"{NAME}: rotor {rotor:g} kg, housing {housing:g} kg"
        by_seed: dict[int, dict[int, dict[str, Any]]] = {}
        for case, result in runs.all(NAME, cases, words).items():
            by_seed.setdefault(case.seed, {})[int(case.rpm)] = result
        met = values.met(checked, [ours(checked, one) for one in by_seed.values()])
        rows.append([
            f"{rotor:g}", f"{housing:g}", *(f"{one.after:.3g}" for one in answer.numbers),
            *(f"{one.residual:+.1f}" for one in met), f"{values.rms(met):.1f}",
        ])  # fmt: skip
    columns = ["rotor, kg", "housing, kg", "A_1, um", "p", "unbalance, um", *(one.name for one in checked)]
    return markdown([*columns, "rms"], rows)


def measured(*roles: str) -> list[dict[str, Any]]:
    """Values as `fmu_bearing.identify` reads them."""
    return [
        {"microphone": value.place} | measured_row(value)
        for value in VALUES
        if value.role in roles and not value.without
    ]


def reduce(ear: Ear, quick: bool) -> dict[str, Any]:
    """Levels at the four points, by component, lines and spectra at P1."""
    recording = ear.recording
    sources = ear.sources(recording.positions)
    at = frequencies(ear)
    rate = recording.rate
    return {
        "levels": {name: equivalent(found).tolist() for name, found in sources.items()},
        "frequencies": at,
        "lines": {
            name: {key: line(found[:, 0], rate, f) for key, f in at.items()}
            for name, found in sources.items()
        },
        "spectra": {
            name: spectrum(found[:, 0], rate, STEP, LAST).round(2).tolist() for name, found in sources.items()
        },
    }


def write(found: Results, answer: Answer, runs: Runs, output: Output) -> str:
    """Write pictures and CSV; return the page."""
    radiation_model = runs.radiation_model
    results: dict[str, dict[int, dict[int, dict[str, Any]]]] = {IDENTIFIED: {}, BEFORE: {}}
    for case, result in found.items():
        results[case.label].setdefault(case.seed, {})[int(case.rpm)] = result
    now = results[IDENTIFIED]
    first = now[min(now)]
    _pictures(first, radiation_model, output)
    _csv(now, output)
    output.records("multi-source-measured", measured(values.FIT, values.CHECK))
    judged = classed([orderings(now[seed]) for seed in sorted(now)], REASONS)
    met = values.met(VALUES, [ours(VALUES, now[seed]) for seed in sorted(now)])
    before = values.met(VALUES, [ours(VALUES, one) for one in results[BEFORE].values()])
    any_case = next(iter(found))
    return page.template(NAME).format(
        timing=page.timing(any_case.settle, any_case.duration), seeds=len(now),
        title=TITLE, caution=page.caution(radiation_model), radiation_model=radiation_model,
        identified=answer.words, command=answer.command, values=page.values_part(met, before),
        form=_form(met, any_case.build().imperfections.ball_form_nm),
        slope=page.slope_table([one for one in met if one.value.place == "P3"]), corners=_corner_table(runs),
        counts=counts(judged), statements=page.statements_table(judged),
        printed=printed.page_part(runs, output),
        levels=_level_table(now), lines=_line_table(first), frequencies=_frequency_table(first),
    )  # fmt: skip


def _form(met: list[values.Met], own_nm: float) -> str:
    """Say how far balls would have to be from spheres for the paper's line at f_b."""
    found = [one for one in met if one.value.quantity == "line f_b"]
    if not found:
        return "not run"
    needed = own_nm * 10.0 ** ((found[0].value.paper.middle - found[0].mean) / 20.0)
    return f"{1e-3 * needed:.0f} um"


def _level_table(now: dict[int, dict[int, dict[str, Any]]]) -> str:
    """Mean level of the seeds at the four points and of the components at P1, with P3's range."""
    rows = []
    for rpm in sorted(now[min(now)]):
        levels = [one[rpm]["levels"] for one in now.values() if rpm in one]
        total = np.array([one["total"] for one in levels])
        parts = [np.mean([one[c][0] for one in levels]) for c in PARTS]
        rows.append([f"{rpm:,}", *(f"{v:.1f}" for v in total.mean(axis=0)), page.spread(total[:, 2]),
                     *(f"{v:.1f}" for v in parts)])  # fmt: skip
    return markdown(["r/min", *POINTS, "P3, seeds", *(f"P1 {NAMES[c]}" for c in PARTS)], rows)


def _line_table(first: dict[int, dict[str, Any]]) -> str:
    rows = [
        [f"{rpm:,}", NAMES.get(c, c), *(f"{first[rpm]['lines'][c][key]:.1f}" for key in LINES)]
        for rpm in SPECTRA
        if rpm in first
        for c in (*PARTS, "total")
    ]
    return markdown(["r/min", "component", *LINES], rows)


def _frequency_table(first: dict[int, dict[str, Any]]) -> str:
    rows = [
        [f"{rpm:,}", *(f"{first[rpm]['frequencies'][key]:.1f}" for key in LINES)]
        for rpm in SPECTRA
        if rpm in first
    ]
    return markdown(["r/min", *LINES], rows)


def _csv(now: dict[int, dict[int, dict[str, Any]]], output: Output) -> None:
    rows = [
        [str(seed), str(rpm), name, *(f"{value:.2f}" for value in levels)]
        for seed in sorted(now)
        for rpm in sorted(now[seed])
        for name, levels in now[seed][rpm]["levels"].items()
    ]
    output.csv("multi-source-levels", ["seed", "rpm", "component", *POINTS], rows)
    first = now[min(now)]
    columns = {
        f"{rpm} {name}": levels
        for rpm in SPECTRA
        if rpm in first
        for name, levels in first[rpm]["spectra"].items()
    }
    rows = [
        [f"{STEP * k:g}", *(f"{value:.1f}" for value in levels)]
        for k, levels in enumerate(zip(*columns.values(), strict=True))
    ]
    output.csv("multi-source-spectra", ["frequency_Hz", *columns], rows)


def _pictures(first: dict[int, dict[str, Any]], radiation_model: str, output: Output) -> None:
    """Levels over speed; spectra of each component at the paper's four speeds; of the first seed."""
    drawn, axes = charts.figure(10.5, 3.6, 1, 2)
    speeds = sorted(first)
    lines = {p: [first[n]["levels"]["total"][k] for n in speeds] for k, p in enumerate(POINTS)}
    charts.curves(axes[0], speeds, lines, f"total, radiation model {radiation_model}", "r/min")
    for value in VALUES:
        if value.quantity == "leq":
            low, high = value.paper.low, value.paper.high
            place = POINTS.index(value.place)
            axes[0].plot(
                [value.rpm] * 2, [low - 0.2, high + 0.2], color=charts.COLOURS[place], linewidth=5, alpha=0.4
            )
    parts = {NAMES[c]: [first[n]["levels"][c][0] for n in speeds] for c in PARTS}
    charts.curves(axes[1], speeds, parts, f"components at P1, radiation model {radiation_model}", "r/min")
    axes[0].legend(fontsize=8)
    axes[1].legend(fontsize=8)
    charts.save(drawn, output.images / "multi-source-levels.png")
    speeds = [rpm for rpm in SPECTRA if rpm in first]
    drawn, axes = charts.figure(11.0, 2.6 * len(PARTS), len(PARTS), max(len(speeds), 1))
    for i, part in enumerate(PARTS):
        for k, rpm in enumerate(speeds):
            ax = axes[i * len(speeds) + k]
            levels = np.array(first[rpm]["spectra"][part])
            ax.plot(STEP * np.arange(len(levels)), levels, color=charts.COLOURS[i], linewidth=0.8)
            bottom = np.percentile(levels[1:], 10) - 10.0
            ax.set_ylim(bottom, levels[1:].max() + 20.0)
            for j, (key, f) in enumerate(first[rpm]["frequencies"].items()):
                ax.axvline(f, color="0.6", linewidth=0.6, linestyle=":")
                place = levels[1:].max() + (2.0, 8.0, 14.0)[j % 3]
                ax.annotate(key, (f, place), fontsize=6, ha="center", color="0.3")
            ax.set_title(f"{NAMES[part]}, {rpm:,} r/min", fontsize=8)
            ax.tick_params(labelsize=7)
    charts.save(drawn, output.images / "multi-source-spectra.png")
