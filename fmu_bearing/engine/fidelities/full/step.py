"""One Runge-Kutta step: the stages of every bearing and of the shaft go together.

``stage``: its number, from 0; ``tableau``: place of the method in ``TABLEAUX``; ``d``: residual, then
increment, as accelerations (layout ``F``); ``fac``: factors (layout ``A``). Other arguments: see
`spindle.members`.
"""

import math

from fmu_bearing.engine.fidelities.full import control, flexible
from fmu_bearing.engine.fidelities.full.jacobians import expected_contraction, kind_of
from fmu_bearing.engine.fidelities.full.methods.table import TABLEAUX
from fmu_bearing.engine.fidelities.full.norms import body_size, newton_size, row_size
from fmu_bearing.engine.fidelities.full.runge_kutta import (
    MAX_ITERATIONS,
    complete_torque,
    correct,
    keep_velocities,
    newton_residual,
)  # fmt: skip
from fmu_bearing.engine.fidelities.full.stages import (
    acceleration,
    begin_stages,
    predict_bearings,
    predict_shaft,
    velocity,
)  # fmt: skip
from fmu_bearing.engine.fidelities.full.vectors import add_scaled
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, TAB, C, F, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.conditions import grow_to
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.newton.block_arrow import solve
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import solve_set, solve_shaft, turn_since, turned
from fmu_bearing.engine.spindle.elimination import condense_residual, find_drive, solve_driven, turn_driven
from fmu_bearing.engine.spindle.follow import accelerate, free_forces, growth_power
from fmu_bearing.engine.spindle.port import (
    add_bearing_force,
    clear,
    has_port,
    prescribe_stage,
    store_rotor_force,
)
from fmu_bearing.engine.spindle.shaft import shaft_forces

_DIVERGED = 1e6  # m/s: size of an increment


@kernel
def evaluate(pb, sb, wb, angle, speed, rate):
    """Right-hand side of a bearing at its stage into ``W.F``, as if its rings were free."""
    right_hand_side(
        pb, sb[S.C : S.C + C.SIZE], wb[W.STAGE : W.STAGE + Y.SIZE], angle, speed, rate, wb,
        wb[W.F : W.F + F.SIZE],
    )  # fmt: skip


@kernel
def shaft_residual(p, own, ws, stage, angle, speed, rate):
    """Residual of the shaft's equations at a stage, without the bearings' part.

    Returns power in (W) and the heats of shaft and pedestal (W) there.
    """
    residual = members.vector(p, SP.RESIDUAL)
    work, bent, shaken = shaft_forces(
        p, own, ws, members.vector(p, SP.PLACE), members.vector(p, SP.RATE), angle, speed, rate, ws, residual
    )  # fmt: skip
    members.add_product(p, members.table(p, SP.AT_MASS), -1.0, ws, acceleration(p, stage), ws, residual)
    return work, bent, shaken


@kernel
def residual_of(pb, sb, wb, stage, angle, speed, rate):
    """Put a bearing's residual at a stage to ``W.D`` of its work space, as if its rings were free."""
    here = W.ACC + stage * F.SIZE
    evaluate(pb, sb, wb, angle, speed, rate)
    newton_residual(wb[here : here + F.SIZE], int(pb[P.LANES]), wb)
    if pb[P.MODES] != 0.0:
        flexible.solve_modes(pb, sb[flexure_state(pb) :], stage, wb[W.D : W.D + F.SIZE], wb)


@kernel
def add_increment(pb, sb, wb, stage, gh):
    """Add the increment in ``W.D`` to a bearing's stage; its size (m/s), which its report takes, too."""
    here = W.ACC + stage * F.SIZE
    correct(wb[here : here + F.SIZE], int(pb[P.LANES]), gh, wb)
    size = newton_size(pb, sb[S.C : S.C + C.SIZE], wb[W.D : W.D + F.SIZE], gh)
    if pb[P.MODES] != 0.0:
        flexible.correct_modes(pb, stage, gh, wb)
        size = flexible.modes_size(pb, size, gh, wb)
    wb[W.REPORT + W.SIZE] = size
    return size


