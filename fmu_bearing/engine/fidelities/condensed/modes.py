"""What the rings' modes lack in mass and damping, found from the full model's linearisation.

The condensed balls roll along their tracks with the mean of both races and turn with their difference. In
fidelity `full` they also slip, and a ball whose contact angles vibrate lags behind the orbit and spin axis it
should have, and the traction that drags it along takes energy. For each mode of the rings this reads
frequency and damping off the full equations, linearised about even balls, with the balls
eliminated at the mode's own complex frequency, and gives the rings what is missing as symmetric matrices. The
pockets' and lands' part is left out. In a set the modes are those of the rings with their share of shaft and
housing on them (``P.OWN_SHARE``): not the set's own, but near enough for terms of a few per cent.

Balls carry equal loads at that point, so the rings' coordinates fall into families: both rings along the
axis, and both rings aside and tilting, in two planes alike. One ball serves for all. Matrices of a family are
scaled so that the rings' masses are 1.
"""

import math

from fmu_bearing.engine.dense import eigenvectors, invert, solve_complex
from fmu_bearing.engine.fidelities.condensed.transverse import pattern_weight
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, J, L, P, Q, T
from fmu_bearing.engine.newton.body_slopes import inertia

_SLOWEST = 300.0  # rad/s: slower motions feel the supports, not the balls
_STIFFEST = 1e14  # (rad/s)^2: faster ones are no modes of the rings
_DAMPED = 0.5  # damping ratio beyond which a motion is no mode
_HEAVIEST = 0.3  # of its mass, added to a mode or taken from it, at most
# Of its frequency, damping taken from a mode at most: friction across the track takes too much by little, and
# where contacts open there is nothing else to take it from.
_TAKEN = 0.02
_ROUNDS = 40  # of the search for a mode; 2 to 25 are needed
_CLOSE = 1e-5
_LONGEST = 3.0  # entries of the matrix that takes modes back, between orthogonal modes 1


@kernel
def family_size(family):
    """Return the number of coordinates of a family: 0 along the axis, 1 aside and tilting."""
    return 2 if family == 0 else T.FAMILY


@kernel
def member(family, plane, k):
    """Coordinate ``k`` of a family: inner before outer ring, translation before tilt.

    ``plane``: 0 moves along z and tilts about y, 1 moves along y and tilts about z.
    """
    if family == 0:
        return k * Q.OUTER
    inner = k < 2
    base = Q.INNER if inner else Q.OUTER
    if k & 1 == 0:
        return base + Q.Z - plane
    return base + (Q.INNER_BY if inner else Q.BY) + plane


@kernel
def side(plane, k):
    """Sign of coordinate ``k`` in the second plane, where tilts turn the other way."""
    return -1.0 if plane == 1 and k & 1 == 1 else 1.0


@kernel
def planes(family):
    """Return the number of planes that a family moves in."""
    return 1 if family == 0 else 2


@kernel
def scale(p, i, k):
    """Return what takes a derivative of acceleration ``i`` by coordinate ``k`` to masses of 1."""
    return math.sqrt(inertia(p, i) / inertia(p, k)) * math.sqrt(p[P.OWN_SHARE + i] * p[P.OWN_SHARE + k])


@kernel
def gather_family(p, lv, at, family, into, w):
    """Block of a family of the matrix ``lv[at:]`` (by columns): mean of planes, scaled and symmetric."""
    n = family_size(family)
    for a in range(n):
        for b in range(n):
            total = 0.0
            for plane in range(planes(family)):
                sign = side(plane, a) * side(plane, b)
                i, k = member(family, plane, a), member(family, plane, b)
                total += sign * scale(p, i, k) * lv[at + i + L.COLUMN * k]
                total += sign * scale(p, k, i) * lv[at + k + L.COLUMN * i]
            w[into + a * n + b] = 0.5 * total / planes(family)


