"""Contact of the balls with one race: load, traction over strips, rolling resistance.

The contact triad is (e_n, e_t, e_m): from the ball into the race, along rolling, along the major axis.
Velocities are those of the ball's surface against the race's.
"""

import math

import numpy as np

from fmu_bearing.engine.jit import inlined
from fmu_bearing.engine.layout import (
    B_OM,
    B_WR,
    B_WT,
    B_WX,
    C_BALL_RADIUS,
    C_OVERSIZE_SCALE,
    C_RACE_SIZE,
    C_RACES,
    P_AT_OVERSIZE,
    P_AT_STRIPS,
    P_AT_WAVES,
    P_BALLS,
    P_CONTACT_DAMPING,
    P_MU,
    P_RACES,
    P_ROLLING,
    P_SLIDE_TO_ROLL,
    P_STRIPS,
    P_TRACTION_FLOOR,
    P_WAVINESS,
    POSE_ROWS,
    R_AM,
    R_AN,
    R_APPROACH,
    R_AT,
    R_COSA,
    R_ELASTIC,
    R_EM,
    R_EN,
    R_ENTRAIN,
    R_FM,
    R_FT,
    R_HALF,
    R_LOAD,
    R_MM,
    R_MN,
    R_MT,
    R_RATE,
    R_ROLL,
    R_SCALE,
    R_SINA,
    R_SLOPE,
    R_UM,
    R_UT,
    R_WAVE,
    RACE_HALF_LENGTH,
    RACE_PROFILE_RADIUS,
    RACE_ROWS,
    RACE_SIZE,
    RACE_STIFFNESS,
    STRIDE,
    W_FORCE,
    W_LOSS,
    W_POSE,
    W_RACE,
    WAVE_INTERVALS,
    X_A,
    X_DV,
    X_DW,
    X_H,
    X_N,
    X_RHO,
    X_T,
)
from fmu_bearing.engine.mechanics.pose import bearing_angle
from fmu_bearing.engine.mechanics.powers import ROUND, exp2, log2

_S = STRIDE
_PER_RADIAN = WAVE_INTERVALS / 6.283185307179586


@inlined
def waves(p, c, y_angle, lanes, race, turned, w):
    """Race height (m, towards the ball) and slope (m/rad) under each ball.

    Cubic Hermite interpolation of a table of ``WAVE_INTERVALS`` values and slopes; the slope is the exact
    derivative of the interpolant, so waviness conserves energy. ``turned`` is the race's own angle (rad).
    """
    row = (W_RACE + race * RACE_ROWS) * _S
    pose = (W_POSE + race * POSE_ROWS) * _S
    if p[P_WAVINESS] == 0.0:
        for j in range(lanes):
            w[row + R_WAVE * _S + j] = 0.0
            w[row + R_SLOPE * _S + j] = 0.0
        return
    table = int(p[P_AT_WAVES]) + race * 2 * WAVE_INTERVALS
    scale = c[C_OVERSIZE_SCALE]
    for j in range(lanes):
        # The ball's angle seen from the displaced ring's centre: h leaves the radial direction by ht/hr.
        angle = (
            y_angle[j] + bearing_angle(w[pose + (X_H + 1) * _S + j], w[pose + (X_H + 2) * _S + j]) - turned
        )
        # Adding ROUND leaves the interval's number in the low bits: no conversion, no branch.
        place = angle * _PER_RADIAN
        number = (place - 0.5) + ROUND
        t = place - (number - ROUND)
        i0 = np.float64(number).view(np.int64) & (WAVE_INTERVALS - 1)
        i1 = (i0 + 1) & (WAVE_INTERVALS - 1)
        h0 = p[table + 2 * i0]
        g0 = p[table + 2 * i0 + 1]
        h1 = p[table + 2 * i1]
        g1 = p[table + 2 * i1 + 1]
        d = h1 - h0
        a = g0 + g1 - 2.0 * d
        b = 3.0 * d - 2.0 * g0 - g1
        w[row + R_WAVE * _S + j] = scale * (h0 + t * (g0 + t * (b + t * a)))
        w[row + R_SLOPE * _S + j] = scale * _PER_RADIAN * (g0 + t * (2.0 * b + t * 3.0 * a))


