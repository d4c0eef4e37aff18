"""Fidelities `rings` and `response`: what their tests share, and the equations of `rings` written slowly."""

import numpy as np
from scipy.optimize import root

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import SP, C, H, L, P, S, U
from fmu_bearing.modal.equations.quick import operator_matrix
from tests.oracles.cartesian_forces import turned_axes

COMES_IN = 2e-3  # s, as in condensed/patterns
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


def answer(run, omega, accelerations):
    """Complex places of the coordinates at ``omega`` (rad/s) to what accelerates them, by a dense solve."""
    matrix, n = operator_matrix(run), len(accelerations)
    drive = np.zeros(len(matrix), complex)
    drive[n : 2 * n] = accelerations
    return np.linalg.solve(1j * omega * np.eye(len(matrix)) - matrix, drive)[:n]


class Family:
    """One family of the operator in the state block ``lv``, with complex arrays over its modes."""

    def __init__(self, lv, family):
        f = L.FAMILY + family * L.FAMILY_SIZE
        count = int(lv[L.OPERATOR + family])

        def rows(at, many):
            table = lv[f + at : f + at + many * L.COMPLEX].reshape(many, 2, L.MODES)[:, :, :count]
            return table[:, 0] + 1j * table[:, 1]

        def pairs(at, shape):
            table = lv[f + at : f + at + 2 * int(np.prod(shape))].reshape(*shape, 2)
            return table[..., 0] + 1j * table[..., 1]

        self.planes = PLANES[family]
        n = len(self.planes[0])
        self.value = rows(L.VALUE, 1)[0]
        self.by_place, self.by_rate = rows(L.IN_PLACE, 4)[:n], rows(L.IN_RATE, 4)[:n]
        self.by_away, self.out = rows(L.IN_AWAY, L.AWAYS), rows(L.OUT, 4)[:n]
        follow = pairs(L.FOLLOW, (2, 2, 4))[..., :n]
        self.follow, self.lead = follow
        self.push = pairs(L.COUPLING, (4, L.AWAYS))[:n]
        at = family * L.COMPLEX
        self.now = slice(at, at + count), slice(at + L.MODES, at + L.MODES + count)

    def of(self, x):
        """The family's complex coordinates of the rings' eleven numbers."""
        parts = [np.array([sign * x[k] for k, sign in plane]) for plane in self.planes]
        return parts[0] + (1j * parts[1] if len(parts) > 1 else 0.0)

    def back(self, found):
        """The rings' eleven numbers of complex ones."""
        x = np.zeros(L.N)
        for plane, part in zip(self.planes, (found.real, found.imag), strict=False):
            for (k, sign), value in zip(plane, part, strict=True):
                x[k] = sign * value
        return x


