"""Fidelities `rings` and `response`: what their tests share, and the equations of `rings` written slowly."""

import numpy as np
from scipy.optimize import root

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import SP, C, H, L, P, S, U
from tests.oracles.cartesian_forces import turned_axes

FIDELITIES = {"rings": 1.0, "response": 2.0}


def silent(scene):
    """The scene with its imperfections but without sound."""
    return scene.model_copy(update={"sound": None})


def block(run):
    """What the fidelities keep in the state."""
    return run.s[S.CONDENSED : S.CONDENSED + L.SIZE]


def march(run):
    """Numbers that the march of a single bearing keeps in its state, then its vectors: see `history`."""
    return run.s[S.SET + SP.S_HEAD + (SP.MOTION + L.N) * L.COLUMN + SP.PER_BEARING :]


def history(run):
    """Vectors of the march of a single bearing, by rows: see ``layout.history``."""
    return march(run)[SP.MARCHED : SP.MARCHED + H.VECTORS * L.COLUMN].reshape(H.VECTORS, L.COLUMN)


def vibration(rows):
    """Root mean square velocity of inner and outer ring (m/s), all axes together, mean removed."""
    v = rows[:, :6] - rows[:, :6].mean(0)
    return np.sqrt((v[:, :3] ** 2).sum(1).mean()), np.sqrt((v[:, 3:] ** 2).sum(1).mean())


def matrices(run):
    """Masses, and derivatives of the rings' accelerations by places and rates, of the state block."""
    lv = block(run)
    return [lv[at : at + L.MATRIX].reshape(L.N, 12)[:, : L.N].T.copy() for at in (L.MASS, L.JX, L.JV)]


def with_patterns(run):
    """Linear equations M x'' = K x + C x' of rings and transverse balls of fidelity `response`."""
    lv, count = block(run), L.N + L.PATTERNS
    follow, lead, guide, pull, drag = (
        lv[at : at + L.PATTERNS * L.COLUMN].reshape(L.PATTERNS, L.COLUMN)[:, : L.N]
        for at in (L.SIDE_FOLLOW, L.SIDE_LEAD, L.SIDE_GUIDE, L.SIDE_PULL, L.SIDE_DRAG)
    )
    square, rate = lv[L.SIDE_SQUARE], lv[L.SIDE_RATE]
    mass, stiff, damp = np.eye(count), np.zeros((count, count)), np.zeros((count, count))
    own, places, rates = matrices(run)
    rings, balls = np.s_[: L.N], np.s_[L.N :]
    one = np.eye(L.PATTERNS)
    mass[rings, rings] = own
    stiff[rings, rings], stiff[rings, balls] = places - pull.T @ follow, pull.T
    damp[rings, rings], damp[rings, balls] = rates - pull.T @ lead - drag.T @ guide, drag.T
    stiff[balls, rings], stiff[balls, balls] = square * follow, -square * one
    damp[balls, rings], damp[balls, balls] = square * lead + rate * guide, -rate * one
    return mass, stiff, damp


