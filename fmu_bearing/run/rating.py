"""Ratings and limits of angular contact ball bearings by ISO 281 and makers' catalogues. Units N, mm, r/min.

Sources: ISO 281 for C, P and L10, whose C was found within 0.4 % of 30 printed ratings (NSK super-precision
catalogue, series 70 and 79); ISO 76 for C0; NSK for the factors X and Y; GMN 4000 0813 EN and NSK for preload
classes, speed limits and the least axial force. Makers' figures are rules for steel cages and spindles; a
bearing with other ones has other limits.
"""

import math
from typing import NamedTuple

import numpy as np

from fmu_bearing.prepare.hertz import effective_modulus, point_contact
from fmu_bearing.scene import Scene

_BM = 1.3  # ISO 281: contemporary steel
_STATIC_PRESSURE = 4.2e9  # Pa: ISO 76
_STATIC_CONFORMITY = (0.52, 0.53)  # inner, outer: ISO 76
_STEEL = (207e9, 0.3)  # modulus of elasticity in Pa, Poisson's ratio: as ISO 76 reckons
# NSK: f0 Fa / C0, then e and Y of single rows of 15 deg (X 0.44), clamped outside
_RELATIVE = (0.178, 0.357, 0.714, 1.07, 1.43, 2.14, 3.57, 5.35)
_E_15 = (0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56)
_Y_15 = (1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00)
_X_15, _E_25, _X_25, _Y_25 = 0.44, 0.68, 0.41, 0.87
_NEAR = 1.0  # deg: how near to 15 or 25 deg these factors are used
#: Preload over C of light, medium and heavy pairs by contact angle (deg): GMN.
PRELOAD_CLASSES = {15.0: (0.005, 0.015, 0.030), 25.0: (0.0085, 0.025, 0.051)}
#: n d_m (mm r/min) of single spring-loaded bearings with oil by contact angle (deg): NSK, GMN; ceramic balls.
_SPEED = {15.0: 1.75e6, 25.0: 1.5e6}
_CERAMIC_SPEED = 1.25
# Least axial force of a spring-loaded bearing over Z F_c tan(alpha): fitted to GMN's printed forces of 96
# bearings of 15 and 25 deg (1.08 and 1.13), which scatter by 9 %
_SPRING = 1.1


class Rating(NamedTuple):
    """Load ratings (N) and life of a bearing with steel rings; ``static``: C0 by ISO 76 for steel balls."""

    dynamic: float
    static: float
    equivalent: float | None  # N: P, where the factors for its contact angle are known
    life: float | None  # h: L10


def kind(scene: Scene) -> str:
    """Return ``steel``, ``hybrid``, ``full ceramic`` or ``other``, by the materials' density and modulus."""
    materials = scene.materials
    steel = [
        7000.0 < one.density_kg_m3 < 8500.0 and 180.0 < one.youngs_modulus_GPa < 230.0
        for one in (materials.inner_ring, materials.outer_ring, materials.balls)
    ]
    ceramic = [
        one.density_kg_m3 < 6500.0 and one.youngs_modulus_GPa > 180.0
        for one in (materials.inner_ring, materials.outer_ring, materials.balls)
    ]
    if all(steel):
        return "steel"
    if all(steel[:2]) and ceramic[2]:
        return "hybrid"
    return "full ceramic" if all(ceramic) else "other"


def rating(scene: Scene, axial: float, radial: float, speed_rpm: float) -> Rating | None:
    """Return C, C0, P and L10 at an axial and a radial load (N); None for rings that are not of steel.

    The life is that of a perfect bearing in clean oil. ISO 281 rates bearings with steel rings only.
    """
    if kind(scene) not in ("steel", "hybrid"):
        return None
    dynamic, factor = _dynamic(scene), _static_factor(scene)
    bearing = scene.bearing
    static = factor * bearing.ball_count * bearing.ball_diameter_mm**2 * math.cos(_angle(scene))
    load = _equivalent(scene.bearing.contact_angle_deg, factor * axial / static, axial, radial)
    life = None
    if load is not None and load > 0.0 and speed_rpm != 0.0:
        life = (dynamic / load) ** 3 * 1e6 / (60.0 * abs(speed_rpm))
    return Rating(dynamic, static, load, life)


