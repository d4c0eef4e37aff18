"""Equilibrium of the rings in fidelity `response`, and all lines about it at once.

Arguments: see `spindle.members`.
"""

from fmu_bearing.engine.fidelities.condensed.rows import keep_balls, show_balls
from fmu_bearing.engine.fidelities.condensed.shared import flat
from fmu_bearing.engine.fidelities.response import bearing
from fmu_bearing.engine.fidelities.response.coupled_lines import solve_lines
from fmu_bearing.engine.fidelities.response.line_sound import (
    add_rings,
    follow_beyond,
    from_lines,
    settle_sound,
    sound_of_balls,
)
from fmu_bearing.engine.fidelities.response.lines import KINDS, make_lines
from fmu_bearing.engine.fidelities.rings import frozen_points
from fmu_bearing.engine.fidelities.rings.rest import at_rest
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, C, L, S, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.status import OK

_ALL = 1 << 40  # candidates at once


@kernel
def show_guess(p, s, w, row):
    """Put the balls' places of row ``row`` of every bearing to its trial rows, on races without waves."""
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        for i in range(Y.SIZE):
            wb[W.STAGE + i] = 0.0
        lv = members.condensed(sb)
        show_balls(lv, row, wb)
        flat(members.parameters(p, b), sb[S.C : S.C + C.SIZE], lv, wb)


@kernel
def rest_from(p, s, w, speed, x, at):
    """Find the rest of all bodies, from the coordinates ``x[at:]`` and the balls' places ``L.EVEN``.

    Returns whether there is one; where there is none, these are taken as the rest.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    mean = members.history(p)
    place = members.vector(p, SP.PLACE)
    for i in range(members.padded_size(p)):
        ws[place + i] = x[at + i]
    show_guess(p, s, w, L.EVEN)
    at_equilibrium = at_rest(p, s, w, speed)
    for i in range(members.padded_size(p)):
        own[mean + i] = ws[place + i] if at_equilibrium else x[at + i]
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        if at_equilibrium:
            keep_balls(members.work(p, w, b), lv, L.EVEN)
        members.place_rows(p, b, own, own, mean, lv, L.MEAN)
    return at_equilibrium


@kernel
def linearise(p, s, w, speed):
    """Renew derivatives of all bearings, lines and sound at ``speed`` (rad/s); False if there are none."""
    together = members.has_shaft(p)
    for b in range(members.bearing_count(p)):
        sb, wb = members.state(p, s, b), members.work(p, w, b)
        pb = members.parameters(p, b)
        if not bearing.linearise(pb, sb, speed, wb):
            return False
        for kind in range(KINDS):
            make_lines(pb, sb, not together, speed, kind, 0, _ALL, wb)
    if together:
        solve_lines(p, s, w, speed, 0, _ALL)
    if from_lines(p):
        add_rings(p, s, w, speed, 0, _ALL)
        follow_beyond(p, s, w, speed)
        for b in range(members.bearing_count(p)):
            sound_of_balls(p, s, w, b, speed, 0, _ALL)
        settle_sound(p, s, w)
    return True


@kernel
def rest_at_inputs(p, s, w, speed):
    """Find the rest of a set from the last one, or from the places in ``SP.S_HEAD``; whether it was found."""
    own = members.set_state(p, s)
    if not members.has_shaft(p):
        return rest_from(p, s, w, speed, own, members.history(p))
    frozen_points.take_offsets(p, own)
    if not rest_from(p, s, w, speed, own, members.history(p)):
        rest_from(p, s, w, speed, own, SP.S_HEAD)
    return True


@kernel
def renew_from_zero(p, u, s, w, speed):
    """Renew all at once where there is no equilibrium near the old one, for the inputs ``u``; status code.

    Newton's method starts from the quasi-static equilibrium, which is taken as the equilibrium where there is
    no rest (as at the start). Where balls have no rest about which to find lines, the rings stay still there
    (``solver.restarts`` counts it, and a warning says so). Sound is left to the pieces that follow.
    """
    own = members.set_state(p, s)
    status = frozen_points.freeze_from_zero(p, u, s, w)
    if status != OK:
        return status
    rest_from(p, s, w, speed, own, SP.S_HEAD)
    if linearise(p, s, w, speed):
        return OK
    own[members.march(p) + SP.LINES] = 0.0
    for b in range(members.bearing_count(p)):
        members.condensed(members.state(p, s, b))[L.COUNT] = 0.0
    s[S.RESTARTS] += 1.0
    return OK
