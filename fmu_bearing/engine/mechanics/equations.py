"""The right-hand side: from positions and velocities to accelerations, power and heat."""

from fmu_bearing.engine.jit import entry, inlined, kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_TH,
    B_VR,
    B_WR,
    B_WT,
    B_WX,
    F_G,
    F_HEAT,
    F_TORQUE,
    F_WORK,
    GRAVITY,
    N_BODY,
    P_BALL_INERTIA,
    P_BALL_MASS,
    P_BALL_WAVES,
    P_BALLS,
    P_CAGE,
    P_DRAG,
    P_DRAG_FACTOR,
    P_GRAVITY,
    P_GYROSCOPIC,
    P_LANES,
    P_MODES,
    P_PITCH_RADIUS,
    P_SPRINGS,
    P_TRACTION_LAW,
    POSE_ROWS,
    Q_CAGE,
    Q_OUTER,
    STRIDE,
    W_COS,
    W_FORCE,
    W_G,
    W_LOSS,
    W_POSE,
    W_SCALARS,
    W_SHAFT,
    W_SIN,
    X_N,
    X_Q,
    Y_Q,
    Y_V,
)
from fmu_bearing.engine.mechanics.ball_waves import add_ball_waves, ball_wave_forces
from fmu_bearing.engine.mechanics.bodies import body_equations
from fmu_bearing.engine.mechanics.cage import pockets
from fmu_bearing.engine.mechanics.flexure import (
    bends,
    flexure_equations,
    lean,
    move_groove,
    press_modes,
    slide,
)
from fmu_bearing.engine.mechanics.pose import relative_pose
from fmu_bearing.engine.mechanics.race import collect, normal, rolling, traction, waves
from fmu_bearing.engine.mechanics.springs import spring_forces
from fmu_bearing.engine.mechanics.traction import lubricated_traction
from fmu_bearing.engine.mechanics.trigonometry import ball_angles

_S = STRIDE


@inlined
def react(lanes, balls, body, first, spin, last, w):
    """Generalised forces that each ball puts on one body; spare lanes put none.

    Force x, y, z into the rows of ``w`` from ``first`` on, the moment about the body's own axis into row
    ``spin``, the moments about y and z into the rows from ``last`` on.
    """
    force = (W_FORCE + body * 6) * _S
    pose = (W_POSE + body * POSE_ROWS) * _S
    for j in range(lanes):
        live = -1.0 if j < balls else 0.0
        c = w[W_COS * _S + j]
        s = w[W_SIN * _S + j]
        fx = live * w[force + j]
        fr = live * w[force + _S + j]
        ft = live * w[force + 2 * _S + j]
        qx = w[pose + X_Q * _S + j]
        qr = w[pose + (X_Q + 1) * _S + j]
        qt = w[pose + (X_Q + 2) * _S + j]
        mx = qr * ft - qt * fr + live * w[force + 3 * _S + j]
        mr = qt * fx - qx * ft + live * w[force + 4 * _S + j]
        mt = qx * fr - qr * fx + live * w[force + 5 * _S + j]
        w[first * _S + j] = fx
        w[(first + 1) * _S + j] = -s * fr - c * ft
        w[(first + 2) * _S + j] = c * fr - s * ft
        w[spin * _S + j] = (
            mx * w[pose + X_N * _S + j]
            + mr * w[pose + (X_N + 1) * _S + j]
            + mt * w[pose + (X_N + 2) * _S + j]
        )
        w[last * _S + j] = -s * mr - c * mt
        w[(last + 1) * _S + j] = c * mr - s * mt


@inlined
def race_forces(p, c, y, lanes, race, turned, w):
    """Evaluate the forces between balls and one race, whose poses stand in ``w``; ``turned``: its angle.

    ``race`` has to be a literal: only with constant places do the loops become vector loops.
    """
    waves(p, c, y[B_TH * _S : (B_TH + 1) * _S], lanes, race, turned, w)
    flexible = bends(p, race)
    if flexible:
        lean(p, lanes, race, w)
    normal(p, c, y, lanes, race, w)
    if flexible:
        slide(p, lanes, race, w)
    if p[P_BALL_WAVES] != 0.0:
        add_ball_waves(p, c, lanes, race, w)
    if p[P_TRACTION_LAW] == 0.0:
        traction(p, lanes, race, w)
    else:
        lubricated_traction(p, c, lanes, race, w)
    rolling(p, c, lanes, race, w)
    collect(p, c, lanes, race, w)
    if p[P_BALL_WAVES] != 0.0:
        ball_wave_forces(p, c, lanes, race, w)
    if flexible:
        press_modes(p, c, lanes, race, w)


