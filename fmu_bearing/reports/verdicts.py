"""The table of verdicts on the first screen."""

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.verdicts import Verdict, verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import EngineError
from fmu_bearing.reports.blocks import Table
from fmu_bearing.reports.subject import Subject

_COLUMNS = ("", "value", "verdict", "limit", "source of the limit")


def verdict_table(subject: Subject) -> Table | None:
    """Return the verdicts at the scene's loads and the mean speed; None without scene or equilibrium."""
    scene = subject.recording.scene
    if scene is None:
        return None
    rpm = subject.speed / RPM
    try:
        point = operating_point(scene.replace({"operation.speed_rpm": rpm}))
    except EngineError:
        return None
    found = verdicts(point)
    rows = [[one.label, one.text, one.judgement, one.limit, one.source] for one in found]
    caption = f"Verdicts at {rpm:,.0f} r/min: perfect bearing in its quasi-static state"
    return Table(caption, _COLUMNS, rows, note=_note(found))


def _note(found: list[Verdict]) -> str:
    """Say what to do, the gravest first."""
    advice = [one.advice for judgement in ("change", "watch") for one in found if one.judgement == judgement]
    words = " ".join(f"{line[0].upper()}{line[1:]}." for line in advice if line)
    return words or "Nothing that these limits would forbid."
