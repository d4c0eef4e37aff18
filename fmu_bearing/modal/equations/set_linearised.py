"""A set of bearings on its shaft linearised about rest: bearings by themselves, tied by shaft and housing.

Each bearing has the equations of a single one (see ``linearised``). Rows of its rings that shaft, housing or
a sliding seat drive are ``T q``, and what they would accelerate by without it, times their inertia, is their
force on the coordinates q. The state is the steady one near that in which a run of the set starts, with
loads, tilts and temperatures of every bearing (see ``equilibrium``).
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from fmu_bearing.arrays import Arrays, Refused
from fmu_bearing.engine.layout import SP, STRIDE, P, Q, S, U, Y
from fmu_bearing.instance import EngineError
from fmu_bearing.modal.equations.coordinates import Coordinates
from fmu_bearing.modal.equations.equilibrium import Tie, settle_set
from fmu_bearing.modal.equations.linearised import PHASES, Linearised, in_fixed_axes
from fmu_bearing.modal.equations.plain import BearingArrays
from fmu_bearing.prepare.spindle import in_housing
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.read import with_fidelity

_EQUAL = 1e-12  # m: balls whose places differ less carry equal loads


@dataclass(frozen=True)
class SetBlock:
    """Matrices of shaft, housing and sliding rings, over their n coordinates; SI units.

    Attributes
    ----------
    mass, inverse : ndarray, shape (n, n)
        Without the driven rings; inverse of the mass with them.
    stiffness, damping : ndarray, shape (n, n)
        With pedestal, springs, and the gyroscopic effect at the speed in the damping.
    motions : tuple of ndarray, shape (rows, n)
        Driven rows of each bearing.
    inertia : tuple of ndarray, shape (rows,)
    nose : ndarray, shape (5, n)
    shaft, housed : int, bool
        Number of the shaft's coordinates; whether six of a housing follow.
    signs, positions : ndarray
        Of the bearings, 1 or -1; m.
    """

    mass: NDArray[np.float64]
    inverse: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    damping: NDArray[np.float64]
    motions: tuple[NDArray[np.float64], ...]
    inertia: tuple[NDArray[np.float64], ...]
    nose: NDArray[np.float64]
    shaft: int
    housed: bool
    signs: NDArray[np.float64]
    positions: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of coordinates."""
        return len(self.mass)

    @property
    def total(self) -> NDArray[np.float64]:
        """Mass with the driven rings."""
        found = self.mass.copy()
        for motion, mass in zip(self.motions, self.inertia, strict=True):
            found += motion.T @ (mass[:, None] * motion)
        return found


@dataclass(frozen=True)
class SetLinearised:
    """Small motions x of a set: x' = A x, in fixed axes.

    x holds for each bearing its balls as in ``Coordinates``, then rows of its rings that nothing drives,
    places and rates; behind all bearings the places and the rates of shaft, housing and sliding rings.

    Attributes
    ----------
    coordinates : tuple of Coordinates
        Of each bearing alone.
    first : tuple of int
        Where each bearing begins in x; the last is where q begins.
    matrix : ndarray, shape (n, n)
        Mean over the phases.
    phases : ndarray, shape (phases, n, n)
        At single phases of one ball pitch.
    masses : ndarray, shape (n, n)
        Kinetic energy is half its quadratic form in the rates.
    block : SetBlock
    orbits, spins : ndarray
        rad/s of the balls of each bearing; of a ball about its own axis in axes that orbit with it.
    speed : float
        rad/s of the shaft.
    members : tuple of Linearised
        Each bearing alone, in its own axes, where the set puts it.
    steady : bool
        Whether the steady state was found; else all holds for the state in which a run starts.
    on_pedestal : tuple of float
        How far loads move the housing, or an outer ring on a pedestal of its own (m); its stiffness (N/m).
    """

    coordinates: tuple[Coordinates, ...]
    first: tuple[int, ...]
    matrix: NDArray[np.float64]
    phases: NDArray[np.float64]
    masses: NDArray[np.float64]
    block: SetBlock
    orbits: NDArray[np.float64]
    spins: NDArray[np.float64]
    speed: float
    members: tuple[Linearised, ...]
    steady: bool
    on_pedestal: tuple[float, float]

    @property
    def orbit(self) -> float:
        """rad/s: mean of the bearings; their loads make them differ by some tenths of a per cent."""
        return float(self.orbits.mean())

    @property
    def spin(self) -> float:
        """rad/s: mean of the bearings, of a ball about its own axis against axes that orbit with it."""
        return float(self.spins.mean())

    @property
    def places(self) -> int:
        """First number of the shaft's places."""
        return self.first[-1]

    @property
    def rates(self) -> int:
        """First number of the shaft's rates."""
        return self.first[-1] + self.block.count

    @cached_property
    def equal_loads(self) -> bool:
        """Whether one phase tells all."""
        return len(self.phases) == 1


