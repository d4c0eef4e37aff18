"""How an FMU shows the bearing to other tools."""

from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Part


class Fmu(Part):
    """Names, inputs and outputs of the FMU; the model and its numbers stay the same.

    Names are those of the documentation (``contact.inner.load_max``), a star matches any text.
    """

    outputs: tuple[str, ...] | None = Field(
        default=None,
        strict=False,
        max_length=1000,
        examples=[["usual", "inner_ring.displacement.*", "contact.*.load_max", "rotor.inertia"]],
        description=(
            "What is output, all else that is computed has no place in the FMU (absent: what most systems "
            "connect); names, patterns, or usual, velocities, balls, displacements, contacts, stiffness, "
            "levels, energy, forces. The friction torque always is."
        ),
    )
    inputs: tuple[str, ...] | None = Field(
        default=None,
        strict=False,
        max_length=1000,
        examples=[["shaft_speed", "*_temperature"]],
        description=(
            "Inputs that stay inputs (absent: all); the others become tunable parameters, which may be set "
            "at any time between steps and need no source."
        ),
    )
    naming: Literal["structured", "flat"] = Field(
        default="structured",
        examples=["flat"],
        description=(
            "Names: structured, ball[3].velocity.y, which tools show as a tree, or flat, ball_3_velocity_y, "
            "for tools that make ports or identifiers of names."
        ),
    )
    terminals: bool = Field(
        default=False,
        examples=[True],
        description=(
            "Describe which variables belong together in terminalsAndIcons.xml (FMI 2.0.4): shaft, heat "
            "ports, microphones."
        ),
    )
