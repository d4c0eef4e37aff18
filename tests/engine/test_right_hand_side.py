"""The right-hand side against plain inertial vectors, and against momentum and energy.

States are random but physical: quasi-static start, then micrometres of approach, slip of a few per cent,
tilts, a displaced cage, one ball lifted off both races and one pressed into its pocket.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import STRIDE, C, F, P, S, U, W, Y
from fmu_bearing.engine.mechanics.cage import film_force
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.engine.readout.losses import summarise
from tests.engine.helpers import Run, ball_amplitudes
from tests.oracles import cartesian as oracle

LIFTED, TRAPPED = 2, 5
SPEED_RATE = 3e4  # rad/s2, of the inner ring
SCENES = ("7003C-spindle", "7009C-full-ceramic")
ROUNDING = 1e-9  # displacements of 1e-6 m come from radii of 1e-2 m: 1e-12 at best, then powers and sums


@dataclass
class Case:
    """One state in the engine's layout and in the oracle's."""

    p: np.ndarray
    c: np.ndarray
    y: np.ndarray
    angle: float
    speed: float
    setup: oracle.Setup
    w: np.ndarray

    @property
    def n(self):
        return int(self.p[P.BALLS])

    @property
    def state(self):
        rows = self.y[: 9 * STRIDE].reshape(9, STRIDE)[:, : self.n]
        q, v = self.y[Y.Q0 : Y.V0], self.y[Y.V0 :]
        bodies = np.array([[*q[:3], self.angle, *q[3:5]], q[5:11], q[11:]])
        rates = np.array([[*v[:3], self.speed, *v[3:5]], v[5:11], v[11:]])
        axes = None
        if self.p[P.BALL_WAVES]:
            own = self.w[W.AXES :][: 3 * STRIDE].reshape(3, STRIDE)
            axes = np.array([np.array(oracle.directions(rows[2, j])).T @ own[:, j] for j in range(self.n)])
        return oracle.State(rows.T.copy(), bodies, rates, axes)

    def engine(self):
        """The engine's answer, in the oracle's shapes."""
        f = np.zeros(F.SIZE)
        call("right_hand_side", self.p, self.c, self.y, self.w, f, self.angle, self.speed, SPEED_RATE)
        g = f[F.BODY : F.WORK]
        return oracle.Answer(
            f[: 6 * STRIDE].reshape(6, STRIDE)[:, : self.n].T,
            np.array([[*g[:3], 0.0, *g[3:5]], g[5:11], g[11:]]),
            f[F.TORQUE],
            f[F.HEAT : F.HEAT + 3],
            f[F.WORK],
        )

    def oracle(self):
        return oracle.equations(self.setup, self.state, SPEED_RATE)


def spline(table):
    """Race height and slope by SciPy's Hermite spline over the engine's table."""
    count = table.size // 2
    grid = 2.0 * np.pi * np.arange(count + 1) / count
    curve = CubicHermiteSpline(grid, [*table[0::2], table[0]], np.array([*table[1::2], table[1]]) / grid[1])
    slope = curve.derivative()
    return lambda angle: (curve(angle % (2.0 * np.pi)), slope(angle % (2.0 * np.pi)))


def harmonics(table):
    """Race height and slope as the harmonic sum of which the table holds the values."""
    lines = np.fft.rfft(table[0::2])[:64] / (table.size // 2)
    lines[1:] *= 2.0
    orders = np.arange(64)

    def wave(angle):
        turning = lines * np.exp(1j * orders * angle)
        return turning.real.sum(), (1j * orders * turning).real.sum()

    return wave


def race(p, c, k, wave):
    block = p[P.RACES + k * P.RACE_SIZE :]
    held = c[C.RACES + k * C.RACE_SIZE :]
    count = int(p[P.WAVE_INTERVALS])
    table = p[int(p[P.AT_WAVES]) + 2 * k * count :][: 2 * count]
    return oracle.Race(
        x=held[0],
        circle=held[1],
        free=held[2],
        stiffness=block[P.RACE_STIFFNESS],
        half_length=block[P.RACE_HALF_LENGTH],
        profile=block[P.RACE_PROFILE_RADIUS],
        rolling=held[3] if p[P.ROLLING] else 0.0,
        wave=wave(c[C.OVERSIZE_SCALE] * table) if p[P.WAVINESS] else lambda angle: (0.0, 0.0),
    )


def pick(kind, p, prefix, names):
    return kind(**{name: p[getattr(P, prefix + place)] for name, place in names.items()})


def cage_parts(p):
    if not p[P.CAGE]:
        return None, None
    pocket = pick(
        oracle.Pocket,
        p,
        "POCKET_",
        {name: name.upper() for name in ("clearance", "stiffness", "damping", "friction", "slip", "film")},
    )
    names = {name: name.upper() for name in ("radius", "length", "offset", "clearance", "viscosity")}
    stops = {"stop": "STIFFNESS", "fraction": "FRACTION", "friction": "FRICTION", "slip": "SLIP"}
    names |= {name: "STOP_" + place for name, place in stops.items()}
    return pocket, pick(oracle.Land, p, "LAND_", names) if p[P.LAND] else None


def setup(p, c, mounting, wave=spline):
    pocket, land = cage_parts(p)
    first = int(p[P.AT_OVERSIZE])
    masses = [
        pick(oracle.Mass, p, f"{body}_", {"mass": "MASS", "transverse": "TRANSVERSE", "polar": "POLAR"})
        for body in ("INNER", "OUTER", "CAGE")
    ]
    springs, dampers, load = np.zeros((3, 6, 6)), np.zeros((3, 6, 6)), np.zeros((3, 3))
    rest = np.zeros((3, 6))
    rest[1, 4:] = p[P.MISALIGNMENT_Y], p[P.MISALIGNMENT_Z]
    np.fill_diagonal(springs[0, 4:, 4:], p[P.TILT_STIFFNESS])
    np.fill_diagonal(dampers[0, 4:, 4:], p[P.TILT_DAMPING])
    turn = c[C.PEDESTAL_ROTATIONAL]
    springs[1] = np.diag([c[C.PEDESTAL_AXIAL], 0.0, 0.0, turn, turn, turn])
    turn = c[C.DAMPING_ROTATIONAL]
    dampers[1] = np.diag([c[C.DAMPING_AXIAL], 0.0, 0.0, c[C.DAMPING_SPIN], turn, turn])
    ratio, angle = mounting.pedestal_stiffness_ratio, np.radians(mounting.pedestal_axis_angle_deg)
    along = np.array([ratio * c[C.PEDESTAL], c[C.PEDESTAL]])
    springs[1, 1:3, 1:3] = oracle.turned_axes(*along, angle)
    dampers[1, 1:3, 1:3] = oracle.turned_axes(
        *(2.0 * p[P.PEDESTAL_ZETA] * np.sqrt(along * p[P.OUTER_MASS])), angle
    )
    load[0] = c[C.PRELOAD], c[C.LOAD_Y], c[C.LOAD_Z]
    return oracle.Setup(
        pitch=p[P.PITCH_RADIUS],
        ball_radius=c[C.BALL_RADIUS],
        ball_mass=p[P.BALL_MASS],
        ball_inertia=p[P.BALL_INERTIA],
        oversize=c[C.OVERSIZE_SCALE] * p[first : first + int(p[P.BALLS])],
        races=tuple(race(p, c, k, wave) for k in range(2)),
        damping=p[P.CONTACT_DAMPING],
        friction=p[P.MU],
        slide_to_roll=p[P.SLIDE_TO_ROLL],
        floor=p[P.TRACTION_FLOOR],
        strips=int(p[P.STRIPS]),
        drag=p[P.DRAG_FACTOR] if p[P.DRAG] else 0.0,
        gravity=bool(p[P.GRAVITY]),
        gyroscopic=bool(p[P.GYROSCOPIC]),
        masses=tuple(masses),
        springs=springs,
        dampers=dampers,
        eccentricity=c[C.ECCENTRICITY],
        cage_eccentricity=c[C.CAGE_ECCENTRICITY],
        load=load,
        pocket=pocket,
        land=land,
        rest=rest,
        bumps=c[C.OVERSIZE_SCALE] * ball_amplitudes(p) if p[P.BALL_WAVES] else None,
        neighbours=(p[P.SPRINGS], p[P.SPRING_DAMPING]) if p[P.SPRINGS] and not p[P.CAGE] else None,
    )


def shake(y, run, rng, tilt, cage_offset, afloat):
    """Displace everything about the quasi-static state ``y``; the balls' oil film scale is 1e-6 m."""
    p, n, size = run.p, int(run.p[P.BALLS]), STRIDE
    balls = y[: 9 * size].reshape(9, size)[:, :n]
    spread = rng.uniform(-1.0, 1.0, (9, n))
    orbit, spin = balls[Y.OM // STRIDE].copy(), np.hypot(balls[Y.WX // STRIDE], balls[Y.WR // STRIDE])
    balls[0] += 1e-6 * spread[0]
    balls[1] += 0.5e-6 * spread[1]
    balls[2] += 0.7 + 2e-3 * spread[2]
    balls[3:5] = 0.02 * spread[3:5]
    balls[5] += 0.02 * orbit * spread[5]
    balls[6:] += 0.03 * spin * spread[6:]
    balls[1, LIFTED] -= 3e-6
    balls[0, LIFTED] -= 6e-6
    balls[2] = (balls[2] + np.pi) % (2.0 * np.pi) - np.pi
    q, v = y[Y.Q0 : Y.V0], y[Y.V0 :]
    q[:3] += 0.5e-6 * rng.uniform(-1, 1, 3)
    q[5:8] += 0.5e-6 * rng.uniform(-1, 1, 3)
    for tilts in (q[3:5], q[9:11], q[15:17]):
        tilts[:] = tilt * rng.uniform(-1, 1, 2)
    q[8] = 1e-5
    # cage: behind its balls by less than the pocket's clearance but for one ball, off its land's middle
    room = p[P.POCKET_CLEARANCE] / p[P.PITCH_RADIUS]
    q[14] = 0.7 - 0.3 * room
    way = rng.uniform(0, 2 * np.pi)
    q[11] = q[0] + afloat
    q[12:14] = q[1:3] + cage_offset * p[P.LAND_CLEARANCE] * np.array([np.cos(way), np.sin(way)])
    v[:] = 0.01 * rng.uniform(-1, 1, 17)
    v[8] = 2.0
    v[[3, 4, 9, 10, 15, 16]] *= 30
    v[14] = 1.01 * orbit.mean()
    trapped = 2.0 * np.pi * TRAPPED / n + q[14] + 1.15 * room
    trapped += (np.cos(trapped) * q[12] + np.sin(trapped) * q[13]) * -1.0 / p[P.PITCH_RADIUS]
    balls[2, TRAPPED] = (trapped + np.pi) % (2.0 * np.pi) - np.pi
    # it closes in at a few cm/s: much faster apart, and the pocket would have let go
    balls[5, TRAPPED] = v[14] + 0.05 / p[P.PITCH_RADIUS]


@pytest.fixture
def case(scene):
    def make(
        name,
        seed=1,
        rpm=20000,
        tilt=1e-4,
        cage_offset=0.5,
        afloat=8e-6,
        wave=spline,
        pedestal=None,
        **parameters,
    ):
        one = scene(name)
        one = one.model_copy(update={"mounting": one.mounting.model_copy(update=pedestal or {})})
        run = Run(one, rpm, **parameters).init()
        rng = np.random.default_rng(seed)
        run.u[U.LOAD_Y], run.u[U.LOAD_Z], run.u[U.OIL_T] = 70.0, -40.0, 310.0
        run.u[U.INNER_T], run.u[U.OUTER_T] = 296.0, 294.0
        c = np.zeros(C.SIZE)
        conditions(run.p, run.u, run.u[U.SPEED], c)
        y = run.s[S.Y : S.Y + Y.SIZE].copy()
        shake(y, run, rng, tilt, cage_offset, afloat)
        rows = y[: 9 * STRIDE].reshape(9, STRIDE)
        rows[:, int(run.p[P.BALLS]) :] = rows[:, :1]
        angle = rng.uniform(-np.pi, np.pi)
        return Case(run.p, c, y, angle, run.u[U.SPEED], setup(run.p, c, one.mounting, wave), run.w)

    return make


def off(found, wanted, share=None):
    """Largest difference over the largest value (of ``share``, where given) of each column."""
    found, wanted = np.atleast_2d(found), np.atleast_2d(wanted)
    scale = np.abs(wanted if share is None else share).max(axis=0)
    return (np.abs(found - wanted).max(axis=0) / np.where(scale == 0.0, 1.0, scale)).max()


def agree(case, tolerance, landed=None):
    """Every number of the right-hand side against the oracle; ``landed``: tolerance where the land enters."""
    landed = tolerance if landed is None else landed
    found, wanted = case.engine(), case.oracle()
    assert off(found.balls, wanted.balls) <= tolerance
    for body, gate in enumerate((landed, tolerance, landed)):
        # numbers of one kind: axial, radial, spin, tilt
        for kind in ([0], [1, 2], [3], [4, 5]):
            assert off(found.bodies[body, kind, None], wanted.bodies[body, kind, None]) <= gate
    assert found.torque == pytest.approx(wanted.torque, rel=landed)
    assert found.work == pytest.approx(wanted.work, rel=landed)
    assert found.heats[:2] == pytest.approx(wanted.heats[:2], rel=tolerance)
    assert found.heats[2] == pytest.approx(wanted.heats[2], rel=landed)


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


def test_waviness_table_holds_the_harmonics(case):
    """Hermite interpolation over 2048 intervals: slope of order 20 to (2 pi 20/2048)^3/100 = 2e-6."""
    agree(case(SCENES[0], LAND=0.0, wave=harmonics), 3e-6)


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


@pytest.mark.parametrize("cage_offset", [0.5, 1.02])
@pytest.mark.parametrize("tilt", [0.0, 1e-3])
def test_linear_momentum(case, tilt, cage_offset):
    """What bodies and balls do to each other cancels: only outside forces change the momentum."""
    one = case(SCENES[0], tilt=tilt, cage_offset=cage_offset)
    rate, outside, _ = pulls(one, one.engine())
    assert off(rate.sum(0), outside.sum(0), rate) <= 1e-12


@pytest.mark.parametrize("cage_offset", [0.5, 1.02])
@pytest.mark.parametrize("eccentricity", [0.0, 1e-3])
def test_angular_momentum(case, cage_offset, eccentricity):
    """Moments about the origin, with the drive's torque; without tilt and without axial float of the cage.

    About X alone where the cage has a heavy spot, whose axial motion is left out.
    """
    one = case(SCENES[0], tilt=0.0, cage_offset=cage_offset, afloat=0.0, CAGE_ECCENTRICITY=eccentricity)
    setup, state, found = one.setup, one.state, one.engine()
    rate, outside, centre = pulls(one, found)
    turning, given = np.cross(centre, rate), np.cross(centre, outside)
    for j, (ball, a) in enumerate(zip(state.balls, found.balls, strict=True)):
        spin = a[3:] + np.cross([ball[5], 0.0, 0.0], ball[6:])
        turning[j] += setup.ball_inertia * (spin @ np.array(oracle.directions(ball[2])))
    for k, mass in enumerate(setup.masses):
        spin, tilting = state.rates[k, 3], state.rates[k, 4:]
        gyroscopic = mass.polar * spin * np.array([tilting[1], -tilting[0]])
        turning[one.n + k, 0] += mass.polar * found.bodies[k, 3]
        turning[one.n + k, 1:] += mass.transverse * found.bodies[k, 4:] + gyroscopic
        given[one.n + k] -= (setup.springs[k] @ state.bodies[k] + setup.dampers[k] @ state.rates[k])[3:]
    given[one.n, 0] += found.torque
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
        (rolling, {"races": tuple(replace(race, rolling=0.0) for race in one.setup.races)}),
        (cage, {"pocket": None, "land": None}),
        (drag, {"drag": 0.0}),
    ):
        less = oracle.equations(replace(one.setup, **change), one.state, SPEED_RATE).heats.sum()
        assert lost == pytest.approx(one.oracle().heats.sum() - less, rel=1e-6)


