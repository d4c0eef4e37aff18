"""Runge-Kutta step, implicit or explicit, on x'' = f(x, x') with the accelerations of each stage as unknowns.

With base values from the stages before, V = v_base + g h A and X = x_base + g h V, so Newton's method needs
one solve with I - g h Jv - (g h)^2 Jx per iteration. The first stage is the last one of the step before.
Only ``accept`` of ``progress`` lets anything into the state, which holds zeros beyond the last lane.
"""

import math

from fmu_bearing.engine.fidelities.full import flexible
from fmu_bearing.engine.fidelities.full.methods.table import TABLEAUX
from fmu_bearing.engine.fidelities.full.norms import body_size, newton_size, row_size
from fmu_bearing.engine.fidelities.full.vectors import add_scaled, copy_rows, sum_scaled
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, load, select, splat, store, sum_four
from fmu_bearing.engine.layout import FOUR, STRIDE, TAB, C, F, P, Q, W, Y
from fmu_bearing.engine.mechanics.ball_waves import turn_axes
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.block_arrow import solve

MAX_ITERATIONS = 8


@kernel
def error_size(p, c, h, tableau, fac, co, si, w):
    """Size (m/s) of the difference between the two solutions' velocities.

    For implicit methods it is divided by the Newton matrix (Shampine and Baca 1984), factors ``fac`` turned
    by the angle with cosine ``co`` and sine ``si``: what is too stiff for the step, and has died away in it,
    then means nothing. For explicit methods the stiff share is what tells of instability.
    """
    stages = int(TABLEAUX[tableau + TAB.COUNT])
    explicit = TABLEAUX[tableau + TAB.GAMMA] == 0.0
    d = w[W.D : W.D + F.SIZE]
    for i in range(F.SIZE):
        d[i] = 0.0
    for m in range(stages):
        e = h * TABLEAUX[tableau + TAB.ERROR + m]
        acc = W.ACC + m * F.SIZE
        add_scaled(e, w[acc : acc + F.WORK], d, F.WORK)
    if explicit:
        return newton_size(p, c, d, 1.0)
    solve(p, fac, co, si, d, w)
    return math.sqrt(body_size(p, d, F.BODY, 0.1) + 0.01 * row_size(d, F.X, 2, int(p[P.LANES])))


