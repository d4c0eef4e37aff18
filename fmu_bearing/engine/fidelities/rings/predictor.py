"""First guess of a step of fidelity `rings`, and what a change of its length does to the velocities."""

from fmu_bearing.engine.fidelities.condensed.publish import rate_error
from fmu_bearing.engine.fidelities.condensed.rows import show_balls
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, L, T, W, Y


@kernel
def change_spacing(lv, h):
    """Exchange the part of the velocities that belongs to the step, if that changes; forget the history."""
    if abs(h - lv[L.SPACING]) > 1e-6 * h:
        old = lv[L.SPACING]
        if old > 0.0:
            for i in range(L.N):
                lv[L.JERK + i] = 12.0 / (old * old) * rate_error(lv, i)
                lv[L.V0 + i] += (h * h - old * old) / 12.0 * lv[L.JERK + i]
        lv[L.SPACING] = h
        lv[L.KNOWN] = 0.0
        lv[L.CALM] = 0.0


@kernel
def predict(lv, h, w):
    """Trial state in ``w[W.STAGE:]``, trial accelerations in ``T.A``, balls' places continued from four."""
    for i in range(L.N):
        a = lv[L.A0 + i]
        w[T.A + i] = a
        w[W.STAGE + Y.Q0 + i] = lv[L.Q0 + i] + h * (lv[L.V0 + i] + 0.5 * h * a)
        w[W.STAGE + Y.V0 + i] = lv[L.V0 + i] + h * a
    known = lv[L.KNOWN]
    continue_places(lv, known, w)


@kernel
def continue_places(lv, known, w):
    """Continue the balls' places from ``known`` earlier steps; one that found no rest stays where it is."""
    if known >= 3.0:
        for i in range(2 * STRIDE):
            w[T.X + i] = 4.0 * (lv[L.X + i] + lv[L.X2 + i]) - 6.0 * lv[L.X1 + i] - lv[L.X3 + i]
    elif known == 2.0:
        for i in range(2 * STRIDE):
            w[T.X + i] = 3.0 * (lv[L.X + i] - lv[L.X1 + i]) + lv[L.X2 + i]
    elif known == 1.0:
        for i in range(2 * STRIDE):
            w[T.X + i] = 2.0 * lv[L.X + i] - lv[L.X1 + i]
    else:
        show_balls(lv, L.X, w)
    for j in range(STRIDE):
        if lv[L.SETTLED + j] < known + 1.0 and lv[L.SETTLED + j] < 4.0:
            w[T.X + j] = lv[L.X + j]
            w[T.R + j] = lv[L.R + j]
