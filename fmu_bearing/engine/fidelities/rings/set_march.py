"""Fidelity rings for a set: as ``fidelities.rings.march`` for one bearing, over the set's coordinates."""

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.balls import accelerations, count_settled, stand
from fmu_bearing.engine.fidelities.condensed.rows import from_equilibrium, keep_balls
from fmu_bearing.engine.fidelities.condensed.shared import advance, keep_end, show_end
from fmu_bearing.engine.fidelities.condensed.transverse import (
    add_transverse,
    begin_transverse,
    correct_transverse,
    prepare_step,
)
from fmu_bearing.engine.fidelities.full.start import begin_means
from fmu_bearing.engine.fidelities.rings import coupled, march, predictor, set_held
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, STRIDE, C, H, L, P, S, T, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.shaft import shaft_forces
from fmu_bearing.engine.spindle.sound import emit
from fmu_bearing.engine.status import NO_START, NOT_CONVERGED, OK


@kernel
def longest_of(p, own, speed):
    """Longest internal step (s) at ``speed`` (rad/s)."""
    # a shaft that bends has modes far above those that matter: see `displace_set`
    highest = 0.0 if coupled.bends(p) else own[members.march(p) + H.HIGHEST]
    longest = march.longest_step(members.parameters(p, 0), highest, speed)
    for b in range(1, members.count(p)):
        longest = min(longest, march.longest_step(members.parameters(p, b), highest, speed))
    return longest


@kernel
def place_on_waves(p, s, w, speed):
    """Put shaft, housing, rings and balls where they rest on waves and unequal balls into the trial places.

    Where there is no such rest, they stay at the quasi-static place, with the balls' places in ``L.EVEN``.
    """
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    place = members.vector(p, SP.PLACE)
    found = False
    for again in range(2):
        for i in range(members.padded(p)):
            ws[place + i] = own[SP.S_HEAD + i]
        for b in range(members.count(p)):
            sb = members.state(p, s, b)
            wb = members.work(p, w, b)
            for i in range(Y.SIZE):
                wb[W.STAGE + i] = 0.0
            pb = members.parameters(p, b)
            lv = members.condensed(sb)
            from_equilibrium(pb, lv, lv[L.THETA], wb)
            c = sb[S.C : S.C + C.SIZE]
            stand(pb, c, lv, lv[L.THETA], lv[L.ROLLED], s[S.ANGLE], 0.0, speed, wb)
        if again == 0:
            found = coupled.at_rest(p, s, w, speed)
        if found:
            break


@kernel
def start_rings_set(p, u, s, w, t):
    """Fill the state ``s`` of a set for the inputs ``u`` at time ``t`` (s); status code."""
    status = set_held.start_held(p, u, s, w, t)
    if status != OK:
        return status
    own = members.own_state(p, s)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        lv = members.condensed(sb)
        for j in range(STRIDE):
            lv[L.EVEN + j] = sb[S.Y + Y.X + j]
            lv[L.EVEN_R + j] = sb[S.Y + Y.R + j]
    if not begin_at_rest(p, s, w):
        return NO_START
    for b in range(members.count(p)):
        begin_means(members.state(p, s, b))
    for i in range(2):
        own[SP.MEAN_HEAT + i] = 0.0
    return OK


