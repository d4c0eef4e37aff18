"""Force of the oil at the inlet of a rolling contact, as a moment about the rolling axis, and its slopes.

With the entrainment speed u and the load Q, both regimes are powers: a constant times (eta u)^s Q^w. Between
them, F = F_e + (F_i - F_e)/(1 + M/6.6) with M going as Q (eta u)^-3/4 (Biboulet and Houpert 2010, Proc.
IMechE J 224, 777): F_e of elastic surfaces and oil that pressure thickens, F_i of rigid ones and isoviscous
oil.
"""

from fmu_bearing.engine.choices import EHL_ALONE, FLOODED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import splat
from fmu_bearing.engine.layout import C, P
from fmu_bearing.engine.mechanics.powers import exp2, log2

REGIME_SPEED = -0.75  # power of viscosity times speed in M
SLOWEST_2 = 1e-8  # m2/s2: entrainment rounded over 1e-4 m/s
LIGHTEST = 1e-9  # N: keeps the logarithm of an open contact away
_STILL = 1e-300  # N m: and the 0/0 of one without moment


@kernel
def inlet_powers(law):
    """Powers of viscosity times speed and of load: of the EHL force, then of that of rigid surfaces.

    Houpert (1987), or flooded, Biboulet and Houpert (2010), where the load enters by the axis alone.
    """
    if law == FLOODED:
        return 0.75, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0
    return 0.66, 0.47, 0.636, 0.364


@kernel
def ehl_moment(p, c, race, speed, weight, pressing):
    """Moment (N m) in EHL on four balls; ``speed`` and ``weight``: log2 of u^2 and Q."""
    s, w, _, _ = inlet_powers(p[P.ROLLING_LAW])
    factor = c[C.RACES + race * C.RACE_SIZE + C.ROLLING]
    return factor * pressing * exp2(0.5 * s * speed - (1.0 - w) * weight)


@kernel
def rigid_moment(p, c, race, speed, weight, pressing):
    """Moment (N m) of rigid surfaces in isoviscous oil, and the weight of EHL against its 1."""
    _, _, s, w = inlet_powers(p[P.ROLLING_LAW])
    held = C.RACES + race * C.RACE_SIZE
    moment = c[held + C.RIGID] * pressing * exp2(0.5 * s * speed - (1.0 - w) * weight)
    return moment, c[held + C.REGIME] * pressing * exp2(0.5 * REGIME_SPEED * speed)


@kernel
def inlet_moment(p, c, race, entrain, pressing):
    """Moment (N m) of the oil at the inlet on four balls, against their rolling."""
    speed = log2(entrain * entrain + SLOWEST_2)
    weight = log2(pressing + LIGHTEST)
    elastic = ehl_moment(p, c, race, speed, weight, pressing)
    if p[P.ROLLING_LAW] == EHL_ALONE:
        return elastic
    rigid, regime = rigid_moment(p, c, race, speed, weight, pressing)
    return elastic + (rigid - elastic) / (1.0 + regime)


@kernel
def local_powers(p, c, race, entrain, pressing):
    """Powers of speed and of load with which the moment grows at this speed (m/s) and load (N)."""
    elastic_s, elastic_w, rigid_s, rigid_w = inlet_powers(p[P.ROLLING_LAW])
    if p[P.ROLLING_LAW] == EHL_ALONE:
        return splat(elastic_s), splat(elastic_w)
    speed = log2(entrain * entrain + SLOWEST_2)
    weight = log2(pressing + LIGHTEST)
    elastic = ehl_moment(p, c, race, speed, weight, pressing)
    rigid, regime = rigid_moment(p, c, race, speed, weight, pressing)
    share = 1.0 / (1.0 + regime)
    moved = (rigid - elastic) * regime * share * share
    by_speed = elastic_s * elastic + (rigid_s * rigid - elastic_s * elastic) * share - REGIME_SPEED * moved
    by_load = elastic_w * elastic + (rigid_w * rigid - elastic_w * elastic) * share - moved
    per_moment = 1.0 / (elastic + (rigid - elastic) * share + _STILL)
    return by_speed * per_moment, by_load * per_moment
