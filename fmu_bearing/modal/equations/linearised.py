"""Fidelity `full` linearised about its steady state: constant first-order equations in fixed axes.

The balls' coordinates stand in axes that orbit with them, those of the rings in fixed axes, so the plain
derivatives change as the balls orbit. As patterns round the bearing (1, cos k theta, sin k theta, with theta
the angle in fixed axes: Coleman and Feingold 1958, for rotor blades) the balls stand in fixed axes, too.
Equal ball loads then give constant coefficients, also on a pedestal of two stiffnesses. Under a radial load,
weight or misalignment they repeat with each ball that passes: their mean over one pitch serves, and the
matrices at single phases tell how much is lost.

The state is the steady one (see ``equilibrium``), not an instant of a run. The cage and its films are left
out: it touches balls and lands with clearance, and a linear cage would either not be there or never let go.
Imperfections and sound are left out, too. Weights count as loads where the scene has them.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from fmu_bearing.arrays import Arrays, Refused
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import C, P, Q, S, U, Y
from fmu_bearing.instance import EngineError
from fmu_bearing.modal.equations.coordinates import Coordinates
from fmu_bearing.modal.equations.equilibrium import settle
from fmu_bearing.modal.equations.plain import BearingArrays, Plain
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity

PHASES = 6  # of one ball pitch


@dataclass(frozen=True)
class Linearised:
    """Small motions x of a bearing: x' = A x, in fixed axes.

    Attributes
    ----------
    coordinates : Coordinates
        What the numbers of x are.
    matrix : ndarray
        A (SI units), mean over the phases, shape (n, n).
    phases : ndarray
        A at single phases of one ball pitch, shape (phases, n, n): one where the balls' loads are equal.
    orbit, spin : float
        rad/s: mean speed of the balls' orbit; mean speed of a ball about its axis in orbiting axes.
    speed : float
        rad/s, of the shaft.
    arrays : Arrays
        Parameters, conditions and state at the first phase.
    steady : bool
        Whether the steady state was found; else all holds for the state in which a run starts.
    """

    coordinates: Coordinates
    matrix: NDArray[np.float64]
    phases: NDArray[np.float64]
    orbit: float
    spin: float
    speed: float
    arrays: Arrays | BearingArrays
    steady: bool

    @cached_property
    def equal_loads(self) -> bool:
        """Whether one phase tells all: the balls carry equal loads."""
        return len(self.phases) == 1

    @property
    def on_pedestal(self) -> tuple[float, float]:
        """How far the loads move the outer ring (m), and its pedestal's stiffness (N/m)."""
        place = self.arrays.s[S.Y + Y.Q0 + Q.OUTER :][:3]
        return float(np.linalg.norm(place)), float(self.arrays.u[U.PEDESTAL])


def linearised(scene: Scene, inputs: dict[int, float] | None = None, friction: bool = True) -> Linearised:
    """Linearise a scene's bearing at its operating point.

    Parameters
    ----------
    scene : Scene
        Its cage, imperfections and sound are left out, and its fidelity counts as full.
    inputs : dict, optional
        Values by their places in ``layout.U`` in place of the scene's.
    friction : bool, optional
        False: contacts without traction.

    Raises
    ------
    EngineError
        Where there is no quasi-static equilibrium.
    """
    # whatever a run takes
    full = with_fidelity(scene, model="full")
    bare = full.model_copy(update={"sound": None, "imperfections": None})
    bearing = Arrays.of(bare, CAGE=0.0)
    for place, value in (inputs or {}).items():
        bearing.u[place] = value
    first, steady = _bearing(scene.name, bearing, 0.0, friction)
    even = _even(first)
    count = 1 if even else PHASES
    pitch = 2.0 * math.pi / first.p[P.BALLS]
    bearings = [first]
    for k in range(1, count):
        one, found = _bearing(scene.name, bearing, pitch * k / count, friction)
        bearings.append(one)
        steady = steady and found
    coordinates = Coordinates.of(first.p)
    orbit = float(np.mean([_mean(one, Y.OM) for one in bearings]))
    matrices = np.array(
        [in_fixed_axes(one, coordinates, pitch * k / count, orbit) for k, one in enumerate(bearings)]
    )
    # about its own axis, against the axes that orbit with the ball
    spin = math.hypot(_mean(first, Y.WX) - orbit, _mean(first, Y.WR))
    speed = float(first.u[U.SPEED])
    return Linearised(coordinates, matrices.mean(axis=0), matrices, orbit, spin, speed, first, steady)


