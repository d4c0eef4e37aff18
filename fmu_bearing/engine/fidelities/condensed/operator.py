"""What balls and cage do between the rings by the linearised equations of fidelity `full`, by their modes.

The condensed balls (``balls``) rest between the races at every instant. In fidelity `full` they have inertia,
slip, and spin axes that lag behind, and the cage goes with them. About the frozen point, where all balls
carry equal loads, that is linear: with q the rings' displacements from it, v their velocities, x the states
of one pattern of the balls (places x, r, angle; their rates; spins) and of the cage, family by family

    x' = A x + C_q q + C_v v + K e,       a = a_c(q, v, waves) + R_q q + R_v v + D x - D_e e.

A, C and D are blocks of the Jacobian of `full`, in axes that do not turn: balls' rates are less n times their
orbit's turning there. a_c are the accelerations with the balls at rest, with all their nonlinearity and
waves; R are the derivatives of `full` less theirs. e is how far the balls' places of rest (x, r), and by how
much both contacts press there, are from what the rings' linear motion would give: what waves and nonlinear
contacts do. K e accelerates the balls as their contacts would, and as friction does that follows the loads of
rest; D_e e takes out of a_c what x brings in again, and adds that friction. Without waves and for small
motions e is zero, and this is the linearised `full` itself, for any stiffness and at any frequency. K and D_e
are of how contacts press: a wave under a ball moves no surface along the track.

Modes of A that grow while the rings are fixed are left out: the cage whirls in its lands, or friction that
falls with sliding drives a ball. That motion is bounded by what is not linear.
"""

import math

from fmu_bearing.engine.complex_numbers import complex_at, over, real_times, square
from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import solve_complex
from fmu_bearing.engine.eigen import eigen
from fmu_bearing.engine.fidelities.condensed.families import (
    acting,
    add_members,
    by_members,
    family_size,
    member,
    side,
)
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, J, L, P, Q, T, Y

_GROWS = 1.0  # 1/s: a mode that grows faster is left out
_SLOW = 1e-2  # 1/s: damping of a rate that nothing else damps
_REAL = 1e-9  # of its size: a smaller imaginary part of an eigenvalue is rounding
_FAST = 1e5  # 1/s: a rate over it is of the size of a place
_BALL_ROWS = J.BALL + J.PLACED  # states of a ball; the cage's follow


@kernel
def internal(p):
    """Return the number of states of balls and cage in a family."""
    return L.INTERNAL if p[P.CAGE] != 0.0 else _BALL_ROWS


@kernel
def own_scale(p, i):
    """Size of state ``i``: places in m, angles at the pitch circle, rates over a fast frequency."""
    if i < J.PLACED:
        return 1.0 if i < 2 else 1.0 / p[P.PITCH_RADIUS]
    if i < J.BALL:
        return _FAST if i < J.BALL - 1 else _FAST / p[P.PITCH_RADIUS]
    if i < _BALL_ROWS:
        return 2.0 * _FAST / p[P.DIAMETER]
    cage = i - _BALL_ROWS
    size = 1.0 if cage < 2 else _FAST
    return size if cage & 1 == 0 else size / p[P.PITCH_RADIUS]


@kernel
def ball_by(jac, i, family, b):
    """Complex acceleration ``i`` of a ball at angle 0 by coordinate ``b`` of a family: place, then velocity.

    A ball feels U exp(i phi) as the real part of (C_0 - i C_1) times it.
    """
    at = J.C + i * J.BODIES * STRIDE
    k = at + member(family, 0, b) * STRIDE
    if family == 0:
        return complex(jac[k], 0.0), complex(jac[k + Q.SIZE * STRIDE], 0.0)
    m = at + member(1, 1, b) * STRIDE
    s = -side(1, b)
    return complex(jac[k], s * jac[m]), complex(jac[k + Q.SIZE * STRIDE], s * jac[m + Q.SIZE * STRIDE])


@kernel
def by_ball(p, jac, family, a, k):
    """Complex acceleration of coordinate ``a`` of a family by state ``k`` of the balls' pattern."""
    many = acting(p, family)
    re = many * jac[J.D + (member(family, 0, a) * J.STATES + k) * STRIDE]
    if family == 0:
        return complex(re, 0.0)
    return complex(re, many * side(1, a) * jac[J.D + (member(1, 1, a) * J.STATES + k) * STRIDE])


@kernel
def damp_undragged(a, at):
    """Damp the rate of a place that nothing drags: place and rate would share one mode."""
    if abs(a[at].real) < _SLOW:
        a[at] -= _SLOW


