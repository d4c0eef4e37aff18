"""Force of the oil at the inlet of a rolling contact, as a moment about the rolling axis, and its slopes.

With the entrainment speed u and the load Q, both regimes are powers: a constant times (eta u)^s Q^w. Between
them, F = F_e + (F_i - F_e)/(1 + M/6.6) with M going as Q (eta u)^-3/4 (Biboulet and Houpert 2010, Proc.
IMechE J 224, 777): F_e of elastic surfaces and oil that pressure thickens, F_i of rigid ones and isoviscous
oil.
"""

from fmu_bearing.engine.choices import EHL_ALONE, FLOODED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store
from fmu_bearing.engine.layout import FOUR, C, P, R
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
def inlet_factors(p, c, race):
    """Factors of the moments (N m) in EHL and of rigid surfaces, and of the weight of EHL against those."""
    if p[P.ROLLING] == 0.0:
        return 0.0, 0.0, 0.0
    raceway = C.RACES + race * C.RACE_SIZE
    return c[raceway + C.ROLLING], c[raceway + C.RIGID], c[raceway + C.REGIME]


@kernel
def power_law(factor, s, w, speed, weight, pressing):
    """Return a factor times u^s Q^w of four balls; ``speed`` and ``weight``: log2 of u^2 and of Q."""
    return factor * pressing * exp2(0.5 * s * speed - (1.0 - w) * weight)


@kernel
def inlet_moments(p, lanes, factors, row, w):
    """Write the moment (N m) of the oil at the inlets of one race, against rolling, at ``ROLL``.

    What ``p`` holds is read before the loops: within them LLVM has to assume that storing a row changes it.
    """
    elastic, rigid, regime = factors
    es, ew, rs, rw = inlet_powers(p[P.ROLLING_LAW])
    if p[P.ROLLING_LAW] == EHL_ALONE:
        for j in range(0, lanes, FOUR):
            u = load(w, row + R.ENTRAIN + j)
            pressing = load(w, row + R.LOAD + j)
            speed, weight = log2(u * u + SLOWEST_2), log2(pressing + LIGHTEST)
            store(w, row + R.ROLL + j, power_law(elastic, es, ew, speed, weight, pressing))
        return
    for j in range(0, lanes, FOUR):
        u = load(w, row + R.ENTRAIN + j)
        pressing = load(w, row + R.LOAD + j)
        speed, weight = log2(u * u + SLOWEST_2), log2(pressing + LIGHTEST)
        moment = power_law(elastic, es, ew, speed, weight, pressing)
        other = power_law(rigid, rs, rw, speed, weight, pressing)
        heavy = power_law(regime, REGIME_SPEED, 1.0, speed, weight, pressing)
        store(w, row + R.ROLL + j, moment + (other - moment) / (1.0 + heavy))


@kernel
def local_powers(law, factors, entrain, pressing):
    """Powers of speed and of load with which the moment grows at this speed (m/s) and load (N)."""
    es, ew, rs, rw = inlet_powers(law)
    if law == EHL_ALONE:
        return splat(es), splat(ew)
    elastic, rigid, regime = factors
    speed = log2(entrain * entrain + SLOWEST_2)
    weight = log2(pressing + LIGHTEST)
    moment = power_law(elastic, es, ew, speed, weight, pressing)
    other = power_law(rigid, rs, rw, speed, weight, pressing)
    heavy = power_law(regime, REGIME_SPEED, 1.0, speed, weight, pressing)
    share = 1.0 / (1.0 + heavy)
    moved = (other - moment) * heavy * share * share
    by_speed = es * moment + (rs * other - es * moment) * share - REGIME_SPEED * moved
    by_load = ew * moment + (rw * other - ew * moment) * share - moved
    per_moment = 1.0 / (moment + (other - moment) * share + _STILL)
    return by_speed * per_moment, by_load * per_moment
