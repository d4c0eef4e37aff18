"""Amplitudes of lines at known orders, by least squares over whole revolutions.

An average over revolutions takes for synchronous what lies nearer to a whole order than one over their
number. A fit of lines at their own orders does not: it parts them by their phase, which drifts.

The equations of the fit are sums of cosines and sines over equally spaced points, which have closed forms.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from fmu_bearing.acoustics.analysis.origins import Origin

#: Weight that draws amplitudes to zero, times the square of a line's terms: lines that the revolutions
#: cannot part share what is there, the simpler ones take more. Where they can be parted it moves an
#: amplitude by a millionth.
_PULL = 1e-6
_CHUNK = 4096  # points at a time: the exponentials of all lines at all points would fill the memory


class LineFit:
    """Equations of a fit of lines to signals over whole revolutions, factorised once.

    Parameters
    ----------
    lines : sequence of Origin
        A constant is fitted beside them.
    revolutions, per_revolution : int
        The signals have their product of points, the first of them one step after angle 0. Lines above half
        the points per revolution are fitted too: at a known order a line and its fold are the same values.
    """

    def __init__(self, lines: Sequence[Origin], revolutions: int, per_revolution: int) -> None:
        self.lines = tuple(lines)
        self.orders: NDArray[np.float64] = np.array([0.0, *(line.order for line in lines)])
        self.per_revolution, self.points = per_revolution, revolutions * per_revolution
        weights = np.array([0.0, *(1.0 if line.bearing == 0 else float(line.terms) ** 2 for line in lines)])
        matrix = self._matrix()
        matrix[np.diag_indices_from(matrix)] += _PULL * np.concatenate([weights, weights[1:]])
        self._factor = cho_factor(matrix)

    def amplitudes(self, signals: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Return the constant and the complex amplitude A of each line: the real part of A e^(i order angle).

        ``signals``: shape (points, channels); returns shape (1 + lines, channels).
        """
        sums = np.zeros((len(self.orders), signals.shape[1]), dtype=complex)
        for part, angle in self._parts():
            sums += np.exp(-1j * self.orders[:, None] * angle) @ signals[part]
        sums /= self.points
        solution = cho_solve(self._factor, np.concatenate([sums.real, -sums.imag[1:]]))
        count = len(self.orders)
        amplitudes: NDArray[np.complex128] = solution[:count].astype(complex)
        amplitudes[1:] -= 1j * solution[count:]
        return amplitudes

    def signals(self, amplitudes: NDArray[np.complex128], chosen: NDArray[np.int_]) -> NDArray[np.float64]:
        """Return the sum of some lines (their places among ``lines``), shape (points, channels)."""
        signals = np.empty((self.points, amplitudes.shape[1]))
        orders, those = self.orders[chosen + 1], amplitudes[chosen + 1]
        for part, angle in self._parts():
            signals[part] = np.real(np.exp(1j * angle[:, None] * orders) @ those)
        return signals

    def growth(self, chosen: NDArray[np.int_]) -> NDArray[np.float64]:
        """Return by how much neighbours let noise grow in some lines' amplitudes; 1: a lone line."""
        count = len(self.orders)
        places = np.concatenate([chosen + 1, chosen + count])
        units = np.zeros((2 * count - 1, len(places)))
        units[places, np.arange(len(places))] = 1.0
        inverse = cho_solve(self._factor, units)[places, np.arange(len(places))].reshape(2, -1)
        # a line alone has the inverse of 1/2 in both of its parts
        return np.sqrt(0.25 * inverse.sum(axis=0))

    def _parts(self) -> list[tuple[slice, NDArray[Any]]]:
        """Return runs of points with their angles (rad)."""
        step = 2.0 * np.pi / self.per_revolution
        return [
            (slice(first, last), step * np.arange(first + 1, last + 1))
            for first in range(0, self.points, _CHUNK)
            for last in (min(first + _CHUNK, self.points),)
        ]

    def _matrix(self) -> NDArray[np.float64]:
        """Return the mean products of cosines and sines of all lines, the constant first."""
        less = self._mean(self.orders[:, None] - self.orders)
        more = self._mean(self.orders[:, None] + self.orders)
        cosines = 0.5 * (less.real + more.real)
        sines = 0.5 * (less.real - more.real)[1:, 1:]
        mixed = 0.5 * (more.imag - less.imag)[:, 1:]
        return np.block([[cosines, mixed], [mixed.T, sines]])

    def _mean(self, orders: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Return the mean of e^(i order angle) over the points: a geometric series."""
        half = np.pi * orders / self.per_revolution
        below = np.sin(half)
        # at order 0 and at multiples of the points per revolution every term is 1
        near = np.abs(below) < 1e-12
        ratio = np.sin(half * self.points) / np.where(near, 1.0, below * self.points)
        return np.where(near, 1.0, ratio * np.exp(1j * half * (self.points + 1)))
