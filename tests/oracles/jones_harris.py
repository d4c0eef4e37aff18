"""Quasi-static angular-contact bearing: ring displacement and all balls from ONE system of equations.

After A. B. Jones (1960) and T. A. Harris, with the sign of each term derived here. The outer ring stands
still and fixed; ball j sits at its angle theta_j and may move along X and radially.

* Groove centre circles: exact torus against sphere. The ball centre is brought into the (displaced, tilted)
  ring's own axes; the approach is its distance from the groove centre circle less (f - 1/2) D, the force
  points along that line.
* Centrifugal force ``m r w_c^2``, orbit and spin from pure rolling at both contacts (`kinematics.rolling`),
  pitch of the spin axis as ruled by `kinematics.pitch_angle`; by default halfway between the contact angles.
* Gyroscopic moment. The ball's angular momentum J w turns with the orbit, so the races must supply
  ``w_c e_x x J w = J w_c w_s sin(beta) e_t = M e_t`` (positive for either sense of rotation). A friction pair
  M/D at each contact does it: on the ball ``+M/D (cos a_i, -sin a_i)`` inside and
  ``-M/D (cos a_o, -sin a_o)`` outside. Hence for a ball, with the normal forces ``Q_i (sin a_i, cos a_i)``
  and ``-Q_o (sin a_o, cos a_o)``:

      x:  Q_i sin a_i - Q_o sin a_o + M/D (cos a_i - cos a_o) = 0
      r:  Q_i cos a_i - Q_o cos a_o - M/D (sin a_i - sin a_o) + m r w_c^2 = 0

* Under race control one race takes all of it: ``2 M/D`` there and nothing at the other.
* The pair never exceeds `friction_limit` times the lighter of both loads, so it fades without a jump as a
  ball leaves the inner race. It binds where M/D > 0.05 Q_i, for the 7009C at 18,000 r/min below 30 N.
* Left out: traction along the rolling direction, drag, cage forces, gravity; both rings are rigid.
"""

import functools
from dataclasses import dataclass
from math import asin, atan2, cos, hypot, pi, sin, tan

import numpy as np
from scipy.optimize import brentq, root
from scipy.spatial.transform import Rotation

from . import Bearing, cross
from .hertz import race_contact
from .kinematics import pitch_angle, rolling

# N/m, assumed: keeps an unloaded ball at standstill midway between the races, at less than 1e-6 N
IDLE_SPRING = 1.0
MICRO = 1e-6  # unknowns are micrometres, tilts micrometres at the pitch radius
RESIDUAL_LIMIT = 1e-6  # N


@dataclass(frozen=True)
class Ball:
    """One ball (SI, radians): place, loads, angles, motion, force out of balance, what the ring feels."""

    angle: float
    axial: float
    radial: float
    inner_load: float
    outer_load: float
    inner_angle: float
    outer_angle: float
    orbit_speed: float
    spin_speed: float
    pitch: float
    gyroscopic_moment: float
    residual: tuple[float, float]
    ring_force: tuple[float, float, float]
    ring_moment: tuple[float, float, float]


@dataclass(frozen=True)
class Equilibrium:
    """Displacement (dx, dy, dz, tilt about Y, tilt about Z) of the inner ring and its balls."""

    displacement: tuple[float, ...]
    balls: tuple[Ball, ...]

    @property
    def force(self) -> np.ndarray:
        """Force and moment the balls exert on the inner ring about its centre: (Fx, Fy, Fz, My, Mz)."""
        force = np.sum([b.ring_force for b in self.balls], axis=0)
        moment = np.sum([b.ring_moment for b in self.balls], axis=0)
        return np.array([*force, moment[1], moment[2]])


