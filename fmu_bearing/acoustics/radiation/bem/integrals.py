"""Boundary integrals over the line elements, for all circumferential orders at once.

The kernel exp(-j k R) / (4 pi R) is split into 1/R - k^2 R / 2, whose harmonics are closed forms
(`engine.boundary_elements`) and hold for every frequency, and a remainder that is smooth enough for a plain
trapezoidal rule round the circle and Gauss points along the element. The closed part carries the
singularity; it is integrated once per mesh, with intervals that shrink towards the field point.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.bem.meridian import NODES, Mesh
from fmu_bearing.compiled.load import call
from fmu_bearing.engine.boundary_elements.closed_part import KINDS
from fmu_bearing.engine.boundary_elements.remainder import ROWS
from fmu_bearing.engine.layout import FOUR

_FAR_POINTS, _NEAR_POINTS = 4, 8  # of the closed part, per element or interval of it
_PLAIN_POINTS = 2  # of the smooth remainder, per element: 3e-4 of it at six elements per wavelength


@lru_cache
def _gauss(count: int) -> NDArray[np.float64]:
    """Gauss points and weights on [0, 1], shape (2, count); read only."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    rule = np.array([0.5 * (1.0 + nodes), 0.5 * weights])
    rule.flags.writeable = False
    return rule


def _basis(at: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lagrange polynomials of the collocation points at places on [0, 1], shape (NODES, n)."""
    nodes = _gauss(NODES)[0]
    return np.array([np.prod([(at - c) / (b - c) for c in nodes if c != b], axis=0) for b in nodes]).reshape(
        NODES, -1
    )


def _azimuths(orders: int, turns: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """1 - cos phi at ``turns`` + 1 azimuths from 0 to pi, and weights (orders, azimuths) of their sums.

    The weights are those of the trapezoidal rule times cos(m phi) / (4 pi); zeros fill rows up.
    """
    phi = np.pi * np.arange(turns + 1) / turns
    width = -(-len(phi) // FOUR) * FOUR
    less, weights = np.zeros(width), np.zeros((orders, width))
    less[: turns + 1] = 1.0 - np.cos(phi)
    parts = np.full(turns + 1, 2.0 / (4.0 * turns))
    parts[[0, -1]] *= 0.5
    weights[:, : turns + 1] = parts * np.cos(np.arange(orders)[:, None] * phi)
    return less, weights


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
        self._sources = [(own.astype(float), mesh.ends, mesh.normals)]
        if plane is not None:
            ends, normals = mesh.ends.copy(), mesh.normals.copy()
            ends[:, 0::2] = 2.0 * plane - ends[:, 0::2]
            normals[:, 0] *= -1.0
            self._sources.append((np.full(len(own), -1.0), ends, normals))
        total = np.zeros((KINDS, len(points), len(mesh.ends), NODES, orders))
        rules = _gauss(_FAR_POINTS), _gauss(_NEAR_POINTS), _gauss(NODES)[0]
        for on, ends, normals in self._sources:
            work = np.zeros(5 * (orders + 2))
            call("closed_part", points, on, ends, normals, *rules, work, total, orders)
        flat = total.reshape(KINDS, len(points), -1, orders)
        self._closed = np.ascontiguousarray(np.moveaxis(flat, 3, 1))
        self._reach = max(float(points[:, 1].max()), float(mesh.ends[:, 1::2].max()))

    def __call__(self, k: float) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Single and double layer matrices at wavenumber ``k`` (1/m), shape (orders, points, nodes) each.

        Entry m, i, n is the integral of cos(m phi) exp(-jkR) / (4 pi R), or of its derivative along the
        source's normal, times the n-th shape function, over the surface.
        """
        out = np.zeros((2, *self._closed.shape[1:]), dtype=complex)
        turns = int(np.ceil(k * self._reach)) + self._orders + 10
        less, weights = _azimuths(self._orders, turns)
        rule, work = _gauss(_PLAIN_POINTS), np.zeros(ROWS * len(less))
        for on, ends, normals in self._sources:
            of_element = (on, ends, normals, rule, _basis(rule[0]))
            call("remainder", self._points, *of_element, less, weights, work, out.view(float), k)
        for kind, layer in enumerate(out):
            for order, matrix in enumerate(layer):  # one by one: whole arrays are large
                matrix += self._closed[kind, order]
                matrix -= 0.5 * k**2 * self._closed[2 + kind, order]
        return out[0], out[1]
