"""Fidelity `response` while its inputs drift: what is frozen goes along with them between renewals.

The last two renewals give two points of a drift. Where conditions have moved along the line through both, the
equilibrium, heats and torque move along it, too, and are off by the square of the way alone. Lines stay those
of the last renewal. So a drift along a line has fewer renewals than other changes: two of them may be as far
apart as lines, levels and heats allow, which is measured at each (`take_along`). What is frozen is found for
inputs ahead of those of now by half of that way (`aim_inputs`). Where conditions leave the line, or rest,
renewals are due as without a drift.

Before, a drift was renewed every 0.5 % of viscosity. Arguments: see `spindle.members`; ``dr``: numbers of the
drift, layout ``DR``; components of a change count in tolerances of `condensed.frozen.deviation`, but
viscosity, whose heats go along and which moves lines little.
"""

import math

from fmu_bearing.engine.fidelities.response.exchange import back_of, front, inputs_of
from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.fidelities.rings import frozen_points
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import DR, SP, C, L, S, U, W
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import inputs, offset_change

_RELATIVE = 1e-3  # of loads and pedestal
_VISCOSITY = 5e-3
_SPEED = 0.01
_GEOMETRY = 1e-9  # m
_OFFSET = 5e-9  # m
_FIRST = 5.0  # tolerances from one renewal to the next, at least
_MOST = 30.0  # and at most: contacts give way by some 3 % of their approach
_TWICE = 2.0  # how much farther than the last time at most
_LEVEL = 0.5  # dB: of all lines' weight from one renewal to the next; off by half of that
_HEAT = 1e-3  # of the heats: by which they are off where two more were found
_NEAREST = 0.5  # tolerances between two points of a line, at least
_FARTHEST = 60.0  # and at most: more is a jump
_BEYOND = 2.0  # of the way between both points: no farther along the line
_JUMP = 3.0  # tolerances in a step, or a millisecond of it: no drift
_SMOOTH = 30e-3  # s: partners may give temperatures every 10 ms
_REST = 1e-9  # of the way, in a step
PAUSE = 32.0  # times the pieces of a renewal: a slow drift waits as long for the next one


@kernel
def drift_of(p, s):
    """Return ``dr``."""
    return s[2 * front(p) + inputs(p) :]


@kernel
def bearing_of(b):
    """Place in ``dr`` of the numbers of bearing ``b``."""
    return DR.HEAD + b * DR.PER_BEARING


@kernel
def inputs_at(p):
    """Place in ``dr`` of the inputs that what is frozen was found for; their change before follows."""
    return DR.HEAD + members.bearing_count(p) * DR.PER_BEARING


@kernel
def relative(now, then):
    """How many tolerances a load or a stiffness is from another one."""
    return (now - then) / (_RELATIVE * abs(then) + 1e-12)


@kernel
def component(p, own, lv, b, c, speed, offset, k):
    """Component ``k`` of how far conditions ``c`` at ``speed`` are from what bearing ``b`` holds, in ``lv``.

    ``offset``: of its inner ring (m), see ``SP.FROZEN_OFFSET``.
    """
    h = L.CONDITIONS
    inner, outer = C.RACES, C.RACES + C.RACE_SIZE
    if k == 0:
        # of a set the load follows from its rest
        return 0.0 if members.has_shaft(p) else relative(c[C.PRELOAD], lv[h + C.PRELOAD])
    if k == 1:
        return relative(c[C.LOAD_Y], lv[h + C.LOAD_Y])
    if k == 2:
        return relative(c[C.LOAD_Z], lv[h + C.LOAD_Z])
    if k == 3:
        now, then = c[C.VISCOSITY], lv[h + C.VISCOSITY]
        return math.log(now / then) / _VISCOSITY if now > 0.0 and then > 0.0 else 0.0
    if k == 4:
        return relative(c[C.PEDESTAL], lv[h + C.PEDESTAL])
    if k == 5:
        return relative(c[C.BALL_RADIUS], lv[h + C.BALL_RADIUS])
    if k == 6 or k == 7:
        i = C.GROOVE_X if k == 6 else C.GROOVE_RADIUS
        return (c[outer + i] - c[inner + i] - (lv[h + outer + i] - lv[h + inner + i])) / _GEOMETRY
    if k == 8 or k == 9:
        i = (inner if k == 8 else outer) + C.FREE
        return (c[i] - lv[h + i]) / _GEOMETRY
    if k == 10:
        return (speed - lv[L.FROZEN_SPEED]) / (_SPEED * abs(lv[L.FROZEN_SPEED]) + 1e-3)
    return (offset - own[members.per_bearing(p, b) + SP.FROZEN_OFFSET]) / _OFFSET


