"""Families of motion about equal ball loads, which do not act on each other.

Family 0: both rings along the axis and the outer ring's turning. Family 1: both rings aside and tilting, in
two equal planes, as complex numbers U = u_0 + i u_1: plane 0 moves along z and tilts about y, plane 1 moves
along y and tilts about z the other way. At the angle phi a ball feels both planes turned, U exp(i phi); balls
that do Re(b exp(i phi_j)) push the rings as Z/2 b does (Coleman and Feingold 1958, for rotor blades).
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import L, P, Q


@kernel
def family_size(family):
    """Return the number of coordinates of the rings in a family."""
    return 3 if family == 0 else L.FAMILY_RINGS


@kernel
def member(family, plane, k):
    """Coordinate ``k`` of a family: inner ring, outer ring, then cage; of each translation before rotation.

    ``plane``: 0 or 1, of family 1; along the axis the inner ring has one coordinate.
    """
    if family == 0:
        if k == 0:
            return Q.X
        base = Q.OUTER if k < family_size(0) else Q.CAGE
        return base + (Q.X if k == 1 or k == family_size(0) else Q.TURN)
    inner = k < 2
    base = Q.INNER if inner else (Q.OUTER if k < L.FAMILY_RINGS else Q.CAGE)
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
def acting(p, family):
    """Sum of the balls' equal shares in what they do to the rings."""
    return p[P.BALLS] if family == 0 else 0.5 * p[P.BALLS]


@kernel
def by_members(x, at, row, column, family, a, b):
    """Complex derivative of coordinate ``a`` by coordinate ``b`` of a family, from real ones ``x[at:]``.

    Entry (i, k) is at ``at + i row + k column``; the mean of both planes.
    """
    i, k = member(family, 0, a), member(family, 0, b)
    if family == 0:
        return complex(x[at + i * row + k * column], 0.0)
    m, n = member(1, 1, a), member(1, 1, b)
    sa, sb = side(1, a), side(1, b)
    along = 0.5 * (x[at + i * row + k * column] + sa * sb * x[at + m * row + n * column])
    across = 0.5 * (sa * x[at + m * row + k * column] - sb * x[at + i * row + n * column])
    return complex(along, across)


@kernel
def add_members(z, x, at, row, column, family, a, b):
    """Add a complex number to real derivatives, in both planes."""
    i, k = member(family, 0, a), member(family, 0, b)
    x[at + i * row + k * column] += z.real
    if family == 0:
        return
    m, n = member(1, 1, a), member(1, 1, b)
    sa, sb = side(1, a), side(1, b)
    x[at + m * row + n * column] += sa * sb * z.real
    x[at + m * row + k * column] += sa * z.imag
    x[at + i * row + n * column] -= sb * z.imag
