"""The contact of a ball and a race: its axes, heights of both surfaces, load, slopes and in-plane stiffness.

Statics, stiffness, outputs, the right-hand side, its slopes and the condensed balls call these. A kernel here
takes one ball's numbers or four balls' lanes, and does the same operations in the same order; heights of the
surfaces are for lanes, in which a single place counts four times.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import gather, splat, to_bits
from fmu_bearing.engine.layout import P
from fmu_bearing.engine.mechanics.powers import ROUND
from fmu_bearing.engine.mechanics.triples import added, scaled


@kernel
def carries_both_ways(p):
    """Whether a bearing is a deep groove one: both circles of groove centres lie in its middle plane."""
    return p[P.RACES + P.RACE_GROOVE_X] == 0.0


@kernel
def contact_axes(sx, sr, n, h):
    """Return distance (m) from the groove's centre, one over it, sine and cosine of the contact angle, e, m.

    ``sx``, ``sr``: ball from the groove's centre (m) along the ring's axis ``n`` and ``h``, away from it.
    ``e``: unit vector from the ball into the race; ``m``: across the track.
    """
    distance = math.sqrt(sx * sx + sr * sr)
    per = 1.0 / distance
    sine = sx * per
    cosine = sr * per
    e = added(scaled(sine, n), scaled(cosine, h))
    return distance, per, sine, cosine, e, added(scaled(cosine, n), scaled(-sine, h))


@kernel
def race_surface(p, race, place):
    """Height (m, towards the ball) of a race at ``place``, its first and second derivative by the place.

    ``place``: angle in intervals of the race's table, ``P.WAVE_INTERVALS`` a turn, of values and slopes.
    Cubic Hermite interpolation; the slope is the exact derivative of the interpolant, so waviness conserves
    energy. Imperfections at full scale.
    """
    intervals = int(p[P.WAVE_INTERVALS])
    within = intervals - 1
    table = int(p[P.AT_WAVES]) + race * 2 * intervals
    # Adding ROUND leaves the interval's number in the low bits: no conversion, no branch.
    number = (place - 0.5) + ROUND
    t = place - (number - ROUND)
    i0 = to_bits(number) & within
    i1 = (i0 + 1) & within
    h0 = gather(p, table, i0 << 1)
    g0 = gather(p, table + 1, i0 << 1)
    h1 = gather(p, table, i1 << 1)
    g1 = gather(p, table + 1, i1 << 1)
    d = h1 - h0
    a = g0 + g1 - 2.0 * d
    b = 3.0 * d - 2.0 * g0 - g1
    return h0 + t * (g0 + t * (b + t * a)), g0 + t * (2.0 * b + t * 3.0 * a), 2.0 * b + t * 6.0 * a


@kernel
def first_zonal(p, form, x):
    """Begin the sums of the zonal harmonics of a ball at ``x``: two polynomials, height (m), its derivative.

    ``form``: where their rows of ``P.FORM_ROW`` numbers begin (``prepare.surfaces.form_rows``).
    """
    return x, splat(1.0), splat(0.0), splat(p[form + P.FORM_RISE])


@kernel
def next_zonal(p, row, x, sums):
    """Add the order of ``row`` to what :func:`first_zonal` began.

    Legendre polynomials without their leading coefficients follow Q_(n+1) = x Q_n - n^2/(4 n^2 - 1) Q_(n-1);
    what they leave out is in the rows. Each order waits for the one before: several places fill that time.
    """
    here, before, height, rise = sums
    height += p[row + P.FORM_HEIGHT] * here
    rise += p[row + P.FORM_RISE] * here
    return x * here - p[row + P.FORM_BACK] * before, here, height, rise


@kernel
def hertz(stiffness, approach):
    """Load (N) and its slope (N/m) by Hertz's law, and the root (m^0.5) of the approach (m); zero if open.

    ``stiffness`` (N/m^1.5): load over approach^1.5.
    """
    pressed = max(approach, 0.0)
    root = math.sqrt(pressed)
    return stiffness * root * pressed, 1.5 * stiffness * root, root


@kernel
def damped(stiffness, damping, root, elastic, rate):
    """Load (N) with contact damping: tau times the slope of Hertz's law times the rate (m/s); no pull.

    ``damping``: 1.5 tau (s); ``root``, ``elastic``: of :func:`hertz`.
    """
    return max(elastic + stiffness * root * damping * rate, 0.0)


@kernel
def damped_slopes(stiffness, damping, root, per_root, rate):
    """Slopes of :func:`damped` by approach (N/m) and rate (N s/m); ``per_root``: one over root, bounded."""
    return stiffness * (1.5 * root + 0.5 * damping * rate * per_root), stiffness * damping * root


@kernel
def approach_under(stiffness, load):
    """Approach (m) under a ``load`` (N): Hertz's law turned round."""
    return (load / stiffness) ** (2.0 / 3.0)


@kernel
def in_plane(xx, xr, rr, along, across, ex, er, mx, mr):
    """Return in-plane stiffness (N/m) ``xx``, ``xr``, ``rr`` plus that of a contact.

    ``along``: slope of its load; ``across``: load over distance from the groove's centre, for the load turns
    as the ball moves across; ``e``, ``m``: see :func:`contact_axes`.
    """
    return (
        xx + along * ex * ex + across * mx * mx,
        xr + along * ex * er + across * mx * mr,
        rr + along * er * er + across * mr * mr,
    )
