"""Integrals of the kernel's closed part over line elements, with intervals that shrink to the field point.

Arrays are flat: field points (x, r), ends (x, r, x, r) and normals (x, r) of elements, rules of Gauss (places
on [0, 1], then weights).
"""

import math

from fmu_bearing.engine.boundary_elements.ring_potential import static_harmonics
from fmu_bearing.engine.jit import kernel

END, X1, R1, X2, R2 = 4, 0, 1, 2, 3  # numbers of an element in the array of ends, and their places
KINDS = 4  # 1/R, its derivative along the normal, R, its derivative
_NEAR = 2.0  # element lengths within which an element is cut into shrinking intervals
_SHRINK = 0.2  # of each interval against the one before
_SMALLEST = 1e-6  # of the element's length: what is left out weighs 1e-6 log(1e6)
_FOUR_PI = 4.0 * math.pi


@kernel
def _interval(x, r, ends, normals, e, a, b, flat, rule, nodes, orders, w, out, at, apart):
    """Add the part of element ``e`` between a and b (places on [0, 1]) to a point's block of ``out``.

    The block, (nodes, orders), begins at ``at``, those of the other kinds ``apart`` behind each other.
    """
    x1, r1, x2, r2 = ends[END * e + X1], ends[END * e + R1], ends[END * e + X2], ends[END * e + R2]
    length = math.hypot(x2 - x1, r2 - r1)
    count = rule.size // 2
    row = orders + 2
    for g in range(count):
        t = a + (b - a) * rule[g]
        weight = (b - a) * rule[count + g] * length
        sx = x1 + t * (x2 - x1)
        sr = r1 + t * (r2 - r1)
        static_harmonics(sx - x, r, sr, normals[2 * e], normals[2 * e + 1], flat, orders, w)
        for n in range(nodes.size):
            value = weight * sr / _FOUR_PI
            for other in range(nodes.size):
                if other != n:
                    value *= (t - nodes[other]) / (nodes[n] - nodes[other])
            for kind in range(KINDS):
                first = at + kind * apart + n * orders
                for m in range(orders):
                    out[first + m] += value * w[(kind + 1) * row + m]


@kernel
def _side(x, r, ends, normals, e, from_, to, smallest, flat, rule, nodes, orders, w, out, at, apart):
    """Cut the stretch from the place nearest the field point to an end into growing intervals."""
    edge = abs(to - from_)
    while edge > 0.0:
        inner = edge * _SHRINK
        if edge <= smallest or inner < smallest:
            inner = 0.0
        low = from_ + inner if to > from_ else from_ - edge
        high = from_ + edge if to > from_ else from_ - inner
        _interval(x, r, ends, normals, e, low, high, flat, rule, nodes, orders, w, out, at, apart)
        edge = inner


@kernel
def closed_part(points, own, ends, normals, far_rule, near_rule, nodes, w, out, orders):
    """Add the closed parts to ``out`` (KINDS, points, elements, nodes, orders).

    ``own``: the element on which each point lies, -1 for none; ``nodes``: collocation points on [0, 1];
    ``w``: work space of 5 (``orders`` + 2) numbers.
    """
    count = normals.size // 2
    block = nodes.size * orders
    apart = own.size * count * block
    for i in range(own.size):
        x = points[2 * i]
        r = points[2 * i + 1]
        for e in range(count):
            at = (i * count + e) * block
            dx = ends[END * e + X2] - ends[END * e + X1]
            dr = ends[END * e + R2] - ends[END * e + R1]
            length = math.hypot(dx, dr)
            t = ((x - ends[END * e + X1]) * dx + (r - ends[END * e + R1]) * dr) / (length * length)
            t = min(max(t, 0.0), 1.0)
            gap = math.hypot(ends[END * e + X1] + t * dx - x, ends[END * e + R1] + t * dr - r)
            flat = own[i] == e
            if gap > _NEAR * length:
                _interval(
                    x, r, ends, normals, e, 0.0, 1.0, flat, far_rule, nodes, orders, w, out, at, apart
                )  # fmt: skip
                continue
            smallest = max(_SMALLEST, 0.3 * gap / length)
            for to in range(2):
                _side(
                    x, r, ends, normals, e, t, float(to), smallest, flat, near_rule, nodes, orders, w, out,
                    at, apart,
                )  # fmt: skip
