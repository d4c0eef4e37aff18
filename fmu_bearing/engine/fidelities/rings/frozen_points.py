"""What bearings hold in fidelities rings and response: a single one at its inputs, of a set as it rests.

Arguments: see `spindle.members`.
"""

import math

from fmu_bearing.engine.fidelities.condensed.carried import freeze_carried
from fmu_bearing.engine.fidelities.condensed.frozen import (
    apply_rigid_preload,
    deviation,
    freeze_at,
    frozen_conditions,
)
from fmu_bearing.engine.fidelities.condensed.shared import (
    build_operator,
    even_spacing,
)
from fmu_bearing.engine.fidelities.condensed.uneven import (
    begin_uneven,
    freeze_uneven,
    go_on_uneven,
    uneven_out_of_date,
)
from fmu_bearing.engine.fidelities.full.start import start
from fmu_bearing.engine.fidelities.rings.rest import find_levers
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, PT, SP, ST, STRIDE, C, L, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.contact import carries_both_ways
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import (
    bearing_conditions,
    bearing_inputs,
    growth_rate,
    loads_differ,
    offset_change,
    take_loads,
)
from fmu_bearing.engine.spindle.rest import begin_rest, keep_stiffness, settle_bearing
from fmu_bearing.engine.spindle.rest_unknowns import neutral_aside, put_rings_in_state, start_vector
from fmu_bearing.engine.spindle.steady import (
    place_at_rest,
    renew_excess,
    rest_as_known,
    rest_steadily,
    show_rest,
)
from fmu_bearing.engine.statics.axial import TOUCHING, quasistatic
from fmu_bearing.engine.statics.place import place_balls, upright_point
from fmu_bearing.engine.status import OK
from fmu_bearing.engine.steady.even import BOTH, NONE, OUTER

PIECE = 1e-3  # s of simulated time per piece of a renewal
MOST = 1000.0  # pieces in a communication step: more than any renewal with all its searches has
FAR = 0.2  # of the speed: where it is that far from what is frozen, all pieces are made at once
# Renewals in a drift of the inputs pause for this many times the pieces of the last one, unless what is
# frozen is off by so many times its tolerance that it cannot wait (``hurry``). At rest it is within it.
PAUSE = 4.0
_NEAR = 1e-3  # of a load
_TRIES = 4  # axial loads, ten times as large each, where balls find no rest under the one that is asked for
# m: two contacts at some 15 degrees give way by half of that, an approach changes by an eighth: the 1e-9 that
# a bearing's own geometry may change by
_GROWN = 5e-9


@kernel
def store_loads(p, own):
    """Store the loads on the set at which its bearings' quasi-static points were found."""
    at = members.march(p)
    for i in range(SP.PLANE):
        own[at + SP.FROZEN_NOSE + i] = own[SP.NOSE + i]
    own[at + SP.FROZEN_SPRING] = own[SP.SPRING]
    own[at + SP.FROZEN_PEDESTAL] = own[SP.PEDESTAL_STIFFNESS + Q.Y]


@kernel
def load_deviation(value, noted):
    """How far a load is from the stored one; 1: as far as it may be at rest."""
    return abs(value - noted) / (_NEAR * abs(noted) + 1e-12)


@kernel
def largest_load_deviation(p, own):
    """How far the loads on the set are from the stored ones, see `load_deviation`."""
    at = members.march(p)
    most = load_deviation(own[SP.SPRING], own[at + SP.FROZEN_SPRING])
    most = max(most, load_deviation(own[SP.PEDESTAL_STIFFNESS + Q.Y], own[at + SP.FROZEN_PEDESTAL]))
    for i in range(SP.PLANE):
        most = max(most, load_deviation(own[SP.NOSE + i], own[at + SP.FROZEN_NOSE + i]))
    return most


@kernel
def swap_offsets(p, own):
    """Exchange the offsets with the ones that the inputs ask for, which ``SP.FROZEN_OFFSET`` holds."""
    for b in range(members.bearing_count(p)):
        bearing_at = members.per_bearing(p, b)
        now = own[bearing_at + SP.OFFSET]
        own[bearing_at + SP.OFFSET] = own[bearing_at + SP.FROZEN_OFFSET]
        own[bearing_at + SP.FROZEN_OFFSET] = now


