"""Flexural coordinates in the Runge-Kutta step: stages, and their place in Newton's method.

The coordinates have flat arrays of their own beside the state ``y``, so the block-arrow factors of balls and
bodies stay as they are; ``newton.modes`` solves both together. In kernels ``flexure`` is the modes' part of
the state (places, rates, accelerations, then factors), ``own`` their part of the work space, ``w[W.FLEX:]``
(layout ``FL``).
"""

import math

from fmu_bearing.engine.fidelities.full.methods.table import TABLEAUX
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, dot_six, load, select, six, splat, store
from fmu_bearing.engine.layout import FL, FOUR, STRIDE, TAB, J, P, W
from fmu_bearing.engine.mechanics.flexure import bends, mode_force, modes_of
from fmu_bearing.engine.newton.modes import inverse_of_modes, partner, ring_factors


@kernel
def groove_residual(rows, d, lanes, balls, own):
    """Force rows that the balls' residual ``d`` puts on the groove once the balls have answered."""
    for axis in range(FL.GROOVE):
        out = FL.X + axis * STRIDE
        row = (FL.COUPLINGS + axis * J.BALL) * STRIDE
        for j in range(0, lanes, FOUR):
            # spare lanes put none
            force = dot_six(six(rows, row + j, STRIDE), six(d, j, STRIDE))
            store(own, out + j, select(consecutive(j) < balls, force, 0.0))


@kernel
def subtract_modes(p, rows, race, lanes, own, out, d):
    """Take from the balls' residual ``d`` what increments at ``own[out:]`` of one ring's modes do to them."""
    first, end = modes_of(p, race)
    for j in range(0, lanes, FOUR):
        x = r = t = splat(0.0)
        for k in range(first, end):
            mode = int(p[P.AT_MODES]) + k * P.MODE_SIZE
            at = FL.MODES + 2 * k * STRIDE + j
            a = own[out + 2 * k]
            b = own[out + 2 * k + 1]
            c = load(own, at)
            s = load(own, at + STRIDE)
            moved = a * c + b * s
            x += p[mode + P.MODE_X] * moved
            r += p[mode + P.MODE_R] * moved
            t += p[mode + P.MODE_T] * (a * s - b * c)
        for i in range(J.BALL):
            at = i * FL.GROOVE * STRIDE + j
            pushed = load(rows, at) * x + load(rows, at + STRIDE) * r + load(rows, at + 2 * STRIDE) * t
            store(d, i * STRIDE + j, load(d, i * STRIDE + j) - pushed)


@kernel
def combine(p, inverse, residual, out):
    """Increments of all modes from their residuals: each from its own and its partner's."""
    both = bends(p, 0) and bends(p, 1)  # else nobody has a partner
    for k in range(int(p[P.MODES])):
        i = 2 * k
        at = k * FL.PER_INVERSE + FL.OWN
        re = inverse[at]
        im = inverse[at + 1]
        a = re * residual[i] - im * residual[i + 1]
        b = re * residual[i + 1] + im * residual[i]
        m = partner(p, k) if both else -1
        if m >= 0:
            at = k * FL.PER_INVERSE + FL.PARTNER
            re = inverse[at]
            im = inverse[at + 1]
            a += re * residual[2 * m] - im * residual[2 * m + 1]
            b += re * residual[2 * m + 1] + im * residual[2 * m]
        out[i] = a
        out[i + 1] = b


@kernel
def solve_modes(p, flexure, stage, d, w):
    """Increments of the coordinates' accelerations at a stage.

    What they do to the balls is taken from the balls' residual ``d``.
    """
    modes = int(p[P.MODES])
    lanes = int(p[P.LANES])
    table = int(p[P.AT_MODES])
    own = w[W.FLEX :]
    increment = FL.A
    acc = FL.ACC + stage * FL.COORDINATES
    # the forces have done their work: the residuals take their place
    residual = FL.FORCE
    out = FL.D
    for race in range(2):
        first, end = modes_of(p, race)
        if first < end:
            groove_residual(ring_factors(flexure, modes, race), d, lanes, p[P.BALLS], own)
        for k in range(first, end):
            mode = table + k * P.MODE_SIZE
            i = 2 * k
            cosine, sine = mode_force(p, mode, lanes, own, FL.MODES + i * STRIDE, 0.0)
            own[residual + i] = own[increment + i] - own[acc + i] - cosine / p[mode + P.MODE_MASS]
            own[residual + i + 1] = own[increment + i + 1] - own[acc + i + 1] - sine / p[mode + P.MODE_MASS]
    combine(p, inverse_of_modes(flexure, modes), own[residual:], own[out:])
    for race in range(2):
        if bends(p, race):
            subtract_modes(p, ring_factors(flexure, modes, race), race, lanes, own, out, d)


