"""Two planes whose radial springs replace a bearing that also resists tilt, for programs without tilt.

Springs of half the radial stiffness K_r at e + h and e - h along the axis have the tilt stiffness
K_r (e^2 + h^2) and the coupling K_r e. So e, the load centre, is the coupling over K_r, and h^2 the tilt
stiffness over K_r less e^2.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.steady.impedance import FREEDOMS

_Y, _Z, _BY, _BZ = (FREEDOMS.index(name) for name in ("y", "z", "by", "bz"))


@dataclass(frozen=True)
class Planes:
    """Places of the two planes along X, the centre of the circle of balls at 0.

    Attributes
    ----------
    centre : float
        m: e, the load centre.
    half : float
        m: h, half their distance.
    """

    centre: float
    half: float

    @property
    def places(self) -> tuple[float, float]:
        """Both planes (m): e + h, e - h."""
        return self.centre + self.half, self.centre - self.half

    def equivalent(self, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the matrices (shape (..., 5, 5)) that springs or dampers in both planes have."""
        found = np.zeros_like(matrix)
        found[..., 0, 0] = matrix[..., 0, 0]
        half = 0.5 * matrix[..., _Y : _Z + 1, _Y : _Z + 1]
        for place in self.places:
            lever = np.eye(len(FREEDOMS))[_Y : _Z + 1]
            # at X the ring moves by y + bz X and z - by X
            lever[0, _BZ], lever[1, _BY] = place, -place
            found += lever.T @ half @ lever
        return found


def planes(matrix: NDArray[np.float64], mirrored: bool = False) -> Planes:
    """Return the planes of a static stiffness matrix; means of both directions where they differ.

    Parameters
    ----------
    matrix : ndarray, shape (5, 5)
    mirrored : bool
        Whether the bearing carries the other way: its planes are then on the other side.

    Raises
    ------
    ValueError
        Where no radial springs have so little tilt stiffness beside so much coupling.
    """
    radial = 0.5 * float(matrix[_Y, _Y] + matrix[_Z, _Z])
    tilt = 0.5 * float(matrix[_BY, _BY] + matrix[_BZ, _BZ])
    coupling = 0.25 * float(matrix[_Y, _BZ] + matrix[_BZ, _Y] - matrix[_Z, _BY] - matrix[_BY, _Z])
    if not radial > 0.0:
        raise ValueError("no two planes can replace this bearing: it has no radial stiffness")
    centre = coupling / radial
    square = tilt / radial - centre**2
    if not square > 0.0:
        raise ValueError(
            f"no two planes can replace this bearing: its tilt stiffness of {tilt:.4g} N m/rad is less "
            f"than the {radial * centre**2:.4g} N m/rad of radial springs at its load centre, "
            f"{1e3 * centre:.2f} mm from its centre"
        )
    return Planes(-centre if mirrored else centre, math.sqrt(square))


def mirrored_matrix(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return matrices (shape (..., 5, 5)) of the bearing that carries the other way: x and tilts reversed."""
    signs = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    return np.asarray(signs[:, None] * matrix * signs)


#: What `errors` returns, in order.
ERRORS = ("tilt stiffness", "coupling stiffness", "tilt damping", "coupling damping")


def errors(found: Planes, k: NDArray[np.float64], c: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what the planes have too much of tilt and coupling, over what the bearing has.

    Parameters
    ----------
    k, c : ndarray, shape (..., 5, 5)
        Stiffness and damping.

    Returns
    -------
    ndarray, shape (..., 4)
        In the order of `ERRORS`; of both directions the one that is further off.
    """
    columns = []
    for matrix in (k, c):
        other = found.equivalent(matrix)
        for pairs in (((_BZ, _BZ), (_BY, _BY)), ((_Y, _BZ), (_Z, _BY))):
            ways = np.stack([other[..., i, j] / matrix[..., i, j] - 1.0 for i, j in pairs])
            columns.append(np.take_along_axis(ways, np.abs(ways).argmax(axis=0)[None], axis=0)[0])
    return np.stack(columns, axis=-1)
