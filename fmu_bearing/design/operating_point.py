"""A scene's bearings at their operating point, without a run: contacts, frequencies, film, limits, life.

All figures are of perfect bearings with rigid rings in their steady state; loads and stiffness come from
`steady.statics`. Ratings and limits come from `design.rating`, with their sources.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, kinematic_frequencies
from fmu_bearing.design.heat import Heat, heat_in_all, heat_of
from fmu_bearing.design.rating import Rating, least_load, rating, reference_life, speed_limit
from fmu_bearing.design.torque_range import TorqueRange, torque_range
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import C, P, S, Y
from fmu_bearing.formulas import iso281
from fmu_bearing.instance import Instance
from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.modes.growth import self_excitation
from fmu_bearing.modal.modes.solve import may_grow, solved
from fmu_bearing.prepare.bodies import ball
from fmu_bearing.progress import Tell, silent
from fmu_bearing.results import rates
from fmu_bearing.results.balls import Readable
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene, SceneSource, scene_of, si
from fmu_bearing.scene.fit import held_loose
from fmu_bearing.scene.member import SceneBearing, still_of
from fmu_bearing.steady.rest import parts, started
from fmu_bearing.steady.statics import BearingLoad, Point, Statics, point
from fmu_bearing.threads import one_thread

RINGS = ("inner", "outer")
_CONTACTS = (
    "load_mean", "load_max", "angle_mean", "pressure_max", "spin_to_roll", "shoulder_margin",
)  # fmt: skip
_SLOPE = 10.0 / 9.0  # Weibull's exponent of point contact: Lundberg and Palmgren (1947), ISO 281


@dataclass(frozen=True)
class BearingPoint(Result):
    """Figures of one bearing at its operating point, SI units."""

    quantities = (
        "bearing [1] = load.number", "kind = scene.materials.kind", "speed_rpm = scene.operation.speed_rpm",
        "preload_N = scene.mounted.preload_N", "axial_load_N = axial", "radial_load_N = radial",
        "contact [N, rad, Pa, 1] = contacts", "displacement_m", "stiffness [N/m, N, N m/rad]",
        "frequencies_Hz = frequencies._asdict", "film_over_roughness [1] = film", "viscosity_mm2_s",
        "viscosity_ratio [1]", "speed_number_mm_rpm", "speed_limit_mm_rpm", "least_preload_N",
        "rating [N, 1] = rating._asdict", "reference_life_Mrev", "friction_torque_N_m [N m]",
        "heat_W", "gyroscopic_friction [1]",
        Quantity("ball_loads_N", of=lambda one: dict(zip(RINGS, one.ball_loads, strict=True))),
    )  # fmt: skip

    scene: Scene
    """Of this bearing alone, without sound, imperfections and bending. Of a set its preload is what it
    carries loose, at standstill and 20 degC without load on the shaft, by a constant force behind springs and
    by displacement with spacers; 0 in a set without one."""
    contacts: dict[str, dict[str, float]]
    """By ``inner`` and ``outer``: the outputs ``contact.*`` there."""
    frequencies: KinematicFrequencies
    """Hz, as cage and balls turn in the steady state."""
    film: float
    """Thinnest film over the composite roughness."""
    viscosity: float
    """Kinematic viscosity of the oil, mm2/s."""
    viscosity_ratio: float
    """That over the one ISO 281 asks for at this speed and size; NaN at standstill."""
    speed_number: float
    """n d_m, mm r/min."""
    speed_limit: float | None
    """Its limit for spring-loaded bearings of this angle, see `design.rating.speed_limit`."""
    least_preload: float
    """N: of what `holding` is, below it balls skid, see `design.rating.least_load`."""
    rating: Rating | None
    """None where no standard rates the bearing."""
    reference_life: float | None
    """Mrev: L10r by ISO 16281 from the loads of the balls; None where no standard rates the bearing."""
    friction_torque: float
    """N m: of the settled bearing, positive where it brakes positive rotation."""
    heat: Heat
    """W: what that torque loses, by where it arises and what it warms."""
    gyroscopic_friction: float
    """Coefficient of friction that keeps a ball from turning about its gyroscopic axis, mean of the balls."""
    load: BearingLoad
    """What it carries, where its ring is, the loads of its balls."""
    on_shaft: bool
    """Whether it is one of a set: the shaft holds its inner ring."""

    @property
    def stiffness(self) -> NDArray[np.float64]:
        """Forces x, y, z and moments about y, z on the inner ring per displacement and tilt, shape (5, 5).

        For frequency to 0 at the steady state, balls keeping their spacing: `BearingStiffness.static`. Rings
        of a single bearing bend as the scene has it.
        """
        return self.load.stiffness

    @property
    def axial(self) -> float:
        """Axial load (N) for its rating: 0 of a bearing that is unloaded, of a deep groove one its size."""
        return axial_of(self.scene, self.load)

    @property
    def radial(self) -> float:
        """Radial load, N, weights included."""
        return self.load.radial

    @property
    def holding(self) -> float:
        """Load (N) that keeps balls from skidding: the axial one, of a deep groove bearing all of it."""
        return math.hypot(self.axial, self.radial) if self.scene.bearing.is_deep_groove else self.axial

    @property
    def displacement(self) -> float:
        """Of the inner ring against the outer along the bearing's own axis, m."""
        return float(self.load.displacement[0])

    @property
    def ball_loads(self) -> NDArray[np.float64]:
        """Loads (N) at inner and outer race, shape (2, balls), as those of `statics`."""
        return self.load.ball_loads

    @property
    def life(self) -> float | None:
        """L10r in hours; None where no standard rates the bearing, and at standstill."""
        speed = self.scene.operation.speed_rpm
        if self.reference_life is None or speed == 0.0:
            return None
        return iso281.hours(self.reference_life, speed)

    def at_races(self, name: str) -> dict[str, float]:
        """Return an output ``contact.*`` by race."""
        return {ring: found[name] for ring, found in self.contacts.items()}


