"""Fidelity `full` linearised about its steady state: x' = A x of a single bearing, or of a set on its shaft.

Each bearing has its own equations in fixed axes (see ``bearing``). Rows of its rings that shaft, housing or a
sliding seat drive are ``T q``, and what they would accelerate by without it, times their inertia, is their
force on the coordinates q. A single bearing is a set without shaft: no coordinates q, no driven rows.

The state is the steady one in which runs of `full` start (``engine/steady``), with the loads, tilts and
temperatures of every bearing. The cage and its films are left out: it touches balls and lands with clearance,
and a linear cage would either have no contact or never lose it. Imperfections and sound are left out, too.
Weights, of the balls too, load the steady state where the scene has them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from fmu_bearing.arrays import Arrays, EngineError
from fmu_bearing.engine.layout import SP, C, P, Q, S, U, Y
from fmu_bearing.engine.steady.point import CARRIED, NOT_FOUND
from fmu_bearing.modal.equations.bearing import BearingLinearised, in_fixed_axes, phases_of
from fmu_bearing.modal.equations.coordinates import Coordinates
from fmu_bearing.modal.equations.plain import BearingArrays
from fmu_bearing.modal.equations.shaft import ShaftMatrices, matrices, rows_of
from fmu_bearing.scene import Scene
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.read import with_fidelity


@dataclass(frozen=True)
class Linearised:
    """Small motions x: x' = A x, in fixed axes.

    x holds for each bearing its numbers in the order of ``Coordinates``, without the rows of its rings that
    are driven; behind all bearings the places and the rates of shaft, housing and sliding rings.

    Attributes
    ----------
    bearings : tuple of BearingLinearised
        Each bearing alone, in its own axes, in the place that it has on the shaft.
    shaft : ShaftMatrices
        Of a single bearing without coordinates: ``shaft.count`` is 0.
    own : tuple of ndarray
        Which numbers of each bearing are in x.
    matrix : ndarray, shape (n, n)
        A (SI units), mean over the phases.
    phases : ndarray, shape (phases, n, n)
        A at single phases of one ball pitch: one where the balls' loads are equal.
    masses : ndarray, shape (n, n)
        Kinetic energy is half its quadratic form in the rates.
    speed : float
        rad/s of the shaft.
    steady : bool
        Whether the steady state was found; else all holds for the state in which a run starts.
    on_pedestal : tuple of float
        How far loads move the housing, or an outer ring on a pedestal of its own (m); its stiffness (N/m).
    """

    bearings: tuple[BearingLinearised, ...]
    shaft: ShaftMatrices
    own: tuple[NDArray[np.int64], ...]
    matrix: NDArray[np.float64]
    phases: NDArray[np.float64]
    masses: NDArray[np.float64]
    speed: float
    steady: bool
    on_pedestal: tuple[float, float]

    @property
    def carried(self) -> bool:
        """Whether a run starts with quasi-static balls, some of which the cage carries: `steady.carried`."""
        return any(bearing.arrays.s[S.SETTLED] == CARRIED for bearing in self.bearings)

    @property
    def orbits(self) -> NDArray[np.float64]:
        """rad/s: speed of the balls' orbit in each bearing; loads make them differ by some 0.1 %."""
        return np.array([bearing.orbit for bearing in self.bearings])

    @property
    def spins(self) -> NDArray[np.float64]:
        """rad/s: speed of a ball about its own axis against axes that orbit with it, in each bearing."""
        return np.array([bearing.spin for bearing in self.bearings])

    @property
    def orbit(self) -> float:
        """rad/s: mean of the bearings."""
        return float(self.orbits.mean())

    @property
    def spin(self) -> float:
        """rad/s: mean of the bearings."""
        return float(self.spins.mean())

    @property
    def places(self) -> int:
        """First number of the shaft's places."""
        return self.first[-1]

    @property
    def rates(self) -> int:
        """First number of the shaft's rates."""
        return self.first[-1] + self.shaft.count

    @property
    def equal_loads(self) -> bool:
        """Whether one phase serves for all: the balls of each bearing carry equal loads."""
        return len(self.phases) == 1

    @cached_property
    def first(self) -> tuple[int, ...]:
        """Where each bearing begins in x; the last is where the places of the shaft begin."""
        return (0, *(int(end) for end in np.cumsum([numbers.size for numbers in self.own])))

    @cached_property
    def pairs(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Numbers of the places in x, and of the rate of each."""
        numbers = []
        for bearing, own, first in zip(self.bearings, self.own, self.first, strict=False):
            where = np.full(bearing.coordinates.size, -1)
            where[own] = first + np.arange(own.size)
            pairs = where[np.array(bearing.coordinates.pairs)]
            numbers.append(pairs[:, pairs[0] >= 0])
        places, rates = np.hstack([*numbers, np.arange(self.shaft.count) + [[self.places], [self.rates]]])
        return places, rates

    def of_bearing(self, number: int, vector: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Return the part of a vector x that is a bearing's own, from 0, in its order; driven rows are 0."""
        part = np.zeros(self.bearings[number].coordinates.size, dtype=complex)
        part[self.own[number]] = vector[self.first[number] : self.first[number + 1]]
        return part


def linearised(scene: Scene, inputs: dict[int, float] | None = None, friction: bool = True) -> Linearised:
    """Linearise a scene, a single bearing or a set, at its operating point.

    Parameters
    ----------
    scene : Scene
        Its cage, imperfections and sound are left out, and its fidelity counts as full.
    inputs : dict, optional
        Values by their places in the engine's ``u`` (``layout.U``) in place of the scene's.
    friction : bool, optional
        False: contacts without traction.

    Raises
    ------
    EngineError
        Where there is no quasi-static equilibrium.
    SceneError
        For bearings on another model's shaft: without its mass there is no mode.
    """
    require(scene, "modes")
    full = with_fidelity(scene, model="full")
    run = Arrays.of(full.model_copy(update={"sound": None, "imperfections": None})).at(inputs or {})
    rows = rows_of(run.p)
    _leave_out(run, rows, ("CAGE",) if friction else ("CAGE", "MU"))
    try:
        run.init()
    except EngineError as refusal:
        raise EngineError(f"{scene.name}: {refusal}") from None
    speed = float(run.u[U.SPEED])
    shaft = matrices(run, speed)
    alone = [bearing_of(run, row, speed) for row in rows]
    # without friction nothing decides how fast balls spin
    steady = not friction or all(_is_steady(one) for one in alone)
    count = phases_of(alone)
    bearings = tuple(in_fixed_axes(one, count, steady) for one in alone)
    own = tuple(_own(one.coordinates, mass.size) for one, mass in zip(bearings, shaft.inertia, strict=True))
    phases = np.array([_assembled(bearings, k, own, shaft) for k in range(count)])
    masses = block_diag(
        *[np.diag(one.coordinates.masses[numbers]) for one, numbers in zip(bearings, own, strict=True)],
        np.zeros_like(shaft.mass), shaft.total,
    )  # fmt: skip
    return Linearised(
        bearings, shaft, own, phases.mean(axis=0), phases, masses, speed, steady,
        (_on_pedestal(run, rows, alone, shaft), float(run.u[U.PEDESTAL])),
    )  # fmt: skip


def under_force(scene: Scene, inputs: dict[int, float] | None = None) -> Linearised:
    """Linearise as `linearised`; with rigid preload under the force which its place means.

    A ring that is fixed would have no row.
    """
    system = linearised(scene, inputs)
    one = system.bearings[0]
    if not one.coordinates.held:
        return system
    state = one.arrays.s
    force = float(state[S.Y + Y.Q0 + Q.OUTER] * state[S.C + C.PEDESTAL_AXIAL])
    return linearised(scene.replace({"mounting.preload_mode": "force"}), {**(inputs or {}), U.PRELOAD: force})


def _leave_out(run: Arrays, rows: Sequence[NDArray[np.float64]], names: Sequence[str]) -> None:
    """Set parameters of all bearings to zero."""
    run.p.setflags(write=True)
    for row in rows:
        for name in names:
            run.p[int(row[SP.ROW_P]) + getattr(P, name)] = 0.0
    run.p.setflags(write=False)


def bearing_of(run: Arrays, row: NDArray[np.float64], speed: float) -> BearingArrays:
    """Return the arrays of one bearing of an initialised scene, as of a single one.

    ``row``: see `rows_of`; ``speed``: of the shaft (rad/s). Its weight is a load that it carries already.
    """
    parts = []
    for array, place, size in (
        (run.p, SP.ROW_P, SP.ROW_P_SIZE), (run.s, SP.ROW_S, SP.ROW_S_SIZE), (run.w, SP.ROW_W, SP.ROW_W_SIZE),
    ):  # fmt: skip
        first = int(row[place])
        length = int(row[size]) or array.size  # a single bearing has the whole arrays
        parts.append(array[first : first + length].copy())
    p, s, w = parts
    if SP.has_shaft(run.p):
        p[P.SET] = 0.0
    p[P.GRAVITY] = 0.0  # a constant force, which would turn against the axes of a phase
    u = np.zeros(U.SIZE)
    u[U.SPEED] = speed
    return BearingArrays(p, u, s, w)


def _is_steady(bearing: BearingArrays) -> bool:
    """Whether a bearing starts steady; so does a quasi-static state where nothing turns balls."""
    turns = bearing.u[U.SPEED] != 0.0 and (bearing.p[P.MU] != 0.0 or bearing.p[P.GYROSCOPIC] != 0.0)
    return not turns or bearing.s[S.SETTLED] not in (NOT_FOUND, CARRIED)


def _on_pedestal(
    run: Arrays, rows: list[NDArray[np.float64]], bearings: list[BearingArrays], shaft: ShaftMatrices
) -> float:
    """Return how far loads move the housing (m), or the ring on a pedestal of its own that goes furthest."""
    own = run.s[int(run.p[int(run.p[P.SET]) + SP.AT_S]) + SP.S_HEAD :]
    places = [own[shaft.shaft_count :][:3]] if shaft.housed else [
        bearing.s[S.Y + Y.Q0 + Q.OUTER :][:3]
        for bearing, row in zip(bearings, rows, strict=True)
        if row[SP.ROW_SEAT] == SP.PEDESTAL
    ]  # fmt: skip
    return max((float(np.linalg.norm(place)) for place in places), default=0.0)


def _own(at: Coordinates, driven: int) -> NDArray[np.int64]:
    """Return which numbers of a bearing are its own in the set: not the driven rows of its rings."""
    own = np.ones(at.size, dtype=bool)
    for first in (at.rings, at.ring_rates):
        own[first : first + driven] = False
    return np.flatnonzero(own)


def _assembled(
    bearings: Sequence[BearingLinearised],
    phase: int,
    own: Sequence[NDArray[np.int64]],
    shaft: ShaftMatrices,
) -> NDArray[np.float64]:
    """Return A at a phase from the matrices of the bearings."""
    n, behind = shaft.count, sum(numbers.size for numbers in own)
    size = behind + 2 * n
    places, rates = slice(behind, behind + n), slice(behind + n, size)
    matrix, force = np.zeros((size, size)), np.zeros((n, size))
    force[:, places], force[:, rates] = -shaft.stiffness, -shaft.damping
    begin = 0
    for bearing, numbers, motion, mass in zip(bearings, own, shaft.motions, shaft.inertia, strict=True):
        at, end = bearing.coordinates, begin + numbers.size
        into = np.zeros((at.size, size))
        into[numbers, np.arange(begin, end)] = 1.0
        into[at.rings : at.rings + mass.size, places] = motion
        into[at.ring_rates : at.ring_rates + mass.size, rates] = motion
        moved = bearing.phases[phase] @ into
        matrix[begin:end] = moved[numbers]
        force += motion.T @ (mass[:, None] * moved[at.ring_rates : at.ring_rates + mass.size])
        begin = end
    matrix[places, rates] = np.eye(n)
    matrix[rates] = shaft.inverse @ force
    return matrix
