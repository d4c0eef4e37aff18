"""How fidelity `rings` begins: where a bearing or a set rests on waves and unequal balls.

Arguments: see `spindle.members`.
"""

from fmu_bearing.engine.fidelities.condensed.balls import count_settled, set_angles
from fmu_bearing.engine.fidelities.condensed.defects import taken_by_defects
from fmu_bearing.engine.fidelities.condensed.rows import from_equilibrium, keep_balls
from fmu_bearing.engine.fidelities.full.start import begin_means
from fmu_bearing.engine.fidelities.rings import equations, frozen_points, growth
from fmu_bearing.engine.fidelities.rings.march import FIRST, longest_of_all
from fmu_bearing.engine.fidelities.rings.rest import at_rest
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, C, H, L, P, S, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.status import DEEP_DEFECT, NO_START, OK

# Of both approaches of the most loaded ball: what a local defect may take. Above, balls leave a race in it.
# Found on a 6205: 0.9 to 1.3 of the accelerations of full up to 1.1, restarts from 2.4 on.
_MOST_TAKEN = 1.0


@kernel
def place_on_waves(p, s, w, speed):
    """Put shaft, housing, rings and balls where they rest on waves and unequal balls into the trial places.

    Where there is no such rest, they stay at the quasi-static place, with the balls' places in ``L.EVEN``.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    place = members.vector(p, SP.PLACE)
    converged = False
    for again in range(2):
        for i in range(members.padded_size(p)):
            ws[place + i] = own[SP.S_HEAD + i]
        for b in range(members.bearing_count(p)):
            sb = members.state(p, s, b)
            wb = members.work(p, w, b)
            for i in range(Y.SIZE):
                wb[W.STAGE + i] = 0.0
            pb = members.parameters(p, b)
            lv = members.condensed(sb)
            from_equilibrium(pb, lv, lv[L.THETA], wb)
            c = sb[S.C : S.C + C.SIZE]
            set_angles(pb, c, lv, lv[L.THETA], lv[L.ROLLED], s[S.ANGLE], 0.0, speed, wb)
        if again == 0:
            converged = at_rest(p, s, w, speed)
        if converged:
            break


@kernel
def begin_at_rest(p, s, w):
    """Begin where all rests at the clock and angles reached; False where balls find no rest.

    Where there is no rest on waves and unequal balls, the rings are put to that on even races; where balls
    find none there, the next step has to look for it again.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    place_on_waves(p, s, w, s[S.SPEED])
    for i in range(members.padded_size(p)):
        own[members.history(p) + i] = ws[members.vector(p, SP.PLACE) + i]
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        for row in (L.X, L.X1, L.X2):
            keep_balls(members.work(p, w, b), lv, row)
    converged = equations.restart_march(p, s, w)
    if not converged:
        own[members.march(p) + H.CONTRACTION] = 1.0
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        for _ in range(L.HISTORY):
            count_settled(lv, int(members.parameters(p, b)[P.LANES]), members.work(p, w, b))
    # nothing is known of the rate of acceleration yet, which Newmark's velocity contains: begin finely
    s[S.STEP] = FIRST * longest_of_all(p, own, s[S.SPEED])
    equations.publish_all(p, s, w)
    return converged


@kernel
def follows_defects(p, s, w):
    """Whether no local defect is deeper than balls follow, see above; their contacts are in ``w``."""
    for b in range(members.bearing_count(p)):
        c = members.state(p, s, b)[S.C : S.C + C.SIZE]
        if taken_by_defects(members.parameters(p, b), c, members.work(p, w, b)) > _MOST_TAKEN:
            return False
    return True


@kernel
def start_rings(p, u, s, w, t):
    """Fill the state ``s`` of a set for the inputs ``u`` at time ``t`` (s); status code."""
    status = frozen_points.start_frozen(p, u, s, w, t)
    if status != OK:
        return status
    own = members.set_state(p, s)
    if not begin_at_rest(p, s, w):
        # see `start_response`
        status = frozen_points.freeze_from_zero(p, u, s, w)
        if status == OK and not begin_at_rest(p, s, w):
            status = NO_START
        if status != OK:
            return status
    if not follows_defects(p, s, w):
        return DEEP_DEFECT
    growth.search_at_once(p, s, w)
    for b in range(members.bearing_count(p)):
        begin_means(members.state(p, s, b))
    for i in range(2):
        own[SP.MEAN_HEAT + i] = 0.0
    return OK
