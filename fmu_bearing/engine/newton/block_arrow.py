"""The Newton system (I - cv Jv - cx Jx) d = r in accelerations: one 6 x 6 block per ball, a border of 17.

The balls are eliminated first; what remains for the bodies is inverted once per factorisation. Between
factorisations the bearing turns: the solve turns the bodies' y, z pairs back by the orbit angle passed
since, which keeps an old Jacobian exact for equal ball loads and an isotropic pedestal.
"""

from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import A, F, J, P, Q, W
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.newton.springs import couple_springs, spring_matrix


@kernel
def invert_blocks(a, at, lanes):
    """Invert the 6 x 6 blocks of all lanes in place (Gauss-Jordan; the blocks' diagonals dominate)."""
    for k in range(6):
        kk = at + (k * 6 + k) * STRIDE
        for j in range(lanes):
            a[kk + j] = 1.0 / a[kk + j]
        for m in range(6):
            if m != k:
                km = at + (k * 6 + m) * STRIDE
                for j in range(lanes):
                    a[km + j] *= a[kk + j]
        for i in range(6):
            if i != k:
                ik = at + (i * 6 + k) * STRIDE
                for m in range(6):
                    if m != k:
                        im = at + (i * 6 + m) * STRIDE
                        km = at + (k * 6 + m) * STRIDE
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
def border_column(jac, fac, w, scratch, g, cv, cx, cx_ball, lanes):
    """Column ``g`` of the border: W = Mb^-1 M_bG into ``fac``, and the row M_Gb beside it."""
    for i in range(6):
        newton_row(jac, J.C + (i * 34 + g) * STRIDE, Q.SIZE, cv, cx, w, scratch + i * STRIDE, lanes)
    for i in range(6):
        times_six(fac, A.INVERSE + i * 6 * STRIDE, w, scratch, fac, A.W + (i * Q.SIZE + g) * STRIDE, lanes)
    for k in range(6):
        out = A.GB + (g * 6 + k) * STRIDE
        newton_row(jac, J.D + (g * 9 + k) * STRIDE, 3, cv, cx_ball if k < 3 else 0.0, fac, out, lanes)


