"""Seals: a constant torque between the rings, in the balance of moments, of power and of heat."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import F, J, P, Q, S, U, Y
from fmu_bearing.engine.mechanics.seals import seal_moment, seal_slope
from tests.engine.helpers import Run, quiet
from tests.engine.states import ROUNDING, SCENES, agree
from tests.engine.test_jacobian import agree as slopes_agree, shaken
from tests.oracles import cartesian as oracle
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene as set_of

TORQUE = 0.0692  # N m, of a 6205-2RSH
SLOW = 25.0  # r/min: with the outer ring's 2 rad/s of a random state seals are far from their torque


@pytest.mark.parametrize("rpm", [20000, -20000, SLOW])
def test_against_inertial_vectors(case, rpm):
    agree(case(SCENES[0], rpm=rpm, SEAL_TORQUE=TORQUE), ROUNDING, landed=1e-6)


@pytest.mark.parametrize("rpm", [20000, SLOW])
def test_both_rings_feel_it_and_nothing_else_does(case, rpm):
    """Newton's third law about the axis: what the shaft gives, the outer ring takes."""
    with_seals, without = (case(SCENES[0], rpm=rpm, SEAL_TORQUE=torque) for torque in (TORQUE, 0.0))
    assert np.array_equal(with_seals.y, without.y)
    found, plain = (one.engine() for one in (with_seals, without))
    slide = with_seals.speed - with_seals.y[Y.V0 + Q.OUTER + Q.TURN]
    moment = seal_moment(with_seals.p, slide)
    # differences of numbers up to 1e6 times as large: rounding
    assert found.torque - plain.torque == pytest.approx(moment, rel=1e-9)
    turned = with_seals.p[P.OUTER_POLAR] * (found.bodies[oracle.OUTER, 3] - plain.bodies[oracle.OUTER, 3])
    assert turned == pytest.approx(moment, rel=1e-9)
    assert found.heats[0] - plain.heats[0] == pytest.approx(moment * slide, rel=1e-9)
    assert np.array_equal(found.balls, plain.balls) and np.array_equal(found.heats[1:], plain.heats[1:])


@pytest.mark.parametrize("rpm", [20000, SLOW])
def test_power_balance(case, rpm):
    one = case(SCENES[0], rpm=rpm, tilt=0.0, SEAL_TORQUE=TORQUE)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= 1e-12 * (abs(found.work) + found.heats.sum())


def test_moment_and_its_slope(scene):
    p = Run(scene("7003C-bare"), 0, SEAL_TORQUE=TORQUE).p
    assert seal_moment(p, 0.0) == 0.0
    for slide in (0.2, 0.9, 1.3, 5.0):
        assert seal_moment(p, -slide) == -seal_moment(p, slide)
        difference = (seal_moment(p, slide + 1e-5) - seal_moment(p, slide - 1e-5)) / 2e-5
        assert seal_slope(p, slide) == pytest.approx(difference, rel=1e-6, abs=1e-9)
    # the rest beyond is 1/8 of x^-8
    assert seal_moment(p, 13.0) == pytest.approx(TORQUE, rel=2e-10)
    assert seal_moment(p, 11e3) == TORQUE


def test_jacobian(scene):
    """Where the torque has a slope, by differences and by itself."""
    sealed, open_ = (
        shaken(scene("7003C-spindle"), rpm=SLOW, WAVINESS=0.0, SEAL_TORQUE=torque) for torque in (TORQUE, 0.0)
    )
    slopes_agree(sealed, 1e-4)
    turn = Q.OUTER + Q.TURN
    blocks = []
    for point in (sealed, open_):
        jac = np.zeros(J.SIZE)
        call("jacobian", point.p, point.c, point.y, point.w, jac, point.angle, point.speed, 0.0)
        blocks.append(jac[J.E :].reshape(Q.SIZE, J.BODIES))
    change = blocks[1] - blocks[0]
    slope = seal_slope(sealed.p, sealed.speed - sealed.y[Y.V0 + turn])
    assert slope > 0.5 * TORQUE
    assert change[turn, Q.SIZE + turn] * sealed.p[P.OUTER_POLAR] == pytest.approx(slope, rel=1e-6)
    change[turn, Q.SIZE + turn] = 0.0
    assert not np.any(change)


