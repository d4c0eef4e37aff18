"""How the bearing is mounted and loaded."""

from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Part


class Rotor(Part):
    """A solid cylinder fixed to the inner ring, centred in the bearing."""

    mass_kg: float = Field(ge=0, le=1000, examples=[0.25], description="Mass of the rotor, kg.")
    length_mm: float = Field(ge=1, le=5000, examples=[180.0], description="Length of the rotor, mm.")
    diameter_mm: float = Field(ge=1, le=1000, examples=[15.0], description="Diameter of the rotor, mm.")


class TiltSupport(Part):
    """What holds the rotor against tilting: the far bearing of the spindle."""

    stiffness_N_m_rad: float = Field(
        ge=0, le=1e9, examples=[1e5], description="Stiffness against tilting, N m/rad."
    )
    damping_ratio: float = Field(
        ge=0, le=1, examples=[0.05], description="Damping over the critical one of the tilting rotor."
    )


class Housing(Part):
    """A cylinder that moves with the outer ring."""

    mass_kg: float = Field(ge=0, le=1e4, examples=[2.0], description="Mass moving with the outer ring, kg.")
    diameter_mm: float = Field(
        ge=5, le=3000, examples=[100.0], description="Outside diameter of the housing, mm."
    )
    length_mm: float = Field(ge=1, le=5000, examples=[160.0], description="Length of the housing, mm.")
    front_face_mm: float = Field(
        ge=-500,
        le=500,
        examples=[15.5],
        description="Distance of its front face ahead (-X) of the bearing's end face, mm.",
    )


class Mounting(Part):
    """Preload, radial load, pedestal, and the bodies fixed to the rings."""

    preload_N: float = Field(
        ge=0, le=1e4, examples=[500.0], description="Axial force on the inner ring towards +X, N."
    )
    preload_mode: Literal["force", "rigid"] = Field(
        default="force",
        examples=["force"],
        description="Preload by a constant force, or by the displacement that gives it at standstill and "
        "20 degC.",
    )
    pedestal_stiffness_N_m: float = Field(
        ge=1e4, le=1e12, examples=[1e8], description="Radial stiffness under the outer ring, N/m."
    )
    pedestal_axial_ratio: float = Field(
        ge=0.01, le=100, examples=[1.0], description="Axial over radial stiffness of the pedestal."
    )
    pedestal_rotational_ratio_mm2: float = Field(
        ge=0.1, le=1e6, examples=[200.0], description="Rotational over radial stiffness of the pedestal, mm2."
    )
    pedestal_damping_ratio: float = Field(
        ge=0,
        le=1,
        examples=[0.05],
        description="Damping over the critical one of the outer ring's mass; 0: none.",
    )
    radial_load_y_N: float = Field(
        ge=-3e3, le=3e3, examples=[0.0], description="Horizontal load on the inner ring, N."
    )
    radial_load_z_N: float = Field(
        ge=-3e3, le=3e3, examples=[0.0], description="Upward load on the inner ring, N."
    )
    misalignment_y_mrad: float = Field(
        default=0.0,
        ge=-10,
        le=10,
        examples=[0.0],
        description="Tilt about Y of the outer ring's seat against the shaft, mrad.",
    )
    misalignment_z_mrad: float = Field(
        default=0.0,
        ge=-10,
        le=10,
        examples=[0.0],
        description="Tilt about Z of the outer ring's seat against the shaft, mrad.",
    )
    rotor: Rotor | None = Field(default=None, description="Rotor on the inner ring; absent: the ring alone.")
    tilt_support: TiltSupport | None = Field(
        default=None, description="Support against tilting; absent: the balls alone hold the inner ring."
    )
    housing: Housing | None = Field(
        default=None, description="Housing on the outer ring; absent: the ring alone."
    )
