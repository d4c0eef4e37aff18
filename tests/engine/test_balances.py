"""The right-hand side against momentum and energy."""

from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import F, S, Y
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.engine.readout.losses import summarise
from tests.engine.helpers import SUPPORTED
from tests.engine.states import BUMPS, ROUNDING, SCENES, SPEED_RATE, agree, off
from tests.oracles import cartesian as oracle

HEAVY = 1e-3  # m: two hundred times the default, so that what it does stands out


def pulls(case, found):
    """Rates of momentum, forces from outside and centres of balls and bodies, in inertial axes."""
    setup, state = case.setup, case.state
    rate, outside, centre = [], [], []
    weight = np.array([0.0, 0.0, -9.81 if setup.gravity else 0.0])
    for ball, a in zip(state.balls, found.balls, strict=True):
        x, r, t = oracle.directions(ball[2])
        radius, orbit = setup.pitch + ball[1], ball[5]
        inertial = a[0] * x + (a[1] - radius * orbit**2) * r + (radius * a[2] + 2.0 * ball[4] * orbit) * t
        rate.append(setup.ball_mass * inertial)
        outside.append(setup.ball_mass * weight - setup.drag * radius**2 * orbit * abs(orbit) * t)
        centre.append(ball[0] * x + radius * r)
    for k, mass in enumerate(setup.masses):
        spring = setup.springs[k] @ state.bodies[k] + setup.dampers[k] @ state.rates[k]
        moved, place = found.bodies[k, :3], state.bodies[k, :3]
        if k == oracle.CAGE:
            _, spot, ahead = oracle.directions(state.bodies[k, 3])
            swung = found.bodies[k, 3] * ahead - state.rates[k, 3] ** 2 * spot
            moved, place = moved + setup.cage_eccentricity * swung, place + setup.cage_eccentricity * spot
        rate.append(mass.mass * moved)
        outside.append(mass.mass * weight + setup.load[k] - spring[:3])
        centre.append(place)
    outside[case.n] = outside[case.n] + oracle.unbalance(setup, state, SPEED_RATE)
    return np.array(rate), np.array(outside), np.array(centre)


def moments(case, found):
    """Rates of the moments of momentum about the origin, and moments from outside, of balls and bodies."""
    setup, state = case.setup, case.state
    rate, outside, centre = pulls(case, found)
    turning, given = np.cross(centre, rate), np.cross(centre, outside)
    for j, (ball, a) in enumerate(zip(state.balls, found.balls, strict=True)):
        spin = a[3:] + np.cross([ball[5], 0.0, 0.0], ball[6:])
        turning[j] += setup.ball_inertia * (spin @ np.array(oracle.directions(ball[2])))
    for k, mass in enumerate(setup.masses):
        spin, tilting = state.rates[k, 3], state.rates[k, 4:]
        gyroscopic = mass.polar * spin * np.array([tilting[1], -tilting[0]])
        turning[case.n + k, 0] += mass.polar * found.bodies[k, 3]
        turning[case.n + k, 1:] += mass.transverse * found.bodies[k, 4:] + gyroscopic
        given[case.n + k] -= (setup.springs[k] @ state.bodies[k] + setup.dampers[k] @ state.rates[k])[3:]
    given[case.n, 0] += found.torque
    return turning, given


@pytest.mark.parametrize("held", [{}, SUPPORTED], ids=["free", "springs to ground"])
@pytest.mark.parametrize("cage_offset", [0.5, 1.02])
@pytest.mark.parametrize("tilt", [0.0, 1e-3])
def test_linear_momentum(case, tilt, cage_offset, held):
    """What bodies and balls do to each other cancels: only outside forces change the momentum."""
    one = case(SCENES[0], tilt=tilt, cage_offset=cage_offset, **held)
    rate, outside, _ = pulls(one, one.engine())
    assert off(rate.sum(0), outside.sum(0), rate) <= 1e-12


