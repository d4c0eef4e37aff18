"""Rings and cage: forces that do not come through the balls, and the equations of the bodies."""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, F, P, Q, W, Y
from fmu_bearing.engine.mechanics.cage import land


@kernel
def lands(p, y, speed, f, w):
    """Add both lands' forces to the body rows of ``f``, their loss to the oil, their energy to ``w``."""
    i = Y.Q0
    k = Y.Q0 + Q.CAGE
    vi = Y.V0
    vk = Y.V0 + Q.CAGE
    gi = F.BODY
    gk = F.BODY + Q.CAGE
    w[W.SCALARS] = 0.0
    for side in range(2):
        x = p[P.LAND_OFFSET] if side == 0 else -p[P.LAND_OFFSET]
        dy = y[k + 1] - y[i + 1] + x * (y[k + 5] - y[i + 4])
        dz = y[k + 2] - y[i + 2] - x * (y[k + 4] - y[i + 3])
        vy = y[vk + 1] - y[vi + 1] + x * (y[vk + 5] - y[vi + 4])
        vz = y[vk + 2] - y[vi + 2] - x * (y[vk + 4] - y[vi + 3])
        fy, fz, on_inner, on_cage, stored, lost = land(p, dy, dz, vy, vz, speed, y[vk + 3])
        f[gk + 1] += fy
        f[gk + 2] += fz
        f[gk + 3] += on_cage
        f[gk + 4] -= x * fz
        f[gk + 5] += x * fy
        f[gi + 1] -= fy
        f[gi + 2] -= fz
        f[gi + 3] += x * fz
        f[gi + 4] -= x * fy
        f[F.TORQUE] -= on_inner
        f[F.HEAT + 2] += lost
        w[W.SCALARS] += stored


@kernel
def inner_ring(p, c, y, angle, speed, speed_rate, f):
    """Preload, loads, weight, unbalance, tilt support and gyroscopic moments of inner ring and rotor."""
    g = F.BODY
    v = Y.V0
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
    f[F.WORK] += fx * y[v] + fy * y[v + 1] + fz * y[v + 2] + f[F.TORQUE] * speed
    if p[P.GRAVITY] != 0.0:
        fz -= GRAVITY * mass
    f[g] += fx
    f[g + 1] += fy
    f[g + 2] += fz
    polar = p[P.INNER_POLAR] * speed
    k = p[P.TILT_STIFFNESS]
    d = p[P.TILT_DAMPING]
    dby = y[v + 3]
    dbz = y[v + 4]
    f[g + 3] += -polar * dbz - k * y[Y.Q0 + 3] - d * dby
    f[g + 4] += polar * dby - k * y[Y.Q0 + 4] - d * dbz
    f[F.HEAT] += d * (dby * dby + dbz * dbz)
    for i in range(3):
        f[g + i] /= mass
    f[g + 3] /= p[P.INNER_TRANSVERSE]
    f[g + 4] /= p[P.INNER_TRANSVERSE]


@kernel
def outer_ring(p, c, y, f):
    """Pedestal springs and dampers, weight and gyroscopic moments of the outer ring (and housing)."""
    g = F.BODY + Q.OUTER
    q = Y.Q0 + Q.OUTER
    v = Y.V0 + Q.OUTER
    mass = p[P.OUTER_MASS]
    transverse = p[P.OUTER_TRANSVERSE]
    polar = p[P.OUTER_POLAR] * y[v + 3]
    lost = (
        c[C.DAMPING_AXIAL] * y[v] * y[v]
        + c[C.DAMPING] * (y[v + 1] * y[v + 1] + y[v + 2] * y[v + 2])
        + c[C.DAMPING_SPIN] * y[v + 3] * y[v + 3]
        + c[C.DAMPING_ROTATIONAL] * (y[v + 4] * y[v + 4] + y[v + 5] * y[v + 5])
    )
    f[F.HEAT + 1] += lost
    weight = GRAVITY * mass if p[P.GRAVITY] != 0.0 else 0.0
    turn = c[C.PEDESTAL_ROTATIONAL]
    f[g] = (f[g] - c[C.PEDESTAL_AXIAL] * y[q] - c[C.DAMPING_AXIAL] * y[v]) / mass
    f[g + 1] = (f[g + 1] - c[C.PEDESTAL] * y[q + 1] - c[C.DAMPING] * y[v + 1]) / mass
    f[g + 2] = (f[g + 2] - c[C.PEDESTAL] * y[q + 2] - c[C.DAMPING] * y[v + 2] - weight) / mass
    f[g + 3] = (f[g + 3] - turn * y[q + 3] - c[C.DAMPING_SPIN] * y[v + 3]) / p[P.OUTER_POLAR]
    damped = c[C.DAMPING_ROTATIONAL]
    lean_y = y[q + 4] - p[P.MISALIGNMENT_Y]
    lean_z = y[q + 5] - p[P.MISALIGNMENT_Z]
    f[g + 4] = (f[g + 4] - polar * y[v + 5] - turn * lean_y - damped * y[v + 4]) / transverse
    f[g + 5] = (f[g + 5] + polar * y[v + 4] - turn * lean_z - damped * y[v + 5]) / transverse


@kernel
def cage_body(p, y, f):
    """Weight and gyroscopic moments of the cage."""
    g = F.BODY + Q.CAGE
    v = Y.V0 + Q.CAGE
    mass = p[P.CAGE_MASS]
    polar = p[P.CAGE_POLAR] * y[v + 3]
    weight = GRAVITY * mass if p[P.GRAVITY] != 0.0 else 0.0
    f[g] /= mass
    f[g + 1] /= mass
    f[g + 2] = (f[g + 2] - weight) / mass
    f[g + 3] /= p[P.CAGE_POLAR]
    f[g + 4] = (f[g + 4] - polar * y[v + 5]) / p[P.CAGE_TRANSVERSE]
    f[g + 5] = (f[g + 5] + polar * y[v + 4]) / p[P.CAGE_TRANSVERSE]


@kernel
def body_equations(p, c, y, angle, speed, speed_rate, w, f):
    """Turn the summed forces in the body rows of ``f`` into accelerations; add work and heat.

    Tilts are those of a non-spinning frame: I_t b'' + I_p Omega x b' = moment.
    """
    w[W.SCALARS] = 0.0
    if p[P.CAGE] != 0.0:
        if p[P.LAND] != 0.0:
            lands(p, y, speed, f, w)
        cage_body(p, y, f)
    else:
        for i in range(6):
            f[F.BODY + Q.CAGE + i] = 0.0
    inner_ring(p, c, y, angle, speed, speed_rate, f)
    outer_ring(p, c, y, f)
