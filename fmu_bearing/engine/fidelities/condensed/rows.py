"""The rings' coordinates and the balls' force components; the balls' places between ``lv`` and ``w``."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, L, T


@kernel
def coordinate(i):
    """Coordinate of the rings that component ``i`` of the balls' forces acts on: see ``L.FORCES``."""
    return i if i < L.TURN else i + 1


@kernel
def component(i):
    """Component of the balls' forces that acts on coordinate ``i`` of the rings, which is not ``L.TURN``."""
    return i if i < L.TURN else i - 1


@kernel
def show_balls(lv, at, w):
    """Copy the balls' places from row ``at`` of ``lv`` and the next to the trial rows."""
    for i in range(2 * STRIDE):
        w[T.X + i] = lv[at + i]


@kernel
def keep_balls(w, lv, at):
    """Copy the balls' places from the trial rows to row ``at`` of ``lv`` and the next."""
    for i in range(2 * STRIDE):
        lv[at + i] = w[T.X + i]
