"""Sums of scaled vectors.

Callers pass slices, so that indices begin at zero: with an offset inside the index the compiler finds no
vector loop.
"""

from fmu_bearing.engine.jit import inlined


@inlined
def add_scaled(scale, x, y, n):
    """``y += scale * x`` over ``n`` numbers."""
    for i in range(n):
        y[i] += scale * x[i]


@inlined
def sum_scaled(x, scale, y, out, n):
    """``out = x + scale * y`` over ``n`` numbers."""
    for i in range(n):
        out[i] = x[i] + scale * y[i]
