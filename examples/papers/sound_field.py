"""The sound-field paper: full-ceramic 7009C in a spindle and bare, its steel twin, circles of 24 points."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from examples.papers import page, printed_field, values
from examples.papers.case import FEW_AROUND, SCENES, SEEDS, Case, Changes, around, code_hash
from examples.papers.circles import Circle, orderings
from examples.papers.field_tables import (
    BARE,
    CONTACTS,
    SPINDLE,
    Variants,
    angles_sentence,
    draw_pictures,
    each,
    falls_part,
    field_table,
    part_table,
    sizes_sentence,
    write_csv,
)
from examples.papers.identification import Answer, amplitude, identify
from examples.papers.medians import by_seed
from examples.papers.page import Output, Slope
from examples.papers.printed_field import HELD, SCENE as ALONE
from examples.papers.reduced import ANGLES, WHOLE
from examples.papers.runs import Results, Runs
from examples.papers.statements import Classed, classed, classes_table, counts
from examples.papers.values import CHECK, Met
from fmu_bearing.engine.sources import source_hash
from fmu_bearing.results.table import markdown
from fmu_bearing.scene import read_scene

NAME = "sound-field"
STATEMENTS = f"{NAME}-statements"
TITLE = "Sound-field paper: full-ceramic 7009C, circles of 24 points"
SCENE = "7009C-spindle"
SPEEDS = (3000, 6000, 9000, 12000, 15000, 18000)
VALUES = values.read(NAME)
NUMBERS = (amplitude("18,000 r/min, 210 deg"),)
#: The paper computes from 0 to 20 kHz.
BAND: Changes = (("imperfections.highest_frequency_kHz", 20.0),)
_READ = {int(value.rpm) for value in VALUES}  # r/min
PICTURE = "\n![Circles: speeds, radii, ceramic and steel](../images/papers/sound-field.png)\n"
NO_CIRCLE = "Not shown: this radiation model gives no directivity.\n"
NOT_RUN = "Not run.\n"
_OFF, _STEP_RPM = "15,000 r/min, 270 deg", 15000
_SOFT: Changes = (
    ("mounting.pedestal_stiffness_ratio", 0.6),
    ("mounting.pedestal_axis_angle_deg", 45.0),
)
_UNBALANCE: Changes = (("imperfections.unbalance_um", 5.0),)


def _pull(newton: float) -> Changes:
    """Radial load (N) towards 225 deg, the lower right where the paper says that the bearing is eccentric."""
    part = round(newton * 0.5**0.5, 3)
    return (("mounting.radial_load_y_N", part), ("mounting.radial_load_z_N", -part))


#: What could give the circle a direction, each at the same A_1; sizes are chosen, not identified.
DIRECTIONS: dict[str, Changes] = {
    "as it is": (),
    "pedestal 0.6 as stiff along 45 deg": _SOFT,
    "the same, unbalance 5 um (G 9.4)": (*_SOFT, *_UNBALANCE),
    "the same, A_1 0.3 um": (*_SOFT, *((key, 0.3) for key in NUMBERS[0].keys)),
    "300 N at 225 deg": _pull(300.0),
    "1,000 N at 225 deg": _pull(1000.0),
    "misalignment 2 mrad": (("mounting.misalignment_y_mrad", 2.0),),
}
_UNKNOWN = (
    "what gives the paper's zones their direction (it names no radial load), masses and bed of the spindle, "
    "the draw of waves and ball sizes, and what the motor does to the measured levels."
)


def _steel() -> Changes:
    """Rings and balls of the steel twin's scene."""
    materials = read_scene(SCENES / "7009C-steel.toml").materials.model_dump(exclude_none=True)
    parts = ("inner_ring", "outer_ring", "balls")
    return tuple((f"materials.{part}.{key}", x) for part in parts for key, x in materials[part].items())


def case(rpm: float, changes: Changes = (), bare: bool = False) -> Case:
    """One operating point, in the spindle or bare."""
    if bare:
        return Case(ALONE, rpm, (*BAND, *HELD, *changes))
    return Case(SCENE, rpm, (*BAND, *changes))


