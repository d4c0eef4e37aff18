"""Rings and cage: forces that do not come through the balls, and the equations of the bodies."""

import math

from fmu_bearing.engine.choices import OUTER_GUIDED
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, F, P, Q, W, Y
from fmu_bearing.engine.mechanics.cage import guiding_land
from fmu_bearing.engine.mechanics.seals import seal_friction


@kernel
def guiding_ring(p):
    """First coordinate of the ring that guides the cage, and that of its tilts.

    The inner ring for a cage that the balls guide: it has no land.
    """
    if p[P.GUIDANCE] == OUTER_GUIDED:
        return Q.OUTER, Q.OUTER + Q.BY
    return Q.INNER, Q.INNER + Q.INNER_BY


@kernel
def ring_spin(ring, y, speed):
    """Spin (rad/s) of the ring that guides the cage; ``speed``: of the inner one."""
    return y[Y.V0 + Q.OUTER + Q.TURN] if ring == Q.OUTER else speed


@kernel
def cage_at_land(y, x, ring, tilt):
    """Place (m) and velocity (m/s) in y and z of the cage, at ``x`` (m) of its axis, against its ring.

    ``ring``, ``tilt``: see `guiding_ring`.
    """
    k = Y.Q0 + Q.CAGE
    vk = Y.V0 + Q.CAGE
    i = Y.Q0 + ring
    vi = Y.V0 + ring
    return (
        y[k + Q.Y] - y[i + Q.Y] + x * (y[k + Q.BZ] - y[Y.Q0 + tilt + 1]),
        y[k + Q.Z] - y[i + Q.Z] - x * (y[k + Q.BY] - y[Y.Q0 + tilt]),
        y[vk + Q.Y] - y[vi + Q.Y] + x * (y[vk + Q.BZ] - y[Y.V0 + tilt + 1]),
        y[vk + Q.Z] - y[vi + Q.Z] - x * (y[vk + Q.BY] - y[Y.V0 + tilt]),
    )


@kernel
def land_forces(p, c, y, speed, f, w):
    """Add both lands' forces to the body rows of ``f``, their loss to the oil, their energy to ``w``."""
    ring, tilt = guiding_ring(p)
    spin = ring_spin(ring, y, speed)
    gi = F.BODY + ring
    gt = F.BODY + tilt
    gk = F.BODY + Q.CAGE
    gap = (c[C.LAND_VISCOSITY], c[C.LAND_CLEARANCE])
    w[W.LANDS_ENERGY] = 0.0
    for side in range(2):
        x = p[P.LAND_OFFSET] if side == 0 else -p[P.LAND_OFFSET]
        dy, dz, vy, vz = cage_at_land(y, x, ring, tilt)
        fy, fz, on_ring, on_cage, stored, lost = guiding_land(
            p, gap, dy, dz, vy, vz, spin, y[Y.V0 + Q.CAGE + Q.TURN]
        )
        f[gk + Q.Y] += fy
        f[gk + Q.Z] += fz
        f[gk + Q.TURN] += on_cage
        f[gk + Q.BY] -= x * fz
        f[gk + Q.BZ] += x * fy
        f[gi + Q.Y] -= fy
        f[gi + Q.Z] -= fz
        f[gt] += x * fz
        f[gt + 1] -= x * fy
        if ring == Q.OUTER:
            f[gi + Q.TURN] += on_ring
        else:
            f[F.TORQUE] -= on_ring
        f[F.HEAT_OIL] += lost
        w[W.LANDS_ENERGY] += stored


@kernel
def supported(p, c, y, i, force):
    """Return ``force`` (N, N m) with what springs and dampers to ground put on row ``i`` of the inner ring.

    Springs along y and z are free where those of the pedestal are.
    """
    away = y[Y.Q0 + i]
    if i == Q.Y:
        away -= c[C.NEUTRAL_Y]
    elif i == Q.Z:
        away -= c[C.NEUTRAL_Z]
    return force - p[P.SUPPORT_STIFFNESS + i] * away - p[P.SUPPORT_DAMPING + i] * y[Y.V0 + i]


