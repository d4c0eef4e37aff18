"""Physics, integrator and accuracy of a scene, and the terms that are left out."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from fmu_bearing.engine import choices
from fmu_bearing.scene.base import Conflict, Part

STRIPS = (1, 3, 5)


class Terms(Part):
    """Forces that a scene may leave out; they are then not computed.

    Other forces are left out in their own tables: traction by ``lubricant.traction_max = 0``, the
    film in pockets by ``pocket_damping_N_s_m = 0``, the cage by ``bearing.cage = false``, pedestal damping by
    its ratio, thermal effects by ``expansion_1e6_K = 0`` and ``vogel_B_K = 0`` or ``walther_slope = 0``,
    imperfections, rotor and supports by leaving out their tables. Contact of balls and races and the inertia
    of what moves are the bearing itself.
    """

    gravity: bool = Field(default=True, description="Weight of all bodies.", examples=[True])
    drag: bool = Field(default=True, description="Oil-air drag on the balls.", examples=[True])
    rolling_resistance: bool = Field(
        default=True, description="Hydrodynamic rolling resistance.", examples=[True]
    )
    rolling_reduction: bool = Field(
        default=True,
        description="Reduction of rolling resistance by inlet shear heating and starvation; false: factor 1.",
        examples=[True],
    )
    rolling_hysteresis: bool = Field(
        default=True,
        description="Rolling resistance by the elastic work that materials do not give back.",
        examples=[True],
    )
    thermal_traction: bool = Field(
        default=False, examples=[False],
        description="Traction that falls as friction heats the oil it shears: 0.5 to 5 % less heat; runs of "
        "fidelity full take 2 to 4 times as long.",
    )  # fmt: skip
    contact_damping: bool = Field(
        default=True, description="Damping in the contacts of balls and races.", examples=[True]
    )
    pocket_friction: bool = Field(
        default=True, description="Friction between balls and the cage's pockets.", examples=[True]
    )
    land_film: bool = Field(
        default=True,
        description="Film between the cage and the lands of the ring that guides it; the dry stop stays.",
        examples=[True],
    )
    land_growth: bool = Field(
        default=False, examples=[False],
        description="Growth of a land's clearance from 20 degC and standstill on, by heat, fit and rotation "
        "of cage and ring; without it the clearance is that of the running bearing.",
    )  # fmt: skip
    gyroscopic: bool = Field(default=True, description="Gyroscopic moments of the balls.", examples=[True])


class Accuracy(Part):
    """Largest differences of fidelity ``auto`` from ``full``."""

    level_dB: float = Field(
        default=1.0, ge=0.01, le=40, examples=[1.0],
        description="Difference allowed in levels of vibration and sound, dB.",
    )  # fmt: skip
    relative: float = Field(
        default=0.1, ge=1e-3, le=1, examples=[0.1],
        description="Relative difference allowed in loads and friction torque.",
    )  # fmt: skip


class Fidelity(Part):
    """Physics, integrator, error bounds and detail."""

    model: Literal[choices.Fidelity, "auto"] = Field(
        default="full", examples=["full"],
        description="Physics: all bodies, the rings alone, the linear response, or the fastest "
        "within the accuracy.",
    )  # fmt: skip
    method: choices.Method = Field(
        default="esdirk4", description="Integrator of fidelity full.", examples=["esdirk4"]
    )
    accuracy: Accuracy = Field(
        default_factory=Accuracy, description="Differences from fidelity full that fidelity auto may make."
    )
    race_control: choices.RaceControl = Field(
        default="shared",
        description="Which race balances the gyroscopic moment in the quasi-static state.",
        examples=["shared"],
    )
    tolerance: float = Field(
        default=2e-3, ge=1e-6, le=0.1, examples=[2e-3],
        description="Relative error allowed in ring velocities.",
    )  # fmt: skip
    max_internal_step_us: float = Field(
        default=25.0, ge=0.1, le=100, examples=[25.0], description="Largest internal step of the solver, us."
    )
    traction_strips: int = Field(
        default=5, ge=1, le=5, examples=[5], description="Strips over a contact's major axis: 1, 3 or 5."
    )
    ball_harmonics: int = Field(
        default=8, ge=0, le=16, examples=[4], description="Highest circumferential order of the balls' sound."
    )
    terms: Terms = Field(default_factory=Terms, description="Forces that are computed.")

    def conflicts(self) -> Iterator[Conflict]:
        """Yield a number of strips for which there is no symmetric rule."""
        if self.traction_strips not in STRIPS:
            yield Conflict("traction_strips", "must be 1, 3 or 5")