def cases(runs: Runs, found: Changes, speeds: Sequence[int] = SPEEDS) -> list[Case]:
    """Operating points of the ceramic bearing: those of values with all speeds around, others with five."""
    if runs.quick:
        return runs.around([Case(SCENE, WHOLE, (*BAND, *found), 1, 0.005, 0.02)])
    return [
        *runs.around([case(rpm, found) for rpm in speeds if rpm in _READ]),
        *around([case(rpm, found) for rpm in speeds if rpm not in _READ], SEEDS, FEW_AROUND),
    ]


def _few(speeds: Sequence[int], changes: Changes) -> list[Case]:
    """Operating points of the bare bearing: four seeds, five speeds around each."""
    return around([case(rpm, changes, bare=True) for rpm in speeds], SEEDS, FEW_AROUND)


def identified(runs: Runs, bare: bool = False) -> Answer:
    """Identify A_1 from the fitted value."""

    def levels(changes: Changes) -> dict[str, Met]:
        own = _few((WHOLE,), changes) if bare else cases(runs, changes, (WHOLE,))
        found = runs.all("circles", own, f"{NAME}: {'bare, ' * bare}A_1 {changes[0][1]:.3g} um")
        return {one.value.name: one for one in met_of(found, {}, True)}

    scene, fixed = (ALONE, (*BAND, *HELD)) if bare else (SCENE, BAND)
    return identify(scene, fixed, NUMBERS, VALUES, levels, 1 if runs.quick else 8)


def met_of(ceramic: Results, steel: Results, directive: bool) -> list[Met]:
    """Join the paper's values with ours; without DV where the radiation model resolves no angles."""
    return values.met(
        VALUES,
        (
            (one.seed, ours(one.rpm, result, twin, directive))
            for twin, found in ((False, ceramic), (True, steel))
            for one, result in found.items()
        ),
    )


def ours(rpm: float, result: Mapping[str, Any], twin: bool, directive: bool) -> dict[str, float]:
    """Our values of one run, by name."""
    found = {}
    for value in VALUES:
        if value.rpm != rpm or (value.quantity == "steel dv") != twin:
            continue
        places = [tuple(int(x) for x in place.split(",")) for place in value.place.split(";") if "," in place]
        if value.quantity == "leq":
            circle = Circle(result)
            mean = value.place == "mean"
            found[value.name] = circle.mean if mean else float(circle.levels[ANGLES.index(int(value.place))])
        elif value.quantity == "fall":
            near, far = (Circle(result, *place).top for place in places)
            found[value.name] = near - far
        elif directive:
            found[value.name] = Circle(result, *places[0]).dv
    return found


def slopes(met: Iterable[Met]) -> list[Slope]:
    """Slope through all measured levels."""
    return page.slopes("all measured levels", [one for one in met if one.value.quantity == "leq"])


def judge(ceramic: Results, steel: Results, directive: bool) -> list[Classed]:
    """Class the statements, seed by seed on medians over the speeds around each.

    Figures of statements with one margin get its range over the seeds.
    """
    own, twin = by_seed(ceramic.items()), by_seed(steel.items())
    by = [orderings(own[seed], twin.get(seed, {}), directive) for seed in own]
    found = []
    for k, one in enumerate(classed(by, {})):
        margins = [judged[k].margins for judged in by]
        if len(by) > 1 and all(len(own_) == 1 for own_ in margins) and "/" not in one.figures:
            ends = [margin for (margin,) in margins]
            one = replace(one, figures=f"{one.figures}, all seeds {min(ends):+.1f} to {max(ends):+.1f}")
        found.append(one)
    return found