@pytest.mark.parametrize("cage_offset", [0.5, 1.02])
@pytest.mark.parametrize("eccentricity", [0.0, 1e-3])
def test_angular_momentum(case, cage_offset, eccentricity):
    """Moments about the origin, with the drive's torque; without tilt and without axial float of the cage.

    About X alone where the cage has a heavy spot, whose axial motion is left out.
    """
    one = case(SCENES[0], tilt=0.0, cage_offset=cage_offset, afloat=0.0, CAGE_ECCENTRICITY=eccentricity)
    turning, given = moments(one, one.engine())
    axes = slice(0, 1 if eccentricity else 3)
    assert off(turning.sum(0)[axes], given.sum(0)[axes], turning[:, axes]) <= 1e-11


def test_losses_by_source(case):
    """Sources add up to all heat but the dampers'; rolling is what goes when the oracle leaves it out."""
    one = case(SCENES[0], cage_offset=1.02)
    s = np.zeros(S.size(one.p))
    s[S.Y : S.Y + Y.SIZE] = one.y
    f = s[S.F : S.F + F.SIZE]
    call("right_hand_side", one.p, one.c, one.y, one.w, f, one.angle, one.speed, SPEED_RATE)
    summarise(one.p, s, one.w)
    contacts, rolling, cage, drag = s[S.LOSS : S.LOSS + 4]
    dampers = sum(v @ damper @ v for v, damper in zip(one.state.rates, one.setup.dampers, strict=True))
    heats = f[F.HEAT : F.HEAT + 3].sum()
    assert contacts + rolling + cage + drag + dampers == pytest.approx(heats, rel=1e-12)
    for lost, change in (
        (rolling, {"races": tuple(replace(race, rolling=lambda *_: 0.0) for race in one.setup.races)}),
        (cage, {"pocket": None, "land": None}),
        (drag, {"drag": 0.0}),
    ):
        less = oracle.equations(replace(one.setup, **change), one.state, SPEED_RATE).heats.sum()
        assert lost == pytest.approx(one.oracle().heats.sum() - less, rel=1e-6)


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("cage_offset", [0.5, 1.02])
@pytest.mark.parametrize(("tilt", "gate"), [(0.0, 1e-12), (1e-5, 4e-9), (1e-4, 4e-8), (1e-3, 1e-6)])
@pytest.mark.parametrize("held", [{}, SUPPORTED], ids=["free", "springs to ground"])
def test_power_balance(case, name, cage_offset, tilt, gate, held):
    """Work less heat is the rate of the stored energy along the engine's accelerations.

    Small-tilt equations leave a rest that grows with the tilt squared, and with the forces in the pockets,
    which the balls press at the start: 2e-9 of the work there.
    """
    one = case(name, tilt=tilt, cage_offset=cage_offset, **held)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= gate * found.work


@pytest.mark.parametrize(("tilt", "gate"), [(0.0, 1e-12), (1e-5, 1e-9), (1e-4, 1e-8)])
def test_power_balance_of_wavy_balls(case, tilt, gate):
    one = case(SCENES[0], tilt=tilt, ball_waves=BUMPS)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= gate * found.work


@pytest.mark.heavy
@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("cage_offset", [0.5, 1.02])
def test_heavy_spot_of_the_cage(case, name, cage_offset):
    """Force, turning, weight and energy of a cage whose mass is off its middle; all balances close."""
    one = case(name, tilt=0.0, afloat=0.0, cage_offset=cage_offset, CAGE_ECCENTRICITY=HEAVY)
    agree(one, ROUNDING, landed=1e-6)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= 1e-12 * found.work
    energy = stored_energy(one.p, one.c, one.y, one.w)
    assert energy == pytest.approx(oracle.stored_energy(one.setup, one.state), rel=1e-12)
    rate, outside, _ = pulls(one, found)
    assert off(rate.sum(0), outside.sum(0), rate) <= 1e-12


def test_stored_energy(case):
    one = case(SCENES[0], cage_offset=1.02, **SUPPORTED)
    one.engine()
    energy = stored_energy(one.p, one.c, one.y, one.w)
    assert energy == pytest.approx(oracle.stored_energy(one.setup, one.state), rel=1e-12)
