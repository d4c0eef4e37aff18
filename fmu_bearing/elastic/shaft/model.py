"""Matrices of a shaft in a few coordinates and how its planes move with them."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

FREEDOMS = 5  # of a plane: x y z (m), tilts about y and z (rad); spin is prescribed


def rigid_transform(sign: float, position: float) -> NDArray[np.float64]:
    """Return what takes a rigid body's displacement at X = 0 to that of a plane, shape (5, 5).

    ``sign``: -1 for the mirrored axes of a bearing that carries towards -X; ``position``: of the plane, m.
    """
    transform = np.diag([sign, 1.0, 1.0, sign, sign])
    transform[1, 4], transform[2, 3] = position, -position
    return transform


@dataclass(frozen=True)
class ShaftModel:
    """A shaft without its bearings and their rings, SI units, in fixed axes: X to the rear, Z up.

    The n coordinates need not be displacements of planes: ``nose`` and ``planes`` give these. The
    equations are ``mass a + (damping + speed gyroscopic) v + stiffness q = force``; ``loads`` of a plane come
    in as the transpose of its motion.

    Attributes
    ----------
    mass, damping, stiffness, gyroscopic : ndarray, shape (n, n)
        ``gyroscopic`` per rad/s of the shaft's speed.
    across : ndarray, shape (2, n)
        Force that an acceleration of 1 m/s2 along Y, and along Z, takes, kg.
    nose : ndarray, shape (5, n)
        x y z, tilts about y and z of the shaft at X = 0.
    planes : tuple of ndarray, shape (5, n)
        The same at each bearing.
    spots : tuple of ndarray, shape (5, n)
        The same at each heavy spot of the scene.
    polar : float
        Moment of inertia about the axis, kg m2.
    at : callable
        Motion of the plane at a distance (m) from the nose, shape (5, n); beyond the ends of the shaft that
        of a rigid extension. A force there comes in as its transpose, which is statically exact at the nose
        and at the bearings. Default: that of a rigid shaft.
    """

    mass: NDArray[np.float64]
    damping: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    gyroscopic: NDArray[np.float64]
    across: NDArray[np.float64]
    nose: NDArray[np.float64]
    planes: tuple[NDArray[np.float64], ...]
    spots: tuple[NDArray[np.float64], ...]
    polar: float
    at: Callable[[float], NDArray[np.float64]] = field(default=partial(rigid_transform, 1.0), compare=False)

    @property
    def count(self) -> int:
        """Number of coordinates."""
        return len(self.mass)

    @property
    def heavy(self) -> NDArray[np.float64]:
        """Force that an acceleration of 1 m/s2 along Z takes (kg), shape (n,); weight is -g times it."""
        return np.asarray(self.across[1])

    @property
    def tilts(self) -> NDArray[np.bool_]:
        """Which coordinates are tilts (rad) of the nose or of bearings, shape (n,); the others are in m."""
        turned = np.array([plane[3:] for plane in (self.nose, *self.planes)])
        return np.asarray(np.any(turned != 0.0, axis=(0, 1)))
