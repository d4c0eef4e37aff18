"""Local defects of races and balls: what they take of the approach of a contact, and what that does.

A defect is a table (`layout.defect`): with the approach delta of the sound contact and the place x of the
ball's centre along the track, it leaves eta(delta, x). The contact stores U = (2/5) K eta^(5/2), so that
with G = d eta/d delta

    Q = K eta^(3/2) G along the normal,    T = -K eta^(3/2) d eta/dx along the track,

and energy closes whatever the table is. Contact damping follows eta: P = K (eta^(3/2) + (3/2) tau eta^(1/2)
eta') takes the place of K eta^(3/2) in both, so that it dissipates P - K eta^(3/2) times eta', never less
than nothing. In the rows of a race APPROACH is eta, GAIN is G, LOAD is P G, and SLOPE gains d eta/dx over G,
so that RATE stays eta'/G and ELASTIC times RATE the rate of U. Defects within reach of one contact follow one
another: the second takes what the first leaves.

With the factor s a defect leaves s eta(delta/s, x): depths grow by s, lengths do not, energy closes for each.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import store
from fmu_bearing.engine.layout import DE, FL, FOUR, STRIDE, C, P, R, W, X, Y
from fmu_bearing.engine.mechanics.ball_waves import ball_wave_forces, has_wavy_balls
from fmu_bearing.engine.mechanics.contact import damped, hertz
from fmu_bearing.engine.mechanics.flexure import bends
from fmu_bearing.engine.mechanics.pose import bearing_angle
from fmu_bearing.engine.mechanics.trigonometry import wrap

LEAST_GAIN = 1e-3  # between nodes tables fall below it where less than 0.02 um is left: no contact pulls
LEAST_SCALE = 1e-6  # of a defect: less is none


@kernel
def has_defects(p, c):
    """Whether local defects act: at scale 0 nobody has turned the balls' own."""
    return p[P.DEFECTS] != 0.0 and c[C.OVERSIZE_SCALE] != 0.0


@kernel
def interval(p, at, count, value):
    """Return which interval of ``count`` ascending nodes at ``p[at:]`` holds ``value``, or is nearest."""
    low = 0
    high = count - 1
    while high - low > 1:
        middle = (low + high) >> 1
        if p[at + middle] <= value:
            low = middle
        else:
            high = middle
    return low


@kernel
def cubic(f0, f1, g0, g1, t, step):
    """Value of a cubic Hermite polynomial at ``t`` from 0 to 1 of a step, its slope and second derivative.

    ``f0``, ``f1``: values at both ends; ``g0``, ``g1``: slopes.
    """
    d = f1 - f0
    s0 = step * g0
    s1 = step * g1
    a = s0 + s1 - 2.0 * d
    b = 3.0 * d - 2.0 * s0 - s1
    value = f0 + t * (s0 + t * (b + t * a))
    slope = (s0 + t * (2.0 * b + t * 3.0 * a)) / step
    return value, slope, (2.0 * b + t * 6.0 * a) / (step * step)


@kernel
def drop_over(p, row, t, step):
    """Drop and its slope along the track at one place, each with two derivatives by the approach."""
    after = row + DE.DROP_ROW
    own = cubic(p[row + DE.DROP], p[after + DE.DROP], p[row + DE.DROP_E], p[after + DE.DROP_E], t, step)
    along = cubic(
        p[row + DE.DROP_X], p[after + DE.DROP_X], p[row + DE.DROP_XE], p[after + DE.DROP_XE], t, step
    )
    return own, along