@kernel
def factor(p, jac, cv, cx, cx_ball, fac, w):
    """Factor I - cv Jv - cx Jx from the blocks ``jac`` into ``fac``; False if singular.

    ``cx_ball`` stands for ``cx`` in the columns of the balls' places.
    """
    lanes = int(p[P.LANES])
    scratch = W.FORCE
    for i in range(6):
        for k in range(6):
            out = A.INVERSE + (i * 6 + k) * STRIDE
            newton_row(jac, J.B + (i * 9 + k) * STRIDE, 3, cv, cx_ball if k < 3 else 0.0, fac, out, lanes)
        own = A.INVERSE + i * 7 * STRIDE
        for j in range(lanes):
            fac[own + j] += 1.0
    invert_blocks(fac, A.INVERSE, lanes)
    for g in range(Q.SIZE):
        border_column(jac, fac, w, scratch, g, cv, cx, cx_ball, lanes)
    border = w[scratch : scratch + Q.SIZE * Q.SIZE]
    for g in range(Q.SIZE):
        left = A.GB + g * 6 * STRIDE
        for h in range(Q.SIZE):
            total = 1.0 if g == h else 0.0
            total -= cv * jac[J.E + g * 34 + Q.SIZE + h] + cx * jac[J.E + g * 34 + h]
            first = 0.0
            second = 0.0
            third = 0.0
            fourth = 0.0
            for k in range(6):
                right = A.W + (k * Q.SIZE + h) * STRIDE
                row = left + k * STRIDE
                for quad in range(lanes // 4):
                    j = 4 * quad
                    first += fac[row + j] * fac[right + j]
                    second += fac[row + j + 1] * fac[right + j + 1]
                    third += fac[row + j + 2] * fac[right + j + 2]
                    fourth += fac[row + j + 3] * fac[right + j + 3]
            border[g * Q.SIZE + h] = total - ((first + second) + (third + fourth))
    fine = invert_border(border, 0, Q.SIZE, w[scratch + Q.SIZE * Q.SIZE :])
    for g in range(Q.SIZE):
        for h in range(Q.SIZE):
            fac[A.S + h * A.BORDER + g] = border[g * Q.SIZE + h]
    if fine and p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        balls = int(p[P.BALLS])
        spring_matrix(p, cv, cx_ball, fac, w)
        fine = invert_border(fac, A.SPRING_BALLS, balls, w[scratch : scratch + balls])
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
    turn_pair(x, at + 1, c, s)
    turn_pair(x, at + 3, c, s)
    turn_pair(x, at + 6, c, s)
    turn_pair(x, at + 9, c, s)
    turn_pair(x, at + 12, c, s)
    turn_pair(x, at + 15, c, s)


@inlined
def times_six(a, row, x, at, out, to, lanes):
    """``out[to + j] = sum over k of a[row + k] x[at + k]`` lane by lane, six products written out."""
    for j in range(lanes):
        out[to + j] = (
            (a[row + j] * x[at + j] + a[row + STRIDE + j] * x[at + STRIDE + j])
            + (
                a[row + 2 * STRIDE + j] * x[at + 2 * STRIDE + j]
                + a[row + 3 * STRIDE + j] * x[at + 3 * STRIDE + j]
            )
            + (
                a[row + 4 * STRIDE + j] * x[at + 4 * STRIDE + j]
                + a[row + 5 * STRIDE + j] * x[at + 5 * STRIDE + j]
            )
        )


@inlined
def less_seventeen(a, row, x, at, t, source, out, to, lanes):
    """``out[to + j] = t[source + j] - sum over g of a[row + g] x[at + g]`` lane by lane, written out."""
    for j in range(lanes):
        first = (
            (a[row + j] * x[at] + a[row + STRIDE + j] * x[at + 1])
            + (a[row + 2 * STRIDE + j] * x[at + 2] + a[row + 3 * STRIDE + j] * x[at + 3])
            + (a[row + 4 * STRIDE + j] * x[at + 4] + a[row + 5 * STRIDE + j] * x[at + 5])
        )
        second = (
            (a[row + 6 * STRIDE + j] * x[at + 6] + a[row + 7 * STRIDE + j] * x[at + 7])
            + (a[row + 8 * STRIDE + j] * x[at + 8] + a[row + 9 * STRIDE + j] * x[at + 9])
            + (a[row + 10 * STRIDE + j] * x[at + 10] + a[row + 11 * STRIDE + j] * x[at + 11])
        )
        third = (
            (a[row + 12 * STRIDE + j] * x[at + 12] + a[row + 13 * STRIDE + j] * x[at + 13])
            + (a[row + 14 * STRIDE + j] * x[at + 14] + a[row + 15 * STRIDE + j] * x[at + 15])
            + a[row + 16 * STRIDE + j] * x[at + 16]
        )
        out[to + j] = t[source + j] - ((first + second) + third)


@kernel
def border_product(fac, w, source, d):
    """``d[F_G:] = S^-1 w[source:]``; S^-1 stands by columns of ``BORDER`` numbers, the spare ones zero."""
    total = w[source + A.BORDER : source + 2 * A.BORDER]
    for i in range(A.BORDER):
        total[i] = 0.0
    for h in range(Q.SIZE):
        x = w[source + h]
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
    t = W.FORCE
    sums = t + 6 * STRIDE
    turn_pairs(d, F.BODY, c, -s)
    times_six(fac, A.INVERSE, d, 0, w, t, lanes)
    times_six(fac, A.INVERSE + 6 * STRIDE, d, 0, w, t + STRIDE, lanes)
    times_six(fac, A.INVERSE + 12 * STRIDE, d, 0, w, t + 2 * STRIDE, lanes)
    times_six(fac, A.INVERSE + 18 * STRIDE, d, 0, w, t + 3 * STRIDE, lanes)
    times_six(fac, A.INVERSE + 24 * STRIDE, d, 0, w, t + 4 * STRIDE, lanes)
    times_six(fac, A.INVERSE + 30 * STRIDE, d, 0, w, t + 5 * STRIDE, lanes)
    products = w[sums + 2 * A.BORDER : sums + 2 * A.BORDER + STRIDE]
    for g in range(Q.SIZE):
        times_six(fac[A.GB + g * 6 * STRIDE : A.S], 0, w, t, products, 0, lanes)
        first = 0.0
        second = 0.0
        third = 0.0
        fourth = 0.0
        for k in range(lanes // 4):
            first += products[4 * k]
            second += products[4 * k + 1]
            third += products[4 * k + 2]
            fourth += products[4 * k + 3]
        w[sums + g] = d[F.BODY + g] - ((first + second) + (third + fourth))
    border_product(fac, w, sums, d)
    if p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        couple_springs(p, fac, d, w)
    less_seventeen(fac, A.W, d, F.BODY, w, t, d, 0, lanes)
    less_seventeen(fac, A.W + 17 * STRIDE, d, F.BODY, w, t + STRIDE, d, STRIDE, lanes)
    less_seventeen(fac, A.W + 34 * STRIDE, d, F.BODY, w, t + 2 * STRIDE, d, 2 * STRIDE, lanes)
    less_seventeen(fac, A.W + 51 * STRIDE, d, F.BODY, w, t + 3 * STRIDE, d, 3 * STRIDE, lanes)
    less_seventeen(fac, A.W + 68 * STRIDE, d, F.BODY, w, t + 4 * STRIDE, d, 4 * STRIDE, lanes)
    less_seventeen(fac, A.W + 85 * STRIDE, d, F.BODY, w, t + 5 * STRIDE, d, 5 * STRIDE, lanes)
    turn_pairs(d, F.BODY, c, s)
