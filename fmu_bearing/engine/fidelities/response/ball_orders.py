"""Orders of the balls' form over their own turning, for the lines of fidelity `response`.

While a ball turns once in its orbiting axes, each contact runs once round a circle on it
(``condensed.ball_form``). Heights and slopes along that circle have Fourier orders up to the highest zonal
order.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.fidelities.condensed.ball_form import turned_back
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane
from fmu_bearing.engine.layout import LN, STRIDE, P
from fmu_bearing.engine.mechanics.ball_waves import zonal
from fmu_bearing.engine.mechanics.triples import dot


@kernel
def form_over_turning(p, lv, j, count, at, stride, x):
    """Sample the form of ball ``j`` at ``count`` equal parts of its turning into four rows of ``x[at:]``.

    ``stride``: from row to row. Heights (m) under inner and outer race, then slopes (m/rad) across both
    tracks.
    """
    table = int(p[P.AT_AXES]) + j
    a = p[table], p[table + STRIDE], p[table + 2 * STRIDE]
    for k in range(count):
        turn = 2.0 * PI * k / count
        # four directions at once, not four places of the turning
        directions, _, _ = turned_back(lv, math.cos(turn), math.sin(turn))
        sines = dot(a, directions)
        height, rise = zonal(p, int(p[P.AT_FORM]), int(p[P.BALL_WAVES]), sines)
        for race in range(2):
            x[at + race * stride + k] = lane(height, race)
            x[at + (2 + race) * stride + k] = lane(rise, race) * lane(sines, 2 + race)


@kernel
def form_of(form, m):
    """Place in ``x`` of the balls' real parts of order ``m`` of one form; the imaginary ones are behind."""
    return LN.FORM + ((m - 1) * LN.FORMS + form) * LN.FORM_SIZE


@kernel
def form_orders(p, lv, highest, x):
    """Orders 1 .. ``highest`` of each ball's forms over its own turning; ``LN.COS`` is overwritten."""
    count = 2 * (highest + 1)
    for k in range(count):
        x[LN.COS + k] = math.cos(2.0 * PI * k / count) / count
        x[LN.SIN + k] = math.sin(2.0 * PI * k / count) / count
    for j in range(int(p[P.BALLS])):
        form_over_turning(p, lv, j, count, LN.TURNED, LN.TURNS, x)
        for m in range(1, highest + 1):
            for form in range(LN.FORMS):
                re = 0.0
                im = 0.0
                for k in range(count):
                    value = x[LN.TURNED + form * LN.TURNS + k]
                    re += value * x[LN.COS + (m * k) % count]
                    im -= value * x[LN.SIN + (m * k) % count]
                x[form_of(form, m) + j] = re
                x[form_of(form, m) + STRIDE + j] = im
