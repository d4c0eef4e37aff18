"""Radiator, radiation model, metering and microphones."""

import math
from collections.abc import Iterator
from typing import Literal, NamedTuple

from pydantic import Field

from fmu_bearing.engine.choices import RadiationModel
from fmu_bearing.scene.base import Conflict, Label, Part

Point = tuple[float, float, float]
#: The radiating body: the bare bearing, the housing, or the bearing's face in a rigid plane.
Radiator = Literal["bare", "housing", "baffle"]

_CARTESIAN = ("x_mm", "y_mm", "z_mm")
_CYLINDRICAL = ("theta_deg", "r_mm", "l_mm")
_FAR = 1e5  # mm


class Place(NamedTuple):
    """Name of a microphone, and its place (x, y, z) in m."""

    name: str
    position_m: Point


def cylindrical(theta_deg: float, r_mm: float, l_mm: float) -> Point:
    """Cartesian point (m) of an angle from 12 o'clock, a distance from the axis and an axial place.

    Sine and cosine are rounded at 15 decimals: a point at 3 o'clock then has z = 0, not 1e-17.
    """
    theta = math.radians(theta_deg)
    sine, cosine = round(math.sin(theta), 15), round(math.cos(theta), 15)
    return (l_mm / 1e3, 0.0 - r_mm * sine / 1e3, 0.0 + r_mm * cosine / 1e3)


class Microphone(Part):
    """A named point: either ``x_mm``, ``y_mm``, ``z_mm`` or ``theta_deg``, ``r_mm``, ``l_mm``."""

    name: Label = Field(examples=["P1"], description="Name of the microphone.")
    x_mm: float | None = Field(
        default=None, ge=-_FAR, le=_FAR, examples=[0.0],
        description="Place along the bearing axis from the bearing's centre, of a set from the shaft's nose "
        "(+X to the rear), mm.",
    )  # fmt: skip
    y_mm: float | None = Field(
        default=None, ge=-_FAR, le=_FAR, examples=[105.0], description="Horizontal place, mm."
    )
    z_mm: float | None = Field(
        default=None, ge=-_FAR, le=_FAR, examples=[0.0], description="Place upwards, mm."
    )
    theta_deg: float | None = Field(
        default=None, ge=-720, le=720, examples=[90.0], description="Angle from 12 o'clock about +X, deg."
    )
    r_mm: float | None = Field(
        default=None, ge=0, le=_FAR, examples=[210.0], description="Distance from the bearing axis, mm."
    )
    l_mm: float | None = Field(
        default=None, ge=-_FAR, le=_FAR, examples=[50.0], description="As x_mm: place along the axis, mm."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield a place that is incomplete or given twice."""
        given = tuple(key for key in _CARTESIAN + _CYLINDRICAL if getattr(self, key) is not None)
        if given not in (_CARTESIAN, _CYLINDRICAL):
            yield Conflict(
                "",
                f"microphone '{self.name}' has {', '.join(given) or 'no place'}: give x_mm, y_mm, z_mm or "
                "theta_deg, r_mm, l_mm",
            )

    @property
    def position_m(self) -> Point:
        """Cartesian place in m."""
        if self.x_mm is not None and self.y_mm is not None and self.z_mm is not None:
            return (self.x_mm / 1e3, self.y_mm / 1e3, self.z_mm / 1e3)
        assert self.theta_deg is not None and self.r_mm is not None and self.l_mm is not None
        return cylindrical(self.theta_deg, self.r_mm, self.l_mm)


class Circle(Part):
    """Microphones evenly spaced on a circle about the axis, the first at 12 o'clock."""

    radius_mm: float = Field(ge=1, le=_FAR, examples=[210.0], description="Radius of the circle, mm.")
    axial_mm: float = Field(
        ge=-_FAR, le=_FAR, examples=[50.0],
        description="Place of the circle along the axis, as x_mm of a microphone, mm.",
    )  # fmt: skip
    count: int = Field(ge=1, le=360, examples=[24], description="Number of microphones on the circle.")

    def points(self) -> list[Place]:
        """Names, by angle, and places (m)."""
        angles = [360.0 * k / self.count for k in range(self.count)]
        return [Place(f"{a:g} deg", cylindrical(a, self.radius_mm, self.axial_mm)) for a in angles]


class Sound(Part):
    """Radiation and metering."""

    radiation_model: RadiationModel = Field(
        default="bem", examples=["bem"],
        description="How radiation is computed: by the papers' methods, compact bodies, boundary elements "
        "or the user's table.",
    )  # fmt: skip
    radiator: Radiator = Field(
        default="bare",
        description="What radiates: the bare bearing, its face flush in a rigid plane, or the housing.",
        examples=["bare"],
    )
    reflecting_plane_mm: float | None = Field(
        default=None, ge=-_FAR, le=_FAR, examples=[-100.0],
        description="Place of a rigid plane across the bearing axis, as x_mm of a microphone (absent: free "
        "field), mm.",
    )  # fmt: skip
    table_file: str | None = Field(
        default=None, min_length=1, max_length=1000, examples=["housing.npz"],
        description="File that radiation model table reads, relative to the scene file.",
    )  # fmt: skip
    third_octaves: bool = Field(
        default=False, description="Third-octave levels of every microphone.", examples=[True]
    )
    details: bool = Field(
        default=True,
        description="Fast and Slow levels side by side, energy sums and levels per source type.",
        examples=[False],
    )
    air_density_kg_m3: float = Field(
        default=1.204, ge=0.1, le=10, examples=[1.225],
        description="Density of the air (default: at 20 degC), kg/m3.",
    )  # fmt: skip
    sound_speed_m_s: float = Field(
        default=343.2, ge=100, le=2000, examples=[340.0],
        description="Speed of sound in the air (default: at 20 degC), m/s.",
    )  # fmt: skip
    time_weighting: Literal["fast", "slow"] = Field(
        default="fast",
        description="Exponential averaging of the levels: 0.125 s or 1 s (IEC 61672-1).",
        examples=["fast"],
    )
    metering_start_s: float = Field(
        default=0.02, ge=0, le=1000, examples=[0.02],
        description="Time after initialisation at which metering begins, s.",
    )  # fmt: skip
    # A file's array arrives as a list: the one conversion that strictness may let pass.
    microphone: tuple[Microphone, ...] = Field(
        default=(), max_length=360, strict=False, description="Single microphones."
    )
    circle: Circle | None = Field(default=None, description="Microphones on a circle about the axis.")

    def conflicts(self) -> Iterator[Conflict]:
        """Yield missing microphones, repeated names, and a table that is missing or not read."""
        names = [place.name for place in self.points()]
        if not names:
            yield Conflict(
                "", "no microphone is given: add [[sound.microphone]] or [sound.circle], or leave out [sound]"
            )
        for name in sorted({name for name in names if names.count(name) > 1}):
            yield Conflict("", f"microphone names must differ: {name} is given more than once")
        if "\0" in (self.table_file or ""):
            yield Conflict("table_file", "is refused: a file's name holds no NUL")
        if self.radiation_model == "table" and self.table_file is None:
            yield Conflict(
                "table_file",
                'is missing, for example table_file = "housing.npz"; radiation_model = "table" reads it',
            )
        if self.radiation_model != "table" and self.table_file is not None:
            yield Conflict(
                "table_file", f'is read with radiation_model = "table" only, not "{self.radiation_model}"'
            )

    def points(self) -> list[Place]:
        """Names and places (m) of all microphones: the single ones first, then the circle."""
        single = [Place(microphone.name, microphone.position_m) for microphone in self.microphone]
        return single + (self.circle.points() if self.circle is not None else [])
