"""Forces between balls, rings and cage in inertial Cartesian vectors, for the oracle in `cartesian`.

Every force acts at one point in space, forward on one body and backward on the other; a body collects force
and moment about its own centre; power is force times the velocity of the material at that point.

What is the model's choice and not physics is written out here too:

* small tilts: axis ``n = (1 - (by^2 + bz^2)/2, bz, -by)``, angular velocity ``spin n + (0, by', bz')``; the
  azimuth of a ball on a body is read in the plane YZ;
* speeds are rounded where they change sign: entrainment over 1e-4 m/s, rolling and seals over 1 rad/s;
* a land is a plane at a fixed distance from the centre of either body: the cage's axial float is left out;
  beyond the dry stop the film keeps the thickness it has there.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.polynomial import legendre

from . import cross

EX = np.array([1.0, 0.0, 0.0])
INNER, OUTER, CAGE = range(3)
STILL, TURNING = 1e-4, 1.0  # m/s, rad/s

Wave = Callable[[float], tuple[float, float]]


@dataclass(frozen=True)
class Mass:
    """Mass (kg), transverse and polar moment of inertia (kg m2)."""

    mass: float
    transverse: float
    polar: float


@dataclass(frozen=True)
class Race:
    """Torus groove: centre circle (x, radius), free distance of the ball's centre from it, contact (SI).

    ``rolling``: moment against rolling (N m) by entrainment (m/s), load (N) and semi-major axis (m).
    """

    x: float
    circle: float
    free: float
    stiffness: float
    half_length: float
    profile: float
    rolling: Callable[[float, float, float], float]
    wave: Wave


@dataclass(frozen=True)
class Pocket:
    """Pocket of the cage (SI): a radial bore, or a sphere about a point of the pitch circle."""

    clearance: float
    stiffness: float
    damping: float
    friction: float
    slip: float
    film: float
    spherical: bool = False


@dataclass(frozen=True)
class Land:
    """Lands of the cage on a ring (SI), the inner one or the outer one; ``radius``: of the journal."""

    radius: float
    length: float
    offset: float
    clearance: float
    viscosity: float
    stop: float
    fraction: float
    friction: float
    slip: float
    ring: int = INNER


@dataclass(frozen=True)
class Setup:
    """The whole bearing (SI). Springs and dampers are matrices over (x, y, z, angle, tilt y, tilt z)."""

    pitch: float
    ball_radius: float
    ball_mass: float
    ball_inertia: float
    oversize: np.ndarray
    races: tuple[Race, Race]
    damping: float
    friction: float
    slide_to_roll: float
    floor: float
    strips: int
    drag: float
    gravity: bool
    gyroscopic: bool
    masses: tuple[Mass, Mass, Mass]
    springs: np.ndarray
    dampers: np.ndarray
    eccentricity: float
    cage_eccentricity: float
    load: np.ndarray
    pocket: Pocket | None
    land: Land | None
    bumps: np.ndarray | None = None  # m: zonal harmonics of the balls from order 1 on
    rest: np.ndarray = field(default_factory=lambda: np.zeros((3, 6)))  # where the springs are slack
    neighbours: tuple[float, float] | None = None  # N/m and N s/m between adjacent balls
    seals: float = 0.0  # N m


@dataclass(frozen=True)
class State:
    """Balls (n, 9): x, r, theta, rates, spin; bodies (3, 6): x, y, z, angle, tilts; their rates (3, 6);
    inertial directions (n, 3) fixed in wavy balls.
    """

    balls: np.ndarray
    bodies: np.ndarray
    rates: np.ndarray
    axes: np.ndarray | None = None

    def after(self, time, balls=0.0, bodies=0.0) -> "State":
        """Move on for ``time`` with the present rates and with the accelerations given ((n, 6), (3, 6))."""
        rates = np.hstack([self.balls[:, 3:6], np.zeros((len(self.balls), 6))])
        rates[:, 3:] += balls
        axes = None
        if self.axes is not None:
            turning = [np.array(directions(ball[2])).T @ ball[6:] for ball in self.balls]
            axes = self.axes + time * np.cross(turning, self.axes)
        return State(
            self.balls + time * rates, self.bodies + time * self.rates, self.rates + time * bodies, axes
        )


@dataclass
class Loads:
    """Force and moment about its own centre on every ball and body; rows: balls, then bodies."""

    setup: Setup
    state: State
    force: np.ndarray = field(init=False)
    moment: np.ndarray = field(init=False)

    def __post_init__(self):
        self.force = np.zeros((len(self.state.balls) + 3, 3))
        self.moment = np.zeros_like(self.force)

    def row(self, body: int) -> int:
        return len(self.state.balls) + body

    def centre(self, row: int) -> np.ndarray:
        n = len(self.state.balls)
        return ball_centre(self.setup, self.state.balls[row]) if row < n else self.state.bodies[row - n, :3]

    def spin(self, row: int) -> np.ndarray:
        """Angular velocity of a ball or body."""
        n = len(self.state.balls)
        if row < n:
            return np.array(directions(self.state.balls[row, 2])).T @ self.state.balls[row, 6:]
        rate = self.state.rates[row - n]
        return rate[3] * axis(self.state.bodies[row - n]) + np.array([0.0, rate[4], rate[5]])

    def velocity(self, row: int, point: np.ndarray) -> np.ndarray:
        """Velocity of the material of a ball or body at a point."""
        n = len(self.state.balls)
        own = ball_velocity(self.setup, self.state.balls[row]) if row < n else self.state.rates[row - n, :3]
        return own + cross(self.spin(row), point - self.centre(row))

    def push(self, row: int, point: np.ndarray, force: np.ndarray, couple: np.ndarray) -> float:
        """Load one body; power it receives (W)."""
        self.force[row] += force
        self.moment[row] += cross(point - self.centre(row), force) + couple
        return force @ self.velocity(row, point) + couple @ self.spin(row)

    def act(self, one: int, other: int, point, force, couple=(0.0, 0.0, 0.0)) -> float:
        """Load ``one`` and, at the same point, ``other`` with the opposite; power both receive (W)."""
        force, couple = np.asarray(force), np.asarray(couple)
        return self.push(one, point, force, couple) + self.push(other, point, -force, -couple)


def directions(theta) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Axial, radial and circumferential direction of a ball at ``theta`` from 12 o'clock."""
    c, s = np.cos(theta), np.sin(theta)
    return EX, np.array([0.0, -s, c]), np.array([0.0, -c, -s])


