"""Weighting, levels, spectra and kinematic frequencies."""

import numpy as np
import pytest
from scipy.signal import sosfreqz

from fmu_bearing.acoustics.analysis.spectrum import (
    amplitude_spectrum,
    kinematic_frequencies,
    level_spectrum,
    power_spectral_density,
)
from fmu_bearing.acoustics.filters.weighting import a_weighting_db, a_weighting_sections, level
from fmu_bearing.engine.layout import SD

# IEC 61672-1:2013, table 3: nominal frequency, A-weighting in dB, given to 0.1 dB.
IEC_TABLE = {
    31.5: -39.4, 63: -26.2, 125: -16.1, 250: -8.6, 500: -3.2, 1000: 0.0, 2000: 1.2, 4000: 1.0, 8000: -1.1,
    16000: -6.6,
}  # fmt: skip


def test_formula_meets_the_table():
    """0.05 dB of rounding, and up to 0.1 dB because nominal frequencies stand for 10^(n/10)."""
    exact = [10 ** (round(10 * np.log10(f)) / 10) for f in IEC_TABLE]
    assert a_weighting_db(exact) == pytest.approx(list(IEC_TABLE.values()), abs=0.06)


def test_filter_meets_the_formula():
    """0.06 dB to 20 kHz is our own gate; the standard allows class 1 more than 1 dB."""
    frequency = np.geomspace(20, 20_000, 2000)
    found = 20 * np.log10(np.abs(sosfreqz(a_weighting_sections(SD.RATE), frequency, fs=SD.RATE)[1]))
    assert np.max(np.abs(found - a_weighting_db(frequency))) < 0.06
    at_calibrator = sosfreqz(a_weighting_sections(SD.RATE), [1000.0], fs=SD.RATE)[1]
    assert abs(at_calibrator[0]) == pytest.approx(1.0, abs=1e-9)


def test_levels_are_finite():
    assert level(1.0) == pytest.approx(93.9794, abs=1e-4)
    assert level(0.0) == pytest.approx(10 * np.log10(1e-20 / 4e-10))


def test_table_2_of_the_multi_source_paper():
    """1e-4 relative: the table is printed to 0.01 Hz of numbers from 139 Hz on."""
    table = {
        20_000: (333.33, 138.80, 936.04, 2334.34, 1665.62),
        25_000: (416.67, 173.51, 1170.07, 2917.97, 2082.07),
        28_000: (466.67, 194.33, 1310.48, 3268.13, 2331.91),
        30_000: (500.0, 208.21, 1404.07, 3501.54, 2498.46),
    }
    for rpm, printed in table.items():
        found = kinematic_frequencies(rpm * np.pi / 30, 12, 4.5e-3, 26e-3, np.radians(15))
        assert tuple(found) == pytest.approx(printed, rel=1e-4)


def test_spectra_of_a_tone_and_of_noise():
    t = np.arange(51_200) / 51_200
    tone = np.sqrt(2) * np.sin(2 * np.pi * 1007.0 * t)
    frequency, rms = amplitude_spectrum(tone, 51_200, 20.0)
    assert rms.max() == pytest.approx(1.0, abs=0.012)  # flat top between bins: 0.1 dB
    assert frequency[rms.argmax()] == pytest.approx(1000.0, abs=20.0)
    assert level_spectrum(tone, 51_200, 20.0)[1].max() == pytest.approx(93.98, abs=0.1)
    noise = np.random.default_rng(1).standard_normal(512_000)
    frequency, density = power_spectral_density(noise, 51_200, 100.0)
    # unit variance; about 2,000 blocks: 2 % for the mean of any band
    assert density[10:-10].mean() * 25_600 == pytest.approx(1.0, rel=0.02)
    with pytest.raises(ValueError, match="samples"):
        amplitude_spectrum(tone[:100], 51_200, 20.0)
