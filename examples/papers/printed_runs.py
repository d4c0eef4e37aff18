"""Runs of :mod:`examples.papers.printed_equations` on a paper's bare bearing, and what is read from them.

Runs are of even balls under an axial load: one ball represents twelve, rings move along the axis, the cage
turns. Growth rates are of all twelve balls, rings and cage about the corrected steady state.
"""

import functools
import math
import pathlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

from examples.papers.printed_equations import Corrections, Equations
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
    WX,
    Array,
    Bearing,
    R,
    X,
)
from fmu_bearing import operating_point
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import STRIDE, C, S, Y
from fmu_bearing.scene import Scene, scene_of

SCENES = pathlib.Path(__file__).parents[1] / "scenes"
TURNS = 2.0  # of the shaft: how long a reading runs that has no steady state
SETTLED = 0.03  # s: the cage's slowest decay against its balls, m_c / 12 c, takes 6.5 ms
#: Where a run ends: m, rad, and rates over shaft speed.
FAR, ASKEW, RACING, SPINNING = 1e-3, 1e-2, 3.0, 1e3


@dataclass(frozen=True)
class Printed:
    """Equations of a paper, and the bearing that they are run on.

    Attributes
    ----------
    scene : str
        File name in ``examples/scenes``, without its suffix.
    system : type
        `Equations` or one that reads a paper's rows in another way.
    corrections : type
        `Corrections` or one with that paper's faults.
    changes : tuple of (str, value)
        Keys of the scene, dotted, with other values than the file's.
    """

    scene: str = "7003C-bare"
    system: type[Equations] = Equations
    corrections: type[Corrections] = Corrections
    changes: tuple[tuple[str, Any], ...] = ()


MULTI_SOURCE = Printed()


def scene_at(rpm: float, paper: Printed = MULTI_SOURCE) -> Scene:
    """Return the paper's bearing at a speed, perfect, with a balanced cage and rigid rings."""
    scene = scene_of(SCENES / f"{paper.scene}.toml").replace(dict(paper.changes)).with_rigid_rings()
    cage = scene.bearing.cage
    assert cage is not None
    bearing = scene.bearing.model_copy(update={"cage": cage.model_copy(update={"mass_eccentricity_um": 0.0})})
    operation = scene.operation.model_copy(update={"speed_rpm": float(rpm)})
    return scene.model_copy(
        update={"bearing": bearing, "operation": operation, "imperfections": None, "sound": None}
    )


@functools.lru_cache(maxsize=8)
def _prepared(rpm: float, paper: Printed) -> tuple[Bearing, Array]:
    """Return the numbers of the scene at a speed, and the product's steady state in this layout (size, 1)."""
    product = Arrays.of(scene_at(rpm, paper))
    product.init()
    y = product.s[S.Y : S.Y + Y.SIZE]
    bearing = Bearing(product.p.copy(), product.s[S.C : S.C + C.SIZE].copy())
    count = int(bearing.balls)
    rows = y[: Y.ROWS * STRIDE].reshape(Y.ROWS, STRIDE)[:, :count].copy()
    bodies = y[Y.Q0 :]
    ahead = rows[LAG] - bodies[FIRST[CAGE] + 3] - 2.0 * math.pi / count * np.arange(count)
    rows[LAG] = (ahead + math.pi) % (2.0 * math.pi) - math.pi
    return bearing, np.concatenate([rows.ravel(), bodies])[:, None]


def bearing_at(rpm: float, paper: Printed = MULTI_SOURCE) -> Bearing:
    """Geometry, contacts, masses and oil of the scene at a speed, as the package prepares them."""
    return _prepared(rpm, paper)[0]


def equations(
    rpm: float, corrections: Corrections, even: bool = True, paper: Printed = MULTI_SOURCE
) -> Equations:
    """Return the equations of the scene at a speed."""
    return paper.system(bearing_at(rpm, paper), rpm * RPM, corrections, even)


