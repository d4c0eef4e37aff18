"""Frequencies at which transfer functions are evaluated and fitted, and interpolation between them."""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

BAND = (20.0, 20_000.0)  # Hz: hearing, and where filters follow their transfer functions
STOP = 22_000.0  # Hz: between the band and here the sound fades (`filters.fir.band_limit`)


def fit_frequencies() -> NDArray[np.float64]:
    """Frequencies in Hz at which transfer functions are evaluated and fitted, shape (n,): up to `STOP`."""
    return np.concatenate(
        [np.geomspace(BAND[0], 1000.0, 50, endpoint=False), np.arange(1000.0, STOP + 1.0, 62.5)]
    )


def spline_of(
    frequency: NDArray[np.float64], response: NDArray[np.complex128], flight: float | NDArray[np.float64]
) -> CubicSpline:
    """Cubic spline of transfer functions (..., frequencies) whose flight times (s) are taken out.

    Towards zero frequency it knows that negative frequencies carry the conjugate.
    """
    still = response * np.exp(2j * np.pi * frequency * flight)
    low = frequency > 0.0
    ends = np.concatenate([-frequency[low][::-1], frequency])
    return CubicSpline(ends, np.concatenate([still[..., low][..., ::-1].conj(), still], axis=-1), axis=-1)


def interpolated_response(
    frequency: NDArray[np.float64],
    response: NDArray[np.complex128],
    flight: float,
    wanted: NDArray[np.float64],
) -> NDArray[np.complex128]:
    """Transfer function at the frequencies ``wanted`` (Hz), by a cubic spline (`spline_of`).

    The flight time (s) is taken out before and put back after. Above the last given frequency its value is
    held.
    """
    still = spline_of(frequency, response, flight)(np.minimum(wanted, frequency[-1]))
    result: NDArray[np.complex128] = still * np.exp(-2j * np.pi * wanted * flight)
    return result
