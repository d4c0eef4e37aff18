"""Statistics against closed forms, and sentences that say what cannot be distinguished."""

import math

import numpy as np
import pytest

from fmu_bearing.identification.free import Free
from fmu_bearing.identification.statistics import (
    Spread,
    level_covariance,
    remarks,
    shrunk_covariance,
    uncertainty,
    whitener,
    widened,
)


def free(*names):
    return [Free(name, (name,), (1.0,), 0.1, 10.0, True) for name in names]


def test_weighted_least_squares_in_closed_form():
    rng = np.random.default_rng(1)
    slopes, root = rng.normal(size=(12, 3)), rng.normal(size=(12, 12))
    covariance = root @ root.T + np.eye(12)
    white = whitener(covariance)
    assert white @ covariance @ white == pytest.approx(np.eye(12), abs=1e-9)
    found = uncertainty(white @ slopes, np.zeros(12))
    assert found.covariance == pytest.approx(np.linalg.inv(slopes.T @ np.linalg.inv(covariance) @ slopes))
    assert found.singular_values == pytest.approx(np.linalg.svd(white @ slopes)[1])


def test_large_residuals_widen_and_small_ones_do_not_narrow():
    slopes = np.eye(6)[:, :2]
    small, large = uncertainty(slopes, np.full(6, 0.1)), uncertainty(slopes, np.full(6, 3.0))
    assert (small.scale, large.scale) == (1.0, pytest.approx(3.0 * math.sqrt(6 / 4)))
    assert large.covariance == pytest.approx(large.scale**2 * small.covariance)


def test_a_direction_without_influence_is_unknown():
    found = uncertainty(np.array([[1.0, 1.0], [2.0, 2.0], [1.0, 1.0]]), np.zeros(3))
    assert found.covariance[0, 0] > 1e9 and found.covariance[1, 1] > 1e9
    sentences = remarks(free("a", "b"), found, [1.0, 1.0], 12)
    assert any(
        "do not distinguish" in s and "a" in s and "b" in s and "while lowering" in s for s in sentences
    )


def test_shrunk_covariance_keeps_variances_and_real_correlation():
    rng = np.random.default_rng(2)
    common = rng.normal(size=(400, 1))
    samples = common * [1.0, 2.0, 0.0] + 0.1 * rng.normal(size=(400, 3))
    found, plain = shrunk_covariance(samples), np.cov(samples.T)
    assert np.diag(found) == pytest.approx(np.diag(plain))
    # 400 samples of a correlation of 0.99 leave nothing to shrink; of three unrelated columns all
    assert found[0, 1] == pytest.approx(plain[0, 1], rel=0.02)
    few = rng.normal(size=(6, 3))
    unrelated, chance = shrunk_covariance(few), np.cov(few.T)
    assert abs(unrelated[0, 1]) < 0.5 * abs(chance[0, 1])
    assert not shrunk_covariance(samples[:1]).any()
    assert np.linalg.eigvalsh(level_covariance(np.full(3, 2.0), samples[:5], 4)).min() >= 4.0 - 1e-9


def test_covariance_of_levels_by_hand():
    """Three seeds with variances 4 and 3 dB2, whose mean of two is compared: 1.5 times that and noise.

    The bearing that was measured has a draw of its own, and the mean of two seeds half the variance more.
    """
    seeds = np.array([[70.0, 60.0], [72.0, 60.0], [74.0, 63.0]])
    found = level_covariance(np.array([0.5, 1.0]), seeds, averaged=2)
    assert found == pytest.approx(np.diag([0.25 + 1.5 * 4.0, 1.0 + 1.5 * 3.0]), rel=1e-12)
    many = level_covariance(np.zeros(2), seeds, averaged=1000)
    assert many == pytest.approx(np.diag([4.004, 3.003]), rel=1e-12)


def test_bending_levels_widen_one_direction_alone():
    spread = Spread(np.diag([0.01, 0.04]), np.array([10.0, 5.0]), np.eye(2), 1.0)
    found = widened(spread, np.array([2.0, 0.25]))
    assert found.covariance == pytest.approx(np.diag([0.01, 0.16]))


def test_sentences():
    equal = Spread(np.array([[0.04, 0.038], [0.038, 0.04]]), np.array([20.0, 4.0]), np.eye(2), 2.0)
    said = " ".join(remarks(free("a", "b"), equal, [0.1, 2.0], 5))
    assert "5 fitted values carry 1 free keys" in said
    assert "residuals are 2.0 times" in said
    assert "a is at its low bound, 0.1" in said
    assert "rise and fall together (correlation +0.95)" in said
    lost = Spread(np.diag([0.01, 4.0]), np.array([10.0, 0.5]), np.eye(2), 1.0)
    assert any("do not determine b: a factor of 7.4" in s for s in remarks(free("a", "b"), lost, [1, 1], 9))
    clear = Spread(np.diag([0.01, 0.01]), np.array([10.0, 10.0]), np.eye(2), 1.0)
    assert not remarks(free("a", "b"), clear, [1.0, 1.0], 6)
