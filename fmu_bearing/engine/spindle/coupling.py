"""Newton's equations of a set: each bearing condensed onto its driven rows, the shaft's equations, and back.

The bearings' forces on the shaft come from `elimination`. With R the driven rows and columns of the inverse
of a bearing's equations, and m the inertia of these rows, the shaft has ``A ds = r_s + forces``, A its own
matrix with sum T^T m R^-1 T.

Jacobians belong to the angles at which they were made; each bearing's residual is turned back by its orbit
angle since, the shaft's by the first bearing's. Arguments: see `members`.
"""

import math

from fmu_bearing.engine.dense import invert
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, P, Q, S, Y
from fmu_bearing.engine.newton.block_arrow import turn_pair
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.elimination import (
    condense_residual,
    keep_columns,
    solve_driven,
    turn_driven,
)  # fmt: skip
from fmu_bearing.engine.spindle.port import clear, fix_rows, has_port
from fmu_bearing.engine.spindle.shaft import has_housing, pedestal_force


@kernel
def pedestal_matrix(p, own, stiffness, scale, ws, at, width, spare):
    """Add ``scale`` times the pedestal's matrix to the housing's, at ``ws[at:]`` in rows of ``width``.

    ``stiffness``: place in the set's own state; ``spare``: twelve numbers of scratch.
    """
    force = spare + SP.HOUSING
    for k in range(SP.HOUSING):
        for i in range(2 * SP.HOUSING):
            ws[spare + i] = 0.0
        ws[spare + k] = 1.0
        pedestal_force(p, own, stiffness, ws, spare, scale, ws, force)
        for i in range(SP.HOUSING):
            ws[at + i * width + k] += ws[force + i]


@kernel
def shaft_matrix(p, own, ws, speed, by_mass, by_rate, by_place, at):
    """Put the weighted sum of mass, damping with gyroscopic moments, and stiffness to ``ws[at:]``, by rows.

    Of shaft, housing with its pedestal, and springs at sliding rings; ``speed``: rad/s.
    """
    n = members.coordinates(p)
    if not members.has_shaft(p):
        for i in range(n * n):
            ws[at + i] = 0.0
        return
    lanes = members.padded_size(p)
    mass = members.table(p, SP.AT_MASS)
    damping = members.table(p, SP.AT_DAMPING)
    gyroscopic = members.table(p, SP.AT_GYROSCOPIC)
    stiffness = members.table(p, SP.AT_STIFFNESS)
    for i in range(n):
        for k in range(n):
            m = k * lanes + i
            rates = p[damping + m] + speed * p[gyroscopic + m]
            ws[at + i * n + k] = by_mass * p[mass + m] + by_rate * rates + by_place * p[stiffness + m]
    if has_housing(p):
        h = int(p[int(p[P.SET]) + SP.SHAFT])
        spare = members.scratch(p, 0)
        pedestal_matrix(p, own, SP.PEDESTAL_STIFFNESS, by_place, ws, at + h * n + h, n, spare)
        pedestal_matrix(p, own, SP.PEDESTAL_DAMPING, by_rate, ws, at + h * n + h, n, spare)


@kernel
def add_driven(p, b, x, first, row, column, out, to):
    """Add ``T^T m X T`` of bearing ``b`` to the coordinates' matrix at ``out[to:]``, by rows.

    X: of the driven rows, entry (i, j) at ``x[first + i row + j column]``; m: their inertia.
    """
    n = members.coordinates(p)
    if not members.has_shaft(p):
        for i in range(n):
            for k in range(n):
                out[to + i * n + k] += x[first + i * row + k * column]
        return
    r = members.row(p, b)
    t = int(p[r + SP.ROW_AT_T])
    count = int(p[r + SP.ROW_DRIVEN])
    columns = int(p[r + SP.ROW_AT_COLUMNS])
    moving = int(p[r + SP.ROW_COLUMNS])  # coordinates: the others do not move this bearing
    for i in range(count):
        for one in range(moving):
            k = int(p[columns + one])
            # row i of m X T
            total = 0.0
            for j in range(count):
                total += x[first + i * row + j * column] * p[t + k * SP.LANES + j]
            total *= p[r + SP.ROW_MASS + i]
            for other in range(moving):
                h = int(p[columns + other])
                out[to + h * n + k] += p[t + h * SP.LANES + i] * total


@kernel
def turned_rows(x, at, count, c, s, out, to):
    """Put the matrix of ``count`` driven rows, columns of ``SP.LANES`` at ``x[at:]``, turned to ``out[to:]``.

    Row by row; ``c``, ``s``: cosine and sine of the angle.
    """
    for k in range(count):
        for i in range(count):
            out[to + k * count + i] = x[at + k * SP.LANES + i]
        turn_driven(count, out, to + k * count, c, s)
    for i in range(count):
        for k in range(i):
            one = to + i * count + k
            other = to + k * count + i
            kept = out[one]
            out[one] = out[other]
            out[other] = kept
    for i in range(count):
        turn_driven(count, out, to + i * count, c, s)


