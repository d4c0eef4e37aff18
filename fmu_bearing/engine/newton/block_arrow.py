"""The Newton system (I - cv Jv - cx Jx) d = r in accelerations: one 6 x 6 block per ball, a border of 17.

The balls are eliminated first; what remains for the bodies is inverted once per factorisation. Between
factorisations the bearing turns: the solve turns the bodies' y, z pairs back by the orbit angle passed
since, which keeps an old Jacobian exact for equal ball loads and an isotropic pedestal.

Everything that belongs to balls is done for four of them at a time.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import (
    dot_six,
    in_groups,
    load,
    plus_scaled,
    six,
    splat,
    store,
    store_six,
    sum_four,
)
from fmu_bearing.engine.layout import FOUR, MAX_BALLS, STRIDE, A, F, J, P, Q, W
from fmu_bearing.engine.newton.springs import couple_springs, spring_matrix

_ROW = J.STATES * STRIDE  # from one row of blocks B and D to the next
_BODIES = J.BODIES * STRIDE  # and of block C


@kernel
def invert_block(a, at):
    """Invert the 6 x 6 blocks of a group at ``a[at:]`` in place (Gauss-Jordan; their diagonals dominate)."""
    for k in range(J.BALL):
        row = at + k * A.SIX
        pivot = 1.0 / load(a, row + k * FOUR)
        store(a, row + k * FOUR, pivot)
        for m in range(J.BALL):
            if m != k:
                store(a, row + m * FOUR, load(a, row + m * FOUR) * pivot)
        for i in range(J.BALL):
            if i != k:
                other = at + i * A.SIX
                factor = load(a, other + k * FOUR)
                for m in range(J.BALL):
                    if m != k:
                        entry = other + m * FOUR
                        store(a, entry, load(a, entry) - factor * load(a, row + m * FOUR))
                store(a, other + k * FOUR, -(factor * pivot))


@kernel
def invert_border(a, at, n, w):
    """Invert the ``n`` x ``n`` matrix at ``a[at:]`` in place with row pivoting; False if singular.

    ``w``: scratch for ``n`` pivot indices.
    """
    for k in range(n):
        pivot = k
        best = abs(a[at + k * n + k])
        for i in range(k + 1, n):
            size = abs(a[at + i * n + k])
            if size > best:
                best = size
                pivot = i
        if not (best > 0.0 and best < 1e300):
            return False
        w[k] = float(pivot)
        if pivot != k:
            for m in range(n):
                saved = a[at + k * n + m]
                a[at + k * n + m] = a[at + pivot * n + m]
                a[at + pivot * n + m] = saved
        inv = 1.0 / a[at + k * n + k]
        a[at + k * n + k] = 1.0
        for m in range(n):
            a[at + k * n + m] *= inv
        for i in range(n):
            if i != k:
                factor = a[at + i * n + k]
                a[at + i * n + k] = 0.0
                for m in range(n):
                    a[at + i * n + m] -= factor * a[at + k * n + m]
    for back in range(n):
        k = n - 1 - back
        pivot = int(w[k])
        if pivot != k:
            for i in range(n):
                saved = a[at + i * n + k]
                a[at + i * n + k] = a[at + i * n + pivot]
                a[at + i * n + pivot] = saved
    return True


@kernel
def entry(jac, place, rate, cv, cx):
    """Four balls' entry of the Newton matrix off its diagonal, from the derivatives by place and by rate."""
    return -cv * load(jac, rate) - cx * load(jac, place)


@kernel
def rows_by_ball(jac, first, cv, cx, fac, to):
    """Entries of one acceleration for a ball's own six into ``fac[to:]``; ``first``: its row of B or D."""
    for k in range(J.BALL):
        place = first + k * STRIDE
        # orbit and translations have places, the spins have none
        weight = cx if k < J.PLACED else 0.0
        store(fac, to + k * FOUR, entry(jac, place, place + J.PLACED * STRIDE, cv, weight))


@kernel
def factor_group(jac, j, cv, cx, cx_ball, fac, at):
    """Factors of the four balls from lane ``j`` on into their group at ``fac[at:]``."""
    for i in range(J.BALL):
        own = at + A.INVERSE + i * A.SIX
        rows_by_ball(jac, J.B + i * _ROW + j, cv, cx_ball, fac, own)
        store(fac, own + i * FOUR, load(fac, own + i * FOUR) + 1.0)
    invert_block(fac, at + A.INVERSE)
    for g in range(Q.SIZE):
        rows_by_ball(jac, J.D + g * _ROW + j, cv, cx_ball, fac, at + A.GB + g * A.SIX)
        place = J.C + g * STRIDE + j
        column = at + A.W + g * A.SIX
        for i in range(J.BALL):
            row = place + i * _BODIES
            store(fac, column + i * FOUR, entry(jac, row, row + Q.SIZE * STRIDE, cv, cx))
        store_six(fac, column, FOUR, times_six(fac, at + A.INVERSE, six(fac, column, FOUR)))


@kernel
def eliminated_row(fac, g, lanes, sums):
    """Row ``g`` for the balls times all columns of W, over all balls: four partial sums each."""
    for h in range(Q.SIZE):
        store(sums, h * FOUR, 0.0)
    for j in range(0, lanes, FOUR):
        at = in_groups(j, A.GROUP)
        row = six(fac, at + A.GB + g * A.SIX, FOUR)
        for h in range(Q.SIZE):
            column = six(fac, at + A.W + h * A.SIX, FOUR)
            store(sums, h * FOUR, load(sums, h * FOUR) + dot_six(row, column))


