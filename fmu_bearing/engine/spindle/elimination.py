"""One bearing of a set in Newton's equations: condensed onto its driven rows, and solved with these given.

With N d = r the bearing's equations (``newton.block_arrow``), S^-1 the inverse of what the balls leave of the
bodies' block and x the bodies' residual less what the balls put on them, the bodies go ``d = S^-1 x``. Driven
rows I go ``T ds`` with the shaft instead, by accelerations a that are found beside the free rows F of d:

    a = R^-1 d_I - R^-1 S^-1_IF x_F,    d_F = S^-1_FI R^-1 d_I + (S^-1_FF - S^-1_FI R^-1 S^-1_IF) x_F

with R = S^-1_II. These four blocks, a sweep of S^-1 over the rows I, take its place in the factors. Columns F
are used before the shaft's equations, which get the forces ``m (x_I + R^-1 S^-1_IF x_F)`` with m the inertia
of the driven rows, and columns I behind them.

Springs between balls reach past S^-1: bearings that they tie are solved step by step. Arguments: see
`members`.
"""

from fmu_bearing.engine.dense import invert
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store, sum_four
from fmu_bearing.engine.layout import FOUR, SP, A, F, P, Q, S, W
from fmu_bearing.engine.newton.block_arrow import (
    back_substitute,
    border_product,
    solve,
    solve_balls,
    turn_pair,
    turn_pairs,
)  # fmt: skip
from fmu_bearing.engine.newton.springs import couple_springs
from fmu_bearing.engine.spindle import members


@kernel
def tied(pb):
    """Whether springs tie the balls together: the border alone is not the bearing's compliance then."""
    return (pb[P.SPRINGS] != 0.0) & (pb[P.CAGE] == 0.0)


@kernel
def driven_compliance(p, b, pb, sb, wb, ws, at):
    """Put R, the driven rows and columns of N^-1, of bearing ``b`` to ``ws[at:]``, by rows."""
    r = members.row(p, b)
    count = int(p[r + SP.ROW_DRIVEN])
    fac = sb[S.FAC : S.CONDENSED]
    d = wb[W.F : W.F + F.SIZE]
    for k in range(count):
        if tied(pb):
            for i in range(F.SIZE):
                d[i] = 0.0
            d[F.BODY + k] = 1.0
            solve(pb, fac, 1.0, 0.0, d, wb)
        for i in range(count):
            ws[at + i * count + k] = d[F.BODY + i] if tied(pb) else fac[A.S + k * A.BORDER + i]


@kernel
def condense_bearing(p, s, w, b):
    """Condense the factored bearing ``b`` of the state onto its driven rows; False if singular."""
    if not members.has_shaft(p):
        return True
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    pb = members.parameters(p, b)
    sb = members.state(p, s, b)
    wb = members.work(p, w, b)
    count = int(p[members.row(p, b) + SP.ROW_DRIVEN])
    driven_compliance(p, b, pb, sb, wb, wb, W.F0)
    spare = members.matrix(p)
    if not invert(wb, W.F0, count, ws, spare):
        return False
    keep_columns(ws, spare, count, SP.LANES, own, members.per_bearing(p, b) + SP.SCHUR)
    if not tied(pb):
        sweep(sb[S.FAC : S.CONDENSED], count, own, members.per_bearing(p, b) + SP.SCHUR, ws, spare)
    return True


@kernel
def sweep(fac, count, own, schur, ws, at):
    """Sweep S^-1 in a bearing's factors over its ``count`` driven rows; R^-1 is at ``own[schur:]``.

    ``ws[at:]``: scratch of ``SP.LANES`` numbers.
    """
    for h in range(count, Q.SIZE):
        column = A.S + h * A.BORDER
        for i in range(SP.LANES):
            ws[at + i] = 0.0
        members.add_columns(own, schur, SP.LANES, count, 1.0, fac, column, ws, at)
        for i in range(count):
            fac[column + i] = ws[at + i]
            for g in range(count, Q.SIZE):
                fac[column + g] -= fac[A.S + i * A.BORDER + g] * ws[at + i]
    for g in range(count, Q.SIZE):
        for i in range(count):
            ws[at + i] = fac[A.S + i * A.BORDER + g]
        for k in range(count):
            total = 0.0
            for i in range(count):
                total += ws[at + i] * own[schur + k * SP.LANES + i]
            fac[A.S + k * A.BORDER + g] = total
    for k in range(count):
        for i in range(count):
            fac[A.S + k * A.BORDER + i] = own[schur + k * SP.LANES + i]