@kernel
def add_springs(p, radius, x, n):
    """Add to A of family 1 the springs between neighbouring balls, which are slack where these lie evenly.

    One stretches by sin(D/2) (r + r') + R cos(D/2) (a' - a) between radii r, r' and angles a, a' of balls D
    apart, and pulls on both by that (`mechanics.springs`); r' = r exp(i D) in the pattern. Balls that move
    as one, family 0, stretch none. ``radius``: R (m).
    """
    apart = 2.0 * PI / p[P.BALLS]
    sin, cos = math.sin(0.5 * apart), math.cos(0.5 * apart)
    r, a = 1, 2  # places of a ball: x, r, angle
    for rate in range(2):
        strength = (p[P.SPRINGS] if rate == 0 else p[P.SPRING_DAMPING]) / p[P.BALL_MASS]
        across, along = (J.PLACED + r) * n + rate * J.PLACED, (J.PLACED + a) * n + rate * J.PLACED
        both = complex(0.0, 2.0 * strength * sin * cos * math.sin(apart))
        x[across + r] -= 2.0 * strength * sin * sin * (1.0 + math.cos(apart))
        x[across + a] -= both * radius
        x[along + r] += both * (1.0 / radius)
        x[along + a] -= 2.0 * strength * cos * cos * (1.0 - math.cos(apart))


