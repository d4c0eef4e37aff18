"""Boundary integrals over the line elements, for all circumferential orders at once.

The kernel exp(-j k R) / (4 pi R) is split into 1/R - k^2 R / 2, whose harmonics are closed forms
(`ring_potential`) and hold for every frequency, and a remainder that is smooth enough for a plain
trapezoidal rule round the circle and Gauss points along the element. The closed part carries the
singularity; it is integrated once per mesh, with intervals that shrink towards the field point.
"""

import functools
import math
import threading
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.bem.meridian import NODES, Mesh
from fmu_bearing.acoustics.radiation.bem.remainder import remainder
from fmu_bearing.acoustics.radiation.bem.ring_potential import static_harmonics
from fmu_bearing.files import cache_root, own_folder

_NEAR = 2.0  # element lengths within which an element is cut into shrinking intervals
_SHRINK = 0.2  # of each interval against the one before
_SMALLEST = 1e-6  # of the element's length: what is left out weighs 1e-6 log(1e6)
_FAR_POINTS, _NEAR_POINTS = 4, 8
_PLAIN_POINTS = 3  # of the smooth remainder, per element
_FOUR_PI = 4.0 * math.pi
_wrapping = threading.Lock()


def _compiled_once(function):
    """Compile a function, once for all threads, and keep it where the engine's kernels are."""
    with _wrapping:
        return _wrapped(function)


@functools.cache
def _wrapped(function):
    settings: Any = numba.config
    before = settings.CACHE_DIR
    # Numba reads the folder when the function is wrapped; the process's own setting is put back
    settings.CACHE_DIR = str(own_folder(cache_root() / "integrals"))
    try:
        return numba.njit(nogil=True, error_model="numpy", cache=True)(function)
    finally:
        settings.CACHE_DIR = before


def _gauss(count: int) -> NDArray[np.float64]:
    """Gauss points and weights on [0, 1], shape (2, count)."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return np.array([0.5 * (1.0 + nodes), 0.5 * weights])


def _basis(at: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lagrange polynomials of the collocation points at places on [0, 1], shape (NODES, n)."""
    nodes = _gauss(NODES)[0]
    return np.array([np.prod([(at - c) / (b - c) for c in nodes if c != b], axis=0) for b in nodes]).reshape(
        NODES, -1
    )


@numba.njit(nogil=True, error_model="numpy")
def _interval(x, r, ends, normal, a, b, flat, rule, nodes, orders, work, block):
    """Add the part of an element between a and b (places on [0, 1]) to ``block`` (4, NODES, orders)."""
    length = math.hypot(ends[2] - ends[0], ends[3] - ends[1])
    for g in range(rule.shape[1]):
        t = a + (b - a) * rule[0, g]
        weight = (b - a) * rule[1, g] * length
        sx = ends[0] + t * (ends[2] - ends[0])
        sr = ends[1] + t * (ends[3] - ends[1])
        static_harmonics(
            sx - x, r, sr, normal[0], normal[1], flat, orders, work[0], work[1], work[2], work[3], work[4]
        )
        for n in range(len(nodes)):
            value = weight * sr / _FOUR_PI
            for other in range(len(nodes)):
                if other != n:
                    value *= (t - nodes[other]) / (nodes[n] - nodes[other])
            for kind in range(4):
                for m in range(orders):
                    block[kind, n, m] += value * work[kind + 1, m]


@numba.njit(nogil=True, error_model="numpy")
def _side(x, r, ends, normal, from_, to, smallest, flat, rule, nodes, orders, work, block):
    """Cut the stretch from the place nearest the field point to an end into growing intervals."""
    far = abs(to - from_)
    if far <= 0.0:
        return
    edge = far
    while edge > 0.0:
        inner = edge * _SHRINK
        if edge <= smallest or inner < smallest:
            inner = 0.0
        if to > from_:
            _interval(x, r, ends, normal, from_ + inner, from_ + edge, flat, rule, nodes, orders, work, block)
        else:
            _interval(x, r, ends, normal, from_ - edge, from_ - inner, flat, rule, nodes, orders, work, block)
        edge = inner


