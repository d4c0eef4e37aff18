"""Real discrete Fourier transforms of many signals at once, on flat arrays: one lane per signal.

A signal of 2 B samples is folded into B complex numbers, transformed by the radix-2 algorithm of Cooley and
Tukey (1965), and unfolded into its B + 1 frequencies; back the other way round. Rows hold the real parts of
all lanes, then the imaginary ones: 2 n numbers. Every step works in place and is done in pieces: the units
``begin`` .. ``end`` - 1 of its work, those outside of it being none. Every loop over lanes is a vector loop
without a running sum, the same on every machine.
"""

from fmu_bearing.engine.jit import kernel


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
            ar = z[p : p + n]
            ai = z[p + n : p + 2 * n]
            br = z[q : q + n]
            bi = z[q + n : q + 2 * n]
            for i in range(n):
                tr = c * br[i] - d * bi[i]
                ti = c * bi[i] + d * br[i]
                br[i] = ar[i] - tr
                bi[i] = ai[i] - ti
                ar[i] += tr
                ai[i] += ti
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
            ar = z[p : p + n]
            ai = z[p + n : p + 2 * n]
            br = z[q : q + n]
            bi = z[q + n : q + 2 * n]
            for i in range(n):
                tr = ar[i] - br[i]
                ti = ai[i] - bi[i]
                ar[i] += br[i]
                ai[i] += bi[i]
                br[i] = c * tr - d * ti
                bi[i] = c * ti + d * tr
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
        ar = z[p : p + n]
        ai = z[p + n : p + 2 * n]
        br = z[q : q + n]
        bi = z[q + n : q + 2 * n]
        if k == 0:
            for i in range(n):
                br[i] = ar[i] - ai[i]
                bi[i] = 0.0
                ar[i] += ai[i]
                ai[i] = 0.0
        elif k == half:
            for i in range(n):
                ai[i] = -ai[i]
        else:
            c = 0.5 * turns[k]
            d = -0.5 * turns[block + 1 + k]
            for i in range(n):  # even samples' transform plus and minus turned odd samples'
                er = 0.5 * (ar[i] + br[i])
                ei = 0.5 * (ai[i] - bi[i])
                sr = br[i] - ar[i]
                si = ai[i] + bi[i]
                tr = c * si - d * sr
                ti = c * sr + d * si
                ar[i] = er + tr
                ai[i] = ei + ti
                br[i] = er - tr
                bi[i] = ti - ei


@kernel
def fold(z, n, block, turns, begin, end):
    """Opposite of `unfold`: frequencies become rows ready for `divide`; units the same.

    After that the result is ``block`` times the folded signals.
    """
    half = block // 2
    for k in range(max(begin, 0), min(end, half + 1)):
        p = k * 2 * n
        q = (block - k) * 2 * n
        ar = z[p : p + n]
        ai = z[p + n : p + 2 * n]
        br = z[q : q + n]
        bi = z[q + n : q + 2 * n]
        if k == 0:
            for i in range(n):
                ai[i] = 0.5 * (ar[i] - br[i])
                ar[i] = 0.5 * (ar[i] + br[i])
        elif k == half:
            for i in range(n):
                ai[i] = -ai[i]
        else:
            c = 0.5 * turns[k]
            d = 0.5 * turns[block + 1 + k]
            for i in range(n):
                er = 0.5 * (ar[i] + br[i])
                ei = 0.5 * (ai[i] - bi[i])
                sr = ar[i] - br[i]
                si = ai[i] + bi[i]
                tr = c * si + d * sr
                ti = c * sr - d * si
                ar[i] = er - tr
                ai[i] = ei + ti
                br[i] = er + tr
                bi[i] = ti - ei