def page_of(runs: Runs, output: Output) -> str:
    """Run all cases, write pictures and CSV; return the page."""
    answer = identified(runs)
    directive = runs.radiation_model != "compact"  # see page.caution
    found = answer.changes
    all_ = Variants(
        runs.all("circles", cases(runs, found), NAME),
        _unless(runs, "steel twin", lambda: runs.around([case(WHOLE, (*found, *_steel()))])),
    )
    alone = Variants({}, {}) if runs.quick else _alone(runs)
    contacts = Variants({}, {}) if runs.quick else _alone(runs, "paper_contacts")
    met = met_of(all_.ceramic, all_.steel, directive)
    judged = judge(all_.ceramic, all_.steel, directive)
    lines = slopes(met)
    write_csv(NAME, {SPINDLE: all_, BARE: alone, CONTACTS: contacts}, output)
    others = [met_of(one.ceramic, one.steel, True) for one in (alone, contacts) if one.ceramic]
    _compared_csv(met, others, output)
    _write_printed(runs, output)
    if directive:
        draw_pictures(NAME, all_, alone, output)
    statements = page.template(STATEMENTS).format(
        statements=page.statements_table(judged),
        angles=angles_sentence(all_.ceramic) if directive else NO_CIRCLE,
        sizes=sizes_sentence(VALUES, all_.ceramic) if directive else NO_CIRCLE,
    )
    output.write(STATEMENTS, statements, output.results)
    one = next(iter(all_.ceramic))
    return page.template(NAME).format(
        title=TITLE, caution=page.caution(runs.radiation_model), radiation_model=runs.radiation_model,
        verdict=page.verdict_part(answer, met, lines, judged, _UNKNOWN), values=page.values_part(met),
        off=_off(all_, met) if directive and not runs.quick else "",
        slope=page.slope_table(lines), identified=answer.words, timing=page.timing(one.settle, one.duration),
        counts=counts(judged), classes=classes_table(),
        falls=falls_part(VALUES, all_.ceramic, alone.ceramic, contacts.ceramic),
        alone=_alone_part(met, others) if others else NOT_RUN,
        directions=_direction_table(runs, found) if not runs.quick else NOT_RUN,
        circles=PICTURE if directive else NO_CIRCLE, field=field_table(all_.ceramic, directive),
        parts=part_table(all_.ceramic),
    )  # fmt: skip


def _write_printed(runs: Runs, output: Output) -> None:
    """Write the page on the paper's equations of motion."""
    if runs.quick:
        return
    code = code_hash("printed_field", "printed_runs", "printed_equations", "printed_forces")
    place = runs.cache / "printed_field" / f"{code}-{source_hash()}.json"
    found = runs.one(place, printed_field.results, "printed equations 1 to 3")
    output.write("printed-field", printed_field.page_of(found))


def _unless(runs: Runs, words: str, cases: Callable[[], list[Case]], model: str | None = None) -> Results:
    """Results of cases that quick runs leave out."""
    return {} if runs.quick else runs.all("circles", cases(), f"{NAME}: {words}", radiation_model=model)


def _alone(runs: Runs, model: str | None = None) -> Variants:
    """Run the bare bearing and its twin, with its own A_1; the paper's own radiation model needs own runs."""
    found = identified(runs, bare=True).changes
    words = f"bare, {model or runs.radiation_model}"
    return Variants(
        _unless(runs, words, lambda: _few(sorted(_READ), found), model),
        _unless(runs, f"{words}, steel twin", lambda: _few((WHOLE,), (*found, *_steel())), model),
    )


def _named(met: Iterable[Met], name: str) -> Met:
    return next(one for one in met if one.value.name == name)