def sealed_run(scene, rpm, fidelity, torque=TORQUE):
    number = float(FIDELITIES.index(fidelity))
    return Run(quiet(scene("7003C-spindle")), rpm, FIDELITY=number, SEAL_TORQUE=torque).init()


def settled(scene, rpm, torque, fidelity):
    run = sealed_run(scene, rpm, fidelity, torque)
    run.run(1e-3)
    return run


@pytest.mark.parametrize("fidelity", FIDELITIES)
@pytest.mark.parametrize("rpm", [1500, -20000])
def test_steady_torque_is_that_without_seals_and_the_seals(scene, fidelity, rpm):
    sealed, open_ = (settled(scene, rpm, torque, fidelity) for torque in (TORQUE, 0.0))
    more = np.copysign(TORQUE, rpm)
    names = ("friction_torque", "friction_torque_mean", "friction_torque_share.seals")
    torque, mean, share = (sealed.value(name) - open_.value(name) for name in names)
    # what full leaves is the outer ring, which the seals turn by 1e-6 rad on its pedestal
    assert torque == pytest.approx(more, rel=1e-9)
    assert mean == pytest.approx(more, rel=1e-9)
    assert share == pytest.approx(more, rel=1e-9)
    assert open_.value("friction_torque_share.seals") == 0.0
    for name in ("contacts", "rolling", "cage", "drag"):
        name = f"friction_torque_share.{name}"
        assert sealed.value(name) == pytest.approx(open_.value(name), rel=1e-9)
    heat = sealed.value("heat.inner_ring") - open_.value("heat.inner_ring")
    assert heat == pytest.approx(more * rpm * RPM, rel=1e-9)
    for name in ("heat.outer_ring", "heat.oil"):
        assert sealed.value(name) == pytest.approx(open_.value(name), rel=1e-9)


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_through_standstill(scene, fidelity):
    """From 3,000 to -3,000 r/min in 4 ms: power turns with the speed, and the balance closes."""
    run = sealed_run(scene, 3000, fidelity)
    run.run(1e-3)
    heat = run.s[S.HEAT]
    for k in range(1, 41):
        run.u[U.SPEED] = (3000 - 150 * k) * RPM
        run.run(1e-4)
    # of the power on the shaft's speed: in full the outer ring still swings by some 0.03 rad/s
    assert run.value("friction_torque_share.seals") == pytest.approx(-TORQUE, rel=1e-3)
    # half of it by each way: M times the angle turned, less what is rounded within 1 rad/s of standstill
    rubbed = TORQUE * 2.0 * 0.5 * 3000 * RPM * 2e-3
    assert run.s[S.HEAT] - heat > rubbed
    assert abs(run.imbalance) < 1e-3 * run.heat


def test_outer_ring_turns_on_its_pedestal_as_far_as_the_torque_takes_it(scene):
    """The start of full is at rest with it: no swing of the outer ring follows."""
    run = sealed_run(scene, 20000, "full")
    turn = S.Y + Y.Q0 + Q.OUTER + Q.TURN
    first = run.s[turn]
    run.run(5e-3)
    assert run.s[turn] == pytest.approx(first, rel=1e-3)
    assert abs(run.s[S.F + F.BODY + Q.OUTER + Q.TURN] * run.p[P.OUTER_POLAR]) < 1e-3 * TORQUE


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_bearings_of_a_set(fidelity):
    pair = set_of("+-", (40.0, 70.0), rpm=10e3)
    number = float(FIDELITIES.index(fidelity))
    sealed, open_ = (SetRun(pair, FIDELITY=number, SEAL_TORQUE=torque).init() for torque in (TORQUE, 0.0))
    for run in (sealed, open_):
        run.run(5e-4)
    more = sealed.value("friction_torque") - open_.value("friction_torque")
    assert more == pytest.approx(2.0 * TORQUE, rel=1e-6)
    assert abs(sealed.imbalance) < 1e-3 * sealed.heat