@kernel
def spread_family(p, family, block, factor, lv, at, w):
    """Add ``factor`` times a family's block to the matrix ``lv[at:]``, in both planes."""
    n = family_size(family)
    for plane in range(planes(family)):
        for a in range(n):
            for b in range(n):
                i, k = member(family, plane, a), member(family, plane, b)
                value = side(plane, a) * side(plane, b) * w[block + a * n + b]
                lv[at + i + L.COLUMN * k] += factor * value / scale(p, i, k)


@kernel
def row_of_ball(family):
    """Numbers per equation of a ball: coefficients, then a right side per coordinate and plane."""
    return J.BALL + planes(family) * family_size(family)


@kernel
def ball_answers(p, jac, family, sr, si, w):
    """Solve for the rates of ball 0 per displacement of a family at the complex frequency ``sr + i si``.

    In 1/s. They stand behind the coefficients in ``T.BALL_RE``, ``T.BALL_IM``: first plane, then second.
    """
    n = family_size(family)
    width = row_of_ball(family)
    re = w[T.BALL_RE : T.BALL_RE + J.BALL * T.BALL_ROW]
    im = w[T.BALL_IM : T.BALL_IM + J.BALL * T.BALL_ROW]
    per = 1.0 / (sr * sr + si * si)
    for i in range(J.BALL):
        for k in range(J.BALL):
            row = J.B + i * J.STATES * STRIDE
            by_place = jac[row + k * STRIDE] if k < J.PLACED else 0.0
            own = 1.0 if i == k else 0.0
            by_rate = jac[row + (J.PLACED + k) * STRIDE]
            re[i * width + k] = sr * (own - by_place * per) - by_rate
            im[i * width + k] = si * (own + by_place * per)
        for plane in range(planes(family)):
            for b in range(n):
                at = J.C + (i * J.BODIES + member(family, plane, b)) * STRIDE
                moving = jac[at + Q.SIZE * STRIDE]
                column = i * width + J.BALL + plane * n + b
                re[column] = jac[at] + sr * moving
                im[column] = si * moving
    return solve_complex(re, im, J.BALL, width)


@kernel
def full_answers(p, jac, family, sr, si, w):
    """Accelerations of a family per displacement by the full equations into ``T.FULL_RE``, ``T.FULL_IM``.

    At the complex frequency ``sr + i si`` (1/s); scaled and symmetric. False where a ball's equations are
    singular.
    """
    n = family_size(family)
    if not ball_answers(p, jac, family, sr, si, w):
        return False
    for i in range(n * n):
        w[T.FULL_RE + i] = 0.0
        w[T.FULL_IM + i] = 0.0
    width = row_of_ball(family)
    size = sr * sr + si * si
    # a sum over the balls in one plane is their number by half the sum over both planes of one ball
    for plane in range(planes(family)):
        for a in range(n):
            i = member(family, plane, a)
            for b in range(n):
                k = member(family, plane, b)
                at = J.E + i * J.BODIES + k
                re = (jac[at] + sr * jac[at + Q.SIZE]) / p[P.BALLS]
                im = si * jac[at + Q.SIZE] / p[P.BALLS]
                for m in range(J.BALL):
                    row = J.D + i * J.STATES * STRIDE
                    by_rate = jac[row + (J.PLACED + m) * STRIDE]
                    by_place = jac[row + m * STRIDE] / size if m < J.PLACED else 0.0
                    # a ball's place is its rate over s
                    fr = by_rate + sr * by_place
                    fi = -si * by_place
                    answer = m * width + J.BALL + plane * n + b
                    xr, xi = w[T.BALL_RE + answer], w[T.BALL_IM + answer]
                    re += fr * xr - fi * xi
                    im += fr * xi + fi * xr
                share = side(plane, a) * side(plane, b) * scale(p, i, k) * p[P.BALLS] / planes(family)
                w[T.FULL_RE + a * n + b] += 0.5 * share * re
                w[T.FULL_IM + a * n + b] += 0.5 * share * im
                w[T.FULL_RE + b * n + a] += 0.5 * share * re
                w[T.FULL_IM + b * n + a] += 0.5 * share * im
    return True


