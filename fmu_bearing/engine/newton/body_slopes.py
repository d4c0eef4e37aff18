"""The bodies' share of the Jacobian that does not come through the balls: supports, gyroscopes, lands.

The film of a land is differentiated by differences: five evaluations of one formula for a side, against a
page of derivatives.
"""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, J, P, Q, W, Y
from fmu_bearing.engine.mechanics.cage import land_contact

# steps of the differences: small against clearance and surface speeds, large against rounding
_PLACE = 1e-6  # of the clearance
_VELOCITY = 1e-8  # m/s: the film's force bends with it
_RATE = 1e-3  # rad/s


@kernel
def inertia(p, i):
    """Mass or moment of inertia that belongs to body coordinate ``i``."""
    if i < Q.INNER + Q.INNER_BY:
        return p[P.INNER_MASS]
    if i < Q.OUTER:
        return p[P.INNER_TRANSVERSE]
    if i < Q.OUTER + Q.TURN:
        return p[P.OUTER_MASS]
    if i == Q.OUTER + Q.TURN:
        return p[P.OUTER_POLAR]
    if i < Q.CAGE:
        return p[P.OUTER_TRANSVERSE]
    if i < Q.CAGE + Q.TURN:
        return p[P.CAGE_MASS]
    if i == Q.CAGE + Q.TURN:
        return p[P.CAGE_POLAR]
    return p[P.CAGE_TRANSVERSE]


@kernel
def support(p, i, stiffness, damping, jac):
    """Take a spring and a damper of one body coordinate into block E."""
    at = J.E + i * J.BODIES + i
    per = 1.0 / inertia(p, i)
    jac[at] -= stiffness * per
    jac[at + Q.SIZE] -= damping * per


@kernel
def gyroscope(p, by, angular_momentum, jac):
    """Take the gyroscopic moments of a body into block E; ``by``: its tilt about y, before that about z."""
    per = angular_momentum / inertia(p, by)
    jac[J.E + by * J.BODIES + Q.SIZE + by + 1] -= per
    jac[J.E + (by + 1) * J.BODIES + Q.SIZE + by] += per


@kernel
def spin_columns(p, y, turn, polar, jac):
    """Take what a body's own spin changes of its gyroscopic moments into block E."""
    by = turn + 1
    per = polar / inertia(p, by)
    jac[J.E + by * J.BODIES + Q.SIZE + turn] -= per * y[Y.V0 + by + 1]
    jac[J.E + (by + 1) * J.BODIES + Q.SIZE + turn] += per * y[Y.V0 + by]


@kernel
def land_coordinate(axis, k, x):
    """Coordinate of cage or inner ring that moves the cage in its land, and how far per unit.

    ``axis``: along y (0) or z (1); ``k``: translation and tilt of the cage, then of the inner ring; ``x``:
    the land's place (m).
    """
    tilting = k & 1
    sign = 1.0 if k < 2 else -1.0
    lever = sign * ((x if axis == 0 else -x) if tilting else 1.0)
    if tilting == 0:
        return (Q.CAGE if k < 2 else Q.INNER) + Q.Y + axis, lever
    return (Q.CAGE + Q.BZ if k < 2 else Q.INNER + Q.INNER_BZ) - axis, lever


@kernel
def land_column(p, x, axis, rate, dfy, dfz, dturn, jac):
    """Spread the derivatives of a land by the cage's motion in it along ``axis`` over block E."""
    for k in range(4):
        column, by = land_coordinate(axis, k, x)
        column += rate * Q.SIZE
        turn = Q.CAGE + Q.TURN
        jac[J.E + turn * J.BODIES + column] += dturn * by / p[P.CAGE_POLAR]
        for i in range(4):
            row, lever = land_coordinate(0, i, x)
            jac[J.E + row * J.BODIES + column] += dfy * by * lever / inertia(p, row)
            row, lever = land_coordinate(1, i, x)
            jac[J.E + row * J.BODIES + column] += dfz * by * lever / inertia(p, row)


