"""What the rings' modes lack in mass and damping, found from the full model's linearisation.

The condensed balls roll along their tracks with the mean of both races and turn with their difference. In
fidelity `full` they also slip, and a ball whose contact angles vibrate lags behind the orbit and spin axis it
should have, the traction that drags it along takes energy, and the land's film takes the cage along. For each
mode of the rings this finds its complex frequency by the full equations, linearised about even balls, with
balls and cage eliminated at that frequency (``whirls``), forward and backward each its own, and gives the
rings what is missing. What both whirls lack equally are symmetric matrices of mass and damping. Half of what
they lack apart acts from each plane on the other with opposite signs: a velocity's force changes their
frequencies, as a gyroscope's does, and an acceleration's one whirl's damping at the other's expense. Such a
force of displacements would do the same to damping, but act on the rings' static place, too.

In a set the modes belong to the rings with their share of shaft and housing on them (``P.OWN_SHARE``): not
the set's own, but near enough for terms of a few per cent.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import eigenvectors, invert, solve_complex
from fmu_bearing.engine.fidelities.condensed.whirls import (
    condensed_whirl,
    family_size,
    full_whirl,
    gather_rings,
    planes,
    spread_family,
    spread_turned,
)
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import L, T

_SLOWEST = 300.0  # rad/s: slower motions feel the supports, not the balls
_STIFFEST = 1e14  # (rad/s)^2: faster ones are no modes of the rings
_DAMPED = 0.5  # damping ratio beyond which a motion is no mode
_ASIDE = 0.5  # of their mean frequency: both whirls of a mode are not further from it
# rad/s: both whirls of slower modes are damped equally. A force by the acceleration is right at the frequency
# that it is found for and grows with its square: a bearing that tilts with its shaft at 90 Hz, alone, does so
# at 2 kHz where another one holds it.
_APART_FROM = 2.0 * PI * 300.0
_HEAVIEST = 0.3  # of its mass, added to a mode or taken from it, at most
# Of its frequency, damping taken from a mode at most: friction across the track takes too much by little, and
# where contacts open there is nothing else to take it from.
_TAKEN = 0.02
# Of the more damped whirl's damping, what the other one keeps at least. One that grows by itself in `full`
# ends in motion that is beyond these equations, which would grow for ever.
_LEAST = 0.02
_ROUNDS = 40  # of the search for a mode; 2 to 25 are needed
_ROUGH = 1e-3  # of a frequency: where the search for each whirl begins
_CLOSE = 1e-6
_PASSES = 4  # of what is missing: each leaves a tenth of its error
_TURNS = 4  # of the iteration for a whirl's shapes
_LONGEST = 3.0  # entries of the matrix that takes modes back, between orthogonal modes 1


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
def diagonalise(w, block, n, rank, shape):
    """Eigenvalue of that rank of a block's symmetric part; its vector into ``w[shape:]``."""
    for a in range(n):
        for b in range(n):
            w[T.VALUES + a * n + b] = 0.5 * (w[block + a * n + b] + w[block + b * n + a])
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
def is_mode(sr, si):
    """Whether a complex frequency (1/s) is that of a mode of the rings."""
    return si > _SLOWEST and si * si < _STIFFEST and abs(sr) < _DAMPED * si


@kernel
def mean_whirl(p, lv, jac, family, sr, si, w):
    """Accelerations per displacement by the full equations, mean of both whirls, into ``T.MEAN_RE``, ``_IM``.

    At the complex frequency ``sr + i si`` (1/s). False where a ball's equations are singular.
    """
    n = family_size(family)
    for i in range(n * n):
        w[T.MEAN_RE + i] = 0.0
        w[T.MEAN_IM + i] = 0.0
    per = 1.0 / planes(family)
    for whirl in range(planes(family)):
        if not full_whirl(p, lv, jac, family, turn_of(family, whirl), sr, si, w):
            return False
        for i in range(n * n):
            w[T.MEAN_RE + i] -= per * w[T.WHIRL_RE + i]
            w[T.MEAN_IM + i] -= per * w[T.WHIRL_IM + i]
    for i in range(n):
        w[T.MEAN_RE + i * n + i] += sr * sr - si * si
        w[T.MEAN_IM + i * n + i] += 2.0 * sr * si
    return True


