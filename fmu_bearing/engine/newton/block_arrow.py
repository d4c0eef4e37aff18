"""The Newton system (I - cv Jv - cx Jx) d = r in accelerations: one 6 x 6 block per ball, a border of 17.

The balls are eliminated first; what remains for the bodies is inverted once per factorisation. Between
factorisations the bearing turns: the solve turns the bodies' y, z pairs back by the orbit angle passed
since, which keeps an old Jacobian exact for equal ball loads and an isotropic pedestal.
"""

from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.lanes import sum_lanes
from fmu_bearing.engine.layout import FOUR, MAX_BALLS, STRIDE, A, F, J, P, Q, W
from fmu_bearing.engine.newton.springs import couple_springs, spring_matrix

_PAIR = 2 * STRIDE  # from one pair of entries to the next
_OWN = J.BALL * STRIDE  # a row of a ball's own inverse
_BODIES = Q.SIZE * STRIDE  # a row of that times the ball's rows for the bodies


@kernel
def invert_blocks(a, at, lanes):
    """Invert the 6 x 6 blocks of all lanes in place (Gauss-Jordan; the blocks' diagonals dominate)."""
    for k in range(J.BALL):
        kk = at + (k * J.BALL + k) * STRIDE
        for j in range(lanes):
            a[kk + j] = 1.0 / a[kk + j]
        for m in range(J.BALL):
            if m != k:
                km = at + (k * J.BALL + m) * STRIDE
                for j in range(lanes):
                    a[km + j] *= a[kk + j]
        for i in range(J.BALL):
            if i != k:
                ik = at + (i * J.BALL + k) * STRIDE
                for m in range(J.BALL):
                    if m != k:
                        im = at + (i * J.BALL + m) * STRIDE
                        km = at + (k * J.BALL + m) * STRIDE
                        for j in range(lanes):
                            a[im + j] -= a[ik + j] * a[km + j]
                for j in range(lanes):
                    a[ik + j] *= -a[kk + j]


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
                kept = a[at + k * n + m]
                a[at + k * n + m] = a[at + pivot * n + m]
                a[at + pivot * n + m] = kept
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
                kept = a[at + i * n + k]
                a[at + i * n + k] = a[at + i * n + pivot]
                a[at + i * n + pivot] = kept
    return True


@inlined
def newton_row(jac, at, columns, cv, cx, out, to, lanes):
    """``out[to] = -cv jac[at + columns] - cx jac[at]``: minus rate and place derivative of one entry."""
    for j in range(lanes):
        out[to + j] = -cv * jac[at + columns * STRIDE + j] - cx * jac[at + j]


@kernel
def border_column(jac, fac, w, g, cv, cx, cx_ball, lanes):
    """Column ``g`` of the border: W = Mb^-1 M_bG into ``fac``, and the row M_Gb beside it."""
    for i in range(J.BALL):
        newton_row(jac, J.C + (i * J.BODIES + g) * STRIDE, Q.SIZE, cv, cx, w, W.COLUMN + i * STRIDE, lanes)
    for i in range(J.BALL):
        times_six(fac, A.INVERSE + i * _OWN, w, W.COLUMN, fac, A.W + (i * Q.SIZE + g) * STRIDE, lanes)
    for k in range(J.BALL):
        entry = J.D + (g * J.STATES + k) * STRIDE
        out = A.GB + (g * J.BALL + k) * STRIDE
        newton_row(jac, entry, J.PLACED, cv, cx_ball if k < J.PLACED else 0.0, fac, out, lanes)