def need_shaft(scene: Scene) -> None:
    """Refuse (`SceneError`) bearings on another model's shaft: without its mass there are no modes."""
    if scene.spindle is not None and scene.spindle.shaft.external:
        raise SceneError(
            f"{scene.name}: another model owns the shaft (spindle.shaft.external): modes need its mass; give "
            "the shaft as sections_mm of [spindle.shaft]"
        )


def set_linearised(
    scene: Scene, inputs: dict[int, float] | None = None, friction: bool = True
) -> SetLinearised:
    """Linearise a scene's set at its operating point.

    Parameters
    ----------
    scene : Scene
        Cage, imperfections, bending of the rings and sound are left out, and its fidelity counts as full.
    inputs : dict, optional
        Values by their places in ``u`` of a set (``SP.INPUTS``) in place of the scene's.
    friction : bool, optional
        False: contacts without traction.

    Raises
    ------
    EngineError
        Where there is no equilibrium.
    SceneError
        For bearings on another model's shaft: without its mass there is no mode.
    """
    need_shaft(scene)
    bare = with_fidelity(scene.with_rigid_rings(), model="full")
    run = Arrays.of(bare.model_copy(update={"sound": None, "imperfections": None}))
    for place, value in (inputs or {}).items():
        run.u[place] = value
    rows = _rows(run.p)
    run.p.setflags(write=True)
    for row in rows:
        run.p[int(row[SP.ROW_P]) + P.CAGE] = 0.0
        if not friction:
            run.p[int(row[SP.ROW_P]) + P.MU] = 0.0
    run.p.setflags(write=False)
    try:
        run.init()
    except Refused as refusal:
        raise EngineError(f"{scene.name}: {refusal}") from None
    speed = float(run.u[SP.U_SPEED])
    block = _block(run.p, run.s, rows, speed)
    members = [_member(run, row, speed) for row in rows]
    # without friction nothing says how fast balls spin
    steady = settle_set(members, _tie(run, block)) if friction else True
    at = tuple(Coordinates.of(one.p) for one in members)
    count = 1 if all(_even(one) for one in members) else PHASES
    orbits = np.array([float(np.mean(_of_balls(one, Y.OM))) for one in members])
    spins = np.array(
        [
            math.hypot(float(np.mean(_of_balls(one, Y.WX))) - orbit, float(np.mean(_of_balls(one, Y.WR))))
            for one, orbit in zip(members, orbits, strict=True)
        ]
    )
    driven = [len(mass) for mass in block.inertia]
    keeps = [_kept(one, rows) for one, rows in zip(at, driven, strict=True)]
    alone = []
    for one, own, orbit, spin in zip(members, at, orbits, spins, strict=True):
        turns = [2.0 * math.pi / own.balls * k / count for k in range(count)]
        found = np.array([in_fixed_axes(_turned(one, own, turn), own, turn, float(orbit)) for turn in turns])
        alone.append(
            Linearised(own, found.mean(axis=0), found, float(orbit), float(spin), speed, one, steady)
        )
    phases = np.array([_assembled([one.phases[k] for one in alone], at, keeps, block) for k in range(count)])
    first = np.concatenate([[0], np.cumsum([keep.size for keep in keeps])])
    masses = block_diag(
        *[np.diag(own.masses[keep]) for own, keep in zip(at, keeps, strict=True)],
        np.zeros_like(block.mass), block.total,
    )  # fmt: skip
    return SetLinearised(
        at, tuple(int(k) for k in first), phases.mean(axis=0), phases, masses, block, orbits, spins, speed,
        tuple(alone), steady, (_on_pedestal(run, rows, members, block), float(run.u[SP.U_PEDESTAL])),
    )  # fmt: skip


