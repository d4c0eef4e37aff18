"""The guarded one-evaluation path: blocks of Newmark steps, kept only if the last one proves them right.

A block leaves the state untouched until a second iteration at its end has shown that Newton's method
contracts, that what one iteration leaves is within the tolerance, and that the accelerations are smooth on
the scale of the step. Otherwise the block is thrown away and ESDIRK4 goes on from the untouched state.
"""

import math

from fmu_bearing.engine.fidelities.full.fast.newmark import BETA, BETA_BALL, iterate, predict, true_rates
from fmu_bearing.engine.fidelities.full.norms import body_size, newton_size
from fmu_bearing.engine.fidelities.full.progress import accept, renew_jacobian, wrap_angles
from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import STRIDE, C, F, J, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.ball_waves import turn_axes
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.readout.motion import emit_samples

LONGEST = 1e-5  # s: beyond it the rings' modes of the example bearings leave the method's range
SHORTEST = 4e-6  # s: below it ESDIRK4 costs no more
_SETTLING = 4e-3  # s after the start before the first try
_CONTRACTION = 0.2  # a second iteration must gain this much
_LEFT = 10.0  # what it finds, in tolerances: not an error that adds up, for the next step finds it again
_RANGE = 2.0  # rad: limit of frequency times step, of 2.45 for beta = 1/12
_BALL_RANGE = 2.1  # rad: the same for the balls
_OLDEST = 1e-2  # s: age of the Jacobian; the contraction usually asks for a new one earlier
_TRUSTED = 5e-2  # s without a refusal: the pauses are short again, and longer steps are tried
_HOLDS = (1e-3, 3.2e-2)  # s: pause after leaving, doubled each time it is soon left again
# what a block of steps turned out to be
_GOOD = 0
_SHORTER = 1  # asks for shorter steps
_LEAVE = 2  # asks for a pause


@kernel
def begin(s, t):
    """Set the path's own numbers at initialisation, time ``t`` (s)."""
    s[S.FALLBACKS] = 0.0
    s[S.FAST_STEP] = LONGEST
    s[S.FAST_COUNT] = 0.0
    s[S.FAST_HOLD] = t + _SETTLING
    s[S.FAST_PATIENCE] = _HOLDS[0]


@kernel
def leave(s, shorter, h):
    """Leave the path: for steps shorter than ``h`` at once, otherwise for a pause."""
    s[S.FALLBACKS] += 1.0
    s[S.FAST_COUNT] = 0.0
    s[S.FACTOR_STEP] = 0.0
    if shorter:
        s[S.FAST_STEP] = h / 1.5
        s[S.FAST_HOLD] = s[S.TIME]
    else:
        s[S.FAST_STEP] = LONGEST
        s[S.FAST_HOLD] = s[S.TIME] + s[S.FAST_PATIENCE]
        s[S.FAST_PATIENCE] = min(2.0 * s[S.FAST_PATIENCE], _HOLDS[1])


@kernel
def ring_range(s):
    """Upper bound (rad/s) of the rings' frequencies: diagonal of the Jacobian, the balls held."""
    most = 0.0
    for i in range(Q.RINGS):
        most = max(most, -s[S.JAC + J.E + i * J.BODIES + i])
    return math.sqrt(most)


@kernel
def remember(s, h, before):
    """Take an ESDIRK4 step of length ``h`` into the history; ``before``: the accelerations it began with."""
    if s[S.FAST_COUNT] == 0.0 or abs(h - s[S.FAST_LENGTH]) > 1e-6 * h:
        s[S.FAST_COUNT] = 0.0
        s[S.FAST_LENGTH] = h
    for i in range(F.SIZE):
        s[S.FAST_A2 + i] = s[S.FAST_A1 + i]
        s[S.FAST_A1 + i] = before[i]
        s[S.FAST_A0 + i] = s[S.F + i]
    s[S.FAST_COUNT] += 1.0
    if s[S.FAST_COUNT] == 2.0:
        a = s[S.FAST_A0 : S.FAST_A1]
        true_rates(
            s[S.Y : S.Y + Y.SIZE], -h, a, s[S.FAST_A1 : S.FAST_A2],
            s[S.FAST_A2 : S.FAST_A2 + F.SIZE], s[S.FAST_Y : S.FAST_A0],
        )  # fmt: skip


@kernel
def shift_history(s, before):
    """After a jump of the inputs the whole history moves by that of the accelerations since ``before``."""
    for i in range(F.BODY + Q.SIZE):
        jump = s[S.F + i] - before[i]
        s[S.FAST_A0 + i] += jump
        s[S.FAST_A1 + i] += jump
        s[S.FAST_A2 + i] += jump


