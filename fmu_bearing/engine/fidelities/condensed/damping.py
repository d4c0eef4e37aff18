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
from fmu_bearing.engine.layout import C, J, L, P, S, T, Y
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.newton.jacobian import inertia, jacobian

_SLOWEST = 300.0  # rad/s: slower motions feel the supports, not the balls
_MOST = 0.6  # damping added to a mode at most, over its frequency: a ratio of 0.3


@kernel
def taken(p, jac, shape, omega, w):
    """Damping (1/s) of the rings' motion ``shape`` at ``omega`` (rad/s) by the full equations.

    ``shape``: 11 numbers, then the same times the rings' masses, scaled to modal mass 1. Returns minus the
    imaginary part of the projected accelerations over ``omega``; -1 where a ball cannot be eliminated.
    """
    re = w[T.SPARE + 400 : T.SPARE + 442]
    im = w[T.SPARE + 442 : T.SPARE + 484]
    total = 0.0
    for i in range(L.N):
        for k in range(L.N):
            total += shape[L.N + i] * jac[J.E + i * 34 + 17 + k] * shape[k] * omega
    for j in range(int(p[P.BALLS])):
        for i in range(6):
            for k in range(6):
                row = J.B + i * 9 * STRIDE + j
                re[i * 7 + k] = -jac[row + (3 + k) * STRIDE]
                im[i * 7 + k] = omega if i == k else 0.0
                if k < 3:
                    im[i * 7 + k] += jac[row + k * STRIDE] / omega
            still = 0.0
            moving = 0.0
            for k in range(L.N):
                still += jac[J.C + (i * 34 + k) * STRIDE + j] * shape[k]
                moving += jac[J.C + (i * 34 + 17 + k) * STRIDE + j] * shape[k]
            re[i * 7 + 6] = still
            im[i * 7 + 6] = omega * moving
        if not solve_complex(re, im, 6):
            return -1.0
        for k in range(6):
            by_rate = 0.0
            by_place = 0.0
            for i in range(L.N):
                by_rate += shape[L.N + i] * jac[J.D + (i * 9 + 3 + k) * STRIDE + j]
                if k < 3:
                    by_place += shape[L.N + i] * jac[J.D + (i * 9 + k) * STRIDE + j]
            # a ball's place is its rate over i omega
            total += by_rate * im[k * 7 + 6] - by_place * re[k * 7 + 6] / omega
    return -total / omega


@kernel
def add_damping(p, s, w):
    """Fill ``L_EXTRA`` from the derivatives in ``lv`` (made with it at zero) and the quasi-static point."""
    lv = s[S.CONDENSED :]
    jac = s[S.JAC : S.CONDENSED]
    c = lv[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    jacobian(p, c, lv[L.Y0 : L.Y0 + Y.SIZE], 0.0, lv[L.FOUND_SPEED], 0.0, w, jac)
    values = T.SPARE
    vectors = T.SPARE + L.N * L.N
    mass = vectors + L.N * L.N
    shape = w[mass + L.N * L.N : mass + L.N * L.N + 2 * L.N]
    modes(p, lv, w, values, vectors, mass)
    for k in range(L.N):
        squared = w[values + k * L.N + k]
        if not (squared > _SLOWEST * _SLOWEST and squared < 1e14):
            continue
        omega = math.sqrt(squared)
        own = 0.0
        for i in range(L.N):
            shape[i] = w[vectors + i * L.N + k]
            shape[L.N + i] = shape[i] * inertia(p, i)
        for i in range(L.N):
            for m in range(L.N):
                own -= shape[L.N + i] * lv[L.JV + i + 12 * m] * shape[m]
        extra = taken(p, jac, shape, omega, w) - own
        if not (extra > 0.0):
            continue
        extra = min(extra, _MOST * omega)
        for i in range(L.N):
            left = 0.0
            for m in range(L.N):
                left += lv[L.MASS + i + 12 * m] * shape[m]
            w[mass + i] = left
        for i in range(L.N):
            for m in range(L.N):
                lv[L.EXTRA + i + 12 * m] -= w[mass + i] * extra * w[mass + m] * inertia(p, m)


@kernel
def modes(p, lv, w, values, vectors, mass):
    """Squared frequencies (diagonal of ``w[values:]``) and mode shapes (columns) of modal mass 1.

    The mass matrix is own masses times ``L_MASS``, symmetric; the stiffness is symmetrised. First the mass
    matrix is diagonalised, then the stiffness in the coordinates where the mass is the identity.
    """
    for i in range(L.N):
        for k in range(L.N):
            scale = math.sqrt(inertia(p, i) / inertia(p, k))
            back = 1.0 / scale
            w[values + i * L.N + k] = 0.5 * (scale * lv[L.MASS + i + 12 * k] + back * lv[L.MASS + k + 12 * i])
    eigenvectors(w, values, w, vectors, L.N)
    # columns over the roots of the values: U with U^T M U = 1
    for k in range(L.N):
        root = 1.0 / math.sqrt(max(w[values + k * L.N + k], 1e-12))
        for i in range(L.N):
            w[mass + i * L.N + k] = w[vectors + i * L.N + k] * root / math.sqrt(inertia(p, i))
    for i in range(L.N):
        for k in range(L.N):
            total = 0.0
            for m in range(L.N):
                for n in range(L.N):
                    total -= (
                        w[mass + m * L.N + i] * inertia(p, m) * lv[L.JX + m + 12 * n] * w[mass + n * L.N + k]
                    )
            w[values + i * L.N + k] = total
    for i in range(L.N):
        for k in range(i):
            mean = 0.5 * (w[values + i * L.N + k] + w[values + k * L.N + i])
            w[values + i * L.N + k] = mean
            w[values + k * L.N + i] = mean
    eigenvectors(w, values, w, vectors, L.N)
    # back to ring coordinates, row by row through the columns just found
    for i in range(L.N):
        for k in range(L.N):
            total = 0.0
            for m in range(L.N):
                total += w[mass + i * L.N + m] * w[vectors + m * L.N + k]
            lv[L.EXTRA + i * L.N + k] = total
    for i in range(L.N * L.N):
        w[vectors + i] = lv[L.EXTRA + i]
    for i in range(L.MATRIX):
        lv[L.EXTRA + i] = 0.0