@kernel
def turn_of(family, whirl):
    """Turn of a family's first or second whirl: 1 forward, -1 backward, 0 along the axis."""
    return 0.0 if family == 0 else 1.0 - 2.0 * whirl


@kernel
def find_mode(p, lv, jac, family, rank, shape, w):
    """Complex frequency (1/s) of a mode of the full equations, its shape into ``w[shape:]``; 0, 0 if none.

    Rough, as the mean of both whirls. The shape is that of the real part at the frequency, and the frequency
    that of the shape (Rayleigh).
    """
    n = family_size(family)
    squared = diagonalise(w, T.STILL, n, rank, shape)
    if not (squared > _SLOWEST * _SLOWEST and squared < _STIFFEST):
        return 0.0, 0.0
    sr, si = 0.0, math.sqrt(squared)
    for _ in range(_ROUNDS):
        if not mean_whirl(p, lv, jac, family, sr, si, w):
            return 0.0, 0.0
        diagonalise(w, T.MEAN_RE, n, n - 1 - rank, shape)
        re, im = root(form(w, T.MEAN_RE, shape, n), form(w, T.MEAN_IM, shape, n))
        if not is_mode(re, im):
            return 0.0, 0.0
        far = abs(re - sr) + abs(im - si)
        sr, si = re, im
        if far < _ROUGH * im:
            return sr, si
    return 0.0, 0.0


@kernel
def begin_shapes(w, shape, n):
    """Begin a whirl's shapes, right and left, with a mode's."""
    for i in range(n):
        for at in (T.RIGHT, T.LEFT):
            w[at + i] = w[shape + i]
            w[at + T.FAMILY + i] = 0.0


@kernel
def nearer(n, turned, at, w):
    """One inverse iteration of a shape at ``w[at:]`` by ``T.WHIRL_RE``, ``T.WHIRL_IM``; False if singular.

    ``turned``: by the matrix with rows for columns, for the left shape.
    """
    width = n + 1
    re = w[T.ROWS_RE : T.ROWS_RE + n * width]
    im = w[T.ROWS_IM : T.ROWS_IM + n * width]
    for a in range(n):
        for b in range(n):
            place = b * n + a if turned else a * n + b
            re[a * width + b] = w[T.WHIRL_RE + place]
            im[a * width + b] = w[T.WHIRL_IM + place]
        re[a * width + n] = w[at + a]
        im[a * width + n] = w[at + T.FAMILY + a]
    if not solve_complex(re, im, n, width):
        return False
    size = 0.0
    for a in range(n):
        size += re[a * width + n] * re[a * width + n] + im[a * width + n] * im[a * width + n]
    per = 1.0 / math.sqrt(size + 1e-300)
    for a in range(n):
        w[at + a] = per * re[a * width + n]
        w[at + T.FAMILY + a] = per * im[a * width + n]
    return True


@kernel
def quotient(n, w):
    """Rayleigh's quotient of the matrix ``T.WHIRL_RE``, ``T.WHIRL_IM`` with both shapes, a complex number."""
    up_re = 0.0
    up_im = 0.0
    below_re = 0.0
    below_im = 0.0
    for a in range(n):
        yr, yi = w[T.LEFT + a], w[T.LEFT + T.FAMILY + a]
        xr, xi = w[T.RIGHT + a], w[T.RIGHT + T.FAMILY + a]
        below_re += yr * xr - yi * xi
        below_im += yr * xi + yi * xr
        for b in range(n):
            xr, xi = w[T.RIGHT + b], w[T.RIGHT + T.FAMILY + b]
            mr, mi = w[T.WHIRL_RE + a * n + b], w[T.WHIRL_IM + a * n + b]
            fr, fi = mr * xr - mi * xi, mr * xi + mi * xr
            up_re += yr * fr - yi * fi
            up_im += yr * fi + yi * fr
    per = 1.0 / (below_re * below_re + below_im * below_im + 1e-300)
    return (up_re * below_re + up_im * below_im) * per, (up_im * below_re - up_re * below_im) * per


