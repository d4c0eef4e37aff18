"""Equations 1 to 6 of the multi-source paper in plain NumPy, each fault in them with its own switch.

The right-hand side is the paper's: twelve balls (place, velocity, spin), cage, inner ring with its speed
prescribed, outer ring on its pedestal. Nothing of the engine is used. With :meth:`Corrections.none` the
rows are as printed, with :meth:`Corrections.all` as docs/theory.md has them. Forces that the paper leaves to
its references are the same in both: Hertzian load with damping, rolling resistance, drag, pockets, lands.
Rolling resistance F_xi is a moment: the pressure in the inlet (F_by) takes back what F_xi pushes.

Axes: X along the bearing, Z up, a ball at ``y = -r sin(theta), z = r cos(theta)``, components (x, r,
theta). Signs that depend on how an axis is counted are read in the paper's favour where one choice makes a
whole equation right. The moments of T_xi are read as docs/printed-equations.md has them: the x row is
right, since else no ball rolls, the radial row is not. If omega_x is counted against the orbit, both are
right (``traction_moments`` on).

Arrays of balls have the shape (balls, k), vectors (3, balls, k): ``k`` states are evaluated at once, so
that a Jacobian by differences costs little.
"""

import dataclasses
import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from examples.papers.printed_forces import (
    CAGE,
    FIRST,
    INNER,
    LAG,
    OM,
    OUTER,
    VR,
    VX,
    WR,
    WT,
    Array,
    Bearing,
    Contact,
    Pose,
    R,
    X,
    contact,
    cross,
    dot,
    land,
    pocket,
    pose,
)
from fmu_bearing.engine.constants import GRAVITY

ROWS = 9  # of the state per ball
BODIES = 17  # coordinates of inner ring, outer ring and cage


@dataclass(frozen=True)
class Corrections:
    """One switch per fault of eqs. 1 to 6: true where the equation is corrected.

    Attributes
    ----------
    gyroscopic_pair : bool
        Eq. 1: opposite signs of the two gyroscopic terms.
    single_inertia : bool
        Eq. 1: the ball's inertia counts once, not as J and as I.
    traction_moments : bool
        Eq. 1: opposite signs of the moments of T_xi in the x row and the radial row.
    pocket_moments : bool
        Eq. 1: friction alone turns a ball in its pocket, with its lever.
    contact_couples : bool
        Eq. 1: the moments of the traction within a contact (spin), which are missing.
    orbit_terms : bool
        Eq. 1: centrifugal and Coriolis terms.
    cage_rotation : bool
        Eq. 2: Q_cy turns the cage the way it pushes it.
    cage_tilt : bool
        Eq. 2: tilt rows with the same zero of the angle as the force rows; lands tilt the cage.
    land_reaction : bool
        Eqs. 2 and 3: the inner ring carries the cage's lands.
    inner_tilt : bool
        Eq. 3: signs of M_y and M_z.
    fixed_axes : bool
        Eqs. 2, 3, 5: gyroscopic moments of rings and cage in axes that do not spin.
    contact_radii : bool
        Eqs. 3 to 6: moments of the contact forces where they act, k = 1.
    pedestal_sign : bool
        Eq. 5: the pedestal holds the outer ring.
    pedestal_damping : bool
        Eq. 5: the pedestal is damped.
    traction_law : bool
        Traction that can carry a load in place of eta V S / h at ambient viscosity.
    """

    gyroscopic_pair: bool = True
    single_inertia: bool = True
    traction_moments: bool = True
    pocket_moments: bool = True
    contact_couples: bool = True
    orbit_terms: bool = True
    cage_rotation: bool = True
    cage_tilt: bool = True
    land_reaction: bool = True
    inner_tilt: bool = True
    fixed_axes: bool = True
    contact_radii: bool = True
    pedestal_sign: bool = True
    pedestal_damping: bool = True
    traction_law: bool = True

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """All corrections."""
        return tuple(field.name for field in dataclasses.fields(cls))

    @classmethod
    def none(cls) -> Self:
        """As printed."""
        return cls(**dict.fromkeys(cls.names(), False))

    @classmethod
    def all(cls) -> Self:
        """All of them."""
        return cls()

    def changed(self, on: tuple[str, ...] = (), off: tuple[str, ...] = ()) -> Self:
        """Put some in and leave some out.

        Raises
        ------
        ValueError
            For a name that is no correction.
        """
        known = self.names()
        if unknown := [name for name in (*on, *off) if name not in known]:
            raise ValueError(f"no such correction: {', '.join(unknown)}; there are {', '.join(known)}")
        return dataclasses.replace(self, **dict.fromkeys(on, True), **dict.fromkeys(off, False))


