"""Inputs turned into the constants of one communication step: oil, thermal sizes, pedestal."""

import math

from fmu_bearing.engine.choices import OUTER_GUIDED, WALTHER
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import DE, MAX_DEFECTS, C, P, U
from fmu_bearing.engine.mechanics.inlet import REGIME_SPEED, inlet_powers

_TO_RPM = 30.0 / math.pi
# Both laws grow without bound in the cold: the exponent ends at twelve decades, an oil that flows no more.
_SET = 12.0 * math.log(10.0)
_CLEAR = 1.0  # K: Vogel's law is held short of its pole by this much
_SHEARED = 0.64  # power of the viscosity in what inlet shear heating takes of the rolling resistance
_STILL = 1e-15  # m: growth
_ROUNDS = 8  # of Newton's method: 1e-12 after six
_HALVINGS = 80  # of the range of a film's heating, at most 1e10 K in the coldest oil
_NEARBY = 0.1  # K
_LEFT = 0.1  # of a land's clearance: the least that growth leaves


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
def thinning(p, temperature):
    """Return what a kelvin takes of the logarithm of the viscosity (1/K) at ``temperature`` (K)."""
    warmer, colder = viscosity(p, temperature + _NEARBY), viscosity(p, temperature - _NEARBY)
    return math.log(colder / warmer) / (2.0 * _NEARBY)


@kernel
def sheared_viscosity(p, temperature, slide):
    """Viscosity (Pa s) of a film between walls at ``temperature`` (K) that slide (m/s) and heat it.

    Root of eta = eta(T + eta v^2/(12 k)), the mean rise of plane Couette flow. The rise lies between none and
    that of the unheated oil; halving that range needs no slope and ends in oil of any thickness.
    """
    per = slide * slide / (12.0 * p[P.OIL_CONDUCTIVITY])
    low = 0.0
    high = viscosity(p, temperature) * per
    for _ in range(_HALVINGS):
        rise = 0.5 * (low + high)
        if viscosity(p, temperature + rise) * per > rise:
            low = rise
        else:
            high = rise
    return viscosity(p, temperature + 0.5 * (low + high))


@kernel
def thickest_useful(power, heated, starved, nu):
    """Viscosity (mm2/s) of the largest rolling resistance, or ``nu`` if that lies below it.

    Resistance goes as nu^power exp(-starved nu)/(1 + heated nu^0.64); its logarithm rises with the one of nu
    by power - 0.64 x/(1 + x) - starved nu, x = heated nu^0.64. Newton's method in the logarithm of nu comes
    down from where the first and the last part cancel; ``power`` above 0.64.
    """
    x = heated * math.exp(_SHEARED * math.log(nu))
    if starved * nu + _SHEARED * x / (1.0 + x) <= power:
        return nu
    at = math.log(min(nu, power / starved))
    for _ in range(_ROUNDS):
        x = heated * math.exp(_SHEARED * at)
        share = x / (1.0 + x)
        dry = starved * math.exp(at)
        at -= (dry + _SHEARED * share - power) / (dry + _SHEARED * _SHEARED * share / (1.0 + x))
    return math.exp(at)


@kernel
def rolling_reduction(p, eta, speed):
    """Viscosity that rolling feels over the oil's, and what shear heating and starvation leave of its force.

    SKF friction model (SKF rolling bearings catalogue 2018): 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64) and
    exp(-K_rs nu n (d + D) sqrt(K_z / (2 (D - d)))), n in r/min, d_m in mm, nu in mm2/s. ``speed`` in rad/s.
    1, 1, 1 where the scene leaves the reduction out.

    In cold oil the second factor would make the rolling resistance fall as the oil gets thicker. Held, the
    largest resistance over viscosity stays from there on: rolling feels no thicker oil. Its place is that of
    the law's EHL force; between the regimes a contact's own largest lies beside it, by its load.
    """
    if p[P.REDUCTION] == 0.0:
        return 1.0, 1.0, 1.0
    n = abs(speed) * _TO_RPM
    nu = max(eta / p[P.OIL_DENSITY] * 1e6, 1e-6)
    fast = 1.28 * math.log(n + 1e-6)
    felt = 1.0
    if p[P.STARVATION_HELD] != 0.0:
        power, _, _, _ = inlet_powers(p[P.ROLLING_LAW])
        useful = thickest_useful(power, p[P.SHEAR_HEATING] * math.exp(fast), p[P.STARVATION] * n, nu)
        felt = useful / nu
        nu = useful
    heating = 1.0 / (1.0 + p[P.SHEAR_HEATING] * math.exp(fast + _SHEARED * math.log(nu)))
    return felt, heating, math.exp(-p[P.STARVATION] * nu * n)


