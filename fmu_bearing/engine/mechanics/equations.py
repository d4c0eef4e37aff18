"""The right-hand side: from positions and velocities to accelerations, power and heat."""

from fmu_bearing.engine.jit import entry, kernel
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
    W_SIN,
    X_N,
    X_Q,
    Y_Q,
    Y_V,
)
from fmu_bearing.engine.mechanics.ball_waves import add_ball_waves, ball_wave_forces
from fmu_bearing.engine.mechanics.bodies import body_equations
from fmu_bearing.engine.mechanics.cage import pockets
from fmu_bearing.engine.mechanics.pose import relative_pose
from fmu_bearing.engine.mechanics.race import collect, normal, rolling, traction, waves
from fmu_bearing.engine.mechanics.springs import spring_forces
from fmu_bearing.engine.mechanics.traction import lubricated_traction
from fmu_bearing.engine.mechanics.trigonometry import ball_angles

_S = STRIDE


@kernel
def react(lanes, body, first, spins, w):
    """Generalised forces that each ball puts on one body, into the rows of ``W_G`` from ``first`` on.

    Order: force x, y, z, moment about the body's own axis (only if ``spins``), moment y, z.
    """
    force = (W_FORCE + body * 6) * _S
    pose = (W_POSE + body * POSE_ROWS) * _S
    out = (W_G + first) * _S
    last = 4 if spins else 3
    for j in range(lanes):
        c = w[W_COS * _S + j]
        s = w[W_SIN * _S + j]
        fx = -w[force + j]
        fr = -w[force + _S + j]
        ft = -w[force + 2 * _S + j]
        qx = w[pose + X_Q * _S + j]
        qr = w[pose + (X_Q + 1) * _S + j]
        qt = w[pose + (X_Q + 2) * _S + j]
        mx = qr * ft - qt * fr - w[force + 3 * _S + j]
        mr = qt * fx - qx * ft - w[force + 4 * _S + j]
        mt = qx * fr - qr * fx - w[force + 5 * _S + j]
        w[out + j] = fx
        w[out + _S + j] = -s * fr - c * ft
        w[out + 2 * _S + j] = c * fr - s * ft
        # for the inner ring this row is overwritten by the moment about y just below
        w[out + 3 * _S + j] = (
            mx * w[pose + X_N * _S + j]
            + mr * w[pose + (X_N + 1) * _S + j]
            + mt * w[pose + (X_N + 2) * _S + j]
        )
        w[out + last * _S + j] = -s * mr - c * mt
        w[out + (last + 1) * _S + j] = c * mr - s * mt


@kernel
def shaft_moment(balls, w):
    """Moment of all balls on the inner ring about its own axis (N m), which the drive must balance."""
    pose = W_POSE * _S
    force = W_FORCE * _S
    total = 0.0
    for j in range(balls):
        fx = -w[force + j]
        fr = -w[force + _S + j]
        ft = -w[force + 2 * _S + j]
        qx = w[pose + X_Q * _S + j]
        qr = w[pose + (X_Q + 1) * _S + j]
        qt = w[pose + (X_Q + 2) * _S + j]
        total += (qr * ft - qt * fr - w[force + 3 * _S + j]) * w[pose + X_N * _S + j]
        total += (qt * fx - qx * ft - w[force + 4 * _S + j]) * w[pose + (X_N + 1) * _S + j]
        total += (qx * fr - qr * fx - w[force + 5 * _S + j]) * w[pose + (X_N + 2) * _S + j]
    return total


