"""Flexural coordinates in the Runge-Kutta step: stages, and their place in Newton's method.

The coordinates stand beside the state ``y`` in flat arrays of their own, so the block-arrow factors of balls
and bodies stay as they are. In the Newton matrix each mode is eliminated ahead of them: its two coordinates
are coupled with the balls lane by lane, and what is left of it after the balls have answered is taken as the
same for every place of the balls, a 2 x 2 block per mode. What couples the modes with each other and with
rigid motion of the bodies is left to the iteration: it vanishes for equal ball loads, but for modes of the
same order on both rings, which the light balls couple weakly.
"""

import math

from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import (
    A_INV,
    B_TH,
    FACTOR_ROWS,
    FLEX_ROWS,
    FW_A,
    FW_ACC,
    FW_D,
    FW_Q,
    FW_V,
    FW_VEL,
    J_C,
    J_D,
    MODE_BODY,
    MODE_DAMPING,
    MODE_GYROSCOPIC,
    MODE_MASS,
    MODE_ORDER,
    MODE_R,
    MODE_SIZE,
    MODE_STIFFNESS,
    MODE_T,
    MODE_WEIGHT,
    MODE_X,
    N_BODY,
    P_AT_MODES,
    P_BALL_MASS,
    P_BALLS,
    P_INNER_MASS,
    P_LANES,
    P_MODES,
    P_OUTER_MASS,
    P_PITCH_RADIUS,
    Q_OUTER,
    STRIDE,
)
from fmu_bearing.engine.mechanics.flexure import bends, flat, flexure_work
from fmu_bearing.engine.solvers.tableaux import T_A, T_ERROR, T_STAGES, TABLEAUX

_S = STRIDE


@kernel
def local_row(jac, row, columns, first, k, c, s, axis, j):
    """Entry of a ball's row for motion of a body along the ball's own axis x, r or theta (0, 1, 2).

    ``first``: the body's x column, ``k`` added to it; ``columns``: of the block.
    """
    at = (row * columns + first + k) * _S + j
    if axis == 0:
        return jac[at]
    y = jac[at + _S]
    z = jac[at + 2 * _S]
    return c * z - s * y if axis == 1 else -c * y - s * z


@kernel
def local_column(jac, first, column, c, s, axis, j):
    """Entry of block D for the force on a body along the ball's own axis; ``first``: the body's x row."""
    at = J_D + (first * 9 + column) * _S + j
    if axis == 0:
        return jac[at]
    y = jac[at + 9 * _S]
    z = jac[at + 18 * _S]
    return c * z - s * y if axis == 1 else -c * y - s * z


@kernel
def answers(p, jac, race, c, s, cv, cx, j, kept):
    """Ball ``j``'s rows of the Newton matrix for motion of the groove under it: 18 rows of ``kept``.

    The groove's motion along itself presses nothing: its place has no effect, only its velocity.
    """
    first = 0 if race == 0 else Q_OUTER
    for i in range(6):
        for axis in range(3):
            value = cv * local_row(jac[J_C:], i, 34, first, N_BODY, c, s, axis, j)
            if axis < 2:
                value += cx * local_row(jac[J_C:], i, 34, first, 0, c, s, axis, j)
            kept[(i * 3 + axis) * _S + j] = -value


@kernel
def returns(p, jac, fac, race, c, s, cv, cx, j, kept, row):
    """Groove's rows for the ball's motion, times the inverse of the ball's own block: 18 more rows of ``kept``.

    ``row``: scratch for six numbers.
    """
    first = 0 if race == 0 else Q_OUTER
    mass = p[P_INNER_MASS] if race == 0 else p[P_OUTER_MASS]
    for axis in range(3):
        for m in range(6):
            value = cv * local_column(jac, first, 3 + m, c, s, axis, j)
            if m < 3:
                value += cx * local_column(jac, first, m, c, s, axis, j)
            row[m] = -mass * value
        for k in range(6):
            total = 0.0
            for m in range(6):
                total += row[m] * fac[A_INV + (m * 6 + k) * _S + j]
            kept[(18 + axis * 6 + k) * _S + j] = total


