"""Smooth rest of the kernel: harmonics of exp(-jkR) / R - 1/R + k^2 R / 2 by the trapezoidal rule.

Almost all the time of boundary elements is spent here. Azimuths are worked through in rows that the compiler
turns into vector instructions: sine and cosine are polynomials with selections in the place of branches, and
the sums over azimuths may be taken in any order. These two liberties (``reassoc`` and ``contract``) are the
only ones that LLVM gets; with all of its fast mathematics it would remove the rounding by `_ROUND`.

Source of the polynomials and of the two parts of pi/2: fdlibm (Sun Microsystems 1993), k_sin.c, k_cos.c and
e_rem_pio2.c; their error is below 1 unit in the last place for arguments up to 1e6.
"""

import math

import numba
import numpy as np

_SMALL = 0.02  # k R below which the remainder is taken from its series
_FOUR_PI = 4.0 * math.pi
_LANES = 8  # rows are filled up to a multiple of it, with weights of zero
_ROUND = 6755399441055744.0  # 1.5 * 2^52: added and taken away again, it rounds to whole numbers
_TWO_OVER_PI = 2.0 / math.pi
_HALF_PI_HIGH = 1.5707963267341256  # the first 33 bits of pi/2: exact when multiplied by up to 2^20
_HALF_PI_LOW = 6.077100506506192e-11  # the rest
_S1, _S2, _S3 = -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04
_S4, _S5, _S6 = 2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10
_C1, _C2, _C3 = 4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05
_C4, _C5, _C6 = -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11


@numba.njit(nogil=True, error_model="numpy", fastmath={"contract"})
def _terms(k, a2, twice, less, normal, lift, even, odd, even_slope, odd_slope):
    """Fill four rows: real and imaginary part of the remainder (1/m), and of its slope along the normal.

    ``k`` is the wavenumber (1/m), ``a2`` the squared distance in the meridian plane, ``twice`` 2 r r' (m2),
    ``less`` 1 - cos phi; ``normal`` + ``lift`` * ``less`` is the distance along the source's normal (m).
    """
    for j in range(len(less)):
        distance = math.sqrt(a2 + twice * less[j])
        inverse = 1.0 / distance if distance > 0.0 else 0.0
        z = k * distance
        quarters = (z * _TWO_OVER_PI + _ROUND) - _ROUND
        y = (z - quarters * _HALF_PI_HIGH) - quarters * _HALF_PI_LOW
        y2 = y * y
        sine = y + y * y2 * (_S1 + y2 * (_S2 + y2 * (_S3 + y2 * (_S4 + y2 * (_S5 + y2 * _S6)))))
        higher = _C1 + y2 * (_C2 + y2 * (_C3 + y2 * (_C4 + y2 * (_C5 + y2 * _C6))))
        cosine = 1.0 - 0.5 * y2 + y2 * y2 * higher
        # whole turns out: 0, 1, 2 or 3 quarters are left
        quarter = quarters - 4.0 * ((quarters * 0.25 - 0.375 + _ROUND) - _ROUND)
        turned = (quarter == 1.0) | (quarter == 3.0)
        si = cosine if turned else sine
        co = sine if turned else cosine
        si = -si if quarter >= 2.0 else si
        co = -co if (quarter == 1.0) | (quarter == 2.0) else co
        real = (co - 1.0 + 0.5 * z * z) * inverse
        real_slope = (k * (z - si) - real) * inverse
        imaginary = si * inverse
        imaginary_slope = (k * co - imaginary) * inverse
        small = z < _SMALL
        real = k * z * z * z * (1.0 / 24.0) if small else real
        real_slope = k * k * z * z * 0.125 if small else real_slope
        imaginary = k * (1.0 - z * z * (1.0 / 6.0)) if small else imaginary
        imaginary_slope = -k * k * z * (1.0 / 3.0) if small else imaginary_slope
        along = (normal + lift * less[j]) * inverse
        even[j] = real
        odd[j] = -imaginary
        even_slope[j] = real_slope * along
        odd_slope[j] = -imaginary_slope * along


@numba.njit(nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
def _sum(weights, row):
    total = 0.0
    for j in range(len(weights)):
        total += weights[j] * row[j]
    return total


def remainder(points, own, ends, normals, rule, basis, cosines, k, out):
    """Add the smooth parts of order m to ``out`` (2, orders, points, elements * NODES), complex.

    ``points`` (points, 2) and ``ends`` (elements, 4) are places x, r (m), ``k`` the wavenumber (1/m);
    ``cosines`` (orders, n), two rows at least: cos(m phi) at n azimuths from 0 to pi, the second row
    cos(phi) itself; ``rule`` and ``basis``: points, weights and shape functions along an element.
    """
    orders = out.shape[1]
    turns = cosines.shape[1]
    width = (turns + _LANES - 1) // _LANES * _LANES
    less = np.zeros(width)
    weights = np.zeros((orders, width))
    for j in range(turns):
        less[j] = 1.0 - cosines[1, j]
        part = 2.0 if 0 < j < turns - 1 else 1.0
        for m in range(orders):
            weights[m, j] = part * cosines[m, j]
    even, odd, even_slope, odd_slope = np.zeros(width), np.zeros(width), np.zeros(width), np.zeros(width)
    for i in range(len(points)):
        x = points[i, 0]
        r = points[i, 1]
        for e in range(len(ends)):
            length = math.hypot(ends[e, 2] - ends[e, 0], ends[e, 3] - ends[e, 1])
            nx = normals[e, 0]
            nr = normals[e, 1]
            for g in range(rule.shape[1]):
                dx = ends[e, 0] + rule[0, g] * (ends[e, 2] - ends[e, 0]) - x
                s = ends[e, 1] + rule[0, g] * (ends[e, 3] - ends[e, 1])
                normal = 0.0 if own[i] == e else nx * dx + nr * (s - r)
                a2 = dx * dx + (s - r) ** 2
                _terms(k, a2, 2.0 * r * s, less, normal, nr * r, even, odd, even_slope, odd_slope)
                weight = rule[1, g] * length * s / _FOUR_PI * math.pi / (turns - 1)
                for m in range(orders):
                    row = weights[m]
                    single = complex(_sum(row, even), _sum(row, odd))
                    double = complex(_sum(row, even_slope), _sum(row, odd_slope))
                    for n in range(basis.shape[0]):
                        value = weight * basis[n, g]
                        column = e * basis.shape[0] + n
                        out[0, m, i, column] += value * single
                        out[1, m, i, column] += value * double
