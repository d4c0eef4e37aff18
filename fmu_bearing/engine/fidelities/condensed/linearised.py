"""Derivatives of the rings' accelerations and the rings' static equilibrium, with the balls condensed."""

from fmu_bearing.engine.dense import invert, times
from fmu_bearing.engine.fidelities.condensed.balls import accelerations
from fmu_bearing.engine.fidelities.condensed.rows import component
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, C, F, L, P, Q, T, W, Y
from fmu_bearing.engine.newton.body_slopes import inertia
from fmu_bearing.engine.newton.jacobian import is_angle

# Differences: displacement 1 nm (0.1 N in 100), tilt the same at the pitch circle, and rates that advance the
# approach by as much. The condensed forces are smooth to 1e-9 N, so differences hold 1e-7.
_MOVE = 1e-9
_RATE = 1e-2
_ROUNDS = 60
_LONGEST = 3e-6  # m: move of a ring in one round, about the approach of a loaded contact


@kernel
def derivatives(p, c, lv, angle, speed, speed_rate, w):
    """Fill ``L.JX`` and ``L.JV`` at the state in ``w[W.STAGE:]``; False where balls find no rest.

    The balls' places in ``w`` belong to the state before and after. ``w[W.F + F.BODY:]`` keeps its
    accelerations; ``T.FOLLOW`` is what :func:`added_mass` needs.
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
        step = _MOVE if k < L.N else _RATE
        if is_angle(i):
            step /= lever
        unmoved = w[at]
        w[at] = unmoved + step
        fine = accelerations(p, c, lv, angle, speed, speed_rate, q, w)
        w[at] = unmoved
        into = (L.JX if k < L.N else L.JV) + L.COLUMN * i
        for m in range(L.N):
            lv[into + m] = (w[W.F + F.BODY + m] - w[T.BASE + m]) / step
        for m in range(2 * STRIDE):
            w[T.FOLLOW + k * T.FOLLOW_SIZE + m] = (w[T.X + m] - w[T.BALLS + m]) / step
            w[T.X + m] = w[T.BALLS + m]
        if not fine:
            return False
    for i in range(L.N):
        w[W.F + F.BODY + i] = w[T.BASE + i]
    return True


@kernel
def across_track(w, j, i, contact_x):
    """Velocity along the track at a contact per unit rate of one ring's motion ``i``: x y z by bz."""
    co = w[T.COS + j]
    si = w[T.SIN + j]
    if i == Q.Y:
        return -co
    if i == Q.Z:
        return -si
    if i == Q.INNER_BY:
        return si * contact_x
    if i == Q.INNER_BZ:
        return -co * contact_x
    return 0.0


@kernel
def added_mass(p, c, lv, w):
    """Identity plus the balls' share of the mass matrix over the rings' own masses, into ``L.MASS``.

    Along the contacts the balls follow as their static equilibrium does (``T.FOLLOW``, derivatives of
    (x, r) by the coordinates, less what ``transverse`` moves). Along the track they roll: the centre goes
    with the mean of both races, and half their difference turns the ball, which counts 2/5 of its mass.
    """
    ball = p[P.BALL_MASS]
    tx = lv[L.SIDE]
    tr = lv[L.SIDE + 1]
    # contacts lie off the bearing's middle by the ball's radius times the sine of about the free angle
    x_o = c[C.BALL_RADIUS] * c[C.RACES + C.GROOVE_X] / (c[C.RACES + C.FREE] + 1e-12)
    x_i = -x_o
    for i in range(L.N):
        for k in range(L.N):
            total = 0.0
            for j in range(int(p[P.BALLS])):
                a = T.FOLLOW + i * T.FOLLOW_SIZE + j
                b = T.FOLLOW + k * T.FOLLOW_SIZE + j
                total += w[a] * w[b] + w[a + STRIDE] * w[b + STRIDE]
                total -= (tx * w[a] + tr * w[a + STRIDE]) * (tx * w[b] + tr * w[b + STRIDE])
                ti = across_track(w, j, i, x_i) if i < Q.OUTER else 0.0
                tk = across_track(w, j, k, x_i) if k < Q.OUTER else 0.0
                oi = across_track(w, j, component(i) - Q.OUTER, x_o) if i >= Q.OUTER and i != L.TURN else 0.0
                ok = across_track(w, j, component(k) - Q.OUTER, x_o) if k >= Q.OUTER and k != L.TURN else 0.0
                total += 0.25 * (ti + oi) * (tk + ok) + 0.1 * (ti - oi) * (tk - ok)
            lv[L.MASS + i + L.COLUMN * k] = (1.0 if i == k else 0.0) + ball * total / inertia(p, i)


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
def step_matrix(lv, cv, cx, w):
    """Put ``B - cv J_v - cx J_x`` to ``T.MATRIX``, row by row.

    The balls move across their tracks by ``L.SIDE_GAIN`` and ``L.SIDE_KICK`` meanwhile.
    """
    gain = lv[L.SIDE_GAIN]
    kick = lv[L.SIDE_KICK]
    by_place = cx * lv[L.SIDE_SQUARE]
    by_rate = cv * lv[L.SIDE_RATE]
    for k in range(L.N):
        for i in range(L.N):
            at = i + L.COLUMN * k
            value = lv[L.MASS + at] - cv * lv[L.JV + at] - cx * lv[L.JX + at]
            for row in range(0, L.PATTERNS * L.COLUMN, L.COLUMN):
                by = gain * lv[L.SIDE_PULL + row + i] + kick * lv[L.SIDE_DRAG + row + i]
                value -= by * (by_place * lv[L.SIDE_FOLLOW + row + k] + by_rate * lv[L.SIDE_GUIDE + row + k])
            w[T.MATRIX + i * L.N + k] = value


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
