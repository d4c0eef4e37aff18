"""The sound-field paper: full-ceramic 7009C and its steel twin, circles of 24 points."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from examples.papers import page, values
from examples.papers.case import AROUND, FEW_AROUND, FEW_SEEDS, SEEDS, Case, Changes, around
from examples.papers.circles import REASONS, Circle, orderings
from examples.papers.field_tables import (
    CONTACTS,
    Variants,
    angles_sentence,
    draw_pictures,
    each,
    falls_part,
    field_table,
    over,
    part_table,
    sizes_sentence,
    write_csv,
)
from examples.papers.identification import Answer, amplitude, identify
from examples.papers.medians import by_seed
from examples.papers.page import Output, Slope
from examples.papers.reduced import ANGLES, WHOLE
from examples.papers.runs import Results, Runs
from examples.papers.statements import HOLDS, UNSEEN, Classed, classed, counts
from examples.papers.values import CHECK, Met
from fmu_bearing.results.table import markdown

NAME = "sound-field"
TITLE = "Sound-field paper: full-ceramic 7009C, circles of 24 points"
CERAMIC, STEEL = "7009C-full-ceramic", "7009C-steel"
SCENE = CERAMIC
SPEEDS = (3000, 6000, 9000, 12000, 15000, 18000)
LOAD_N, LOAD_DEG = 100.0, 210.0
PULL = f"{LOAD_N:.0f} N at {LOAD_DEG:.0f} deg"
#: Radial load towards the lower right seen from the front, where the paper says the bearing is eccentric.
LOADED: Changes = (
    ("mounting.radial_load_y_N", round(-LOAD_N * math.sin(math.radians(LOAD_DEG)), 6)),
    ("mounting.radial_load_z_N", round(LOAD_N * math.cos(math.radians(LOAD_DEG)), 6)),
)
VALUES = values.read(NAME)
NUMBERS = (amplitude("18,000 r/min, 210 deg"),)
#: The paper computes from 0 to 20 kHz.
CHANGES: Changes = (("imperfections.highest_frequency_kHz", 20.0),)
_RIGID: Changes = (("mounting.flexure", None),)  # quick cases: rigid rings run a hundred times as fast
PICTURE = "\n![Circles: speeds, radii, ceramic and steel](../images/papers/sound-field.png)\n"
NO_CIRCLE = "Not shown: this radiation model gives no directivity.\n"
NOT_RUN = "Not run.\n"
_OFF, _STEP_RPM = "15,000 r/min, 270 deg", 15000
#: Other values of numbers that the scene assumes, to see whether one of them brings what is farthest off.
ASSUMED: tuple[Changes, ...] = (
    (("imperfections.waviness_exponent", 1.7),),
    (("mounting.flexure.damping_ratio", 0.02),),
    (("mounting.flexure.outer_seat_stiffness_N_m", 1e8), ("mounting.flexure.inner_seat_stiffness_N_m", 1e8)),
    (("bearing.contact_damping_us", 25.0),),
    _RIGID,
)
_ASSUMED = (
    "waviness exponent 1.7, four times the rings' damping, rings on seats of 1e8 N/m, ten times the "
    "contacts' damping, rigid rings"
)
_UNKNOWN = (
    "which direction the paper's zones come from (it names no radial load), the draw of waves and ball "
    "sizes, the rings' damping and seats, and what motor and housing do to the measured levels."
)


def case(rpm: float, changes: Changes = (), scene: str = CERAMIC) -> Case:
    """One operating point."""
    return Case(scene, rpm, (*CHANGES, *changes))


def cases(runs: Runs, found: Changes, speeds: Sequence[int] = SPEEDS) -> list[Case]:
    """Operating points of the ceramic bearing: those of values with all speeds around, others with five."""
    if runs.quick:
        return runs.around([Case(CERAMIC, WHOLE, (*CHANGES, *found, *_RIGID), 1, 0.005, 0.02)])
    read = {int(value.rpm) for value in VALUES}
    return [
        *runs.around([case(rpm, found) for rpm in speeds if rpm in read]),
        *around([case(rpm, found) for rpm in speeds if rpm not in read], SEEDS, FEW_AROUND),
    ]


def identified(runs: Runs) -> Answer:
    """Identify A_1 from the fitted value."""

    def levels(changes: Changes) -> dict[str, Met]:
        own = cases(runs, changes, (WHOLE,))
        found = runs.all("circles", own, f"{NAME}: A_1 {changes[0][1]:.3g} um")
        return {one.value.name: one for one in met_of(found, {}, True)}

    return identify(SCENE, CHANGES, NUMBERS, VALUES, levels, 1 if runs.quick else 8)


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


def judge(ceramic: Results, steel: Results, directive: bool, reasons: Mapping[str, Any]) -> list[Classed]:
    """Class the statements, seed by seed on medians over the speeds around each.

    Figures of statements with one margin get its range over the seeds.
    """
    own, twin = by_seed(ceramic.items()), by_seed(steel.items())
    by = [orderings(own[seed], twin.get(seed, {}), directive) for seed in own]
    found = []
    for k, one in enumerate(classed(by, reasons)):
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
        _unless(runs, "load", lambda: runs.few([case(rpm, (*found, *LOADED)) for rpm in SPEEDS])),
        _unless(runs, "steel twin", lambda: runs.around([case(WHOLE, found, STEEL)])),
    )
    met = met_of(all_.ceramic, all_.steel, directive)
    judged = judge(all_.ceramic, all_.steel, directive, REASONS)
    lines = slopes(met)
    contacts = _contacts(runs, found)
    by_contacts = met_of(contacts.ceramic, contacts.steel, True)
    others = [_unless(runs, "assumed numbers", lambda one=one: _step(found, one)) for one in ASSUMED]
    write_csv(NAME, all_, contacts, output)
    _compared_csv(met, by_contacts, output)
    if directive:
        draw_pictures(NAME, all_, output)
    one = next(iter(all_.ceramic))
    return page.template(NAME).format(
        title=TITLE, caution=page.caution(runs.radiation_model), radiation_model=runs.radiation_model,
        verdict=page.verdict_part(answer, met, lines, _UNKNOWN), values=page.values_part(met),
        off=_off(all_, others, met, by_contacts) if contacts.ceramic and directive else "",
        slope=page.slope_table(lines), identified=answer.words, timing=page.timing(one.settle, one.duration),
        counts=counts(judged), statements=page.statements_table(judged),
        angles=angles_sentence(all_.ceramic) if directive else NO_CIRCLE,
        sizes=sizes_sentence(VALUES, all_.ceramic) if directive else NO_CIRCLE,
        falls=falls_part(VALUES, all_.ceramic, contacts.ceramic),
        contacts=_contacts_part(met, by_contacts, judged, contacts) if contacts.ceramic else NOT_RUN,
        pull=PULL, load=_load_part(all_, directive) if all_.loaded else NOT_RUN,
        circles=PICTURE if directive else NO_CIRCLE, field=field_table(all_.ceramic, directive),
        parts=part_table(all_.ceramic),
    )  # fmt: skip


def _unless(runs: Runs, words: str, cases: Callable[[], list[Case]], model: str | None = None) -> Results:
    """Results of cases that quick runs leave out."""
    return {} if runs.quick else runs.all("circles", cases(), f"{NAME}: {words}", radiation_model=model)


def _contacts(runs: Runs, found: Changes) -> Variants:
    """Run the paper's own radiation model on the same motion: its channels need runs of their own."""

    def few(scene: str, speeds: Sequence[int]) -> list[Case]:
        return around([case(rpm, found, scene) for rpm in speeds], SEEDS, FEW_AROUND)

    return Variants(
        _unless(runs, CONTACTS, lambda: few(CERAMIC, SPEEDS), CONTACTS), {},
        _unless(runs, f"{CONTACTS}, steel twin", lambda: few(STEEL, (WHOLE,)), CONTACTS),
    )  # fmt: skip


