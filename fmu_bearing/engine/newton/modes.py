"""Flexural modes in the Newton matrix: their rows and columns, and the inverse of what the balls leave.

Each mode is eliminated ahead of balls and bodies. Its two coordinates are coupled with the balls lane by
lane, and what is left of it after the balls have answered is taken as the mean over all places of the balls:
a complex number acting on a + i b, and another between two modes of the same order on both rings. What
couples orders with each other and with rigid motion of the bodies is left to the iteration: it vanishes for
equal ball loads.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FL, A, J, P, Q, W, Y
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.mechanics.flexure import bends


@kernel
def local_row(jac, row, columns, first, k, c, s, axis, j):
    """Entry of a ball's row for motion of a body along the ball's own axis x, r or theta (0, 1, 2).

    ``first``: the body's x column, ``k`` added to it; ``columns``: of the block.
    """
    at = (row * columns + first + k) * STRIDE + j
    if axis == 0:
        return jac[at]
    y = jac[at + STRIDE]
    z = jac[at + 2 * STRIDE]
    return c * z - s * y if axis == 1 else -c * y - s * z


@kernel
def local_column(jac, first, column, c, s, axis, j):
    """Entry of block D for the force on a body along the ball's own axis; ``first``: the body's x row."""
    at = J.D + (first * 9 + column) * STRIDE + j
    if axis == 0:
        return jac[at]
    y = jac[at + 9 * STRIDE]
    z = jac[at + 18 * STRIDE]
    return c * z - s * y if axis == 1 else -c * y - s * z


@kernel
def answers(p, jac, race, c, s, cv, cx, j, kept):
    """Ball ``j``'s rows of the Newton matrix for motion of the groove under it: 18 rows of ``kept``.

    The groove's motion along itself presses nothing: its place has no effect, only its velocity.
    """
    first = 0 if race == 0 else Q.OUTER
    for i in range(6):
        for axis in range(3):
            value = cv * local_row(jac[J.C :], i, 34, first, Q.SIZE, c, s, axis, j)
            if axis < 2:
                value += cx * local_row(jac[J.C :], i, 34, first, 0, c, s, axis, j)
            kept[(i * 3 + axis) * STRIDE + j] = -value


@kernel
def returns(p, jac, fac, race, c, s, cv, cx, j, kept, row):
    """Groove's rows for the ball's motion, times the inverse of the ball's own block.

    18 more rows of ``kept``; ``row``: scratch for six numbers.
    """
    first = 0 if race == 0 else Q.OUTER
    mass = p[P.INNER_MASS] if race == 0 else p[P.OUTER_MASS]
    for axis in range(3):
        for m in range(6):
            value = cv * local_column(jac, first, 3 + m, c, s, axis, j)
            if m < 3:
                value += cx * local_column(jac, first, m, c, s, axis, j)
            row[m] = -mass * value
        for k in range(6):
            total = 0.0
            for m in range(6):
                total += row[m] * fac[A.INVERSE + (m * 6 + k) * STRIDE + j]
            kept[(18 + axis * 6 + k) * STRIDE + j] = total


@kernel
def ring_answers(p, jac, fac, y, turned, race, cv, cx, kept, row):
    """Rows of one ring at all balls into ``kept``."""
    for j in range(int(p[P.LANES])):
        angle = y[Y.TH + j] - turned
        c = math.cos(angle)
        s = math.sin(angle)
        answers(p, jac, race, c, s, cv, cx, j, kept)
        returns(p, jac, fac, race, c, s, cv, cx, j, kept, row)


@kernel
def groove_inertia(p, pushed, moved, same, total):
    """Inertia (kg, 3 x 3) of one groove against another's motion, or its own, summed over the balls.

    ``pushed``, ``moved``: rows of the two rings as :func:`ring_answers` left them; ``same``: one ring.
    """
    lever = p[P.PITCH_RADIUS]
    for a in range(3):
        for b in range(3):
            value = 0.0
            for j in range(int(p[P.BALLS])):
                if same:
                    # what the ball is pushed by, the groove is pushed back by
                    value -= p[P.BALL_MASS] * (lever if a == 2 else 1.0) * moved[(a * 3 + b) * STRIDE + j]
                for k in range(6):
                    value -= pushed[(18 + a * 6 + k) * STRIDE + j] * moved[(k * 3 + b) * STRIDE + j]
            total[a * 3 + b] = value


@kernel
def coupling(p, mode, other, total):
    """How a mode answers another of its order through the balls: real and imaginary part.

    The mean over all places of the balls; (a + i b) of the other mode is multiplied by it.
    """
    psi_x = p[other + P.MODE_X]
    psi_r = p[other + P.MODE_R]
    psi_t = p[other + P.MODE_T]
    x = psi_x * total[0] + psi_r * total[1]
    r = psi_x * total[3] + psi_r * total[4]
    t = psi_x * total[6] + psi_r * total[7]
    in_phase = p[mode + P.MODE_X] * x + p[mode + P.MODE_R] * r + p[mode + P.MODE_T] * total[8] * psi_t
    ahead = p[mode + P.MODE_X] * total[2] + p[mode + P.MODE_R] * total[5]
    half = 0.5 / p[mode + P.MODE_MASS]
    return half * in_phase, half * (ahead * psi_t - p[mode + P.MODE_T] * t)


@kernel
def mode_block(p, mode, spin, cv, cx, total):
    """Diagonal of the Newton matrix for one mode, the balls eliminated: real and imaginary part."""
    n = p[mode + P.MODE_ORDER]
    g = p[mode + P.MODE_GYROSCOPIC]
    damping = p[mode + P.MODE_DAMPING]
    stiff = p[mode + P.MODE_STIFFNESS] / p[mode + P.MODE_MASS] - (n * n + 2.0 * n * g) * spin * spin
    real, imaginary = coupling(p, mode, mode, total)
    real += 1.0 + cv * damping + cx * stiff
    return real, imaginary - 2.0 * cv * spin * (n + g) - cx * damping * n * spin


@kernel
def partner(p, k):
    """Mode of the other ring with the order of mode ``k``; -1 where there is none."""
    table = int(p[P.AT_MODES])
    own = table + k * P.MODE_SIZE
    found = -1
    for m in range(int(p[P.MODES])):
        other = table + m * P.MODE_SIZE
        if (
            p[other + P.MODE_ORDER] == p[own + P.MODE_ORDER]
            and p[other + P.MODE_BODY] != p[own + P.MODE_BODY]
        ):
            found = m
    return found


@kernel
def invert_modes(p, speed, cv, cx, totals, inverse):
    """Inverse of the modes' blocks, four numbers each: own and partner's coefficient, real and imaginary."""
    table = int(p[P.AT_MODES])
    for k in range(int(p[P.MODES])):
        mode = table + k * P.MODE_SIZE
        race = int(p[mode + P.MODE_BODY])
        ar, ai = mode_block(p, mode, speed if race == 0 else 0.0, cv, cx, totals[27 * race :])
        m = partner(p, k)
        br = 0.0
        bi = 0.0
        dr = 1.0
        di = 0.0
        er = ar
        ei = ai
        if m >= 0:
            other = table + m * P.MODE_SIZE
            br, bi = coupling(p, mode, other, totals[9 + 9 * race :])
            cr, ci = coupling(p, other, mode, totals[18 - 9 * race :])
            dr, di = mode_block(p, other, 0.0 if race == 0 else speed, cv, cx, totals[27 - 27 * race :])
            er = ar * dr - ai * di - (br * cr - bi * ci)
            ei = ar * di + ai * dr - (br * ci + bi * cr)
        per = 1.0 / (er * er + ei * ei)
        inverse[4 * k] = (dr * er + di * ei) * per
        inverse[4 * k + 1] = (di * er - dr * ei) * per
        inverse[4 * k + 2] = -(br * er + bi * ei) * per
        inverse[4 * k + 3] = -(bi * er - br * ei) * per


@kernel
def factor_modes(p, jac, fac, y, turned, speed, cv, cx, kept, w):
    """Prepare :func:`solve_modes` from the Jacobian ``jac`` and the factors ``fac`` made from it.

    ``turned``: orbit angle (rad) since the Jacobian was made; ``kept``: the flexure's part of the state.
    """
    if p[P.MODES] == 0.0:
        return
    modes = int(p[P.MODES])
    # inertia of inner on inner, inner on outer, outer on inner, outer on outer groove
    totals = w[W.FLEX : W.FLEX + 36]
    row = w[W.FLEX + 36 : W.FLEX + 42]
    first = kept[6 * modes :]
    second = kept[6 * modes + FL.FACTOR_ROWS * STRIDE :]
    inner = bends(p, 0)
    outer = bends(p, 1)
    if inner:
        ring_answers(p, jac, fac, y, turned, 0, cv, cx, first, row)
        groove_inertia(p, first, first, True, totals)
    if outer:
        ring_answers(p, jac, fac, y, turned, 1, cv, cx, second, row)
        groove_inertia(p, second, second, True, totals[27:])
    if inner and outer:
        groove_inertia(p, first, second, False, totals[9:])
        groove_inertia(p, second, first, False, totals[18:])
    invert_modes(p, speed, cv, cx, totals, kept[6 * modes + 2 * FL.FACTOR_ROWS * STRIDE :])
