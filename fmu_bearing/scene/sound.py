"""What radiates, how it is computed, where the microphones stand."""

import math
from typing import Literal

from pydantic import Field, model_validator

from fmu_bearing.scene.base import Part

Point = tuple[float, float, float]


def cylindrical(theta: float, r: float, x: float) -> Point:
    """Cartesian point (m) of an angle from 12 o'clock (rad), distance from the axis, axial place (m)."""
    return (x, -r * math.sin(theta), r * math.cos(theta))


class Microphone(Part):
    """A named point: either ``x_mm``, ``y_mm``, ``z_mm`` or ``theta_deg``, ``r_mm``, ``l_mm``."""

    name: str = Field(min_length=1, max_length=40, examples=["P1"])
    x_mm: float | None = Field(default=None, ge=-1e5, le=1e5)
    y_mm: float | None = Field(default=None, ge=-1e5, le=1e5)
    z_mm: float | None = Field(default=None, ge=-1e5, le=1e5)
    theta_deg: float | None = Field(default=None, ge=-720, le=720)
    r_mm: float | None = Field(default=None, ge=0, le=1e5)
    l_mm: float | None = Field(default=None, ge=-1e5, le=1e5)

    @model_validator(mode="after")
    def _one_way(self) -> "Microphone":
        given = [
            name
            for name in ("x_mm", "y_mm", "z_mm", "theta_deg", "r_mm", "l_mm")
            if getattr(self, name) is not None
        ]
        if given not in (["x_mm", "y_mm", "z_mm"], ["theta_deg", "r_mm", "l_mm"]):
            raise ValueError(
                f"microphone '{self.name}' has {', '.join(given) or 'no place'}: give x_mm, y_mm, z_mm or "
                "theta_deg, r_mm, l_mm"
            )
        return self

    @property
    def position_m(self) -> Point:
        """Cartesian place in m."""
        if self.x_mm is not None:
            return (1e-3 * self.x_mm, 1e-3 * (self.y_mm or 0.0), 1e-3 * (self.z_mm or 0.0))
        return cylindrical(
            math.radians(self.theta_deg or 0.0), 1e-3 * (self.r_mm or 0.0), 1e-3 * (self.l_mm or 0.0)
        )


class Circle(Part):
    """Microphones evenly spaced on a circle about the axis, the first at 12 o'clock."""

    radius_mm: float = Field(gt=0, le=1e5, examples=[210.0], description="radius")
    axial_mm: float = Field(ge=-1e5, le=1e5, examples=[50.0], description="axial place")
    count: int = Field(ge=1, le=360, examples=[24], description="number of microphones")

    def points(self) -> list[tuple[str, Point]]:
        """Names and places (m)."""
        step = 360.0 / self.count
        return [
            (
                f"{k * step:g} deg",
                cylindrical(math.radians(k * step), 1e-3 * self.radius_mm, 1e-3 * self.axial_mm),
            )
            for k in range(self.count)
        ]


class Sound(Part):
    """Radiation and metering."""

    rung: Literal["paper", "compact"] = Field(description="how radiation is computed", examples=["compact"])
    radiator: Literal["bare", "housing"] = Field(description="what radiates", examples=["bare"])
    air_density_kg_m3: float = Field(ge=0.1, le=10, examples=[1.225], description="density of the air")
    sound_speed_m_s: float = Field(ge=100, le=2000, examples=[340.0], description="speed of sound")
    time_weighting: Literal["fast", "slow"] = Field(description="exponential averaging", examples=["fast"])
    metering_start_s: float = Field(ge=0, le=1000, examples=[0.02], description="time after initialisation")
    microphone: tuple[Microphone, ...] = Field(default=(), max_length=360)
    circle: Circle | None = None

    @model_validator(mode="after")
    def _somewhere(self) -> "Sound":
        names = [name for name, _ in self.points()]
        if not names:
            raise ValueError(
                "no microphone is given: add [[sound.microphone]] or [sound.circle], or leave out [sound]"
            )
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"microphone names must differ: {', '.join(twice)} stands more than once")
        return self

    def points(self) -> list[tuple[str, Point]]:
        """Names and places (m) of all microphones."""
        single = [(microphone.name, microphone.position_m) for microphone in self.microphone]
        return single + (self.circle.points() if self.circle is not None else [])