@kernel
def load_block(s, w):
    """History, state and accelerations of the path into the block's first places."""
    for i in range(F.SIZE):
        w[W.BLOCK_A + i] = s[S.FAST_A2 + i]
        w[W.BLOCK_A + F.SIZE + i] = s[S.FAST_A1 + i]
        w[W.BLOCK_NOW + i] = s[S.FAST_A0 + i]
    for i in range(Y.SIZE):
        w[W.BLOCK_Y + i] = s[S.FAST_Y + i]


@kernel
def ball_beta(p, s, h):
    """Newmark's beta for the balls' places: 1/12 while the step resolves their modes, else 1/4."""
    most = 0.0
    for k in range(2):
        for j in range(int(p[P.LANES])):
            most = max(most, -s[S.JAC + J.B + k * (J.STATES + 1) * STRIDE + j])
    return BETA if most * h * h < _BALL_RANGE * _BALL_RANGE else BETA_BALL


@kernel
def difference(p, h, k, third, w):
    """First or third difference of the bodies' accelerations up to step ``k`` of the block (m/s, times h)."""
    d = w[W.D : W.D + F.SIZE]
    for i in range(F.BODY, F.BODY + Q.SIZE):
        now = W.BLOCK_NOW + k * F.SIZE + i
        before = now - F.SIZE
        if third:
            earlier = before - F.SIZE
            d[i] = w[now] - 3.0 * w[before] + 3.0 * w[earlier] - w[earlier - F.SIZE]
        else:
            d[i] = w[now] - w[before]
    return h * math.sqrt(body_size(p, d, F.BODY))


@kernel
def method_error(p, h, beta_ball, k, w):
    """Estimate (m/s) of what the method does to the rings' velocities at their present frequencies.

    Fox and Goodwin: (w h)^4/240 of a velocity v, of which the third difference is h (w h)^3 w v. Balls with
    beta = 1/4 answer with (w h)^2/6 of their inertia missing; h times the first difference is (w h)^2 v.
    """
    error = difference(p, h, k, True, w) / 240.0
    if beta_ball != BETA:
        share = p[P.BALLS] * p[P.BALL_MASS] / min(p[P.INNER_MASS], p[P.OUTER_MASS])
        error += share / 6.0 * difference(p, h, k, False, w)
    return error


@inlined
def try_block(p, s, w, h, beta_ball, count, tolerance):
    """Compute ``count`` steps of length ``h`` into the block; ``_GOOD``, ``_SHORTER`` or ``_LEAVE``."""
    c = s[S.C : S.C + C.SIZE]
    fac = s[S.FAC : S.FAST]
    load_block(s, w)
    turned = s[S.Y + Y.TH] - s[S.JACOBIAN_ANGLE]
    orbit = s[S.Y + Y.OM]
    size = 0.0
    for k in range(count):
        y = w[W.BLOCK_Y + k * Y.SIZE : W.BLOCK_Y + (k + 1) * Y.SIZE]
        new = w[W.BLOCK_Y + (k + 1) * Y.SIZE : W.BLOCK_Y + (k + 2) * Y.SIZE]
        a = w[W.BLOCK_NOW + k * F.SIZE : W.BLOCK_NOW + (k + 1) * F.SIZE]
        new_a = w[W.BLOCK_NOW + (k + 1) * F.SIZE : W.BLOCK_NOW + (k + 2) * F.SIZE]
        t = (k + 1) * h
        rate = s[S.SPEED_RATE]
        angle = s[S.ANGLE] + t * (s[S.SPEED] + 0.5 * t * rate)
        co = math.cos(turned + t * orbit)
        si = math.sin(turned + t * orbit)
        predict(y, a, h, new, new_a)
        turn_axes(p, s[S.AXES : S.JAC], s[S.Y : S.Y + Y.SIZE], int(p[P.LANES]), t, w)
        iterate(p, c, angle, s[S.SPEED] + t * rate, rate, h, beta_ball, fac, co, si, new, new_a, w)
        if k == count - 1:
            size = newton_size(p, c, w[W.D : W.D + F.SIZE], 0.5 * h)
            iterate(p, c, angle, s[S.SPEED] + t * rate, rate, h, beta_ball, fac, co, si, new, new_a, w)
    left = newton_size(p, c, w[W.D : W.D + F.SIZE], 0.5 * h)
    s[S.NEWTON] += count + 1.0
    if not (size < 1e3 and left < 1e3):
        return _LEAVE
    if left > _CONTRACTION * size and left > 1e-2 * tolerance:
        return _LEAVE
    if left > _LEFT * tolerance:
        return _SHORTER
    return _GOOD if method_error(p, h, beta_ball, count, w) <= tolerance else _SHORTER


