"""The verdicts on the first screen: the overall one, and the table of all."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from fmu_bearing.design.operating_point import RINGS, OperatingPoint, operating_point
from fmu_bearing.design.verdict import Verdict, overall
from fmu_bearing.design.verdicts import verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import EngineError
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Overall, Table

_COLUMNS = ("", "value", "verdict", "limit", "source of the limit")


#: What the run itself is judged by, where it was kept: its extremes, as the figures above the table.
_EXTREMES = {"pressure_max": np.max, "shoulder_margin": np.min}


@dataclass(frozen=True)
class Judged:
    """All verdicts on a run, and their table."""

    found: tuple[Verdict, ...]
    table: Table


def overall_of(found: Iterable[Verdict], several: bool = False) -> Overall:
    """Return the overall verdict; ``several``: figures of several bearings are named by bearing."""
    verdicts_ = list(found)
    judged = [one for one in verdicts_ if one.judgement != "not judged"]
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

    Pressure, film and shoulder are judged by the run's extremes, all else at the scene's loads and the mean
    speed.
    """
    scene = subject.recording.scene
    if scene is None:
        return None
    rpm = subject.speed / RPM
    try:
        point = operating_point(scene.replace({"operation.speed_rpm": rpm}))
    except EngineError:
        return None
    point, ran = _of_run(point, subject)
    found = verdicts(point)
    rows = [[one.label, one.text, one.judgement, one.limit, one.source] for one in found]
    caption = f"Verdicts at {rpm:,.0f} r/min: {ran}perfect bearing in its steady state"
    return Judged(found, Table(caption, _COLUMNS, rows, note=_note(point, found), stacked=True))


def _of_run(point: OperatingPoint, subject: Subject) -> tuple[OperatingPoint, str]:
    """Return the point with what the run reached, and words that say so; empty: the run kept none of it."""
    (bearing,) = point.bearings
    contacts = {ring: dict(bearing.contacts[ring]) for ring in RINGS}
    film, kept = bearing.film, False
    for ring in RINGS:
        for key, extreme in _EXTREMES.items():
            name = f"contact.{ring}.{key}"
            if subject.has(name):
                contacts[ring][key] = float(extreme(subject.output(name)))
                kept = True
    if subject.has("film.lambda_min"):
        film, kept = float(subject.output("film.lambda_min").min()), True
    words = "pressure, film and shoulder at the run's extremes; all else of the " if kept else ""
    return replace(point, bearings=(replace(bearing, contacts=contacts, film=film),)), words


def _note(point: OperatingPoint, found: tuple[Verdict, ...]) -> str:
    """Say what to do: about the state itself, then about what is judged, the gravest first."""
    advice = list(point.remarks)
    advice += [one.advice for judgement in ("change", "watch") for one in found if one.judgement == judgement]
    words = " ".join(f"{line[0].upper()}{line[1:]}." for line in advice if line)
    return words or "None of these limits is exceeded."
