"""Makers' rules for spindle bearings: GMN 4000 0813 EN, and NSK's super-precision catalogue.

GMN's figures were read in a text conversion, where a digit may be wrong. They are rules for steel cages and
spindles; a bearing with other ones has other limits. Units N, mm, r/min.
"""

import math
from collections.abc import Mapping

import numpy as np

#: Preload over C of light, medium and heavy pairs by contact angle (deg): GMN.
PRELOAD_CLASSES = {15.0: (0.005, 0.015, 0.030), 25.0: (0.0085, 0.025, 0.051)}
#: Names of these classes.
CLASS_NAMES = ("light", "medium", "heavy")
#: deg: least and largest contact angle of the bearings that makers' rules are for.
ANGLES = (15.0, 25.0)
#: Load over that of a class up to which a bearing is of this class: assumed; makers print two digits.
CLASS_SLACK = 1.1
#: Share of a single bearing's speed that a rigid pair of a class reaches: GMN; NSK's lightest as light.
RIGID_SPEED = {"extra light": 0.8, "light": 0.8, "medium": 0.7, "heavy": 0.5}
#: Pa: contact pressure of makers' heaviest class, by kind of bearing (computed from their preloads).
CLASS_PRESSURE = {"steel": 1.34e9, "hybrid": 1.5e9}
# n d_m (mm r/min) of single spring-loaded bearings with oil by contact angle (deg): NSK, GMN; ceramic balls
_SPEED = {15.0: 1.75e6, 25.0: 1.5e6}
_CERAMIC_SPEED = 1.25
# with grease: NSK's limiting speeds of 60 sizes times their pitch diameters, equal within 1 %
_GREASE_SPEED = {15.0: 1.15e6, 25.0: 1.0e6}
_NEAR = 1.0  # deg
# Least axial force of a spring-loaded bearing over Z F_c tan(alpha): fitted to GMN's printed forces of 96
# bearings of 15 and 25 deg (1.08 and 1.13), which scatter by 9 %
_SPRING = 1.1

#: SKF's factor k_r of the least radial load of deep groove bearings, by dimension series; from memory.
_LEAST_RADIAL = {"18": 0.015, "19": 0.02, "10": 0.025, "02": 0.025, "03": 0.03}
_LEAST_RADIAL_OTHER = 0.025


def at_known_angle(angle_deg: float) -> bool:
    """Whether a contact angle is one that makers' rules are for."""
    return ANGLES[0] - _NEAR <= angle_deg <= ANGLES[1] + _NEAR


def preload_class(force: float, loads: Mapping[str, float]) -> str | None:
    """Return the first class that takes a preload (N) with a slack of `CLASS_SLACK`; None beyond the last.

    ``loads``: N by name, from the lightest class on.
    """
    return next((name for name, load in loads.items() if force <= CLASS_SLACK * load), None)


def preload_classes(angle_deg: float) -> tuple[float, float, float]:
    """Return the preload over C of light, medium and heavy pairs, between 15 and 25 deg in proportion."""
    angles, rows = list(PRELOAD_CLASSES), np.array(list(PRELOAD_CLASSES.values()))
    light, medium, heavy = (float(np.interp(angle_deg, angles, column)) for column in rows.T)
    return light, medium, heavy


def speed_limit(angle_deg: float, ceramic_balls: bool, grease: bool = False) -> float | None:
    """Return the n d_m (mm r/min) of single bearings on springs, with oil or grease.

    None but for 15 to 25 deg.
    """
    if not at_known_angle(angle_deg):
        return None
    speeds = _GREASE_SPEED if grease else _SPEED
    limit = float(np.interp(angle_deg, list(speeds), list(speeds.values())))
    return limit * (_CERAMIC_SPEED if ceramic_balls else 1.0)


def least_preload(balls: int, angle: float, centrifugal: float) -> float:
    """Return the axial force (N) below which balls of this centrifugal force (N) skid; angle in rad."""
    return _SPRING * balls * abs(centrifugal) * math.tan(angle)


def least_radial(series: str, nu: float, rpm: float, pitch: float) -> float:
    """Return the radial load (N) below which balls of deep groove bearings skid: SKF's rule, from memory.

    F = k_r (nu n / 1000)^(2/3) (d_m / 100)^2 kN, with the viscosity in mm2/s, r/min and the pitch diameter in
    mm; SKF lets axial preload take its place. ``series``: dimension series.
    """
    factor = _LEAST_RADIAL.get(series, _LEAST_RADIAL_OTHER)
    return 1e3 * factor * (1e-3 * nu * abs(rpm)) ** (2.0 / 3.0) * (1e-2 * pitch) ** 2