@kernel
def ranked(w, n, rank):
    """Column of the ``rank``-th smallest of the ``n`` eigenvalues in ``T.VALUES``."""
    for k in range(n):
        smaller = 0
        for m in range(n):
            mine, other = w[T.VALUES + k * n + k], w[T.VALUES + m * n + m]
            if other < mine or (other == mine and m < k):
                smaller += 1
        if smaller == rank:
            return k
    return 0


@kernel
def diagonalise(w, block, sign, n, rank, shape):
    """Eigenvalue of that rank of ``sign`` times a block; its vector into ``w[shape:]``."""
    for i in range(n * n):
        w[T.VALUES + i] = sign * w[block + i]
    eigenvectors(w, T.VALUES, w, T.VECTORS, n)
    column = ranked(w, n, rank)
    for i in range(n):
        w[shape + i] = w[T.VECTORS + i * n + column]
    return w[T.VALUES + column * n + column]


@kernel
def form(w, block, shape, n):
    """Quadratic form of a block: ``shape block shape``."""
    total = 0.0
    for a in range(n):
        for b in range(n):
            total += w[shape + a] * w[block + a * n + b] * w[shape + b]
    return total


@kernel
def root(re, im):
    """Square root of a complex number with a positive imaginary part."""
    size = math.sqrt(re * re + im * im)
    imaginary = math.sqrt(max(0.5 * (size - re), 0.0))
    return (0.5 * im / imaginary if imaginary > 0.0 else 0.0), imaginary


@kernel
def find_mode(p, jac, family, rank, shape, w):
    """Complex frequency (1/s) of a mode of the full equations, its shape into ``w[shape:]``; 0, 0 if none.

    The shape is that of the real part at the frequency, and the frequency that of the shape (Rayleigh).
    """
    n = family_size(family)
    squared = diagonalise(w, T.STILL, 1.0, n, rank, shape)
    if not (squared > _SLOWEST * _SLOWEST and squared < _STIFFEST):
        return 0.0, 0.0
    sr, si = 0.0, math.sqrt(squared)
    for _ in range(_ROUNDS):
        if not full_answers(p, jac, family, sr, si, w):
            return 0.0, 0.0
        diagonalise(w, T.FULL_RE, -1.0, n, rank, shape)
        re, im = root(form(w, T.FULL_RE, shape, n), form(w, T.FULL_IM, shape, n))
        size = abs(im)
        if not (size > _SLOWEST and size * size < _STIFFEST and abs(re) < _DAMPED * size):
            return 0.0, 0.0
        far = abs(re - sr) + abs(im - si)
        sr, si = re, im
        if far < _CLOSE * size:
            return sr, si
    return 0.0, 0.0


@kernel
def across_answer(p, lv, family, shape, sr, si, w):
    """Force per displacement (1/s2) that the transverse balls add to a shape: real and imaginary part."""
    n = family_size(family)
    follows = 0.0
    leads = 0.0
    guides = 0.0
    for a in range(n):
        follows += w[shape + a] * w[T.FOLLOWS + a]
        leads += w[shape + a] * w[T.LEADS + a]
        guides += w[shape + a] * w[T.GUIDES + a]
    square, rate = lv[L.SIDE_SQUARE], lv[L.SIDE_RATE]
    # contact damping leads the balls' places of rest
    ahead_re, ahead_im = follows + leads * sr, leads * si
    drive_re = square * ahead_re + rate * sr * guides
    drive_im = square * ahead_im + rate * si * guides
    below_re = sr * sr - si * si + rate * sr + square
    below_im = (2.0 * sr + rate) * si
    per = 1.0 / (below_re * below_re + below_im * below_im + 1e-300)
    place_re = (drive_re * below_re + drive_im * below_im) * per
    place_im = (drive_im * below_re - drive_re * below_im) * per
    off_re, off_im = place_re - guides, place_im
    re = square * follows * (ahead_re - place_re) - rate * guides * (sr * off_re - si * off_im)
    im = square * follows * (ahead_im - place_im) - rate * guides * (sr * off_im + si * off_re)
    weight = p[P.BALL_MASS] * pattern_weight(p, family)
    return weight * re, weight * im


