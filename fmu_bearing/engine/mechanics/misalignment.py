"""Misalignment: the outer ring's seat leans against the shaft, so its pedestal springs rest at that tilt."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    B_R,
    B_TH,
    B_X,
    C_PEDESTAL_ROTATIONAL,
    P_LANES,
    P_MISALIGNMENT_Y,
    P_MISALIGNMENT_Z,
    P_PITCH_RADIUS,
    P_TILT_STIFFNESS,
    Q_OUTER,
    STRIDE,
    Y_Q,
)

_S = STRIDE


@kernel
def lean(p, c, radial, tilting, coupling, y):
    """Tilt rings and balls of the start ``y`` about as the misalignment leaves them.

    ``radial`` (N/m), ``tilting`` (N m/rad) and ``coupling`` (N): stiffness of the bearing. Nothing but the
    bearing holds the inner ring radially, so it moves until no radial force is left, which relieves most
    of the tilt (about the apex of the contact lines no load changes to first order). Seat, what stiffness
    remains and tilt support are springs in series; each ball takes the mean of both rings' displacement.
    """
    if not (radial > 0.0):
        return
    lever = -coupling / radial
    left = max(tilting + coupling * lever, 0.0)
    support = p[P_TILT_STIFFNESS]
    share = left / (left + support) if support > 0.0 else 1.0
    seat = c[C_PEDESTAL_ROTATIONAL]
    outer = seat / (seat + left * (1.0 - share))
    inner = outer * share
    by = p[P_MISALIGNMENT_Y]
    bz = p[P_MISALIGNMENT_Z]
    y[Y_Q + Q_OUTER + 4] = outer * by
    y[Y_Q + Q_OUTER + 5] = outer * bz
    y[Y_Q + 3] = inner * by
    y[Y_Q + 4] = inner * bz
    apart = lever * (outer - inner)
    y[Y_Q + 1] -= apart * bz
    y[Y_Q + 2] += apart * by
    mean = 0.5 * (outer + inner) * p[P_PITCH_RADIUS]
    for j in range(int(p[P_LANES])):
        angle = y[B_TH * _S + j]
        way = by * math.cos(angle) + bz * math.sin(angle)
        y[B_X * _S + j] += mean * way
        y[B_R * _S + j] += 0.5 * apart * way
