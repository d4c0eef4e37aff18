"""Finite impulse responses for the engine: the decimator, and fits to transfer functions."""

import functools

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve, toeplitz
from scipy.signal import remez

from fmu_bearing.acoustics.radiation.frequencies import BAND, between, fit_frequencies
from fmu_bearing.engine.layout import SD

# Where a path lies this far below its component's strongest one, its error counts against that one (-30 dB).
_WEAK = 10 ** (-30 / 20)
_STOP = 24_000.0  # Hz: filters let little through from here on; nothing is fitted between the bands
_STOP_WEIGHT = 0.02
_RIDGE = 1e-12  # relative: keeps the normal equations of long filters solvable
_LENGTHS = (48, 64, 96, 128, 192, 256, 384, 512, 768, 1024)
# Beyond this length the grid of `fit_frequencies` (62.5 Hz: 16 ms, 820 taps) no longer determines the taps.
_GRID_SERVES = 512
_FINER = 4
_GOOD = 10 ** (-55 / 20)  # error at which a filter is long enough
_LITTLE = 10 ** (0.5 / 20)  # where none is: what a longer one must better, 0.5 dB


@functools.cache
def decimator() -> NDArray[np.float64]:
    """Return the anti-alias filter at ``RAW_RATE``, shape (DECIMATOR_TAPS,), symmetric; read only.

    Everything above ``RATE`` - 20 kHz = 31.2 kHz, all that could fold below 20 kHz, is down by at least 80
    dB. The pass band's ripple is undone by the filters fitted behind it (`fit`).
    """
    stop = SD.RATE - BAND[1]
    taps = remez(
        SD.DECIMATOR_TAPS,
        [0.0, BAND[1], stop, SD.RAW_RATE / 2],
        [1.0, 0.0],
        weight=[1.0, 100.0],
        fs=SD.RAW_RATE,
    )
    taps /= taps.sum()
    taps.flags.writeable = False
    return taps


def decimator_response(frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Complex response of the decimator at ``frequency`` in Hz."""
    n = np.arange(SD.DECIMATOR_TAPS)
    return np.exp(-2j * np.pi * np.asarray(frequency)[..., None] * n / SD.RAW_RATE) @ decimator()


def delay_of(flight: float) -> int:
    """Whole samples at ``RATE`` by which a path of ``flight`` seconds is delayed ahead of its filter."""
    return int(np.floor(flight * SD.RATE))


@functools.cache
def _grid(length: int) -> NDArray[np.float64]:
    """Frequencies in Hz that determine a filter of ``length`` taps."""
    f = fit_frequencies()
    if length <= _GRID_SERVES:
        return f
    places = np.arange(_FINER * (len(f) - 1) + 1) / _FINER
    return np.interp(places, np.arange(len(f)), f)


@functools.cache
def _basis(length: int) -> NDArray[np.complex128]:
    turn = -2j * np.pi / SD.RATE * np.arange(length)
    return np.exp(_grid(length)[:, None] * turn)


@functools.cache
def _stop_rows(length: int) -> NDArray[np.complex128]:
    turn = -2j * np.pi / SD.RATE * np.arange(length)
    return np.exp(np.linspace(_STOP, SD.RATE / 2, 12)[:, None] * turn)


@functools.cache
def _decimated(length: int) -> NDArray[np.complex128]:
    """Response of the decimator on the grid of a filter of ``length`` taps."""
    return decimator_response(_grid(length))


def fit(
    response: NDArray[np.complex128], flight: float, strongest: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """Fit a filter to a transfer function by weighted least squares.

    Parameters
    ----------
    response
        Transfer function at `fit_frequencies`, flight time included.
    flight
        Time in s taken out as whole samples before the fit.
    strongest
        Magnitude of the component's strongest path at the same frequencies: the yardstick where this path is
        weak.

    Returns
    -------
    taps, error
        Taps at ``RATE``, newest sample first, as few as reach -55 dB or, where 1024 do not, come within
        0.5 dB of the least error; largest deviation in `BAND` over the larger of the path's own magnitude and
        the strongest one's minus 30 dB. Filters longer than 512 taps are held to a grid four times as fine,
        where a spline stands for the response.
    """
    found = []
    for length in _LENGTHS:
        found.append(_fit_length(length, response, flight, strongest))
        if found[-1][1] < _GOOD:
            return found[-1]
    least = min(error for _, error in found)
    return next((taps, error) for taps, error in found if error <= _LITTLE * least)


def _fit_length(
    length: int, response: NDArray[np.complex128], flight: float, strongest: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """Return taps and error of the best filter of one length."""
    coarse, grid = fit_frequencies(), _grid(length)
    if len(grid) > len(coarse):
        response = between(coarse, response, flight, grid)
        strongest = np.interp(grid, coarse, strongest)
    # what the filter must do so that the whole chain is `response`, LATENCY late
    wanted = (
        response * np.exp(2j * np.pi * grid * (delay_of(flight) - SD.LATENCY) / SD.RATE) / _decimated(length)
    )
    weight = 1.0 / np.maximum(np.abs(response), _WEAK * strongest)
    basis, stop = _basis(length), _stop_rows(length)
    # Normal equations: far cheaper than an orthogonal solver, and the errors stay those of the filter
    # length. Their matrix depends on the distance of two taps alone: one column tells all.
    square = weight**2
    column = (square @ basis).real + (_STOP_WEIGHT * weight[-1]) ** 2 * stop.sum(axis=0).real
    column[0] *= 1.0 + _RIDGE
    taps = solve(toeplitz(column), ((square * wanted.conj()) @ basis).real, assume_a="pos")
    return taps, float(np.max(np.abs(basis @ taps - wanted) * weight))