@kernel
def left_over(p, table, delta, x):
    """Approach (m) that a defect leaves of ``delta`` (m) at ``x`` (m), within the places of its table.

    Returns eta, its slopes along delta and x, and its second derivatives by delta twice, by both, by x twice.
    """
    places = int(p[table + DE.PLACES])
    approaches = int(p[table + DE.APPROACHES])
    first = table + DE.TABLE_HEAD
    nodes = first + places
    touches = nodes + approaches
    i = interval(p, first, places, x)
    width = p[first + i + 1] - p[first + i]
    s = (x - p[first + i]) / width
    row = touches + i * DE.TOUCH_ROW
    after = row + DE.TOUCH_ROW
    touch, touch_x, touch_xx = cubic(
        p[row + DE.TOUCH], p[after + DE.TOUCH], p[row + DE.TOUCH_X], p[after + DE.TOUCH_X], s, width
    )
    e = delta - touch
    if not (e > 0.0):
        return e, 1.0, -touch_x, 0.0, 0.0, -touch_xx
    beyond = e >= p[nodes + approaches - 1]
    k = approaches - 2 if beyond else interval(p, nodes, approaches, e)
    step = p[nodes + k + 1] - p[nodes + k]
    t = 1.0 if beyond else (e - p[nodes + k]) / step
    row = touches + places * DE.TOUCH_ROW + (i * approaches + k) * DE.DROP_ROW
    own, along = drop_over(p, row, t, step)
    drop0, drop_e0, drop_ee0 = own
    drop_x0, drop_xe0, drop_xee0 = along
    own, along = drop_over(p, row + approaches * DE.DROP_ROW, t, step)
    drop1, drop_e1, drop_ee1 = own
    drop_x1, drop_xe1, drop_xee1 = along
    drop, drop_x, drop_xx = cubic(drop0, drop1, drop_x0, drop_x1, s, width)
    drop_e, drop_ex, _ = cubic(drop_e0, drop_e1, drop_xe0, drop_xe1, s, width)
    drop_ee, _, _ = cubic(drop_ee0, drop_ee1, drop_xee0, drop_xee1, s, width)
    if beyond:
        drop_e = 0.0
        drop_ex = 0.0
        drop_ee = 0.0
    gain = 1.0 - drop_e
    return (
        e - drop,
        gain,
        -touch_x * gain - drop_x,
        -drop_ee,
        drop_ee * touch_x - drop_ex,
        2.0 * touch_x * drop_ex - touch_xx * gain - touch_x * touch_x * drop_ee - drop_xx,
    )


@kernel
def scaled_left_over(p, table, scale, delta, x):
    """Return :func:`left_over` of a defect with a ``scale``, above 0; last its slope along the scale (m)."""
    share = delta / scale
    eta, gain, eta_x, by_two, by_both, by_places = left_over(p, table, share, x)
    by_scale = eta - share * gain
    return scale * eta, gain, scale * eta_x, by_two / scale, by_both, scale * by_places, by_scale


@kernel
def within(p, table, x):
    """Whether a place ``x`` (m) lies between the ends of a table."""
    first = table + DE.TABLE_HEAD
    return x > p[first] and x < p[first + int(p[table + DE.PLACES]) - 1]


@kernel
def head_of(p, k):
    """Place in ``p`` of the head of defect ``k`` of a bearing."""
    return int(p[P.AT_DEFECTS]) + k * DE.SIZE


@kernel
def table_of(p, head, race):
    """Place in ``p`` of the table of a defect at a race; 0: this race does not meet it."""
    away = int(p[head + DE.AT_TABLE + race])
    return int(p[P.AT_DEFECTS]) + away if away > 0 else 0


@kernel
def place_on_race(p, y_angle, head, race, turned, j, w):
    """Place (m) of ball ``j`` along the track from the middle of a defect on the race.

    ``turned``: the race's own angle (rad).
    """
    h = W.POSE + race * X.SIZE + X.H + j
    angle = y_angle[j] + bearing_angle(w[h + STRIDE], w[h + 2 * STRIDE]) - turned - p[head + DE.ANGLE]
    return p[head + DE.RADIUS + race] * wrap(angle)


@kernel
def clear_defects(p, c, lanes, row, w):
    """Begin the rows of a race that defects write, as of sound places."""
    bumps = p[P.BALL_DEFECTS] != 0.0 and not has_wavy_balls(p, c)
    for j in range(0, lanes, FOUR):
        store(w, row + R.GAIN + j, 1.0)
        store(w, row + R.BUMP_N + j, 0.0)
        store(w, row + R.BEND_N + j, 0.0)
        store(w, row + R.BEND_T + j, 0.0)
        store(w, row + R.BEND_TT + j, 0.0)
        if bumps:
            store(w, row + R.BUMP_T + j, 0.0)
            store(w, row + R.BUMP_M + j, 0.0)


