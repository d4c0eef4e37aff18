"""Accelerometers: what they are on, where, which way they look, and what the signal passes."""

from collections.abc import Iterator, Sequence
from typing import Any, Literal

from pydantic import Field, field_validator
from pydantic_core import PydanticCustomError

from fmu_bearing.scene.base import Conflict, Label, Part
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.housing import SKIN
from fmu_bearing.scene.mounting import Mounting
from fmu_bearing.scene.spindle import Spindle

_FAR = 5e3  # mm
_TURNS = "turns with the shaft, and a sensor there would need a telemetry that no scene has"


class StructureMode(Part):
    """A mode of the structure under the sensor, which the force of the seat drives; see the page of sound."""

    frequency_Hz: float = Field(ge=20, le=2e4, examples=[3100.0], description="Natural frequency, Hz.")
    damping_ratio: float = Field(
        ge=1e-4, le=0.5, examples=[0.02], description="Damping over the critical one of the mode."
    )
    mass_kg: float = Field(
        ge=1e-3, le=1e6, examples=[4.0],
        description="Modal mass, for a shape that is 1 at the sensor and 1 at the seat, kg.",
    )  # fmt: skip


class Accelerometer(Part):
    """A named sensor on a body that does not turn."""

    name: Label = Field(examples=["DE"], description="Name of the accelerometer.")
    on: Literal["outer ring", "housing"] = Field(
        default="outer ring", examples=["outer ring"],
        description="Body that carries it: an outer ring, or the housing, which moves as a rigid body.",
    )  # fmt: skip
    bearing: int | None = Field(
        default=None, ge=1, le=64, examples=[1],
        description="Number of the bearing whose outer ring carries it, of a set alone, from the nose on.",
    )  # fmt: skip
    x_mm: float | None = Field(
        default=None, ge=-_FAR, le=_FAR, examples=[0.0],
        description="Place along the axis from the bearing's centre, of a set from the shaft's nose (absent: "
        "the bearing's plane, of a set's housing its middle), mm.",
    )  # fmt: skip
    angle_deg: float = Field(
        default=0.0, ge=-720, le=720, examples=[0.0], description="Angle from 12 o'clock about +X, deg."
    )
    radius_mm: float | None = Field(
        default=None, ge=0, le=_FAR, examples=[26.0],
        description="Distance from the bearing axis (absent: the body's outside), mm.",
    )  # fmt: skip
    direction: Literal["radial", "axial", "tangential"] = Field(
        default="radial", examples=["radial"],
        description="Sensitive axis: away from the axis, along +X, or towards growing angles.",
    )  # fmt: skip
    resonance_kHz: float | None = Field(
        default=None, ge=1, le=1000, examples=[28.0],
        description="Resonance of the mounted sensor (absent: none), kHz.",
    )  # fmt: skip
    damping_ratio: float = Field(
        default=0.03, ge=1e-3, le=1, examples=[0.03],
        description="Damping over the critical one of that resonance (default assumed).",
    )  # fmt: skip
    noise_m_s2: float = Field(
        default=0.0, ge=0, le=1e4, examples=[0.05],
        description="White noise of sensor and amplifier up to 25.6 kHz, in recordings alone, rms, m/s2.",
    )  # fmt: skip
    # A file's array arrives as a list: the one conversion that strictness may let pass.
    mode: tuple[StructureMode, ...] = Field(
        default=(), max_length=16, strict=False,
        description="Modes of the structure that it sits on; none: rigid.",
    )  # fmt: skip

    @field_validator("on", mode="before")
    @classmethod
    def _stands_still(cls, value: Any) -> Any:
        if value in ("inner ring", "shaft", "rotor", "cage"):
            found = (Conflict("", f'{_TURNS}: give "outer ring" or "housing"'),)
            raise PydanticCustomError("conflict", "{text}", {"conflicts": found, "text": found[0].reason})
        return value


def conflicts(
    sensors: Sequence[Accelerometer], bearings: Sequence[Bearing], mounting: Mounting | None,
    spindle: Spindle | None,
) -> Iterator[Conflict]:  # fmt: skip
    """Yield repeated names, bodies that are not there or stay at rest, and places beside the body."""
    names = [sensor.name for sensor in sensors]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield Conflict("accelerometer", f"names must differ: {name} is given more than once")
    for number, sensor in enumerate(sensors, start=1):
        key = f"accelerometer[{number}]"
        if spindle is None:
            yield from _alone(key, sensor, mounting)
        else:
            yield from _in_set(key, sensor, spindle)
        if sensor.on != "outer ring" or (sensor.bearing or 1) > len(bearings):
            continue
        place = (sensor.bearing or 1) - 1
        middle = 0.0 if spindle is None else spindle.bearing[place].position_mm
        yield from _beside(key, sensor, bearings[place], middle)


def _alone(key: str, sensor: Accelerometer, mounting: Mounting | None) -> Iterator[Conflict]:
    if sensor.bearing is not None:
        yield Conflict(f"{key}.bearing", "is of a set of bearings ([spindle]) alone: leave it out")
    if sensor.on == "housing" and mounting is not None and mounting.housing is None:
        yield Conflict(f"{key}.on", 'needs a table [mounting.housing]: add it, or give on = "outer ring"')


def _in_set(key: str, sensor: Accelerometer, spindle: Spindle) -> Iterator[Conflict]:
    count = len(spindle.bearing)
    moves = spindle.housing.moves
    rests = "is refused: that housing does not move, so there is nothing to read; give "
    way = "spindle.housing.mass_kg and pedestal_stiffness_N_m"
    if sensor.on == "housing":
        if sensor.bearing is not None:
            yield Conflict(f"{key}.bearing", 'is read with on = "outer ring" alone: leave it out')
        if not moves:
            yield Conflict(f"{key}.on", rests + way)
        elif all(one.seat == "sliding" for one in spindle.bearing):
            yield Conflict(f"{key}.on", 'needs a bearing with seat = "fixed", whose ring shows how it moves')
        return
    if sensor.bearing is None:
        yield Conflict(f"{key}.bearing", f"is missing: 1 to {count}, from the nose on")
    elif sensor.bearing > count:
        yield Conflict(f"{key}.bearing", f"= {sensor.bearing}: the set has bearings 1 to {count}")
    elif not moves and spindle.bearing[sensor.bearing - 1].seat != "pedestal":
        yield Conflict(f"{key}.bearing", f'{rests}{way}, or that bearing seat = "pedestal"')


def _beside(key: str, sensor: Accelerometer, bearing: Bearing, middle: float) -> Iterator[Conflict]:
    """Yield a place that is not on the outer ring; ``middle``: of its bearing along the axis (mm)."""
    low, high = bearing.outer_ring_inner_diameter_mm / 2.0, bearing.outside_diameter_mm / 2.0
    if sensor.radius_mm is not None and not low - SKIN <= sensor.radius_mm <= high + SKIN:
        yield Conflict(
            f"{key}.radius_mm",
            f"= {sensor.radius_mm:g} is not on the outer ring, which is from {low:g} to {high:g} mm",
        )
    half = bearing.width_mm / 2.0
    if sensor.x_mm is not None and abs(sensor.x_mm - middle) > half + SKIN:
        yield Conflict(
            f"{key}.x_mm",
            f"= {sensor.x_mm:g} is not on the outer ring, which is from {middle - half:g} to "
            f"{middle + half:g} mm",
        )
