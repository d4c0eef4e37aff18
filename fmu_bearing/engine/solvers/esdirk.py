"""ESDIRK4(3), the implicit part of ARK4(3)6L[2]SA (Kennedy and Carpenter 2003), on x'' = f(x, x').

The unknowns of a stage are its accelerations A: V = v_base + g h A, X = x_base + g h V with g = 1/4. The
first stage is the last one of the step before (stiffly accurate), so a step costs five implicit stages.
"""

import numpy as np

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    C_BALL_RADIUS,
    F_G,
    F_HEAT,
    F_SIZE,
    F_WORK,
    N_BODY,
    P_BALLS,
    P_LANES,
    P_PITCH_RADIUS,
    Q_CAGE,
    STAGES,
    STRIDE,
    W_ACC,
    W_D,
    W_F,
    W_F0,
    W_NEW,
    W_VEL,
    W_Y,
    Y_Q,
    Y_SIZE,
    Y_V,
)
from fmu_bearing.engine.mechanics.ball_waves import turn_axes
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.solvers.block_arrow import solve
from fmu_bearing.engine.solvers.jacobian import is_angle

_S = STRIDE
GAMMA = 0.25
NODES = np.array([0.0, 1.0 / 2, 83.0 / 250, 31.0 / 50, 17.0 / 20, 1.0])
# rows of the tableau below the diagonal, five numbers each
A = np.array([
    0.0, 0.0, 0.0, 0.0, 0.0,
    1.0 / 4, 0.0, 0.0, 0.0, 0.0,
    8611.0 / 62500, -1743.0 / 31250, 0.0, 0.0, 0.0,
    5012029.0 / 34652500, -654441.0 / 2922500, 174375.0 / 388108, 0.0, 0.0,
    15267082809.0 / 155376265600, -71443401.0 / 120774400, 730878875.0 / 902184768,
    2285395.0 / 8070912, 0.0,
    82889.0 / 524892, 0.0, 15625.0 / 83664, 69875.0 / 102672, -2260.0 / 8211,
])  # fmt: skip
B = np.array([82889.0 / 524892, 0.0, 15625.0 / 83664, 69875.0 / 102672, -2260.0 / 8211, 1.0 / 4])
B_LOW = np.array(
    [
        4586570599.0 / 29645900160,
        0.0,
        178811875.0 / 945068544,
        814220225.0 / 1159782912,
        -3700637.0 / 11593932,
        61727.0 / 225920,
    ]
)
MAX_ITERATIONS = 8


@kernel
def scaled_size(p, d, factor):
    """Largest change of velocity (m/s) in ``factor * d``: bodies at the pitch radius, balls in x and r.

    The cage and the balls count a tenth: they matter through what they do to the rings.
    """
    lever = p[P_PITCH_RADIUS]
    size = 0.0
    for i in range(N_BODY):
        value = abs(d[F_G + i])
        if is_angle(i):
            value *= lever
        if i >= Q_CAGE:
            value *= 0.1
        size = max(size, value)
    for j in range(2 * _S):
        if j % _S < p[P_BALLS]:
            size = max(size, 0.1 * abs(d[j]))
    return size * abs(factor)


@kernel
def newton_size(p, c, d, factor):
    """As :func:`scaled_size`, with the balls' orbit and spin at their surface speeds as well.

    They are left out of the step control, where their stiff share of the error estimate means nothing.
    """
    size = scaled_size(p, d, factor)
    orbit = 0.1 * p[P_PITCH_RADIUS] * abs(factor)
    spin = 0.03 * c[C_BALL_RADIUS] * abs(factor)
    for j in range(int(p[P_BALLS])):
        size = max(size, orbit * abs(d[2 * _S + j]))
        for k in range(3, 6):
            size = max(size, spin * abs(d[k * _S + j]))
    return size


@kernel
def add_scaled(p, scale, source, at, target, to):
    """``target[to:] += scale * source[at:]`` over balls' lanes and bodies in the layout of accelerations."""
    lanes = int(p[P_LANES])
    for i in range(6):
        for j in range(lanes):
            target[to + i * _S + j] += scale * source[at + i * _S + j]
    for i in range(N_BODY):
        target[to + F_G + i] += scale * source[at + F_G + i]


@kernel
def stage_base(p, y, h, stage, w):
    """Explicit part of a stage into ``w[W_NEW:]``: positions and velocities before its own acceleration."""
    lanes = int(p[P_LANES])
    for i in range(Y_SIZE):
        w[W_NEW + i] = y[i]
    for m in range(stage):
        a = h * A[stage * 5 + m]
        if a == 0.0:
            continue
        acc = W_ACC + m * F_SIZE
        vel = W_VEL + m * F_SIZE
        for i in range(3):
            for j in range(lanes):
                w[W_NEW + i * _S + j] += a * w[vel + i * _S + j]
        for i in range(6):
            for j in range(lanes):
                w[W_NEW + (3 + i) * _S + j] += a * w[acc + i * _S + j]
        for i in range(N_BODY):
            w[W_NEW + Y_Q + i] += a * w[vel + F_G + i]
            w[W_NEW + Y_V + i] += a * w[acc + F_G + i]


