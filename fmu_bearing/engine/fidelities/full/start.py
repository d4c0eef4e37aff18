"""The state at initialisation: the steady one at the inputs, of a single bearing and of a set.

Shaft, housing and rings rest under preload, loads, weights and misalignment on their springs; in a set the
preload is put in as offsets. Flexible rings are bent by their loads; each ball has its own place, orbit and
spin. From the quasi-static state of the bearing with its imperfections, all is moved by what steady and
quasi-static state of the perfect bearing differ by where it rests. Arguments: see `spindle.members`.
"""

from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.fidelities.full.progress import show_axes, total_energy
from fmu_bearing.engine.fidelities.full.settle import settle
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, MAX_DEFECTS, PT, SP, C, F, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.ball_waves import first_axes
from fmu_bearing.engine.mechanics.conditions import defect_scales
from fmu_bearing.engine.mechanics.contact import carries_both_ways
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.follow import copy_rows
from fmu_bearing.engine.spindle.inputs import (
    bearing_conditions,
    bearing_inputs,
    offset_change,
    spread_choices,
    take_loads,
)
from fmu_bearing.engine.spindle.port import begin_motion, has_port
from fmu_bearing.engine.spindle.rest import begin_rest, keep_stiffness, rest, settle_bearing, weights
from fmu_bearing.engine.spindle.rest_unknowns import (
    free_rows,
    neutral_aside,
    put_rings_in_state,
    start_vector,
)
from fmu_bearing.engine.spindle.steady import place_at_rest, rest_steadily
from fmu_bearing.engine.statics.place import (
    pedestal_deflection,
    place_balls,
    place_cage,
    shift_bearing,
    too_far,
)
from fmu_bearing.engine.statics.rigid_preload import cold_place
from fmu_bearing.engine.statics.spin_balance import balance_spins
from fmu_bearing.engine.status import NO_START, OK, TOO_SOFT
from fmu_bearing.engine.steady.carried import carry_balls
from fmu_bearing.engine.steady.even import BOTH, NONE
from fmu_bearing.engine.steady.point import CARRIED, NOT_FOUND, needs_carrying, settle_perfect
from fmu_bearing.engine.steady.transfer import move_to_steady

_BACKWARD = 1e-6  # of all forces: what a bearing may carry against its direction


@kernel
def place_rest(p, y, eq, s, w):
    """Place balls and cage in the state ``y`` about the rings there, from the equilibrium ``eq``."""
    place_balls(p, y, eq)
    if p[P.CAGE] != 0.0:
        place_cage(p, y, eq)
    first_axes(p, s[S.AXES : S.JAC])
    show_axes(p, s, w)


@kernel
def become_steady(p, c, y, first, before, fixed, s, w, speed):
    """Move the state ``y`` by what the steady state of the perfect bearing differs from ``before``.

    ``first``: the quasi-static state of the perfect bearing with its rings where they rest under steady
    forces, ``before``: under quasi-static ones; ``fixed``: see `steady.even`. Where no steady state is near,
    orbit and spins alone are balanced, under loads across the axis with balls that the cage carries.
    """
    jac = s[S.JAC : S.CONDENSED]
    settled = NOT_FOUND
    # fidelities rings and response find theirs with what they hold
    if p[P.FIDELITY] == FULL:
        settled = settle_perfect(p, c, first, speed, fixed, w, jac)
        if speed != 0.0 and needs_carrying(p, c, first, fixed, settled):
            settled = CARRIED
    for i in range(Y.SIZE):
        y[i] -= before[i]
    move_to_steady(p, first, settled, w)
    for i in range(Y.SIZE):
        y[i] += first[i]
    if settled == CARRIED and not carry_balls(p, c, y, speed, w, jac):
        settled = NOT_FOUND
    s[S.SETTLED] = settled
    if settled == NOT_FOUND:
        balance_spins(p, c, y, 0.0, speed, w, jac)
        if p[P.CAGE] != 0.0:
            orbit = 0.0
            for j in range(int(p[P.BALLS])):
                orbit += y[Y.OM + j] / p[P.BALLS]
            y[Y.V0 + Q.CAGE + Q.TURN] = orbit


@kernel
def begin_clock(p, s, speed, t):
    """Clock, and what steps and Jacobian begin with, at time ``t`` (s)."""
    s[S.TIME] = t
    s[S.START] = t
    s[S.SPEED] = speed
    s[S.SPEED_RATE] = 0.0
    s[S.STEP] = min(2e-6, p[P.MAX_STEP])
    s[S.FACTOR_STEP] = 0.0
    s[S.JACOBIAN_TIME] = -1e300
    s[S.CONTRACTION] = s[S.CONTRACTION + 1] = 0.1
    s[S.JACOBIANS] = 0.0


@kernel
def begin_means(s):
    """Mean heats (W) and torque (N m) before the first communication step: the start's."""
    for i in range(3):
        s[S.MEAN_HEAT + i] = s[S.F + F.HEAT + i]
    s[S.MEAN_TORQUE] = s[S.F + F.TORQUE]


