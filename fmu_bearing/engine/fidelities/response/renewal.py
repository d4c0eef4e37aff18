"""Renewal of what is held, of the equilibrium, of lines and their sound, in pieces beside those in use.

A renewal takes 1 to 10 ms of a processor's time. A model in a loop of 1 ms cannot wait for that, so the work
is cut into pieces of some 0.2 ms, one for each millisecond that is simulated (`held.PIECE`), and goes on in a
second state behind the one that steps go on from (`back_of`), which takes over what was renewed when it is
complete. Meanwhile the old lines serve, with phases at the speed of now. What is renewed is found for the
speed that a ramp will have reached in the middle of the time in which it serves.

A search for what uneven balls add (``condensed.uneven``) goes on in the state in use, and shares the pieces.
Arguments: see `spindle.members`; ``stage``: of `IDLE` and so on; ``back``: the second state.
"""

from fmu_bearing.engine.fidelities.condensed.shared import hold_masses
from fmu_bearing.engine.fidelities.response import bearing
from fmu_bearing.engine.fidelities.response.coupled_lines import answer_lines
from fmu_bearing.engine.fidelities.response.equilibrium import renew_from_zero, rest_at_inputs
from fmu_bearing.engine.fidelities.response.lines import KINDS, line_table, make_lines
from fmu_bearing.engine.fidelities.response.sound import (
    add_rings,
    follow_beyond,
    from_lines,
    note,
    settle_sound,
    sound_moved,
    sound_of_balls,
)
from fmu_bearing.engine.fidelities.rings import held
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD, SL, SP, L, P, S, U, W
from fmu_bearing.engine.readout.motion import sound_block
from fmu_bearing.engine.sound import beats
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.status import OK

IDLE, HOLD, MASSES, DERIVE, LINES, ANSWER, RINGS, BEYOND, BALLS, MEANS, COMPLETE = range(11)

# Candidates per piece: of a bearing's lines, of a set's (times the cubed number of coordinates), of lines
# that sound: of the rings, of the balls.
_LINES = 144
_ANSWERS = 2e5
_RINGS = 192
_BALLS = 960
_GUESS = 8.0  # pieces of the first renewal
_SEARCHES = 4.0  # every so many pieces one is of a search that waits


@kernel
def inputs(p):
    """Return how many inputs there are."""
    return int(p[int(p[P.SET]) + SP.SIZE_U]) if members.has_shaft(p) else U.SIZE


@kernel
def front(p):
    """Return the length of the part of ``s`` that steps go on from."""
    if members.has_shaft(p):
        return int(p[int(p[P.SET]) + SP.FRONT])
    return line_table(p) + L.MOST_LINES * L.LINE_SIZE


@kernel
def inputs_of(p, s):
    """Return the inputs that a renewal is for."""
    return s[front(p) : front(p) + inputs(p)]


@kernel
def back_of(p, s):
    """Return the state in which a renewal goes on."""
    return s[front(p) + inputs(p) : 2 * front(p) + inputs(p)]


@kernel
def copy(source, target, begin, end):
    """Copy the numbers from ``begin`` to ``end``."""
    for i in range(begin, end):
        target[i] = source[i]


@kernel
def mirror(p, s):
    """Begin without a renewal: the second state is the first one, just found."""
    copy(s, back_of(p, s), 0, front(p))
    own = members.set_state(p, s)
    at = members.march(p)
    own[at + SP.MADE_LAST] = _GUESS
    own[at + SP.MADE_LAST + 1] = _GUESS


