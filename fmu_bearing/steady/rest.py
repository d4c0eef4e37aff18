"""Where a scene's bearings are in their steady state: the engine started at the operating point, and read.

The state in which runs of fidelity full start: perfect bearings with rigid rings, without sound. Values are
in the axes of the shaft, values of a part in its bearing's own axes.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import GRAVITY, REFERENCE_TEMPERATURE
from fmu_bearing.engine.layout import SP, C, P, Q, S, U, Y
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.lengths import parts_of
from fmu_bearing.prepare.model import prepare
from fmu_bearing.progress import Tell, silent
from fmu_bearing.results.balls import Reader
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import still_of

_MOTIONS = ("displacement.x", "displacement.y", "displacement.z", "tilt.y", "tilt.z")
#: Shares of speed and of the temperatures' rise in the states of `preloads`.
_STATES = {"cold": (0.0, 0.0), "warm": (0.0, 1.0), "running": (1.0, 1.0)}
TOUCHING = 0.01  # N: balls and races just touch
#: Rows of an outer ring's six without its rotation.
OUTER_PLANE = [Q.X, Q.Y, Q.Z, Q.BY, Q.BZ]


@dataclass(frozen=True)
class Part:
    """Parameters ``p`` and state ``s`` of one bearing, as of a single one."""

    p: NDArray[np.float64]
    s: NDArray[np.float64]

    @property
    def apart(self) -> NDArray[np.float64]:
        """Place of the inner ring against the outer one (m, rad), in the bearing's own axes, shape (5,)."""
        y = self.s[S.Y : S.Y + Y.SIZE]
        return np.asarray(y[Y.Q0 : Y.Q0 + Q.OUTER] - y[Y.Q0 + Q.OUTER : Y.Q0 + Q.CAGE][OUTER_PLANE])

    def balls(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Return loads (N), contact angles (rad) and pressures (Pa), each of shape (2, balls)."""
        reader = Reader(self)
        return reader.loads(self), reader.angles(self), reader.pressures(self)


def pedestal(state: NDArray[np.float64]) -> NDArray[np.float64]:
    """Stiffness under an outer ring along x y z and against tilts (N/m, N m/rad), shape (5, 5).

    ``state``: of its bearing.
    """
    c = state[S.C : S.C + C.SIZE]
    tilts = [c[C.PEDESTAL_ROTATIONAL]] * 2
    stiffness = np.diag([c[C.PEDESTAL_AXIAL], c[C.PEDESTAL_Y], c[C.PEDESTAL_Z], *tilts])
    stiffness[Q.Y, Q.Z] = stiffness[Q.Z, Q.Y] = c[C.PEDESTAL_YZ]
    return stiffness


def started(
    scene: Scene, inputs: Mapping[int, float] | None = None, tell: Tell = silent, fidelity: str = "full"
) -> Instance:  # fmt: skip
    """Return the engine started at a scene's operating point.

    Parameters
    ----------
    scene : Scene
    inputs : mapping, optional
        Values by their places in ``u`` in place of the scene's, SI units.
    tell : callable
        Takes the warnings of the bearings.
    fidelity : str

    Raises
    ------
    EngineError
        Where there is no equilibrium; a ``ValueError``.
    """
    run = Instance(prepare(still_of(scene).with_rigid_rings(), fidelity=fidelity), tell=tell)
    for place, value in (inputs or {}).items():
        run.u[place] = value
    _initialise(run)
    return run


def _initialise(run: Instance) -> None:
    try:
        run.initialise()
    except EngineError as refusal:
        raise EngineError(f"{run.model.scene.name}: {refusal}") from None


def parts(run: Instance) -> tuple[Part, ...]:
    """Return the bearings of a started scene; their arrays are views."""
    return tuple(Part(run.p[at_p], run.s[at_s]) for at_p, at_s in parts_of(run.p))


def nose(run: Instance) -> NDArray[np.float64]:
    """Place (m) and tilts (rad) of the shaft's nose, of a single bearing its inner ring's, shape (5,).

    The shaft's zero is where the preloaded set is at 20 degC and standstill; of a set that carries one way
    where its balls are in line with the grooves, as of a single bearing.
    """
    prefix = f"{run.model.scene.assembly.moving}."
    place = np.array([run.get(prefix + name) for name in _MOTIONS])
    if SP.has_shaft(run.p) and run.p[int(run.p[P.SET]) + SP.ONE_WAY] != 0.0:
        # the engine counts from where the load at the start puts such a set
        first = SP.first(run.p, SP.AT_ROWS)
        row = run.p[first : first + SP.ROW]
        place[0] += row[SP.ROW_SIGN] * (per_bearing(run, SP.OFFSET_COLD)[0] - row[SP.ROW_STICKOUT])
    return place


def per_bearing(run: Instance, place: int) -> NDArray[np.float64]:
    """One of the numbers that the state of a set holds for each bearing, ``SP.OFFSET`` and so on."""
    block = run.p[int(run.p[P.SET]) :]
    first = int(block[SP.AT_S]) + SP.S_HEAD + SP.MOTION * int(block[SP.PADDED_SIZE]) + place
    return run.s[first : first + int(block[SP.BEARINGS]) * SP.PER_BEARING : SP.PER_BEARING]


def forces(run: Instance) -> NDArray[np.float64]:
    """Force x y z (N) and moment about y, z (N m) of the shaft on each bearing, shape (bearings, 5)."""
    scene = run.model.scene
    if scene.assembly.joined:
        names = [[bearing.prefix + name for name in SP.BEARING_OUTPUTS] for bearing in scene.bearings()]
        return np.array([[run.get(name) for name in of_one] for of_one in names])
    p, u, c, y = run.p, run.u, run.s[S.C :], run.s[S.Y :]
    rigid = p[P.RIGID] != 0.0  # the pedestal then carries the force of the held place
    axial = y[Y.Q0 + Q.OUTER] * c[C.PEDESTAL_AXIAL] if rigid else u[U.PRELOAD]
    weight = GRAVITY * p[P.INNER_MASS] if p[P.GRAVITY] else 0.0
    springs = p[P.SUPPORT_STIFFNESS : P.SUPPORT_STIFFNESS + Q.OUTER] * y[Y.Q0 : Y.Q0 + Q.OUTER]
    return np.array([[axial, u[U.LOAD_Y], u[U.LOAD_Z] - weight, 0.0, 0.0]]) - springs


def preloads(run: Instance) -> dict[str, list[float]]:
    """Return what each bearing carries along its axis without load and weight, N.

    ``cold``: at standstill and 20 degC; ``warm``: at standstill and the temperatures of the inputs;
    ``running``: at their speed too. Empty for sets that carry one way and for a bearing under a constant
    force, which no temperature changes.

    Raises
    ------
    EngineError
        Where there is no equilibrium; a ``ValueError``.
    """
    signs = np.array([bearing.sign for bearing in run.model.scene.bearings()])
    if run.p[P.RIGID] == 0.0 and len(set(signs)) == 1:
        return {}
    loads = {}
    for key, shares in _STATES.items():
        try:
            loads[key] = carried(unloaded(run, *shares))
        except EngineError:
            if not gap(run, key) > 0.0:
                raise
            loads[key] = [0.0]
    return loads


def gap(run: Instance, key: str) -> float:
    """Return how far (m) balls and races of a single rigidly preloaded bearing are apart along its axis.

    From where the inner ring is held to where it would touch; negative: they are pressed together. ``key``:
    state, as of `preloads`.
    """
    if run.p[P.RIGID] == 0.0 or SP.has_shaft(run.p):
        return 0.0
    free = _without_loads(run, *_STATES[key])
    free.p[P.RIGID] = 0.0
    free.u[U.PRELOAD] = TOUCHING
    _initialise(free)
    return float(free.s[S.Y + Y.Q0] - run.s[S.PLACE])


def carried(run: Instance) -> list[float]:
    """Return what each bearing of a started scene carries along its axis, N."""
    signs = np.array([bearing.sign for bearing in run.model.scene.bearings()])
    return [float(force) for force in signs * forces(run)[:, 0]]


def unloaded(run: Instance, speed: float, warmth: float) -> Instance:
    """Return another engine of the same scene, started without load and weight.

    Parameters
    ----------
    run : Instance
    speed, warmth : float
        Shares of the shaft speed and of all temperatures above 20 degC.

    Raises
    ------
    EngineError
        Where there is no equilibrium; a ``ValueError``.
    """
    free = _without_loads(run, speed, warmth)
    _initialise(free)
    return free


def _without_loads(run: Instance, speed: float, warmth: float) -> Instance:
    """As `unloaded`, before its start."""
    free = Instance(run.model, tell=silent)
    free.u[:] = run.u
    for at_p, _ in parts_of(free.p):
        free.p[at_p][P.GRAVITY] = 0.0
    for variable in run.model.variables:
        if variable.array != "u":
            continue
        if variable.name.startswith(("nose.", "radial_load.")):
            free.u[variable.index] = 0.0
        elif variable.name == "shaft_speed":
            free.u[variable.index] *= speed
        elif variable.name.endswith("temperature") and warmth != 1.0:  # 1 leaves every bit
            rise = free.u[variable.index] - REFERENCE_TEMPERATURE
            free.u[variable.index] = REFERENCE_TEMPERATURE + warmth * rise
    return free