@kernel
def increments(p, s, w, own, ws, stage, gh, angle, speed):
    """One iteration of Newton's method at a stage; its size (m/s), the largest over the bearings.

    With it power in and the heats of shaft and pedestal (W), of the state before the increment.
    """
    rate = s[S.SPEED_RATE]
    work, bent, shaken = shaft_residual(p, own, ws, stage, angle, speed, rate)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        residual_of(pb, sb, wb, stage, angle, speed, rate)
        condense_residual(p, b, pb, sb, wb, own, ws)
    solve_shaft(p, own, ws)
    largest = 0.0
    count = members.bearing_count(p)
    for k in range(count):
        b = count - 1 - k  # the last one's factors are still in the cache
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        solve_driven(p, b, pb, sb, wb, own, ws)
        size = add_increment(pb, sb, wb, stage, gh)
        # a size that is no number must not be overlooked
        largest = max(largest, size) if size < _DIVERGED else _DIVERGED
    increment = members.vector(p, SP.INCREMENT)
    mine = acceleration(p, stage)
    place = members.vector(p, SP.PLACE)
    moving = members.vector(p, SP.RATE)
    for i in range(members.padded_size(p)):
        d = ws[increment + i]
        ws[mine + i] += d
        ws[moving + i] += gh * d
        ws[place + i] += gh * gh * d
    return largest, work, bent, shaken


@kernel
def measure_contraction(p, w, stage, before):
    """Keep in each bearing's report how large its last increment is over ``before``, the set's largest (m/s).

    The set contracts as the bearing with the largest increment left, and it is that one's Jacobian that fits
    least: what others have left is less, or follows from it through the shaft.
    """
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        rate = wb[W.REPORT + W.SIZE] / (before + 1e-300)
        at = W.REPORT + W.CONTRACTION + kind_of(stage)
        wb[at] = max(wb[at], rate)


@kernel
def iterate(p, s, w, stage, h, gh, t, tolerance, probe):
    """Newton's method at a stage, ``t`` (s) into the step; returns iterations, negative if it fails.

    ``probe``: a second iteration in any case. What contractions are found to be goes to the reports.
    """
    angle = s[S.ANGLE] + t * (s[S.SPEED] + 0.5 * t * s[S.SPEED_RATE])
    speed = s[S.SPEED] + t * s[S.SPEED_RATE]
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    together = members.has_shaft(p)
    fac = s[S.FAC : S.CONDENSED]
    d = w[W.D : W.D + F.SIZE]
    co, si = turned(s, t)
    expected = expected_contraction(p, s, stage)
    work = bent = shaken = 0.0
    before = 0.0
    if together:
        turn_since(p, s, w, t)
    for n in range(MAX_ITERATIONS):
        if together:
            size, work, bent, shaken = increments(p, s, w, own, ws, stage, gh, angle, speed)
        else:
            residual_of(p, s, w, stage, angle, speed, s[S.SPEED_RATE])
            solve(p, fac, co, si, d, w)
            size = add_increment(p, s, w, stage, gh)
        if not (size < _DIVERGED):
            return -1.0
        rate = expected
        if n > 0:
            rate = size / (before + 1e-300)
            if size > 1e-2 * tolerance:
                measure_contraction(p, w, stage, before)
            if rate > 0.9 and size > tolerance:
                return -1.0
        if (n > 0 or not probe) and size * rate <= tolerance * (1.0 - min(rate, 0.9)):
            keep_powers(p, s, w, stage, gh, speed, work, bent, shaken, ws)
            return n + 1.0
        before = size
    return -1.0


@kernel
def corrected_forces(p, b, pb, wb, ws):
    """Put forces on the free rows of bearing ``b`` to the set's work space, with the last increment's change.

    Returns their place. What drove the rows in that increment is what these forces changed by.
    """
    at = members.scratch(p, b)
    driving = at + SP.LANES
    count = int(p[members.row(p, b) + SP.ROW_DRIVEN])
    turn_driven(count, ws, driving, ws[at + SP.TURNED], ws[at + SP.TURNED + 1])
    f = wb[W.F : W.F + F.SIZE]
    for i in range(count):
        f[F.BODY + i] -= ws[driving + i]
    free_forces(p, b, pb, f, ws, at)
    return at