def _step(found: Changes, other: Changes) -> list[Case]:
    """Return the cases with one assumed number at the two speeds between which the paper's levels step up."""
    own = [case(rpm, (*found, *other)) for rpm in (_STEP_RPM, WHOLE)]
    return around(own, FEW_SEEDS, AROUND[2:7:2])


def _named(met: Iterable[Met], name: str) -> Met:
    return next(one for one in met if one.value.name == name)


def _constant(by_contacts: Iterable[Met]) -> float:
    """Distance of `paper_contacts` from the fitted level (dB)."""
    return _named(by_contacts, NUMBERS[0].value).from_middle


def _off(all_: Variants, others: Sequence[Results], met: Sequence[Met], by_contacts: Sequence[Met]) -> str:
    """Say what was ruled out as a cause of the values that are farthest off."""

    def dv(result):
        return Circle(result).dv

    def mean(result):
        return Circle(result).mean

    def spot(result):
        return float(Circle(result).levels[ANGLES.index(270)])

    def quietest(result):
        return float(Circle(result).levels.min())

    own, wide = _named(met, "DV at r 210, l 50 mm"), _named(by_contacts, "DV at r 210, l 50 mm")
    late = _named(met, _OFF)
    runs, paper = each(all_.ceramic, spot, _STEP_RPM), late.value.paper
    mid, high = (_named(met, name).value.paper.middle for name in (_OFF, "18,000 r/min, mean of 24 points"))
    shifted = _named(by_contacts, _OFF).level - _constant(by_contacts)
    rows = each(all_.ceramic, dv, WHOLE)
    wider = [over(found, dv)[0] for found in others]
    here, *steps = (
        over(found, mean)[0] - over(found, mean, _STEP_RPM)[0] for found in (all_.ceramic, *others)
    )
    parts = {
        group: values.rms(one for one in met if one.value.role == CHECK and one.value.group == group)
        for group in ("measured", "falls", "circles")
    }
    points = (
        f"* **By kind:** measured levels are {parts['measured']:.1f} dB rms off, falls "
        f"{parts['falls']:.1f} dB, DV {parts['circles']:.1f} dB.",
        f"* **No cause of DV:** at r 210, l 50 mm it is {own.level:.1f} dB, in the paper "
        f"{own.value.paper.middle:.2f}. Ruled out: the draw and the exact speed (the largest of {len(rows)} "
        f"runs is {max(rows):.1f} dB), a radial load ({PULL}: {over(all_.loaded, dv)[0]:.1f} dB), the "
        f"radiation model (`{CONTACTS}`: {wide.level:.1f} dB), assumed numbers ({_ASSUMED}: "
        f"{page.spread(wider)} dB).",
        f"* **No cause of {_OFF}:** ours is {late.level:.1f} dB, in the paper {page.printed(paper)}. Ruled "
        f"out: the draw and the exact speed ({len(runs)} runs have {page.spread(runs)} dB), the place (the "
        f"quietest of 24 points in any run has {min(each(all_.ceramic, quietest, _STEP_RPM)):.1f} dB), a "
        f"radial load ({over(all_.loaded, spot, _STEP_RPM)[0]:.1f} dB), the radiation model (`{CONTACTS}`, "
        f"less its constant: {shifted:.1f} dB). The paper rises by {high - mid:.1f} dB from there to the "
        f"mean at 18,000 r/min, ours by {here:.1f} dB, and by {page.spread(steps)} dB with the same assumed "
        "numbers.",
    )
    return "".join(map(page.wrapped, points))


