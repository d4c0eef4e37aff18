"""Pieces of a renewal of fidelity `response`: stage by stage, bearing by bearing, some lines at a time.

Each takes 0.1 to 0.4 ms of a processor. ``stage``: of `IDLE` and so on; other arguments: see `renewal`.
"""

from fmu_bearing.engine.fidelities.condensed.shared import build_operator
from fmu_bearing.engine.fidelities.response import bearing
from fmu_bearing.engine.fidelities.response.coupled_lines import solve_lines
from fmu_bearing.engine.fidelities.response.equilibrium import renew_from_zero, rest_at_inputs
from fmu_bearing.engine.fidelities.response.exchange import back_of, end_blend, inputs_of
from fmu_bearing.engine.fidelities.response.line_sound import (
    add_rings,
    follow_beyond,
    from_lines,
    note,
    settle_sound,
    sound_of_balls,
)
from fmu_bearing.engine.fidelities.response.lines import KINDS, line_table, make_lines
from fmu_bearing.engine.fidelities.rings import frozen_points
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SL, SP, L, W
from fmu_bearing.engine.readout.motion import sound_block
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.status import OK

IDLE, SETTLE, EXCEED, SETTLE_AGAIN, HOLD, MASSES, DERIVE, LINES = range(8)
ANSWER, RINGS, BEYOND, BALLS, MEANS, COMPLETE = range(8, 14)

# Candidates per piece: of a bearing's lines, of a set's (times the cubed number of coordinates; no more than
# take 0.2 ms in a pair, which makes three pieces in a step where it is late), of lines that sound: of the
# rings, of the balls.
_LINES = 144
_SOLVED = 4e5
_SOLVED_LEAST = 14  # coordinates: fewer take as long, by what is not cubed
_SOLVED_MOST = 63
_RINGS = 192
_BALLS = 480


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
    enter(p, s, stage if member < members.bearing_count(p) else then)
    if member < members.bearing_count(p):
        own[at + SP.MEMBER] = member


@kernel
def frozen_piece(p, s, w):
    """One piece up to the lines; False where there is no equilibrium near the old one."""
    own = members.set_state(p, s)
    back = back_of(p, s)
    at = members.march(p)
    stage, b = int(own[at + SP.STAGE]), int(own[at + SP.MEMBER])
    aim = own[at + SP.AIM]
    pb, sb, wb = members.parameters(p, b), members.state(p, back, b), members.work(p, w, b)
    together = members.has_shaft(p)
    if stage == EXCEED:
        frozen_points.renew_excess_force(p, inputs_of(p, s), b, back, w)
        next_member(p, s, EXCEED, SETTLE_AGAIN)
    elif stage == SETTLE or stage == SETTLE_AGAIN:
        if frozen_points.rest_set(p, inputs_of(p, s), True, back, w) != OK:
            return False
        ws = members.set_work(p, w)
        unknowns = frozen_points.start_vector(p, SP.UNKNOWNS)
        for i in range(members.coordinates(p)):
            members.set_state(p, back)[SP.S_HEAD + i] = ws[unknowns + i]
        enter(p, s, EXCEED if stage == SETTLE else HOLD)
    elif stage == HOLD:
        if not together and frozen_points.rest_set(p, inputs_of(p, s), True, back, w) != OK:
            return False
        if frozen_points.freeze_point(p, inputs_of(p, s), b, False, back, w) != OK:
            return False
        next_member(p, s, HOLD, MASSES)
    elif stage == MASSES:
        build_operator(pb, sb, wb)
        next_member(p, s, MASSES, DERIVE)
        if b + 1 == members.bearing_count(p) and not rest_at_inputs(p, back, w, aim):
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
def lines_piece(p, s, w):
    """One piece of a set's lines."""
    own = members.set_state(p, s)
    at = members.march(p)
    many = max(int(_SOLVED / (members.coordinates(p) ** 3 + _SOLVED_LEAST**3)), 4)
    many = min(many, _SOLVED_MOST)
    if solve_lines(p, back_of(p, s), w, own[at + SP.AIM], int(own[at + SP.CURSOR]), many):
        own[at + SP.CURSOR] += many
    else:
        enter(p, s, RINGS)


@kernel
def token_of(p, back, aim):
    """Return a number that two tables of lines hardly have in common unless they are equal."""
    token = aim
    for b in range(members.bearing_count(p)):
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

    What it leaves to the next one is in the work space, which is not part of the state: notes there say of
    what it is and how far it has gone. Where another state was put back meanwhile, of another renewal or of
    an earlier piece of this one, all pieces so far are made again.
    """
    own = members.set_state(p, s)
    at = members.march(p)
    ps = sound_block(p)
    ws = members.work(p, w, 0)[W.SOUND :]
    tag = note(ps, SL.NOTE_TOKEN)
    stage, member, cursor = own[at + SP.STAGE], own[at + SP.MEMBER], own[at + SP.CURSOR]
    if stage == RINGS and cursor == 0.0:
        own[at + SP.TOKEN] = token_of(p, back_of(p, s), own[at + SP.AIM])
    elif not (ws[tag] == own[at + SP.TOKEN] and is_at(ws, tag, stage, member, cursor)):
        enter(p, s, RINGS)
        while own[at + SP.STAGE] != stage or own[at + SP.MEMBER] != member or own[at + SP.CURSOR] != cursor:
            sound_once(p, s, w)
    sound_once(p, s, w)
    ws[tag] = own[at + SP.TOKEN]
    for i in range(SL.PLACE_SIZE):
        ws[tag + SL.NOTE_PLACE - SL.NOTE_TOKEN + i] = own[at + SP.STAGE + i]


@kernel
def is_at(ws, tag, stage, member, cursor):
    """Whether the pieces in the work space end where the next one is that of these numbers."""
    at = tag + SL.NOTE_PLACE - SL.NOTE_TOKEN
    return (
        ws[at] == stage
        and ws[at + SP.MEMBER - SP.STAGE] == member
        and ws[at + SP.CURSOR - SP.STAGE] == cursor
    )


@kernel
def sound_once(p, s, w):
    """As `sound_piece`, with what it needs in the work space."""
    own = members.set_state(p, s)
    back = back_of(p, s)
    at = members.march(p)
    stage, b, cursor = int(own[at + SP.STAGE]), int(own[at + SP.MEMBER]), int(own[at + SP.CURSOR])
    aim = own[at + SP.AIM]
    if stage == RINGS:
        many = int(_RINGS / (2.0 * members.bearing_count(p) - 1.0))
        if add_rings(p, back, w, aim, cursor, many):
            own[at + SP.CURSOR] += many
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
        settle_sound(p, back, w)
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
        lines_piece(p, s, w)
    elif not frozen_piece(p, s, w):
        end_blend(p, s)
        status = renew_from_zero(p, inputs_of(p, s), back_of(p, s), w, own[at + SP.AIM])
        if status != OK:
            own[at + SP.STAGE] = IDLE
            return status
        enter(p, s, RINGS)
    if own[at + SP.STAGE] == RINGS and not from_lines(p):
        own[at + SP.STAGE] = COMPLETE
    own[at + SP.MADE] += 1.0
    return OK
