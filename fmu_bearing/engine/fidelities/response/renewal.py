"""Renewal of what is frozen, of the equilibrium, of lines and their sound, in pieces beside those in use.

A renewal takes 1 to 10 ms of a processor's time. A model in a loop of 1 ms cannot wait for that, so the work
is cut into pieces of some 0.2 ms, one for each millisecond that is simulated (`frozen_points.PIECE`), and
goes on in a second state behind the one that steps go on from (`back_of`), which takes over what was renewed
when it is complete. Meanwhile the old lines serve, with phases at the speed of now. In a ramp one renewal
follows the other, for the speed that will be reached in the middle of the time in which it serves: a
resonance may be as narrow as 0.5 % of the speed. Where a ramp ends lines are renewed for the speed at which
it rests.

A search for what uneven balls add (``condensed.uneven``) goes on in the state in use, and shares the pieces.
Arguments: see `spindle.members`; ``stage``: of `pieces`; ``back``: the second state.
"""

from fmu_bearing.engine.fidelities.response import drift
from fmu_bearing.engine.fidelities.response.exchange import (
    BLEND,
    back_of,
    copy,
    end_blend,
    exchange_lines,
    front,
    inputs_of,
    share_in_use,
)
from fmu_bearing.engine.fidelities.response.line_sound import from_lines
from fmu_bearing.engine.fidelities.response.pieces import (
    ANSWER,
    COMPLETE,
    HOLD,
    IDLE,
    LINES,
    SETTLE,
    enter,
    piece,
)
from fmu_bearing.engine.fidelities.rings import frozen_points
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD, SP, L, S, U
from fmu_bearing.engine.readout.motion import sound_block
from fmu_bearing.engine.sound import beats
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import inputs
from fmu_bearing.engine.status import OK

_GUESS = 8.0  # pieces of the first renewal
# how far lines may be off once a renewal that begins now is complete: this many times what the speed changes
# by meanwhile, at most and at least these parts of the speed
_CALM = 10.0
_DRIFT = 1e-3
_REST = 1e-6
_STILL = 1e-4  # rad/s: and this much
_AHEAD = 0.6  # of a drift: how far beyond the speed at which they come into use lines are found
_SOON = 0.1  # s: no farther than a ramp comes in that time
_SMOOTH = 10e-3  # s: a speed with noise has no rate from one step to the next,
_PACE = 20.0  # 1/s: and one that changes by more than this part of it jumps
_NEAR = 1e-3  # of an input: what is frozen may be off by as much
_HURRY = 5.0  # of what is frozen; new lines come in by and by
# Where a set is so far behind, by these parts of the speed or times what may be off, it makes more pieces.
_LATE = 0.03
_LOST = 50.0
_CATCH_UP = 3.0
_SEARCHES = 4.0  # every so many pieces one is of a search that waits


@kernel
def mirror(p, u, s):
    """Begin without a renewal: the second state is the first one, just found."""
    copy(s, back_of(p, s), 0, front(p))
    own = members.set_state(p, s)
    at = members.march(p)
    own[at + SP.MADE_LAST] = _GUESS
    end_blend(p, s)
    drift.begin_drift(p, u, s)


@kernel
def aim_ahead(p, s, speed, h):
    """Return the speed (rad/s) to find lines for, when a step of ``h`` (s) to ``speed`` begins.

    Until they are complete a ramp goes on; half of the time in which they serve is as long again, or as long
    as half of a drift takes.
    """
    own = members.set_state(p, s)
    rate = own[members.march(p) + SP.RAMP]
    last = own[members.march(p) + SP.MADE_LAST] * frozen_points.PIECE
    half = _SOON
    if abs(rate) * half > _AHEAD * _DRIFT * abs(speed):
        near = _AHEAD * _DRIFT * abs(speed) / abs(rate)
        half = max(near, min(0.5 * (1.0 + frozen_points.PAUSE) * last, _HURRY * near))
    ahead = rate * max(last + 0.5 * BLEND + max(0.5 * last, half) - h, 0.0)
    return speed + min(max(ahead, -frozen_points.FAR * abs(speed)), frozen_points.FAR * abs(speed))