# coordinates of a family with their signs: in the first plane, then in the second, where tilts turn back
PLANES = (
    [[(0, 1.0), (5, 1.0), (8, 1.0)]],
    [[(2, 1.0), (3, 1.0), (7, 1.0), (9, 1.0)], [(1, 1.0), (4, -1.0), (6, 1.0), (10, -1.0)]],
)


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
        self.families = [Family(self.lv, family) for family in range(2)]
        self.places = [np.array([self.lv[L.X + j], self.lv[L.R + j]]) for j in range(self.balls)]

    def matrix(self, where):
        """An 11 x 11 matrix of the state block."""
        return self.lv[where : where + L.MATRIX].reshape(L.N, 12)[:, : L.N].T

    def height(self, race, angle, further=0.0):
        """Race height under an angle from the table's cubic, on along its tangent by an angle ``further``."""
        count = int(self.p[P.WAVE_INTERVALS])
        table = self.p[int(self.p[P.AT_WAVES]) :][: 4 * count].reshape(2, -1, 2)[race]
        place = angle * count / (2 * np.pi)
        i, t = int(np.floor(place)), place - np.floor(place)
        (h0, g0), (h1, g1) = table[i % count], table[(i + 1) % count]
        a, b = g0 + g1 - 2 * (h1 - h0), 3 * (h1 - h0) - 2 * g0 - g1
        slope = (g0 + t * (2 * b + t * 3 * a)) * count / (2 * np.pi)
        return h0 + t * (g0 + t * (b + t * a)) + further * slope

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
        return force, np.cross(q, force)

    def both(self, place, theta, heights, q, ahead):
        """Contacts of a ball at ``place`` (x, r) with both rings at ``q``; ``ahead``: advanced by tau."""
        radial = np.array([0.0, -np.sin(theta), np.cos(theta)])
        ball = place[0] * np.array([1.0, 0.0, 0.0]) + (self.p[P.PITCH_RADIUS] + place[1]) * radial
        inner = [(at[:3], at[3:5]) for at in (q, ahead)]
        outer = [(at[5:8], at[9:11]) for at in (q, ahead)]
        return self.contact(0, ball, heights[0], *inner), self.contact(1, ball, heights[1], *outer)

    def residual(self, place, theta, heights, q, ahead):
        """Net force (x, r) on a ball."""
        p = self.p
        plane = np.array([[1.0, 0.0, 0.0], [0.0, -np.sin(theta), np.cos(theta)]])
        orbit = self.lv[L.RATIO] * self.speed
        net = np.array([0.0, (p[P.PITCH_RADIUS] + place[1]) * orbit**2 * p[P.BALL_MASS]])
        net[1] -= GRAVITY * p[P.BALL_MASS] * np.cos(theta)
        for force, _ in self.both(place, theta, heights, q, ahead):
            net -= plane @ force
        return net

    def counted(self, e, pushes):
        """What counts of a ball's rest beside the linear one: less where it is far or lightly loaded."""
        xx, xr, rr = self.lv[L.REACH : L.REACH + 3]
        far = e[:2] @ np.array([[xx, xr], [xr, rr]]) @ e[:2]
        loaded = np.prod([np.linalg.norm(force) for force, _ in pushes]) / self.lv[L.LOADED]
        return e * loaded**4 / (loaded**4 + 1e-4) / (1.0 + far**2)

    def pressed(self, linear, theta, rings, pushes):
        """By how much both contacts of a ball press beside its linear motion (m), as load over stiffness.

        ``linear``: x, r of that; ``rings``: the rings' displacements, advanced by tau.
        """
        found = np.zeros(2)
        for race, (first, tilt) in enumerate(((0, 3), (5, 9))):
            ex, er, lever, soft, load = self.lv[L.PRESS + race * L.PRESS_SIZE :][:5]
            pair = self.lv[L.PAIR_INNER + race] * self.speed**2
            # friction across the track is at right angles to the load
            now = np.sqrt(max(np.sum(pushes[race][0] ** 2) - pair**2, 0.0))
            u, by, bz = rings[first : first + 3], rings[tilt], rings[tilt + 1]
            aside = u[2] * np.cos(theta) - u[1] * np.sin(theta)
            led = ex * (linear[0] - u[0]) + er * (linear[1] - aside)
            led -= lever * (by * np.cos(theta) + bz * np.sin(theta))
            found[race] = soft * (now - load) - led
        return found

    def accelerations(self, t, q, v, modes=None):
        """Accelerations of the 11 coordinates at time ``t`` from the start, then rates of the modes.

        ``modes``: complex, of balls and cage; absent: where their drive would hold them, and accelerations of
        the rings alone.
        """
        p, speed = self.p, self.speed
        orbit = self.lv[L.RATIO] * speed
        ahead = q + self.tau * v
        f = np.zeros(L.N)
        place = q - self.lv[L.AT_RINGS : L.AT_RINGS + L.N]
        # where the rings' linear motion takes the balls, by families
        led = [one.follow @ one.of(place) + one.lead @ one.of(v) for one in self.families]
        away = np.zeros((2, L.AWAYS), dtype=complex)
        for j in range(self.balls):
            now = orbit * t + 2 * np.pi * j / self.balls
            across, rates = (now - speed * t, now - q[8]), (orbit - speed, orbit)
            size = 0.5 * p[int(p[P.AT_OVERSIZE]) + j]
            # damping presses by tau times the rate; the ball goes on along its orbit
            heights = [size + self.height(k, across[k], self.tau * rates[k]) for k in range(2)]
            theta = now + self.tau * orbit
            state = (theta, heights, q, ahead)
            found = root(
                lambda x, state=state: self.residual(1e-6 * x, *state), 1e6 * self.places[j], tol=1e-13
            )
            self.places[j] = 1e-6 * found.x
            pushes = self.both(self.places[j], *state)
            moved = self.places[j] - self.lv[L.AT_BALL : L.AT_BALL + 2]
            linear = (led[0] + led[1] * np.exp(1j * theta)).real
            pressed = self.pressed(linear, theta, place + self.tau * v, pushes)
            moved = self.counted(np.append(moved - linear, pressed), pushes)
            away[0] += moved / self.balls
            away[1] += 2.0 * np.exp(-1j * theta) * moved / self.balls
            for first, tilt, (force, moment) in zip((0, 5), (3, 9), pushes, strict=True):
                f[first : first + 3] += force
                f[tilt : tilt + 2] += moment[1:]
        beside = self.matrix(L.FEEDTHROUGH_PLACE) @ place + self.matrix(L.FEEDTHROUGH_RATE) @ v
        rates, begin = [], 0
        for one, e in zip(self.families, away, strict=True):
            drive = one.of(place) @ one.by_place + one.of(v) @ one.by_rate + e @ one.by_away
            held = np.where(np.abs(one.value) < 1.0, 0.0, -drive / one.value)
            z = held if modes is None else modes[begin : begin + len(one.value)]
            beside += one.back(one.out @ z - one.push @ e)
            rates.append(one.value * z + drive)
            begin += len(one.value)
        self.rates = np.concatenate(rates)
        # what an operator adds at a start comes in by and by
        beside += self.lv[L.JUMP : L.JUMP + L.N] * np.exp(-t / COMES_IN)
        rings = self.rings(t, f, q, v, self.c) + beside
        return rings if modes is None else np.concatenate([rings, self.rates])

    def rings(self, t, f, q, v, c):
        """Everything on the rings that does not come through the balls' contacts, over their inertia."""
        p, speed = self.p, self.speed
        f[0] += c[C.PRELOAD]
        heavy = p[P.INNER_MASS] * c[C.ECCENTRICITY] * speed**2
        f[1] -= heavy * np.sin(speed * t)
        f[2] += heavy * np.cos(speed * t) - GRAVITY * p[P.INNER_MASS]
        f[7] -= GRAVITY * p[P.OUTER_MASS]
        f[3] -= p[P.INNER_POLAR] * speed * v[4]
        f[4] += p[P.INNER_POLAR] * speed * v[3]
        f[:5] -= p[P.SUPPORT_STIFFNESS : P.SUPPORT_STIFFNESS + 5] * q[:5]
        f[:5] -= p[P.SUPPORT_DAMPING : P.SUPPORT_DAMPING + 5] * v[:5]
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
        return f / own
