"""Shaft and housing: loads, unbalance, springs, dampers, energy. Arguments: see `members`."""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, P, Q
from fmu_bearing.engine.spindle import members


@kernel
def has_housing(p):
    """Whether the housing moves."""
    return p[int(p[P.SET]) + SP.HOUSED] != 0.0


@kernel
def weighs(p):
    """Whether weight counts: a choice of the scene, as such read from the first bearing's parameters."""
    return p[P.GRAVITY] != 0.0


@kernel
def pedestal_force(p, stiffness, at, x, first, scale, out, to):
    """Add to ``out[to:]`` the pedestal's matrix times ``scale`` and the housing's motion ``x[first:]``.

    Six numbers each. ``stiffness[at:]``: ``SP.PEDESTAL_TERMS`` numbers, stiffness or damping along x y z,
    about x y z, between y and z, in the pedestal's plane; motion and forces at X = 0.
    """
    lever = p[int(p[P.SET]) + SP.HOUSING_X]
    y = x[first + Q.Y] + lever * x[first + Q.BZ]
    z = x[first + Q.Z] - lever * x[first + Q.BY]
    between = scale * stiffness[at + SP.BETWEEN]
    across = scale * stiffness[at + Q.Y] * y + between * z
    upward = scale * stiffness[at + Q.Z] * z + between * y
    out[to] += scale * stiffness[at] * x[first]
    out[to + Q.Y] += across
    out[to + Q.Z] += upward
    out[to + Q.TURN] += scale * stiffness[at + Q.TURN] * x[first + Q.TURN]
    out[to + Q.BY] += scale * stiffness[at + Q.BY] * x[first + Q.BY] - lever * upward
    out[to + Q.BZ] += scale * stiffness[at + Q.BZ] * x[first + Q.BZ] + lever * across


@kernel
def along(x, at, y, to, count):
    """Sum of products of ``count`` numbers ``x[at:]`` and ``y[to:]``."""
    total = 0.0
    for i in range(count):
        total += x[at + i] * y[to + i]
    return total


@kernel
def twice_energy(p, at, x, first):
    """``x M x`` for the coordinates ``x[first:]`` and their matrix at ``p[at:]``."""
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    total = 0.0
    for k in range(n):
        total += x[first + k] * along(p, at + k * lanes, x, first, n)
    return total


@kernel
def unbalance(p, i):
    """Force of the unbalance on coordinate ``i`` over squared speed: at angle zero, and a quarter turn on.

    Of heavy spots, and of the eccentricity in `[imperfections]`, by the scale of these.
    """
    lanes = members.padded_size(p)
    at = members.table(p, SP.AT_UNBALANCE) + i
    eccentric = at + 2 * lanes
    scale = p[P.IMPERFECTION_SCALE]
    return p[at] + scale * p[eccentric], p[at + lanes] + scale * p[eccentric + lanes]


@kernel
def unbalance_force(p, angle, speed, rate, out, to):
    """Add the force of the unbalance to ``out[to:]``; ``rate``: of the speed (rad/s2)."""
    if p[int(p[P.SET]) + SP.UNBALANCED] == 0.0:
        return
    co = math.cos(angle)
    si = math.sin(angle)
    square = speed * speed
    for i in range(members.padded_size(p)):
        first, second = unbalance(p, i)
        along_it = co * first + si * second
        ahead = co * second - si * first
        out[to + i] += square * along_it - rate * ahead


@kernel
def static_load(p, own):
    """Turn loads on the nose and of springs into forces on the coordinates."""
    lanes = members.padded_size(p)
    nose = members.table(p, SP.AT_NOSE)
    springs = members.table(p, SP.AT_SPRINGS)
    to = SP.S_HEAD + SP.STATIC_LOAD * lanes
    for k in range(lanes):
        own[to + k] = -own[SP.SPRING] * p[springs + k]
        for i in range(SP.PLANE):
            own[to + k] += p[nose + i * lanes + k] * own[SP.NOSE + i]


@kernel
def shaft_forces(p, own, x, q, v, angle, speed, rate, out, to):
    """Put the forces on shaft and housing, without their bearings', to ``out[to:]``.

    Places and rates of the coordinates: ``x[q:]`` and ``x[v:]``. Returns power in (W), and the heats of the
    bending shaft and of the pedestal (W).
    """
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    if not members.has_shaft(p):
        for i in range(lanes):
            out[to + i] = 0.0
        return 0.0, 0.0, 0.0
    static = SP.S_HEAD + SP.STATIC_LOAD * lanes
    for i in range(lanes):
        out[to + i] = own[static + i]
    unbalance_force(p, angle, speed, rate, out, to)
    power = along(out, to, x, v, n)
    if weighs(p):
        heavy = members.table(p, SP.AT_HEAVY)
        for i in range(lanes):
            out[to + i] -= GRAVITY * p[heavy + i]
    members.add_product(p, members.table(p, SP.AT_GYROSCOPIC), -speed, x, v, out, to)
    bent = 0.0
    if p[int(p[P.SET]) + SP.SPRUNG] != 0.0:
        members.add_product(p, members.table(p, SP.AT_STIFFNESS), -1.0, x, q, out, to)
        before = along(out, to, x, v, n)
        members.add_product(p, members.table(p, SP.AT_DAMPING), -1.0, x, v, out, to)
        bent = before - along(out, to, x, v, n)
    shaken = 0.0
    if has_housing(p):
        h = int(p[int(p[P.SET]) + SP.SHAFT])
        pedestal_force(p, own, SP.PEDESTAL_STIFFNESS, x, q + h, -1.0, out, to + h)
        before = along(out, to + h, x, v + h, SP.HOUSING)
        pedestal_force(p, own, SP.PEDESTAL_DAMPING, x, v + h, -1.0, out, to + h)
        shaken = before - along(out, to + h, x, v + h, SP.HOUSING)
    return power, bent, shaken


@kernel
def shaft_energy(p, own, x, q, v, w, at):
    """Return the stored energy (J) of shaft and housing without driven rings.

    Places and rates: ``x[q:]`` and ``x[v:]``; ``w[at:]``: scratch of ``SP.HOUSING`` numbers.
    """
    total = 0.5 * twice_energy(p, members.table(p, SP.AT_MASS), x, v)
    if p[int(p[P.SET]) + SP.SPRUNG] != 0.0:
        total += 0.5 * twice_energy(p, members.table(p, SP.AT_STIFFNESS), x, q)
    if weighs(p):
        total += GRAVITY * along(p, members.table(p, SP.AT_HEAVY), x, q, members.coordinates(p))
    if has_housing(p):
        h = int(p[int(p[P.SET]) + SP.SHAFT])
        for i in range(SP.HOUSING):
            w[at + i] = 0.0
        pedestal_force(p, own, SP.PEDESTAL_STIFFNESS, x, q + h, 1.0, w, at)
        total += 0.5 * along(w, at, x, q + h, SP.HOUSING)
    return total
