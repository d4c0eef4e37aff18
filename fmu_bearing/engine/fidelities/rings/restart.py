"""From one communication point to the next; where a step fails, the rings begin again at rest.

There are states that no step leads out of: a ball that has left its races, a ring flung by a jump of the
inputs. Clock, angles, sums, counts and sound go on; rings and balls begin at rest at the present inputs
(``solver.restarts`` counts it, and a warning says so). Where no step leads out of that rest either, they stay
there until the end of the communication step. A step is refused only where there is no rest at its inputs, or
where loads would sink the ring.
Arguments: see `spindle.members`.
"""

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.ball_motion import forget_balls
from fmu_bearing.engine.fidelities.condensed.balls import accelerations
from fmu_bearing.engine.fidelities.condensed.rows import turn_balls
from fmu_bearing.engine.fidelities.condensed.shared import advance
from fmu_bearing.engine.fidelities.full.start import exceeds_pedestal
from fmu_bearing.engine.fidelities.rings import equations, frozen_points, predictor
from fmu_bearing.engine.fidelities.rings.march import emit_rings, go_on, take_inputs
from fmu_bearing.engine.fidelities.rings.start import begin_at_rest, follows_defects
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import DE, C, L, P, S, T, U
from fmu_bearing.engine.mechanics.defects import head_of
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.sound_sum import sampled
from fmu_bearing.engine.status import DEEP_DEFECT, OK, TOO_SOFT

_TRIES = 3  # times to begin again within a communication step, before the rings wait for its end


@kernel
def begin_again(p, u, s, w):
    """Put shaft, housing, rings and balls to rest at the inputs ``u`` and the clock reached; status code."""
    own = members.set_state(p, s)
    status = frozen_points.freeze_from_zero(p, u, s, w)
    if status != OK:
        return status
    predictor.forget(own, members.march(p), members.history(p), members.padded_size(p))
    equations.share_march(p, s)
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        for i in range(L.MODES_NOW, L.MODES_STAY):
            lv[i] = 0.0
        forget_balls(lv)
    begin_at_rest(p, s, w)
    return OK


@kernel
def wait(p, s, w, h):
    """Let the time ``h`` (s) pass with shaft, housing and rings at rest."""
    for b in range(members.bearing_count(p)):
        turn_balls(members.state(p, s, b), h)
    if sampled(p):
        emit_rings(p, s, w, h)
    for b in range(members.bearing_count(p)):
        advance(members.parameters(p, b), members.state(p, s, b), h)


@kernel
def defects_grow(p, s):
    """Whether a local defect has got a larger scale than in the last step."""
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        for k in range(int(pb[P.DEFECTS])):
            now = p[P.DEFECT_SCALE + int(pb[head_of(pb, k) + DE.NUMBER])]
            if now > members.state(p, s, b)[S.C + C.DEFECT_SCALE + k]:
                return True
    return False


@kernel
def follows_now(p, s, w):
    """Whether no local defect is deeper than balls follow from the present state on."""
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        equations.show_present(pb, sb, wb)
        q = wb[T.Q : T.Q + L.COLUMN]
        c, lv = sb[S.C : S.C + C.SIZE], members.condensed(sb)
        if not accelerations(pb, c, lv, sb[S.ANGLE], sb[S.SPEED], sb[S.SPEED_RATE], q, wb):
            return False
    return follows_defects(p, s, w)


@kernel
def march_rings(p, u, s, w, h):
    """Advance the state of a set by the communication step ``h`` (s); status code."""
    for b in range(members.bearing_count(p)):
        steps.begin_means(members.state(p, s, b))
    end = s[S.TIME] + h
    deeper = defects_grow(p, s)
    status = take_inputs(p, u, s, w, h)
    if exceeds_pedestal(p, s):
        return TOO_SOFT
    if deeper and not follows_now(p, s, w):
        return DEEP_DEFECT
    if status == OK:
        status = go_on(p, u, s, w, h, h, end)
    for again in range(_TRIES):
        if status == OK:
            break
        s[S.RESTARTS] += 1.0
        status = begin_again(p, u, s, w)
        if status != OK:
            return status
        if again < _TRIES - 1:
            status = go_on(p, u, s, w, h, end - s[S.TIME], end)
        else:
            wait(p, s, w, end - s[S.TIME])
            begin_again(p, u, s, w)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        sb[S.TIME] = end
        sb[S.SPEED] = u[U.SPEED]
    equations.keep_loads(p, s, w)
    equations.publish_all(p, s, w)
    for b in range(members.bearing_count(p)):
        steps.end_means(members.state(p, s, b), h)
    return OK
