"""Fidelity `rings`: the rings' 11 degrees of freedom in time, the balls condensed.

Newmark's method with beta = 1/12 (Fox and Goodwin 1949; the same as Numerov's for the positions): fourth
order in the positions for any force that depends on position and time, second order in the small terms
that depend on velocity. Beta's next term, which depends on the mode, keeps resonances in their place
(:func:`predictor.displace`). Linearly implicit: the accelerations are guessed from earlier ones and corrected
by one evaluation with the inverse of B - h/2 J_v - h^2 beta J_x (B: masses), whose J is renewed only when the
correction stops contracting. A second evaluation follows where the first correction, times the contraction
measured now and then, would leave too much. Newmark's own velocity is true but for h^2/12 times the rate of
acceleration, which outputs take away again, and which is exchanged when the step changes.

A step is repeated at half its length when the correction does not settle, when balls find no rest, or when
the third difference of the accelerations shows that it is too long.
"""

from fmu_bearing.engine.dense import times
from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.balls import accelerations, count_settled, stand
from fmu_bearing.engine.fidelities.condensed.held import hold
from fmu_bearing.engine.fidelities.condensed.linearised import (
    at_rest,
    derivatives,
    factor_step,
    highest_mode,
)
from fmu_bearing.engine.fidelities.condensed.publish import publish
from fmu_bearing.engine.fidelities.condensed.rows import keep_balls, show_balls
from fmu_bearing.engine.fidelities.condensed.shared import (
    advance,
    emit,
    hold_masses,
    set_inputs,
    start_condensed,
)
from fmu_bearing.engine.fidelities.condensed.transverse import (
    add_transverse,
    begin_transverse,
    carry_transverse,
    correct_transverse,
    hold_across,
    keep_transverse,
    prepare_step,
)
from fmu_bearing.engine.fidelities.rings.predictor import change_spacing, displace, judge, predict
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, L, P, S, T, U, W, Y
from fmu_bearing.engine.mechanics.race import wave_time
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.newton.jacobian import is_angle
from fmu_bearing.engine.status import NO_START, NOT_CONVERGED, OK

_LONGEST = 2e-5  # s
# Radians per step. The highest ring mode: below the 2.45 at which the method turns unstable, with room for
# stiffness that varies. The fastest wave: the method errs by 1/240 of what it excites, 0.04 dB; at 10 kHz
# the step is 16 us.
_MODE = 2.2
_WAVE = 1.0
_ITERATIONS = 6
_PROBE = 32  # steps between measurements of the contraction
_SLOW = 0.25  # contraction beyond which a new Jacobian (23 evaluations) pays
# Shares of the tolerance: what the correction may leave in a step, and what the step's own error estimate
# may reach. Both repeat at every step and mostly alternate in sign.
_CORRECTION = 0.01
_TRUNCATION = 1.0
_GROW = 1.0 / 40  # of the allowed error: twice the step makes 16 times the error
_FIRST = 1.0 / 16  # of the longest step: the first one
_PATIENCE = 8  # steps before a longer one is tried


@kernel
def longest_step(p, lv, speed):
    """Longest internal step (s) at ``speed``: see the limits above."""
    h = min(_LONGEST, p[P.MAX_STEP])
    h = min(h, _MODE / (lv[L.HIGHEST] + 1.0))
    return min(h, _WAVE * wave_time(p, speed))


