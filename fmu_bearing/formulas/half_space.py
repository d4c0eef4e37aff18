"""Frictionless contact of two elastic half-spaces whose gap is given at each point of a plane.

Pressures p >= 0 on a grid of rectangles, each constant, so that

    gap + u(p) >= 0,    p (gap + u(p)) = 0,    u = 2/(pi E') int p/r dA,

where ``gap`` is that of the undeformed bodies at a given approach, below zero where they overlap. Conjugate
gradients with projection (Polonsky and Keer, Wear 231 (1999) 206), here at a fixed approach; influence of a
rectangle by Love (1929), summed by Fourier transforms over a grid of twice the size, on which nothing wraps
round (from memory: Liu, Wang and Liu, Wear 243 (2000) 101). The inverse of the influence of all cells, by the
same transforms, preconditions the steps (from memory: Vollebregt, J. Comput. Phys. 257 (2014) 333): half as
many.

The pressures are those of least complementary energy V = int p (u/2 + gap) dA, and U = -V is the energy that
the contact stores. Its slopes come with the pressures: dU/d(approach) is the load, and with a gap that moves
dU = -int p d(gap) dA. On a grid both are exact, too.
"""

import math
from typing import NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

Real = NDArray[np.float64]

#: Part of int p |gap| dA to which int p |gap + u| dA has to fall, and of the overlap that may be left.
TOLERANCE = 1e-4  # loads are then as exact, and energies within 1e-6
_MOST = 500  # steps; contacts of balls with pits take 10 to 20
_SMALLEST = 1e-4  # of a transform over its largest part: below, it is rounding and ends of the grid


class Grid(NamedTuple):
    """Influence of the cells of a grid on each other.

    Attributes
    ----------
    shape : tuple
        Cells along x and y.
    area : float
        Of a cell (m2).
    spectrum : array
        Transform of the displacement by one cell under 1 Pa (m/Pa), real, as the cell is symmetric.
    inverse : array
        One over it.
    double : tuple
        Length of the transforms along x and y.
    """

    shape: tuple[int, int]
    area: float
    spectrum: Real
    inverse: Real
    double: tuple[int, int]

    def displaced(self, pressure: Real) -> Real:
        """Displacements (m) of all cells by pressures (Pa)."""
        return self._convolved(pressure, self.spectrum)

    def pressed(self, displacement: Real) -> Real:
        """Pressures (Pa) that nearly make displacements (m), which are taken as 0 round the grid."""
        return self._convolved(displacement, self.inverse)

    def _convolved(self, values: Real, spectrum: Real) -> Real:
        (rows, columns), (long, wide) = self.shape, self.double
        # half of the doubled grid is empty before, and not wanted afterwards
        there = scipy.fft.rfft(values, wide, axis=1)
        there = scipy.fft.fft(there, long, axis=0, overwrite_x=True)
        there *= spectrum
        back = scipy.fft.ifft(there, axis=0, overwrite_x=True)[:rows]
        return scipy.fft.irfft(back, wide, axis=1, overwrite_x=True)[:, :columns]


class Contact(NamedTuple):
    """Pressures (Pa) on the grid, load (N), stored energy (J), and steps it took."""

    pressure: Real
    load: float
    energy: float
    steps: int


def love(x: Real, y: Real, dx: float, dy: float, modulus: float) -> Real:
    """Displacement (m) at x, y from the middle of a rectangle dx by dy (m) under 1 Pa; E' in Pa.

    Love, Phil. Trans. A 228 (1929) 377: the integral of 1/r over the rectangle in closed form.
    """

    def corner(p: Real, q: Real) -> Real:
        return p * np.arcsinh(q / np.abs(p)) + q * np.arcsinh(p / np.abs(q))

    # a point on the line of a side is moved off it by what changes no digit
    tiny = 1e-14 * (dx + dy)
    left, right = (np.where(side == 0.0, tiny, side) for side in (x - dx / 2, x + dx / 2))
    low, high = (np.where(side == 0.0, tiny, side) for side in (y - dy / 2, y + dy / 2))
    whole = corner(right, high) + corner(left, low) - corner(right, low) - corner(left, high)
    return 2.0 / (math.pi * modulus) * whole


