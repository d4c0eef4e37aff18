"""Motion samples for the sound filters, at a fixed rate, interpolated within the internal step."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    F_G,
    MO_BALLS,
    MO_CAGE,
    MO_INNER,
    MO_OUTER,
    MO_PER_BALL,
    P_AT_SOUND,
    P_BALLS,
    P_METERING_START,
    P_MODES,
    P_PITCH_RADIUS,
    P_SOUND_SIZE,
    P_TIME_WEIGHTING,
    Q_CAGE,
    Q_OUTER,
    S_F,
    S_SAMPLE,
    S_SOUND,
    S_SPEED,
    S_SPEED_RATE,
    S_START,
    S_TIME,
    S_Y,
    STRIDE,
    W_FLEX,
    W_LAST,
    W_MOTION,
    W_SOUND,
    W_Y,
    Y_V,
)
from fmu_bearing.engine.layout_flexure import (
    FW_A,
    FW_V,
)
from fmu_bearing.engine.layout_sound import RAW_RATE
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.sound.radiate import push

_S = STRIDE


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
    last = W_LAST + F_G
    for i in range(3):
        k = first + i
        v, a = hermite(s[S_Y + Y_V + k], s[S_F + F_G + k], w[W_Y + Y_V + k], w[last + k], h, t)
        w[at + i] = v
        w[at + 3 + i] = a
    w[at + 6] = spin
    w[at + 9] = spin_rate
    for i in range(2):
        k = tilt + i
        v, a = hermite(s[S_Y + Y_V + k], s[S_F + F_G + k], w[W_Y + Y_V + k], w[last + k], h, t)
        w[at + 7 + i] = v
        w[at + 10 + i] = a


@kernel
def ball_motion(p, s, w, h, t):
    """Inertial velocity, acceleration, spin and its rate of every ball, resolved in its orbiting axes."""
    last = W_LAST
    pitch = p[P_PITCH_RADIUS]
    for j in range(int(p[P_BALLS])):
        at = W_MOTION + MO_BALLS + MO_PER_BALL * j
        v0 = S_Y + 3 * _S + j
        v1 = W_Y + 3 * _S + j
        a0 = S_F + j
        a1 = last + j
        vx, ax = hermite(s[v0], s[a0], w[v1], w[a1], h, t)
        vr, ar = hermite(s[v0 + _S], s[a0 + _S], w[v1 + _S], w[a1 + _S], h, t)
        om, aom = hermite(s[v0 + 2 * _S], s[a0 + 2 * _S], w[v1 + 2 * _S], w[a1 + 2 * _S], h, t)
        wx, dwx = hermite(s[v0 + 3 * _S], s[a0 + 3 * _S], w[v1 + 3 * _S], w[a1 + 3 * _S], h, t)
        wr, dwr = hermite(s[v0 + 4 * _S], s[a0 + 4 * _S], w[v1 + 4 * _S], w[a1 + 4 * _S], h, t)
        wt, dwt = hermite(s[v0 + 5 * _S], s[a0 + 5 * _S], w[v1 + 5 * _S], w[a1 + 5 * _S], h, t)
        radius = pitch + s[S_Y + _S + j] + t * (w[W_Y + _S + j] - s[S_Y + _S + j])
        angle, _ = hermite(
            s[S_Y + 2 * _S + j], s[S_Y + 5 * _S + j], w[W_Y + 2 * _S + j], w[W_Y + 5 * _S + j], h, t
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
    count = 2 * int(p[P_MODES])
    at = W_MOTION + MO_BALLS + MO_PER_BALL * int(p[P_BALLS])
    old = flexure_state(p)
    new = W_FLEX
    v = new + FW_V
    a = new + FW_A
    for i in range(count):
        _, rate = hermite(s[old + count + i], s[old + 2 * count + i], w[v + i], w[a + i], h, t)
        w[at + i] = rate


@kernel
def emit_samples(p, s, w, h):
    """Push every sample that falls into the step just made (old state in ``s``, new one in ``w``)."""
    if p[P_SOUND_SIZE] == 0.0:
        return
    block = int(p[P_AT_SOUND])
    ps = p[block : block + int(p[P_SOUND_SIZE])]
    elapsed = s[S_TIME] - s[S_START]
    last = W_LAST
    while s[S_SAMPLE] <= (elapsed + h) * RAW_RATE:
        t = min(max((s[S_SAMPLE] / RAW_RATE - elapsed) / h, 0.0), 1.0)
        body_motion(
            s, w, 0, W_MOTION + MO_INNER, 3, s[S_SPEED] + t * h * s[S_SPEED_RATE], s[S_SPEED_RATE], h, t
        )
        k = Q_OUTER + 3
        spin, rate = hermite(s[S_Y + Y_V + k], s[S_F + F_G + k], w[W_Y + Y_V + k], w[last + F_G + k], h, t)
        body_motion(s, w, Q_OUTER, W_MOTION + MO_OUTER, k + 1, spin, rate, h, t)
        k = Q_CAGE + 3
        spin, rate = hermite(s[S_Y + Y_V + k], s[S_F + F_G + k], w[W_Y + Y_V + k], w[last + F_G + k], h, t)
        body_motion(s, w, Q_CAGE, W_MOTION + MO_CAGE, k + 1, spin, rate, h, t)
        ball_motion(p, s, w, h, t)
        flexure_motion(p, s, w, h, t)
        push(ps, s[S_SOUND:], w[W_SOUND:], w[W_MOTION:W_SOUND], p[P_TIME_WEIGHTING], p[P_METERING_START])
        s[S_SAMPLE] += 1.0
