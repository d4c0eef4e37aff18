"""The sound-field paper: full-ceramic 7009C and its steel twin, circles of 24 points."""

import math
from typing import Any

import numpy as np

from examples.papers import charts, page, values
from examples.papers.case import Case, Changes
from examples.papers.circles import (
    ANGLES,
    FRICTION,
    IMPACT,
    PLACES,
    RADII,
    REASONS,
    L,
    R,
    circle_at,
    orderings,
    twins,
)
from examples.papers.hearing import NAMES, Ear, equivalent
from examples.papers.identification import (
    AMPLITUDE,
    AMPLITUDE_UM,
    EXPONENT,
    Answer,
    by_identify,
    measured_row,
)
from examples.papers.page import Output
from examples.papers.runs import Results, Runs
from examples.papers.statements import HOLDS, Classed, classed, counts
from fmu_bearing.acoustics.analysis.directivity import attenuation
from fmu_bearing.results.table import markdown
from fmu_bearing.scene.sound import cylindrical

NAME = "sound-field"
TITLE = "Sound-field paper: full-ceramic 7009C, circles of 24 points"
MODULES = ("sound_field", "circles", "hearing", "values")
CERAMIC, STEEL = "7009C-full-ceramic", "7009C-steel"
SPEEDS = (3000, 6000, 9000, 12000, 15000, 18000)
LOAD_N, LOAD_DEG = 100.0, 210.0
PULL = f"{LOAD_N:.0f} N at {LOAD_DEG:.0f} deg"
#: Radial load towards the lower right seen from the front, where the paper says the bearing is eccentric.
LOADED = (
    ("mounting.radial_load_y_N", round(-LOAD_N * math.sin(math.radians(LOAD_DEG)), 6)),
    ("mounting.radial_load_z_N", round(LOAD_N * math.cos(math.radians(LOAD_DEG)), 6)),
)
VALUES = values.read(NAME)
FREE = {AMPLITUDE: AMPLITUDE_UM, EXPONENT: (0.8, 2.0)}
SCENE = CERAMIC
#: The paper computes from 0 to 20 kHz.
CHANGES: Changes = (("imperfections.highest_frequency_kHz", 20.0),)
QUICK = (("mounting.flexure", None),)  # rigid rings have fidelities a hundred times as fast
IDENTIFIED, PULLED, TWIN, BEFORE = "ceramic", f"ceramic, {PULL}", "steel", "before"
FALL_GOAL_DB = 2.0

BySpeed = dict[int, dict[str, Any]]


def cases(found: Changes, seeds: tuple[int, ...], quick: bool) -> list[Case]:
    """Operating points: ceramic, with a load, its steel twin; ceramic with the scene's own numbers."""
    if quick:
        return [Case(CERAMIC, 18000, (*QUICK, *found), seed, 0.005, 0.02, IDENTIFIED) for seed in seeds]
    own = sorted({int(value.rpm) for value in VALUES})
    variants = (
        (IDENTIFIED, CERAMIC, found, SPEEDS),
        (PULLED, CERAMIC, (*found, *LOADED), SPEEDS),
        (TWIN, STEEL, found, (18000,)),
        (BEFORE, CERAMIC, (), own),
    )
    return [
        Case(scene, rpm, (*CHANGES, *changes), seed, label=label)
        for label, scene, changes, speeds in variants
        for rpm in speeds
        for seed in seeds
    ]


def identified(runs: Runs) -> Answer:
    """Identify the free numbers from the fitted values."""
    return by_identify(
        SCENE, QUICK if runs.quick else CHANGES, FREE, measured(values.FIT), VALUES, seeds=len(runs.seeds),
        folder=runs.cache / NAME / "identify", workers=runs.jobs, radiation_model=runs.radiation_model,
        quick=runs.quick,
    )  # fmt: skip


