"""From a level's own state to the one that outputs and sound read."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_TH,
    B_VR,
    B_VX,
    B_WX,
    B_X,
    F_G,
    F_HEAT,
    F_TORQUE,
    F_WORK,
    P_BALLS,
    P_CAGE,
    P_LANES,
    P_PITCH_RADIUS,
    PI,
    Q_CAGE,
    STRIDE,
    Y_Q,
    Y_V,
)
from fmu_bearing.engine.layout_condensed import (
    L_A,
    L_A1,
    L_A2,
    L_FOUND_SPEED,
    L_HEAT,
    L_JERK,
    L_KNOWN,
    L_Q,
    L_R,
    L_R1,
    L_R2,
    L_RATIO,
    L_SETTLED,
    L_SPACING,
    L_SPIN,
    L_THETA,
    L_TORQUE,
    L_V,
    L_X,
    L_X1,
    L_X2,
    N,
)
from fmu_bearing.engine.mechanics.trigonometry import wrap

_S = STRIDE
# What a ball in its races can do: its place varies by 0.3 mm per radian of turning at most (ten times what a
# load of 3 kN does), and follows the rings by at most ten times their velocity.
_PER_RADIAN = 3e-4
_PER_RING = 10.0


@kernel
def rate_error(lv, i):
    """By how much Newmark's velocity exceeds the true one: h^2/12 times the rate of acceleration (m/s)."""
    h = lv[L_SPACING]
    if lv[L_KNOWN] >= 2.0:
        return h / 24.0 * (3.0 * lv[L_A + i] - 4.0 * lv[L_A1 + i] + lv[L_A2 + i])
    return h * h / 12.0 * lv[L_JERK + i]


@kernel
def publish_rings(lv, newmark, y, f):
    """Displacements, velocities and accelerations of the rings; ``newmark``: velocities are Newmark's."""
    for i in range(N):
        y[Y_Q + i] = lv[L_Q + i]
        y[Y_V + i] = lv[L_V + i] - (rate_error(lv, i) if newmark else 0.0)
        f[F_G + i] = lv[L_A + i]


@kernel
def publish_cage(p, lv, speed, speed_rate, y, f):
    """Turn the cage with the balls about the place it had at the start."""
    k = Q_CAGE + 3
    y[Y_Q + k] = wrap(lv[L_THETA])
    y[Y_V + k] = lv[L_RATIO] * speed if p[P_CAGE] != 0.0 else 0.0
    f[F_G + k] = lv[L_RATIO] * speed_rate if p[P_CAGE] != 0.0 else 0.0


@kernel
def fastest_ball(p, speed, y):
    """Bound (m/s) on what differences of the balls' places may show: see above."""
    most = 0.0
    for i in range(N):
        tilt = i == 3 or i == 4 or i >= 8
        most = max(most, abs(y[Y_V + i]) * (p[P_PITCH_RADIUS] if tilt else 1.0))
    return _PER_RADIAN * abs(speed) + _PER_RING * most


@kernel
def publish_balls(p, lv, speed, speed_rate, y, f):
    """Places, rates and spins of the balls; rates of x and r by backward differences over the last steps.

    A ball that carries nothing has no place of its own to have a rate: zero there, and where the difference
    is more than a ball can do.
    """
    h = lv[L_SPACING]
    known = lv[L_KNOWN]
    # weights of the places now, one and two steps before, in velocity and acceleration
    v0 = 0.0
    v1 = 0.0
    v2 = 0.0
    per2 = 0.0
    if known >= 2.0:
        v0 = 1.5 / h
        v1 = -2.0 / h
        v2 = 0.5 / h
        per2 = 1.0 / (h * h)
    elif known == 1.0:
        v0 = 1.0 / h
        v1 = -1.0 / h
    orbit = lv[L_RATIO] * speed
    limit = fastest_ball(p, speed, y)
    needed = min(known, 2.0) + 1.0
    balls = p[P_BALLS]
    for j in range(int(p[P_LANES])):
        place = j if j < balls else 0
        x = lv[L_X + j]
        r = lv[L_R + j]
        x1 = lv[L_X1 + j]
        r1 = lv[L_R1 + j]
        x2 = lv[L_X2 + j]
        r2 = lv[L_R2 + j]
        y[B_X * _S + j] = x
        y[B_R * _S + j] = r
        y[B_TH * _S + j] = wrap(lv[L_THETA] + 2.0 * PI * place / balls)
        vx = v0 * x + v1 * x1 + v2 * x2
        vr = v0 * r + v1 * r1 + v2 * r2
        told = 1.0 if lv[L_SETTLED + j] >= needed and max(abs(vx), abs(vr)) <= limit else 0.0
        y[B_VX * _S + j] = told * vx
        y[B_VR * _S + j] = told * vr
        y[B_OM * _S + j] = orbit
        f[j] = told * per2 * (x - 2.0 * x1 + x2)
        f[_S + j] = told * per2 * (r - 2.0 * r1 + r2)
        f[2 * _S + j] = lv[L_RATIO] * speed_rate
        for i in range(3):
            y[(B_WX + i) * _S + j] = lv[L_SPIN + i * _S + j] * speed
            f[(3 + i) * _S + j] = lv[L_SPIN + i * _S + j] * speed_rate


@kernel
def publish_losses(lv, speed, f):
    """Heats held from the quasi-static point, and the torque that puts them in at ``speed``."""
    f[F_WORK] = lv[L_HEAT] + lv[L_HEAT + 1] + lv[L_HEAT + 2]
    found = lv[L_FOUND_SPEED]
    # in a ramp from far below, the speed that the heats belong to is still to come
    near = found != 0.0 and speed * found > 0.5 * found * found
    f[F_TORQUE] = f[F_WORK] / speed if near else lv[L_TORQUE]
    for i in range(3):
        f[F_HEAT + i] = lv[L_HEAT + i]


@kernel
def publish(p, lv, speed, speed_rate, newmark, y, f):
    """Write the whole state ``y`` and its right-hand side ``f`` (layout of level full)."""
    publish_rings(lv, newmark, y, f)
    publish_cage(p, lv, speed, speed_rate, y, f)
    publish_balls(p, lv, speed, speed_rate, y, f)
    publish_losses(lv, speed, f)