def speed_limit(scene: Scene) -> float | None:
    """Return the n d_m (mm r/min) to which makers run such a bearing with oil; None beyond 25 deg."""
    angle = scene.bearing.contact_angle_deg
    if angle > max(_SPEED) + _NEAR:
        return None
    limit = float(np.interp(angle, list(_SPEED), list(_SPEED.values())))
    return limit * (_CERAMIC_SPEED if kind(scene) in ("hybrid", "full ceramic") else 1.0)


def least_preload(scene: Scene, centrifugal: float) -> float:
    """Return the axial force (N) below which balls of this centrifugal force (N) skid, by GMN's catalogue."""
    return _SPRING * scene.bearing.ball_count * abs(centrifugal) * math.tan(_angle(scene))


def preload_classes(scene: Scene) -> tuple[float, float, float]:
    """Return makers' preload over C of light, medium and heavy pairs, between 15 and 25 deg in proportion."""
    angles, rows = list(PRELOAD_CLASSES), np.array(list(PRELOAD_CLASSES.values()))
    light, medium, heavy = (
        float(np.interp(scene.bearing.contact_angle_deg, angles, column)) for column in rows.T
    )
    return light, medium, heavy


def _angle(scene: Scene) -> float:
    return math.radians(scene.bearing.contact_angle_deg)


def _gamma(scene: Scene) -> float:
    bearing = scene.bearing
    return bearing.ball_diameter_mm * math.cos(_angle(scene)) / bearing.pitch_diameter_mm


def _dynamic(scene: Scene) -> float:
    """Dynamic load rating C (N) of ISO 281; its f_c as a formula lies within 0.13 % of the table."""
    g, bearing = _gamma(scene), scene.bearing
    ratio = 1.04 * ((1.0 - g) / (1.0 + g)) ** 1.72
    factor = 38.20 * (1.0 + ratio ** (10.0 / 3.0)) ** -0.3
    factor *= g**0.3 * (1.0 - g) ** 1.39 / (1.0 + g) ** (1.0 / 3.0) * 26.0**0.41
    size = bearing.ball_diameter_mm
    growth = size**1.8 if size <= 25.4 else 3.647 * size**1.4
    return _BM * factor * math.cos(_angle(scene)) ** 0.7 * bearing.ball_count ** (2.0 / 3.0) * growth


def _static_factor(scene: Scene) -> float:
    """Factor f0 (N/mm2) of ISO 76: the load of the worse race at 4200 MPa over 5 times the ball's square."""
    g, modulus = _gamma(scene), effective_modulus(*_STEEL, *_STEEL)
    loads = []
    for conformity, curvature in zip(_STATIC_CONFORMITY, (g / (1.0 - g), -g / (1.0 + g)), strict=True):
        across = 1.0 / (2.0 - 1.0 / conformity)  # ball of diameter 1
        contact = point_contact(0.5 / (1.0 + curvature), across, modulus)
        loads.append(contact.stiffness * (_STATIC_PRESSURE / contact.pressure) ** 3)
    return min(loads) / 5.0 * 1e-6


def _equivalent(angle: float, relative: float, axial: float, radial: float) -> float | None:
    """Dynamic equivalent load P (N) of a single row; None for another contact angle than 15 or 25 deg."""
    if abs(angle - 15.0) <= _NEAR:
        limit, x = float(np.interp(relative, _RELATIVE, _E_15)), _X_15
        y = float(np.interp(relative, _RELATIVE, _Y_15))
    elif abs(angle - 25.0) <= _NEAR:
        limit, x, y = _E_25, _X_25, _Y_25
    else:
        return None
    return radial if axial <= limit * radial else x * radial + y * axial