def grid(rows: int, columns: int, dx: float, dy: float, modulus: float) -> Grid:
    """Grid of cells dx by dy (m) along x and y, on half-spaces of E' (Pa)."""
    double = (_length(rows), _length(columns))
    # even in both directions: a quarter is computed, and mirrored round the doubled grid
    near = [np.minimum(np.arange(n), n - np.arange(n)) for n in double]
    quarter = love(
        dx * np.arange(double[0] // 2 + 1.0)[:, None], dy * np.arange(double[1] // 2 + 1.0), dx, dy, modulus
    )
    spectrum = scipy.fft.rfft2(quarter[near[0][:, None], near[1]]).real
    inverse = 1.0 / np.maximum(spectrum, _SMALLEST * spectrum.max())
    return Grid((rows, columns), dx * dy, np.ascontiguousarray(spectrum), inverse, double)


def _length(cells: int) -> int:
    """Length of a transform over a doubled grid that is computed fast."""
    return int(scipy.fft.next_fast_len(2 * cells - 1, real=True))


def solve(gap: Real, on: Grid, start: Real | None = None, tolerance: float = TOLERANCE) -> Contact:
    """Contact of bodies with a gap (m) before they deform, below zero where they overlap.

    Parameters
    ----------
    gap : array of the grid's shape
        m, at the middle of each cell.
    on : Grid
    start : array, optional
        Pressures (Pa) to start from, as those of a contact nearby.
    tolerance : float
        As `TOLERANCE`.

    Raises
    ------
    ValueError
        For a gap of another shape, or that is not finite.
    ArithmeticError
        Where the steps do not converge.
    """
    if gap.shape != on.shape or not np.isfinite(gap).all():
        raise ValueError(f"gap of {gap.shape} cells on a grid of {on.shape}: give finite gaps of this shape")
    overlap = -float(gap.min())
    if overlap <= 0.0:
        return Contact(np.zeros(on.shape), 0.0, 0.0, 0)
    together = float(on.spectrum.max())  # m/Pa: if all cells are pressed
    pressure = np.array(start) if start is not None else np.zeros(on.shape)
    if not pressure.any():
        pressure = np.maximum(-gap - 0.5 * overlap, 0.0) / together
    left = on.displaced(pressure) + gap
    path, before, held = np.zeros(on.shape), 0.0, np.zeros(on.shape)
    for step in range(_MOST):
        touching = pressure > 0.0
        wrong = float(np.vdot(pressure, np.abs(left)))
        free = float(left.min(where=~touching, initial=0.0))
        if wrong <= -tolerance * float(np.vdot(pressure, gap)) and -free <= 10.0 * tolerance * overlap:
            load = float(pressure.sum()) * on.area
            energy = -0.5 * float(np.vdot(pressure, left + gap)) * on.area
            return Contact(pressure, load, energy, step)
        last, held = held, np.where(touching, left, 0.0)
        wanted = np.where(touching, on.pressed(held), 0.0)
        size = float(np.vdot(held, wanted))
        # after a change of the cells that touch the step is that of steepest descent
        keep = max(0.0, (size - float(np.vdot(last, wanted))) / before) if before > 0.0 else 0.0
        path = np.where(touching, keep * path, 0.0) + wanted
        bent = on.displaced(path)
        curved = float(np.vdot(path, bent))
        length = float(np.vdot(held, path)) / curved if curved > 0.0 else 0.0
        pressure = pressure - length * path
        drawn = pressure < 0.0
        pressure[drawn] = 0.0
        new = (pressure == 0.0) & (left < 0.0) & ~touching
        # new cells begin with less than they need: more would lift the bodies off each other
        pressure[new] = -left[new] / together
        if new.any() or drawn.any():
            left = on.displaced(pressure) + gap
        else:
            left = left - length * bent
        before = 0.0 if new.any() else size
    raise ArithmeticError(
        f"contact on {on.shape[0]} x {on.shape[1]} cells, overlap {1e6 * overlap:.3g} um: no solution after "
        f"{_MOST} steps; give a smoother gap or a coarser grid"
    )
