"""Geometry of the bearing."""

from pydantic import Field, model_validator

from fmu_bearing.scene.base import Part


class Cage(Part):
    """A cage with round radial pockets, guided by the inner ring's shoulders on two lands."""

    outside_diameter_mm: float = Field(ge=2, le=1000, examples=[27.6], description="outside diameter")
    bore_mm: float = Field(ge=1, le=1000, examples=[23.4], description="bore")
    width_mm: float = Field(ge=0.5, le=300, examples=[9.1], description="width")
    pocket_diameter_mm: float = Field(ge=0.5, le=120, examples=[4.6], description="diameter of a pocket")
    land_clearance_mm: float = Field(
        ge=0.005, le=2, examples=[0.04], description="radial clearance of the lands"
    )
    pocket_damping_N_s_m: float = Field(ge=0, le=10, examples=[0.02], description="film damping in a pocket")
    pocket_friction: float = Field(ge=0, le=0.5, examples=[0.05], description="friction in a pocket")

    @model_validator(mode="after")
    def _fits(self) -> "Cage":
        if self.bore_mm >= self.outside_diameter_mm:
            raise ValueError(
                f"bore_mm = {self.bore_mm:g} must be below outside_diameter_mm = {self.outside_diameter_mm:g}"
            )
        if self.pocket_diameter_mm >= self.width_mm:
            raise ValueError(
                f"pocket_diameter_mm = {self.pocket_diameter_mm:g} must be below width_mm = {self.width_mm:g}"
            )
        return self


class Bearing(Part):
    """A single-row angular contact ball bearing."""

    designation: str = Field(
        min_length=1, max_length=40, examples=["7003C"], description="name of the bearing"
    )
    bore_mm: float = Field(ge=1, le=1000, examples=[17.0], description="bore")
    outside_diameter_mm: float = Field(ge=3, le=2000, examples=[35.0], description="outside diameter")
    width_mm: float = Field(ge=1, le=300, examples=[10.0], description="width")
    pitch_diameter_mm: float = Field(ge=2, le=1500, examples=[26.0], description="pitch diameter")
    ball_diameter_mm: float = Field(ge=0.5, le=120, examples=[4.5], description="ball diameter")
    ball_count: int = Field(ge=3, le=24, examples=[12], description="number of balls")
    contact_angle_deg: float = Field(ge=5, le=45, examples=[15.0], description="free contact angle")
    inner_conformity: float = Field(ge=0.505, le=0.6, examples=[0.515], description="groove radius over D")
    outer_conformity: float = Field(ge=0.505, le=0.6, examples=[0.52], description="groove radius over D")
    inner_ring_outer_diameter_mm: float = Field(
        ge=1, le=1500, examples=[22.6], description="effective outer diameter of the inner ring, for its mass"
    )
    outer_ring_inner_diameter_mm: float = Field(
        ge=1, le=2000, examples=[29.6], description="effective inner diameter of the outer ring, for its mass"
    )
    contact_damping_us: float = Field(
        ge=0, le=25, examples=[0.5], description="contact damping over contact stiffness"
    )
    race_roughness_um: float = Field(
        ge=0.001, le=2, examples=[0.02], description="rms roughness of the races"
    )
    ball_roughness_um: float = Field(
        ge=0.001, le=2, examples=[0.01], description="rms roughness of the balls"
    )
    cage: Cage | None = Field(default=None, description="leave the table out for a bearing without cage")

    @model_validator(mode="after")
    def _fits(self) -> "Bearing":
        order = (
            ("bore_mm", "inner_ring_outer_diameter_mm"),
            ("inner_ring_outer_diameter_mm", "pitch_diameter_mm"),
            ("pitch_diameter_mm", "outer_ring_inner_diameter_mm"),
            ("outer_ring_inner_diameter_mm", "outside_diameter_mm"),
        )
        for small, large in order:
            if getattr(self, small) >= getattr(self, large):
                raise ValueError(
                    f"{small} = {getattr(self, small):g} must be below {large} = {getattr(self, large):g}"
                )
        room = 3.141592653589793 * self.pitch_diameter_mm / self.ball_diameter_mm
        if self.ball_count > room:
            raise ValueError(
                f"ball_count = {self.ball_count} does not fit the pitch circle: at most {int(room)} balls of "
                f"{self.ball_diameter_mm:g} mm"
            )
        if self.cage is not None and self.cage.pocket_diameter_mm <= self.ball_diameter_mm:
            raise ValueError(
                f"cage.pocket_diameter_mm = {self.cage.pocket_diameter_mm:g} must exceed ball_diameter_mm = "
                f"{self.ball_diameter_mm:g}"
            )
        return self
