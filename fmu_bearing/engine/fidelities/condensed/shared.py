"""What fidelities `rings` and `response` share: operators at the frozen point, and the end of a step."""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.fidelities.condensed.balls import accelerations, set_angles
from fmu_bearing.engine.fidelities.condensed.contact_forces import (
    find_coupling,
    find_load_friction,
    find_restoring,
    store_contacts,
)
from fmu_bearing.engine.fidelities.condensed.frozen import nonzero_speed
from fmu_bearing.engine.fidelities.condensed.linearised import derivatives
from fmu_bearing.engine.fidelities.condensed.operator import (
    clear_operator,
    find_operator,
)
from fmu_bearing.engine.fidelities.condensed.publish import frozen_torque, publish_moving
from fmu_bearing.engine.fidelities.condensed.transverse import (
    clear_transverse,
    find_friction,
    find_transverse,
)
from fmu_bearing.engine.fidelities.full.vectors import copy_rows
from fmu_bearing.engine.fidelities.steps import advance_clock
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, L, P, Q, S, T, W, Y
from fmu_bearing.engine.mechanics.seals import seal_moment
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.newton.body_slopes import land_slopes
from fmu_bearing.engine.newton.jacobian import jacobian


@kernel
def even_spacing(p, lv):
    """Rows of the balls' angles from ball 0, of their sizes and of the mask of spare lanes."""
    balls = p[P.BALLS]
    sizes = int(p[P.AT_OVERSIZE])
    for j in range(int(p[P.LANES])):
        place = j if j < balls else 0
        angle = 2.0 * PI * place / balls
        lv[L.PHI + j] = p[P.WAVE_INTERVALS] * place / balls
        lv[L.COS + j] = math.cos(angle)
        lv[L.SIN + j] = math.sin(angle)
        lv[L.SIZES + j] = 0.5 * p[sizes + j]
        lv[L.MASK + j] = 1.0 if j < balls else 0.0


@kernel
def flat(p, c, lv, w):
    """Angles at the start, and races without waves under balls of one size."""
    set_angles(p, c, lv, 0.0, 0.0, 0.0, 0.0, 0.0, w)
    for i in range(2 * STRIDE):
        w[T.INNER + i] = 0.0
        w[T.FORM_SLOPE + i] = 0.0


@kernel
def jacobian_with_cage(p, c, lv, speed, w, jac):
    """Jacobian of `full` at the frozen point, with the cage as it runs there.

    Where it whirls and its pockets press on all balls, these lag in them. The film of its lands has the
    slopes of where the cage is: its whirl is faster or slower than what rings do, so that they feel the mean
    over it.
    """
    y = lv[L.Y0 : L.Y0 + Y.SIZE]
    if p[P.CAGE] == 0.0:
        jacobian(p, c, y, 0.0, speed, 0.0, w, jac)
        return
    lag = lv[L.LAG] if lv[L.MORE_PRESSED] != 0.0 and lv[L.MORE_WHIRL] != 0.0 else 0.0
    for j in range(int(p[P.LANES])):
        y[Y.TH + j] += lag
    viscosity = c[C.LAND_VISCOSITY]
    c[C.LAND_VISCOSITY] = 0.0
    jacobian(p, c, y, 0.0, speed, 0.0, w, jac)
    for j in range(int(p[P.LANES])):
        y[Y.TH + j] -= lag
    # the mean over all directions is that of two
    c[C.LAND_VISCOSITY] = 0.5 * viscosity
    away, rate = lv[L.MORE_AWAY], lv[L.MORE_AWAY] * lv[L.MORE_WHIRL]
    for k in range(2 if p[P.LAND] != 0.0 else 0):
        place, moving = Y.Q0 + Q.CAGE + Q.Z - k, Y.V0 + Q.CAGE + Q.Y + k
        sign = 1.0 - 2.0 * k
        y[place] += away
        y[moving] -= sign * rate
        land_slopes(p, c, y, speed, p[P.LAND_OFFSET], jac)
        land_slopes(p, c, y, speed, -p[P.LAND_OFFSET], jac)
        y[place] -= away
        y[moving] += sign * rate
    c[C.LAND_VISCOSITY] = viscosity


