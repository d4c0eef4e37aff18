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
from fmu_bearing.engine.layout import (
    B_OM,
    B_WR,
    B_WT,
    B_WX,
    C_OVERSIZE_SCALE,
    C_RACE_SIZE,
    C_RACES,
    P_AT_BALL_WAVES,
    P_BALL_WAVES,
    P_BALLS,
    P_CONTACT_DAMPING,
    P_RACES,
    POSE_ROWS,
    R_AM,
    R_APPROACH,
    R_AT,
    R_BUMP_M,
    R_BUMP_T,
    R_COSA,
    R_ELASTIC,
    R_EM,
    R_EN,
    R_HALF,
    R_LOAD,
    R_RATE,
    RACE_HALF_LENGTH,
    RACE_ROWS,
    RACE_SIZE,
    RACE_STIFFNESS,
    STRIDE,
    W_AXES,
    W_FORCE,
    W_LOSS,
    W_POSE,
    W_RACE,
    X_A,
    X_DV,
    X_DW,
    X_RHO,
    X_T,
)

_S = STRIDE


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
    sx = w[pose + X_A * _S + j] - c[C_RACES + race * C_RACE_SIZE]
    sr = w[pose + X_RHO * _S + j] - c[C_RACES + race * C_RACE_SIZE + 1]
    return math.sqrt(sx * sx + sr * sr)


@kernel
def add_ball_waves(p, c, lanes, race, w):
    """Put the balls' waviness into approach, its rate, load and ellipse that ``race.normal`` left.

    Reads the axes in the rows ``W_AXES``; leaves the slope towards e_t and e_m for
    :func:`ball_wave_forces`.
    """
    row = (W_RACE + race * RACE_ROWS) * _S
    pose = (W_POSE + race * POSE_ROWS) * _S
    axes = W_AXES * _S
    first = int(p[P_AT_BALL_WAVES])
    orders = int(p[P_BALL_WAVES])
    scale = c[C_OVERSIZE_SCALE]
    hertz = p[P_RACES + race * RACE_SIZE + RACE_STIFFNESS]
    half = p[P_RACES + race * RACE_SIZE + RACE_HALF_LENGTH]
    damping = 1.5 * p[P_CONTACT_DAMPING]
    for j in range(lanes):
        along = 0.0
        across = 0.0
        outward = 0.0
        speed_t = 0.0
        speed_m = 0.0
        for i in range(3):
            a = w[axes + i * _S + j]
            m = w[row + (R_EM + i) * _S + j]
            t = w[pose + (X_T + i) * _S + j]
            dv = w[pose + (X_DV + i) * _S + j]
            outward += a * w[row + (R_EN + i) * _S + j]
            along += a * t
            across += a * m
            speed_t += dv * t
            speed_m += dv * m
        height, rise = zonal(p, first, orders, outward)
        bump_t = scale * rise * along
        bump_m = scale * rise * across
        approach = w[row + R_APPROACH * _S + j] + scale * height
        rate = w[row + R_RATE * _S + j]
        rate += bump_t * w[row + R_COSA * _S + j] / w[pose + X_RHO * _S + j] * speed_t
        rate += bump_m / groove_distance(c, race, pose, w, j) * speed_m
        rate += bump_m * w[row + R_AT * _S + j] - bump_t * w[row + R_AM * _S + j]
        pressed = max(approach, 0.0)
        root = math.sqrt(pressed)
        elastic = hertz * root * pressed
        w[row + R_BUMP_T * _S + j] = bump_t
        w[row + R_BUMP_M * _S + j] = bump_m
        w[row + R_APPROACH * _S + j] = approach
        w[row + R_RATE * _S + j] = rate
        w[row + R_ELASTIC * _S + j] = elastic
        w[row + R_LOAD * _S + j] = max(elastic + hertz * root * damping * rate, 0.0)
        w[row + R_HALF * _S + j] = half * root


@kernel
def ball_wave_forces(p, c, lanes, race, w):
    """Add lateral force and moment of the wavy balls to what ``race.collect`` gathered, loss included."""
    row = (W_RACE + race * RACE_ROWS) * _S
    pose = (W_POSE + race * POSE_ROWS) * _S
    out = (W_FORCE + race * 6) * _S
    balls = int(p[P_BALLS])
    for j in range(lanes):
        load = w[row + R_LOAD * _S + j]
        bump_t = w[row + R_BUMP_T * _S + j]
        bump_m = w[row + R_BUMP_M * _S + j]
        force_t = -load * bump_t * w[row + R_COSA * _S + j] / w[pose + X_RHO * _S + j]
        force_m = -load * bump_m / groove_distance(c, race, pose, w, j)
        power = 0.0
        for i in range(3):
            m = w[row + (R_EM + i) * _S + j]
            t = w[pose + (X_T + i) * _S + j]
            force = force_t * t + force_m * m
            moment = load * (bump_t * m - bump_m * t)
            w[out + i * _S + j] += force
            w[out + (3 + i) * _S + j] += moment
            power += force * w[pose + (X_DV + i) * _S + j] + moment * w[pose + (X_DW + i) * _S + j]
        w[(W_LOSS + race) * _S + j] -= power if j < balls else 0.0


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
    """Rows ``W_AXES``: the axes (3 rows, orbiting axes) turned with the spin in ``y`` for the time ``t`` (s).

    In the orbiting axes a' = (w - theta' e_x) x a. Exact while that spin is constant, as it nearly is in
    rolling; else the direction is off by t^2/2 of the spin's rate, 5e-6 rad for 10 us at 1e5 rad/s2.
    Without ball waviness nothing is done.
    """
    if p[P_BALL_WAVES] == 0.0:
        return
    to = W_AXES * _S
    for j in range(lanes):
        ax, ar, at = turn_vector(
            axes[j],
            axes[_S + j],
            axes[2 * _S + j],
            y[B_WX * _S + j] - y[B_OM * _S + j],
            y[B_WR * _S + j],
            y[B_WT * _S + j],
            t,
        )
        w[to + j] = ax
        w[to + _S + j] = ar
        w[to + 2 * _S + j] = at


@kernel
def advance_axes(p, axes, y0, y1, lanes, h):
    """Turn ``axes`` in place over an accepted step of ``h`` (s) with the mean of its first and last spin.

    Second order: the local error is h^3/12 of (the spin's second rate + spin x its rate).
    """
    if p[P_BALL_WAVES] == 0.0:
        return
    for j in range(lanes):
        ax, ar, at = turn_vector(
            axes[j],
            axes[_S + j],
            axes[2 * _S + j],
            0.5 * (y0[B_WX * _S + j] - y0[B_OM * _S + j] + y1[B_WX * _S + j] - y1[B_OM * _S + j]),
            0.5 * (y0[B_WR * _S + j] + y1[B_WR * _S + j]),
            0.5 * (y0[B_WT * _S + j] + y1[B_WT * _S + j]),
            h,
        )
        axes[j] = ax
        axes[_S + j] = ar
        axes[2 * _S + j] = at


@kernel
def first_axes(p, axes):
    """Axes at the start, from the table behind the amplitudes; spare lanes copy ball 0 there already."""
    if p[P_BALL_WAVES] == 0.0:
        return
    table = int(p[P_AT_BALL_WAVES]) + int(p[P_BALL_WAVES])
    for i in range(3 * _S):
        axes[i] = p[table + i]
