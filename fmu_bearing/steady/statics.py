"""Statics of a scene: loads, ball loads, stiffness of the shaft, limits of the preload."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from fmu_bearing.elastic.shaft import ShaftModel, rigid_transform, shaft_model
from fmu_bearing.elastic.shaft.model import FREEDOMS
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import P, Q, U
from fmu_bearing.instance import Instance
from fmu_bearing.modal.equations.linearised import Linearised, under_force
from fmu_bearing.modal.equations.remarks import remarks
from fmu_bearing.prepare.bodies import inner_ring
from fmu_bearing.prepare.spindle import supports
from fmu_bearing.progress import Tell, silent
from fmu_bearing.results.balls import Readable
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.table import tenths
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.member import set_of
from fmu_bearing.steady.axial import LiftOff, lift_off, neutral_spacing, spacing
from fmu_bearing.steady.impedance import at_rest
from fmu_bearing.steady.member import Member
from fmu_bearing.steady.rest import (
    OUTER_PLANE,
    TOUCHING,
    forces,
    gap,
    nose,
    parts,
    pedestal,
    preloads,
    started,
)
from fmu_bearing.threads import one_thread


@dataclass(frozen=True)
class BearingLoad(Result):
    """What one bearing carries, SI units, shaft axes."""

    quantities = (
        Quantity(" = label", "bearing"), "bearing [1] = number", "carries",
        Quantity("position_mm", "at, mm", "g", factor=1e3), Quantity("axial_N", "axial, N", tenths),
        Quantity("force_y_N", "y, N", tenths, of=lambda one: one.force[1]),
        Quantity("force_z_N", "z, N", tenths, of=lambda one: one.force[2]),
        Quantity("moment_y_N_m [N m]", of=lambda one: one.moment[0]),
        Quantity("moment_z_N_m [N m]", of=lambda one: one.moment[1]),
        "ball_load_max_N = ball_loads.max",
        Quantity("ball_load_inner_max_N", "ball inner, N", ".1f", of=lambda one: one.ball_loads[0].max()),
        Quantity("ball_load_outer_max_N", "ball outer, N", ".1f", of=lambda one: one.ball_loads[1].max()),
        Quantity("balls_unloaded [1] = unloaded", "unloaded balls"),
        Quantity("angle_inner_max_deg", "angle inner, deg", ".2f", of=lambda one: one.largest_angle(0)),
        Quantity("angle_outer_max_deg", "angle outer, deg", ".2f", of=lambda one: one.largest_angle(1)),
        Quantity("pressure_inner_GPa", "inner, GPa", ".3f", of=lambda one: 1e-9 * one.pressures[0].max()),
        Quantity("pressure_outer_GPa", "outer, GPa", ".3f", of=lambda one: 1e-9 * one.pressures[1].max()),
    )  # fmt: skip

    number: int
    """From 1 at the nose; 1 for a single bearing."""
    position: float
    """m from the nose; 0 for a single bearing."""
    sign: int
    """1 where it carries axial force on the shaft towards +X, else -1."""
    force: NDArray[np.float64]
    """Of the shaft on the bearing, N. Shape (3,)."""
    moment: NDArray[np.float64]
    """About y and z through its centre, N m. Shape (2,)."""
    displacement: NDArray[np.float64]
    """Of the inner ring against the outer in the bearing's own axes: m, rad. Shape (5,)."""
    stiffness: NDArray[np.float64]
    """Of the bearing in its own axes, for frequency to 0, see `BearingStiffness.static`. Shape (5, 5)."""
    ball_loads: NDArray[np.float64]
    contact_angles: NDArray[np.float64]
    pressures: NDArray[np.float64]
    """N, rad, Pa at inner and outer race, in the bearing's own axes. Shape (2, balls)."""

    @property
    def axial(self) -> float:
        """Axial load that it carries, N; never negative but for rounding, and of deep groove bearings."""
        return self.sign * float(self.force[0])

    @property
    def radial(self) -> float:
        """Radial load that it carries, N."""
        return math.hypot(float(self.force[1]), float(self.force[2]))

    @property
    def carries(self) -> str:
        """Direction of the axial force on the shaft that it carries."""
        return "+x" if self.sign > 0 else "-x"

    @property
    def label(self) -> str:
        """Number and direction."""
        return f"{self.number}, {self.carries}"

    def largest_angle(self, race: int) -> float:
        """Return the largest contact angle (deg) at the inner (0) or outer (1) race."""
        return math.degrees(self.contact_angles[race].max())

    @property
    def unloaded(self) -> int:
        """How many balls the inner race does not touch."""
        return int(np.sum(self.ball_loads[0] <= 0.0))


