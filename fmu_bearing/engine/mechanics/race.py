"""Contact of the balls with one race: load, traction over strips, rolling resistance.

The contact triad is (e_n, e_t, e_m): from the ball into the race, along rolling, along the major axis.
Velocities are those of the ball's surface against the race's.
"""

import math

import numpy as np

from fmu_bearing.engine.jit import inlined
from fmu_bearing.engine.layout import STRIDE, C, P, R, W, X, Y
from fmu_bearing.engine.mechanics.pose import bearing_angle
from fmu_bearing.engine.mechanics.powers import ROUND, exp2, log2

_PER_RADIAN = P.WAVE_INTERVALS / 6.283185307179586


@inlined
def waves(p, c, y_angle, lanes, race, turned, w):
    """Race height (m, towards the ball) and slope (m/rad) under each ball.

    Cubic Hermite interpolation of a table of ``WAVE_INTERVALS`` values and slopes; the slope is the exact
    derivative of the interpolant, so waviness conserves energy. ``turned`` is the race's own angle (rad).
    """
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    if p[P.WAVINESS] == 0.0:
        for j in range(lanes):
            w[row + R.WAVE + j] = 0.0
            w[row + R.SLOPE + j] = 0.0
        return
    table = int(p[P.AT_WAVES]) + race * 2 * P.WAVE_INTERVALS
    scale = c[C.OVERSIZE_SCALE]
    for j in range(lanes):
        # The ball's angle seen from the displaced ring's centre: h leaves the radial direction by ht/hr.
        angle = (
            y_angle[j] + bearing_angle(w[pose + X.H + STRIDE + j], w[pose + X.H + 2 * STRIDE + j]) - turned
        )
        # Adding ROUND leaves the interval's number in the low bits: no conversion, no branch.
        place = angle * _PER_RADIAN
        number = (place - 0.5) + ROUND
        t = place - (number - ROUND)
        i0 = np.float64(number).view(np.int64) & (P.WAVE_INTERVALS - 1)
        i1 = (i0 + 1) & (P.WAVE_INTERVALS - 1)
        h0 = p[table + 2 * i0]
        g0 = p[table + 2 * i0 + 1]
        h1 = p[table + 2 * i1]
        g1 = p[table + 2 * i1 + 1]
        d = h1 - h0
        a = g0 + g1 - 2.0 * d
        b = 3.0 * d - 2.0 * g0 - g1
        w[row + R.WAVE + j] = scale * (h0 + t * (g0 + t * (b + t * a)))
        w[row + R.SLOPE + j] = scale * _PER_RADIAN * (g0 + t * (2.0 * b + t * 3.0 * a))


@inlined
def normal(p, c, y, lanes, race, w):
    """Contact direction, approach and its rate, load and sliding at the contact's middle."""
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    numbers = P.RACES + race * P.RACE_SIZE
    hertz = p[numbers + P.RACE_STIFFNESS]
    half = p[numbers + P.RACE_HALF_LENGTH]
    held = C.RACES + race * C.RACE_SIZE
    groove_x = c[held + C.GROOVE_X]
    groove_r = c[held + C.GROOVE_RADIUS]
    free = c[held + C.FREE]
    ball = c[C.BALL_RADIUS]
    damping = 1.5 * p[P.CONTACT_DAMPING]
    oversize = int(p[P.AT_OVERSIZE])
    half_scale = 0.5 * c[C.OVERSIZE_SCALE]
    slide_to_roll = p[P.SLIDE_TO_ROLL]
    slip_floor = p[P.TRACTION_FLOOR]
    for j in range(lanes):
        nx = w[pose + X.N + j]
        nr = w[pose + X.N + STRIDE + j]
        nt = w[pose + X.N + 2 * STRIDE + j]
        hx = w[pose + X.H + j]
        hr = w[pose + X.H + STRIDE + j]
        ht = w[pose + X.H + 2 * STRIDE + j]
        tx = w[pose + X.T + j]
        tr = w[pose + X.T + STRIDE + j]
        tt = w[pose + X.T + 2 * STRIDE + j]
        rho = w[pose + X.RHO + j]
        sx = w[pose + X.A + j] - groove_x
        sr = rho - groove_r
        distance = math.sqrt(sx * sx + sr * sr)
        sina = sx / distance
        cosa = sr / distance
        ex = sina * nx + cosa * hx
        er = sina * nr + cosa * hr
        et = sina * nt + cosa * ht
        mx = sina * -hx + cosa * nx
        mr = sina * -hr + cosa * nr
        mt = sina * -ht + cosa * nt
        dvx = w[pose + X.DV + j]
        dvr = w[pose + X.DV + STRIDE + j]
        dvt = w[pose + X.DV + 2 * STRIDE + j]
        along = tx * dvx + tr * dvr + tt * dvt
        slope = w[row + R.SLOPE + j]
        approach = distance - free + w[row + R.WAVE + j] + half_scale * p[oversize + j]
        rate = ex * dvx + er * dvr + et * dvt + slope * along / rho
        pressed = max(approach, 0.0)
        root = math.sqrt(pressed)
        elastic = hertz * root * pressed
        load = max(elastic + hertz * root * damping * rate, 0.0)
        dwx = w[pose + X.DW + j]
        dwr = w[pose + X.DW + STRIDE + j]
        dwt = w[pose + X.DW + 2 * STRIDE + j]
        at = tx * dwx + tr * dwr + tt * dwt
        am = mx * dwx + mr * dwr + mt * dwt
        ut = along + ball * am
        # Surface speed of the ball against the moving contact; the mean of both surfaces entrains oil.
        om = y[Y.OM + j]
        own = mx * (y[Y.WX + j] - om) + mr * y[Y.WR + j] + mt * y[Y.WT + j]
        entrain = ball * own - 0.5 * ut
        w[row + R.EN + j] = ex
        w[row + R.EN + STRIDE + j] = er
        w[row + R.EN + 2 * STRIDE + j] = et
        w[row + R.EM + j] = mx
        w[row + R.EM + STRIDE + j] = mr
        w[row + R.EM + 2 * STRIDE + j] = mt
        w[row + R.SINA + j] = sina
        w[row + R.COSA + j] = cosa
        w[row + R.APPROACH + j] = approach
        w[row + R.RATE + j] = rate
        w[row + R.ELASTIC + j] = elastic
        w[row + R.LOAD + j] = load
        w[row + R.HALF + j] = half * root
        w[row + R.UT + j] = ut
        w[row + R.UM + j] = mx * dvx + mr * dvr + mt * dvt - ball * at
        w[row + R.AN + j] = ex * dwx + er * dwr + et * dwt
        w[row + R.AT + j] = at
        w[row + R.AM + j] = am
        w[row + R.ENTRAIN + j] = entrain
        w[row + R.SCALE + j] = slide_to_roll * math.sqrt(entrain * entrain + 1e-8) + slip_floor