@kernel
def begin_at_rest(p, s, w):
    """Begin where the set rests at the clock and angles reached: ``fidelities.rings.start.begin_at_rest``."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    place_on_waves(p, s, w, s[S.SPEED])
    for i in range(members.padded(p)):
        own[members.history(p) + i] = ws[members.vector(p, SP.PLACE) + i]
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        for row in (L.X, L.X1, L.X2):
            keep_balls(members.work(p, w, b), lv, row)
    found = coupled.begin_anew(p, s, w)
    if not found:
        own[members.march(p) + H.CONTRACTION] = 1.0
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        for _ in range(L.HISTORY):
            count_settled(lv, int(members.parameters(p, b)[P.LANES]), members.work(p, w, b))
    # nothing is known of the rate of acceleration yet, which Newmark's velocity contains: begin finely
    s[S.STEP] = march.FIRST * longest_of(p, own, s[S.SPEED])
    coupled.publish_set(p, s, w)
    return found


@kernel
def displace_set(p, own, ws, h):
    """Add to the trial places what the change ``SP.INCREMENT`` of the accelerations moves them by.

    Modes above 2.45 radians per step make Newmark's method with the first two terms of beta unstable (see
    ``fidelities.rings.predictor.displaced``), and those of a shaft that bends go up to 100 kHz. There a third
    term is added, (omega h)^4 / 3200: with 1 / 3900 no frequency is unstable, the rest is room for stiffness
    that varies. Slow modes are off by no more than without, as the series goes on with 1 / 6048.
    """
    turned = members.vector(p, SP.FORCE)
    d = members.vector(p, SP.INCREMENT)
    coupled.answer(p, own, ws, members.squares(p), d, turned)
    n = members.coordinates(p)
    place = members.vector(p, SP.PLACE)
    predictor.displaced(ws, d, turned, place, n, h)
    if coupled.bends(p):
        again = members.vector(p, SP.RATE)
        coupled.answer(p, own, ws, members.squares(p), turned, again)
        for i in range(n):
            ws[place + i] += coupled.THIRD * h**6 * ws[again + i]


@kernel
def predict_set(p, s, w, h):
    """Trial state at the end of a step ``h`` (s): coordinates, balls' places, what stands under them."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    predictor.guess(
        own, members.march(p), members.history(p), members.padded(p), members.coordinates(p), h, ws,
        members.vector(p, SP.ACCELERATION), members.vector(p, SP.INCREMENT), members.vector(p, SP.PLACE),
        members.vector(p, SP.NEWMARK),
    )  # fmt: skip
    displace_set(p, own, ws, h)
    for b in range(members.count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        coupled.follow_trial(p, b, own, ws, wb, h)
        predictor.continue_places(lv, int(pb[P.LANES]), wb)
        begin_transverse(lv, h, wb)
        march.stand_ahead(pb, sb, h, wb)


@kernel
def true_rates(p, own, ws, h):
    """Put the rates that dampers and gyroscopic moments see to ``SP.RATE``: `fidelities.rings.march.correct`.

    The rate of acceleration that the trial itself counts in makes modes about 3 radians per step unstable
    from 5 % damping on. Where a shaft bends there are such modes: there it is that of the last step, which
    leaves all modes stable and shifts the frequency of a slow one by its damping ratio times (omega h)^3 / 8.
    """
    numbers = members.march(p)
    x = members.history(p)
    lanes = members.padded(p)
    n = members.coordinates(p)
    acc = members.vector(p, SP.ACCELERATION)
    newmark = members.vector(p, SP.NEWMARK)
    rate = members.vector(p, SP.RATE)
    if not coupled.bends(p) or own[numbers + H.KNOWN] < 1.0:
        predictor.true_velocities(own, numbers, x, lanes, n, h, ws, acc, newmark, rate)
        return
    for i in range(n):
        change = own[x + H.A0 * lanes + i] - own[x + H.A1 * lanes + i]
        ws[rate + i] = ws[newmark + i] - h / 12.0 * change


@kernel
def residual_of(p, s, w, h):
    """Put what is out of balance at the trial state to ``SP.RESIDUAL``; False where balls find no rest."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    rate = s[S.SPEED_RATE]
    speed = s[S.SPEED] + h * rate
    angle = s[S.ANGLE] + h * (s[S.SPEED] + 0.5 * h * rate)
    acc = members.vector(p, SP.ACCELERATION)
    residual = members.vector(p, SP.RESIDUAL)
    true_rates(p, own, ws, h)
    shaft_forces(
        p, own, ws, members.vector(p, SP.PLACE), members.vector(p, SP.RATE), angle, speed, rate, ws, residual
    )  # fmt: skip
    members.add_product(p, members.table(p, SP.AT_MASS), -1.0, ws, acc, ws, residual)
    for b in range(members.count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        coupled.follow_trial(p, b, own, ws, wb, h)
        q = wb[T.Q : T.Q + L.COLUMN]
        fine = accelerations(pb, sb[S.C : S.C + C.SIZE], lv, angle, speed, rate, q, wb)
        add_transverse(pb, lv, wb)
        if not fine:
            return False
        coupled.pull_rings(p, b, lv, wb, ws)
    return True


@kernel
def correct_once(p, s, w, h):
    """Correct the trial state by the residual; the size (m/s) of the correction."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded(p)
    d = members.vector(p, SP.INCREMENT)
    coupled.answer(p, own, ws, members.inverse(p), members.vector(p, SP.RESIDUAL), d)
    for i in range(n):
        ws[members.vector(p, SP.ACCELERATION) + i] += ws[d + i]
        ws[members.vector(p, SP.NEWMARK) + i] += 0.5 * h * ws[d + i]
    displace_set(p, own, ws, h)
    known = own[members.march(p) + H.KNOWN]
    counts = 0.0 if coupled.bends(p) and known >= 1.0 else predictor.last_counts(known)
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        members.moved(p, b, ws, d, wb, T.D)
        correct_transverse(members.condensed(members.state(p, s, b)), h, counts, wb)
    return 0.5 * h * march.size_of(own, members.history(p) + H.LEVERS * lanes, n, ws, d)


@kernel
def correct_rings(p, s, w, h, tolerance, probe):
    """Trial state of a step by predictor and corrections; what the last leaves (m/s), or -1."""
    own = members.own_state(p, s)
    at = members.march(p) + H.CONTRACTION
    predict_set(p, s, w, h)
    before = 0.0
    worst = 0.0
    for n in range(march.ITERATIONS):
        if not residual_of(p, s, w, h):
            return -1.0
        size = correct_once(p, s, w, h)
        s[S.NEWTON] += 1.0
        left, worst = march.judge_correction(own[at], size, before, worst, n, probe, tolerance)
        if left >= 0.0:
            if worst > 0.0:
                own[at] = worst
            return left
        if left != left:
            return -1.0
        before = size
    return -1.0


@kernel
def try_rings(p, s, w, h, tolerance):
    """One attempt of length ``h``: its error over the allowed one, or -1 with a fresh Jacobian in vain."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    lanes = members.padded(p)
    numbers = members.march(p)
    x = members.history(p)
    predictor.change_spacing(own, numbers, x, lanes, members.coordinates(p), h)
    coupled.tell_march(p, s)
    for _ in range(2):
        if (
            own[numbers + H.CONTRACTION] > march.SLOW
            and own[numbers + H.FRESH] == 0.0
            and not coupled.renew_rings(p, s, w)
        ):
            return -1.0
        for b in range(members.count(p)):
            prepare_step(members.condensed(members.state(p, s, b)), h)
        if abs(h - own[numbers + H.FACTOR_STEP]) > 0.05 * h:
            if not coupled.factor_rings(p, s, w, h):
                return -1.0
            own[numbers + H.FACTOR_STEP] = h
        probe = s[S.STEPS] % march.PROBE == 0.0
        left = correct_rings(p, s, w, h, march.CORRECTION * tolerance, probe)
        if left >= 0.0:
            acc = members.vector(p, SP.ACCELERATION)
            third = predictor.judged(own, numbers, x, lanes, ws, acc, members.vector(p, SP.INCREMENT))
            return 0.01 * h * third / (march.TRUNCATION * tolerance)
        if own[numbers + H.FRESH] != 0.0:
            return -1.0
        own[numbers + H.CONTRACTION] = 1.0
    return -1.0


@kernel
def emit_rings(p, s, w, h):
    """Sound samples of the step ``h`` (s) just made; publish its end."""
    coupled.show(p, s, w)
    emit_shown(p, s, w, h)


@kernel
def emit_shown(p, s, w, h):
    """Sound samples of the step ``h`` (s) to the rings as they are shown; publish its end."""
    for b in range(members.count(p)):
        show_end(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b), h, False)
    emit(p, s, w, h)
    for b in range(members.count(p)):
        keep_end(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))


@kernel
def accept_rings(p, s, w, h):
    """Move the set's state to the end of the step ``h`` (s)."""
    own = members.own_state(p, s)
    predictor.move_on(
        own, members.history(p), members.padded(p), members.coordinates(p), members.own_work(p, w),
        members.vector(p, SP.ACCELERATION), members.vector(p, SP.PLACE), members.vector(p, SP.NEWMARK),
    )  # fmt: skip
    march.count_step(own, members.march(p))
    for b in range(members.count(p)):
        mine = members.kept(p, b)
        march.accept_balls(members.parameters(p, b), members.state(p, s, b), h, members.work(p, w, b))
        own[mine + SP.OFFSET] += h * own[mine + SP.OFFSET_RATE]
    coupled.tell_march(p, s)
    if p[P.SOUND_SIZE] != 0.0:
        emit_rings(p, s, w, h)
    for b in range(members.count(p)):
        advance(members.state(p, s, b), h)


@kernel
def take_inputs(p, u, s, w, h):
    """Set conditions, loads and ramps; renew what is held where it is out of date. Status code."""
    if not set_held.take_rings_inputs(p, u, s, w, h):
        return OK
    if set_held.hold_set(p, u, s, w) != OK:
        return NOT_CONVERGED
    own = members.own_state(p, s)
    own[members.march(p) + H.KNOWN] = 0.0
    coupled.tell_march(p, s)
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        for i in range(Y.SIZE):
            wb[W.STAGE + i] = 0.0
    return OK if coupled.begin_anew(p, s, w) else NOT_CONVERGED


@kernel
def go_on(p, u, s, w, h, remaining, end):
    """Step through what remains (s) of the communication step ``h`` (s) to time ``end``; status code."""
    own = members.own_state(p, s)
    speed = u[SP.U_SPEED]
    numbers = members.march(p)
    tolerance = steps.velocity_tolerance(p, speed)
    longest = longest_of(p, own, max(abs(s[S.SPEED]), abs(speed)))
    left = steps.most_attempts(h, longest, 100.0)
    while steps.unfinished(remaining, h, end):
        cap = min(s[S.STEP], longest)
        length = steps.even_length(remaining, cap)
        error = try_rings(p, s, w, length, tolerance)
        left -= 1.0
        if not (0.0 <= error <= 1.0):
            if not steps.rejected(s, 0.5 * length, h) or left < 0.0:
                return NOT_CONVERGED
            continue
        if left < 0.0:
            return NOT_CONVERGED
        accept_rings(p, s, w, length)
        remaining = end - s[S.TIME]
        if error < march.GROW and own[numbers + H.CALM] >= march.PATIENCE and own[numbers + H.KNOWN] >= 3.0:
            s[S.STEP] = min(longest, 2.0 * cap)
    return OK
