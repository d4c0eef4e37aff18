"""The rings' equations at a complex frequency, by the full equations and by the condensed ones.

Balls carry equal loads at the held point, so the rings' coordinates fall into families: both rings along the
axis, and both rings aside and tilting, in two equal planes. Motions of two equal planes are whirls, forward
and backward, the second plane a quarter turn before or behind the first: a whirl's equations are as many as a
plane's, with complex coefficients. One ball serves for all. It orbits, so a whirl of s is one of s - i times
its orbit speed to it.

The cage answers too, which is eliminated with the balls: the film of its lands turns with the inner ring at
half the speed and takes the cage along at low frequency. Matrices of a family are scaled so that the masses
of rings and cage are 1.
"""

import math

from fmu_bearing.engine.dense import solve_complex
from fmu_bearing.engine.fidelities.condensed.transverse import pattern_weight
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, J, L, P, Q, T, Y
from fmu_bearing.engine.newton.body_slopes import inertia


@kernel
def family_size(family):
    """Return the number of coordinates of a family: 0 along the axis, 1 aside and tilting."""
    return 2 if family == 0 else T.FAMILY


@kernel
def whole_size(p, family):
    """Return the number of its coordinates with the cage's, if there is one."""
    return family_size(family) + (T.CAGED if p[P.CAGE] != 0.0 else 0)


@kernel
def member(family, plane, k):
    """Coordinate ``k`` of a family: inner ring, outer ring, cage; of each translation before tilt.

    ``plane``: 0 moves along z and tilts about y, 1 moves along y and tilts about z. Along the axis the rings
    have one coordinate each; the cage also turns.
    """
    if family == 0:
        if k < 2:
            return k * Q.OUTER
        return Q.CAGE + (Q.X if k == 2 else Q.TURN)
    inner = k < 2
    base = Q.INNER if inner else (Q.OUTER if k < T.FAMILY else Q.CAGE)
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
def own_share(p, i):
    """Inertia of a coordinate over that with what it carries in a set."""
    return p[P.OWN_SHARE + i] if i < Q.RINGS else 1.0


@kernel
def scale(p, i, k):
    """Return what takes a derivative of acceleration ``i`` by coordinate ``k`` to masses of 1."""
    return math.sqrt(inertia(p, i) / inertia(p, k)) * math.sqrt(own_share(p, i) * own_share(p, k))


@kernel
def gather_family(p, lv, at, family, sign, into, w):
    """Block of a family of ``sign`` times the matrix ``lv[at:]`` (by columns), scaled: mean of planes.

    Behind it, at ``into + T.BLOCK``, what the other plane does a quarter turn before: a whirl's coefficient
    is the first plus i times its turn times the second.
    """
    n = family_size(family)
    per = sign / planes(family)
    for a in range(n):
        for b in range(n):
            along = 0.0
            for plane in range(planes(family)):
                i, k = member(family, plane, a), member(family, plane, b)
                along += side(plane, a) * side(plane, b) * scale(p, i, k) * lv[at + i + L.COLUMN * k]
            across = 0.0
            if family == 1:
                i, k = member(1, 0, a), member(1, 1, b)
                across += side(1, b) * scale(p, i, k) * lv[at + i + L.COLUMN * k]
                i, k = member(1, 1, a), member(1, 0, b)
                across -= side(1, a) * scale(p, i, k) * lv[at + i + L.COLUMN * k]
            w[into + a * n + b] = per * along
            w[into + T.BLOCK + a * n + b] = per * across


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
def spread_turned(p, block, factor, lv, at, w):
    """Add ``factor`` times a block that acts from each plane on the other to the matrix ``lv[at:]``.

    With opposite signs, so that both whirls feel it as i times their turn times the block.
    """
    n = T.FAMILY
    for a in range(n):
        for b in range(n):
            value = factor * w[block + a * n + b]
            i, k = member(1, 0, a), member(1, 1, b)
            lv[at + i + L.COLUMN * k] += side(1, b) * value / scale(p, i, k)
            i, k = member(1, 1, a), member(1, 0, b)
            lv[at + i + L.COLUMN * k] -= side(1, a) * value / scale(p, i, k)


