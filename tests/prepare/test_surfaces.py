"""Surfaces: power law, contact filter, highest orders, form of the balls."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipk

from fmu_bearing.prepare.imperfections import Harmonics, ball_waves, fastest_wave, intervals, race_harmonics
from fmu_bearing.prepare.surfaces import (
    HIGHEST_BALL_ORDER,
    ball_profile,
    contact_filter,
    highest_orders,
    law,
    mean_patches,
)
from tests.marks import heavy_but
from tests.oracles import B7003C, B7009C
from tests.oracles.hertz import race_contact
from tests.oracles.jones_harris import JonesHarris


def flawed(scene, operation=None, **values):
    """The scene with the law of grade P4, and other values."""
    given = {"waviness_exponent": 1.35, "highest_order": None, "contact_filter": True} | values
    made = scene.model_copy(update={"imperfections": scene.imperfections.model_copy(update=given)})
    return made.model_copy(update={"operation": scene.operation.model_copy(update=operation or {})})


@pytest.mark.parametrize("u", [0.0, 1e-6, 0.3, 1.0, 3.0, 4.4934094579, 10.0, 60.0])
def test_filter_is_the_mean_over_the_contact(u):
    mean, _ = quad(lambda x: 0.5 * np.cos(u * x), -1.0, 1.0, epsabs=1e-13, limit=200)
    assert contact_filter(u) == pytest.approx(mean, abs=1e-12)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0])
@pytest.mark.parametrize("u", [0.6, 1.0, 2.0, 4.0])
def test_filter_weighs_with_the_pressure_of_a_flat_punch(u, ratio):
    """Change of load by a wave along the track: integral of -dp/d(approach) over the ellipse times the wave.

    p = p0 sqrt(1 - x2 - y2) on an ellipse of fixed shape whose axes go with the root of the approach and p0
    with it: differentiated by finite differences, integrated in polar coordinates on the larger ellipse.
    ``ratio``: of the axis across the track to that along it, ``u``: wave number times the latter.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    node, weight = np.polynomial.legendre.leggauss(400)
    radius, share = 0.5 * (node + 1.0), 0.5 * weight

    def total(approach, wave):
        size, peak = np.sqrt(approach), np.sqrt(approach)
        x = size * np.outer(radius, np.cos(angle))
        pressure = peak * np.sqrt(1.0 - radius**2)
        cell = ratio * size**2 * radius * share
        return float((pressure * cell) @ (np.cos(u * x).mean(axis=1) if wave else np.ones(radius.size)))

    step = 1e-5
    of_wave, whole = (total(1.0 + step, wave) - total(1.0 - step, wave) for wave in (True, False))
    # differences: second order of the step; sum of the root at the rim: 400 points, 1e-7
    assert contact_filter(u) == pytest.approx(of_wave / whole, abs=1e-6)


@pytest.mark.parametrize(
    ("u", "half_space"),
    [
        (0.3, 0.9850),
        (0.6, 0.9411),
        (1.0, 0.8417),
        (1.5, 0.6655),
        (2.0, 0.4551),
        (2.5, 0.2401),
        (3.0, 0.0477),
        (4.0, -0.1892),
    ],
)
def test_filter_against_a_half_space(u, half_space):
    """Ball on the outer race of a 6205, 180 N, waves of 20 nm; its grid leaves 0.001."""
    assert contact_filter(u) == pytest.approx(half_space, abs=1e-3)


def cells_in_contact(half_length, half_width, count):
    """Centres of square cells in an ellipse, and displacements of each under unit pressure on every other.

    Boussinesq's 1/r over a rectangle (Love 1929) for a half-space of pi E* = 1. ``count``: across the width.
    """
    side = 2.0 * half_width / count
    rows = np.arange(-int(half_length / side) - 1, int(half_length / side) + 2) * side
    columns = (np.arange(count) - 0.5 * (count - 1)) * side
    x, y = (part.ravel() for part in np.meshgrid(columns, rows))
    inside = (x / half_width) ** 2 + (y / half_length) ** 2 < 1.0
    x, y = x[inside], y[inside]

    def corner(a, b):
        return a * np.arcsinh(b / np.abs(a)) + b * np.arcsinh(a / np.abs(b))

    dx, dy = x[:, None] - x, y[:, None] - y
    ends = (-0.5 * side, 0.5 * side)
    return x, sum(np.sign(a) * np.sign(b) * corner(dx + a, dy + b) for a in ends for b in ends)