@kernel
def ring_answers(p, jac, fac, y, turned, race, cv, cx, kept, total, row):
    """Rows of one ring, and the groove's inertia (kg, 3 x 3 into ``total``) summed over the balls."""
    for i in range(9):
        total[i] = 0.0
    lever = p[P_PITCH_RADIUS]
    for j in range(int(p[P_LANES])):
        angle = y[B_TH * _S + j] - turned
        c = math.cos(angle)
        s = math.sin(angle)
        answers(p, jac, race, c, s, cv, cx, j, kept)
        returns(p, jac, fac, race, c, s, cv, cx, j, kept, row)
        if j >= p[P_BALLS]:
            continue
        for a in range(3):
            for b in range(3):
                # what the ball is pushed by, the groove is pushed back by
                value = -p[P_BALL_MASS] * (lever if a == 2 else 1.0) * kept[(a * 3 + b) * _S + j]
                for k in range(6):
                    value -= kept[(18 + a * 6 + k) * _S + j] * kept[(k * 3 + b) * _S + j]
                total[a * 3 + b] += value


@kernel
def mode_block(p, mode, spin, cv, cx, total):
    """Diagonal and off-diagonal of a mode's 2 x 2 block, the balls eliminated."""
    n = p[mode + MODE_ORDER]
    mass = p[mode + MODE_MASS]
    g = p[mode + MODE_GYROSCOPIC]
    damping = p[mode + MODE_DAMPING]
    psi_x = p[mode + MODE_X]
    psi_r = p[mode + MODE_R]
    psi_t = p[mode + MODE_T]
    normal = psi_x * (psi_x * total[0] + psi_r * total[1]) + psi_r * (psi_x * total[3] + psi_r * total[4])
    along = psi_t * psi_t * total[8]
    across = psi_t * (psi_x * (total[6] - total[2]) + psi_r * (total[7] - total[5]))
    stiff = p[mode + MODE_STIFFNESS] / mass - (n * n + 2.0 * n * g) * spin * spin
    diagonal = 1.0 + cv * damping + cx * stiff + 0.5 * (normal + along) / mass
    other = 2.0 * cv * spin * (n + g) + cx * damping * n * spin + 0.5 * across / mass
    return diagonal, other


@kernel
def factor_modes(p, jac, fac, y, turned, speed, cv, cx, kept, w):
    """Prepare :func:`solve_modes` from the Jacobian ``jac`` and the factors ``fac`` made from it.

    ``turned``: orbit angle (rad) since the Jacobian was made; ``kept``: the flexure's part of the state.
    """
    if p[P_MODES] == 0.0:
        return
    modes = int(p[P_MODES])
    table = int(p[P_AT_MODES])
    scratch = w[flexure_work(p) :]
    total = scratch[:9]
    for race in range(2):
        if not bends(p, race):
            continue
        rows = kept[6 * modes + race * FACTOR_ROWS * _S :]
        ring_answers(p, jac, fac, y, turned, race, cv, cx, rows, total, scratch[9:15])
        for k in range(modes):
            mode = table + k * MODE_SIZE
            if int(p[mode + MODE_BODY]) == race:
                diagonal, other = mode_block(p, mode, speed if race == 0 else 0.0, cv, cx, total)
                per = 1.0 / (diagonal * diagonal + other * other)
                at = 6 * modes + 2 * FACTOR_ROWS * _S + 2 * k
                kept[at] = diagonal * per
                kept[at + 1] = other * per


@inlined
def groove_residual(rows, d, lanes, balls, own):
    """Force rows that the balls' residual ``d`` puts on the groove once the balls have answered."""
    for axis in range(3):
        at = (18 + axis * 6) * _S
        for j in range(lanes):
            own[axis * _S + j] = (
                (rows[at + j] * d[j] + rows[at + _S + j] * d[_S + j])
                + (rows[at + 2 * _S + j] * d[2 * _S + j] + rows[at + 3 * _S + j] * d[3 * _S + j])
                + (rows[at + 4 * _S + j] * d[4 * _S + j] + rows[at + 5 * _S + j] * d[5 * _S + j])
            )
        for j in range(balls, lanes):
            own[axis * _S + j] = 0.0