@kernel
def gather_states(p, jac, orbit, radius, family, n, w):
    """Put A to ``T.STATES``, scaled, and the states' rates by the rings to ``T.BY_RINGS``, not scaled.

    ``orbit``: of the balls (rad/s), on a circle of ``radius`` (m).
    """
    x = complex_at(w, T.STATES, n * n)
    by_rings = complex_at(w, T.BY_RINGS, 2 * n * L.FAMILY_RINGS)
    for i in range(n * n):
        x[i] = 0.0
    for i in range(2 * n * L.FAMILY_RINGS):
        by_rings[i] = 0.0
    rings = family_size(family)
    cage = rings  # coordinates of a family: the cage's behind the rings'
    for i in range(_BALL_ROWS):
        x[i * n + i] = complex(0.0, -family * orbit)
    for i in range(J.PLACED):
        x[i * n + J.PLACED + i] = 1.0
    for i in range(J.BALL):
        row = (J.PLACED + i) * n
        for k in range(J.STATES):
            x[row + k] += jac[J.B + (i * J.STATES + k) * STRIDE]
        for k in range((n - _BALL_ROWS) // 2):
            x[row + _BALL_ROWS + k], x[row + _BALL_ROWS + 2 + k] = ball_by(jac, i, family, cage + k)
        for b in range(rings):
            at = 2 * ((J.PLACED + i) * L.FAMILY_RINGS + b)
            by_rings[at], by_rings[at + 1] = ball_by(jac, i, family, b)
    for a in range((n - _BALL_ROWS) // 2):
        x[(_BALL_ROWS + a) * n + _BALL_ROWS + 2 + a] = 1.0
        row = (_BALL_ROWS + 2 + a) * n
        for k in range(J.STATES):
            x[row + k] = by_ball(p, jac, family, cage + a, k)
        for rate in range(2):
            first = J.E + rate * Q.SIZE
            for k in range(2):
                by = by_members(jac, first, J.BODIES, 1, family, cage + a, cage + k)
                x[row + _BALL_ROWS + 2 * rate + k] = by
            for b in range(rings):
                at = 2 * ((_BALL_ROWS + 2 + a) * L.FAMILY_RINGS + b) + rate
                by_rings[at] = by_members(jac, first, J.BODIES, 1, family, cage + a, b)
        damp_undragged(x, row + _BALL_ROWS + 2 + a)
    if family == 1:
        add_springs(p, radius, x, n)
    damp_undragged(x, (J.BALL - 1) * n + J.BALL - 1)
    for i in range(n):
        for k in range(n):
            x[i * n + k] = real_times(own_scale(p, k) / own_scale(p, i), x[i * n + k])


@kernel
def ring_by(p, jac, family, a, i):
    """Complex acceleration of coordinate ``a`` of the rings by state ``i`` of balls and cage."""
    if i < J.STATES:
        return by_ball(p, jac, family, a, i)
    k = i - _BALL_ROWS
    first = J.E if k < 2 else J.E + Q.SIZE
    return by_members(jac, first, J.BODIES, 1, family, a, family_size(family) + (k & 1))


@kernel
def find_modes(p, n, w):
    """Modes of ``T.STATES`` and their inverse, no longer scaled; False where there are none to work with."""
    vectors = complex_at(w, T.VECTORS, n * n)
    if not eigen(complex_at(w, T.STATES, 2 * n * n), complex_at(w, T.TURNS, n * n), vectors, n):
        return False
    width = 2 * n
    inverse = complex_at(w, T.MODES_INVERSE, n * width)
    for i in range(n):
        for k in range(n):
            inverse[i * width + k] = vectors[i * n + k]
            inverse[i * width + n + k] = 1.0 if i == k else 0.0
    if not solve_complex(inverse, n, width):
        return False
    for i in range(n):
        scale = own_scale(p, i)
        for m in range(n):
            vectors[i * n + m] = real_times(scale, vectors[i * n + m])
            inverse[m * width + n + i] = real_times(1.0 / scale, inverse[m * width + n + i])
    return True


@kernel
def put(lv, row, mode, z):
    """Write a complex number of ``mode`` into a row."""
    lv[row + mode] = z.real
    lv[row + L.MODES + mode] = z.imag


@kernel
def mode_of(x, row, mode):
    """Complex number of ``mode`` in a row."""
    return complex(x[row + mode], x[row + L.MODES + mode])


@kernel
def counts(family, value):
    """How often the real part of a mode counts, by its eigenvalue; 0: left out.

    Of family 0 twice for one of a pair.
    """
    if value.real > _GROWS:
        return 0.0
    if family == 1 or abs(value.imag) <= _REAL * abs(value.real):
        return 1.0
    return 2.0 if value.imag > 0.0 else 0.0


@kernel
def keep_modes(p, lv, jac, family, n, w):
    """Write the modes found; their number."""
    f = L.FAMILY + family * L.FAMILY_SIZE
    rings = family_size(family)
    width = 2 * n
    states, vectors = complex_at(w, T.STATES, n * n), complex_at(w, T.VECTORS, n * n)
    by_rings = complex_at(w, T.BY_RINGS, 2 * n * L.FAMILY_RINGS)
    into = 0
    for m in range(n):
        value = states[m * n + m]
        twice = counts(family, value)
        if twice == 0.0:
            continue
        inverse = complex_at(w, T.MODES_INVERSE + 2 * (m * width + n), n)
        put(lv, f + L.VALUE, into, value)
        for b in range(rings):
            by_place, by_rate = 0j, 0j
            for i in range(n):
                at = 2 * (i * L.FAMILY_RINGS + b)
                by_place += inverse[i] * by_rings[at]
                by_rate += inverse[i] * by_rings[at + 1]
            put(lv, f + L.IN_PLACE + b * L.COMPLEX, into, by_place)
            put(lv, f + L.IN_RATE + b * L.COMPLEX, into, by_rate)
            put(lv, f + L.IN_WHOLE + b * L.COMPLEX, into, by_place + value * by_rate)
        for k in range(L.AWAYS):
            total = 0j
            for i in range(J.BALL):
                # contacts push a ball towards its place of rest
                total += real_times(w[T.RESTORING + L.AWAYS * i + k], inverse[J.PLACED + i])
            put(lv, f + L.IN_AWAY + k * L.COMPLEX, into, total)
        for a in range(rings):
            total = 0j
            for i in range(n):
                total += ring_by(p, jac, family, a, i) * vectors[i * n + m]
            put(lv, f + L.OUT + a * L.COMPLEX, into, twice * total)
        for i in range(n):
            put(lv, f + L.SHAPE + i * L.COMPLEX, into, twice * vectors[i * n + m])
        into += 1
    return into


@kernel
def find_follow(lv, family, w):
    """Write how balls at rest follow the rings, from derivatives just made with ball 0 at angle 0."""
    f = L.FAMILY + family * L.FAMILY_SIZE + L.FOLLOW
    for k in range(2):
        for part in range(2):
            for b in range(family_size(family)):
                row = T.FOLLOW + k * STRIDE
                to = f + 2 * ((2 * part + k) * L.FAMILY_RINGS + b)
                lv[to] = w[row + (member(family, 0, b) + part * L.N) * T.FOLLOW_SIZE]
                lv[to + 1] = 0.0
                if family == 1:
                    lv[to + 1] = -side(1, b) * w[row + (member(1, 1, b) + part * L.N) * T.FOLLOW_SIZE]


@kernel
def find_feedthrough(lv, jac):
    """Write the rings' own derivatives that `full` has beside those with balls at rest.

    By families: differences couple them a little, the more aside the rings are, and not in the mirror image
    of a bearing.
    """
    for family in range(2):
        for a in range(family_size(family)):
            for b in range(family_size(family)):
                by = by_members(jac, J.E, J.BODIES, 1, family, a, b)
                by -= by_members(lv, L.JX, 1, L.COLUMN, family, a, b)
                add_members(by, lv, L.FEEDTHROUGH_PLACE, 1, L.COLUMN, family, a, b)
                by = by_members(jac, J.E + Q.SIZE, J.BODIES, 1, family, a, b)
                by -= by_members(lv, L.JV, 1, L.COLUMN, family, a, b)
                add_members(by, lv, L.FEEDTHROUGH_RATE, 1, L.COLUMN, family, a, b)


@kernel
def clear_operator(lv):
    """Let balls follow statically, from now on."""
    for i in range(L.OPERATOR_BEGIN, L.FAMILY + 2 * L.FAMILY_SIZE):
        lv[i] = 0.0
    lv[L.MODES_STEP] = 0.0


@kernel
def keep_states(lv, w):
    """Put the states of balls and cage away from where their drive would hold them to ``T.KEPT``."""
    kept = complex_at(w, T.KEPT, 2 * L.INTERNAL)
    for i in range(2 * L.INTERNAL):
        kept[i] = 0.0
    for family in range(2):
        shape = L.FAMILY + family * L.FAMILY_SIZE + L.SHAPE
        for m in range(int(lv[L.OPERATOR + family])):
            away = mode_of(lv, L.MODES_NOW + family * L.COMPLEX, m)
            away -= static_mode(lv, family, m, lv, L.MODES_DRIVEN)
            for i in range(L.INTERNAL):
                kept[family * L.INTERNAL + i] += mode_of(lv, shape + i * L.COMPLEX, m) * away


@kernel
def static_mode(lv, family, m, x, drives):
    """Where the drives of rings at rest at ``x[drives:]`` would hold mode ``m`` of a family: complex."""
    value = mode_of(lv, L.FAMILY + family * L.FAMILY_SIZE + L.VALUE, m)
    if square(value) < 1.0:
        return 0j
    at = drives + family * L.COMPLEX
    drive = mode_of(x, at + L.BY_PLACE * L.BOTH, m) + mode_of(x, at + L.BY_AWAY * L.BOTH, m)
    return over(value * mode_of(x, at + L.BY_RATE * L.BOTH, m) - drive, value)


@kernel
def put_states(lv, family, n, w):
    """Put the states ``T.KEPT`` to the modes just found, as distances from where their drive holds them."""
    z = L.MODES_NOW + family * L.COMPLEX
    kept = complex_at(w, T.KEPT + 2 * family * L.INTERNAL, n)
    states = complex_at(w, T.STATES, n * n)
    into = 0
    for i in range(L.COMPLEX):
        lv[z + i] = 0.0
    for m in range(n):
        if counts(family, states[m * n + m]) == 0.0:
            continue
        inverse = complex_at(w, T.MODES_INVERSE + 2 * (2 * m + 1) * n, n)
        total = 0j
        for i in range(n):
            # of family 0 the real part counts
            total += inverse[i] * (kept[i] if family == 1 else kept[i].real)
        put(lv, z, into, total)
        into += 1


@kernel
def find_operator(p, lv, jac, orbit, w):
    """Fill the operator from the Jacobian of `full` at the frozen point and derivatives with balls at rest.

    Both were just made there, after `contact_forces`. ``orbit``: rad/s of the balls. States of
    balls and cage are carried over.
    """
    keep_states(lv, w)
    clear_operator(lv)
    for i in range(L.MATRIX):
        lv[L.FROZEN_JX + i] = lv[L.JX + i]
        lv[L.FROZEN_JV + i] = lv[L.JV + i]
    n = internal(p)
    radius = p[P.PITCH_RADIUS] + lv[L.Y0 + Y.R]
    for family in range(2):
        gather_states(p, jac, orbit, radius, family, n, w)
        if not find_modes(p, n, w):
            clear_operator(lv)
            return
        lv[L.OPERATOR + family] = keep_modes(p, lv, jac, family, n, w)
        put_states(lv, family, n, w)
        find_follow(lv, family, w)
        for i in range(T.COUPLING_SIZE // 2):
            lv[L.FAMILY + family * L.FAMILY_SIZE + L.COUPLING + i] = w[
                T.COUPLING + family * (T.COUPLING_SIZE // 2) + i
            ]
    find_feedthrough(lv, jac)
    for i in range(L.N):
        lv[L.AT_RINGS + i] = lv[L.Y0 + Y.Q0 + i]
    lv[L.AT_BALL] = lv[L.Y0 + Y.X]
    lv[L.AT_BALL + 1] = lv[L.Y0 + Y.R]