@kernel
def change_contact(at, rho, left, ahead, w):
    """Put what a defect leaves into approach, gain and bends of one ball; returns one over the whole gain.

    ``at``: the ball's place in the rows of a race; ``left``: of :func:`scaled_left_over`; ``ahead``: place
    along the table by the ball's place along the track.
    """
    eta, gain, _, by_two, by_both, by_places, _ = left
    before = w[at + R.GAIN]
    gain = max(gain, LEAST_GAIN)
    along = before * w[at + R.SLOPE] / rho
    w[at + R.BEND_TT] = (
        gain * w[at + R.BEND_TT]
        + by_two * along * along
        + (2.0 * by_both * along + by_places * ahead) * ahead
    )
    w[at + R.BEND_T] = gain * w[at + R.BEND_T] + (by_two * along + by_both * ahead) * before
    w[at + R.BEND_N] = gain * w[at + R.BEND_N] + by_two * before * before
    w[at + R.APPROACH] = eta
    w[at + R.GAIN] = before * gain
    return 1.0 / (before * gain)


@kernel
def inner_product(w, one, other):
    """Product of two vectors of one ball, whose components are a row apart."""
    return (
        w[one] * w[other] + w[one + STRIDE] * w[other + STRIDE] + w[one + 2 * STRIDE] * w[other + 2 * STRIDE]
    )


@kernel
def press(p, race, at, w):
    """Load without and with damping and semi-major axis of one ball, from approach, gain and rate."""
    numbers = P.RACES + race * P.RACE_SIZE
    stiffness = p[numbers + P.RACE_STIFFNESS]
    gain = w[at + R.GAIN]
    elastic, _, root = hertz(stiffness, w[at + R.APPROACH])
    pressing = damped(stiffness, 1.5 * p[P.CONTACT_DAMPING], root, elastic, gain * w[at + R.RATE])
    w[at + R.ELASTIC] = gain * elastic
    w[at + R.LOAD] = gain * pressing
    w[at + R.HALF] = p[numbers + P.RACE_HALF_LENGTH] * root


@kernel
def meet_on_race(p, race, table, scale, x, head, j, w):
    """Let ball ``j`` meet a defect of the race at the place ``x`` (m) along the track."""
    at = W.RACE + race * R.SIZE + j
    pose = W.POSE + race * X.SIZE + j
    rho = w[pose + X.RHO]
    left = scaled_left_over(p, table, scale, w[at + R.APPROACH], x)
    _, _, eta_x, _, _, _, _ = left
    per_radian = p[head + DE.RADIUS + race]
    if bends(p, race):
        per_radian *= w[W.FLEX + FL.GR + j]
    slope = eta_x * per_radian * change_contact(at, rho, left, per_radian / rho, w)
    onward = inner_product(w, pose + X.T, pose + X.DV)
    w[at + R.SLOPE] += slope
    w[at + R.RATE] += slope * onward / rho
    press(p, race, at, w)


@kernel
def acts_across(y, full, end):
    """Share of a ball's defect that acts ``y`` (m) off its track, and its slope (1/m): a cubic step.

    1 up to ``full`` (m), 0 from ``end`` on.
    """
    away = abs(y)
    if away <= full:
        return 1.0, 0.0
    if not (away < end):
        return 0.0, 0.0
    t = (end - away) / (end - full)
    return t * t * (3.0 - 2.0 * t), -math.copysign(6.0 * t * (1.0 - t) / (end - full), y)


