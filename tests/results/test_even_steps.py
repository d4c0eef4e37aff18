"""Which times are even: those that a logger rounded are, those with a gap or with a drift are not."""

import numpy as np
import pytest

from fmu_bearing.results.even_steps import ALLOWED, spacing

RATE = 12_000.0


@pytest.mark.parametrize(
    ("rate", "written"),
    [
        (12_000.0, "{:.6f}"),
        (51_200.0, "{:.6f}"),  # 0.5 us are 2.6 % of a step: the worst that the limit is for
        (97_656.0, "{:.8g}"),
        (12_000.0, "{:.8g}"),
    ],
)
def test_times_that_a_logger_rounded_are_even(rate, written):
    time = np.array([float(written.format(k / rate)) for k in range(60_000)])
    found = spacing(time)
    assert found.even
    # both ends are rounded by half of the last digit, 0.5 us, over 0.6 s or more
    assert 1.0 / found.step == pytest.approx(rate, rel=2e-6)


def test_a_lost_sample_a_repeated_time_and_a_drift_are_not_even():
    time = np.arange(6000) / RATE
    lost = spacing(np.delete(time, 2500))
    assert not lost.even and lost.worst == 2499 and 0.3 < lost.off < 1.0
    repeated = time.copy()
    repeated[300] = repeated[299]
    assert not spacing(repeated).even and spacing(repeated).worst == 299
    # gaps that grow by e = 1e-3 in all: a parabola is n e / 12 off the line that fits it best, at both ends
    drift = spacing(np.cumsum(np.linspace(1.0, 1.001, 6000)) / RATE)
    assert not drift.even and drift.off == pytest.approx(0.5, rel=0.01)


@pytest.mark.parametrize(("share", "even"), [(0.9 * ALLOWED, True), (1.1 * ALLOWED, False)])
def test_the_limit_is_a_share_of_a_step(share, even):
    time = np.arange(1000) / RATE
    time[500] += share / RATE
    assert spacing(time).even is even


def test_an_even_grid_keeps_its_step_to_the_last_digit():
    assert spacing(np.arange(5) * 0.25).step == 0.25
    assert not spacing([1.0]).even and spacing([0.0, 1.0]).even
