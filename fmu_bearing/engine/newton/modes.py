"""Flexural modes in the Newton matrix: their rows and columns, and the inverse of what the balls leave.

Each mode is eliminated ahead of balls and bodies. Its two coordinates are coupled with the balls lane by
lane, and what is left of it after the balls have answered is taken as the mean over all places of the balls:
a complex number acting on a + i b, and another between two modes of the same order on both rings. What
couples orders with each other and with rigid motion of the bodies is left to the iteration: it vanishes for
equal ball loads.
"""

import math

from fmu_bearing.engine.complex_numbers import complex_at, over
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import in_groups
from fmu_bearing.engine.layout import FL, FOUR, STRIDE, A, J, P, Q, W, Y
from fmu_bearing.engine.mechanics.flexure import bends


@kernel
def local_row(jac, row, column, c, s, axis, j):
    """Entry of block C for motion of a body along the ball's own axis x, r or theta (0, 1, 2).

    ``row``: of the ball; ``column``: the body's displacement or velocity along x.
    """
    at = J.C + (row * J.BODIES + column) * STRIDE + j
    if axis == 0:
        return jac[at]
    y = jac[at + STRIDE]
    z = jac[at + 2 * STRIDE]
    return c * z - s * y if axis == 1 else -c * y - s * z


@kernel
def local_column(jac, first, column, c, s, axis, j):
    """Entry of block D for the force on a body along the ball's own axis; ``first``: the body's x row."""
    next_row = J.STATES * STRIDE
    at = J.D + (first * J.STATES + column) * STRIDE + j
    if axis == 0:
        return jac[at]
    y = jac[at + next_row]
    z = jac[at + 2 * next_row]
    return c * z - s * y if axis == 1 else -c * y - s * z


@kernel
def ball_groove_coupling(jac, race, c, s, cv, cx, j, factors):
    """Ball ``j``'s rows of the Newton matrix for motion of the groove under it, into ``factors``.

    The groove's motion along itself presses nothing: its place has no effect, only its velocity.
    """
    first = Q.INNER if race == 0 else Q.OUTER
    for i in range(J.BALL):
        for axis in range(FL.GROOVE):
            value = cv * local_row(jac, i, first + Q.SIZE, c, s, axis, j)
            if axis < 2:
                value += cx * local_row(jac, i, first, c, s, axis, j)
            factors[(i * FL.GROOVE + axis) * STRIDE + j] = -value


@kernel
def groove_ball_coupling(p, jac, fac, race, c, s, cv, cx, j, factors, row):
    """Groove's rows for the ball's motion, times the inverse of the ball's own block.

    They follow in ``factors``; ``row``: scratch for ``J.BALL`` numbers.
    """
    first = Q.INNER if race == 0 else Q.OUTER
    mass = p[P.INNER_MASS] if race == 0 else p[P.OUTER_MASS]
    for axis in range(FL.GROOVE):
        for m in range(J.BALL):
            value = cv * local_column(jac, first, J.PLACED + m, c, s, axis, j)
            if m < J.PLACED:
                value += cx * local_column(jac, first, m, c, s, axis, j)
            row[m] = -mass * value
        for k in range(J.BALL):
            total = 0.0
            for m in range(J.BALL):
                total += row[m] * fac[in_groups(j, A.GROUP) + A.INVERSE + m * A.SIX + k * FOUR]
            factors[(FL.COUPLINGS + axis * J.BALL + k) * STRIDE + j] = total


@kernel
def ring_couplings(p, jac, fac, y, turned, race, cv, cx, factors, row):
    """Rows of one ring at all balls into ``factors``."""
    for j in range(int(p[P.LANES])):
        angle = y[Y.TH + j] - turned
        c = math.cos(angle)
        s = math.sin(angle)
        ball_groove_coupling(jac, race, c, s, cv, cx, j, factors)
        groove_ball_coupling(p, jac, fac, race, c, s, cv, cx, j, factors, row)


@kernel
def groove_inertia(p, pushed, moved, same, total):
    """Inertia (kg, 3 x 3) of one groove against another's motion, or its own, summed over the balls.

    ``pushed``, ``moved``: rows of the two rings as :func:`ring_couplings` left them; ``same``: one ring.
    """
    lever = p[P.PITCH_RADIUS]
    for a in range(FL.GROOVE):
        for b in range(FL.GROOVE):
            own = (a * FL.GROOVE + b) * STRIDE
            value = 0.0
            for j in range(int(p[P.BALLS])):
                if same:
                    # what the ball is pushed by, the groove is pushed back by
                    value -= p[P.BALL_MASS] * (lever if a == 2 else 1.0) * moved[own + j]
                for k in range(J.BALL):
                    back = (FL.COUPLINGS + a * J.BALL + k) * STRIDE
                    value -= pushed[back + j] * moved[(k * FL.GROOVE + b) * STRIDE + j]
            total[a * FL.GROOVE + b] = value


