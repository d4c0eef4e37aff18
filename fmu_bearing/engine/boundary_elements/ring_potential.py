"""Circumferential harmonics of 1/R and R between two rings: closed forms with Legendre functions.

Two points at (x, r) and (x', r') of a meridian plane, turned against each other by phi, are
R = sqrt(A^2 + 2 r r' (1 - cos phi)) apart, with A their distance in the plane. The harmonics

    I_m = integral over phi of cos(m phi) / R = 2 Q_{m-1/2}(chi) / sqrt(r r'),  chi = 1 + A^2 / (2 r r')

are toroidal (Legendre) functions. Source: Cohl and Tohline (1999, eqs. 12 to 19), Abramowitz and Stegun
(1964, 8.13, 17.6).
"""

import math

from fmu_bearing.engine.jit import kernel

MAX_ORDER = 16
_DISTANCE, _DISTANCE_SLOPE = 3, 4  # rows of the work space for R and its derivative
_FORWARD = 1.1  # below this chi the upward recurrence loses less than three digits up to order 16
_DIGITS = 40.0  # the downward recurrence begins exp(-40) below the wanted orders
_AGM_STEPS = 40


@kernel
def elliptic(complement):
    """Complete elliptic integrals K and E of the parameter 1 - ``complement``, by the arithmetic mean."""
    a = 1.0
    b = math.sqrt(complement)
    c2 = 1.0 - complement
    total = 0.5 * c2
    power = 0.5
    for _ in range(_AGM_STEPS):
        c = 0.5 * (a - b)
        a, b = 0.5 * (a + b), math.sqrt(a * b)
        power *= 2.0
        total += power * c * c
        if c < 1e-17 * a:
            break
    k = 0.5 * math.pi / a
    return k, k * (1.0 - total)


@kernel
def toroidal(excess, highest, q):
    """Fill ``q[0 .. highest]`` with Q_{m-1/2}(1 + ``excess``), ``excess`` > 0."""
    chi = 1.0 + excess
    k, e = elliptic(excess / (2.0 + excess))
    root = math.sqrt(2.0 / (2.0 + excess))
    q[0] = root * k
    if highest == 0:
        return
    if chi < _FORWARD:
        q[1] = chi * q[0] - (2.0 + excess) * root * e
        for m in range(1, highest):
            q[m + 1] = (2.0 * m * chi * q[m] - (m - 0.5) * q[m - 1]) / (m + 0.5)
        return
    eta = math.log(chi + math.sqrt(excess * (2.0 + excess)))
    start = highest + 2 + int(_DIGITS / (2.0 * eta))
    above = 0.0
    here = 1e-280
    for m in range(start, 0, -1):
        below = (2.0 * m * chi * here - (m + 0.5) * above) / (m - 0.5)
        if m <= highest:
            q[m] = here
        above = here
        here = below
        if here > 1e200:
            here *= 1e-200
            above *= 1e-200
            for i in range(m, highest + 1):
                q[i] *= 1e-200
    scale = q[0] / here
    for m in range(1, highest + 1):
        q[m] *= scale


@kernel
def static_harmonics(dx, r, s, nx, ns, flat, orders, w):
    """Harmonics of 1/R and R, and of their derivatives along the source's normal (nx, ns).

    ``dx`` = x' - x, ``r`` and ``s`` the radii of field and source point (m); ``flat``: the field point is on
    the source's own straight element, where the normal component of the distance is nil. Five rows of
    ``orders`` + 2 numbers of ``w``: scratch, then orders 0 .. ``orders`` - 1 of 1/R, of its derivative, of R
    and of its derivative.
    """
    row = orders + 2
    a2 = dx * dx + (s - r) * (s - r)
    rs = r * s
    excess = a2 / (2.0 * rs)
    toroidal(excess, orders, w)
    scale = 2.0 / math.sqrt(rs)
    chi = 1.0 + excess
    slope = -scale / (rs * excess * (2.0 + excess))
    normal = 0.0 if flat else nx * dx + ns * (s - r)
    for m in range(orders):
        below = w[1] if m == 0 else w[m - 1]  # of the order |m - 1|
        here = scale * w[m]
        cubed = slope * (m - 0.5) * (chi * w[m] - below)  # harmonics of 1/R^3
        less = here - 0.5 * scale * (below + w[m + 1])  # harmonics of (1 - cos phi) / R
        w[row + m] = here
        w[2 * row + m] = -(normal * cubed + 0.5 * ns / s * (here - a2 * cubed))
        w[_DISTANCE * row + m] = a2 * here + 2.0 * rs * less
        w[_DISTANCE_SLOPE * row + m] = normal * here + ns * r * less
