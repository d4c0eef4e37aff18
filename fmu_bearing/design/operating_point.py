"""A bearing at its operating point, without a run: contacts, stiffness, frequencies, film, limits, life.

Everything is that of the perfect bearing with rigid rings in its quasi-static state. Ratings and limits come
from `design.rating`, with their sources.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, kinematic_frequencies
from fmu_bearing.design.rating import Rating, kind, least_preload, preload_classes, rating, speed_limit
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import C, S
from fmu_bearing.formulas.iso281 import viscosity_ratio
from fmu_bearing.formulas.makers import CLASS_PRESSURE
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.bodies import ball
from fmu_bearing.prepare.model import prepare
from fmu_bearing.run.stiffness import stiffness
from fmu_bearing.scene import Scene, si

RINGS = ("inner", "outer")
_CONTACTS = (
    "load_mean", "load_max", "angle_mean", "pressure_max", "spin_to_roll", "shoulder_margin",
)  # fmt: skip
#: Pa: pressures beyond which races of hardened steel are marked in the long run: a rule, no standard.
HIGH_PRESSURE = 2.0e9
#: Film over roughness below which surfaces touch, and from which on they are apart (Harris 2006).
MIXED, APART = 1.0, 3.0
_LITTLE = 2.0  # deg: a groove's edge and a contact angle are known no better


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
        See `run.stiffness.stiffness`.
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
        None for rings that are not of steel.
    displacement : float
        m: of the inner ring against the outer along the axis.
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

    def summary(self) -> dict[str, Any]:
        """Return all figures by name, SI units, for machines."""
        return {
            "scene": self.scene.name,
            "kind": kind(self.scene),
            "speed_rpm": self.scene.operation.speed_rpm,
            "preload_N": self.scene.mounting.preload_N,
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
        }


def operating_point(scene: Scene) -> OperatingPoint:
    """Return the figures of a scene at its operating point.

    Raises
    ------
    EngineError
        Where there is no equilibrium.
    """
    scene = scene.model_copy(update={"sound": None, "imperfections": None}).with_rigid_rings()
    bearing = Instance(prepare(scene, fidelity="full"), tell=lambda text: None)
    bearing.initialise()
    contacts = {ring: {key: bearing.get(f"contact.{ring}.{key}") for key in _CONTACTS} for ring in RINGS}
    b, operation = si(scene.bearing), scene.operation
    speed = operation.speed_rpm * RPM
    angle = 0.5 * (contacts["inner"]["angle_mean"] + contacts["outer"]["angle_mean"])
    frequencies = kinematic_frequencies(speed, b.ball_count, b.ball_diameter, b.pitch_diameter, angle)
    mass, _ = ball(scene)
    centrifugal = mass * 0.5 * b.pitch_diameter * (2.0 * math.pi * frequencies.f_c) ** 2
    nu = 1e6 * float(bearing.s[S.C + C.VISCOSITY]) / scene.lubricant.density_kg_m3
    mounting = scene.mounting
    radial = math.hypot(mounting.radial_load_y_N, mounting.radial_load_z_N)
    return OperatingPoint(
        scene, contacts, stiffness(bearing.p, bearing.s), frequencies, bearing.get("film.lambda_min"), nu,
        viscosity_ratio(nu, operation.speed_rpm, scene.bearing.pitch_diameter_mm),
        abs(operation.speed_rpm) * scene.bearing.pitch_diameter_mm, speed_limit(scene),
        least_preload(scene, centrifugal), rating(scene, mounting.preload_N, radial, operation.speed_rpm),
        bearing.get("inner_ring.displacement.x") - bearing.get("outer_ring.displacement.x"),
    )  # fmt: skip


def cautions(point: OperatingPoint) -> list[str]:
    """Return what a designer should know: value, limit with its source, and the way out."""
    found = [*_pressure(point), *_preload(point), *_speed(point), *_film(point)]
    for ring in RINGS:
        margin = math.degrees(point.contacts[ring]["shoulder_margin"])
        if 0.0 <= margin < _LITTLE:
            found.append(
                f"shoulder: the contact ellipse of the {ring} race ends {margin:.1f} deg before its edge, "
                f"less than {_LITTLE:g} deg (assumed: what tolerances take): reduce preload or load, or give "
                "a higher shoulder"
            )
    return found


def _pressure(point: OperatingPoint) -> list[str]:
    usual = CLASS_PRESSURE.get(kind(point.scene))
    race = max(RINGS, key=lambda ring: point.contacts[ring]["pressure_max"])
    pressure = point.contacts[race]["pressure_max"]
    shown = f"contact pressure {1e-9 * pressure:.2f} GPa at the {race} race"
    if pressure > HIGH_PRESSURE:
        return [
            f"{shown}: above {1e-9 * HIGH_PRESSURE:.1f} GPa (rule of the field, no standard): reduce preload "
            "or load, take more or larger balls, or closer conformity"
        ]
    if usual is not None and pressure > usual:
        return [
            f"{shown}: above the {1e-9 * usual:.2f} GPa of makers' heaviest preload class (GMN, NSK; "
            "computed): reduce preload or load, or take a larger bearing"
        ]
    return []


def _preload(point: OperatingPoint) -> list[str]:
    preload, found = point.scene.mounting.preload_N, []
    if 0.0 < preload < point.least_preload:
        found.append(
            f"preload {preload:g} N: below the {point.least_preload:.3g} N that keep balls from skidding at "
            f"{point.scene.operation.speed_rpm:g} r/min (1.1 Z F_c tan(alpha), fitted to GMN's spring "
            "preloads): give more preload, lower speed, or lighter balls"
        )
    if point.rating is not None:
        heavy = preload_classes(point.scene)[2]
        share = preload / point.rating.dynamic
        if share > heavy:
            found.append(
                f"preload {preload:g} N: {share:.3f} C, {share / heavy:.2g} times makers' heavy class of "
                f"{heavy:.3f} C (GMN): give {heavy * point.rating.dynamic:.3g} N or less, unless it stands "
                "for a load"
            )
    return found


def _speed(point: OperatingPoint) -> list[str]:
    limit = point.speed_limit
    if limit is None or point.speed_number <= limit:
        return []
    return [
        f"speed number n d_m {1e-6 * point.speed_number:.2f}e6 mm r/min: above the {1e-6 * limit:.2f}e6 of "
        "spring-loaded bearings with oil (GMN, NSK): lower the speed, or take a smaller bearing"
    ]


def _film(point: OperatingPoint) -> list[str]:
    if point.scene.operation.speed_rpm == 0.0 or point.film >= APART:
        return []
    state = "surfaces touch" if point.film < MIXED else "surfaces touch in part"
    return [
        f"film over roughness {point.film:.2f}: below {MIXED if point.film < MIXED else APART:g} {state} "
        f"(Harris 2006; viscosity ratio of ISO 281 {point.viscosity_ratio:.2f}): take thicker or cooler oil, "
        "or smoother surfaces"
    ]
