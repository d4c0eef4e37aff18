"""The right-hand side against plain inertial vectors."""

from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing.engine.layout import P, Q, Y
from fmu_bearing.engine.mechanics.cage import film_force
from fmu_bearing.engine.mechanics.energy import stored_energy
from tests.engine.helpers import SUPPORTED
from tests.engine.states import (
    BUMPS,
    LIFTED,
    ROUNDING,
    SCENES,
    SPEED_RATE,
    TRAPPED,
    agree,
    case_of,
    harmonics,
    off,
)
from tests.oracles import cartesian as oracle


@pytest.mark.parametrize("name", SCENES)
def test_states_are_what_they_should_be(case, name):
    """One ball off a race, one held by its pocket, most pressed by a few micrometres and sliding."""
    one = case(name)
    state = one.state
    gaps = np.array([[oracle.approach(one.setup, state, j, k) for k in range(2)] for j in range(one.n)])
    assert gaps[LIFTED].min() < -1e-7
    assert (gaps > 5e-7).mean() > 0.8
    assert gaps.max() < 2e-5
    push = np.linalg.norm(oracle.in_pocket(one.setup, state, TRAPPED)) - one.setup.pocket.clearance
    assert 1e-6 < push < 5e-5
    with_cage, without = one.oracle(), replace(one.setup, pocket=None, land=None)
    rest = oracle.equations(without, state, SPEED_RATE)
    assert abs(with_cage.balls[TRAPPED, 2] - rest.balls[TRAPPED, 2]) > 1e5  # rad/s2


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("tilt", [0.0, 1e-5, 1e-4])
def test_against_inertial_vectors(case, name, seed, tilt):
    agree(case(name, seed=seed, tilt=tilt, LAND=0.0), ROUNDING)


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("cage_offset", [0.1, 0.5, 0.9, 0.98, 1.02])
def test_lands_against_pressure_quadrature(case, name, cage_offset):
    """The engine rounds the direction of the film's motion over 0.01 1/s of some 1e2 and more."""
    agree(case(name, cage_offset=cage_offset), ROUNDING, landed=1e-6)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.96])
@pytest.mark.parametrize("closing", [-300.0, 0.0, 300.0])
@pytest.mark.parametrize("wedge", [-1e6, 1e6])
def test_film_against_pressure_quadrature(case, ratio, closing, wedge):
    """At 1e6 rad/s the engine's rounding of the motion's direction is below 1e-11."""
    land = case(SCENES[0]).setup.land
    eccentric, whirl = ratio * land.clearance, 150.0
    factor = land.viscosity * land.radius * land.length**3 / land.clearance**2
    back, on = factor * np.array(film_force(ratio, closing, -0.5 * wedge * ratio))
    out, ahead = np.array([0.6, -0.8]), np.array([0.8, 0.6])
    velocity = closing * land.clearance * out + whirl * eccentric * ahead
    push = oracle.film_push(land, eccentric * out, velocity, 0.7 * wedge, 0.3 * wedge + 2.0 * whirl)
    assert off(push[:, None], (on * ahead - back * out)[:, None]) <= 1e-11


@pytest.mark.parametrize("rpm", [0, 1000, -20000, 60000])
def test_other_speeds(case, rpm):
    agree(case(SCENES[0], rpm=rpm, LAND=0.0), ROUNDING)


@pytest.mark.parametrize(
    "term", ["CAGE", "GRAVITY", "DRAG", "ROLLING", "GYROSCOPIC", "WAVINESS", "IMPERFECTION_SCALE"]
)
def test_without_a_term(case, term):
    agree(case(SCENES[0], LAND=0.0, **{term: 0.0}), ROUNDING)


def test_springs_and_dampers_to_ground(case):
    agree(case(SCENES[0], LAND=0.0, **SUPPORTED), ROUNDING)


@pytest.mark.parametrize("hysteresis", [False, True])
@pytest.mark.parametrize("law", ["houpert-1987-ehl", "starved", "flooded"])
@pytest.mark.parametrize("rpm", [1000, 20000])
def test_rolling_laws(scene, law, hysteresis, rpm):
    """In oil and steel that lose much; the moment's parts are the oracle's powers."""
    changes = {"lubricant.rolling_law": law, "fidelity.terms.rolling_hysteresis": hysteresis}
    changes |= {"lubricant.viscosity_Pa_s": 0.5, "materials.outer_ring.hysteresis_loss": 0.5}

    def changed(name):
        return scene(name).replace(changes)

    agree(case_of(changed, SCENES[0], rpm=rpm, LAND=0.0), ROUNDING)