def _off(all_: Variants, met: Sequence[Met]) -> str:
    """Say by kind how far off values are, and what the farthest of them are bounded by."""
    own, late = _named(met, "DV at r 210, l 50 mm"), _named(met, _OFF)
    rows = each(all_.ceramic, lambda result: Circle(result).dv, WHOLE)
    spot = each(all_.ceramic, lambda result: float(Circle(result).levels[ANGLES.index(270)]), _STEP_RPM)
    parts = {
        group: values.rms(one for one in met if one.value.role == CHECK and one.value.group == group)
        for group in ("measured", "falls", "circles")
    }
    points = (
        f"* **By kind:** measured levels are {parts['measured']:.1f} dB rms off, falls "
        f"{parts['falls']:.1f} dB, DV {parts['circles']:.1f} dB.",
        f"* **DV:** at r 210, l 50 mm it is {own.level:.1f} dB ({min(rows):.1f} to {max(rows):.1f} in "
        f"{len(rows)} runs), calculated there 6.53. All 24 errors of the paper lie between 0.79 and 2.81 dB, "
        "so that the *measured* DV is at least 6.53 - (2.81 - 0.79) = 4.5 dB. [What could give it]"
        "(#what-gives-the-circle-a-direction).",
        f"* **{_OFF}:** ours is {late.level:.1f} dB ({page.spread(spot)} in {len(spot)} runs), in the paper "
        f"{page.printed(late.value.paper)}.",
    )
    return "".join(map(page.wrapped, points))


def _alone_part(met: Sequence[Met], others: Sequence[Sequence[Met]]) -> str:
    """Compare the bare bearing, by our radiation model and by the paper's own, value by value."""
    rows = []
    for one in met:
        cells = [f"{one.level:.1f} ({one.residual:+.1f})"]
        for own in others:
            cells += [f"{m.level:.1f} ({m.residual:+.1f})" for m in own if m.value == one.value]
        rows.append([one.value.name, page.printed(one.value.paper), *cells])
    words = []
    for name, own in zip((SPINDLE, BARE, CONTACTS), (met, *others), strict=True):
        constant = _named(own, NUMBERS[0].value).from_middle
        checked = [m for m in own if m.value.role == CHECK]
        less = [_less(m, constant) if m.value.quantity == "leq" else m for m in checked]
        (line,) = slopes(own)
        words.append(
            f"* {name}: {constant:+.1f} dB off the fitted level; checked values {values.rms(checked):.1f} dB "
            f"rms, less this constant {values.rms(less):.1f} dB; slope {line.ours:.1f} dB per decade (seeds "
            f"{page.spread(line.by_seed)}), paper {line.paper:.1f}"
        )
    columns = ["value", "paper", *(f"{name} (residual)" for name in (SPINDLE, BARE, CONTACTS))]
    return "".join(page.wrapped(f"{one}.") for one in words) + "\n" + markdown(columns, rows)


def _direction_table(runs: Runs, found: Changes) -> str:
    """DV and DA of the circle with what could give it a direction."""
    rows = []
    for name, changes in DIRECTIONS.items():
        got = runs.all("floors", runs.few([case(WHOLE, (*found, *changes))]), f"{NAME}: {name}")
        by = [one[WHOLE]["floors"] for one in by_seed(got.items()).values()]
        for height in by[0] if not changes else ("free",):
            levels = [np.array(one[height]) for one in by]
            dv = [float(np.ptp(one)) for one in levels]
            what = name if height == "free" else f"floor {height} mm below the axis"
            angles = " / ".join(f"{ANGLES[int(one.argmax())]}" for one in levels)
            rows.append([what, f"{np.mean(levels):.1f}", page.spread(dv), angles])
    columns = ["at r 210, l 50 mm, 18,000 r/min", "mean, dB", "DV of the seeds, dB", "their DA, deg"]
    return markdown(columns, rows)


def _less(one: Met, constant: float) -> Met:
    """Take a constant off our value."""
    return Met(one.value, {seed: tuple(x - constant for x in numbers) for seed, numbers in one.ours.items()})


def _compared_csv(met: Sequence[Met], others: Sequence[Sequence[Met]], output: Output) -> None:
    """Write the values of the spindle, of the bare bearing and by the paper's own radiation model."""
    rows = [
        [one.value.name, *(f"{x:.2f}" for x in (one.value.paper.low, one.value.paper.high, one.level)),
         *(f"{other.level:.2f}" for own in others for other in own if other.value == one.value)]
        for one in met
    ]  # fmt: skip
    columns = ["value", "paper_low", "paper_high", SPINDLE, BARE, CONTACTS]
    output.csv(f"{NAME}-values", columns[: len(rows[0])], rows)
