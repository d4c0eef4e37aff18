"""Small linear systems by Gauss-Jordan elimination with row pivoting."""

from fmu_bearing.engine.jit import kernel


@kernel
def eliminate(a, at, n):
    """Solve in place the system of ``n`` rows of ``n + 1`` numbers at ``a[at:]``; False if singular."""
    m = n + 1
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(a[at + i * m + k]) > abs(a[at + pivot * m + k]):
                pivot = i
        if not (abs(a[at + pivot * m + k]) > 0.0):
            return False
        for j in range(m):
            kept = a[at + k * m + j]
            a[at + k * m + j] = a[at + pivot * m + j]
            a[at + pivot * m + j] = kept
        for i in range(n):
            if i != k:
                factor = a[at + i * m + k] / a[at + k * m + k]
                for j in range(k, m):
                    a[at + i * m + j] -= factor * a[at + k * m + j]
    for k in range(n):
        a[at + k * m + n] /= a[at + k * m + k]
    return True
