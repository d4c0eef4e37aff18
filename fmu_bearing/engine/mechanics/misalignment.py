"""Misalignment: the outer ring's seat leans against the shaft, so its pedestal springs rest at that tilt."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
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
def lean(p, c, tilt_stiffness, y):
    """Tilt rings and balls of the start ``y`` about as the misalignment leaves them.

    Pedestal, bearing (``tilt_stiffness``, N m/rad) and tilt support are springs in series between the
    leaning seat and the frame; the balls take the mean of both rings' axial displacement at their place.
    The coupling of tilt and radial displacement is left to the run.
    """
    support = p[P_TILT_STIFFNESS]
    both = tilt_stiffness + support
    bearing = tilt_stiffness * support / both if both > 0.0 else 0.0
    seat = c[C_PEDESTAL_ROTATIONAL]
    outer = seat / (seat + bearing)
    inner = outer * (tilt_stiffness / both if both > 0.0 else 0.0)
    by = p[P_MISALIGNMENT_Y]
    bz = p[P_MISALIGNMENT_Z]
    y[Y_Q + Q_OUTER + 4] = outer * by
    y[Y_Q + Q_OUTER + 5] = outer * bz
    y[Y_Q + 3] = inner * by
    y[Y_Q + 4] = inner * bz
    mean = 0.5 * (outer + inner) * p[P_PITCH_RADIUS]
    for j in range(int(p[P_LANES])):
        angle = y[B_TH * _S + j]
        y[B_X * _S + j] += mean * (by * math.cos(angle) + bz * math.sin(angle))
