"""Derivatives of the rings' accelerations and the rings' static equilibrium, with the balls condensed."""

import math

from fmu_bearing.engine.dense import invert, times
from fmu_bearing.engine.fidelities.condensed.balls import accelerations
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    C_BALL_RADIUS,
    C_ECCENTRICITY,
    C_RACES,
    F_G,
    P_BALL_MASS,
    P_BALLS,
    P_PITCH_RADIUS,
    STRIDE,
    W_F,
    W_Y,
    Y_Q,
    Y_V,
)
from fmu_bearing.engine.layout_condensed import (
    E_COS,
    E_R,
    E_SIN,
    E_X,
    L_INVERSE,
    L_JV,
    L_JX,
    L_MASS,
    T_A,
    T_D,
    T_Q,
    T_SPARE,
    N,
)
from fmu_bearing.engine.newton.jacobian import inertia

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
    """Fill ``L_JX``, ``L_JV`` and ``L_MASS`` at the state in ``w[W_Y:]``; False where balls find no rest.

    The balls' places in ``w`` are those of the state before and after. ``w[W_F + F_G:]`` keeps its
    accelerations.
    """
    q = w[T_Q : T_Q + 12]
    lever = p[P_PITCH_RADIUS]
    if not accelerations(p, c, lv, angle, speed, speed_rate, q, w):
        return False
    base = T_SPARE
    balls = T_SPARE + N
    follow = balls + 2 * _S
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
        into = (L_JX if k < N else L_JV) + 12 * i
        for m in range(N):
            lv[into + m] = (w[W_F + F_G + m] - w[base + m]) / step
        for m in range(2 * _S):
            if k < N:
                w[follow + i * 2 * _S + m] = (w[E_X * _S + m] - w[balls + m]) / step
            w[E_X * _S + m] = w[balls + m]
        if not fine:
            return False
    for i in range(N):
        w[W_F + F_G + i] = w[base + i]
    added_mass(p, c, lv, follow, w)
    return True


@kernel
def across_track(w, j, i, contact_x):
    """Velocity along the track at a contact per unit rate of ring coordinate ``i`` (0-2 x y z, 3 4 tilts)."""
    co = w[E_COS * _S + j]
    si = w[E_SIN * _S + j]
    if i == 1:
        return -co
    if i == 2:
        return -si
    if i == 3:
        return si * contact_x
    if i == 4:
        return -co * contact_x
    return 0.0


@kernel
def added_mass(p, c, lv, follow, w):
    """Identity plus the balls' share of the mass matrix over the rings' own masses, into ``lv[L_MASS:]``.

    In the axial plane the balls follow as their static equilibrium does (``w[follow:]``, derivatives of
    (x, r) by the 11 coordinates). Along the track they roll: the centre goes with the mean of both races,
    and half their difference turns the ball, which counts 2/5 of its mass.
    """
    ball = p[P_BALL_MASS]
    # contacts lie off the bearing's middle by the ball's radius times the sine of about the free angle
    x_o = c[C_BALL_RADIUS] * c[C_RACES] / (c[C_RACES + 2] + 1e-12)
    x_i = -x_o
    for i in range(N):
        for k in range(N):
            total = 0.0
            for j in range(int(p[P_BALLS])):
                a = follow + i * 2 * _S + j
                b = follow + k * 2 * _S + j
                total += w[a] * w[b] + w[a + _S] * w[b + _S]
                ti = across_track(w, j, i, x_i) if i < 5 else 0.0
                tk = across_track(w, j, k, x_i) if k < 5 else 0.0
                oi = across_track(w, j, i - 5 if i < 8 else i - 6, x_o) if i >= 5 and i != 8 else 0.0
                ok = across_track(w, j, k - 5 if k < 8 else k - 6, x_o) if k >= 5 and k != 8 else 0.0
                total += 0.25 * (ti + oi) * (tk + ok) + 0.1 * (ti - oi) * (tk - ok)
            lv[L_MASS + i + 12 * k] = (1.0 if i == k else 0.0) + ball * total / inertia(p, i)


@kernel
def invert_into(lv, w):
    """Inverse of the matrix in ``w[T_SPARE:]`` (rows of 11) into ``lv[L_INVERSE:]``; False if singular."""
    if not invert(w, T_SPARE, N, w, T_SPARE + N * N):
        return False
    for k in range(N):
        for i in range(N):
            lv[L_INVERSE + 12 * k + i] = w[T_SPARE + N * N + i * N + k]
        lv[L_INVERSE + 12 * k + 11] = 0.0
    return True


@kernel
def factor_step(lv, cv, cx, w):
    """Inverse of ``B - cv J_v - cx J_x`` into ``lv[L_INVERSE:]``; False if singular."""
    for i in range(N):
        for k in range(N):
            at = i + 12 * k
            w[T_SPARE + i * N + k] = lv[L_MASS + at] - cv * lv[L_JV + at] - cx * lv[L_JX + at]
    return invert_into(lv, w)


@kernel
def highest_mode(lv, w):
    """Angular frequency (rad/s) of the highest mode, by power iteration; the inverse is left that of B."""
    if not factor_step(lv, 0.0, 0.0, w):
        return 1e9
    for i in range(N):
        w[T_D + i] = 1.0 + 0.1 * i
    size = 0.0
    for _ in range(40):
        times(lv, L_JX, w, T_D, w, T_Q)
        times(lv, L_INVERSE, w, T_Q, w, T_A)
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
    """Find the rings' static equilibrium without unbalance from the guess in ``w[W_Y:]``; whether found.

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
            lv[L_JX + 13 * i] -= 2500.0
        if not factor_step_static(lv, w):
            break
        for i in range(N):
            w[T_A + i] = w[W_F + F_G + i]
        times(lv, L_INVERSE, w, T_A, w, T_D)
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
    for i in range(N):
        for k in range(N):
            w[T_SPARE + i * N + k] = -lv[L_JX + i + 12 * k]
    return invert_into(lv, w)


@kernel
def balls_of(w, lv, at):
    """Copy the balls' places from ``w`` to rows ``at`` and the next of ``lv``."""
    for i in range(_S):
        lv[at + i] = w[E_X * _S + i]
        lv[at + _S + i] = w[E_R * _S + i]
