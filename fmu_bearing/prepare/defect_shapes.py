"""Shapes of local defects: how deep a spall, a pit, a dent or a scratch is below the race's surface."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.scene.defect import RIM

Real = NDArray[np.float64]

#: Outlines with an edge all round, and the dent, which has none.
KINDS = ("rectangle", "ellipse", "dent")
_STEEPEST = math.radians(80.0)  # turn of a shape without end across


class Shape(NamedTuple):
    """A local defect in its own frame: X along rolling, Y across, both from its middle; SI units.

    How the shapes of a scene become one: a `spall` is a rectangle or an ellipse, a `pit` an ellipse as wide
    as long, a `dent` a dent, a `scratch` a rectangle whose ``length`` is the scratch's own width, with
    ``width`` infinite and ``turn``.

    Attributes
    ----------
    kind : str
        One of `KINDS`.
    length, width : float
        Along rolling and across at turn 0 (m); ``width`` may be infinite. A dent's rim lies outside.
    depth : float
        Of bottom or middle below the surface (m).
    edge : float
        Radius of the rounded edge of rectangle and ellipse (m).
    rim : float
        Height of a dent's rim (m).
    offset : float
        Of its middle across the track (m), from the middle of the contact.
    turn : float
        About the surface's normal (rad), from X towards Y.
    """

    kind: str
    length: float
    width: float
    depth: float
    edge: float = 0.0
    rim: float = 0.0
    offset: float = 0.0
    turn: float = 0.0

    def check(self) -> None:
        """Raise `ValueError` for a shape that there is not, with the way out."""
        if self.kind not in KINDS:
            raise ValueError(f"shape {self.kind!r}: one of {', '.join(KINDS)}")
        for name in ("length", "width"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} {getattr(self, name)} m of a defect: give more than 0")
        for name in ("depth", "edge", "rim"):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise ValueError(f"{name} {getattr(self, name)} m of a defect: give 0 or more")
        if not math.isfinite(self.length + self.offset + self.turn):
            raise ValueError("length, offset and turn of a defect: give finite numbers")
        if self.rim > 0.0 and self.kind != "dent":
            raise ValueError(f"rim {self.rim} m of a {self.kind}: only a dent has one; give 0")
        if math.isinf(self.width) and self.kind != "rectangle":
            raise ValueError(f"width of a {self.kind} without end: only a rectangle can have it")
        if math.isinf(self.width) and abs(math.remainder(self.turn, math.pi)) > _STEEPEST:
            raise ValueError(
                f"turn {math.degrees(self.turn):.0f} deg of a shape without end across: give -80 to 80 deg"
            )

    def pit(self, x: Real, y: Real) -> Real:
        """Depth (m) at points along and across (m, arrays of one shape) below the surface; a rim is < 0."""
        across = y - self.offset
        cosine, sine = math.cos(self.turn), math.sin(self.turn)
        u, v = np.abs(cosine * x + sine * across), np.abs(cosine * across - sine * x)
        half, side = 0.5 * self.length, 0.5 * self.width
        if self.kind == "rectangle":
            return self._below(np.minimum(half - u, side - v))
        radius = np.hypot(u / half, v / side)
        if self.kind == "dent":
            inside = self.depth * np.maximum(1.0 - radius**2, 0.0) ** 2
            part = np.clip((radius - 1.0) / (RIM - 1.0), 0.0, 1.0)
            return inside - self.rim * np.sin(math.pi * part) ** 2
        # distance to an ellipse of first order, that to a circle exactly
        slope = np.hypot(u / half**2, v / side**2) / np.maximum(radius, 1e-12)
        return self._below((1.0 - radius) / np.maximum(slope, 1.0 / max(half, side)))

    def _below(self, inside: Real) -> Real:
        """Depth (m) at distances inside an outline (m): a quarter circle, a wall, the bottom."""
        if self.edge == 0.0:
            return np.where(inside > 0.0, self.depth, 0.0)
        part = np.clip(inside, 0.0, self.edge)
        arc = self.edge - np.sqrt(self.edge**2 - part**2)
        return np.where(inside >= self.edge, self.depth, np.minimum(self.depth, arc))

    def sizes(self) -> tuple[float, float]:
        """Distances (m) along and across of edges that lie along the axes; infinite where there are none."""
        if self.kind == "dent" or self.turn != 0.0:
            return math.inf, math.inf
        return self.length, self.width

    def extent(self, track: float) -> tuple[float, float]:
        """Half lengths along and across (m) of a box that holds it; a track has half a width (m).

        What of an endless shape lies further than ``track`` from the middle of the track is left out.
        """
        out = RIM if self.kind == "dent" and self.rim > 0.0 else 1.0
        half, side = 0.5 * out * self.length, 0.5 * out * self.width
        cosine, sine = abs(math.cos(self.turn)), abs(math.sin(self.turn))
        if self.kind == "rectangle":
            free = (half * cosine + side * sine if sine > 0.0 else half, half * sine + side * cosine)
            # a slanted strip is cut where the track ends
            cut = (half + (track + abs(self.offset)) * sine) / cosine if cosine > 1e-9 else math.inf
            return min(free[0], cut), free[1]
        return math.hypot(half * cosine, side * sine), math.hypot(half * sine, side * cosine)
