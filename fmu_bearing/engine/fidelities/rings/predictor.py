"""First guess of a step of fidelity `rings`, and what a change of its length does to the velocities.

Accelerations and balls' places are continued by the polynomial through the last few of them. High degrees
serve smooth motion; what moves by more than a radian in a step they only make larger. So the degree is the
one whose guess lately was best.

``x``: the set's own state, where ``numbers`` and ``vectors`` are the places of the march's numbers and
vectors (layout ``H``); ``w``: the set's own work space, in which ``a``, ``d``, ``q`` and ``v`` are places of
vectors of the ``n`` coordinates, ``lanes`` numbers each; ``h``: s. In `continue_places`, ``w`` and ``lanes``
are one bearing's work space and its balls' lanes.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, load, select, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, H, L, T

_HIGHEST = L.HISTORY - 1  # degree
_FORGET = 0.9  # per step: what is left of an old error
_LONGER = 64.0  # times the step before, chosen: a first step of 1e-15 s says nothing


@kernel
def rate_error(x, numbers, vectors, lanes, i):
    """By how much Newmark's velocity exceeds the true one: h^2/12 times the rate of acceleration (m/s)."""
    h = x[numbers + H.SPACING]
    at = vectors + i
    if x[numbers + H.KNOWN] >= 2.0:
        now = x[at + H.A0 * lanes]
        return h / 24.0 * (3.0 * now - 4.0 * x[at + H.A1 * lanes] + x[at + H.A2 * lanes])
    return h * h / 12.0 * x[at + H.JERK * lanes]


@kernel
def change_spacing(x, numbers, vectors, lanes, n, h):
    """Exchange the part of the velocities that belongs to the step, if that changes; forget the history."""
    if abs(h - x[numbers + H.SPACING]) > 1e-6 * h:
        old = x[numbers + H.SPACING]
        if old > 0.0:
            jerk = vectors + H.JERK * lanes
            # a rate over a step says nothing about one that is far longer
            kept = 1.0 if h < _LONGER * old else 0.0
            for i in range(n):
                part = rate_error(x, numbers, vectors, lanes, i)
                x[jerk + i] = kept * 12.0 / (old * old) * part
                x[vectors + H.V0 * lanes + i] += h * h / 12.0 * x[jerk + i] - part
        x[numbers + H.SPACING] = h
        x[numbers + H.KNOWN] = 0.0
        x[numbers + H.CALM] = 0.0


@kernel
def forget(x, numbers, vectors, lanes):
    """Forget all that the march keeps but the levers, as at the start."""
    for i in range(H.NUMBERS):
        x[numbers + i] = 0.0
    for k in range(H.VECTORS):
        for i in range(lanes if k != H.LEVERS else 0):
            x[vectors + k * lanes + i] = 0.0


@kernel
def weights(degree):
    """Weights of the last five values in the polynomial through ``degree + 1`` of them, one step ahead."""
    if degree >= 4.0:
        return 5.0, -10.0, 10.0, -5.0, 1.0
    if degree >= 3.0:
        return 4.0, -6.0, 4.0, -1.0, 0.0
    if degree >= 2.0:
        return 3.0, -3.0, 1.0, 0.0, 0.0
    if degree >= 1.0:
        return 2.0, -1.0, 0.0, 0.0, 0.0
    return 1.0, 0.0, 0.0, 0.0, 0.0


@kernel
def guess(x, numbers, vectors, lanes, h, w, a, d, q, v):
    """Trial accelerations to ``w[a:]``, their change to ``w[d:]``, places to ``w[q:]``, rates to ``w[v:]``.

    The places lack what :func:`displaced` adds.
    """
    c0, c1, c2, c3, c4 = weights(min(x[numbers + H.DEGREE], x[numbers + H.KNOWN]))
    for i in range(0, lanes, FOUR):
        now = load(x, vectors + H.A0 * lanes + i)
        rate = load(x, vectors + H.V0 * lanes + i)
        ahead = c0 * now + c1 * load(x, vectors + H.A1 * lanes + i) + c2 * load(x, vectors + H.A2 * lanes + i)
        ahead += c3 * load(x, vectors + H.A3 * lanes + i) + c4 * load(x, vectors + H.A4 * lanes + i)
        store(w, a + i, ahead)
        store(w, d + i, ahead - now)
        store(w, q + i, load(x, vectors + H.Q0 * lanes + i) + h * (rate + 0.5 * h * now))
        store(w, v + i, rate + 0.5 * h * (now + ahead))


@kernel
def displaced(w, d, turned, q, lanes, h):
    """Add to the places at ``w[q:]`` what the change ``w[d:]`` of the trial accelerations moves them by.

    Newmark's beta is the matrix 1/12 - h^2/240 B^-1 J_x: for a mode of frequency omega the first two terms
    of 1/(2 - 2 cos omega h) - 1/(omega h)^2, with which the step turns it by omega h exactly. ``turned``:
    place of B^-1 J_x times the change.
    """
    for i in range(0, lanes, FOUR):
        moved = load(w, d + i) - h * h / 20.0 * load(w, turned + i)
        store(w, q + i, load(w, q + i) + h * h / 12.0 * moved)