@kernel
def inner_ring(p, c, y, angle, speed, speed_rate, f):
    """Preload, loads, weight, unbalance, springs to ground and gyroscopic moments of inner ring and rotor."""
    g = F.BODY
    v = Y.V0
    for i in range(Q.INNER_BY):
        f[g + i] += supported(p, c, y, i, 0.0)
    mass = p[P.INNER_MASS]
    eccentric = mass * c[C.ECCENTRICITY]
    ca = math.cos(angle)
    sa = math.sin(angle)
    # heavy spot at 12 o'clock when the angle is zero: direction (0, -sin, cos)
    push_y = eccentric * (speed * speed * -sa + speed_rate * ca)
    push_z = eccentric * (speed * speed * ca + speed_rate * sa)
    # rigid preload: the mount gives whatever holds the ring to its place
    fx = c[C.PRELOAD] if p[P.RIGID] == 0.0 else -f[g]
    fy = c[C.LOAD_Y] + push_y
    fz = c[C.LOAD_Z] + push_z
    f[F.WORK] += fx * y[v] + fy * y[v + Q.Y] + fz * y[v + Q.Z] + f[F.TORQUE] * speed
    if p[P.GRAVITY] != 0.0:
        fz -= GRAVITY * mass
    f[g] += fx
    f[g + Q.Y] += fy
    f[g + Q.Z] += fz
    polar = p[P.INNER_POLAR] * speed
    f[g + Q.INNER_BY] += supported(p, c, y, Q.INNER_BY, -polar * y[v + Q.INNER_BZ])
    f[g + Q.INNER_BZ] += supported(p, c, y, Q.INNER_BZ, polar * y[v + Q.INNER_BY])
    for i in range(Q.OUTER):
        f[F.HEAT] += p[P.SUPPORT_DAMPING + i] * y[v + i] * y[v + i]
    for i in range(3):
        f[g + i] /= mass
    f[g + Q.INNER_BY] /= p[P.INNER_TRANSVERSE]
    f[g + Q.INNER_BZ] /= p[P.INNER_TRANSVERSE]


@kernel
def outer_ring(p, c, y, f):
    """Pedestal springs and dampers, weight and gyroscopic moments of the outer ring (and housing)."""
    g = F.BODY + Q.OUTER
    q = Y.Q0 + Q.OUTER
    v = Y.V0 + Q.OUTER
    mass = p[P.OUTER_MASS]
    transverse = p[P.OUTER_TRANSVERSE]
    polar = p[P.OUTER_POLAR] * y[v + Q.TURN]
    lost = (
        c[C.DAMPING_AXIAL] * y[v] * y[v]
        + c[C.DAMPING_Z] * (y[v + Q.Y] * y[v + Q.Y] + y[v + Q.Z] * y[v + Q.Z])
        + (c[C.DAMPING_Y] - c[C.DAMPING_Z]) * y[v + Q.Y] * y[v + Q.Y]
        + 2.0 * c[C.DAMPING_YZ] * y[v + Q.Y] * y[v + Q.Z]
        + c[C.DAMPING_SPIN] * y[v + Q.TURN] * y[v + Q.TURN]
        + c[C.DAMPING_ROTATIONAL] * (y[v + Q.BY] * y[v + Q.BY] + y[v + Q.BZ] * y[v + Q.BZ])
    )
    f[F.HEAT_OUTER] += lost
    weight = GRAVITY * mass if p[P.GRAVITY] != 0.0 else 0.0
    turn = c[C.PEDESTAL_ROTATIONAL]
    f[g] = (f[g] - c[C.PEDESTAL_AXIAL] * y[q] - c[C.DAMPING_AXIAL] * y[v]) / mass
    between = c[C.PEDESTAL_YZ]
    damped = c[C.DAMPING_YZ]
    aside_y = y[q + Q.Y] - c[C.NEUTRAL_Y]
    aside_z = y[q + Q.Z] - c[C.NEUTRAL_Z]
    f[g + Q.Y] -= c[C.PEDESTAL_Y] * aside_y + between * aside_z
    f[g + Q.Y] = (f[g + Q.Y] - c[C.DAMPING_Y] * y[v + Q.Y] - damped * y[v + Q.Z]) / mass
    f[g + Q.Z] -= c[C.PEDESTAL_Z] * aside_z + between * aside_y
    f[g + Q.Z] = (f[g + Q.Z] - c[C.DAMPING_Z] * y[v + Q.Z] - damped * y[v + Q.Y] - weight) / mass
    damped = c[C.DAMPING_SPIN]
    f[g + Q.TURN] = (f[g + Q.TURN] - turn * y[q + Q.TURN] - damped * y[v + Q.TURN]) / p[P.OUTER_POLAR]
    damped = c[C.DAMPING_ROTATIONAL]
    lean_y = y[q + Q.BY] - p[P.MISALIGNMENT_Y]
    lean_z = y[q + Q.BZ] - p[P.MISALIGNMENT_Z]
    f[g + Q.BY] = (f[g + Q.BY] - polar * y[v + Q.BZ] - turn * lean_y - damped * y[v + Q.BY]) / transverse
    f[g + Q.BZ] = (f[g + Q.BZ] + polar * y[v + Q.BY] - turn * lean_z - damped * y[v + Q.BZ]) / transverse


