"""How fidelity `rings` begins: where rings and balls rest on waves and unequal balls."""

from fmu_bearing.engine.fidelities.condensed.balls import count_settled, stand
from fmu_bearing.engine.fidelities.condensed.linearised import at_rest
from fmu_bearing.engine.fidelities.condensed.publish import publish
from fmu_bearing.engine.fidelities.condensed.rows import keep_balls, show_balls
from fmu_bearing.engine.fidelities.condensed.shared import start_condensed
from fmu_bearing.engine.fidelities.rings.march import FIRST, begin_anew, longest_step
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, F, L, P, S, W, Y
from fmu_bearing.engine.newton.jacobian import is_angle
from fmu_bearing.engine.status import NO_START, OK


@kernel
def start_rings(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    status = start_condensed(p, u, s, w, t)
    if status != OK:
        return status
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    lv[L.THETA] = 0.0
    lv[L.ROLLED] = 0.0
    if not begin_at_rest(p, s, w):
        return NO_START
    for i in range(3):
        s[S.MEAN_HEAT + i] = lv[L.HEAT + i]
    s[S.MEAN_TORQUE] = s[S.F + F.TORQUE]
    return OK


@kernel
def begin_at_rest(p, s, w):
    """Begin where rings and balls rest at the clock and angles reached; False where balls find no rest.

    ``L.MEAN`` and the trial state hold the rest on even races. Where there is none on waves and unequal
    balls, the rings stand there; where balls find none there, the next step has to look for it again.
    """
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    # from the even races' equilibrium to the one on waves and unequal balls, or the start would ring
    c = s[S.C : S.C + C.SIZE]
    keep_balls(w, lv, L.EVEN)
    stand(p, c, lv, lv[L.THETA], lv[L.ROLLED], s[S.ANGLE], 0.0, s[S.SPEED], w)
    if not at_rest(p, c, lv, s[S.SPEED], w):
        for i in range(L.N):
            w[W.STAGE + Y.Q0 + i] = lv[L.MEAN + i]
        show_balls(lv, L.EVEN, w)
    for i in range(L.N):
        lv[L.Q0 + i] = w[W.STAGE + Y.Q0 + i]
        lv[L.V0 + i] = 0.0
        lv[L.A0 + i] = 0.0
        lv[L.LEVERS + i] = p[P.PITCH_RADIUS] if is_angle(i) else 1.0
    for row in (L.X, L.X1, L.X2):
        keep_balls(w, lv, row)
    found = begin_anew(p, s, w)
    if not found:
        lv[L.CONTRACTION] = 1.0
    for _ in range(L.HISTORY):
        count_settled(lv, int(p[P.LANES]), w)
    # nothing is known of the rate of acceleration yet, which Newmark's velocity contains: begin finely
    s[S.STEP] = FIRST * longest_step(p, lv[L.HIGHEST], s[S.SPEED])
    publish(p, lv, s[S.SPEED], s[S.SPEED_RATE], True, s[S.Y : S.Y + Y.SIZE], s[S.F : S.F + F.SIZE])
    return found
