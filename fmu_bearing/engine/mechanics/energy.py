"""Stored energy, for the balance work in = dissipation + change of energy."""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, P, Q, R, W, Y
from fmu_bearing.engine.mechanics.contact import hertz
from fmu_bearing.engine.mechanics.defects import has_defects
from fmu_bearing.engine.mechanics.springs import spring_energy


@kernel
def squares(y, at, count):
    """Sum of squares of ``count`` numbers of ``y`` from ``at`` on."""
    total = 0.0
    for i in range(count):
        total += y[at + i] * y[at + i]
    return total


@kernel
def kinetic_spin(p, y):
    """Sum over the balls of spin speed squared (rad2/s2)."""
    total = 0.0
    for j in range(int(p[P.BALLS])):
        wx = y[Y.WX + j]
        wr = y[Y.WR + j]
        wt = y[Y.WT + j]
        total += wx * wx + wr * wr + wt * wt
    return total


@kernel
def ball_energy(p, c, y, w):
    """Kinetic and potential energy of the balls and the elastic energy of their contacts (J)."""
    pitch = p[P.PITCH_RADIUS]
    mass = p[P.BALL_MASS]
    gravity = GRAVITY if p[P.GRAVITY] != 0.0 else 0.0
    caged = p[P.CAGE] != 0.0
    total = 0.5 * p[P.BALL_INERTIA] * kinetic_spin(p, y)
    for j in range(int(p[P.BALLS])):
        radius = pitch + y[Y.R + j]
        vx = y[Y.VX + j]
        vr = y[Y.VR + j]
        vt = radius * y[Y.OM + j]
        total += 0.5 * mass * (vx * vx + vr * vr + vt * vt) + mass * gravity * radius * w[W.COS + j]
        for race in range(2):
            row = W.RACE + race * R.SIZE
            elastic = w[row + R.ELASTIC + j]
            if has_defects(p, c):  # by Hertz's law of the approach, not by the load
                elastic /= w[row + R.GAIN + j]
            total += 0.4 * elastic * max(w[row + R.APPROACH + j], 0.0)
        if caged:
            pressing, _, _ = hertz(p[P.POCKET_STIFFNESS], w[W.POCKET + j])
            total += 0.4 * pressing * w[W.POCKET + j]
    return total


@kernel
def stored_energy(p, c, y, w):
    """All stored energy (J) at the state for which the rows of ``w`` were last filled.

    The prescribed rotation of the inner ring is not counted: its inertia belongs to the drive.
    """
    outer = Y.Q0 + Q.OUTER
    cage = Y.Q0 + Q.CAGE
    vo = Y.V0 + Q.OUTER
    vc = Y.V0 + Q.CAGE
    total = ball_energy(p, c, y, w) + w[W.LANDS_ENERGY]
    if p[P.SPRINGS] != 0.0 and p[P.CAGE] == 0.0:
        total += spring_energy(p, y, w)
    total += 0.5 * p[P.INNER_MASS] * squares(y, Y.V0, 3)
    total += 0.5 * p[P.INNER_TRANSVERSE] * squares(y, Y.V0 + Q.INNER_BY, 2)
    for i in range(Q.OUTER):
        total += 0.5 * p[P.SUPPORT_STIFFNESS + i] * squares(y, Y.Q0 + i, 1)
    total += 0.5 * p[P.OUTER_MASS] * squares(y, vo, 3) + 0.5 * p[P.OUTER_POLAR] * squares(y, vo + Q.TURN, 1)
    total += 0.5 * p[P.OUTER_TRANSVERSE] * squares(y, vo + Q.BY, 2)
    total += 0.5 * c[C.PEDESTAL_AXIAL] * squares(y, outer, 1)
    total += 0.5 * c[C.PEDESTAL_Z] * squares(y, outer + Q.Y, 2)
    total += 0.5 * (c[C.PEDESTAL_Y] - c[C.PEDESTAL_Z]) * squares(y, outer + Q.Y, 1)
    total += c[C.PEDESTAL_YZ] * y[outer + Q.Y] * y[outer + Q.Z]
    lean_y = y[outer + Q.BY] - p[P.MISALIGNMENT_Y]
    lean_z = y[outer + Q.BZ] - p[P.MISALIGNMENT_Z]
    turned = squares(y, outer + Q.TURN, 1) + lean_y * lean_y + lean_z * lean_z
    total += 0.5 * c[C.PEDESTAL_ROTATIONAL] * turned
    heavy = p[P.INNER_MASS] * y[Y.Q0 + Q.Z] + p[P.OUTER_MASS] * y[outer + Q.Z]
    if p[P.CAGE] != 0.0:
        total += 0.5 * p[P.CAGE_MASS] * squares(y, vc, 3) + 0.5 * p[P.CAGE_POLAR] * squares(y, vc + Q.TURN, 1)
        total += 0.5 * p[P.CAGE_TRANSVERSE] * squares(y, vc + Q.BY, 2)
        heavy += p[P.CAGE_MASS] * y[cage + Q.Z]
        eccentric = c[C.CAGE_ECCENTRICITY]
        if eccentric != 0.0:
            # the mass moves with the heavy spot, not with the centre
            ca = math.cos(y[cage + Q.TURN])
            sa = math.sin(y[cage + Q.TURN])
            around = eccentric * y[vc + Q.TURN]
            carried = 0.5 * around - ca * y[vc + Q.Y] - sa * y[vc + Q.Z]
            total += p[P.CAGE_MASS] * around * carried
            heavy += p[P.CAGE_MASS] * eccentric * ca
    if p[P.GRAVITY] != 0.0:
        total += GRAVITY * heavy
    return total