@kernel
def land_slopes(p, c, y, speed, x, jac):
    """Add one land at ``x`` (m) to block E."""
    i = Y.Q0
    k = Y.Q0 + Q.CAGE
    vi = Y.V0
    vk = Y.V0 + Q.CAGE
    sleeve = y[vk + Q.TURN]
    viscosity = c[C.LAND_VISCOSITY]
    dy = y[k + Q.Y] - y[i + Q.Y] + x * (y[k + Q.BZ] - y[i + Q.INNER_BZ])
    dz = y[k + Q.Z] - y[i + Q.Z] - x * (y[k + Q.BY] - y[i + Q.INNER_BY])
    vy = y[vk + Q.Y] - y[vi + Q.Y] + x * (y[vk + Q.BZ] - y[vi + Q.INNER_BZ])
    vz = y[vk + Q.Z] - y[vi + Q.Z] - x * (y[vk + Q.BY] - y[vi + Q.INNER_BY])
    fy, fz, _, turn, _, _ = land_contact(p, viscosity, dy, dz, vy, vz, speed, sleeve)
    for rate in range(2):
        h = _VELOCITY if rate == 1 else _PLACE * p[P.LAND_CLEARANCE]
        near = h if rate == 0 else 0.0
        fast = h if rate == 1 else 0.0
        per = 1.0 / h
        fy1, fz1, _, turn1, _, _ = land_contact(p, viscosity, dy + near, dz, vy + fast, vz, speed, sleeve)
        land_column(p, x, 0, rate, (fy1 - fy) * per, (fz1 - fz) * per, (turn1 - turn) * per, jac)
        fy1, fz1, _, turn1, _, _ = land_contact(p, viscosity, dy, dz + near, vy, vz + fast, speed, sleeve)
        land_column(p, x, 1, rate, (fy1 - fy) * per, (fz1 - fz) * per, (turn1 - turn) * per, jac)
    per = 1.0 / _RATE
    fy1, fz1, _, turn1, _, _ = land_contact(p, viscosity, dy, dz, vy, vz, speed, sleeve + _RATE)
    column = Q.SIZE + Q.CAGE + Q.TURN
    jac[J.E + (Q.CAGE + Q.TURN) * J.BODIES + column] += (turn1 - turn) * per / p[P.CAGE_POLAR]
    for n in range(4):
        row, lever = land_coordinate(0, n, x)
        jac[J.E + row * J.BODIES + column] += (fy1 - fy) * per * lever / inertia(p, row)
        row, lever = land_coordinate(1, n, x)
        jac[J.E + row * J.BODIES + column] += (fz1 - fz) * per * lever / inertia(p, row)


@kernel
def heavy_spot(by, ca, sa, turned, moved_y, moved_z):
    """Return the cage's accelerations (turn, y, z), or their slopes, with the heavy spot from those without.

    ``by``: the eccentricity e (m), and e m over the polar moment (1/m); ``ca``, ``sa``: of the cage's angle.
    """
    eccentric, pull = by
    turned = turned + pull * (ca * moved_y + sa * moved_z)
    return turned, moved_y + eccentric * ca * turned, moved_z + eccentric * sa * turned


