"""Integrals of exp(x (1 - s)) s^m over a step: what a drive that is a polynomial leaves in a mode.

The phi functions of exponential integrators (Hochbruck and Ostermann 2010): phi_0 is exp, and phi_{k+1}(x) is
(phi_k(x) - 1/k!) / x.
"""

import math

from fmu_bearing.engine.complex_numbers import over, real_times, square
from fmu_bearing.engine.jit import kernel

_TERMS = 24  # of the series of phi for small arguments: 2^24/24! is rounding
_ORDERS = 5


@kernel
def last_phi(x):
    """Series of phi_5(x) = sum x^j / (j + 5)!."""
    total, term = 0j, complex(1.0 / 120.0, 0.0)
    for j in range(_TERMS):
        total += term
        term = real_times(1.0 / (j + 1.0 + _ORDERS), term * x)
    return total


@kernel
def moments(x, m):
    """Put the complex exp(x) and k! phi_{k+1}(x), k = 0 .. 4, to ``m``.

    The second is the integral over a step of exp(x (1 - s)) s^k.
    """
    m[0] = real_times(math.exp(x.real), complex(math.cos(x.imag), math.sin(x.imag)))
    if square(x) < 4.0:
        phi = last_phi(x)
        factorial = 24.0
        for k in range(_ORDERS, 0, -1):
            # phi_k is known, and phi_{k-1} = x phi_k + 1/(k - 1)!
            m[k] = real_times(factorial, phi)
            phi = x * phi + 1.0 / factorial
            factorial /= max(k - 1.0, 1.0)
        return
    phi = m[0]
    factorial = 1.0
    for k in range(1, _ORDERS + 1):
        phi = over(phi - 1.0 / factorial, x)
        m[k] = real_times(factorial, phi)
        factorial *= k


@kernel
def weigh(m0, m1, m2, m3, m4, known, stiff):
    """Weights of the drives at the end, now and at three steps before, from the moments of a step."""
    none = 0.0 * m0
    if known < 1.0:
        return m1, m0 - m1, none, none, none
    if known < 3.0 or stiff:
        return 0.5 * (m1 + m2), m0 - m2, 0.5 * (m2 - m1), none, none
    per = 1.0 / 24.0
    return (
        per * (6.0 * m1 + 11.0 * m2 + 6.0 * m3 + m4),
        m0 + per * (20.0 * m1 - 20.0 * m2 - 20.0 * m3 - 4.0 * m4),
        per * (-36.0 * m1 + 6.0 * m2 + 24.0 * m3 + 6.0 * m4),
        per * (12.0 * m1 + 4.0 * m2 - 12.0 * m3 - 4.0 * m4),
        per * (-2.0 * m1 - m2 + 2.0 * m3 + m4),
    )
