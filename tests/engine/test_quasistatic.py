"""The quasi-static kernel against published-style gates and an independent SciPy solution."""

import numpy as np
import pytest
from scipy.optimize import brentq

from fmu_bearing.engine.layout import EQ, C, P, U, W
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.statics.quasistatic import equilibrium
from fmu_bearing.engine.status import OK
from fmu_bearing.prepare.model import pack
from tests.oracles import B7003C, B7009C
from tests.oracles.jones_harris import JonesHarris

RPM = np.pi / 30


class Bearing:
    """A scene's parameters and conditions, and the kernel's answers in SI units."""

    def __init__(self, scene, **parameters):
        self.p = pack(scene, np.empty(0))
        for name, value in parameters.items():
            self.p[getattr(P, name)] = value
        self.u = np.array([0.0, 0.0, 1e8, 0, 0, 293.15, 293.15, 293.15])
        self.c = np.zeros(C.SIZE)
        self.w = np.zeros(W.size(self.p))
        self.out = np.zeros(EQ.SIZE)
        self.balls = int(self.p[P.BALLS])
        conditions(self.p, self.u, 0.0, self.c)

    def solve(self, rpm, load, offset=(0.0, 0.0), status=OK):
        """Equilibrium under (Fx, Fy, Fz, My, Mz); the bearing itself, for its rows."""
        load, offset = np.array(load, dtype=float), np.array(offset, dtype=float)
        assert equilibrium(self.p, self.c, rpm * RPM, load, offset, self.out, self.w) == status
        return self

    def row(self, at_row):
        """A quantity of all balls."""
        return self.out[at_row : at_row + self.balls].copy()

    @property
    def shift(self):
        """Displacement of the inner ring against the outer: x, y, z, tilts y and z."""
        return self.out[EQ.SHIFT : EQ.SHIFT + 5].copy()

    @property
    def stiffness(self):
        """The 5 x 5 matrix."""
        return self.out[EQ.STIFFNESS : EQ.STIFFNESS + 25].reshape(5, 5).copy()


def solve(scene, rpm, preload, **temperatures):
    """Under axial load: loads (N), angles (deg), axial displacement (m), stiffness of equal balls."""
    bearing = Bearing(scene)
    bearing.u[U.INNER_T] = temperatures.get("inner", 293.15)
    bearing.u[U.OUTER_T] = temperatures.get("outer", 293.15)
    conditions(bearing.p, bearing.u, rpm * RPM, bearing.c)
    bearing.solve(rpm, (preload, 0, 0, 0, 0))
    k = bearing.stiffness
    return {
        "load_i": bearing.row(EQ.LOAD_I)[0],
        "load_o": bearing.row(EQ.LOAD_O)[0],
        "angle_i": np.degrees(bearing.row(EQ.ANGLE_I)[0]),
        "angle_o": np.degrees(bearing.row(EQ.ANGLE_O)[0]),
        "shift": bearing.shift[0],
        "orbit": bearing.row(EQ.OM)[0],
        # axial, radial, tilt, coupling of vertical force with the tilt about Y
        "stiffness": (k[0, 0], k[2, 2], k[3, 3], k[2, 3]),
    }


def test_hertz_constants(scene):
    for name, inner, outer in (
        ("7003C-bare", 2.541e10, 2.407e10),
        ("7009C-full-ceramic", 3.575e10, 3.361e10),
    ):
        p = pack(scene(name), np.empty(0))
        assert p[P.RACES + P.RACE_STIFFNESS] == pytest.approx(inner, rel=5e-3)
        assert p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS] == pytest.approx(outer, rel=5e-3)


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
