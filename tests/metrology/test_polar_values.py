"""Synchronous and asynchronous values of signals whose values are known."""

import numpy as np
import pytest

from fmu_bearing.metrology.nose import whole_turns
from fmu_bearing.metrology.polar_values import asynchronous, contour, fundamental, revolutions_of, synchronous

POINTS = 256
ANGLE = 2.0 * np.pi * np.arange(1, 40 * POINTS + 1) / POINTS


def test_what_repeats_has_no_width():
    rows = revolutions_of(3.0 + np.cos(ANGLE) + 0.2 * np.cos(3.0 * ANGLE), POINTS)
    # rounding of the cosines at angles up to 250 rad
    assert asynchronous(rows) < 1e-12
    assert synchronous(rows.mean(axis=0), 2) == pytest.approx(0.4, rel=1e-3)  # highest at one of 256 places
    assert synchronous(rows.mean(axis=0), 1) > 2.0
    assert fundamental(rows.mean(axis=0)) == pytest.approx(2.0, rel=1e-12)


def test_width_is_the_range_over_revolutions_at_the_widest_angle():
    # at every angle the phases 0.42 n of 40 revolutions are spread over the circle, 2 pi / 50 apart at most
    rows = revolutions_of(np.cos(0.42 * ANGLE), POINTS)
    assert asynchronous(rows) == pytest.approx(2.0, abs=0.005)
    assert asynchronous(rows + np.cos(5.0 * ANGLE[:POINTS])) == pytest.approx(2.0, abs=0.005)


def test_centre_of_least_squares_is_that_of_a_circle_fit():
    """Orders 0 and 1 are the circle: against a fit of radius and centre to the points in the plane."""
    turn = ANGLE[:POINTS]
    base = 1e6  # much larger than the contour, where both agree
    radius = base + 3.0 * np.cos(turn - 0.4) + 0.7 * np.cos(2.0 * turn) + 0.1 * np.cos(9.0 * turn + 1.0)
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    table = np.column_stack([2.0 * x, 2.0 * y, np.ones_like(x)])
    (cx, cy, c), *_ = np.linalg.lstsq(table, x**2 + y**2, rcond=None)
    about = np.hypot(x - cx, y - cy) - np.sqrt(c + cx**2 + cy**2)
    # terms of second order: 3^2 / 1e6; squares of 1e6 keep 1e-4
    np.testing.assert_allclose(contour(radius, 2), about, atol=1e-3)


@pytest.mark.parametrize(
    ("ratios", "wanted"),
    # 21 turns of the cage in 50; 2/5 repeats: the longest average holds least of it; two cages: both
    [([0.42], 50), ([0.4199903], 50), ([0.42, 0.42], 50)],
)
def test_revolutions_in_which_the_cage_turns_wholly(ratios, wanted):
    assert whole_turns(ratios) == wanted


def test_worst_cage_counts():
    counts = np.arange(20, 121)
    ratios = (0.4172, 0.4193)
    off = np.max([np.abs(counts * one - np.rint(counts * one)) for one in ratios], axis=0) / counts
    assert whole_turns(list(ratios)) == counts[np.argmin(off)]