@kernel
def begin(p, u, s, w, h, stage):
    """Begin a renewal at a ``stage``, `HOLD` or, of sound alone, `RINGS`, within a step of ``h`` (s)."""
    own = members.set_state(p, s)
    back = back_of(p, s)
    at = members.march(p)
    speed = u[SP.U_SPEED]
    # until it is complete, and half as long again while it serves, but no farther than it may be off
    last = own[at + SP.MADE_LAST + (1 if stage == RINGS else 0)]
    ahead = s[S.SPEED_RATE] * max(1.5 * last * held.PIECE - h, 0.0)
    ahead = min(max(ahead, -held.FAR * abs(speed)), held.FAR * abs(speed))
    aim = speed + ahead
    own[at + SP.AIM] = aim
    own[at + SP.MADE] = 0.0
    own[at + SP.OF_SOUND] = 1.0 if stage == RINGS else 0.0
    enter(p, s, stage)
    if stage == RINGS:
        return
    given = inputs_of(p, s)
    for i in range(inputs(p)):
        given[i] = u[i]
    given[SP.U_SPEED] = aim
    for b in range(members.count(p)):
        sb, of = members.state(p, s, b), members.state(p, back, b)
        copy(sb, of, 0, S.JAC)
        copy(sb, of, S.CONDENSED, S.CONDENSED + L.SIZE)
        of[S.SPEED] = aim
        lv = members.condensed(of)
        lv[L.KNOWN] = 0.0
        lv[L.SEARCH_BEFORE] = 1.0 if lv[L.SEARCH_STATE] == L.GOING else 0.0
    copy(own, members.set_state(p, back), 0, members.lines(p) if members.has_shaft(p) else S.SOUND - S.SET)
    held.set_inputs_of(p, given, back, w, held.PIECE)


@kernel
def enter(p, s, stage):
    """Enter a stage of the renewal."""
    own = members.set_state(p, s)
    at = members.march(p)
    own[at + SP.STAGE] = stage
    own[at + SP.MEMBER] = 0.0
    own[at + SP.KIND] = 0.0
    own[at + SP.CURSOR] = 0.0


@kernel
def next_member(p, s, stage, then):
    """Go on with the next bearing in this or an earlier ``stage``, or behind the last one ``then``."""
    at = members.march(p)
    own = members.set_state(p, s)
    member = own[at + SP.MEMBER] + 1.0
    enter(p, s, stage if member < members.count(p) else then)
    if member < members.count(p):
        own[at + SP.MEMBER] = member


@kernel
def held_piece(p, s, w):
    """One piece up to the lines; False where there is no equilibrium near the old one."""
    own = members.set_state(p, s)
    back = back_of(p, s)
    at = members.march(p)
    stage, b = int(own[at + SP.STAGE]), int(own[at + SP.MEMBER])
    aim = own[at + SP.AIM]
    pb, sb, wb = members.parameters(p, b), members.state(p, back, b), members.work(p, w, b)
    together = members.has_shaft(p)
    if stage == HOLD:
        if held.hold_points(p, inputs_of(p, s), False, back, w) != OK:
            return False
        if together:
            ws = members.set_work(p, w)
            found = held.start_vector(p, SP.UNKNOWNS)
            for i in range(members.coordinates(p)):
                members.set_state(p, back)[SP.S_HEAD + i] = ws[found + i]
        enter(p, s, MASSES)
    elif stage == MASSES:
        hold_masses(pb, sb, wb)
        next_member(p, s, MASSES, DERIVE)
        if b + 1 == members.count(p) and not rest_at_inputs(p, back, w, aim):
            return False
    elif stage == DERIVE:
        if not bearing.linearise(pb, sb, aim, wb):
            return False
        own[at + SP.STAGE] = LINES
    else:
        kind, cursor = int(own[at + SP.KIND]), int(own[at + SP.CURSOR])
        if make_lines(pb, sb, not together, aim, kind, cursor, _LINES, wb):
            own[at + SP.CURSOR] += _LINES
        elif kind + 1 < KINDS:
            own[at + SP.KIND] += 1.0
            own[at + SP.CURSOR] = 0.0
        else:
            next_member(p, s, DERIVE, ANSWER if together else RINGS)
    return True


@kernel
def answer_piece(p, s, w):
    """One piece of a set's lines."""
    own = members.set_state(p, s)
    at = members.march(p)
    many = max(int(_ANSWERS / members.coordinates(p) ** 3), 4)
    if answer_lines(p, back_of(p, s), w, own[at + SP.AIM], int(own[at + SP.CURSOR]), many):
        own[at + SP.CURSOR] += many
    else:
        enter(p, s, RINGS)


