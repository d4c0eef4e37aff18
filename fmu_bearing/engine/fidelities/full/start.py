"""The state at initialisation: quasi-static under preload, radial loads, weights and misalignment.

Rings rest on their springs, bent by their loads where they are flexible; each ball has its own place, orbit
and spin.
"""

import math

from fmu_bearing.engine.fidelities.full.fast.blocks import begin
from fmu_bearing.engine.fidelities.full.progress import show_axes, total_energy
from fmu_bearing.engine.fidelities.full.settle import around, settle
from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_TH,
    B_VR,
    B_VX,
    B_WR,
    B_WT,
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
    P_RIGID,
    PI,
    Q5_OM,
    Q5_R,
    Q5_SHIFT,
    Q5_SIZE,
    Q5_WR,
    Q5_WX,
    Q5_X,
    Q_CAGE,
    Q_OUTER,
    S_AXES,
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
    S_PLACE,
    S_SPEED,
    S_SPEED_RATE,
    S_START,
    S_STEP,
    S_TIME,
    S_Y,
    STRIDE,
    TOO_SOFT,
    U_PRELOAD,
    U_SPEED,
    W_MOTION,
    W_SCALARS,
    W_VEL,
    Y_Q,
    Y_SIZE,
    Y_V,
)
from fmu_bearing.engine.mechanics.ball_waves import first_axes
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.statics.mounted import mounted_equilibrium
from fmu_bearing.engine.statics.rigid_preload import rigid_start
from fmu_bearing.engine.statics.spin_balance import balance_spins

_S = STRIDE
_FAR = 0.3  # of the pitch radius: beyond it the angles of pockets and waves, series in it, lose a micrometre


@kernel
def loads(p, c, load):
    """Set the loads on the inner ring with its weight (N, N m); return the pedestal's load in z (N)."""
    load[0] = c[C_PRELOAD]
    load[1] = c[C_LOAD_Y]
    load[2] = c[C_LOAD_Z]
    load[3] = 0.0
    load[4] = 0.0
    carried = load[2]
    if p[P_GRAVITY] != 0.0:
        load[2] -= GRAVITY * p[P_INNER_MASS]
        carried = load[2] - GRAVITY * (p[P_OUTER_MASS] + p[P_BALLS] * p[P_BALL_MASS])
        if p[P_CAGE] != 0.0:
            carried -= GRAVITY * p[P_CAGE_MASS]
    return carried


@kernel
def find(p, c, speed, load, tilt, found, w):
    """Equilibrium on the pedestal; status code.

    A ring that hangs on a few balls at speed, with no axial load, may have none that can be found: then
    one with a little axial load stands in, a start from which such a ring sets itself moving anyway.
    """
    status = mounted_equilibrium(p, c, speed, load, 1.0, tilt, found, w)
    if status != OK:
        load[0] += 1.0 + 0.05 * (abs(load[0]) + abs(load[1]) + abs(load[2]))
        status = mounted_equilibrium(p, c, speed, load, 1.0, tilt, found, w)
    return status


@kernel
def place_balls(p, y, found, x_outer, y_outer, z_outer):
    """Balls about the displaced outer ring, each in its own equilibrium; spare lanes copy the first.

    The first ball is at 12 o'clock. Under radial load or tilt a ball moves along and outwards as it orbits.
    """
    balls = p[P_BALLS]
    pitch = p[P_PITCH_RADIUS]
    for j in range(int(p[P_LANES])):
        place = j if j < balls else 0
        angle = 2.0 * PI * place / balls
        # the ball's place and velocity, from the axes about the outer ring's centre to the inertial ones
        radius = pitch + found[Q5_R + place]
        orbit = found[Q5_OM + place]
        outwards = orbit * around(p, found, Q5_R, place)
        yb = y_outer - radius * math.sin(angle)
        zb = z_outer + radius * math.cos(angle)
        apart = math.sqrt(yb * yb + zb * zb)
        c = (zb * math.cos(angle) - yb * math.sin(angle)) / apart
        s = (-yb * math.cos(angle) - zb * math.sin(angle)) / apart
        y[B_X * _S + j] = found[Q5_X + place] + x_outer
        y[B_TH * _S + j] = angle + math.atan2(s, c)
        y[B_R * _S + j] = apart - pitch
        y[B_VX * _S + j] = orbit * around(p, found, Q5_X, place)
        y[B_VR * _S + j] = outwards * c + radius * orbit * s
        y[B_OM * _S + j] = (radius * orbit * c - outwards * s) / apart
        y[B_WX * _S + j] = found[Q5_WX + place]
        y[B_WR * _S + j] = found[Q5_WR + place] * c
        y[B_WT * _S + j] = -found[Q5_WR + place] * s


@kernel
def place_cage(p, y, found, x_outer):
    """Cage about the inner ring, in the plane of the balls and with their mean orbit speed."""
    balls = p[P_BALLS]
    k = Y_Q + Q_CAGE
    y[k] = x_outer
    y[k + 1] = y[Y_Q + 1]
    y[k + 2] = y[Y_Q + 2]
    for j in range(int(balls)):
        angle = 2.0 * PI * j / balls
        x = found[Q5_X + j] / balls
        y[k] += x
        y[k + 4] += 2.0 * x * math.cos(angle) / p[P_PITCH_RADIUS]
        y[k + 5] += 2.0 * x * math.sin(angle) / p[P_PITCH_RADIUS]
        y[Y_V + Q_CAGE + 3] += found[Q5_OM + j] / balls


@inlined
def start(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    for i in range(s.size):
        s[i] = 0.0
    for i in range(W_MOTION):
        w[i] = 0.0
    c = s[S_C : S_C + C_SIZE]
    conditions(p, u, u[U_SPEED], c)
    load = w[W_SCALARS + 8 : W_SCALARS + 13]
    tilt = w[W_SCALARS + 13 : W_SCALARS + 15]
    found = w[W_VEL : W_VEL + Q5_SIZE]
    if p[P_RIGID] != 0.0:
        status = rigid_start(p, u, c, s, w, found)
        if status != OK:
            return status
    carried = loads(p, c, load)
    status = find(p, c, u[U_SPEED], load, tilt, found, w)
    if status != OK:
        return status
    y = s[S_Y : S_Y + Y_SIZE]
    o = Y_Q + Q_OUTER
    y[o] = c[C_PRELOAD] / c[C_PEDESTAL_AXIAL]
    y[o + 1] = c[C_LOAD_Y] / c[C_PEDESTAL]
    y[o + 2] = carried / c[C_PEDESTAL]
    if abs(y[o + 1]) + abs(y[o + 2]) > _FAR * p[P_PITCH_RADIUS]:
        return TOO_SOFT
    for i in range(2):
        y[o + 4 + i] = tilt[i]
        y[Y_Q + 3 + i] = tilt[i] + found[Q5_SHIFT + 3 + i]
    for i in range(3):
        y[Y_Q + i] = y[o + i] + found[Q5_SHIFT + i]
    if p[P_RIGID] != 0.0:
        y[Y_Q] = s[S_PLACE]
        c[C_PRELOAD] = u[U_PRELOAD]
    place_balls(p, y, found, y[o], y[o + 1], y[o + 2])
    if p[P_CAGE] != 0.0:
        place_cage(p, y, found, y[o])
    first_axes(p, s[S_AXES:S_JAC])
    show_axes(p, s, w)
    settle(p, c, y, 0.0, u[U_SPEED], s, w)
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
    summarise(p, s, w)
    for i in range(3):
        s[S_MEAN_INNER + i] = s[S_F + F_HEAT + i]
    return OK