@kernel
def begin(p, u, s, w, h):
    """Begin a renewal within a step of ``h`` (s)."""
    own = members.set_state(p, s)
    back = back_of(p, s)
    at = members.march(p)
    aim = aim_ahead(p, s, u[U.SPEED], h)
    own[at + SP.AIM] = aim
    own[at + SP.MADE] = 0.0
    enter(p, s, SETTLE if members.has_shaft(p) else HOLD)
    given = inputs_of(p, s)
    drift.aim_inputs(p, u, s, given)
    given[U.SPEED] = aim
    for b in range(members.bearing_count(p)):
        sb, of = members.state(p, s, b), members.state(p, back, b)
        copy(sb, of, 0, S.JAC)
        copy(sb, of, S.CONDENSED, S.CONDENSED + L.SIZE)
        of[S.SPEED] = aim
        lv = members.condensed(of)
        lv[L.KNOWN] = 0.0
        lv[L.SEARCH_BEFORE] = 1.0 if lv[L.SEARCH_STATE] == L.GOING else 0.0
    copy(own, members.set_state(p, back), 0, members.lines(p) if members.has_shaft(p) else S.SOUND - S.SET)
    frozen_points.set_inputs(p, given, back, w, frozen_points.PIECE)


@kernel
def take_over(p, s):
    """Let what was renewed take the place of what was in use."""
    own, of = members.set_state(p, s), members.set_state(p, back_of(p, s))
    at = members.march(p)
    own[at + SP.MADE_LAST] = own[at + SP.MADE]
    own[at + SP.NEW] = 1.0
    level = drift.level_change(p, s)
    if from_lines(p):
        take_sound(p, s)
    exchange_lines(p, s)
    drift.take_along(p, s, level)
    for b in range(members.bearing_count(p)):
        take_bearing(p, s, b)
    copy(of, own, SP.SHAFT_STIFFNESS, SP.PORT_BEGIN)
    for b in range(members.bearing_count(p)):
        bearing_at = members.per_bearing(p, b)
        for place in (SP.OFFSET, SP.FROZEN_OFFSET, SP.EXCESS):
            own[bearing_at + place] = of[bearing_at + place]
    copy(of, own, at + SP.FROZEN_NOSE, at + SP.LINES)
    copy(of, own, members.history(p), members.history(p) + members.padded_size(p))


@kernel
def take_bearing(p, s, b):
    """Take over what was renewed of a bearing; rings and balls go on from where they are."""
    sb, of = members.state(p, s, b), members.state(p, back_of(p, s), b)
    lv, new = members.condensed(sb), members.condensed(of)
    copy(new, lv, L.RATIO, L.SPACING)
    copy(new, lv, L.ROLL, L.SIDE_STEP)
    copy(new, lv, L.CONDITIONS, L.Q0)
    copy(new, lv, L.MEAN, L.X)
    copy(new, lv, L.EVEN, L.PHI)
    copy(new, lv, L.SIZES, L.SETTLED)
    # a search that went on meanwhile knows more
    before = new[L.SEARCH_BEFORE]
    knows_more = before > 0.0 or (before < 0.0 and lv[L.SEARCH_STATE] == L.ENDED)
    copy(new, lv, L.OWN_END, L.MORE_SPEED if knows_more else L.SIZE)
    lv[L.KNOWN] = 0.0
    copy(of, sb, S.LOSS, S.LOSS + S.LOSSES)
    sb[S.PLACE] = of[S.PLACE]
    sb[S.RESTARTS] = of[S.RESTARTS]


@kernel
def take_sound(p, s):
    """Take over the lines' sound; meters stay."""
    ps, ss, of = sound_block(p), s[S.SOUND :], back_of(p, s)[S.SOUND :]
    copy(of, ss, SD.SS_LINES, SD.SS_TABLES)
    lines, means, wide = int(ps[SD.H_S_LINES]), int(ps[SD.H_S_MEANS]), int(ps[SD.H_S_BEATS])
    copy(of, ss, lines, lines + int(of[SD.SS_LINES]) * beats.line_size(ps))
    copy(of, ss, means, means + beats.quantities(ps) * int(ps[SD.H_MICS]))
    copy(of, ss, wide, wide + int(of[SD.SS_BEATS]) * beats.beat_size(ps))


@kernel
def moved(p, s, speed):
    """How far ``speed`` (rad/s) is from that of the lines in use; 1: as far as it may be."""
    own = members.set_state(p, s)
    at = members.march(p)
    used = members.condensed(members.state(p, s, 0))[L.FROZEN_SPEED]
    last = own[at + SP.MADE_LAST] * frozen_points.PIECE
    near = min(max(_CALM * last * own[at + SP.RAMP + 1], _REST * abs(speed)), _DRIFT * abs(speed))
    return abs(speed + last * own[at + SP.RAMP] - used) / (near + _STILL)


