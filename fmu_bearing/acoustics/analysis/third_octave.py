"""Third-octave bands (IEC 61260-1, base ten): filters, and levels of recordings.

Band x has its centre at 1000 Hz times 10^(x/10) and its edges a factor of 10^(1/20) to either side. Each
filter is that of the meters (`weighting.band_sections`): it keeps the limits of class 1 at 48 kHz and more.
"""

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.filters.weighting import band_sections, level

#: Octave ratio of the base-ten system.
OCTAVE = 10.0**0.3
#: From the centre of a band to its edges, as a factor.
EDGE = OCTAVE ** (1.0 / 6.0)
_NOMINAL = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)
_LOWEST, _HIGHEST = -17, 13  # bands 20 Hz to 20 kHz
_ROOM = 0.95  # of half the sample rate: the last band's upper edge lies below


def centre_frequencies(sample_rate: float = np.inf) -> NDArray[np.float64]:
    """Exact centres (Hz) of the bands from 20 Hz to 20 kHz that fit below half the sample rate."""
    centres = 1000.0 * 10.0 ** (np.arange(_LOWEST, _HIGHEST + 1) / 10.0)
    fitting: NDArray[np.float64] = centres[centres * EDGE < _ROOM * sample_rate / 2.0]
    return fitting


def nominal_frequency(centre: float) -> float:
    """Return the rounded value (Hz) by which a band is known: 25 for 25.119, 3150 for 3162.28."""
    decade, place = divmod(round(10.0 * np.log10(centre)), 10)
    return float(_NOMINAL[place] * 10.0**decade)


def band_filters(sample_rate: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Centre frequencies (Hz), shape (bands,), and second-order sections, shape (bands, 4, 6).

    Raises
    ------
    ValueError
        When no band fits below half the sample rate.
    """
    centres = centre_frequencies(sample_rate)
    if len(centres) == 0:
        raise ValueError(
            f"a sample rate of {sample_rate:g} Hz leaves room for no band; the lowest needs 48 Hz"
        )
    sections = [band_sections(float(sample_rate), float(centre)) for centre in centres]
    return centres, np.array(sections)


def third_octave_levels(
    pressure: ArrayLike, sample_rate: float, settle: float = 0.0
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Centre frequencies (Hz) and equivalent levels (dB re 20 uPa) of the third-octave bands.

    Of noise, a band of width B over a time T has a standard deviation of 4.34 / sqrt(B T) dB (`spread`).

    Parameters
    ----------
    pressure : array_like, shape (..., samples)
        In Pa.
    sample_rate : float
        In Hz.
    settle : float
        Time (s) at the beginning in which the filters settle; it is left out of the levels.

    Returns
    -------
    centres : ndarray, shape (bands,)
    levels : ndarray, shape (..., bands)

    Raises
    ------
    ValueError
        When nothing is left after ``settle``.
    """
    signal = np.asarray(pressure, dtype=float)
    first = round(settle * sample_rate)
    if not 0 <= first < signal.shape[-1]:
        raise ValueError(
            f"settle = {settle} s leaves nothing of {signal.shape[-1] / sample_rate:g} s: give less, or a "
            "longer recording"
        )
    centres, sections = band_filters(sample_rate)
    power = [np.mean(scipy.signal.sosfilt(band, signal)[..., first:] ** 2, axis=-1) for band in sections]
    return centres, level(np.stack(power, axis=-1))


def spread(centre: ArrayLike, duration: float) -> NDArray[np.float64]:
    """Return the standard deviation (dB) of a band's level of Gaussian noise over ``duration`` (s)."""
    width = np.asarray(centre, dtype=float) * (EDGE - 1.0 / EDGE)
    return 10.0 / np.log(10.0) / np.sqrt(width * duration)
