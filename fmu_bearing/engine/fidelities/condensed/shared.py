"""What the levels `rings` and `response` share: start, inputs, and the end of a step."""

import math

from fmu_bearing.engine.fidelities.condensed.balls import stand
from fmu_bearing.engine.fidelities.condensed.damping import add_damping
from fmu_bearing.engine.fidelities.condensed.held import hold, out_of_date
from fmu_bearing.engine.fidelities.condensed.linearised import (
    at_rest,
    derivatives,
)
from fmu_bearing.engine.fidelities.condensed.publish import publish
from fmu_bearing.engine.fidelities.full.start import find, loads, place_balls, start
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    B_R,
    B_TH,
    B_X,
    C_LOAD_Y,
    C_PEDESTAL,
    C_PEDESTAL_AXIAL,
    C_PRELOAD,
    C_SIZE,
    F_SIZE,
    L_SIZE,
    OK,
    P_AT_OVERSIZE,
    P_AT_WAVES,
    P_BALLS,
    P_LANES,
    P_WAVINESS,
    PI,
    Q5_SHIFT,
    Q5_SIZE,
    Q_OUTER,
    S_ANGLE,
    S_C,
    S_F,
    S_HEAT_INNER,
    S_LEVEL,
    S_SPEED,
    S_SPEED_RATE,
    S_STEPS,
    S_TIME,
    S_WORK,
    S_Y,
    STRIDE,
    U_SPEED,
    W_LAST,
    W_SCALARS,
    W_VEL,
    W_Y,
    WAVE_INTERVALS,
    Y_Q,
    Y_SIZE,
)
from fmu_bearing.engine.layout_condensed import (
    E_BEND,
    E_INNER,
    E_R,
    E_X,
    L_COS,
    L_HEAT,
    L_MASK,
    L_MEAN,
    L_ORDER,
    L_PHI,
    L_RATIO,
    L_SIN,
    L_SIZES,
    L_X,
    N,
)
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.readout.motion import emit_samples

_S = STRIDE


@kernel
def highest_order(p):
    """Waves per turn that matter to the step: the rms curvature of the race heights over their rms slope.

    For one harmonic its order; for a flat spectrum about 0.8 of the highest, whence the factor 1.25.
    """
    if p[P_WAVINESS] == 0.0:
        return 1.0
    worst = 1.0
    for race in range(2):
        table = int(p[P_AT_WAVES]) + race * 2 * WAVE_INTERVALS
        slopes = 0.0
        changes = 0.0
        for i in range(WAVE_INTERVALS):
            g = p[table + 2 * i + 1]
            d = p[table + 2 * ((i + 1) % WAVE_INTERVALS) + 1] - g
            slopes += g * g
            changes += d * d
        if slopes > 0.0:
            worst = max(worst, 1.25 * math.sqrt(changes / slopes) * WAVE_INTERVALS / (2.0 * PI))
    return worst


@kernel
def even_spacing(p, lv):
    """Rows of the balls' angles from ball 0, of their sizes and of the mask of spare lanes."""
    balls = p[P_BALLS]
    sizes = int(p[P_AT_OVERSIZE])
    for j in range(int(p[P_LANES])):
        place = j if j < balls else 0
        angle = 2.0 * PI * place / balls
        lv[L_PHI + j] = WAVE_INTERVALS * place / balls
        lv[L_COS + j] = math.cos(angle)
        lv[L_SIN + j] = math.sin(angle)
        lv[L_SIZES + j] = 0.5 * p[sizes + j]
        lv[L_MASK + j] = 1.0 if j < balls else 0.0


@kernel
def flat(p, c, lv, w):
    """Angles at the start, and races without waves under balls of one size."""
    stand(p, c, lv, 0.0, 0.0, 0.0, 0.0, w)
    for i in range(2 * _S):
        w[E_INNER * _S + i] = 0.0
        w[E_BEND * _S + i] = 0.0


@kernel
def start_condensed(p, u, s, w, t):
    """Start shared with level response: full's start, held values, then the rings' own equilibrium.

    Leaves that equilibrium in ``w[W_Y:]`` and the balls' places in ``w``; race heights are not applied.
    Status code.
    """
    status = start(p, u, s, w, t)
    if status != OK:
        return status
    lv = s[S_LEVEL : S_LEVEL + L_SIZE]
    status = hold(p, u, u[U_SPEED], s, w)
    if status != OK:
        return status
    c = s[S_C : S_C + C_SIZE]
    even_spacing(p, lv)
    lv[L_ORDER] = highest_order(p)
    for i in range(Y_SIZE):
        w[W_Y + i] = 0.0
    for i in range(N):
        w[W_Y + Y_Q + i] = s[S_Y + Y_Q + i]
    for j in range(_S):
        w[E_X * _S + j] = s[S_Y + j]
        w[E_R * _S + j] = s[S_Y + _S + j]
    flat(p, c, lv, w)
    if not at_rest(p, c, lv, u[U_SPEED], w):
        # no rest (no preload, no pull): the quasi-static place serves, the first steps do what follows
        for i in range(N):
            w[W_Y + Y_Q + i] = s[S_Y + Y_Q + i]
        for j in range(_S):
            w[E_X * _S + j] = s[S_Y + j]
            w[E_R * _S + j] = s[S_Y + _S + j]
    for i in range(N):
        lv[L_MEAN + i] = w[W_Y + Y_Q + i]
    if derivatives(p, c, lv, 0.0, u[U_SPEED], 0.0, w):
        # the trial state and the balls' places outlast the full evaluations in there only if kept
        for i in range(2 * _S):
            lv[L_X + i] = w[E_X * _S + i]
        add_damping(p, s, w)
        for i in range(2 * _S):
            w[E_X * _S + i] = lv[L_X + i]
        for i in range(Y_SIZE):
            w[W_Y + i] = 0.0
        for i in range(N):
            w[W_Y + Y_Q + i] = lv[L_MEAN + i]
        flat(p, c, lv, w)
    return OK