@kernel
def cage_body(p, c, y, f):
    """Weight, heavy spot and gyroscopic moments of the cage.

    The heavy spot is at 12 o'clock where the cage's angle is zero and moves in the plane of the balls. It
    pulls at the centre, and what balls and lands put on the centre turns the cage about its centre of mass,
    where its weight acts.
    """
    g = F.BODY + Q.CAGE
    v = Y.V0 + Q.CAGE
    mass = p[P.CAGE_MASS]
    polar = p[P.CAGE_POLAR] * y[v + Q.TURN]
    weight = GRAVITY * mass if p[P.GRAVITY] != 0.0 else 0.0
    f[g] /= mass
    eccentric = c[C.CAGE_ECCENTRICITY]
    if eccentric != 0.0:
        angle = y[Y.Q0 + Q.CAGE + Q.TURN]
        ca = math.cos(angle)
        sa = math.sin(angle)
        f[g + Q.TURN] += eccentric * (ca * f[g + Q.Y] + sa * f[g + Q.Z])
        ahead = eccentric * f[g + Q.TURN] / p[P.CAGE_POLAR]
        outwards = eccentric * y[v + Q.TURN] * y[v + Q.TURN]
        f[g + Q.Y] += mass * (ca * ahead - sa * outwards)
        f[g + Q.Z] += mass * (sa * ahead + ca * outwards)
    f[g + Q.Y] /= mass
    f[g + Q.Z] = (f[g + Q.Z] - weight) / mass
    f[g + Q.TURN] /= p[P.CAGE_POLAR]
    f[g + Q.BY] = (f[g + Q.BY] - polar * y[v + Q.BZ]) / p[P.CAGE_TRANSVERSE]
    f[g + Q.BZ] = (f[g + Q.BZ] + polar * y[v + Q.BY]) / p[P.CAGE_TRANSVERSE]


@kernel
def body_equations(p, c, y, angle, speed, speed_rate, w, f):
    """Turn the summed forces in the body rows of ``f`` into accelerations; add work and heat.

    Tilts belong to a non-spinning frame: I_t b'' + I_p Omega x b' = moment.
    """
    w[W.LANDS_ENERGY] = 0.0
    if p[P.CAGE] != 0.0:
        if p[P.LAND] != 0.0:
            land_forces(p, c, y, speed, f, w)
        cage_body(p, c, y, f)
    else:
        for i in range(Q.SIZE - Q.CAGE):
            f[F.BODY + Q.CAGE + i] = 0.0
    if p[P.SEAL_TORQUE] != 0.0:
        seal_friction(p, y, speed, f)
    inner_ring(p, c, y, angle, speed, speed_rate, f)
    outer_ring(p, c, y, f)