def under_force(scene: Scene, inputs: dict[int, float] | None = None) -> Linearised:
    """Linearise as `linearised`; with rigid preload under the force which its place means.

    A ring that is held would have no row.
    """
    system = linearised(scene, inputs)
    if not system.coordinates.held:
        return system
    state = system.arrays.s
    force = float(state[S.Y + Y.Q0 + Q.OUTER] * state[S.C + C.PEDESTAL_AXIAL])
    return linearised(scene.replace({"mounting.preload_mode": "force"}), {**(inputs or {}), U.PRELOAD: force})


def _bearing(name: str, given: Arrays, phase: float, friction: bool) -> tuple[Arrays, bool]:
    """Return a bearing with the balls turned on by ``phase`` (rad), and whether its state is steady.

    Its axes turn with the balls: the first one stays at 12 o'clock, loads and seats turn back. ``given``: the
    bearing without cage, nothing turned, with its inputs; ``name``: of its scene.
    """
    turned: dict[str, float] = {"GRAVITY": 0.0} | _turned_seat(given.p, phase)
    if not friction:
        turned |= {"MU": 0.0}
    bearing = given.with_parameters(**turned)
    weight = GRAVITY * given.p[P.INNER_MASS] if given.p[P.GRAVITY] else 0.0
    load = _turn_back(bearing.u[U.LOAD_Y], bearing.u[U.LOAD_Z] - weight, phase)
    bearing.u[U.LOAD_Y], bearing.u[U.LOAD_Z] = load
    try:
        bearing.init()
    except Refused as refusal:
        raise EngineError(f"{name}: {refusal}") from None
    # without friction nothing says how fast balls spin
    return bearing, settle(bearing) if friction else True


def _turn_back(y: float, z: float, phase: float) -> tuple[float, float]:
    c, s = math.cos(phase), math.sin(phase)
    return c * y + s * z, c * z - s * y


def _turned_seat(p: NDArray[np.float64], phase: float) -> dict[str, float]:
    """Return the parameters of the seat of the outer ring in axes turned by ``phase`` (rad)."""
    found = dict(
        zip(
            ("MISALIGNMENT_Y", "MISALIGNMENT_Z"),
            _turn_back(p[P.MISALIGNMENT_Y], p[P.MISALIGNMENT_Z], phase),
            strict=True,
        )
    )
    c, s = math.cos(phase), math.sin(phase)
    turn = np.array([[c, s], [-s, c]])
    for name in ("PEDESTAL", "PEDESTAL_DAMPING"):
        y, z, between = (p[getattr(P, f"{name}_{axes}")] for axes in ("Y", "Z", "YZ"))
        tensor = turn @ np.array([[y, between], [between, z]]) @ turn.T
        found[f"{name}_Y"], found[f"{name}_Z"] = float(tensor[0, 0]), float(tensor[1, 1])
        found[f"{name}_YZ"] = float(tensor[0, 1])
    return found


def _even(bearing: Arrays) -> bool:
    """Whether nothing tells one ball from another."""
    u, p = bearing.u, bearing.p
    return not (u[U.LOAD_Y] or u[U.LOAD_Z] or p[P.MISALIGNMENT_Y] or p[P.MISALIGNMENT_Z])


def _mean(bearing: Arrays, row: int) -> float:
    first = S.Y + row
    return float(np.mean(bearing.s[first : first + int(bearing.p[P.BALLS])]))


def in_fixed_axes(
    bearing: Arrays | BearingArrays, at: Coordinates, phase: float, orbit: float
) -> NDArray[np.float64]:
    """Return A in fixed axes, from the derivatives in axes that are turned by ``phase`` against them.

    ``orbit``: rad/s of the balls.
    """
    plain = Plain(bearing, at).derivatives()
    angles = 2.0 * math.pi * np.arange(at.balls) / at.balls + phase
    patterns, rates = at.patterns(angles)
    back = np.linalg.inv(patterns)
    turning = block_diag(*[back @ rates * orbit] * at.BALL_STATES)
    rings = at.turned(phase)
    balls = block_diag(*[patterns] * at.BALL_STATES)
    into = block_diag(balls, rings)
    found = np.linalg.solve(into, plain @ into)
    found[: at.rings, : at.rings] -= turning
    return np.asarray(found)