def measured(*roles: str) -> list[dict[str, Any]]:
    """Levels at single points as `fmu_bearing.identify` reads them."""
    found = []
    for value in VALUES:
        if value.role in roles and value.quantity == "leq" and value.place != "mean":
            place = cylindrical(float(value.place), R, L)
            found.append(
                {f"{axis}_mm": round(1e3 * x, 3) for axis, x in zip("xyz", place, strict=True)}
                | measured_row(value)
            )
    return found


def reduce(ear: Ear, quick: bool) -> dict[str, Any]:
    """Levels round circles, shape (radii, places, 24), and by component on the paper's circle.

    The whole field at 18,000 r/min, of which the paper speaks; at other speeds its circle alone.
    """
    recording = ear.recording
    whole = round(recording.scene.operation.speed_rpm) == 18000
    radii, places = (RADII, PLACES) if whole else ((R,), (L,))
    grid = [cylindrical(a, r, x) for r in radii for x in places for a in ANGLES]
    field = ear.levels(grid).reshape(len(radii), len(places), len(ANGLES))
    own = ear.sources([cylindrical(a, R, L) for a in ANGLES])
    late = recording.output_time >= recording.start
    return {
        "radii": list(radii),
        "places": list(places),
        "field": field.round(3).tolist(),
        "parts": {name: equivalent(found).round(3).tolist() for name, found in own.items()},
        "cage_ratio": float(np.mean(recording.outputs["cage.speed_ratio"][late])),
    }


def ours(results: BySpeed, steel: BySpeed, directive: bool) -> dict[str, float]:
    """Our values of one seed, by name."""
    found = {}
    for value in VALUES:
        by_speed = steel if value.quantity == "steel dv" else results
        if int(value.rpm) in by_speed:
            number = _read(value, by_speed[int(value.rpm)], directive)
            if number is not None:
                found[value.name] = number
    return found


def _read(value: values.Value, result: dict[str, Any], directive: bool) -> float | None:
    """One value from the circles of one run; None where the radiation model cannot give it."""
    if value.quantity == "leq":
        circle = circle_at(result)
        return circle.mean if value.place == "mean" else float(circle.levels[ANGLES.index(int(value.place))])
    places = [tuple(int(x) for x in place.split(",")) for place in value.place.split(";")]
    if value.quantity == "fall":
        near, far = (circle_at(result, *place).top for place in places)
        return near - far
    return circle_at(result, *places[0]).dv if directive else None


def write(found: Results, answer: Answer, runs: Runs, output: Output) -> str:
    """Write pictures and CSV; return the page."""
    radiation_model = runs.radiation_model
    every: dict[str, dict[int, BySpeed]] = {}
    for case, result in found.items():
        every.setdefault(case.label, {}).setdefault(case.seed, {})[int(case.rpm)] = result
    directive = radiation_model != "compact"  # see page.caution
    now, steel = every[IDENTIFIED], every.get(TWIN, {})
    seeds = sorted(now)
    judged = {
        name: classed([orderings(every[name][seed], directive) for seed in seeds], REASONS)
        for name in (IDENTIFIED, PULLED)
        if name in every
    }
    twin = classed([twins(now[seed], steel.get(seed, {}), directive) for seed in seeds], {})
    met = values.met(VALUES, [ours(now[seed], steel.get(seed, {}), directive) for seed in seeds])
    before = values.met(VALUES, [ours(one, {}, directive) for one in every.get(BEFORE, {}).values()])
    first = {name: by_seed[seeds[0]] for name, by_seed in every.items() if name != BEFORE}
    _csv(every, output)
    output.records("sound-field-measured", measured(values.FIT, values.CHECK))
    if directive:
        _pictures(first, output)
    any_case = next(iter(found))
    return page.template(NAME).format(
        title=TITLE, caution=page.caution(radiation_model), radiation_model=radiation_model,
        pull=PULL, identified=answer.words, command=answer.command, seeds=len(seeds),
        timing=page.timing(any_case.settle, any_case.duration), counts=counts([*judged[IDENTIFIED], *twin]),
        values=page.values_part(met, before),
        slope=page.slope_table([one for one in met if one.value.quantity == "leq"]),
        falls=_falls(met), statements=page.statements_table(judged[IDENTIFIED]),
        pulled=_pulled(judged.get(PULLED, [])), twins=page.statements_table(twin),
        circles=_circle_table(first) + PICTURE if directive else NO_CIRCLE,
        chance=_chance_table(every) if directive else NO_CIRCLE,
        field=_field_table(first, directive), doubling=_doubling_table(first), parts=_part_table(first),
    )  # fmt: skip


