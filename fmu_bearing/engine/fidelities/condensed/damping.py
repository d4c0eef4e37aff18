"""What traction takes from the rings' modes, found from the full model's linearisation.

Contact damping is in the condensed forces. Fidelity `full` damps the lowest modes up to ten times more: a
ball whose contact angles vibrate lags behind the orbit and spin axis it should have, and the traction that
drags it along takes energy. For each mode of the rings this reads the damping off the full equations,
linearised about the quasi-static point, with every ball eliminated at the mode's own frequency, and gives the
rings what is missing as a matrix that is symmetric and takes energy only. The pockets' and lands' part is
left out.
"""

import math

from fmu_bearing.engine.dense import eigenvectors, solve_complex
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, C, J, L, P, Q, S, T, Y
from fmu_bearing.engine.newton.body_slopes import inertia
from fmu_bearing.engine.newton.jacobian import jacobian

_SLOWEST = 300.0  # rad/s: slower motions feel the supports, not the balls
_STIFFEST = 1e14  # (rad/s)^2: faster ones are no modes of the rings
_MOST = 0.6  # damping added to a mode at most, over its frequency: a ratio of 0.3


@kernel
def taken(p, jac, shape, omega, w):
    """Damping (1/s) of the rings' motion ``shape`` at ``omega`` (rad/s) by the full equations.

    ``shape``: ``L.N`` numbers, then the same times the rings' masses, scaled to modal mass 1. Returns minus
    the imaginary part of the projected accelerations over ``omega``; -1 where a ball cannot be eliminated.
    """
    re = w[T.BALL_RE : T.BALL_RE + J.BALL * T.BALL_ROW]
    im = w[T.BALL_IM : T.BALL_IM + J.BALL * T.BALL_ROW]
    total = 0.0
    for i in range(L.N):
        for k in range(L.N):
            total += shape[L.N + i] * jac[J.E + i * J.BODIES + Q.SIZE + k] * shape[k] * omega
    for j in range(int(p[P.BALLS])):
        for i in range(J.BALL):
            for k in range(J.BALL):
                row = J.B + i * J.STATES * STRIDE + j
                re[i * T.BALL_ROW + k] = -jac[row + (J.PLACED + k) * STRIDE]
                im[i * T.BALL_ROW + k] = omega if i == k else 0.0
                if k < J.PLACED:
                    im[i * T.BALL_ROW + k] += jac[row + k * STRIDE] / omega
            still = 0.0
            moving = 0.0
            for k in range(L.N):
                still += jac[J.C + (i * J.BODIES + k) * STRIDE + j] * shape[k]
                moving += jac[J.C + (i * J.BODIES + Q.SIZE + k) * STRIDE + j] * shape[k]
            re[i * T.BALL_ROW + J.BALL] = still
            im[i * T.BALL_ROW + J.BALL] = omega * moving
        if not solve_complex(re, im, J.BALL):
            return -1.0
        for k in range(J.BALL):
            by_rate = 0.0
            by_place = 0.0
            for i in range(L.N):
                by_rate += shape[L.N + i] * jac[J.D + (i * J.STATES + J.PLACED + k) * STRIDE + j]
                if k < J.PLACED:
                    by_place += shape[L.N + i] * jac[J.D + (i * J.STATES + k) * STRIDE + j]
            # a ball's place is its rate over i omega
            total += by_rate * im[k * T.BALL_ROW + J.BALL] - by_place * re[k * T.BALL_ROW + J.BALL] / omega
    return -total / omega


@kernel
def add_damping(p, s, w):
    """Fill ``L.EXTRA`` from the derivatives in ``lv`` (made with it at zero) and the quasi-static point."""
    lv = s[S.CONDENSED :]
    jac = s[S.JAC : S.CONDENSED]
    c = lv[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    jacobian(p, c, lv[L.Y0 : L.Y0 + Y.SIZE], 0.0, lv[L.FOUND_SPEED], 0.0, w, jac)
    shape = w[T.SHAPE : T.SHAPE + 2 * L.N]
    modes(p, lv, w)
    for k in range(L.N):
        squared = w[T.VALUES + k * L.N + k]
        if not (squared > _SLOWEST * _SLOWEST and squared < _STIFFEST):
            continue
        omega = math.sqrt(squared)
        own = 0.0
        for i in range(L.N):
            shape[i] = w[T.VECTORS + i * L.N + k]
            shape[L.N + i] = shape[i] * inertia(p, i)
        for i in range(L.N):
            for m in range(L.N):
                own -= shape[L.N + i] * lv[L.JV + i + L.COLUMN * m] * shape[m]
        extra = taken(p, jac, shape, omega, w) - own
        if not (extra > 0.0):
            continue
        extra = min(extra, _MOST * omega)
        for i in range(L.N):
            left = 0.0
            for m in range(L.N):
                left += lv[L.MASS + i + L.COLUMN * m] * shape[m]
            w[T.MOVING + i] = left
        for i in range(L.N):
            for m in range(L.N):
                lv[L.EXTRA + i + L.COLUMN * m] -= w[T.MOVING + i] * extra * w[T.MOVING + m] * inertia(p, m)


@kernel
def modes(p, lv, w):
    """Squared frequencies and mode shapes of modal mass 1 into ``T.VALUES`` and ``T.VECTORS`` of ``w``.

    The mass matrix is own masses times ``L.MASS``, symmetric; the stiffness is symmetrised. First the mass
    matrix is diagonalised, then the stiffness in the coordinates where the mass is the identity.
    """
    for i in range(L.N):
        for k in range(L.N):
            scale = math.sqrt(inertia(p, i) / inertia(p, k))
            back = 1.0 / scale
            w[T.VALUES + i * L.N + k] = 0.5 * (
                scale * lv[L.MASS + i + L.COLUMN * k] + back * lv[L.MASS + k + L.COLUMN * i]
            )
    eigenvectors(w, T.VALUES, w, T.VECTORS, L.N)
    # columns over the roots of the values: U with U^T M U = 1
    for k in range(L.N):
        root = 1.0 / math.sqrt(max(w[T.VALUES + k * L.N + k], 1e-12))
        for i in range(L.N):
            w[T.ROOT + i * L.N + k] = w[T.VECTORS + i * L.N + k] * root / math.sqrt(inertia(p, i))
    for i in range(L.N):
        for k in range(L.N):
            total = 0.0
            for m in range(L.N):
                for n in range(L.N):
                    total -= (
                        w[T.ROOT + m * L.N + i]
                        * inertia(p, m)
                        * lv[L.JX + m + L.COLUMN * n]
                        * w[T.ROOT + n * L.N + k]
                    )
            w[T.VALUES + i * L.N + k] = total
    for i in range(L.N):
        for k in range(i):
            mean = 0.5 * (w[T.VALUES + i * L.N + k] + w[T.VALUES + k * L.N + i])
            w[T.VALUES + i * L.N + k] = mean
            w[T.VALUES + k * L.N + i] = mean
    eigenvectors(w, T.VALUES, w, T.VECTORS, L.N)
    # back to ring coordinates, row by row through the columns just found
    for i in range(L.N):
        for k in range(L.N):
            total = 0.0
            for m in range(L.N):
                total += w[T.ROOT + i * L.N + m] * w[T.VECTORS + m * L.N + k]
            lv[L.EXTRA + i * L.N + k] = total
    for i in range(L.N * L.N):
        w[T.VECTORS + i] = lv[L.EXTRA + i]
    for i in range(L.MATRIX):
        lv[L.EXTRA + i] = 0.0