def _static(points, own, ends, normals, far_rule, near_rule, nodes, orders, out):
    """Fill ``out`` (4, points, elements, NODES, orders) with the closed parts."""
    for i in range(len(points)):
        work = np.zeros((5, orders + 2))
        x = points[i, 0]
        r = points[i, 1]
        for e in range(len(ends)):
            dx = ends[e, 2] - ends[e, 0]
            dr = ends[e, 3] - ends[e, 1]
            length = math.hypot(dx, dr)
            t = ((x - ends[e, 0]) * dx + (r - ends[e, 1]) * dr) / length**2
            t = min(max(t, 0.0), 1.0)
            gap = math.hypot(ends[e, 0] + t * dx - x, ends[e, 1] + t * dr - r)
            block = out[:, i, e]
            flat = own[i] == e
            if gap > _NEAR * length:
                _interval(x, r, ends[e], normals[e], 0.0, 1.0, flat, far_rule, nodes, orders, work, block)
                continue
            smallest = max(_SMALLEST, 0.3 * gap / length)
            _side(x, r, ends[e], normals[e], t, 0.0, smallest, flat, near_rule, nodes, orders, work, block)
            _side(x, r, ends[e], normals[e], t, 1.0, smallest, flat, near_rule, nodes, orders, work, block)


class Potentials:
    """Single and double layer potentials of a mesh at given field points, for any frequency.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        Field points (x, r), m; r = 0 is moved off the axis by a nanometre.
    own : ndarray of int, shape (n,)
        Element on which a point lies, -1 for none.
    mesh : Mesh
    orders : int
        Circumferential orders 0 .. orders - 1; at least 2.
    plane : float, optional
        Axial place (m) of a rigid plane normal to the axis: images are added.
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        own: NDArray[np.int64],
        mesh: Mesh,
        orders: int,
        plane: float | None = None,
    ) -> None:
        points = np.array(points, dtype=float)
        points[:, 1] = np.maximum(points[:, 1], 1e-9)
        self._points, self._orders = points, orders
        self._sources = [(own, mesh.ends, mesh.normals)]
        if plane is not None:
            ends, normals = mesh.ends.copy(), mesh.normals.copy()
            ends[:, 0::2] = 2.0 * plane - ends[:, 0::2]
            normals[:, 0] *= -1.0
            self._sources.append((np.full_like(own, -1), ends, normals))
        shape = (4, len(points), len(mesh.ends), NODES, orders)
        total = np.zeros(shape)
        for on, ends, normals in self._sources:
            part = np.zeros(shape)
            _compiled_once(_static)(
                points, on, ends, normals, _gauss(_FAR_POINTS), _gauss(_NEAR_POINTS), _gauss(NODES)[0],
                orders, part,
            )  # fmt: skip
            total += part
        flat = total.reshape(4, len(points), -1, orders)
        self._closed = np.ascontiguousarray(np.moveaxis(flat, 3, 1))
        self._reach = max(float(points[:, 1].max()), float(mesh.ends[:, 1::2].max()))

    def __call__(self, k: float) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Single and double layer matrices at wavenumber ``k`` (1/m), shape (orders, points, nodes) each.

        Entry m, i, n is the integral of cos(m phi) exp(-jkR) / (4 pi R), or of its derivative along the
        source's normal, times the n-th shape function, over the surface.
        """
        out = np.zeros((2, *self._closed.shape[1:]), dtype=complex)
        turns = int(np.ceil(k * self._reach)) + self._orders + 10
        cosines = np.cos(np.arange(max(self._orders, 2))[:, None] * np.pi * np.arange(turns + 1) / turns)
        rule = _gauss(_PLAIN_POINTS)
        for on, ends, normals in self._sources:
            _compiled_once(remainder)(self._points, on, ends, normals, rule, _basis(rule[0]), cosines, k, out)
        out += self._closed[:2]
        out -= 0.5 * k**2 * self._closed[2:]
        return out[0], out[1]