@dataclass(frozen=True)
class OperatingPoint(Result):
    """A scene's bearings at their operating point, SI units."""

    quantities = (
        "scene = scene.name", "speed_rpm = scene.operation.speed_rpm", "bearings = _with_ranges", "statics",
        "heat_W", "torque_range", "life_h", "whirl_Hz_1_s", "steady",
    )  # fmt: skip

    scene: Scene
    bearings: tuple[BearingPoint, ...]
    """From the nose on; a single bearing is the only one."""
    statics: Statics
    """What they carry, and how stiff they hold the shaft."""
    life: float | None
    """h: L10r of all bearings together; None where one has none, and at standstill."""
    whirl: tuple[float, float] | None
    """Hz, 1/s: frequency and growth of the mode by which the inner ring, or the set, whirls by itself; None
    where none grows, or where it is not known."""
    steady: bool
    """Whether a steady state was found; else no growth is known."""

    @property
    def heat(self) -> Heat:
        """Of all bearings together, W."""
        return heat_in_all(bearing.heat for bearing in self.bearings)

    @cached_property
    def torque_range(self) -> TorqueRange:
        """The range that the friction torques may have from what the scene assumes; computed when asked for.

        Raises
        ------
        EngineError
            Where there is no equilibrium; a ``ValueError``.
        """
        return torque_range(self.scene)

    @property
    def remarks(self) -> tuple[str, ...]:
        """That no steady state was found, that the pedestal is soft."""
        return self.statics.remarks

    def _with_ranges(self) -> list[dict[str, Any]]:
        """Return the bearings with the ranges of their torque (N m) and heat (W)."""
        ranges = self.torque_range
        return [
            bearing.summary() | {"friction_torque_range_N_m": torque, "heat_range_W": ranges.heat(torque)}
            for bearing, torque in zip(self.bearings, ranges.bearings, strict=True)
        ]


@one_thread
def operating_point(scene: SceneSource, tell: Tell = silent) -> OperatingPoint:
    """Return the figures of a scene's bearings at its operating point, without a run.

    Each bearing of a set is where the shaft puts it, under its own load and at its own temperatures. Friction
    torques are of settled bearings with their cages.

    Parameters
    ----------
    scene : Scene or path
    tell : callable
        Takes the warnings of the bearings.

    Raises
    ------
    SceneError
        If the file cannot be read, or another model owns the shaft.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing import operating_point
    >>> (one,) = operating_point("examples/scenes/7003C-spindle.toml").bearings
    >>> f"{1e-9 * one.contacts['inner']['pressure_max']:.2f} GPa, kappa {one.viscosity_ratio:.2f}"
    '1.89 GPa, kappa 1.79'
    >>> for one in operating_point("examples/spindle_set/7003C-DB.toml").bearings:
    ...     print(f"{one.axial:.0f} N, {1e-9 * one.contacts['inner']['pressure_max']:.2f} GPa")
    167 N, 1.54 GPa
    67 N, 1.17 GPa
    >>> print(f"{operating_point('examples/spindle_set/7003C-DB.toml').heat.total:.1f} W")
    32.9 W
    """
    scene = still_of(scene_of(scene))
    statics = point(scene, tell=tell)
    rigid = scene.with_rigid_rings()
    settled = started(scene, fidelity="response")
    bearings = tuple(
        _figures(_alone(rigid, bearing, statics.statics), bearing, part, load, statics, settled)
        for bearing, part, load in zip(
            rigid.bearings(), parts(statics.run), statics.statics.bearings, strict=True
        )
    )
    whirl, steady = _whirl(rigid, statics.system), statics.system.steady
    return OperatingPoint(scene, bearings, statics.statics, _life_of(bearings), whirl, steady)