def _falls(met: list[values.Met]) -> str:
    """Falls over r and l against the goal."""
    rows = [
        [
            one.value.name, page.printed(one.value.paper), f"{one.mean:.1f}", page.spread(one.ours),
            f"{one.from_middle:+.1f}",
            "met" if abs(one.from_middle) <= FALL_GOAL_DB else "**not met**",
        ]
        for one in met
        if one.value.quantity == "fall"
    ]  # fmt: skip
    columns = [
        "18,000 r/min, SPLmax",
        "paper, dB",
        "ours",
        "seeds",
        "difference",
        f"goal: within {FALL_GOAL_DB:.0f}",
    ]
    return markdown(columns, rows)


def _pulled(judged: list[Classed]) -> str:
    """Say for how many seeds each statement holds with the load."""
    rows = [
        [f"{number}. {one.statement}", f"{one.holds} of {one.seeds}", f"{100.0 * one.share:.0f} %"]
        for number, one in enumerate(judged, 1)
    ]
    held = sum(one.kind == HOLDS for one in judged)
    if not rows:
        return "Not run.\n"
    return f"{held} of {len(rows)} hold.\n\n" + markdown(
        ["what the paper states", "seeds", "comparisons"], rows
    )


PICTURE = "\n![Circles: speeds, radii, ceramic and steel](../images/papers/sound-field.png)\n"
NO_CIRCLE = "Not shown: this radiation model gives no directivity.\n"


def _circle_table(results: dict[str, BySpeed]) -> str:
    rows = []
    for name, by_speed in results.items():
        for rpm in sorted(by_speed):
            c = circle_at(by_speed[rpm])
            impact, friction = c.zone(IMPACT), c.zone(FRICTION)
            rows.append([
                name, f"{rpm:,}", *(f"{c.levels[k]:.1f}" for k in (0, 6, 12, 18)), f"{c.mean:.1f}",
                f"{c.angle}", f"{c.dv:.2f}", f"{impact[1]}", f"{friction[1]}", f"{impact[2]:.4f}",
                f"{friction[2]:.4f}", f"{c.dl:.4f}",
            ])  # fmt: skip
    columns = ["variant", "r/min", "point 1", "7", "13", "19", "mean", "DA", "DV", "DA 0-60", "DA 180-240",
               "DL 0-60", "DL 180-240", "DL whole"]  # fmt: skip
    return markdown(columns, rows)


def _chance_table(every: dict[str, dict[int, BySpeed]]) -> str:
    """Circle at the highest speed for all seeds."""
    rows = []
    for name in (IDENTIFIED, PULLED):
        for seed, by_speed in sorted(every.get(name, {}).items()):
            if 18000 in by_speed:
                c = circle_at(by_speed[18000])
                rows.append([name, f"{seed}", f"{c.mean:.1f}", f"{c.angle}", f"{c.dv:.2f}",
                             f"{c.zone(IMPACT)[1]}", f"{c.zone(FRICTION)[1]}"])  # fmt: skip
    return markdown(["variant", "seed", "mean, dB", "DA", "DV, dB", "DA 0-60", "DA 180-240"], rows)