def _contacts_part(
    met: Sequence[Met], by_contacts: Sequence[Met], judged: Sequence[Classed], contacts: Variants
) -> str:
    """Compare the paper's own radiation model, value by value, slope and statements."""
    constant = _constant(by_contacts)
    rows = []
    for one in by_contacts:
        if one.value.quantity == "fall":
            continue  # in the table of falls
        less = _less(one, constant) if one.value.quantity == "leq" else one
        rows.append([
            one.value.name, page.printed(one.value.paper),
            *(f"{m.level:.1f} ({m.residual:+.1f})" for m in met if m.value == one.value),
            f"{one.level:.1f} ({one.residual:+.1f})", page.spread(one.by_seed), f"{less.residual:+.1f}",
        ])  # fmt: skip
    columns = ["value", "paper", "ours (residual)", f"{CONTACTS} (residual)", "seeds", "less the constant"]
    checked = [one for one in by_contacts if one.value.role == CHECK]
    shifted = [_less(one, constant) if one.value.quantity == "leq" else one for one in checked]
    own = [one for one in met if one.value.role == CHECK]
    (line,) = slopes(by_contacts)
    other = judge(contacts.ceramic, contacts.steel, True, REASONS)
    pairs = list(enumerate(zip(judged, other, strict=True), 1))
    more = [f"{n}" for n, (a, b) in pairs if b.kind == HOLDS != a.kind]
    fewer = [f"{n}" for n, (a, b) in pairs if a.kind == HOLDS != b.kind]
    held, theirs = (sum(one.kind == HOLDS for one in found) for found in (judged, other))
    nearer = min(values.rms(checked), values.rms(shifted)) < values.rms(own)
    return (
        f"The paper's own method is {'nearer to' if nearer else 'no nearer to'} its values than ours. "
        f"With the same A_1 it is {constant:+.1f} dB off the fitted level. Rms of the checked "
        f"values: {values.rms(checked):.1f} dB as it is, {values.rms(shifted):.1f} dB less this constant, "
        f"ours {values.rms(own):.1f} dB. Slope: {line.ours:.1f} dB per decade (seeds "
        f"{page.spread(line.by_seed)}), paper {line.paper:.1f}. {theirs} of {len(pairs)} statements hold "
        f"with it, {held} with ours; with it alone: {', '.join(more) or 'none'}; with ours alone: "
        f"{', '.join(fewer) or 'none'}.\n\n{markdown(columns, rows)}"
    )