@kernel
def predict_balls(y, lanes, h, gh, stage, tableau, w):
    """Rows of a stage's state from the stages before, and of its first guess: the accelerations before it."""
    here = W.ACC + stage * F.SIZE
    for m in range(stage):
        store(w, W.WEIGHTS + m * FOUR, h * TABLEAUX[tableau + TAB.A + stage * TAB.ROW + m])
    for row in range(Y.RATES // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + lanes, FOUR):
            guess = load(w, here - F.SIZE + k)
            rate = load(y, Y.VX + k) + gh * guess
            for m in range(stage):
                rate += load(w, W.WEIGHTS + m * FOUR) * load(w, W.ACC + m * F.SIZE + k)
            store(w, here + k, guess)
            store(w, W.STAGE + Y.VX + k, rate)
    for row in range(Y.PLACES // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + lanes, FOUR):
            place = load(y, k)
            for m in range(stage):
                place += load(w, W.WEIGHTS + m * FOUR) * load(w, W.VEL + m * F.SIZE + k)
            store(w, W.STAGE + k, place + gh * load(w, W.STAGE + Y.VX + k))


@kernel
def predict_bodies(y, h, gh, stage, tableau, w):
    """Do for the bodies what :func:`predict_balls` does for the balls."""
    here = W.ACC + stage * F.SIZE
    acc = w[here + F.BODY : here + F.WORK]
    before = w[here - F.SIZE + F.BODY : here]
    q = w[W.STAGE + Y.Q0 : W.STAGE + Y.V0]
    v = w[W.STAGE + Y.V0 : W.STAGE + Y.SIZE]
    for i in range(Q.SIZE):
        acc[i] = before[i]
        q[i] = y[Y.Q0 + i]
    sum_scaled(y[Y.V0 : Y.SIZE], gh, acc, v, Q.SIZE)
    for m in range(stage):
        a = h * TABLEAUX[tableau + TAB.A + stage * TAB.ROW + m]
        earlier = m * F.SIZE + F.BODY
        add_scaled(a, w[W.ACC + earlier :], v, Q.SIZE)
        add_scaled(a, w[W.VEL + earlier :], q, Q.SIZE)
    add_scaled(gh, v, q, Q.SIZE)


@kernel
def predict(y, lanes, h, gh, stage, tableau, w):
    """State of a stage into ``w[W.STAGE:]`` from the stages before and a first guess of its accelerations."""
    predict_balls(y, lanes, h, gh, stage, tableau, w)
    predict_bodies(y, h, gh, stage, tableau, w)


@kernel
def correct(acc, lanes, gh, w):
    """Add the increment in ``w[W.D:]`` to a stage's accelerations ``acc`` and to its state."""
    rates = W.STAGE + Y.VX
    square = gh * gh
    for row in range(Y.RATES // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + lanes, FOUR):
            d = load(w, W.D + k)
            store(acc, k, load(acc, k) + d)
            store(w, rates + k, load(w, rates + k) + gh * d)
            if row < Y.PLACES // STRIDE:
                store(w, W.STAGE + k, load(w, W.STAGE + k) + square * d)
    bodies = w[W.D + F.BODY : W.D + F.WORK]
    add_scaled(1.0, bodies, acc[F.BODY :], Q.SIZE)
    add_scaled(gh, bodies, w[W.STAGE + Y.V0 : W.STAGE + Y.SIZE], Q.SIZE)
    add_scaled(square, bodies, w[W.STAGE + Y.Q0 : W.STAGE + Y.V0], Q.SIZE)


@kernel
def keep_velocities(y, lanes, kept):
    """Copy the rates of all places of a state into ``kept``, laid out like accelerations."""
    copy_rows(y[Y.VX :], kept, Y.PLACES // STRIDE, lanes)
    for i in range(Q.SIZE):
        kept[F.BODY + i] = y[Y.V0 + i]


@kernel
def newton_residual(acc, lanes, w):
    """Right-hand side less the stage's accelerations ``acc`` into ``w[W.D:]``."""
    for row in range(Y.RATES // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + lanes, FOUR):
            store(w, W.D + k, load(w, W.F + k) - load(acc, k))
    sum_scaled(w[W.F + F.BODY :], -1.0, acc[F.BODY :], w[W.D + F.BODY :], Q.SIZE)


@kernel
def keep_powers(p, c, speed, gh, acc, w):
    """Take power, heats and shaft torque of a stage from ``w[W.F:]`` into its accelerations ``acc``."""
    outer = F.BODY + Q.OUTER + Q.TURN
    complete_torque(p, c, speed, gh, p[P.OUTER_POLAR] * (acc[outer] - w[W.F + outer]), acc, w)


@kernel
def complete_torque(p, c, speed, gh, gained, acc, w):
    """Do what `keep_powers` does with what the outer ring ``gained`` beyond ``w[W.F:]`` about the axis (N m).

    They belong to the state before Newton's last increment. The sliding which this increment still takes away
    counts little in Newton's norm. Yet traction is stiff: behind a jump of the forces that sliding can be as
    much torque as a ramp of the shaft takes. So the torque is completed by the balance of moments about the
    axis: what balls, cage and outer ring with its pedestal gain beyond ``w[W.F:]`` comes from the shaft.
    """
    lanes = int(p[P.LANES])
    orbit = splat(0.0)
    spin = splat(0.0)
    for j in range(0, lanes, FOUR):
        live = consecutive(j) < p[P.BALLS]
        orbit += select(live, load(acc, F.TH + j) - load(w, W.F + F.TH + j), 0.0)
        spin += select(live, load(acc, F.WX + j) - load(w, W.F + F.WX + j), 0.0)
    outer = F.BODY + Q.OUTER + Q.TURN
    cage = F.BODY + Q.CAGE + Q.TURN
    missing = p[P.BALL_MASS] * p[P.PITCH_RADIUS] * p[P.PITCH_RADIUS] * sum_four(orbit)
    missing += p[P.BALL_INERTIA] * sum_four(spin)
    missing += gained
    missing += p[P.CAGE_POLAR] * (acc[cage] - w[W.F + cage])
    if gh != 0.0:  # an explicit stage has no increment
        missing += gh * (c[C.DAMPING_SPIN] + gh * c[C.PEDESTAL_ROTATIONAL]) * w[W.D + outer]
    for i in range(F.WORK, F.SIZE):
        acc[i] = w[W.F + i]
    acc[F.TORQUE] += missing
    acc[F.WORK] += missing * speed


@kernel
def runge_kutta_step(
    p, c, y, f, axes, flexure, angle, speed, speed_rate, h, tableau, fac, turned, tolerance, contraction,
    probe, w, report,
):  # fmt: skip
    """One step of length ``h`` from (y, f); the new state goes to ``w[W.STAGE:]``, its f to ``w[W.LAST:]``.

    ``axes``: of wavy balls, at the step's start; ``flexure``: the rings' part of the state; ``tableau``:
    place in TABLEAUX; ``fac``: factors for about this ``h``; ``turned``: orbit angle (rad) since they were
    made; ``tolerance`` (m/s): Newton's error; ``contraction``: rate known so far; ``probe``: measure it anew.
    ``report`` takes ``W.ERROR``, ``W.CONTRACTION`` and ``W.ITERATIONS``. Returns False where Newton's method
    does not converge.
    """
    gh = TABLEAUX[tableau + TAB.GAMMA] * h
    stages = int(TABLEAUX[tableau + TAB.COUNT])
    lanes = int(p[P.LANES])
    stage_y = w[W.STAGE : W.STAGE + Y.SIZE]
    result = w[W.F : W.F + F.SIZE]
    increment = w[W.D : W.D + F.SIZE]
    for i in range(F.SIZE):
        w[W.ACC + i] = f[i]
        result[i] = 0.0
    keep_velocities(y, lanes, w[W.VEL : W.VEL + F.SIZE])
    bending = p[P.MODES] != 0.0
    flexible.begin_modes(p, flexure, w)
    orbit = y[Y.OM]
    iterations = 0.0
    worst = 0.0
    for stage in range(1, stages):
        here = W.ACC + stage * F.SIZE
        acc = w[here : here + F.SIZE]
        predict(y, lanes, h, gh, stage, tableau, w)
        if bending:
            flexible.predict_modes(p, flexure, h, gh, stage, tableau, w)
        t = h * TABLEAUX[tableau + TAB.NODES + stage]
        turn_axes(p, axes, y, lanes, t, w)
        angle_t = angle + t * (speed + 0.5 * t * speed_rate)
        speed_t = speed + t * speed_rate
        co = math.cos(turned + orbit * t)
        si = math.sin(turned + orbit * t)
        before = 0.0
        done = gh == 0.0
        if done:
            right_hand_side(p, c, stage_y, angle_t, speed_t, speed_rate, w, result)
            for i in range(Y.RATES + Q.SIZE):
                acc[i] = result[i]
            if bending:
                flexible.take_accelerations(p, stage, w)
        for n in range(0 if done else MAX_ITERATIONS):
            right_hand_side(p, c, stage_y, angle_t, speed_t, speed_rate, w, result)
            newton_residual(acc, lanes, w)
            if bending:
                flexible.solve_modes(p, flexure, stage, increment, w)
            solve(p, fac, co, si, increment, w)
            correct(acc, lanes, gh, w)
            if bending:
                flexible.correct_modes(p, stage, gh, w)
            iterations += 1.0
            size = flexible.modes_size(p, newton_size(p, c, increment, gh), gh, w)
            if not (size < 1e6):
                return False
            rate = contraction
            if n > 0:
                rate = size / (before + 1e-300)
                if size > 1e-2 * tolerance:
                    worst = max(worst, rate)
                if rate > 0.9 and size > tolerance:
                    return False
            if (n > 0 or not (probe and stage == stages - 1)) and size * rate <= tolerance * (
                1.0 - min(rate, 0.9)
            ):
                done = True
                break
            before = size
        if not done:
            return False
        keep_powers(p, c, speed_t, gh, acc, w)
        keep_velocities(stage_y, lanes, w[W.VEL + stage * F.SIZE : W.VEL + (stage + 1) * F.SIZE])
        if bending:
            flexible.keep_mode_velocities(p, stage, w)
    last = W.ACC + (stages - 1) * F.SIZE
    if last != W.LAST:
        for i in range(F.SIZE):
            w[W.LAST + i] = w[last + i]
    flexible.end_modes(p, stages, w)
    report[W.ERROR] = flexible.modes_error(p, error_size(p, c, h, tableau, fac, co, si, w), h, tableau, w)
    report[W.CONTRACTION] = worst
    report[W.ITERATIONS] = iterations
    return True


@kernel
def integrate_power(h, tableau, w, totals):
    """Add work, and heat to inner ring, outer ring and oil (J) over the last step, by the same quadrature."""
    stages = int(TABLEAUX[tableau + TAB.COUNT])
    for k in range(F.POWERS):
        total = 0.0
        for stage in range(stages):
            weight = TABLEAUX[tableau + TAB.B + stage]
            total += weight * w[W.ACC + stage * F.SIZE + F.WORK + k]
        totals[k] += h * total


@kernel
def integrate_torque(h, tableau, w, speed, speed_rate):
    """Work (J) and time integral (N m s) of the torque over the last step, by the same quadrature.

    ``speed`` (rad/s) at the step's begin, ``speed_rate`` (rad/s2) over it.
    """
    work = 0.0
    impulse = 0.0
    for stage in range(int(TABLEAUX[tableau + TAB.COUNT])):
        part = h * TABLEAUX[tableau + TAB.B + stage] * w[W.ACC + stage * F.SIZE + F.TORQUE]
        impulse += part
        work += part * (speed + h * TABLEAUX[tableau + TAB.NODES + stage] * speed_rate)
    return work, impulse
