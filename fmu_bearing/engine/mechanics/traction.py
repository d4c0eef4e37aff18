"""Traction laws beside the regularised one of ``race``: Eyring's, the multi-source paper's, heated oil.

Both take the sliding from the rows that ``race.normal_contact`` wrote, walk over the same strips across the
major axis and leave their result in the rows of ``race.traction``. Their film is the central one of Hamrock
and Dowson (1977) at the contact's present entrainment speed.
"""

import math

from fmu_bearing.engine.choices import EYRING, REGULARISED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, P, R, W

_ROELANDS_PRESSURE = 1.96e8  # Pa, Roelands (1966)
_ROELANDS_VISCOSITY = 9.67  # -log of the viscosity (Pa s) to which all his isotherms run
_LARGEST_EXPONENT = 40.0  # 2e17 times ambient: a glass; keeps every product below far from overflow
_THINNEST = 1e-9  # m, added to the film: a molecular layer stays at standstill
_SLOWEST_2 = 1e-8  # m2/s2: entrainment rounded over 1e-4 m/s, as in the rolling resistance
_LIGHTEST = 1e-3  # N: the film formula's load, where a contact opens
_STILL_2 = 1e-40  # m2/s2: only keeps 0/0 away
_NOWHERE = 1e-30  # m2: and the same of an open contact
_PRESSED_2 = 1e-60  # N2: only keeps 0/0 away
_FLASH = 4.0 / 3.0 * math.sqrt(2.0 / math.pi)  # 1.064
_ROUNDS = 8  # of Newton's method, which comes from above: 1e-15 after six


@kernel
def roelands_depth(eta):
    """Logarithm of the viscosity ``eta`` (Pa s) over Roelands' common one; floored, for 1e-4 Pa s or less."""
    return max(math.log(eta) + _ROELANDS_VISCOSITY, 0.5)


@kernel
def roelands_index(alpha, eta):
    """Roelands' exponent Z that gives the pressure-viscosity coefficient ``alpha`` (1/Pa) at p = 0."""
    return alpha * _ROELANDS_PRESSURE / roelands_depth(eta)


@kernel
def viscosity_under_pressure(eta, index, pressure):
    """Viscosity (Pa s) at ``pressure`` (Pa), ``eta`` at ambient; Roelands (1966), exponent capped.

    eta exp((ln eta + 9.67) ((1 + p / 1.96e8)^Z - 1)).
    """
    growth = math.exp(index * math.log(1.0 + pressure * (1.0 / _ROELANDS_PRESSURE))) - 1.0
    return eta * math.exp(min(roelands_depth(eta) * growth, _LARGEST_EXPONENT))


@kernel
def central_film(factor, eta, entrain, load):
    """Central film thickness (m); Hamrock and Dowson (1977), ``factor`` holds all but eta u and Q.

    Speed and load have floors and the film a molecular layer, so that standstill and an opening contact
    stay finite.
    """
    speed = eta * math.sqrt(entrain * entrain + _SLOWEST_2)
    return _THINNEST + factor * math.exp(0.67 * math.log(speed) - 0.067 * math.log(load + _LIGHTEST))


@kernel
def eyring_drag(area, eta, film, stress, limit, slide_2):
    """Eyring force over sliding speed (N s/m) of one strip, bounded smoothly by ``limit`` (N).

    S = A tau_0 asinh(eta v / (h tau_0)) and F = S / sqrt(1 + (S / limit)^2); ``slide_2`` is v squared.
    The asinh goes through log(1 + .), so that it is exact where v vanishes.
    """
    slide = math.sqrt(slide_2 + _STILL_2)
    x = eta * slide / (film * stress)
    shear = area * stress * math.log1p(x + x * x / (1.0 + math.sqrt(1.0 + x * x)))
    return shear * limit / (slide * math.sqrt(shear * shear + limit * limit + _PRESSED_2))


@kernel
def eyring_strip(area, eta, film, stress, limit, ut, um, turning, reach, across, floor_2):
    """Eyring force of a strip over its sliding (N s/m); second, times a^2 and spin, the moment of its own.

    ``turning``: spin times the semi-major axis a (m/s). Spin makes the sliding vary within a strip. Eyring's
    stress saturates within 0.1 mm/s, so a strip taken at its middle would stick and slip where the contact
    as a whole slides smoothly. Its sliding therefore includes spin times half its width, ``reach`` over a,
    and times the mean square of the place across it, ``across`` over a^2. That brings five strips from four
    times to within a tenth of the whole ellipse's pull at small sliding with spin. The floor of the
    regularised law's slip scale counts as sliding too: at standstill, where no spin is left, the law
    would otherwise switch within a thin film's 1 um/s.
    """
    slide_2 = floor_2 + ut * ut + um * um + (reach * reach + across) * turning * turning
    drag = eyring_drag(area, eta, film, stress, limit, slide_2)
    # along the strip only what turns the sliding counts: the stress hardly changes
    steady = ut * ut / (slide_2 + _STILL_2)
    return drag, drag * (reach * reach / 3.0 * (1.0 - steady) + across)


@kernel
def strip_area(half_length, half_width, share, node):
    """Area (m2) of the strip that carries ``share`` of the load at ``node`` of the major axis.

    Strip load over strip pressure: share Q / (pi/4 p0 sqrt(1 - xi^2)) with p0 = 3 Q / (2 pi a b).
    """
    return (8.0 / 3.0) * half_length * half_width * share / math.sqrt(1.0 - node * node)


