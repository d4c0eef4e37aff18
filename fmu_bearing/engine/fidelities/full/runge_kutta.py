"""One bearing's part of a Runge-Kutta step, implicit or explicit; `step` joins all of them.

Of x'' = f(x, x') the accelerations of each stage are the unknowns. With base values from the stages before,
V = v_base + g h A and X = x_base + g h V, so Newton's method needs one solve with I - g h Jv - (g h)^2 Jx per
iteration. The first stage is the last one of the step before. Only ``accept`` of ``progress`` lets anything
into the state, which holds zeros beyond the last lane.
"""

from fmu_bearing.engine.fidelities.full.methods.table import TABLEAUX
from fmu_bearing.engine.fidelities.full.vectors import add_scaled, copy_rows, sum_scaled
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, load, select, splat, store, sum_four
from fmu_bearing.engine.layout import FOUR, STRIDE, TAB, C, F, P, Q, W, Y

MAX_ITERATIONS = 8


@kernel
def predict_balls(y, change, ahead, lanes, h, gh, stage, tableau, w):
    """Rows of a stage's state from the stages before, with a first guess of its accelerations."""
    here = W.ACC + stage * F.SIZE
    last = here - F.SIZE
    before = W.ACC + max(stage - 2, 0) * F.SIZE
    beyond = TABLEAUX[tableau + TAB.BEYOND + stage]
    for m in range(stage):
        store(w, W.WEIGHTS + m * FOUR, h * TABLEAUX[tableau + TAB.A + stage * TAB.ROW + m])
    for row in range(Y.RATES // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + lanes, FOUR):
            known = load(w, last + k)
            guess = known + beyond * (known - load(w, before + k)) + ahead * load(change, k)
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
def predict_bodies(y, change, ahead, h, gh, stage, tableau, w):
    """Do for the bodies what :func:`predict_balls` does for the balls."""
    here = W.ACC + stage * F.SIZE
    acc = w[here + F.BODY : here + F.WORK]
    last = w[here - F.SIZE + F.BODY : here]
    before = w[W.ACC + max(stage - 2, 0) * F.SIZE + F.BODY :]
    beyond = TABLEAUX[tableau + TAB.BEYOND + stage]
    q = w[W.STAGE + Y.Q0 : W.STAGE + Y.V0]
    v = w[W.STAGE + Y.V0 : W.STAGE + Y.SIZE]
    for i in range(Q.SIZE):
        acc[i] = last[i] + beyond * (last[i] - before[i]) + ahead * change[F.BODY + i]
        q[i] = y[Y.Q0 + i]
    sum_scaled(y[Y.V0 : Y.SIZE], gh, acc, v, Q.SIZE)
    for m in range(stage):
        a = h * TABLEAUX[tableau + TAB.A + stage * TAB.ROW + m]
        earlier = m * F.SIZE + F.BODY
        add_scaled(a, w[W.ACC + earlier :], v, Q.SIZE)
        add_scaled(a, w[W.VEL + earlier :], q, Q.SIZE)
    add_scaled(gh, v, q, Q.SIZE)


@kernel
def predict(y, change, ahead, lanes, h, gh, stage, tableau, w):
    """State of a stage into ``w[W.STAGE:]`` from the stages before and a first guess of its accelerations.

    The guess is on the straight line through the two stages before (``TAB.BEYOND``). ``change``: of the
    accelerations in the step before, of which ``ahead`` is added (`stages.ahead_of`).
    """
    predict_balls(y, change, ahead, lanes, h, gh, stage, tableau, w)
    predict_bodies(y, change, ahead, h, gh, stage, tableau, w)


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
def keep_velocities(y, lanes, out):
    """Copy the rates of all places of a state into ``out``, laid out like accelerations."""
    copy_rows(y[Y.VX :], out, Y.PLACES // STRIDE, lanes)
    for i in range(Q.SIZE):
        out[F.BODY + i] = y[Y.V0 + i]


@kernel
def newton_residual(acc, lanes, w):
    """Right-hand side less the stage's accelerations ``acc`` into ``w[W.D:]``."""
    for row in range(Y.RATES // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + lanes, FOUR):
            store(w, W.D + k, load(w, W.F + k) - load(acc, k))
    sum_scaled(w[W.F + F.BODY :], -1.0, acc[F.BODY :], w[W.D + F.BODY :], Q.SIZE)


@kernel
def complete_torque(p, c, speed, gh, gained, acc, w):
    """Take power, heats and shaft torque of a stage from ``w[W.F:]`` into its accelerations ``acc``.

    ``gained``: what the outer ring gains beyond ``w[W.F:]`` about the axis (N m). Power and torque belong to
    the state before Newton's last increment. The sliding which this increment still takes away counts little
    in Newton's norm. Yet traction is stiff: behind a jump of the forces that sliding can be as much torque as
    a ramp of the shaft takes. So the torque is completed by the balance of moments about the axis: what
    balls, cage and outer ring with its pedestal gain beyond ``w[W.F:]`` comes from the shaft.
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
