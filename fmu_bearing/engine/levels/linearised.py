"""Derivatives of the rings' accelerations and the rings' static equilibrium, with the balls condensed."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    C_ECCENTRICITY,
    F_G,
    P_LANES,
    P_PITCH_RADIUS,
    STRIDE,
    W_F,
    W_Y,
    Y_Q,
    Y_V,
)
from fmu_bearing.engine.levels.condensed import accelerations
from fmu_bearing.engine.levels.places import (
    E_R,
    E_X,
    L_INVERSE,
    L_JV,
    L_JX,
    T_A,
    T_D,
    T_Q,
    T_SPARE,
    N,
)

_S = STRIDE
# Differences: displacement 1 nm (0.1 N in 100), tilt the same at the pitch circle, and rates that move the
# advanced displacements by as much. The condensed forces are smooth to 1e-9 N, so differences hold 1e-7.
_MOVE = 1e-9
_RATE = 1e-2
_ROUNDS = 60
_LONGEST = 3e-6  # m: move of a ring in one round, about the approach of a loaded contact


@kernel
def is_tilt(i):
    """Whether coordinate ``i`` is an angle."""
    return i == 3 or i == 4 or i >= 8


@kernel
def derivatives(p, c, lv, angle, speed, speed_rate, w):
    """Derivatives of accelerations at the state in ``w[W_Y:]`` into ``lv``: ``L_JX``, ``L_JV``; False if none.

    The balls' places in ``w`` are those of the state before and after. ``w[W_F + F_G:]`` keeps its
    accelerations.
    """
    lanes = int(p[P_LANES])
    q = w[T_Q : T_Q + N]
    lever = p[P_PITCH_RADIUS]
    if not accelerations(p, c, lv, angle, speed, speed_rate, q, w):
        return False
    base = T_SPARE
    balls = T_SPARE + N
    for i in range(N):
        w[base + i] = w[W_F + F_G + i]
    for i in range(2 * _S):
        w[balls + i] = w[E_X * _S + i]
    for k in range(2 * N):
        i = k if k < N else k - N
        at = W_Y + (Y_Q if k < N else Y_V) + i
        step = _MOVE if k < N else _RATE
        if is_tilt(i):
            step /= lever
        kept = w[at]
        w[at] = kept + step
        fine = accelerations(p, c, lv, angle, speed, speed_rate, q, w)
        w[at] = kept
        into = (L_JX if k < N else L_JV) + i
        for m in range(N):
            lv[into + m * N] = (w[W_F + F_G + m] - w[base + m]) / step
        for m in range(2 * _S):
            w[E_X * _S + m] = w[balls + m]
        if not fine:
            return False
    for i in range(N):
        w[W_F + F_G + i] = w[base + i]
    return True


@kernel
def invert(a, at, n, out, to):
    """Inverse of the ``n`` x ``n`` matrix ``a[at:]`` (destroyed) into ``out[to:]``; False if singular."""
    for i in range(n):
        for j in range(n):
            out[to + i * n + j] = 1.0 if i == j else 0.0
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(a[at + i * n + k]) > abs(a[at + pivot * n + k]):
                pivot = i
        size = a[at + pivot * n + k]
        if not (abs(size) > 0.0 and abs(size) < 1e300):
            return False
        per = 1.0 / size
        for j in range(n):
            kept = a[at + k * n + j]
            a[at + k * n + j] = a[at + pivot * n + j] * per
            a[at + pivot * n + j] = kept if pivot != k else a[at + k * n + j]
            kept = out[to + k * n + j]
            out[to + k * n + j] = out[to + pivot * n + j] * per
            out[to + pivot * n + j] = kept if pivot != k else out[to + k * n + j]
        for i in range(n):
            if i != k:
                factor = a[at + i * n + k]
                for j in range(n):
                    a[at + i * n + j] -= factor * a[at + k * n + j]
                    out[to + i * n + j] -= factor * out[to + k * n + j]
    return True


@kernel
def factor_step(lv, cv, cx, w):
    """Inverse of ``I - cv J_v - cx J_x`` into ``lv[L_INVERSE:]``; False if singular."""
    for i in range(N * N):
        w[T_SPARE + i] = -cv * lv[L_JV + i] - cx * lv[L_JX + i]
    for i in range(N):
        w[T_SPARE + i * N + i] += 1.0
    return invert(w, T_SPARE, N, lv, L_INVERSE)


@kernel
def times(lv, at, w, source, target):
    """``w[target:] = matrix w[source:]`` with the matrix of 11 x 11 numbers at ``lv[at:]``."""
    for i in range(N):
        row = at + i * N
        a = 0.0
        b = 0.0
        d = 0.0
        for j in range(0, 9, 3):
            a += lv[row + j] * w[source + j]
            b += lv[row + j + 1] * w[source + j + 1]
            d += lv[row + j + 2] * w[source + j + 2]
        a += lv[row + 9] * w[source + 9]
        b += lv[row + 10] * w[source + 10]
        w[target + i] = (a + b) + d


@kernel
def highest_mode(lv, w):
    """Angular frequency (rad/s) of the highest mode, from ``L_JX`` by power iteration."""
    for i in range(N):
        w[T_D + i] = 1.0 + 0.1 * i
    size = 0.0
    for _ in range(40):
        times(lv, L_JX, w, T_D, T_A)
        total = 0.0
        before = 0.0
        for i in range(N):
            total += w[T_A + i] * w[T_A + i]
            before += w[T_D + i] * w[T_D + i]
        size = math.sqrt(total / before)
        for i in range(N):
            w[T_D + i] = -w[T_A + i] / (size + 1e-300)
    return math.sqrt(size)


@kernel
def at_rest(p, c, lv, speed, w):
    """Static equilibrium of the rings without unbalance, from the guess in ``w[W_Y:]``; whether found.

    Newton's method with moves of a few micrometres at most; soft directions (no preload) are held by a
    floor of (50 rad/s)^2 on the diagonal, a hundredth of the lowest spring that a scene's pedestal makes.
    """
    lever = p[P_PITCH_RADIUS]
    eccentricity = c[C_ECCENTRICITY]
    c[C_ECCENTRICITY] = 0.0
    found = False
    for _ in range(_ROUNDS):
        if not derivatives(p, c, lv, 0.0, speed, 0.0, w):
            break
        for i in range(N):
            lv[L_JX + i * N + i] -= 2500.0
        if not factor_step_static(lv, w):
            break
        for i in range(N):
            w[T_A + i] = w[W_F + F_G + i]
        times(lv, L_INVERSE, w, T_A, T_D)
        longest = 0.0
        for i in range(N):
            longest = max(longest, abs(w[T_D + i]) * (lever if is_tilt(i) else 1.0))
        if not (longest < 1e3):
            break
        share = min(1.0, _LONGEST / (longest + 1e-300))
        for i in range(N):
            w[W_Y + Y_Q + i] += share * w[T_D + i]
        if longest < 1e-12:
            found = True
            break
    c[C_ECCENTRICITY] = eccentricity
    return found


@kernel
def factor_step_static(lv, w):
    """Inverse of ``-J_x`` into ``lv[L_INVERSE:]``; False if singular."""
    for i in range(N * N):
        w[T_SPARE + i] = -lv[L_JX + i]
    return invert(w, T_SPARE, N, lv, L_INVERSE)


@kernel
def balls_of(w, lv, at):
    """Copy the balls' places from ``w`` to rows ``at`` and the next of ``lv``."""
    for i in range(_S):
        lv[at + i] = w[E_X * _S + i]
        lv[at + _S + i] = w[E_R * _S + i]
