"""The verdicts on the first screen: the overall one, and the table of all."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fmu_bearing.design.operating_point import RINGS, OperatingPoint
from fmu_bearing.design.verdict import Verdict, overall
from fmu_bearing.design.verdicts import cautions, shared_label, shared_limit, side_by_side, verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Absent, Overall, Table
from fmu_bearing.results.base import table
from fmu_bearing.scene import Scene

#: What the run itself is judged by, where it was kept: its extremes, as the figures above the table.
_EXTREMES = {"pressure_max": np.max, "shoulder_margin": np.min}


@dataclass(frozen=True)
class Judged:
    """All verdicts on a run, and their table."""

    found: tuple[Verdict, ...]
    table: Table


def overall_of(every: Iterable[Verdict], several: bool = False) -> Overall:
    """Return the overall verdict; ``several``: figures of several bearings are named by bearing."""
    verdicts_ = list(every)
    judged = [verdict for verdict in verdicts_ if verdict.judgement != "not judged"]
    beyond = {
        which: [one for one in judged if one.judgement == which] for which in ("change", "watch")
    }  # fmt: skip
    count = ", ".join(f"{len(those)} to {which}" for which, those in beyond.items() if those)
    words = f"of {len(judged)} figures with a limit {count or 'all are within it'}"
    lines = [
        f"{f'bearing {one.bearing}: ' if several and one.bearing is not None else ''}{one.label} {one.text}, "
        f"limit {one.limit} ({which})"
        for which, those in beyond.items()
        for one in those
    ]
    return Overall(overall(verdicts_), words, lines)


def judged(subject: Subject) -> Judged | None:
    """Return the verdicts on the run; None without scene or equilibrium.

    Pressure, with the static safety by ball loads, film and shoulder are judged by the run's extremes, all
    else at the scene's loads and the mean speed.
    """
    try:
        point, ran = _of_run(subject.point, subject)
    except Absent:
        return None
    judgements, several = verdicts(point), subject.several
    state = "perfect bearings in their steady state" if several else "perfect bearing in its steady state"
    caption = f"Verdicts at {subject.speed / RPM:,.0f} r/min: {ran}{state}"
    names = list(subject.prefixes)
    shown = _side_by_side(judgements, names, point.scene) if several else table(Verdict, judgements)
    return Judged(judgements, Table(caption, *shown, note=_note(point, judgements)))


def _side_by_side(
    judgements: Sequence[Verdict], bearings: list[str], scene: Scene
) -> tuple[list[str], list[list[str]]]:
    """Return columns and a row per figure, with its verdict on each bearing, or on all together."""
    whole: list[list[Verdict | None]] = [
        [*(None for _ in bearings), one] for one in judgements if one.bearing is None
    ]
    rows = []
    for same in [*([*each, None] for each in side_by_side(judgements)), *whole]:
        first = next(one for one in same if one is not None)
        cells = ["" if one is None else f"{one.text} ({one.judgement})" for one in same]
        rows.append([shared_label(first), *cells, shared_limit(same, scene), first.source])
    return ["", *bearings, "all together", "limit", "source of the limit"], rows


def _of_run(point: OperatingPoint, subject: Subject) -> tuple[OperatingPoint, str]:
    """Return the point with what the run reached, and words that say so; empty: the run kept none of it."""
    bearings, kept = [], False
    for bearing, prefix in zip(point.bearings, subject.prefixes.values(), strict=True):
        contacts, film = {ring: dict(bearing.contacts[ring]) for ring in RINGS}, bearing.film
        for ring in RINGS:
            for key, extreme in _EXTREMES.items():
                name = f"{prefix}contact.{ring}.{key}"
                if subject.has(name):
                    contacts[ring][key] = float(extreme(subject.output(name)))
                    kept = True
        if subject.has(f"{prefix}film.lambda_min"):
            film, kept = float(subject.output(f"{prefix}film.lambda_min").min()), True
        bearings.append(replace(bearing, contacts=contacts, film=film))
    words = "pressure, static safety by ball loads, film and shoulder at the run's extremes; all else of the "
    return replace(point, bearings=tuple(bearings)), words if kept else ""


def _note(point: OperatingPoint, judgements: tuple[Verdict, ...]) -> str:
    """Say what to do: about the state itself, then about what is judged, the gravest first."""
    advice = cautions(point, sorted(judgements, key=lambda one: one.judgement != "change"))
    words = " ".join(f"{line[0].upper()}{line[1:]}." for line in advice)
    return words or "None of these limits is exceeded."
