"""Orders of the balls' form over their own turning, for the lines of fidelity `response`.

While a ball turns once in its orbiting axes, each contact runs once round a circle on it
(``condensed.ball_form``). Heights and slopes along that circle have Fourier orders up to the highest zonal
order.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.fidelities.condensed.ball_form import pair_of_sums, turned_back
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, load, splat
from fmu_bearing.engine.layout import LN, STRIDE, P
from fmu_bearing.engine.mechanics.triples import dot


@kernel
def form_over_turning(p, lv, j, count, at, x):
    """Sample the form of ball ``j`` at ``count`` equal parts of its turning, an even number, into ``x[at:]``.

    ``LN.FORMS`` numbers per part: heights (m) under inner and outer race, then slopes (m/rad) across both
    tracks.
    """
    table = int(p[P.AT_AXES]) + j
    form, orders = int(p[P.AT_FORM]), int(p[P.BALL_WAVES])
    a = p[table], p[table + STRIDE], p[table + 2 * STRIDE]
    for k in range(0, count, 2):
        # four directions at once, not four places of the turning; two places, as each waits for itself
        one, other = sines_at(lv, a, 2.0 * PI * k / count), sines_at(lv, a, 2.0 * PI * (k + 1) / count)
        height, rise, height_after, rise_after = pair_of_sums(p, form, orders, one, other)
        for race in range(2):
            here = at + LN.FORMS * k + race
            x[here] = lane(height, race)
            x[here + 2] = lane(rise, race) * lane(one, 2 + race)
            x[here + LN.FORMS] = lane(height_after, race)
            x[here + LN.FORMS + 2] = lane(rise_after, race) * lane(other, 2 + race)


@kernel
def sines_at(lv, a, turn):
    """Sines of the four directions of a ball's contacts against its axis ``a``, turned by ``turn`` (rad)."""
    directions, _ = turned_back(lv, math.cos(turn), math.sin(turn))
    return dot(a, directions)


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
        form_over_turning(p, lv, j, count, LN.TURNED, x)
        for m in range(1, highest + 1):
            re, im = splat(0.0), splat(0.0)
            place = 0  # of m k among the parts
            for k in range(count):
                values = load(x, LN.TURNED + LN.FORMS * k)
                re += values * x[LN.COS + place]
                im -= values * x[LN.SIN + place]
                place += m
                if place >= count:
                    place -= count
            for form in range(LN.FORMS):
                x[form_of(form, m) + j] = lane(re, form)
                x[form_of(form, m) + STRIDE + j] = lane(im, form)
