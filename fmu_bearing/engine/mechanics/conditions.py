"""Inputs turned into the constants of one communication step: oil, thermal sizes, pedestal."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    C_BALL_RADIUS,
    C_DAMPING,
    C_DAMPING_AXIAL,
    C_DAMPING_ROTATIONAL,
    C_DAMPING_SPIN,
    C_ECCENTRICITY,
    C_LOAD_Y,
    C_LOAD_Z,
    C_OVERSIZE_SCALE,
    C_PEDESTAL,
    C_PEDESTAL_AXIAL,
    C_PEDESTAL_ROTATIONAL,
    C_PRELOAD,
    C_RACE_SIZE,
    C_RACES,
    C_VISCOSITY,
    P_AXIAL_RATIO,
    P_BALL_EXPANSION,
    P_DIAMETER,
    P_ECCENTRICITY,
    P_IMPERFECTION_SCALE,
    P_OIL_DENSITY,
    P_OUTER_MASS,
    P_OUTER_POLAR,
    P_OUTER_TRANSVERSE,
    P_PEDESTAL_ZETA,
    P_RACES,
    P_REDUCTION,
    P_ROTATIONAL_RATIO,
    P_SHEAR_HEATING,
    P_STARVATION,
    P_VISCOSITY,
    P_VISCOSITY_LAW,
    P_VOGEL_B,
    P_VOGEL_C,
    P_WALTHER_SLOPE,
    RACE_EXPANSION,
    RACE_GROOVE,
    RACE_GROOVE_RADIUS,
    RACE_GROOVE_X,
    RACE_ROLLING,
    RACE_SIZE,
    REFERENCE_TEMPERATURE,
    U_INNER_T,
    U_LOAD_Y,
    U_LOAD_Z,
    U_OIL_T,
    U_OUTER_T,
    U_PEDESTAL,
    U_PRELOAD,
)

_TO_RPM = 30.0 / math.pi
# Both laws grow without bound in the cold: twelve decades stand for an oil that has set.
_SET = 12.0 * math.log(10.0)
_CLEAR = 1.0  # K: Vogel's law is held short of its pole by this much


@kernel
def vogel(p, temperature):
    """Dynamic viscosity (Pa s) at ``temperature`` (K): exp(B/(T - C)) through the reference point.

    Vogel (1921).
    """
    b = p[P_VOGEL_B]
    pole = p[P_VOGEL_C]
    exponent = b / max(temperature - pole, _CLEAR) - b / (REFERENCE_TEMPERATURE - pole)
    return p[P_VISCOSITY] * math.exp(min(exponent, _SET))


@kernel
def walther(p, temperature):
    """Dynamic viscosity (Pa s) at ``temperature`` (K): lg lg(v + 0.7) = A - B lg T, v in mm2/s.

    Walther (1931) as in ASTM D341; A follows from the reference viscosity, the density is constant.
    """
    to_mm2_s = 1e6 / p[P_OIL_DENSITY]
    # the law knows oils above 0.3 mm2/s only: below, the inner logarithm has no logarithm
    known = math.log(max(p[P_VISCOSITY] * to_mm2_s + 0.7, 1.0 + 1e-6))
    fall = p[P_WALTHER_SLOPE] * math.log(max(temperature, 1.0) / REFERENCE_TEMPERATURE)
    raised = known * math.exp(-fall)
    return (math.exp(min(raised, _SET)) - 0.7) / to_mm2_s


@kernel
def viscosity(p, temperature):
    """Dynamic viscosity (Pa s) of the oil at ``temperature`` (K) and ambient pressure."""
    if p[P_VISCOSITY_LAW] == 1.0:
        return walther(p, temperature)
    return vogel(p, temperature)


@kernel
def rolling_reduction(p, eta, speed):
    """Reduction of the rolling resistance by inlet shear heating and kinematic starvation.

    SKF friction model (SKF rolling bearings catalogue 2018): 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64) and
    exp(-K_rs nu n (d + D) sqrt(K_z / (2 (D - d)))), n in r/min, d_m in mm, nu in mm2/s. ``speed`` in rad/s.
    1 where the scene leaves the reduction out.
    """
    if p[P_REDUCTION] == 0.0:
        return 1.0
    n = abs(speed) * _TO_RPM
    nu = max(eta / p[P_OIL_DENSITY] * 1e6, 1e-6)
    heating = 1.0 / (1.0 + p[P_SHEAR_HEATING] * math.exp(1.28 * math.log(n + 1e-6) + 0.64 * math.log(nu)))
    return heating * math.exp(-p[P_STARVATION] * nu * n)


@kernel
def conditions(p, u, speed, c):
    """Fill ``c`` from the inputs ``u``; ``speed`` (rad/s) enters the reduction factors only.

    Rings and balls expand about the reference temperature: groove circles, groove radii and ball radius
    scale with their own body's temperature; the balls have the mean of both rings'.
    """
    eta = viscosity(p, u[U_OIL_T])
    rise_i = u[U_INNER_T] - REFERENCE_TEMPERATURE
    rise_o = u[U_OUTER_T] - REFERENCE_TEMPERATURE
    ball = 0.5 * p[P_DIAMETER] * (1.0 + p[P_BALL_EXPANSION] * 0.5 * (rise_i + rise_o))
    reduced = rolling_reduction(p, eta, speed)
    for race in range(2):
        numbers = P_RACES + race * RACE_SIZE
        held = C_RACES + race * C_RACE_SIZE
        growth = 1.0 + p[numbers + RACE_EXPANSION] * (rise_i if race == 0 else rise_o)
        c[held] = p[numbers + RACE_GROOVE_X] * growth
        c[held + 1] = p[numbers + RACE_GROOVE_RADIUS] * growth
        c[held + 2] = p[numbers + RACE_GROOVE] * growth - ball
        c[held + 3] = p[numbers + RACE_ROLLING] * math.exp(0.66 * math.log(eta)) * reduced
    c[C_BALL_RADIUS] = ball
    c[C_PRELOAD] = u[U_PRELOAD]
    c[C_LOAD_Y] = u[U_LOAD_Y]
    c[C_LOAD_Z] = u[U_LOAD_Z]
    c[C_VISCOSITY] = eta
    radial = u[U_PEDESTAL]
    axial = p[P_AXIAL_RATIO] * radial
    rotational = p[P_ROTATIONAL_RATIO] * radial
    twice = 2.0 * p[P_PEDESTAL_ZETA]
    mass = p[P_OUTER_MASS]
    c[C_PEDESTAL] = radial
    c[C_PEDESTAL_AXIAL] = axial
    c[C_PEDESTAL_ROTATIONAL] = rotational
    c[C_DAMPING] = twice * math.sqrt(radial * mass)
    c[C_DAMPING_AXIAL] = twice * math.sqrt(axial * mass)
    c[C_DAMPING_ROTATIONAL] = twice * math.sqrt(rotational * p[P_OUTER_TRANSVERSE])
    c[C_DAMPING_SPIN] = twice * math.sqrt(rotational * p[P_OUTER_POLAR])
    c[C_OVERSIZE_SCALE] = p[P_IMPERFECTION_SCALE]
    c[C_ECCENTRICITY] = p[P_IMPERFECTION_SCALE] * p[P_ECCENTRICITY]
