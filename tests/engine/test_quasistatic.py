"""The quasi-static kernel against published-style gates and an independent SciPy solution."""

import numpy as np
import pytest
from scipy.optimize import brentq

from fmu_bearing.engine.layout import P
from fmu_bearing.prepare.model import pack
from tests.engine.helpers import RPM
from tests.engine.quasistatic import solve
from tests.oracles import B7003C, B7009C
from tests.oracles.jones_harris import JonesHarris


def test_hertz_constants(scene):
    for name, inner, outer in (
        ("7003C-bare", 2.541e10, 2.407e10),
        ("7009C-full-ceramic", 3.575e10, 3.361e10),
    ):
        p = pack(scene(name), np.empty(0))
        assert p[P.RACES + P.RACE_STIFFNESS] == pytest.approx(inner, rel=5e-3)
        assert p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS] == pytest.approx(outer, rel=5e-3)


@pytest.mark.parametrize(("inner", "outer"), [(60.0, 60.0), (10.0, 0.0), (-40.0, 30.0)])
def test_axial_place_without_load_over_temperature(scene, inner, outer):
    """Groove centres are apart by both groove radii less the ball's diameter, where the ball just touches.

    Every length of a ring grows with its own temperature (11.8e-6/K), the ball with the mean (3.2e-6/K): also
    the axial places of the groove centres about the ring's own middle, 0.02 um of the shift at 60 K.
    """

    def place(inner, outer):
        first, second = 1.0 + 11.8e-6 * inner, 1.0 + 11.8e-6 * outer
        ball = 4.5e-3 * (1.0 + 3.2e-6 * 0.5 * (inner + outer))
        apart = 4.5e-3 * (0.515 * first + 0.52 * second) - ball
        reach_i, reach_o, sine, cosine = 0.015 * 4.5e-3, 0.02 * 4.5e-3, np.sin(np.pi / 12), np.cos(np.pi / 12)
        across = (13e-3 + reach_i * cosine) * first - (13e-3 - reach_o * cosine) * second
        return np.sqrt(apart**2 - across**2) - (reach_i * first + reach_o * second) * sine

    assert place(0.0, 0.0) == pytest.approx(0.0, abs=1e-15)
    given, load = scene("7003C-bare"), 1e-5  # N: 0.1 nm of elastic approach
    cold = solve(given, 0.0, load)["shift"]
    warm = solve(given, 0.0, load, inner=293.15 + inner, outer=293.15 + outer)["shift"]
    assert warm - cold == pytest.approx(place(inner, outer), abs=1e-9)


def test_static_gate_of_the_7003c(scene):
    found = solve(scene("7003C-bare"), 0.0, 500.0)
    # gates of the design study, stated within 0.5 %
    assert found["load_i"] == pytest.approx(115.62, rel=5e-3)
    assert found["angle_i"] == pytest.approx(21.12, rel=5e-3)
    assert found["shift"] == pytest.approx(18.01e-6, rel=5e-3)
    axial, radial, tilt, _ = found["stiffness"]
    assert axial == pytest.approx(5.57e7, rel=5e-3)
    assert radial == pytest.approx(1.63e8, rel=5e-3)
    assert tilt == pytest.approx(4.73e3, rel=5e-3)


def test_static_gate_of_the_7009c(scene):
    found = solve(scene("7009C-full-ceramic"), 0.0, 350.0)
    assert found["load_i"] == pytest.approx(70.11, rel=5e-3)
    assert found["angle_i"] == pytest.approx(17.08, rel=5e-3)
    assert found["shift"] == pytest.approx(11.58e-6, rel=5e-3)


@pytest.mark.parametrize(
    ("name", "bearing", "rpm", "preload"),
    [
        ("7003C-bare", B7003C, 20e3, 500.0),
        ("7003C-bare", B7003C, 40e3, 500.0),
        ("7009C-full-ceramic", B7009C, 18e3, 350.0),
    ],
)
def test_against_the_independent_solution(scene, name, bearing, rpm, preload):
    found = solve(scene(name), rpm, preload)
    oracle = JonesHarris(bearing).solve((preload, 0.0, 0.0), rpm * RPM)
    ball = oracle.balls[0]
    # same equations and geometry, other unknowns and solver: agreement to the solvers' tolerance
    assert found["load_i"] == pytest.approx(ball.inner_load, rel=1e-6)
    assert found["load_o"] == pytest.approx(ball.outer_load, rel=1e-6)
    assert found["angle_i"] == pytest.approx(np.degrees(ball.inner_angle), rel=1e-6)
    assert found["angle_o"] == pytest.approx(np.degrees(ball.outer_angle), rel=1e-6)


@pytest.mark.parametrize("rpm", [0.0, 1.0, 1e3, 4e4, 1e5])
@pytest.mark.parametrize("preload", [0.0, 1.0, 500.0, 1e4])
def test_equilibrium_at_the_extremes(scene, rpm, preload):
    found = solve(scene("7003C-bare"), rpm, preload)
    values = np.array([found[k] for k in ("load_i", "load_o", "angle_i", "angle_o", "shift", "orbit")])
    assert np.isfinite(values).all()
    mass = 3200 * np.pi / 6 * 4.5e-3**3
    # radial balance of a ball: outer load less inner load carries the centrifugal force (gyroscopic pair
    # shifts it by up to 2 % of the force at 100,000 r/min)
    radial = found["load_o"] * np.cos(np.radians(found["angle_o"])) - found["load_i"] * np.cos(
        np.radians(found["angle_i"])
    )
    force = mass * 13e-3 * found["orbit"] ** 2
    assert radial == pytest.approx(force, rel=0.03, abs=1e-3)


def test_a_hotter_inner_ring_lowers_the_contact_angle(scene):
    """Under constant preload a radial growth of the inner groove closes the free angle."""
    bare = scene("7003C-bare")
    hot = solve(bare, 0.0, 500.0, inner=303.15)
    p = pack(bare, np.empty(0))

    def angle(rise_inner):
        """Static angle from (A + d(Q)) cos a = R_ci - R_co with Q = F / (Z sin a), grown groove by groove."""
        growth = 1 + 11.8e-6 * rise_inner
        ball = 4.5e-3 * (1 + 3.2e-6 * rise_inner / 2)
        reach = (0.515 * growth + 0.52) * 4.5e-3 - ball
        start = np.radians(15)
        apart = (13e-3 + (0.515 - 0.5) * 4.5e-3 * np.cos(start)) * growth - (
            13e-3 - 0.02 * 4.5e-3 * np.cos(start)
        )
        k_i, k_o = p[P.RACES + P.RACE_STIFFNESS], p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS]

        def open_loop(a):
            q = 500.0 / (12 * np.sin(a))
            return (reach + (q / k_i) ** (2 / 3) + (q / k_o) ** (2 / 3)) * np.cos(a) - apart

        return np.degrees(brentq(open_loop, 0.1, 0.8, xtol=1e-14))

    assert angle(10.0) - angle(0.0) == pytest.approx(-1.16, abs=0.01)  # degrees: direction and size
    assert hot["angle_i"] == pytest.approx(angle(10.0), rel=1e-6)