BUMPS = 1e-7 * np.array([0.0, 1.0, -0.5, 0.3, 0.0, 0.2, -0.1, 0.1])  # m, orders 1 to 8


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


@pytest.mark.parametrize(("tilt", "gate"), [(0.0, 1e-12), (1e-5, 1e-9), (1e-4, 1e-8)])
def test_power_balance_of_wavy_balls(case, tilt, gate):
    one = case(SCENES[0], tilt=tilt, ball_waves=BUMPS)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= gate * found.work


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


HEAVY = 1e-3  # m: two hundred times the default, so that what it does stands out


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


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("cage_offset", [0.5, 1.02])
@pytest.mark.parametrize(("tilt", "gate"), [(0.0, 1e-12), (1e-5, 1e-9), (1e-4, 1e-8), (1e-3, 1e-6)])
def test_power_balance(case, name, cage_offset, tilt, gate):
    """Work less heat is the rate of the stored energy along the engine's accelerations.

    Small-tilt equations leave a rest that grows with the tilt squared.
    """
    one = case(name, tilt=tilt, cage_offset=cage_offset)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= gate * found.work


def test_stored_energy(case):
    one = case(SCENES[0], cage_offset=1.02)
    one.engine()
    energy = stored_energy(one.p, one.c, one.y, one.w)
    assert energy == pytest.approx(oracle.stored_energy(one.setup, one.state), rel=1e-12)
