"""The unit of vibration testers beside um/s, the Anderon.

It is the rms displacement per angle, in microinches per radian of the inner ring, over the root of the number
of octaves of the band (Sugawara Laboratories, "About units of measurement", who make such testers: 7.698 um/s
at 1800 r/min in a third of 50 Hz to 10.8 kHz). By this definition the high band to 10 kHz has 7.53 um/s.
"""

import math
from typing import Literal

from fmu_bearing.engine.constants import RPM
from fmu_bearing.scene import Scene
from fmu_bearing.vibration_test.rig import bands

Unit = Literal["um/s", "anderon"]
UNITS: tuple[Unit, ...] = ("um/s", "anderon")
_MICROINCH = 0.0254  # um


def micrometres(scene: Scene, unit: Unit = "anderon") -> dict[str, float]:
    """Return um/s per unit in the bands L, M, H of the vibration test of a scene.

    Raises
    ------
    ValueError
        For a unit that is not known.
    """
    if unit not in UNITS:
        raise ValueError(f"unit = {unit}: choose from {', '.join(UNITS)}")
    turning = abs(scene.operation.speed_rpm) * RPM
    return {
        name: 1.0 if unit == "um/s" else _MICROINCH * turning * math.sqrt(math.log2(high / low))
        for name, (low, high) in bands(scene).items()
    }
