"""Spectra of recorded pressure and the kinematic frequencies of a bearing."""

from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.filters.weighting import level


class KinematicFrequencies(NamedTuple):
    """Frequencies in Hz of pure rolling: shaft f_r, cage f_c, ball f_b, inner f_i and outer race f_o.

    In the field's other names: f_c is FTF, f_b BSF, f_i BPFI, f_o BPFO.
    """

    f_r: float
    f_c: float
    f_b: float
    f_i: float
    f_o: float


def kinematic_frequencies(
    speed: float, ball_count: int, ball_diameter: float, pitch_diameter: float, contact_angle: float
) -> KinematicFrequencies:
    """Frequencies of a bearing whose inner ring turns at ``speed`` (rad/s) without sliding.

    Lengths in m, ``contact_angle`` in rad. Source: multi-source paper, eq. 47.
    """
    shaft = abs(speed) / (2.0 * np.pi)
    ratio = ball_diameter / pitch_diameter * np.cos(contact_angle)
    return KinematicFrequencies(
        f_r=shaft,
        f_c=0.5 * shaft * (1.0 - ratio),
        f_b=0.5 * shaft * pitch_diameter / ball_diameter * (1.0 - ratio**2),
        f_i=0.5 * ball_count * shaft * (1.0 + ratio),
        f_o=0.5 * ball_count * shaft * (1.0 - ratio),
    )


def amplitude_spectrum(
    pressure: ArrayLike, sample_rate: float, resolution: float | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Frequencies in Hz and rms pressures in Pa of the lines of a recording, shape (bins,) each.

    A line's rms is read at its bin within 0.1 dB (flat-top window), whatever its place between bins.
    ``resolution`` is the bin spacing in Hz; the blocks of that length are averaged in energy with half
    overlap. Without it the whole recording is one block.

    Raises
    ------
    ValueError
        When the recording is shorter than one block.
    """
    signal = np.asarray(pressure, dtype=float)
    size = _block(signal, sample_rate, resolution)
    frequency, power = scipy.signal.welch(
        signal, sample_rate, "flattop", size, detrend="constant", scaling="spectrum"
    )
    return frequency, np.sqrt(power)


def power_spectral_density(
    pressure: ArrayLike, sample_rate: float, resolution: float | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Frequencies in Hz and one-sided density in Pa^2/Hz of a recording (Hann window, Welch's average).

    Raises
    ------
    ValueError
        When the recording is shorter than one block.
    """
    signal = np.asarray(pressure, dtype=float)
    size = _block(signal, sample_rate, resolution)
    return scipy.signal.welch(
        signal, sample_rate, scipy.signal.get_window("hann", size), size, detrend="constant"
    )


def level_spectrum(
    pressure: ArrayLike, sample_rate: float, resolution: float | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return `amplitude_spectrum` with levels in dB re 20 uPa instead of pascals."""
    frequency, rms = amplitude_spectrum(pressure, sample_rate, resolution)
    return frequency, level(rms**2)


def _block(signal: NDArray[np.float64], sample_rate: float, resolution: float | None) -> int:
    if signal.ndim != 1:
        raise ValueError(f"pressure must be one-dimensional, not of shape {signal.shape}")
    size = signal.size if resolution is None else round(sample_rate / resolution)
    if size < 8 or size > signal.size:
        raise ValueError(
            f"a resolution of {resolution} Hz needs {size} samples, the recording has {signal.size}"
        )
    return size
