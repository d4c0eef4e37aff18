"""Random but physical states of a bearing for the right-hand side, in the engine's layout and the oracle's.

Quasi-static start, then micrometres of approach, slip of a few per cent, tilts, a displaced cage, one ball
lifted off both races and one pressed into its pocket.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from fmu_bearing.compiled import call
from fmu_bearing.engine.choices import GUIDANCES, OUTER_GUIDED
from fmu_bearing.engine.layout import STRIDE, C, F, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions
from tests.engine.helpers import Run, ball_amplitudes
from tests.oracles import cartesian as oracle

LIFTED, TRAPPED = 2, 5
SPEED_RATE = 3e4  # rad/s2, of the inner ring
SCENES = ("7003C-spindle", "7009C-full-ceramic")
ROUNDING = 1e-9  # displacements of 1e-6 m come from radii of 1e-2 m: 1e-12 at best, then powers and sums
BUMPS = 1e-7 * np.array([0.0, 1.0, -0.5, 0.3, 0.0, 0.2, -0.1, 0.1])  # m, orders 1 to 8


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


def guided(scene, guidance):
    """Return the 7003C with another guidance of its cage; on the outer ring with a wider one."""
    changes = {"bearing.cage.guidance": guidance, "bearing.cage.land_clearance_mm": None}
    if guidance == "outer":
        changes |= {"bearing.cage.land_clearance_mm": 0.04, "bearing.cage.outside_diameter_mm": 28.6}
    return scene.replace(changes)


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
        rolling=rolling(p, block, held),
        wave=wave(c[C.OVERSIZE_SCALE] * table) if p[P.WAVINESS] else lambda angle: (0.0, 0.0),
    )


def rolling(p, block, held):
    """Moment against rolling, over the powers that the papers print."""
    powers = {0: (0.66, 0.47), 1: (0.66, 0.47, 0.636, 0.364), 2: (3 / 4, 1 / 3, 2 / 3, 1 / 3)}
    powers = powers[int(p[P.ROLLING_LAW])]

    def moment(entrainment, load, half_length):
        solid = block[P.RACE_HYSTERESIS] * load * half_length
        if not p[P.ROLLING]:
            return solid
        elastic = held[C.ROLLING] * entrainment ** powers[0] * load ** powers[1]
        if len(powers) == 2:
            return solid + elastic
        rigid = held[C.RIGID] * entrainment ** powers[2] * load ** powers[3]
        return solid + elastic + (rigid - elastic) / (1.0 + held[C.REGIME] * load * entrainment**-0.75)

    return moment


def pick(kind, p, prefix, names):
    return kind(**{name: p[getattr(P, prefix + place)] for name, place in names.items()})


def cage_parts(p):
    if not p[P.CAGE]:
        return None, None
    guidance = GUIDANCES[int(p[P.GUIDANCE])]
    pocket = pick(
        oracle.Pocket,
        p,
        "POCKET_",
        {name: name.upper() for name in ("clearance", "stiffness", "damping", "friction", "slip", "film")},
    )
    pocket = replace(pocket, spherical=guidance == "balls")
    names = {name: name.upper() for name in ("radius", "length", "offset", "clearance", "viscosity")}
    stops = {"stop": "STIFFNESS", "fraction": "FRACTION", "friction": "FRICTION", "slip": "SLIP"}
    names |= {name: "STOP_" + place for name, place in stops.items()}
    if not p[P.LAND]:
        return pocket, None
    land = pick(oracle.Land, p, "LAND_", names)
    return pocket, replace(land, ring=oracle.OUTER if guidance == "outer" else oracle.INNER)


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
    held = [0, 1, 2, 4, 5]  # the inner ring's own rotation is prescribed
    springs[0, held, held] = p[P.SUPPORT_STIFFNESS : P.SUPPORT_STIFFNESS + 5]
    dampers[0, held, held] = p[P.SUPPORT_DAMPING : P.SUPPORT_DAMPING + 5]
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
        seals=p[P.SEAL_TORQUE],
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
    ring = Q.OUTER if p[P.GUIDANCE] == OUTER_GUIDED else Q.INNER
    q[11] = q[ring] + afloat
    # without lands in the room of its pockets
    free = p[P.LAND_CLEARANCE] or p[P.POCKET_CLEARANCE]
    q[12:14] = q[ring + 1 : ring + 3] + cage_offset * free * np.array([np.cos(way), np.sin(way)])
    v[:] = 0.01 * rng.uniform(-1, 1, 17)
    v[8] = 2.0
    v[[3, 4, 9, 10, 15, 16]] *= 30
    v[14] = 1.01 * orbit.mean()
    trapped = 2.0 * np.pi * TRAPPED / n + q[14] + 1.15 * room
    trapped += (np.cos(trapped) * q[12] + np.sin(trapped) * q[13]) * -1.0 / p[P.PITCH_RADIUS]
    balls[2, TRAPPED] = (trapped + np.pi) % (2.0 * np.pi) - np.pi
    # it closes in at a few cm/s: much faster apart, and the pocket would have let go
    balls[5, TRAPPED] = v[14] + 0.05 / p[P.PITCH_RADIUS]


def case_of(
    scene,
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
    """A random state of a gate scene; ``parameters`` replace the bearing's own by their names in ``P``."""
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
