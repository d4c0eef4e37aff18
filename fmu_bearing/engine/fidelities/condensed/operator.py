"""What balls and cage do between the rings by the linearised equations of fidelity `full`, by their modes.

The condensed balls (``balls``) rest between the races at every instant. In fidelity `full` they have inertia,
slip, and spin axes that lag behind, and the cage goes with them. About the held point, where all balls carry
equal loads, that is linear: with q the rings' displacements from it, v their velocities, x the states of one
pattern of the balls (places x, r, angle; their rates; spins) and of the cage, family by family

    x' = A x + C_q q + C_v v + K e,       a = a_c(q, v, waves) + R_q q + R_v v + D x - D_e e.

A, C and D are blocks of the Jacobian of `full`, in axes that do not turn: balls' rates are less n times their
orbit's turning there. a_c are the accelerations with the balls at rest, with all their nonlinearity and
waves; R are the derivatives of `full` less theirs. e is how far the balls' places of rest (x, r), and by how
much both contacts press there, are from what the rings' linear motion would give: what waves and nonlinear
contacts do. K e accelerates the balls as their contacts would, and as friction does that follows the loads of
rest; D_e e takes out of a_c what x brings in again, and adds that friction. Without waves and for small
motions e is zero, and this is the linearised `full` itself, for any stiffness and at any frequency. K and D_e
are of how contacts press: a wave under a ball moves no surface along the track.

Modes of A that grow while the rings are held are left out: the cage whirls in its lands, or friction that
falls with sliding drives a ball. That motion is bounded by what is not linear.
"""

import math

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
    k = member(family, 0, b)
    by_place, by_rate = jac[at + k * STRIDE], jac[at + (k + Q.SIZE) * STRIDE]
    if family == 0:
        return by_place, 0.0, by_rate, 0.0
    m = member(1, 1, b)
    s = -side(1, b)
    return by_place, s * jac[at + m * STRIDE], by_rate, s * jac[at + (m + Q.SIZE) * STRIDE]


@kernel
def by_ball(p, jac, family, a, k):
    """Complex acceleration of coordinate ``a`` of a family by state ``k`` of the balls' pattern."""
    many = acting(p, family)
    re = many * jac[J.D + (member(family, 0, a) * J.STATES + k) * STRIDE]
    if family == 0:
        return re, 0.0
    return re, many * side(1, a) * jac[J.D + (member(1, 1, a) * J.STATES + k) * STRIDE]


@kernel
def hold_loosely(re, at):
    """Damp the rate of a place that nothing drags: place and rate would share one mode."""
    if abs(re[at]) < _SLOW:
        re[at] -= _SLOW


@kernel
def add_springs(p, radius, re, im, n):
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
        both = 2.0 * strength * sin * cos * math.sin(apart)
        re[across + r] -= 2.0 * strength * sin * sin * (1.0 + math.cos(apart))
        im[across + a] -= both * radius
        im[along + r] += both / radius
        re[along + a] -= 2.0 * strength * cos * cos * (1.0 - math.cos(apart))


