"""Makers' rules for spindle bearings: GMN 4000 0813 EN, and NSK's super-precision catalogue.

GMN's figures were read in a text conversion, where a digit may be wrong. They are rules for steel cages and
spindles; a bearing with other ones has other limits. Units N, mm, r/min.
"""

import math

import numpy as np

#: Preload over C of light, medium and heavy pairs by contact angle (deg): GMN.
PRELOAD_CLASSES = {15.0: (0.005, 0.015, 0.030), 25.0: (0.0085, 0.025, 0.051)}
#: Names of these classes.
CLASS_NAMES = ("light", "medium", "heavy")
#: Share of a single bearing's speed that a rigid pair of these classes reaches: GMN.
RIGID_SPEED = (0.8, 0.7, 0.5)
#: Pa: contact pressure of makers' heaviest class, by kind of bearing (computed from their preloads).
CLASS_PRESSURE = {"steel": 1.34e9, "hybrid": 1.5e9}
# n d_m (mm r/min) of single spring-loaded bearings with oil by contact angle (deg): NSK, GMN; ceramic balls
_SPEED = {15.0: 1.75e6, 25.0: 1.5e6}
_CERAMIC_SPEED = 1.25
_NEAR = 1.0  # deg
# Least axial force of a spring-loaded bearing over Z F_c tan(alpha): fitted to GMN's printed forces of 96
# bearings of 15 and 25 deg (1.08 and 1.13), which scatter by 9 %
_SPRING = 1.1


def preload_classes(angle_deg: float) -> tuple[float, float, float]:
    """Return the preload over C of light, medium and heavy pairs, between 15 and 25 deg in proportion."""
    angles, rows = list(PRELOAD_CLASSES), np.array(list(PRELOAD_CLASSES.values()))
    light, medium, heavy = (float(np.interp(angle_deg, angles, column)) for column in rows.T)
    return light, medium, heavy


def speed_limit(angle_deg: float, ceramic_balls: bool) -> float | None:
    """Return the n d_m (mm r/min) of single bearings on springs with oil; None beyond 25 deg."""
    if angle_deg > max(_SPEED) + _NEAR:
        return None
    limit = float(np.interp(angle_deg, list(_SPEED), list(_SPEED.values())))
    return limit * (_CERAMIC_SPEED if ceramic_balls else 1.0)


def least_preload(balls: int, angle: float, centrifugal: float) -> float:
    """Return the axial force (N) below which balls of this centrifugal force (N) skid; angle in rad."""
    return _SPRING * balls * abs(centrifugal) * math.tan(angle)