@kernel
def ball_answers(p, lv, jac, family, turn, sr, si, w):
    """Solve for the rates of ball 0 per displacement of a whirl at the complex frequency ``sr + i si``.

    In 1/s. They follow the coefficients in ``T.BALL_RE``, ``T.BALL_IM``. ``turn``: 1 forward, -1
    backward, 0 along the axis. False if singular.
    """
    n = whole_size(p, family)
    width = J.BALL + n
    re = w[T.BALL_RE : T.BALL_RE + J.BALL * T.BALL_ROW]
    im = w[T.BALL_IM : T.BALL_IM + J.BALL * T.BALL_ROW]
    seen = si - turn * lv[L.Y0 + Y.OM]
    per = 1.0 / (sr * sr + seen * seen + 1e-300)
    for i in range(J.BALL):
        for k in range(J.BALL):
            row = J.B + i * J.STATES * STRIDE
            by_place = jac[row + k * STRIDE] if k < J.PLACED else 0.0
            own = 1.0 if i == k else 0.0
            by_rate = jac[row + (J.PLACED + k) * STRIDE]
            # a ball's place is its rate over its frequency
            re[i * width + k] = sr * (own - by_place * per) - by_rate
            im[i * width + k] = seen * (own + by_place * per)
        for b in range(n):
            total_re = 0.0
            total_im = 0.0
            for plane in range(planes(family)):
                at = J.C + (i * J.BODIES + member(family, plane, b)) * STRIDE
                moving = jac[at + Q.SIZE * STRIDE]
                fr, fi = jac[at] + sr * moving, si * moving
                if plane == 0:
                    total_re += fr
                    total_im += fi
                else:
                    ahead = turn * side(1, b)
                    total_re -= ahead * fi
                    total_im += ahead * fr
            re[i * width + J.BALL + b] = total_re
            im[i * width + J.BALL + b] = total_im
    return solve_complex(re, im, J.BALL, width)


@kernel
def pushed(p, lv, jac, family, turn, i, b, sr, si, w):
    """Acceleration ``i`` of the bodies per displacement ``b`` of a whirl: real and imaginary part (1/s2).

    Of the balls' share what ball 0 does times their number, after :func:`ball_answers`.
    """
    re = 0.0
    im = 0.0
    for plane in range(planes(family)):
        at = J.E + i * J.BODIES + member(family, plane, b)
        fr, fi = jac[at] + sr * jac[at + Q.SIZE], si * jac[at + Q.SIZE]
        if plane == 0:
            re += fr
            im += fi
        else:
            ahead = turn * side(1, b)
            re -= ahead * fi
            im += ahead * fr
    width = J.BALL + whole_size(p, family)
    seen = si - turn * lv[L.Y0 + Y.OM]
    per = 1.0 / (sr * sr + seen * seen + 1e-300)
    for m in range(J.BALL):
        row = J.D + i * J.STATES * STRIDE
        by_place = jac[row + m * STRIDE] * per if m < J.PLACED else 0.0
        fr = p[P.BALLS] * (jac[row + (J.PLACED + m) * STRIDE] + sr * by_place)
        fi = -p[P.BALLS] * seen * by_place
        xr, xi = w[T.BALL_RE + m * width + J.BALL + b], w[T.BALL_IM + m * width + J.BALL + b]
        re += fr * xr - fi * xi
        im += fr * xi + fi * xr
    return re, im


@kernel
def full_whirl(p, lv, jac, family, turn, sr, si, w):
    """Equations of a whirl by the full ones at ``sr + i si`` (1/s) into ``T.WHIRL_RE``, ``T.WHIRL_IM``.

    What is zero with a mode's shape at its frequency: that squared, less the accelerations per displacement.
    False where a ball's equations are singular.
    """
    if not ball_answers(p, lv, jac, family, turn, sr, si, w):
        return False
    whole = whole_size(p, family)
    re = w[T.FULL_RE : T.FULL_RE + T.WHOLE]
    im = w[T.FULL_IM : T.FULL_IM + T.WHOLE]
    for a in range(whole):
        for b in range(whole):
            i = member(family, 0, a)
            share = scale(p, i, member(family, 0, b)) / planes(family)
            fr, fi = pushed(p, lv, jac, family, turn, i, b, sr, si, w)
            if family == 1:
                # what the other plane feels, turned back
                gr, gi = pushed(p, lv, jac, family, turn, member(1, 1, a), b, sr, si, w)
                ahead = turn * side(1, a)
                fr += ahead * gi
                fi -= ahead * gr
            own = 1.0 if a == b else 0.0
            re[a * whole + b] = own * (sr * sr - si * si) - share * fr
            im[a * whole + b] = own * 2.0 * sr * si - share * fi
    n = family_size(family)
    for left in range(whole - n):
        c = whole - 1 - left
        pr, pi = re[c * whole + c], im[c * whole + c]
        per = 1.0 / (pr * pr + pi * pi + 1e-300)
        for a in range(c):
            fr = (re[a * whole + c] * pr + im[a * whole + c] * pi) * per
            fi = (im[a * whole + c] * pr - re[a * whole + c] * pi) * per
            for b in range(c):
                xr, xi = re[c * whole + b], im[c * whole + b]
                re[a * whole + b] -= fr * xr - fi * xi
                im[a * whole + b] -= fr * xi + fi * xr
    for a in range(n):
        for b in range(n):
            w[T.WHIRL_RE + a * n + b] = re[a * whole + b]
            w[T.WHIRL_IM + a * n + b] = im[a * whole + b]
    return True


