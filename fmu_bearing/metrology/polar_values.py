"""Synchronous and asynchronous error motion of one signal over whole revolutions.

The rows of a signal are its revolutions, its columns equal angles of the shaft from the first step on.
"""

import numpy as np
from numpy.typing import NDArray


def revolutions_of(signal: NDArray[np.float64], per_revolution: int) -> NDArray[np.float64]:
    """Return a signal as rows of revolutions, shape (revolutions, per_revolution)."""
    return signal.reshape(-1, per_revolution)


def asynchronous(rows: NDArray[np.float64]) -> float:
    """Largest width of the polar plot at any angle: the range over the revolutions."""
    return float(np.ptp(rows, axis=0).max())


def contour(mean: NDArray[np.float64], lowest: int) -> NDArray[np.float64]:
    """Return a contour over one revolution without what lies below the order ``lowest``.

    For a small contour on a large base circle, orders 0 and 1 are the circle of least squares: its radius and
    its centre.
    """
    lines = np.fft.rfft(mean)
    lines[:lowest] = 0.0
    return np.fft.irfft(lines, mean.size)


def synchronous(mean: NDArray[np.float64], lowest: int) -> float:
    """Range of a mean contour from the order ``lowest`` on."""
    return float(np.ptp(contour(mean, lowest)))


def fundamental(mean: NDArray[np.float64]) -> float:
    """Range of the first order of a mean contour: twice its amplitude."""
    return float(4.0 * np.abs(np.fft.rfft(mean)[1]) / mean.size)
