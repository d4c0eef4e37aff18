"""What the levels hold between changes of the inputs: cage speed, gyroscopic friction, torque and heats.

All come from one evaluation of the full right-hand side at the quasi-static point under the axial load
alone, with the balls' spins balanced and without imperfections. (Under a radial load the balls' own orbit
speeds differ, and before a cage has evened them out the same evaluation shows several times the settled
losses.) The torque is what puts in the heats: at that point the lands' drag still speeds up a cage that the
balls do not hold back yet, which would be 15 % more; level `full` settles at the heats. They are renewed when
the speed has moved by 1 % or a condition by 0.1 %; in between orbit and spins follow the speed, the
gyroscopic friction its square, and the heats stay (below 1 rad/s they go to zero with the speed squared). A
renewal costs some 30 evaluations of the full right-hand side with its Jacobian.
"""

from fmu_bearing.engine.fidelities.full.start import place_balls, place_cage
from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_WX,
    C_BALL_RADIUS,
    C_LOAD_Y,
    C_LOAD_Z,
    C_OVERSIZE_SCALE,
    C_PEDESTAL,
    C_PEDESTAL_AXIAL,
    C_PRELOAD,
    C_RACE_SIZE,
    C_RACES,
    C_SIZE,
    C_VISCOSITY,
    F_HEAT,
    F_SIZE,
    OK,
    P_BALL_INERTIA,
    P_BALLS,
    P_CAGE,
    P_GYROSCOPIC,
    P_LANES,
    P_RACE_CONTROL,
    Q5_OM,
    Q5_SHIFT,
    Q5_SIZE,
    Q5_WR,
    Q_CAGE,
    Q_OUTER,
    S_F,
    S_JAC,
    S_LEVEL,
    S_LOSS,
    S_Y,
    STRIDE,
    W_ACC,
    W_BLOCK_A,
    W_G,
    W_SCALARS,
    W_VEL,
    Y_Q,
    Y_SIZE,
    Y_V,
)
from fmu_bearing.engine.layout_condensed import (
    L_C,
    L_FOUND_SPEED,
    L_HEAT,
    L_PAIR_INNER,
    L_PAIR_OUTER,
    L_RATIO,
    L_SPIN,
    L_TORQUE,
    L_TWIST,
    L_Y,
)
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.statics.mounted import mounted_equilibrium
from fmu_bearing.engine.statics.spin_balance import balance_spins

_S = STRIDE
_STANDSTILL = 1.0  # rad/s: slower shafts are given the ratios of this speed


@inlined
def quasistatic_point(p, c, speed, y, w):
    """State ``y`` at the quasi-static point under the axial load in ``c``; orbit times spin r there.

    Returns ``(status, mean over the balls of orbit speed times spin about r, (rad/s)^2)``. The one place
    that knows the quasi-static kernel.
    """
    load = w[W_SCALARS + 8 : W_SCALARS + 13]
    tilt = w[W_SCALARS + 13 : W_SCALARS + 15]
    found = w[W_VEL : W_VEL + Q5_SIZE]
    for i in range(1, 5):
        load[i] = 0.0
    load[0] = c[C_PRELOAD]
    status = mounted_equilibrium(p, c, speed, load, 0.0, tilt, found, w)
    if status != OK:
        # as in `start`: a ring without axial load is given a little
        load[0] += 1.0 + 0.05 * abs(load[0])
        status = mounted_equilibrium(p, c, speed, load, 0.0, tilt, found, w)
    if status != OK:
        return status, 0.0
    for i in range(Y_SIZE):
        y[i] = 0.0
    o = Y_Q + Q_OUTER
    y[o] = c[C_PRELOAD] / c[C_PEDESTAL_AXIAL]
    for i in range(2):
        y[o + 4 + i] = tilt[i]
        y[Y_Q + 3 + i] = tilt[i] + found[Q5_SHIFT + 3 + i]
    for i in range(3):
        y[Y_Q + i] = y[o + i] + found[Q5_SHIFT + i]
    place_balls(p, y, found, y[o], y[o + 1], y[o + 2])
    if p[P_CAGE] != 0.0:
        place_cage(p, y, found, y[o])
    gyroscopic = 0.0
    balls = int(p[P_BALLS])
    for j in range(balls):
        gyroscopic += found[Q5_OM + j] * found[Q5_WR + j] / balls
    return OK, gyroscopic


