"""The state at initialisation: quasi-static under the preload, rings at rest on their springs."""

import math

from fmu_bearing.engine.fast import begin
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_TH,
    B_WR,
    B_WX,
    B_X,
    C_LOAD_Y,
    C_LOAD_Z,
    C_PEDESTAL,
    C_PEDESTAL_AXIAL,
    C_PRELOAD,
    C_SIZE,
    F_HEAT,
    GRAVITY,
    OK,
    P_BALL_MASS,
    P_BALLS,
    P_CAGE,
    P_CAGE_MASS,
    P_GRAVITY,
    P_INNER_MASS,
    P_LANES,
    P_MAX_STEP,
    P_OUTER_MASS,
    P_PITCH_RADIUS,
    PI,
    Q_CAGE,
    Q_OUTER,
    S_C,
    S_CONTRACTION,
    S_ENERGY_NOW,
    S_ENERGY_START,
    S_F,
    S_FAC,
    S_FACTOR_STEP,
    S_JAC,
    S_JACOBIAN_TIME,
    S_JACOBIANS,
    S_MEAN_INNER,
    S_SPEED,
    S_SPEED_RATE,
    S_START,
    S_STEP,
    S_TIME,
    S_Y,
    STRIDE,
    U_SPEED,
    W_MOTION,
    W_SCALARS,
    Y_Q,
    Y_SIZE,
    Y_V,
)
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.progress import total_energy
from fmu_bearing.engine.solvers.quasistatic import quasistatic, stiffness_matrix
from fmu_bearing.engine.solvers.spin_balance import balance_spins

_S = STRIDE


@kernel
def place_balls(p, y, found, x_outer, y_outer, z_outer):
    """Balls evenly spaced about the displaced outer ring, the first at 12 o'clock; spare lanes copy it."""
    balls = p[P_BALLS]
    pitch = p[P_PITCH_RADIUS]
    for j in range(int(p[P_LANES])):
        place = j if j < balls else 0
        y[B_X * _S + j] = found[1] + x_outer
        angle = 2.0 * PI * place / balls
        along = math.cos(angle) * z_outer - math.sin(angle) * y_outer
        across = -math.cos(angle) * y_outer - math.sin(angle) * z_outer
        y[B_TH * _S + j] = angle + across / pitch
        y[B_R * _S + j] = found[2] + along
        y[B_OM * _S + j] = found[3]
        y[B_WX * _S + j] = found[4]
        y[B_WR * _S + j] = found[5]


@kernel
def start(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    for i in range(s.size):
        s[i] = 0.0
    for i in range(W_MOTION):
        w[i] = 0.0
    c = s[S_C : S_C + C_SIZE]
    conditions(p, u, u[U_SPEED], c)
    found = w[W_SCALARS + 8 : W_SCALARS + 16]
    status = quasistatic(p, c, u[U_SPEED], found)
    if status != OK:
        return status
    _, radial, _, _ = stiffness_matrix(p, c, found)
    y = s[S_Y : S_Y + Y_SIZE]
    x_outer = c[C_PRELOAD] / c[C_PEDESTAL_AXIAL]
    inner_z = c[C_LOAD_Z]
    outer_z = inner_z
    if p[P_GRAVITY] != 0.0:
        inner_z -= GRAVITY * p[P_INNER_MASS]
        outer_z = inner_z - GRAVITY * (p[P_OUTER_MASS] + p[P_BALLS] * p[P_BALL_MASS])
        if p[P_CAGE] != 0.0:
            outer_z -= GRAVITY * p[P_CAGE_MASS]
    o = Y_Q + Q_OUTER
    y[o] = x_outer
    y[o + 1] = c[C_LOAD_Y] / c[C_PEDESTAL]
    y[o + 2] = outer_z / c[C_PEDESTAL]
    y[Y_Q] = x_outer + found[0]
    if radial > 0.0:
        # sag of the inner ring, bounded where a soft contact would put it out of the linear range
        y[Y_Q + 1] = y[o + 1] + min(max(c[C_LOAD_Y] / radial, -1e-6), 1e-6)
        y[Y_Q + 2] = y[o + 2] + min(max(inner_z / radial, -1e-6), 1e-6)
    place_balls(p, y, found, x_outer, y[o + 1], y[o + 2])
    k = Y_Q + Q_CAGE
    if p[P_CAGE] != 0.0:
        y[k] = found[1] + x_outer
        y[k + 1] = y[Y_Q + 1]
        y[k + 2] = y[Y_Q + 2]
        y[Y_V + Q_CAGE + 3] = found[3]
    balance_spins(p, c, y, 0.0, u[U_SPEED], w, s[S_JAC:S_FAC])
    if p[P_CAGE] != 0.0:
        orbit = 0.0
        for j in range(int(p[P_BALLS])):
            orbit += y[B_OM * _S + j] / p[P_BALLS]
        y[Y_V + Q_CAGE + 3] = orbit
    s[S_TIME] = t
    s[S_START] = t
    s[S_SPEED] = u[U_SPEED]
    s[S_SPEED_RATE] = 0.0
    s[S_STEP] = min(2e-6, p[P_MAX_STEP])
    s[S_FACTOR_STEP] = 0.0
    s[S_JACOBIAN_TIME] = -1e300
    s[S_CONTRACTION] = 0.1
    begin(s, t)
    s[S_JACOBIANS] = 0.0
    s[S_ENERGY_START] = total_energy(p, s, w)
    s[S_ENERGY_NOW] = s[S_ENERGY_START]
    for i in range(3):
        s[S_MEAN_INNER + i] = s[S_F + F_HEAT + i]
    return OK