@kernel
def preload_set(p, u, s, w):
    """Offsets of all bearings into the set's own state: where preload puts them, at the inputs; status code.

    Where all bearings carry one way, the load on the nose takes the preload's place: the shaft's zero is
    free.
    """
    own = members.set_state(p, s)
    given = members.set_work(p, w)[SP.INPUT : SP.INPUT + U.SIZE]
    asked = u[U.PRELOAD]
    if p[int(p[P.SET]) + SP.PRELOAD_KIND] == SP.TOUCHING:
        asked = 0.0
    for b in range(members.bearing_count(p)):
        r = members.row(p, b)
        load = p[r + SP.ROW_SHARE] * asked
        if p[int(p[P.SET]) + SP.ONE_WAY] != 0.0:
            load = abs(u[U.NOSE]) / members.bearing_count(p)
        bearing_inputs(p, u, b, given)
        place, status = cold_place(members.parameters(p, b), given, load, members.work(p, w, b))
        if status != OK:
            return status
        at = members.per_bearing(p, b)
        own[at + SP.OFFSET_COLD] = place + p[r + SP.ROW_STICKOUT]
        own[at + SP.OFFSET] = own[at + SP.OFFSET_COLD] + offset_change(p, u, b)
        own[at + SP.OFFSET_RATE] = 0.0
    return OK


@kernel
def rests_without_shoulder(p, w):
    """Whether the shaft rests on a side of races without shoulder, with the bearings as they settled last."""
    ws = members.set_work(p, w)
    total = 100.0
    most = 0.0
    for b in range(members.bearing_count(p)):
        along = ws[members.scratch(p, b) + SP.START_FORCE]
        total += abs(along)
        if not carries_both_ways(members.parameters(p, b)):
            most = max(most, along)
    return most > _BACKWARD * total


@kernel
def begin_preload(p, u, s, w):
    """Put the offsets of a set, or the place of a rigid preload, to where preload puts them; status code."""
    if members.has_shaft(p):
        return preload_set(p, u, s, w)
    if p[P.RIGID] == 0.0:
        return OK
    s[S.PLACE], status = cold_place(p, u, u[U.PRELOAD], w)
    return status


@kernel
def has_flaws(p, s):
    """Whether a bearing has imperfections."""
    for b in range(members.bearing_count(p)):
        if members.state(p, s, b)[S.C + C.OVERSIZE_SCALE] != 0.0:
            return True
    return False


@kernel
def note_rest(p, s, w, sign):
    """Add ``sign`` times the rest found last to the set's coordinates and to where outer rings are."""
    ws = members.set_work(p, w)
    z = start_vector(p, SP.UNKNOWNS)
    for i in range(members.coordinates(p) if members.has_shaft(p) else 0):
        members.set_state(p, s)[SP.S_HEAD + i] += sign * ws[z + i]
    for b in range(members.bearing_count(p)):
        at = members.scratch(p, b)
        for i in range(2):
            ws[at + SP.START_ASIDE + i] += sign * ws[at + SP.START_OUTER + Q.Y + i]


@kernel
def place_perfect(p, s, w, speed, to, sign):
    """Put the quasi-static states of the perfect bearings, outer rings on the axis, to ``w[to:]`` of each.

    Their rings are where they rested last, which is added ``sign`` times to where the start puts them;
    pedestals in the conditions are moved with them.
    """
    note_rest(p, s, w, sign)
    for b in range(members.bearing_count(p)):
        place_at_rest(p, b, speed, members.work(p, w, b)[to : to + Y.SIZE], s, w)
        neutral_aside(p, b, members.state(p, s, b)[S.C : S.C + C.SIZE], w)


@kernel
def place_flawed(p, s, w, speed):
    """Place rings, balls and cage of all bearings in the state, outer rings on the axis; status code.

    `TOO_SOFT`: a pedestal lets its ring too far down.
    """
    ws = members.set_work(p, w)
    z = start_vector(p, SP.UNKNOWNS)
    for b in range(members.bearing_count(p)):
        pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
        settle_bearing(p, s, w, b, speed, 1.0, z, start_vector(p, SP.TRIAL_FORCES))
        y = sb[S.Y : S.Y + Y.SIZE]
        put_rings_in_state(p, b, y, ws)
        aside_y, aside_z = y[Y.Q0 + Q.OUTER + Q.Y], y[Y.Q0 + Q.OUTER + Q.Z]
        if too_far(pb, aside_y, aside_z):
            return TOO_SOFT
        shift_bearing(pb, y, -aside_y, -aside_z)
        place_rest(pb, y, wb[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE], sb, wb)
    note_rest(p, s, w, 1.0)
    return OK


