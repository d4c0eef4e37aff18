"""Waveforms at another rate: no delay, flat to 0.4 of it, nothing folds."""

import numpy as np
import pytest

from fmu_bearing.dataset.plan import RATE
from fmu_bearing.dataset.sensors import margin, resampled

SIZE = 600


def through(rate, frequency):
    """A sine from 20 ms on through `resampled`, and what it is at the rate."""
    more = margin(rate)
    time = (np.arange(round(SIZE * RATE / rate) + 1 + 2 * more) - more) / RATE
    there = np.arange(SIZE) / rate
    sine = [np.sin(2.0 * np.pi * frequency * t + 0.3) for t in (time, there)]
    return resampled(sine[0][None], rate, SIZE)[0], sine[1]


@pytest.mark.parametrize("rate", [RATE, 25_600, 12_000, 20_000, 48_000, 2_100])
def test_waveforms_have_no_delay_and_keep_what_lies_below(rate):
    for share in (0.003, 0.1, 0.4):
        read, wanted = through(rate, share * rate)
        assert read.dtype == np.float32 and read.shape == (SIZE,)
        # the filter passes within 90 dB of 1; float32 has 7 digits
        assert read == pytest.approx(wanted, abs=4e-5)


@pytest.mark.parametrize("rate", [25_600, 12_000, 20_000, 2_100])
def test_nothing_folds(rate):
    for frequency in (0.5 * rate, 0.61 * rate, 0.9 * rate, 0.47 * RATE):
        if 0.5 * rate <= frequency < 0.5 * RATE:
            assert np.abs(through(rate, frequency)[0]).max() < 10.0 ** (-85.0 / 20.0)


def test_the_rate_of_the_engine_is_kept_to_the_bit():
    read, wanted = through(RATE, 3000.0)
    assert margin(RATE) == 0 and np.array_equal(read, wanted.astype(np.float32))
