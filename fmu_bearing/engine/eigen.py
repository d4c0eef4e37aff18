"""Eigenvalues and eigenvectors of small complex matrices.

Householder's reduction to Hessenberg form, the QR algorithm with Wilkinson's shifts by Givens' rotations, and
back substitution (Golub and Van Loan, Matrix Computations, 7.4 to 7.6). Matrices are real and imaginary parts
by rows of ``n`` numbers. Callers scale their matrices: rows and columns of like size.
"""

import math

from fmu_bearing.engine.jit import kernel

_ROUNDS = 60  # per eigenvalue; 2 to 4 are needed
_SMALL = 1e-16  # of the neighbouring diagonal: an entry below it counts as zero
_ODD = 10  # rounds without an eigenvalue after which a shift is taken aside


@kernel
def root_of(re, im):
    """Square root of a complex number."""
    size = math.hypot(re, im)
    a = math.sqrt(0.5 * (size + abs(re)))
    b = 0.5 * im / a if a > 0.0 else 0.0
    if re >= 0.0:
        return a, b
    return abs(b), math.copysign(a, im)


@kernel
def reduce(re, im, zr, zi, n):
    """Reduce to Hessenberg form in place; the transformations go to ``zr``, ``zi``."""
    for i in range(n * n):
        zr[i] = 0.0
        zi[i] = 0.0
    for i in range(n):
        zr[i * n + i] = 1.0
    for k in range(n - 2):
        # eliminate the rest of column k by rotations of two rows each
        for i in range(k + 2, n):
            rotate_out(re, im, zr, zi, n, k + 1, i, k)


@kernel
def rotate_out(re, im, zr, zi, n, top, low, column):
    """Rotate rows ``top`` and ``low`` so that the lower entry of ``column`` vanishes, then the columns."""
    br, bi = re[low * n + column], im[low * n + column]
    if br == 0.0 and bi == 0.0:
        return
    c, sr, si = rotation(re[top * n + column], im[top * n + column], br, bi)
    rotate_rows(re, im, n, top, low, 0, c, sr, si)
    re[low * n + column] = 0.0
    im[low * n + column] = 0.0
    rotate_columns(re, im, n, top, low, n, c, sr, si)
    rotate_columns(zr, zi, n, top, low, n, c, sr, si)


@kernel
def rotation(ar, ai, br, bi):
    """Cosine and complex sine of Givens' rotation that takes (a, b) to (r, 0): r = c a + s b."""
    a = math.hypot(ar, ai)
    b = math.hypot(br, bi)
    size = math.hypot(a, b)
    if b == 0.0:
        return 1.0, 0.0, 0.0
    if a == 0.0:
        return 0.0, br / b, -bi / b
    # s = sign(a) conj(b) / size
    ur, ui = ar / a, ai / a
    return a / size, (ur * br + ui * bi) / size, (ui * br - ur * bi) / size


@kernel
def rotate_rows(re, im, n, top, low, first, c, sr, si):
    """Rows: (top, low) becomes (c top + s low, c low - conj(s) top), from column ``first`` on."""
    for j in range(first, n):
        t, b = top * n + j, low * n + j
        xr, xi, yr, yi = re[t], im[t], re[b], im[b]
        re[t] = c * xr + (sr * yr - si * yi)
        im[t] = c * xi + (sr * yi + si * yr)
        re[b] = c * yr - (sr * xr + si * xi)
        im[b] = c * yi - (sr * xi - si * xr)


@kernel
def rotate_columns(re, im, n, one, two, rows, c, sr, si):
    """Columns: the inverse of `rotate_rows`, in the first ``rows`` rows."""
    for i in range(rows):
        t, b = i * n + one, i * n + two
        xr, xi, yr, yi = re[t], im[t], re[b], im[b]
        re[t] = c * xr + (sr * yr + si * yi)
        im[t] = c * xi + (sr * yi - si * yr)
        re[b] = c * yr - (sr * xr - si * xi)
        im[b] = c * yi - (sr * xi + si * xr)


@kernel
def shift_of(re, im, n, k):
    """Eigenvalue of the last two rows of ``k`` that is nearer to the last diagonal."""
    a, b, c, d = (k - 2) * n + k - 2, (k - 2) * n + k - 1, (k - 1) * n + k - 2, (k - 1) * n + k - 1
    half_r, half_i = 0.5 * (re[a] - re[d]), 0.5 * (im[a] - im[d])
    pr = re[b] * re[c] - im[b] * im[c]
    pi = re[b] * im[c] + im[b] * re[c]
    qr, qi = root_of(half_r * half_r - half_i * half_i + pr, 2.0 * half_r * half_i + pi)
    if half_r * qr + half_i * qi < 0.0:
        qr, qi = -qr, -qi
    # d - b c / (half + root)
    lr, li = half_r + qr, half_i + qi
    size = lr * lr + li * li
    if size == 0.0:
        return re[d], im[d]
    return re[d] - (pr * lr + pi * li) / size, im[d] - (pi * lr - pr * li) / size


