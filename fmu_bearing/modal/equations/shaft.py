"""Shaft, housing and sliding rings of a set: their matrices, and what ties the bearings along the axis.

A single bearing is a set without shaft: it has none of these coordinates.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import SP, P, Q
from fmu_bearing.prepare.spindle import in_housing


@dataclass(frozen=True)
class ShaftMatrices:
    """Matrices of shaft, housing and sliding rings, over their n coordinates; SI units.

    Attributes
    ----------
    mass, inverse : ndarray, shape (n, n)
        Without the driven rings; inverse of the mass with them.
    stiffness, damping : ndarray, shape (n, n)
        With pedestal, springs, and the gyroscopic effect at the speed in the damping.
    motions : tuple of ndarray, shape (rows, n)
        Driven rows of each bearing.
    inertia : tuple of ndarray, shape (rows,)
    nose : ndarray, shape (5, n)
    shaft_count : int
        How many coordinates are the shaft's own.
    housed : bool
        Whether six of a housing follow.
    signs, positions : ndarray
        Of the bearings, 1 or -1; m.
    """

    mass: NDArray[np.float64]
    inverse: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    damping: NDArray[np.float64]
    motions: tuple[NDArray[np.float64], ...]
    inertia: tuple[NDArray[np.float64], ...]
    nose: NDArray[np.float64]
    shaft_count: int
    housed: bool
    signs: NDArray[np.float64]
    positions: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of coordinates."""
        return len(self.mass)

    @property
    def total(self) -> NDArray[np.float64]:
        """Mass with the driven rings."""
        whole = self.mass.copy()
        for motion, mass in zip(self.motions, self.inertia, strict=True):
            whole += motion.T @ (mass[:, None] * motion)
        return whole


def rows_of(p: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Return the numbers ``SP.ROW_P`` and so on of each bearing from the parameters ``p`` of a set."""
    block = int(p[P.SET])
    first = block + int(p[block + SP.AT_ROWS])
    count = int(p[block + SP.BEARINGS])
    return [p[first + k * SP.ROW : first + (k + 1) * SP.ROW] for k in range(count)]


def matrices(run: Arrays, speed: float) -> ShaftMatrices:
    """Return the matrices of an initialised set at a speed of its shaft (rad/s)."""
    p, rows = run.p, rows_of(run.p)
    head = p[int(p[P.SET]) :]
    n, shaft, housed = int(head[SP.COUNT]), int(head[SP.SHAFT]), bool(head[SP.HOUSED])
    mass, inverse, stiffness, damping, gyroscopic = (
        _matrix(p, place, n, n)
        for place in (SP.AT_MASS, SP.AT_INVERSE, SP.AT_STIFFNESS, SP.AT_DAMPING, SP.AT_GYROSCOPIC)
    )
    if housed:
        own = run.s[int(head[SP.AT_S]) :]
        here = in_housing(1, float(head[SP.HOUSING_X]))
        six = slice(shaft, shaft + SP.HOUSING)
        stiffness[six, six] += here.T @ _pedestal(own[SP.PEDESTAL_STIFFNESS :]) @ here
        damping[six, six] += here.T @ _pedestal(own[SP.PEDESTAL_DAMPING :]) @ here
    motions, inertia = [], []
    for row in rows:
        first, count = int(row[SP.ROW_AT_T]), int(row[SP.ROW_DRIVEN])
        motions.append(p[first : first + SP.LANES * n].reshape(n, SP.LANES)[:, :count].T.copy())
        inertia.append(row[SP.ROW_MASS : SP.ROW_MASS + count].copy())
    return ShaftMatrices(
        mass, inverse, stiffness, damping + speed * gyroscopic, tuple(motions), tuple(inertia),
        _matrix(p, SP.AT_NOSE, n, SP.PLANE).T, shaft, housed,
        np.array([row[SP.ROW_SIGN] for row in rows]), np.array([row[SP.ROW_POSITION] for row in rows]),
    )  # fmt: skip


def _pedestal(numbers: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the matrix of a pedestal in its own plane, shape (6, 6), from ``SP.PEDESTAL_TERMS`` numbers."""
    stiffness = np.diag(numbers[: SP.HOUSING])
    stiffness[Q.Y, Q.Z] = stiffness[Q.Z, Q.Y] = numbers[SP.BETWEEN]
    return stiffness


def _matrix(p: NDArray[np.float64], place: int, rows: int, columns: int) -> NDArray[np.float64]:
    """Return a table of the block by its columns of padded rows."""
    block = int(p[P.SET])
    lanes, first = SP.padded_size(rows), block + int(p[block + place])
    return np.asarray(p[first : first + lanes * columns].reshape(columns, lanes)[:, :rows].T.copy())
