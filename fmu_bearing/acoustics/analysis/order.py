"""Order analysis: signals counted in turns of the shaft instead of seconds."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from fmu_bearing.acoustics.analysis.spectrum import amplitude_spectrum
from fmu_bearing.acoustics.filters.weighting import level

_FINER = 4  # times the sample rate before interpolation: a cubic spline then errs by less than 1e-3
_MARGIN = 1.28  # samples per turn over twice the highest order
_LONGEST = 64  # times the old samples: more than that is a mistake, not a measurement


@dataclass(frozen=True)
class OrderMap:
    """Levels over order and shaft speed.

    Attributes
    ----------
    orders : ndarray, shape (orders,)
        Multiples of the shaft's turns.
    speed : ndarray, shape (blocks,)
        Mean shaft speed (rad/s) of each block.
    time : ndarray, shape (blocks,)
        Its middle (s).
    levels : ndarray, shape (blocks, orders)
        In dB re 20 uPa; a line's level is read at its order within 0.1 dB.
    """

    orders: NDArray[np.float64]
    speed: NDArray[np.float64]
    time: NDArray[np.float64]
    levels: NDArray[np.float64]


@dataclass(frozen=True)
class Waterfall:
    """Levels over frequency and time, of blocks of equal length.

    Attributes
    ----------
    frequency : ndarray, shape (bins,)
        In Hz.
    time, speed : ndarray, shape (blocks,)
        Middle of each block (s), and the shaft's mean speed in it (rad/s).
    levels : ndarray, shape (blocks, bins)
        In dB re 20 uPa; a line's level is read at its bin within 0.1 dB.
    """

    frequency: NDArray[np.float64]
    time: NDArray[np.float64]
    speed: NDArray[np.float64]
    levels: NDArray[np.float64]


def on_angle(
    signal: ArrayLike, angle: ArrayLike, highest: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Resample a signal evenly on the shaft's angle.

    Parameters
    ----------
    signal : array_like, shape (samples,)
    angle : array_like, shape (samples,)
        Angle (rad) of the shaft at each sample; it only grows or only falls.
    highest : float
        Highest order to be kept. At the slowest turn all that the signal holds is kept, so nothing folds.

    Returns
    -------
    resampled : ndarray
    places : ndarray
        Place of each new sample in samples of the old signal.
    per_turn : float
        New samples per turn.

    Raises
    ------
    ValueError
        When shapes differ or the shaft stops or turns back.
    """
    x = np.asarray(signal, dtype=float)
    phi = np.asarray(angle, dtype=float)
    if x.ndim != 1 or x.shape != phi.shape:
        raise ValueError(f"signal {x.shape} and angle {phi.shape} must be one-dimensional and of one length")
    turned = np.sign(phi[-1] - phi[0]) * phi
    if not (np.diff(turned) > 0.0).all():
        raise ValueError("the shaft stops or turns back: orders need an angle that only grows")
    slowest = float(np.min(np.diff(turned)))
    per_turn = float(np.ceil(max(2.0 * highest * _MARGIN, 2.0 * np.pi / slowest)))
    if per_turn * (turned[-1] - turned[0]) > 2.0 * np.pi * _LONGEST * len(x):
        raise ValueError(
            f"the slowest turn is too slow beside the others: it needs {per_turn:.0f} samples per turn; "
            "leave out the part in which the shaft hardly turns"
        )
    grid = np.arange(turned[0], turned[-1], 2.0 * np.pi / per_turn)
    places = np.interp(grid, turned, np.arange(len(x)))
    fine = scipy.signal.resample_poly(np.pad(x, 64, mode="reflect"), _FINER, 1, window=("kaiser", 8.0))
    spline = CubicSpline(np.arange(len(fine)) / _FINER - 64.0, fine)
    return spline(places), places, per_turn


def order_spectrum(
    signal: ArrayLike, angle: ArrayLike, highest: float, resolution: float = 0.25
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Orders up to ``highest`` and the rms of their lines, both of shape (orders,).

    Speed may change meanwhile. ``resolution`` is the spacing in orders: blocks of 1 / ``resolution`` turns
    are averaged in energy.

    Raises
    ------
    ValueError
        As `on_angle`; also when the recording is shorter than one block.
    """
    even, _, per_turn = on_angle(signal, angle, highest)
    orders, rms = amplitude_spectrum(even, per_turn, resolution)
    keep = orders <= highest
    return orders[keep], rms[keep]


def order_map(
    signal: ArrayLike,
    angle: ArrayLike,
    sample_rate: float,
    highest: float,
    resolution: float = 0.25,
    overlap: float = 0.75,
) -> OrderMap:
    """Spectra over order of successive blocks of 1 / ``resolution`` turns (`OrderMap`).

    Raises
    ------
    ValueError
        As `order_spectrum`.
    """
    even, places, per_turn = on_angle(signal, angle, highest)
    starts, size = _starts(len(even), per_turn, resolution, overlap)
    orders, levels = _levels(even, starts, size, per_turn)
    keep = orders <= highest
    time = places / sample_rate
    ends = starts + size - 1
    turned = 2.0 * np.pi * (size - 1) / per_turn
    return OrderMap(
        orders[keep],
        turned / (time[ends] - time[starts]),
        0.5 * (time[starts] + time[ends]),
        levels[:, keep],
    )


def waterfall(
    signal: ArrayLike,
    angle: ArrayLike,
    sample_rate: float,
    highest: float,
    resolution: float = 20.0,
    overlap: float = 0.75,
) -> Waterfall:
    """Spectra over frequency (Hz) of successive blocks of 1 / ``resolution`` s (`Waterfall`).

    Raises
    ------
    ValueError
        When shapes differ or the recording is shorter than one block.
    """
    x, phi = np.asarray(signal, dtype=float), np.asarray(angle, dtype=float)
    if x.ndim != 1 or x.shape != phi.shape:
        raise ValueError(f"signal {x.shape} and angle {phi.shape} must be one-dimensional and of one length")
    starts, size = _starts(len(x), sample_rate, resolution, overlap)
    frequency, levels = _levels(x, starts, size, sample_rate)
    keep = frequency <= highest
    ends = starts + size - 1
    return Waterfall(
        frequency[keep],
        np.asarray(0.5 * (starts + ends) / sample_rate, dtype=np.float64),
        np.asarray(np.abs(phi[ends] - phi[starts]) / (size - 1) * sample_rate, dtype=np.float64),
        levels[:, keep],
    )


def _starts(samples: int, rate: float, resolution: float, overlap: float) -> tuple[NDArray[np.int64], int]:
    """First samples of the blocks, and their length."""
    size = round(rate / resolution)
    if not 0.0 <= overlap < 1.0:
        raise ValueError(f"overlap = {overlap}: it must be at least 0 and less than 1")
    if size < 8 or size > samples:
        raise ValueError(
            f"a resolution of {resolution:g} needs blocks of {size} samples, the recording has {samples}: "
            "take a coarser one or record longer"
        )
    return np.arange(0, samples - size + 1, max(1, round(size * (1.0 - overlap)))), size


def _levels(
    signal: NDArray[np.float64], starts: NDArray[np.int64], size: int, rate: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Bins and levels of each block: flat-top window, so that lines read true between bins."""
    hop = int(starts[1] - starts[0]) if len(starts) > 1 else size
    frequency, _, power = scipy.signal.spectrogram(
        signal, rate, "flattop", size, size - hop, detrend="constant", scaling="spectrum"
    )
    return frequency, level(power.T)
