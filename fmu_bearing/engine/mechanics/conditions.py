"""Inputs turned into the constants of one communication step: oil, thermal sizes, pedestal."""

import math

from fmu_bearing.engine.choices import WALTHER
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, P, U

_TO_RPM = 30.0 / math.pi
# Both laws grow without bound in the cold: the exponent ends at twelve decades, an oil that flows no more.
_SET = 12.0 * math.log(10.0)
_CLEAR = 1.0  # K: Vogel's law is held short of its pole by this much


@kernel
def vogel(p, temperature):
    """Dynamic viscosity (Pa s) at ``temperature`` (K): exp(B/(T - C)) through the reference point.

    Vogel (1921).
    """
    b = p[P.VOGEL_B]
    pole = p[P.VOGEL_C]
    exponent = b / max(temperature - pole, _CLEAR) - b / (REFERENCE_TEMPERATURE - pole)
    return p[P.VISCOSITY] * math.exp(min(exponent, _SET))


@kernel
def walther(p, temperature):
    """Dynamic viscosity (Pa s) at ``temperature`` (K): lg lg(v + 0.7) = A - B lg T, v in mm2/s.

    Walther (1931) as in ASTM D341; A follows from the reference viscosity, the density is constant.
    """
    to_mm2_s = 1e6 / p[P.OIL_DENSITY]
    # the law holds above 0.3 mm2/s only: below, ln(v + 0.7) is negative and has no logarithm
    known = math.log(max(p[P.VISCOSITY] * to_mm2_s + 0.7, 1.0 + 1e-6))
    fall = p[P.WALTHER_SLOPE] * math.log(max(temperature, 1.0) / REFERENCE_TEMPERATURE)
    raised = known * math.exp(-fall)
    return (math.exp(min(raised, _SET)) - 0.7) / to_mm2_s


@kernel
def viscosity(p, temperature):
    """Dynamic viscosity (Pa s) of the oil at ``temperature`` (K) and ambient pressure."""
    if p[P.VISCOSITY_LAW] == WALTHER:
        return walther(p, temperature)
    return vogel(p, temperature)


@kernel
def rolling_reduction(p, eta, speed):
    """Reduction of the rolling resistance by inlet shear heating and kinematic starvation.

    SKF friction model (SKF rolling bearings catalogue 2018): 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64) and
    exp(-K_rs nu n (d + D) sqrt(K_z / (2 (D - d)))), n in r/min, d_m in mm, nu in mm2/s. ``speed`` in rad/s.
    1 where the scene leaves the reduction out.
    """
    if p[P.REDUCTION] == 0.0:
        return 1.0
    n = abs(speed) * _TO_RPM
    nu = max(eta / p[P.OIL_DENSITY] * 1e6, 1e-6)
    heating = 1.0 / (1.0 + p[P.SHEAR_HEATING] * math.exp(1.28 * math.log(n + 1e-6) + 0.64 * math.log(nu)))
    return heating * math.exp(-p[P.STARVATION] * nu * n)


@kernel
def conditions(p, u, speed, c):
    """Fill ``c`` from the inputs ``u``; ``speed`` (rad/s) enters the reduction factors only.

    Rings and balls expand about the reference temperature: groove circles, groove radii and ball radius
    scale with their own body's temperature; the balls have the mean of both rings'.
    """
    eta = viscosity(p, u[U.OIL_T])
    rise_i = u[U.INNER_T] - REFERENCE_TEMPERATURE
    rise_o = u[U.OUTER_T] - REFERENCE_TEMPERATURE
    ball = 0.5 * p[P.DIAMETER] * (1.0 + p[P.BALL_EXPANSION] * 0.5 * (rise_i + rise_o))
    reduced = rolling_reduction(p, eta, speed)
    for race in range(2):
        numbers = P.RACES + race * P.RACE_SIZE
        held = C.RACES + race * C.RACE_SIZE
        growth = 1.0 + p[numbers + P.RACE_EXPANSION] * (rise_i if race == 0 else rise_o)
        c[held + C.GROOVE_X] = p[numbers + P.RACE_GROOVE_X] * growth
        c[held + C.GROOVE_RADIUS] = p[numbers + P.RACE_GROOVE_RADIUS] * growth
        c[held + C.FREE] = p[numbers + P.RACE_GROOVE] * growth - ball
        c[held + C.ROLLING] = p[numbers + P.RACE_ROLLING] * math.exp(0.66 * math.log(eta)) * reduced
    c[C.BALL_RADIUS] = ball
    c[C.PRELOAD] = u[U.PRELOAD]
    c[C.LOAD_Y] = u[U.LOAD_Y]
    c[C.LOAD_Z] = u[U.LOAD_Z]
    c[C.VISCOSITY] = eta
    radial = u[U.PEDESTAL]
    axial = p[P.AXIAL_RATIO] * radial
    rotational = p[P.ROTATIONAL_RATIO] * radial
    twice = 2.0 * p[P.PEDESTAL_ZETA]
    mass = p[P.OUTER_MASS]
    c[C.PEDESTAL] = radial
    c[C.PEDESTAL_AXIAL] = axial
    c[C.PEDESTAL_ROTATIONAL] = rotational
    c[C.DAMPING] = twice * math.sqrt(radial * mass)
    c[C.DAMPING_AXIAL] = twice * math.sqrt(axial * mass)
    c[C.DAMPING_ROTATIONAL] = twice * math.sqrt(rotational * p[P.OUTER_TRANSVERSE])
    c[C.DAMPING_SPIN] = twice * math.sqrt(rotational * p[P.OUTER_POLAR])
    c[C.OVERSIZE_SCALE] = p[P.IMPERFECTION_SCALE]
    c[C.ECCENTRICITY] = p[P.IMPERFECTION_SCALE] * p[P.ECCENTRICITY]
