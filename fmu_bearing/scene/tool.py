"""The tool on the nose, and the cut that it takes: what milling stability needs beside the bearings."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.shaft import LONG, Section, thin_sections

_MOST = 40  # sections


class Holder(Part):
    """What holds the tool on the nose."""

    sections_mm: tuple[Section, ...] = Field(
        min_length=1, max_length=_MOST, strict=False, examples=[[[40.0, 30.0, 10.0], [15.0, 40.0, 10.0]]],
        description="Sections from the tool to the nose, each [length, diameter, bore], mm.",
    )  # fmt: skip
    material: Material | None = Field(
        default=None, examples=["GCr15"], description="Its material; absent: that of the inner rings."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield sections whose bore leaves nothing."""
        yield from thin_sections(self.sections_mm)


class Tool(Part):
    """A tool on the nose of the shaft, or on the rotor of a single bearing, fixed there without a gap.

    Receptance and milling stability at its tip have it; runs, loads and modes do not.
    """

    sections_mm: tuple[Section, ...] = Field(
        min_length=1, max_length=_MOST, strict=False, examples=[[[20.0, 9.0, 0.0], [20.0, 10.0, 0.0]]],
        description="Sections from the tip on, as far as the tool sticks out, each [length, diameter, bore], "
        "mm.",
    )  # fmt: skip
    material: Material = Field(examples=["tungsten-carbide"], description="Its material.")
    holder: Holder | None = Field(default=None, description="Absent: the tool is fixed on the nose itself.")
    damping_ratio: float = Field(
        default=0.01, ge=0, le=0.5, examples=[0.01],
        description="Of tool and holder with their joints, the same at all frequencies: half the loss factor "
        "(default assumed).",
    )  # fmt: skip
    position_mm: float | None = Field(
        default=None, ge=-LONG, le=LONG, examples=[-90.0],
        description="Where it is fixed, from the shaft's nose or the middle of a single bearing, negative: "
        "ahead of it (absent: the nose; of a single bearing the front end of its rotor), mm.",
    )  # fmt: skip

    def conflicts(self) -> Iterator[Conflict]:
        """Yield sections whose bore leaves nothing."""
        yield from thin_sections(self.sections_mm)


class Milling(Part):
    """A cut across the axis, by teeth at equal angles; the workpiece is rigid."""

    teeth: int = Field(ge=1, le=100, examples=[4], description="Number of teeth.")
    cutting_coefficient_N_mm2: float = Field(
        ge=10, le=20000, examples=[800.0],
        description="Tangential force over chip area, K_t, N/mm2.",
    )  # fmt: skip
    radial_ratio: float = Field(
        default=0.3, ge=0, le=2, examples=[0.3], description="Radial over tangential force (default assumed)."
    )
    radial_immersion: float = Field(
        ge=0.01, le=1, examples=[0.5],
        description="Radial depth over the diameter of the tool; 1: a slot.",
    )  # fmt: skip
    direction: Literal["up", "down"] = Field(
        default="down", examples=["down"], description="Up milling, or down (climb) milling."
    )
    depth_mm: float | None = Field(
        default=None, ge=1e-4, le=1000, examples=[2.0],
        description="Axial depth of the cut, which is judged (absent: none is), mm.",
    )  # fmt: skip
    feed_angle_deg: float = Field(
        default=90.0, ge=-360, le=360, examples=[90.0],
        description="Direction in which the tool is fed, about +X from 12 o'clock, deg.",
    )  # fmt: skip
