"""Real discrete Fourier transforms of many signals at once, on flat arrays: one lane per signal.

A signal of 2 B samples is folded into B complex numbers, transformed by the radix-2 algorithm of Cooley and
Tukey (1965), and unfolded into its B + 1 frequencies; back the other way round. Rows hold the real parts of
all lanes, then the imaginary ones: 2 n numbers, n a multiple of four. Every step works in place and is done
in pieces: the units ``begin`` .. ``end`` - 1 of its work, those outside of it being none. Lanes go four by
four without a running sum, the same on every machine.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store
from fmu_bearing.engine.layout import FOUR


@kernel
def reversed_bits(k, block):
    """``k`` with its bits in reverse order, as many as number the ``block`` (a power of two) places."""
    r = 0
    while block > 1:
        r = 2 * r + k % 2
        k = k // 2
        block = block // 2
    return r


@kernel
def combine(z, n, block, turns, begin, end):
    """Forward transform of ``block`` rows in bit-reversed order, without its first stage; they end in order.

    ``turns``: cosines then sines of 2 pi k / (2 block), k = 0 .. block. Units: ``block`` / 2 per stage.
    """
    pairs = block // 2
    half = 2
    while half < block:
        groups = pairs // half
        u = max(begin, 0)
        k = u // groups if u < pairs else 0
        first = k + (u - k * groups) * 2 * half
        for _ in range(u, min(end, pairs)):
            c = turns[2 * k * groups]
            d = -turns[block + 1 + 2 * k * groups]
            p = first * 2 * n
            q = (first + half) * 2 * n
            for r in range(p, p + n, FOUR):
                s = r + q - p
                ar, ai, br, bi = load(z, r), load(z, r + n), load(z, s), load(z, s + n)
                tr = c * br - d * bi
                ti = c * bi + d * br
                store(z, s, ar - tr)
                store(z, s + n, ai - ti)
                store(z, r, ar + tr)
                store(z, r + n, ai + ti)
            first += 2 * half
            if first >= block:
                k += 1
                first = k
        begin -= pairs
        end -= pairs
        half *= 2


@kernel
def divide(z, n, block, turns, begin, end):
    """Backward transform of ``block`` rows in order, without its last stage; they end bit-reversed.

    ``turns`` and units as in `combine`.
    """
    pairs = block // 2
    half = pairs
    while half > 1:
        groups = pairs // half
        u = max(begin, 0)
        k = u // groups if u < pairs else 0
        first = k + (u - k * groups) * 2 * half
        for _ in range(u, min(end, pairs)):
            c = turns[2 * k * groups]
            d = turns[block + 1 + 2 * k * groups]
            p = first * 2 * n
            q = (first + half) * 2 * n
            for r in range(p, p + n, FOUR):
                s = r + q - p
                ar, ai, br, bi = load(z, r), load(z, r + n), load(z, s), load(z, s + n)
                tr = ar - br
                ti = ai - bi
                store(z, r, ar + br)
                store(z, r + n, ai + bi)
                store(z, s, c * tr - d * ti)
                store(z, s + n, c * ti + d * tr)
            first += 2 * half
            if first >= block:
                k += 1
                first = k
        begin -= pairs
        end -= pairs
        half //= 2


@kernel
def unfold(z, n, block, turns, begin, end):
    """Rows 0 .. ``block`` - 1 of folded transforms become frequencies 0 .. ``block`` of the real signals.

    Units: frequencies 0 .. ``block`` / 2, each with its opposite.
    """
    half = block // 2
    for k in range(max(begin, 0), min(end, half + 1)):
        p = k * 2 * n
        q = (block - k) * 2 * n
        if k == 0:
            for r in range(p, p + n, FOUR):
                s = r + q - p
                ar, ai = load(z, r), load(z, r + n)
                store(z, s, ar - ai)
                store(z, s + n, splat(0.0))
                store(z, r, ar + ai)
                store(z, r + n, splat(0.0))
        elif k == half:
            for r in range(p + n, p + 2 * n, FOUR):
                store(z, r, -load(z, r))
        else:
            c = 0.5 * turns[k]
            d = -0.5 * turns[block + 1 + k]
            for r in range(p, p + n, FOUR):  # even samples' transform plus and minus turned odd samples'
                s = r + q - p
                ar, ai, br, bi = load(z, r), load(z, r + n), load(z, s), load(z, s + n)
                er = 0.5 * (ar + br)
                ei = 0.5 * (ai - bi)
                sr = br - ar
                si = ai + bi
                tr = c * si - d * sr
                ti = c * sr + d * si
                store(z, r, er + tr)
                store(z, r + n, ei + ti)
                store(z, s, er - tr)
                store(z, s + n, ti - ei)


@kernel
def fold(z, n, block, turns, begin, end):
    """Opposite of `unfold`: frequencies become rows ready for `divide`; units the same.

    After that the result is ``block`` times the folded signals.
    """
    half = block // 2
    for k in range(max(begin, 0), min(end, half + 1)):
        p = k * 2 * n
        q = (block - k) * 2 * n
        if k == 0:
            for r in range(p, p + n, FOUR):
                ar, br = load(z, r), load(z, r + q - p)
                store(z, r + n, 0.5 * (ar - br))
                store(z, r, 0.5 * (ar + br))
        elif k == half:
            for r in range(p + n, p + 2 * n, FOUR):
                store(z, r, -load(z, r))
        else:
            c = 0.5 * turns[k]
            d = 0.5 * turns[block + 1 + k]
            for r in range(p, p + n, FOUR):
                s = r + q - p
                ar, ai, br, bi = load(z, r), load(z, r + n), load(z, s), load(z, s + n)
                er = 0.5 * (ar + br)
                ei = 0.5 * (ai - bi)
                sr = ar - br
                si = ai + bi
                tr = c * si + d * sr
                ti = c * sr - d * si
                store(z, r, er - tr)
                store(z, r + n, ei + ti)
                store(z, s, er + tr)
                store(z, s + n, ti - ei)
