"""Several bearings on one shaft in motion: one dense system, solved with general-purpose tools.

A bearing is anything that tells the accelerations its bodies would have by themselves:

* ``balls``: their number; ``caged``: whether it has a cage; ``masses``: 17 numbers, mass (kg) or moment of
  inertia (kg m2) behind each coordinate of inner ring (x y z by bz), outer ring and cage (x y z turn by bz);
* ``evaluate(balls, places, rates, angle, speed, speed_rate)``: an :class:`Answer`, for nine rows of the balls
  (x r theta, their rates, spin about x r theta), places and rates of the 17 coordinates;
* ``stored(...)`` of the same: its energy (J); ``slopes(...)``: derivatives of its accelerations by places and
  by rates, each square, in the order of the accelerations: six rows of the balls, then the 17.

Unknown accelerations stand in this order: for each bearing its balls (x, r, theta, then spin about x, r,
theta: all balls of one row together) and those of its bodies that move by themselves (x of a sliding outer
ring, six of one on its own pedestal, six of the cage); then the shaft's n coordinates; then six of the
housing (x y z turn by bz at X = 0), if it moves. Rows of the balls and of bodies that move by themselves are
accelerations (m/s2, rad/s2), rows of shaft and housing forces (N, N m or what the coordinate asks for).

A ring that shaft or housing carries moves as ``T q`` (+ offset) and gives ``T^T m (a_free - a)`` to them;
``a_free`` is the acceleration that the bearing's own equations would give it. The term of a housing that
turns about its axis and tilts at once is left out (the rings' own is in their equations).
"""

from dataclasses import dataclass, field

import numpy as np

GRAVITY = 9.81
RINGS = 5  # coordinates of the inner ring, those of the outer ring follow
BODIES = 17
_OUTER = slice(5, 11)


def at_plane(sign, position):
    """Motion (5 x 5) of a plane of a rigid shaft in a bearing's own axes by that of X = 0."""
    return np.array(
        [
            [sign, 0.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0, position],
            [0.0, 0.0, 1.0, -position, 0.0],
            [0.0, 0.0, 0.0, sign, 0.0],
            [0.0, 0.0, 0.0, 0.0, sign],
        ]
    )


def of_housing(sign, position):
    """Motion (6 x 6) of an outer ring in its own axes by that of a rigid housing at X = 0.

    A mirror across the axis keeps turns about it, and changes the sign of tilts.
    """
    found = np.zeros((6, 6))
    without_turn = [0, 1, 2, 4, 5]
    found[np.ix_(without_turn, without_turn)] = at_plane(sign, position)
    found[3, 3] = 1.0
    return found


@dataclass(frozen=True)
class Answer:
    """A bearing's answer to a state: accelerations of balls (6 x n) and bodies (17), power and heat (W)."""

    balls: np.ndarray
    bodies: np.ndarray
    power: float
    heat: float


@dataclass(frozen=True)
class Housing:
    """A housing in x y z turn by bz at X = 0: matrices 6 x 6; ``heavy``: mass by coordinate (kg, kg m)."""

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    heavy: np.ndarray

    @classmethod
    def cylinder(
        cls, mass, diameter, length, position, stiffness, axial, rotational, zeta, carried=0.0,
        axes=(1.0, 0.0),
    ):  # fmt: skip
        """Solid cylinder on a pedestal at its middle; ``carried``: more inertia (6) that zeta counts.

        ``axial``, ``rotational`` (m2): stiffness over ``stiffness``, the radial one along z' (N/m); ``axes``:
        stiffness along y' over that one, and the turn (rad) of y', z' about X.
        """
        polar = mass * diameter**2 / 8.0
        across = 0.5 * polar + mass * length**2 / 12.0
        inertia = np.array([mass] * 3 + [polar, across, across])
        springs = stiffness * np.array([axial, axes[0], 1.0] + [rotational] * 3)
        dampers = 2.0 * zeta * np.sqrt(springs * (inertia + carried))
        middle, turned = of_housing(1.0, position), np.eye(6)
        turned[1:3, 1:3] = [[np.cos(axes[1]), np.sin(axes[1])], [-np.sin(axes[1]), np.cos(axes[1])]]
        along = turned @ middle  # motion along the pedestal's axes
        m = middle.T @ np.diag(inertia) @ middle
        d, k = (along.T @ np.diag(one) @ along for one in (dampers, springs))
        return cls(m, d, k, mass * middle[2])