@kernel
def begin_modes(p, flexure, w):
    """Accelerations and velocities at the start of a step into the first stage's arrays."""
    if p[P.MODES] == 0.0:
        return
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    for i in range(count):
        own[FL.ACC + i] = flexure[2 * count + i]
        own[FL.VEL + i] = flexure[count + i]


@kernel
def predict_modes(p, flexure, h, gh, stage, tableau, w):
    """Coordinates of a stage from the stages before and its first guess of the accelerations."""
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    here = FL.ACC + stage * FL.COORDINATES
    before = FL.ACC + max(stage - 2, 0) * FL.COORDINATES
    beyond = TABLEAUX[tableau + TAB.BEYOND + stage]
    for i in range(count):
        known = own[here - FL.COORDINATES + i]
        guess = known + beyond * (known - own[before + i])
        own[here + i] = guess
        own[FL.V + i] = flexure[count + i] + gh * guess
        own[FL.Q + i] = flexure[i]
    for m in range(stage):
        a = h * TABLEAUX[tableau + TAB.A + stage * TAB.ROW + m]
        if a != 0.0:
            acc = FL.ACC + m * FL.COORDINATES
            vel = FL.VEL + m * FL.COORDINATES
            for i in range(count):
                own[FL.V + i] += a * own[acc + i]
                own[FL.Q + i] += a * own[vel + i]
    for i in range(count):
        own[FL.Q + i] += gh * own[FL.V + i]


@kernel
def correct_modes(p, stage, gh, w):
    """Add the increments to a stage's accelerations and coordinates."""
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    here = FL.ACC + stage * FL.COORDINATES
    for i in range(count):
        own[here + i] += own[FL.D + i]
        own[FL.V + i] += gh * own[FL.D + i]
        own[FL.Q + i] += gh * gh * own[FL.D + i]


@kernel
def take_accelerations(p, stage, w):
    """Accelerations of an explicit stage: those just evaluated."""
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    here = FL.ACC + stage * FL.COORDINATES
    for i in range(count):
        own[here + i] = own[FL.A + i]


@kernel
def keep_mode_velocities(p, stage, w):
    """Velocities of a finished stage for those that follow."""
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    vel = FL.VEL + stage * FL.COORDINATES
    for i in range(count):
        own[vel + i] = own[FL.V + i]


@kernel
def end_modes(p, stages, w):
    """Accelerations of the last stage, where the end of the step is looked for."""
    if p[P.MODES] == 0.0:
        return
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    last = FL.ACC + (stages - 1) * FL.COORDINATES
    for i in range(count):
        own[FL.A + i] = own[last + i]


@kernel
def grooves_size(p, own, d):
    """Sum of the squares of the grooves' root mean square velocities (m2/s2) by the increments at ``d``."""
    total = 0.0
    table = int(p[P.AT_MODES])
    for k in range(int(p[P.MODES])):
        a = own[d + 2 * k]
        b = own[d + 2 * k + 1]
        total += p[table + k * P.MODE_SIZE + P.MODE_WEIGHT] * (a * a + b * b)
    return total


@kernel
def modes_size(p, size, gh, w):
    """Size (m/s) of a Newton increment, ``size`` without the modes."""
    if p[P.MODES] == 0.0:
        return size
    own = w[W.FLEX :]
    return math.sqrt(size * size + gh * gh * grooves_size(p, own, FL.D))


@kernel
def modes_error(p, error, h, tableau, w):
    """Error estimate (m/s) of a step, ``error`` without the modes."""
    if p[P.MODES] == 0.0:
        return error
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    for i in range(count):
        own[FL.D + i] = 0.0
    for m in range(int(TABLEAUX[tableau + TAB.COUNT])):
        e = h * TABLEAUX[tableau + TAB.ERROR + m]
        acc = FL.ACC + m * FL.COORDINATES
        for i in range(count):
            own[FL.D + i] += e * own[acc + i]
    return math.sqrt(error * error + grooves_size(p, own, FL.D))


@kernel
def accept_modes(p, s, at, w):
    """Coordinates, velocities and accelerations at the end of the step into the state from ``at`` on."""
    if p[P.MODES] == 0.0:
        return
    count = 2 * int(p[P.MODES])
    own = w[W.FLEX :]
    for i in range(count):
        s[at + i] = own[FL.Q + i]
        s[at + count + i] = own[FL.V + i]
        s[at + 2 * count + i] = own[FL.A + i]
