"""The state at initialisation: quasi-static under preload, radial loads, weights and misalignment.

Rings rest on their springs, bent by their loads where they are flexible; each ball has its own place, orbit
and spin.
"""

import math

from fmu_bearing.engine.constants import GRAVITY, PI
from fmu_bearing.engine.fidelities.full.fast.blocks import begin
from fmu_bearing.engine.fidelities.full.progress import show_axes, total_energy
from fmu_bearing.engine.fidelities.full.settle import around, settle
from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import EQ, C, F, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.ball_waves import first_axes
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.statics.mounted import mounted_equilibrium
from fmu_bearing.engine.statics.rigid_preload import rigid_start
from fmu_bearing.engine.statics.spin_balance import balance_spins
from fmu_bearing.engine.status import OK, TOO_SOFT

_FAR = 0.3  # of the pitch radius: beyond it the angles of pockets and waves, series in it, lose a micrometre


@kernel
def loads(p, c, load):
    """Set the loads on the inner ring with its weight (N, N m); return the pedestal's load in z (N)."""
    load[0] = c[C.PRELOAD]
    load[1] = c[C.LOAD_Y]
    load[2] = c[C.LOAD_Z]
    load[3] = 0.0
    load[4] = 0.0
    carried = load[2]
    if p[P.GRAVITY] != 0.0:
        load[2] -= GRAVITY * p[P.INNER_MASS]
        carried = load[2] - GRAVITY * (p[P.OUTER_MASS] + p[P.BALLS] * p[P.BALL_MASS])
        if p[P.CAGE] != 0.0:
            carried -= GRAVITY * p[P.CAGE_MASS]
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
    balls = p[P.BALLS]
    pitch = p[P.PITCH_RADIUS]
    for j in range(int(p[P.LANES])):
        place = j if j < balls else 0
        angle = 2.0 * PI * place / balls
        # the ball's place and velocity, from the axes about the outer ring's centre to the inertial ones
        radius = pitch + found[EQ.R + place]
        orbit = found[EQ.OM + place]
        outwards = orbit * around(p, found, EQ.R, place)
        yb = y_outer - radius * math.sin(angle)
        zb = z_outer + radius * math.cos(angle)
        apart = math.sqrt(yb * yb + zb * zb)
        c = (zb * math.cos(angle) - yb * math.sin(angle)) / apart
        s = (-yb * math.cos(angle) - zb * math.sin(angle)) / apart
        y[Y.X + j] = found[EQ.X + place] + x_outer
        y[Y.TH + j] = angle + math.atan2(s, c)
        y[Y.R + j] = apart - pitch
        y[Y.VX + j] = orbit * around(p, found, EQ.X, place)
        y[Y.VR + j] = outwards * c + radius * orbit * s
        y[Y.OM + j] = (radius * orbit * c - outwards * s) / apart
        y[Y.WX + j] = found[EQ.WX + place]
        y[Y.WR + j] = found[EQ.WR + place] * c
        y[Y.WT + j] = -found[EQ.WR + place] * s


@kernel
def place_cage(p, y, found, x_outer):
    """Cage about the inner ring, in the plane of the balls and with their mean orbit speed."""
    balls = p[P.BALLS]
    k = Y.Q0 + Q.CAGE
    y[k] = x_outer
    y[k + 1] = y[Y.Q0 + 1]
    y[k + 2] = y[Y.Q0 + 2]
    for j in range(int(balls)):
        angle = 2.0 * PI * j / balls
        x = found[EQ.X + j] / balls
        y[k] += x
        y[k + 4] += 2.0 * x * math.cos(angle) / p[P.PITCH_RADIUS]
        y[k + 5] += 2.0 * x * math.sin(angle) / p[P.PITCH_RADIUS]
        y[Y.V0 + Q.CAGE + 3] += found[EQ.OM + j] / balls


@inlined
def start(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    for i in range(s.size):
        s[i] = 0.0
    for i in range(W.MOTION):
        w[i] = 0.0
    c = s[S.C : S.C + C.SIZE]
    conditions(p, u, u[U.SPEED], c)
    load = w[W.SCALARS + 8 : W.SCALARS + 13]
    tilt = w[W.SCALARS + 13 : W.SCALARS + 15]
    found = w[W.VEL : W.VEL + EQ.SIZE]
    if p[P.RIGID] != 0.0:
        status = rigid_start(p, u, c, s, w, found)
        if status != OK:
            return status
    carried = loads(p, c, load)
    status = find(p, c, u[U.SPEED], load, tilt, found, w)
    if status != OK:
        return status
    y = s[S.Y : S.Y + Y.SIZE]
    o = Y.Q0 + Q.OUTER
    y[o] = c[C.PRELOAD] / c[C.PEDESTAL_AXIAL]
    y[o + 1] = c[C.LOAD_Y] / c[C.PEDESTAL]
    y[o + 2] = carried / c[C.PEDESTAL]
    if abs(y[o + 1]) + abs(y[o + 2]) > _FAR * p[P.PITCH_RADIUS]:
        return TOO_SOFT
    for i in range(2):
        y[o + 4 + i] = tilt[i]
        y[Y.Q0 + 3 + i] = tilt[i] + found[EQ.SHIFT + 3 + i]
    for i in range(3):
        y[Y.Q0 + i] = y[o + i] + found[EQ.SHIFT + i]
    if p[P.RIGID] != 0.0:
        y[Y.Q0] = s[S.PLACE]
        c[C.PRELOAD] = u[U.PRELOAD]
    place_balls(p, y, found, y[o], y[o + 1], y[o + 2])
    if p[P.CAGE] != 0.0:
        place_cage(p, y, found, y[o])
    first_axes(p, s[S.AXES : S.JAC])
    show_axes(p, s, w)
    settle(p, c, y, 0.0, u[U.SPEED], s, w)
    balance_spins(p, c, y, 0.0, u[U.SPEED], w, s[S.JAC : S.FAC])
    if p[P.CAGE] != 0.0:
        orbit = 0.0
        for j in range(int(p[P.BALLS])):
            orbit += y[Y.OM + j] / p[P.BALLS]
        y[Y.V0 + Q.CAGE + 3] = orbit
    s[S.TIME] = t
    s[S.START] = t
    s[S.SPEED] = u[U.SPEED]
    s[S.SPEED_RATE] = 0.0
    s[S.STEP] = min(2e-6, p[P.MAX_STEP])
    s[S.FACTOR_STEP] = 0.0
    s[S.JACOBIAN_TIME] = -1e300
    s[S.CONTRACTION] = 0.1
    begin(s, t)
    s[S.JACOBIANS] = 0.0
    s[S.ENERGY_START] = total_energy(p, s, w)
    s[S.ENERGY_NOW] = s[S.ENERGY_START]
    summarise(p, s, w)
    for i in range(3):
        s[S.MEAN_HEAT + i] = s[S.F + F.HEAT + i]
    return OK