@pytest.mark.parametrize("u", heavy_but([1.0, 3.0, 4.0], 1))
@pytest.mark.parametrize(("ratio", "error"), [(1.0, 0.025), (4.0, 0.006)])
def test_filter_against_pressures_that_follow_a_wave(u, ratio, error):
    """Change of load by a wave pressed into a half-space, over that by an approach of its height.

    Small waves leave the ellipse as it is, so both are solutions of one set of equations. Cells stand for an
    ellipse of other size, which follows from the load of a flat punch, pi E* a/K(1 - b2/a2) by its
    approach; what is left is their ``error``. A weight by Hertz's pressure would give 0.90, 0.35 and 0.09.
    """
    count = 24
    x, displacement = cells_in_contact(ratio, 1.0, count)
    punch = np.linalg.solve(displacement, np.ones(x.size)).sum() * (2.0 / count) ** 2
    size = punch / (ratio / ellipk(1.0 - ratio**-2))
    wave, whole = (
        np.linalg.solve(displacement, one).sum() for one in (np.cos(u * x / size), np.ones(x.size))
    )
    assert contact_filter(u) == pytest.approx(wave / whole, abs=error)


def test_law_is_a_straight_line_without_filter():
    orders = np.array([1, 2, 10, 100])
    assert law(0.3, 1.35, orders, 0.0) == pytest.approx(0.3 * orders**-1.35, rel=1e-15)
    # order 12 of grade P4: 10 nm
    assert 1e3 * law(0.3, 1.35, [12], 0.0)[0] == pytest.approx(10.5, abs=0.1)


def test_filter_acts_where_waves_are_as_short_as_the_contact(scene):
    """W is near 0.9 at u = 0.8: orders 170 of the 7003C and 370 of the 7009C, half-widths of 50 to 80 um."""
    for name, order in (("7003C-bare", 170), ("7009C-steel", 370)):
        inner, _ = mean_patches(scene(name))
        assert 4.5e-5 < inner.half_width < 8e-5
        # W falls from 0.95 to 0.85 within a factor of 1.7 in order
        assert float(contact_filter(order * inner.half_width / inner.radius)) == pytest.approx(0.9, abs=0.05)


@pytest.mark.parametrize(("name", "bearing"), [("7003C-bare", B7003C), ("7009C-full-ceramic", B7009C)])
@pytest.mark.parametrize("rpm", [0.0, 20000.0])
def test_contacts_against_the_five_freedoms(scene, name, bearing, rpm):
    at = flawed(scene(name), {"speed_rpm": rpm})
    force = (at.mounting.preload_N, 0.0, 0.0)
    ball = JonesHarris(bearing, gyroscopic=False).solve(force, rpm * np.pi / 30.0).balls[0]
    inner, outer = mean_patches(at)
    for patch, race, load, angle, side in (
        (inner, "inner", ball.inner_load, ball.inner_angle, -1.0),
        (outer, "outer", ball.outer_load, ball.outer_angle, 1.0),
    ):
        # the kinematic orbit is that of the free contact angle: 1 % of the centrifugal force
        assert patch.half_width == pytest.approx(race_contact(bearing, race, load).semi_minor, rel=3e-3)
        radius = 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(angle))
        assert patch.radius == pytest.approx(radius, rel=1e-3)


@pytest.mark.parametrize("rpm", [3000.0, 20000.0, -20000.0])
def test_highest_orders_sound_at_the_highest_frequency(scene, rpm):
    bare = flawed(scene("7003C-bare"), {"speed_rpm": rpm}, highest_frequency_kHz=8.0)
    orders = highest_orders(bare)
    shaft = abs(rpm) / 60.0
    orbit, spin = kinematics_of(bare, shaft)
    for order, rate, limit in (
        (orders.inner, shaft - orbit, 1000),
        (orders.outer, orbit, 1000),
        (orders.balls, spin, 80),
    ):
        assert order * rate <= 8000.0 * (1 + 1e-9)
        assert order == limit or (order + 1) * rate > 8000.0


def test_the_lowest_speed_decides(scene):
    bare = scene("7003C-bare")
    slow = flawed(bare, {"speed_rpm": 5000.0})
    assert highest_orders(flawed(bare, {"lowest_speed_rpm": 5000.0})) == highest_orders(slow)
    assert highest_orders(flawed(bare, highest_order=77))[:2] == (77, 77)


