"""Vectors in space: three components, each of four balls or of one, in each ball's own axes x, r, theta."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import STRIDE


@kernel
def three(x, at):
    """Load a vector of four balls: three rows from ``x[at:]`` on."""
    return load(x, at), load(x, at + STRIDE), load(x, at + 2 * STRIDE)


@kernel
def store_three(x, at, value):
    """Write a vector of four balls into three rows from ``x[at:]`` on."""
    first, second, third = value
    store(x, at, first)
    store(x, at + STRIDE, second)
    store(x, at + 2 * STRIDE, third)


@kernel
def dot(a, b):
    """Scalar product."""
    ax, ar, at = a
    bx, br, bt = b
    return ax * bx + ar * br + at * bt


@kernel
def cross(a, b):
    """Vector product."""
    ax, ar, at = a
    bx, br, bt = b
    return ar * bt - at * br, at * bx - ax * bt, ax * br - ar * bx


@kernel
def scaled(factor, a):
    """``factor`` times a vector."""
    x, r, t = a
    return factor * x, factor * r, factor * t


@kernel
def added(a, b):
    """Sum of two vectors."""
    ax, ar, at = a
    bx, br, bt = b
    return ax + bx, ar + br, at + bt


@kernel
def along(u, a, v, b, w, c):
    """Vector with components ``u``, ``v``, ``w`` along ``a``, ``b``, ``c``."""
    return added(added(scaled(u, a), scaled(v, b)), scaled(w, c))