@dataclass(frozen=True)
class Statics(Result):
    """The bearings of a scene, and their shaft, in their steady state under a load, SI units.

    It is the state in which runs of fidelity full start, of perfect bearings with rigid rings. A single
    bearing is its own shaft: the nose is its inner ring.

    Examples
    --------
    >>> from fmu_bearing import statics
    >>> found = statics("examples/spindle_set/7003C-DB.toml")
    >>> f"{1e-6 * found.axial_stiffness:.0f} N/um, neutral spacing {1e3 * found.neutral_spacing:.0f} mm"
    '48 N/um, neutral spacing 63 mm'
    """

    quantities = (
        "scene = scene.name", "arrangement", "speed_rpm = scene.operation.speed_rpm", "load [N, N m]",
        "displacement [m, rad]", "bearings", "stiffness [N/m, N, N m/rad]", "axial_stiffness_N_m",
        "radial_stiffness_N_m", "tilt_stiffness_N_m_rad", "nose_stiffness_N_m", "nose_stiffness_bending_N_m",
        Quantity("lift_off [N]", of=lambda found: {
            way: {"load_N": one.load, "bearing": one.bearing} for way, one in found.lift_off.items()
        }),
        "preloads_N", "gaps_m", "spacing_m", "neutral_spacing_m", "cautions",
    )  # fmt: skip

    scene: Scene
    load: NDArray[np.float64]
    """On the shaft, moved to its nose, with weight: forces x y z (N), moments about y, z (N m). Shape (5,).
    """
    displacement: NDArray[np.float64]
    """Of the shaft at its nose: x y z (m), tilts about y, z (rad), with displacements of a housing or of
    pedestals that move. Zero is where the preloaded set is at 20 degC and standstill, of a set that carries
    one way and of a single bearing where balls are in line with the grooves (in runs of such a set: where the
    load at the start puts it); thermal growth counts from the nose. Shape (5,)."""
    bearings: tuple[BearingLoad, ...]
    stiffness: NDArray[np.float64]
    """Of the shaft at its nose, the rest of it free: rows forces and moments, columns displacements and
    tilts. Its bearings are as stiff as for frequency to 0 at their steady state. Shape (5, 5)."""
    nose_stiffness_bending: float
    """`nose_stiffness` with a shaft that bends in bearings as stiff as here, N/m; the same where the scene's
    shaft bends, and for a single bearing."""
    lift_off: dict[str, LiftOff]
    """By direction of an axial load alone, ``+x`` and ``-x``, the load that unloads the first bearing; empty
    for a single bearing."""
    preloads: dict[str, list[float]]
    """Axial load (N) of each bearing without load: ``cold``, ``warm`` (standstill), ``running``. Empty for a
    set that carries one way and a single bearing under constant force."""
    gaps: dict[str, float]
    """By those states in which a single bearing with a rigid preload has none: how far (m) its balls and
    races are apart along the axis."""
    spacing: float | None
    neutral_spacing: float | None
    """Distance (m) of both directions' bearings, and that at which warm inner rings and shaft leave the
    preload as it is."""
    remarks: tuple[str, ...]
    """That no steady state was found, that the pedestal is soft."""

    @property
    def arrangement(self) -> str:
        """What makers call the set, or that the bearing is a single one."""
        return self.scene.assembly.arrangement

    @property
    def axial_stiffness(self) -> float:
        """Force along x per displacement, the rest fixed, N/m."""
        return float(self.stiffness[0, 0])

    @property
    def radial_stiffness(self) -> float:
        """Force along z per displacement, tilts fixed, N/m."""
        return float(self.stiffness[2, 2])

    @property
    def tilt_stiffness(self) -> float:
        """Moment about y per tilt, the shaft free to move along z, N m/rad."""
        k = self.stiffness
        return float(k[3, 3] - k[2, 3] * k[3, 2] / k[2, 2])

    @property
    def nose_stiffness(self) -> float:
        """Force along z at the nose per displacement there, the shaft free, N/m."""
        return _at_nose(self.stiffness)

    def records(self) -> tuple[BearingLoad, ...]:
        """Return the bearings."""
        return self.bearings

    def table(self) -> list[dict[str, Any]]:
        """Return a row per bearing, units in the names."""
        return [bearing.summary() for bearing in self.bearings]

    def cautions(self) -> list[str]:
        """Return what a designer should look at, one line each."""
        sentences = [*self.remarks]
        for key, loads in self.preloads.items():
            if key in self.gaps:
                loose = f": balls are loose by {1e6 * self.gaps[key]:.1f} um"
                sentences.append(f"{_STATES[key]} the rigid preload is lost{loose}")
            elif max(map(abs, loads)) < TOUCHING:
                sentences.append(f"{_STATES[key]} the preload of the set is lost: its bearings are loose")
        for bearing in self.bearings:
            name = self.scene.assembly.name(bearing.number)
            if self.scene.bearing.is_deep_groove:  # its loaded zone is part of the circle
                if math.hypot(bearing.axial, bearing.radial) < _UNLOADED:
                    sentences.append(f"{name} is unloaded: its balls skid at speed; give it a load")
            elif bearing.axial < _UNLOADED:
                sentences.append(f"{name} is unloaded: its balls skid at speed; raise the preload")
            elif bearing.unloaded:
                sentences.append(f"{name}: {bearing.unloaded} of its balls carry nothing")
        soft, stiff = self.nose_stiffness_bending, self.nose_stiffness
        if abs(soft / stiff - 1.0) > _NOSES_DIFFER:
            sentences.append(
                f"the shaft is rigid here and its nose has {1e-6 * stiff:.3g} N/um; one that bends has "
                f"{1e-6 * soft:.3g} N/um: set spindle.shaft.flexible = true"
            )
        return sentences