@kernel
def expand_races(p, u, speed, c):
    """Move the races by what fits and rotation at ``speed`` (rad/s) make them grow.

    A fit takes part of the interference to the race while it holds; loose, a ring grows by its own rotation
    alone.
    """
    for race in range(2):
        numbers = P.RACES + race * P.RACE_SIZE
        raceway = C.RACES + race * C.RACE_SIZE
        ring = (u[U.INNER_T] if race == 0 else u[U.OUTER_T]) - REFERENCE_TEMPERATURE
        partner = (u[U.SHAFT_T] if race == 0 else u[U.HOUSING_T]) - REFERENCE_TEMPERATURE
        tight = 0.5 * (p[P.INTERFERENCE + race] + p[numbers + P.RACE_FIT_OWN])
        tight += p[numbers + P.RACE_FIT_RING] * ring + p[numbers + P.RACE_FIT_PARTNER] * partner
        tight += p[numbers + P.RACE_FIT_SPIN] * speed * speed
        growth = p[numbers + P.RACE_FIT_SHARE] * max(tight, 0.0) + p[numbers + P.RACE_SPIN] * speed * speed
        c[raceway + C.INTERFERENCE] = tight
        c[raceway + C.GROWTH] = growth
        c[raceway + C.GROOVE_RADIUS] += growth
        c[raceway + C.GROOVE_START] = c[raceway + C.GROOVE_RADIUS]


@kernel
def regrow(p, u, speed, c):
    """Let the races in ``c``, which are mounted, grow to another ``speed`` (rad/s)."""
    for race in range(2):
        raceway = C.RACES + race * C.RACE_SIZE
        c[raceway + C.GROOVE_RADIUS] -= c[raceway + C.GROWTH]
    expand_races(p, u, speed, c)


@kernel
def ramp(p, u, speed, now, c, h):
    """Let the races in ``c`` grow, in the time ``h`` (s), from what they are in ``now`` to ``speed`` (rad/s).

    Growth that changed at communication points alone would sound at their rate.
    """
    regrow(p, u, speed, c)
    for race in range(2):
        raceway = C.RACES + race * C.RACE_SIZE
        away = c[raceway + C.GROWTH] - now[raceway + C.GROWTH]
        # rounding is not worth a rate, which would cost an evaluation each step
        if abs(away) > _STILL:
            c[raceway + C.GROWTH_RATE] = away / h
            c[raceway + C.GROWTH] = now[raceway + C.GROWTH]
            c[raceway + C.GROOVE_RADIUS] -= away
            c[raceway + C.GROOVE_START] = c[raceway + C.GROOVE_RADIUS]


@kernel
def grow_to(c, t):
    """Let the races be those of the time ``t`` (s) after the state."""
    for race in range(2):
        raceway = C.RACES + race * C.RACE_SIZE
        c[raceway + C.GROOVE_RADIUS] = c[raceway + C.GROOVE_START] + t * c[raceway + C.GROWTH_RATE]


@kernel
def grow_on(c, h):
    """Move the races on with the state by the time ``h`` (s)."""
    for race in range(2):
        raceway = C.RACES + race * C.RACE_SIZE
        grown = h * c[raceway + C.GROWTH_RATE]
        c[raceway + C.GROWTH] += grown
        c[raceway + C.GROOVE_START] += grown
        c[raceway + C.GROOVE_RADIUS] = c[raceway + C.GROOVE_START]


@kernel
def take_fit_growth_out(p, c):
    """Take the growth by fits out of ``c`` where the preload is that of the loose bearing."""
    if p[P.UNMOUNTED] == 0.0:
        return
    for race in range(2):
        raceway = C.RACES + race * C.RACE_SIZE
        c[raceway + C.GROOVE_RADIUS] -= c[raceway + C.GROWTH]
        c[raceway + C.GROWTH] = 0.0


@kernel
def grown_clearance(p, u, speed, c):
    """Clearance (m) of the cage in its lands at ``speed`` (rad/s); the races in ``c`` have grown.

    The cage has the mean of both rings' temperatures, as the balls; it keeps a tenth of its clearance.
    The ring's shoulders grow by fit and rotation as much as its race.
    """
    drawn = p[P.LAND_CLEARANCE]
    if p[P.LAND_BY_RACE] == 0.0:
        return drawn
    rise_i = u[U.INNER_T] - REFERENCE_TEMPERATURE
    rise_o = u[U.OUTER_T] - REFERENCE_TEMPERATURE
    outside = p[P.GUIDANCE] == OUTER_GUIDED
    race = C.RACES + C.RACE_SIZE if outside else C.RACES
    gained = p[P.LAND_BY_RACE] * c[race + C.GROWTH]
    gained += p[P.LAND_BY_RING] * (rise_o if outside else rise_i)
    gained += p[P.LAND_BY_CAGE] * 0.5 * (rise_i + rise_o) + p[P.LAND_BY_SPEED] * speed * speed
    return max(drawn + gained, _LEFT * drawn)


@kernel
def defect_scales(p, pb, c):
    """Scales of the local defects of a bearing, with the parameters ``pb``, from the choices in ``p``."""
    for k in range(int(pb[P.DEFECTS])):
        number = int(pb[int(pb[P.AT_DEFECTS]) + k * DE.SIZE + DE.NUMBER])
        c[C.DEFECT_SCALE + k] = p[P.DEFECT_SCALE + number]