@kernel
def heated_share(x):
    """Share s of the traction that is left where it heats its own oil: s = 1/sqrt(1 + x s), x 0 or more.

    ``x``: what a kelvin takes of the viscosity's logarithm, times the rise under the whole traction.
    """
    s = math.exp(-math.log(x) / 3.0) if x > 1.0 else 1.0
    for _ in range(_ROUNDS):
        s -= (s * s * (1.0 + x * s) - 1.0) / (s * (2.0 + 3.0 * x * s))
    return s


@kernel
def warming(half_width, entrain, effusivity, film, conductivity):
    """Rise (K) of the oil over the heat flux (W/m2) of friction, mean over a strip of the contact.

    Flash of both surfaces, which share the flux so that they are equally warm: 1.064 q sqrt(b/u)/(e_1 + e_2)
    (Carslaw and Jaeger 1959: a strip 2 b wide on a half-space, mean over the strip), and mean of the film
    between them, q h/(12 k).
    """
    speed = math.sqrt(entrain * entrain + _SLOWEST_2)
    return _FLASH * math.sqrt(half_width / speed) / effusivity + film / (12.0 * conductivity)


@kernel
def lubricated_traction(p, c, lanes, race, w):
    """Traction by ``P.TRACTION_LAW``: `eyring`, `regularised`, or `paper`, that paper's eta V S / h.

    Eyring (1936) with Roelands' viscosity at the strip's mean pressure, bounded by mu Q of the strip. The
    paper's law takes the ambient viscosity and has no bound; alone it is unusable (traction over load 3e-5
    at speed: it cannot drive a ball). Forces along e_t and e_m and moments on the ball, as ``traction``.

    With ``P.THERMAL_TRACTION`` friction heats the oil that it shears, and each strip keeps `heated_share`.
    """
    row = W.RACE + race * R.SIZE
    numbers = P.RACES + race * P.RACE_SIZE
    per_profile = 0.5 / p[numbers + P.RACE_PROFILE_RADIUS]
    width = p[numbers + P.RACE_HALF_WIDTH] / p[numbers + P.RACE_HALF_LENGTH]
    pressure = 0.25 * math.pi * p[numbers + P.RACE_PRESSURE] / p[numbers + P.RACE_HALF_LENGTH]
    factor = p[numbers + P.RACE_CENTRAL_FILM]
    eta = c[C.VISCOSITY]
    index = roelands_index(p[P.PRESSURE_VISCOSITY], eta)
    stress = p[P.EYRING_STRESS]
    law = p[P.TRACTION_LAW]
    heated = p[P.THERMAL_TRACTION] != 0.0
    effusivity = p[numbers + P.RACE_EFFUSIVITY]
    thinning = c[C.THINNING]
    floor_2 = p[P.TRACTION_FLOOR] * p[P.TRACTION_FLOOR]
    across = 0.25 * width * width
    mu = p[P.MU]
    strips = int(p[P.STRIPS])
    nodes = int(p[P.AT_STRIPS])
    for j in range(lanes):
        half = w[row + R.HALF + j]
        load = w[row + R.LOAD + j]
        entrain = w[row + R.ENTRAIN + j]
        film = central_film(factor, eta, entrain, load)
        scale = p[P.SLIDE_TO_ROLL] * math.sqrt(entrain * entrain + _SLOWEST_2) + p[P.TRACTION_FLOOR]
        sum_t = 0.0
        sum_m = 0.0
        spin = w[row + R.AN + j]
        moment_n = 0.0
        moment_t = 0.0
        moment_m = 0.0
        for k in range(strips):
            node = p[nodes + k]
            share = p[nodes + strips + k]
            offset = node * half
            sag = offset * offset * per_profile
            ut = w[row + R.UT + j] - offset * spin - sag * w[row + R.AM + j]
            um = w[row + R.UM + j] + sag * w[row + R.AT + j]
            inside = 1.0 - node * node
            area = strip_area(half, half * width, share, node)
            own = 0.0
            if law == EYRING:
                thick = viscosity_under_pressure(eta, index, pressure * half * math.sqrt(inside))
                # half the strip's width over a: its share over the density 3/4 (1 - xi^2) of the load; across
                # it the mean square weighted with the pressure, b^2 / 4 (1 - xi^2)
                drag, own = eyring_strip(
                    area, thick, film, stress, mu * share * load, ut, um, half * spin,
                    share / (1.5 * inside), across * inside, floor_2,
                )  # fmt: skip
            elif law == REGULARISED:
                drag = mu * share * load / math.sqrt(ut * ut + um * um + scale * scale)
            else:
                drag = area * eta / film
            if heated:
                flux = drag * (ut * ut + um * um) / (area + _NOWHERE)
                narrow = half * width * math.sqrt(inside)
                warms = warming(narrow, entrain, effusivity, film, p[P.OIL_CONDUCTIVITY])
                left = heated_share(thinning * warms * flux)
                drag *= left
                own *= left
            moment_n -= own * half * half * spin
            ft = -drag * ut
            fm = -drag * um
            sum_t += ft
            sum_m += fm
            moment_n -= offset * ft
            moment_t += sag * fm
            moment_m -= sag * ft
        w[row + R.FT + j] = sum_t
        w[row + R.FM + j] = sum_m
        w[row + R.MN + j] = moment_n
        w[row + R.MT + j] = moment_t
        w[row + R.MM + j] = moment_m
