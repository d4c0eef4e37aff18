"""Static load rating by ISO 76. Units N, mm."""

import math

from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.formulas.iso281 import GROOVES, relative_ball

#: Pa: contact pressure at the static rating.
STATIC_PRESSURE = 4.2e9
_STEEL = (207e9, 0.3)  # modulus of elasticity in Pa, Poisson's ratio: as the standard reckons
_NEAR = 1.0  # deg
# X0 0.5; Y0 of single rows by contact angle (deg): NSK
_Y0 = {15.0: 0.46, 25.0: 0.38}
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


def static_load(angle_deg: float, axial: float, radial: float) -> float | None:
    """Return the static equivalent load P0 (N) of a single row; None for other angles than 15 and 25 deg."""
    for angle, y in _Y0.items():
        if abs(angle_deg - angle) <= _NEAR:
            return max(radial, 0.5 * radial + y * axial)
    return None
