"""How finely the scene is computed, and which terms are left out."""

from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Part


class Terms(Part):
    """Forces that a scene may leave out; what is left out is not computed."""

    gravity: bool = Field(description="weight of all bodies", examples=[True])
    drag: bool = Field(description="oil-air drag on the balls", examples=[True])
    rolling_resistance: bool = Field(description="hydrodynamic rolling resistance", examples=[True])
    land_film: bool = Field(description="film and dry stop of the cage's lands", examples=[True])
    gyroscopic: bool = Field(description="gyroscopic moments of the balls", examples=[True])


class Fidelity(Part):
    """Level, error bounds and detail."""

    level: Literal["full"] = Field(description="level of the dynamics", examples=["full"])
    tolerance: float = Field(
        ge=1e-6, le=0.1, examples=[1e-3], description="relative error of ring velocities"
    )
    max_internal_step_us: float = Field(ge=0.1, le=100, examples=[20.0], description="largest internal step")
    traction_strips: Literal[1, 3, 5] = Field(description="strips over a contact's major axis", examples=[5])
    ball_harmonics: int = Field(
        ge=0, le=16, examples=[4], description="circumferential orders of the balls' sound"
    )
    terms: Terms
