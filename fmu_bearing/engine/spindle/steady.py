"""Where a set rests with the steady forces of its bearings.

``rest`` moves the set with quasi-static bearings. What friction across the tracks changes in a bearing's
force at the place it has is found with even balls, as if the bearing were displaced along its axis alone, and
added; then the set is brought to rest again. Arguments: see `members`; ``y``: see `layout.y`.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import sum_lanes
from fmu_bearing.engine.layout import EQ, PT, SP, STRIDE, C, F, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.rest import outer_row, rest
from fmu_bearing.engine.statics.held import held, held_tilted
from fmu_bearing.engine.statics.place import place_balls, place_cage
from fmu_bearing.engine.status import OK
from fmu_bearing.engine.steady.even import BOTH, make_even, settle_evenly

_ROUNDS = 8
_CLOSE = 1e-6  # of the load


@kernel
def place_rings_held(p, b, y, ws):
    """Put the rings of bearing ``b`` in the state ``y`` to where the set rested last, all else to zero."""
    at = members.scratch(p, b)
    for i in range(Y.SIZE):
        y[i] = 0.0
    for i in range(SP.HOUSING):
        y[Y.Q0 + Q.OUTER + i] = ws[at + SP.START_OUTER + i]
    for i in range(SP.PLANE):
        y[Y.Q0 + i] = ws[at + SP.START_RING + i] + ws[at + SP.START_OUTER + outer_row(i)]


@kernel
def place_held(p, b, speed, y, s, w):
    """Quasi-static state ``y`` of the perfect bearing ``b``, its rings where the set rested last."""
    pb = members.parameters(p, b)
    wb = members.work(p, w, b)
    ws = members.set_work(p, w)
    c = members.state(p, s, b)[S.C : S.C + C.SIZE]
    at = members.scratch(p, b)
    found = wb[W.FOUND : W.FOUND + EQ.SIZE]
    force = wb[W.LOAD : W.LOAD + EQ.FREEDOMS]
    ring = ws[at + SP.START_RING : at + SP.START_RING + SP.PLANE]
    tilt = ws[at + SP.START_TILT : at + SP.START_TILT + 2]
    held_tilted(pb, c, speed, ring, tilt, 0.0, force, found, wb)
    place_rings_held(p, b, y, ws)
    place_balls(pb, y, found)
    if pb[P.CAGE] != 0.0:
        place_cage(pb, y, found)


@kernel
def axial_excess(p, b, speed, s, w):
    """By how much (N) the steady force of bearing ``b`` along its axis exceeds the quasi-static one."""
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    wb = members.work(p, w, b)
    ws = members.set_work(p, w)
    c = sb[S.C : S.C + C.SIZE]
    at = members.scratch(p, b)
    found = wb[W.FOUND : W.FOUND + EQ.SIZE]
    force = wb[W.LOAD : W.LOAD + EQ.FREEDOMS]
    ring = wb[W.PATTERN + PT.STEP : W.PATTERN + PT.STEP + SP.PLANE]
    for i in range(SP.PLANE):
        ring[i] = ws[at + SP.START_RING + i] if i == Q.X else 0.0
    if speed == 0.0 or held(pb, c, speed, ring, force, found, wb) != OK or force[Q.X] == 0.0:
        return 0.0
    before = force[Q.X]
    y = wb[W.PATTERN + PT.EVEN_STATE : W.PATTERN + PT.REST_STATE]
    place_rings_held(p, b, y, ws)
    place_balls(pb, y, found)
    if pb[P.CAGE] != 0.0:
        place_cage(pb, y, found)
    make_even(pb, c, y, speed)
    scale = c[C.OVERSIZE_SCALE]
    c[C.OVERSIZE_SCALE] = 0.0
    excess = 0.0
    if settle_evenly(pb, c, y, speed, BOTH, wb, sb[S.JAC : S.CONDENSED]):
        right_hand_side(pb, c, y, 0.0, speed, 0.0, wb, wb[W.F : W.F + F.SIZE])
        excess = sum_lanes(wb, W.BODY + Q.X * STRIDE, int(pb[P.LANES])) - before
    c[C.OVERSIZE_SCALE] = scale
    return excess


@kernel
def rest_steadily(p, s, w, speed):
    """Bring the unknowns to rest with the steady forces of the bearings; status code, as of ``rest``."""
    ws = members.set_work(p, w)
    for b in range(members.count(p)):
        ws[members.scratch(p, b) + SP.START_MORE] = 0.0
    status = rest(p, s, w, speed)
    for _ in range(_ROUNDS):
        if status != OK:
            break
        far = False
        for b in range(members.count(p)):
            at = members.scratch(p, b)
            excess = axial_excess(p, b, speed, s, w)
            if abs(excess - ws[at + SP.START_MORE]) > _CLOSE * abs(ws[at + SP.START_FORCE + Q.X]):
                far = True
            ws[at + SP.START_MORE] = excess
        # also where nothing moves any more: the search has left the bearings elsewhere
        status = rest(p, s, w, speed)
        if not far:
            break
    return status