@kernel
def conditions(p, u, speed, c):
    """Fill ``c`` from the inputs ``u``; ``speed`` (rad/s) enters reduction factors, lands and fits.

    Rings and balls expand about the reference temperature: groove circles, groove radii and ball radius
    scale with their own body's temperature; the balls have the mean of both rings'.
    """
    eta = viscosity(p, u[U.OIL_T])
    rise_i = u[U.INNER_T] - REFERENCE_TEMPERATURE
    rise_o = u[U.OUTER_T] - REFERENCE_TEMPERATURE
    ball = 0.5 * p[P.DIAMETER] * (1.0 + p[P.BALL_EXPANSION] * 0.5 * (rise_i + rise_o))
    felt, heating, starving = rolling_reduction(p, eta, speed)
    elastic, _, rigid, _ = inlet_powers(p[P.ROLLING_LAW])
    thick, thin = math.log(eta), math.log(felt)
    for race in range(2):
        numbers = P.RACES + race * P.RACE_SIZE
        raceway = C.RACES + race * C.RACE_SIZE
        growth = 1.0 + p[numbers + P.RACE_EXPANSION] * (rise_i if race == 0 else rise_o)
        c[raceway + C.GROOVE_X] = p[numbers + P.RACE_GROOVE_X] * growth
        c[raceway + C.GROOVE_RADIUS] = p[numbers + P.RACE_GROOVE_RADIUS] * growth
        c[raceway + C.FREE] = p[numbers + P.RACE_GROOVE] * growth - ball
        c[raceway + C.INTERFERENCE] = 0.0
        c[raceway + C.GROWTH] = 0.0
        c[raceway + C.GROWTH_RATE] = 0.0
        c[raceway + C.GROOVE_START] = c[raceway + C.GROOVE_RADIUS]
        reduced = math.exp(elastic * thin) * heating * starving
        c[raceway + C.ROLLING] = p[numbers + P.RACE_ROLLING] * math.exp(elastic * thick) * reduced
        reduced = math.exp(rigid * thin) * heating * starving
        c[raceway + C.RIGID] = p[numbers + P.RACE_RIGID] * math.exp(rigid * thick) * reduced
        c[raceway + C.REGIME] = p[numbers + P.RACE_REGIME] * math.exp(REGIME_SPEED * (thick + thin))
    if p[P.FITS] != 0.0:
        expand_races(p, u, speed, c)
    c[C.BALL_RADIUS] = ball
    c[C.POCKET] = p[P.POCKET_STIFFNESS]
    c[C.NEUTRAL_Y] = 0.0
    c[C.NEUTRAL_Z] = 0.0
    c[C.PRELOAD] = u[U.PRELOAD]
    c[C.LOAD_Y] = u[U.LOAD_Y]
    c[C.LOAD_Z] = u[U.LOAD_Z]
    c[C.VISCOSITY] = eta
    c[C.LAND_VISCOSITY] = p[P.LAND_VISCOSITY]
    if p[P.LAND_SLIDE] != 0.0:
        c[C.LAND_VISCOSITY] = sheared_viscosity(p, u[U.OIL_T], p[P.LAND_SLIDE] * speed)
    c[C.LAND_CLEARANCE] = grown_clearance(p, u, speed, c)
    c[C.THINNING] = thinning(p, u[U.OIL_T]) if p[P.THERMAL_TRACTION] != 0.0 else 0.0
    radial = u[U.PEDESTAL]
    axial = p[P.AXIAL_RATIO] * radial
    rotational = p[P.ROTATIONAL_RATIO] * radial
    twice = 2.0 * p[P.PEDESTAL_ZETA]
    mass = p[P.OUTER_MASS]
    c[C.PEDESTAL] = radial
    c[C.PEDESTAL_Y] = radial * p[P.PEDESTAL_Y]
    c[C.PEDESTAL_Z] = radial * p[P.PEDESTAL_Z]
    c[C.PEDESTAL_YZ] = radial * p[P.PEDESTAL_YZ]
    c[C.PEDESTAL_AXIAL] = axial
    c[C.PEDESTAL_ROTATIONAL] = rotational
    damping = twice * math.sqrt(radial * mass)
    c[C.DAMPING_Y] = damping * p[P.PEDESTAL_DAMPING_Y]
    c[C.DAMPING_Z] = damping * p[P.PEDESTAL_DAMPING_Z]
    c[C.DAMPING_YZ] = damping * p[P.PEDESTAL_DAMPING_YZ]
    c[C.DAMPING_AXIAL] = twice * math.sqrt(axial * mass)
    c[C.DAMPING_ROTATIONAL] = twice * math.sqrt(rotational * p[P.OUTER_TRANSVERSE])
    c[C.DAMPING_SPIN] = twice * math.sqrt(rotational * p[P.OUTER_POLAR])
    c[C.OVERSIZE_SCALE] = p[P.IMPERFECTION_SCALE]
    for i in range(MAX_DEFECTS):
        c[C.DEFECT_SCALE + i] = 0.0
    defect_scales(p, p, c)
    c[C.ECCENTRICITY] = p[P.IMPERFECTION_SCALE] * p[P.ECCENTRICITY]
    c[C.CAGE_ECCENTRICITY] = p[P.IMPERFECTION_SCALE] * p[P.CAGE_ECCENTRICITY]
