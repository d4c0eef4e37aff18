"""The right-hand side: from positions and velocities to accelerations, power and heat."""

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, load, select, store, sum_lanes
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, P, Q, R, W, X, Y
from fmu_bearing.engine.mechanics.ball_waves import add_ball_waves, ball_wave_forces, has_wavy_balls
from fmu_bearing.engine.mechanics.bodies import body_equations
from fmu_bearing.engine.mechanics.cage import pocket_forces
from fmu_bearing.engine.mechanics.defects import add_defects, defect_forces, has_defects
from fmu_bearing.engine.mechanics.flexure import (
    add_groove_sliding,
    add_groove_slope,
    bends,
    flexure_equations,
    modal_forces,
    move_groove,
)
from fmu_bearing.engine.mechanics.pose import relative_pose
from fmu_bearing.engine.mechanics.race import (
    normal_contact,
    plain_traction,
    rolling_moment,
    sum_contact_forces,
    traction,
    waviness,
)
from fmu_bearing.engine.mechanics.springs import spring_forces
from fmu_bearing.engine.mechanics.traction import lubricated_traction
from fmu_bearing.engine.mechanics.trigonometry import ball_angles
from fmu_bearing.engine.mechanics.triples import added, cross, dot, scaled, three


@kernel
def body_reaction(lanes, balls, body, first, spin, last, w):
    """Generalised forces that each ball puts on one body; spare lanes put none.

    Force x, y, z into the rows of ``w`` from ``first`` on, the moment about the body's own axis into row
    ``spin``, the moments about y and z into the rows from ``last`` on.
    """
    force = W.FORCE + body * W.FORCE_SIZE
    pose = W.POSE + body * X.SIZE
    for j in range(0, lanes, FOUR):
        live = select(consecutive(j) < balls, -1.0, 0.0)
        c = load(w, W.COS + j)
        s = load(w, W.SIN + j)
        on_body = scaled(live, three(w, force + W.FX + j))
        turning = scaled(live, three(w, force + W.MX + j))
        about = added(cross(three(w, pose + X.Q + j), on_body), turning)
        fx, fr, ft = on_body
        mx, mr, mt = about
        store(w, first + j, fx)
        store(w, first + STRIDE + j, -s * fr - c * ft)
        store(w, first + 2 * STRIDE + j, c * fr - s * ft)
        store(w, spin + j, dot(about, three(w, pose + X.N + j)))
        store(w, last + j, -s * mr - c * mt)
        store(w, last + STRIDE + j, c * mr - s * mt)


@kernel
def inner_pose(p, c, y, speed, w):
    """Evaluate where the balls are in the inner ring."""
    lanes = int(p[P.LANES])
    q = Y.Q0
    v = Y.V0
    relative_pose(
        p, y, lanes, 0, y[q], y[q + Q.Y], y[q + Q.Z], y[q + Q.INNER_BY], y[q + Q.INNER_BZ],
        y[v], y[v + Q.Y], y[v + Q.Z], speed, y[v + Q.INNER_BY], y[v + Q.INNER_BZ], w,
    )  # fmt: skip
    if bends(p, 0):
        move_groove(p, c, lanes, 0, speed, w)


@kernel
def outer_pose(p, c, y, w):
    """Evaluate where the balls are in the outer ring."""
    lanes = int(p[P.LANES])
    q = Y.Q0 + Q.OUTER
    v = Y.V0 + Q.OUTER
    relative_pose(
        p, y, lanes, 1, y[q], y[q + Q.Y], y[q + Q.Z], y[q + Q.BY], y[q + Q.BZ],
        y[v], y[v + Q.Y], y[v + Q.Z], y[v + Q.TURN], y[v + Q.BY], y[v + Q.BZ], w,
    )  # fmt: skip
    if bends(p, 1):
        move_groove(p, c, lanes, 1, y[v + Q.TURN], w)