@kernel
def lacking(p, lv, family, shape, sr, si, w):
    """Mass and damping (1/s) that a mode of the condensed rings lacks for the complex frequency given."""
    n = family_size(family)
    mass = form(w, T.HEAVY, shape, n)
    damping = form(w, T.DAMPER, shape, n)
    re, im = across_answer(p, lv, family, shape, sr, si, w)
    square_re, square_im = sr * sr - si * si, 2.0 * sr * si
    re += form(w, T.STILL, shape, n) + sr * damping + square_re * mass
    im += si * damping + square_im * mass
    # s^2 m + s c = -(re + i im)
    below = square_re * si - square_im * sr
    more = (im * sr - re * si) / below
    damper = (square_im * re - square_re * im) / below
    if not (abs(more) < _HEAVIEST * mass):
        return 0.0, 0.0
    return more, max(damper, -_TAKEN * si)


@kernel
def correct_family(p, lv, jac, family, w):
    """Add what the modes of a family lack to ``L.MASS`` and ``L.EXTRA``."""
    n = family_size(family)
    gather_family(p, lv, L.JX, family, T.STILL, w)
    gather_family(p, lv, L.JV, family, T.DAMPER, w)
    gather_family(p, lv, L.MASS, family, T.HEAVY, w)
    for i in range(n * n):
        w[T.STILL + i] *= -1.0
        w[T.DAMPER + i] *= -1.0
    row = family * L.COLUMN
    for a in range(n):
        i = member(family, 0, a)
        per = math.sqrt(p[P.OWN_SHARE + i]) / math.sqrt(inertia(p, i))
        # what the ring carries
        w[T.HEAVY + a * n + a] += 1.0 - p[P.OWN_SHARE + i]
        w[T.FOLLOWS + a] = per * lv[L.SIDE_FOLLOW + row + i]
        w[T.LEADS + a] = per * lv[L.SIDE_LEAD + row + i]
        w[T.GUIDES + a] = per * lv[L.SIDE_GUIDE + row + i]
    for k in range(n):
        shape = T.SHAPES + k * n
        w[T.ADDED + k] = 0.0
        w[T.ADDED + T.FAMILY + k] = 0.0
        sr, si = find_mode(p, jac, family, k, shape, w)
        if si > 0.0:
            mass, damping = lacking(p, lv, family, shape, sr, si, w)
            w[T.ADDED + k] = mass
            w[T.ADDED + T.FAMILY + k] = damping
    spread_modes(p, lv, family, w)


@kernel
def spread_modes(p, lv, family, w):
    """Make symmetric matrices of what the modes in ``T.SHAPES`` lack, and add them to the rings'."""
    n = family_size(family)
    for i in range(n * n):
        w[T.VECTORS + i] = w[T.SHAPES + i]
    # rows of shapes: the inverse has in column k what takes out mode k
    if not invert(w, T.VECTORS, n, w, T.BACK):
        return
    for i in range(n * n):
        if not (abs(w[T.BACK + i]) < _LONGEST):
            return
    for part in range(2):
        for a in range(n):
            for b in range(n):
                total = 0.0
                for k in range(n):
                    added = w[T.ADDED + part * T.FAMILY + k]
                    total += w[T.BACK + a * n + k] * added * w[T.BACK + b * n + k]
                w[T.VALUES + a * n + b] = total
        if part == 0:
            spread_family(p, family, T.VALUES, 1.0, lv, L.MASS, w)
        else:
            spread_family(p, family, T.VALUES, -1.0, lv, L.EXTRA, w)


@kernel
def correct_modes(p, lv, jac, w):
    """Add to ``L.MASS`` and ``L.EXTRA`` what the full Jacobian ``jac`` tells; ``L.JV`` is without it."""
    correct_family(p, lv, jac, 0, w)
    correct_family(p, lv, jac, 1, w)
