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

import math

from fmu_bearing.engine.dense import times
from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.ball_motion import carry_balls, move_balls, move_places
from fmu_bearing.engine.fidelities.condensed.balls import accelerations, count_settled, stand
from fmu_bearing.engine.fidelities.condensed.held import hold
from fmu_bearing.engine.fidelities.condensed.linearised import derivatives, factor_step, highest_mode
from fmu_bearing.engine.fidelities.condensed.rows import show_balls
from fmu_bearing.engine.fidelities.condensed.shared import advance, emit, hold_masses, set_inputs
from fmu_bearing.engine.fidelities.condensed.transverse import (
    add_transverse,
    begin_transverse,
    carry_transverse,
    correct_transverse,
    hold_across,
    keep_transverse,
    prepare_step,
)
from fmu_bearing.engine.fidelities.rings.predictor import (
    change_spacing,
    displace,
    judge,
    last_counts,
    move_on,
    predict,
    true_velocities,
)
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, H, L, P, S, T, U, W, Y
from fmu_bearing.engine.mechanics.race import wave_time
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.status import NOT_CONVERGED, OK

_LONGEST = 2e-5  # s
# Radians per step. The highest ring mode: below the 2.45 at which the method turns unstable, with room for
# stiffness that varies. The fastest wave: the method errs by 1/240 of what it excites, 0.04 dB; at 10 kHz
# the step is 16 us.
_MODE = 2.2
_WAVE = 1.0
ITERATIONS = 6
PROBE = 32  # steps between measurements of the contraction
SLOW = 0.25  # contraction beyond which a new Jacobian (23 evaluations) pays
# Shares of the tolerance: what the correction may leave in a step, and what the step's own error estimate
# may reach. Both repeat at every step and mostly alternate in sign.
CORRECTION = 0.01
TRUNCATION = 1.0
GROW = 1.0 / 40  # of the allowed error: twice the step makes 16 times the error
FIRST = 1.0 / 16  # of the longest step: the first one
PATIENCE = 8  # steps before a longer one is tried


@kernel
def longest_step(p, highest, speed):
    """Longest internal step (s) at ``speed``: see the limits above; ``highest``: mode (rad/s)."""
    h = min(_LONGEST, p[P.MAX_STEP])
    h = min(h, _MODE / (highest + 1.0))
    return min(h, _WAVE * wave_time(p, speed))


@kernel
def differentiate(p, s, w):
    """Jacobian at the present state, with balls held across their tracks; False if there is none."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    for i in range(L.N):
        w[W.STAGE + Y.Q0 + i] = lv[L.Q0 + i]
        w[W.STAGE + Y.V0 + i] = lv[L.V0 + i]
    show_balls(lv, L.X, w)
    tau = p[P.CONTACT_DAMPING]
    speed = s[S.SPEED]
    theta = lv[L.THETA] + tau * lv[L.RATIO] * speed
    stand(p, c, lv, theta, lv[L.ROLLED], s[S.ANGLE] + tau * speed, lv[L.Q0 + L.TURN], speed, w)
    if not derivatives(p, c, lv, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], w):
        return False
    hold_across(p, lv, w)
    s[S.JACOBIANS] += 1.0
    return True


@kernel
def begin_jacobian(x, numbers, highest):
    """Note a Jacobian at the present state with the ``highest`` mode (rad/s); ``numbers``: of the march."""
    x[numbers + H.HIGHEST] = highest
    x[numbers + H.FACTOR_STEP] = 0.0
    x[numbers + H.CONTRACTION] = 0.1
    x[numbers + H.FRESH] = 1.0


@kernel
def renew(p, s, w):
    """Jacobian at the present state, and the highest mode; False if there are none."""
    if not differentiate(p, s, w):
        return False
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    begin_jacobian(lv, L.MARCH, highest_mode(lv, w))
    return True


@kernel
def forces_anew(p, s, w):
    """After a jump and new derivatives: accelerations by the forces at the present state; False if none."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    # the derivatives leave the rows of the balls a nanometre off
    q = w[T.Q : T.Q + L.COLUMN]
    if not accelerations(p, s[S.C : S.C + C.SIZE], lv, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], q, w):
        return False
    carry_transverse(p, lv, w)
    if p[P.SOUND_SIZE] != 0.0:
        carry_balls(p, lv, w)
    return True