def start(system: Equations) -> Array:
    """State of even balls at rest under the preload, rolling: where all runs start, shape (size,).

    Static balance without centrifugal force; orbit and spin roll without sliding about the line of contact.
    """
    b = system.bearing
    races = [getattr(b.races, key).ravel() for key in ("groove_x", "groove_radius", "free", "stiffness")]
    groove_x, groove_r, free, stiffness = races
    outer = b.preload / b.pedestal_axial

    def apart(unknown: Array) -> tuple[Array, Array]:
        x, r, inner = 1e-5 * unknown
        return x - np.array([inner, outer]) - groove_x, b.pitch_radius + r - groove_r

    def balance(unknown: Array) -> list[float]:
        x, r = apart(unknown)
        distance = np.hypot(x, r)
        pull = stiffness * np.maximum(distance - free, 0.0) ** 1.5 / distance
        return [(pull * x).sum(), (pull * r).sum(), b.preload + b.balls * pull[INNER] * x[INNER]]

    found = root(balance, [0.5, 0.0, 2.0])
    if not found.success:
        raise ArithmeticError(f"no static balance: {found.message}")
    x, r = apart(found.x)
    angle = math.atan2(x[OUTER], r[OUTER])
    c, s = math.cos(angle), math.sin(angle)
    orbit = 0.5 * system.speed * (1.0 - b.ball_radius * c / b.pitch_radius)
    roll = orbit * (b.pitch_radius + b.ball_radius * c) / b.ball_radius
    state = np.zeros(system.size)
    balls, places, rates = system.split(state[:, None])
    balls[X], balls[R], balls[OM] = 1e-5 * found.x[0], 1e-5 * found.x[1], orbit
    balls[WX], balls[WR] = orbit - roll * c, roll * s
    places[FIRST[INNER]], places[FIRST[OUTER]] = 1e-5 * found.x[2], outer
    rates[FIRST[CAGE] + 3] = orbit
    return state


def sizes(system: Equations) -> Array:
    """Change of each state that hardly counts: m, rad, m/s, rad/s; shape (size,)."""
    found = np.zeros(system.size)
    balls, places, rates = system.split(found[:, None])
    balls[: R + 1], balls[LAG], balls[VX : VR + 1], balls[OM], balls[WX:] = 1e-10, 1e-7, 1e-5, 1e-2, 1e-1
    places[:], rates[:] = 1e-10, 1e-5
    turns = [3, 4, 8, 9, 10, 15, 16]
    places[turns], rates[turns] = 1e-8, 1e-3
    places[14], rates[14] = 1e-3, 1e-2
    return found


@dataclass(frozen=True)
class Run:
    """A run: its last state (size,), its length (s), what ended it early, largest ring velocity (m/s).

    The velocity is the larger of both rings' along the axis, over the second half of the run.
    """

    state: Array
    seconds: float
    ended: str
    ring_velocity: float


def excess(system: Equations, state: Array) -> dict[str, float]:
    """How far a state of shape (size,) is past the bounds of a bearing: 1 is at a bound."""
    balls, places, rates = system.split(state[:, None])
    speed = system.speed
    return {
        "the outer ring has left by 1 mm": float(np.abs(places[5:8]).max()) / FAR,
        "the inner ring has left by 1 mm": float(np.abs(places[:3]).max()) / FAR,
        "the inner ring is tilted by 10 mrad": float(np.abs(places[3:5]).max()) / ASKEW,
        "the cage turns at three times shaft speed": float(np.abs(rates[14]).max()) / (RACING * speed),
        "the balls spin at a thousand times shaft speed": float(np.abs(balls[WX:]).max())
        / (SPINNING * speed),
    }


def run(system: Equations, state: Array, seconds: float, relative: float = 1e-4) -> Run:
    """Integrate by BDF, until something has left the bearing at the latest."""

    def past(time: float, now: Array) -> float:
        return 1.0 - max(excess(system, now).values())

    past.terminal = True  # type: ignore[attr-defined]
    with np.errstate(all="ignore"):
        found = solve_ivp(
            system, (0.0, seconds), state, method="BDF", vectorized=True, events=past, rtol=relative,
            atol=sizes(system),
        )  # fmt: skip
    last = found.y[:, -1]
    ended = "" if found.status == 0 else max(excess(system, last).items(), key=lambda one: one[1])[0]
    if found.status < 0:
        ended = f"the integration fails: {found.message}"
    half = found.t >= 0.5 * found.t[-1]
    _, _, rates = system.split(found.y[:, half])
    velocity = np.abs(rates[[FIRST[INNER], FIRST[OUTER]]]).max()
    return Run(last, float(found.t[-1]), ended, float(velocity))


