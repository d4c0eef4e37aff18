"""Verdict on the seals of a bearing."""

from collections.abc import Iterator

from fmu_bearing.design.operating_point import BearingPoint
from fmu_bearing.design.verdict import Judgement, Verdict
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas import seals


def seal_verdicts(point: BearingPoint) -> Iterator[Verdict]:
    """Yield the verdict on the speed of lips that rub; none where nothing says on which diameter they do."""
    bearing, rpm = point.scene.bearing, abs(point.scene.operation.speed_rpm)
    lip, limit = bearing.lip_diameter, seals.LIP_SPEED
    if bearing.seal is None or bearing.seal.kind not in seals.RUBBING or lip is None:
        return
    speed = rpm * RPM * 0.5e-3 * lip
    text, source = f"{speed:.1f}", f"SKF: {limit:g}, prints up to {seals.MOST_LIP_SPEED:g}"
    judgement: Judgement = "good"
    if speed > limit:
        judgement = "watch" if speed <= seals.MOST_LIP_SPEED else "change"
    advice = ""
    if judgement != "good":
        advice = (
            f"lips of the {bearing.seal.kind} seals {text} m/s: above {limit:g} ({source}) their rubber "
            f"wears and hardens: {limit / speed * rpm:.0f} r/min or less, or seals that hardly touch"
        )
    yield Verdict("lip_speed", "lips of the seals, m/s", speed, text, f"{limit:g}", source, judgement, advice)