class Equations:
    """Eqs. 1 to 6 at one shaft speed.

    Parameters
    ----------
    bearing : Bearing
    speed : float
        Of the inner ring, rad/s.
    corrections : Corrections
    even : bool
        One ball represents all and rings move along the axis only: no weights, no tilts.
    """

    def __init__(self, bearing: Bearing, speed: float, corrections: Corrections, even: bool = False) -> None:
        self.bearing = b = bearing
        self.speed, self.on, self.even = speed, corrections, even
        self.count = int(b.balls)
        self.balls = 1 if even else self.count
        self.weight = 0.0 if even or not b.gravity else GRAVITY
        self.spacing = 2.0 * math.pi / self.count * np.arange(self.balls)[:, None]

    @property
    def size(self) -> int:
        """Length of a state."""
        return ROWS * self.balls + 2 * BODIES

    def split(self, state: Array) -> tuple[Array, Array, Array]:
        """Split states (size, k): rows of balls (9, balls, k), coordinates and rates of bodies (17, k)."""
        end = ROWS * self.balls
        return (
            state[:end].reshape(ROWS, self.balls, -1), state[end : end + BODIES], state[end + BODIES :]
        )  # fmt: skip

    def __call__(self, time: float, state: Array) -> Array:
        """Rates of a state of shape (size,) or of several, (size, k)."""
        one = state.ndim == 1
        found = self.rates(state[:, None] if one else state)
        return found[:, 0] if one else found

    def angles(self, balls: Array, places: Array) -> Array:
        """Angles of the balls from 12 o'clock (rad): the state has what they are ahead of their pockets."""
        return np.asarray(balls[LAG] + places[FIRST[CAGE] + 3] + self.spacing)

    def contacts(self, state: Array) -> tuple[Pose, Contact]:
        """Balls seen from inner ring, outer ring and cage, and their contacts with both races."""
        balls, places, speeds = self.split(state)
        seen = pose(self.bearing, self.speed, balls, self.angles(balls, places), places, speeds)
        return seen, contact(self.bearing, balls, seen.of(slice(2)), not self.on.traction_law)

    def ball_rows(self, balls: Array, angle: Array, force: Array, moment: Array) -> Array:
        """Eq. 1: accelerations and rates of spin, (6, balls, k), from force and moment on the balls."""
        b, om = self.bearing, balls[OM]
        radius = b.pitch_radius + balls[R]
        around = radius * om
        drag = (b.drag_factor if b.drag else 0.0) * around * np.abs(around)
        weight = self.weight * b.ball_mass
        fx, fr, ft = force
        fr = (fr - weight * np.cos(angle)) / b.ball_mass
        ft = (ft + weight * np.sin(angle) - drag) / b.ball_mass
        if self.on.orbit_terms:
            fr = fr + radius * om * om
            ft = ft - 2.0 * balls[VR] * om
        own = b.ball_inertia if self.on.single_inertia else 2.0 * b.ball_inertia
        pair = b.ball_inertia * om
        radial = pair * balls[WT] if self.on.gyroscopic_pair else -pair * balls[WT]
        return np.stack([
            fx / b.ball_mass, fr, ft / radius,
            moment[0] / own, (moment[1] + radial) / own, (moment[2] - pair * balls[WR]) / own,
        ])  # fmt: skip

    def on_ball(self, contact: Contact) -> Array:
        """Moments of the contacts in eq. 1, N m, shape (3, 2, balls, k)."""
        ball = self.bearing.ball_radius
        turning = (ball * contact.along + contact.rolling) * contact.m
        if not self.on.traction_moments:
            turning = turning * np.array([1.0, -1.0, 1.0])[:, None, None, None]
        turning = turning - ball * contact.across * contact.t
        return turning + self.couple(contact) if self.on.contact_couples else turning

    def in_pocket(self, force: Array, rubbed: Array) -> Array:
        """Moment of a pocket in eq. 1, N m, from its force and the moment of its friction."""
        if self.on.pocket_moments:
            return rubbed
        # printed: (Q_cz - P_xi) D/2 in the x row and (Q_cx - P_eta) D/2 in the radial row
        return self.bearing.ball_radius * np.stack([force[1], force[0], 0.0 * force[0]])

    @staticmethod
    def couple(contact: Contact) -> Array:
        """Moment of the traction about the contact's middle, N m."""
        about, t, m = contact.couples
        return np.asarray(about * contact.e + t * contact.t + m * contact.m)

    def summed(self, angle: Array, force: Array, moment: Array, axis: Array) -> Array:
        """Add up balls in fixed axes: force x, y, z, moment about ``axis``, y, z, shape (6, ..., k)."""
        c, s = np.cos(angle), np.sin(angle)
        rows = [row for x, r, t in (force, moment) for row in (x, -s * r - c * t, c * r - s * t)]
        rows[3] = dot(moment, axis)
        found = self.count / self.balls * np.stack([row.sum(axis=-2) for row in rows])
        if self.even:
            found[[1, 2, 4, 5]] = 0.0  # twelve equal balls round the axis
        return found

    def on_rings(self, angle: Array, contact: Contact, seen: Pose) -> Array:
        """Eqs. 3 and 5: force and moment of the balls on both rings, (6, 2, k)."""
        b = self.bearing
        ball = b.ball_radius
        if self.on.contact_radii:
            turning = (ball * contact.along + contact.rolling) * contact.m - ball * contact.across * contact.t
            moment = -cross(seen.q, contact.force) - turning - self.couple(contact)
        else:
            k = b.races.curvature
            radius = b.pitch_radius + ball * k * contact.e[1]  # eqs. 4 and 6: e points into the race
            around = -(contact.along + contact.rolling / ball)
            # the tangential force turns about x, and about the radial direction by its axial place
            moment = np.stack([radius * around, -k * ball * contact.e[0] * around, radius * contact.force[0]])
        found = self.summed(angle, -contact.force, moment, seen.n)
        if not self.on.inner_tilt:
            found[4:, INNER] *= -1.0
        return found

    def on_cage(self, angle: Array, pose: Pose, force: Array, moment: Array) -> Array:
        """Eq. 2: force and moment of the balls on the cage, (6, k)."""
        found = self.summed(angle, -force, -cross(pose.q, force) - moment, pose.n)
        if not self.on.cage_rotation:
            found[3] = -found[3]
        if not self.on.cage_tilt and not self.even:
            # printed: cosine for M_y and sine for M_z, with the angle from Y that the force rows have
            radius = self.bearing.pitch_radius
            found[4] = (radius * np.sin(angle) * force[0]).sum(axis=0)
            found[5] = -(radius * np.cos(angle) * force[0]).sum(axis=0)
        return found

    def lands(self, places: Array, speeds: Array, inner: Array, cage: Array) -> None:
        """Add both lands to force and moment on inner ring and cage."""
        b = self.bearing
        if not b.land:
            return
        cage_rows, ring_rows = [12, 13, 15, 16], [1, 2, 3, 4]  # y, z, tilts about y and z
        gap, rate = (one[cage_rows] - one[ring_rows] for one in (places, speeds))
        x = b.land_offset * np.array([1.0, -1.0])
        arm = np.stack([x, -x])[:, :, None]
        apart, moving = (one[:2, None] + arm * one[[3, 2], None] for one in (gap, rate))
        force, on_ring, on_cage = land(b, apart, moving, self.speed, speeds[FIRST[CAGE] + 3])
        tilting = (arm * force)[::-1].sum(axis=1)
        pushing = force.sum(axis=1)
        cage[1:3] += pushing
        cage[3] += on_cage.sum(axis=0)
        if self.on.cage_tilt:
            cage[4:] += tilting
        if self.on.land_reaction:
            inner[1:3] -= pushing
            inner[3] += on_ring.sum(axis=0)
            inner[4:] -= tilting

    def pedestal(self, places: Array, speeds: Array) -> Array:
        """Force and moment of the pedestal on the outer ring, (6, k): printed F = +K x, M = +S R psi."""
        b = self.bearing
        turn = b.pedestal_rotational
        radial = np.array([[b.pedestal_y, b.pedestal_yz], [b.pedestal_yz, b.pedestal_z]])
        push = np.concatenate([[b.pedestal_axial * places[5]], radial @ places[6:8], turn * places[8:11]])
        if self.on.pedestal_sign:
            push = -push
        if self.on.pedestal_damping:
            radial = np.array([[b.damping_y, b.damping_yz], [b.damping_yz, b.damping_z]])
            push[0] -= b.damping_axial * speeds[5]
            push[1:3] -= radial @ speeds[6:8]
            push[3] -= b.damping_spin * speeds[8]
            push[4:] -= b.damping_rotational * speeds[9:11]
        return np.asarray(push)

    def tilting(self, body: str, moment: Array, rates: Array, spin: Array | float) -> Array:
        """Tilt accelerations (2, k) of a body that spins, from moment and tilt rates about y and z."""
        transverse = getattr(self.bearing, f"{body}_transverse")
        polar = getattr(self.bearing, f"{body}_polar")
        # printed: Euler's equations of axes that turn with the body; fixed axes: I_p Omega x b'
        carried = -polar * spin if self.on.fixed_axes else (transverse - polar) * spin
        return np.asarray((moment + carried * np.stack([rates[1], -rates[0]])) / transverse)

    def body_rows(self, places: Array, speeds: Array, inner: Array, outer: Array, cage: Array) -> Array:
        """Eqs. 2, 3 and 5: accelerations of the bodies (17, k) from the forces and moments on them."""
        b = self.bearing
        inner[0] += b.preload
        inner[4:] -= b.tilt_stiffness * places[3:5] + b.tilt_damping * speeds[3:5]
        outer = outer + self.pedestal(places, speeds)
        rows = []
        for name, loads, mass, at, spin in (
            ("inner", inner, b.inner_mass, 3, self.speed),
            ("outer", outer, b.outer_mass, 9, speeds[8]),
            ("cage", cage, b.cage_mass, 15, speeds[14]),
        ):
            loads[2] -= self.weight * mass
            rows.append(loads[:3] / mass)
            if name != "inner":
                rows.append(loads[3:4] / getattr(b, f"{name}_polar"))
            rows.append(self.tilting(name, loads[4:], speeds[at : at + 2], spin))
        return np.concatenate(rows)

    def rates(self, state: Array) -> Array:
        """Rates of states, shape (size, k)."""
        balls, places, speeds = self.split(state)
        angle = self.angles(balls, places)
        seen, touching = self.contacts(state)
        held, rubbed = pocket(self.bearing, balls, seen.of(CAGE))
        force = touching.force.sum(axis=1) + held
        moment = self.on_ball(touching).sum(axis=1) + self.in_pocket(held, rubbed)
        rings = self.on_rings(angle, touching, seen.of(slice(2)))
        inner, outer = rings[:, INNER], rings[:, OUTER]
        cage = self.on_cage(angle, seen.of(CAGE), held, rubbed)
        self.lands(places, speeds, inner, cage)
        found = np.empty_like(state)
        of_balls, of_places, of_speeds = self.split(found)
        of_balls[X], of_balls[R] = balls[VX], balls[VR]
        of_balls[LAG] = balls[OM] - speeds[FIRST[CAGE] + 3]
        of_balls[VX:] = self.ball_rows(balls, angle, force, moment)
        of_places[:] = speeds
        of_speeds[:] = self.body_rows(places, speeds, inner, outer, cage)
        return found