@kernel
def rest_all(p, u, s, w, speed):
    """Find where shaft, housing and rings rest, and place them, balls and cages there; status code.

    That is the quasi-static rest of the bearings with their imperfections, then moved by what steady and
    quasi-static rest of perfect bearings differ by. States of perfect bearings are left in ``PT.FIRST_STATE``
    for the steady rest, in ``W.STAGE`` for the quasi-static one.
    """
    own = members.set_state(p, s)
    take_loads(p, u, own)
    status = begin_preload(p, u, s, w)
    if status != OK:
        return status
    if has_port(p):
        for i in range(SP.PLANE):
            own[SP.S_HEAD + i] = u[U.PORT + i]
    begin_rest(p, s, w, speed)
    for i in range(members.padded_size(p)):
        own[SP.S_HEAD + i] = 0.0
    status = rest(p, s, w, speed, 0.0)
    if status != OK:
        return status
    place_perfect(p, s, w, speed, W.STAGE, -1.0)
    if has_flaws(p, s):
        status = rest(p, s, w, speed, 1.0)
        if status != OK:
            return status
    if members.has_shaft(p) and rests_without_shoulder(p, w) and not has_port(p):
        return NO_START
    status = place_flawed(p, s, w, speed)
    if status == OK:
        status = rest_steadily(p, s, w, speed, p[P.FIDELITY] == FULL)
    if status == OK:
        place_perfect(p, s, w, speed, W.PATTERN + PT.FIRST_STATE, 1.0)
        keep_stiffness(p, s, w)
    return status


@kernel
def exceeds_pedestal(p, s):
    """Whether the loads of now would push the ring of a single bearing too far on its pedestal.

    Once it is there no step leads back: with the stiffness of before the pedestal would fling it.
    """
    if members.has_shaft(p):
        return False
    c = s[S.C : S.C + C.SIZE]
    own_weight, lying = weights(p, p)
    aside, down = pedestal_deflection(p, c, c[C.LOAD_Y], c[C.LOAD_Z] - own_weight - lying)
    return too_far(p, aside, down)


@kernel
def twist(p, b, c, y, w):
    """Turn an outer ring on a pedestal of its own about its axis, as far as friction does."""
    if free_rows(p, b) > 0:
        moment = members.set_work(p, w)[members.scratch(p, b) + SP.START_MORE + Q.OUTER + Q.TURN]
        y[Y.Q0 + Q.OUTER + Q.TURN] = moment / c[C.PEDESTAL_ROTATIONAL]


@kernel
def begin_bearing(p, s, w, b, speed, t):
    """Move bearing ``b``, as `rest_all` has placed it, to the steady state; its clock."""
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    wb = members.work(p, w, b)
    together = members.has_shaft(p)
    c = sb[S.C : S.C + C.SIZE]
    y = sb[S.Y : S.Y + Y.SIZE]
    first = wb[W.PATTERN + PT.FIRST_STATE : W.PATTERN + PT.EVEN_STATE]
    before = wb[W.STAGE : W.STAGE + Y.SIZE]
    # the steady state is found about the axis: patterns count angles there
    become_steady(pb, c, y, first, before, BOTH if together else NONE, sb, wb, speed)
    settle(pb, c, y, 0.0, speed, sb, wb)
    at = members.scratch(p, b) + SP.START_ASIDE
    ws = members.set_work(p, w)
    shift_bearing(pb, y, ws[at], ws[at + 1])
    c[C.NEUTRAL_Y] = 0.0
    c[C.NEUTRAL_Z] = 0.0
    if together:
        twist(p, b, c, y, w)
    if pb[P.RIGID] != 0.0:
        y[Y.Q0] = sb[S.PLACE]
    begin_clock(pb, sb, speed, t)


@kernel
def start(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    for i in range(s.size):
        s[i] = 0.0
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        for i in range(W.MOTION):
            wb[i] = 0.0
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    for i in range(ws.size):
        ws[i] = 0.0
    speed = u[U.SPEED]
    spread_choices(p)
    for b in range(members.bearing_count(p)):
        bearing_conditions(p, u, b, speed, w)
        sb = members.state(p, s, b)
        for i in range(C.USED):
            sb[S.C + i] = members.work(p, w, b)[W.CONDITIONS + i]
        # the start is that of sound places, whatever the balls meet there
        for i in range(MAX_DEFECTS):
            sb[S.C + C.DEFECT_SCALE + i] = 0.0
    status = rest_all(p, u, s, w, speed)
    if status != OK:
        return status
    if has_port(p):
        begin_motion(p, u, own, t)
    for b in range(members.bearing_count(p)):
        begin_bearing(p, s, w, b, speed, t)
    for i in range(0 if members.has_shaft(p) else members.coordinates(p)):
        own[SP.S_HEAD + i] = s[S.Y + Y.Q0 + i]
    copy_rows(p, s, w)
    for b in range(members.bearing_count(p)):
        defect_scales(p, members.parameters(p, b), members.state(p, s, b)[S.C : S.C + C.SIZE])
    s[S.ENERGY_START] = total_energy(p, s, w)
    s[S.ENERGY_NOW] = s[S.ENERGY_START]
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        summarise(members.parameters(p, b), sb, members.work(p, w, b))
        begin_means(sb)
    for i in range(2):
        own[SP.MEAN_HEAT + i] = own[SP.POWER_NOW + 1 + i]
    for i in range(SP.PLANE):
        own[SP.PORT_MEAN + i] = own[SP.PORT_FORCE + i]
    return OK
