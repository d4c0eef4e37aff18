"""Waviness that turns with the ball: height of the ball's surface at its contacts, and what it does there.

A ball carries a body-fixed unit axis a. Its surface stands h(e) = sum of A_n P_n(e . a) above the sphere in
the direction e (zonal harmonics, Legendre polynomials). With e from the ball into the race the approach
gains h, and with G the gradient of h the contact pushes along the gradient of the whole approach:

    d h / dt = h' (cos a_c (a.t)/rho t + (a.m)/l m) . dv + h' (a x e) . dw

dv, dw: velocity of the ball's centre against the race's material there and relative spin; rho: distance of
the ball's centre from the ring's axis; l: from the groove's centre. The moving contact direction thus gives
a lateral force (1/l is some ten times 1/radius of the ball) and the tilted surface a moment about the
ball's centre. Force and moment act on the race with the opposite sign at the same point, so energy closes.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, C, P, R, W, X, Y


@kernel
def zonal(p, first, orders, x):
    """Height and its derivative by ``x`` (m) of the zonal harmonics ``p[first:]`` of orders 1, 2, ... at x.

    Bonnet's recurrence; derivatives by P'_(n+1) = P'_(n-1) + (2n + 1) P_n, which has no pole at the axis.
    """
    before = 1.0
    here = x
    slope_before = 0.0
    slope = 1.0
    height = p[first] * here
    rise = p[first]
    for n in range(1, orders):
        after = ((2.0 * n + 1.0) * x * here - n * before) / (n + 1.0)
        slope_after = slope_before + (2.0 * n + 1.0) * here
        before = here
        here = after
        slope_before = slope
        slope = slope_after
        height += p[first + n] * here
        rise += p[first + n] * slope
    return height, rise


@kernel
def groove_distance(c, race, pose, w, j):
    """Distance (m) of ball ``j``'s centre from the circle of groove centres of ``race``."""
    held = C.RACES + race * C.RACE_SIZE
    sx = w[pose + X.A + j] - c[held + C.GROOVE_X]
    sr = w[pose + X.RHO + j] - c[held + C.GROOVE_RADIUS]
    return math.sqrt(sx * sx + sr * sr)


@kernel
def add_ball_waves(p, c, lanes, race, w):
    """Put the balls' waviness into approach, its rate, load and ellipse that ``race.normal`` left.

    Reads the axes in the rows ``W.AXES``; leaves the slope towards e_t and e_m for
    :func:`ball_wave_forces`.
    """
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    first = int(p[P.AT_BALL_WAVES])
    orders = int(p[P.BALL_WAVES])
    scale = c[C.OVERSIZE_SCALE]
    hertz = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
    half = p[P.RACES + race * P.RACE_SIZE + P.RACE_HALF_LENGTH]
    damping = 1.5 * p[P.CONTACT_DAMPING]
    for j in range(lanes):
        along = 0.0
        across = 0.0
        outward = 0.0
        speed_t = 0.0
        speed_m = 0.0
        for i in range(3):
            a = w[W.AXES + i * STRIDE + j]
            m = w[row + R.EM + i * STRIDE + j]
            t = w[pose + X.T + i * STRIDE + j]
            dv = w[pose + X.DV + i * STRIDE + j]
            outward += a * w[row + R.EN + i * STRIDE + j]
            along += a * t
            across += a * m
            speed_t += dv * t
            speed_m += dv * m
        height, rise = zonal(p, first, orders, outward)
        bump_t = scale * rise * along
        bump_m = scale * rise * across
        approach = w[row + R.APPROACH + j] + scale * height
        rate = w[row + R.RATE + j]
        rate += bump_t * w[row + R.COSA + j] / w[pose + X.RHO + j] * speed_t
        rate += bump_m / groove_distance(c, race, pose, w, j) * speed_m
        rate += bump_m * w[row + R.AT + j] - bump_t * w[row + R.AM + j]
        pressed = max(approach, 0.0)
        root = math.sqrt(pressed)
        elastic = hertz * root * pressed
        w[row + R.BUMP_T + j] = bump_t
        w[row + R.BUMP_M + j] = bump_m
        w[row + R.APPROACH + j] = approach
        w[row + R.RATE + j] = rate
        w[row + R.ELASTIC + j] = elastic
        w[row + R.LOAD + j] = max(elastic + hertz * root * damping * rate, 0.0)
        w[row + R.HALF + j] = half * root


