"""The right-hand side: from positions and velocities to accelerations, power and heat."""

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import entry, inlined, kernel
from fmu_bearing.engine.layout import F, P, Q, W, X, Y
from fmu_bearing.engine.layout.sizes import STRIDE
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


@inlined
def react(lanes, balls, body, first, spin, last, w):
    """Generalised forces that each ball puts on one body; spare lanes put none.

    Force x, y, z into the rows of ``w`` from ``first`` on, the moment about the body's own axis into row
    ``spin``, the moments about y and z into the rows from ``last`` on.
    """
    force = W.FORCE + body * 6 * STRIDE
    pose = W.POSE + body * X.SIZE
    for j in range(lanes):
        live = -1.0 if j < balls else 0.0
        c = w[W.COS + j]
        s = w[W.SIN + j]
        fx = live * w[force + j]
        fr = live * w[force + STRIDE + j]
        ft = live * w[force + 2 * STRIDE + j]
        qx = w[pose + X.Q + j]
        qr = w[pose + X.Q + STRIDE + j]
        qt = w[pose + X.Q + 2 * STRIDE + j]
        mx = qr * ft - qt * fr + live * w[force + 3 * STRIDE + j]
        mr = qt * fx - qx * ft + live * w[force + 4 * STRIDE + j]
        mt = qx * fr - qr * fx + live * w[force + 5 * STRIDE + j]
        w[first + j] = fx
        w[first + STRIDE + j] = -s * fr - c * ft
        w[first + 2 * STRIDE + j] = c * fr - s * ft
        w[spin + j] = (
            mx * w[pose + X.N + j] + mr * w[pose + X.N + STRIDE + j] + mt * w[pose + X.N + 2 * STRIDE + j]
        )
        w[last + j] = -s * mr - c * mt
        w[last + STRIDE + j] = c * mr - s * mt


@inlined
def race_forces(p, c, y, lanes, race, turned, w):
    """Evaluate the forces between balls and one race, whose poses stand in ``w``; ``turned``: its angle.

    ``race`` has to be a literal: only with constant places do the loops become vector loops.
    """
    waves(p, c, y[Y.TH : Y.TH + STRIDE], lanes, race, turned, w)
    flexible = bends(p, race)
    if flexible:
        lean(p, lanes, race, w)
    normal(p, c, y, lanes, race, w)
    if flexible:
        slide(p, lanes, race, w)
    if p[P.BALL_WAVES] != 0.0:
        add_ball_waves(p, c, lanes, race, w)
    if p[P.TRACTION_LAW] == 0.0:
        traction(p, lanes, race, w)
    else:
        lubricated_traction(p, c, lanes, race, w)
    rolling(p, c, lanes, race, w)
    collect(p, c, lanes, race, w)
    if p[P.BALL_WAVES] != 0.0:
        ball_wave_forces(p, c, lanes, race, w)
    if flexible:
        press_modes(p, c, lanes, race, w)


@kernel
def inner_forces(p, c, y, angle, speed, w):
    """Evaluate what the balls feel from the inner ring and give back to it."""
    lanes = int(p[P.LANES])
    q = Y.Q0
    v = Y.V0
    relative_pose(
        p, y, lanes, 0, y[q], y[q + 1], y[q + 2], y[q + 3], y[q + 4],
        y[v], y[v + 1], y[v + 2], speed, y[v + 3], y[v + 4], w,
    )  # fmt: skip
    if bends(p, 0):
        move_groove(p, c, lanes, 0, speed, w)
    race_forces(p, c, y, lanes, 0, angle, w)
    react(lanes, int(p[P.BALLS]), 0, W.BODY, W.SHAFT, W.BODY + 3 * STRIDE, w)


@kernel
def outer_forces(p, c, y, w):
    """Evaluate what the balls feel from the outer ring and give back to it."""
    lanes = int(p[P.LANES])
    q = Y.Q0 + Q.OUTER
    v = Y.V0 + Q.OUTER
    relative_pose(
        p, y, lanes, 1, y[q], y[q + 1], y[q + 2], y[q + 4], y[q + 5],
        y[v], y[v + 1], y[v + 2], y[v + 3], y[v + 4], y[v + 5], w,
    )  # fmt: skip
    if bends(p, 1):
        move_groove(p, c, lanes, 1, y[v + 3], w)
    race_forces(p, c, y, lanes, 1, y[q + 3], w)
    react(
        lanes,
        int(p[P.BALLS]),
        1,
        W.BODY + Q.OUTER * STRIDE,
        W.BODY + (Q.OUTER + 3) * STRIDE,
        W.BODY + (Q.OUTER + 4) * STRIDE,
        w,
    )


