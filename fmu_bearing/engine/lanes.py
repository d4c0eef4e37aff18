"""Four balls at a time: sums over lanes in four partial sums of fixed order, so that bits never change."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR


@kernel
def sum_lanes(x, at, lanes):
    """Sum of ``lanes`` numbers, a multiple of four, at ``x[at:]``."""
    a = 0.0
    b = 0.0
    c = 0.0
    d = 0.0
    for k in range(lanes // FOUR):
        i = at + FOUR * k
        j = i + 2
        a += x[i]
        b += x[i + 1]
        c += x[j]
        d += x[j + 1]
    return (a + b) + (c + d)


@kernel
def dot_lanes(x, at, y, to, lanes):
    """Sum of the products of ``lanes`` numbers, a multiple of four, at ``x[at:]`` and ``y[to:]``."""
    a = 0.0
    b = 0.0
    c = 0.0
    d = 0.0
    for k in range(lanes // FOUR):
        i = FOUR * k
        j = i + 2
        a += x[at + i] * y[to + i]
        b += x[at + i + 1] * y[to + i + 1]
        c += x[at + j] * y[to + j]
        d += x[at + j + 1] * y[to + j + 1]
    return (a + b) + (c + d)
