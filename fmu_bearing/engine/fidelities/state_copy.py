"""What of a state later steps need, for copies to go back to: a third to a tenth of it.

The rest is scratch that no value of survives a step, room for more lines than there are, rows of spare lanes,
and in fidelity `response` the second state while no renewal goes on in it. All of it is written before it is
read again. Arguments: see `spindle.members`.
"""

from fmu_bearing.engine.choices import FULL, RESPONSE
from fmu_bearing.engine.fidelities.full.vectors import copy_rows
from fmu_bearing.engine.fidelities.response.exchange import back_in_use, copy, front
from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR, SD, SP, STRIDE, A, J, L, P, S
from fmu_bearing.engine.readout.motion import sound_block
from fmu_bearing.engine.sound import beats
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import inputs


@kernel
def copy_live(p, s, kept):
    """Copy to ``kept`` what later steps need of the state ``s``; the rest of ``kept`` stays as it is."""
    if p[P.FIDELITY] != RESPONSE:
        _copy_front(p, s, kept)
        return
    size = front(p)
    begin = size + inputs(p)
    _copy_front(p, s[0:size], kept[0:size])
    copy(s, kept, size, begin)
    if back_in_use(p, s):
        copy(s, kept, begin, begin + size)
    copy(s, kept, begin + size, s.size)


@kernel
def _copy_front(p, s, kept):
    """Copy what steps go on from."""
    for b in range(members.bearing_count(p)):
        pb, sb, kb = members.parameters(p, b), members.state(p, s, b), members.state(p, kept, b)
        copy(sb, kb, 0, S.JAC)
        if p[P.FIDELITY] == FULL:
            _copy_newton(pb, sb, kb)
        else:
            _copy_condensed(sb, kb)
        copy(sb, kb, S.SET, S.SOUND)
        _copy_sound(pb, sb, kb)
        behind = S.SOUND + int(pb[P.SOUND_STATE])
        if p[P.FIDELITY] == FULL:
            copy(sb, kb, behind, sb.size)
        elif p[P.FIDELITY] == RESPONSE and not members.has_shaft(p):
            first = line_table(pb)
            copy(sb, kb, first, first + int(members.condensed(sb)[L.COUNT]) * L.LINE_SIZE)
    if members.has_shaft(p):
        own, other = members.set_state(p, s), members.set_state(p, kept)
        end = own.size
        if p[P.FIDELITY] == RESPONSE:
            end = members.lines(p) + int(own[members.march(p) + SP.LINES]) * members.line_size(p)
        copy(own, other, 0, end)


@kernel
def _copy_newton(pb, sb, kb):
    """Copy the Jacobian and the factors of fidelity `full`, of balls the lanes in use."""
    lanes = int(pb[P.LANES])
    copy_rows(sb[S.JAC :], kb[S.JAC :], J.E // STRIDE, lanes)
    copy(sb, kb, S.JAC + J.E, S.FAC)
    copy(sb, kb, S.FAC, S.FAC + lanes // FOUR * A.GROUP)
    copy(sb, kb, S.FAC + A.S, S.FAC + A.SIZE)


@kernel
def _copy_condensed(sb, kb):
    """Copy what fidelities `rings` and `response` keep, and what a search that goes on has found."""
    kept = S.CONDENSED + L.SEARCH_KEPT
    copy(sb, kb, S.CONDENSED, kept)
    if members.condensed(sb)[L.SEARCH_STATE] != L.IDLE:
        copy(sb, kb, kept, S.CONDENSED + L.SIZE)


@kernel
def _copy_sound(pb, sb, kb):
    """Copy the sound state; of lines and of their beats as many as there are."""
    end = S.SOUND + int(pb[P.SOUND_STATE])
    ps = sound_block(pb)
    if pb[P.SOUND_SIZE] == 0.0 or ps[SD.H_LINES] == 0.0:
        copy(sb, kb, S.SOUND, end)
        return
    ss = sb[S.SOUND :]
    lines, behind = int(ps[SD.H_S_LINES]), int(ps[SD.H_S_ALONE])
    beaten = int(ps[SD.H_S_BEATS])
    copy(sb, kb, S.SOUND, S.SOUND + lines + int(ss[SD.SS_LINES]) * beats.line_size(ps))
    copy(sb, kb, S.SOUND + behind, S.SOUND + beaten + int(ss[SD.SS_BEATS]) * beats.beat_size(ps))
    if pb[P.SENSORS_SIZE] != 0.0:
        copy(sb, kb, S.SOUND + int(pb[P.SENSORS_STATE]), end)