class JonesHarris:
    """Quasi-static model of one bearing.

    Parameters
    ----------
    bearing : Bearing
        Geometry and materials.
    pitch : str
        Rule for the ball's spin axis, see `kinematics.pitch_angle`.
    gyroscopic : bool
        False leaves the gyroscopic moment out.
    friction_limit : float
        Greatest share of the lighter contact load the gyroscopic friction pair may take; 0.05 is assumed.
        Under race control it is the load of the race in control.
    control : str
        Who carries the gyroscopic moment: "shared", "outer" or "inner".
    """

    def __init__(
        self,
        bearing: Bearing,
        pitch: str = "mean",
        gyroscopic: bool = True,
        friction_limit: float = 0.05,
        control: str = "shared",
    ) -> None:
        self.bearing = bearing
        self.pitch = pitch
        self.gyroscopic = gyroscopic
        self.friction_limit = friction_limit
        self.control = control
        self.inner_constant = race_contact(bearing, "inner").constant
        self.outer_constant = race_contact(bearing, "outer").constant
        # a column of the Jacobian moves one ball: the others are where they were
        self._known = functools.lru_cache(maxsize=64)(self.ball)
        self.angles = [2.0 * pi * j / bearing.ball_count for j in range(bearing.ball_count)]

    # ---- one ball ------------------------------------------------------------------------------------------

    def ball(self, angle: float, axial: float, radial: float, displacement: tuple, speed: float) -> Ball:
        """Return the ball centred at (axial, radial) with all its forces; `residual` is left over."""
        bearing = self.bearing
        e_x = np.array([1.0, 0.0, 0.0])
        e_r = np.array([0.0, -sin(angle), cos(angle)])
        centre = axial * e_x + radial * e_r

        turn = _turn(displacement[3], displacement[4])
        shift = np.asarray(displacement[:3])
        inner_normal, inner_length = _towards_groove(bearing.inner_groove_centre, turn.T @ (centre - shift))
        inner_normal = turn @ inner_normal
        outer_normal, outer_length = _towards_groove(bearing.outer_groove_centre, centre)
        inner_load = self.inner_constant * max(inner_length - bearing.inner_reach, 0.0) ** 1.5
        outer_load = self.outer_constant * max(outer_length - bearing.outer_reach, 0.0) ** 1.5
        # the inner race pushes along its normal; the outer one too, and its normal points inwards and to -X
        inner_angle = atan2(inner_normal @ e_x, inner_normal @ e_r)
        outer_angle = atan2(-(outer_normal @ e_x), -(outer_normal @ e_r))

        beta = pitch_angle(self.pitch, bearing.ball_diameter, radial, inner_angle, outer_angle)
        orbit, spin = rolling(speed, bearing.ball_diameter, radial, inner_angle, outer_angle, beta)
        moment = bearing.ball_inertia * orbit * spin * sin(beta) if self.gyroscopic else 0.0
        # sharing equally, each race supplies M/2 at the arm D/2
        pair = moment / bearing.ball_diameter
        shares = {"shared": (1.0, 1.0), "outer": (0.0, 2.0), "inner": (2.0, 0.0)}[self.control]
        gripping = [load for load, share in zip((inner_load, outer_load), shares, strict=True) if share > 0.0]
        limit = self.friction_limit * min(gripping) / max(shares)
        pair = min(max(pair, -limit), limit)
        inner_friction = shares[0] * pair * (cos(inner_angle) * e_x - sin(inner_angle) * e_r)
        outer_friction = -shares[1] * pair * (cos(outer_angle) * e_x - sin(outer_angle) * e_r)

        on_ball_inner = inner_load * inner_normal + inner_friction
        on_ball = on_ball_inner + outer_load * outer_normal + outer_friction
        on_ball = on_ball + bearing.ball_mass * radial * orbit**2 * e_r
        # from the ball to the point on the line of groove centres that has the same gap to both races
        share = bearing.inner_reach / (bearing.inner_reach + bearing.outer_reach)
        to_idle = (1.0 - share) * inner_length * inner_normal + share * outer_length * outer_normal
        on_ball = on_ball + IDLE_SPRING * to_idle
        contact = centre - 0.5 * bearing.ball_diameter * inner_normal
        return Ball(
            angle=angle,
            axial=axial,
            radial=radial,
            inner_load=inner_load,
            outer_load=outer_load,
            inner_angle=inner_angle,
            outer_angle=outer_angle,
            orbit_speed=orbit,
            spin_speed=spin,
            pitch=beta,
            gyroscopic_moment=moment,
            residual=(on_ball @ e_x, on_ball @ e_r),
            ring_force=tuple(-on_ball_inner),
            ring_moment=tuple(cross(contact - shift, -on_ball_inner)),
        )

    # ---- balls under a given displacement of the ring ------------------------------------------------------

    def at_displacement(
        self, displacement: np.ndarray, speed: float = 0.0, start: Equilibrium | None = None
    ) -> Equilibrium:
        """Ball equilibria under a prescribed ring displacement (m, rad); each ball stands alone."""
        displacement = tuple(np.asarray(displacement, dtype=float))
        half_pitch = 0.5 * self.bearing.pitch_diameter
        balls = []
        for j, angle in enumerate(self.angles):
            if start is None:
                guess = np.array([0.5 * displacement[0], 0.0]) / MICRO
            else:
                guess = np.array([start.balls[j].axial, start.balls[j].radial - half_pitch]) / MICRO

            def residual(u: np.ndarray, angle: float = angle) -> np.ndarray:
                ball = self.ball(angle, u[0] * MICRO, half_pitch + u[1] * MICRO, displacement, speed)
                return np.array(ball.residual)

            u = _solve(residual, guess)
            balls.append(self.ball(angle, u[0] * MICRO, half_pitch + u[1] * MICRO, displacement, speed))
        return Equilibrium(displacement, tuple(balls))

    # ---- ring and balls at once ----------------------------------------------------------------------------

    def solve(
        self,
        force: tuple[float, float, float],
        speed: float = 0.0,
        moment: tuple[float, float] | None = None,
        tilt: tuple[float, float] = (0.0, 0.0),
    ) -> Equilibrium:
        """Equilibrium under forces (Fx, Fy, Fz) in N on the inner ring at `speed` in rad/s.

        Parameters
        ----------
        force : tuple of float
            Load on the inner ring; Fx must be positive, it is what seats the balls.
        speed : float
            Speed of the inner ring about X.
        moment : tuple of float, optional
            Moments (My, Mz) in N m about the ring's centre; the ring then tilts freely.
        tilt : tuple of float, optional
            Tilts about Y and Z in rad, held if `moment` is not given.

        Raises
        ------
        ValueError
            If the axial load is not positive or no equilibrium is found.
        """
        if force[0] <= 0.0:
            raise ValueError("the oracle starts from the axial load and needs it positive")
        half_pitch = 0.5 * self.bearing.pitch_diameter
        approach = self.static_axial(force[0])[2] / MICRO
        u = np.array([approach, 0.0, 0.0, 0.0, 0.0] + len(self.angles) * [0.5 * approach, 0.0])

        def system(u: np.ndarray, share: float) -> np.ndarray:
            state = self._state(u, share * speed)
            ring = state.force + np.array([force[0], share * force[1], share * force[2], 0.0, 0.0])
            if moment is None:
                # held tilts: micrometres at the pitch radius, of the order of the forces in N
                ring[3:] = u[3:5] - share * np.asarray(tilt) * half_pitch / MICRO
            else:
                ring[3:] = (ring[3:] + share * np.asarray(moment)) / half_pitch
            return np.concatenate([ring, *(b.residual for b in state.balls)])

        # walk from the axial static load to the full load and speed, in smaller steps where it fails
        done, step = 0.0, 1.0
        u = _solve(lambda v: system(v, 0.0), u)
        while done < 1.0:
            aim = min(done + step, 1.0)
            try:
                u = _solve(lambda v, aim=aim: system(v, aim), u)
                done = aim
            except ValueError:
                step *= 0.5
                if step < 1e-3:
                    raise
        return self._state(u, speed)

    def _state(self, u: np.ndarray, speed: float) -> Equilibrium:
        half_pitch = 0.5 * self.bearing.pitch_diameter
        displacement = (*(u[:3] * MICRO), *(u[3:5] * MICRO / half_pitch))
        places = u[5:].reshape(-1, 2) * MICRO
        balls = (
            self._known(angle, x, half_pitch + r, displacement, speed)
            for angle, (x, r) in zip(self.angles, places, strict=True)
        )
        return Equilibrium(displacement, tuple(balls))

    # ---- what follows from it ------------------------------------------------------------------------------

    def stiffness(self, state: Equilibrium, speed: float = 0.0, step: float = 2e-8) -> np.ndarray:
        """Stiffness (5 x 5: N/m, N/rad, N m/m, N m/rad): balls follow, the other four axes are held."""
        columns = []
        for k in range(5):
            scaled = step if k < 3 else step / (0.5 * self.bearing.pitch_diameter)
            move = np.zeros(5)
            move[k] = scaled
            plus = self.at_displacement(np.array(state.displacement) + move, speed, state).force
            minus = self.at_displacement(np.array(state.displacement) - move, speed, state).force
            columns.append(-(plus - minus) / (2.0 * scaled))
        return np.array(columns).T

    def static_axial(self, force: float) -> tuple[float, float, float]:
        """Load per ball, contact angle, axial displacement at standstill under axial load: one unknown.

        At rest both contact angles are equal and the three points lie on a line, so the
        groove-centre distance is
        ``B = A cos a0 / cos a`` and the contacts act in series.
        """
        bearing = self.bearing
        distance = bearing.inner_reach + bearing.outer_reach
        series = (self.inner_constant ** (-2.0 / 3.0) + self.outer_constant ** (-2.0 / 3.0)) ** -1.5
        free = bearing.contact_angle

        def load(angle: float) -> float:
            return series * (distance * max(cos(free) / cos(angle) - 1.0, 0.0)) ** 1.5

        def excess(angle: float) -> float:
            return bearing.ball_count * load(angle) * sin(angle) - force

        angle = brentq(excess, free, asin(0.95), xtol=1e-15, rtol=1e-14)
        return load(angle), angle, distance * cos(free) * (tan(angle) - tan(free))


