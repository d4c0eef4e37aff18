"""Stages of a step: their places in the work space, and where Newton's method begins.

Newton's method of a single bearing begins at the accelerations of the stage before, and takes 1.06 iterations
a stage. In a set the bearing that is furthest away decides: from there the QBC set of the benchmark takes 1.8
(20,000 r/min). Sets begin on the straight line through two stages (see `extrapolation`): from the second
implicit stage on that is 4 to 12 times as near there, and 1.3 iterations do. Arguments: see `step`.
"""

from fmu_bearing.engine.fidelities.full import flexible
from fmu_bearing.engine.fidelities.full.methods.table import TABLEAUX
from fmu_bearing.engine.fidelities.full.runge_kutta import correct, keep_velocities, predict
from fmu_bearing.engine.fidelities.full.vectors import add_scaled
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, SP, STRIDE, TAB, F, P, S, W, Y
from fmu_bearing.engine.mechanics.ball_waves import turn_axes
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.spindle import members


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
    for b in range(members.count(p)):
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
def extrapolation(stage, tableau):
    """How far a stage lies beyond the one before, over how far that one lies beyond its own; 0 if unknown.

    Newton's method begins there on the straight line through the accelerations of the two stages before. An
    explicit method has no guess to improve.
    """
    if stage < 2 or TABLEAUX[tableau + TAB.GAMMA] == 0.0:
        return 0.0
    here = tableau + TAB.NODES + stage
    last = TABLEAUX[here - 1]
    return (TABLEAUX[here] - last) / (last - TABLEAUX[here - 2])


@kernel
def extrapolate(wb, lanes, gh, stage, beyond):
    """Move a bearing's first guess at a stage from the stage before to the line through the two before.

    ``wb``: the bearing's work space; ``gh``: weight of rates, s; ``beyond``: see `extrapolation`. Places and
    rates of the stage go with the accelerations.
    """
    here = W.ACC + stage * F.SIZE
    last = here - F.SIZE
    before = last - F.SIZE
    for row in range(Y.RATES // STRIDE):
        for k in range(row * STRIDE, row * STRIDE + lanes, FOUR):
            store(wb, W.D + k, beyond * (load(wb, last + k) - load(wb, before + k)))
    for i in range(F.BODY, F.WORK):
        wb[W.D + i] = beyond * (wb[last + i] - wb[before + i])
    correct(wb[here : here + F.SIZE], lanes, gh, wb)


@kernel
def predict_bearings(p, s, w, h, gh, stage, tableau):
    """States of all bearings at a stage from the stages before, with a first guess of its accelerations.

    ``h``: length of the step (s); ``gh``: weight of rates (s).
    """
    beyond = extrapolation(stage, tableau) if members.has_shaft(p) else 0.0
    t = h * TABLEAUX[tableau + TAB.NODES + stage]
    for b in range(members.count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        y = sb[S.Y : S.Y + Y.SIZE]
        predict(y, int(pb[P.LANES]), h, gh, stage, tableau, wb)
        if beyond != 0.0:
            extrapolate(wb, int(pb[P.LANES]), gh, stage, beyond)
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
    beyond = extrapolation(stage, tableau)
    for i in range(lanes):
        guess = ws[last + i] + beyond * (ws[last + i] - ws[before + i])
        ws[here + i] = guess
        ws[place + i] = own[SP.S_HEAD + i]
        ws[rate + i] = own[SP.S_HEAD + lanes + i] + gh * guess
    for m in range(stage):
        a = h * TABLEAUX[tableau + TAB.A + stage * TAB.ROW + m]
        add_scaled(a, ws[acceleration(p, m) :], ws[rate:], lanes)
        add_scaled(a, ws[velocity(p, m) :], ws[place:], lanes)
    for i in range(lanes):
        ws[place + i] += gh * ws[rate + i]