@kernel
def note_away(p, u, s, w, b):
    """Note how far ``u`` is from what bearing ``b`` holds, after `frozen_points.set_inputs`."""
    own = members.set_state(p, s)
    lv = members.condensed(members.state(p, s, b))
    fresh = members.work(p, w, b)[W.CONDITIONS : W.CONDITIONS + C.SIZE]
    offset = own[members.per_bearing(p, b) + SP.OFFSET_COLD] + offset_change(p, u, b)
    now = drift_of(p, s)[bearing_of(b) + DR.NOW :]
    for k in range(DR.COMPONENTS):
        now[k] = component(p, own, lv, b, fresh, u[U.SPEED], offset, k)


@kernel
def renewed(p, s, b, k):
    """Component ``k`` of how far bearing ``b`` as renewed is from as frozen."""
    own, of = members.set_state(p, s), members.set_state(p, back_of(p, s))
    lv = members.condensed(members.state(p, s, b))
    new = members.condensed(members.state(p, back_of(p, s), b))
    offset = of[members.per_bearing(p, b) + SP.FROZEN_OFFSET]
    conditions = new[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    return component(p, own, lv, b, conditions, new[L.FROZEN_SPEED], offset, k)


@kernel
def go_along(p, s, share):
    """Let equilibrium, heats and torque be those at ``share`` of the line's way from what is frozen."""
    dr = drift_of(p, s)
    own = members.set_state(p, s)
    by = share - dr[DR.SHARE]
    dr[DR.SHARE] = share
    mean = members.history(p)
    change = inputs_at(p) + 2 * inputs(p)
    for i in range(members.coordinates(p)):
        own[mean + i] += by * dr[change + i]
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        lv = members.condensed(sb)
        at = bearing_of(b)
        for i in range(DR.HEATS):
            lv[L.HEAT + i] += by * dr[at + DR.HEAT + i]
        lv[L.TORQUE] += by * dr[at + DR.TORQUE]
        for i in range(DR.LOSSES):
            sb[S.LOSS + i] += by * dr[at + DR.LOSS + i]
        own[members.per_bearing(p, b) + SP.OFFSET] += by * dr[at + DR.OFFSET]
        members.place_rows(p, b, own, own, mean, lv, L.MEAN)


@kernel
def place_on_line(p, u, s, w):
    """Share of the line's way where the inputs ``u`` are, and how far aside of it, after `set_inputs`."""
    dr = drift_of(p, s)
    share = 0.0
    for b in range(members.bearing_count(p)):
        at = bearing_of(b)
        note_away(p, u, s, w, b)
        for k in range(DR.COMPONENTS):
            share += dr[at + DR.NOW + k] * dr[at + DR.CHANGE + k]
    share = min(max(share / dr[DR.SQUARE], -_BEYOND), _BEYOND)
    aside = frozen_points.largest_load_deviation(p, members.set_state(p, s))
    for b in range(members.bearing_count(p)):
        at = bearing_of(b)
        for k in range(DR.COMPONENTS):
            aside = max(aside, abs(dr[at + DR.NOW + k] - share * dr[at + DR.CHANGE + k]))
    return share, aside


@kernel
def goes_on(p, s):
    """Whether inputs drift along a line that is known."""
    dr = drift_of(p, s)
    return dr[DR.KNOWN] != 0.0 and dr[DR.RATE] != 0.0


@kernel
def begin_line(p, u, s, w):
    """Move what was just renewed, for inputs ahead, to the inputs ``u``, after `set_inputs`."""
    dr = drift_of(p, s)
    if dr[DR.KNOWN] != 0.0:
        share, aside = place_on_line(p, u, s, w)
        if aside <= 1.0:
            go_along(p, s, share)
        else:
            dr[DR.KNOWN] = 0.0


@kernel
def follow(p, u, s, w, h, off):
    """Move what is frozen along with inputs ``u`` over a step of ``h`` (s); how far it is off for renewals.

    ``off``: how far without a drift (`frozen.deviation`), just found.
    """
    dr = drift_of(p, s)
    dr[DR.SINCE] += h
    if dr[DR.KNOWN] == 0.0:
        return off
    share, aside = place_on_line(p, u, s, w)
    by = share - dr[DR.SHARE]
    if aside > 1.0 or abs(by) * dr[DR.LARGEST] > _JUMP * max(h / frozen_points.PIECE, 1.0):
        dr[DR.KNOWN] = 0.0
        return off
    go_along(p, s, share)
    dr[DR.RATE] += (by - h * dr[DR.RATE]) / (h + _SMOOTH)
    dr[DR.STILL] = dr[DR.STILL] + h if abs(by) < _REST else 0.0
    if dr[DR.STILL] > _SMOOTH:
        dr[DR.RATE] = 0.0
        return off
    lead = members.set_state(p, s)[members.march(p) + SP.MADE_LAST] * frozen_points.PIECE
    reached = (abs(share) + lead * abs(dr[DR.RATE])) * dr[DR.LARGEST]
    waited = dr[DR.SINCE] > PAUSE * lead and abs(share) * dr[DR.LARGEST] > 1.0
    if share * dr[DR.RATE] > 0.0 and (reached > 0.5 * dr[DR.ALLOWED] or waited):
        return max(off, 2.0 * _FIRST)  # due at once
    return min(off, 1.0)


@kernel
def aim_inputs(p, u, s, given):
    """Put inputs ahead of ``u`` to ``given``: of the middle of the time for which a renewal will serve.

    Those of now without a drift; the speed has an aim of its own.
    """
    dr = drift_of(p, s)
    for i in range(inputs(p)):
        given[i] = u[i]
    if dr[DR.KNOWN] == 0.0:
        return
    rate = dr[DR.RATE]
    lead = members.set_state(p, s)[members.march(p) + SP.MADE_LAST] * frozen_points.PIECE
    half = min(0.5 * dr[DR.ALLOWED] / dr[DR.LARGEST], 0.5 * PAUSE * lead * abs(rate))
    ahead = lead * rate + math.copysign(half, rate)
    ahead = min(max(ahead, -_BEYOND), _BEYOND)
    change = inputs_at(p) + inputs(p)
    for i in range(inputs(p)):
        moved = u[i] + ahead * dr[change + i]
        # never to the other side of zero, nor far towards it
        if i != U.SPEED and moved * u[i] > 0.5 * u[i] * u[i]:
            given[i] = moved


@kernel
def weight_of_lines(p, s, other):
    """Weight (m2/s2) of the lines in use, or of those of a renewal that is complete (``other``)."""
    source = back_of(p, s) if other else s
    own = members.set_state(p, source)
    if members.has_shaft(p):
        lines, size = own[members.lines(p) :], members.line_size(p)
        count = int(own[members.march(p) + SP.LINES])
        at = SP.LINE_WEIGHT
    else:
        lines, size = source[line_table(p) :], L.LINE_SIZE
        count = int(members.condensed(source)[L.COUNT])
        at = L.LINE_WEIGHT
    total = 0.0
    for k in range(count):
        total += lines[k * size + at]
    return total


@kernel
def losses(p, s):
    """Sum (W) of the heats of all bearings."""
    total = 0.0
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        for i in range(DR.HEATS):
            total += lv[L.HEAT + i]
    return total


@kernel
def level_change(p, s):
    """By how much (dB) lines of a renewal that is complete differ from those in use, all together."""
    now, then = weight_of_lines(p, s, True), weight_of_lines(p, s, False)
    return abs(10.0 * math.log10((now + 1e-300) / (then + 1e-300)))


@kernel
def take_along(p, s, level):
    """Find the line of the drift from what is frozen to what was renewed, before that is taken over.

    How far the next renewal may be follows from how far heats are from where the last line would have led,
    and from ``level``, see `level_change`.
    """
    dr = drift_of(p, s)
    own, of = members.set_state(p, s), members.set_state(p, back_of(p, s))
    count = members.bearing_count(p)
    known = dr[DR.KNOWN] != 0.0
    square, largest, along = 0.0, 0.0, 0.0
    for b in range(count):
        at = bearing_of(b) + DR.CHANGE
        for k in range(DR.COMPONENTS):
            change = renewed(p, s, b, k)
            along += change * dr[at + k]
            square += change * change
            largest = max(largest, abs(change))
    missed = 0.0
    if known:
        go_along(p, s, along / dr[DR.SQUARE])
        missed = abs(losses(p, back_of(p, s)) / (losses(p, s) + 1e-300) - 1.0)
    go_along(p, s, 0.0)
    for b in range(count):
        note_changes(p, s, dr, b)
    first, many = inputs_at(p), inputs(p)
    given = inputs_of(p, s)
    for i in range(many):
        dr[first + many + i] = given[i] - dr[first + i]
        dr[first + i] = given[i]
    mean = members.history(p)
    for i in range(members.coordinates(p)):
        dr[first + 2 * many + i] = of[mean + i] - own[mean + i]
    dr[DR.RATE] *= along / square if known and square > 0.0 else 0.0
    dr[DR.LARGEST], dr[DR.SQUARE] = largest, square
    dr[DR.SINCE], dr[DR.STILL] = 0.0, 0.0
    straight = _NEAREST < largest < _FARTHEST and not loads_changed(p, own, of)
    dr[DR.KNOWN] = 1.0 if straight else 0.0
    allowed = _TWICE * max(largest, _FIRST) if known else _FIRST
    allowed = min(allowed, largest * _LEVEL / (level + 1e-12), largest * math.sqrt(_HEAT / (missed + 1e-12)))
    dr[DR.ALLOWED] = min(max(allowed, _FIRST), _MOST)


@kernel
def note_changes(p, s, dr, b):
    """Note how bearing ``b`` as renewed differs from as frozen."""
    own, of = members.set_state(p, s), members.set_state(p, back_of(p, s))
    sb, kb = members.state(p, s, b), members.state(p, back_of(p, s), b)
    lv, new = members.condensed(sb), members.condensed(kb)
    at = bearing_of(b)
    for k in range(DR.COMPONENTS):
        dr[at + DR.CHANGE + k] = renewed(p, s, b, k)
    for i in range(DR.HEATS):
        dr[at + DR.HEAT + i] = new[L.HEAT + i] - lv[L.HEAT + i]
    dr[at + DR.TORQUE] = new[L.TORQUE] - lv[L.TORQUE]
    for i in range(DR.LOSSES):
        dr[at + DR.LOSS + i] = kb[S.LOSS + i] - sb[S.LOSS + i]
    place = members.per_bearing(p, b) + SP.OFFSET
    dr[at + DR.OFFSET] = of[place] - own[place]


@kernel
def loads_changed(p, own, of):
    """Whether loads on the set differ between what is frozen and what was renewed."""
    at = members.march(p)
    if own[at + SP.FROZEN_SPRING] != of[at + SP.FROZEN_SPRING]:
        return True
    for i in range(SP.PLANE):
        if own[at + SP.FROZEN_NOSE + i] != of[at + SP.FROZEN_NOSE + i]:
            return True
    return False


@kernel
def begin_drift(p, u, s):
    """Begin without a drift, frozen at the inputs ``u``."""
    dr = drift_of(p, s)
    first = inputs_at(p)
    for i in range(first + 2 * inputs(p) + members.padded_size(p)):
        dr[i] = 0.0
    for i in range(inputs(p)):
        dr[first + i] = u[i]
