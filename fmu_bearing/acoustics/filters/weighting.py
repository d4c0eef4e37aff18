"""Frequency and time weighting of sound levels (IEC 61672-1), third octaves (IEC 61260-1).

`a_weighting_db` is the standard's formula; `a_weighting_sections` is the digital filter the engine runs:
the four low analogue poles mapped one by one (z = e^{s/fs}), the four zeros at zero frequency, and for the
double pole at 12.2 kHz one free section fitted so that the magnitude follows the formula to 20 kHz.
"""

import functools

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import least_squares

from fmu_bearing.acoustics.filters.designed import A_WEIGHTING

FAST, SLOW = 0.125, 1.0  # s, IEC 61672-1
REFERENCE_PRESSURE = 2e-5  # Pa
FLOOR = 1e-20  # Pa^2 added to every mean square, so that levels stay finite (-106 dB)

# IEC 61672-1, annex E: pole frequencies in Hz (the outer two are double).
_POLES = (20.598997, 107.65265, 737.86223, 12194.217)


def _analogue(frequency: NDArray[np.float64]) -> NDArray[np.float64]:
    f1, f2, f3, f4 = _POLES
    f = frequency**2
    return f4**2 * f**2 / ((f + f1**2) * np.sqrt((f + f2**2) * (f + f3**2)) * (f + f4**2))


def a_weighting_db(frequency: ArrayLike) -> NDArray[np.float64]:
    """A-weighting in dB at ``frequency`` in Hz (positive), 0 dB at 1 kHz. IEC 61672-1 (2013), annex E."""
    f = np.asarray(frequency, dtype=float)
    return 20.0 * np.log10(_analogue(f) / _analogue(np.array(1000.0)))


def a_weighting_sections(sample_rate: float) -> NDArray[np.float64]:
    """Second-order sections of the A-weighting filter, shape (3, 6), as `scipy.signal.sosfilt` takes them.

    At 51.2 kHz the magnitude keeps within 0.06 dB of IEC 61672-1 from 20 Hz to 20 kHz.
    """
    return _sections(float(sample_rate)).copy()


@functools.cache
def _sections(sample_rate: float) -> NDArray[np.float64]:
    """Sections of the four low poles, then the free one: fitted once per rate, in a tenth of a second."""
    f1, f2, f3, _ = _mapped(sample_rate)
    fixed = np.array([[1.0, -2.0, 1.0, *np.poly([f1, f1])], [1.0, -2.0, 1.0, *np.poly([f2, f3])]])
    known = A_WEIGHTING.get(sample_rate)
    return np.concatenate([fixed, free_section(fixed, sample_rate) if known is None else [known]])


def _mapped(sample_rate: float) -> list[float]:
    """Poles in z."""
    return [np.exp(-2.0 * np.pi * f / sample_rate) for f in _POLES]


def free_section(fixed: NDArray[np.float64], sample_rate: float) -> NDArray[np.float64]:
    """Fit the section, shape (1, 6), that makes ``fixed`` ones follow the formula."""
    f4 = _mapped(sample_rate)[-1]
    frequency = np.append(np.geomspace(20.0, min(20_000.0, 0.45 * sample_rate), 400), 1000.0)
    here = scipy.signal.sosfreqz(fixed, frequency, fs=sample_rate)[1]
    wanted = a_weighting_db(frequency)

    def last(x: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([[x[0], x[1], x[2], *np.poly(x[3:])]])

    def error(x: NDArray[np.float64]) -> NDArray[np.float64]:
        response = here * scipy.signal.sosfreqz(last(x), frequency, fs=sample_rate)[1]
        return 20.0 * np.log10(np.abs(response)) - wanted

    gain = 10 ** (-error(np.array([1.0, 0.0, 0.0, f4, f4]))[-1] / 20.0)
    start = np.array([gain, 0.1 * gain, 0.01 * gain, f4, 0.9 * f4])
    x = least_squares(error, start, x_scale=np.maximum(np.abs(start), 1e-2), xtol=1e-14, ftol=1e-14).x
    x[:3] *= 10 ** (-error(x)[-1] / 20.0)  # exactly 0 dB at 1 kHz, where calibrators sound
    return last(x)


def band_centre(nominal: float) -> float:
    """Exact mid-band frequency in Hz of the third octave with a nominal one. IEC 61260-1, base ten."""
    return float(10.0 ** (round(10.0 * np.log10(nominal)) / 10.0))


def band_sections(sample_rate: float, nominal: float) -> NDArray[np.float64]:
    """Second-order sections of a third-octave filter, shape (4, 6), as `scipy.signal.sosfilt` takes them.

    Butterworth of order four on either side (three would miss class 1 at 16 kHz), edges 10^(1/20) above
    and below the middle (IEC 61260-1, base ten), bilinear with both edges held; class 1. 0 dB exactly in the
    middle.
    """
    centre = band_centre(nominal)
    edges = (centre * 10**-0.05, centre * 10**0.05)
    sections: NDArray[np.float64] = scipy.signal.butter(4, edges, "bandpass", fs=sample_rate, output="sos")
    sections[0, :3] /= abs(scipy.signal.sosfreqz(sections, [centre], fs=sample_rate)[1][0])
    return sections


def high_pass_gains(sample_rate: float, frequency: float) -> NDArray[np.float64]:
    """Gains of the microphones' high-pass as a tracker, shape (3,), in the order of `layout.sound`.

    The second-order Butterworth high-pass with its corner at ``frequency`` (bilinear) has the denominator
    1 - (2 - follow - steer) / z + (1 - follow) / z^2 and the numerator gain (1 - 1 / z)^2.
    """
    c = np.tan(np.pi * frequency / sample_rate)
    gain = 1.0 / (1.0 + np.sqrt(2.0) * c + c**2)
    return gain * np.array([1.0, 2.0 * np.sqrt(2.0) * c, 4.0 * c**2])


def level(mean_square: ArrayLike) -> NDArray[np.float64]:
    """Level in dB re 20 uPa of a mean square pressure in Pa^2; never below -106 dB, always finite."""
    return 10.0 * np.log10((np.asarray(mean_square, dtype=float) + FLOOR) / REFERENCE_PRESSURE**2)
