"""Matches by chance: laws against counts of random draws, coverage against a fine axis."""

import math

import numpy as np
import pytest
from scipy.stats import binom

from examples.papers.chance import at_least, best_of, chance

LOW, HIGH = 5e3, 70e3
MODES = [2.6e3, 4.95e3, 6.5e3, 6.6e3, 18.7e3, 23.4e3, 24.0e3, 30.5e3, 52.4e3, 71e3]


def test_equal_trials_are_binomial():
    for k in range(-1, 11):
        assert at_least(k, [0.3] * 9) == pytest.approx(binom.sf(k - 1, 9, 0.3), abs=1e-15)


def test_unequal_trials_are_those_drawn():
    p = np.array([0.05, 0.9, 0.4, 0.4, 0.7])
    successes = (np.random.default_rng(2).random((200_000, 5)) < p).sum(axis=1)
    for k in range(7):
        # 200,000 draws: a standard error of 1.1e-3 at most
        assert at_least(k, p) == pytest.approx(np.mean(successes >= k), abs=5e-3)


def test_coverage_is_the_share_of_a_fine_axis_and_probability_that_of_draws():
    peaks = np.array([6.55e3, 12e3, 18.4e3, 26e3, 52.0e3, 69.7e3])
    found = chance(peaks, MODES, 0.02, LOW, HIGH)

    def near(places):
        return (np.abs(places[..., None] / np.array(MODES) - 1.0) <= 0.02).any(axis=-1)

    axis = np.exp(np.linspace(math.log(LOW), math.log(HIGH), 400_001))
    assert found.coverage == pytest.approx(near(axis).mean(), abs=1e-4)
    assert (found.peaks, found.matches) == (6, near(peaks).sum()) == (6, 4)
    assert found.expected == pytest.approx(6 * found.coverage)
    draws = np.exp(np.random.default_rng(3).uniform(math.log(LOW), math.log(HIGH), (100_000, 6)))
    counts = near(draws).sum(axis=1)
    assert found.expected == pytest.approx(counts.mean(), abs=0.02)
    assert found.probability == pytest.approx(np.mean(counts >= 4), abs=3e-3)


def test_peaks_beyond_the_range_are_not_counted_and_no_modes_match_none():
    assert chance([1e3, 6.5e3, 80e3], MODES, 0.02, LOW, HIGH).peaks == 1
    none = chance([6.5e3], [], 0.02, LOW, HIGH)
    assert (none.matches, none.coverage, none.probability) == (0, 0.0, 1.0)
    assert chance([], MODES, 0.02, LOW, HIGH).probability == 1.0


def test_who_may_choose_matches_more_easily():
    """Ten choices without common coverage: some choice fits well, and one of chance's does so too."""
    choices = [[LOW * 1.05**k] for k in range(10)]
    peaks = [LOW * 1.05**3, 40e3, 60e3]
    best, probability = best_of(peaks, choices, 0.02, LOW, HIGH)
    assert best == 3
    alone = chance(peaks, choices[3], 0.02, LOW, HIGH)
    # none of three peaks in any of ten bands; the first band is cut at the range's end
    share = sum(chance(peaks, modes, 0.02, LOW, HIGH).coverage for modes in choices)
    assert probability == pytest.approx(1.0 - (1.0 - share) ** 3, abs=0.012)  # 20,000 draws
    assert probability > 4.0 * alone.probability
    assert best_of(peaks, choices[3:4], 0.02, LOW, HIGH)[1] == pytest.approx(alone.probability, abs=0.01)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"tolerance": 0.0}, "tolerance 0.0"),
        ({"lowest": HIGH}, "0 < lowest < highest"),
        ({"peaks": [-1.0]}, "peaks hold"),
        ({"modes": [np.nan]}, "modes hold"),
    ],
)
def test_refusals(change, message):
    arguments = {"peaks": [6e3], "modes": MODES, "tolerance": 0.02, "lowest": LOW, "highest": HIGH} | change
    with pytest.raises(ValueError, match=message):
        chance(**arguments)
    with pytest.raises(ValueError, match="choices is empty"):
        best_of([6e3], [], 0.02, LOW, HIGH)
    with pytest.raises(ValueError, match="between 0 and 1"):
        at_least(1, [1.2])
