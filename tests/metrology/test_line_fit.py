"""Lines by least squares: against NumPy's solution of the whole equations, and the near-integer trap."""

from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing.acoustics.analysis.origins import bearing_origins, shaft_origins
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.metrology.line_fit import LineFit
from fmu_bearing.metrology.polar_values import revolutions_of, synchronous
from tests.marks import heavy_but

POINTS = 256
#: Orders of a 7003C hybrid at 2000 r/min: f_o lies 0.04 beside 5 f_r, f_i as far beside 7 f_r.
CAGE, SPIN, BALLS = 0.41999, 2.82302, 12
RATES = KinematicFrequencies(1.0, CAGE, SPIN, BALLS * (1.0 - CAGE), BALLS * CAGE)


def angles(revolutions):
    return 2.0 * np.pi * np.arange(1, revolutions * POINTS + 1) / POINTS


def plain(signals, orders, revolutions):
    """Constant and complex amplitudes by the matrix of all cosines and sines."""
    turned = angles(revolutions)[:, None] * np.asarray(orders)
    table = np.hstack([np.ones((len(turned), 1)), np.cos(turned), np.sin(turned)])
    found = np.linalg.lstsq(table, signals, rcond=None)[0]
    count = len(orders)
    return np.vstack([found[:1], found[1 : count + 1] - 1j * found[count + 1 :]])


def test_amplitudes_are_those_of_the_equations_written_out():
    """Random signals: what the fit leaves is as little as NumPy's."""
    lines = [one for one in shaft_origins(12) + bearing_origins(RATES, 12.0) if one.terms <= 3]
    signals = np.random.default_rng(5).normal(size=(20 * POINTS, 2))
    fit = LineFit(lines, 20, POINTS)
    found = fit.amplitudes(signals)
    wanted = plain(signals, fit.orders[1:], 20)
    # the pull moves an amplitude by 9e-6 of itself at three terms, more where neighbours are near
    np.testing.assert_allclose(found, wanted, atol=1e-3 * np.abs(wanted).max())


def test_sum_of_lines_and_its_parts():
    lines = shaft_origins(3) + bearing_origins(RATES, 6.0)
    fit = LineFit(lines, 24, POINTS)
    made = np.cos(2.0 * angles(24) + 0.3) + 0.5 * np.cos(RATES.f_o * angles(24) - 1.0)
    amplitudes = fit.amplitudes(made[:, None])
    both = fit.signals(amplitudes, np.arange(len(lines)))[:, 0]
    # lines are exact: 1e-6 times the square of the terms is left
    np.testing.assert_allclose(both, made, atol=1e-4)
    alone = fit.signals(amplitudes, np.array([1]))[:, 0]
    np.testing.assert_allclose(alone, np.cos(2.0 * angles(24) + 0.3), atol=1e-4)


@pytest.mark.parametrize("revolutions", heavy_but([16, 20, 50, 200], 0, 1, 2))
def test_a_race_near_a_whole_order_is_not_taken_for_synchronous(revolutions):
    """The trap: an average over few revolutions holds most of a line 0.04 orders beside a whole one."""
    turned = angles(revolutions)
    race = 20.0 * np.cos(RATES.f_o * turned + 1.0) + 10.0 * np.cos((RATES.f_i - 1.0) * turned - 0.4)  # nm
    shaft = 2.0 * np.cos(2.0 * turned) + 30.0 * np.cos(turned)
    signal = race + shaft
    mean = revolutions_of(signal, POINTS).mean(axis=0)
    lines = shaft_origins(40) + bearing_origins(RATES, 160.0)
    fit = LineFit(lines, revolutions, POINTS)
    whole = fit.signals(fit.amplitudes(signal[:, None]), np.arange(40))[:POINTS, 0]
    # range of the second order alone: 4 nm; the pull leaves 1e-5 of the races at 16 revolutions
    assert synchronous(whole, 2) == pytest.approx(4.0, abs=0.05)
    # what an average leaves of a line: a geometric series
    off = RATES.f_o - 5.0
    left = abs(np.sin(np.pi * off * revolutions) / (revolutions * np.sin(np.pi * off)))
    if revolutions == 16:
        assert left > 0.4  # 40 % of the race would pass for synchronous
        assert synchronous(mean, 2) > 8.0 + 4.0
    if revolutions in (50, 200):
        assert left < 0.01  # the cage turns 21 times in 50 revolutions, nearly
        assert synchronous(mean, 2) == pytest.approx(4.0, abs=1.0)


def test_a_line_beside_a_whole_order_lets_noise_grow():
    near = KinematicFrequencies(1.0, 5.005 / 12.0, SPIN, 12.0 - 5.005, 5.005)
    lines = [one for one in shaft_origins(6) + bearing_origins(near, 6.5, sidebands=0) if one.terms <= 6]
    growth = LineFit(lines, 20, POINTS).growth(np.arange(6))
    # 5 f_r beside f_o at a tenth of 1/20; others stand apart, at less than 30 % more than alone
    assert growth[4] > 3.0
    assert growth[[0, 1, 2]] == pytest.approx(1.0, abs=0.3)


def test_lines_at_one_order_share_by_the_squares_of_their_terms():
    """What nothing parts is shared so that the pull is least: terms 1 and 3 get 9 to 1."""
    lines = [replace(bearing_origins(RATES, 6.0)[0], order=CAGE, terms=terms) for terms in (1, 3)]
    fit = LineFit(lines, 20, POINTS)
    one, other = fit.amplitudes(np.cos(CAGE * angles(20))[:, None])[1:, 0]
    # the pull takes a millionth of the sum; equations this near to singular leave 1e-9
    assert one / other == pytest.approx(9.0, rel=1e-5)
    assert one + other == pytest.approx(1.0, abs=1e-5)
