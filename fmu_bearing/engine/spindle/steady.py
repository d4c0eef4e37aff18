"""Where perfect bearings rest with their steady forces.

``rest`` moves all with quasi-static bearings. By how much steady forces exceed quasi-static ones is found
with the rings where they rest, and added; then the set is brought to rest again. Fidelity full counts it on
all rows of both rings, with what loads across the axis do to balls and cage; rings and response, which are
linearised about even balls, along the axis alone. The steady state of a single bearing is found with free
rings, so that nothing is added. Arguments: see `members`; ``y``: see `layout.y`.

States here have the outer ring's centre on the axis: a shift of the whole bearing changes no force.
"""

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import sum_lanes
from fmu_bearing.engine.layout import EQ, PT, SP, STRIDE, C, F, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.bodies import land_forces
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.rest import rest, show_ring_forces
from fmu_bearing.engine.spindle.rest_unknowns import put_rings_in_state
from fmu_bearing.engine.spindle.shaft import weighs
from fmu_bearing.engine.statics.place import place_balls, place_cage, upright_point
from fmu_bearing.engine.statics.quasistatic import forces_at_displacement
from fmu_bearing.engine.status import OK
from fmu_bearing.engine.steady.even import BOTH, equalise_balls, settle_evenly
from fmu_bearing.engine.steady.point import REST, settle_at_rest

_ROUNDS = 8
_CLOSE = 1e-6  # of the load


@kernel
def place_at_rest(p, b, speed, y, s, w):
    """Quasi-static state ``y`` of the perfect bearing ``b``, its rings where they rested last.

    Forces of its balls on the inner ring are left in ``W.LOAD``.
    """
    pb = members.parameters(p, b)
    wb = members.work(p, w, b)
    ws = members.set_work(p, w)
    c = members.state(p, s, b)[S.C : S.C + C.SIZE]
    at = members.scratch(p, b)
    eq = wb[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE]
    force = wb[W.LOAD : W.LOAD + EQ.FREEDOMS]
    ring = ws[at + SP.START_RING : at + SP.START_RING + SP.PLANE]
    tilt = ws[at + SP.START_TILT : at + SP.START_TILT + 2]
    forces_at_displacement(pb, c, speed, ring, tilt, 0.0, force, eq, wb)
    for i in range(Y.SIZE):
        y[i] = 0.0
    put_rings_in_state(p, b, y, ws)
    for i in (Q.Y, Q.Z):
        y[Y.Q0 + i] -= y[Y.Q0 + Q.OUTER + i]
        y[Y.Q0 + Q.OUTER + i] = 0.0
    place_balls(pb, y, eq)
    if pb[P.CAGE] != 0.0:
        place_cage(pb, y, eq)


@kernel
def axial_excess(p, b, speed, s, w):
    """By how much (N) the steady force of bearing ``b`` along its axis exceeds the quasi-static one.

    With even balls, as if the bearing were displaced along its axis alone; ``c`` has no imperfections.
    """
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    wb = members.work(p, w, b)
    ws = members.set_work(p, w)
    c = sb[S.C : S.C + C.SIZE]
    at = members.scratch(p, b)
    y = wb[W.PATTERN + PT.EVEN_STATE : W.PATTERN + PT.REST_STATE]
    shift, outer = ws[at + SP.START_RING + Q.X], ws[at + SP.START_OUTER + Q.X]
    if speed == 0.0 or upright_point(pb, c, speed, shift, outer, y, wb) != OK or wb[W.LOAD + Q.X] == 0.0:
        return 0.0
    before = wb[W.LOAD + Q.X]
    equalise_balls(pb, c, y, speed)
    if not settle_evenly(pb, c, y, speed, BOTH, wb, sb[S.JAC : S.CONDENSED]):
        return 0.0
    right_hand_side(pb, c, y, 0.0, speed, 0.0, wb, wb[W.F : W.F + F.SIZE])
    return sum_lanes(wb, W.BODY + Q.X * STRIDE, int(pb[P.LANES])) - before


@kernel
def show_steady_forces(p, b, y, speed, s, w, out, to):
    """Put to ``out[to:]`` what balls, lands and weights put on all rows of both rings at the state ``y``."""
    pb = members.parameters(p, b)
    wb = members.work(p, w, b)
    c = members.state(p, s, b)[S.C : S.C + C.SIZE]
    f = wb[W.F : W.F + F.SIZE]
    right_hand_side(pb, c, y, 0.0, speed, 0.0, wb, f)
    for i in range(Q.RINGS):
        out[to + i] = sum_lanes(wb, W.BODY + i * STRIDE, int(pb[P.LANES]))
    if pb[P.CAGE] != 0.0 and pb[P.LAND] != 0.0:
        for i in range(F.SIZE):
            f[i] = 0.0
        land_forces(pb, c, y, speed, f, wb)
        for i in range(Q.RINGS):
            out[to + i] += f[F.BODY + i]
    if weighs(p):
        out[to + Q.Z] -= GRAVITY * pb[P.INNER_MASS]
        out[to + Q.OUTER + Q.Z] -= GRAVITY * pb[P.OUTER_MASS]


