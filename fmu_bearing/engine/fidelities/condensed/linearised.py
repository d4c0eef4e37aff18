"""Derivatives of the rings' accelerations, with the balls condensed."""

from fmu_bearing.engine.fidelities.condensed.balls import accelerations
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, F, L, P, T, W, Y
from fmu_bearing.engine.newton.jacobian import is_angle

# m: central differences by it, tilts the same at the pitch circle, rates the same in the time constant of
# contact damping. The condensed forces are smooth to 1e-9 N, so differences hold 3e-7 of 10 N/um, and what is
# of the third order is 1e-5 of that at an approach of 0.1 um. It matters where both rings move together: the
# stiffnesses of two contacts cancel there, and what is left of them acts beside a soft support.
_MOVE = 3e-10
_SHORTEST = 1e-7  # s: shorter time constants are as good as none


@kernel
def derivatives(p, c, lv, angle, speed, speed_rate, w):
    """Fill ``L.JX`` and ``L.JV`` at the state in ``w[W.STAGE:]``; False where balls find no rest.

    The balls' places in ``w`` belong to the state before and after. ``w[W.F + F.BODY:]`` keeps its
    accelerations; ``T.FOLLOW``: how the balls' places follow.
    """
    q = w[T.Q : T.Q + L.COLUMN]
    lever = p[P.PITCH_RADIUS]
    # each evaluation squares what the balls are off by: 60 nm at first, 0.6 nm, nothing beside _MOVE
    for _ in range(3):
        if not accelerations(p, c, lv, angle, speed, speed_rate, q, w):
            return False
    for i in range(L.N):
        w[T.BASE + i] = w[W.F + F.BODY + i]
    for i in range(2 * STRIDE):
        w[T.BALLS + i] = w[T.X + i]
    for k in range(2 * L.N):
        i = k if k < L.N else k - L.N
        at = W.STAGE + (Y.Q0 if k < L.N else Y.V0) + i
        step = _MOVE if k < L.N else _MOVE / max(p[P.CONTACT_DAMPING], _SHORTEST)
        if is_angle(i):
            step /= lever
        into = (L.JX if k < L.N else L.JV) + L.COLUMN * i
        unmoved = w[at]
        for side in range(-1, 2, 2):
            w[at] = unmoved + side * step
            fine = accelerations(p, c, lv, angle, speed, speed_rate, q, w)
            w[at] = unmoved
            per = side / (2.0 * step)
            for m in range(L.N):
                change = w[W.F + F.BODY + m] - w[T.BASE + m]
                lv[into + m] = per * change + (0.0 if side < 0 else lv[into + m])
            for m in range(2 * STRIDE):
                follow = T.FOLLOW + k * T.FOLLOW_SIZE + m
                moved = per * (w[T.X + m] - w[T.BALLS + m])
                w[follow] = moved + (0.0 if side < 0 else w[follow])
                w[T.X + m] = w[T.BALLS + m]
            if not fine:
                return False
    for i in range(L.N):
        w[W.F + F.BODY + i] = w[T.BASE + i]
    return True
