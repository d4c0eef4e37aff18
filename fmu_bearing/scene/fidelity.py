"""How finely the scene is computed, and which terms are left out."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part

STRIPS = (1, 3, 5)


class Terms(Part):
    """Forces that a scene may leave out; what is left out is not computed."""

    gravity: bool = Field(description="Weight of all bodies.", examples=[True])
    drag: bool = Field(description="Oil-air drag on the balls.", examples=[True])
    rolling_resistance: bool = Field(description="Hydrodynamic rolling resistance.", examples=[True])
    land_film: bool = Field(description="Film and dry stop of the cage's lands.", examples=[True])
    gyroscopic: bool = Field(description="Gyroscopic moments of the balls.", examples=[True])


class Fidelity(Part):
    """Level, error bounds and detail."""

    level: Literal["full"] = Field(description="Level of the dynamics.", examples=["full"])
    tolerance: float = Field(
        ge=1e-6, le=0.1, examples=[1e-3], description="Relative error allowed in ring velocities."
    )
    max_internal_step_us: float = Field(
        ge=0.1, le=100, examples=[20.0], description="Largest internal step of the solver, us."
    )
    traction_strips: int = Field(
        ge=1, le=5, examples=[5], description="Strips over a contact's major axis: 1, 3 or 5."
    )
    ball_harmonics: int = Field(
        ge=0, le=16, examples=[4], description="Highest circumferential order of the balls' sound."
    )
    terms: Terms = Field(description="Forces that are computed.")

    def conflicts(self) -> Iterator[Conflict]:
        """Yield a number of strips for which there is no symmetric rule."""
        if self.traction_strips not in STRIPS:
            yield Conflict("traction_strips", "must be 1, 3 or 5")