@kernel
def find_excess(p, b, speed, across, s, w):
    """Put to ``START_PULL`` by how much steady forces of bearing ``b`` exceed quasi-static ones, by rows."""
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    wb = members.work(p, w, b)
    ws = members.set_work(p, w)
    c = sb[S.C : S.C + C.SIZE]
    to = members.scratch(p, b) + SP.START_LOAD
    if across and speed != 0.0:
        first = wb[W.PATTERN + PT.FIRST_STATE : W.PATTERN + PT.EVEN_STATE]
        place_at_rest(p, b, speed, first, s, w)
        before = members.scratch(p, b) + SP.START_BEFORE
        show_ring_forces(p, b, speed, wb[W.LOAD : W.LOAD + EQ.FREEDOMS], s, w, ws, before)
        if settle_at_rest(pb, c, first, speed, BOTH, wb, sb[S.JAC : S.CONDENSED]) == REST:
            show_steady_forces(p, b, wb[W.PATTERN + PT.REST_STATE : W.PATTERN + PT.WHIRL_STATE], speed, s, w,
                               ws, to)  # fmt: skip
            for i in range(Q.RINGS):
                ws[to + i] -= ws[before + i]
            return
    for i in range(SP.LANES):
        ws[to + i] = 0.0
    ws[to + Q.X] = axial_excess(p, b, speed, s, w)
    ws[to + Q.OUTER + Q.X] = -ws[to + Q.X]


@kernel
def add_excess(p, b, speed, across, s, w):
    """Renew by how much steady forces of bearing ``b`` exceed quasi-static ones; whether that has moved."""
    ws = members.set_work(p, w)
    c = members.state(p, s, b)[S.C : S.C + C.SIZE]
    at = members.scratch(p, b)
    # imperfections pass, and what they do to a rest is in the quasi-static forces
    scale, eccentric, of_cage = c[C.OVERSIZE_SCALE], c[C.ECCENTRICITY], c[C.CAGE_ECCENTRICITY]
    c[C.OVERSIZE_SCALE] = 0.0
    c[C.ECCENTRICITY] = 0.0
    c[C.CAGE_ECCENTRICITY] = 0.0
    find_excess(p, b, speed, across, s, w)
    c[C.OVERSIZE_SCALE] = scale
    c[C.ECCENTRICITY] = eccentric
    c[C.CAGE_ECCENTRICITY] = of_cage
    load = abs(ws[at + SP.START_FORCE + Q.X])
    if across:
        load += abs(ws[at + SP.START_FORCE + Q.Y]) + abs(ws[at + SP.START_FORCE + Q.Z])
    moved = False
    for i in range(Q.RINGS):
        is_force = i < Q.TURN or Q.OUTER <= i < Q.OUTER + Q.TURN
        lever = 1.0 if is_force else members.parameters(p, b)[P.PITCH_RADIUS]
        if abs(ws[at + SP.START_LOAD + i] - ws[at + SP.START_MORE + i]) > _CLOSE * load * lever:
            moved = True
        ws[at + SP.START_MORE + i] = ws[at + SP.START_LOAD + i]
    return moved


@kernel
def rest_steadily(p, s, w, speed, across):
    """Bring the unknowns to rest with the steady forces of the bearings; status code, as of ``rest``.

    ``across``: all of them, else along the axis alone.
    """
    show_excess(p, s, w, not across)
    status = rest(p, s, w, speed, 0.0)
    for _ in range(_ROUNDS if members.has_shaft(p) else 0):
        if status != OK:
            break
        far = False
        for b in range(members.bearing_count(p)):
            if add_excess(p, b, speed, across, s, w):
                far = True
        # also where nothing moves any more: the search has left the bearings elsewhere
        status = rest(p, s, w, speed, 0.0)
        if not far:
            break
    for b in range(members.bearing_count(p)):
        keep_rest(p, b, s, w)
    return status


@kernel
def show_excess(p, s, w, known):
    """Put to ``START_MORE`` by how much steady forces exceed quasi-static ones, if ``known``, or zeros."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    for b in range(members.bearing_count(p)):
        at = members.scratch(p, b) + SP.START_MORE
        for i in range(SP.LANES):
            ws[at + i] = 0.0
        if known:
            ws[at + Q.X] = own[members.per_bearing(p, b) + SP.EXCESS]
            ws[at + Q.OUTER + Q.X] = -ws[at + Q.X]


@kernel
def keep_rest(p, b, s, w):
    """Keep where the rings of bearing ``b`` rest, and by how much its steady force exceeds the other."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    bearing_at = members.per_bearing(p, b)
    at = members.scratch(p, b)
    own[bearing_at + SP.EXCESS] = ws[at + SP.START_MORE + Q.X]
    for i in range(SP.START_LOAD - SP.START_RING):
        own[bearing_at + SP.RESTED + i] = ws[at + SP.START_RING + i]


@kernel
def show_rest(p, b, s, w):
    """Put what `keep_rest` has kept back to the scratch."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    bearing_at = members.per_bearing(p, b)
    at = members.scratch(p, b)
    ws[at + SP.START_MORE + Q.X] = own[bearing_at + SP.EXCESS]
    for i in range(SP.START_LOAD - SP.START_RING):
        ws[at + SP.START_RING + i] = own[bearing_at + SP.RESTED + i]


@kernel
def rest_as_known(p, s, w, speed):
    """As `rest_steadily` along the axis, with the excess of the steady forces as it is known; status code."""
    show_excess(p, s, w, True)
    status = rest(p, s, w, speed, 0.0)
    for b in range(members.bearing_count(p)):
        keep_rest(p, b, s, w)
    return status


@kernel
def renew_excess(p, b, speed, s, w):
    """Renew by how much the steady force of bearing ``b`` exceeds the quasi-static one where it rests."""
    show_rest(p, b, s, w)
    add_excess(p, b, speed, False, s, w)
    keep_rest(p, b, s, w)