def test_waviness_table_holds_the_harmonics(case):
    """Hermite interpolation over 2048 intervals: slope of order 20 to (2 pi 20/2048)^3/100 = 2e-6."""
    agree(case(SCENES[0], LAND=0.0, wave=harmonics), 3e-6)


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("tilt", [0.0, 1e-4])
def test_wavy_balls(case, name, tilt):
    """Forces and moments of wavy balls from the gradient of the approach, taken by complex steps."""
    one = case(name, tilt=tilt, ball_waves=BUMPS, LAND=0.0)
    smooth = one.oracle() if not tilt else None
    agree(one, ROUNDING)
    if smooth is not None:
        rest = oracle.equations(replace(one.setup, bumps=None), one.state, SPEED_RATE)
        for k in range(6):  # every row of a ball feels the waves
            assert off(rest.balls[:, k, None], smooth.balls[:, k, None]) > 1e-7


@pytest.mark.parametrize("bumps", [{}, {"ball_waves": BUMPS}], ids=["round balls", "wavy balls"])
@pytest.mark.parametrize("race", [0, 1], ids=["inner", "outer"])
def test_a_contact_that_parts_fast_does_not_pull(case, race, bumps):
    """At 20 m/s the damping of a pressed contact exceeds its elastic force: it lets go, as in the oracle."""
    one, fast = case(SCENES[0], LAND=0.0, **bumps), 4
    one.y[Y.VR + fast] = 20.0 if race == 0 else -20.0
    gap = oracle.approach(one.setup, one.state, fast, race)
    # the contact's direction is within 30 deg of the radius
    assert 1e-6 < gap < 0.5 * 1.5 * one.p[P.CONTACT_DAMPING] * 20.0
    agree(one, ROUNDING)


def test_a_pocket_that_parts_fast_does_not_pull(case):
    """The trapped ball leaves at 1 m/s, five times as fast as the pocket's damping lets it press."""
    one = case(SCENES[0], LAND=0.0)
    one.y[Y.OM + TRAPPED] = one.y[Y.V0 + Q.CAGE + Q.TURN] - 1.0 / one.p[P.PITCH_RADIUS]
    assert one.p[P.POCKET_DAMPING] * 1.0 == 5.0  # elastic force times 1 + damping * rate
    assert np.linalg.norm(oracle.in_pocket(one.setup, one.state, TRAPPED)) > 1e-6 + one.setup.pocket.clearance
    agree(one, ROUNDING)


def test_leaning_seat(case):
    one = case(SCENES[0], tilt=1e-5, MISALIGNMENT_Y=3e-4, MISALIGNMENT_Z=-1e-4, LAND=0.0)
    agree(one, ROUNDING)
    energy = stored_energy(one.p, one.c, one.y, one.w)
    assert energy == pytest.approx(oracle.stored_energy(one.setup, one.state), rel=1e-12)


@pytest.mark.parametrize("ratio", [0.3, 4.0])
@pytest.mark.parametrize("angle", [0.0, 30.0, -70.0])
def test_orthotropic_pedestal(case, ratio, angle):
    pedestal = {"pedestal_stiffness_ratio": ratio, "pedestal_axis_angle_deg": angle}
    one = case(SCENES[0], tilt=1e-5, LAND=0.0, pedestal=pedestal)
    agree(one, ROUNDING)
    energy = stored_energy(one.p, one.c, one.y, one.w)
    assert energy == pytest.approx(oracle.stored_energy(one.setup, one.state), rel=1e-12)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= 1e-9 * found.work


@pytest.mark.parametrize("stiffness", [1e5, 2.5e7])
def test_springs_between_balls(case, stiffness):
    one = case(SCENES[0], tilt=0.0, CAGE=0.0, SPRINGS=stiffness, SPRING_DAMPING=30.0)
    agree(one, ROUNDING)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    # springs stretched by 0.1 mm exchange far more power than the bearing takes in
    inertia = one.setup.ball_mass * one.setup.pitch**2
    exchanged = np.abs(found.balls[:, 2] * one.state.balls[:, 5]).max() * inertia
    assert abs(found.work - found.heats.sum() - stored) <= 1e-12 * (found.work + exchanged)
    energy = stored_energy(one.p, one.c, one.y, one.w)
    assert energy == pytest.approx(oracle.stored_energy(one.setup, one.state), rel=1e-12)