def turned_axes(along_y: float, along_z: float, angle: float) -> np.ndarray:
    """Stiffness or damping (2 x 2, in y and z) of springs along axes y', z' turned by ``angle`` about X."""
    first, second = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    return along_y * np.outer(first, first) + along_z * np.outer(second, second)


def axis(body: np.ndarray) -> np.ndarray:
    """Axis of a slightly tilted body."""
    return np.array([1.0 - 0.5 * (body[4] ** 2 + body[5] ** 2), body[5], -body[4]])


def ball_centre(setup: Setup, ball: np.ndarray) -> np.ndarray:
    _, radial, _ = directions(ball[2])
    return ball[0] * EX + (setup.pitch + ball[1]) * radial


def ball_velocity(setup: Setup, ball: np.ndarray) -> np.ndarray:
    _, radial, around = directions(ball[2])
    return ball[3] * EX + ball[4] * radial + (setup.pitch + ball[1]) * ball[5] * around


def seen_from(setup: Setup, ball, body):
    """Axis n, radial direction h, tangent n x h, axial and radial distance, azimuth of a ball on a body."""
    n = axis(body)
    from_centre = ball_centre(setup, ball) - body[:3]
    axial = from_centre @ n
    h = from_centre - axial * n
    radius = np.sqrt(h @ h)
    h = h / radius
    _, radial, around = directions(ball[2])
    azimuth = ball[2] + np.arctan((h @ around) / (h @ radial)) - body[3]
    return n, h, cross(n, h), axial, radius, azimuth