@inlined
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
    for j in range(lanes):
        w[row + R.FT + j] = 0.0
        w[row + R.FM + j] = 0.0
        w[row + R.MN + j] = 0.0
        w[row + R.MT + j] = 0.0
        w[row + R.MM + j] = 0.0
    for k in range(strips):
        node = p[nodes + k]
        share = -mu * p[nodes + strips + k]
        for j in range(lanes):
            offset = node * w[row + R.HALF + j]
            sag = offset * offset * per_profile
            ut = w[row + R.UT + j] - offset * w[row + R.AN + j] - sag * w[row + R.AM + j]
            um = w[row + R.UM + j] + sag * w[row + R.AT + j]
            scale = w[row + R.SCALE + j]
            pull = share * w[row + R.LOAD + j] / math.sqrt(ut * ut + um * um + scale * scale)
            ft = pull * ut
            fm = pull * um
            w[row + R.FT + j] += ft
            w[row + R.FM + j] += fm
            w[row + R.MN + j] -= offset * ft
            w[row + R.MT + j] += sag * fm
            w[row + R.MM + j] -= sag * ft


@inlined
def rolling(p, c, lanes, race, w):
    """Hydrodynamic rolling moment (N m) about e_m, opposing the relative rolling of the two surfaces.

    Houpert (1987), inlet force 2.86 E' Rx^2 k^0.348 G^0.022 U^0.66 W^0.47 on either surface, so that the
    pair dissipates twice that force times the entrainment speed; reduction factors are in ``c``.
    """
    row = W.RACE + race * R.SIZE
    factor = c[C.RACES + race * C.RACE_SIZE + C.ROLLING]
    if p[P.ROLLING] == 0.0:
        for j in range(lanes):
            w[row + R.ROLL + j] = 0.0
        return
    for j in range(lanes):
        u = w[row + R.ENTRAIN + j]
        load = w[row + R.LOAD + j]
        turning = w[row + R.AM + j]
        size = factor * load * exp2(0.33 * log2(u * u + 1e-8) - 0.53 * log2(load + 1e-9))
        w[row + R.ROLL + j] = -size * turning / math.sqrt(turning * turning + 1.0)


@inlined
def collect(p, c, lanes, race, w):
    """Force and moment on each ball and the power lost in the contact; spare lanes lose none."""
    balls = int(p[P.BALLS])
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    out = W.FORCE + race * W.FORCE_SIZE
    ball = c[C.BALL_RADIUS]
    for j in range(lanes):
        load = w[row + R.LOAD + j]
        ft = w[row + R.FT + j]
        fm = w[row + R.FM + j]
        # The normal of a wavy race leans along the track; it still passes through the ball's centre.
        lean = ft - load * w[row + R.SLOPE + j] / w[pose + X.RHO + j]
        mn = w[row + R.MN + j]
        mt = w[row + R.MT + j] - ball * fm
        mm = w[row + R.MM + j] + ball * ft + w[row + R.ROLL + j]
        power = -w[row + R.ELASTIC + j] * w[row + R.RATE + j]
        ex = w[row + R.EN + j]
        er = w[row + R.EN + STRIDE + j]
        et = w[row + R.EN + 2 * STRIDE + j]
        mx = w[row + R.EM + j]
        mr = w[row + R.EM + STRIDE + j]
        me = w[row + R.EM + 2 * STRIDE + j]
        tx = w[pose + X.T + j]
        tr = w[pose + X.T + STRIDE + j]
        tt = w[pose + X.T + 2 * STRIDE + j]
        fx = -load * ex + lean * tx + fm * mx
        fr = -load * er + lean * tr + fm * mr
        fe = -load * et + lean * tt + fm * me
        gx = mn * ex + mt * tx + mm * mx
        gr = mn * er + mt * tr + mm * mr
        ge = mn * et + mt * tt + mm * me
        w[out + W.FX + j] = fx
        w[out + W.FR + j] = fr
        w[out + W.FT + j] = fe
        w[out + W.MX + j] = gx
        w[out + W.MR + j] = gr
        w[out + W.MT + j] = ge
        power -= fx * w[pose + X.DV + j] + gx * w[pose + X.DW + j]
        power -= fr * w[pose + X.DV + STRIDE + j] + gr * w[pose + X.DW + STRIDE + j]
        power -= fe * w[pose + X.DV + 2 * STRIDE + j] + ge * w[pose + X.DW + 2 * STRIDE + j]
        w[W.LOSS + race * STRIDE + j] = power if j < balls else 0.0