def _whirl(scene: Scene, system: Linearised) -> tuple[float, float] | None:
    """Frequency (Hz) and growth (1/s) of what grows fastest by itself; None where none is known."""
    if not system.steady or (scene.assembly.joined and not may_grow(system.matrix)):
        return None
    return self_excitation(scene, solved(scene, system))


def _alone(scene: Scene, one: SceneBearing[Scene], statics: Statics) -> Scene:
    """Return the scene of one bearing with the preload and temperatures that it has in its set."""
    assembly, cold = scene.assembly, statics.preloads.get("cold")
    if not assembly.joined:
        return scene
    carried = 0.0 if cold is None else max(cold[one.number - 1], 0.0)
    spacer = assembly.preload is not None and assembly.preload.kind == "spacer"
    if spacer and scene.fit is not None and held_loose(scene):  # its class is that of the loose bearing
        carried = assembly.usual_N[one.number - 1]
    mounting = {"preload_N": float(f"{carried:.4g}"), "preload_mode": "rigid" if spacer else "force"}
    place = assembly.members[one.number - 1]
    rings = ("inner_ring_temperature_degC", "outer_ring_temperature_degC")
    warm = {key: getattr(place, key) for key in rings if getattr(place, key) is not None}
    return one.scene.model_copy(
        update={
            "mounting": one.scene.mounted.model_copy(update=mounting),
            "operation": one.scene.operation.model_copy(update=warm),
        }
    )


def _figures(
    scene: Scene, one: SceneBearing[Scene], part: Readable, load: BearingLoad, found: Point, settled: Instance
) -> BearingPoint:
    """Return the figures of a bearing.

    ``scene``: of the bearing alone; ``part``: its parameters and state; ``settled``: the engine where its
    torque is read.
    """

    def output(name: str) -> float:
        return found.run.get(one.prefix + name)

    contacts = {ring: {key: output(f"contact.{ring}.{key}") for key in _CONTACTS} for ring in RINGS}
    b, rpm = si(scene.bearing), scene.operation.speed_rpm
    frequencies = rates.frequencies(rpm * RPM, *rates.ball_rates(part), b.ball_count)
    mass, _ = ball(scene)
    # GMN's rule, fitted with balls that roll at one angle
    angle = 0.5 * (contacts["inner"]["angle_mean"] + contacts["outer"]["angle_mean"])
    rolling = kinematic_frequencies(rpm * RPM, b.ball_count, b.ball_diameter, b.pitch_diameter, angle)
    centrifugal = mass * 0.5 * b.pitch_diameter * (2.0 * math.pi * rolling.f_c) ** 2
    nu = 1e6 * float(part.s[S.C + C.VISCOSITY]) / scene.lubricant.density_kg_m3
    pitch = scene.bearing.pitch_diameter_mm
    return BearingPoint(
        scene, contacts, frequencies, output("film.lambda_min"), nu,
        iso281.viscosity_ratio(nu, rpm, pitch), abs(rpm) * pitch, speed_limit(scene),
        least_load(scene, centrifugal, nu), rating(scene, axial_of(scene, load), load.radial, rpm),
        reference_life(scene, *load.ball_loads), settled.get(one.prefix + "friction_torque"),
        heat_of(lambda name: settled.get(one.prefix + name), rpm * RPM, scene.bearing),
        _gyroscopic_friction(part, load.ball_loads), load, one.prefix != "",
    )  # fmt: skip


def axial_of(scene: Scene, load: BearingLoad) -> float:
    """Return the axial load (N) of a bearing for its rating, which deep groove ones carry both ways."""
    return abs(load.axial) if scene.bearing.is_deep_groove else max(0.0, load.axial)


def _gyroscopic_friction(bearing: Readable, loads: NDArray[np.float64]) -> float:
    """Coefficient 2 M_g / (D_w (Q_i + Q_o)) that holds the gyroscopic moment M_g (Harris 2006), mean."""
    j = np.arange(loads.shape[1])
    orbit, spin = bearing.s[S.Y + Y.OM + j], bearing.s[S.Y + Y.WR + j]
    moment = bearing.p[P.BALL_INERTIA] * np.abs(orbit * spin)
    carried = bearing.s[S.C + C.BALL_RADIUS] * loads.sum(axis=0)
    return float(np.mean(moment / np.maximum(carried, 1e-12)))


def _life_of(bearings: Sequence[BearingPoint]) -> float | None:
    """Return L10r (h) of all bearings together.

    Ten of a hundred sets have lost a bearing by then: with lives L, the sum of L^(-10/9) is that of the set
    (Lundberg and Palmgren 1947; Weibull's exponent 10/9 of point contact, ISO 281).
    """
    lives = [bearing.life for bearing in bearings]
    if any(life is None for life in lives):
        return None
    total = sum(life**-_SLOPE for life in lives if life is not None and math.isfinite(life))
    return float(total ** (-1.0 / _SLOPE)) if total > 0.0 else math.inf
