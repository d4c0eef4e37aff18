"""Levels of made-up signals: lines, spectra, bands, histories."""

import math

import numpy as np
import pytest

from examples.papers import hearing
from examples.papers.hearing import a_weighted, below, line, spectrum
from examples.papers.reduced import histories
from fmu_bearing.acoustics.filters.weighting import a_weighting_db
from fmu_bearing.files import CacheError

RATE = 51200.0


def test_line_and_spectrum_read_a_tone():
    time = np.arange(8192) / RATE
    tone = np.sqrt(2.0) * 2e-2 * np.sin(2 * np.pi * 1311.0 * time + 0.3)  # 60 dB
    other = np.sqrt(2.0) * 2e-1 * np.sin(2 * np.pi * 1400.0 * time)  # 80 dB, five resolutions away
    # 0.1 dB: the search steps in 0.1 % of the frequency, the window's top is flat over that
    assert line(tone[None], RATE, 1309.0) == pytest.approx(60.0, abs=0.1)
    assert line((tone + other)[None], RATE, 1311.0) == pytest.approx(60.0, abs=0.5)  # leakage
    assert line(np.stack([tone, tone]), RATE, 1311.0) == pytest.approx(63.01, abs=0.1)  # energies
    levels = spectrum(tone[None], RATE, 20.0, 4000.0)
    assert len(levels) == 201 and int(np.argmax(levels)) * 20 in (1300, 1320)
    assert levels.max() == pytest.approx(60.0, abs=0.15)


def test_levels_up_to_a_frequency_leave_out_what_lies_above():
    time = np.arange(5120) / RATE  # 100 ms: whole periods, so nothing leaks
    low = np.sqrt(2.0) * 2e-2 * np.sin(2 * np.pi * 1000.0 * time)  # 60 dB
    high = np.sqrt(2.0) * 2e-1 * np.sin(2 * np.pi * 5000.0 * time)  # 80 dB
    assert below((low + high)[None, None], RATE, 4000.0) == pytest.approx([60.0], abs=1e-6)
    assert below(np.stack([low, low])[:, None], RATE, 4000.0) == pytest.approx([63.01], abs=0.01)
    assert below((low + high)[None, None], RATE, 6000.0) == pytest.approx([80.04], abs=0.01)


def test_histories_are_peaks_of_the_weighted_pressure():
    time = np.arange(5120) / RATE  # 100 ms
    tone = 0.2 * np.sin(2 * np.pi * 3150.0 * time)
    peaks = histories(a_weighted(tone[None], RATE), RATE)
    assert peaks.shape == (1, 19)
    peak = 20 * math.log10(0.2 / 2e-5) + float(a_weighting_db([3150.0])[0])
    assert peaks[0] == pytest.approx([peak] * 19, abs=0.1)  # 16 samples a period: 0.17 dB at worst, rarely


def test_kept_paths_are_unpickled_from_own_files_alone(tmp_path, scene):
    """A pickle is a program: one that others can write to is refused, in their folder or in one's own."""
    asked = (scene("7003C-bare"), "compact", ((0.0, 0.0, 0.2),), 2, tmp_path)
    assert hearing._kept_paths(*asked)
    (file,) = (tmp_path / "paths").glob("*.pickle")
    for place, words in ((file, file.name), (tmp_path / "paths", "paths is refused")):
        hearing._read.cache_clear()
        place.chmod(0o777)
        with pytest.raises(CacheError, match=words):
            hearing._kept_paths(*asked)
        place.chmod(0o700)
        assert hearing._kept_paths(*asked)
