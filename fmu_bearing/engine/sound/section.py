"""One section of second order, on lanes side by side: A-weighting."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD


@kernel
def filter_section(ps, at, ss, state, x, n):
    """Filter the ``n`` signals ``x`` in place; numbers at ``ps[at:]``, states at ``ss[state:]``.

    Transposed direct form II.
    """
    b0 = ps[at + SD.B0]
    b1 = ps[at + SD.B1]
    b2 = ps[at + SD.B2]
    a1 = ps[at + SD.A1]
    a2 = ps[at + SD.A2]
    s1 = ss[state : state + n]
    s2 = ss[state + n : state + 2 * n]
    for c in range(n):
        value = b0 * x[c] + s1[c]
        s1[c] = b1 * x[c] - a1 * value + s2[c]
        s2[c] = b2 * x[c] - a2 * value
        x[c] = value
