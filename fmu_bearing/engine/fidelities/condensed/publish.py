"""From the rings' own state to the one that outputs and sound are made of."""

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, F, H, L, P, Q, Y
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.newton.jacobian import is_angle

# What a ball in its races can do: its place varies by 0.3 mm per radian of turning at most (ten times what a
# load of 3 kN does), and follows the rings by at most ten times their velocity.
_PER_RADIAN = 3e-4
_PER_RING = 10.0


@kernel
def rate_error(x, numbers, vectors, lanes, i):
    """By how much Newmark's velocity exceeds the true one: h^2/12 times the rate of acceleration (m/s).

    ``numbers``, ``vectors``: places in ``x`` of what the march keeps, see ``layout.history``; ``lanes``: from
    one vector to the next.
    """
    h = x[numbers + H.SPACING]
    at = vectors + i
    if x[numbers + H.KNOWN] >= 2.0:
        now = x[at + H.A0 * lanes]
        return h / 24.0 * (3.0 * now - 4.0 * x[at + H.A1 * lanes] + x[at + H.A2 * lanes])
    return h * h / 12.0 * x[at + H.JERK * lanes]


@kernel
def publish_rings(lv, newmark, y, f):
    """Displacements, velocities and accelerations of the rings; ``newmark``: velocities are Newmark's."""
    for i in range(L.N):
        y[Y.Q0 + i] = lv[L.Q0 + i]
        error = rate_error(lv, L.MARCH, L.MOVING, L.COLUMN, i) if newmark else 0.0
        y[Y.V0 + i] = lv[L.V0 + i] - error
        f[F.BODY + i] = lv[L.A0 + i]


@kernel
def publish_cage(p, lv, speed, speed_rate, y, f):
    """Turn the cage with the balls about the place it had at the start."""
    k = Q.CAGE + Q.TURN
    y[Y.Q0 + k] = wrap(lv[L.THETA])
    y[Y.V0 + k] = lv[L.RATIO] * speed if p[P.CAGE] != 0.0 else 0.0
    f[F.BODY + k] = lv[L.RATIO] * speed_rate if p[P.CAGE] != 0.0 else 0.0


@kernel
def fastest_ball(p, speed, y):
    """Bound (m/s) on what differences of the balls' places may show: see above."""
    most = 0.0
    for i in range(L.N):
        most = max(most, abs(y[Y.V0 + i]) * (p[P.PITCH_RADIUS] if is_angle(i) else 1.0))
    return _PER_RADIAN * abs(speed) + _PER_RING * most


@kernel
def publish_balls(p, lv, speed, speed_rate, y, f):
    """Places, rates and spins of the balls; rates of x and r by backward differences over the last steps.

    A ball that carries nothing has no place of its own to have a rate: zero there, and where the difference
    is more than a ball can do.
    """
    h = lv[L.SPACING]
    known = lv[L.KNOWN]
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
    orbit = lv[L.RATIO] * speed
    limit = fastest_ball(p, speed, y)
    needed = min(known, 2.0) + 1.0
    balls = p[P.BALLS]
    for j in range(int(p[P.LANES])):
        place = j if j < balls else 0
        x = lv[L.X + j]
        r = lv[L.R + j]
        x1 = lv[L.X1 + j]
        r1 = lv[L.R1 + j]
        x2 = lv[L.X2 + j]
        r2 = lv[L.R2 + j]
        y[Y.X + j] = x
        y[Y.R + j] = r
        y[Y.TH + j] = wrap(lv[L.THETA] + 2.0 * PI * place / balls)
        vx = v0 * x + v1 * x1 + v2 * x2
        vr = v0 * r + v1 * r1 + v2 * r2
        told = 1.0 if lv[L.SETTLED + j] >= needed and max(abs(vx), abs(vr)) <= limit else 0.0
        y[Y.VX + j] = told * vx
        y[Y.VR + j] = told * vr
        y[Y.OM + j] = orbit
        f[F.X + j] = told * per2 * (x - 2.0 * x1 + x2)
        f[F.R + j] = told * per2 * (r - 2.0 * r1 + r2)
        f[F.TH + j] = lv[L.RATIO] * speed_rate
        for i in range(3):
            y[Y.WX + i * STRIDE + j] = lv[L.SPIN + i * STRIDE + j] * speed
            f[F.WX + i * STRIDE + j] = lv[L.SPIN + i * STRIDE + j] * speed_rate


@kernel
def held_heat(lv):
    """Sum (W) of the heats held from the operating point."""
    return lv[L.HEAT] + lv[L.HEAT_OUTER] + lv[L.HEAT_OIL]


@kernel
def held_torque(lv, speed):
    """Torque (N m) that puts in the heats held from the operating point at ``speed`` (rad/s)."""
    found = lv[L.FOUND_SPEED]
    # in a ramp from far below, the speed that the heats belong to is still to come
    near = found != 0.0 and speed * found > 0.5 * found * found
    return held_heat(lv) / speed if near else lv[L.TORQUE]


@kernel
def publish_losses(lv, speed, f):
    """Heats held from the operating point, and the torque that puts them in at ``speed``."""
    f[F.WORK] = held_heat(lv)
    f[F.TORQUE] = held_torque(lv, speed)
    for i in range(3):
        f[F.HEAT + i] = lv[L.HEAT + i]


@kernel
def publish(p, lv, speed, speed_rate, newmark, y, f):
    """Write the whole state ``y`` and its right-hand side ``f`` (of fidelity full: see the layout)."""
    publish_rings(lv, newmark, y, f)
    publish_cage(p, lv, speed, speed_rate, y, f)
    publish_balls(p, lv, speed, speed_rate, y, f)
    publish_losses(lv, speed, f)
