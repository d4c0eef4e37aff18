"""First guess of a step of level `rings`, and what a change of its length does to the velocities."""

from fmu_bearing.engine.fidelities.condensed.publish import rate_error
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, W_Y, Y_Q, Y_V
from fmu_bearing.engine.layout_condensed import (
    E_X,
    L_A,
    L_CALM,
    L_JERK,
    L_KNOWN,
    L_Q,
    L_SETTLED,
    L_SPACING,
    L_V,
    L_X,
    L_X1,
    L_X2,
    L_X3,
    T_A,
    N,
)

_S = STRIDE


@kernel
def change_spacing(lv, h):
    """Exchange the part of the velocities that belongs to the step, if that changes; forget the history."""
    if abs(h - lv[L_SPACING]) > 1e-6 * h:
        old = lv[L_SPACING]
        if old > 0.0:
            for i in range(N):
                lv[L_JERK + i] = 12.0 / (old * old) * rate_error(lv, i)
                lv[L_V + i] += (h * h - old * old) / 12.0 * lv[L_JERK + i]
        lv[L_SPACING] = h
        lv[L_KNOWN] = 0.0
        lv[L_CALM] = 0.0


@kernel
def predict(lv, h, w):
    """Trial state in ``w[W_Y:]``, trial accelerations in ``T_A``, balls' places continued from four."""
    for i in range(N):
        a = lv[L_A + i]
        w[T_A + i] = a
        w[W_Y + Y_Q + i] = lv[L_Q + i] + h * (lv[L_V + i] + 0.5 * h * a)
        w[W_Y + Y_V + i] = lv[L_V + i] + h * a
    known = lv[L_KNOWN]
    continue_places(lv, known, w)


@kernel
def continue_places(lv, known, w):
    """Continue the balls' places from ``known`` earlier steps; one that found no rest stays where it is."""
    if known >= 3.0:
        for i in range(2 * _S):
            w[E_X * _S + i] = 4.0 * (lv[L_X + i] + lv[L_X2 + i]) - 6.0 * lv[L_X1 + i] - lv[L_X3 + i]
    elif known == 2.0:
        for i in range(2 * _S):
            w[E_X * _S + i] = 3.0 * (lv[L_X + i] - lv[L_X1 + i]) + lv[L_X2 + i]
    elif known == 1.0:
        for i in range(2 * _S):
            w[E_X * _S + i] = 2.0 * lv[L_X + i] - lv[L_X1 + i]
    else:
        for i in range(2 * _S):
            w[E_X * _S + i] = lv[L_X + i]
    for j in range(_S):
        if lv[L_SETTLED + j] < known + 1.0 and lv[L_SETTLED + j] < 4.0:
            w[E_X * _S + j] = lv[L_X + j]
            w[(E_X + 1) * _S + j] = lv[L_X + _S + j]