@kernel
def keep_columns(x, at, count, lanes, out, to):
    """Copy a square matrix, row by row at ``x[at:]``, into columns of ``lanes`` numbers at ``out[to:]``."""
    for k in range(count):
        for i in range(lanes):
            out[to + k * lanes + i] = x[at + i * count + k] if i < count else 0.0


@kernel
def turn_driven(count, x, at, c, s):
    """Turn the y, z pairs of ``count`` driven rows at ``x[at:]`` by the angle of cosine ``c``, sine ``s``."""
    turn_pair(x, at + Q.Y, c, s)
    turn_pair(x, at + Q.INNER_BY, c, s)
    if count > Q.OUTER:
        turn_pair(x, at + Q.OUTER + Q.Y, c, s)
        turn_pair(x, at + Q.OUTER + Q.BY, c, s)


@kernel
def put_border(m, at, count, x, first, out, to):
    """Put to ``out[to:]`` ``M x[first:]``, M by ``count`` columns of ``A.BORDER`` numbers at ``m[at:]``.

    All five groups of lanes go together, so that no sum waits for another.
    """
    a = splat(0.0)
    b = splat(0.0)
    c = splat(0.0)
    d = splat(0.0)
    e = splat(0.0)
    for k in range(count):
        column = at + k * A.BORDER
        value = x[first + k]
        a += load(m, column) * value
        b += load(m, column + FOUR) * value
        c += load(m, column + 2 * FOUR) * value
        d += load(m, column + 3 * FOUR) * value
        e += load(m, column + 4 * FOUR) * value
    store(out, to, a)
    store(out, to + FOUR, b)
    store(out, to + 2 * FOUR, c)
    store(out, to + 3 * FOUR, d)
    store(out, to + 4 * FOUR, e)


@kernel
def condense_residual(p, b, pb, sb, wb, own, ws):
    """Add the forces of bearing ``b`` to the shaft's residual, its driven rows where the shaft has them.

    ``W.D`` of ``wb`` holds the bearing's residual.
    """
    if tied(pb):
        condense_residual_tied(p, b, pb, sb, wb, own, ws)
        return
    r = members.row(p, b)
    count = int(p[r + SP.ROW_DRIVEN])
    at = members.scratch(p, b)
    c = ws[at + SP.TURNED]
    s = ws[at + SP.TURNED + 1]
    d = wb[W.D : W.D + F.SIZE]
    fac = sb[S.FAC : S.CONDENSED]
    turn_pairs(d, F.BODY, c, -s)
    solve_balls(fac, int(pb[P.LANES]), d, wb)
    for g in range(Q.SIZE):
        wb[W.REST + g] = d[F.BODY + g] - sum_four(load(wb, W.BODY_SUMS + g * FOUR))
    put_border(fac, A.S + count * A.BORDER, Q.SIZE - count, wb, W.REST + count, wb, W.BODIES)
    for i in range(SP.LANES):
        ws[at + i] = wb[W.REST + i] + wb[W.BODIES + i] if i < count else 0.0
    turn_driven(count, ws, at, c, s)
    for i in range(count):
        ws[at + i] *= p[r + SP.ROW_MASS + i]
    members.project_forces(p, b, ws, at, ws, members.vector(p, SP.RESIDUAL))


@kernel
def solve_driven(p, b, pb, sb, wb, own, ws):
    """Solve bearing ``b`` with its driven rows following the shaft; the increment ends in ``W.D``."""
    if tied(pb):
        solve_driven_tied(p, b, pb, sb, wb, own, ws)
        return
    count = int(p[members.row(p, b) + SP.ROW_DRIVEN])
    at = members.scratch(p, b)
    c = ws[at + SP.TURNED]
    s = ws[at + SP.TURNED + 1]
    d = wb[W.D : W.D + F.SIZE]
    fac = sb[S.FAC : S.CONDENSED]
    members.driven_motion(p, b, ws, members.vector(p, SP.INCREMENT), ws, at)
    turn_driven(count, ws, at, c, -s)
    put_border(fac, A.S, count, ws, at, wb, W.REST)
    for g in range(count):
        d[F.BODY + g] = ws[at + g]
    for g in range(count, Q.SIZE):
        d[F.BODY + g] = wb[W.BODIES + g] + wb[W.REST + g]
    back_substitute(fac, int(pb[P.LANES]), d, wb)
    turn_pairs(d, F.BODY, c, s)