@kernel
def condense_set(p, s, w, gh):
    """Condense the bearings, each condensed already, onto the coordinates.

    ``gh``: weight of rates in the stages, s; that of places is its square. The matrix goes to the set's work
    space, row by row. It belongs to the first bearing's orbit angle at its Jacobian: the others' are turned
    by as much as they have turned less since their own.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    at = members.matrix(p)
    shaft_matrix(p, own, ws, s[S.SPEED], 1.0, gh, gh * gh, at)
    spare = at + n * n
    first = orbited(s)
    for b in range(members.bearing_count(p)):
        count = int(p[members.row(p, b) + SP.ROW_DRIVEN])
        angle = orbited(members.state(p, s, b)) - first
        schur = members.per_bearing(p, b) + SP.SCHUR
        turned_rows(own, schur, count, math.cos(angle), math.sin(angle), ws, spare)
        add_driven(p, b, ws, spare, count, 1, ws, at)


@kernel
def factor_set(p, s, w, gh):
    """Invert the shaft's matrix with all bearings condensed onto it; False if singular."""
    if not members.has_shaft(p):
        return True
    condense_set(p, s, w, gh)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    if has_port(p):
        fix_rows(ws, members.matrix(p), SP.PLANE, n, n)
    return invert_set(p, members.set_state(p, s), ws)


@kernel
def invert_set(p, own, ws):
    """Invert the coordinates' matrix in the work space into the set's own state; False if singular."""
    n = members.coordinates(p)
    at = members.matrix(p)
    if not invert(ws, at, n, ws, at + n * n):
        return False
    keep_columns(ws, at + n * n, n, members.padded_size(p), own, members.inverse(p))
    return True


@kernel
def orbited(sb):
    """Orbit angle (rad) of a bearing since its Jacobian."""
    return sb[S.Y + Y.TH] - sb[S.JACOBIAN_ANGLE]


@kernel
def turned(sb, t):
    """Cosine and sine of a bearing's orbit angle since its Jacobian, ``t`` (s) into the step."""
    angle = orbited(sb) + sb[S.Y + Y.OM] * t
    return math.cos(angle), math.sin(angle)


@kernel
def turn_since(p, s, w, t):
    """Store cosine and sine of the bearings' orbit angles since their Jacobians, ``t`` (s) into the step."""
    ws = members.set_work(p, w)
    for b in range(members.bearing_count(p)):
        at = members.scratch(p, b) + SP.TURNED
        ws[at], ws[at + 1] = turned(members.state(p, s, b), t)


@kernel
def turn_coordinates(p, x, at, c, s):
    """Turn all pairs of the shaft's and the housing's coordinates: y and z alternate behind X."""
    h = int(p[int(p[P.SET]) + SP.SHAFT])
    for i in range(1, h, 2):
        turn_pair(x, at + i, c, s)
    if has_housing(p):
        turn_pair(x, at + h + Q.Y, c, s)
        turn_pair(x, at + h + Q.BY, c, s)


@kernel
def solve_shaft(p, own, ws):
    """Solve the shaft's equations for its increment, in axes that turn with the first bearing."""
    lanes = members.padded_size(p)
    residual = members.vector(p, SP.RESIDUAL)
    increment = members.vector(p, SP.INCREMENT)
    c = ws[members.scratch(p, 0) + SP.TURNED]
    s = ws[members.scratch(p, 0) + SP.TURNED + 1]
    if has_port(p):
        clear(ws, residual, SP.PLANE)
    turn_coordinates(p, ws, residual, c, -s)
    for i in range(lanes):
        ws[increment + i] = 0.0
    at = members.inverse(p)
    members.add_columns(own, at, lanes, members.coordinates(p), 1.0, ws, residual, ws, increment)
    turn_coordinates(p, ws, increment, c, s)


@kernel
def solve_set(p, s, w):
    """Solve Newton's equations in place; `turn_since` has stored the orbit angles.

    Residuals: ``W.D`` of each bearing's work space (accelerations, driven rows as if free) and
    ``SP.RESIDUAL`` of the set's (N, N m). Increments: the same, and ``SP.INCREMENT``.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        condense_residual(p, b, pb, members.state(p, s, b), members.work(p, w, b), own, ws)
    solve_shaft(p, own, ws)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        solve_driven(p, b, pb, members.state(p, s, b), members.work(p, w, b), own, ws)