_UNLOADED = 1e-3  # N
_STATES = {"cold": "at standstill and 20 degC", "warm": "at standstill, warm,", "running": "at speed"}
_LOOSE = 1e-3  # N/m: under what nothing holds
_NOSES_DIFFER = 0.2  # of the rigid shaft's nose: then its stiffness misleads a designer


@dataclass(frozen=True)
class Point:
    """A scene at its operating point: its statics with what they are read from.

    Attributes
    ----------
    run : Instance
        The engine, started.
    system : Linearised
        The bearings, linearised.
    statics : Statics
    """

    run: Instance
    system: Linearised
    statics: Statics


@one_thread
def statics(
    scene: SceneSource, force: Sequence[float] | None = None, at: float | None = None,
    moment: Sequence[float] = (0.0, 0.0),
) -> Statics:  # fmt: skip
    """Return what the bearings of a scene carry, and how stiff they hold the shaft, without a run.

    Parameters
    ----------
    scene : Scene or path
    force : sequence of three floats, optional
        Force x y z on the shaft of a set (N); default: ``[spindle.load]``. Weight is added unless
        ``fidelity.terms.gravity`` is false.
    at : float, optional
        Where it acts, m from the nose; default: as ``[spindle.load]`` has it. As in runs, the nose takes it
        with its moment: exact for a rigid shaft, and ahead of the first bearing.
    moment : sequence of two floats
        Moments about y and z on the shaft (N m).

    Raises
    ------
    SceneError
        If the scene cannot be read, where another model owns the shaft, and for loads given beside the
        scene's own on a single bearing.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing import statics
    >>> found = statics("examples/spindle_set/7003C-DB.toml", force=(100.0, 0.0, -60.0), at=0.0)
    >>> found.arrangement, [round(one.axial) for one in found.bearings]
    ('DB (O)', [167, 67])
    """
    scene = scene_of(scene)
    if not scene.assembly.joined:
        if force is not None or at is not None or any(moment):
            raise SceneError(
                f"{scene.name}: force, at and moment are of the shaft of a set; give the loads of a single "
                "bearing by preload_N, radial_load_y_N and radial_load_z_N of [mounting]"
            )
        return point(scene).statics
    given = set_of(scene).load
    if force is None:
        force = (given.force_x_N, given.force_y_N, given.force_z_N)
    plane = 1e-3 * given.position_mm if at is None else float(at)
    load = np.array([*(float(value) for value in (*force, *moment)), plane])
    if not np.all(np.isfinite(load)):
        raise ValueError("force, place and moment must be finite numbers")
    on_nose = rigid_transform(1.0, plane).T @ load[:FREEDOMS]
    return point(scene, {U.NOSE + k: float(part) for k, part in enumerate(on_nose)}).statics


def point(scene: Scene, inputs: Mapping[int, float] | None = None, tell: Tell = silent) -> Point:
    """Return a scene at its operating point.

    Parameters
    ----------
    scene : Scene
    inputs : mapping, optional
        Values by their places in ``u`` in place of the scene's, SI units.
    tell : callable
        Takes the warnings of the bearings.

    Raises
    ------
    SceneError
        Where another model owns the shaft.
    EngineError
        Where there is no equilibrium; a ``ValueError``.
    """
    require(scene, "statics")
    system = under_force(scene, dict(inputs or {}))
    run = started(scene, inputs, tell)
    matrices = [at_rest(bearing) for bearing in system.bearings]
    own = bent = _stiffness(scene, system, matrices)
    spacer = None
    free: dict[str, LiftOff] = {}
    if not scene.assembly.joined:
        load = np.array([*forces(run)[0, : Q.INNER_BY], 0.0, 0.0])
    else:
        members = [Member(run, k) for k in range(len(matrices))]
        load = run.u[U.NOSE : U.NOSE + FREEDOMS] + _weight(scene)
        if not set_of(scene).shaft.flexible:
            bent = _stiffness(scene, system, matrices, flexible=True)
        free, spacer = lift_off(members), neutral_spacing(scene, members)
    carried = preloads(run)
    # a solution that hardly carries is as good as none: balls are loose
    lost = [key for key, loads in carried.items() if max(map(abs, loads)) < TOUCHING]
    gaps = {} if scene.assembly.joined else {key: gap(run, key) for key in lost}
    statics = Statics(
        scene, load, nose(run), _bearings(scene, run, matrices), own, _at_nose(bent), free, carried, gaps,
        spacing(scene.bearings()), spacer, tuple(remarks(system)),
    )  # fmt: skip
    return Point(run, system, statics)