@inlined
def ball_residual(rows, d, lanes, own):
    """Take from the balls' residual ``d`` what the groove's increment in three rows of ``own`` does."""
    for i in range(6):
        at = i * 3 * _S
        for j in range(lanes):
            d[i * _S + j] -= (rows[at + j] * own[j] + rows[at + _S + j] * own[_S + j]) + rows[
                at + 2 * _S + j
            ] * own[2 * _S + j]


@kernel
def gather(p, mode, lanes, own, at):
    """Sums of three force rows over the balls for one mode's cosine and sine coordinate."""
    psi_x = p[mode + MODE_X]
    psi_r = p[mode + MODE_R]
    psi_t = p[mode + MODE_T]
    cosine = 0.0
    sine = 0.0
    for j in range(lanes):
        c = own[at + j]
        s = own[at + _S + j]
        push = psi_x * own[j] + psi_r * own[_S + j]
        drag = psi_t * own[2 * _S + j]
        cosine += push * c + drag * s
        sine += push * s - drag * c
    return cosine, sine


@kernel
def spread(p, mode, lanes, own, at, a, b):
    """Add the groove's increment by one mode's coordinates ``a``, ``b`` to three rows."""
    psi_x = p[mode + MODE_X]
    psi_r = p[mode + MODE_R]
    psi_t = p[mode + MODE_T]
    for j in range(lanes):
        c = own[at + j]
        s = own[at + _S + j]
        along = a * c + b * s
        own[j] += psi_x * along
        own[_S + j] += psi_r * along
        own[2 * _S + j] += psi_t * (a * s - b * c)


@kernel
def solve_modes(p, kept, stage, d, w):
    """Increments of the coordinates' accelerations at a stage; takes what they do from the balls' residual ``d``."""
    modes = int(p[P_MODES])
    lanes = int(p[P_LANES])
    balls = int(p[P_BALLS])
    table = int(p[P_AT_MODES])
    own = w[flexure_work(p) :]
    found = flat(p, FW_A)
    acc = flat(p, FW_ACC + stage)
    out = flat(p, FW_D)
    for race in range(2):
        if not bends(p, race):
            continue
        rows = kept[6 * modes + race * FACTOR_ROWS * _S :]
        groove_residual(rows, d, lanes, balls, own)
        for k in range(modes):
            mode = table + k * MODE_SIZE
            if int(p[mode + MODE_BODY]) == race:
                i = 2 * k
                cosine, sine = gather(p, mode, lanes, own, (FLEX_ROWS + i) * _S)
                first = own[found + i] - own[acc + i] - cosine / p[mode + MODE_MASS]
                second = own[found + i + 1] - own[acc + i + 1] - sine / p[mode + MODE_MASS]
                at = 6 * modes + 2 * FACTOR_ROWS * _S + i
                own[out + i] = kept[at] * first - kept[at + 1] * second
                own[out + i + 1] = kept[at + 1] * first + kept[at] * second
    for race in range(2):
        if not bends(p, race):
            continue
        for i in range(3 * _S):
            own[i] = 0.0
        for k in range(modes):
            mode = table + k * MODE_SIZE
            if int(p[mode + MODE_BODY]) == race:
                at = (FLEX_ROWS + 2 * k) * _S
                spread(p, mode, lanes, own, at, own[out + 2 * k], own[out + 2 * k + 1])
        ball_residual(kept[6 * modes + race * FACTOR_ROWS * _S :], d, lanes, own)


@kernel
def begin_modes(p, kept, w):
    """Accelerations and velocities at the start of a step into the first stage's arrays."""
    if p[P_MODES] == 0.0:
        return
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    acc = flat(p, FW_ACC)
    vel = flat(p, FW_VEL)
    for i in range(count):
        own[acc + i] = kept[2 * count + i]
        own[vel + i] = kept[count + i]