def _rows(p: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    block = int(p[P.SET])
    first = block + int(p[block + SP.AT_ROWS])
    count = int(p[block + SP.BEARINGS])
    return [p[first + k * SP.ROW : first + (k + 1) * SP.ROW].copy() for k in range(count)]


def _member(run: Arrays, row: NDArray[np.float64], speed: float) -> BearingArrays:
    """Return one bearing's arrays as those of a single one: p, u, s, w."""
    parts = {
        name: array[int(row[at]) : int(row[at]) + int(row[size])].copy()
        for name, array, at, size in (
            ("p", run.p, SP.ROW_P, SP.ROW_P_SIZE), ("s", run.s, SP.ROW_S, SP.ROW_S_SIZE),
            ("w", run.w, SP.ROW_W, SP.ROW_W_SIZE),
        )
    }  # fmt: skip
    parts["p"][P.SET] = 0.0
    u = np.zeros(U.SIZE)
    u[U.SPEED] = speed
    return BearingArrays(parts["p"], u, parts["s"], parts["w"])


def _tie(run: Arrays, block: SetBlock) -> Tie:
    """Return what ties the bearings where the run starts: shaft, housing and sliding rings along the axis."""
    head, n = run.p[int(run.p[P.SET]) :], block.count
    own = run.s[int(head[SP.AT_S]) :]
    lanes = SP.padded_size(n)
    q, held = own[SP.S_HEAD : SP.S_HEAD + n], own[SP.S_HEAD + SP.HELD_LOAD * lanes :][:n]
    along = np.zeros(n, dtype=bool)
    along[0] = True  # the whole shaft's
    along[block.shaft :] = True
    if block.housed:
        along[block.shaft : block.shaft + SP.HOUSING] = np.isin(np.arange(SP.HOUSING), (Q.X, Q.TURN))
    at = np.ix_(along, along)
    return Tie(
        (held - block.stiffness @ q)[along], block.stiffness[at], block.inverse[at],
        [motion[:, along] for motion in block.motions], block.inertia,
    )  # fmt: skip


def _on_pedestal(
    run: Arrays, rows: list[NDArray[np.float64]], members: list[BearingArrays], block: SetBlock
) -> float:
    """Return how far loads move the housing (m), or the ring on a pedestal of its own that goes furthest."""
    own = run.s[int(run.p[int(run.p[P.SET]) + SP.AT_S]) + SP.S_HEAD :]
    places = [own[block.shaft :][:3]] if block.housed else [
        one.s[S.Y + Y.Q0 + Q.OUTER :][:3]
        for one, row in zip(members, rows, strict=True)
        if row[SP.ROW_SEAT] == SP.PEDESTAL
    ]  # fmt: skip
    return max((float(np.linalg.norm(place)) for place in places), default=0.0)


def _of_balls(one: BearingArrays, row: int) -> NDArray[np.float64]:
    first = S.Y + row
    return np.asarray(one.s[first : first + int(one.p[P.BALLS])])


def _even(one: BearingArrays) -> bool:
    """Whether all balls stand alike."""
    radii = np.concatenate([_of_balls(one, row)[None] for row in (Y.X, Y.R)])
    return bool(np.ptp(radii, axis=1).max() < _EQUAL)


def _kept(at: Coordinates, driven: int) -> NDArray[np.int64]:
    """Return which numbers of a bearing are its own in the set: not the driven rows of its rings."""
    found = np.ones(at.size, dtype=bool)
    for first in (at.rings, at.ring_rates):
        found[first : first + driven] = False
    return np.flatnonzero(found)


def _turned(one: BearingArrays, at: Coordinates, phase: float) -> BearingArrays:
    """Return the bearing with its balls ``phase`` (rad) further on, in axes that went with them.

    Balls stand as others stood there: interpolated round the bearing. The rest turns back.
    """
    if phase == 0.0:
        return one
    found = BearingArrays(one.p, one.u, one.s.copy(), one.w)
    n, lanes = at.balls, int(one.p[P.LANES])
    where = 2.0 * math.pi * np.arange(n) / n
    across = at.patterns(where + phase)[0] @ np.linalg.inv(at.patterns(where)[0])
    y = found.s[S.Y : S.Y + Y.SIZE]
    rows = y[: Y.Q0].reshape(Y.ROWS, -1)
    angle = Y.TH // STRIDE
    rows[angle, :n] -= where  # what is left repeats round the bearing
    rows[:, :n] = rows[:, :n] @ across.T
    rows[angle, :n] += where
    rows[:, n:lanes] = rows[:, :1]
    ring = at.turned(phase)[: 2 * Q.RINGS, : 2 * Q.RINGS]
    y[Y.Q0 : Y.Q0 + Q.RINGS] = ring[: Q.RINGS, : Q.RINGS] @ y[Y.Q0 : Y.Q0 + Q.RINGS]
    y[Y.V0 : Y.V0 + Q.RINGS] = ring[: Q.RINGS, : Q.RINGS] @ y[Y.V0 : Y.V0 + Q.RINGS]
    return found


def _matrix(p: NDArray[np.float64], place: int, rows: int, columns: int) -> NDArray[np.float64]:
    """Return a table of the block by its columns of padded rows."""
    block = int(p[P.SET])
    lanes, first = SP.padded_size(rows), block + int(p[block + place])
    return np.asarray(p[first : first + lanes * columns].reshape(columns, lanes)[:, :rows].T.copy())


def _block(
    p: NDArray[np.float64], s: NDArray[np.float64], rows: list[NDArray[np.float64]], speed: float
) -> SetBlock:
    head = p[int(p[P.SET]) :]
    n, shaft, housed = int(head[SP.COUNT]), int(head[SP.SHAFT]), bool(head[SP.HOUSED])
    mass, inverse, stiffness, damping, turning = (
        _matrix(p, place, n, n)
        for place in (SP.AT_MASS, SP.AT_INVERSE, SP.AT_STIFFNESS, SP.AT_DAMPING, SP.AT_GYROSCOPIC)
    )
    if housed:
        own = s[int(head[SP.AT_S]) :]
        here = in_housing(1, float(head[SP.HOUSING_X]))
        six = slice(shaft, shaft + SP.HOUSING)
        stiffness[six, six] += here.T @ (own[SP.FEET : SP.FEET + SP.HOUSING, None] * here)
        damping[six, six] += here.T @ (own[SP.FEET_DAMPING : SP.FEET_DAMPING + SP.HOUSING, None] * here)
    motions, inertia = [], []
    for row in rows:
        first, count = int(row[SP.ROW_AT_T]), int(row[SP.ROW_DRIVEN])
        motions.append(p[first : first + SP.LANES * n].reshape(n, SP.LANES)[:, :count].T.copy())
        inertia.append(row[SP.ROW_MASS : SP.ROW_MASS + count].copy())
    return SetBlock(
        mass, inverse, stiffness, damping + speed * turning, tuple(motions), tuple(inertia),
        _matrix(p, SP.AT_NOSE, n, SP.PLANE).T, shaft, housed,
        np.array([row[SP.ROW_SIGN] for row in rows]), np.array([row[SP.ROW_POSITION] for row in rows]),
    )  # fmt: skip


def _assembled(
    alone: list[NDArray[np.float64]],
    at: tuple[Coordinates, ...],
    keeps: list[NDArray[np.int64]],
    block: SetBlock,
) -> NDArray[np.float64]:
    """Return A of the set from those of its bearings."""
    n, behind = block.count, sum(keep.size for keep in keeps)
    found = np.zeros((behind + 2 * n, behind + 2 * n))
    places, rates = slice(behind, behind + n), slice(behind + n, behind + 2 * n)
    force = np.zeros((n, behind + 2 * n))
    force[:, places] = -block.stiffness
    force[:, rates] = -block.damping
    begin = 0
    for matrix, own, keep, motion, mass in zip(alone, at, keeps, block.motions, block.inertia, strict=True):
        into = np.zeros((own.size, behind + 2 * n))
        into[keep, begin + np.arange(keep.size)] = 1.0
        into[own.rings : own.rings + mass.size, places] = motion
        into[own.ring_rates : own.ring_rates + mass.size, rates] = motion
        moved = matrix @ into
        found[begin : begin + keep.size] = moved[keep]
        force += motion.T @ (mass[:, None] * moved[own.ring_rates : own.ring_rates + mass.size])
        begin += keep.size
    found[places, rates] = np.eye(n)
    found[rates] = block.inverse @ force
    return found
