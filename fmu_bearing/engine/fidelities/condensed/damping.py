"""What traction takes from the rings' modes, found from the full model's linearisation.

Contact damping is in the condensed forces. Level `full` damps the lowest modes up to ten times more: a ball
whose contact angles vibrate lags behind the orbit and spin axis it should have, and the traction that drags
it along takes energy. For each mode of the rings this reads the damping off the full equations, linearised
about the quasi-static point, with every ball eliminated at the mode's own frequency, and gives the rings
what is missing as a matrix that is symmetric and takes energy only. The pockets' and lands' part is left out.
"""

import math

from fmu_bearing.engine.dense import eigenvectors, solve_complex
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C_SIZE, J_B, J_C, J_D, J_E, P_BALLS, S_JAC, S_LEVEL, STRIDE, Y_SIZE
from fmu_bearing.engine.layout_condensed import (
    L_C,
    L_EXTRA,
    L_FOUND_SPEED,
    L_JV,
    L_JX,
    L_MASS,
    L_Y,
    MATRIX,
    T_SPARE,
    N,
)
from fmu_bearing.engine.newton.jacobian import inertia, jacobian

_S = STRIDE
_SLOWEST = 300.0  # rad/s: slower motions feel the supports, not the balls
_MOST = 0.6  # damping added to a mode at most, over its frequency: a ratio of 0.3


@kernel
def taken(p, jac, shape, omega, w):
    """Damping (1/s) of the rings' motion ``shape`` at ``omega`` (rad/s) by the full equations.

    ``shape``: 11 numbers, then the same times the rings' masses, scaled to modal mass 1. Returns minus the
    imaginary part of the projected accelerations over ``omega``; -1 where a ball cannot be eliminated.
    """
    re = w[T_SPARE + 400 : T_SPARE + 442]
    im = w[T_SPARE + 442 : T_SPARE + 484]
    total = 0.0
    for i in range(N):
        for k in range(N):
            total += shape[N + i] * jac[J_E + i * 34 + 17 + k] * shape[k] * omega
    for j in range(int(p[P_BALLS])):
        for i in range(6):
            for k in range(6):
                row = J_B + i * 9 * _S + j
                re[i * 7 + k] = -jac[row + (3 + k) * _S]
                im[i * 7 + k] = omega if i == k else 0.0
                if k < 3:
                    im[i * 7 + k] += jac[row + k * _S] / omega
            still = 0.0
            moving = 0.0
            for k in range(N):
                still += jac[J_C + (i * 34 + k) * _S + j] * shape[k]
                moving += jac[J_C + (i * 34 + 17 + k) * _S + j] * shape[k]
            re[i * 7 + 6] = still
            im[i * 7 + 6] = omega * moving
        if not solve_complex(re, im, 6):
            return -1.0
        for k in range(6):
            by_rate = 0.0
            by_place = 0.0
            for i in range(N):
                by_rate += shape[N + i] * jac[J_D + (i * 9 + 3 + k) * _S + j]
                if k < 3:
                    by_place += shape[N + i] * jac[J_D + (i * 9 + k) * _S + j]
            # a ball's place is its rate over i omega
            total += by_rate * im[k * 7 + 6] - by_place * re[k * 7 + 6] / omega
    return -total / omega


@kernel
def add_damping(p, s, w):
    """Fill ``L_EXTRA`` from the derivatives in ``lv`` (made with it at zero) and the quasi-static point."""
    lv = s[S_LEVEL:]
    jac = s[S_JAC:S_LEVEL]
    jacobian(
        p, lv[L_C : L_C + C_SIZE], lv[L_Y : L_Y + Y_SIZE], 0.0, lv[L_FOUND_SPEED], 0.0, w, jac
    )  # fmt: skip
    values = T_SPARE
    vectors = T_SPARE + N * N
    mass = vectors + N * N
    shape = w[mass + N * N : mass + N * N + 2 * N]
    modes(p, lv, w, values, vectors, mass)
    for k in range(N):
        squared = w[values + k * N + k]
        if not (squared > _SLOWEST * _SLOWEST and squared < 1e14):
            continue
        omega = math.sqrt(squared)
        own = 0.0
        for i in range(N):
            shape[i] = w[vectors + i * N + k]
            shape[N + i] = shape[i] * inertia(p, i)
        for i in range(N):
            for m in range(N):
                own -= shape[N + i] * lv[L_JV + i + 12 * m] * shape[m]
        extra = taken(p, jac, shape, omega, w) - own
        if not (extra > 0.0):
            continue
        extra = min(extra, _MOST * omega)
        for i in range(N):
            left = 0.0
            for m in range(N):
                left += lv[L_MASS + i + 12 * m] * shape[m]
            w[mass + i] = left
        for i in range(N):
            for m in range(N):
                lv[L_EXTRA + i + 12 * m] -= w[mass + i] * extra * w[mass + m] * inertia(p, m)


@kernel
def modes(p, lv, w, values, vectors, mass):
    """Squared frequencies (diagonal of ``w[values:]``) and mode shapes (columns) of modal mass 1.

    The mass matrix is own masses times ``L_MASS``, symmetric; the stiffness is symmetrised. First the mass
    matrix is diagonalised, then the stiffness in the coordinates where the mass is the identity.
    """
    for i in range(N):
        for k in range(N):
            scale = math.sqrt(inertia(p, i) / inertia(p, k))
            back = 1.0 / scale
            w[values + i * N + k] = 0.5 * (scale * lv[L_MASS + i + 12 * k] + back * lv[L_MASS + k + 12 * i])
    eigenvectors(w, values, w, vectors, N)
    # columns over the roots of the values: U with U^T M U = 1
    for k in range(N):
        root = 1.0 / math.sqrt(max(w[values + k * N + k], 1e-12))
        for i in range(N):
            w[mass + i * N + k] = w[vectors + i * N + k] * root / math.sqrt(inertia(p, i))
    for i in range(N):
        for k in range(N):
            total = 0.0
            for m in range(N):
                for n in range(N):
                    total -= w[mass + m * N + i] * inertia(p, m) * lv[L_JX + m + 12 * n] * w[mass + n * N + k]
            w[values + i * N + k] = total
    for i in range(N):
        for k in range(i):
            mean = 0.5 * (w[values + i * N + k] + w[values + k * N + i])
            w[values + i * N + k] = mean
            w[values + k * N + i] = mean
    eigenvectors(w, values, w, vectors, N)
    # back to ring coordinates, row by row through the columns just found
    for i in range(N):
        for k in range(N):
            total = 0.0
            for m in range(N):
                total += w[mass + i * N + m] * w[vectors + m * N + k]
            lv[L_EXTRA + i * N + k] = total
    for i in range(N * N):
        w[vectors + i] = lv[L_EXTRA + i]
    for i in range(MATRIX):
        lv[L_EXTRA + i] = 0.0