@inlined
def normal(p, c, y, lanes, race, w):
    """Contact direction, approach and its rate, load and sliding at the contact's middle."""
    row = (W_RACE + race * RACE_ROWS) * _S
    pose = (W_POSE + race * POSE_ROWS) * _S
    numbers = P_RACES + race * RACE_SIZE
    hertz = p[numbers + RACE_STIFFNESS]
    half = p[numbers + RACE_HALF_LENGTH]
    held = C_RACES + race * C_RACE_SIZE
    groove_x = c[held]
    groove_r = c[held + 1]
    free = c[held + 2]
    ball = c[C_BALL_RADIUS]
    damping = 1.5 * p[P_CONTACT_DAMPING]
    oversize = int(p[P_AT_OVERSIZE])
    half_scale = 0.5 * c[C_OVERSIZE_SCALE]
    slide_to_roll = p[P_SLIDE_TO_ROLL]
    slip_floor = p[P_TRACTION_FLOOR]
    for j in range(lanes):
        nx = w[pose + X_N * _S + j]
        nr = w[pose + (X_N + 1) * _S + j]
        nt = w[pose + (X_N + 2) * _S + j]
        hx = w[pose + X_H * _S + j]
        hr = w[pose + (X_H + 1) * _S + j]
        ht = w[pose + (X_H + 2) * _S + j]
        tx = w[pose + X_T * _S + j]
        tr = w[pose + (X_T + 1) * _S + j]
        tt = w[pose + (X_T + 2) * _S + j]
        rho = w[pose + X_RHO * _S + j]
        sx = w[pose + X_A * _S + j] - groove_x
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
        dvx = w[pose + X_DV * _S + j]
        dvr = w[pose + (X_DV + 1) * _S + j]
        dvt = w[pose + (X_DV + 2) * _S + j]
        along = tx * dvx + tr * dvr + tt * dvt
        slope = w[row + R_SLOPE * _S + j]
        approach = distance - free + w[row + R_WAVE * _S + j] + half_scale * p[oversize + j]
        rate = ex * dvx + er * dvr + et * dvt + slope * along / rho
        pressed = max(approach, 0.0)
        root = math.sqrt(pressed)
        elastic = hertz * root * pressed
        load = max(elastic + hertz * root * damping * rate, 0.0)
        dwx = w[pose + X_DW * _S + j]
        dwr = w[pose + (X_DW + 1) * _S + j]
        dwt = w[pose + (X_DW + 2) * _S + j]
        at = tx * dwx + tr * dwr + tt * dwt
        am = mx * dwx + mr * dwr + mt * dwt
        ut = along + ball * am
        # Surface speed of the ball against the moving contact; the mean of both surfaces entrains oil.
        om = y[B_OM * _S + j]
        own = mx * (y[B_WX * _S + j] - om) + mr * y[B_WR * _S + j] + mt * y[B_WT * _S + j]
        entrain = ball * own - 0.5 * ut
        w[row + R_EN * _S + j] = ex
        w[row + (R_EN + 1) * _S + j] = er
        w[row + (R_EN + 2) * _S + j] = et
        w[row + R_EM * _S + j] = mx
        w[row + (R_EM + 1) * _S + j] = mr
        w[row + (R_EM + 2) * _S + j] = mt
        w[row + R_SINA * _S + j] = sina
        w[row + R_COSA * _S + j] = cosa
        w[row + R_APPROACH * _S + j] = approach
        w[row + R_RATE * _S + j] = rate
        w[row + R_ELASTIC * _S + j] = elastic
        w[row + R_LOAD * _S + j] = load
        w[row + R_HALF * _S + j] = half * root
        w[row + R_UT * _S + j] = ut
        w[row + R_UM * _S + j] = mx * dvx + mr * dvr + mt * dvt - ball * at
        w[row + R_AN * _S + j] = ex * dwx + er * dwr + et * dwt
        w[row + R_AT * _S + j] = at
        w[row + R_AM * _S + j] = am
        w[row + R_ENTRAIN * _S + j] = entrain
        w[row + R_SCALE * _S + j] = slide_to_roll * math.sqrt(entrain * entrain + 1e-8) + slip_floor


@inlined
def traction(p, lanes, race, w):
    """Traction of the strips over the major axis: forces along e_t and e_m and moments on the ball.

    Regularised Coulomb law mu Q u / sqrt(u^2 + u_c^2), bounded by mu Q, with u_c a share of the entrainment
    speed. The strips are Gauss-Jacobi (1,1) points, exact for the parabolic load per length of a Hertz
    ellipse; sliding varies over them with spin and with the curvature of the contact (Heathcote).
    """
    row = (W_RACE + race * RACE_ROWS) * _S
    profile = p[P_RACES + race * RACE_SIZE + RACE_PROFILE_RADIUS]
    per_profile = 0.5 / profile
    mu = p[P_MU]
    strips = int(p[P_STRIPS])
    nodes = int(p[P_AT_STRIPS])
    for j in range(lanes):
        w[row + R_FT * _S + j] = 0.0
        w[row + R_FM * _S + j] = 0.0
        w[row + R_MN * _S + j] = 0.0
        w[row + R_MT * _S + j] = 0.0
        w[row + R_MM * _S + j] = 0.0
    for k in range(strips):
        node = p[nodes + k]
        share = -mu * p[nodes + strips + k]
        for j in range(lanes):
            offset = node * w[row + R_HALF * _S + j]
            sag = offset * offset * per_profile
            ut = w[row + R_UT * _S + j] - offset * w[row + R_AN * _S + j] - sag * w[row + R_AM * _S + j]
            um = w[row + R_UM * _S + j] + sag * w[row + R_AT * _S + j]
            scale = w[row + R_SCALE * _S + j]
            pull = share * w[row + R_LOAD * _S + j] / math.sqrt(ut * ut + um * um + scale * scale)
            ft = pull * ut
            fm = pull * um
            w[row + R_FT * _S + j] += ft
            w[row + R_FM * _S + j] += fm
            w[row + R_MN * _S + j] -= offset * ft
            w[row + R_MT * _S + j] += sag * fm
            w[row + R_MM * _S + j] -= sag * ft


