"""Spherical waves of order n on one axis, scaled to stay of order one at any frequency, zero included.

With x = k r, time factor e^{+j omega t}, and the double factorials taken out:

* h_n(x) = (2n-1)!! / x^{n+1} * g_n(x), spherical Hankel functions of the second kind, waves that leave;
* j_n(x) = x^n / (2n+1)!! * q_n(x), spherical Bessel functions, waves that are finite at the centre;

so that g_n and q_n are 1 (g_n: times j) at low frequency.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaln

Array = NDArray[np.float64]
Spectrum = NDArray[np.complex128]


def leaving(order: int, x: Array) -> Spectrum:
    """g_0 .. g_order at ``x``, shape (order + 1, *x.shape): x^{n+1} h_n / (2n-1)!!, upward recurrence."""
    g = np.empty((order + 1, *np.shape(x)), dtype=complex)
    g[0] = 1j * np.exp(-1j * x)
    if order > 0:
        g[1] = (1.0 + 1j * x) * g[0]
    for n in range(1, order):
        g[n + 1] = g[n] - x**2 / ((2 * n + 1) * (2 * n - 1)) * g[n - 1]
    return g


def finite(order: int, x: Array) -> Array:
    """q_0 .. q_order at ``x``, shape (order + 1, *x.shape): (2n+1)!! j_n / x^n, downward recurrence."""
    x = np.asarray(x, dtype=float)
    top = order + int(x.max(initial=0.0) ** 2 / 4.0) + 2  # there the series takes a dozen terms
    q = np.empty((order + 1, *x.shape))
    above, here = _series(top + 1, x), _series(top, x)
    for n in range(top, -1, -1):
        if n <= order:
            q[n] = here
        above, here = here, here - x**2 / ((2 * n + 1) * (2 * n + 3)) * above
    return q


def _series(n: int, x: Array) -> Array:
    """q_n by its power series; for x^2 below about 4 n."""
    term = np.ones_like(x)
    total = term.copy()
    for m in range(1, 60):
        term = -term * x**2 / (2.0 * m * (2 * n + 2 * m + 1))
        total += term
    return total


def leaving_slope(order: int, x: Array, g: Spectrum) -> Spectrum:
    """Slopes x h_n'(x) / h_n(x), n = 0 .. order, from `leaving`'s g up to ``order + 1``; -(n+1) at x = 0."""
    n = np.arange(order + 1).reshape(-1, *[1] * np.ndim(x))
    return n - (2 * n + 1) * g[1 : order + 2] / g[: order + 1]


def finite_slope(order: int, x: Array, q: Array) -> Array:
    """Slopes x j_n'(x) (2n+1)!! / x^n, n = 0 .. order, from `finite`'s q up to ``order + 1``; n at x = 0."""
    n = np.arange(order + 1).reshape(-1, *[1] * np.ndim(x))
    return n * q[: order + 1] - x**2 / (2 * n + 3) * q[1 : order + 2]


def log_double_factorial(odd: NDArray[np.int_]) -> Array:
    """Natural logarithm of odd!! for odd numbers from -1 on."""
    half = (odd + 1) / 2.0
    return gammaln(2.0 * half + 1.0) - half * np.log(2.0) - gammaln(half + 1.0)


@lru_cache(maxsize=2)
def coupling(order: int) -> tuple[Array, NDArray[np.int_]]:
    """Logarithms of (n v l; 0 0 0)^2 (2l+1) (2v+1), shape (v, n, s), for l = n + v - 2 s; and l itself.

    Squares of Wigner's 3j symbols with zeros below, in closed form (Edmonds 1957, eq. 3.7.17); minus infinity
    where l would fall below |n - v|.
    """
    v, n, s = np.meshgrid(*[np.arange(order + 1)] * 3, indexing="ij")
    inside = s <= np.minimum(n, v)
    s = np.where(inside, s, 0)
    el = n + v - 2 * s
    half = n + v - s  # (n + v + l) / 2
    symbol = gammaln(2 * (half - n) + 1) + gammaln(2 * (half - v) + 1) + gammaln(2 * (half - el) + 1)
    symbol -= gammaln(2 * half + 2)
    symbol += 2.0 * (gammaln(half + 1) - gammaln(half - n + 1))
    symbol -= 2.0 * (gammaln(half - v + 1) + gammaln(half - el + 1))
    symbol += np.log(2.0 * el + 1.0) + np.log(2.0 * v + 1.0)
    return np.where(inside, symbol, -np.inf), np.where(inside, el, 0)
