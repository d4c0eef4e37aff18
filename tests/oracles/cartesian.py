"""Equations of motion of the bearing in inertial Cartesian vectors, one ball after the other.

Forces come from `cartesian_forces`. Balls follow Newton and Euler in inertial axes and only then turn into
the orbiting ones. Rings and cage have the angular momentum ``I_p spin n + I_t (0, by', bz')``, of which the
small-tilt model lets the spin move along n and the tilts along y and z. The rate of the stored energy comes
from the positions by a complex step in time, so it knows no formula of a rate.
"""

from dataclasses import dataclass

import numpy as np

from tests.oracles.cartesian_forces import (
    CAGE,
    INNER,
    OUTER,
    Land,
    Loads,
    Mass,
    Pocket,
    Race,
    Setup,
    State,
    approach,
    axis,
    ball_centre,
    ball_velocity,
    between_balls,
    directions,
    film_push,
    in_pocket,
    in_race,
    on_cage,
    on_land,
    stretch,
    turned_axes,
)

__all__ = [
    "CAGE", "INNER", "OUTER", "Answer", "Land", "Loads", "Mass", "Pocket", "Race", "Setup", "State",
    "approach", "ball_velocity", "directions", "equations", "film_push", "in_pocket", "power_stored",
    "stored_energy", "turned_axes", "unbalance",
]  # fmt: skip

GRAVITY = 9.81
_STEP = 1e-30  # s, imaginary: no difference is taken, so it can be this small


@dataclass(frozen=True)
class Answer:
    """Ball accelerations (n, 6) as x'', r'', theta'', spin rates in the orbiting axes; bodies (3, 6);
    moment the shaft has to give (N m), heats of inner ring, outer ring and oil and power put in (W).
    """

    balls: np.ndarray
    bodies: np.ndarray
    torque: float
    heats: np.ndarray
    work: float


def equations(setup: Setup, state: State, spin_rate: float = 0.0) -> Answer:
    """Accelerations, shaft torque, heats and power in. ``spin_rate``: the inner ring's own (rad/s2)."""
    loads = Loads(setup, state)
    count = len(state.balls)
    contact = [sum(in_race(loads, j, k) for j in range(count)) for k in (INNER, OUTER)]
    oil = sum(contact) / 2.0
    if setup.pocket is not None:
        oil += sum(on_cage(loads, j) for j in range(count))
    if setup.land is not None:
        oil += on_land(loads, 1.0) + on_land(loads, -1.0)
    if setup.neighbours is not None:
        oil += between_balls(loads)
    slide = state.rates[INNER, 3] - state.rates[OUTER, 3]
    rubbing = setup.seals * slide / (1.0 + slide**8) ** 0.125
    torque = rubbing - loads.moment[count + INNER] @ axis(state.bodies[INNER])
    balls = np.empty((count, 6))
    for j in range(count):
        balls[j], drag = ball_motion(setup, state.balls[j], loads.force[j], loads.moment[j])
        oil += drag
    spring_loss = [rate @ damper @ rate for rate, damper in zip(state.rates, setup.dampers, strict=True)]
    heats = np.array([contact[0] / 2.0 + spring_loss[0], contact[1] / 2.0 + spring_loss[1], oil])
    heats[INNER] += rubbing * slide
    bodies = np.zeros((3, 6))
    for k in range(3 if setup.pocket is not None else 2):
        outside = -setup.springs[k] @ (state.bodies[k] - setup.rest[k]) - setup.dampers[k] @ state.rates[k]
        outside[:3] += setup.load[k]
        if k == INNER:
            outside[:3] += unbalance(setup, state, spin_rate)
        if k == OUTER:
            outside[3] += rubbing
        bodies[k] = body_motion(setup, state, loads, k, outside)
    if setup.pocket is not None:
        bodies[CAGE] = heavy_spot(setup, state, loads, bodies[CAGE])
    driven = (setup.load[INNER] + unbalance(setup, state, spin_rate)) @ state.rates[INNER, :3]
    return Answer(balls, bodies, torque, heats, driven + torque * state.rates[INNER, 3])


def ball_motion(setup: Setup, ball, force, moment) -> tuple[np.ndarray, float]:
    """Newton and Euler for one ball, then the orbiting axes; loss to the oil mist (W)."""
    axial, radial, around = directions(ball[2])
    radius, orbit = setup.pitch + ball[1], ball[5]
    speed = radius * orbit
    drag = -setup.drag * abs(speed) * speed * around
    weight = np.array([0.0, 0.0, -GRAVITY * setup.ball_mass]) if setup.gravity else np.zeros(3)
    a = (force + drag + weight) / setup.ball_mass
    spin_rate = moment / setup.ball_inertia
    # d(e_r)/dt = orbit e_t, d(e_t)/dt = -orbit e_r
    carried = orbit if setup.gyroscopic else 0.0
    rates = [
        a @ axial,
        a @ radial + radius * orbit**2,
        (a @ around - 2.0 * ball[4] * orbit) / radius,
        spin_rate @ axial,
        spin_rate @ radial + carried * ball[8],
        spin_rate @ around - carried * ball[7],
    ]
    return np.array(rates), -drag @ around * speed


def unbalance(setup: Setup, state: State, spin_rate: float) -> np.ndarray:
    """Inertia force (N) of the rotor's heavy spot, at 12 o'clock when the ring's angle is zero."""
    _, spot, ahead = directions(state.bodies[INNER, 3])
    speed = state.rates[INNER, 3]
    return -setup.masses[INNER].mass * setup.eccentricity * (spin_rate * ahead - speed**2 * spot)