def _shaft(scene: Scene, flexible: bool) -> ShaftModel:
    """Return the shaft of a scene's set as one that bends or not, whatever the scene says."""
    spindle = set_of(scene)
    shaft = spindle.shaft.model_copy(update={"flexible": flexible})
    return shaft_model(scene, spindle.model_copy(update={"shaft": shaft}))


def _weight(scene: Scene) -> NDArray[np.float64]:
    """Weight of shaft and inner rings, moved to the nose (N, N m); zero where the scene leaves it out."""
    if not scene.fidelity.terms.gravity:
        return np.zeros(FREEDOMS)
    shaft = _shaft(scene, flexible=False)
    masses = [inner_ring(bearing.scene).mass for bearing in scene.bearings()]
    rings = sum(mass * plane[Q.Z] for mass, plane in zip(masses, shaft.planes, strict=True))
    return np.asarray(-GRAVITY * (shaft.heavy + rings))


def _at_nose(stiffness: NDArray[np.float64]) -> float:
    """Force along z at the nose per displacement there, the shaft free, N/m."""
    return float(1.0 / np.linalg.inv(stiffness)[2, 2])


def _bearings(
    scene: Scene, run: Instance, matrices: Sequence[NDArray[np.float64]]
) -> tuple[BearingLoad, ...]:  # fmt: skip
    """Return the bearings of a started scene, in shaft axes."""
    return tuple(
        BearingLoad(
            bearing.number,
            bearing.position,
            bearing.sign,
            load[: Q.INNER_BY],
            load[Q.INNER_BY :],
            part.apart,
            matrix,
            *part.balls(),
        )
        for bearing, part, load, matrix in zip(
            scene.bearings(), parts(run), forces(run), matrices, strict=True
        )
    )


def _stiffness(
    scene: Scene, system: Linearised, matrices: Sequence[NDArray[np.float64]], flexible: bool | None = None
) -> NDArray[np.float64]:  # fmt: skip
    """Return the stiffness at the nose, all else free to follow, shape (5, 5).

    ``matrices``: of the bearings in their own axes; ``flexible``: a shaft that bends or not, default: the
    scene's. A single bearing is held by its pedestal and by springs to ground.
    """
    tied, bearings = system.shaft, system.bearings
    if tied.count == 0:
        (one,), (matrix,) = bearings, matrices
        springs = one.arrays.p[P.SUPPORT_STIFFNESS : P.SUPPORT_STIFFNESS + FREEDOMS]
        return _on_pedestal(one.arrays, matrix) + np.diag(springs)
    shaft = _shaft(scene, set_of(scene).shaft.flexible if flexible is None else flexible)
    first = shaft.count
    # housing and sliding rings have no springs to the shaft
    upright = shaft.stiffness + supports(scene, shaft)[0]
    stiffness = block_diag(upright, tied.stiffness[tied.shaft_count :, tied.shaft_count :])
    for one, matrix, plane, driven, sign in zip(
        bearings, matrices, shaft.planes, tied.motions, tied.signs, strict=True
    ):
        moves = np.zeros((FREEDOMS, len(stiffness)))
        moves[:, :first] = rigid_transform(sign, 0.0) @ plane
        if len(driven) > FREEDOMS:
            moves[:, first:] = -driven[Q.OUTER :][OUTER_PLANE, tied.shaft_count :]
        else:
            matrix = _on_pedestal(one.arrays, matrix)
        stiffness += moves.T @ matrix @ moves
    own, across = stiffness[:FREEDOMS, :FREEDOMS], stiffness[:FREEDOMS, FREEDOMS:]
    if across.shape[1] == 0:
        return own
    behind = stiffness[FREEDOMS:, FREEDOMS:] + _LOOSE * np.eye(across.shape[1])
    return np.asarray(own - across @ np.linalg.solve(behind, stiffness[FREEDOMS:, :FREEDOMS]))


def _on_pedestal(arrays: Readable, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Stiffness of a bearing and the pedestal under its outer ring in series, shape (5, 5)."""
    return np.asarray(matrix - matrix @ np.linalg.solve(matrix + pedestal(arrays.s), matrix))