@kernel
def find_drive(p, b, pb, wb, ws):
    """Put to ``ws[at + SP.LANES:]`` what drove the rows of bearing ``b`` in `solve_driven` (m/s2, rad/s2).

    In axes that turn with the Jacobian: a beyond their residual as free rows.
    """
    if tied(pb):
        return  # found on the way
    at = members.scratch(p, b) + SP.LANES
    for i in range(int(p[members.row(p, b) + SP.ROW_DRIVEN])):
        balls = sum_four(load(wb, W.BODY_SUMS + i * FOUR))
        ws[at + i] = wb[W.REST + i] - wb[W.BODIES + i] + balls


@kernel
def condense_residual_tied(p, b, pb, sb, wb, own, ws):
    """Do `condense_residual` for balls that springs tie together.

    ``W.D`` of ``wb`` ends turned back and zero in driven rows. The answers there with these rows free, d0,
    stay in the scratch.
    """
    r = members.row(p, b)
    count = int(p[r + SP.ROW_DRIVEN])
    at = members.scratch(p, b)
    to = at + SP.LANES
    d = wb[W.D : W.D + F.SIZE]
    fac = sb[S.FAC : S.CONDENSED]
    c = ws[at + SP.TURNED]
    s = ws[at + SP.TURNED + 1]
    for i in range(count):
        ws[at + 2 * SP.LANES + i] = p[r + SP.ROW_MASS + i] * d[F.BODY + i]
        d[F.BODY + i] = 0.0
    turn_pairs(d, F.BODY, c, -s)
    solve_balls(fac, int(pb[P.LANES]), d, wb)
    for g in range(Q.SIZE):
        wb[W.REST + g] = d[F.BODY + g] - sum_four(load(wb, W.BODY_SUMS + g * FOUR))
    border_product(fac, wb, d)
    couple_springs(pb, fac, d, wb)
    for i in range(count):
        ws[at + i] = d[F.BODY + i]
    # m R^-1 d0 in fixed axes, with m r_I
    for i in range(SP.LANES):
        ws[to + i] = 0.0
    schur = members.per_bearing(p, b) + SP.SCHUR
    members.add_columns(own, schur, SP.LANES, count, 1.0, ws, at, ws, to)
    turn_driven(count, ws, to, c, s)
    for i in range(count):
        ws[to + i] = p[r + SP.ROW_MASS + i] * ws[to + i] + ws[at + 2 * SP.LANES + i]
    members.project_forces(p, b, ws, to, ws, members.vector(p, SP.RESIDUAL))


@kernel
def solve_driven_tied(p, b, pb, sb, wb, own, ws):
    """Do `solve_driven` for balls that springs tie together.

    R^-1 (T ds - d0), the accelerations that drive the rows, stays in the scratch at ``SP.LANES``.
    """
    r = members.row(p, b)
    count = int(p[r + SP.ROW_DRIVEN])
    at = members.scratch(p, b)
    driving = at + SP.LANES
    to = at + 2 * SP.LANES
    d = wb[W.D : W.D + F.SIZE]
    fac = sb[S.FAC : S.CONDENSED]
    c = ws[at + SP.TURNED]
    s = ws[at + SP.TURNED + 1]
    lanes = int(pb[P.LANES])
    members.driven_motion(p, b, ws, members.vector(p, SP.INCREMENT), ws, to)
    turn_driven(count, ws, to, c, -s)
    for i in range(SP.LANES):
        ws[driving + i] = 0.0
    for i in range(count):
        ws[to + i] -= ws[at + i]
    schur = members.per_bearing(p, b) + SP.SCHUR
    members.add_columns(own, schur, SP.LANES, count, 1.0, ws, to, ws, driving)
    for i in range(count):
        wb[W.REST + i] += ws[driving + i]
    border_product(fac, wb, d)
    solve_balls(fac, lanes, d, wb)
    couple_springs(pb, fac, d, wb)
    back_substitute(fac, lanes, d, wb)
    turn_pairs(d, F.BODY, c, s)
