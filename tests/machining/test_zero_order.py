"""Lobes of zero order against closed forms, and against milling in time with its delay."""

import math

import numpy as np
import pytest

from fmu_bearing.machining.zero_order import Cut, angles, branches, depths, in_the_cut, limit_at, phases
from tests.machining import delay

K, ZETA, F0 = 2e7, 0.03, 1000.0
TEETH, KT, KR = 4, 600e6, 0.3


def one_mode(hertz, stiffness=K, damping=ZETA, own=F0):
    r = hertz / own
    return 1.0 / (stiffness * (1.0 - r**2 + 2j * damping * r))


def along_feed(hertz, aside=0.0):
    g = np.zeros((len(hertz), 2, 2), dtype=complex)
    g[:, 0, 0] = one_mode(hertz)
    g[:, 1, 1] = aside * one_mode(hertz, own=1.1 * F0)
    return g


SLOT = Cut(TEETH, KT, KR, *angles(1.0, "up"))


def test_least_real_part_of_one_mode():
    hertz = np.linspace(900.0, 1300.0, 4001)
    assert one_mode(hertz).real.min() == pytest.approx(-1.0 / (4.0 * K * ZETA * (1.0 + ZETA)), rel=1e-5)


def test_a_slot_with_one_mode_along_the_feed_has_its_limit_in_closed_form():
    """8 k zeta (1 + zeta) / (N K_t k_r) at w sqrt(1 + 2 zeta): 6.8667 mm at 1029.56 Hz."""
    hertz = np.linspace(900.0, 1300.0, 4001)
    found = depths(SLOT, branches(SLOT, along_feed(hertz, 1e-12))).ravel()
    positive = np.where(found > 0.0, found, np.inf)
    least = int(positive.argmin())
    assert 1e3 * positive[least] == pytest.approx(6.8667, abs=1e-4)
    assert positive[least] == pytest.approx(8.0 * K * ZETA * (1.0 + ZETA) / (TEETH * KT * KR), rel=1e-5)
    assert np.tile(hertz, 2)[least] == pytest.approx(F0 * math.sqrt(1.0 + 2.0 * ZETA), abs=0.1)


def test_the_limit_meets_the_equation_that_it_is_from():
    """det(I + L A G) = 0 with L = -N a K_t / 4 pi (1 - exp(-i w T)): at limits and speeds of the lobes."""
    rng = np.random.default_rng(61)
    hertz = np.linspace(900.0, 1300.0, 101)
    g = along_feed(hertz, 0.7)
    g[:, 0, 1] = 0.3j * g[:, 0, 0]
    g[:, 1, 0] = -0.3j * g[:, 0, 0]
    cut = Cut(3, KT, KR, *angles(0.6, "down"))
    values = branches(cut, g)
    found, turned = depths(cut, values), phases(values)
    for branch, k in zip(*np.nonzero(found > 0.0), strict=True):
        period = (turned[branch, k] + 2.0 * math.pi * rng.integers(1, 9)) / (2.0 * math.pi * hertz[k])
        back = np.exp(-2j * math.pi * hertz[k] * period)
        factor = -3.0 * found[branch, k] * KT / (4.0 * math.pi) * (1.0 - back)
        left = np.linalg.det(np.eye(2) + factor * cut.directions @ g[k])
        assert abs(left) < 1e-9


def test_branches_are_continuous():
    hertz = np.linspace(800.0, 1400.0, 3001)
    g = along_feed(hertz, 1.0)
    g[:, 0, 1], g[:, 1, 0] = 0.4j * g[:, 1, 1], -0.4j * g[:, 1, 1]
    steps = np.abs(np.diff(branches(SLOT, g), axis=1))
    assert steps.max() < 0.05 * np.abs(branches(SLOT, g)).max()


@pytest.mark.parametrize("positive", [True, False])
def test_axes_of_the_cut(positive):
    """Fed to -Y (90 deg from 12 o'clock) by a shaft that turns about +X: teeth go from Z to -Y."""
    g = np.array([[1.0, 2.0], [3.0, 4.0]], dtype=complex)
    found = in_the_cut(g, math.pi / 2.0, positive)
    # u = -Y; v = Z, or for the other sense -Z
    sign = 1.0 if positive else -1.0
    np.testing.assert_allclose(found, [[1.0, -sign * 2.0], [-sign * 3.0, 4.0]], atol=1e-15)


def test_angles_and_what_is_refused():
    assert angles(1.0, "up") == angles(1.0, "down") == (0.0, math.pi)
    assert angles(0.5, "up") == pytest.approx((0.0, math.pi / 2.0))
    assert angles(0.5, "down") == pytest.approx((math.pi / 2.0, math.pi))
    assert angles(0.25, "up") == pytest.approx((0.0, math.pi / 3.0))
    with pytest.raises(
        ValueError, match=r"radial_immersion = 0\.2 is refused; allowed: 0\.25 to 1: .* twice the"
    ):
        angles(0.2, "down")


@pytest.mark.parametrize(
    ("immersion", "direction", "teeth", "rpm", "low", "high"),
    [
        # four teeth in a slot: two are in the cut at any time, and their forces are their mean at any time
        (1.0, "up", 4, 14_000.0, 0.99, 1.01),
        (1.0, "up", 4, 10_500.0, 0.99, 1.01),
        # forces that change about their mean: limits in time are 0.95, 1.03 and 0.96 of these
        (0.5, "down", 4, 9_000.0, 0.9, 1.05),
        (0.5, "down", 4, 10_000.0, 0.95, 1.1),
        (0.5, "up", 4, 12_000.0, 0.9, 1.0),
        # three teeth of which one or two cut: the mean is 1.22 times too careful, and at 14,000 r/min 1.34
        (0.75, "down", 3, 13_000.0, 1.1, 1.35),
        (0.75, "down", 3, 14_000.0, 1.2, 1.5),
    ],
)
def test_just_above_the_limit_it_grows_in_time_and_just_below_it_dies(
    immersion, direction, teeth, rpm, low, high
):
    """``low``, ``high``: shares of the limit between which that in time is."""
    cut = Cut(teeth, KT, KR, *angles(immersion, direction))
    hertz = np.linspace(300.0, 3000.0, 10_801)
    g = along_feed(hertz)
    g[:, 1, 1] = one_mode(hertz, 1.3 * K, 0.02, 1.3 * F0)
    limit, _ = limit_at(cut, branches(cut, g), hertz, rpm)
    parts = [delay.of_mode(K, ZETA, F0), delay.of_mode(1.3 * K, 0.02, 1.3 * F0, (0.0, 1.0))]
    poles = (
        np.concatenate([one[0] for one in parts]), np.vstack([one[1] for one in parts]),
        np.hstack([one[2] for one in parts]),
    )  # fmt: skip
    above, below = (
        delay.growth(poles, limit * share, rpm, teeth, KT, KR, cut.entry, cut.exit) for share in (high, low)
    )
    assert above > 0.0 > below