def body_motion(setup: Setup, state: State, loads: Loads, k: int, outside: np.ndarray) -> np.ndarray:
    """Accelerations of one ring or the cage; ``outside``: forces and moments from springs and loads.

    Angular momentum I_p spin n + I_t (0, by', bz'), so a turning body on a tilting axis needs the moment
    I_p spin dn/dt. The inner ring's spin is prescribed: its acceleration is left at zero.
    """
    body, row, rate = setup.masses[k], loads.row(k), state.rates[k]
    force = loads.force[row] + outside[:3]
    if setup.gravity:
        force = force - [0.0, 0.0, GRAVITY * body.mass]
    swing = np.array([0.0, rate[5], -rate[4]])  # dn/dt across the axis
    tilting = loads.moment[row] + [0.0, outside[4], outside[5]] - body.polar * rate[3] * swing
    spinning = loads.moment[row] @ axis(state.bodies[k]) + outside[3]
    return np.array(
        [*force / body.mass, 0.0 if k == INNER else spinning / body.polar, *tilting[1:] / body.transverse]
    )


def heavy_spot(setup: Setup, state: State, loads: Loads, bodies: np.ndarray) -> np.ndarray:
    """Accelerations of a cage whose centre of mass is at ``e u`` from its centre, u at its angle.

    Lagrange's equations of T = m |v + e w u'|^2/2 + I w^2/2 in y, z and the angle, solved together; weight
    pulls at the centre of mass. ``bodies``: the accelerations without it, of which the others stay.
    """
    cage, mass, e = loads.row(CAGE), setup.masses[CAGE], setup.cage_eccentricity
    _, spot, ahead = directions(state.bodies[CAGE, 3])
    speed = state.rates[CAGE, 3]
    weight = np.array([0.0, 0.0, -GRAVITY * mass.mass if setup.gravity else 0.0])
    inertia = np.diag([mass.mass, mass.mass, mass.polar + mass.mass * e**2])
    inertia[2, :2] = inertia[:2, 2] = mass.mass * e * ahead[1:]
    push = loads.force[cage] + weight + mass.mass * e * speed**2 * spot
    turning = loads.moment[cage] @ axis(state.bodies[CAGE]) + e * ahead @ weight
    found = bodies.copy()
    found[1:4] = np.linalg.solve(inertia, [*push[1:], turning])
    return found


def stored_energy(setup: Setup, state: State):
    """Kinetic, gravitational and elastic energy (J); the inner ring's prescribed rotation is not counted."""
    gravity = GRAVITY if setup.gravity else 0.0
    total = 0.0
    for j, ball in enumerate(state.balls):
        velocity = ball_velocity(setup, ball)
        total += 0.5 * setup.ball_mass * (velocity @ velocity) + 0.5 * setup.ball_inertia * (
            ball[6:] @ ball[6:]
        )
        total += setup.ball_mass * gravity * ball_centre(setup, ball)[2]
        for k in (INNER, OUTER):
            gap = approach(setup, state, j, k)
            total += 0.4 * setup.races[k].stiffness * gap**2.5 if gap.real > 0.0 else 0.0
        if setup.pocket is not None:
            offset = in_pocket(setup, state, j)
            push = np.sqrt(offset @ offset) - setup.pocket.clearance
            total += 0.4 * setup.pocket.stiffness * push**2.5 if push.real > 0.0 else 0.0
    if setup.pocket is not None:
        _, spot, ahead = directions(state.bodies[CAGE, 3])
        cage, (velocity, speed) = setup.masses[CAGE], (state.rates[CAGE, :3], state.rates[CAGE, 3])
        carried = velocity + setup.cage_eccentricity * speed * ahead
        total += 0.5 * cage.mass * (carried @ carried - velocity @ velocity)
        total += cage.mass * gravity * setup.cage_eccentricity * spot[2]
    if setup.neighbours is not None:
        total += 0.5 * setup.neighbours[0] * (stretch(setup, state) ** 2).sum()
    for k in range(3 if setup.pocket is not None else 2):
        body, at, rate = setup.masses[k], state.bodies[k], state.rates[k]
        turning = 0.0 if k == INNER else 0.5 * body.polar * rate[3] ** 2
        total += (
            0.5 * body.mass * (rate[:3] @ rate[:3]) + turning + 0.5 * body.transverse * (rate[4:] @ rate[4:])
        )
        off = at - setup.rest[k]
        total += body.mass * gravity * at[2] + 0.5 * off @ setup.springs[k] @ off
    if setup.land is not None:
        for side in (1.0, -1.0):
            reach = [
                state.bodies[k, :3] + side * setup.land.offset * axis(state.bodies[k])
                for k in (setup.land.ring, CAGE)
            ]
            apart = (reach[1] - reach[0]) * [0, 1, 1]
            push = np.sqrt(apart @ apart) - setup.land.fraction * setup.land.clearance
            total += 0.5 * setup.land.stop * push**2 if push.real > 0.0 else 0.0
    return total


def power_stored(setup: Setup, state: State, balls: np.ndarray, bodies: np.ndarray) -> float:
    """Rate of the stored energy (W) along the accelerations given, shapes (n, 6) and (3, 6)."""
    return stored_energy(setup, state.after(1j * _STEP, balls, bodies)).imag / _STEP
