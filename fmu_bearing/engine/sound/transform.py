"""Real discrete Fourier transforms of many signals at once, on flat arrays: one lane per signal.

A signal of 2 B samples is folded into B complex numbers, transformed by the radix-2 algorithm of Cooley and
Tukey (1965), and unfolded into its B + 1 frequencies. Rows hold the real parts of all lanes, then the
imaginary ones: 2 n numbers. Every loop over lanes is a vector loop without a running sum, the same on every
machine.
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
def butterflies(z, n, block, turns, sign):
    """Transform ``block`` rows of ``n`` complex lanes in place; their order before is bit-reversed.

    ``turns``: cosines then sines of 2 pi k / (2 block), k = 0 .. block. ``sign`` is that of the exponent.
    """
    half = 1
    while half < block:
        stride = block // half  # of the table, whose circle has 2 block places
        for k in range(half):
            c = turns[k * stride]
            d = sign * turns[block + 1 + k * stride]
            for first in range(k, block, 2 * half):
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
        half *= 2


@kernel
def unfold(z, n, block, turns, out):
    """Frequencies 0 .. ``block`` of the real signals whose folded transform is in ``z``."""
    for k in range(block + 1):
        p = (k % block) * 2 * n
        q = ((block - k) % block) * 2 * n
        ar = z[p : p + n]
        ai = z[p + n : p + 2 * n]
        br = z[q : q + n]
        bi = z[q + n : q + 2 * n]
        c = turns[k]
        d = -turns[block + 1 + k]
        xr = out[2 * n * k : 2 * n * k + n]
        xi = out[2 * n * k + n : 2 * n * (k + 1)]
        # even samples' transform plus turned odd samples'; one result per loop, or it is no vector loop
        for i in range(n):
            xr[i] = 0.5 * ((ar[i] + br[i]) + (c * (ai[i] + bi[i]) - d * (br[i] - ar[i])))
        for i in range(n):
            xi[i] = 0.5 * ((ai[i] - bi[i]) + (c * (br[i] - ar[i]) + d * (ai[i] + bi[i])))


@kernel
def fold(x, n, block, turns, z):
    """Opposite of `unfold`, rows of ``z`` in bit-reversed order, ready for `butterflies` with sign +1.

    The result is ``block`` times the folded signals.
    """
    for k in range(block):
        p = k * 2 * n
        q = (block - k) * 2 * n
        ar = x[p : p + n]
        ai = x[p + n : p + 2 * n]
        br = x[q : q + n]
        bi = x[q + n : q + 2 * n]
        c = turns[k]
        d = turns[block + 1 + k]
        row = reversed_bits(k, block) * 2 * n
        zr = z[row : row + n]
        zi = z[row + n : row + 2 * n]
        for i in range(n):
            zr[i] = 0.5 * ((ar[i] + br[i]) - (c * (ai[i] + bi[i]) + d * (ar[i] - br[i])))
        for i in range(n):
            zi[i] = 0.5 * ((ai[i] - bi[i]) + (c * (ar[i] - br[i]) - d * (ai[i] + bi[i])))
