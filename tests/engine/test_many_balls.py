"""Bearings of 25 and 36 balls, the most: slopes, balance at rest, independent solution, energy."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import EQ, MAX_BALLS, STRIDE, C, F, P, Y
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.template import new_scene
from tests.engine import test_jacobian as jacobian
from tests.engine.helpers import RPM, quiet
from tests.engine.quasistatic import Bearing
from tests.extremes.bearings import MOST_BALLS, edited
from tests.extremes.cases import Case
from tests.extremes.checks import balanced
from tests.marks import heavy_but
from tests.oracles import Bearing as Geometry
from tests.oracles.jones_harris import JonesHarris


def bearing_of(balls):
    """The 7913C, which has 25 balls, and the 7009C with 36 smaller ones."""
    if balls == MAX_BALLS:
        return edited("7009C-full-ceramic", MOST_BALLS | {"sound": None})
    text = new_scene("7913C", "NSK-7913C", kind="full-ceramic", sound=False)
    return read_scene_text(text).with_rigid_rings()


@pytest.fixture(scope="module", params=[25, 36])
def many(request):
    one = bearing_of(request.param)
    assert one.bearing.ball_count == request.param
    return one


def geometry(scene):
    """Plain numbers of a scene for the oracle, whose rings are of one material."""
    b, ring, ball = scene.bearing, scene.materials.inner_ring, scene.materials.balls
    assert ring == scene.materials.outer_ring
    return Geometry(
        ball_diameter=1e-3 * b.ball_diameter_mm, pitch_diameter=1e-3 * b.pitch_diameter_mm,
        ball_count=b.ball_count, ring_modulus=1e9 * ring.youngs_modulus_GPa,
        ring_poisson=ring.poisson_ratio, inner_conformity=b.inner_conformity,
        outer_conformity=b.outer_conformity, contact_angle=np.radians(b.contact_angle_deg),
        ball_modulus=1e9 * ball.youngs_modulus_GPa, ball_poisson=ball.poisson_ratio,
        ball_density=ball.density_kg_m3,
    )  # fmt: skip


def test_slopes_are_those_of_differences(many):
    """All displaced and sliding, one ball off its races; without waves, within the bounds of fewer balls.

    Seed 1 puts one of 32 balls where a step of the differences crosses a kink: 9 %, and 5e-6 with steps of a
    tenth.
    """
    jacobian.agree(jacobian.shaken(quiet(many), seed=2))


def test_no_row_reaches_into_the_next(many):
    """The balls' lanes end before the row does: what lies behind them is never written."""
    point = jacobian.shaken(many)
    lanes = int(point.p[P.LANES])
    assert point.balls <= lanes < STRIDE
    f = np.full(F.SIZE, np.nan)
    call("right_hand_side", point.p, point.c, point.y, point.w, f, point.angle, point.speed, 0.0)
    rows = f[: F.BODY].reshape(-1, STRIDE)
    assert np.isfinite(rows[:, :lanes]).all() and np.isfinite(f[F.BODY :]).all()
    assert np.isnan(rows[:, lanes:]).all()


@pytest.mark.parametrize("rpm", heavy_but([0.0, 12e3], 1))
def test_against_the_independent_solution(many, rpm):
    found = Bearing(many).solve(rpm, (500, 0, 0, 0, 0))
    theory = JonesHarris(geometry(many)).solve((500.0, 0.0, 0.0), rpm * RPM)
    assert found.shift[0] == pytest.approx(theory.displacement[0], rel=1e-6)
    for row, field in (
        (EQ.LOAD_I, "inner_load"), (EQ.LOAD_O, "outer_load"), (EQ.ANGLE_I, "inner_angle"),
        (EQ.ANGLE_O, "outer_angle"), (EQ.OM, "orbit_speed"),
    ):  # fmt: skip
        expected = [getattr(ball, field) for ball in theory.balls]
        assert len(expected) == many.bearing.ball_count
        np.testing.assert_allclose(found.row(row), expected, rtol=1e-6, atol=1e-12)


def test_the_ring_is_in_balance_where_the_equilibrium_is(many):
    """Under load along and across at standstill: forces of all balls on the inner ring add up to the load."""
    off = dict.fromkeys(("GRAVITY", "DRAG", "ROLLING", "CAGE", "WAVINESS"), 0.0)
    bearing = Bearing(quiet(many), **off).solve(0.0, (500, 100, -300, 0, 0))
    bearing.c[[C.PRELOAD, C.LOAD_Y, C.LOAD_Z]] = 500, 100, -300
    y, f = np.zeros(Y.SIZE), np.zeros(F.SIZE)
    for row, found in ((Y.X // STRIDE, EQ.X), (Y.R // STRIDE, EQ.R)):
        y[row * STRIDE :][: bearing.balls] = bearing.row(found)
    y[Y.TH :][: bearing.balls] = 2 * np.pi * np.arange(bearing.balls) / bearing.balls
    y[Y.Q0 : Y.Q0 + 5] = bearing.shift
    rows = y[: Y.Q0].reshape(-1, STRIDE)
    rows[:, bearing.balls :] = rows[:, :1]
    call("right_hand_side", bearing.p, bearing.c, y, bearing.w, f, 0.0, 0.0, 0.0)
    force = f[F.BODY : F.BODY + 3] * bearing.p[P.INNER_MASS]
    np.testing.assert_allclose(force, 0.0, atol=1e-5)  # N, of 100 to 500
    balls = f[: 2 * STRIDE].reshape(2, -1)[:, : bearing.balls] * bearing.p[P.BALL_MASS]
    np.testing.assert_allclose(balls, 0.0, atol=1e-6)


def test_energy_is_kept(many):
    """5 ms under a load across, within the bound of the extreme cases."""
    run = Instance(prepare(many, fidelity="full"))
    run.set("radial_load.z", -300.0)
    run.initialise()
    for _ in range(50):
        run.step(1e-4)
    balanced(run, Case.energy)
