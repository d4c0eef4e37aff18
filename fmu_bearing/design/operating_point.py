"""A bearing at its operating point, without a run: contacts, stiffness, frequencies, film, limits, life.

Everything is that of the perfect bearing with rigid rings in its steady state; the stiffness is that
of `modal.stiffness.scene_stiffness`. Ratings and limits come from `design.rating`, with their sources.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, kinematic_frequencies
from fmu_bearing.design.rating import Rating, least_preload, rating, reference_life, speed_limit
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import C, P, S, Y
from fmu_bearing.formulas.iso281 import viscosity_ratio
from fmu_bearing.instance import Instance
from fmu_bearing.modal.equations.linearised import under_force
from fmu_bearing.modal.equations.remarks import remarks
from fmu_bearing.modal.modes.natural_modes import Modes, self_excited
from fmu_bearing.modal.modes.solve import may_grow, solved
from fmu_bearing.modal.stiffness.impedance import at_rest
from fmu_bearing.prepare.bodies import ball
from fmu_bearing.prepare.model import prepare
from fmu_bearing.progress import Tell, silent
from fmu_bearing.run.balls import Readable, Reader
from fmu_bearing.scene import Scene, SceneSource, scene_of, si
from fmu_bearing.threads import one_thread

RINGS = ("inner", "outer")
_CONTACTS = (
    "load_mean", "load_max", "angle_mean", "pressure_max", "spin_to_roll", "shoulder_margin",
)  # fmt: skip


@dataclass(frozen=True)
class OperatingPoint:
    """Figures of a bearing at its operating point, SI units.

    Attributes
    ----------
    scene : Scene
        Without sound, imperfections and bending.
    contacts : dict
        By ``inner`` and ``outer``: the outputs ``contact.*`` there.
    stiffness : ndarray, shape (5, 5)
        Forces x, y, z and moments about y, z on the inner ring per displacement and tilt, for frequency to 0
        at the steady state, balls keeping their spacing: `Stiffness.static`. Rings bend as the scene has it.
    frequencies : KinematicFrequencies
        At the mean of both contact angles, Hz.
    film : float
        Thinnest film over the composite roughness.
    viscosity : float
        Kinematic viscosity of the oil, mm2/s.
    viscosity_ratio : float
        That over the one ISO 281 asks for at this speed and size; NaN at standstill.
    speed_number : float
        n d_m, mm r/min.
    speed_limit : float, optional
        Its limit for spring-loaded bearings of this angle, see `design.rating.speed_limit`.
    least_preload : float
        N: below it balls skid, see `design.rating.least_preload`.
    rating : Rating, optional
        None for what no standard rates.
    ball_loads : dict
        By ``inner`` and ``outer``: N, shape (balls,).
    reference_life : float, optional
        Mrev: L10r by ISO 16281 from these loads; None for what no standard rates.
    friction_torque : float
        N m: of the settled bearing, positive where it brakes positive rotation.
    gyroscopic_friction : float
        Coefficient of friction that keeps a ball from turning about its gyroscopic axis, mean of the balls.
    displacement : float
        m: of the inner ring against the outer along the axis.
    axial, radial : float
        N: loads that it carries.
    on_shaft : bool
        Whether it is one of a set: the shaft holds its inner ring.
    whirl : tuple of float, optional
        Hz, 1/s: frequency and growth of the mode by which the inner ring, or its set, whirls by itself; None
        where none grows, or where it is not known.
    steady : bool
        Whether a steady state was found; else no growth is known.
    remarks : tuple of str
        That no steady state was found, that the pedestal is soft; of a set `ShaftStatics` has them.
    """

    scene: Scene
    contacts: dict[str, dict[str, float]]
    stiffness: NDArray[np.float64]
    frequencies: KinematicFrequencies
    film: float
    viscosity: float
    viscosity_ratio: float
    speed_number: float
    speed_limit: float | None
    least_preload: float
    rating: Rating | None
    displacement: float
    axial: float
    radial: float
    on_shaft: bool
    ball_loads: dict[str, NDArray[np.float64]]
    reference_life: float | None
    friction_torque: float
    gyroscopic_friction: float
    whirl: tuple[float, float] | None = None
    steady: bool = True
    remarks: tuple[str, ...] = ()

    def summary(self) -> dict[str, Any]:
        """Return all figures by name, SI units, for machines."""
        return {
            "scene": self.scene.name,
            "kind": self.scene.materials.kind,
            "speed_rpm": self.scene.operation.speed_rpm,
            "preload_N": self.scene.mounted.preload_N,
            "axial_load_N": self.axial,
            "radial_load_N": self.radial,
            "contact": self.contacts,
            "displacement_m": self.displacement,
            "stiffness": self.stiffness.tolist(),
            "frequencies_Hz": self.frequencies._asdict(),
            "film_over_roughness": self.film,
            "viscosity_mm2_s": self.viscosity,
            "viscosity_ratio": self.viscosity_ratio,
            "speed_number_mm_rpm": self.speed_number,
            "speed_limit_mm_rpm": self.speed_limit,
            "least_preload_N": self.least_preload,
            "rating": None if self.rating is None else self.rating._asdict(),
            "reference_life_Mrev": self.reference_life,
            "friction_torque_N_m": self.friction_torque,
            "gyroscopic_friction": self.gyroscopic_friction,
            "whirl_Hz_1_s": self.whirl,
            "steady": self.steady,
            "ball_loads_N": {ring: loads.tolist() for ring, loads in self.ball_loads.items()},
        }


@one_thread
def operating_point(scene: SceneSource, tell: Tell = silent) -> OperatingPoint:
    """Return the figures of a scene, or that of a file, at its operating point, without a run.

    ``tell`` takes the warnings of the bearing.

    Raises
    ------
    SceneError
        If the file cannot be read.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing import operating_point
    >>> point = operating_point("examples/scenes/7003C-spindle.toml")
    >>> f"{1e-9 * point.contacts['inner']['pressure_max']:.2f} GPa, kappa {point.viscosity_ratio:.2f}"
    '1.89 GPa, kappa 1.79'
    """
    scene = scene_of(scene)
    if scene.spindle is not None:
        raise scene.unmounted("an operating point", "take `operating_points`")
    system = under_force(scene)
    scene = scene.model_copy(update={"sound": None, "imperfections": None}).with_rigid_rings()
    bearing = Instance(prepare(scene, fidelity="full"), tell=tell)
    bearing.initialise()
    settled = Instance(prepare(scene, fidelity="response"), tell=silent)
    settled.initialise()
    mounting = scene.mounted
    radial = math.hypot(mounting.radial_load_y_N, mounting.radial_load_z_N)
    torque = settled.get("friction_torque")
    return replace(
        figures(scene, bearing, bearing.get, mounting.preload_N, radial, torque, at_rest(system.bearings[0])),
        whirl=whirl_of(solved(scene, system)) if system.steady and may_grow(system.matrix) else None,
        steady=system.steady,
        remarks=tuple(remarks(system)),
    )


def whirl_of(found: Modes) -> tuple[float, float] | None:
    """Frequency (Hz) and growth (1/s) of the mode that grows fastest by itself, if one does."""
    grows = self_excited(found)
    return None if grows is None else (grows.frequency, grows.growth)


def figures(
    scene: Scene, bearing: Readable, output: Callable[[str], float], axial: float, radial: float,
    torque: float, stiffness: NDArray[np.float64], on_shaft: bool = False,
) -> OperatingPoint:  # fmt: skip
    """Return the figures of a bearing whose state is known.

    Parameters
    ----------
    scene : Scene
        Of the bearing, without sound, imperfections and bending.
    bearing : Readable
        Its parameters and state.
    output : callable
        Gives its outputs by name, in its own axes.
    axial, radial : float
        Loads (N) for its rating.
    torque : float
        Its friction torque, N m.
    stiffness : ndarray, shape (5, 5)
        As `OperatingPoint` has it.
    on_shaft : bool
        Whether it is one of a set.
    """
    contacts = {ring: {key: output(f"contact.{ring}.{key}") for key in _CONTACTS} for ring in RINGS}
    b, operation = si(scene.bearing), scene.operation
    speed = operation.speed_rpm * RPM
    angle = 0.5 * (contacts["inner"]["angle_mean"] + contacts["outer"]["angle_mean"])
    frequencies = kinematic_frequencies(speed, b.ball_count, b.ball_diameter, b.pitch_diameter, angle)
    mass, _ = ball(scene)
    centrifugal = mass * 0.5 * b.pitch_diameter * (2.0 * math.pi * frequencies.f_c) ** 2
    nu = 1e6 * float(bearing.s[S.C + C.VISCOSITY]) / scene.lubricant.density_kg_m3
    balls = Reader(bearing).read(bearing)
    loads = {"inner": balls[:, 1], "outer": balls[:, 3]}
    return OperatingPoint(
        scene, contacts, stiffness, frequencies, output("film.lambda_min"), nu,
        viscosity_ratio(nu, operation.speed_rpm, scene.bearing.pitch_diameter_mm),
        abs(operation.speed_rpm) * scene.bearing.pitch_diameter_mm, speed_limit(scene),
        least_preload(scene, centrifugal), rating(scene, axial, radial, operation.speed_rpm),
        output("inner_ring.displacement.x") - output("outer_ring.displacement.x"), axial, radial, on_shaft,
        loads, reference_life(scene, loads["inner"], loads["outer"]), torque,
        _gyroscopic_friction(bearing, loads),
    )  # fmt: skip


def _gyroscopic_friction(bearing: Readable, loads: dict[str, NDArray[np.float64]]) -> float:
    """Coefficient 2 M_g / (D_w (Q_i + Q_o)) that holds the gyroscopic moment M_g (Harris 2006), mean."""
    j = np.arange(len(loads["inner"]))
    orbit, spin = bearing.s[S.Y + Y.OM + j], bearing.s[S.Y + Y.WR + j]
    moment = bearing.p[P.BALL_INERTIA] * np.abs(orbit * spin)
    carried = bearing.s[S.C + C.BALL_RADIUS] * (loads["inner"] + loads["outer"])
    return float(np.mean(moment / np.maximum(carried, 1e-12)))