@functools.lru_cache(maxsize=8)
def settled(rpm: float, paper: Printed = MULTI_SOURCE) -> Run:
    """Steady state of the corrected equations at a speed: even balls after :data:`SETTLED`."""
    system = equations(rpm, paper.corrections.all(), paper=paper)
    return run(system, start(system), SETTLED, 1e-5)


def all_round(system: Equations, state: Array) -> Array:
    """State of all balls from one of even balls, shape (size,)."""
    one = type(system)(system.bearing, system.speed, system.on, True)
    found = np.empty(system.size)
    for whole, part in zip(system.split(found[:, None]), one.split(state[:, None]), strict=True):
        whole[:] = part
    return found


def growth(rpm: float, corrections: Corrections, paper: Printed = MULTI_SOURCE) -> tuple[float, float]:
    """Growth rate (1/s) and frequency (Hz) of what grows fastest about the corrected steady state.

    All balls, rings and cage at one position, without weights; 0 where nothing grows by 1 per second.
    """
    system = equations(rpm, corrections, even=False, paper=paper)
    system.weight = 0.0
    state = all_round(system, settled(rpm, paper).state)
    step = sizes(system)
    ahead, behind = (system(0.0, state[:, None] + sign * np.diag(step)) for sign in (1.0, -1.0))
    values = np.linalg.eigvals((ahead - behind) / (2.0 * step))
    fastest = values[np.argmax(values.real)]
    if fastest.real < 1.0:
        return 0.0, 0.0
    return float(fastest.real), float(abs(fastest.imag) / (2.0 * math.pi))


def figures(system: Equations, state: Array) -> dict[str, Any]:
    """Means over the balls of a state (size,): loads (N), angles (deg), speed ratios, spin, sliding (m/s).

    ``spin`` is seen from the orbit (rad/s), ``pitch`` its angle from -X towards the outside (deg),
    ``sideways`` its part about the direction of motion (rad/s). Lists are of inner and outer race.
    """
    balls, _, rates = system.split(state[:, None])
    _, touching = system.contacts(state[:, None])
    spin = balls[WX:].mean(axis=(1, 2))
    spin[0] -= balls[OM].mean()

    def both(values: Array) -> list[float]:
        return [float(value) for value in values.mean(axis=(1, 2))]

    return {
        "load": both(touching.load),
        "angle": both(np.degrees(touching.angle)),
        "orbit": float(balls[OM].mean()) / system.speed,
        "cage": float(rates[14, 0]) / system.speed,
        "spin": float(np.sqrt(spin @ spin)),
        "pitch": math.degrees(math.atan2(spin[1], -spin[0])),
        "sideways": float(spin[2]),
        "slide_along": both(touching.slide_along),
        "slide_across": both(touching.slide_across),
        "traction": both(np.hypot(touching.along, touching.across) / np.maximum(touching.load, 1e-12)),
    }


def of_run(system: Equations, found: Run) -> dict[str, Any]:
    """Figures of a run's end with its length, its end and the rings' velocity."""
    return figures(system, found.state) | {
        "seconds": found.seconds, "ended": found.ended, "ring_velocity": found.ring_velocity,
    }  # fmt: skip


def ours(rpm: float, paper: Printed = MULTI_SOURCE) -> dict[str, Any]:
    """Figures of the product: loads and angles of its operating point, motion of the state it starts in."""
    bearing, state = _prepared(rpm, paper)
    found = figures(paper.system(bearing, rpm * RPM, paper.corrections.all()), state[:, 0])
    load = operating_point(scene_at(rpm, paper)).bearings[0].load
    found["load"] = [float(value) for value in load.ball_loads.mean(axis=1)]
    found["angle"] = [float(value) for value in np.degrees(load.contact_angles.mean(axis=1))]
    # a steady state: its rings are at rest
    return found | {"seconds": 0.0, "ended": "", "ring_velocity": 0.0}


def reading(
    rpm: float, corrections: Corrections, turns: float = TURNS, paper: Printed = MULTI_SOURCE
) -> dict[str, Any]:
    """Figures of even balls after some turns of the shaft, from :func:`start`."""
    system = equations(rpm, corrections, paper=paper)
    return of_run(system, run(system, start(system), turns * 60.0 / rpm))