@kernel
def ball_forces(p, c, y, angle, speed, w):
    """Everything the balls feel from the bodies and give back to them; fills the rows of ``w``."""
    lanes = int(p[P_LANES])
    th = B_TH * _S
    ball_angles(y, th, lanes, w)
    q = Y_Q
    v = Y_V
    turning = y[th : th + _S]
    relative_pose(
        p, y, lanes, 0, y[q], y[q + 1], y[q + 2], y[q + 3], y[q + 4],
        y[v], y[v + 1], y[v + 2], speed, y[v + 3], y[v + 4], w,
    )  # fmt: skip
    q += Q_OUTER
    v += Q_OUTER
    relative_pose(
        p, y, lanes, 1, y[q], y[q + 1], y[q + 2], y[q + 4], y[q + 5],
        y[v], y[v + 1], y[v + 2], y[v + 3], y[v + 4], y[v + 5], w,
    )  # fmt: skip
    for race in range(2):
        waves(p, c, turning, lanes, race, angle if race == 0 else y[q + 3], w)
        normal(p, c, y, lanes, race, w)
        if p[P_BALL_WAVES] != 0.0:
            add_ball_waves(p, c, lanes, race, w)
        if p[P_TRACTION_LAW] == 0.0:
            traction(p, lanes, race, w)
        else:
            lubricated_traction(p, c, lanes, race, w)
        rolling(p, c, lanes, race, w)
        collect(c, lanes, race, w)
        if p[P_BALL_WAVES] != 0.0:
            ball_wave_forces(c, lanes, race, w)
    react(lanes, 0, 0, False, w)
    react(lanes, 1, Q_OUTER, True, w)
    if p[P_CAGE] != 0.0:
        q = Y_Q + Q_CAGE
        v = Y_V + Q_CAGE
        relative_pose(
            p, y, lanes, 2, y[q], y[q + 1], y[q + 2], y[q + 4], y[q + 5],
            y[v], y[v + 1], y[v + 2], y[v + 3], y[v + 4], y[v + 5], w,
        )  # fmt: skip
        pockets(p, c, turning, lanes, y[q + 3], w)
        react(lanes, 2, Q_CAGE, True, w)


@kernel
def ball_accelerations(p, y, w, f):
    """Accelerations of the balls in the orbiting axes (rows of ``f``); returns the power lost to drag (W)."""
    lanes = int(p[P_LANES])
    balls = int(p[P_BALLS])
    caged = p[P_CAGE] != 0.0
    weight = GRAVITY * p[P_BALL_MASS] if p[P_GRAVITY] != 0.0 else 0.0
    drag = p[P_DRAG_FACTOR] if p[P_DRAG] != 0.0 else 0.0
    gyro = 1.0 if p[P_GYROSCOPIC] != 0.0 else 0.0
    per_mass = 1.0 / p[P_BALL_MASS]
    per_inertia = 1.0 / p[P_BALL_INERTIA]
    pitch = p[P_PITCH_RADIUS]
    one = W_FORCE * _S
    two = (W_FORCE + 6) * _S
    three = (W_FORCE + 12) * _S
    if not caged:
        for i in range(6 * _S):
            w[three + i] = 0.0
    lost = 0.0
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
        if j < balls:
            lost += pull * around
    if p[P_SPRINGS] != 0.0 and not caged:
        lost += spring_forces(p, y, f)
    return lost


@kernel
def sum_rows(first, count, balls, w, out, at):
    """Sum ``count`` rows of ``w`` over the balls, in index order, into ``out[at:]``."""
    for i in range(count):
        total = 0.0
        for j in range(balls):
            total += w[(first + i) * _S + j]
        out[at + i] = total


@entry
def right_hand_side(p, c, y, angle, speed, speed_rate, w, f):
    """Accelerations, power, heat and shaft torque at one state.

    ``p`` parameters, ``c`` conditions, ``y`` positions and velocities, ``angle``/``speed``/``speed_rate`` of
    the inner ring (rad, rad/s, rad/s2); ``w`` work space; ``f`` result (see ``layout``). SI units.
    """
    ball_forces(p, c, y, angle, speed, w)
    balls = int(p[P_BALLS])
    drag_loss = ball_accelerations(p, y, w, f)
    sum_rows(W_G, N_BODY, balls, w, f, F_G)
    torque = -shaft_moment(balls, w)
    losses = f[F_HEAT : F_HEAT + 3]
    inner = 0.0
    outer = 0.0
    pocket = 0.0
    for j in range(balls):
        inner += w[W_LOSS * _S + j]
        outer += w[(W_LOSS + 1) * _S + j]
        if p[P_CAGE] != 0.0:
            pocket += w[(W_LOSS + 2) * _S + j]
    # half of each contact's loss heats its ring, the balls' half goes to the oil with all that stirs it
    losses[0] = 0.5 * inner
    losses[1] = 0.5 * outer
    losses[2] = 0.5 * (inner + outer) + pocket + drag_loss
    f[F_TORQUE] = torque
    f[F_WORK] = 0.0
    body_equations(p, c, y, angle, speed, speed_rate, w, f)


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