@kernel
def inner_forces(p, c, y, angle, speed, w):
    """Evaluate what the balls feel from the inner ring and give back to it."""
    lanes = int(p[P_LANES])
    q = Y_Q
    v = Y_V
    relative_pose(
        p, y, lanes, 0, y[q], y[q + 1], y[q + 2], y[q + 3], y[q + 4],
        y[v], y[v + 1], y[v + 2], speed, y[v + 3], y[v + 4], w,
    )  # fmt: skip
    if bends(p, 0):
        move_groove(p, c, lanes, 0, speed, w)
    race_forces(p, c, y, lanes, 0, angle, w)
    react(lanes, int(p[P_BALLS]), 0, W_G, W_SHAFT, W_G + 3, w)


@kernel
def outer_forces(p, c, y, w):
    """Evaluate what the balls feel from the outer ring and give back to it."""
    lanes = int(p[P_LANES])
    q = Y_Q + Q_OUTER
    v = Y_V + Q_OUTER
    relative_pose(
        p, y, lanes, 1, y[q], y[q + 1], y[q + 2], y[q + 4], y[q + 5],
        y[v], y[v + 1], y[v + 2], y[v + 3], y[v + 4], y[v + 5], w,
    )  # fmt: skip
    if bends(p, 1):
        move_groove(p, c, lanes, 1, y[v + 3], w)
    race_forces(p, c, y, lanes, 1, y[q + 3], w)
    react(lanes, int(p[P_BALLS]), 1, W_G + Q_OUTER, W_G + Q_OUTER + 3, W_G + Q_OUTER + 4, w)


@kernel
def cage_forces(p, c, y, w):
    """Evaluate what the balls feel from the cage and give back to it; zeros where there is none."""
    lanes = int(p[P_LANES])
    if p[P_CAGE] == 0.0:
        for i in range(6 * _S):
            w[(W_FORCE + 12) * _S + i] = 0.0
            w[(W_G + Q_CAGE) * _S + i] = 0.0
        for j in range(_S):
            w[(W_LOSS + 2) * _S + j] = 0.0
        return
    q = Y_Q + Q_CAGE
    v = Y_V + Q_CAGE
    relative_pose(
        p, y, lanes, 2, y[q], y[q + 1], y[q + 2], y[q + 4], y[q + 5],
        y[v], y[v + 1], y[v + 2], y[v + 3], y[v + 4], y[v + 5], w,
    )  # fmt: skip
    pockets(p, c, y[B_TH * _S : (B_TH + 1) * _S], lanes, y[q + 3], w)
    react(lanes, int(p[P_BALLS]), 2, W_G + Q_CAGE, W_G + Q_CAGE + 3, W_G + Q_CAGE + 4, w)


@kernel
def ball_forces(p, c, y, angle, speed, w):
    """Everything the balls feel from the bodies and give back to them; fills the rows of ``w``."""
    ball_angles(y, B_TH * _S, int(p[P_LANES]), w)
    inner_forces(p, c, y, angle, speed, w)
    outer_forces(p, c, y, w)
    cage_forces(p, c, y, w)


