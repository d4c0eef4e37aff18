"""From the rings' own state to the one that outputs and sound are made of."""

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.fidelities.condensed.ball_form import add_ball_form
from fmu_bearing.engine.fidelities.condensed.ball_motion import show_moving
from fmu_bearing.engine.fidelities.condensed.defects import show_directions
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, L, P, Q, R, S, T, W, Y
from fmu_bearing.engine.mechanics.ball_waves import has_wavy_balls
from fmu_bearing.engine.mechanics.defects import add_defects, has_defects
from fmu_bearing.engine.mechanics.equations import inner_pose, outer_pose
from fmu_bearing.engine.mechanics.race import normal_contact, waviness
from fmu_bearing.engine.mechanics.seals import seal_moment
from fmu_bearing.engine.mechanics.trigonometry import ball_angles, wrap
from fmu_bearing.engine.newton.jacobian import is_angle

# What a ball in its races can do: its place varies by 0.3 mm per radian of turning at most (ten times what a
# load of 3 kN does), and follows the rings by at most ten times their velocity.
_PER_RADIAN = 3e-4
_PER_RING = 10.0


@kernel
def fastest_ball(p, speed, y):
    """Bound (m/s) on what differences of the balls' places may show: see above."""
    most = 0.0
    for i in range(L.N):
        most = max(most, abs(y[Y.V0 + i]) * (p[P.PITCH_RADIUS] if is_angle(i) else 1.0))
    return _PER_RADIAN * abs(speed) + _PER_RING * most


@kernel
def publish_balls(p, lv, speed, speed_rate, y, f):
    """Places, rates and spins of the balls (see ``ball_motion``), but for their angles."""
    show_moving(p, lv, fastest_ball(p, speed, y), y, f)
    for j in range(0, int(p[P.LANES]), FOUR):
        store(y, Y.OM + j, splat(lv[L.RATIO] * speed))
        store(f, F.TH + j, splat(lv[L.RATIO] * speed_rate))
        for row in range(j, j + 3 * STRIDE, STRIDE):
            spin = load(lv, L.SPIN + row)
            store(y, Y.WX + row, spin * speed)
            store(f, F.WX + row, spin * speed_rate)


@kernel
def frozen_heat(lv):
    """Sum (W) of the heats frozen at the operating point."""
    return lv[L.HEAT] + lv[L.HEAT_OUTER] + lv[L.HEAT_OIL]


@kernel
def frozen_torque(lv, speed):
    """Torque (N m) that puts in the heats frozen at the operating point at ``speed`` (rad/s)."""
    frozen = lv[L.FROZEN_SPEED]
    # in a ramp from far below, the speed that the heats belong to is still to come
    near = frozen != 0.0 and speed * frozen > 0.5 * frozen * frozen
    return frozen_heat(lv) / speed if near else lv[L.TORQUE]


@kernel
def publish_moving(p, lv, speed, speed_rate, y, f):
    """Write ``y`` and ``f`` as `publish` does, but for the balls' angles.

    The cage turns with the balls about the place it had at the start.
    """
    for i in range(L.N):
        y[Y.Q0 + i] = lv[L.Q0 + i]
        y[Y.V0 + i] = lv[L.V0 + i]
        f[F.BODY + i] = lv[L.A0 + i]
    turn = Q.CAGE + Q.TURN
    y[Y.Q0 + turn] = wrap(lv[L.THETA])
    y[Y.V0 + turn] = lv[L.RATIO] * speed if p[P.CAGE] != 0.0 else 0.0
    f[F.BODY + turn] = lv[L.RATIO] * speed_rate if p[P.CAGE] != 0.0 else 0.0
    publish_balls(p, lv, speed, speed_rate, y, f)
    f[F.WORK] = frozen_heat(lv)
    f[F.TORQUE] = frozen_torque(lv, speed)
    for i in range(3):
        f[F.HEAT + i] = lv[L.HEAT + i]
    if p[P.SEAL_TORQUE] != 0.0:
        rubbing = seal_moment(p, speed)
        f[F.WORK] += rubbing * speed
        f[F.TORQUE] += rubbing
        f[F.HEAT] += rubbing * speed


@kernel
def publish(p, lv, speed, speed_rate, y, f):
    """Write the whole state ``y`` and its right-hand side ``f`` (of fidelity full: see the layout)."""
    publish_moving(p, lv, speed, speed_rate, y, f)
    for j in range(int(p[P.LANES])):
        place = j if j < p[P.BALLS] else 0
        y[Y.TH + j] = wrap(lv[L.THETA] + 2.0 * PI * place / p[P.BALLS])


@kernel
def find_contacts(p, s, w):
    """Evaluate the rows of both races at the state of fidelities `rings` and `response`.

    The rings are rigid; the balls' own form is that of balls that spin steadily (``condensed.ball_form``).
    """
    lv, c, y = s[S.CONDENSED : S.CONDENSED + L.SIZE], s[S.C : S.C + C.SIZE], s[S.Y : S.Y + Y.SIZE]
    lanes = int(p[P.LANES])
    own = S.CONTACTS  # heights by the balls' form, until the rows are kept there
    for j in range(lanes):
        w[T.INNER + j] = 0.0
        w[T.OUTER + j] = 0.0
    if has_wavy_balls(p, c):
        add_ball_form(p, c, lv, lv[L.ROLLED], s[S.SPEED], w)
    for j in range(lanes):
        s[own + j] = w[T.INNER + j]
        s[own + STRIDE + j] = w[T.OUTER + j]
    if has_defects(p, c):
        show_directions(p, lv, w, W.DEFECT_AXES)
    ball_angles(y, Y.TH, lanes, w)
    inner_pose(p, c, y, s[S.SPEED], w)
    outer_pose(p, c, y, w)
    for race in range(2):
        turned = s[S.ANGLE] if race == 0 else y[Y.Q0 + Q.OUTER + Q.TURN]
        waviness(p, c, y[Y.TH : Y.TH + STRIDE], lanes, race, turned, w)
        row = W.RACE + race * R.SIZE + R.WAVE
        for j in range(0, lanes, FOUR):
            store(w, row + j, load(w, row + j) + load(s, own + race * STRIDE + j))
        normal_contact(p, c, y, lanes, race, w)
        if has_defects(p, c):
            add_defects(p, c, y, lanes, race, turned, w)