@kernel
def stage_state(p, acc, gh, w):
    """State of a stage from its base and accelerations into ``w[W_Y:]``."""
    lanes = int(p[P_LANES])
    for i in range(6):
        for j in range(lanes):
            w[W_Y + (3 + i) * _S + j] = w[W_NEW + (3 + i) * _S + j] + gh * w[acc + i * _S + j]
    for i in range(3):
        for j in range(lanes):
            w[W_Y + i * _S + j] = w[W_NEW + i * _S + j] + gh * w[W_Y + (3 + i) * _S + j]
    for i in range(N_BODY):
        w[W_Y + Y_V + i] = w[W_NEW + Y_V + i] + gh * w[acc + F_G + i]
        w[W_Y + Y_Q + i] = w[W_NEW + Y_Q + i] + gh * w[W_Y + Y_V + i]


@kernel
def keep_velocities(p, y, at, w):
    """Copy the velocities of a state at ``y`` into ``w[at:]`` in the layout of accelerations."""
    lanes = int(p[P_LANES])
    for i in range(6):
        for j in range(lanes):
            w[at + i * _S + j] = y[(3 + i) * _S + j]
    for i in range(N_BODY):
        w[at + F_G + i] = y[Y_V + i]


@kernel
def esdirk_step(
    p, c, y, f, axes, angle, speed, speed_rate, h, fac, turned, tolerance, contraction, probe, w, report
):
    """One step of length ``h`` from (y, f); the new state is left in ``w[W_Y:]`` and its f in the last stage.

    ``axes``: of wavy balls, at the step's start; ``fac``: factors for about this ``h``; ``turned``: orbit
    angle (rad) since they were made; ``tolerance`` (m/s): Newton's error; ``contraction``: rate known so
    far; ``probe``: measure it anew. ``report`` takes the error estimate (m/s), contraction and iterations.
    Returns False where Newton does not converge.
    """
    gh = GAMMA * h
    stage_y = w[W_Y : W_Y + Y_SIZE]
    result = w[W_F:W_F0]
    for i in range(F_SIZE):
        w[W_ACC + i] = f[i]
    keep_velocities(p, y, W_VEL, w)
    orbit = y[5 * _S]
    iterations = 0.0
    worst = 0.0
    for stage in range(1, STAGES):
        acc = W_ACC + stage * F_SIZE
        for i in range(F_SIZE):
            w[acc + i] = w[acc - F_SIZE + i]
        stage_base(p, y, h, stage, w)
        stage_state(p, acc, gh, w)
        t = h * NODES[stage]
        turn_axes(p, axes, y, int(p[P_LANES]), t, w)
        angle_t = angle + t * (speed + 0.5 * t * speed_rate)
        speed_t = speed + t * speed_rate
        before = 0.0
        done = False
        for n in range(MAX_ITERATIONS):
            right_hand_side(p, c, stage_y, angle_t, speed_t, speed_rate, w, result)
            for i in range(F_G + N_BODY):
                w[W_D + i] = result[i] - w[acc + i]
            solve(p, fac, turned + orbit * t, w[W_D : W_D + F_SIZE], w)
            add_scaled(p, 1.0, w, W_D, w, acc)
            for i in range(F_WORK, F_SIZE):
                w[acc + i] = result[i]
            stage_state(p, acc, gh, w)
            iterations += 1.0
            size = newton_size(p, c, w[W_D : W_D + F_SIZE], gh)
            if not (size < 1e6):
                return False
            rate = contraction
            if n > 0:
                rate = size / (before + 1e-300)
                if size > 1e-2 * tolerance:
                    worst = max(worst, rate)
                if rate > 0.9 and size > tolerance:
                    return False
            if (n > 0 or not (probe and stage == STAGES - 1)) and size * rate <= tolerance * (
                1.0 - min(rate, 0.9)
            ):
                done = True
                break
            before = size
        if not done:
            return False
        keep_velocities(p, stage_y, W_VEL + stage * F_SIZE, w)
    # difference of the two solutions' velocities
    for i in range(F_SIZE):
        w[W_D + i] = 0.0
    for stage in range(STAGES):
        add_scaled(p, B[stage] - B_LOW[stage], w, W_ACC + stage * F_SIZE, w, W_D)
    report[0] = scaled_size(p, w[W_D : W_D + F_SIZE], h)
    report[1] = worst
    report[2] = iterations
    return True


@kernel
def integrate_power(h, w, totals):
    """Add work, and heat to inner ring, outer ring and oil (J) over the last step, by the same quadrature."""
    for k in range(4):
        total = 0.0
        for stage in range(STAGES):
            total += B[stage] * w[W_ACC + stage * F_SIZE + (F_WORK if k == 0 else F_HEAT + k - 1)]
        totals[k] += h * total
