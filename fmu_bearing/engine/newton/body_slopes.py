"""The bodies' share of the Jacobian that does not come through the balls: supports, gyroscopes, lands.

The film of a land is differentiated by differences: five or six evaluations of one formula for a side,
against a page of derivatives.
"""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, J, P, Q, W, Y
from fmu_bearing.engine.mechanics.bodies import cage_at_land, guiding_ring, ring_spin
from fmu_bearing.engine.mechanics.cage import guiding_land
from fmu_bearing.engine.mechanics.seals import seal_slope

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
def land_coordinate(axis, k, x, ring, tilt):
    """Coordinate of cage or ring that moves the cage in its land, and how far per unit.

    ``axis``: along y (0) or z (1); ``k``: translation and tilt of the cage, then of the ring; ``x``: the
    land's place (m); ``ring``, ``tilt``: see `guiding_ring`.
    """
    tilting = k & 1
    sign = 1.0 if k < 2 else -1.0
    lever = sign * ((x if axis == 0 else -x) if tilting else 1.0)
    if tilting == 0:
        return (Q.CAGE if k < 2 else ring) + Q.Y + axis, lever
    return (Q.CAGE + Q.BZ if k < 2 else tilt + 1) - axis, lever


@kernel
def land_rows(p, column, by, x, ring, tilt, change, jac):
    """Spread the ``change`` of a land's forces and torques, times ``by``, over one column of block E.

    ``change``: of the force on the cage in y and z and of the torques on ring and cage; the inner ring's own
    rotation is an input, and its torque belongs to no row.
    """
    dfy, dfz, dring, dcage = change
    turn = Q.CAGE + Q.TURN
    jac[J.E + turn * J.BODIES + column] += dcage * by / p[P.CAGE_POLAR]
    if ring == Q.OUTER:
        turn = Q.OUTER + Q.TURN
        jac[J.E + turn * J.BODIES + column] += dring * by / p[P.OUTER_POLAR]
    for i in range(4):
        row, lever = land_coordinate(0, i, x, ring, tilt)
        jac[J.E + row * J.BODIES + column] += dfy * by * lever / inertia(p, row)
        row, lever = land_coordinate(1, i, x, ring, tilt)
        jac[J.E + row * J.BODIES + column] += dfz * by * lever / inertia(p, row)


@kernel
def land_columns(p, x, ring, tilt, axis, rate, change, jac):
    """Spread the derivatives of a land by the cage's motion in it along ``axis`` over block E."""
    for k in range(4):
        column, by = land_coordinate(axis, k, x, ring, tilt)
        land_rows(p, column + rate * Q.SIZE, by, x, ring, tilt, change, jac)


@kernel
def land_slope(p, gap, before, motion, spins, per):
    """By how much forces and torques of a land differ from those ``before``, times ``per``: see `land_rows`.

    ``gap``: see `land_contact`; ``motion``: place and velocity of the cage in its land; ``spins``: of ring
    and cage.
    """
    fy0, fz0, ring0, cage0, _, _ = before
    dy, dz, vy, vz = motion
    ring, cage = spins
    fy, fz, on_ring, on_cage, _, _ = guiding_land(p, gap, dy, dz, vy, vz, ring, cage)
    return (fy - fy0) * per, (fz - fz0) * per, (on_ring - ring0) * per, (on_cage - cage0) * per


@kernel
def land_slopes(p, c, y, speed, x, jac):
    """Add one land at ``x`` (m) to block E."""
    ring, tilt = guiding_ring(p)
    spin = ring_spin(ring, y, speed)
    cage = y[Y.V0 + Q.CAGE + Q.TURN]
    gap = (c[C.LAND_VISCOSITY], c[C.LAND_CLEARANCE])
    dy, dz, vy, vz = cage_at_land(y, x, ring, tilt)
    before = guiding_land(p, gap, dy, dz, vy, vz, spin, cage)
    for rate in range(2):
        h = _VELOCITY if rate == 1 else _PLACE * c[C.LAND_CLEARANCE]
        near = h if rate == 0 else 0.0
        fast = h if rate == 1 else 0.0
        per = 1.0 / h
        change = land_slope(p, gap, before, (dy + near, dz, vy + fast, vz), (spin, cage), per)
        land_columns(p, x, ring, tilt, 0, rate, change, jac)
        change = land_slope(p, gap, before, (dy, dz + near, vy, vz + fast), (spin, cage), per)
        land_columns(p, x, ring, tilt, 1, rate, change, jac)
    change = land_slope(p, gap, before, (dy, dz, vy, vz), (spin, cage + _RATE), 1.0 / _RATE)
    land_rows(p, Q.SIZE + Q.CAGE + Q.TURN, 1.0, x, ring, tilt, change, jac)
    if ring == Q.OUTER:
        change = land_slope(p, gap, before, (dy, dz, vy, vz), (spin + _RATE, cage), 1.0 / _RATE)
        land_rows(p, Q.SIZE + Q.OUTER + Q.TURN, 1.0, x, ring, tilt, change, jac)


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
    for i in range(Q.OUTER):
        support(p, Q.INNER + i, p[P.SUPPORT_STIFFNESS + i], p[P.SUPPORT_DAMPING + i], jac)
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
    if p[P.SEAL_TORQUE] != 0.0:
        support(p, outer + Q.TURN, 0.0, seal_slope(p, speed - y[Y.V0 + outer + Q.TURN]), jac)
    support(p, outer + Q.BY, c[C.PEDESTAL_ROTATIONAL], c[C.DAMPING_ROTATIONAL], jac)
    support(p, outer + Q.BZ, c[C.PEDESTAL_ROTATIONAL], c[C.DAMPING_ROTATIONAL], jac)
    if p[P.CAGE] != 0.0:
        gyroscope(p, Q.CAGE + Q.BY, p[P.CAGE_POLAR] * y[Y.V0 + Q.CAGE + Q.TURN], jac)
        spin_columns(p, y, Q.CAGE + Q.TURN, p[P.CAGE_POLAR], jac)
        if p[P.LAND] != 0.0:
            land_slopes(p, c, y, speed, p[P.LAND_OFFSET], jac)
            land_slopes(p, c, y, speed, -p[P.LAND_OFFSET], jac)