@kernel
def take_offsets(p, own):
    """Put the inner rings where temperatures hold them, without a ramp."""
    for b in range(members.bearing_count(p)):
        bearing_at = members.per_bearing(p, b)
        own[bearing_at + SP.OFFSET] = own[bearing_at + SP.FROZEN_OFFSET]
        own[bearing_at + SP.OFFSET_RATE] = 0.0


@kernel
def freeze_all(p, u, at_once, s, w):
    """Renew what all bearings hold, of a set where it rests at the inputs ``u``; status code.

    ``at_once``: see `uneven.freeze_uneven`.
    """
    status = freeze_points(p, u, False, at_once, s, w)
    if status == OK:
        for b in range(members.bearing_count(p)):
            build_operator(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))
    return status


@kernel
def freeze_points(p, u, known, at_once, s, w):
    """As `freeze_all`, but leave the operators (`build_operator`) as they are; ``known``: see `rest_set`."""
    status = rest_set(p, u, known, s, w)
    for b in range(members.bearing_count(p)):
        if status == OK:
            status = freeze_point(p, u, b, at_once, s, w)
    return status


@kernel
def find_even(p, c, speed, outer, y, w):
    """Quasi-static state ``y`` of even balls under the axial load in ``c``; status code.

    ``outer``: place of the outer ring along the axis (m).
    """
    axial = w[W.STILL_EQUILIBRIUM : W.STILL_END]
    status = quasistatic(p, c, speed, axial)
    if status == OK:
        status = upright_point(p, c, speed, axial[ST.AXIAL_SHIFT], outer, y, w)
    return status


