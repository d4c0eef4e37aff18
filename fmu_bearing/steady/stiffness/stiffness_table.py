"""Stiffness and damping of one bearing over speed, preload and frequency: numbers, and what follows."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.results.base import Result
from fmu_bearing.scene import Scene
from fmu_bearing.steady.stiffness.planes import Planes, arm, errors, mirrored_matrix, pairs, plane_matrices

Spacing = Literal["held", "free"]


@dataclass(frozen=True)
class StiffnessTable(Result):
    """Numbers of `BearingStiffness`, which adds files and a picture."""

    scene: Scene
    """Of the bearing alone."""
    speeds: NDArray[np.float64]
    """r/min, rising."""
    preloads: NDArray[np.float64]
    """N, rising: values of the input ``preload``, of a set of spacers or springs."""
    frequencies: NDArray[np.float64]
    """Hz, rising."""
    K: NDArray[np.float64]
    """N/m, N/rad, N m/rad. Shape (speed, preload, frequency, 5, 5)."""
    C: NDArray[np.float64]
    """That times s, the shape of K."""
    static: NDArray[np.float64]
    """K for frequency to 0, always of balls that keep their distances: what the bearing has at rest. Shape
    (speed, preload, 5, 5)."""
    orbit: NDArray[np.float64]
    """Hz: frequency of the balls' orbit, f_c. Shape (speed, preload)."""
    spread: NDArray[np.float64]
    """Largest distance of a single phase of a ball pitch from the mean, on the diagonal of K and C w, over K,
    at the lowest and the highest frequency; 0 for equal ball loads. Shape (speed, preload)."""
    steady: NDArray[np.bool_]
    """Whether the steady state was found; else the entries hold for the state in which a run starts. Shape
    (speed, preload)."""
    spacing: Spacing = "held"
    """``held``: balls keep their distances along the orbit, as in a cage; ``free``: they do not."""
    number: int = 1
    """From 1 at the nose."""
    sign: int = 1
    """1 where it carries force on the shaft towards +X, else -1."""
    on_shaft: bool = False
    """Whether it is one of a set."""

    @property
    def impedance(self) -> NDArray[np.complex128]:
        """K + i w C, shape (speed, preload, frequency, 5, 5)."""
        w = 2.0 * math.pi * self.frequencies
        return np.asarray(self.K + 1j * w[:, None, None] * self.C)

    def losses(self) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
        """Return loss over stiffness of five motions, the least first, and these motions.

        Eigenvalues and vectors of (Z - Z^H)/2i, with every force over the root of both stiffnesses; half of
        an eigenvalue times w is the power lost. Below 0 a whirl takes power from the turning shaft.

        Returns
        -------
        tuple of ndarray
            Shapes (speed, preload, frequency, 5) and (speed, preload, frequency, 5, 5), motions in columns.
        """
        z = self.impedance / pairs(self.K)
        values, vectors = np.linalg.eigh((z - np.conj(np.swapaxes(z, -1, -2))) / 2j)
        return np.asarray(values), np.asarray(vectors)

    def against_static(self) -> float:
        """Return the largest difference of K at the lowest frequency from `static`.

        Entries over the root of both diagonal ones.
        """
        return float(np.abs((self.K[:, :, 0] - self.static) / pairs(self.static)).max())

    def planes(self, preload: float | None = None, mirrored: bool = False) -> Planes:
        """Return three planes whose springs and dampers replace the bearing, tilt included; see ``planes``.

        `Planes.K` and `Planes.C` have the shape (3, speed, frequency, 3, 3). The planes are the same for
        all preloads.

        Parameters
        ----------
        preload : float, optional
            N: one of `preloads`; may be left out where there is one.
        mirrored : bool
            Whether the bearing carries the other way, as the rear one of a pair does.

        Raises
        ------
        ValueError
            For a preload that is not in the table, and where the bearing has no radial or tilt stiffness.
        """
        at, a = self.at_preload(preload), arm(self.static)
        k, c = (mirrored_matrix(one) if mirrored else one for one in (self.K[:, at], self.C[:, at]))
        return Planes(a, plane_matrices(k, a), plane_matrices(c, a))

    def plane_errors(self, preload: float | None = None) -> NDArray[np.float64]:
        """Return how far the three planes are from the bearing at the points of the table.

        Returns
        -------
        ndarray, shape (speed, frequency, 3)
            In the order of ``planes.ERRORS``: K + i w C over the root of both diagonal entries.
        """
        at, w = self.at_preload(preload), 2.0 * math.pi * self.frequencies
        return errors(self.planes(preload), self.K[:, at], self.C[:, at], w)

    def at_preload(self, preload: float | None) -> int:
        """Return the place of a preload (N) on its axis; ``ValueError`` for one that is not in the table."""
        listed = ", ".join(f"{value:g}" for value in self.preloads)
        if preload is None:
            if len(self.preloads) > 1:
                raise ValueError(f"the table has several preloads: give one of {listed} N")
            return 0
        near = np.flatnonzero(np.isclose(self.preloads, preload, rtol=1e-9))
        if near.size == 0:
            raise ValueError(f"preload = {preload:g} N is not in this table: it has {listed} N")
        return int(near[0])