@kernel
def build_operator(p, s, w):
    """Find what balls and cage do between the rings at the frozen point: see `operator` and `transverse`.

    ``L.JX`` and ``L.JV`` and the trial state are overwritten. Where balls find no rest there, or nothing
    holds them between both races, they follow statically.
    """
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    jac = s[S.JAC : S.CONDENSED]
    c = lv[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    y = lv[L.Y0 : L.Y0 + Y.SIZE]
    speed = nonzero_speed(lv[L.FROZEN_SPEED])
    lv[L.MODES_NEW] = 1.0
    for i in range(Y.SIZE):
        w[W.STAGE + i] = 0.0
    for i in range(L.N):
        w[W.STAGE + Y.Q0 + i] = y[Y.Q0 + i]
    for j in range(STRIDE):
        w[T.X + j] = y[Y.X + j]
        w[T.R + j] = y[Y.R + j]
    flat(p, c, lv, w)
    if not derivatives(p, c, lv, 0.0, speed, 0.0, w):
        clear_transverse(lv)
        clear_operator(lv)
        return
    # the last difference leaves the contacts moved
    accelerations(p, c, lv, 0.0, speed, 0.0, w[T.Q : T.Q + L.COLUMN], w)
    find_transverse(p, c, lv, speed, w)
    find_restoring(p, lv[L.Y0 + Y.OM], w)
    find_coupling(p, lv, speed, w)
    store_contacts(p, lv, w)
    if lv[L.SIDE_SQUARE] == 0.0:
        clear_operator(lv)
        return
    find_load_friction(p, c, y, speed, w)
    jacobian_with_cage(p, c, lv, speed, w, jac)
    find_friction(lv, jac)
    find_operator(p, lv, jac, lv[L.Y0 + Y.OM], w)


@kernel
def advance(p, s, h):
    """Time, angle, speed, the shaft's work and the sums of heat at the end of the step."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    mean_speed = s[S.SPEED] + 0.5 * h * s[S.SPEED_RATE]
    impulse = h * frozen_torque(lv, mean_speed)
    s[S.SHAFT_WORK] += impulse * mean_speed
    s[S.TORQUE_TIME] += impulse
    advance_clock(s, h)
    for i in range(3):
        s[S.HEAT + i] += h * lv[L.HEAT + i]
        s[S.WORK] += h * lv[L.HEAT + i]
    if p[P.SEAL_TORQUE] != 0.0:
        impulse = h * seal_moment(p, mean_speed)
        work = impulse * mean_speed
        s[S.SHAFT_WORK] += work
        s[S.TORQUE_TIME] += impulse
        s[S.HEAT] += work
        s[S.WORK] += work


@kernel
def show_end(p, s, w, h):
    """Put the end of the step ``h`` (s), now in ``lv``, beside the published state, for samples between.

    Rows of balls go by lanes in use; what follows them in ``y`` and ``f`` is of the bodies.
    """
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    y = w[W.STAGE : W.STAGE + Y.SIZE]
    f = w[W.LAST : W.LAST + F.SIZE]
    for i in range(Y.Q0, Y.SIZE):
        y[i] = s[S.Y + i]
    for i in range(F.BODY, F.SIZE):
        f[i] = 0.0
    publish_moving(p, lv, s[S.SPEED] + h * s[S.SPEED_RATE], s[S.SPEED_RATE], y, f)
    # the interpolation needs angles that run on from the old ones
    turned = lv[L.RATIO] * h * (s[S.SPEED] + 0.5 * h * s[S.SPEED_RATE])
    for j in range(0, int(p[P.LANES]), FOUR):
        store(y, Y.TH + j, load(s, S.Y + Y.TH + j) + turned)


@kernel
def keep_end(p, s, w):
    """Publish what `show_end` has shown."""
    lanes = int(p[P.LANES])
    y = w[W.STAGE : W.STAGE + Y.SIZE]
    for j in range(lanes):
        y[Y.TH + j] = wrap(y[Y.TH + j])
    copy_rows(y, s[S.Y :], Y.ROWS, lanes)
    for i in range(Y.Q0, Y.SIZE):
        s[S.Y + i] = y[i]
    copy_rows(w[W.LAST :], s[S.F :], F.BODY // STRIDE, lanes)
    for i in range(F.BODY, F.SIZE):
        s[S.F + i] = w[W.LAST + i]
