"""Integrals of exp(x (1 - s)) s^m over a step: what a drive that is a polynomial leaves in a mode.

The phi functions of exponential integrators (Hochbruck and Ostermann 2010): phi_0 is exp, and phi_{k+1}(x) is
(phi_k(x) - 1/k!) / x.
"""

import math

from fmu_bearing.engine.jit import kernel

_TERMS = 24  # of the series of phi for small arguments: 2^24/24! is rounding
_ORDERS = 5


@kernel
def next_phi(re, im, less, xr, xi):
    """Return phi_{k+1} = (phi_k - 1/k!) / x."""
    ar, ai = re - less, im
    size = xr * xr + xi * xi
    return (ar * xr + ai * xi) / size, (ai * xr - ar * xi) / size


@kernel
def last_phi(xr, xi):
    """Series of phi_5(x) = sum x^j / (j + 5)!."""
    re, im = 0.0, 0.0
    term_r, term_i = 1.0 / 120.0, 0.0
    for j in range(_TERMS):
        re += term_r
        im += term_i
        per = 1.0 / (j + 1.0 + _ORDERS)
        term_r, term_i = per * (term_r * xr - term_i * xi), per * (term_r * xi + term_i * xr)
    return re, im


@kernel
def moments(xr, xi, w, at):
    """Put exp(x) and m! phi_{m+1}(x), m = 0 .. 4, to ``w[at:]``: pairs of real and imaginary part.

    The second is the integral over a step of exp(x (1 - s)) s^m.
    """
    decay = math.exp(xr)
    w[at] = decay * math.cos(xi)
    w[at + 1] = decay * math.sin(xi)
    if xr * xr + xi * xi < 4.0:
        re, im = last_phi(xr, xi)
        factorial = 24.0
        for k in range(_ORDERS - 1, -1, -1):
            # phi_{k+1} is known; it counts k! in the moments, and phi_k = x phi_{k+1} + 1/k!
            w[at + 2 + 2 * k] = factorial * re
            w[at + 2 + 2 * k + 1] = factorial * im
            per = 1.0 / factorial
            re, im = xr * re - xi * im + per, xr * im + xi * re
            factorial /= max(k, 1.0)
        return
    re, im = w[at], w[at + 1]
    factorial = 1.0
    for k in range(_ORDERS):
        re, im = next_phi(re, im, 1.0 / factorial, xr, xi)
        w[at + 2 + 2 * k] = factorial * re
        w[at + 2 + 2 * k + 1] = factorial * im
        factorial *= k + 1.0


@kernel
def weigh(m0, m1, m2, m3, m4, known, stiff):
    """Weights of the drives at the end, now and at three steps before, from the moments of a step."""
    if known < 1.0:
        return m1, m0 - m1, 0.0, 0.0, 0.0
    if known < 3.0 or stiff:
        return 0.5 * (m1 + m2), m0 - m2, 0.5 * (m2 - m1), 0.0, 0.0
    per = 1.0 / 24.0
    return (
        per * (6.0 * m1 + 11.0 * m2 + 6.0 * m3 + m4),
        m0 + per * (20.0 * m1 - 20.0 * m2 - 20.0 * m3 - 4.0 * m4),
        per * (-36.0 * m1 + 6.0 * m2 + 24.0 * m3 + 6.0 * m4),
        per * (12.0 * m1 + 4.0 * m2 - 12.0 * m3 - 4.0 * m4),
        per * (-2.0 * m1 - m2 + 2.0 * m3 + m4),
    )
