"""From one communication point to the next; where a step fails, the rings begin again at rest.

There are states that no step leads out of: a ball that has left its races, a ring flung by a jump of the
inputs. Clock, angles, sums, counts and sound go on; rings and balls begin at rest at the present inputs
(``solver.restarts`` counts it, and a warning says so). Where no step leads out of that rest either, they stay
there until the end of the communication step. A step is refused only where there is no rest at its inputs.
"""

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed import shared
from fmu_bearing.engine.fidelities.condensed.ball_motion import forget_balls
from fmu_bearing.engine.fidelities.condensed.held import hold
from fmu_bearing.engine.fidelities.condensed.linearised import at_rest
from fmu_bearing.engine.fidelities.condensed.publish import publish
from fmu_bearing.engine.fidelities.condensed.rows import from_equilibrium, keep_balls, turn_balls
from fmu_bearing.engine.fidelities.rings.march import go_on, take_inputs
from fmu_bearing.engine.fidelities.rings.predictor import forget
from fmu_bearing.engine.fidelities.rings.start import begin_at_rest
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, F, L, P, S, U, W, Y
from fmu_bearing.engine.status import OK

TRIES = 3  # times to begin again within a communication step, before the rings wait for its end


@kernel
def forget_motion(lv):
    """Forget how the balls have moved across their tracks."""
    for i in range(L.SIDE_PLACE, L.SIDE_REST + L.PATTERNS):
        lv[i] = 0.0
    forget_balls(lv)


@kernel
def begin_again(p, u, s, w):
    """Put rings and balls to rest at the inputs ``u`` and the clock reached; status code."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    status = hold(p, u, u[U.SPEED], s, w)
    if status != OK:
        return status
    shared.hold_masses(p, s, w)
    for part in range(2):
        status = shared.quasistatic_places(p, c, s[S.SPEED], w)
        if status != OK:
            return status
        shared.flat(p, c, lv, w)
        if part == 1 or at_rest(p, c, lv, s[S.SPEED], w):
            break
    for i in range(L.N):
        lv[L.MEAN + i] = w[W.STAGE + Y.Q0 + i]
    keep_balls(w, lv, L.EVEN)
    from_equilibrium(p, lv, lv[L.THETA], w)
    forget(lv, L.MARCH, L.MOVING, L.COLUMN)
    forget_motion(lv)
    begin_at_rest(p, s, w)
    return OK


@kernel
def wait(p, s, w, h):
    """Let the time ``h`` (s) pass with the rings at rest."""
    turn_balls(s, h)
    if p[P.SOUND_SIZE] != 0.0:
        shared.emit(p, s, w, h, True)
    shared.advance(s, h)


@kernel
def march_rings(p, u, s, w, h):
    """Advance the state by the communication step ``h`` (s); status code."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    steps.begin_means(s)
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
    s[S.TIME] = end
    s[S.SPEED] = u[U.SPEED]
    publish(p, lv, s[S.SPEED], s[S.SPEED_RATE], True, s[S.Y : S.Y + Y.SIZE], s[S.F : S.F + F.SIZE])
    steps.end_means(s, h)
    return OK
