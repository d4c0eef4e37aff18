"""Smooth rest of the boundary elements' kernel, one azimuth at a time with the library's sine and cosine."""

import math

import numba
import numpy as np

_SMALL = 0.02  # k R below which the remainder is taken from its series
_FOUR_PI = 4.0 * math.pi


@numba.njit(nogil=True, error_model="numpy")
def remainder(points, own, ends, normals, rule, basis, cosines, k, out):
    """Add the smooth parts of order m to ``out`` (2, orders, points, elements * NODES), complex."""
    orders = out.shape[1]
    turns = cosines.shape[1]  # two rows at least: the second is cos(phi) itself
    for i in range(len(points)):
        sums = np.zeros((4, orders))
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
                sums[:] = 0.0
                for j in range(turns):
                    less = 1.0 - cosines[1, j]
                    distance = math.sqrt(a2 + 2.0 * r * s * less)
                    z = k * distance
                    if z < _SMALL:
                        even = k * z * z * z / 24.0
                        even_slope = k * k * z * z / 8.0
                        odd = k * (1.0 - z * z / 6.0)
                        odd_slope = -k * k * z / 3.0
                    else:
                        co = math.cos(z)
                        si = math.sin(z)
                        even = (co - 1.0 + 0.5 * z * z) / distance
                        even_slope = (k * (z - si) - even) / distance
                        odd = si / distance
                        odd_slope = (k * co - odd) / distance
                    along = 0.0
                    if distance > 0.0:
                        along = (normal + nr * r * less) / distance
                    part = 2.0 if 0 < j < turns - 1 else 1.0
                    even *= part
                    odd *= -part
                    even_slope *= part * along
                    odd_slope *= -part * along
                    for m in range(orders):
                        c = cosines[m, j]
                        sums[0, m] += c * even
                        sums[1, m] += c * odd
                        sums[2, m] += c * even_slope
                        sums[3, m] += c * odd_slope
                weight = rule[1, g] * length * s / _FOUR_PI * math.pi / (turns - 1)
                for n in range(basis.shape[0]):
                    value = weight * basis[n, g]
                    column = e * basis.shape[0] + n
                    for m in range(orders):
                        out[0, m, i, column] += value * complex(sums[0, m], sums[1, m])
                        out[1, m, i, column] += value * complex(sums[2, m], sums[3, m])
