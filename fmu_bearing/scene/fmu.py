"""How an FMU shows the bearing to other tools."""

from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Part


class Fmu(Part):
    """Names, inputs and outputs of the FMU; the model and its numbers stay the same.

    Names are those of the documentation (``contact.inner.load_max``), a star matches any text.
    """

    outputs: tuple[str, ...] = Field(
        default=(),
        strict=False,
        max_length=1000,
        examples=[["inner_ring.displacement.*", "contact.*.load_max", "stiffness.*", "rotor.inertia"]],
        description="Local variables and constants that become outputs, which masters can connect.",
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
