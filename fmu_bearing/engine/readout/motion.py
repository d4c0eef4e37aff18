"""Motion samples for the sound filters, at a fixed rate, interpolated within the internal step."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FL, MO, SD, F, P, Q, S, W, Y
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
def during(s, w, value, rate, h, t):
    """Value and derivative of one number of the mechanics at the share ``t`` of the step ``h`` (s).

    ``value``: its place in ``y``; ``rate``: that of its derivative in ``f``.
    """
    return hermite(s[S.Y + value], s[S.F + rate], w[W.STAGE + value], w[W.LAST + rate], h, t)


@kernel
def body_motion(s, w, first, at, tilt, spin, spin_rate, h, t):
    """Velocity, acceleration, angular velocity and acceleration of one body into ``w[at:]``.

    ``first``: its coordinates; ``tilt``: its tilt coordinates. The spin is taken about X: tilts are small.
    """
    for i in range(3):
        v, a = during(s, w, Y.V0 + first + i, F.BODY + first + i, h, t)
        w[at + MO.VELOCITY + i] = v
        w[at + MO.ACCELERATION + i] = a
    w[at + MO.SPIN] = spin
    w[at + MO.SPIN_RATE] = spin_rate
    for i in range(2):
        v, a = during(s, w, Y.V0 + tilt + i, F.BODY + tilt + i, h, t)
        w[at + MO.SPIN + 1 + i] = v
        w[at + MO.SPIN_RATE + 1 + i] = a


@kernel
def turning_body(s, w, first, at, h, t):
    """As `body_motion` for a body whose rotation about X is a coordinate: outer ring and cage."""
    turn = first + Q.TURN
    spin, rate = during(s, w, Y.V0 + turn, F.BODY + turn, h, t)
    body_motion(s, w, first, at, first + Q.BY, spin, rate, h, t)


@kernel
def ball_motion(p, s, w, h, t):
    """Inertial velocity, acceleration, spin and its rate of every ball, resolved in its orbiting axes."""
    pitch = p[P.PITCH_RADIUS]
    for j in range(int(p[P.BALLS])):
        at = W.MOTION + MO.BALLS + MO.PER_BALL * j
        vx, ax = during(s, w, Y.VX + j, F.X + j, h, t)
        vr, ar = during(s, w, Y.VR + j, F.R + j, h, t)
        om, aom = during(s, w, Y.OM + j, F.TH + j, h, t)
        wx, dwx = during(s, w, Y.WX + j, F.WX + j, h, t)
        wr, dwr = during(s, w, Y.WR + j, F.WR + j, h, t)
        wt, dwt = during(s, w, Y.WT + j, F.WT + j, h, t)
        old = s[S.Y + Y.R + j]
        radius = pitch + old + t * (w[W.STAGE + Y.R + j] - old)
        th = Y.TH + j
        rate = Y.OM + j
        angle, _ = hermite(s[S.Y + th], s[S.Y + rate], w[W.STAGE + th], w[W.STAGE + rate], h, t)
        to = at + MO.VELOCITY
        w[to] = vx
        w[to + 1] = vr
        w[to + 2] = radius * om
        to = at + MO.ACCELERATION
        w[to] = ax
        w[to + 1] = ar - radius * om * om
        w[to + 2] = radius * aom + 2.0 * vr * om
        to = at + MO.SPIN
        w[to] = wx
        w[to + 1] = wr
        w[to + 2] = wt
        to = at + MO.SPIN_RATE
        w[to] = dwx
        w[to + 1] = dwr - om * wt
        w[to + 2] = dwt + om * wr
        w[at + MO.COS] = math.cos(angle)
        w[at + MO.SIN] = math.sin(angle)


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
    while s[S.SAMPLE] <= (elapsed + h) * SD.RAW_RATE:
        t = min(max((s[S.SAMPLE] / SD.RAW_RATE - elapsed) / h, 0.0), 1.0)
        spin = s[S.SPEED] + t * h * s[S.SPEED_RATE]
        body_motion(s, w, Q.INNER, W.MOTION + MO.INNER, Q.INNER_BY, spin, s[S.SPEED_RATE], h, t)
        turning_body(s, w, Q.OUTER, W.MOTION + MO.OUTER, h, t)
        turning_body(s, w, Q.CAGE, W.MOTION + MO.CAGE, h, t)
        ball_motion(p, s, w, h, t)
        flexure_motion(p, s, w, h, t)
        push(ps, s[S.SOUND :], w[W.SOUND :], w[W.MOTION : W.SOUND], p[P.TIME_WEIGHTING], p[P.METERING_START])
        s[S.SAMPLE] += 1.0