@kernel
def keep_powers(p, s, w, stage, gh, speed, work, bent, shaken, ws):
    """Take powers, heats and torques of a finished stage; ``work``, ``bent``, ``shaken``: the shaft's (W).

    A ring whose rotation is driven gives the housing what the last increment changes of its moment.
    """
    if not members.has_shaft(p):
        here = W.ACC + stage * F.SIZE
        acc = w[here : here + F.SIZE]
        turn = F.BODY + Q.OUTER + Q.TURN
        gained = p[P.OUTER_POLAR] * (acc[turn] - w[W.F + turn])
        complete_torque(p, s[S.C : S.C + C.SIZE], speed, gh, gained, acc, w)
        return
    own = members.set_state(p, s)
    led = has_port(p)
    force = members.vector(p, SP.FORCE)
    if led:
        clear(ws, force, members.padded_size(p))
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        wb = members.work(p, w, b)
        sb = members.state(p, s, b)
        here = W.ACC + stage * F.SIZE
        acc = wb[here : here + F.SIZE]
        turn = F.BODY + Q.OUTER + Q.TURN
        gained = pb[P.OUTER_POLAR] * (acc[turn] - wb[W.F + turn])
        outer = p[members.row(p, b) + SP.ROW_DRIVEN] > Q.OUTER
        if led or outer:
            find_drive(p, b, pb, wb, ws)
        if outer:
            driving = ws[members.scratch(p, b) + SP.LANES + Q.OUTER + Q.TURN]
            gained = pb[P.OUTER_POLAR] * (wb[W.D + turn] - driving)
        c = sb[S.C : S.C + C.SIZE]
        complete_torque(pb, c, speed, gh, gained, acc, wb)
        if led:
            at = corrected_forces(p, b, pb, wb, ws)
            work += add_bearing_force(p, b, pb, wb[W.STAGE : W.STAGE + Y.SIZE], acc, ws, at, force)
        else:
            work += growth_power(p, b, own, wb[W.F + F.BODY], acc[F.BODY])
    put_powers(p, ws, stage, work, bent, shaken)


@kernel
def put_powers(p, ws, stage, work, bent, shaken):
    """Write a stage's power in and heats of shaft and pedestal (W), and the force on the rotor at a port."""
    if has_port(p):
        store_rotor_force(p, ws, stage)
    power = SP.POWER + stage * SP.POWERS
    ws[power] = work
    ws[power + 1] = bent
    ws[power + 2] = shaken


@kernel
def explicit_stage(p, s, w, stage, t):
    """Accelerations of an explicit stage: those just evaluated."""
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    angle = s[S.ANGLE] + t * (s[S.SPEED] + 0.5 * t * s[S.SPEED_RATE])
    speed = s[S.SPEED] + t * s[S.SPEED_RATE]
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        evaluate(pb, members.state(p, s, b), members.work(p, w, b), angle, speed, s[S.SPEED_RATE])
    work, bent, shaken = 0.0, 0.0, 0.0
    if members.has_shaft(p):
        work, bent, shaken = accelerate(p, s, w, True, t, angle, speed, s[S.SPEED_RATE])
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        here = W.ACC + stage * F.SIZE
        for i in range(F.SIZE):
            wb[here + i] = wb[W.F + i]
        if members.parameters(p, b)[P.MODES] != 0.0:
            flexible.take_accelerations(members.parameters(p, b), stage, wb)
    to = acceleration(p, stage)
    of_shaft = members.vector(p, SP.ACCELERATION)
    for i in range(lanes):
        ws[to + i] = ws[of_shaft + i]
    put_powers(p, ws, stage, work, bent, shaken)


@kernel
def first_powers(p, s, w):
    """Powers of the first stage: they were found when the state was reached."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    for i in range(SP.POWERS):
        ws[SP.POWER + i] = own[SP.POWER_NOW + i]
    for i in range(SP.PLANE):
        ws[SP.ROTOR_FORCE + i] = own[SP.PORT_FORCE + i]


@kernel
def nose_square(p, ws, vector):
    """Square (m2/s2) of the nose's velocity by the vector of coordinates at ``ws[vector:]``."""
    lanes = members.padded_size(p)
    nose = members.table(p, SP.AT_NOSE)
    square = 0.0
    for i in range(Q.INNER_BY):
        total = 0.0
        for k in range(lanes):
            total += p[nose + i * lanes + k] * ws[vector + k]
        square += total * total
    return square


@kernel
def shaft_estimate(p, w, h, tableau):
    """Put the difference of both solutions' rates to ``SP.INCREMENT``, times the mass to the residual."""
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    increment = members.vector(p, SP.INCREMENT)
    residual = members.vector(p, SP.RESIDUAL)
    for i in range(lanes):
        ws[increment + i] = 0.0
        ws[residual + i] = 0.0
    for m in range(int(TABLEAUX[tableau + TAB.COUNT])):
        e = h * TABLEAUX[tableau + TAB.ERROR + m]
        add_scaled(e, ws[acceleration(p, m) :], ws[increment:], lanes)
    members.add_product(p, members.table(p, SP.AT_MASS), 1.0, ws, increment, ws, residual)


