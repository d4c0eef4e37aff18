"""The state at initialisation: the steady one at the inputs, of a single bearing and of a set.

A single bearing rests under preload, radial loads, weights and misalignment on its own springs. In a set the
preload is put in as offsets, shaft and housing rest, and the rings of each bearing are placed there. Flexible
rings are bent by their loads; each ball has its own place, orbit and spin. From the quasi-static state of the
bearing with its imperfections, all is moved by what steady and quasi-static state of the perfect bearing
differ by. Arguments: see `spindle.members`.
"""

from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.fidelities.full.progress import show_axes, total_energy
from fmu_bearing.engine.fidelities.full.settle import settle
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, PT, SP, C, F, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.ball_waves import first_axes
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
from fmu_bearing.engine.spindle.rest import (
    free_rows,
    keep_stiffness,
    outer_row,
    settle_bearing,
    start_vector,
)
from fmu_bearing.engine.spindle.steady import place_held, rest_steadily
from fmu_bearing.engine.statics.place import (
    equilibrium,
    loads,
    place_balls,
    place_cage,
    place_rings,
    shift_bearing,
    sunk,
    too_far,
)
from fmu_bearing.engine.statics.rigid_preload import cold_place, rigid_start
from fmu_bearing.engine.statics.spin_balance import balance_spins
from fmu_bearing.engine.status import NO_START, OK, TOO_SOFT
from fmu_bearing.engine.steady.even import BOTH, NONE
from fmu_bearing.engine.steady.point import (
    NOT_FOUND,
    bring_to_axis,
    is_sunk,
    move_to_steady,
    settle_perfect,
)

_BACKWARD = 1e-6  # of all forces: what a bearing may carry against its direction


@kernel
def place_rest(p, c, y, found, s, w):
    """Place balls and cage in the state ``y`` about the rings there, from the equilibrium ``found``."""
    place_balls(p, y, found)
    if p[P.CAGE] != 0.0:
        place_cage(p, y, found)
    first_axes(p, s[S.AXES : S.JAC])
    show_axes(p, s, w)


@kernel
def become_steady(p, c, y, first, held, s, w, speed):
    """Move the quasi-static state ``y`` by what the steady state differs from ``first``, the perfect one.

    ``held``: see `steady.even`. Where no steady state is near, orbit and spins alone are balanced.
    """
    jac = s[S.JAC : S.CONDENSED]
    settled = NOT_FOUND
    # fidelities rings and response find theirs with what they hold
    if p[P.FIDELITY] == FULL:
        settled = settle_perfect(p, c, first, speed, held, w, jac)
    s[S.SETTLED] = settled
    if settled == NOT_FOUND:
        balance_spins(p, c, y, 0.0, speed, w, jac)
        if p[P.CAGE] != 0.0:
            orbit = 0.0
            for j in range(int(p[P.BALLS])):
                orbit += y[Y.OM + j] / p[P.BALLS]
            y[Y.V0 + Q.CAGE + Q.TURN] = orbit
        return
    for i in range(Y.SIZE):
        y[i] -= first[i]
    move_to_steady(p, first, settled, w)
    for i in range(Y.SIZE):
        y[i] += first[i]


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
def place_perfect(p, c, speed, carried, first, w):
    """Put the quasi-static state of the perfect bearing to ``first``; leave it where there is none.

    Under the load in ``W.LOAD`` and what the pedestal has ``carried`` (N): see `rest_alone`. An outer ring
    that has sunk is brought to the axis.
    """
    found = w[W.FOUND : W.FOUND + EQ.SIZE]
    load = w[W.LOAD : W.LOAD + EQ.FREEDOMS]
    tilt = w[W.TILT : W.TILT + 2]
    if equilibrium(p, c, speed, load, 0.0, tilt, found, w) != OK:
        return
    for i in range(Y.SIZE):
        first[i] = 0.0
    place_rings(c, first, found, tilt, c[C.LOAD_Y], carried)
    place_balls(p, first, found)
    if p[P.CAGE] != 0.0:
        place_cage(p, first, found)
    if is_sunk(first):
        bring_to_axis(p, c, first)


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
    for b in range(members.count(p)):
        r = members.row(p, b)
        load = p[r + SP.ROW_SHARE] * asked
        if p[int(p[P.SET]) + SP.ONE_WAY] != 0.0:
            load = abs(u[U.NOSE]) / members.count(p)
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
def pushed_back(p, w):
    """Whether the shaft rests on a side of races without shoulder, with the bearings as they settled last."""
    ws = members.set_work(p, w)
    total = 100.0
    most = 0.0
    for b in range(members.count(p)):
        along = ws[members.scratch(p, b) + SP.START_FORCE]
        total += abs(along)
        most = max(most, along)
    return most > _BACKWARD * total


@kernel
def rest_alone(p, u, s, w, speed):
    """Put the rings of a single bearing to rest in the state, what balls need to ``W.FOUND``.

    Returns a status code, and the load (N) in z that the pedestal carries.
    """
    c = s[S.C : S.C + C.SIZE]
    found = w[W.FOUND : W.FOUND + EQ.SIZE]
    load = w[W.LOAD : W.LOAD + EQ.FREEDOMS]
    tilt = w[W.TILT : W.TILT + 2]
    if p[P.RIGID] != 0.0:
        status = rigid_start(p, u, c, s, w, found)
        if status != OK:
            return status, 0.0
    carried = loads(p, c, load)
    status = equilibrium(p, c, speed, load, 1.0, tilt, found, w)
    if status != OK:
        return status, carried
    y = s[S.Y : S.Y + Y.SIZE]
    place_rings(c, y, found, tilt, c[C.LOAD_Y], carried)
    if too_far(p, y[Y.Q0 + Q.OUTER + Q.Y], y[Y.Q0 + Q.OUTER + Q.Z]):
        return TOO_SOFT, carried
    if p[P.RIGID] != 0.0:
        y[Y.Q0] = s[S.PLACE]
    return OK, carried


