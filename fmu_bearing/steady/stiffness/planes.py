"""Springs and dampers in three planes that replace a bearing which resists tilt, for programs without tilt.

At the place s along the axis the ring moves by y + bz s and z - by s. Radial matrices k(s), 2 x 2, in planes
at -a, 0 and a therefore have the radial stiffness sum k, the coupling with tilt sum k s and the tilt
stiffness sum k s^2. Three planes have one solution for any three matrices R, W and T of a bearing:

    k(-a) = (T / a^2 - W / a) / 2,    k(0) = R - T / a^2,    k(a) = (T / a^2 + W / a) / 2.

So the planes stay where they are, and what they hold follows speed and frequency, below 0 too. The axial
stiffness is in the plane of the balls.

Any a is exact for a rigid piece of shaft. A real one bends between the planes, and gives way where the middle
one pushes: by R less T / a^2, which is much below 0 for planes close together. So a is the root of T / R at
rest (`arm`), the largest of a table. There the middle plane has nothing, and the outer ones share R as the
load centre W / R is between them, which it always is. One a serves all speeds, preloads and frequencies, and
a bearing that carries the other way.

Two things no such springs have. Their force from a tilt is their moment from a displacement, which friction
and spin of the balls make different in a bearing: W is the mean of both. And axial motion does not couple
with the others, as it does in a bearing whose balls carry unequal loads. `errors` states both.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.coordinates import FREEDOMS

_X, _Y, _Z, _BY, _BZ = (FREEDOMS.index(name) for name in ("x", "y", "z", "by", "bz"))
#: Motions aside and the slopes of the axis along them: y, z, bz, -by.
_ASIDE, _SIGNS = [_Y, _Z, _BZ, _BY], np.array([1.0, 1.0, 1.0, -1.0])


@dataclass(frozen=True)
class Planes:
    """What the three planes hold.

    Attributes
    ----------
    a : float
        m: from the centre of the circle of balls to the outer planes.
    K, C : ndarray, shape (3, ..., 3, 3)
        N/m, N s/m: stiffness and damping along x, y, z of each plane.
    """

    a: float
    K: NDArray[np.float64]
    C: NDArray[np.float64]

    @property
    def places(self) -> tuple[float, float, float]:
        """The planes along X (m), the centre of the circle of balls at 0."""
        return -self.a, 0.0, self.a


def arm(static: NDArray[np.float64]) -> float:
    """Return a (m) for stiffness matrices at rest, shape (..., 5, 5), rounded up to 0.1 mm.

    Raises
    ------
    ValueError
        Where one has no radial or no tilt stiffness.
    """
    size = np.diagonal(static, axis1=-2, axis2=-1)
    radial, tilt = size[..., _Y] + size[..., _Z], size[..., _BY] + size[..., _BZ]
    if not (np.all(radial > 0.0) and np.all(tilt > 0.0)):
        raise ValueError("no planes can replace this bearing: it has no radial or no tilt stiffness at rest")
    return 1e-4 * math.ceil(1e4 * math.sqrt(float(np.max(tilt / radial))))


def plane_matrices(matrix: NDArray[np.float64], a: float) -> NDArray[np.float64]:
    """Return what each plane holds of a bearing's stiffness or damping.

    Parameters
    ----------
    matrix : ndarray, shape (..., 5, 5)
    a : float
        m

    Returns
    -------
    ndarray, shape (3, ..., 3, 3)
        Along x, y, z, for the planes at -a, 0 and a.
    """
    aside = _SIGNS[:, None] * matrix[..., _ASIDE, :][..., _ASIDE] * _SIGNS
    coupling = 0.5 * (aside[..., :2, 2:] + aside[..., 2:, :2]) / a
    tilt = aside[..., 2:, 2:] / a**2
    by_plane = np.zeros((3, *matrix.shape[:-2], 3, 3))
    radial = by_plane[..., 1:, 1:]
    radial[0], radial[2] = 0.5 * (tilt - coupling), 0.5 * (tilt + coupling)
    radial[1] = aside[..., :2, :2] - tilt
    by_plane[1, ..., 0, 0] = matrix[..., _X, _X]
    return by_plane


def sum_of_planes(matrices: NDArray[np.float64], a: float) -> NDArray[np.float64]:
    """Return the sum (shape (..., 5, 5)) of ``matrices``, which `plane_matrices` returns."""
    matrix = np.zeros((*matrices.shape[1:-2], len(FREEDOMS), len(FREEDOMS)))
    for place, one in zip((-a, 0.0, a), matrices, strict=True):
        lever = np.eye(len(FREEDOMS))[: _Z + 1]
        lever[_Y, _BZ], lever[_Z, _BY] = place, -place
        matrix += lever.T @ one @ lever
    return matrix


def mirrored_matrix(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return matrices (shape (..., 5, 5)) of the bearing that carries the other way: x and tilts reversed."""
    signs = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    return np.asarray(signs[:, None] * matrix * signs)


def pairs(matrix: NDArray[np.float64] | NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return for each entry the root of both diagonal ones, the measure of what is small; 1 for none."""
    size = np.sqrt(np.abs(np.diagonal(matrix, axis1=-2, axis2=-1)))
    size = np.where(size > 0.0, size, 1.0)
    return np.asarray(size[..., :, None] * size[..., None, :])


#: What `errors` returns, in order.
ERRORS = ("radial and tilt", "coupling", "axial coupling")


def errors(
    matrices: Planes, k: NDArray[np.float64], c: NDArray[np.float64], w: NDArray[np.float64]
) -> NDArray[np.float64]:  # fmt: skip
    """Return how far K + i w C of the planes is from the bearing's, over the root of both diagonal entries.

    Parameters
    ----------
    k, c : ndarray, shape (..., frequency, 5, 5)
        Stiffness and damping.
    w : ndarray, shape (frequency,)
        rad/s.

    Returns
    -------
    ndarray, shape (..., frequency, 3)
        In the order of `ERRORS`, the largest entry of each: in the diagonal blocks of x, of y and z, and of
        the tilts; in the coupling of y and z with the tilts; and in the coupling of x with all others.
    """
    i_w = 1j * w[:, None, None]
    off = sum_of_planes(matrices.K, matrices.a) - k + i_w * (sum_of_planes(matrices.C, matrices.a) - c)
    off = np.abs(off) / pairs(k + i_w * c)
    kind = np.array([0, 1, 1, 2, 2])  # axial, radial, tilt
    same = kind[:, None] == kind
    axial = ~same & ((kind[:, None] == 0) | (kind == 0))
    return np.stack([off[..., which].max(axis=-1) for which in (same, ~same & ~axial, axial)], axis=-1)