@inlined
def commit_step(p, s, w, h, k):
    """Make step ``k`` of the block the state: true rates, sound samples, work and heat by the trapezoid."""
    here = W.BLOCK_NOW + (k + 1) * F.SIZE
    for i in range(F.SIZE):
        w[W.LAST + i] = w[here + i]
    true_rates(
        w[W.BLOCK_Y + (k + 1) * Y.SIZE : W.BLOCK_Y + (k + 2) * Y.SIZE], h, w[here : here + F.SIZE],
        w[here - F.SIZE : here], w[here - 2 * F.SIZE : here - F.SIZE], w[W.STAGE : W.STAGE + Y.SIZE],
    )  # fmt: skip
    # the block's angles run on while the state's are brought back into one turn after each step
    for j in range(Y.TH, Y.VX):
        w[W.STAGE + j] = s[S.Y + j] + wrap(w[W.STAGE + j] - s[S.Y + j])
    emit_samples(p, s, w, h)
    for i in range(F.POWERS):
        place = here + F.WORK + i
        s[S.WORK + i] += 0.5 * h * (w[place - F.SIZE] + w[place])


@kernel
def keep_block(s, w, count):
    """Take the end of the block over as the path's history."""
    last = W.BLOCK_NOW + count * F.SIZE
    for i in range(F.SIZE):
        s[S.FAST_A2 + i] = w[last - 2 * F.SIZE + i]
        s[S.FAST_A1 + i] = w[last - F.SIZE + i]
        s[S.FAST_A0 + i] = w[last + i]
    y = s[S.FAST_Y : S.FAST_A0]
    for i in range(Y.SIZE):
        y[i] = w[W.BLOCK_Y + count * Y.SIZE + i]
    wrap_angles(y)


@inlined
def fast_block(p, s, w, count, tolerance):
    """Advance by ``count`` steps (at most BLOCK) of the history's length; False if refused.

    A refusal leaves the state as it was. One with an old Jacobian is tried once more with a new one. Too
    large an error of the method asks for shorter steps at once; anything else for a pause.
    """
    verdict = _LEAVE
    h = s[S.FAST_LENGTH]
    for _ in range(2):
        if s[S.TIME] - s[S.JACOBIAN_TIME] > _OLDEST:
            renew_jacobian(p, s, w)
        fresh = s[S.JACOBIAN_TIME] == s[S.TIME]
        if s[S.FACTOR_STEP] != -h:
            beta = ball_beta(p, s, h)
            square = h * h
            if not factor(p, s[S.JAC : S.FAC], 0.5 * h, BETA * square, beta * square, s[S.FAC : S.FAST], w):
                break
            s[S.FACTOR_STEP] = -h
            s[S.FAST_BETA] = beta
        verdict = try_block(p, s, w, h, s[S.FAST_BETA], count, tolerance)
        if verdict == _GOOD or fresh:
            break
        s[S.JACOBIAN_TIME] = -1e300
    if verdict == _GOOD:
        for k in range(count):
            commit_step(p, s, w, h, k)
            accept(p, s, w, h)
        keep_block(s, w, count)
        if s[S.TIME] - s[S.FAST_HOLD] > _TRUSTED:
            s[S.FAST_PATIENCE] = _HOLDS[0]
            if s[S.FAST_STEP] < LONGEST:
                s[S.FAST_STEP] = min(1.5 * s[S.FAST_STEP], LONGEST)
                s[S.FAST_HOLD] = s[S.TIME]
        return True
    leave(s, verdict == _SHORTER and h >= 1.5 * SHORTEST, h)
    return False


@kernel
def fast_length(p, s, remaining):
    """Step (s) that the path would take towards a communication point ``remaining`` away; 0 if it rests."""
    if s[S.TIME] < s[S.FAST_HOLD]:
        return 0.0
    wanted = min(s[S.FAST_STEP], p[P.MAX_STEP])
    length = remaining / max(1.0, math.ceil(remaining / wanted - 1e-6))
    if ring_range(s) * length > _RANGE:
        return 0.0
    return length


@kernel
def fast_history(s, length):
    """Whether the history serves steps of this ``length`` (s)."""
    return s[S.FAST_COUNT] >= 2.0 and abs(length - s[S.FAST_LENGTH]) <= 1e-6 * length