@kernel
def rest_together(p, u, s, w, speed, t):
    """Put shaft and housing of a set to rest in its own state; status code."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    take_loads(p, u, own)
    status = preload_set(p, u, s, w)
    if status != OK:
        return status
    z = start_vector(p, SP.UNKNOWNS)
    if has_port(p):
        for i in range(SP.PLANE):
            ws[z + i] = u[U.PORT + i]
    status = rest_steadily(p, s, w, speed, p[P.FIDELITY] == FULL)
    if status != OK:
        return status
    if pushed_back(p, w) and not has_port(p):
        return NO_START
    for i in range(members.coordinates(p)):
        own[SP.S_HEAD + i] = ws[z + i]
    keep_stiffness(p, s, w)
    if has_port(p):
        begin_motion(p, u, own, t)
    return OK


@kernel
def rest_member(p, s, w, b, speed):
    """Put the rings of bearing ``b`` of a set where shaft and housing rest; the balls' to ``W.FOUND``."""
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    ws = members.set_work(p, w)
    settle_bearing(p, s, w, b, speed, start_vector(p, SP.UNKNOWNS), start_vector(p, SP.TRIAL_FORCES))
    y = sb[S.Y : S.Y + Y.SIZE]
    at = members.scratch(p, b)
    for i in range(SP.HOUSING):
        y[Y.Q0 + Q.OUTER + i] = ws[at + SP.START_OUTER + i]
    if too_far(pb, y[Y.Q0 + Q.OUTER + Q.Y], y[Y.Q0 + Q.OUTER + Q.Z]):
        return TOO_SOFT
    for i in range(SP.PLANE):
        y[Y.Q0 + i] = ws[at + SP.START_RING + i] + ws[at + SP.START_OUTER + outer_row(i)]
    return OK


@kernel
def sinks(p, s, w):
    """Whether the loads of now would push the ring of a single bearing too far on its pedestal.

    Once it is there no step leads back: with the stiffness of before the pedestal would fling it.
    """
    if members.has_shaft(p):
        return False
    c = s[S.C : S.C + C.SIZE]
    aside, down = sunk(c, c[C.LOAD_Y], loads(p, c, w[W.LOAD : W.LOAD + EQ.FREEDOMS]))
    return too_far(p, aside, down)


@kernel
def twist(p, b, c, y, w):
    """Turn an outer ring on a pedestal of its own about its axis, as far as friction does."""
    if free_rows(p, b) > 0:
        moment = members.set_work(p, w)[members.scratch(p, b) + SP.START_MORE + Q.OUTER + Q.TURN]
        y[Y.Q0 + Q.OUTER + Q.TURN] = moment / c[C.PEDESTAL_ROTATIONAL]


@kernel
def begin_bearing(p, u, s, w, b, speed, carried, t):
    """Balls and cage of bearing ``b`` about its rings at rest, moved to the steady state; its clock.

    ``carried``: see `rest_alone`.
    """
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    wb = members.work(p, w, b)
    together = members.has_shaft(p)
    c = sb[S.C : S.C + C.SIZE]
    y = sb[S.Y : S.Y + Y.SIZE]
    # the steady state is found about the axis
    moved = together or is_sunk(y)
    aside_y, aside_z = bring_to_axis(pb, c, y) if moved else (0.0, 0.0)
    place_rest(pb, c, y, wb[W.FOUND : W.FOUND + EQ.SIZE], sb, wb)
    first = wb[W.PATTERN + PT.FIRST_STATE : W.PATTERN + PT.EVEN_STATE]
    for i in range(Y.SIZE):
        first[i] = y[i]
    if c[C.OVERSIZE_SCALE] != 0.0:
        if together:
            place_held(p, b, speed, first, s, w)
        else:
            place_perfect(pb, c, speed, carried, first, wb)
    if not together:
        # a rigid preload was given as the load that it means here
        c[C.PRELOAD] = u[U.PRELOAD]
    become_steady(pb, c, y, first, BOTH if together else NONE, sb, wb, speed)
    settle(pb, c, y, 0.0, speed, sb, wb)
    if moved:
        shift_bearing(pb, y, aside_y, aside_z)
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
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        for i in range(W.MOTION):
            wb[i] = 0.0
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    for i in range(ws.size):
        ws[i] = 0.0
    speed = u[U.SPEED]
    spread_choices(p)
    for b in range(members.count(p)):
        bearing_conditions(p, u, b, speed, w)
        sb = members.state(p, s, b)
        for i in range(C.USED):
            sb[S.C + i] = members.work(p, w, b)[W.CONDITIONS + i]
    together = members.has_shaft(p)
    carried = 0.0
    if together:
        status = rest_together(p, u, s, w, speed, t)
    else:
        status, carried = rest_alone(p, u, s, w, speed)
    if status != OK:
        return status
    for b in range(members.count(p)):
        if together:
            status = rest_member(p, s, w, b, speed)
            if status != OK:
                return status
        begin_bearing(p, u, s, w, b, speed, carried, t)
    copy_rows(p, s, w)
    s[S.ENERGY_START] = total_energy(p, s, w)
    s[S.ENERGY_NOW] = s[S.ENERGY_START]
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        summarise(members.parameters(p, b), sb, members.work(p, w, b))
        begin_means(sb)
    for i in range(2):
        own[SP.MEAN_HEAT + i] = own[SP.POWER_NOW + 1 + i]
    for i in range(SP.PLANE):
        own[SP.PORT_MEAN + i] = own[SP.PORT_FORCE + i]
    return OK
