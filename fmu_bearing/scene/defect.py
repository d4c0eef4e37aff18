"""Local defects of races and balls: spalls, pits, dents and scratches, where they are and how large.

Keys that a shape or a place does not have are absent, so that one that is given without an effect is refused.
"""

import math
from collections.abc import Iterator
from typing import Literal, get_args

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part
from fmu_bearing.scene.bearing import MOST_BALLS

Place = Literal["inner", "outer", "ball"]
Shape = Literal["spall", "pit", "dent", "scratch"]
PLACES: tuple[Place, ...] = get_args(Place)
SHAPES: tuple[Shape, ...] = get_args(Shape)
#: Most defects of a scene.
MOST_DEFECTS = 8
#: The rim of a dent ends there, over the radius of the dent.
RIM = 1.5
_EDGE = 0.01  # mm: rounding of an edge where none is given
_BOTTOM = 180.0  # deg: 6 o'clock, where a weight presses the balls
_LONGEST = 20.0  # mm

#: Keys that not every shape has: the shapes that have them.
_OF_SHAPES: dict[str, tuple[Shape, ...]] = {
    "width_mm": ("spall", "scratch"),
    "edge_mm": ("spall", "pit", "scratch"),
    "rim_um": ("dent",),
    "turn_deg": ("scratch",),
}
#: Keys that not every place has: the places that have them.
_OF_PLACES: dict[str, tuple[Place, ...]] = {
    "angle_deg": ("inner", "outer"),
    "offset_mm": ("inner", "outer"),
    "ball": ("ball",),
    "tilt_deg": ("ball",),
}


