"""Smooth rest of the kernel: harmonics of exp(-jkR) / R - 1/R + k^2 R / 2 by the trapezoidal rule.

Almost all the time of boundary elements is spent here. Azimuths are worked through four at a time, in rows
that are filled up to a multiple of it with weights of zero.
"""

import math

from fmu_bearing.engine.boundary_elements.closed_part import END, R1, R2, X1, X2
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, select, splat, store, sum_four
from fmu_bearing.engine.layout import FOUR
from fmu_bearing.engine.mechanics.trigonometry import cosine_and_sine

ROWS = 4  # of the work space: real and imaginary part, and those of the slope along the normal
REAL_SLOPE, IMAGINARY_SLOPE = 2, 3
_SMALL = 0.02  # k R below which the remainder is taken from its series


@kernel
def terms(k, a2, twice, normal, lift, less, w):
    """Fill four rows of ``w``: real and imaginary part of the remainder (1/m), and of its slope (1/m2).

    ``k`` is the wavenumber (1/m), ``a2`` the squared distance in the meridian plane, ``twice`` 2 r r' (m2),
    ``less`` 1 - cos phi; ``normal`` + ``lift`` * ``less`` is the distance along the source's normal (m).
    """
    width = less.size
    for j in range(0, width, FOUR):
        turned = load(less, j)
        distance = math.sqrt(a2 + twice * turned)
        inverse = select(distance > 0.0, 1.0 / distance, splat(0.0))
        z = k * distance
        cosine, sine = cosine_and_sine(z)
        small = z < _SMALL
        z2 = z * z
        real = (cosine - 1.0 + 0.5 * z2) * inverse
        real_slope = select(small, k * k * 0.125 * z2, (k * (z - sine) - real) * inverse)
        imaginary = sine * inverse
        imaginary_slope = select(small, k * k * (-1.0 / 3.0) * z, (k * cosine - imaginary) * inverse)
        along = (normal + lift * turned) * inverse
        store(w, j, select(small, k * (1.0 / 24.0) * (z2 * z), real))
        store(w, width + j, select(small, k * (z2 * (1.0 / 6.0) - 1.0), -imaginary))
        store(w, REAL_SLOPE * width + j, real_slope * along)
        store(w, IMAGINARY_SLOPE * width + j, -imaginary_slope * along)


@kernel
def remainder(points, own, ends, normals, rule, basis, less, weights, w, out, k):
    """Add the smooth parts to ``out`` (2, orders, points, elements * nodes, real and imaginary part).

    Flat arrays: places ``points`` (points, 2) and ``ends`` (elements, 4) are x, r (m), ``k`` the wavenumber
    (1/m); ``less`` is 1 - cos phi at azimuths, ``weights`` (orders, azimuths) cos m phi times those of the
    trapezoidal rule; ``rule`` (2, n) and ``basis`` (nodes, n): points, weights and shape functions along an
    element; ``w``: work space of `ROWS` rows of azimuths.
    """
    width = less.size
    orders = weights.size // width
    elements = normals.size // 2
    gauss = rule.size // 2
    nodes = basis.size // gauss
    columns = elements * nodes
    layer = 2 * orders * own.size * columns
    for i in range(own.size):
        x = points[2 * i]
        r = points[2 * i + 1]
        for e in range(elements):
            dx = ends[END * e + X2] - ends[END * e + X1]
            dr = ends[END * e + R2] - ends[END * e + R1]
            length = math.hypot(dx, dr)
            nx = normals[2 * e]
            nr = normals[2 * e + 1]
            for g in range(gauss):
                away = ends[END * e + X1] + rule[g] * dx - x
                s = ends[END * e + R1] + rule[g] * dr
                normal = 0.0 if own[i] == e else nx * away + nr * (s - r)
                a2 = away * away + (s - r) * (s - r)
                terms(k, a2, 2.0 * r * s, normal, nr * r, less, w)
                weight = rule[gauss + g] * length * s
                for m in range(orders):
                    real, imaginary, real_slope, imaginary_slope = (
                        splat(0.0),
                        splat(0.0),
                        splat(0.0),
                        splat(0.0),
                    )
                    for j in range(0, width, FOUR):
                        part = load(weights, m * width + j)
                        real += part * load(w, j)
                        imaginary += part * load(w, width + j)
                        real_slope += part * load(w, REAL_SLOPE * width + j)
                        imaginary_slope += part * load(w, IMAGINARY_SLOPE * width + j)
                    one, two = sum_four(real), sum_four(imaginary)
                    three, four = sum_four(real_slope), sum_four(imaginary_slope)
                    for n in range(nodes):
                        value = weight * basis[n * gauss + g]
                        at = 2 * ((m * own.size + i) * columns + e * nodes + n)
                        out[at] += value * one
                        out[at + 1] += value * two
                        out[layer + at] += value * three
                        out[layer + at + 1] += value * four
