"""Static load rating by ISO 76. Units N, mm."""

import math

import numpy as np

from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.formulas.iso281 import GROOVES, relative_ball

#: Pa: contact pressure at the static rating.
STATIC_PRESSURE = 4.2e9
_STEEL = (207e9, 0.3)  # modulus of elasticity in Pa, Poisson's ratio: as the standard reckons
_NEAR = 1.0  # deg
#: X0 0.5; Y0 of single rows by contact angle (deg): LYC prints 15, 25 and 40 deg, NSK (BEA) and FGFA 40 deg.
#: 30 deg is half of the 0.66 that LYC prints for double rows; 20, 35 and 45 deg are from memory.
_ANGLES, _Y0 = (15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0), (0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22)
#: X0 and Y0 of radial contact (deep groove, 0 deg): from memory of the standard; SKF prints them.
_RADIAL_X0, _RADIAL_Y0 = 0.6, 0.5
#: C0 with ceramic balls in rings of steel over that with steel balls: GMN; the moduli's ratio squared.
HYBRID = 0.70


def static_factor(g: float) -> float:
    """Return f0 (N/mm2): the load of the worse race at 4200 MPa over 5 times the ball's square.

    ``g``: D_w cos(alpha) / d_m.
    """
    modulus = effective_modulus(*_STEEL, *_STEEL)
    loads = []
    for conformity, curvature in zip(GROOVES, (g / (1.0 - g), -g / (1.0 + g)), strict=True):
        across = 1.0 / (2.0 - 1.0 / conformity)  # ball of diameter 1
        contact = point_contact(0.5 / (1.0 + curvature), across, modulus)
        loads.append(contact.stiffness * (STATIC_PRESSURE / contact.pressure) ** 3)
    return min(loads) / 5.0 * 1e-6


def static_rating(balls: int, ball: float, pitch: float, angle: float) -> float:
    """Return C0 (N) for steel balls; ball and pitch diameter in mm, contact angle in rad."""
    g = relative_ball(ball, pitch, angle)
    return static_factor(g) * balls * ball**2 * math.cos(angle)


def axial_factor(angle_deg: float) -> float | None:
    """Return Y0 of a single row, linear between the angles of the table; None below 14 and above 46 deg.

    0 deg: of a deep groove bearing.
    """
    if angle_deg == 0.0:
        return _RADIAL_Y0
    if not _ANGLES[0] - _NEAR <= angle_deg <= _ANGLES[-1] + _NEAR:
        return None
    return float(np.interp(angle_deg, _ANGLES, _Y0))


def static_load(angle_deg: float, axial: float, radial: float) -> float | None:
    """Return the static equivalent load P0 (N) of a single row; None where `axial_factor` has none."""
    y = axial_factor(angle_deg)
    x = _RADIAL_X0 if angle_deg == 0.0 else 0.5
    return None if y is None else max(radial, x * radial + y * axial)
