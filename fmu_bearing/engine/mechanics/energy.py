"""Stored energy, for the balance work in = dissipation + change of energy."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_VR,
    B_VX,
    C_PEDESTAL,
    C_PEDESTAL_AXIAL,
    C_PEDESTAL_ROTATIONAL,
    GRAVITY,
    P_BALL_INERTIA,
    P_BALL_MASS,
    P_BALLS,
    P_CAGE,
    P_CAGE_MASS,
    P_CAGE_POLAR,
    P_CAGE_TRANSVERSE,
    P_GRAVITY,
    P_INNER_MASS,
    P_INNER_TRANSVERSE,
    P_MISALIGNMENT_Y,
    P_MISALIGNMENT_Z,
    P_OUTER_MASS,
    P_OUTER_POLAR,
    P_OUTER_TRANSVERSE,
    P_PITCH_RADIUS,
    P_POCKET_STIFFNESS,
    P_SPRINGS,
    P_TILT_STIFFNESS,
    Q_CAGE,
    Q_OUTER,
    R_APPROACH,
    R_ELASTIC,
    RACE_ROWS,
    STRIDE,
    W_COS,
    W_POCKET,
    W_RACE,
    W_SCALARS,
    Y_Q,
    Y_V,
)
from fmu_bearing.engine.mechanics.equations import kinetic_spin
from fmu_bearing.engine.mechanics.springs import spring_energy

_S = STRIDE


@kernel
def squares(y, at, count):
    """Sum of squares of ``count`` numbers of ``y`` from ``at`` on."""
    total = 0.0
    for i in range(count):
        total += y[at + i] * y[at + i]
    return total


@kernel
def ball_energy(p, y, w):
    """Kinetic and potential energy of the balls and the elastic energy of their contacts (J)."""
    pitch = p[P_PITCH_RADIUS]
    mass = p[P_BALL_MASS]
    gravity = GRAVITY if p[P_GRAVITY] != 0.0 else 0.0
    caged = p[P_CAGE] != 0.0
    total = 0.5 * p[P_BALL_INERTIA] * kinetic_spin(p, y)
    for j in range(int(p[P_BALLS])):
        radius = pitch + y[B_R * _S + j]
        vx = y[B_VX * _S + j]
        vr = y[B_VR * _S + j]
        vt = radius * y[B_OM * _S + j]
        total += 0.5 * mass * (vx * vx + vr * vr + vt * vt) + mass * gravity * radius * w[W_COS * _S + j]
        for race in range(2):
            row = (W_RACE + race * RACE_ROWS) * _S
            total += 0.4 * w[row + R_ELASTIC * _S + j] * max(w[row + R_APPROACH * _S + j], 0.0)
        if caged:
            push = w[W_POCKET * _S + j]
            total += 0.4 * p[P_POCKET_STIFFNESS] * push * push * push**0.5
    return total


@kernel
def stored_energy(p, c, y, w):
    """All stored energy (J) at the state for which the rows of ``w`` were last filled.

    The prescribed rotation of the inner ring is not counted: its inertia belongs to the drive.
    """
    outer = Y_Q + Q_OUTER
    cage = Y_Q + Q_CAGE
    vo = Y_V + Q_OUTER
    vc = Y_V + Q_CAGE
    total = ball_energy(p, y, w) + w[W_SCALARS]
    if p[P_SPRINGS] != 0.0 and p[P_CAGE] == 0.0:
        total += spring_energy(p, y)
    total += 0.5 * p[P_INNER_MASS] * squares(y, Y_V, 3)
    total += 0.5 * p[P_INNER_TRANSVERSE] * squares(y, Y_V + 3, 2)
    total += 0.5 * p[P_TILT_STIFFNESS] * squares(y, Y_Q + 3, 2)
    total += 0.5 * p[P_OUTER_MASS] * squares(y, vo, 3) + 0.5 * p[P_OUTER_POLAR] * squares(y, vo + 3, 1)
    total += 0.5 * p[P_OUTER_TRANSVERSE] * squares(y, vo + 4, 2)
    total += 0.5 * c[C_PEDESTAL_AXIAL] * squares(y, outer, 1)
    total += 0.5 * c[C_PEDESTAL] * squares(y, outer + 1, 2)
    lean_y = y[outer + 4] - p[P_MISALIGNMENT_Y]
    lean_z = y[outer + 5] - p[P_MISALIGNMENT_Z]
    turned = squares(y, outer + 3, 1) + lean_y * lean_y + lean_z * lean_z
    total += 0.5 * c[C_PEDESTAL_ROTATIONAL] * turned
    heavy = p[P_INNER_MASS] * y[Y_Q + 2] + p[P_OUTER_MASS] * y[outer + 2]
    if p[P_CAGE] != 0.0:
        total += 0.5 * p[P_CAGE_MASS] * squares(y, vc, 3) + 0.5 * p[P_CAGE_POLAR] * squares(y, vc + 3, 1)
        total += 0.5 * p[P_CAGE_TRANSVERSE] * squares(y, vc + 4, 2)
        heavy += p[P_CAGE_MASS] * y[cage + 2]
    if p[P_GRAVITY] != 0.0:
        total += GRAVITY * heavy
    return total
