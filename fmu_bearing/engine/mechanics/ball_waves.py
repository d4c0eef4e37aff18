"""Waviness that turns with the ball: height of the ball's surface at its contacts, and what it does there.

A ball carries a body-fixed unit axis a. Its surface is h(e) = sum of A_n P_n(e . a) above the sphere in
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
from fmu_bearing.engine.lanes import consecutive, lane, load, select, splat, store
from fmu_bearing.engine.layout import DE, FOUR, STRIDE, C, P, R, S, W, X, Y
from fmu_bearing.engine.mechanics.contact import first_zonal, next_zonal
from fmu_bearing.engine.mechanics.race import contact_load
from fmu_bearing.engine.mechanics.trigonometry import cosine_and_sine
from fmu_bearing.engine.mechanics.triples import added, along, cross, dot, scaled, store_three, three

_STILL = 1e-24  # rad2: below this turn sin x / x is 1
_DEFECTS = S.DEFECT_AXES - S.AXES  # behind the axes


@kernel
def zonal(p, form, orders, x):
    """Height of the zonal harmonics and its derivative by ``x`` (m), at three times four places ``x``."""
    x0, x1, x2 = x
    s0, s1, s2 = first_zonal(p, form, x0), first_zonal(p, form, x1), first_zonal(p, form, x2)
    for order in range(1, orders + 1):
        row = form + P.FORM_ROW * order
        s0, s1, s2 = next_zonal(p, row, x0, s0), next_zonal(p, row, x1, s1), next_zonal(p, row, x2, s2)
    _, _, h0, d0 = s0
    _, _, h1, d1 = s1
    _, _, h2, d2 = s2
    return (h0, h1, h2), (d0, d1, d2)


@kernel
def has_wavy_balls(p, c):
    """Whether the balls' waviness acts: without imperfections nobody has turned their axes."""
    return p[P.BALL_WAVES] != 0.0 and c[C.OVERSIZE_SCALE] != 0.0


@kernel
def heights_under(p, lanes, row, w):
    """Height of each ball at its contact and the derivative into the rows ``R.BUMP_T`` and ``R.BUMP_M``."""
    last = lanes - FOUR
    for j in range(0, lanes, 3 * FOUR):
        # beyond the last four lanes these are done again
        k = min(j + FOUR, last)
        m = min(j + 2 * FOUR, last)
        x = (
            dot(three(w, W.AXES + j), three(w, row + R.EN + j)),
            dot(three(w, W.AXES + k), three(w, row + R.EN + k)),
            dot(three(w, W.AXES + m), three(w, row + R.EN + m)),
        )
        height, rise = zonal(p, int(p[P.AT_FORM]), int(p[P.BALL_WAVES]), x)
        h0, h1, h2 = height
        r0, r1, r2 = rise
        store(w, row + R.BUMP_T + j, h0)
        store(w, row + R.BUMP_T + k, h1)
        store(w, row + R.BUMP_T + m, h2)
        store(w, row + R.BUMP_M + j, r0)
        store(w, row + R.BUMP_M + k, r1)
        store(w, row + R.BUMP_M + m, r2)


@kernel
def add_ball_waves(p, c, lanes, race, w):
    """Put the balls' waviness into approach, its rate, load and ellipse that ``race.normal_contact`` left.

    Reads the axes in the rows ``W.AXES``; leaves the slope towards e_t and e_m for
    :func:`ball_wave_forces`.
    """
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    scale = c[C.OVERSIZE_SCALE]
    heights_under(p, lanes, row, w)
    for j in range(0, lanes, FOUR):
        a = three(w, W.AXES + j)
        m = three(w, row + R.EM + j)
        t = three(w, pose + X.T + j)
        dv = three(w, pose + X.DV + j)
        height = load(w, row + R.BUMP_T + j)
        rise = load(w, row + R.BUMP_M + j)
        bump_t = scale * rise * dot(a, t)
        bump_m = scale * rise * dot(a, m)
        approach = load(w, row + R.APPROACH + j) + scale * height
        rate = load(w, row + R.RATE + j)
        rate += bump_t * load(w, row + R.COSA + j) / load(w, pose + X.RHO + j) * dot(dv, t)
        rate += bump_m * load(w, row + R.PER_GROOVE + j) * dot(dv, m)
        rate += bump_m * load(w, row + R.AT + j) - bump_t * load(w, row + R.AM + j)
        store(w, row + R.BUMP_T + j, bump_t)
        store(w, row + R.BUMP_M + j, bump_m)
        contact_load(p, race, row + j, approach, rate, w)