@kernel
def begin_anew(p, s, w):
    """After a jump: Jacobian and accelerations at the present state; False if there are none."""
    if not renew(p, s, w) or not forces_anew(p, s, w):
        return False
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
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
def size_of(x, levers, n, w, at):
    """Largest of the ``n`` numbers at ``w[at:]``, each times its lever at ``x[levers:]``."""
    size = 0.0
    for i in range(n):
        size = max(size, x[levers + i] * abs(w[at + i]))
    # a comparison drops what is not a number, a sum does not
    total = 0.0
    for i in range(n):
        total += w[at + i]
    return size + 0.0 * total


@kernel
def stand_ahead(p, s, h, w):
    """Put balls and race heights to the end of a step ``h`` (s), with the rings at their trial places."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    speed = s[S.SPEED] + h * s[S.SPEED_RATE]
    turned = h * (s[S.SPEED] + 0.5 * h * s[S.SPEED_RATE])
    tau = p[P.CONTACT_DAMPING]
    stand(
        p, s[S.C : S.C + C.SIZE], lv, lv[L.THETA] + lv[L.RATIO] * turned + tau * lv[L.RATIO] * speed,
        lv[L.ROLLED] + lv[L.ROLL] * turned, s[S.ANGLE] + turned + tau * speed,
        w[W.STAGE + Y.Q0 + L.TURN], speed, w,
    )  # fmt: skip


@kernel
def judge_correction(contraction, size, before, worst, n, probe, tolerance):
    """Return what correction ``n`` of ``size`` (m/s) leaves, and the worst contraction.

    Negative where another is needed, not a number where it is given up; ``before``: size of the last one.
    """
    if not (size < 1e6):
        return math.nan, worst
    if n > 0:
        contraction = size / (before + 1e-300)
        # the ratio of smaller corrections is that of the balls' first-order forces
        if before > tolerance:
            worst = max(worst, contraction)
        if contraction > 0.9 and size > tolerance:
            return math.nan, worst
    if (n > 0 or not probe) and size * contraction <= tolerance:
        return size * contraction, worst
    return -1.0, worst


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
    stand_ahead(p, s, h, w)
    q = w[T.Q : T.Q + L.COLUMN]
    v = W.STAGE + Y.V0
    before = 0.0
    worst = 0.0
    for n in range(ITERATIONS):
        # dampers and gyroscopic moments see the true velocity, or they would be wrong by (omega h)^2 / 12
        for i in range(L.N):
            w[T.V + i] = w[v + i]
        true_velocities(lv, L.MARCH, L.MOVING, L.COLUMN, L.N, h, w, T.A, T.V, v)
        fine = accelerations(p, c, lv, angle, speed, rate, q, w)
        add_transverse(p, lv, w)
        for i in range(L.N):
            w[v + i] = w[T.V + i]
        if not fine:
            return -1.0
        times(lv, L.MASS, w, T.A, w, T.D)
        for i in range(L.N):
            w[W.F + F.BODY + i] -= w[T.D + i]
        times(lv, L.INVERSE, w, W.F + F.BODY, w, T.D)
        for i in range(L.N):
            d = w[T.D + i]
            w[T.A + i] += d
            w[v + i] += 0.5 * h * d
        displace(lv, h, w)
        correct_transverse(lv, h, last_counts(lv[L.KNOWN]), w)
        size = 0.5 * h * size_of(lv, L.LEVERS, L.N, w, T.D)
        s[S.NEWTON] += 1.0
        left, worst = judge_correction(lv[L.CONTRACTION], size, before, worst, n, probe, tolerance)
        if left >= 0.0:
            if worst > 0.0:
                lv[L.CONTRACTION] = worst
            return left
        if left != left:
            return -1.0
        before = size
    return -1.0


@kernel
def accept_balls(p, s, h, w):
    """Move the balls' state and the angle of ball 0 to the end of the step."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    lanes = int(p[P.LANES])
    move_places(lv, lanes)
    for row in range(0, 2 * STRIDE, STRIDE):
        for j in range(row, row + lanes, FOUR):
            store(lv, L.X + j, load(w, T.X + j))
    if p[P.SOUND_SIZE] != 0.0:
        # what is not by the patterns' places of rest is friction's drive
        square = lv[L.SIDE_SQUARE]
        move_balls(
            p, lv, h, w[T.SIDE_DRIVEN] - square * w[T.SIDE_REST],
            w[T.SIDE_DRIVEN + 1] - square * w[T.SIDE_REST + 1],
            w[T.SIDE_DRIVEN + 2] - square * w[T.SIDE_REST + 2], w,
        )  # fmt: skip
    keep_transverse(lv, w)
    count_settled(lv, lanes, w)
    turned = h * (s[S.SPEED] + 0.5 * h * s[S.SPEED_RATE])
    lv[L.THETA] = wrap(lv[L.THETA] + lv[L.RATIO] * turned)
    lv[L.ROLLED] = wrap(lv[L.ROLLED] + lv[L.ROLL] * turned)