@kernel
def race_forces(p, c, y, lanes, race, turned, w):
    """Evaluate the forces between balls and one race, whose poses are in ``w``; ``turned``: its angle (rad).

    ``race`` has to be a literal: places are then constants.
    """
    waviness(p, c, y[Y.TH : Y.TH + STRIDE], lanes, race, turned, w)
    flexible = bends(p, race)
    if flexible:
        add_groove_slope(lanes, race, w)
    normal_contact(p, c, y, lanes, race, w)
    if flexible:
        add_groove_sliding(lanes, race, w)
    if has_wavy_balls(p, c):
        add_ball_waves(p, c, lanes, race, w)
    if has_defects(p, c):
        add_defects(p, c, y, lanes, race, turned, w)
    if plain_traction(p):
        traction(p, lanes, race, w)
    else:
        lubricated_traction(p, c, lanes, race, w)
    rolling_moment(p, c, lanes, race, w)
    sum_contact_forces(p, c, lanes, race, w)
    if has_wavy_balls(p, c):
        ball_wave_forces(p, lanes, race, w)
    if has_defects(p, c):
        defect_forces(p, c, lanes, race, w)
    if flexible:
        modal_forces(p, c, lanes, race, w)


@kernel
def inner_forces(p, c, y, angle, speed, w):
    """Evaluate what the balls feel from the inner ring and give back to it."""
    lanes = int(p[P.LANES])
    inner_pose(p, c, y, speed, w)
    race_forces(p, c, y, lanes, 0, angle, w)
    body_reaction(lanes, p[P.BALLS], 0, W.BODY, W.SHAFT, W.BODY + Q.INNER_BY * STRIDE, w)


@kernel
def outer_forces(p, c, y, w):
    """Evaluate what the balls feel from the outer ring and give back to it."""
    lanes = int(p[P.LANES])
    outer_pose(p, c, y, w)
    race_forces(p, c, y, lanes, 1, y[Y.Q0 + Q.OUTER + Q.TURN], w)
    rows = W.BODY + Q.OUTER * STRIDE
    body_reaction(lanes, p[P.BALLS], 1, rows, rows + Q.TURN * STRIDE, rows + Q.BY * STRIDE, w)


@kernel
def cage_forces(p, c, y, w):
    """Evaluate what the balls feel from the cage and give back to it; zeros where there is none."""
    lanes = int(p[P.LANES])
    if p[P.CAGE] == 0.0:
        for i in range(W.FORCE_SIZE):
            w[W.FORCE + 2 * W.FORCE_SIZE + i] = 0.0
            w[W.BODY + Q.CAGE * STRIDE + i] = 0.0
        for j in range(STRIDE):
            w[W.LOSS_CAGE + j] = 0.0
        return
    q = Y.Q0 + Q.CAGE
    v = Y.V0 + Q.CAGE
    relative_pose(
        p, y, lanes, 2, y[q], y[q + Q.Y], y[q + Q.Z], y[q + Q.BY], y[q + Q.BZ],
        y[v], y[v + Q.Y], y[v + Q.Z], y[v + Q.TURN], y[v + Q.BY], y[v + Q.BZ], w,
    )  # fmt: skip
    pocket_forces(p, c, y[Y.TH : Y.TH + STRIDE], lanes, y[q + Q.TURN], w)
    rows = W.BODY + Q.CAGE * STRIDE
    body_reaction(lanes, p[P.BALLS], 2, rows, rows + Q.TURN * STRIDE, rows + Q.BY * STRIDE, w)


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
    weight = GRAVITY * p[P.BALL_MASS] if p[P.GRAVITY] != 0.0 else 0.0
    drag = p[P.DRAG_FACTOR] if p[P.DRAG] != 0.0 else 0.0
    gyro = 1.0 if p[P.GYROSCOPIC] != 0.0 else 0.0
    per_mass = 1.0 / p[P.BALL_MASS]
    per_inertia = 1.0 / p[P.BALL_INERTIA]
    pitch = p[P.PITCH_RADIUS]
    one = W.FORCE
    two = W.FORCE + W.FORCE_SIZE
    last = W.FORCE + 2 * W.FORCE_SIZE
    for j in range(0, lanes, FOUR):
        om = load(y, Y.OM + j)
        radius = pitch + load(y, Y.R + j)
        around = radius * om
        pull = drag * around * abs(around)
        force = added(added(three(w, one + W.FX + j), three(w, two + W.FX + j)), three(w, last + W.FX + j))
        moment = added(added(three(w, one + W.MX + j), three(w, two + W.MX + j)), three(w, last + W.MX + j))
        fx, fr, ft = force
        mx, mr, mt = moment
        fr -= weight * load(w, W.COS + j)
        ft += weight * load(w, W.SIN + j) - pull
        store(f, F.X + j, fx * per_mass)
        store(f, F.R + j, fr * per_mass + radius * om * om)
        store(f, F.TH + j, (ft * per_mass - 2.0 * load(y, Y.VR + j) * om) / radius)
        store(f, F.WX + j, mx * per_inertia)
        store(f, F.WR + j, mr * per_inertia + gyro * om * load(y, Y.WT + j))
        store(f, F.WT + j, mt * per_inertia - gyro * om * load(y, Y.WR + j))
        store(w, W.LOSS_DRAG + j, select(consecutive(j) < p[P.BALLS], pull * around, 0.0))
    if p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        w[W.LOSS_DRAG] += spring_forces(p, y, w, f)