@kernel
def step_error(p, s, w, h, tableau, speed):
    """Error estimate over what is allowed, the largest over the bearings; the nose counts as one of them.

    For implicit methods differences are divided by Newton's matrix (Shampine and Baca 1984): what is too
    stiff for the step, and has died away in it, then means nothing. For explicit methods the stiff share is
    what shows instability. ``speed`` (rad/s): of the shaft, that the tolerance goes with.
    """
    stages = int(TABLEAUX[tableau + TAB.COUNT])
    explicit = TABLEAUX[tableau + TAB.GAMMA] == 0.0
    together = members.has_shaft(p)
    if together:
        shaft_estimate(p, w, h, tableau)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        d = wb[W.D : W.D + F.SIZE]
        for i in range(F.SIZE):
            d[i] = 0.0
        for m in range(stages):
            acc = W.ACC + m * F.SIZE
            add_scaled(h * TABLEAUX[tableau + TAB.ERROR + m], wb[acc : acc + F.WORK], d, F.WORK)
    if not explicit and together:
        turn_since(p, s, w, h)
        solve_set(p, s, w)
    elif not explicit:
        co, si = turned(s, h)
        solve(p, s[S.FAC : S.CONDENSED], co, si, w[W.D : W.D + F.SIZE], w)
    largest = 0.0
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        d = wb[W.D : W.D + F.SIZE]
        allowed = control.allowed_estimate(control.allowed_velocity(pb, sb, speed))
        if explicit:
            size = newton_size(pb, sb[S.C : S.C + C.SIZE], d, 1.0)
        else:
            size = math.sqrt(body_size(pb, d, F.BODY, 0.1) + 0.01 * row_size(d, F.X, 2, int(pb[P.LANES])))
        size = flexible.modes_error(pb, size, h, tableau, wb)
        if b == 0 and together:
            moved = nose_square(p, members.set_work(p, w), members.vector(p, SP.INCREMENT))
            size = max(size, math.sqrt(moved))
        if not (size < _DIVERGED):
            return size
        largest = max(largest, size / allowed)
    return largest


@kernel
def grow_all(p, s, t):
    """Let the races of all bearings be those of the time ``t`` (s) after the state."""
    if p[P.FITS] != 0.0:
        for b in range(members.bearing_count(p)):
            grow_to(members.state(p, s, b)[S.C : S.C + C.SIZE], t)


@kernel
def runge_kutta_step(p, s, w, h, tableau, tolerance, probe, to_speed):
    """One step of length ``h`` (s), from the state into every bearing's ``W.STAGE`` and ``W.LAST``.

    ``tolerance`` (m/s): Newton's error; ``probe``: measure how its method contracts; ``to_speed`` (rad/s): of
    the shaft at the end of the communication step. The first bearing's report takes
    ``W.ERROR`` (over what is allowed) and ``W.ITERATIONS``, every bearing's ``W.CONTRACTION``. False where
    Newton's method does not converge.
    """
    gh = TABLEAUX[tableau + TAB.GAMMA] * h
    stages = int(TABLEAUX[tableau + TAB.COUNT])
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    report = w[W.REPORT : W.REPORT + W.REPORT_SIZE]
    together = members.has_shaft(p)
    begin_stages(p, s, w)
    if together:
        first_powers(p, s, w)
    for b in range(members.bearing_count(p)):
        contraction = members.work(p, w, b)[W.REPORT + W.CONTRACTION :]
        contraction[0] = contraction[1] = 0.0
    iterations = 0.0
    for stage in range(1, stages):
        t = h * TABLEAUX[tableau + TAB.NODES + stage]
        grow_all(p, s, t)
        if together:
            predict_shaft(p, s, w, h, gh, stage, tableau)
        predict_bearings(p, s, w, h, gh, stage, tableau)
        if has_port(p):
            prescribe_stage(p, s, w, stage, t)
        if gh == 0.0:
            explicit_stage(p, s, w, stage, t)
        else:
            last = probe and stage == stages - 1
            done = iterate(p, s, w, stage, h, gh, t, tolerance, last)
            if done < 0.0:
                return False
            iterations += done
        for b in range(members.bearing_count(p)):
            pb = members.parameters(p, b)
            wb = members.work(p, w, b)
            to = W.VEL + stage * F.SIZE
            keep_velocities(wb[W.STAGE : W.STAGE + Y.SIZE], int(pb[P.LANES]), wb[to : to + F.SIZE])
            if pb[P.MODES] != 0.0:
                flexible.keep_mode_velocities(pb, stage, wb)
        to = velocity(p, stage)
        rate = members.vector(p, SP.RATE)
        for i in range(lanes):
            ws[to + i] = ws[rate + i]
    last = W.ACC + (stages - 1) * F.SIZE
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        if last != W.LAST:
            for i in range(F.SIZE):
                wb[W.LAST + i] = wb[last + i]
        flexible.end_modes(members.parameters(p, b), stages, wb)
    report[W.ERROR] = step_error(p, s, w, h, tableau, to_speed)
    report[W.ITERATIONS] = iterations
    return True