def _less(one: Met, constant: float) -> Met:
    """Take a constant off our value."""
    return Met(one.value, {seed: tuple(x - constant for x in numbers) for seed, numbers in one.ours.items()})


def _load_part(all_: Variants, directive: bool) -> str:
    """Say what a radial load changes, against the same seeds and speeds without it.

    A load gives a direction, so no statement is chance by its inputs here.
    """
    own = {(one.rpm, one.seed, one.around) for one in all_.loaded}
    same = {one: found for one, found in all_.ceramic.items() if (one.rpm, one.seed, one.around) in own}
    pairs = list(zip(*(judge(found, {}, directive, {}) for found in (same, all_.loaded)), strict=True))
    seen = [(n, a, b) for n, (a, b) in enumerate(pairs, 1) if b.kind != UNSEEN]
    rows = [
        [f"{n}. {a.statement}", f"{a.kind}: {a.figures}", f"{b.kind}: {b.figures}"]
        for n, a, b in seen
        if (a.kind == HOLDS) != (b.kind == HOLDS)
    ]
    before, after = (
        sum(x.kind == HOLDS for x in found) for found in zip(*(x[1:] for x in seen), strict=True)
    )
    changed = sum(a.kind != b.kind for _, a, b in seen)
    words = (
        f"With it {after} of {len(seen)} statements hold, without it {before} with the same seeds and "
        f"speeds; {changed} change their class. A statement that the draw decides holds for two seeds one "
        "time in four.\n"
    )
    columns = ["hold with one of the two alone", "without load", "with load"]
    return words + (f"\n{markdown(columns, rows)}" if rows else "")


def _compared_csv(met: Sequence[Met], by_contacts: Sequence[Met], output: Output) -> None:
    """Write the values of both radiation models."""
    rows = [
        [one.value.name, *(f"{x:.2f}" for x in (one.value.paper.low, one.value.paper.high, one.level)),
         *(f"{other.level:.2f}" for other in by_contacts if other.value == one.value)]
        for one in met
    ]  # fmt: skip
    columns = ["value", "paper_low", "paper_high", "ours", CONTACTS]
    output.csv(f"{NAME}-values", columns[: len(rows[0])], rows)
