"""Rings and cage: forces that do not come through the balls, and the equations of the bodies."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    C_DAMPING,
    C_DAMPING_AXIAL,
    C_DAMPING_ROTATIONAL,
    C_DAMPING_SPIN,
    C_ECCENTRICITY,
    C_LOAD_Y,
    C_LOAD_Z,
    C_PEDESTAL,
    C_PEDESTAL_AXIAL,
    C_PEDESTAL_ROTATIONAL,
    C_PRELOAD,
    F_G,
    F_HEAT,
    F_TORQUE,
    F_WORK,
    GRAVITY,
    P_CAGE,
    P_CAGE_MASS,
    P_CAGE_POLAR,
    P_CAGE_TRANSVERSE,
    P_GRAVITY,
    P_INNER_MASS,
    P_INNER_POLAR,
    P_INNER_TRANSVERSE,
    P_LAND,
    P_LAND_OFFSET,
    P_MISALIGNMENT_Y,
    P_MISALIGNMENT_Z,
    P_OUTER_MASS,
    P_OUTER_POLAR,
    P_OUTER_TRANSVERSE,
    P_RIGID,
    P_TILT_DAMPING,
    P_TILT_STIFFNESS,
    Q_CAGE,
    Q_OUTER,
    W_SCALARS,
    Y_Q,
    Y_V,
)
from fmu_bearing.engine.mechanics.cage import land


@kernel
def lands(p, y, speed, f, w):
    """Add both lands' forces to the body rows of ``f``, their loss to the oil, their energy to ``w``."""
    i = Y_Q
    k = Y_Q + Q_CAGE
    vi = Y_V
    vk = Y_V + Q_CAGE
    gi = F_G
    gk = F_G + Q_CAGE
    w[W_SCALARS] = 0.0
    for side in range(2):
        x = p[P_LAND_OFFSET] if side == 0 else -p[P_LAND_OFFSET]
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
        f[F_TORQUE] -= on_inner
        f[F_HEAT + 2] += lost
        w[W_SCALARS] += stored


@kernel
def inner_ring(p, c, y, angle, speed, speed_rate, f):
    """Preload, loads, weight, unbalance, tilt support and gyroscopic moments of inner ring and rotor."""
    g = F_G
    v = Y_V
    mass = p[P_INNER_MASS]
    eccentric = mass * c[C_ECCENTRICITY]
    ca = math.cos(angle)
    sa = math.sin(angle)
    # heavy spot at 12 o'clock when the angle is zero: direction (0, -sin, cos)
    push_y = eccentric * (speed * speed * -sa + speed_rate * ca)
    push_z = eccentric * (speed * speed * ca + speed_rate * sa)
    # rigid preload: the mount gives whatever holds the ring to its place
    fx = c[C_PRELOAD] if p[P_RIGID] == 0.0 else -f[g]
    fy = c[C_LOAD_Y] + push_y
    fz = c[C_LOAD_Z] + push_z
    f[F_WORK] += fx * y[v] + fy * y[v + 1] + fz * y[v + 2] + f[F_TORQUE] * speed
    if p[P_GRAVITY] != 0.0:
        fz -= GRAVITY * mass
    f[g] += fx
    f[g + 1] += fy
    f[g + 2] += fz
    polar = p[P_INNER_POLAR] * speed
    k = p[P_TILT_STIFFNESS]
    d = p[P_TILT_DAMPING]
    dby = y[v + 3]
    dbz = y[v + 4]
    f[g + 3] += -polar * dbz - k * y[Y_Q + 3] - d * dby
    f[g + 4] += polar * dby - k * y[Y_Q + 4] - d * dbz
    f[F_HEAT] += d * (dby * dby + dbz * dbz)
    for i in range(3):
        f[g + i] /= mass
    f[g + 3] /= p[P_INNER_TRANSVERSE]
    f[g + 4] /= p[P_INNER_TRANSVERSE]


@kernel
def outer_ring(p, c, y, f):
    """Pedestal springs and dampers, weight and gyroscopic moments of the outer ring (and housing)."""
    g = F_G + Q_OUTER
    q = Y_Q + Q_OUTER
    v = Y_V + Q_OUTER
    mass = p[P_OUTER_MASS]
    transverse = p[P_OUTER_TRANSVERSE]
    polar = p[P_OUTER_POLAR] * y[v + 3]
    lost = (
        c[C_DAMPING_AXIAL] * y[v] * y[v]
        + c[C_DAMPING] * (y[v + 1] * y[v + 1] + y[v + 2] * y[v + 2])
        + c[C_DAMPING_SPIN] * y[v + 3] * y[v + 3]
        + c[C_DAMPING_ROTATIONAL] * (y[v + 4] * y[v + 4] + y[v + 5] * y[v + 5])
    )
    f[F_HEAT + 1] += lost
    weight = GRAVITY * mass if p[P_GRAVITY] != 0.0 else 0.0
    turn = c[C_PEDESTAL_ROTATIONAL]
    f[g] = (f[g] - c[C_PEDESTAL_AXIAL] * y[q] - c[C_DAMPING_AXIAL] * y[v]) / mass
    f[g + 1] = (f[g + 1] - c[C_PEDESTAL] * y[q + 1] - c[C_DAMPING] * y[v + 1]) / mass
    f[g + 2] = (f[g + 2] - c[C_PEDESTAL] * y[q + 2] - c[C_DAMPING] * y[v + 2] - weight) / mass
    f[g + 3] = (f[g + 3] - turn * y[q + 3] - c[C_DAMPING_SPIN] * y[v + 3]) / p[P_OUTER_POLAR]
    damped = c[C_DAMPING_ROTATIONAL]
    lean_y = y[q + 4] - p[P_MISALIGNMENT_Y]
    lean_z = y[q + 5] - p[P_MISALIGNMENT_Z]
    f[g + 4] = (f[g + 4] - polar * y[v + 5] - turn * lean_y - damped * y[v + 4]) / transverse
    f[g + 5] = (f[g + 5] + polar * y[v + 4] - turn * lean_z - damped * y[v + 5]) / transverse


@kernel
def cage_body(p, y, f):
    """Weight and gyroscopic moments of the cage."""
    g = F_G + Q_CAGE
    v = Y_V + Q_CAGE
    mass = p[P_CAGE_MASS]
    polar = p[P_CAGE_POLAR] * y[v + 3]
    weight = GRAVITY * mass if p[P_GRAVITY] != 0.0 else 0.0
    f[g] /= mass
    f[g + 1] /= mass
    f[g + 2] = (f[g + 2] - weight) / mass
    f[g + 3] /= p[P_CAGE_POLAR]
    f[g + 4] = (f[g + 4] - polar * y[v + 5]) / p[P_CAGE_TRANSVERSE]
    f[g + 5] = (f[g + 5] + polar * y[v + 4]) / p[P_CAGE_TRANSVERSE]


@kernel
def body_equations(p, c, y, angle, speed, speed_rate, w, f):
    """Turn the summed forces in the body rows of ``f`` into accelerations; add work and heat.

    Tilts are those of a non-spinning frame: I_t b'' + I_p Omega x b' = moment.
    """
    w[W_SCALARS] = 0.0
    if p[P_CAGE] != 0.0:
        if p[P_LAND] != 0.0:
            lands(p, y, speed, f, w)
        cage_body(p, y, f)
    else:
        for i in range(6):
            f[F_G + Q_CAGE + i] = 0.0
    inner_ring(p, c, y, angle, speed, speed_rate, f)
    outer_ring(p, c, y, f)
