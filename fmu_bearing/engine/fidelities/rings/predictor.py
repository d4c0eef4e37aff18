"""First guess of a step of fidelity `rings`, and what a change of its length does to the velocities.

Accelerations and balls' places are continued by the polynomial through the last few of them. High degrees
serve smooth motion; what moves by more than a radian in a step they only make larger. So the degree is the
one whose guess lately was best.
"""

import math

from fmu_bearing.engine.dense import times
from fmu_bearing.engine.fidelities.condensed.publish import rate_error
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, load, select, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, L, P, T, W, Y

_HIGHEST = L.HISTORY - 1  # degree
_FORGET = 0.9  # per step: what is left of an old error


@kernel
def change_spacing(lv, h):
    """Exchange the part of the velocities that belongs to the step, if that changes; forget the history."""
    if abs(h - lv[L.SPACING]) > 1e-6 * h:
        old = lv[L.SPACING]
        if old > 0.0:
            for i in range(L.N):
                lv[L.JERK + i] = 12.0 / (old * old) * rate_error(lv, i)
                lv[L.V0 + i] += (h * h - old * old) / 12.0 * lv[L.JERK + i]
        lv[L.SPACING] = h
        lv[L.KNOWN] = 0.0
        lv[L.CALM] = 0.0


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
def predict(p, lv, h, w):
    """Trial state in ``w[W.STAGE:]``, trial accelerations in ``T.A``, balls' places continued."""
    c0, c1, c2, c3, c4 = weights(min(lv[L.DEGREE], lv[L.KNOWN]))
    for i in range(L.N):
        now = lv[L.A0 + i]
        a = c0 * now + c1 * lv[L.A1 + i] + c2 * lv[L.A2 + i] + c3 * lv[L.A3 + i] + c4 * lv[L.A4 + i]
        w[T.A + i] = a
        w[T.D + i] = a - now
        w[W.STAGE + Y.Q0 + i] = lv[L.Q0 + i] + h * (lv[L.V0 + i] + 0.5 * h * now)
        w[W.STAGE + Y.V0 + i] = lv[L.V0 + i] + 0.5 * h * (now + a)
    displace(lv, h, w)
    continue_places(lv, int(p[P.LANES]), min(lv[L.KNOWN], _HIGHEST), w)


@kernel
def displace(lv, h, w):
    """Add to the trial displacements what the change ``T.D`` of the trial accelerations moves them by.

    Newmark's beta is the matrix 1/12 - h^2/240 B^-1 J_x: for a mode of frequency omega the first two terms
    of 1/(2 - 2 cos omega h) - 1/(omega h)^2, with which the step turns it by omega h exactly.
    """
    times(lv, L.SQUARES, w, T.D, w, T.Q)
    for i in range(L.N):
        w[W.STAGE + Y.Q0 + i] += h * h / 12.0 * (w[T.D + i] - h * h / 20.0 * w[T.Q + i])


@kernel
def continue_places(lv, lanes, degree, w):
    """Continue the balls' places; one that found no rest in the steps before stays where it is."""
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
def judge(lv, w):
    """Update the errors of all degrees by the accelerations found in ``T.A``, and choose the best.

    The error of the polynomial of degree n is the backward difference of order n + 1. Returns that of order
    3 (m/s2), tilts at the pitch radius; 0 where too few accelerations are known.
    """
    e0 = splat(0.0)
    e1 = splat(0.0)
    e2 = splat(0.0)
    e3 = splat(0.0)
    e4 = splat(0.0)
    for i in range(0, L.COLUMN, FOUR):
        lever = load(lv, L.LEVERS + i)
        a0 = load(lv, L.A0 + i)
        a1 = load(lv, L.A1 + i)
        a2 = load(lv, L.A2 + i)
        a3 = load(lv, L.A3 + i)
        a = load(w, T.A + i) - a0
        b = a0 - a1
        c = a1 - a2
        d = a2 - a3
        e = a3 - load(lv, L.A4 + i)
        e0 = max(e0, lever * abs(a))
        e1 = max(e1, lever * abs(a - b))
        e2 = max(e2, lever * abs(a - 2.0 * b + c))
        e3 = max(e3, lever * abs(a - 3.0 * (b - c) - d))
        e4 = max(e4, lever * abs(a - 4.0 * (b + d) + 6.0 * c + e))
    third = largest(e2)
    w[T.D] = largest(e0)
    w[T.D + 1] = largest(e1)
    w[T.D + 2] = third
    rest = T.D + 2
    w[rest + 1] = largest(e3)
    w[rest + 2] = largest(e4)
    best = 0.0
    least = math.inf
    for n in range(L.HISTORY):
        if lv[L.KNOWN] >= n:
            error = max(w[T.D + n], _FORGET * lv[L.ERRORS + n])
            lv[L.ERRORS + n] = error
            if error <= least:
                least = error
                best = float(n)
    lv[L.DEGREE] = best
    return third if lv[L.KNOWN] >= 2.0 else 0.0