@dataclass(frozen=True)
class Mounted:
    """A bearing in its place.

    ``plane``: motion of the shaft there (5 x n); ``offset`` (m), ``growth`` (m/s): axial place of the inner
    ring with the shaft at zero, own axes, and how it changes with time; ``seat``: "fixed", "sliding" or
    "pedestal"; ``spring``: force (N) and stiffness (N/m) behind a sliding ring; ``lean``: tilts about y and z
    (rad) of the seat that holds the outer ring, own axes.
    """

    bearing: object
    sign: float
    position: float
    plane: np.ndarray
    offset: float = 0.0
    seat: str = "fixed"
    spring: tuple = (0.0, 0.0)
    growth: float = 0.0
    lean: tuple = (0.0, 0.0)

    @property
    def free(self):
        """Coordinates of its bodies that move by themselves, in their order among the 17."""
        outer = {"fixed": [], "sliding": [5], "pedestal": list(range(5, 11))}[self.seat]
        return outer + (list(range(11, BODIES)) if self.bearing.caged else [])


@dataclass(frozen=True)
class Drive:
    """What is prescribed: rotation, force and moment at the nose (5), heavy spots as (kg m, rad), weight.

    ``eccentricity``: of shaft and inner rings (m), at 12 o'clock where the angle is zero.
    """

    speed: float
    angle: float = 0.0
    speed_rate: float = 0.0
    nose: np.ndarray = field(default_factory=lambda: np.zeros(5))
    spots: tuple = ()
    gravity: bool = True
    eccentricity: float = 0.0

    def at(self, t):
        """Angle and speed at a time."""
        return self.angle + t * (self.speed + 0.5 * t * self.speed_rate), self.speed + t * self.speed_rate