def height(wave: Wave, angle):
    """Race height, also for an angle on its way along the imaginary time step."""
    value, slope = wave(angle.real)
    return value + slope * (angle - angle.real)


def approach(setup: Setup, state: State, j: int, k: int):
    """Approach of ball j and race k (m), positive when they press."""
    race = setup.races[k]
    *_, axial, radius, azimuth = seen_from(setup, state.balls[j], state.bodies[k])
    x, r = axial - race.x, radius - race.circle
    gap = np.sqrt(x * x + r * r) - race.free + height(race.wave, azimuth) + setup.oversize[j] / 2.0
    return gap + bump(setup, state, j, k)


def bump(setup: Setup, state: State, j: int, k: int):
    """Height (m) of the wavy ball j where it faces race k."""
    if setup.bumps is None:
        return 0.0
    n, h, _, axial, radius, _ = seen_from(setup, state.balls[j], state.bodies[k])
    e = (axial - setup.races[k].x) * n + (radius - setup.races[k].circle) * h
    e = e / np.sqrt(e @ e)
    return legendre.legval(e @ state.axes[j], [0.0, *setup.bumps])


def bump_gradient(setup: Setup, state: State, j: int, k: int) -> tuple[np.ndarray, np.ndarray]:
    """Change of :func:`bump` with the ball's place and with its turning (inertial axes), by complex steps."""
    step, moved, turned = 1e-30j, np.zeros(3), np.zeros(3)
    radius = setup.pitch + state.balls[j, 1]
    for i, (direction, per) in enumerate(
        zip(directions(state.balls[j, 2]), (1.0, 1.0, 1.0 / radius), strict=True)
    ):
        balls = state.balls.astype(complex)
        balls[j, i] += step * per
        moved += direction * bump(setup, replace(state, balls=balls), j, k).imag / step.imag
    for i, direction in enumerate(np.eye(3)):
        axes = state.axes.astype(complex)
        axes[j] += step * cross(direction, state.axes[j])
        turned[i] = bump(setup, replace(state, axes=axes), j, k).imag / step.imag
    return moved, turned


def pocket_axis(state: State, j: int) -> np.ndarray:
    """Direction of the bore of pocket j: across the cage's axis, its azimuth read in the plane YZ."""
    cage = state.bodies[CAGE]
    n = axis(cage)
    _, radial, _ = directions(cage[3] + 2.0 * np.pi * j / len(state.balls))
    bore = radial - (radial @ n) / n[0] * EX
    return bore / np.sqrt(bore @ bore)


def in_pocket(setup: Setup, state: State, j: int) -> np.ndarray:
    """Vector (m) to ball j from the bore's axis of its pocket, which goes through the cage's centre.

    From the middle of a spherical pocket.
    """
    bore = pocket_axis(state, j)
    from_centre = ball_centre(setup, state.balls[j]) - state.bodies[CAGE, :3]
    if setup.pocket.spherical:
        return from_centre - setup.pitch * bore
    return from_centre - (from_centre @ bore) * bore