@kernel
def true_velocities(x, numbers, vectors, lanes, h, w, a, v, out):
    """Put to ``w[out:]`` Newmark's velocities ``w[v:]`` minus h^2/12 times the rate of acceleration."""
    known = x[numbers + H.KNOWN] >= 1.0
    longer = x[numbers + H.KNOWN] >= 2.0
    a0 = vectors + H.A0 * lanes
    a1 = vectors + H.A1 * lanes
    a2 = vectors + H.A2 * lanes
    for i in range(0, lanes, FOUR):
        now = load(x, a0 + i)
        before = load(x, a1 + i)
        change = load(w, a + i) - now
        earlier = now - before
        third = change - 2.0 * earlier + (before - load(x, a2 + i)) if longer else splat(0.0)
        rate = 0.5 * (3.0 * change - earlier) + third / 3.0 if known else change
        store(w, out + i, load(w, v + i) - h / 12.0 * rate)


@kernel
def last_counts(known):
    """Return what the last acceleration counts in its own rate, times h, with ``known`` earlier steps."""
    return 11.0 / 6.0 if known >= 2.0 else (1.5 if known >= 1.0 else 1.0)


@kernel
def move_on(x, vectors, lanes, w, a, q, v):
    """Make trial accelerations, places and velocities (``w[a:]``, ``w[q:]``, ``w[v:]``) the present ones."""
    for i in range(vectors, vectors + lanes, FOUR):
        for k in range(H.A4, H.A0, -1):
            store(x, k * lanes + i, load(x, (k - 1) * lanes + i))
        store(x, H.A0 * lanes + i, load(w, a + i - vectors))
        store(x, H.Q0 * lanes + i, load(w, q + i - vectors))
        store(x, H.V0 * lanes + i, load(w, v + i - vectors))


@kernel
def continue_places(lv, lanes, w):
    """Continue the balls' places; one that found no rest in the steps before stays where it is."""
    degree = min(lv[L.KNOWN], _HIGHEST)
    c0, c1, c2, c3, c4 = weights(degree)
    for j in range(0, lanes, FOUR):
        settled = load(lv, L.SETTLED + j) > degree
        for row in range(0, 2 * STRIDE, STRIDE):
            at = row + j
            x = load(lv, L.X + at)
            ahead = c0 * x + c1 * load(lv, L.X1 + at) + c2 * load(lv, L.X2 + at)
            ahead += c3 * load(lv, L.X3 + at) + c4 * load(lv, L.X4 + at)
            store(w, T.X + at, select(settled, ahead, x))


@kernel
def largest(value):
    """Largest of four lanes."""
    return max(max(lane(value, 0), lane(value, 1)), max(lane(value, 2), lane(value, 3)))


@kernel
def judged(x, numbers, vectors, lanes, w, a, d):
    """Update the errors of all degrees by the accelerations found at ``w[a:]``, and choose the best.

    The error of the polynomial of degree n is the backward difference of order n + 1. Returns that of order
    3 (m/s2), tilts at their levers; 0 where too few accelerations are known. ``w[d:]``: scratch.
    """
    e0 = splat(0.0)
    e1 = splat(0.0)
    e2 = splat(0.0)
    e3 = splat(0.0)
    e4 = splat(0.0)
    for i in range(0, lanes, FOUR):
        lever = load(x, vectors + H.LEVERS * lanes + i)
        a0 = load(x, vectors + H.A0 * lanes + i)
        a1 = load(x, vectors + H.A1 * lanes + i)
        a2 = load(x, vectors + H.A2 * lanes + i)
        a3 = load(x, vectors + H.A3 * lanes + i)
        first = load(w, a + i) - a0
        b = a0 - a1
        c = a1 - a2
        third = a2 - a3
        e = a3 - load(x, vectors + H.A4 * lanes + i)
        e0 = max(e0, lever * abs(first))
        e1 = max(e1, lever * abs(first - b))
        e2 = max(e2, lever * abs(first - 2.0 * b + c))
        e3 = max(e3, lever * abs(first - 3.0 * (b - c) - third))
        e4 = max(e4, lever * abs(first - 4.0 * (b + third) + 6.0 * c + e))
    error = largest(e2)
    w[d] = largest(e0)
    w[d + 1] = largest(e1)
    w[d + 2] = error
    rest = d + 2
    w[rest + 1] = largest(e3)
    w[rest + 2] = largest(e4)
    best = 0.0
    least = math.inf
    known = x[numbers + H.KNOWN]
    for n in range(H.LENGTH):
        if known >= n:
            worst = max(w[d + n], _FORGET * x[numbers + H.ERRORS + n])
            x[numbers + H.ERRORS + n] = worst
            if worst <= least:
                least = worst
                best = float(n)
    x[numbers + H.DEGREE] = best
    return error if known >= 2.0 else 0.0