@inlined
def through_balls(fac, g, h, lanes):
    """Row ``g`` for the balls times column ``h`` of W, over all balls: four partial sums of fixed order."""
    a = 0.0
    b = 0.0
    c = 0.0
    d = 0.0
    for k in range(J.BALL):
        row = A.GB + (g * J.BALL + k) * STRIDE
        right = A.W + (k * Q.SIZE + h) * STRIDE
        for quad in range(lanes // FOUR):
            i = FOUR * quad
            j = i + 2
            a += fac[row + i] * fac[right + i]
            b += fac[row + i + 1] * fac[right + i + 1]
            c += fac[row + j] * fac[right + j]
            d += fac[row + j + 1] * fac[right + j + 1]
    return (a + b) + (c + d)


@kernel
def factor(p, jac, cv, cx, cx_ball, fac, w):
    """Factor I - cv Jv - cx Jx from the blocks ``jac`` into ``fac``; False if singular.

    ``cx_ball`` stands for ``cx`` in the columns of the balls' places.
    """
    lanes = int(p[P.LANES])
    for i in range(J.BALL):
        for k in range(J.BALL):
            entry = J.B + (i * J.STATES + k) * STRIDE
            out = A.INVERSE + (i * J.BALL + k) * STRIDE
            newton_row(jac, entry, J.PLACED, cv, cx_ball if k < J.PLACED else 0.0, fac, out, lanes)
        own = A.INVERSE + i * (J.BALL + 1) * STRIDE
        for j in range(lanes):
            fac[own + j] += 1.0
    invert_blocks(fac, A.INVERSE, lanes)
    for g in range(Q.SIZE):
        border_column(jac, fac, w, g, cv, cx, cx_ball, lanes)
    border = w[W.BORDER : W.BORDER + Q.SIZE * Q.SIZE]
    for g in range(Q.SIZE):
        for h in range(Q.SIZE):
            entry = J.E + g * J.BODIES + h
            total = 1.0 if g == h else 0.0
            total -= cv * jac[entry + Q.SIZE] + cx * jac[entry]
            border[g * Q.SIZE + h] = total - through_balls(fac, g, h, lanes)
    pivots = w[W.PIVOTS : W.PIVOTS + MAX_BALLS]
    fine = invert_border(border, 0, Q.SIZE, pivots)
    for g in range(Q.SIZE):
        for h in range(Q.SIZE):
            fac[A.S + h * A.BORDER + g] = border[g * Q.SIZE + h]
    if fine and p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        spring_matrix(p, cv, cx_ball, fac, w)
        fine = invert_border(fac, A.SPRING_BALLS, int(p[P.BALLS]), pivots)
    return fine


@inlined
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


@inlined
def pair(a, row, x, at, step):
    """Products of two entries of ``a``, at ``row`` and in the next row, with two numbers of ``x``."""
    return a[row] * x[at] + a[row + STRIDE] * x[at + step]


@inlined
def six(a, row, x, at, step):
    """Sum of six products as three pairs: entries of ``a`` in rows, numbers of ``x`` ``step`` apart."""
    return (
        pair(a, row, x, at, step)
        + pair(a, row + _PAIR, x, at + 2 * step, step)
        + pair(a, row + 2 * _PAIR, x, at + 2 * 2 * step, step)
    )


@inlined
def times_six(a, row, x, at, out, to, lanes):
    """``out[to + j] = sum over k of a[row + k] x[at + k]`` lane by lane, ``k`` counting rows."""
    for j in range(lanes):
        out[to + j] = six(a, row + j, x, at + j, STRIDE)


@inlined
def less_seventeen(a, row, x, at, t, source, out, to, lanes):
    """``out[to + j] = t[source + j] - sum over g of a[row + g] x[at + g]``: two sixes and the other five.

    ``g`` counts rows of ``a`` and numbers of ``x``.
    """
    second = row + J.BALL * STRIDE
    third = second + J.BALL * STRIDE
    last = third + 2 * _PAIR
    x_second = at + J.BALL
    x_third = x_second + J.BALL
    for j in range(lanes):
        total = six(a, row + j, x, at, 1) + six(a, second + j, x, x_second, 1)
        others = pair(a, third + j, x, x_third, 1) + pair(a, third + _PAIR + j, x, x_third + 2, 1)
        out[to + j] = t[source + j] - (total + (others + a[last + j] * x[x_third + 2 * 2]))


@kernel
def border_product(fac, w, d):
    """Bodies' part of ``d`` from their residual in ``w``: S^-1 stands by columns of ``BORDER`` numbers."""
    total = w[W.BODIES : W.BODIES + A.BORDER]
    for i in range(A.BORDER):
        total[i] = 0.0
    for h in range(Q.SIZE):
        x = w[W.REST + h]
        column = fac[A.S + h * A.BORDER : A.SIZE]
        for i in range(A.BORDER):
            total[i] += column[i] * x
    for g in range(Q.SIZE):
        d[F.BODY + g] = total[g]


@kernel
def solve(p, fac, c, s, d, w):
    """Solve in place: ``d`` (layout of f) holds the residual, then the increment.

    ``c``, ``s``: cosine and sine of the orbit angle turned since the factors were made.
    """
    lanes = int(p[P.LANES])
    turn_pairs(d, F.BODY, c, -s)
    for i in range(J.BALL):
        times_six(fac, A.INVERSE + i * _OWN, d, 0, w, W.OWN + i * STRIDE, lanes)
    products = w[W.LANE_SUMS : W.LANE_SUMS + STRIDE]
    for g in range(Q.SIZE):
        times_six(fac[A.GB + g * _OWN : A.S], 0, w, W.OWN, products, 0, lanes)
        w[W.REST + g] = d[F.BODY + g] - sum_lanes(products, 0, lanes)
    border_product(fac, w, d)
    if p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        couple_springs(p, fac, d, w)
    for i in range(J.BALL):
        less_seventeen(fac, A.W + i * _BODIES, d, F.BODY, w, W.OWN + i * STRIDE, d, i * STRIDE, lanes)
    turn_pairs(d, F.BODY, c, s)