@functools.lru_cache(maxsize=64)
def _turn(tilt_y: float, tilt_z: float) -> np.ndarray:
    """Matrix of a ring's tilts (rad), one rotation about their common axis."""
    return Rotation.from_rotvec([0.0, tilt_y, tilt_z]).as_matrix()


def _towards_groove(groove: tuple[float, float], point: np.ndarray) -> tuple[np.ndarray, float]:
    """Find unit vector and distance from a point (ring axes) to the nearest place on the groove circle."""
    from_axis = hypot(point[1], point[2])
    axial, radial = groove[0] - point[0], groove[1] - from_axis
    length = hypot(axial, radial)
    outward = np.array([0.0, point[1], point[2]]) / from_axis
    return (axial * np.array([1.0, 0.0, 0.0]) + radial * outward) / length, length


def _solve(residual, start: np.ndarray) -> np.ndarray:
    """Root of a small system in micrometres and newtons, Jacobian by differences of 1e-4 micrometres."""

    def jacobian(u: np.ndarray) -> np.ndarray:
        return np.array([(residual(u + d) - residual(u - d)) / 2e-4 for d in 1e-4 * np.eye(len(u))]).T

    # lm seldom helps and creeps when it does not, so it gets few evaluations
    for method, limit in (("hybr", {"maxfev": 1000}), ("lm", {"maxiter": 100})):
        found = root(residual, start, jac=jacobian, method=method, tol=1e-14, options=limit)
        if np.max(np.abs(found.fun)) < RESIDUAL_LIMIT:
            return found.x
    raise ValueError(f"no equilibrium: {np.max(np.abs(found.fun)):.3g} N left over")