@kernel
def predict_modes(p, kept, h, gh, stage, tableau, w):
    """Coordinates of a stage from the stages before and its first guess of the accelerations."""
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    q = flat(p, FW_Q)
    v = flat(p, FW_V)
    here = flat(p, FW_ACC + stage)
    for i in range(count):
        guess = own[here - count + i]
        own[here + i] = guess
        own[v + i] = kept[count + i] + gh * guess
        own[q + i] = kept[i]
    for m in range(stage):
        a = h * TABLEAUX[tableau + T_A + stage * 5 + m]
        if a != 0.0:
            acc = flat(p, FW_ACC + m)
            vel = flat(p, FW_VEL + m)
            for i in range(count):
                own[v + i] += a * own[acc + i]
                own[q + i] += a * own[vel + i]
    for i in range(count):
        own[q + i] += gh * own[v + i]


@kernel
def correct_modes(p, stage, gh, w):
    """Add the increments to a stage's accelerations and coordinates."""
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    q = flat(p, FW_Q)
    v = flat(p, FW_V)
    d = flat(p, FW_D)
    here = flat(p, FW_ACC + stage)
    for i in range(count):
        own[here + i] += own[d + i]
        own[v + i] += gh * own[d + i]
        own[q + i] += gh * gh * own[d + i]


@kernel
def take_accelerations(p, stage, w):
    """Accelerations of an explicit stage: those just evaluated."""
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    found = flat(p, FW_A)
    here = flat(p, FW_ACC + stage)
    for i in range(count):
        own[here + i] = own[found + i]


@kernel
def keep_mode_velocities(p, stage, w):
    """Velocities of a finished stage for those that follow."""
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    v = flat(p, FW_V)
    vel = flat(p, FW_VEL + stage)
    for i in range(count):
        own[vel + i] = own[v + i]


@kernel
def end_modes(p, stages, w):
    """Accelerations of the last stage, where the end of the step is looked for."""
    if p[P_MODES] == 0.0:
        return
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    last = flat(p, FW_ACC + stages - 1)
    out = flat(p, FW_A)
    for i in range(count):
        own[out + i] = own[last + i]


@kernel
def grooves_size(p, own, d):
    """Sum of the squares of the grooves' root mean square velocities (m2/s2) by the increments at ``d``."""
    total = 0.0
    table = int(p[P_AT_MODES])
    for k in range(int(p[P_MODES])):
        a = own[d + 2 * k]
        b = own[d + 2 * k + 1]
        total += p[table + k * MODE_SIZE + MODE_WEIGHT] * (a * a + b * b)
    return total


@kernel
def modes_size(p, size, gh, w):
    """Size (m/s) of a Newton increment, ``size`` without the modes."""
    if p[P_MODES] == 0.0:
        return size
    own = w[flexure_work(p) :]
    return math.sqrt(size * size + gh * gh * grooves_size(p, own, flat(p, FW_D)))


@kernel
def modes_error(p, error, h, tableau, w):
    """Error estimate (m/s) of a step, ``error`` without the modes."""
    if p[P_MODES] == 0.0:
        return error
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    d = flat(p, FW_D)
    for i in range(count):
        own[d + i] = 0.0
    for m in range(int(TABLEAUX[tableau + T_STAGES])):
        e = h * TABLEAUX[tableau + T_ERROR + m]
        acc = flat(p, FW_ACC + m)
        for i in range(count):
            own[d + i] += e * own[acc + i]
    return math.sqrt(error * error + grooves_size(p, own, d))


@kernel
def accept_modes(p, s, at, w):
    """Coordinates, velocities and accelerations at the end of the step into the state from ``at`` on."""
    if p[P_MODES] == 0.0:
        return
    count = 2 * int(p[P_MODES])
    own = w[flexure_work(p) :]
    q = flat(p, FW_Q)
    v = flat(p, FW_V)
    a = flat(p, FW_A)
    for i in range(count):
        s[at + i] = own[q + i]
        s[at + count + i] = own[v + i]
        s[at + 2 * count + i] = own[a + i]