@kernel
def ball_wave_forces(p, lanes, race, w):
    """Add lateral force, moment and loss of the wavy balls to what ``race.sum_contact_forces`` gathered."""
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    out = W.FORCE + race * W.FORCE_SIZE
    zero = splat(0.0)
    for j in range(0, lanes, FOUR):
        pressing = load(w, row + R.LOAD + j)
        bump_t = load(w, row + R.BUMP_T + j)
        bump_m = load(w, row + R.BUMP_M + j)
        m = three(w, row + R.EM + j)
        t = three(w, pose + X.T + j)
        force_t = -pressing * bump_t * load(w, row + R.COSA + j) / load(w, pose + X.RHO + j)
        force_m = -pressing * bump_m * load(w, row + R.PER_GROOVE + j)
        force = along(force_t, t, force_m, m, zero, m)
        moment = along(pressing * bump_t, m, -pressing * bump_m, t, zero, m)
        store_three(w, out + W.FX + j, added(three(w, out + W.FX + j), force))
        store_three(w, out + W.MX + j, added(three(w, out + W.MX + j), moment))
        power = dot(force, three(w, pose + X.DV + j)) + dot(moment, three(w, pose + X.DW + j))
        lost = load(w, W.LOSS + race * STRIDE + j)
        store(w, W.LOSS + race * STRIDE + j, lost - select(consecutive(j) < p[P.BALLS], power, 0.0))


@kernel
def turned_vector(a, rate, t):
    """Vectors ``a`` of four balls, turned at the ``rate`` (rad/s) for ``t`` (s); of unit length (Rodrigues).

    With half the angle nothing cancels where it is small.
    """
    turn2 = max(dot(rate, rate) * (t * t), _STILL)
    turn = math.sqrt(turn2)
    cosine, sine = cosine_and_sine(0.5 * turn)
    by_cross = t * (2.0 * sine * cosine) / turn
    by_along = (t * t) * (2.0 * sine * sine) / turn2 * dot(rate, a)
    b = along(1.0 - 2.0 * sine * sine, a, by_cross, cross(rate, a), by_along, rate)
    return scaled(1.0 / math.sqrt(dot(b, b)), b)


@kernel
def turning(y, j):
    """Spin (rad/s) of four balls against their orbiting axes, from the state ``y``."""
    return load(y, Y.WX + j) - load(y, Y.OM + j), load(y, Y.WR + j), load(y, Y.WT + j)


@kernel
def turn_directions(p, axes, y0, y1, t, out, to):
    """Directions of local defects on balls, turned for the time ``t`` (s) into ``out[to:]``.

    The spin is the mean of that in both states.
    """
    for k in range(int(p[P.DEFECTS])):
        head = int(p[P.AT_DEFECTS]) + k * DE.SIZE
        if p[head + DE.ON] == DE.BALL:
            j = int(p[head + DE.OF_BALL])
            at = _DEFECTS + DE.VECTOR * k
            turned_x, turned_r, turned_t = turned_vector(
                (splat(axes[at]), splat(axes[at + 1]), splat(axes[at + 2])),
                (
                    splat(0.5 * (y0[Y.WX + j] - y0[Y.OM + j] + y1[Y.WX + j] - y1[Y.OM + j])),
                    splat(0.5 * (y0[Y.WR + j] + y1[Y.WR + j])),
                    splat(0.5 * (y0[Y.WT + j] + y1[Y.WT + j])),
                ),
                t,
            )
            turned = to + DE.VECTOR * k
            out[turned] = lane(turned_x, 0)
            out[turned + 1] = lane(turned_r, 0)
            out[turned + 2] = lane(turned_t, 0)


@kernel
def turn_axes(p, axes, y, lanes, t, w):
    """Rows ``W.AXES``: the axes (3 rows, orbiting axes) turned with the spin in ``y`` for the time ``t`` (s).

    In the orbiting axes a' = (w - theta' e_x) x a. Exact while that spin is constant, as it nearly is in
    rolling; else the direction is off by t^2/2 of the spin's rate, 5e-6 rad for 10 us at 1e5 rad/s2.
    Without ball waviness none is turned. ``axes`` ends with the directions of defects on balls.
    """
    if p[P.BALL_DEFECTS] != 0.0:
        turn_directions(p, axes, y, y, t, w, W.DEFECT_AXES)
    if p[P.BALL_WAVES] == 0.0:
        return
    for j in range(0, lanes, FOUR):
        store_three(w, W.AXES + j, turned_vector(three(axes, j), turning(y, j), t))


@kernel
def advance_axes(p, axes, y0, y1, lanes, h):
    """Turn ``axes`` in place over an accepted step of ``h`` (s) with the mean of its first and last spin.

    Second order: the local error is h^3/12 of (the spin's second rate + spin x its rate).
    """
    if p[P.BALL_DEFECTS] != 0.0:
        turn_directions(p, axes, y0, y1, h, axes, _DEFECTS)
    if p[P.BALL_WAVES] == 0.0:
        return
    for j in range(0, lanes, FOUR):
        mean = scaled(0.5, added(turning(y0, j), turning(y1, j)))
        store_three(axes, j, turned_vector(three(axes, j), mean, h))


@kernel
def first_axes(p, axes):
    """Axes at the start, from their table; spare lanes copy ball 0 there already."""
    for k in range(int(p[P.DEFECTS])):
        head = int(p[P.AT_DEFECTS]) + k * DE.SIZE
        for i in range(DE.VECTOR):
            axes[_DEFECTS + DE.VECTOR * k + i] = p[head + DE.DIRECTION + i]
    if p[P.BALL_WAVES] == 0.0:
        return
    table = int(p[P.AT_AXES])
    for i in range(3 * STRIDE):
        axes[i] = p[table + i]