@kernel
def ball_wave_forces(p, c, lanes, race, w):
    """Add lateral force and moment of the wavy balls to what ``race.collect`` gathered, loss included."""
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    out = W.FORCE + race * W.FORCE_SIZE
    balls = int(p[P.BALLS])
    for j in range(lanes):
        load = w[row + R.LOAD + j]
        bump_t = w[row + R.BUMP_T + j]
        bump_m = w[row + R.BUMP_M + j]
        force_t = -load * bump_t * w[row + R.COSA + j] / w[pose + X.RHO + j]
        force_m = -load * bump_m / groove_distance(c, race, pose, w, j)
        power = 0.0
        for i in range(3):
            m = w[row + R.EM + i * STRIDE + j]
            t = w[pose + X.T + i * STRIDE + j]
            force = force_t * t + force_m * m
            moment = load * (bump_t * m - bump_m * t)
            w[out + W.FX + i * STRIDE + j] += force
            w[out + W.MX + i * STRIDE + j] += moment
            power += force * w[pose + X.DV + i * STRIDE + j] + moment * w[pose + X.DW + i * STRIDE + j]
        w[W.LOSS + race * STRIDE + j] -= power if j < balls else 0.0


@kernel
def turn_vector(ax, ay, az, wx, wy, wz, t):
    """Vector (ax, ay, az) turned at the rate w (rad/s) for ``t`` (s), then of unit length; Rodrigues."""
    rate2 = wx * wx + wy * wy + wz * wz
    turn2 = rate2 * t * t
    turn = math.sqrt(turn2)
    if turn < 1e-4:
        # series to turn^3 of sin x / x and (1 - cos x) / x^2
        s = t * (1.0 - turn2 / 6.0)
        v = t * t * (0.5 - turn2 / 24.0)
        c = 1.0 - turn2 * (0.5 - turn2 / 24.0)
    else:
        rate = math.sqrt(rate2)
        c = math.cos(turn)
        s = math.copysign(math.sin(turn), t) / rate
        v = (1.0 - c) / rate2
    along = v * (wx * ax + wy * ay + wz * az)
    bx = c * ax + s * (wy * az - wz * ay) + along * wx
    by = c * ay + s * (wz * ax - wx * az) + along * wy
    bz = c * az + s * (wx * ay - wy * ax) + along * wz
    unit = 1.0 / math.sqrt(bx * bx + by * by + bz * bz)
    return bx * unit, by * unit, bz * unit


@kernel
def turn_axes(p, axes, y, lanes, t, w):
    """Rows ``W.AXES``: the axes (3 rows, orbiting axes) turned with the spin in ``y`` for the time ``t`` (s).

    In the orbiting axes a' = (w - theta' e_x) x a. Exact while that spin is constant, as it nearly is in
    rolling; else the direction is off by t^2/2 of the spin's rate, 5e-6 rad for 10 us at 1e5 rad/s2.
    Without ball waviness nothing is done.
    """
    if p[P.BALL_WAVES] == 0.0:
        return
    for j in range(lanes):
        ax, ar, at = turn_vector(
            axes[j],
            axes[STRIDE + j],
            axes[2 * STRIDE + j],
            y[Y.WX + j] - y[Y.OM + j],
            y[Y.WR + j],
            y[Y.WT + j],
            t,
        )
        w[W.AXES + j] = ax
        w[W.AXES + STRIDE + j] = ar
        w[W.AXES + 2 * STRIDE + j] = at


@kernel
def advance_axes(p, axes, y0, y1, lanes, h):
    """Turn ``axes`` in place over an accepted step of ``h`` (s) with the mean of its first and last spin.

    Second order: the local error is h^3/12 of (the spin's second rate + spin x its rate).
    """
    if p[P.BALL_WAVES] == 0.0:
        return
    for j in range(lanes):
        ax, ar, at = turn_vector(
            axes[j],
            axes[STRIDE + j],
            axes[2 * STRIDE + j],
            0.5 * (y0[Y.WX + j] - y0[Y.OM + j] + y1[Y.WX + j] - y1[Y.OM + j]),
            0.5 * (y0[Y.WR + j] + y1[Y.WR + j]),
            0.5 * (y0[Y.WT + j] + y1[Y.WT + j]),
            h,
        )
        axes[j] = ax
        axes[STRIDE + j] = ar
        axes[2 * STRIDE + j] = at


@kernel
def first_axes(p, axes):
    """Axes at the start, from the table behind the amplitudes; spare lanes copy ball 0 there already."""
    if p[P.BALL_WAVES] == 0.0:
        return
    table = int(p[P.AT_BALL_WAVES]) + int(p[P.BALL_WAVES])
    for i in range(3 * STRIDE):
        axes[i] = p[table + i]
