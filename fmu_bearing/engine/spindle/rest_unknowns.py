"""What moves where a set or a single bearing comes to rest: the unknowns of `rest`, and the rings by them.

Unknowns: coordinates of shaft, housing and sliding rings, places x y z (m) and tilts (rad) of each ring on a
pedestal of its own. A single bearing has its inner ring in the place of a shaft. ``z``: place of the unknowns
in the set's own work space; each bearing's part of the scratch has ``SP.START_RING`` and what follows it.
Other arguments: see `members`.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, C, P, Q, Y
from fmu_bearing.engine.layout.sizes import FOUR
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.port import has_port


@kernel
def on_pedestal(p, b):
    """Whether the outer ring of bearing ``b`` is on a pedestal of its own."""
    return p[members.row(p, b) + SP.ROW_SEAT] == SP.PEDESTAL


@kernel
def shared_unknowns(p):
    """Return how many unknowns no ring has for its own: the coordinates, or a single bearing's inner ring."""
    return members.coordinates(p) if members.has_shaft(p) else SP.PLANE


@kernel
def driven_rows(p, b):
    """Return how many rows of the rings of bearing ``b`` these unknowns move."""
    return int(p[members.row(p, b) + SP.ROW_DRIVEN]) if members.has_shaft(p) else SP.PLANE


@kernel
def row_motion(p, b, i, k):
    """How driven row ``i`` of bearing ``b`` moves by shared unknown ``k``."""
    if not members.has_shaft(p):
        return 1.0 if i == k else 0.0
    return p[int(p[members.row(p, b) + SP.ROW_AT_T]) + k * SP.LANES + i]


@kernel
def given_rows(p):
    """Return how many of the first unknowns are given: a shaft's at a port, the place of a rigid preload."""
    if has_port(p):
        return SP.PLANE
    return 1 if p[P.RIGID] != 0.0 else 0


@kernel
def free_rows(p, b):
    """Return how many unknowns the outer ring of bearing ``b`` has for its own."""
    return SP.PLANE if on_pedestal(p, b) and driven_rows(p, b) < SP.DRIVEN else 0


@kernel
def unknowns(p):
    """Return how many unknowns the start has."""
    total = shared_unknowns(p)
    for b in range(members.bearing_count(p)):
        total += free_rows(p, b)
    return total


@kernel
def first_unknown(p, b):
    """Return the first unknown of the outer ring of bearing ``b``."""
    total = shared_unknowns(p)
    for k in range(b):
        total += free_rows(p, k)
    return total


@kernel
def start_vector(p, k):
    """Place in the set's own work space of the start's ``k``-th vector; each has whole groups of lanes."""
    count = unknowns(p)
    apart = (count + FOUR - 1) // FOUR * FOUR
    return members.matrix(p) + count * (count + 1) + k * apart


@kernel
def outer_row(i):
    """Row of the outer ring for row ``i`` of the inner one, which has no rotation about its axis."""
    return i if i < Q.TURN else i + 1


@kernel
def put_rings(p, b, ws, own, z):
    """Put the places of the rings of bearing ``b`` for the unknowns ``ws[z:]`` into its scratch."""
    at = members.scratch(p, b)
    members.place_rows(p, b, own, ws, z, ws, at + SP.START_LOAD)
    for i in range(SP.HOUSING):
        ws[at + SP.START_OUTER + i] = 0.0
    for i in range(driven_rows(p, b)):
        if i >= Q.OUTER:
            ws[at + SP.START_OUTER + i - Q.OUTER] = ws[at + SP.START_LOAD + i]
    mine = z + first_unknown(p, b)
    for i in range(free_rows(p, b)):
        ws[at + SP.START_OUTER + outer_row(i)] = ws[mine + i]
    for i in range(SP.PLANE):
        place = ws[at + SP.START_LOAD + i]
        ws[at + SP.START_RING + i] = place - ws[at + SP.START_OUTER + outer_row(i)]
    for i in range(2):
        ws[at + SP.START_TILT + i] = ws[at + SP.START_OUTER + Q.BY + i]


@kernel
def put_rings_in_state(p, b, y, ws):
    """Put the rings of bearing ``b`` in the state ``y`` to where they were settled last."""
    at = members.scratch(p, b)
    for i in range(SP.HOUSING):
        y[Y.Q0 + Q.OUTER + i] = ws[at + SP.START_OUTER + i]
    for i in range(SP.PLANE):
        y[Y.Q0 + i] = ws[at + SP.START_RING + i] + ws[at + SP.START_OUTER + outer_row(i)]


@kernel
def neutral_aside(p, b, c, w):
    """Move the pedestal in ``c`` so that the outer ring of bearing ``b``, settled last, is on the axis."""
    ws = members.set_work(p, w)
    at = members.scratch(p, b) + SP.START_OUTER
    c[C.NEUTRAL_Y] = -ws[at + Q.Y]
    c[C.NEUTRAL_Z] = -ws[at + Q.Z]


@kernel
def ring_motion(p, b, i, out, to):
    """Put to ``out[to:]`` how row ``i`` of inner against outer ring, bearing ``b``, moves by each unknown."""
    for k in range(unknowns(p)):
        out[to + k] = 0.0
    for m in range(driven_rows(p, b)):
        sign = 1.0 if m == i else -1.0 if m == Q.OUTER + outer_row(i) else 0.0
        if sign != 0.0:
            for k in range(shared_unknowns(p)):
                out[to + k] += sign * row_motion(p, b, m, k)
    if i < free_rows(p, b):
        out[to + first_unknown(p, b) + i] -= 1.0