def _field_table(results: dict[str, BySpeed], directive: bool) -> str:
    rows = []
    for name in (IDENTIFIED, PULLED):
        for r in RADII if 18000 in results.get(name, {}) else ():
            for place in PLACES:
                c = circle_at(results[name][18000], r, place)
                spread = [f"{c.angle}", f"{c.dl:.4f}", f"{c.dv:.2f}"] if directive else []
                rows.append([name, f"{r}", f"{place}", f"{c.top:.1f}", f"{c.mean:.1f}", *spread])
    columns = ["variant", "r, mm", "l, mm", "SPLmax, dB", "mean, dB"]
    return markdown(columns + (["DA, deg", "DL", "DV, dB"] if directive else []), rows)


def _doubling_table(results: dict[str, BySpeed]) -> str:
    """Fit the change of the circles' mean per doubling of r, and of l."""
    rows = []
    for name in (IDENTIFIED, PULLED):
        if 18000 in results.get(name, {}):
            result = results[name][18000]
            over_r = attenuation(RADII, [circle_at(result, r, L).mean for r in RADII])
            over_l = attenuation(PLACES, [circle_at(result, R, x).mean for x in PLACES])
            rows += [
                [name, words, f"{fit.per_doubling:+.2f} dB", f"{fit.residual:.2f} dB"]
                for words, fit in (("r (at l 50 mm)", over_r), ("l (at r 210 mm)", over_l))
            ]
    return markdown(["variant", "over", "per doubling", "largest deviation from it"], rows)


def _part_table(results: dict[str, BySpeed]) -> str:
    rows = []
    for name, by_speed in results.items():
        for rpm in sorted(by_speed):
            parts = by_speed[rpm]["parts"]
            levels = [f"{_mean(parts[c]):.1f}" if c in parts else "" for c in (*NAMES, "total")]
            rows.append([name, f"{rpm:,}", *levels, f"{by_speed[rpm]['cage_ratio']:.4f}"])
    return markdown(["variant", "r/min", *NAMES.values(), "total", "cage over shaft speed"], rows)


def _mean(levels) -> float:
    """Energy mean of levels (dB)."""
    return 10.0 * math.log10(sum(10.0 ** (x / 10.0) for x in levels) / len(levels))


def _csv(every: dict[str, dict[int, BySpeed]], output: Output) -> None:
    rows = [
        [name, str(seed), str(rpm), str(r), str(place), *(f"{value:.2f}" for value in result["field"][i][k])]
        for name, by_seed in every.items()
        for seed, results in sorted(by_seed.items())
        for rpm, result in sorted(results.items())
        for i, r in enumerate(result["radii"])
        for k, place in enumerate(result["places"])
        if (r, place) == (R, L) or (name == IDENTIFIED and seed == min(by_seed))
    ]
    output.csv("sound-field", ["variant", "seed", "rpm", "r_mm", "l_mm", *(f"{a}_deg" for a in ANGLES)], rows)


def _pictures(results: dict[str, BySpeed], output: Output) -> None:
    """Draw circles about their own mean: all speeds, all radii, ceramic and steel."""
    drawn, axes = charts.figure(12.0, 8.6, 2, 3, polar=True)

    def draw(ax, named, title):
        lines = {f"{name} ({c.mean:.1f} dB)": list(c.levels - c.mean) for name, c in named.items()}
        if lines:
            charts.circle(ax, ANGLES, lines, title)

    for k, name in enumerate((IDENTIFIED, PULLED, TWIN)):
        by_speed = results.get(name, {})
        draw(axes[k], {f"{rpm:,} r/min": circle_at(by_speed[rpm]) for rpm in sorted(by_speed)}, name)
    for k, name in enumerate((IDENTIFIED, PULLED)):
        if 18000 in results.get(name, {}):
            radii = {f"r {r} mm": circle_at(results[name][18000], r) for r in RADII}
            draw(axes[3 + k], radii, f"{name}, 18,000 r/min, over r")
    places = results[IDENTIFIED].get(18000)
    if places is not None:
        draw(axes[5], {f"l {x} mm": circle_at(places, R, x) for x in PLACES}, "ceramic, 18,000 r/min, over l")
    charts.save(drawn, output.images / "sound-field.png")