@kernel
def factor(p, jac, cv, cx, cx_ball, fac, w):
    """Factor I - cv Jv - cx Jx from the blocks ``jac`` into ``fac``; False if singular.

    ``cx_ball`` takes the place of ``cx`` in the columns of the balls' places.
    """
    lanes = int(p[P.LANES])
    for j in range(0, lanes, FOUR):
        factor_group(jac, j, cv, cx, cx_ball, fac, in_groups(j, A.GROUP))
    border = w[W.BORDER : W.BORDER + Q.SIZE * Q.SIZE]
    sums = w[W.BORDER_SUMS : W.BORDER_SUMS + Q.SIZE * FOUR]
    for g in range(Q.SIZE):
        eliminated_row(fac, g, lanes, sums)
        for h in range(Q.SIZE):
            place = J.E + g * J.BODIES + h
            total = 1.0 if g == h else 0.0
            total -= cv * jac[place + Q.SIZE] + cx * jac[place]
            border[g * Q.SIZE + h] = total - sum_four(load(sums, h * FOUR))
    pivots = w[W.PIVOTS : W.PIVOTS + MAX_BALLS]
    fine = invert_border(border, 0, Q.SIZE, pivots)
    for g in range(Q.SIZE):
        for h in range(Q.SIZE):
            fac[A.S + h * A.BORDER + g] = border[g * Q.SIZE + h]
    if fine and p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        spring_matrix(p, cv, cx_ball, fac, w)
        fine = invert_border(fac, A.SPRING_BALLS, int(p[P.BALLS]), pivots)
    return fine


@kernel
def turn_pair(x, i, c, s):
    """Turn the vector ``(x[i], x[i + 1])`` by the angle of cosine ``c`` and sine ``s``."""
    y = x[i]
    z = x[i + 1]
    x[i] = c * y - s * z
    x[i + 1] = s * y + c * z


@kernel
def turn_pairs(x, at, c, s):
    """Turn the y, z pairs of translations and tilts of the three bodies by the angle of (c, s)."""
    turn_pair(x, at + Q.INNER + Q.Y, c, s)
    turn_pair(x, at + Q.INNER + Q.INNER_BY, c, s)
    turn_pair(x, at + Q.OUTER + Q.Y, c, s)
    turn_pair(x, at + Q.OUTER + Q.BY, c, s)
    turn_pair(x, at + Q.CAGE + Q.Y, c, s)
    turn_pair(x, at + Q.CAGE + Q.BY, c, s)


@kernel
def times_six(fac, at, x):
    """Six by six entries at ``fac[at:]`` times six numbers of each of four balls."""
    step = A.SIX
    return (
        dot_six(six(fac, at, FOUR), x),
        dot_six(six(fac, at + step, FOUR), x),
        dot_six(six(fac, at + 2 * step, FOUR), x),
        dot_six(six(fac, at + 3 * step, FOUR), x),
        dot_six(six(fac, at + 4 * step, FOUR), x),
        dot_six(six(fac, at + 5 * step, FOUR), x),
    )


@kernel
def border_product(fac, w, d):
    """Bodies' part of ``d`` from their residual in ``w``: S^-1 has columns of ``BORDER`` numbers."""
    for i in range(0, A.BORDER, FOUR):
        total = splat(0.0)
        for h in range(Q.SIZE):
            total += load(fac, A.S + h * A.BORDER + i) * w[W.REST + h]
        store(w, W.BODIES + i, total)
    for g in range(Q.SIZE):
        d[F.BODY + g] = w[W.BODIES + g]


@kernel
def solve_balls(fac, lanes, d, w):
    """Put each ball's solution for its residual in ``d``, the bodies fixed, into the rows ``W.OWN``.

    What that puts on the bodies goes to ``W.BODY_SUMS``, in four partial sums each.
    """
    for g in range(Q.SIZE):
        store(w, W.BODY_SUMS + g * FOUR, 0.0)
    for j in range(0, lanes, FOUR):
        at = in_groups(j, A.GROUP)
        own = times_six(fac, at + A.INVERSE, six(d, j, STRIDE))
        store_six(w, W.OWN + j, STRIDE, own)
        for g in range(Q.SIZE):
            total = W.BODY_SUMS + g * FOUR
            store(w, total, load(w, total) + dot_six(six(fac, at + A.GB + g * A.SIX, FOUR), own))


@kernel
def back_substitute(fac, lanes, d, w):
    """Put the balls' increments into ``d``: their own solution less what the bodies' increments there do."""
    for j in range(0, lanes, FOUR):
        at = in_groups(j, A.GROUP)
        own = six(w, W.OWN + j, STRIDE)
        for g in range(Q.SIZE):
            own = plus_scaled(own, -d[F.BODY + g], six(fac, at + A.W + g * A.SIX, FOUR))
        store_six(d, j, STRIDE, own)


@kernel
def solve(p, fac, c, s, d, w):
    """Solve in place: ``d`` (layout of f) holds the residual, then the increment.

    ``c``, ``s``: cosine and sine of the orbit angle turned since the factors were made.
    """
    lanes = int(p[P.LANES])
    turn_pairs(d, F.BODY, c, -s)
    solve_balls(fac, lanes, d, w)
    for g in range(Q.SIZE):
        w[W.REST + g] = d[F.BODY + g] - sum_four(load(w, W.BODY_SUMS + g * FOUR))
    border_product(fac, w, d)
    if p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        couple_springs(p, fac, d, w)
    back_substitute(fac, lanes, d, w)
    turn_pairs(d, F.BODY, c, s)
