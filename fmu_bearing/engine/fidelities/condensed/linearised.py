"""Derivatives of the rings' accelerations and the rings' static equilibrium, with the balls condensed."""

from fmu_bearing.engine.dense import invert, times
from fmu_bearing.engine.fidelities.condensed.balls import accelerations
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, C, F, L, P, T, W, Y
from fmu_bearing.engine.newton.jacobian import is_angle

# m: central differences by it, tilts the same at the pitch circle, rates the same in the time constant of
# contact damping. The condensed forces are smooth to 1e-9 N, so differences hold 3e-7 of 10 N/um, and what is
# of the third order is 1e-5 of that at an approach of 0.1 um. It matters where both rings move together: the
# stiffnesses of two contacts cancel there, and what is left of them stands beside a soft support.
_MOVE = 3e-10
_SHORTEST = 1e-7  # s: shorter time constants are as good as none
_ROUNDS = 60
_LONGEST = 3e-6  # m: move of a ring in one round, about the approach of a loaded contact


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


@kernel
def invert_into(lv, w):
    """Inverse of ``T.MATRIX`` in ``w`` into ``L.INVERSE`` of ``lv``; False if singular."""
    if not invert(w, T.MATRIX, L.N, w, T.INVERSE):
        return False
    for k in range(L.N):
        for i in range(L.N):
            lv[L.INVERSE + L.COLUMN * k + i] = w[T.INVERSE + i * L.N + k]
        lv[L.INVERSE + L.COLUMN * k + L.N] = 0.0
    return True


@kernel
def at_rest(p, c, lv, speed, w):
    """Find the rings' static equilibrium without unbalance from the guess in ``w[W.STAGE:]``; whether found.

    Newton's method with moves of a few micrometres at most; soft directions (no preload) are held by a
    floor of (50 rad/s)^2 on the diagonal, a hundredth of the lowest spring that a scene's pedestal makes.
    """
    lever = p[P.PITCH_RADIUS]
    eccentricity = c[C.ECCENTRICITY]
    c[C.ECCENTRICITY] = 0.0
    found = False
    for _ in range(_ROUNDS):
        if not derivatives(p, c, lv, 0.0, speed, 0.0, w):
            break
        for i in range(L.N):
            lv[L.JX + L.DIAGONAL * i] -= 2500.0
        if not factor_step_static(lv, w):
            break
        for i in range(L.N):
            w[T.A + i] = w[W.F + F.BODY + i]
        times(lv, L.INVERSE, w, T.A, w, T.D)
        longest = 0.0
        for i in range(L.N):
            longest = max(longest, abs(w[T.D + i]) * (lever if is_angle(i) else 1.0))
        if not (longest < 1e3):
            break
        share = min(1.0, _LONGEST / (longest + 1e-300))
        for i in range(L.N):
            w[W.STAGE + Y.Q0 + i] += share * w[T.D + i]
        if longest < 1e-12:
            found = True
            break
    c[C.ECCENTRICITY] = eccentricity
    return found


@kernel
def factor_step_static(lv, w):
    """Inverse of ``-J_x`` into ``L.INVERSE``; False if singular."""
    for i in range(L.N):
        for k in range(L.N):
            w[T.MATRIX + i * L.N + k] = -lv[L.JX + i + L.COLUMN * k]
    return invert_into(lv, w)