@kernel
def summarise_held(p, s, y, f, w):
    """Losses by source at the held state ``y`` with its right-hand side ``f``; the state in ``s`` stays.

    A step's first sound sample is interpolated from what ``s`` was published with.
    """
    heat = s[S_F + F_HEAT + 2]
    s[S_F + F_HEAT + 2] = f[F_HEAT + 2]
    for j in range(_S):
        w[W_ACC + j] = s[S_Y + B_OM * _S + j]
        w[W_ACC + _S + j] = s[S_Y + B_R * _S + j]
        s[S_Y + B_OM * _S + j] = y[B_OM * _S + j]
        s[S_Y + B_R * _S + j] = y[B_R * _S + j]
    summarise(p, s, w)
    s[S_F + F_HEAT + 2] = heat
    for j in range(_S):
        s[S_Y + B_OM * _S + j] = w[W_ACC + j]
        s[S_Y + B_R * _S + j] = w[W_ACC + _S + j]


@kernel
def hold(p, u, speed, s, w):
    """Renew everything held at ``speed`` (rad/s) and the inputs ``u``; status code, old values on failure."""
    lv = s[S_LEVEL:]
    c = lv[L_C : L_C + C_SIZE]
    y = lv[L_Y : L_Y + Y_SIZE]
    turning = speed
    if abs(speed) < _STANDSTILL:
        turning = -_STANDSTILL if speed < 0.0 else _STANDSTILL
    conditions(p, u, speed, c)
    lv[L_FOUND_SPEED] = speed
    c[C_OVERSIZE_SCALE] = 0.0
    status, gyroscopic = quasistatic_point(p, c, turning, y, w)
    if status != OK:
        return status
    square = turning * turning
    pair = p[P_BALL_INERTIA] * gyroscopic / (c[C_BALL_RADIUS] * square)
    if p[P_GYROSCOPIC] == 0.0:
        pair = 0.0
    outer = 0.5
    if p[P_RACE_CONTROL] == 1.0:
        outer = 1.0
    elif p[P_RACE_CONTROL] == 2.0:
        outer = 0.0
    lv[L_PAIR_INNER] = (1.0 - outer) * pair
    lv[L_PAIR_OUTER] = outer * pair
    balance_spins(p, c, y, 0.0, turning, w, s[S_JAC:S_LEVEL])
    balls = int(p[P_BALLS])
    mean = 0.0
    for j in range(balls):
        mean += y[B_OM * _S + j] / balls
    lv[L_RATIO] = mean / turning
    if p[P_CAGE] != 0.0:
        y[Y_V + Q_CAGE + 3] = mean
    for j in range(int(p[P_LANES])):
        for i in range(3):
            lv[L_SPIN + i * _S + j] = y[(B_WX + i) * _S + j] / turning
    f = w[W_BLOCK_A : W_BLOCK_A + F_SIZE]
    right_hand_side(p, c, y, 0.0, turning, 0.0, w, f)
    summarise_held(p, s, y, f, w)
    share = speed / turning
    lv[L_TORQUE] = share * (f[F_HEAT] + f[F_HEAT + 1] + f[F_HEAT + 2]) / turning
    for i in range(3):
        lv[L_HEAT + i] = share * share * f[F_HEAT + i]
    for i in range(4):
        s[S_LOSS + i] *= share * share
    twist = 0.0
    for j in range(balls):
        twist += w[(W_G + Q_OUTER + 3) * _S + j]
    lv[L_TWIST] = share * twist
    return OK


@kernel
def out_of_date(lv, c, speed):
    """Whether speed or a condition has left the neighbourhood of the held values."""
    far = abs(speed - lv[L_FOUND_SPEED]) > 0.01 * abs(lv[L_FOUND_SPEED]) + 1e-3
    for i in (C_PRELOAD, C_LOAD_Y, C_LOAD_Z, C_VISCOSITY, C_PEDESTAL, C_BALL_RADIUS):
        if abs(c[i] - lv[L_C + i]) > 1e-3 * abs(lv[L_C + i]) + 1e-12:
            far = True
    for race in range(2):
        # groove circles and free distance move by micrometres: 1e-3 of a contact's approach
        for i in range(3):
            k = C_RACES + race * C_RACE_SIZE + i
            if abs(c[k] - lv[L_C + k]) > 1e-9:
                far = True
    return far
