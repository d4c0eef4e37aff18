"""The Newton system (I - cv Jv - cx Jx) d = r in accelerations: one 6 x 6 block per ball, a border of 17.

The balls are eliminated first; what remains for the bodies is inverted once per factorisation. Between
factorisations the bearing turns: the solve turns the bodies' y, z pairs back by the orbit angle passed
since, which keeps an old Jacobian exact for equal ball loads and an isotropic pedestal.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    A_GB,
    A_INV,
    A_S,
    A_SPRING_BALLS,
    A_W,
    F_G,
    J_B,
    J_C,
    J_D,
    J_E,
    N_BODY,
    P_BALLS,
    P_CAGE,
    P_LANES,
    P_SPRINGS,
    STRIDE,
    W_FORCE,
)
from fmu_bearing.engine.solvers.spring_coupling import couple_springs, spring_matrix

_S = STRIDE


@kernel
def invert_blocks(a, at, lanes):
    """Invert the 6 x 6 blocks of all lanes in place (Gauss-Jordan; the blocks' diagonals dominate)."""
    for k in range(6):
        kk = at + (k * 6 + k) * _S
        for j in range(lanes):
            a[kk + j] = 1.0 / a[kk + j]
        for m in range(6):
            if m != k:
                km = at + (k * 6 + m) * _S
                for j in range(lanes):
                    a[km + j] *= a[kk + j]
        for i in range(6):
            if i != k:
                ik = at + (i * 6 + k) * _S
                for m in range(6):
                    if m != k:
                        im = at + (i * 6 + m) * _S
                        km = at + (k * 6 + m) * _S
                        for j in range(lanes):
                            a[im + j] -= a[ik + j] * a[km + j]
                for j in range(lanes):
                    a[ik + j] *= -a[kk + j]


@kernel
def invert_border(a, at, n, w):
    """Invert the ``n`` x ``n`` matrix at ``a[at:]`` in place with row pivoting; False if singular.

    ``w``: scratch for ``n`` pivot indices.
    """
    for k in range(n):
        pivot = k
        best = abs(a[at + k * n + k])
        for i in range(k + 1, n):
            size = abs(a[at + i * n + k])
            if size > best:
                best = size
                pivot = i
        if not (best > 0.0 and best < 1e300):
            return False
        w[k] = float(pivot)
        if pivot != k:
            for m in range(n):
                kept = a[at + k * n + m]
                a[at + k * n + m] = a[at + pivot * n + m]
                a[at + pivot * n + m] = kept
        inv = 1.0 / a[at + k * n + k]
        a[at + k * n + k] = 1.0
        for m in range(n):
            a[at + k * n + m] *= inv
        for i in range(n):
            if i != k:
                factor = a[at + i * n + k]
                a[at + i * n + k] = 0.0
                for m in range(n):
                    a[at + i * n + m] -= factor * a[at + k * n + m]
    for back in range(n):
        k = n - 1 - back
        pivot = int(w[k])
        if pivot != k:
            for i in range(n):
                kept = a[at + i * n + k]
                a[at + i * n + k] = a[at + i * n + pivot]
                a[at + i * n + pivot] = kept
    return True


@kernel
def factor(p, jac, cv, cx, fac, w):
    """Factor I - cv Jv - cx Jx from the blocks ``jac`` into ``fac``; False if singular."""
    lanes = int(p[P_LANES])
    balls = int(p[P_BALLS])
    scratch = W_FORCE * _S
    for i in range(6):
        for k in range(6):
            out = A_INV + (i * 6 + k) * _S
            one = 1.0 if i == k else 0.0
            vel = J_B + (i * 9 + 3 + k) * _S
            pos = J_B + (i * 9 + k) * _S
            scale = cx if k < 3 else 0.0
            for j in range(lanes):
                fac[out + j] = one - cv * jac[vel + j] - scale * jac[pos + j]
    invert_blocks(fac, A_INV, lanes)
    for g in range(N_BODY):
        for i in range(6):
            pos = J_C + (i * 34 + g) * _S
            vel = J_C + (i * 34 + N_BODY + g) * _S
            for j in range(lanes):
                w[scratch + i * _S + j] = -cv * jac[vel + j] - cx * jac[pos + j]
        for i in range(6):
            out = A_W + (i * N_BODY + g) * _S
            for j in range(lanes):
                fac[out + j] = 0.0
            for k in range(6):
                inv = A_INV + (i * 6 + k) * _S
                for j in range(lanes):
                    fac[out + j] += fac[inv + j] * w[scratch + k * _S + j]
        for k in range(6):
            out = A_GB + (g * 6 + k) * _S
            pos = J_D + (g * 9 + k) * _S
            vel = J_D + (g * 9 + 3 + k) * _S
            scale = cx if k < 3 else 0.0
            for j in range(lanes):
                fac[out + j] = -cv * jac[vel + j] - scale * jac[pos + j]
    for g in range(N_BODY):
        for h in range(N_BODY):
            total = 1.0 if g == h else 0.0
            total -= cv * jac[J_E + g * 34 + N_BODY + h] + cx * jac[J_E + g * 34 + h]
            for k in range(6):
                left = A_GB + (g * 6 + k) * _S
                right = A_W + (k * N_BODY + h) * _S
                for j in range(balls):
                    total -= fac[left + j] * fac[right + j]
            fac[A_S + g * N_BODY + h] = total
    fine = invert_border(fac, A_S, N_BODY, w[scratch : scratch + N_BODY])
    if fine and p[P_SPRINGS] != 0.0 and p[P_CAGE] == 0.0:
        spring_matrix(p, cv, cx, fac, w)
        fine = invert_border(fac, A_SPRING_BALLS, balls, w[scratch : scratch + balls])
    return fine


@kernel
def turn_pairs(x, at, c, s):
    """Turn the y, z pairs of translations and tilts of the three bodies by the angle of (c, s)."""
    for k in range(6):
        i = at + (1 if k == 0 else 3 if k == 1 else 6 if k == 2 else 9 if k == 3 else 12 if k == 4 else 15)
        y = x[i]
        z = x[i + 1]
        x[i] = c * y - s * z
        x[i + 1] = s * y + c * z


@kernel
def solve(p, fac, angle, d, w):
    """Solve in place: ``d`` (layout of f) holds the residual, then the increment; ``angle`` turned (rad)."""
    lanes = int(p[P_LANES])
    balls = int(p[P_BALLS])
    scratch = W_FORCE * _S
    c = math.cos(angle)
    s = math.sin(angle)
    turn_pairs(d, F_G, c, -s)
    for i in range(6):
        out = scratch + i * _S
        for j in range(lanes):
            w[out + j] = fac[A_INV + i * 6 * _S + j] * d[j]
        for k in range(1, 6):
            inv = A_INV + (i * 6 + k) * _S
            for j in range(lanes):
                w[out + j] += fac[inv + j] * d[k * _S + j]
    for g in range(N_BODY):
        total = d[F_G + g]
        for k in range(6):
            left = A_GB + (g * 6 + k) * _S
            for j in range(balls):
                total -= fac[left + j] * w[scratch + k * _S + j]
        w[scratch + 6 * _S + g] = total
    for g in range(N_BODY):
        total = 0.0
        for h in range(N_BODY):
            total += fac[A_S + g * N_BODY + h] * w[scratch + 6 * _S + h]
        d[F_G + g] = total
    if p[P_SPRINGS] != 0.0 and p[P_CAGE] == 0.0:
        couple_springs(p, fac, d, w)
    for i in range(6):
        for j in range(lanes):
            d[i * _S + j] = w[scratch + i * _S + j]
        for g in range(N_BODY):
            body = d[F_G + g]
            row = A_W + (i * N_BODY + g) * _S
            for j in range(lanes):
                d[i * _S + j] -= fac[row + j] * body
    turn_pairs(d, F_G, c, s)