@kernel
def start_rings(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    status = start_condensed(p, u, s, w, t)
    if status != OK:
        return status
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    # from the even races' equilibrium to the one on waves and unequal balls, or the start would ring
    c = s[S.C : S.C + C.SIZE]
    keep_balls(w, lv, L.X3)
    stand(p, c, lv, 0.0, 0.0, 0.0, 0.0, s[S.SPEED], w)
    if not at_rest(p, c, lv, s[S.SPEED], w):
        for i in range(L.N):
            w[W.STAGE + Y.Q0 + i] = lv[L.MEAN + i]
        show_balls(lv, L.X3, w)
    for i in range(L.N):
        lv[L.Q0 + i] = w[W.STAGE + Y.Q0 + i]
        lv[L.V0 + i] = 0.0
        lv[L.A0 + i] = 0.0
        lv[L.LEVERS + i] = p[P.PITCH_RADIUS] if is_angle(i) else 1.0
    for row in (L.X, L.X1, L.X2):
        keep_balls(w, lv, row)
    lv[L.THETA] = 0.0
    lv[L.ROLLED] = 0.0
    if not begin_anew(p, s, w):
        return NO_START
    for _ in range(L.HISTORY):
        count_settled(lv, int(p[P.LANES]), w)
    # nothing is known of the rate of acceleration yet, which Newmark's velocity contains: begin finely
    s[S.STEP] = _FIRST * longest_step(p, lv, s[S.SPEED])
    publish(p, lv, s[S.SPEED], 0.0, True, s[S.Y : S.Y + Y.SIZE], s[S.F : S.F + F.SIZE])
    for i in range(3):
        s[S.MEAN_HEAT + i] = lv[L.HEAT + i]
    s[S.MEAN_TORQUE] = s[S.F + F.TORQUE]
    return OK


@kernel
def renew(p, s, w):
    """Jacobian at the present state, and the highest mode; False if there are none."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    for i in range(L.N):
        w[W.STAGE + Y.Q0 + i] = lv[L.Q0 + i]
        w[W.STAGE + Y.V0 + i] = lv[L.V0 + i]
    show_balls(lv, L.X, w)
    tau = p[P.CONTACT_DAMPING]
    speed = s[S.SPEED]
    theta = lv[L.THETA] + tau * lv[L.RATIO] * speed
    rolled = lv[L.ROLLED] + tau * lv[L.ROLL] * speed
    stand(p, c, lv, theta, rolled, s[S.ANGLE] + tau * speed, lv[L.Q0 + L.TURN], speed, w)
    if not derivatives(p, c, lv, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], w):
        return False
    hold_across(p, lv, w)
    lv[L.HIGHEST] = highest_mode(lv, w)
    lv[L.FACTOR_STEP] = 0.0
    lv[L.CONTRACTION] = 0.1
    lv[L.FRESH] = 1.0
    s[S.JACOBIANS] += 1.0
    return True


@kernel
def begin_anew(p, s, w):
    """After a jump: Jacobian and accelerations at the present state; False if there are none."""
    if not renew(p, s, w):
        return False
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    # the derivatives leave the rows of the balls a nanometre off
    q = w[T.Q : T.Q + L.COLUMN]
    if not accelerations(p, s[S.C : S.C + C.SIZE], lv, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], q, w):
        return False
    carry_transverse(p, lv, w)
    times(lv, L.INVERSE, w, W.F + F.BODY, w, T.A)
    for i in range(L.N):
        lv[L.A0 + i] = w[T.A + i]
    return True


@kernel
def take_inputs(p, u, s, w, h):
    """Set conditions and speed ramp; renew what is held where it is out of date. Status code."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    if not set_inputs(p, u, s, w, h):
        return OK
    status = hold(p, u, u[U.SPEED], s, w)
    if status != OK:
        return NOT_CONVERGED
    lv[L.KNOWN] = 0.0
    hold_masses(p, s, w)
    for i in range(Y.SIZE):
        w[W.STAGE + i] = 0.0
    return OK if begin_anew(p, s, w) else NOT_CONVERGED


@kernel
def size_of(p, w, at):
    """Largest of the ``L.N`` numbers at ``w[at:]``, tilts at the pitch radius."""
    lever = p[P.PITCH_RADIUS]
    size = 0.0
    for i in range(L.N):
        value = abs(w[at + i])
        if is_angle(i):
            value *= lever
        size = max(size, value)
    # a comparison drops what is not a number, a sum does not
    total = 0.0
    for i in range(L.N):
        total += w[at + i]
    return size + 0.0 * total


@kernel
def correct(p, s, h, tolerance, probe, w):
    """Trial state of a step by predictor and corrections; what the last leaves (m/s), or -1."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    rate = s[S.SPEED_RATE]
    speed = s[S.SPEED] + h * rate
    turned = h * (s[S.SPEED] + 0.5 * h * rate)
    angle = s[S.ANGLE] + turned
    predict(p, lv, h, w)
    begin_transverse(lv, h, w)
    tau = p[P.CONTACT_DAMPING]
    stand(
        p, c, lv, lv[L.THETA] + lv[L.RATIO] * turned + tau * lv[L.RATIO] * speed,
        lv[L.ROLLED] + lv[L.ROLL] * turned + tau * lv[L.ROLL] * speed, angle + tau * speed,
        w[W.STAGE + Y.Q0 + L.TURN], speed, w,
    )  # fmt: skip
    q = w[T.Q : T.Q + L.COLUMN]
    before = 0.0
    worst = 0.0
    for n in range(_ITERATIONS):
        # dampers and gyroscopic moments see the true velocity, or they would be wrong by (omega h)^2 / 12
        known = lv[L.KNOWN] >= 1.0
        longer = lv[L.KNOWN] >= 2.0
        for i in range(L.N):
            change = w[T.A + i] - lv[L.A0 + i]
            if known:
                earlier = lv[L.A0 + i] - lv[L.A1 + i]
                third = change - 2.0 * earlier + (lv[L.A1 + i] - lv[L.A2 + i]) if longer else 0.0
                change = 0.5 * (3.0 * change - earlier) + third / 3.0
            w[T.V + i] = w[W.STAGE + Y.V0 + i]
            w[W.STAGE + Y.V0 + i] -= h / 12.0 * change
        fine = accelerations(p, c, lv, angle, speed, rate, q, w)
        add_transverse(p, lv, w)
        for i in range(L.N):
            w[W.STAGE + Y.V0 + i] = w[T.V + i]
        if not fine:
            return -1.0
        times(lv, L.MASS, w, T.A, w, T.D)
        for i in range(L.N):
            w[W.F + F.BODY + i] -= w[T.D + i]
        times(lv, L.INVERSE, w, W.F + F.BODY, w, T.D)
        for i in range(L.N):
            d = w[T.D + i]
            w[T.A + i] += d
            w[W.STAGE + Y.V0 + i] += 0.5 * h * d
        displace(lv, h, w)
        correct_transverse(lv, h, w)
        size = 0.5 * h * size_of(p, w, T.D)
        s[S.NEWTON] += 1.0
        if not (size < 1e6):
            return -1.0
        contraction = lv[L.CONTRACTION]
        if n > 0:
            contraction = size / (before + 1e-300)
            # the ratio of smaller corrections is that of the balls' first-order forces
            if before > tolerance:
                worst = max(worst, contraction)
            if contraction > 0.9 and size > tolerance:
                return -1.0
        if (n > 0 or not probe) and size * contraction <= tolerance:
            if worst > 0.0:
                lv[L.CONTRACTION] = worst
            return size * contraction
        before = size
    return -1.0


@kernel
def accept(p, s, h, w):
    """Move the rings' and balls' state and the angle of ball 0 to the end of the step."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    lanes = int(p[P.LANES])
    for i in range(L.N):
        lv[L.A4 + i] = lv[L.A3 + i]
        lv[L.A3 + i] = lv[L.A2 + i]
        lv[L.A2 + i] = lv[L.A1 + i]
        lv[L.A1 + i] = lv[L.A0 + i]
        lv[L.A0 + i] = w[T.A + i]
        lv[L.Q0 + i] = w[W.STAGE + Y.Q0 + i]
        lv[L.V0 + i] = w[W.STAGE + Y.V0 + i]
    for row in range(0, 2 * STRIDE, STRIDE):
        for j in range(row, row + lanes, FOUR):
            store(lv, L.X4 + j, load(lv, L.X3 + j))
            store(lv, L.X3 + j, load(lv, L.X2 + j))
            store(lv, L.X2 + j, load(lv, L.X1 + j))
            store(lv, L.X1 + j, load(lv, L.X + j))
            store(lv, L.X + j, load(w, T.X + j))
    keep_transverse(lv, w)
    count_settled(lv, lanes, w)
    lv[L.KNOWN] += 1.0
    lv[L.CALM] += 1.0
    lv[L.FRESH] = 0.0
    turned = h * (s[S.SPEED] + 0.5 * h * s[S.SPEED_RATE])
    lv[L.THETA] = wrap(lv[L.THETA] + lv[L.RATIO] * turned)
    lv[L.ROLLED] = wrap(lv[L.ROLLED] + lv[L.ROLL] * turned)


@kernel
def try_step(p, s, h, tolerance, w):
    """One attempt of length ``h``: its error over the allowed one, or -1 with a fresh Jacobian in vain."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    change_spacing(lv, h)
    for _ in range(2):
        if lv[L.CONTRACTION] > _SLOW and lv[L.FRESH] == 0.0 and not renew(p, s, w):
            return -1.0
        prepare_step(lv, h)
        if abs(h - lv[L.FACTOR_STEP]) > 0.05 * h:
            if not factor_step(lv, 0.5 * h, h * h / 12.0, h**4 / 240.0, w):
                return -1.0
            lv[L.FACTOR_STEP] = h
        probe = s[S.STEPS] % _PROBE == 0.0
        left = correct(p, s, h, _CORRECTION * tolerance, probe, w)
        if left >= 0.0:
            return 0.01 * h * judge(lv, w) / (_TRUNCATION * tolerance)
        if lv[L.FRESH] != 0.0:
            return -1.0
        lv[L.CONTRACTION] = 1.0
    return -1.0


@kernel
def march_rings(p, u, s, w, h):
    """Advance the state by the communication step ``h`` (s); status code."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    steps.begin_means(s)
    status = take_inputs(p, u, s, w, h)
    if status != OK:
        return status
    tolerance = steps.velocity_tolerance(p, u[U.SPEED])
    longest = longest_step(p, lv, max(abs(s[S.SPEED]), abs(u[U.SPEED])))
    end = s[S.TIME] + h
    left = steps.most_attempts(h, longest, 100.0)
    remaining = h
    while steps.unfinished(remaining, h, end):
        cap = min(s[S.STEP], longest)
        length = steps.even_length(remaining, cap)
        error = try_step(p, s, length, tolerance, w)
        left -= 1.0
        if not (0.0 <= error <= 1.0):
            if not steps.rejected(s, 0.5 * length, h) or left < 0.0:
                return NOT_CONVERGED
            continue
        if left < 0.0:
            return NOT_CONVERGED
        accept(p, s, length, w)
        if p[P.SOUND_SIZE] != 0.0:
            emit(p, s, w, length, True)
        advance(s, length)
        remaining = end - s[S.TIME]
        if error < _GROW and lv[L.CALM] >= _PATIENCE and lv[L.KNOWN] >= 3.0:
            s[S.STEP] = min(longest, 2.0 * cap)
    s[S.TIME] = end
    s[S.SPEED] = u[U.SPEED]
    publish(p, lv, s[S.SPEED], s[S.SPEED_RATE], True, s[S.Y : S.Y + Y.SIZE], s[S.F : S.F + F.SIZE])
    steps.end_means(s, h)
    return OK