@kernel
def runs_away(p, s, speed):
    """Whether ``speed`` (rad/s) has jumped far from that of the lines in use and of those of a renewal."""
    own = members.set_state(p, s)
    at = members.march(p)
    used = members.condensed(members.state(p, s, 0))[L.FROZEN_SPEED]
    jumps = abs(s[S.SPEED_RATE]) >= _PACE * abs(speed)
    busy = own[at + SP.STAGE] != IDLE and not frozen_points.speeds_differ(speed, own[at + SP.AIM])
    return jumps and frozen_points.speeds_differ(speed, used) and not busy


@kernel
def is_late(p, s, speed, off):
    """Whether a set, whose renewals are long, is far behind ``speed`` (rad/s) or its other inputs."""
    used = members.condensed(members.state(p, s, 0))[L.FROZEN_SPEED]
    return members.bearing_count(p) > 1 and (abs(speed - used) > _LATE * abs(speed) or off > _LOST)


@kernel
def strayed(p, u, s):
    """Whether the renewal that goes on is for other inputs than ``u``, the speed aside."""
    given = inputs_of(p, s)
    for i in range(inputs(p)):
        if i != U.SPEED and abs(given[i] - u[i]) > _NEAR * abs(u[i]) + 1e-12:
            return True
    return False


@kernel
def go_on(p, u, s, w, h, off, drifted):
    """Make the pieces due in a step of ``h`` (s); status code, and whether something new is in use.

    ``off``: how far what is frozen is off the inputs ``u``, see `frozen.deviation`; ``drifted``: see
    `drift.follow`. Where the speed jumps far, all pieces are made at once. Where inputs come back to those in
    use, the renewal for others is given up: one bad sample changes nothing. A renewal that finds no
    equilibrium for other inputs gives way to one for these.
    """
    own = members.set_state(p, s)
    at = members.march(p)
    due = frozen_points.pieces_due(p, s, h)
    rate = s[S.SPEED_RATE] if abs(s[S.SPEED_RATE]) < _PACE * abs(u[U.SPEED]) else 0.0
    own[at + SP.RAMP] += h / (h + _SMOOTH) * (rate - own[at + SP.RAMP])
    own[at + SP.RAMP + 1] += h / (h + _SMOOTH) * (abs(rate) - own[at + SP.RAMP + 1])
    # until lines are written the second state keeps those before the ones in use
    first_lines = ANSWER if members.has_shaft(p) else LINES
    far = max(drifted, moved(p, s, u[U.SPEED]))
    renewed = frozen_points.due(p, s, far, _HURRY, drift.goes_on(p, s), h)
    if is_late(p, s, u[U.SPEED], off):
        due *= _CATCH_UP
    at_once = runs_away(p, s, u[U.SPEED])
    if at_once:
        due = h = frozen_points.MOST
        own[at + SP.RAMP] = 0.0
        end_blend(p, s)
        if own[at + SP.STAGE] != IDLE:
            own[at + SP.STAGE] = IDLE
            renewed = True
    fresh = False
    if own[at + SP.STAGE] != IDLE and off <= 1.0 and strayed(p, u, s):
        own[at + SP.STAGE] = IDLE
    while True:
        if own[at + SP.STAGE] == IDLE:
            if renewed:
                begin(p, u, s, w, h)
                renewed = False
        waits = frozen_points.searching(p, s)
        if due < 1.0 or (own[at + SP.STAGE] == IDLE and not waits):
            return OK, fresh
        due -= 1.0
        turn = own[at + SP.TURN] + 1.0
        own[at + SP.TURN] = turn if turn < _SEARCHES else 0.0
        if waits and (own[at + SP.STAGE] == IDLE or own[at + SP.TURN] == 0.0):
            renewed = (frozen_points.search_piece(p, s, w) and not drift.goes_on(p, s)) or renewed
            continue
        if own[at + SP.STAGE] == first_lines and share_in_use(p, s, 0.0) < 1.0:
            return OK, fresh
        status = piece(p, s, w)
        if status != OK and strayed(p, u, s):
            renewed = True
            continue
        if status != OK:
            return status, fresh
        if own[at + SP.STAGE] == COMPLETE:
            take_over(p, s)
            frozen_points.pause(p, s, own[at + SP.MADE])
            if at_once:
                end_blend(p, s)
            own[at + SP.STAGE] = IDLE
            fresh, renewed = True, False