@kernel
def follow_whirl(p, lv, jac, family, turn, shape, sr, si, w):
    """Complex frequency (1/s) of one whirl of a mode near ``sr + i si``; 0, 0 if there is none."""
    n = family_size(family)
    begin_shapes(w, shape, n)
    fr, fi = sr, si
    for _ in range(_ROUNDS):
        if not full_whirl(p, lv, jac, family, turn, fr, fi, w):
            return 0.0, 0.0
        if not (nearer(n, False, T.RIGHT, w) and nearer(n, True, T.LEFT, w)):
            return 0.0, 0.0
        qr, qi = quotient(n, w)
        re, im = root(fr * fr - fi * fi - qr, 2.0 * fr * fi - qi)
        if not (is_mode(re, im) and abs(im - si) < _ASIDE * si):
            return 0.0, 0.0
        far = abs(re - fr) + abs(im - fi)
        fr, fi = re, im
        if far < _CLOSE * im:
            return fr, fi
    return 0.0, 0.0


@kernel
def find_whirls(p, lv, jac, family, rank, w):
    """Find a mode's shape and both whirls' complex frequencies (1/s) in ``T.POLES``; whether there are any.

    With the damping that the rings are to have: at least a share of the more damped whirl's.
    """
    shape = T.SHAPES + rank * family_size(family)
    poles = T.POLES + rank * T.PAIR
    sr, si = find_mode(p, lv, jac, family, rank, shape, w)
    if si == 0.0:
        return False
    fastest = 0.0
    for whirl in range(planes(family)):
        fr, fi = follow_whirl(p, lv, jac, family, turn_of(family, whirl), shape, sr, si, w)
        if fi == 0.0:
            return False
        w[poles + 2 * whirl] = fr
        w[poles + 2 * whirl + 1] = fi
        fastest = min(fastest, fr)
    for whirl in range(planes(family)):
        w[poles + 2 * whirl] = min(w[poles + 2 * whirl], _LEAST * fastest)
    return True


@kernel
def seen_by(rank, n, w):
    """Return what a change of mode ``rank`` counts in a whirl with the shapes found, a complex number."""
    left_re = 0.0
    left_im = 0.0
    right_re = 0.0
    right_im = 0.0
    below_re = 0.0
    below_im = 0.0
    for a in range(n):
        yr, yi = w[T.LEFT + a], w[T.LEFT + T.FAMILY + a]
        xr, xi = w[T.RIGHT + a], w[T.RIGHT + T.FAMILY + a]
        back = w[T.BACK + a * n + rank]
        left_re += back * yr
        left_im += back * yi
        right_re += back * xr
        right_im += back * xi
        below_re += yr * xr - yi * xi
        below_im += yr * xi + yi * xr
    up_re, up_im = left_re * right_re - left_im * right_im, left_re * right_im + left_im * right_re
    per = 1.0 / (below_re * below_re + below_im * below_im + 1e-300)
    return (up_re * below_re + up_im * below_im) * per, (up_im * below_re - up_re * below_im) * per


@kernel
def lacking(p, lv, family, rank, whirl, w):
    """Mass and damping (1/s) that one whirl of a mode of the condensed rings lacks; 0, 0 where it is lost."""
    n = family_size(family)
    sr, si = w[T.POLES + rank * T.PAIR + 2 * whirl], w[T.POLES + rank * T.PAIR + 2 * whirl + 1]
    condensed_whirl(p, lv, family, turn_of(family, whirl), sr, si, w)
    begin_shapes(w, T.SHAPES + rank * n, n)
    for _ in range(_TURNS):
        if not (nearer(n, False, T.RIGHT, w) and nearer(n, True, T.LEFT, w)):
            break
    qr, qi = quotient(n, w)
    vr, vi = seen_by(rank, n, w)
    size = vr * vr + vi * vi
    if not (size > 0.25):
        return 0.0, 0.0
    re, im = (qr * vr + qi * vi) / size, (qi * vr - qr * vi) / size
    square_re, square_im = sr * sr - si * si, 2.0 * sr * si
    # s^2 m + s c = -(re + i im)
    below = square_re * si - square_im * sr
    return (im * sr - re * si) / below, (square_im * re - square_re * im) / below


@kernel
def mean_speed(family, rank, w):
    """Angular frequency (rad/s) of a mode: mean of both whirls."""
    total = 0.0
    for whirl in range(planes(family)):
        total += w[T.POLES + rank * T.PAIR + 2 * whirl + 1]
    return total / planes(family)


