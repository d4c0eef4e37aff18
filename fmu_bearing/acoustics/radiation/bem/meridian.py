"""Bodies of revolution by their meridian: contours, and their division into line elements."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]

NODES = 2  # collocation points per element, at Gauss points: corners never are one
_GRADING = 0.35  # length of a side's outermost elements over its largest ones: pressure bends at edges


@dataclass(frozen=True)
class Body:
    """A rigid or flexing body of revolution.

    Attributes
    ----------
    name : str
        As people call it, for messages.
    contour : ndarray, shape (n, 2)
        Corners (x, r) in m, the body on the right-hand side when one walks along it in the (x, r) plane
        with x to the right and r upwards. A contour that ends where it began is a ring; one whose two ends
        lie on the axis is a body without a bore.
    sides : tuple of int
        Moving component of each side, 0 inner ring, 1 outer ring, 2 cage.
    """

    name: str
    contour: Points
    sides: tuple[int, ...]

    @property
    def closed(self) -> bool:
        """Whether the contour is a ring's."""
        return bool(np.allclose(self.contour[0], self.contour[-1], atol=1e-12))

    def polygon(self) -> Points:
        """Corners of the section between contour and axis, shape (n, 2)."""
        return self.contour[:-1] if self.closed else self.contour

    def contains(self, points: Points) -> NDArray[np.bool_]:
        """Whether points of the meridian plane, shape (n, 2), lie inside the body; shape (n,)."""
        corners = self.polygon()
        x1, r1 = corners[:, 0], corners[:, 1]
        x2, r2 = np.roll(x1, -1), np.roll(r1, -1)
        x, r = points[:, :1], points[:, 1:]
        crossing = (r1 > r) != (r2 > r)
        with np.errstate(divide="ignore", invalid="ignore"):
            at = x1 + (r - r1) * (x2 - x1) / (r2 - r1)
        return np.count_nonzero(crossing & (x < at), axis=1) % 2 == 1

    def distance(self, points: Points) -> NDArray[np.float64]:
        """Distances (m) of points, shape (n, 2), from the contour."""
        first, along = self.contour[:-1], np.diff(self.contour, axis=0)
        offset = points[:, None, :] - first
        place = np.clip((offset * along).sum(axis=2) / (along**2).sum(axis=1), 0.0, 1.0)
        left = offset - place[:, :, None] * along
        return np.sqrt((left**2).sum(axis=2)).min(axis=1)


@dataclass(frozen=True)
class Mesh:
    """Straight line elements of all bodies, and the collocation points on them.

    Attributes
    ----------
    ends : ndarray, shape (elements, 4)
        x, r of the first and x, r of the second end, m.
    normals : ndarray, shape (elements, 2)
        Unit normals (x, r), out of the body.
    component : ndarray of int, shape (elements,)
    points : ndarray, shape (elements * NODES, 2)
        Collocation points (x, r), m, element by element.
    """

    ends: Points
    normals: Points
    component: NDArray[np.int64]
    points: Points

    @property
    def size(self) -> int:
        """Number of collocation points."""
        return len(self.points)

    def node_normals(self) -> Points:
        """Return normals at the collocation points, shape (nodes, 2)."""
        return np.repeat(self.normals, NODES, axis=0)

    def node_component(self) -> NDArray[np.int64]:
        """Return the moving component at the collocation points, shape (nodes,)."""
        return np.repeat(self.component, NODES)


def mesh_of(
    bodies: Sequence[Body], size: float, finest: float | None = None, source: Points | None = None
) -> Mesh:
    """Divide bodies into elements of at most ``size`` m, finer towards the ends of every side.

    Sides that face another body get elements no longer than their distance from it, but no shorter than
    ``finest`` (m; by default ``size``), and sides near a ``source`` (x, r in m) no longer than half their
    distance from it.
    """
    ends, component = [], []
    for body in bodies:
        others = [other for other in bodies if other is not body]
        for k, moving in enumerate(body.sides):
            first, last = body.contour[k], body.contour[k + 1]
            samples = first + np.linspace(0.0, 1.0, 9)[:, None] * (last - first)
            gap = min((float(other.distance(samples).min()) for other in others), default=size)
            here = min(size, max(finest or size, gap))
            if source is not None:
                near = np.linspace(0.0, 1.0, 41)[:, None] * (last - first) + first - source
                here = min(here, 0.5 * float(np.hypot(near[:, 0], near[:, 1]).min()))
            cuts = _divide(float(np.hypot(*(last - first))), here)[:, None]
            places = first + cuts * (last - first)
            ends.append(np.hstack([places[:-1], places[1:]]))
            component += [moving] * (len(places) - 1)
    table = np.vstack(ends)
    along = table[:, 2:] - table[:, :2]
    length = np.hypot(along[:, 0], along[:, 1])[:, None]
    normals = np.stack([-along[:, 1], along[:, 0]], axis=1) / length
    nodes, _ = np.polynomial.legendre.leggauss(NODES)
    points = table[:, None, :2] + 0.5 * (1.0 + nodes)[None, :, None] * along[:, None, :]
    return Mesh(table, normals, np.array(component, dtype=np.int64), points.reshape(-1, 2))


def _divide(length: float, size: float) -> Points:
    """Places from 0 to 1 that divide a side of ``length`` into graded elements; a short one stays whole."""
    count = max(2 if length > 0.5 * size else 1, int(np.ceil(length / size * 1.2)))
    middle = np.sin(np.pi * (np.arange(count) + 0.5) / count)
    widths = np.maximum(middle, _GRADING)
    return np.concatenate([[0.0], np.cumsum(widths) / widths.sum()])


def ring(name: str, component: int, outer: float, inner: float, low: float, high: float) -> Body:
    """Ring of rectangular section: diameters ``outer`` and ``inner``, from x = ``low`` to ``high``, m."""
    a, b = 0.5 * inner, 0.5 * outer
    contour = np.array([[low, a], [low, b], [high, b], [high, a], [low, a]])
    return Body(name, contour, (component,) * 4)


def cylinder(name: str, component: int, diameter: float, low: float, high: float) -> Body:
    """Solid cylinder about the axis from x = ``low`` to ``high``, m."""
    a = 0.5 * diameter
    contour = np.array([[low, 0.0], [low, a], [high, a], [high, 0.0]])
    return Body(name, contour, (component,) * 3)