@kernel
def token_of(p, back, aim):
    """Return a number that two tables of lines hardly have in common unless they are equal."""
    token = aim
    for b in range(members.count(p)):
        sb = members.state(p, back, b)
        lv = members.condensed(sb)
        lines = sb[line_table(members.parameters(p, b)) :]
        token += lv[L.RATIO] + 3.0 * lv[L.ROLL]
        for i in range(int(lv[L.COUNT]) * L.LINE_SIZE):
            token = 0.7 * token + lines[i]
    return token


@kernel
def sound_piece(p, s, w):
    """One piece of the lines' sound.

    What it leaves to the next one is in the work space, which is not part of the state. Where another state
    was put back meanwhile, all pieces so far are made again.
    """
    own = members.set_state(p, s)
    at = members.march(p)
    ps = sound_block(p)
    ws = members.work(p, w, 0)[W.SOUND :]
    tag = note(ps, SL.NOTE_TOKEN)
    stage, member, cursor = own[at + SP.STAGE], own[at + SP.MEMBER], own[at + SP.CURSOR]
    if stage == RINGS and cursor == 0.0:
        own[at + SP.TOKEN] = token_of(p, back_of(p, s), own[at + SP.AIM])
        ws[tag] = own[at + SP.TOKEN]
    elif ws[tag] != own[at + SP.TOKEN]:
        enter(p, s, RINGS)
        while own[at + SP.STAGE] != stage or own[at + SP.MEMBER] != member or own[at + SP.CURSOR] != cursor:
            sound_once(p, s, w)
        ws[tag] = own[at + SP.TOKEN]
    sound_once(p, s, w)


@kernel
def sound_once(p, s, w):
    """As `sound_piece`, with what it needs in the work space."""
    own = members.set_state(p, s)
    back = back_of(p, s)
    at = members.march(p)
    stage, b, cursor = int(own[at + SP.STAGE]), int(own[at + SP.MEMBER]), int(own[at + SP.CURSOR])
    aim = own[at + SP.AIM]
    if stage == RINGS:
        if add_rings(p, back, w, aim, cursor, _RINGS):
            own[at + SP.CURSOR] += _RINGS
        else:
            enter(p, s, BEYOND)
    elif stage == BEYOND:
        follow_beyond(p, back, w, aim)
        enter(p, s, BALLS)
    elif stage == BALLS:
        if sound_of_balls(p, back, w, b, aim, cursor, _BALLS):
            own[at + SP.CURSOR] += _BALLS
        else:
            next_member(p, s, BALLS, MEANS)
    else:
        settle_sound(p, back, w, aim)
        enter(p, s, COMPLETE)


@kernel
def piece(p, s, w):
    """Make one piece of the renewal; status code."""
    own = members.set_state(p, s)
    at = members.march(p)
    stage = own[at + SP.STAGE]
    if stage >= RINGS:
        sound_piece(p, s, w)
    elif stage == ANSWER:
        answer_piece(p, s, w)
    elif not held_piece(p, s, w):
        status = renew_from_zero(p, inputs_of(p, s), back_of(p, s), w, own[at + SP.AIM])
        if status != OK:
            own[at + SP.STAGE] = IDLE
            return status
        enter(p, s, RINGS)
    if own[at + SP.STAGE] == RINGS and not from_lines(p):
        own[at + SP.STAGE] = COMPLETE
    own[at + SP.MADE] += 1.0
    return OK


@kernel
def take_over(p, s):
    """Let what was renewed take the place of what was in use."""
    own, of = members.set_state(p, s), members.set_state(p, back_of(p, s))
    at = members.march(p)
    of_sound = own[at + SP.OF_SOUND] != 0.0
    own[at + SP.MADE_LAST + (1 if of_sound else 0)] = own[at + SP.MADE]
    if from_lines(p):
        take_sound(p, s)
    if of_sound:
        return
    for b in range(members.count(p)):
        take_bearing(p, s, b)
    if members.has_shaft(p):
        copy(of, own, SP.SHAFT_STIFFNESS, SP.PORT_BEGIN)
        for b in range(members.count(p)):
            bearing_at = members.per_bearing(p, b)
            own[bearing_at + SP.OFFSET] = of[bearing_at + SP.OFFSET]
            own[bearing_at + SP.HELD_OFFSET] = of[bearing_at + SP.HELD_OFFSET]
        copy(of, own, at + SP.HELD_NOSE, at + SP.LINES + 1)
        lines = members.lines(p)
        copy(of, own, lines, lines + int(of[at + SP.LINES]) * members.line_size(p))
    copy(of, own, members.history(p), members.history(p) + members.padded_size(p))


