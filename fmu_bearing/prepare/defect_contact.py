"""A ball at one place over a local defect: where it touches first, its load and the energy it stores."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.formulas.half_space import grid, solve
from fmu_bearing.formulas.hertz import PointContact, point_contact
from fmu_bearing.prepare.defect_shapes import Shape
from fmu_bearing.scene.defect import RIM

Real = NDArray[np.float64]

#: Cells along and across of the box in which bodies overlap: loads are within 0.2 % of the undamaged one of
#: those on twice as many each way, in 25 ms.
CELLS = (144, 112)
_LOOK = 96  # points each way at which an overlap is looked for
_FINE = 301  # points each way at which the first touch is looked for


class Carried(NamedTuple):
    """Load (N), stored energy (J), and its slope along the place (N)."""

    load: float
    energy: float
    slope: float


class BallOverDefect:
    """A ball on a race with a defect.

    Parameters
    ----------
    shape : Shape
    radius_x, radius_y : float
        Effective radii along and across rolling (m).
    modulus : float
        E' (Pa).
    cells : tuple
        As `CELLS`.
    """

    def __init__(
        self, shape: Shape, radius_x: float, radius_y: float, modulus: float,
        cells: tuple[int, int] = CELLS,
    ) -> None:  # fmt: skip
        shape.check()
        self.shape, self.rx, self.ry, self.modulus, self.cells = shape, radius_x, radius_y, modulus, cells
        self.hertz: PointContact = point_contact(radius_x, radius_y, modulus)
        # energy of the undamaged contact on such a grid over the exact one, 1e-4 above 1
        box = (-math.sqrt(2.0 * radius_x), math.sqrt(2.0 * radius_x))
        side = (-math.sqrt(2.0 * radius_y), math.sqrt(2.0 * radius_y))
        self._excess = 1.0
        self._excess = self._solved(1.0, 0.0, (*box, *side), False).energy / (0.4 * self.hertz.stiffness)

    def carried(self, delta: float, x: float) -> Carried:
        """Load, energy and slope at an approach of the undamaged contact and a place of the ball (m)."""
        if delta <= -self.shape.rim:
            return Carried(0.0, 0.0, 0.0)
        if self._misses(delta, x):
            load = self.hertz.stiffness * max(delta, 0.0) ** 1.5
            return Carried(load, 0.4 * load * max(delta, 0.0), 0.0)
        box = self._box(delta, x)
        return Carried(0.0, 0.0, 0.0) if box is None else self._solved(delta, x, box, True)

    def touch(self, x: float) -> float:
        """Approach (m) at which a rigid ball at x touches first: 0 beside the defect, more in a pit."""
        # a ball beside an edge touches it, and one over the bottom that: it goes no deeper
        half, side = self.extent(0.0)
        deep = [self.shape.depth, max(half - abs(x), 0.0) ** 2 / (2.0 * self.rx)]
        deep.append((side + abs(self.shape.offset)) ** 2 / (2.0 * self.ry))
        most = max(1.02 * min(deep), 1e-9) + self.shape.rim
        low = -math.sqrt(2.0 * self.rx * most), -math.sqrt(2.0 * self.ry * most)
        high = -low[0], -low[1]
        least = math.inf
        for _ in range(3):
            u = np.linspace(low[0], high[0], _FINE)[:, None]
            v = np.linspace(low[1], high[1], _FINE)[None, :]
            height = u**2 / (2.0 * self.rx) + v**2 / (2.0 * self.ry) + self._pit(x + u, v)
            i, j = np.unravel_index(int(np.argmin(height)), height.shape)
            least = min(least, float(height[i, j]))
            du, dv = (2.0 * (b - a) / (_FINE - 1) for a, b in zip(low, high, strict=True))
            low, high = (float(u[i, 0]) - du, float(v[0, j]) - dv), (float(u[i, 0]) + du, float(v[0, j]) + dv)
        return least

    def reach(self, highest: float) -> float:
        """Distance (m) from its middle beyond which it changes nothing up to an approach (m)."""
        rim = self.shape.rim
        # an ellipse beside a rim is pressed by it once both overlap
        beside = self.hertz.half_width * math.sqrt(highest + rim) + math.sqrt(2.0 * self.rx * rim)
        return self.extent(highest)[0] + beside

    def extent(self, highest: float) -> tuple[float, float]:
        """Half lengths (m) of the shape along and across, on a track as wide as the undamaged contact is."""
        return self.shape.extent(self.hertz.half_length * math.sqrt(highest))

    def _pit(self, x: Real, y: Real) -> Real:
        return self.shape.pit(*np.broadcast_arrays(x, y))

    def _misses(self, delta: float, x: float) -> bool:
        """Whether the undamaged contact, and what a rim might touch, lies beside the defect."""
        if self.shape.rim > 0.0:
            half = RIM * 0.5 * math.hypot(self.shape.length, self.shape.width)
            gone = half + math.sqrt(2.0 * self.rx * (max(delta, 0.0) + self.shape.rim))
            return abs(x) > gone
        if delta <= 0.0:
            return True
        root = math.sqrt(delta)
        u = np.linspace(-1.0, 1.0, _LOOK)[:, None]
        v = np.linspace(-1.0, 1.0, _LOOK)[None, :]
        pit = self._pit(x + self.hertz.half_width * root * u, self.hertz.half_length * root * v)
        return not np.any((pit != 0.0) & (u**2 + v**2 <= 1.0))

    def _box(self, delta: float, x: float) -> tuple[float, float, float, float] | None:
        """Box (m, along from the ball's middle, and across) in which the bodies overlap; None: nowhere."""
        most = delta + self.shape.rim
        half, side = math.sqrt(2.0 * self.rx * most), math.sqrt(2.0 * self.ry * most)
        low, high, left, right = -half, half, -side, side
        for _ in range(3):  # what overlaps may be much smaller than the ball over a flat race would
            u, v = np.linspace(low, high, _LOOK)[:, None], np.linspace(left, right, _LOOK)[None, :]
            gap = u**2 / (2.0 * self.rx) + v**2 / (2.0 * self.ry) + self._pit(x + u, v) - delta
            along, across = np.flatnonzero((gap < 0.0).any(axis=1)), np.flatnonzero((gap < 0.0).any(axis=0))
            if not len(along):
                # the overlap is smaller than the points are apart: look round the lowest one
                i, j = np.unravel_index(int(np.argmin(gap)), gap.shape)
                along, across = np.array([i]), np.array([j])
            du, dv = (high - low) / (_LOOK - 1), (right - left) / (_LOOK - 1)
            filled = min(along[-1] - along[0], across[-1] - across[0]) > 0.6 * _LOOK
            low, high = float(u[along[0], 0]) - du, float(u[along[-1], 0]) + du
            left, right = float(v[0, across[0]]) - dv, float(v[0, across[-1]]) + dv
            if filled:
                break
        return (low, high, left, right) if (gap < 0.0).any() else None

    def _solved(self, delta: float, x: float, box: tuple[float, ...], damaged: bool) -> Carried:
        sizes = self.shape.sizes() if damaged else (math.inf, math.inf)
        u, dx = _cells(box[0], box[1], self.cells[0], sizes[0], -x)
        v, dy = _cells(box[2], box[3], self.cells[1], sizes[1], self.shape.offset)
        u, v = u[:, None], v[None, :]
        gap = u**2 / (2.0 * self.rx) + v**2 / (2.0 * self.ry) - delta
        if damaged:
            gap = gap + self._pit(x + u, v)
        found = solve(gap, grid(u.size, v.size, dx, dy, self.modulus))
        # the grid lies on the race, over which the ball moves: the slope is exact on it
        slope = float((found.pressure * u).sum()) * dx * dy / self.rx
        return Carried(found.load / self._excess, found.energy / self._excess, slope / self._excess)


def _cells(low: float, high: float, number: int, size: float, middle: float) -> tuple[Real, float]:
    """Middles of cells from low to high, and their width (m).

    Edges of a shape of a ``size`` round its ``middle`` lie between cells: else its size on the grid would
    change by a cell from one approach to the next.
    """
    width = (high - low) / number
    if width <= size < math.inf:
        width = size / math.floor(size / width)
        first = middle - 0.5 * size
        low = first + width * math.floor((low - first) / width)
        number = math.ceil((high - low) / width)
    middles: Real = low + width * (np.arange(number, dtype=np.float64) + 0.5)
    return middles, width
