"""A set at initialisation: preload as offsets, rest, then balls and cages about the rings there."""

from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.fidelities.full.settle import settle
from fmu_bearing.engine.fidelities.full.start import (
    FAR,
    become_steady,
    begin_clock,
    begin_means,
    place_rest,
)  # fmt: skip
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, PT, SP, ST, C, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.energy import set_energy
from fmu_bearing.engine.spindle.follow import copy_rows
from fmu_bearing.engine.spindle.inputs import (
    bearing_conditions,
    bearing_inputs,
    offset_change,
    spread_choices,
    take_loads,
)  # fmt: skip
from fmu_bearing.engine.spindle.port import begin_motion, has_port
from fmu_bearing.engine.spindle.rest import (
    keep_stiffness,
    outer_row,
    settle_bearing,
    start_vector,
)  # fmt: skip
from fmu_bearing.engine.spindle.steady import place_held, rest_steadily
from fmu_bearing.engine.statics.axial import quasistatic
from fmu_bearing.engine.status import NO_START, OK, TOO_SOFT
from fmu_bearing.engine.steady.even import BOTH

_BACKWARD = 1e-6  # of all forces: what a bearing may carry against its direction
TOUCHING = 0.01  # N: without preload rings stand where the balls just touch, as for rigid preload


@kernel
def cold_place(p, u, b, load, w):
    """Place (m) of an inner ring under an axial ``load`` (N) at standstill and 20 degC; status."""
    pb = members.parameters(p, b)
    wb = members.work(p, w, b)
    still = wb[W.STILL_INPUTS : W.STILL_CONDITIONS]
    c = wb[W.STILL_CONDITIONS : W.STILL_FOUND]
    found = wb[W.STILL_FOUND : W.STILL_END]
    bearing_inputs(p, u, b, still)
    still[U.SPEED] = 0.0
    still[U.OIL_T] = REFERENCE_TEMPERATURE
    still[U.INNER_T] = REFERENCE_TEMPERATURE
    still[U.OUTER_T] = REFERENCE_TEMPERATURE
    conditions(pb, still, 0.0, c)
    c[C.PRELOAD] = max(load, TOUCHING)
    status = quasistatic(pb, c, 0.0, found)
    place = found[ST.AXIAL_SHIFT]
    if p[members.row(p, b) + SP.ROW_SEAT] == SP.PEDESTAL:
        place += load / c[C.PEDESTAL_AXIAL]
    return place, status


@kernel
def preload_set(p, u, s, w):
    """Offsets of all bearings into the set's own state: where preload puts them, at the inputs; status code.

    A set that carries one way stands where the load on its nose puts it: there the shaft's zero is free.
    """
    own = members.own_state(p, s)
    asked = u[SP.U_PRELOAD]
    if p[int(p[P.SET]) + SP.PRELOAD_KIND] == SP.TOUCHING:
        asked = 0.0
    for b in range(members.count(p)):
        r = members.row(p, b)
        load = p[r + SP.ROW_SHARE] * asked
        if p[int(p[P.SET]) + SP.ONE_WAY] != 0.0:
            load = abs(u[SP.U_NOSE]) / members.count(p)
        place, status = cold_place(p, u, b, load, w)
        if status != OK:
            return status
        at = members.kept(p, b)
        own[at + SP.OFFSET_COLD] = place + p[r + SP.ROW_STICKOUT]
        own[at + SP.OFFSET] = own[at + SP.OFFSET_COLD] + offset_change(p, u, b)
        own[at + SP.OFFSET_RATE] = 0.0
    return OK


@kernel
def pushed_back(p, w):
    """Whether the shaft rests on a side of races without shoulder, in bearings settled last."""
    ws = members.own_work(p, w)
    total = 100.0
    most = 0.0
    for b in range(members.count(p)):
        along = ws[members.scratch(p, b) + SP.START_FORCE]
        total += abs(along)
        most = max(most, along)
    return most > _BACKWARD * total


@kernel
def start_set(p, u, s, w, t):
    """Fill the state ``s`` of a set for the inputs ``u`` at time ``t`` (s); status code."""
    for i in range(s.size):
        s[i] = 0.0
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        for i in range(W.MOTION):
            wb[i] = 0.0
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    for i in range(ws.size):
        ws[i] = 0.0
    speed = u[SP.U_SPEED]
    spread_choices(p)
    take_loads(p, u, own)
    for b in range(members.count(p)):
        bearing_conditions(p, u, b, speed, w)
        sb = members.state(p, s, b)
        for i in range(C.USED):
            sb[S.C + i] = members.work(p, w, b)[W.CONDITIONS + i]
    status = preload_set(p, u, s, w)
    if status != OK:
        return status
    z = start_vector(p, SP.UNKNOWNS)
    if has_port(p):
        for i in range(SP.PLANE):
            ws[z + i] = u[SP.U_PORT + i]
    status = rest_steadily(p, s, w, speed)
    if status != OK:
        return status
    if pushed_back(p, w) and not has_port(p):
        return NO_START
    for i in range(members.coordinates(p)):
        own[SP.S_HEAD + i] = ws[z + i]
    keep_stiffness(p, s, w)
    if has_port(p):
        begin_motion(p, u, own, t)
    for b in range(members.count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        settle_bearing(p, s, w, b, speed, z, start_vector(p, SP.TRIAL_FORCES))
        y = sb[S.Y : S.Y + Y.SIZE]
        at = members.scratch(p, b)
        for i in range(SP.HOUSING):
            y[Y.Q0 + Q.OUTER + i] = ws[at + SP.START_OUTER + i]
        aside = abs(ws[at + SP.START_OUTER + Q.Y]) + abs(ws[at + SP.START_OUTER + Q.Z])
        if aside > FAR * pb[P.PITCH_RADIUS]:
            return TOO_SOFT
        for i in range(SP.PLANE):
            y[Y.Q0 + i] = ws[at + SP.START_RING + i] + ws[at + SP.START_OUTER + outer_row(i)]
        c = sb[S.C : S.C + C.SIZE]
        place_rest(pb, c, y, wb[W.FOUND : W.FOUND + EQ.SIZE], sb, wb)
        settle(pb, c, y, 0.0, speed, sb, wb)
        first = wb[W.PATTERN + PT.FIRST_STATE : W.PATTERN + PT.EVEN_STATE]
        for i in range(Y.SIZE):
            first[i] = y[i]
        if c[C.OVERSIZE_SCALE] != 0.0 and pb[P.MODES] == 0.0:
            place_held(p, b, speed, first, s, w)
        become_steady(pb, c, y, first, BOTH, sb, wb, speed)
        begin_clock(pb, sb, speed, t)
    copy_rows(p, s, w)
    own[SP.ENERGY_START] = set_energy(p, s, w)
    own[SP.ENERGY_NOW] = own[SP.ENERGY_START]
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        summarise(members.parameters(p, b), sb, members.work(p, w, b))
        begin_means(sb)
    for i in range(2):
        own[SP.MEAN_HEAT + i] = own[SP.POWER_NOW + 1 + i]
    for i in range(SP.PLANE):
        own[SP.PORT_MEAN + i] = own[SP.PORT_FORCE + i]
    return OK
