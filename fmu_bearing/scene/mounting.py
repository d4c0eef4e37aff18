"""How the bearing is mounted and loaded."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part
from fmu_bearing.scene.seats import Fit


class Rotor(Part):
    """A solid cylinder fixed to the inner ring, centred in the bearing."""

    mass_kg: float = Field(ge=0, le=1000, examples=[0.25], description="Mass of the rotor, kg.")
    length_mm: float = Field(ge=1, le=5000, examples=[180.0], description="Length of the rotor, mm.")
    diameter_mm: float = Field(ge=1, le=1000, examples=[15.0], description="Diameter of the rotor, mm.")


class TiltSupport(Part):
    """Support of the rotor against tilting: the far bearing of the spindle."""

    stiffness_N_m_rad: float = Field(
        ge=0, le=1e9, examples=[1e5], description="Stiffness against tilting, N m/rad."
    )
    damping_ratio: float = Field(
        ge=0, le=1, examples=[0.05], description="Damping over the critical one of the tilting rotor."
    )


#: Tables of springs with dampers between what turns and ground, in `[mounting]` and `[spindle]`, by their
#: keys: what each holds. They have ``stiffness_...`` and ``damping_ratio``.
SUPPORTS: dict[str, Literal["axial", "radial", "tilt"]] = {
    "tilt_support": "tilt",
}


class Housing(Part):
    """A cylinder that moves with the outer ring."""

    mass_kg: float = Field(ge=0, le=1e4, examples=[2.0], description="Mass moving with the outer ring, kg.")
    diameter_mm: float = Field(
        ge=5, le=3000, examples=[100.0], description="Outside diameter of the housing, mm."
    )
    length_mm: float = Field(ge=1, le=5000, examples=[160.0], description="Length of the housing, mm.")
    front_face_mm: float = Field(
        ge=-500, le=500, examples=[15.5],
        description="Distance of its front face ahead (-X) of the bearing's end face, mm.",
    )  # fmt: skip


#: Lowest and highest circumferential order of a flexural mode; 0 and 1 are no bending of a free ring.
_LOWEST, _HIGHEST = 2, 8
Order = Annotated[int, Field(ge=_LOWEST, le=_HIGHEST)]
_MOST = _HIGHEST - _LOWEST + 1


class Flexure(Part):
    """Bending of the rings in their plane: which orders move, how they are damped, how seats hold them.

    On a tight seat or a solid shaft the bending is inaudible; leave this table out then.
    """

    # A file's array arrives as a list: the one conversion that strictness may let pass.
    outer_ring: tuple[Order, ...] = Field(
        default=(), max_length=_MOST, strict=False, examples=[[2, 3, 4]],
        description="Circumferential orders of the outer ring that move.",
    )  # fmt: skip
    inner_ring: tuple[Order, ...] = Field(
        default=(), max_length=_MOST, strict=False, examples=[[2, 3]],
        description="Circumferential orders of the inner ring that move.",
    )  # fmt: skip
    damping_ratio: float = Field(
        default=0.005, ge=0, le=0.5, examples=[0.005],
        description="Damping over the critical one of every mode.",
    )  # fmt: skip
    outer_seat_stiffness_N_m: float = Field(
        default=0.0, ge=0, le=1e12, examples=[0.0],
        description="Radial stiffness of the outer ring's seat against bending; 0: loose, N/m.",
    )  # fmt: skip
    inner_seat_stiffness_N_m: float = Field(
        default=0.0, ge=0, le=1e12, examples=[0.0],
        description="Radial stiffness of the inner ring's seat against bending; 0: loose, N/m.",
    )  # fmt: skip

    def conflicts(self) -> Iterator[Conflict]:
        """Yield orders that do not rise."""
        for key in ("outer_ring", "inner_ring"):
            orders = getattr(self, key)
            if any(second <= first for first, second in pairwise(orders)):
                yield Conflict(key, f"must rise, each order once: {sorted(set(orders))}")


#: Of a pedestal, and of the seat of an outer ring: of one bearing and of those of a set.
AxesRatio = Annotated[
    float,
    Field(
        ge=0.01,
        le=100,
        examples=[1.0],
        description="Radial stiffness along the pedestal's axis y' over the one along z', which is the "
        "pedestal's stiffness; 1: the same all round.",
    ),
]
AxesAngle = Annotated[
    float,
    Field(
        ge=-90,
        le=90,
        examples=[0.0],
        description="Turn of the pedestal's axes y', z' about X against Y, Z, deg.",
    ),
]
_TILTS = "Tilt about {} of the outer ring's seat against the shaft, mrad."
SeatTiltY = Annotated[float, Field(ge=-10, le=10, examples=[0.0], description=_TILTS.format("Y"))]
SeatTiltZ = Annotated[float, Field(ge=-10, le=10, examples=[0.0], description=_TILTS.format("Z"))]


class Mounting(Part):
    """Preload, radial load, pedestal, and the bodies fixed to the rings."""

    preload_N: float = Field(
        ge=-1e6, le=1e6, examples=[500.0],
        description="Axial force on the inner ring towards +X; up to 2 C0, 10 kN at least; below 0, towards "
        "-X, with deep groove bearings alone, N.",
    )  # fmt: skip
    preload_mode: Literal["force", "rigid"] = Field(
        default="force", examples=["force"],
        description="Preload by a constant force, or by the displacement that gives it at standstill and "
        "20 degC.",
    )  # fmt: skip
    pedestal_stiffness_N_m: float = Field(
        ge=1e4, le=1e12, examples=[1e8], description="Radial stiffness under the outer ring, N/m."
    )
    pedestal_stiffness_ratio: AxesRatio = 1.0
    pedestal_axis_angle_deg: AxesAngle = 0.0
    pedestal_axial_ratio: float = Field(
        default=1.0, ge=0.01, le=100, examples=[1.0],
        description="Axial over radial stiffness of the pedestal (default assumed).",
    )  # fmt: skip
    pedestal_rotational_ratio_mm2: float = Field(
        default=200.0, ge=0.1, le=1e6, examples=[200.0],
        description="Rotational over radial stiffness of the pedestal (default assumed), mm2.",
    )  # fmt: skip
    pedestal_damping_ratio: float = Field(
        default=0.05, ge=0, le=1, examples=[0.05],
        description="Damping over the critical one of the outer ring's mass (default assumed); 0: none.",
    )  # fmt: skip
    radial_load_y_N: float = Field(
        default=0.0, ge=-1e6, le=1e6, examples=[0.0],
        description="Horizontal load on the inner ring; up to 2 C0, 3 kN at least, N.",
    )  # fmt: skip
    radial_load_z_N: float = Field(
        default=0.0, ge=-1e6, le=1e6, examples=[0.0],
        description="Upward load on the inner ring; up to 2 C0, 3 kN at least, N.",
    )  # fmt: skip
    misalignment_y_mrad: SeatTiltY = 0.0
    misalignment_z_mrad: SeatTiltZ = 0.0
    rotor: Rotor | None = Field(default=None, description="Rotor on the inner ring; absent: the ring alone.")
    tilt_support: TiltSupport | None = Field(
        default=None, description="Support against tilting; absent: the balls alone hold the inner ring."
    )
    housing: Housing | None = Field(
        default=None, description="Housing on the outer ring; absent: the ring alone."
    )
    flexure: Flexure | None = Field(default=None, description="Bending of the rings; absent: rigid rings.")
    fit: Fit | None = Field(
        default=None, description="Fits of the rings; absent: rings as drawn, whatever they sit on."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield rings that bend although a solid body on a tight seat keeps them round."""
        if self.flexure is None:
            return
        bodies = (("inner", "rotor", self.rotor), ("outer", "housing", self.housing))
        for ring, name, body in bodies:
            stiffness = getattr(self.flexure, f"{ring}_seat_stiffness_N_m")
            if body is not None and getattr(self.flexure, f"{ring}_ring") and stiffness == 0.0:
                yield Conflict(
                    f"flexure.{ring}_ring",
                    f"cannot bend on the tight seat of [mounting.{name}]: write {ring}_ring = [], or for "
                    f"a loose fit give {ring}_seat_stiffness_N_m, or leave out the {name}",
                )