@kernel
def coupling(p, mode, other, total):
    """How a mode couples to another of its order through the balls: complex.

    ``total``: inertia (kg) of the mode's groove against the motion of the other's, row by row. The mean over
    all places of the balls; (a + i b) of the other mode is multiplied by it.
    """
    psi_x = p[other + P.MODE_X]
    psi_r = p[other + P.MODE_R]
    psi_t = p[other + P.MODE_T]
    radial = total[FL.GROOVE :]
    along = total[2 * FL.GROOVE :]
    x = psi_x * total[0] + psi_r * total[1]
    r = psi_x * radial[0] + psi_r * radial[1]
    t = psi_x * along[0] + psi_r * along[1]
    in_phase = p[mode + P.MODE_X] * x + p[mode + P.MODE_R] * r + p[mode + P.MODE_T] * along[2] * psi_t
    ahead = p[mode + P.MODE_X] * total[2] + p[mode + P.MODE_R] * radial[2]
    half = 0.5 / p[mode + P.MODE_MASS]
    return complex(half * in_phase, half * (ahead * psi_t - p[mode + P.MODE_T] * t))


@kernel
def mode_block(p, mode, spin, cv, cx, total):
    """Diagonal of the Newton matrix for one mode, the balls eliminated: complex."""
    n = p[mode + P.MODE_ORDER]
    g = p[mode + P.MODE_GYROSCOPIC]
    damping = p[mode + P.MODE_DAMPING]
    stiff = p[mode + P.MODE_STIFFNESS] / p[mode + P.MODE_MASS] - (n * n + 2.0 * n * g) * spin * spin
    own = complex(1.0 + cv * damping + cx * stiff, -2.0 * cv * spin * (n + g) - cx * damping * n * spin)
    return coupling(p, mode, mode, total) + own


@kernel
def partner(p, k):
    """Mode of the other ring with the order of mode ``k``; -1 where there is none."""
    table = int(p[P.AT_MODES])
    own = table + k * P.MODE_SIZE
    mate = -1
    for m in range(int(p[P.MODES])):
        other = table + m * P.MODE_SIZE
        if (
            p[other + P.MODE_ORDER] == p[own + P.MODE_ORDER]
            and p[other + P.MODE_BODY] != p[own + P.MODE_BODY]
        ):
            mate = m
    return mate


@kernel
def inertia_place(pushed, moved):
    """Return the place of one groove's inertia against the motion of one (0 inner, 1 outer ring)."""
    return (2 * pushed + moved) * FL.INERTIA


@kernel
def ring_factors(flexure, modes, race):
    """Return what Newton's method keeps of one ring's groove and the balls, in the flexure's state."""
    return flexure[FL.PER_MODE * modes + race * FL.FACTOR_ROWS * STRIDE :]


@kernel
def inverse_of_modes(flexure, modes):
    """Return the modes' inverse, behind the factors of both rings."""
    return flexure[FL.PER_MODE * modes + 2 * FL.FACTOR_ROWS * STRIDE :]


@kernel
def invert_modes(p, speed, cv, cx, totals, inverse):
    """Inverse of the modes' blocks: coefficients of own and partner's residual, complex."""
    table = int(p[P.AT_MODES])
    for k in range(int(p[P.MODES])):
        mode = table + k * P.MODE_SIZE
        race = int(p[mode + P.MODE_BODY])
        a = mode_block(p, mode, speed if race == 0 else 0.0, cv, cx, totals[inertia_place(race, race) :])
        m = partner(p, k)
        b, d, determinant = 0j, complex(1.0, 0.0), a
        if m >= 0:
            other = table + m * P.MODE_SIZE
            opposite = 1 - race
            spin = 0.0 if race == 0 else speed
            b = coupling(p, mode, other, totals[inertia_place(race, opposite) :])
            c = coupling(p, other, mode, totals[inertia_place(opposite, race) :])
            d = mode_block(p, other, spin, cv, cx, totals[inertia_place(opposite, opposite) :])
            determinant = a * d - b * c
        found = complex_at(inverse, k * FL.PER_INVERSE, 2)
        found[FL.OWN // 2] = over(d, determinant)
        found[FL.PARTNER // 2] = over(-b, determinant)


@kernel
def factor_modes(p, jac, fac, y, turned, speed, cv, cx, flexure, w):
    """Prepare :func:`solve_modes` from the Jacobian ``jac`` and the factors ``fac`` made from it.

    ``turned``: orbit angle (rad) since the Jacobian was made; ``flexure``: the flexure's part of the state.
    """
    if p[P.MODES] == 0.0:
        return
    modes = int(p[P.MODES])
    totals = w[W.GROOVE_INERTIA : W.GROOVE_INERTIA + FL.INERTIAS]
    row = w[W.GROOVE_ROW : W.GROOVE_ROW + J.BALL]
    first = ring_factors(flexure, modes, 0)
    second = ring_factors(flexure, modes, 1)
    inner = bends(p, 0)
    outer = bends(p, 1)
    if inner:
        ring_couplings(p, jac, fac, y, turned, 0, cv, cx, first, row)
        groove_inertia(p, first, first, True, totals)
    if outer:
        ring_couplings(p, jac, fac, y, turned, 1, cv, cx, second, row)
        groove_inertia(p, second, second, True, totals[inertia_place(1, 1) :])
    if inner and outer:
        groove_inertia(p, first, second, False, totals[inertia_place(0, 1) :])
        groove_inertia(p, second, first, False, totals[inertia_place(1, 0) :])
    invert_modes(p, speed, cv, cx, totals, inverse_of_modes(flexure, modes))
