"""Small dense matrices: product, elimination, inverse and complex equations."""

from fmu_bearing.engine.complex_numbers import real_times, square
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, L

_LARGEST = 1e300  # a pivot beyond it is no number to divide by


@kernel
def times(m, at, x, source, y, target):
    """``y[target:] = matrix x[source:]``, the matrix of 11 columns of 12 at ``m[at:]``; writes 12 numbers.

    Twelve sums by name stay in three vector registers, where an inner loop would go through memory.
    """
    a0 = 0.0
    a1 = 0.0
    a2 = 0.0
    a3 = 0.0
    a4 = 0.0
    a5 = 0.0
    a6 = 0.0
    a7 = 0.0
    a8 = 0.0
    a9 = 0.0
    a10 = 0.0
    a11 = 0.0
    for k in range(L.N):
        value = x[source + k]
        column = at + L.COLUMN * k
        a0 += m[column + 0] * value
        a1 += m[column + 1] * value
        a2 += m[column + 2] * value
        a3 += m[column + 3] * value
        a4 += m[column + 4] * value
        a5 += m[column + 5] * value
        a6 += m[column + 6] * value
        a7 += m[column + 7] * value
        a8 += m[column + 8] * value
        a9 += m[column + 9] * value
        a10 += m[column + 10] * value
        a11 += m[column + 11] * value
    y[target + 0] = a0
    y[target + 1] = a1
    y[target + 2] = a2
    y[target + 3] = a3
    y[target + 4] = a4
    y[target + 5] = a5
    y[target + 6] = a6
    y[target + 7] = a7
    y[target + 8] = a8
    y[target + 9] = a9
    y[target + 10] = a10
    y[target + 11] = a11


@kernel
def pivot_row(a, at, n, width, k):
    """Row from ``k`` on with the largest number in column ``k``.

    The ``n`` rows of ``width`` numbers begin at ``a[at:]``.
    """
    pivot = k
    for i in range(k + 1, n):
        if abs(a[at + i * width + k]) > abs(a[at + pivot * width + k]):
            pivot = i
    return pivot


@kernel
def swap(a, one, other, count):
    """Exchange ``count`` numbers at ``a[one:]`` and ``a[other:]``."""
    for j in range(count):
        saved = a[one + j]
        a[one + j] = a[other + j]
        a[other + j] = saved


@kernel
def subtract(a, one, factor, other, count):
    """``a[one:] -= factor a[other:]``, ``count`` numbers."""
    for j in range(count):
        a[one + j] -= factor * a[other + j]


@kernel
def eliminate(a, at, n):
    """Solve in place the ``n`` equations, rows of ``n + 1`` numbers at ``a[at:]``; False if singular.

    Gauss-Jordan elimination with row pivoting; the last column takes the solution.
    """
    m = n + 1
    for k in range(n):
        pivot = pivot_row(a, at, n, m, k)
        if not (abs(a[at + pivot * m + k]) > 0.0):
            return False
        swap(a, at + k * m, at + pivot * m, m)
        for i in range(n):
            if i != k:
                factor = a[at + i * m + k] / a[at + k * m + k]
                subtract(a, at + i * m + k, factor, at + k * m + k, m - k)
    for k in range(n):
        a[at + k * m + n] /= a[at + k * m + k]
    return True


@kernel
def invert(a, at, n, out, to):
    """Inverse of the ``n`` x ``n`` matrix ``a[at:]`` (destroyed) into ``out[to:]``; False if singular."""
    for i in range(n):
        for j in range(n):
            out[to + i * n + j] = 1.0 if i == j else 0.0
    for k in range(n):
        pivot = pivot_row(a, at, n, n, k)
        size = a[at + pivot * n + k]
        if not (abs(size) > 0.0 and abs(size) < _LARGEST):
            return False
        per = 1.0 / size
        swap(a, at + k * n, at + pivot * n, n)
        swap(out, to + k * n, to + pivot * n, n)
        for j in range(n):
            a[at + k * n + j] *= per
            out[to + k * n + j] *= per
        for i in range(n):
            if i != k:
                factor = a[at + i * n + k]
                subtract(a, at + i * n, factor, at + k * n, n)
                subtract(out, to + i * n, factor, to + k * n, n)
    return True


@kernel
def solve_complex(a, n, m):
    """Solve ``n`` complex equations, rows of ``m`` numbers, in place; False if singular.

    A row: ``n`` coefficients, then a right side per number left.
    """
    for k in range(n):
        best = 0.0
        pivot = k
        for i in range(k, n):
            if square(a[i * m + k]) > best:
                best = square(a[i * m + k])
                pivot = i
        if not (best > 0.0 and best < _LARGEST):
            return False
        per = real_times(1.0 / best, a[pivot * m + k].conjugate())
        swap(a, k * m + k, pivot * m + k, m - k)
        for j in range(k, m):
            a[k * m + j] *= per
        for i in range(n):
            if i != k:
                subtract(a, i * m + k, a[i * m + k], k * m + k, m - k)
    return True


@kernel
def solve_columns(re, im, n, lanes):
    """Solve ``n`` complex equations in place, columns of ``lanes`` numbers; False if singular.

    Columns of coefficients, then the right side, which takes the solution. ``lanes``: ``n`` filled up to
    whole groups of four; spare rows are zero. As `solve_complex`, but a column's rows go side by side.
    """
    for k in range(n):
        column = k * lanes
        best = 0.0
        pivot = k
        for i in range(k, n):
            size = re[column + i] * re[column + i] + im[column + i] * im[column + i]
            if size > best:
                best = size
                pivot = i
        if not (best > 0.0 and best < _LARGEST):
            return False
        pr = re[column + pivot] / best
        pi = -im[column + pivot] / best
        if pivot != k:
            for j in range(k, n + 1):
                swap(re, j * lanes + k, j * lanes + pivot, 1)
                swap(im, j * lanes + k, j * lanes + pivot, 1)
        # the pivot's row is written by itself
        re[column + k] = 0.0
        im[column + k] = 0.0
        for j in range(k + 1, n + 1):
            at = j * lanes
            xr = re[at + k] * pr - im[at + k] * pi
            xi = re[at + k] * pi + im[at + k] * pr
            for g in range(0, lanes, FOUR):
                fr = load(re, column + g)
                fi = load(im, column + g)
                store(re, at + g, load(re, at + g) - (fr * xr - fi * xi))
                store(im, at + g, load(im, at + g) - (fr * xi + fi * xr))
            re[at + k] = xr
            im[at + k] = xi
    return True