@kernel
def ball_accelerations(p, y, w, f):
    """Accelerations of the balls in the orbiting axes (rows of ``f``); the power lost to drag into ``w``."""
    lanes = int(p[P_LANES])
    balls = int(p[P_BALLS])
    weight = GRAVITY * p[P_BALL_MASS] if p[P_GRAVITY] != 0.0 else 0.0
    drag = p[P_DRAG_FACTOR] if p[P_DRAG] != 0.0 else 0.0
    gyro = 1.0 if p[P_GYROSCOPIC] != 0.0 else 0.0
    per_mass = 1.0 / p[P_BALL_MASS]
    per_inertia = 1.0 / p[P_BALL_INERTIA]
    pitch = p[P_PITCH_RADIUS]
    one = W_FORCE * _S
    two = (W_FORCE + 6) * _S
    three = (W_FORCE + 12) * _S
    for j in range(lanes):
        om = y[B_OM * _S + j]
        vr = y[B_VR * _S + j]
        radius = pitch + y[B_R * _S + j]
        around = radius * om
        pull = drag * around * abs(around)
        fx = w[one + j] + w[two + j] + w[three + j]
        fr = w[one + _S + j] + w[two + _S + j] + w[three + _S + j] - weight * w[W_COS * _S + j]
        ft = w[one + 2 * _S + j] + w[two + 2 * _S + j] + w[three + 2 * _S + j]
        ft += weight * w[W_SIN * _S + j] - pull
        f[j] = fx * per_mass
        f[_S + j] = fr * per_mass + radius * om * om
        f[2 * _S + j] = (ft * per_mass - 2.0 * vr * om) / radius
        f[3 * _S + j] = (w[one + 3 * _S + j] + w[two + 3 * _S + j] + w[three + 3 * _S + j]) * per_inertia
        f[4 * _S + j] = (
            w[one + 4 * _S + j] + w[two + 4 * _S + j] + w[three + 4 * _S + j]
        ) * per_inertia + gyro * om * y[B_WT * _S + j]
        f[5 * _S + j] = (
            w[one + 5 * _S + j] + w[two + 5 * _S + j] + w[three + 5 * _S + j]
        ) * per_inertia - gyro * om * y[B_WR * _S + j]
        w[(W_LOSS + 3) * _S + j] = pull * around if j < balls else 0.0
    if p[P_SPRINGS] != 0.0 and p[P_CAGE] == 0.0:
        w[(W_LOSS + 3) * _S] += spring_forces(p, y, f)


@kernel
def sum_rows(first, count, lanes, w, out, at):
    """Sum ``count`` rows of ``w`` over the lanes into ``out[at:]``, in four partial sums of fixed order."""
    for i in range(count):
        a = 0.0
        b = 0.0
        c = 0.0
        d = 0.0
        row = (first + i) * _S
        for k in range(lanes // 4):
            j = row + 4 * k
            a += w[j]
            b += w[j + 1]
            c += w[j + 2]
            d += w[j + 3]
        out[at + i] = (a + b) + (c + d)


@kernel
def add_up(p, c, y, angle, speed, speed_rate, w, f):
    """From the forces in the rows of ``w`` to the right-hand side ``f``."""
    ball_accelerations(p, y, w, f)
    lanes = int(p[P_LANES])
    sum_rows(W_G, N_BODY, lanes, w, f, F_G)
    sums = w[W_SCALARS + 48 : W_SCALARS + 56]
    sum_rows(W_SHAFT, 5, lanes, w, sums, 0)
    torque = -sums[0]
    # half of each contact's loss heats its ring, the balls' half goes to the oil with all that stirs it
    f[F_HEAT] = 0.5 * sums[1]
    f[F_HEAT + 1] = 0.5 * sums[2]
    f[F_HEAT + 2] = 0.5 * (sums[1] + sums[2]) + sums[3] + sums[4]
    f[F_TORQUE] = torque
    f[F_WORK] = 0.0
    body_equations(p, c, y, angle, speed, speed_rate, w, f)
    if p[P_MODES] != 0.0:
        flexure_equations(p, y, speed, speed_rate, w, f)


@entry
def right_hand_side(p, c, y, angle, speed, speed_rate, w, f):
    """Accelerations, power, heat and shaft torque at one state.

    ``p`` parameters, ``c`` conditions, ``y`` positions and velocities, ``angle``/``speed``/``speed_rate`` of
    the inner ring (rad, rad/s, rad/s2); ``w`` work space; ``f`` result (see ``layout``). SI units.
    """
    ball_forces(p, c, y, angle, speed, w)
    add_up(p, c, y, angle, speed, speed_rate, w, f)


@kernel
def kinetic_spin(p, y):
    """Sum over the balls of spin speed squared (rad2/s2); for the energy only."""
    total = 0.0
    for j in range(int(p[P_BALLS])):
        wx = y[B_WX * _S + j]
        wr = y[B_WR * _S + j]
        wt = y[B_WT * _S + j]
        total += wx * wx + wr * wr + wt * wt
    return total
