"""Fidelity rings for a set, from one communication point to the next: as ``fidelities.rings.restart``."""

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.rows import turn_balls
from fmu_bearing.engine.fidelities.condensed.shared import advance
from fmu_bearing.engine.fidelities.rings import coupled, predictor, set_held
from fmu_bearing.engine.fidelities.rings.restart import TRIES, forget_motion
from fmu_bearing.engine.fidelities.rings.set_march import begin_at_rest, emit_rings, go_on, take_inputs
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, P, S
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.status import OK


@kernel
def begin_again(p, u, s, w):
    """Put shaft, housing, rings and balls to rest at the inputs ``u`` and the clock reached; status code."""
    own = members.own_state(p, s)
    status = set_held.hold_from_zero(p, u, s, w)
    if status != OK:
        return status
    predictor.forget(own, members.march(p), members.history(p), members.padded(p))
    coupled.tell_march(p, s)
    for b in range(members.count(p)):
        forget_motion(members.condensed(members.state(p, s, b)))
    begin_at_rest(p, s, w)
    return OK


@kernel
def wait(p, s, w, h):
    """Let the time ``h`` (s) pass with shaft, housing and rings at rest."""
    for b in range(members.count(p)):
        turn_balls(members.state(p, s, b), h)
    if p[P.SOUND_SIZE] != 0.0:
        emit_rings(p, s, w, h)
    for b in range(members.count(p)):
        advance(members.state(p, s, b), h)


@kernel
def march_rings_set(p, u, s, w, h):
    """Advance the state of a set by the communication step ``h`` (s); status code."""
    for b in range(members.count(p)):
        steps.begin_means(members.state(p, s, b))
    end = s[S.TIME] + h
    status = take_inputs(p, u, s, w, h)
    if status == OK:
        status = go_on(p, u, s, w, h, h, end)
    for again in range(TRIES):
        if status == OK:
            break
        s[S.RESTARTS] += 1.0
        status = begin_again(p, u, s, w)
        if status != OK:
            return status
        if again < TRIES - 1:
            status = go_on(p, u, s, w, h, end - s[S.TIME], end)
        else:
            wait(p, s, w, end - s[S.TIME])
            begin_again(p, u, s, w)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        sb[S.TIME] = end
        sb[S.SPEED] = u[SP.U_SPEED]
    coupled.keep_loads(p, s, w)
    coupled.publish_set(p, s, w)
    for b in range(members.count(p)):
        steps.end_means(members.state(p, s, b), h)
    return OK
