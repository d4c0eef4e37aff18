"""Finite impulse responses for the engine: the decimator, and fits to transfer functions."""

import functools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve, toeplitz

from fmu_bearing.acoustics.filters import designed
from fmu_bearing.acoustics.radiation.frequencies import BAND, STOP, fit_frequencies, interpolated_response
from fmu_bearing.engine.layout import SD

# Where a path lies this far below its component's strongest one, its error counts against that one (-30 dB).
WEAK = 10 ** (-30 / 20)
# Weights of a frequency against one in the band: where the limit falls, an error of -40 dB changes no level.
_EDGE_WEIGHT, _STOP_WEIGHT = 0.1, 0.3
_STOPPED = 64  # frequencies in the stop band
# Samples of the latency in which no filter works: with the flight over 80 mm they make 32, and blocks of
# that length need no direct part beside them. Convolution then takes a quarter to a half less.
_WAIT = 20
_RIDGE = 1e-12  # relative: keeps the normal equations of long filters solvable
_LENGTHS = (104, 128, 160, 192, 256, 384, 512, 768, 1024)
# Beyond this length the grid of `fit_frequencies` (62.5 Hz: 16 ms, 820 taps) no longer determines the taps.
_GRID_SERVES = 512
_FINER = 4
_GOOD = 10 ** (-55 / 20)  # error at which a filter is long enough
_LITTLE = 10 ** (0.5 / 20)  # where none is: what a longer one must better, 0.5 dB


def _half_band(half: Sequence[float]) -> NDArray[np.float64]:
    """Half-band filter of 4 k - 1 taps from the first k of twice its outer ones (`designed`).

    Twice the outer taps are an equiripple filter of half the rate with one band (Vaidyanathan and Nguyen
    1987).
    """
    taps = np.zeros(4 * len(half) - 1)
    taps[::2] = 0.5 * np.array([*half, *reversed(half)])
    taps[len(taps) // 2] = 0.5
    return taps


@functools.cache
def decimator_stages() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return both half-band filters, at ``RAW_RATE`` and at half of it, symmetric; read only.

    Each takes down by 84 dB or more what would fold below 22 kHz when every other sample goes: the first
    above ``RAW_RATE`` / 2 - 22 kHz = 80.4 kHz, the second above ``RATE`` - 22 kHz = 29.2 kHz. Beyond the 20
    kHz that are audible this serves the balls' sound, which shifts by up to 2 kHz when it is projected onto
    circumferential harmonics behind the decimator.
    """
    first = _half_band(designed.FIRST_STAGE)
    second = _half_band(designed.SECOND_STAGE)
    for taps in (first, second):
        taps.flags.writeable = False
    return first, second


def outer_taps(taps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the taps of a half-band filter that the engine needs: one half, without zeros and middle."""
    return taps[: len(taps) // 2 : 2]


@functools.cache
def decimator() -> NDArray[np.float64]:
    """Return the whole anti-alias filter at ``RAW_RATE``, shape (n,), symmetric; read only."""
    first, second = decimator_stages()
    apart = np.zeros(SD.HALF * (len(second) - 1) + 1)
    apart[:: SD.HALF] = second
    taps = np.convolve(first, apart)
    taps.flags.writeable = False
    return taps


def decimator_response(frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Complex response of the decimator at ``frequency`` in Hz."""
    n = np.arange(len(decimator()))
    return np.exp(-2j * np.pi * np.asarray(frequency)[..., None] * n / SD.RAW_RATE) @ decimator()


def band_limit(frequency: NDArray[np.float64]) -> NDArray[np.float64]:
    """Upper limit of the microphones at ``frequency`` in Hz, real: no phase.

    Flat to 20 kHz within 0.008 dB, -70 dB from 22 kHz on. It is the response of a short symmetric filter, so
    that the filters fitted to it (`fit`) need few taps. The engine's filters and the spectra of recordings
    (`analysis.field`) share it: both hear the same.
    """
    *half, middle = designed.BAND_LIMIT
    n = np.arange(-len(half), len(half) + 1)
    taps = np.array([*half, middle, *reversed(half)])
    return np.cos(2.0 * np.pi * np.asarray(frequency)[..., None] * n / SD.RATE) @ taps


def delay_of(flight: float) -> int:
    """Whole samples at ``RATE`` by which a path of ``flight`` seconds is delayed ahead of its filter."""
    return int(np.floor(flight * SD.RATE)) + _WAIT


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
    """Responses of the taps on the grid, then in the stop band."""
    grid = np.append(_grid(length), np.linspace(STOP, SD.RATE / 2, _STOPPED))
    return np.exp(-2j * np.pi / SD.RATE * grid[:, None] * np.arange(length))


@functools.cache
def _undone(length: int) -> NDArray[np.complex128]:
    """Band limit over the decimator's response, on the grid of a filter of ``length`` taps."""
    grid = _grid(length)
    return band_limit(grid) / decimator_response(grid)


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
        where a spline replaces the response.
    """
    fits = []
    for length in _LENGTHS:
        fits.append(_fit_length(length, response, flight, strongest))
        if fits[-1][1] < _GOOD:
            return fits[-1]
    least = min(error for _, error in fits)
    return next((taps, error) for taps, error in fits if error <= _LITTLE * least)


def _fit_length(
    length: int, response: NDArray[np.complex128], flight: float, strongest: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """Return taps and error of the best filter of one length."""
    coarse, grid = fit_frequencies(), _grid(length)
    if len(grid) > len(coarse):
        response = interpolated_response(coarse, response, flight, grid)
        strongest = np.interp(grid, coarse, strongest)
    # what the filter must do so that the whole chain is `response`, band-limited and LATENCY late
    late = np.exp(2j * np.pi * grid * (delay_of(flight) - SD.LATENCY) / SD.RATE)
    wanted = np.append(response * late * _undone(length), np.zeros(_STOPPED))
    weight = 1.0 / np.maximum(np.abs(response), WEAK * strongest)
    audible = grid <= BAND[1]
    weight[~audible] *= _EDGE_WEIGHT
    weight = np.append(weight, np.full(_STOPPED, _STOP_WEIGHT * weight[audible][-1]))
    basis = _basis(length)
    # Normal equations: far cheaper than an orthogonal solver, and the errors stay equal to the filter's
    # length. Their matrix depends on the distance of two taps alone: one column holds all.
    square = weight**2
    column = (square @ basis).real
    column[0] *= 1.0 + _RIDGE
    taps = solve(toeplitz(column), ((square * wanted.conj()) @ basis).real, assume_a="pos")
    error = np.abs(basis @ taps - wanted) * weight
    return taps, float(np.max(error[: len(grid)][audible]))
