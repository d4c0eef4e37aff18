"""Frequencies at which transfer functions are evaluated and fitted, and interpolation between them."""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

BAND = (20.0, 20_000.0)  # Hz: hearing, and where filters follow their transfer functions
STOP = 22_000.0  # Hz: from here on nothing is heard, see `filters.fir.band_limit`


def fit_frequencies() -> NDArray[np.float64]:
    """Frequencies in Hz at which transfer functions are evaluated and fitted, shape (n,)."""
    low, high = BAND
    return np.concatenate(
        [np.geomspace(low, 1000.0, 50, endpoint=False), np.arange(1000.0, high + 1.0, 62.5)]
    )


def between(
    frequency: NDArray[np.float64],
    response: NDArray[np.complex128],
    flight: float,
    wanted: NDArray[np.float64],
) -> NDArray[np.complex128]:
    """Transfer function at the frequencies ``wanted`` (Hz, within the given ones), by a cubic spline.

    The flight time (s) is taken out before and put back after. Towards zero frequency the spline knows that
    negative frequencies carry the conjugate.
    """
    still = response * np.exp(2j * np.pi * frequency * flight)
    low = frequency > 0.0
    ends = np.concatenate([-frequency[low][::-1], frequency])
    spline = CubicSpline(ends, np.concatenate([still[low][::-1].conj(), still]))
    result: NDArray[np.complex128] = spline(wanted) * np.exp(-2j * np.pi * wanted * flight)
    return result