@kernel
def cage_unbalance(p, c, y, lanes, w, jac):
    """Put the heavy spot of the cage into its rows of blocks D and E, which are those without it."""
    eccentric = c[C.CAGE_ECCENTRICITY]
    by = (eccentric, eccentric * p[P.CAGE_MASS] / p[P.CAGE_POLAR])
    angle = y[Y.Q0 + Q.CAGE + Q.TURN]
    ca = math.cos(angle)
    sa = math.sin(angle)
    row = J.STATES * STRIDE
    first = J.D + Q.CAGE * row
    for k in range(J.STATES):
        for j in range(0, lanes, FOUR):
            at = first + k * STRIDE + j
            turned, moved_y, moved_z = heavy_spot(
                by, ca, sa, load(jac, at + Q.TURN * row), load(jac, at + Q.Y * row), load(jac, at + Q.Z * row)
            )
            store(jac, at + Q.TURN * row, turned)
            store(jac, at + Q.Y * row, moved_y)
            store(jac, at + Q.Z * row, moved_z)
    first = J.E + Q.CAGE * J.BODIES
    turn = first + Q.TURN * J.BODIES
    for k in range(J.BODIES):
        at = first + k
        turned, moved_y, moved_z = heavy_spot(
            by, ca, sa, jac[turn + k], jac[at + Q.Y * J.BODIES], jac[at + Q.Z * J.BODIES]
        )
        jac[turn + k] = turned
        jac[at + Q.Y * J.BODIES] = moved_y
        jac[at + Q.Z * J.BODIES] = moved_z
    # the spot's own way: its direction by the angle, its pull by the speed
    body = W.F0 + F.BODY + Q.CAGE
    speed = y[Y.V0 + Q.CAGE + Q.TURN]
    ahead = eccentric * w[body + Q.TURN]
    outwards = eccentric * speed * speed
    free_y = w[body + Q.Y] - ca * ahead + sa * outwards
    free_z = w[body + Q.Z] - sa * ahead - ca * outwards
    if p[P.GRAVITY] != 0.0:
        free_z += GRAVITY  # the weight has no lever about the centre of mass
    _, pull = by
    turned = pull * (ca * free_z - sa * free_y)
    at = first + Q.CAGE + Q.TURN
    jac[at + Q.TURN * J.BODIES] += turned
    jac[at + Q.Y * J.BODIES] += ca * (eccentric * turned - outwards) - sa * ahead
    jac[at + Q.Z * J.BODIES] += sa * (eccentric * turned - outwards) + ca * ahead
    at += Q.SIZE
    jac[at + Q.Y * J.BODIES] -= 2.0 * eccentric * speed * sa
    jac[at + Q.Z * J.BODIES] += 2.0 * eccentric * speed * ca


@kernel
def body_slopes(p, c, y, speed, jac):
    """Add to block E what ``bodies.body_equations`` adds to the forces of the balls."""
    gyroscope(p, Q.INNER + Q.INNER_BY, p[P.INNER_POLAR] * speed, jac)
    support(p, Q.INNER + Q.INNER_BY, p[P.TILT_STIFFNESS], p[P.TILT_DAMPING], jac)
    support(p, Q.INNER + Q.INNER_BZ, p[P.TILT_STIFFNESS], p[P.TILT_DAMPING], jac)
    outer = Q.OUTER
    gyroscope(p, outer + Q.BY, p[P.OUTER_POLAR] * y[Y.V0 + outer + Q.TURN], jac)
    spin_columns(p, y, outer + Q.TURN, p[P.OUTER_POLAR], jac)
    support(p, outer, c[C.PEDESTAL_AXIAL], c[C.DAMPING_AXIAL], jac)
    support(p, outer + Q.Y, c[C.PEDESTAL_Y], c[C.DAMPING_Y], jac)
    support(p, outer + Q.Z, c[C.PEDESTAL_Z], c[C.DAMPING_Z], jac)
    for i in (Q.Y, Q.Z):
        across = J.E + (outer + i) * J.BODIES + outer + (Q.Z if i == Q.Y else Q.Y)
        jac[across] -= c[C.PEDESTAL_YZ] / p[P.OUTER_MASS]
        jac[across + Q.SIZE] -= c[C.DAMPING_YZ] / p[P.OUTER_MASS]
    support(p, outer + Q.TURN, c[C.PEDESTAL_ROTATIONAL], c[C.DAMPING_SPIN], jac)
    support(p, outer + Q.BY, c[C.PEDESTAL_ROTATIONAL], c[C.DAMPING_ROTATIONAL], jac)
    support(p, outer + Q.BZ, c[C.PEDESTAL_ROTATIONAL], c[C.DAMPING_ROTATIONAL], jac)
    if p[P.CAGE] != 0.0:
        gyroscope(p, Q.CAGE + Q.BY, p[P.CAGE_POLAR] * y[Y.V0 + Q.CAGE + Q.TURN], jac)
        spin_columns(p, y, Q.CAGE + Q.TURN, p[P.CAGE_POLAR], jac)
        if p[P.LAND] != 0.0:
            land_slopes(p, c, y, speed, p[P.LAND_OFFSET], jac)
            land_slopes(p, c, y, speed, -p[P.LAND_OFFSET], jac)