@kernel
def gather_states(p, jac, orbit, radius, family, n, w):
    """Put A to ``T.STATES``, scaled, and the states' rates by the rings to ``T.BY_RINGS``, not scaled.

    ``orbit``: of the balls (rad/s), on a circle of ``radius`` (m).
    """
    re = w[T.STATES : T.STATES + 2 * n * n]
    im = w[T.STATES + 2 * L.INTERNAL * L.INTERNAL : T.STATES + 2 * L.INTERNAL * L.INTERNAL + 2 * n * n]
    for i in range(2 * n * n):
        re[i] = 0.0
        im[i] = 0.0
    rings = family_size(family)
    cage = rings  # coordinates of a family: the cage's behind the rings'
    for i in range(_BALL_ROWS):
        im[i * n + i] = -family * orbit
    for i in range(J.PLACED):
        re[i * n + J.PLACED + i] = 1.0
    for i in range(J.BALL):
        row = (J.PLACED + i) * n
        for k in range(J.STATES):
            re[row + k] = jac[J.B + (i * J.STATES + k) * STRIDE]
        for k in range((n - _BALL_ROWS) // 2):
            pr, pi, vr, vi = ball_by(jac, i, family, cage + k)
            re[row + _BALL_ROWS + k] = pr
            im[row + _BALL_ROWS + k] = pi
            re[row + _BALL_ROWS + 2 + k] = vr
            im[row + _BALL_ROWS + 2 + k] = vi
    for a in range((n - _BALL_ROWS) // 2):
        re[(_BALL_ROWS + a) * n + _BALL_ROWS + 2 + a] = 1.0
        row = (_BALL_ROWS + 2 + a) * n
        for k in range(J.STATES):
            re[row + k], im[row + k] = by_ball(p, jac, family, cage + a, k)
        for k in range(2):
            pr, pi = by_members(jac, J.E, J.BODIES, 1, family, cage + a, cage + k)
            vr, vi = by_members(jac, J.E + Q.SIZE, J.BODIES, 1, family, cage + a, cage + k)
            re[row + _BALL_ROWS + k] = pr
            im[row + _BALL_ROWS + k] = pi
            re[row + _BALL_ROWS + 2 + k] = vr
            im[row + _BALL_ROWS + 2 + k] = vi
        hold_loosely(re, row + _BALL_ROWS + 2 + a)
    if family == 1:
        add_springs(p, radius, re, im, n)
    hold_loosely(re, (J.BALL - 1) * n + J.BALL - 1)
    for i in range(n):
        for k in range(n):
            share = own_scale(p, k) / own_scale(p, i)
            re[i * n + k] *= share
            im[i * n + k] *= share
    for b in range(rings):
        for i in range(n):
            at = T.BY_RINGS + T.PER_RING * (i * L.FAMILY_RINGS + b)
            for k in range(T.PER_RING):
                w[at + k] = 0.0
            if J.PLACED <= i < _BALL_ROWS:
                w[at], w[at + 1], w[at + 2], w[at + 2 + 1] = ball_by(jac, i - J.PLACED, family, b)
            elif i >= _BALL_ROWS + 2:
                a = cage + i - _BALL_ROWS - 2
                w[at], w[at + 1] = by_members(jac, J.E, J.BODIES, 1, family, a, b)
                w[at + 2], w[at + 2 + 1] = by_members(jac, J.E + Q.SIZE, J.BODIES, 1, family, a, b)


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
    """Modes of ``T.STATES`` and their inverse; False where there are none to work with."""
    inner = 2 * L.INTERNAL * L.INTERNAL
    re, im = w[T.STATES : T.STATES + inner], w[T.STATES + inner : T.STATES + 2 * inner]
    half = L.INTERNAL * L.INTERNAL
    vr, vi = w[T.VECTORS : T.VECTORS + half], w[T.VECTORS + half : T.VECTORS + 2 * half]
    if not eigen(re, im, w[T.TURNS : T.TURNS + half], w[T.TURNS + half : T.TURNS + 2 * half], vr, vi, n):
        return False
    width = 2 * n
    ar, ai = w[T.INVERSE_RE : T.INVERSE_RE + n * width], w[T.INVERSE_IM : T.INVERSE_IM + n * width]
    for i in range(n):
        for k in range(n):
            ar[i * width + k] = vr[i * n + k]
            ai[i * width + k] = vi[i * n + k]
            ar[i * width + n + k] = 1.0 if i == k else 0.0
            ai[i * width + n + k] = 0.0
    return solve_complex(ar, ai, n, width)


@kernel
def put(lv, row, mode, re, im):
    """Write a complex number of ``mode`` into a row."""
    lv[row + mode] = re
    lv[row + L.MODES + mode] = im


@kernel
def counts(family, n, mode, w):
    """How often the real part of a mode found counts: of family 0 twice for one of a pair; 0: left out."""
    half = L.INTERNAL * L.INTERNAL
    re, im = w[T.STATES + mode * n + mode], w[T.STATES + 2 * half + mode * n + mode]
    if re > _GROWS:
        return 0.0
    if family == 1 or abs(im) <= _REAL * abs(re):
        return 1.0
    return 2.0 if im > 0.0 else 0.0


@kernel
def keep_modes(p, lv, jac, family, n, w):
    """Write the modes found; their number."""
    f = L.FAMILY + family * L.FAMILY_SIZE
    rings = family_size(family)
    half = L.INTERNAL * L.INTERNAL
    width = 2 * n
    into = 0
    for m in range(n):
        twice = counts(family, n, m, w)
        if twice == 0.0:
            continue
        vr, vi = w[T.STATES + m * n + m], w[T.STATES + 2 * half + m * n + m]
        put(lv, f + L.VALUE, into, vr, vi)
        for b in range(rings):
            sums_pr, sums_pi, sums_vr, sums_vi = 0.0, 0.0, 0.0, 0.0
            for i in range(n):
                xr = w[T.INVERSE_RE + m * width + n + i] / own_scale(p, i)
                xi = w[T.INVERSE_IM + m * width + n + i] / own_scale(p, i)
                at = T.BY_RINGS + T.PER_RING * (i * L.FAMILY_RINGS + b)
                sums_pr += xr * w[at] - xi * w[at + 1]
                sums_pi += xr * w[at + 1] + xi * w[at]
                sums_vr += xr * w[at + 2] - xi * w[at + 2 + 1]
                sums_vi += xr * w[at + 2 + 1] + xi * w[at + 2]
            put(lv, f + L.IN_PLACE + b * L.COMPLEX, into, sums_pr, sums_pi)
            put(lv, f + L.IN_RATE + b * L.COMPLEX, into, sums_vr, sums_vi)
            sums_pr, sums_pi = sums_pr + vr * sums_vr - vi * sums_vi, sums_pi + vr * sums_vi + vi * sums_vr
            put(lv, f + L.IN_WHOLE + b * L.COMPLEX, into, sums_pr, sums_pi)
        for k in range(L.AWAYS):
            sums_pr, sums_pi = 0.0, 0.0
            for i in range(J.BALL):
                # contacts push a ball towards its place of rest
                stiff = w[T.HOLDS + L.AWAYS * i + k]
                scale = own_scale(p, J.PLACED + i)
                sums_pr += w[T.INVERSE_RE + m * width + n + J.PLACED + i] / scale * stiff
                sums_pi += w[T.INVERSE_IM + m * width + n + J.PLACED + i] / scale * stiff
            put(lv, f + L.IN_AWAY + k * L.COMPLEX, into, sums_pr, sums_pi)
        for a in range(rings):
            sums_pr, sums_pi = 0.0, 0.0
            for i in range(n):
                dr, di = ring_by(p, jac, family, a, i)
                xr, xi = (
                    own_scale(p, i) * w[T.VECTORS + i * n + m],
                    own_scale(p, i) * w[T.VECTORS + half + i * n + m],
                )
                sums_pr += dr * xr - di * xi
                sums_pi += dr * xi + di * xr
            put(lv, f + L.OUT + a * L.COMPLEX, into, twice * sums_pr, twice * sums_pi)
        for i in range(n):
            xr, xi = (
                own_scale(p, i) * w[T.VECTORS + i * n + m],
                own_scale(p, i) * w[T.VECTORS + half + i * n + m],
            )
            put(lv, f + L.SHAPE + i * L.COMPLEX, into, twice * xr, twice * xi)
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
def find_beside(p, lv, jac, w):
    """Write the rings' own derivatives that `full` has beside those with balls at rest.

    By families: differences couple them a little, the more aside the rings are, and not in the mirror image
    of a bearing.
    """
    for family in range(2):
        for a in range(family_size(family)):
            for b in range(family_size(family)):
                re, im = by_members(jac, J.E, J.BODIES, 1, family, a, b)
                now_re, now_im = by_members(lv, L.JX, 1, L.COLUMN, family, a, b)
                add_members(re - now_re, im - now_im, 1.0, lv, L.BESIDE_PLACE, 1, L.COLUMN, family, a, b)
                re, im = by_members(jac, J.E + Q.SIZE, J.BODIES, 1, family, a, b)
                now_re, now_im = by_members(lv, L.JV, 1, L.COLUMN, family, a, b)
                add_members(re - now_re, im - now_im, 1.0, lv, L.BESIDE_RATE, 1, L.COLUMN, family, a, b)


@kernel
def clear_operator(lv):
    """Let balls follow statically, from now on."""
    for i in range(L.OPERATOR_BEGIN, L.FAMILY + 2 * L.FAMILY_SIZE):
        lv[i] = 0.0
    lv[L.MODES_STEP] = 0.0


@kernel
def keep_states(lv, w):
    """Put the states of balls and cage away from where their drive would hold them to ``T.KEPT``."""
    for i in range(2 * L.COMPLEX):
        w[T.KEPT + i] = 0.0
    if lv[L.OPERATOR] + lv[L.OPERATOR + 1] == 0.0:
        return
    for family in range(2):
        f = L.FAMILY + family * L.FAMILY_SIZE
        z = L.MODES_NOW + family * L.COMPLEX
        for m in range(int(lv[L.OPERATOR + family])):
            re, im = held_by(lv, family, m, lv, L.MODES_DRIVEN)
            re, im = lv[z + m] - re, lv[z + L.MODES + m] - im
            for i in range(L.INTERNAL):
                shape = f + L.SHAPE + i * L.COMPLEX + m
                xr, xi = lv[shape], lv[shape + L.MODES]
                w[T.KEPT + family * L.COMPLEX + i] += xr * re - xi * im
                w[T.KEPT + family * L.COMPLEX + L.MODES + i] += xr * im + xi * re


@kernel
def held_by(lv, family, m, x, drives):
    """Where the drives of rings at rest at ``x[drives:]`` would hold mode ``m`` of a family: complex."""
    value = L.FAMILY + family * L.FAMILY_SIZE + L.VALUE + m
    re, im = lv[value], lv[value + L.MODES]
    size = re * re + im * im
    if size < 1.0:
        return 0.0, 0.0
    at = drives + family * L.COMPLEX + m
    gr = x[at + L.BY_PLACE * L.BOTH] + x[at + L.BY_AWAY * L.BOTH]
    gi = x[at + L.BY_PLACE * L.BOTH + L.MODES] + x[at + L.BY_AWAY * L.BOTH + L.MODES]
    qr, qi = x[at + L.BY_RATE * L.BOTH], x[at + L.BY_RATE * L.BOTH + L.MODES]
    gr -= re * qr - im * qi
    gi -= re * qi + im * qr
    return -(gr * re + gi * im) / size, -(gi * re - gr * im) / size


@kernel
def put_states(p, lv, family, n, w):
    """Put the states ``T.KEPT`` to the modes just found, as distances from where their drive holds them."""
    z = L.MODES_NOW + family * L.COMPLEX
    width = 2 * n
    into = 0
    for i in range(L.COMPLEX):
        lv[z + i] = 0.0
    for m in range(n):
        if counts(family, n, m, w) == 0.0:
            continue
        for i in range(n):
            xr = w[T.INVERSE_RE + m * width + n + i] / own_scale(p, i)
            xi = w[T.INVERSE_IM + m * width + n + i] / own_scale(p, i)
            kr = w[T.KEPT + family * L.COMPLEX + i]
            ki = w[T.KEPT + family * L.COMPLEX + L.MODES + i] if family == 1 else 0.0
            lv[z + into] += xr * kr - xi * ki
            lv[z + L.MODES + into] += xr * ki + xi * kr
        into += 1


@kernel
def find_operator(p, lv, jac, orbit, w):
    """Fill the operator from the Jacobian of `full` at the held point and derivatives with balls at rest.

    Both were just made there, after `contact_forces`. ``orbit``: rad/s of the balls. States of
    balls and cage are carried over.
    """
    keep_states(lv, w)
    clear_operator(lv)
    for i in range(L.MATRIX):
        lv[L.HELD_PLACE + i] = lv[L.JX + i]
        lv[L.HELD_RATE + i] = lv[L.JV + i]
    n = internal(p)
    radius = p[P.PITCH_RADIUS] + lv[L.Y0 + Y.R]
    for family in range(2):
        gather_states(p, jac, orbit, radius, family, n, w)
        if not find_modes(p, n, w):
            clear_operator(lv)
            return
        lv[L.OPERATOR + family] = keep_modes(p, lv, jac, family, n, w)
        put_states(p, lv, family, n, w)
        find_follow(lv, family, w)
        for i in range(T.PUSHED // 2):
            lv[L.FAMILY + family * L.FAMILY_SIZE + L.PUSH + i] = w[T.PUSHES + family * (T.PUSHED // 2) + i]
    find_beside(p, lv, jac, w)
    for i in range(L.N):
        lv[L.AT_RINGS + i] = lv[L.Y0 + Y.Q0 + i]
    lv[L.AT_BALL] = lv[L.Y0 + Y.X]
    lv[L.AT_BALL + 1] = lv[L.Y0 + Y.R]
