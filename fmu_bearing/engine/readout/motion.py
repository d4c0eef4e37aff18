"""Motion samples for the sound filters, at a fixed rate, interpolated within the internal step."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FL, MO, SD, F, P, Q, S, W, Y
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.sound.radiate import push


@kernel
def hermite(v0, a0, v1, a1, h, t):
    """Value and derivative at ``t`` in [0, 1] of the cubic through values and rates at both ends."""
    d = v1 - v0
    b0 = h * a0
    b1 = h * a1
    c2 = 3.0 * d - 2.0 * b0 - b1
    c3 = b0 + b1 - 2.0 * d
    value = v0 + t * (b0 + t * (c2 + t * c3))
    rate = (b0 + t * (2.0 * c2 + t * 3.0 * c3)) / h
    return value, rate


@kernel
def body_motion(s, w, first, at, tilt, spin, spin_rate, h, t):
    """Velocity, acceleration, angular velocity and acceleration of one body into ``w[at:]``.

    ``first``: its coordinates; ``tilt``: its tilt coordinates. The spin is taken about X: tilts are small.
    """
    last = W.LAST + F.BODY
    for i in range(3):
        k = first + i
        v, a = hermite(s[S.Y + Y.V0 + k], s[S.F + F.BODY + k], w[W.STAGE + Y.V0 + k], w[last + k], h, t)
        w[at + i] = v
        w[at + 3 + i] = a
    w[at + 6] = spin
    w[at + 9] = spin_rate
    for i in range(2):
        k = tilt + i
        v, a = hermite(s[S.Y + Y.V0 + k], s[S.F + F.BODY + k], w[W.STAGE + Y.V0 + k], w[last + k], h, t)
        w[at + 7 + i] = v
        w[at + 10 + i] = a


@kernel
def ball_motion(p, s, w, h, t):
    """Inertial velocity, acceleration, spin and its rate of every ball, resolved in its orbiting axes."""
    last = W.LAST
    pitch = p[P.PITCH_RADIUS]
    for j in range(int(p[P.BALLS])):
        at = W.MOTION + MO.BALLS + MO.PER_BALL * j
        v0 = S.Y + 3 * STRIDE + j
        v1 = W.STAGE + 3 * STRIDE + j
        a0 = S.F + j
        a1 = last + j
        vx, ax = hermite(s[v0], s[a0], w[v1], w[a1], h, t)
        vr, ar = hermite(s[v0 + STRIDE], s[a0 + STRIDE], w[v1 + STRIDE], w[a1 + STRIDE], h, t)
        om, aom = hermite(
            s[v0 + 2 * STRIDE], s[a0 + 2 * STRIDE], w[v1 + 2 * STRIDE], w[a1 + 2 * STRIDE], h, t
        )
        wx, dwx = hermite(
            s[v0 + 3 * STRIDE], s[a0 + 3 * STRIDE], w[v1 + 3 * STRIDE], w[a1 + 3 * STRIDE], h, t
        )
        wr, dwr = hermite(
            s[v0 + 4 * STRIDE], s[a0 + 4 * STRIDE], w[v1 + 4 * STRIDE], w[a1 + 4 * STRIDE], h, t
        )
        wt, dwt = hermite(
            s[v0 + 5 * STRIDE], s[a0 + 5 * STRIDE], w[v1 + 5 * STRIDE], w[a1 + 5 * STRIDE], h, t
        )
        radius = pitch + s[S.Y + STRIDE + j] + t * (w[W.STAGE + STRIDE + j] - s[S.Y + STRIDE + j])
        angle, _ = hermite(
            s[S.Y + 2 * STRIDE + j],
            s[S.Y + 5 * STRIDE + j],
            w[W.STAGE + 2 * STRIDE + j],
            w[W.STAGE + 5 * STRIDE + j],
            h,
            t,
        )
        w[at] = vx
        w[at + 1] = vr
        w[at + 2] = radius * om
        w[at + 3] = ax
        w[at + 4] = ar - radius * om * om
        w[at + 5] = radius * aom + 2.0 * vr * om
        w[at + 6] = wx
        w[at + 7] = wr
        w[at + 8] = wt
        w[at + 9] = dwx
        w[at + 10] = dwr - om * wt
        w[at + 11] = dwt + om * wr
        w[at + 12] = math.cos(angle)
        w[at + 13] = math.sin(angle)


@kernel
def flexure_motion(p, s, w, h, t):
    """Second time derivatives of the flexural coordinates, behind the balls."""
    count = 2 * int(p[P.MODES])
    at = W.MOTION + MO.BALLS + MO.PER_BALL * int(p[P.BALLS])
    old = flexure_state(p)
    new = W.FLEX
    v = new + FL.V
    a = new + FL.A
    for i in range(count):
        _, rate = hermite(s[old + count + i], s[old + 2 * count + i], w[v + i], w[a + i], h, t)
        w[at + i] = rate


@kernel
def emit_samples(p, s, w, h):
    """Push every sample that falls into the step just made (old state in ``s``, new one in ``w``)."""
    if p[P.SOUND_SIZE] == 0.0:
        return
    block = int(p[P.AT_SOUND])
    ps = p[block : block + int(p[P.SOUND_SIZE])]
    elapsed = s[S.TIME] - s[S.START]
    last = W.LAST
    while s[S.SAMPLE] <= (elapsed + h) * SD.RAW_RATE:
        t = min(max((s[S.SAMPLE] / SD.RAW_RATE - elapsed) / h, 0.0), 1.0)
        body_motion(
            s, w, 0, W.MOTION + MO.INNER, 3, s[S.SPEED] + t * h * s[S.SPEED_RATE], s[S.SPEED_RATE], h, t
        )
        k = Q.OUTER + 3
        spin, rate = hermite(
            s[S.Y + Y.V0 + k], s[S.F + F.BODY + k], w[W.STAGE + Y.V0 + k], w[last + F.BODY + k], h, t
        )
        body_motion(s, w, Q.OUTER, W.MOTION + MO.OUTER, k + 1, spin, rate, h, t)
        k = Q.CAGE + 3
        spin, rate = hermite(
            s[S.Y + Y.V0 + k], s[S.F + F.BODY + k], w[W.STAGE + Y.V0 + k], w[last + F.BODY + k], h, t
        )
        body_motion(s, w, Q.CAGE, W.MOTION + MO.CAGE, k + 1, spin, rate, h, t)
        ball_motion(p, s, w, h, t)
        flexure_motion(p, s, w, h, t)
        push(ps, s[S.SOUND :], w[W.SOUND :], w[W.MOTION : W.SOUND], p[P.TIME_WEIGHTING], p[P.METERING_START])
        s[S.SAMPLE] += 1.0