def strip_points(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and shares of a load spread as 1 - s^2 over (-1, 1) that carry its moments up to 2 count - 1."""
    points = legendre.legroots(legendre.legder([0.0] * (count + 1) + [1.0]))
    powers = np.arange(count)
    moments = 0.75 * ((1.0 + (-1.0) ** powers) / (powers + 1) - (1.0 + (-1.0) ** powers) / (powers + 3))
    return points, np.linalg.solve(np.vander(points, increasing=True).T, moments)


def in_race(loads: Loads, j: int, k: int) -> float:
    """Load ball j and race k; heat of the contact (W)."""
    setup, state = loads.setup, loads.state
    race, ring = setup.races[k], loads.row(k)
    n, h, t, axial, radius, azimuth = seen_from(setup, state.balls[j], state.bodies[k])
    e = (axial - race.x) * n + (radius - race.circle) * h
    e /= np.linalg.norm(e)
    m = cross(e, t)
    gap = approach(setup, state, j, k)
    if gap <= 0.0:
        return 0.0
    centre = loads.centre(j)
    # steepest rise of the approach: on a wavy race it leans along the track; the contact pushes down it
    uphill = e + race.wave(azimuth)[1] / radius * t
    twist = np.zeros(3)
    if setup.bumps is not None:
        moved, twist = bump_gradient(setup, state, j, k)
        uphill = uphill + moved
    rate = uphill @ (loads.velocity(j, centre) - loads.velocity(ring, centre))
    rate += twist @ (loads.spin(j) - loads.spin(ring))
    elastic = race.stiffness * gap**1.5
    load = max(race.stiffness * np.sqrt(gap) * (gap + 1.5 * setup.damping * rate), 0.0)
    power = loads.act(j, ring, centre, -load * uphill, -load * twist)
    # both surfaces as seen from the contact, which travels with the ball's centre around the X axis
    foot = setup.ball_radius * e
    on_ball = cross(loads.spin(j) - state.balls[j, 5] * EX, foot) @ t
    on_race = on_ball - (loads.velocity(j, centre + foot) - loads.velocity(ring, centre + foot)) @ t
    entrainment = np.hypot(0.5 * (on_ball + on_race), STILL)
    still = setup.slide_to_roll * entrainment + setup.floor
    for place, share in zip(*strip_points(setup.strips), strict=True):
        offset = place * race.half_length * np.sqrt(gap)
        point = centre + foot + offset * m - offset**2 / (2.0 * race.profile) * e
        slip = loads.velocity(j, point) - loads.velocity(ring, point)
        slip -= (slip @ e) * e
        power += loads.act(
            j, ring, point, -setup.friction * share * load * slip / np.sqrt(slip @ slip + still**2)
        )
    turning = (loads.spin(j) - loads.spin(ring)) @ m
    resistance = race.rolling(entrainment, load, race.half_length * np.sqrt(gap))
    power += loads.act(j, ring, centre, np.zeros(3), -resistance * turning / np.hypot(turning, TURNING) * m)
    return -power - elastic * rate


def stretch(setup: Setup, state: State) -> np.ndarray:
    """By how much (m) each chord to the next ball is longer than that of even balls on their circle."""
    radius, theta = setup.pitch + state.balls[:, 1], state.balls[:, 2]
    y, z = radius * np.sin(theta), radius * np.cos(theta)
    chord = np.sqrt((np.roll(y, -1) - y) ** 2 + (np.roll(z, -1) - z) ** 2)
    return chord - 2.0 * np.sin(np.pi / len(theta)) * radius.mean()


def between_balls(loads: Loads) -> float:
    """Load all balls by the springs and dampers that join neighbours; heat (W).

    Forces are the slopes of the stretch over the balls' places, by differences in the complex plane.
    """
    setup, state = loads.setup, loads.state
    count, tiny = len(state.balls), 1e-30
    slopes = np.zeros((count, 2, count))  # ball, radius or angle, spring
    for ball in range(count):
        for kind in range(2):
            moved = state.balls.astype(complex)
            moved[ball, 1 + kind] += 1j * tiny
            slopes[ball, kind] = stretch(setup, replace(state, balls=moved)).imag / tiny
    rates = np.einsum("bks,bk->s", slopes, state.balls[:, 4:6])
    pull = setup.neighbours[0] * stretch(setup, state) + setup.neighbours[1] * rates
    for ball in range(count):
        _, outward, around = directions(state.balls[ball, 2])
        along = slopes[ball] @ pull
        loads.force[ball] -= along[0] * outward + along[1] / (setup.pitch + state.balls[ball, 1]) * around
    return float(setup.neighbours[1] * rates @ rates)


def on_cage(loads: Loads, j: int) -> float:
    """Load ball j and its pocket, whose wall is everywhere as far from its axis or middle; heat (W)."""
    setup, state, pocket = loads.setup, loads.state, loads.setup.pocket
    cage = loads.row(CAGE)
    bore = pocket_axis(state, j)
    offset = in_pocket(setup, state, j)
    apart = np.linalg.norm(offset)
    centre = loads.centre(j)
    sliding = loads.velocity(j, centre) - loads.velocity(cage, centre)
    filmed = sliding if pocket.spherical else sliding - (sliding @ bore) * bore
    power = loads.act(j, cage, centre, -pocket.film * filmed)
    push = apart - pocket.clearance
    if push <= 0.0:
        return -power
    normal = offset / apart
    rate = normal @ sliding
    elastic = pocket.stiffness * push**1.5
    load = max(elastic * (1.0 + pocket.damping * rate), 0.0)
    power += loads.act(j, cage, centre, -load * normal)
    point = centre + setup.ball_radius * normal
    slip = loads.velocity(j, point) - loads.velocity(cage, point)
    slip -= (slip @ normal) * normal
    power += loads.act(j, cage, point, -pocket.friction * load * slip / np.sqrt(slip @ slip + pocket.slip**2))
    return -power - elastic * rate


def film_push(land: Land, journal, velocity, journal_speed: float, sleeve_speed: float) -> np.ndarray:
    """Force (N) in y, z of a short film on the journal, which stands at ``journal`` (y, z) in the sleeve.

    Reynolds, flow only along the axis: d/dz(h^3/(12 eta) dp/dz) = (w1 + w2)/2 dh/dphi + dh/dt = -u out with
    u of the journal's motion; integrated over the length by hand and by quadrature over the half turn about
    u where the pressure is positive.
    """
    along = np.array([journal[1], -journal[0]])
    u = np.asarray(velocity) + 0.5 * (journal_speed + sleeve_speed) * along
    points, weights = legendre.leggauss(400)
    phi = np.arctan2(u[1], u[0]) + 0.5 * np.pi * points
    out = np.array([np.cos(phi), np.sin(phi)])
    pressed = land.viscosity * land.length**3 * (u @ out) / (land.clearance - journal @ out) ** 3
    return -(out * pressed) @ weights * 0.5 * np.pi * land.radius


def on_land(loads: Loads, side: float) -> float:
    """Load ring and cage at one land, the inner one of them as the journal; heat (W)."""
    bodies, rates, land = loads.state.bodies, loads.state.rates, loads.setup.land
    journal, sleeve = (INNER, CAGE) if land.ring == INNER else (CAGE, OUTER)
    inside, around = loads.row(journal), loads.row(sleeve)
    plane = [
        loads.centre(row) + side * land.offset * axis(bodies[k])
        for row, k in ((inside, journal), (around, sleeve))
    ]
    apart = (plane[1] - plane[0]) * [0, 1, 1]
    moving = (loads.velocity(around, plane[1]) - loads.velocity(inside, plane[0])) * [0, 1, 1]
    distance = np.linalg.norm(apart)
    e = apart / distance
    t = cross(EX, e)
    limit = land.fraction * land.clearance
    wet = min(distance, limit)
    whirl = moving @ t / distance
    speeds = rates[journal, 3], rates[sleeve, 3]
    on_journal = film_push(land, -wet * e[1:], -(moving @ e * e + wet * whirl * t)[1:], *speeds)
    film = np.array([0.0, *on_journal])
    gap = land.clearance + wet * np.cos(np.arange(2000) * np.pi / 1000)
    shear = (
        land.viscosity * (speeds[0] - speeds[1]) * land.radius**3 * land.length * np.mean(2.0 * np.pi / gap)
    )
    power = loads.push(inside, plane[0] + apart / 2.0, film, -shear * EX)
    power += loads.push(around, plane[1] - apart / 2.0, -film, shear * EX)
    if distance <= limit:
        return -power
    stop = land.stop * (distance - limit)
    # the bore rubs where it has come down on the journal, on the far side of the offset
    touching = [plane[0] - land.radius * e, plane[1] - (land.radius + distance) * e]
    rub = (loads.velocity(around, touching[1]) - loads.velocity(inside, touching[0])) @ t
    force = -stop * e - land.friction * stop * rub / np.hypot(rub, land.slip) * t
    power += loads.push(inside, touching[0], -force, np.zeros(3))
    power += loads.push(around, touching[1], force, np.zeros(3))
    return -power - stop * (moving @ e)