class Slow:
    """The equations of fidelity rings written out with NumPy: balls by SciPy's root, forces ball by ball."""

    def __init__(self, run, ratio=1.0, angle=0.0):
        """``ratio``, ``angle`` (rad): of the pedestal's stiffnesses, and of its axes."""
        self.ratio, self.angle = ratio, angle
        self.p, self.lv = run.p, block(run).copy()
        self.c = run.s[S.C : S.C + C.SIZE].copy()
        self.balls = int(self.p[P.BALLS])
        self.speed = run.u[U.SPEED]
        self.tau = self.p[P.CONTACT_DAMPING]
        self.soft = self.lv[L.SIDE : L.SIDE + 2]
        self.square, self.rate = self.lv[L.SIDE_SQUARE], self.lv[L.SIDE_RATE]
        self.side = {
            name: self.lv[at : at + L.PATTERNS * L.COLUMN].reshape(L.PATTERNS, L.COLUMN)[:, : L.N]
            for name, at in (("guide", L.SIDE_GUIDE), ("pull", L.SIDE_PULL), ("drag", L.SIDE_DRAG))
        }
        self.places = [np.array([self.lv[L.X + j], self.lv[L.R + j]]) for j in range(self.balls)]

    def matrix(self, where):
        """An 11 x 11 matrix of the state block."""
        return self.lv[where : where + L.MATRIX].reshape(L.N, 12)[:, : L.N].T

    def height(self, race, angle, derivative=0):
        """Race height under an angle, or its second derivative, from the table's cubic."""
        count = int(self.p[P.WAVE_INTERVALS])
        table = self.p[int(self.p[P.AT_WAVES]) :][: 4 * count].reshape(2, -1, 2)[race]
        place = angle * count / (2 * np.pi)
        i, t = int(np.floor(place)), place - np.floor(place)
        (h0, g0), (h1, g1) = table[i % count], table[(i + 1) % count]
        a, b = g0 + g1 - 2 * (h1 - h0), 3 * (h1 - h0) - 2 * g0 - g1
        if derivative:
            return (2 * b + 6 * a * t) * (count / (2 * np.pi)) ** 2
        return h0 + t * (g0 + t * (b + t * a))

    def seat(self, race, ball, u, tilt):
        """Ring seen from a ball: axis, ball from its centre, radial direction, ball from the groove."""
        axis = np.array([1 - 0.5 * tilt @ tilt, tilt[1], -tilt[0]])
        q = ball - u
        axial = q @ axis
        h = q - axial * axis
        rho = np.linalg.norm(h)
        o = C.RACES + race * C.RACE_SIZE
        return axis, q, h / rho, np.array([axial - self.c[o], rho - self.c[o + 1]])

    def contact(self, race, ball, height, ring, ahead):
        """Force of the ball at ``ball`` (orbiting plane turned into x y z) on one ring, and its moment.

        ``ring``, ``ahead``: the ring's place and tilts, now and advanced by tau. Approach alone is advanced:
        that the direction turns meanwhile changes the distance by 1e-12 m.
        """
        axis, q, h, s = self.seat(race, ball, *ring)
        distance = np.linalg.norm(s)
        sine, cosine = s / distance
        free = self.c[C.RACES + race * C.RACE_SIZE + 2]
        approach = max(np.linalg.norm(self.seat(race, ball, *ahead)[3]) - free + height, 0.0)
        hertz = self.p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
        pair = self.lv[L.PAIR_INNER + race] * self.speed**2
        e, m = sine * axis + cosine * h, cosine * axis - sine * h
        force = hertz * approach**1.5 * e + pair * m
        return force, np.cross(q, force), e, m, 1.5 * hertz * approach**0.5, hertz * approach**1.5 / distance

    def both(self, place, theta, heights, q, ahead):
        """Contacts of a ball at ``place`` (x, r) with both rings at ``q``; ``ahead``: advanced by tau."""
        radial = np.array([0.0, -np.sin(theta), np.cos(theta)])
        ball = place[0] * np.array([1.0, 0.0, 0.0]) + (self.p[P.PITCH_RADIUS] + place[1]) * radial
        inner = [(at[:3], at[3:5]) for at in (q, ahead)]
        outer = [(at[5:8], at[9:11]) for at in (q, ahead)]
        return self.contact(0, ball, heights[0], *inner), self.contact(1, ball, heights[1], *outer)

    def residual(self, place, theta, heights, bends, q, ahead):
        """Net force (x, r) on a ball, with the inertia of what the waves make it do."""
        p = self.p
        plane = np.array([[1.0, 0.0, 0.0], [0.0, -np.sin(theta), np.cos(theta)]])
        orbit = self.lv[L.RATIO] * self.speed
        net = np.array([0.0, (p[P.PITCH_RADIUS] + place[1]) * orbit**2 * p[P.BALL_MASS]])
        net[1] -= GRAVITY * p[P.BALL_MASS] * np.cos(theta)
        stiffness, pushed = np.zeros((2, 2)), np.zeros(2)
        for contact, bend in zip(self.both(place, theta, heights, q, ahead), bends, strict=True):
            force, _, e, m, kn, kt = contact
            e, m = plane @ e, plane @ m
            net -= plane @ force
            stiffness += kn * np.outer(e, e) + kt * np.outer(m, m)
            pushed += kn * bend * e
        made = np.linalg.solve(stiffness, pushed)
        return net + p[P.BALL_MASS] * (made - self.soft * (self.soft @ made))

    def patterns(self, theta):
        """Even, cosine and minus sine pattern of a ball, normed so that sums over the balls project."""
        return np.array([1.0, 2.0 * np.cos(theta), -2.0 * np.sin(theta)]) / self.balls

    def accelerations(self, t, q, v, side=None):
        """Accelerations of the 11 coordinates at time ``t`` from the start, then of the transverse patterns.

        ``side``: the patterns' places and velocities; absent: at rest where the balls rest, and the
        accelerations of the rings alone.
        """
        p, speed = self.p, self.speed
        orbit = self.lv[L.RATIO] * speed
        ahead = q + self.tau * v
        f = np.zeros(L.N)
        rest = np.zeros(L.PATTERNS)
        for j in range(self.balls):
            theta = orbit * (t + self.tau) + 2 * np.pi * j / self.balls
            across = theta - speed * (t + self.tau), theta - q[8]
            size = 0.5 * p[int(p[P.AT_OVERSIZE]) + j]
            heights = [size + self.height(race, across[race]) for race in range(2)]
            bends = [
                self.height(0, across[0], 2) * (orbit - speed) ** 2,
                self.height(1, across[1], 2) * orbit**2,
            ]
            state = (theta, heights, bends, q, ahead)
            found = root(
                lambda x, state=state: self.residual(1e-6 * x, *state), 1e6 * self.places[j], tol=1e-13
            )
            self.places[j] = 1e-6 * found.x
            rest += self.patterns(theta) * (self.soft @ self.places[j] - self.lv[L.SIDE_STILL])
            contacts = self.both(self.places[j], theta, heights, q, ahead)
            for first, tilt, (force, moment, *_) in zip((0, 5), (3, 9), contacts, strict=True):
                f[first : first + 3] += force
                f[tilt : tilt + 2] += moment[1:]
        rolled = self.side["guide"] @ v
        place, moving = (rest, np.zeros(L.PATTERNS)) if side is None else side
        self.rest = rest
        pushed = (place - rest) @ self.side["pull"] + (moving - rolled) @ self.side["drag"]
        rings = self.rings(t, f, q, v, self.c, pushed)
        if side is None:
            return rings
        return np.concatenate([rings, self.square * (rest - place) + self.rate * (rolled - moving)])

    def rings(self, t, f, q, v, c, pushed=0.0):
        """Everything on the rings that does not come through the balls' contacts, then the mass matrix.

        ``pushed``: accelerations of their own masses by the balls' transverse motion.
        """
        p, speed = self.p, self.speed
        f[0] += c[C.PRELOAD]
        heavy = p[P.INNER_MASS] * c[C.ECCENTRICITY] * speed**2
        f[1] -= heavy * np.sin(speed * t)
        f[2] += heavy * np.cos(speed * t) - GRAVITY * p[P.INNER_MASS]
        f[7] -= GRAVITY * p[P.OUTER_MASS]
        f[3] += -p[P.INNER_POLAR] * speed * v[4] - p[P.TILT_STIFFNESS] * q[3]
        f[4] += p[P.INNER_POLAR] * speed * v[3] - p[P.TILT_STIFFNESS] * q[4]
        f[3:5] -= p[P.TILT_DAMPING] * v[3:5]
        f[8] += self.lv[L.TWIST]
        f[5] -= c[C.PEDESTAL_AXIAL] * q[5] + c[C.DAMPING_AXIAL] * v[5]
        along = np.array([self.ratio * c[C.PEDESTAL], c[C.PEDESTAL]])
        damping = 2.0 * p[P.PEDESTAL_ZETA] * np.sqrt(along * p[P.OUTER_MASS])
        f[6:8] -= turned_axes(*along, self.angle) @ q[6:8] + turned_axes(*damping, self.angle) @ v[6:8]
        f[8] -= c[C.PEDESTAL_ROTATIONAL] * q[8] + c[C.DAMPING_SPIN] * v[8]
        f[9:] -= c[C.PEDESTAL_ROTATIONAL] * q[9:] + c[C.DAMPING_ROTATIONAL] * v[9:]
        own = p[
            [P.INNER_MASS] * 3
            + [P.INNER_TRANSVERSE] * 2
            + [P.OUTER_MASS] * 3
            + [P.OUTER_POLAR]
            + [P.OUTER_TRANSVERSE] * 2
        ]
        return np.linalg.solve(self.matrix(L.MASS), f / own + self.matrix(L.EXTRA) @ v + pushed)
