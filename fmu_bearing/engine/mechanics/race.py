"""Contact of the balls with one race: load, traction over strips, rolling resistance.

The contact triad is (e_n, e_t, e_m): from the ball into the race, along rolling, along the major axis.
Velocities: of the ball's surface against the race's.
"""

import math

from fmu_bearing.engine.choices import REGULARISED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, load, select, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, P, R, W, X, Y
from fmu_bearing.engine.mechanics.contact import contact_axes, damped, hertz, race_surface
from fmu_bearing.engine.mechanics.inlet import inlet_factors, inlet_moments
from fmu_bearing.engine.mechanics.pose import bearing_angle
from fmu_bearing.engine.mechanics.trigonometry import TWO_PI
from fmu_bearing.engine.mechanics.triples import along, dot, store_three, three


@kernel
def wave_time(p, speed):
    """Time (s) in which the fastest wave of races and balls turns by one radian at a shaft speed (rad/s)."""
    rate = p[P.WAVE_RATE] if p[P.IMPERFECTION_SCALE] != 0.0 else 0.0
    return 1.0 / (rate * abs(speed) + 1.0)


@kernel
def passing_time(p, speed):
    """Longest step (s) that sees the local defects of a bearing pass, at a shaft speed (rad/s)."""
    rate = p[P.PASS_RATE] if p[P.IMPERFECTION_SCALE] != 0.0 else 0.0
    return 1.0 / (rate * abs(speed) + 1.0)


@kernel
def waviness_under(p, c, y_angle, race, turned, j, w):
    """Race height (m, towards the ball), slope (m/rad) and curvature (m/rad2) under four balls.

    ``turned`` is the race's own angle (rad).
    """
    per_radian = p[P.WAVE_INTERVALS] / TWO_PI
    scale = c[C.OVERSIZE_SCALE]
    # The ball's angle seen from the displaced ring's centre: h leaves the radial direction by ht/hr.
    _, hr, ht = three(w, W.POSE + race * X.SIZE + X.H + j)
    angle = load(y_angle, j) + bearing_angle(hr, ht) - turned
    height, slope, curvature = race_surface(p, race, angle * per_radian)
    return scale * height, scale * per_radian * slope, scale * per_radian * per_radian * curvature


@kernel
def waviness(p, c, y_angle, lanes, race, turned, w):
    """Write race height (m, towards the ball) and slope (m/rad) under each ball into their rows."""
    row = W.RACE + race * R.SIZE
    if p[P.WAVINESS] == 0.0:
        for j in range(0, lanes, FOUR):
            store(w, row + R.WAVE + j, 0.0)
            store(w, row + R.SLOPE + j, 0.0)
        return
    for j in range(0, lanes, FOUR):
        height, slope, _ = waviness_under(p, c, y_angle, race, turned, j, w)
        store(w, row + R.WAVE + j, height)
        store(w, row + R.SLOPE + j, slope)


@kernel
def contact_load(p, race, at, approach, rate, w):
    """Write approach (m), its rate (m/s), loads and ellipse of four balls into a race's rows at ``at``."""
    numbers = P.RACES + race * P.RACE_SIZE
    stiffness = p[numbers + P.RACE_STIFFNESS]
    elastic, _, root = hertz(stiffness, approach)
    pressing = damped(stiffness, 1.5 * p[P.CONTACT_DAMPING], root, elastic, rate)
    half = p[numbers + P.RACE_HALF_LENGTH] * root
    store(w, at + R.APPROACH, approach)
    store(w, at + R.RATE, rate)
    store(w, at + R.ELASTIC, elastic)
    store(w, at + R.LOAD, pressing)
    store(w, at + R.HALF, half)


@kernel
def normal_contact(p, c, y, lanes, race, w):
    """Contact direction, approach and its rate, load and sliding at the contact's middle."""
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    raceway = C.RACES + race * C.RACE_SIZE
    groove_x = c[raceway + C.GROOVE_X]
    groove_r = c[raceway + C.GROOVE_RADIUS]
    free = c[raceway + C.FREE]
    ball = c[C.BALL_RADIUS]
    sizes = int(p[P.AT_OVERSIZE])
    half_scale = 0.5 * c[C.OVERSIZE_SCALE]
    slide_to_roll = p[P.SLIDE_TO_ROLL]
    slip_floor = p[P.TRACTION_FLOOR]
    for j in range(0, lanes, FOUR):
        n = three(w, pose + X.N + j)
        h = three(w, pose + X.H + j)
        t = three(w, pose + X.T + j)
        dv = three(w, pose + X.DV + j)
        dw = three(w, pose + X.DW + j)
        rho = load(w, pose + X.RHO + j)
        sx = load(w, pose + X.A + j) - groove_x
        distance, per_distance, sina, cosa, e, m = contact_axes(sx, rho - groove_r, n, h)
        onward = dot(t, dv)
        oversize = half_scale * load(p, sizes + j)
        approach = distance - free + load(w, row + R.WAVE + j) + oversize
        rate = dot(e, dv) + load(w, row + R.SLOPE + j) * onward / rho
        at = dot(t, dw)
        am = dot(m, dw)
        ut = onward + ball * am
        # Surface speed of the ball against the moving contact; the mean of both surfaces entrains oil.
        spin = (load(y, Y.WX + j) - load(y, Y.OM + j), load(y, Y.WR + j), load(y, Y.WT + j))
        entrain = ball * dot(m, spin) - 0.5 * ut
        store_three(w, row + R.EN + j, e)
        store_three(w, row + R.EM + j, m)
        store(w, row + R.PER_GROOVE + j, per_distance)
        store(w, row + R.SINA + j, sina)
        store(w, row + R.COSA + j, cosa)
        contact_load(p, race, row + j, approach, rate, w)
        store(w, row + R.UT + j, ut)
        store(w, row + R.UM + j, dot(m, dv) - ball * at)
        store(w, row + R.AN + j, dot(e, dw))
        store(w, row + R.AT + j, at)
        store(w, row + R.AM + j, am)
        store(w, row + R.ENTRAIN + j, entrain)
        store(w, row + R.SCALE + j, slide_to_roll * math.sqrt(entrain * entrain + 1e-8) + slip_floor)