@kernel
def correct_mode(p, lv, family, rank, w):
    """Add to ``T.ADDED`` what both whirls of a mode still lack."""
    added = T.ADDED + rank
    size = mean_speed(family, rank, w)
    mass, damping = lacking(p, lv, family, rank, 0, w)
    if family == 1:
        other, weaker = lacking(p, lv, family, rank, 1, w)
        if size > _APART_FROM:
            w[added + T.MASS_TURNED] -= 0.5 * (damping - weaker) / size
            w[added + T.DAMPER_TURNED] += 0.5 * (mass - other) * size
        mass, damping = 0.5 * (mass + other), 0.5 * (damping + weaker)
    w[added] += mass
    w[added + T.FAMILY] = max(w[added + T.FAMILY] + damping, -_TAKEN * size)


@kernel
def within_bounds(family, rank, w):
    """Whether what is added to a mode is small against its mass."""
    added = T.ADDED + rank
    most = _HEAVIEST * form(w, T.HEAVY, T.SHAPES + rank * family_size(family), family_size(family))
    fine = abs(w[added]) <= most and abs(w[added + T.MASS_TURNED]) <= most
    return fine and abs(w[added + T.DAMPER_TURNED]) <= most * mean_speed(family, rank, w)


@kernel
def modal_matrix(part, n, w):
    """Put the matrix of one part of ``T.ADDED`` to ``T.VALUES``."""
    for a in range(n):
        for b in range(n):
            total = 0.0
            for k in range(n):
                total += w[T.BACK + a * n + k] * w[T.ADDED + part + k] * w[T.BACK + b * n + k]
            w[T.VALUES + a * n + b] = total


@kernel
def show_added(p, lv, family, w):
    """Gather the rings' matrices again, and add what the modes are given so far."""
    n = family_size(family)
    gather_rings(p, lv, family, w)
    for part in range(T.PARTS):
        into = T.HEAVY if part & 1 == 0 else T.DAMPER
        modal_matrix(part * T.FAMILY, n, w)
        for i in range(n * n):
            w[into + (T.BLOCK if part > 1 else 0) + i] += w[T.VALUES + i]


@kernel
def take_back(n, w):
    """Put the matrix that takes modes back to ``T.BACK``; False where shapes are too similar."""
    for i in range(n * n):
        w[T.VECTORS + i] = w[T.SHAPES + i]
    # rows of shapes: the inverse has in column k what takes out mode k
    if not invert(w, T.VECTORS, n, w, T.BACK):
        return False
    for i in range(n * n):
        if not (abs(w[T.BACK + i]) < _LONGEST):
            return False
    return True


@kernel
def correct_family(p, lv, jac, family, w):
    """Add what the modes of a family lack to ``L.MASS`` and ``L.EXTRA``."""
    n = family_size(family)
    gather_rings(p, lv, family, w)
    for i in range(T.PARTS * T.FAMILY):
        w[T.ADDED + i] = 0.0
    for k in range(n):
        w[T.FOUND + k] = 1.0 if find_whirls(p, lv, jac, family, k, w) else 0.0
    if not take_back(n, w):
        return
    for _ in range(_PASSES):
        show_added(p, lv, family, w)
        for k in range(n):
            if w[T.FOUND + k] != 0.0:
                correct_mode(p, lv, family, k, w)
    gather_rings(p, lv, family, w)
    for k in range(n):
        if not within_bounds(family, k, w):
            for part in range(T.PARTS):
                w[T.ADDED + part * T.FAMILY + k] = 0.0
    modal_matrix(0, n, w)
    spread_family(p, family, T.VALUES, 1.0, lv, L.MASS, w)
    modal_matrix(T.FAMILY, n, w)
    spread_family(p, family, T.VALUES, -1.0, lv, L.EXTRA, w)
    if family == 1:
        modal_matrix(T.MASS_TURNED, n, w)
        spread_turned(p, T.VALUES, 1.0, lv, L.MASS, w)
        modal_matrix(T.DAMPER_TURNED, n, w)
        spread_turned(p, T.VALUES, -1.0, lv, L.EXTRA, w)


@kernel
def correct_modes(p, lv, jac, w):
    """Add to ``L.MASS`` and ``L.EXTRA`` what the full Jacobian ``jac`` gives; ``L.JV`` is without it."""
    correct_family(p, lv, jac, 0, w)
    correct_family(p, lv, jac, 1, w)