@kernel
def quasistatic_places(p, c, speed, w):
    """Rings and balls at the quasi-static equilibrium under all loads into the trial state; status code."""
    load = w[W_SCALARS + 8 : W_SCALARS + 13]
    tilt = w[W_SCALARS + 13 : W_SCALARS + 15]
    found = w[W_VEL : W_VEL + Q5_SIZE]
    carried = loads(p, c, load)
    status = find(p, c, speed, load, tilt, found, w)
    if status != OK:
        return status
    y = w[W_Y : W_Y + Y_SIZE]
    for i in range(Y_SIZE):
        y[i] = 0.0
    o = Y_Q + Q_OUTER
    y[o] = c[C_PRELOAD] / c[C_PEDESTAL_AXIAL]
    y[o + 1] = c[C_LOAD_Y] / c[C_PEDESTAL]
    y[o + 2] = carried / c[C_PEDESTAL]
    for i in range(2):
        y[o + 4 + i] = tilt[i]
        y[Y_Q + 3 + i] = tilt[i] + found[Q5_SHIFT + 3 + i]
    for i in range(3):
        y[Y_Q + i] = y[o + i] + found[Q5_SHIFT + i]
    place_balls(p, y, found, y[o], y[o + 1], y[o + 2])
    for j in range(_S):
        w[E_X * _S + j] = y[B_X * _S + j]
        w[E_R * _S + j] = y[B_R * _S + j]
    for i in range(Y_Q):
        y[i] = 0.0
    return OK


@kernel
def set_inputs(p, u, s, w, h):
    """Set conditions and speed ramp; True where what is held is out of date."""
    lv = s[S_LEVEL : S_LEVEL + L_SIZE]
    rate = (u[U_SPEED] - s[S_SPEED]) / h
    fresh = w[W_SCALARS + 16 : W_SCALARS + 16 + C_SIZE]
    conditions(p, u, 0.5 * (s[S_SPEED] + u[U_SPEED]), fresh)
    # a ramp that goes on as before also leaves the speed that all was found at
    changed = rate != s[S_SPEED_RATE] or u[U_SPEED] != s[S_SPEED]
    for i in range(C_SIZE):
        if fresh[i] != s[S_C + i]:
            changed = True
            s[S_C + i] = fresh[i]
    s[S_SPEED_RATE] = rate
    return changed and out_of_date(lv, fresh, u[U_SPEED])


@kernel
def advance(s, h):
    """Time, angle, speed and the sums of heat at the end of the step."""
    lv = s[S_LEVEL : S_LEVEL + L_SIZE]
    s[S_ANGLE] = wrap(s[S_ANGLE] + h * (s[S_SPEED] + 0.5 * h * s[S_SPEED_RATE]))
    s[S_SPEED] += h * s[S_SPEED_RATE]
    s[S_TIME] += h
    s[S_STEPS] += 1.0
    for i in range(3):
        s[S_HEAT_INNER + i] += h * lv[L_HEAT + i]
        s[S_WORK] += h * lv[L_HEAT + i]


@kernel
def emit(p, s, w, h, newmark):
    """Sound samples of the step ``h`` from the published state to the one now in ``lv``; publish that."""
    lv = s[S_LEVEL : S_LEVEL + L_SIZE]
    y = w[W_Y : W_Y + Y_SIZE]
    f = w[W_LAST : W_LAST + F_SIZE]
    for i in range(Y_SIZE):
        y[i] = s[S_Y + i]
    for i in range(F_SIZE):
        f[i] = 0.0
    publish(p, lv, s[S_SPEED] + h * s[S_SPEED_RATE], s[S_SPEED_RATE], newmark, y, f)
    # the interpolation needs angles that run on from the old ones
    turned = lv[L_RATIO] * h * (s[S_SPEED] + 0.5 * h * s[S_SPEED_RATE])
    for j in range(int(p[P_LANES])):
        y[B_TH * _S + j] = s[S_Y + B_TH * _S + j] + turned
    emit_samples(p, s, w, h)
    for j in range(int(p[P_LANES])):
        y[B_TH * _S + j] = wrap(y[B_TH * _S + j])
    for i in range(Y_SIZE):
        s[S_Y + i] = y[i]
    for i in range(F_SIZE):
        s[S_F + i] = f[i]