@kernel
def add_across(p, lv, family, sr, si, w):
    """Add the transverse balls at ``sr + i si`` (1/s) to the equations in ``T.WHIRL_RE``, ``T.WHIRL_IM``."""
    if lv[L.SIDE_SQUARE] == 0.0:
        return
    n = family_size(family)
    square, rate = lv[L.SIDE_SQUARE], lv[L.SIDE_RATE]
    below_re = sr * sr - si * si + rate * sr + square
    below_im = (2.0 * sr + rate) * si
    per = 1.0 / (below_re * below_re + below_im * below_im + 1e-300)
    weight = p[P.BALL_MASS] * pattern_weight(p, family)
    for b in range(n):
        guides = w[T.GUIDES + b]
        # contact damping leads the balls' places of rest
        ahead_re = w[T.FOLLOWS + b] + w[T.LEADS + b] * sr
        ahead_im = w[T.LEADS + b] * si
        drive_re = square * ahead_re + rate * sr * guides
        drive_im = square * ahead_im + rate * si * guides
        place_re = (drive_re * below_re + drive_im * below_im) * per
        place_im = (drive_im * below_re - drive_re * below_im) * per
        off_re, off_im = place_re - guides, place_im
        drag_re = rate * (sr * off_re - si * off_im)
        drag_im = rate * (sr * off_im + si * off_re)
        for a in range(n):
            pull = square * w[T.FOLLOWS + a]
            to = a * n + b
            w[T.WHIRL_RE + to] += weight * (pull * (ahead_re - place_re) - w[T.GUIDES + a] * drag_re)
            w[T.WHIRL_IM + to] += weight * (pull * (ahead_im - place_im) - w[T.GUIDES + a] * drag_im)


@kernel
def condensed_whirl(p, lv, family, turn, sr, si, w):
    """Equations of a whirl of the condensed rings, with what ``T.HEAVY`` and so on hold; see `full_whirl`."""
    n = family_size(family)
    square_re, square_im = sr * sr - si * si, 2.0 * sr * si
    for i in range(n * n):
        turned = turn * w[T.STILL + T.BLOCK + i]
        mass, mass_turned = w[T.HEAVY + i], turn * w[T.HEAVY + T.BLOCK + i]
        damper, damper_turned = w[T.DAMPER + i], turn * w[T.DAMPER + T.BLOCK + i]
        re = w[T.STILL + i] + square_re * mass - square_im * mass_turned
        im = turned + square_re * mass_turned + square_im * mass
        w[T.WHIRL_RE + i] = re + sr * damper - si * damper_turned
        w[T.WHIRL_IM + i] = im + sr * damper_turned + si * damper
    add_across(p, lv, family, sr, si, w)


@kernel
def gather_rings(p, lv, family, w):
    """Fill ``T.STILL``, ``T.DAMPER``, ``T.HEAVY`` and the rows of the transverse balls of a family."""
    gather_family(p, lv, L.JX, family, -1.0, T.STILL, w)
    gather_family(p, lv, L.JV, family, -1.0, T.DAMPER, w)
    gather_family(p, lv, L.MASS, family, 1.0, T.HEAVY, w)
    n = family_size(family)
    row = family * L.COLUMN
    for a in range(n):
        i = member(family, 0, a)
        per = math.sqrt(own_share(p, i)) / math.sqrt(inertia(p, i))
        # what the ring carries
        w[T.HEAVY + a * n + a] += 1.0 - own_share(p, i)
        w[T.FOLLOWS + a] = per * lv[L.SIDE_FOLLOW + row + i]
        w[T.LEADS + a] = per * lv[L.SIDE_LEAD + row + i]
        w[T.GUIDES + a] = per * lv[L.SIDE_GUIDE + row + i]
