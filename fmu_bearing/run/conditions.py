"""Speeds at which candidates of fidelity ``auto`` are compared: a scene's own, a second one, a rise."""

import math
from dataclasses import dataclass

from fmu_bearing.engine.constants import RPM
from fmu_bearing.scene import Scene

WINDOW = 0.06  # s: twenty turns at 20,000 r/min
#: 1/s: by this share of its own the speed rises in a second. A motor spindle takes longer to full speed, and
#: a drive that does it in a tenth accelerates the balls by friction, 10 % of the torque of the 7003C.
RATE = 1.0


@dataclass(frozen=True)
class Condition:
    """What candidates are compared under: speed (rad/s) at the beginning and at the end of a window (s)."""

    first: float
    last: float
    window: float

    @property
    def name(self) -> str:
        """Speed, or speeds and the time between them."""
        last = f"{self.last / RPM:,.0f} r/min"
        if self.first == self.last:
            return last
        return f"{self.first / RPM:,.0f} to {last} in {1e3 * self.window:g} ms"


def conditions(scene: Scene, window: float = WINDOW) -> tuple[Condition, ...]:
    """Return the scene's own speed, a second one, and a rise to the first.

    At standstill, and where ``operation.lowest_speed_rpm`` is the scene's speed, which is held then, the
    first alone.
    """
    own = scene.operation.speed_rpm * RPM
    if without_others(scene):
        return (Condition(own, own, window),)
    lowest = scene.operation.lowest_speed_rpm
    second = 0.5 * own if lowest is None else math.copysign(lowest * RPM, own)
    pairs = (own, own), (second, second), ((1.0 - RATE * window) * own, own)
    return tuple(Condition(first, last, window) for first, last in pairs)


def without_others(scene: Scene) -> str:
    """Return why a scene has one condition alone, and which others it lacks; empty: it has all."""
    own, lowest = abs(scene.operation.speed_rpm), scene.operation.lowest_speed_rpm
    if own == 0.0:
        return "another speed and a rise of speed, as the shaft does not turn"
    if lowest == own:
        return f"another speed and a rise of speed, as {own:,g} r/min are held (operation.lowest_speed_rpm)"
    return ""