@kernel
def plain_traction(p):
    """Whether traction follows the regularised law in oil that friction does not heat: `traction`."""
    return p[P.TRACTION_LAW] == REGULARISED and p[P.THERMAL_TRACTION] == 0.0


@kernel
def traction(p, lanes, race, w):
    """Traction of the strips over the major axis: forces along e_t and e_m and moments on the ball.

    Regularised Coulomb law mu Q u / sqrt(u^2 + u_c^2), bounded by mu Q, with u_c a share of the entrainment
    speed. The strips are Gauss-Jacobi (1,1) points, exact for the parabolic load per length of a Hertz
    ellipse; sliding varies over them with spin and with the curvature of the contact (Heathcote).
    """
    row = W.RACE + race * R.SIZE
    profile = p[P.RACES + race * P.RACE_SIZE + P.RACE_PROFILE_RADIUS]
    per_profile = 0.5 / profile
    mu = p[P.MU]
    strips = int(p[P.STRIPS])
    nodes = int(p[P.AT_STRIPS])
    for j in range(0, lanes, FOUR):
        half = load(w, row + R.HALF + j)
        pressing = load(w, row + R.LOAD + j)
        scale = load(w, row + R.SCALE + j)
        an = load(w, row + R.AN + j)
        at = load(w, row + R.AT + j)
        am = load(w, row + R.AM + j)
        middle_t = load(w, row + R.UT + j)
        middle_m = load(w, row + R.UM + j)
        force_t = splat(0.0)
        force_m = splat(0.0)
        moment_n = splat(0.0)
        moment_t = splat(0.0)
        moment_m = splat(0.0)
        for k in range(strips):
            offset = p[nodes + k] * half
            sag = offset * offset * per_profile
            ut = middle_t - offset * an - sag * am
            um = middle_m + sag * at
            pull = -mu * p[nodes + strips + k] * pressing / math.sqrt(ut * ut + um * um + scale * scale)
            ft = pull * ut
            fm = pull * um
            force_t += ft
            force_m += fm
            moment_n -= offset * ft
            moment_t += sag * fm
            moment_m -= sag * ft
        store(w, row + R.FT + j, force_t)
        store(w, row + R.FM + j, force_m)
        store(w, row + R.MN + j, moment_n)
        store(w, row + R.MT + j, moment_t)
        store(w, row + R.MM + j, moment_m)


@kernel
def rolling_moment(p, c, lanes, race, w):
    """Write the rolling moment (N m) about e_m, which opposes the relative rolling of the two surfaces.

    One part is that of the oil at the inlet, a force on either surface, so that the pair dissipates twice
    that force times the entrainment speed; reduction factors are in ``c``. The other is hysteresis: the share
    alpha of 3/16 Q b, the moment of the pressure on the leading half of the ellipse (Johnson 1985, 9.6).
    """
    row = W.RACE + race * R.SIZE
    lost = p[P.RACES + race * P.RACE_SIZE + P.RACE_HYSTERESIS]
    inlet_moments(p, lanes, inlet_factors(p, c, race), row, w)
    for j in range(0, lanes, FOUR):
        turning = load(w, row + R.AM + j)
        size = load(w, row + R.ROLL + j)
        size += lost * load(w, row + R.LOAD + j) * load(w, row + R.HALF + j)
        store(w, row + R.ROLL + j, -size * turning / math.sqrt(turning * turning + 1.0))


@kernel
def sum_contact_forces(p, c, lanes, race, w):
    """Force and moment on each ball and the power lost in the contact; spare lanes lose none."""
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    out = W.FORCE + race * W.FORCE_SIZE
    ball = c[C.BALL_RADIUS]
    for j in range(0, lanes, FOUR):
        e = three(w, row + R.EN + j)
        m = three(w, row + R.EM + j)
        t = three(w, pose + X.T + j)
        pressing = load(w, row + R.LOAD + j)
        ft = load(w, row + R.FT + j)
        fm = load(w, row + R.FM + j)
        # The normal of a wavy race leans along the track; it still passes through the ball's centre.
        lean = ft - pressing * load(w, row + R.SLOPE + j) / load(w, pose + X.RHO + j)
        mt = load(w, row + R.MT + j) - ball * fm
        mm = load(w, row + R.MM + j) + ball * ft + load(w, row + R.ROLL + j)
        force = along(-pressing, e, lean, t, fm, m)
        moment = along(load(w, row + R.MN + j), e, mt, t, mm, m)
        store_three(w, out + W.FX + j, force)
        store_three(w, out + W.MX + j, moment)
        work = dot(force, three(w, pose + X.DV + j)) + dot(moment, three(w, pose + X.DW + j))
        lost = -load(w, row + R.ELASTIC + j) * load(w, row + R.RATE + j) - work
        store(w, W.LOSS + race * STRIDE + j, select(consecutive(j) < p[P.BALLS], lost, 0.0))
