"""Variables of accelerometers."""

from fmu_bearing.engine.layout import Z
from fmu_bearing.interface.variable import Variable, read
from fmu_bearing.scene import Scene

_WORDS = (
    "Acceleration that accelerometer {} reads",
    "Root mean square of the acceleration since metering began at accelerometer {}",
    "Largest amount of the acceleration since metering began at accelerometer {}",
    "Kurtosis of the acceleration since metering began at accelerometer {}; 3: normally distributed",
)


def accelerometers(scene: Scene, first: int) -> list[Variable]:
    """Return the variables of each accelerometer, from the place ``first`` in ``z`` on."""
    return [
        read(
            f"accelerometer[{k + 1}].{label}", "output", words.format(sensor.name),
            "" if label == "kurtosis" else "m/s2", first + Z.PER_ACCELEROMETER * k + i,
            **({"min": 0.0} if label != "acceleration" else {}),
        )
        for k, sensor in enumerate(scene.accelerometers)
        for i, (label, words) in enumerate(zip(Z.ACCELEROMETER_OUTPUTS, _WORDS, strict=True))
    ]  # fmt: skip
