"""The shaft of a set: sections, stiffness, heavy spots, tilt support; or that of another model."""

from collections.abc import Iterator, Sequence
from typing import Annotated

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.mounting import TiltSupport

LONG = 5000.0  # mm: of a shaft, at most

Length = Annotated[float, Field(ge=0.1, le=LONG)]
Diameter = Annotated[float, Field(ge=1, le=1000)]
Bore = Annotated[float, Field(ge=0, le=1000)]
# A file's array arrives as a list: the one conversion that strictness may let pass.
Section = Annotated[tuple[Length, Diameter, Bore], Field(strict=False)]


def thin_sections(sections: Sequence[tuple[float, float, float]]) -> Iterator[Conflict]:
    """Yield sections (length, diameter, bore) whose bore leaves nothing."""
    for number, (_, diameter, bore) in enumerate(sections, start=1):
        if bore >= diameter:
            yield Conflict(
                "sections_mm", f"section {number} has a bore of {bore:g} mm in a diameter of {diameter:g}"
            )


class Unbalance(Part):
    """A heavy spot of the shaft."""

    position_mm: float = Field(
        ge=0, le=LONG, examples=[20.0], description="Plane of the heavy spot from the nose, mm."
    )
    amount_g_mm: float = Field(
        ge=0, le=1e5, examples=[0.1], description="Mass times distance from the axis, g mm."
    )
    angle_deg: float = Field(
        default=0.0, ge=-360, le=360, examples=[0.0],
        description="Angle about +X from 12 o'clock where the shaft's angle is zero, deg.",
    )  # fmt: skip


class OnShaft(Part):
    """A plane of the shaft that a support holds."""

    position_mm: float | None = Field(
        default=None, ge=0, le=LONG, examples=[150.0],
        description="Plane that it holds, from the shaft's nose (absent: the middle of the bearings), mm.",
    )  # fmt: skip


class ShaftTiltSupport(OnShaft, TiltSupport):
    """Moments between shaft and ground that hold the shaft against tilting: a bearing that is not in the set.

    It holds one plane of the shaft; all planes of a rigid shaft have the same tilt.
    """


class Shaft(Part):
    """The shaft in cylindrical sections; its nose is at X = 0. One of another model has no sections."""

    external: bool = Field(
        default=False, examples=[True],
        description="Whether another model owns the shaft: its motion at X = 0 comes in, the bearings' force "
        "goes out (mechanical port).",
    )  # fmt: skip
    sections_mm: tuple[Section, ...] = Field(
        default=(), max_length=40, strict=False, examples=[[[30.0, 22.0, 0.0], [140.0, 17.0, 0.0]]],
        description="Sections from the nose to the rear, each [length, diameter, bore], mm.",
    )  # fmt: skip
    material: Material | None = Field(
        default=None,
        examples=["GCr15"],
        description="Material of the shaft; absent: that of the inner rings.",
    )
    temperature_degC: float | None = Field(
        default=None, ge=-40, le=199, examples=[45.0],
        description="Mean temperature of the shaft between its bearings (absent: that of [operation]'s inner "
        "ring), degC.",
    )  # fmt: skip
    flexible: bool = Field(
        default=False,
        examples=[True],
        description="Whether the shaft bends (Timoshenko beam); else it is rigid with the same mass.",
    )
    fixed_modes: int = Field(
        default=2, ge=0, le=8, examples=[2],
        description="Flexible shaft: bending modes between nose and bearings that are kept, per direction.",
    )  # fmt: skip
    damping_ratio: float = Field(
        default=0.005, ge=0, le=0.5, examples=[0.005],
        description="Flexible shaft: damping over the critical one at its lowest bending frequency without "
        "supports; it grows with frequency (default assumed).",
    )  # fmt: skip
    unbalance: tuple[Unbalance, ...] = Field(
        default=(), max_length=20, strict=False, description="Heavy spots; absent: a balanced shaft."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield sections whose bore leaves nothing, and a shaft without any."""
        if self.external:
            return
        if not self.sections_mm:
            yield Conflict(
                "sections_mm",
                "is missing, for example sections_mm = [[30.0, 22.0, 0.0], [140.0, 17.0, 0.0]]; a shaft that "
                "another model owns has external = true",
            )
            return
        for key in () if self.flexible else ("fixed_modes", "damping_ratio"):
            if getattr(self, key) != type(self).model_fields[key].default:
                yield Conflict(key, "applies to a shaft that bends: give flexible = true, or leave it out")
        yield from thin_sections(self.sections_mm)
        for number, spot in enumerate(self.unbalance, start=1):
            if spot.position_mm > self.length_mm:
                yield Conflict(
                    f"unbalance[{number}].position_mm",
                    f"= {spot.position_mm:g} is beyond the shaft's end at {self.length_mm:g} mm",
                )

    @property
    def length_mm(self) -> float:
        """Length of all sections."""
        return sum(length for length, _, _ in self.sections_mm)