def test_a_phase_belongs_to_its_order(scene):
    bare = scene("7003C-bare")
    low, high, all_of_them = (
        race_harmonics(flawed(bare, highest_order=order, lowest_order=lowest))
        for order, lowest in ((20, 2), (400, 2), (400, 1))
    )
    for race in range(2):
        assert np.array_equal(low[race].phases, high[race].phases[:19])
        assert np.array_equal(low[race].amplitudes, high[race].amplitudes[:19])
        assert np.array_equal(all_of_them[race].phases[1:], high[race].phases)


def test_races_have_phases_of_their_own(scene):
    """Both races of one seed: 399 orders, whose differences of phase are as good as uniform; order 1, too."""
    inner, outer = race_harmonics(flawed(scene("7003C-bare"), highest_order=400, lowest_order=1))
    apart = np.exp(1j * (inner.phases - outer.phases))
    # the mean of N unit vectors of chance is longer than 3 / sqrt(N) once in 8,000 times; the seed is fixed
    assert abs(apart.mean()) < 3.0 / np.sqrt(apart.size)
    assert abs(apart[0] - 1.0) > 1e-3


def test_balls_deviate_by_their_form(scene):
    flaws = flawed(scene("7003C-bare"), ball_form_nm=80.0).imperfections
    for highest in (2, 12, HIGHEST_BALL_ORDER):
        amplitudes = ball_profile(flaws, highest, 0.0)
        assert amplitudes.size == highest and amplitudes[0] == 0.0
        x = np.random.default_rng(1).uniform(-1.0, 1.0, 200_000)
        heights = np.polynomial.legendre.legval(x, [0.0, *amplitudes])
        # the extremes of the random places miss the true ones by little
        assert np.ptp(heights) == pytest.approx(80e-9, rel=2e-3)
    n = np.arange(2, HIGHEST_BALL_ORDER + 1)
    assert np.abs(amplitudes[1:]) * n**1.35 == pytest.approx(abs(amplitudes[1]) * 2**1.35, rel=1e-12)


def test_lowest_order_of_the_races_leaves_the_balls_alone(scene):
    """A band below twice the balls' spin still gives them order 2; order 50 of the races asks no more."""
    bare = scene("7003C-bare")
    slow = flawed(bare, ball_form_nm=80.0, highest_order=None, highest_frequency_kHz=1.0, lowest_order=1)
    assert highest_orders(slow).balls == 2
    assert list(ball_waves(slow)[0] != 0.0) == [False, True]
    assert highest_orders(flawed(slow, lowest_order=50)).balls == 2


def test_tables_resolve_their_waves():
    assert [intervals(n) for n in (0, 20, 256, 257, 1000)] == [2048, 2048, 2048, 4096, 8192]


def test_fastest_wave(scene):
    bare = flawed(scene("7003C-bare"), highest_order=50)
    orbit, spin = kinematics_of(bare, 1.0)
    assert fastest_wave(bare, race_harmonics(bare), 0) == pytest.approx(50 * (1.0 - orbit), rel=1e-12)
    assert fastest_wave(bare, race_harmonics(bare), 40) == pytest.approx(40 * spin, rel=1e-12)


@pytest.mark.parametrize(("inner", "outer"), [(12, 40), (40, 12), (30, 40)])
def test_waves_of_each_race_pass_at_its_own_rate(scene, inner, outer):
    """Balls go round at 0.42 of the shaft's speed: they meet a wave of the inner race 1.4 times as often."""
    bare = scene("7003C-bare")
    orbit, _ = kinematics_of(bare, 1.0)
    races = tuple(Harmonics(np.ones(2), np.array([2, most]), np.zeros(2)) for most in (inner, outer))
    assert fastest_wave(bare, races, 0) == pytest.approx(max(inner * (1.0 - orbit), outer * orbit), rel=1e-12)


def kinematics_of(scene, shaft):
    """Orbit and spin frequency (Hz) of rolling balls."""
    b = scene.bearing
    ratio = b.ball_diameter_mm / b.pitch_diameter_mm * np.cos(np.radians(b.contact_angle_deg))
    return 0.5 * shaft * (1 - ratio), 0.5 * shaft * b.pitch_diameter_mm / b.ball_diameter_mm * (1 - ratio**2)