@kernel
def triangular(re, im, zr, zi, n):
    """Make the Hessenberg matrix triangular, the transformations follow in ``z``; False if not in bounds."""
    k = n
    rounds = 0
    while k > 1:
        low = k - 1
        while low > 0:
            size = abs(re[(low - 1) * n + low - 1]) + abs(im[(low - 1) * n + low - 1])
            size += abs(re[low * n + low]) + abs(im[low * n + low])
            if abs(re[low * n + low - 1]) + abs(im[low * n + low - 1]) <= _SMALL * size:
                re[low * n + low - 1] = 0.0
                im[low * n + low - 1] = 0.0
                break
            low -= 1
        if low == k - 1:
            k -= 1
            rounds = 0
            continue
        rounds += 1
        if rounds > _ROUNDS:
            return False
        sr, si = shift_of(re, im, n, k)
        if rounds % _ODD == 0:
            sr += abs(re[(k - 1) * n + k - 2])
        # one implicit step: the first rotation is that of the shifted matrix, the others chase the bulge
        c, tr, ti = rotation(
            re[low * n + low] - sr, im[low * n + low] - si, re[(low + 1) * n + low], im[(low + 1) * n + low]
        )
        for i in range(low, k - 1):
            if i > low:
                at, under = i * n + i - 1, (i + 1) * n + i - 1
                c, tr, ti = rotation(re[at], im[at], re[under], im[under])
            rotate_rows(re, im, n, i, i + 1, max(i - 1, 0), c, tr, ti)
            rotate_columns(re, im, n, i, i + 1, min(i + 3, k), c, tr, ti)
            rotate_columns(zr, zi, n, i, i + 1, n, c, tr, ti)
            if i > low:
                re[(i + 1) * n + i - 1] = 0.0
                im[(i + 1) * n + i - 1] = 0.0
    return True


@kernel
def eigen(re, im, zr, zi, vr, vi, n):
    """Eigenvalues to the diagonal of the matrix (destroyed), eigenvectors to the columns of ``v``.

    ``re``, ``im``: the matrix, with as many numbers of scratch behind it; ``z``: scratch of its size. False
    where the algorithm does not converge.
    """
    reduce(re, im, zr, zi, n)
    if not triangular(re, im, zr, zi, n):
        return False
    largest = 0.0
    for i in range(n):
        for j in range(i, n):
            largest = max(largest, abs(re[i * n + j]) + abs(im[i * n + j]))
    least = 1e-16 * largest + 1e-300
    for k in range(n):
        # solve (T - t_kk) x = 0 upwards from x_k = 1; x takes column k of v for the time being
        for i in range(n):
            vr[i * n + k] = 1.0 if i == k else 0.0
            vi[i * n + k] = 0.0
        for i in range(k - 1, -1, -1):
            sum_r, sum_i = 0.0, 0.0
            for j in range(i + 1, k + 1):
                sum_r -= re[i * n + j] * vr[j * n + k] - im[i * n + j] * vi[j * n + k]
                sum_i -= re[i * n + j] * vi[j * n + k] + im[i * n + j] * vr[j * n + k]
            dr = re[i * n + i] - re[k * n + k]
            di = im[i * n + i] - im[k * n + k]
            if abs(dr) + abs(di) < least:
                dr = least
            size = dr * dr + di * di
            vr[i * n + k] = (sum_r * dr + sum_i * di) / size
            vi[i * n + k] = (sum_i * dr - sum_r * di) / size
    # z times the triangle x, behind the matrix
    for i in range(n):
        for k in range(n):
            sum_r, sum_i = 0.0, 0.0
            for j in range(k + 1):
                sum_r += zr[i * n + j] * vr[j * n + k] - zi[i * n + j] * vi[j * n + k]
                sum_i += zr[i * n + j] * vi[j * n + k] + zi[i * n + j] * vr[j * n + k]
            re[n * n + i * n + k] = sum_r
            im[n * n + i * n + k] = sum_i
    for k in range(n):
        size = 0.0
        for i in range(n):
            size += re[n * n + i * n + k] ** 2 + im[n * n + i * n + k] ** 2
        per = 1.0 / math.sqrt(size)
        for i in range(n):
            vr[i * n + k] = per * re[n * n + i * n + k]
            vi[i * n + k] = per * im[n * n + i * n + k]
    return True