@kernel
def freeze_point(p, u, b, at_once, s, w):
    """Renew what bearing ``b`` holds but its operator, where `rest_set` has found it at rest."""
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    wb = members.work(p, w, b)
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    lv = members.condensed(sb)
    c = lv[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    y = lv[L.Y0 : L.Y0 + Y.SIZE]
    together = members.has_shaft(p)
    rigid = pb[P.RIGID] != 0.0
    speed = u[U.SPEED]
    given = ws[SP.INPUT : SP.INPUT + U.SIZE]
    bearing_inputs(p, u, b, given)
    show_rest(p, b, s, w)
    at = members.scratch(p, b)
    carried = -ws[at + SP.START_FORCE]
    if carried > -TOUCHING or not carries_both_ways(pb):
        carried = max(carried, TOUCHING)
    if together:
        given[U.PRELOAD] = carried
    turning = frozen_conditions(pb, given, speed, lv, c)
    if rigid or pb[P.SUPPORT_STIFFNESS] != 0.0:
        # mount and springs leave the balls the load that the present sizes and speed ask for
        c[C.PRELOAD] = carried
    status = find_even(pb, c, turning, ws[at + SP.START_OUTER], y, wb)
    for _ in range(_TRIES):
        if status == OK:
            break
        # balls that just touch may find no rest: some load along the axis gives even ones
        c[C.PRELOAD] = math.copysign(10.0 * max(abs(c[C.PRELOAD]), TOUCHING), c[C.PRELOAD])
        status = find_even(pb, c, turning, ws[at + SP.START_OUTER], y, wb)
    if status == OK:
        if rigid:
            y[Y.Q0] = sb[S.PLACE]
            own[members.history(p) + Q.X] = sb[S.PLACE]
        else:
            c[C.PRELOAD] = given[U.PRELOAD]
        freeze_at(pb, speed, turning, OUTER if together else NONE, sb, wb)
        if together:
            # what the shaft puts across the axis counts as this bearing's load
            force = at + SP.START_FORCE
            c[C.LOAD_Y], c[C.LOAD_Z] = ws[force + Q.Y], ws[force + Q.Z]
        if uneven_out_of_date(lv, c, speed):
            first = wb[W.PATTERN + PT.FIRST_STATE : W.PATTERN + PT.EVEN_STATE]
            place_at_rest(p, b, turning, first, s, w)
            begin_uneven(c, speed, turning, BOTH if together else NONE, sb, wb)
            neutral_aside(p, b, lv[L.SEARCH_CONDITIONS : L.SEARCH_CONDITIONS + C.SIZE], w)
        c[C.LOAD_Y], c[C.LOAD_Z] = given[U.LOAD_Y], given[U.LOAD_Z]
        freeze_uneven(pb, speed, at_once, sb, wb)
        if lv[L.MORE_KNOWN] == L.CARRIED:
            carried_state = wb[W.PATTERN + PT.FIRST_STATE : W.PATTERN + PT.EVEN_STATE]
            place_at_rest(p, b, turning, carried_state, s, w)
            freeze_carried(pb, c, carried_state, speed, turning, sb, wb)
        bearing_at = members.per_bearing(p, b)
        own[bearing_at + SP.FROZEN_OFFSET] = own[bearing_at + SP.OFFSET_COLD] + offset_change(p, u, b)
    c[C.PRELOAD] = given[U.PRELOAD]
    return status


@kernel
def renew_excess_force(p, u, b, s, w):
    """Renew the steady force of bearing ``b`` where `rest_set` has found it at rest."""
    renew_excess(p, b, u[U.SPEED], s, w)
    members.set_state(p, s)[members.march(p) + SP.AIM] = u[U.SPEED]


@kernel
def rest_set(p, u, known, s, w):
    """Find where all rests at the inputs ``u``, with perfect bearings; status code.

    ``known``: with the excess of its bearings' steady forces as it is known, see `renew_excess_force`. The
    coordinates there are left among the set's own work space's vectors, see ``SP.UNKNOWNS``.
    """
    own = members.set_state(p, s)
    if p[P.RIGID] != 0.0 and u[U.PRELOAD] != members.condensed(s)[L.CONDITIONS + C.PRELOAD]:
        apply_rigid_preload(p, u, s, w)
    for b in range(members.bearing_count(p)):
        bearing_at = members.per_bearing(p, b)
        own[bearing_at + SP.FROZEN_OFFSET] = own[bearing_at + SP.OFFSET_COLD] + offset_change(p, u, b)
    swap_offsets(p, own)
    begin_rest(p, s, w, u[U.SPEED])
    if known:
        status = rest_as_known(p, s, w, u[U.SPEED])
    else:
        status = rest_steadily(p, s, w, u[U.SPEED], False)
        own[members.march(p) + SP.AIM] = u[U.SPEED]
    swap_offsets(p, own)
    if status != OK:
        return status
    keep_stiffness(p, s, w)
    store_loads(p, own)
    return OK


@kernel
def settle_all(p, u, s, w):
    """Put all to where `rest_set` has found its rest, and the balls' places there to ``L.EVEN``."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    z = start_vector(p, SP.UNKNOWNS)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        settle_bearing(p, s, w, b, u[U.SPEED], 0.0, z, start_vector(p, SP.TRIAL_FORCES))
        y = wb[W.STAGE : W.STAGE + Y.SIZE]
        put_rings_in_state(p, b, y, ws)
        place_balls(members.parameters(p, b), y, wb[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE])
        lv = members.condensed(members.state(p, s, b))
        for j in range(STRIDE):
            lv[L.EVEN + j] = y[Y.X + j]
            lv[L.EVEN_R + j] = y[Y.R + j]
    for i in range(members.coordinates(p)):
        own[SP.S_HEAD + i] = ws[z + i] if members.has_shaft(p) else w[W.STAGE + Y.Q0 + i]


@kernel
def freeze_from_zero(p, u, s, w):
    """As `freeze_all`, but search the rest from zero coordinates, and put all there; status code.

    The balls' places, ball 0 at angle 0, go to ``L.EVEN``.
    """
    own = members.set_state(p, s)
    for i in range(3 * members.padded_size(p)):
        own[SP.S_HEAD + i] = 0.0
    status = freeze_all(p, u, False, s, w)
    if status != OK:
        return status
    take_offsets(p, own)
    settle_all(p, u, s, w)
    return OK


@kernel
def start_frozen(p, u, s, w, t):
    """Start of fidelities rings and response: that of fidelity full, then what is frozen; status code.

    The balls' places at rest on even races, ball 0 at angle 0, go to ``L.EVEN``.
    """
    status = start(p, u, s, w, t)
    if status != OK:
        return status
    find_levers(p, members.set_state(p, s))
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        lv = members.condensed(sb)
        even_spacing(members.parameters(p, b), lv)
        for j in range(STRIDE):
            lv[L.EVEN + j] = sb[S.Y + Y.X + j]
            lv[L.EVEN_R + j] = sb[S.Y + Y.R + j]
    return freeze_all(p, u, True, s, w)


@kernel
def set_inputs(p, u, s, w, h):
    """Set conditions, loads and ramps; the `deviation` of what is frozen."""
    own = members.set_state(p, s)
    speed = u[U.SPEED]
    rate = (speed - s[S.SPEED]) / h
    middle = 0.5 * (s[S.SPEED] + speed)
    if loads_differ(p, u, own):
        take_loads(p, u, own)
    most = largest_load_deviation(p, own)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        fresh = members.work(p, w, b)[W.CONDITIONS : W.CONDITIONS + C.SIZE]
        lv = members.condensed(sb)
        bearing_conditions(p, u, b, middle, w)
        for i in range(C.USED):
            sb[S.C + i] = fresh[i]
        sb[S.SPEED_RATE] = rate
        bearing_at = members.per_bearing(p, b)
        own[bearing_at + SP.OFFSET_RATE] = growth_rate(p, u, own, b, h)
        if members.has_shaft(p):
            # the load follows from the set's rest, see above
            fresh[C.PRELOAD] = lv[L.CONDITIONS + C.PRELOAD]
        grown = own[bearing_at + SP.OFFSET_COLD] + offset_change(p, u, b) - own[bearing_at + SP.FROZEN_OFFSET]
        most = max(most, deviation(lv, fresh, speed), abs(grown) / _GROWN)
    return most


@kernel
def due(p, s, off, hurry, patient, h):
    """Whether a renewal may begin in a step of ``h`` (s); ``off``: see `condensed.frozen`.

    What a search has found is taken as soon as it has come to its end, or if ``patient`` with the next
    renewal.
    """
    own = members.set_state(p, s)
    at = members.march(p) + SP.PAUSE
    own[at] = max(own[at] - h / PIECE, 0.0)
    for b in range(members.bearing_count(p)):
        if not patient and members.condensed(members.state(p, s, b))[L.SEARCH_STATE] == L.ENDED:
            return True
    return off > hurry or (off > 1.0 and own[at] <= 0.0)


@kernel
def pause(p, s, pieces):
    """Let renewals pause after one of so many ``pieces``."""
    members.set_state(p, s)[members.march(p) + SP.PAUSE] = PAUSE * pieces


@kernel
def pieces_due(p, s, h):
    """Count of pieces of work that are due in the communication step ``h`` (s): one per `PIECE` of time."""
    own = members.set_state(p, s)
    at = members.march(p) + SP.PIECES
    own[at] += min(h / PIECE, MOST)
    due = math.floor(own[at] + 1e-9)
    own[at] -= due
    return due


@kernel
def speeds_differ(one, other):
    """Whether two speeds (rad/s) are so far apart that what is frozen at one does not serve the other."""
    return abs(one - other) > FAR * max(abs(one), abs(other)) + 1.0


@kernel
def searching(p, s):
    """Whether a search for what uneven balls add is going."""
    for b in range(members.bearing_count(p)):
        if members.condensed(members.state(p, s, b))[L.SEARCH_STATE] == L.GOING:
            return True
    return False


@kernel
def search_piece(p, s, w):
    """Make one piece of a search in the first bearing that waits for one; whether it came to its end."""
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        lv = members.condensed(sb)
        if lv[L.SEARCH_STATE] == L.GOING:
            go_on_uneven(members.parameters(p, b), sb, members.work(p, w, b))
            return lv[L.SEARCH_STATE] == L.ENDED
    return False