@kernel
def cage_forces(p, c, y, w):
    """Evaluate what the balls feel from the cage and give back to it; zeros where there is none."""
    lanes = int(p[P.LANES])
    if p[P.CAGE] == 0.0:
        for i in range(6 * STRIDE):
            w[W.FORCE + 12 * STRIDE + i] = 0.0
            w[W.BODY + Q.CAGE * STRIDE + i] = 0.0
        for j in range(STRIDE):
            w[W.LOSS + 2 * STRIDE + j] = 0.0
        return
    q = Y.Q0 + Q.CAGE
    v = Y.V0 + Q.CAGE
    relative_pose(
        p, y, lanes, 2, y[q], y[q + 1], y[q + 2], y[q + 4], y[q + 5],
        y[v], y[v + 1], y[v + 2], y[v + 3], y[v + 4], y[v + 5], w,
    )  # fmt: skip
    pockets(p, c, y[Y.TH : Y.TH + STRIDE], lanes, y[q + 3], w)
    react(
        lanes,
        int(p[P.BALLS]),
        2,
        W.BODY + Q.CAGE * STRIDE,
        W.BODY + (Q.CAGE + 3) * STRIDE,
        W.BODY + (Q.CAGE + 4) * STRIDE,
        w,
    )


@kernel
def ball_forces(p, c, y, angle, speed, w):
    """Everything the balls feel from the bodies and give back to them; fills the rows of ``w``."""
    ball_angles(y, Y.TH, int(p[P.LANES]), w)
    inner_forces(p, c, y, angle, speed, w)
    outer_forces(p, c, y, w)
    cage_forces(p, c, y, w)


@kernel
def ball_accelerations(p, y, w, f):
    """Accelerations of the balls in the orbiting axes (rows of ``f``); the power lost to drag into ``w``."""
    lanes = int(p[P.LANES])
    balls = int(p[P.BALLS])
    weight = GRAVITY * p[P.BALL_MASS] if p[P.GRAVITY] != 0.0 else 0.0
    drag = p[P.DRAG_FACTOR] if p[P.DRAG] != 0.0 else 0.0
    gyro = 1.0 if p[P.GYROSCOPIC] != 0.0 else 0.0
    per_mass = 1.0 / p[P.BALL_MASS]
    per_inertia = 1.0 / p[P.BALL_INERTIA]
    pitch = p[P.PITCH_RADIUS]
    one = W.FORCE
    two = W.FORCE + 6 * STRIDE
    three = W.FORCE + 12 * STRIDE
    for j in range(lanes):
        om = y[Y.OM + j]
        vr = y[Y.VR + j]
        radius = pitch + y[Y.R + j]
        around = radius * om
        pull = drag * around * abs(around)
        fx = w[one + j] + w[two + j] + w[three + j]
        fr = w[one + STRIDE + j] + w[two + STRIDE + j] + w[three + STRIDE + j] - weight * w[W.COS + j]
        ft = w[one + 2 * STRIDE + j] + w[two + 2 * STRIDE + j] + w[three + 2 * STRIDE + j]
        ft += weight * w[W.SIN + j] - pull
        f[j] = fx * per_mass
        f[STRIDE + j] = fr * per_mass + radius * om * om
        f[2 * STRIDE + j] = (ft * per_mass - 2.0 * vr * om) / radius
        f[3 * STRIDE + j] = (
            w[one + 3 * STRIDE + j] + w[two + 3 * STRIDE + j] + w[three + 3 * STRIDE + j]
        ) * per_inertia
        f[4 * STRIDE + j] = (
            w[one + 4 * STRIDE + j] + w[two + 4 * STRIDE + j] + w[three + 4 * STRIDE + j]
        ) * per_inertia + gyro * om * y[Y.WT + j]
        f[5 * STRIDE + j] = (
            w[one + 5 * STRIDE + j] + w[two + 5 * STRIDE + j] + w[three + 5 * STRIDE + j]
        ) * per_inertia - gyro * om * y[Y.WR + j]
        w[W.LOSS + 3 * STRIDE + j] = pull * around if j < balls else 0.0
    if p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        w[W.LOSS + 3 * STRIDE] += spring_forces(p, y, f)


@kernel
def sum_rows(first, count, lanes, w, out, at):
    """Sum ``count`` rows of ``w`` over the lanes into ``out[at:]``, in four partial sums of fixed order."""
    for i in range(count):
        a = 0.0
        b = 0.0
        c = 0.0
        d = 0.0
        row = first + i * STRIDE
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
    lanes = int(p[P.LANES])
    sum_rows(W.BODY, Q.SIZE, lanes, w, f, F.BODY)
    sums = w[W.SCALARS + 48 : W.SCALARS + 56]
    sum_rows(W.SHAFT, 5, lanes, w, sums, 0)
    torque = -sums[0]
    # half of each contact's loss heats its ring, the balls' half goes to the oil with all that stirs it
    f[F.HEAT] = 0.5 * sums[1]
    f[F.HEAT + 1] = 0.5 * sums[2]
    f[F.HEAT + 2] = 0.5 * (sums[1] + sums[2]) + sums[3] + sums[4]
    f[F.TORQUE] = torque
    f[F.WORK] = 0.0
    body_equations(p, c, y, angle, speed, speed_rate, w, f)
    if p[P.MODES] != 0.0:
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
    for j in range(int(p[P.BALLS])):
        wx = y[Y.WX + j]
        wr = y[Y.WR + j]
        wt = y[Y.WT + j]
        total += wx * wx + wr * wr + wt * wt
    return total