@kernel
def meet_on_ball(p, race, k, table, scale, j, w):
    """Let the race meet defect ``k``, on ball ``j``, if its direction in ``W.DEFECT_AXES`` is within reach.

    The place along the track is R atan2(-d_t, d_e), with d the direction in the contact's axes: the angle
    round the rolling axis e_m from the defect to the contact. Off the track by R d_m it acts by a share.
    """
    head = head_of(p, k)
    at = W.RACE + race * R.SIZE + j
    pose = W.POSE + race * X.SIZE + j
    d = W.DEFECT_AXES + DE.VECTOR * k
    d0 = w[d]
    d1 = w[d + 1]
    d2 = w[d + 2]
    t = pose + X.T
    m = at + R.EM
    de = d0 * w[at + R.EN] + d1 * w[at + R.EN + STRIDE] + d2 * w[at + R.EN + 2 * STRIDE]
    if not (de > 0.0):
        return
    dt = d0 * w[t] + d1 * w[t + STRIDE] + d2 * w[t + 2 * STRIDE]
    dm = d0 * w[m] + d1 * w[m + STRIDE] + d2 * w[m + 2 * STRIDE]
    radius = p[head + DE.RADIUS + race]
    x = radius * math.atan2(-dt, de)
    edges = head + DE.ACROSS + 2 * race
    share, share_y = acts_across(radius * dm, p[edges], p[edges + 1])
    if not within(p, table, x) or scale * share < LEAST_SCALE:
        return
    rho = w[pose + X.RHO]
    left = scaled_left_over(p, table, scale * share, w[at + R.APPROACH], x)
    _, _, eta_x, _, _, _, by_scale = left
    per_gain = change_contact(at, rho, left, radius * w[at + R.COSA] / rho, w)
    # approach by turning of the ball about e, t, m against the contact's axes
    along = radius * eta_x * per_gain
    aside = radius * by_scale * scale * share_y * per_gain
    twist = dm / (de * de + dt * dt)
    by_n = along * twist * de + aside * dt
    by_t = along * twist * dt - aside * de
    by_m = -along
    onward = inner_product(w, t, pose + X.DV) / rho
    sideways = inner_product(w, m, pose + X.DV) * w[at + R.PER_GROOVE]
    w[at + R.RATE] += (
        by_n * (w[at + R.AN] - onward * w[at + R.SINA])
        + by_t * (w[at + R.AT] + sideways)
        + by_m * (w[at + R.AM] - onward * w[at + R.COSA])
    )
    w[at + R.BUMP_N] += by_n
    w[at + R.BUMP_M] += by_t
    w[at + R.BUMP_T] -= by_m
    press(p, race, at, w)


@kernel
def add_defects(p, c, y, lanes, race, turned, w):
    """Put local defects into what ``race.normal_contact`` and the balls' waviness left; ``turned``: rad.

    Spare lanes follow ball 0. Writes approach, its rate, gain, slopes, loads and ellipse of balls in reach.
    """
    row = W.RACE + race * R.SIZE
    clear_defects(p, c, lanes, row, w)
    balls = int(p[P.BALLS])
    for k in range(int(p[P.DEFECTS])):
        head = head_of(p, k)
        table = table_of(p, head, race)
        scale = c[C.OVERSIZE_SCALE] * c[C.DEFECT_SCALE + k]
        if table == 0 or not (scale > LEAST_SCALE):
            continue
        for j in range(lanes):
            if p[head + DE.ON] == DE.BALL:
                if (j if j < balls else 0) == int(p[head + DE.OF_BALL]):
                    meet_on_ball(p, race, k, table, scale, j, w)
            else:
                x = place_on_race(p, y[Y.TH : Y.TH + STRIDE], head, race, turned, j, w)
                if within(p, table, x):
                    meet_on_race(p, race, table, scale, x, head, j, w)


@kernel
def defect_forces(p, c, lanes, race, w):
    """Add what defects on balls do beside the normal load to what ``race.sum_contact_forces`` gathered."""
    if p[P.BALL_DEFECTS] == 0.0:
        return
    if not has_wavy_balls(p, c):
        ball_wave_forces(p, lanes, race, w)
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    out = W.FORCE + race * W.FORCE_SIZE
    for j in range(lanes):
        twist = w[row + R.LOAD + j] * w[row + R.BUMP_N + j]
        if twist != 0.0:
            force = twist * w[row + R.SINA + j] / w[pose + X.RHO + j]
            for i in range(0, 3 * STRIDE, STRIDE):
                w[out + W.FX + i + j] += force * w[pose + X.T + i + j]
                w[out + W.MX + i + j] -= twist * w[row + R.EN + i + j]
            onward = inner_product(w, pose + X.T + j, pose + X.DV + j)
            if j < p[P.BALLS]:
                w[W.LOSS + race * STRIDE + j] += twist * w[row + R.AN + j] - force * onward
