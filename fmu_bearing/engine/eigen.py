"""Eigenvalues and eigenvectors of small complex matrices.

Reduction to Hessenberg form and the QR algorithm with Wilkinson's shifts, both by Givens' rotations, and back
substitution (Golub and Van Loan, Matrix Computations, 7.4 to 7.6). Matrices are by rows of ``n`` numbers.
Callers scale them: rows and columns of like size.
"""

import math

from fmu_bearing.engine.complex_numbers import over, real_times, root, square
from fmu_bearing.engine.jit import kernel

_ROUNDS = 60  # per eigenvalue; 2 to 4 are needed
_SMALL = 1e-16  # of the neighbouring diagonal: an entry below it counts as zero
_ODD = 10  # rounds without an eigenvalue after which a shift is taken aside


@kernel
def size_of(z):
    """Sum of the sizes of both parts."""
    return abs(z.real) + abs(z.imag)


@kernel
def reduce(a, z, n):
    """Reduce to Hessenberg form in place; the transformations go to ``z``."""
    for i in range(n):
        for k in range(n):
            z[i * n + k] = 1.0 if i == k else 0.0
    for k in range(n - 2):
        # eliminate the rest of column k by rotations of two rows each
        for i in range(k + 2, n):
            low = a[i * n + k]
            if low != 0.0:
                c, s = rotation(a[(k + 1) * n + k], low)
                rotate_rows(a, n, k + 1, i, 0, c, s)
                a[i * n + k] = 0.0
                rotate_columns(a, n, k + 1, i, n, c, s)
                rotate_columns(z, n, k + 1, i, n, c, s)


@kernel
def rotation(a, b):
    """Cosine and complex sine of Givens' rotation that takes (a, b) to (r, 0): r = c a + s b."""
    far, high = math.hypot(a.real, a.imag), math.hypot(b.real, b.imag)
    if high == 0.0:
        return 1.0, 0j
    if far == 0.0:
        return 0.0, real_times(1.0 / high, b.conjugate())
    # s = sign(a) conj(b) / size
    per = 1.0 / math.hypot(far, high)
    return far * per, real_times(per / far, a * b.conjugate())


@kernel
def rotate_rows(a, n, top, low, first, c, s):
    """Rows: (top, low) becomes (c top + s low, c low - conj(s) top), from column ``first`` on."""
    for j in range(first, n):
        x, y = a[top * n + j], a[low * n + j]
        a[top * n + j] = real_times(c, x) + s * y
        a[low * n + j] = real_times(c, y) - s.conjugate() * x


@kernel
def rotate_columns(a, n, one, two, rows, c, s):
    """Columns: the inverse of `rotate_rows`, in the first ``rows`` rows."""
    for i in range(rows):
        x, y = a[i * n + one], a[i * n + two]
        a[i * n + one] = real_times(c, x) + s.conjugate() * y
        a[i * n + two] = real_times(c, y) - s * x


@kernel
def shift_of(a, n, k):
    """Eigenvalue of the last two rows of ``k`` that is nearer to the last diagonal."""
    at = (k - 2) * n + k - 2
    last = a[at + n + 1]
    half, both = 0.5 * (a[at] - last), a[at + 1] * a[at + n]
    along = root(half * half + both)
    if half.real * along.real + half.imag * along.imag < 0.0:
        along = -along
    if half + along == 0.0:
        return last
    return last - over(both, half + along)


@kernel
def triangular(a, z, n):
    """Make the Hessenberg matrix triangular, the transformations follow in ``z``; False if not in bounds."""
    k = n
    rounds = 0
    while k > 1:
        low = k - 1
        while low > 0:
            at = low * n + low
            if size_of(a[at - 1]) <= _SMALL * (size_of(a[at - n - 1]) + size_of(a[at])):
                a[at - 1] = 0.0
                break
            low -= 1
        if low == k - 1:
            k -= 1
            rounds = 0
            continue
        rounds += 1
        if rounds > _ROUNDS:
            return False
        shift = shift_of(a, n, k)
        if rounds % _ODD == 0:
            shift += abs(a[(k - 1) * n + k - 2].real)
        # one implicit step: the first rotation is that of the shifted matrix, the others chase the bulge
        c, s = rotation(a[low * n + low] - shift, a[(low + 1) * n + low])
        for i in range(low, k - 1):
            if i > low:
                c, s = rotation(a[i * n + i - 1], a[(i + 1) * n + i - 1])
            rotate_rows(a, n, i, i + 1, max(i - 1, 0), c, s)
            rotate_columns(a, n, i, i + 1, min(i + 3, k), c, s)
            rotate_columns(z, n, i, i + 1, n, c, s)
            if i > low:
                a[(i + 1) * n + i - 1] = 0.0
    return True


@kernel
def eigen(a, z, v, n):
    """Eigenvalues to the diagonal of the matrix (destroyed), eigenvectors to the columns of ``v``.

    ``a``: the matrix, with as many numbers of scratch behind it; ``z``: scratch of its size. False where the
    algorithm does not converge.
    """
    reduce(a, z, n)
    if not triangular(a, z, n):
        return False
    largest = 0.0
    for i in range(n):
        for j in range(i, n):
            largest = max(largest, size_of(a[i * n + j]))
    least = 1e-16 * largest + 1e-300
    for k in range(n):
        # solve (T - t_kk) x = 0 upwards from x_k = 1; x takes column k of v for the time being
        for i in range(n):
            v[i * n + k] = 1.0 if i == k else 0.0
        for i in range(k - 1, -1, -1):
            total = 0j
            for j in range(i + 1, k + 1):
                total -= a[i * n + j] * v[j * n + k]
            apart = a[i * n + i] - a[k * n + k]
            if size_of(apart) < least:
                apart = complex(least, apart.imag)
            v[i * n + k] = over(total, apart)
    # z times the triangle x, behind the matrix
    for i in range(n):
        for k in range(n):
            total = 0j
            for j in range(k + 1):
                total += z[i * n + j] * v[j * n + k]
            a[n * n + i * n + k] = total
    for k in range(n):
        total = 0.0
        for i in range(n):
            total += square(a[n * n + i * n + k])
        for i in range(n):
            v[i * n + k] = real_times(1.0 / math.sqrt(total), a[n * n + i * n + k])
    return True
