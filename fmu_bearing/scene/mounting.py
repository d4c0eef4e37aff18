"""How the bearing is mounted and loaded."""

from pydantic import Field

from fmu_bearing.scene.base import Part


class Rotor(Part):
    """A solid cylinder fixed to the inner ring, centred in the bearing."""

    mass_kg: float = Field(ge=0, le=1000, examples=[0.25], description="mass")
    length_mm: float = Field(ge=1, le=5000, examples=[180.0], description="length")
    diameter_mm: float = Field(ge=1, le=1000, examples=[15.0], description="diameter")


class TiltSupport(Part):
    """What holds the rotor against tilting: the far bearing of the spindle."""

    stiffness_N_m_rad: float = Field(ge=0, le=1e9, examples=[1e5], description="rotational stiffness")
    damping_ratio: float = Field(ge=0, le=1, examples=[0.05], description="damping ratio")


class Housing(Part):
    """A cylinder that moves with the outer ring."""

    mass_kg: float = Field(ge=0, le=1e4, examples=[2.0], description="moving mass")
    diameter_mm: float = Field(ge=5, le=3000, examples=[100.0], description="outside diameter")
    length_mm: float = Field(ge=1, le=5000, examples=[160.0], description="length")
    front_face_mm: float = Field(
        ge=-500,
        le=500,
        examples=[15.5],
        description="distance of its front face ahead of the bearing's end face",
    )


class Mounting(Part):
    """Preload, radial load, pedestal, and the bodies fixed to the rings."""

    preload_N: float = Field(ge=0, le=1e4, examples=[500.0], description="axial force on the inner ring")
    pedestal_stiffness_N_m: float = Field(ge=1e4, le=1e12, examples=[1e8], description="radial stiffness")
    pedestal_axial_ratio: float = Field(
        ge=0.01, le=100, examples=[1.0], description="axial over radial stiffness"
    )
    pedestal_rotational_ratio_mm2: float = Field(
        ge=0.1, le=1e6, examples=[200.0], description="rotational over radial stiffness"
    )
    pedestal_damping_ratio: float = Field(ge=0, le=1, examples=[0.05], description="damping ratio")
    radial_load_y_N: float = Field(
        ge=-3e3, le=3e3, examples=[0.0], description="horizontal load on the inner ring"
    )
    radial_load_z_N: float = Field(
        ge=-3e3, le=3e3, examples=[0.0], description="vertical load on the inner ring"
    )
    rotor: Rotor | None = None
    tilt_support: TiltSupport | None = None
    housing: Housing | None = None
