"""Flexural coordinates in the Runge-Kutta step: stages, and their place in Newton's method.

The coordinates stand beside the state ``y`` in flat arrays of their own, so the block-arrow factors of balls
and bodies stay as they are; ``mode_factors`` tells how both go together.
"""

import math

from fmu_bearing.engine.fidelities.full.methods.tableaux import T_A, T_ERROR, T_STAGES, TABLEAUX
from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import (
    P_AT_MODES,
    P_BALLS,
    P_LANES,
    P_MODES,
    STRIDE,
    W_FLEX,
)
from fmu_bearing.engine.layout_flexure import (
    ARRAY,
    FACTOR_ROWS,
    FLEX_ROWS,
    FW_A,
    FW_ACC,
    FW_D,
    FW_FORCE,
    FW_Q,
    FW_V,
    FW_VEL,
    MODE_BODY,
    MODE_MASS,
    MODE_R,
    MODE_SIZE,
    MODE_T,
    MODE_WEIGHT,
    MODE_X,
)
from fmu_bearing.engine.mechanics.flexure import bends, mode_force
from fmu_bearing.engine.newton.modes import partner

_S = STRIDE


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
def combine(p, inverse, residual, out):
    """Increments of all modes from their residuals: each from its own and its partner's."""
    for k in range(int(p[P_MODES])):
        i = 2 * k
        re = inverse[4 * k]
        im = inverse[4 * k + 1]
        a = re * residual[i] - im * residual[i + 1]
        b = re * residual[i + 1] + im * residual[i]
        m = partner(p, k)
        if m >= 0:
            re = inverse[4 * k + 2]
            im = inverse[4 * k + 3]
            a += re * residual[2 * m] - im * residual[2 * m + 1]
            b += re * residual[2 * m + 1] + im * residual[2 * m]
        out[i] = a
        out[i + 1] = b


@kernel
def solve_modes(p, kept, stage, d, w):
    """Increments of the coordinates' accelerations at a stage.

    What they do to the balls is taken from the balls' residual ``d``.
    """
    modes = int(p[P_MODES])
    lanes = int(p[P_LANES])
    balls = int(p[P_BALLS])
    table = int(p[P_AT_MODES])
    own = w[W_FLEX:]
    found = FW_A
    acc = FW_ACC + stage * ARRAY
    # the forces have done their work: the residuals take their place
    residual = FW_FORCE
    out = FW_D
    for race in range(2):
        if not bends(p, race):
            continue
        groove_residual(kept[6 * modes + race * FACTOR_ROWS * _S :], d, lanes, balls, own)
        for k in range(modes):
            mode = table + k * MODE_SIZE
            if int(p[mode + MODE_BODY]) == race:
                i = 2 * k
                cosine, sine = mode_force(p, mode, lanes, own, (FLEX_ROWS + i) * _S, 0.0)
                own[residual + i] = own[found + i] - own[acc + i] - cosine / p[mode + MODE_MASS]
                own[residual + i + 1] = own[found + i + 1] - own[acc + i + 1] - sine / p[mode + MODE_MASS]
    combine(p, kept[6 * modes + 2 * FACTOR_ROWS * _S :], own[residual:], own[out:])
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
    own = w[W_FLEX:]
    acc = FW_ACC
    vel = FW_VEL
    for i in range(count):
        own[acc + i] = kept[2 * count + i]
        own[vel + i] = kept[count + i]


@kernel
def predict_modes(p, kept, h, gh, stage, tableau, w):
    """Coordinates of a stage from the stages before and its first guess of the accelerations."""
    count = 2 * int(p[P_MODES])
    own = w[W_FLEX:]
    q = FW_Q
    v = FW_V
    here = FW_ACC + stage * ARRAY
    for i in range(count):
        guess = own[here - ARRAY + i]
        own[here + i] = guess
        own[v + i] = kept[count + i] + gh * guess
        own[q + i] = kept[i]
    for m in range(stage):
        a = h * TABLEAUX[tableau + T_A + stage * 5 + m]
        if a != 0.0:
            acc = FW_ACC + m * ARRAY
            vel = FW_VEL + m * ARRAY
            for i in range(count):
                own[v + i] += a * own[acc + i]
                own[q + i] += a * own[vel + i]
    for i in range(count):
        own[q + i] += gh * own[v + i]


@kernel
def correct_modes(p, stage, gh, w):
    """Add the increments to a stage's accelerations and coordinates."""
    count = 2 * int(p[P_MODES])
    own = w[W_FLEX:]
    q = FW_Q
    v = FW_V
    d = FW_D
    here = FW_ACC + stage * ARRAY
    for i in range(count):
        own[here + i] += own[d + i]
        own[v + i] += gh * own[d + i]
        own[q + i] += gh * gh * own[d + i]


@kernel
def take_accelerations(p, stage, w):
    """Accelerations of an explicit stage: those just evaluated."""
    count = 2 * int(p[P_MODES])
    own = w[W_FLEX:]
    found = FW_A
    here = FW_ACC + stage * ARRAY
    for i in range(count):
        own[here + i] = own[found + i]


@kernel
def keep_mode_velocities(p, stage, w):
    """Velocities of a finished stage for those that follow."""
    count = 2 * int(p[P_MODES])
    own = w[W_FLEX:]
    v = FW_V
    vel = FW_VEL + stage * ARRAY
    for i in range(count):
        own[vel + i] = own[v + i]


@kernel
def end_modes(p, stages, w):
    """Accelerations of the last stage, where the end of the step is looked for."""
    if p[P_MODES] == 0.0:
        return
    count = 2 * int(p[P_MODES])
    own = w[W_FLEX:]
    last = FW_ACC + (stages - 1) * ARRAY
    out = FW_A
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
    own = w[W_FLEX:]
    return math.sqrt(size * size + gh * gh * grooves_size(p, own, FW_D))


@kernel
def modes_error(p, error, h, tableau, w):
    """Error estimate (m/s) of a step, ``error`` without the modes."""
    if p[P_MODES] == 0.0:
        return error
    count = 2 * int(p[P_MODES])
    own = w[W_FLEX:]
    d = FW_D
    for i in range(count):
        own[d + i] = 0.0
    for m in range(int(TABLEAUX[tableau + T_STAGES])):
        e = h * TABLEAUX[tableau + T_ERROR + m]
        acc = FW_ACC + m * ARRAY
        for i in range(count):
            own[d + i] += e * own[acc + i]
    return math.sqrt(error * error + grooves_size(p, own, d))


@kernel
def accept_modes(p, s, at, w):
    """Coordinates, velocities and accelerations at the end of the step into the state from ``at`` on."""
    if p[P_MODES] == 0.0:
        return
    count = 2 * int(p[P_MODES])
    own = w[W_FLEX:]
    q = FW_Q
    v = FW_V
    a = FW_A
    for i in range(count):
        s[at + i] = own[q + i]
        s[at + count + i] = own[v + i]
        s[at + 2 * count + i] = own[a + i]
