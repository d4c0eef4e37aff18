"""Statics of a scene's set of bearings: loads, ball loads, stiffness of the shaft, limits of the preload."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import ShaftModel, shaft_model
from fmu_bearing.elastic.shaft.model import FREEDOMS
from fmu_bearing.engine.layout import SP
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.equations.remarks import remarks
from fmu_bearing.modal.stiffness.impedance import at_rest
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.member import set_of
from fmu_bearing.spindle.assembly import Assembly, assembly, weight
from fmu_bearing.spindle.axial import LiftOff, lift_off, neutral_spacing, preloads, spacing
from fmu_bearing.spindle.equilibrium import Rest, rest, stiffness_with
from fmu_bearing.spindle.member import shaft_speed
from fmu_bearing.threads import one_thread


@dataclass(frozen=True)
class BearingLoad:
    """What one bearing of a set carries, SI units, shaft axes.

    Attributes
    ----------
    number : int
        From 1 at the nose.
    position : float
        m from the nose.
    sign : int
        1 where it carries axial force on the shaft towards +X, else -1.
    force : ndarray, shape (3,)
        Of the shaft on the bearing, N.
    moment : ndarray, shape (2,)
        About y and z through its centre, N m.
    displacement : ndarray, shape (5,)
        Of the inner ring against the outer in the bearing's own axes: m, rad.
    stiffness : ndarray, shape (5, 5)
        Of the bearing in its own axes, for frequency to 0, see `Stiffness.static`.
    ball_loads, contact_angles, pressures : ndarray, shape (2, balls)
        N, rad, Pa at inner and outer race, in the bearing's own axes.
    """

    number: int
    position: float
    sign: int
    force: NDArray[np.float64]
    moment: NDArray[np.float64]
    displacement: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    ball_loads: NDArray[np.float64]
    contact_angles: NDArray[np.float64]
    pressures: NDArray[np.float64]

    @property
    def axial(self) -> float:
        """Axial load that it carries, N; never negative but for rounding."""
        return self.sign * float(self.force[0])

    @property
    def radial(self) -> float:
        """Radial load that it carries, N."""
        return math.hypot(float(self.force[1]), float(self.force[2]))

    @property
    def unloaded(self) -> int:
        """How many balls the inner race does not touch."""
        return int(np.sum(self.ball_loads[0] <= 0.0))


@dataclass(frozen=True)
class ShaftStatics:
    """A set of bearings on one shaft at rest under a load, SI units.

    Attributes
    ----------
    scene : Scene
    load : ndarray, shape (5,)
        On the shaft, moved to its nose, with weight: forces x y z (N), moments about y, z (N m).
    displacement : ndarray, shape (5,)
        Of the shaft at its nose: x y z (m), tilts about y, z (rad), with those of a housing or of pedestals
        that move. Zero is where the preloaded set stands at 20 degC and standstill, of a set that carries one
        way where its balls are in line with the grooves (in runs: where the load at the start puts it);
        thermal growth counts from the nose.
    bearings : tuple of BearingLoad
    stiffness : ndarray, shape (5, 5)
        Of the shaft at its nose, the rest of it free: rows forces and moments, columns displacements and
        tilts. Its bearings are as stiff as for frequency to 0 at their steady state.
    nose_stiffness_bending : float
        `nose_stiffness` with a shaft that bends in bearings as stiff as here, N/m; the same where the scene's
        shaft bends.
    lift_off : dict
        By direction of an axial load alone, ``+x`` and ``-x``, the load that unloads the first bearing.
    preloads : dict
        Axial load (N) of each bearing without load: ``cold``, ``warm`` (standstill), ``running``.
    spacing, neutral_spacing : float, optional
        Distance (m) of both directions' bearings, and that at which warm inner rings and shaft leave the
        preload as it is.
    residual : float
        Force out of balance, N.
    remarks : tuple of str
        That no steady state was found, that the pedestal is soft.

    Examples
    --------
    >>> from fmu_bearing import shaft_statics
    >>> found = shaft_statics("examples/spindle_set/7003C-DB.toml")
    >>> f"{1e-6 * found.axial_stiffness:.0f} N/um, neutral spacing {1e3 * found.neutral_spacing:.0f} mm"
    '48 N/um, neutral spacing 63 mm'
    """

    scene: Scene
    load: NDArray[np.float64]
    displacement: NDArray[np.float64]
    bearings: tuple[BearingLoad, ...]
    stiffness: NDArray[np.float64]
    nose_stiffness_bending: float
    lift_off: dict[str, LiftOff]
    preloads: dict[str, list[float]]
    spacing: float | None
    neutral_spacing: float | None
    residual: float
    remarks: tuple[str, ...]

    @property
    def arrangement(self) -> str:
        """What makers call the set."""
        return set_of(self.scene).arrangement

    @property
    def axial_stiffness(self) -> float:
        """Force along x per displacement, the rest held, N/m."""
        return float(self.stiffness[0, 0])

    @property
    def radial_stiffness(self) -> float:
        """Force along z per displacement, tilts held, N/m."""
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

    def table(self) -> list[dict[str, Any]]:
        """Return a row per bearing, units in the names."""
        return [
            {
                "bearing": one.number,
                "position_mm": 1e3 * one.position,
                "carries": "+x" if one.sign > 0 else "-x",
                "axial_N": one.axial,
                "force_y_N": float(one.force[1]),
                "force_z_N": float(one.force[2]),
                "moment_y_N_m": float(one.moment[0]),
                "moment_z_N_m": float(one.moment[1]),
                "ball_load_max_N": float(one.ball_loads.max()),
                "balls_unloaded": one.unloaded,
                "angle_inner_max_deg": math.degrees(float(one.contact_angles[0].max())),
                "pressure_inner_GPa": 1e-9 * float(one.pressures[0].max()),
                "pressure_outer_GPa": 1e-9 * float(one.pressures[1].max()),
            }
            for one in self.bearings
        ]

    def summary(self) -> dict[str, Any]:
        """Return all figures by name, SI units but where a name ends in a unit, for machines."""
        return {
            "scene": self.scene.name,
            "arrangement": self.arrangement,
            "speed_rpm": self.scene.operation.speed_rpm,
            "load": self.load.tolist(),
            "displacement": self.displacement.tolist(),
            "bearings": self.table(),
            "stiffness": self.stiffness.tolist(),
            "axial_stiffness_N_m": self.axial_stiffness,
            "radial_stiffness_N_m": self.radial_stiffness,
            "tilt_stiffness_N_m_rad": self.tilt_stiffness,
            "nose_stiffness_N_m": self.nose_stiffness,
            "nose_stiffness_bending_N_m": self.nose_stiffness_bending,
            "lift_off": {
                way: {"load_N": one.load, "bearing": one.bearing} for way, one in self.lift_off.items()
            },
            "preloads_N": self.preloads,
            "spacing_m": self.spacing,
            "neutral_spacing_m": self.neutral_spacing,
            "residual_N": self.residual,
            "cautions": self.cautions(),
        }

    def cautions(self) -> list[str]:
        """Return what a designer should look at, one line each."""
        found = [*self.remarks]
        for one in self.bearings:
            if one.axial < _UNLOADED:
                found.append(f"bearing {one.number} is unloaded: its balls skid at speed; raise the preload")
            elif one.unloaded:
                found.append(f"bearing {one.number}: {one.unloaded} of its balls carry nothing")
        soft, stiff = self.nose_stiffness_bending, self.nose_stiffness
        if abs(soft / stiff - 1.0) > _NOSES_DIFFER:
            found.append(
                f"the shaft is rigid here and its nose has {1e-6 * stiff:.3g} N/um; one that bends has "
                f"{1e-6 * soft:.3g} N/um: set spindle.shaft.flexible = true"
            )
        return found


_UNLOADED = 1e-3  # N
_NOSES_DIFFER = 0.2  # of the rigid shaft's nose: then its stiffness misleads a designer


@one_thread
def shaft_statics(
    scene: SceneSource, force: Sequence[float] | None = None, at: float | None = None,
    moment: Sequence[float] = (0.0, 0.0),
) -> ShaftStatics:  # fmt: skip
    """Return the equilibrium of a set of bearings on one shaft, outer rings held or on springs.

    Bearings are perfect, their rings rigid; speed and temperatures are the scene's.

    Parameters
    ----------
    scene : Scene or path
        With a table ``[spindle]``.
    force : sequence of three floats, optional
        Force x y z on the shaft (N); default: that of ``[spindle.load]``. Weight is added unless
        ``fidelity.terms.gravity`` is false.
    at : float, optional
        Where it acts, m from the nose; default: as ``[spindle.load]`` has it.
    moment : sequence of two floats
        Moments about y and z on the shaft (N m).

    Raises
    ------
    SceneError
        If the scene cannot be read or has no set.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing import shaft_statics
    >>> found = shaft_statics("examples/spindle_set/7003C-DB.toml", force=(200.0, 0.0, -300.0), at=0.0)
    >>> found.arrangement, [round(one.axial) for one in found.bearings]
    ('DB (O)', [277, 77])
    """
    scene = scene_of(scene)
    given = set_of(scene).load
    if force is None:
        force = (given.force_x_N, given.force_y_N, given.force_z_N)
    x, y, z = (float(value) for value in force)
    about_y, about_z = (float(value) for value in moment)
    plane = 1e-3 * given.position_mm if at is None else float(at)
    given_load = np.array([x, y, z, about_y, about_z, plane])
    if not np.all(np.isfinite(given_load)):
        raise ValueError("force, place and moment must be finite numbers")
    assembled = assembly(scene, shaft_speed(scene))
    rigid = replace(assembled, shaft=_shaft(scene, flexible=False))
    load, at_nose = (
        one.shaft.at(plane).T @ given_load[:FREEDOMS] + weight(one) for one in (assembled, rigid)
    )
    found = rest(assembled, load)
    # loads on the shaft as they are on its nose, without weight, which is the scene's
    nose = {SP.U_NOSE + k: float(part) for k, part in enumerate(at_nose - weight(rigid))}
    system = linearised(scene, nose)
    matrices = [at_rest(one) for one in system.bearings]
    bending = stiffness_with(assembled, _shaft(scene, flexible=True), matrices)
    return ShaftStatics(
        scene, at_nose, found.shaft[:FREEDOMS], _bearings(assembled, found, matrices),
        stiffness_with(assembled, assembled.shaft, matrices), _at_nose(bending), lift_off(assembled),
        preloads(assembled), spacing(assembled), neutral_spacing(assembled), found.residual,
        tuple(remarks(system)),
    )  # fmt: skip


def _shaft(scene: Scene, flexible: bool) -> ShaftModel:
    """Return the shaft of a scene's set as one that bends or not, whatever the scene says."""
    spindle = set_of(scene)
    shaft = spindle.shaft.model_copy(update={"flexible": flexible})
    return shaft_model(scene, spindle.model_copy(update={"shaft": shaft}))


def _at_nose(stiffness: NDArray[np.float64]) -> float:
    """Force along z at the nose per displacement there, the shaft free, N/m."""
    return float(1.0 / np.linalg.inv(stiffness)[2, 2])


def _bearings(
    assembled: Assembly, found: Rest, matrices: Sequence[NDArray[np.float64]]
) -> tuple[BearingLoad, ...]:  # fmt: skip
    """Return the bearings of a set at rest, in shaft axes."""
    bearings = []
    for k, (one, own, held) in enumerate(zip(assembled.members, found.apart, found.held, strict=True)):
        on_bearing = -one.mirror * held.force
        bearings.append(
            BearingLoad(
                k + 1,
                one.position,
                int(one.sign),
                on_bearing[:3],
                on_bearing[3:],
                own,
                matrices[k],
                held.loads,
                held.angles,
                held.pressures,
            )  # fmt: skip
        )
    return tuple(bearings)
