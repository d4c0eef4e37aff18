"""Sums of scaled vectors, and copies of rows."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STRIDE


@kernel
def whole(n):
    """Return how many of ``n`` numbers make up whole groups of four."""
    return n - n % FOUR


@kernel
def add_scaled(scale, x, y, n):
    """``y += scale * x`` over ``n`` numbers."""
    for i in range(0, whole(n), FOUR):
        store(y, i, load(y, i) + scale * load(x, i))
    for i in range(whole(n), n):
        y[i] += scale * x[i]


@kernel
def sum_scaled(x, scale, y, out, n):
    """``out = x + scale * y`` over ``n`` numbers."""
    for i in range(0, whole(n), FOUR):
        store(out, i, load(x, i) + scale * load(y, i))
    for i in range(whole(n), n):
        out[i] = x[i] + scale * y[i]


@kernel
def copy_rows(x, out, rows, lanes):
    """``out = x`` over the first ``lanes`` of each of some rows."""
    for row in range(0, rows * STRIDE, STRIDE):
        for i in range(row, row + lanes, FOUR):
            store(out, i, load(x, i))