@inlined
def rolling(p, c, lanes, race, w):
    """Hydrodynamic rolling moment (N m) about e_m, opposing the relative rolling of the two surfaces.

    Houpert (1987), inlet force 2.86 E' Rx^2 k^0.348 G^0.022 U^0.66 W^0.47 on either surface, so that the
    pair dissipates twice that force times the entrainment speed; reduction factors are in ``c``.
    """
    row = (W_RACE + race * RACE_ROWS) * _S
    factor = c[C_RACES + race * C_RACE_SIZE + 3]
    if p[P_ROLLING] == 0.0:
        for j in range(lanes):
            w[row + R_ROLL * _S + j] = 0.0
        return
    for j in range(lanes):
        u = w[row + R_ENTRAIN * _S + j]
        load = w[row + R_LOAD * _S + j]
        turning = w[row + R_AM * _S + j]
        size = factor * load * exp2(0.33 * log2(u * u + 1e-8) - 0.53 * log2(load + 1e-9))
        w[row + R_ROLL * _S + j] = -size * turning / math.sqrt(turning * turning + 1.0)


@inlined
def collect(p, c, lanes, race, w):
    """Force and moment on each ball and the power lost in the contact; spare lanes lose none."""
    balls = int(p[P_BALLS])
    row = (W_RACE + race * RACE_ROWS) * _S
    pose = (W_POSE + race * POSE_ROWS) * _S
    out = (W_FORCE + race * 6) * _S
    ball = c[C_BALL_RADIUS]
    for j in range(lanes):
        load = w[row + R_LOAD * _S + j]
        ft = w[row + R_FT * _S + j]
        fm = w[row + R_FM * _S + j]
        # The normal of a wavy race leans along the track; it still passes through the ball's centre.
        lean = ft - load * w[row + R_SLOPE * _S + j] / w[pose + X_RHO * _S + j]
        mn = w[row + R_MN * _S + j]
        mt = w[row + R_MT * _S + j] - ball * fm
        mm = w[row + R_MM * _S + j] + ball * ft + w[row + R_ROLL * _S + j]
        power = -w[row + R_ELASTIC * _S + j] * w[row + R_RATE * _S + j]
        ex = w[row + R_EN * _S + j]
        er = w[row + (R_EN + 1) * _S + j]
        et = w[row + (R_EN + 2) * _S + j]
        mx = w[row + R_EM * _S + j]
        mr = w[row + (R_EM + 1) * _S + j]
        me = w[row + (R_EM + 2) * _S + j]
        tx = w[pose + X_T * _S + j]
        tr = w[pose + (X_T + 1) * _S + j]
        tt = w[pose + (X_T + 2) * _S + j]
        fx = -load * ex + lean * tx + fm * mx
        fr = -load * er + lean * tr + fm * mr
        fe = -load * et + lean * tt + fm * me
        gx = mn * ex + mt * tx + mm * mx
        gr = mn * er + mt * tr + mm * mr
        ge = mn * et + mt * tt + mm * me
        w[out + j] = fx
        w[out + _S + j] = fr
        w[out + 2 * _S + j] = fe
        w[out + 3 * _S + j] = gx
        w[out + 4 * _S + j] = gr
        w[out + 5 * _S + j] = ge
        power -= fx * w[pose + X_DV * _S + j] + gx * w[pose + X_DW * _S + j]
        power -= fr * w[pose + (X_DV + 1) * _S + j] + gr * w[pose + (X_DW + 1) * _S + j]
        power -= fe * w[pose + (X_DV + 2) * _S + j] + ge * w[pose + (X_DW + 2) * _S + j]
        w[(W_LOSS + race) * _S + j] = power if j < balls else 0.0