class Spindle:
    """Bearings on a shaft, with or without a housing that moves.

    ``shaft`` has matrices ``mass``, ``damping``, ``stiffness``, ``gyroscopic``, vector ``heavy``, and the
    motions ``nose`` and ``spots`` (5 x n each).

    A state is the vector of all places in the order of the unknowns (those of spins are not read), then of
    all rates, then work and heat so far (J).
    """

    def __init__(self, mounted, shaft, drive, housing=None):
        self.mounted, self.shaft, self.drive, self.housing = tuple(mounted), shaft, drive, housing
        self.own, start = [], 0
        for one in self.mounted:
            size = 6 * one.bearing.balls + len(one.free)
            self.own.append(slice(start, start + size))
            start += size
        n = len(shaft.heavy)
        self.of_shaft = slice(start, start + n)
        self.of_housing = slice(start + n, start + n + (0 if housing is None else 6))
        self.carriers = slice(start, self.of_housing.stop)
        self.count = self.of_housing.stop
        self.motions = [self._motion(k) for k in range(len(self.mounted))]
        self.weights = [self._weights(k) for k in range(len(self.mounted))]
        self.mass = self._carriers("mass")
        self.heavy = self._carriers("heavy")
        self.total_mass = self.mass.copy()
        for motion, weight in zip(self.motions, self.weights, strict=True):
            self.total_mass += motion.T @ (weight[:, None] * motion)

    def _carriers(self, name):
        """Matrix or vector of shaft and housing among all unknowns."""
        parts = [(self.of_shaft, getattr(self.shaft, name))]
        if self.housing is not None:
            parts.append((self.of_housing, getattr(self.housing, name)))
        found = np.zeros((self.count,) * np.ndim(parts[0][1]))
        for place, part in parts:
            found[(place,) * np.ndim(part)] = part
        return found

    def carried(self, k):
        """Coordinates of the outer ring of a bearing that the housing carries."""
        if self.housing is None:
            return []
        return [one for one in range(5, 11) if one not in self.mounted[k].free]

    def _motion(self, k):
        """All accelerations of a bearing (6 n + 17) by the unknowns."""
        one, own = self.mounted[k], self.own[k]
        balls = 6 * one.bearing.balls
        found = np.zeros((balls + BODIES, self.count))
        found[:balls, own.start : own.start + balls] = np.eye(balls)
        for number, body in enumerate(one.free):
            found[balls + body, own.start + balls + number] = 1.0
        mirror = np.array([one.sign, 1.0, 1.0, one.sign, one.sign])
        found[balls : balls + RINGS, self.of_shaft] = mirror[:, None] * one.plane
        by_housing = of_housing(one.sign, one.position)
        for body in self.carried(k):
            found[balls + body, self.of_housing] = by_housing[body - RINGS]
        return found

    def _weights(self, k):
        """What each row counts: 1 where it moves by itself, the mass where it is carried, 0 where held."""
        one, balls = self.mounted[k], 6 * self.mounted[k].bearing.balls
        found = np.zeros(balls + BODIES)
        found[:balls] = 1.0
        found[balls + np.array(one.free, dtype=int)] = 1.0
        for body in [*range(RINGS), *self.carried(k)]:
            found[balls + body] = one.bearing.masses[body]
        return found

    def split(self, state):
        """Places and rates of all unknowns."""
        return state[: self.count], state[self.count : 2 * self.count]

    def bearing_state(self, k, t, state):
        """Nine rows of the balls, places and rates of the 17 coordinates; angle, speed and its rate."""
        one = self.mounted[k]
        n = one.bearing.balls
        places, rates = (self.motions[k] @ part for part in self.split(state))
        places[6 * n] += one.offset + one.growth * t
        places[6 * n + 9 : 6 * n + 11] += one.lean
        rates[6 * n] += one.growth
        balls = np.concatenate([places[: 3 * n], rates[: 6 * n]]).reshape(9, n)
        return balls, places[6 * n :], rates[6 * n :], *self.drive.at(t), self.drive.speed_rate

    def answer(self, k, t, state):
        """What a bearing says about the state."""
        return self.mounted[k].bearing.evaluate(*self.bearing_state(k, t, state))

    def pushes(self, t):
        """Force and moment at the plane of each heavy spot."""
        angle, speed = self.drive.at(t)
        found = []
        for amount, ahead in self.drive.spots:
            outwards = np.array([0.0, -np.sin(angle + ahead), np.cos(angle + ahead), 0.0, 0.0])
            back = np.array([0.0, np.cos(angle + ahead), np.sin(angle + ahead), 0.0, 0.0])
            found.append(amount * (speed**2 * outwards + self.drive.speed_rate * back))
        return found

    def outside(self, t):
        """Forces on shaft and housing from outside but weight: nose, heavy spots, eccentricity."""
        found = np.zeros(self.count)
        found[self.of_shaft] = self.shaft.nose.T @ self.drive.nose
        for spot, push in zip(self.shaft.spots, self.pushes(t), strict=True):
            found[self.of_shaft] += spot.T @ push
        if self.drive.eccentricity:
            angle, speed = self.drive.at(t)
            co, si, rate = np.cos(angle), np.sin(angle), self.drive.speed_rate
            push = self.drive.eccentricity * (speed**2 * np.array([-si, co]) + rate * np.array([co, si]))
            turning = self.shaft.across + sum(one.bearing.masses[0] * one.plane[1:3] for one in self.mounted)
            found[self.of_shaft] += push @ turning
        return found

    def springs(self):
        """Of each sliding ring: its place among the unknowns, what stretches its spring, force, stiffness."""
        for one, own, motion in zip(self.mounted, self.own, self.motions, strict=True):
            if one.seat == "sliding":
                balls = 6 * one.bearing.balls
                stretch = motion[balls + RINGS].copy()
                if self.housing is not None:
                    stretch[self.of_housing] -= of_housing(one.sign, one.position)[0]
                yield own.start + balls, stretch, one.spring, one.bearing.masses[RINGS]

    def matrices(self, t):
        """Damping with gyroscopic terms, and stiffness of shaft and housing, among all unknowns."""
        damping, stiffness = self._carriers("damping"), self._carriers("stiffness")
        damping[self.of_shaft, self.of_shaft] += self.drive.at(t)[1] * self.shaft.gyroscopic
        return damping, stiffness

    def forces(self, t, state):
        """All that accelerates, in the units of the rows; power in but that of growth, and heat (W)."""
        places, rates = self.split(state)
        damping, stiffness = self.matrices(t)
        outside = self.outside(t)
        found = outside - damping @ rates - stiffness @ places
        if self.drive.gravity:
            found -= GRAVITY * self.heavy
        power, heat = float(outside @ rates), float(rates @ self._carriers("damping") @ rates)
        for k in range(len(self.mounted)):
            answer = self.answer(k, t, state)
            free = np.concatenate([answer.balls.ravel(), answer.bodies])
            found += self.motions[k].T @ (self.weights[k] * free)
            power += answer.power
            heat += answer.heat
        for place, stretch, (force, constant), mass in self.springs():
            push = stretch * (force + constant * (stretch @ places))
            push[place] /= mass  # a row of accelerations
            found -= push
        return found, power, heat

    def residual(self, t, state, accelerations):
        """What is left over in all rows at given accelerations of the unknowns."""
        return self.forces(t, state)[0] - self.total_mass @ accelerations

    def rate(self, t, state):
        """Rates of a state."""
        found, power, heat = self.forces(t, state)
        c = self.carriers
        found[c] = np.linalg.solve(self.total_mass[c, c], found[c])  # all other rows are accelerations
        for k, one in enumerate(self.mounted):
            if one.growth != 0.0:
                first = 6 * one.bearing.balls
                moved = self.motions[k][first] @ found - self.answer(k, t, state).bodies[0]
                power += one.growth * one.bearing.masses[0] * moved
        return np.concatenate([self.split(state)[1], found, [power, heat]])

    def energy(self, t, state):
        """Stored energy (J)."""
        places, rates = self.split(state)
        total = 0.5 * rates @ self.mass @ rates + 0.5 * places @ self.matrices(t)[1] @ places
        if self.drive.gravity:
            total += GRAVITY * self.heavy @ places
        for _, stretch, (force, constant), _ in self.springs():
            gone = stretch @ places
            total += gone * (force + 0.5 * constant * gone)
        for k, one in enumerate(self.mounted):
            total += one.bearing.stored(*self.bearing_state(k, t, state))
        return float(total)

    def matrix(self, t, state, gh):
        """Minus the derivative of :meth:`residual` by the accelerations, with places and rates following.

        A change d of accelerations moves rates by ``gh d`` and places by ``gh^2 d``.
        """
        damping, stiffness = self.matrices(t)
        found = self.total_mass + gh * damping + gh * gh * stiffness
        for k, one in enumerate(self.mounted):
            by_places, by_rates = one.bearing.slopes(*self.bearing_state(k, t, state))
            moved = (gh * gh * by_places + gh * by_rates) @ self.motions[k]
            found -= self.motions[k].T @ (self.weights[k][:, None] * moved)
        for place, stretch, (_, constant), mass in self.springs():
            push = stretch.copy()
            push[place] /= mass
            found += gh * gh * constant * np.outer(push, stretch)
        return found


def runge_kutta(rate, state, duration, h, t=0.0):
    """State after ``duration`` (s) by steps of ``h`` (s) of the classical method."""
    steps = round(duration / h)
    for _ in range(steps):
        k1 = rate(t, state)
        k2 = rate(t + 0.5 * h, state + 0.5 * h * k1)
        k3 = rate(t + 0.5 * h, state + 0.5 * h * k2)
        k4 = rate(t + h, state + h * k3)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        t += h
    return state