@kernel
def count_step(x, numbers):
    """Note a step made; ``numbers``: of the march in ``x``."""
    x[numbers + H.KNOWN] += 1.0
    x[numbers + H.CALM] += 1.0
    x[numbers + H.FRESH] = 0.0


@kernel
def accept(p, s, h, w):
    """Move the rings' and balls' state and the angle of ball 0 to the end of the step."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    move_on(lv, L.MOVING, L.COLUMN, L.N, w, T.A, W.STAGE + Y.Q0, W.STAGE + Y.V0)
    accept_balls(p, s, h, w)
    count_step(lv, L.MARCH)


@kernel
def try_step(p, s, h, tolerance, w):
    """One attempt of length ``h``: its error over the allowed one, or -1 with a fresh Jacobian in vain."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    change_spacing(lv, L.MARCH, L.MOVING, L.COLUMN, L.N, h)
    for _ in range(2):
        if lv[L.CONTRACTION] > SLOW and lv[L.FRESH] == 0.0 and not renew(p, s, w):
            return -1.0
        prepare_step(lv, h)
        if abs(h - lv[L.FACTOR_STEP]) > 0.05 * h:
            if not factor_step(lv, 0.5 * h, h * h / 12.0, h**4 / 240.0, w):
                return -1.0
            lv[L.FACTOR_STEP] = h
        probe = s[S.STEPS] % PROBE == 0.0
        left = correct(p, s, h, CORRECTION * tolerance, probe, w)
        if left >= 0.0:
            return 0.01 * h * judge(lv, w) / (TRUNCATION * tolerance)
        if lv[L.FRESH] != 0.0:
            return -1.0
        lv[L.CONTRACTION] = 1.0
    return -1.0


@kernel
def go_on(p, u, s, w, h, remaining, end):
    """Step through what remains (s) of the communication step ``h`` (s) to time ``end``; status code."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    tolerance = steps.velocity_tolerance(p, u[U.SPEED])
    longest = longest_step(p, lv[L.HIGHEST], max(abs(s[S.SPEED]), abs(u[U.SPEED])))
    left = steps.most_attempts(h, longest, 100.0)
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
        if error < GROW and lv[L.CALM] >= PATIENCE and lv[L.KNOWN] >= 3.0:
            s[S.STEP] = min(longest, 2.0 * cap)
    return OK