@kernel
def take_bearing(p, s, b):
    """Take over what was renewed of a bearing."""
    sb, of = members.state(p, s, b), members.state(p, back_of(p, s), b)
    lv, new = members.condensed(sb), members.condensed(of)
    theta, rolled = lv[L.THETA], lv[L.ROLLED]
    # a search that went on meanwhile knows more
    copy(new, lv, 0, L.MORE_SPEED if new[L.SEARCH_BEFORE] != 0.0 else L.SIZE)
    lv[L.THETA] = theta
    lv[L.ROLLED] = rolled
    copy(of, sb, S.LOSS, S.LOSS + S.LOSSES)
    sb[S.PLACE] = of[S.PLACE]
    sb[S.RESTARTS] = of[S.RESTARTS]
    if not members.has_shaft(p):
        first = line_table(p)
        copy(of, sb, first, first + int(lv[L.COUNT]) * L.LINE_SIZE)


@kernel
def take_sound(p, s):
    """Take over the lines' sound; meters stay."""
    ps, ss, of = sound_block(p), s[S.SOUND :], back_of(p, s)[S.SOUND :]
    copy(of, ss, SD.SS_LINES, SD.SS_SPEED + 1)
    lines, means, wide = int(ps[SD.H_S_LINES]), int(ps[SD.H_S_MEANS]), int(ps[SD.H_S_BEATS])
    copy(of, ss, lines, lines + int(of[SD.SS_LINES]) * beats.line_size(ps))
    copy(of, ss, means, means + beats.quantities(ps) * int(ps[SD.H_MICS]))
    copy(of, ss, wide, wide + int(of[SD.SS_BEATS]) * beats.beat_size(ps))


@kernel
def runs_away(p, s, speed):
    """Whether ``speed`` (rad/s) is far from that of the lines in use and of those of a renewal."""
    own = members.set_state(p, s)
    at = members.march(p)
    used = members.condensed(members.state(p, s, 0))[L.FOUND_SPEED]
    busy = own[at + SP.STAGE] != IDLE and own[at + SP.OF_SOUND] == 0.0
    return held.apart_by_far(speed, used) and not (busy and not held.apart_by_far(speed, own[at + SP.AIM]))


@kernel
def go_on(p, u, s, w, h, renewed):
    """Make the pieces due in a step of ``h`` (s); status code, and whether something new is in use.

    ``renewed``: whether what is held is out of date for the inputs ``u``. Where the speed jumps far, all
    pieces are made at once.
    """
    own = members.set_state(p, s)
    at = members.march(p)
    due = held.pieces_due(p, s, h)
    if runs_away(p, s, u[SP.U_SPEED]):
        due = h = held.MOST
        if own[at + SP.STAGE] != IDLE:
            own[at + SP.STAGE] = IDLE
            renewed = True
    fresh = False
    while True:
        if own[at + SP.STAGE] == IDLE:
            if renewed:
                begin(p, u, s, w, h, HOLD)
                renewed = False
            elif sound_moved(p, s, u[SP.U_SPEED]):
                begin(p, u, s, w, h, RINGS)
        waits = held.searching(p, s)
        if due < 1.0 or (own[at + SP.STAGE] == IDLE and not waits):
            return OK, fresh
        due -= 1.0
        own[at + SP.TURN] = (own[at + SP.TURN] + 1.0) % _SEARCHES
        if waits and (own[at + SP.STAGE] == IDLE or own[at + SP.TURN] == 0.0):
            renewed = held.searched(p, s, w) or renewed
            continue
        status = piece(p, s, w)
        if status != OK:
            return status, fresh
        if own[at + SP.STAGE] == COMPLETE:
            take_over(p, s)
            own[at + SP.STAGE] = IDLE
            fresh = fresh or own[at + SP.OF_SOUND] == 0.0
