"""Stages of a step: their places in the work space, and where Newton's method begins.

Newton's method begins at accelerations on the straight line through the two stages before (``TAB.BEYOND``),
in the first implicit stage on the one through the end of the step before (`ahead_of`). From the stage before
alone it is 4 to 12 times as far: under 1000 N across, single bearings then take 1.9 iterations a stage in
place of 1.5, and what those leave doubles the error. Arguments: see `step`.
"""

from fmu_bearing.engine.fidelities.full import flexible
from fmu_bearing.engine.fidelities.full.methods.table import TABLEAUX
from fmu_bearing.engine.fidelities.full.runge_kutta import keep_velocities, predict
from fmu_bearing.engine.fidelities.full.vectors import add_scaled, sum_scaled
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, SP, STRIDE, TAB, F, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.ball_waves import turn_axes
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.spindle import members

# Over the time in which the change that is kept came about: in a step more than twice as long as the one
# before, a guess from there is none.
_FAR = 3.0


@kernel
def acceleration(p, stage):
    """Place in the set's own work space of a stage's accelerations (m/s2, rad/s2)."""
    return members.vector(p, stage)


@kernel
def velocity(p, stage):
    """Place in the set's own work space of a stage's rates (m/s, rad/s)."""
    return members.vector(p, SP.VELOCITIES + stage)


@kernel
def begin_stages(p, s, w):
    """Put the state into the first stage of every bearing and of the shaft."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        for i in range(F.SIZE):
            wb[W.ACC + i] = sb[S.F + i]
            wb[W.F + i] = 0.0
        keep_velocities(sb[S.Y : S.Y + Y.SIZE], int(pb[P.LANES]), wb[W.VEL : W.VEL + F.SIZE])
        flexible.begin_modes(pb, sb[flexure_state(pb) :], wb)
    acc = acceleration(p, 0)
    vel = velocity(p, 0)
    for i in range(lanes):
        ws[acc + i] = own[SP.S_HEAD + 2 * lanes + i]
        ws[vel + i] = own[SP.S_HEAD + lanes + i]


@kernel
def ahead_of(s, t, stage, tableau):
    """Share of the accelerations' change in the step before that a stage ``t`` (s) into this one goes on by.

    ``s``: state of any bearing. Only the first implicit stage has no line through stages of its own. None
    where the change belongs to a step much shorter than this one: it carries what Newton's method left.
    """
    if stage != 1 or TABLEAUX[tableau + TAB.GAMMA] == 0.0 or t > _FAR * s[S.CHANGE_TIME]:
        return 0.0
    return t / s[S.CHANGE_TIME]


@kernel
def keep_change(pb, sb, wb, h, tableau):
    """Store by how much the accelerations of a bearing have changed towards the end of a step ``h`` (s)."""
    if TABLEAUX[tableau + TAB.GAMMA] == 0.0:
        return
    first = int(TABLEAUX[tableau + TAB.CHANGE_FROM])
    before = W.ACC + first * F.SIZE
    for row in range(F.BODY // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + int(pb[P.LANES]), FOUR):
            store(sb, S.CHANGE + k, load(wb, W.LAST + k) - load(wb, before + k))
    sum_scaled(wb[W.LAST + F.BODY :], -1.0, wb[before + F.BODY :], sb[S.CHANGE + F.BODY :], Q.SIZE)
    sb[S.CHANGE_TIME] = h * (1.0 - TABLEAUX[tableau + TAB.NODES + first])


@kernel
def predict_bearings(p, s, w, h, gh, stage, tableau):
    """States of all bearings at a stage from the stages before, with a first guess of its accelerations.

    ``h``: length of the step (s); ``gh``: weight of rates (s).
    """
    t = h * TABLEAUX[tableau + TAB.NODES + stage]
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        y = sb[S.Y : S.Y + Y.SIZE]
        change = sb[S.CHANGE : S.CHANGE + F.WORK]
        predict(y, change, ahead_of(sb, t, stage, tableau), int(pb[P.LANES]), h, gh, stage, tableau, wb)
        if pb[P.MODES] != 0.0:
            flexible.predict_modes(pb, sb[flexure_state(pb) :], h, gh, stage, tableau, wb)
        turn_axes(pb, sb[S.AXES : S.JAC], y, int(pb[P.LANES]), t, wb)


@kernel
def predict_shaft(p, s, w, h, gh, stage, tableau):
    """State of shaft and housing at a stage from those before, with a first guess of its accelerations."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    place = members.vector(p, SP.PLACE)
    rate = members.vector(p, SP.RATE)
    here = acceleration(p, stage)
    last = acceleration(p, stage - 1)
    before = acceleration(p, max(stage - 2, 0))
    change = SP.S_HEAD + SP.CHANGE * lanes
    beyond = TABLEAUX[tableau + TAB.BEYOND + stage]
    ahead = ahead_of(s, h * TABLEAUX[tableau + TAB.NODES + stage], stage, tableau)
    for i in range(lanes):
        guess = ws[last + i] + beyond * (ws[last + i] - ws[before + i]) + ahead * own[change + i]
        ws[here + i] = guess
        ws[place + i] = own[SP.S_HEAD + i]
        ws[rate + i] = own[SP.S_HEAD + lanes + i] + gh * guess
    for m in range(stage):
        a = h * TABLEAUX[tableau + TAB.A + stage * TAB.ROW + m]
        add_scaled(a, ws[acceleration(p, m) :], ws[rate:], lanes)
        add_scaled(a, ws[velocity(p, m) :], ws[place:], lanes)
    for i in range(lanes):
        ws[place + i] += gh * ws[rate + i]