class Defect(Part):
    """A place where material is missing from a race or a ball, in a perfect or a wavy surface.

    A spall is a rectangle and a pit is round, both with a flat bottom; a dent is round and smooth, with or
    without a rim; a scratch runs across the track.
    """

    on: Place = Field(examples=["outer"], description="Race or ball that has it.")
    shape: Shape = Field(examples=["spall"], description="Its shape.")
    length_mm: float | None = Field(
        default=None, ge=0.05, le=_LONGEST, examples=[1.2],
        description="Length along rolling, of a pit or dent its diameter; of a scratch its length, absent: "
        "across the whole track, mm.",
    )  # fmt: skip
    width_mm: float | None = Field(
        default=None, ge=0.02, le=60, examples=[3.0],
        description="Width of a spall across the track, absent: as long as it is; of a scratch its width, "
        "which is along rolling where it is not turned, mm.",
    )  # fmt: skip
    depth_um: float = Field(ge=0, le=2000, examples=[100.0], description="Depth in the middle, um.")
    edge_mm: float | None = Field(
        default=None, ge=0.001, le=5, examples=[0.01],
        description=f"Length over which an edge is rounded; absent: {_EDGE:g}, not of dents, mm.",
    )  # fmt: skip
    angle_deg: float | None = Field(
        default=None, ge=-360, le=360, examples=[180.0],
        description="Place of its middle on the race from 12 o'clock with positive rotation, on the inner "
        "race at the start; absent: 180 on the outer race, 0 on the inner one, deg.",
    )  # fmt: skip
    offset_mm: float | None = Field(
        default=None, ge=-60, le=60, examples=[0.0],
        description="Distance of its middle from the middle of the contact at the operating point, across "
        "the track towards +X; absent: 0, mm.",
    )  # fmt: skip
    rim_um: float | None = Field(
        default=None, ge=0, le=200, examples=[1.0],
        description=f"Height of the rim of a dent, which ends at {RIM:g} radii; absent: none, um.",
    )  # fmt: skip
    turn_deg: float | None = Field(
        default=None, ge=-80, le=80, examples=[0.0],
        description="Angle of a scratch with the direction across the track; absent: 0, deg.",
    )  # fmt: skip
    ball: int | None = Field(
        default=None, ge=1, le=MOST_BALLS, examples=[1], description="Number of the ball that has it."
    )
    tilt_deg: float | None = Field(
        default=None, ge=-90, le=90, examples=[0.0],
        description="Angle of the defect of a ball out of the ball's rolling circle at the start; absent: "
        "0, deg.",
    )  # fmt: skip
    bearing: int | None = Field(
        default=None, ge=1, le=16, examples=[1],
        description="Number of the bearing that has it, from the nose on; of sets alone.",
    )  # fmt: skip

    @property
    def along_mm(self) -> float:
        """Size along rolling where it is not turned: of a scratch its width, else its length."""
        size = self.width_mm if self.shape == "scratch" else self.length_mm
        assert size is not None, "refused"
        return size

    @property
    def across_mm(self) -> float | None:
        """Size across the track where it is not turned; None: the whole track."""
        return (self.width_mm or self.length_mm) if self.shape == "spall" else self.length_mm

    @property
    def turn(self) -> float:
        """Angle (rad) between its own axes and those of the track."""
        return math.radians(self.turn_deg or 0.0)

    @property
    def edge(self) -> float:
        """Length (m) over which its edge is rounded; 0 of a dent, which has none."""
        if self.shape == "dent":
            return 0.0
        return 1e-3 * (min(_EDGE, 0.5 * self._shorter) if self.edge_mm is None else self.edge_mm)

    @property
    def angle(self) -> float:
        """Place on the race (rad), see ``angle_deg``."""
        usual = _BOTTOM if self.on == "outer" else 0.0
        return math.radians(usual if self.angle_deg is None else self.angle_deg)

    @property
    def words(self) -> str:
        """What it is, in a few words: ``spall of 1.2 x 3 mm, 100 um deep, on the outer race at 180 deg``."""
        along, across = self.along_mm, self.across_mm
        if self.shape in ("pit", "dent"):
            size = f"{along:g} mm"
        elif self.shape == "spall":
            size = f"{along:g} x {across:g} mm"
        else:
            size = f"{along:g} mm" + ("" if across is None else f" x {across:g} mm")
        if self.on == "ball":
            where = f"ball {self.ball}"
        else:
            where = f"the {self.on} race at {math.degrees(self.angle):g} deg"
        of = "" if self.bearing is None else f" of bearing {self.bearing}"
        return f"{self.shape} of {size}, {self.depth_um:g} um deep, on {where}{of}"

    @property
    def span_mm(self) -> float:
        """Length along rolling that it takes, with its rim; of a scratch that is turned the part it takes.

        A scratch across the whole track is counted as if it were not turned: what lies beyond the contact
        meets no ball.
        """
        if self.shape == "dent" and self.rim_um:
            return RIM * self.along_mm
        across = self.across_mm or 0.0
        return abs(self.along_mm * math.cos(self.turn)) + abs(across * math.sin(self.turn))

    @property
    def _shorter(self) -> float:
        return min(self.along_mm, self.across_mm or self.along_mm)

    def conflicts(self) -> Iterator[Conflict]:
        """Yield sizes that are missing, and keys that the shape or the place does not have."""
        needed = "width_mm" if self.shape == "scratch" else "length_mm"
        if getattr(self, needed) is None:
            example, of = (0.1, "across itself") if self.shape == "scratch" else (1.2, "along rolling")
            yield Conflict(
                needed, f"is missing, for example {needed} = {example}: size of a {self.shape} {of}"
            )
        elif self.edge_mm is not None and self.shape != "dent" and self.edge_mm > 0.5 * self._shorter:
            yield Conflict("edge_mm", f"must not exceed half of the shorter side, {0.5 * self._shorter:g} mm")
        for keys, mine, what in ((_OF_SHAPES, self.shape, "shape"), (_OF_PLACES, self.on, "on")):
            for key, have in keys.items():
                if getattr(self, key) is not None and mine not in have:
                    others = " or ".join(f'"{one}"' for one in have)
                    yield Conflict(
                        key, f'has no meaning with {what} = "{mine}": leave it out, or give {what} = {others}'
                    )
        if self.on == "ball" and self.ball is None:
            yield Conflict("ball", "is missing, for example ball = 1: which ball has it")