@kernel
def growth_power(p, c, w):
    """Power (W) of races that grow: their rates times the balls' elastic loads along the radius."""
    total = 0.0
    for race in range(2):
        rate = c[C.RACES + race * C.RACE_SIZE + C.GROWTH_RATE]
        if rate != 0.0:
            row = W.RACE + race * R.SIZE
            for j in range(int(p[P.BALLS])):
                total -= rate * w[row + R.ELASTIC + j] * w[row + R.COSA + j]
    return total


@kernel
def sum_accelerations(p, c, y, angle, speed, speed_rate, w, f):
    """From the forces in the rows of ``w`` to the right-hand side ``f``."""
    ball_accelerations(p, y, w, f)
    lanes = int(p[P.LANES])
    for i in range(Q.SIZE):
        f[F.BODY + i] = sum_lanes(w, W.BODY + i * STRIDE, lanes)
    torque = -sum_lanes(w, W.SHAFT, lanes)
    inner = sum_lanes(w, W.LOSS, lanes)
    outer = sum_lanes(w, W.LOSS + STRIDE, lanes)
    cage = sum_lanes(w, W.LOSS_CAGE, lanes)
    drag = sum_lanes(w, W.LOSS_DRAG, lanes)
    # Half of each contact's loss heats its ring. The other half heats the balls, which give it to the oil;
    # the losses of cage and drag arise in the oil.
    f[F.HEAT] = 0.5 * inner
    f[F.HEAT_OUTER] = 0.5 * outer
    f[F.HEAT_OIL] = 0.5 * (inner + outer) + cage + drag
    f[F.TORQUE] = torque
    f[F.WORK] = growth_power(p, c, w)
    body_equations(p, c, y, angle, speed, speed_rate, w, f)
    if p[P.MODES] != 0.0:
        flexure_equations(p, y, speed, speed_rate, w, f)


@kernel
def right_hand_side(p, c, y, angle, speed, speed_rate, w, f):
    """Accelerations, power, heat and shaft torque at one state.

    ``p`` parameters, ``c`` conditions, ``y`` positions and velocities, ``angle``/``speed``/``speed_rate`` of
    the inner ring (rad, rad/s, rad/s2); ``w`` work space; ``f`` result (see ``layout``). SI units.
    """
    ball_forces(p, c, y, angle, speed, w)
    sum_accelerations(p, c, y, angle, speed, speed_rate, w, f)
