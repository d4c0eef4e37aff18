"""Form and waviness of the balls under both races, for balls that spin steadily.

Held with the operating point are the spin against the orbiting axes, the same for all balls, and the
directions of the contacts. So each contact runs round one and the same circle on every ball, by the angle
``L.ROLLED``; the balls differ by where their body-fixed axis a was when that angle was zero. With g the
contact's direction turned back by it, the surface is h(g . a) above the sphere (``mechanics.ball_waves``)
and its gradient across the track gives a force Q h' (g_m . a) / l, l from the groove's centre.

Contact damping acts on the rate of approach, tau times its stiffness: that is the height h + tau dh/dt. It
does not act on the slope, nor does the ball's inertia know it.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, load, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, L, P, R, T, W, Y
from fmu_bearing.engine.mechanics.contact import first_zonal, next_zonal
from fmu_bearing.engine.mechanics.triples import added, cross, dot, scaled, three

_STILL = 1e-9  # of the shaft's speed: slower balls do not turn


@kernel
def freeze_rolling(p, lv, y, turning, w):
    """Keep spin and contact directions of the state ``y`` at the shaft speed ``turning`` (rad/s).

    The rows of both contacts in ``w`` belong to that state. Means over the balls, which are equal there.
    """
    balls = int(p[P.BALLS])
    for i in range(L.ROLL_SIZE):
        lv[L.ROLL + i] = 0.0
    for j in range(balls):
        lv[L.ROLL_AXIS] -= y[Y.OM + j] / balls
        for i in range(L.VECTOR):
            lv[L.ROLL_AXIS + i] += y[Y.WX + i * STRIDE + j] / balls
            for race in range(2):
                row = W.RACE + race * R.SIZE + i * STRIDE + j
                lv[L.CONTACT_AXES + FOUR * i + race] += w[row + R.EN] / balls
                lv[L.CONTACT_AXES + FOUR * i + 2 + race] += w[row + R.EM] / balls
    size = math.sqrt(lv[L.ROLL_AXIS] ** 2 + lv[L.ROLL_AXIS + 1] ** 2 + lv[L.ROLL_AXIS + 2] ** 2)
    if size < _STILL * abs(turning):
        return
    for i in range(L.VECTOR):
        lv[L.ROLL_AXIS + i] /= size
    lv[L.ROLL] = size / turning


@kernel
def turned_back(lv, cosine, sine):
    """Directions ``L.CONTACT_AXES``, turned about the balls' spin axis by minus an angle, and their rates.

    Four at a time: into both races, across both tracks. ``cosine``, ``sine``: of the angle; the rates are
    derivatives by it (rad).
    """
    axis = splat(lv[L.ROLL_AXIS]), splat(lv[L.ROLL_AXIS + 1]), splat(lv[L.ROLL_AXIS + 2])
    at = L.CONTACT_AXES
    e = load(lv, at), load(lv, at + FOUR), load(lv, at + 2 * FOUR)
    still = scaled(dot(axis, e), axis)
    moving = added(e, scaled(-1.0, still))
    aside = cross(axis, e)
    here = added(scaled(cosine, moving), scaled(-sine, aside))
    rate = added(scaled(-sine, moving), scaled(-cosine, aside))
    return added(still, here), rate


@kernel
def vector_of(vectors, k):
    """Vector ``k`` of four."""
    x, r, t = vectors
    return lane(x, k), lane(r, k), lane(t, k)


@kernel
def pair_of_sums(p, form, orders, x, y):
    """Height of the zonal harmonics and its derivative at ``x``, then at ``y``, both of four balls."""
    one, other = first_zonal(p, form, x), first_zonal(p, form, y)
    for order in range(1, orders + 1):
        row = form + P.FORM_ROW * order
        one, other = next_zonal(p, row, x, one), next_zonal(p, row, y, other)
    _, _, height, slope = one
    _, _, other_height, other_slope = other
    return height, slope, other_height, other_slope


@kernel
def add_ball_form(p, c, lv, rolled, speed, w):
    """Add the balls' form to the heights under both races; write ``T.FORM_SLOPE``.

    ``rolled`` (rad): by which the balls have turned; ``speed`` of the shaft (rad/s). Heights are advanced by
    contact damping.
    """
    form = int(p[P.AT_FORM])
    axes = int(p[P.AT_AXES])
    orders = int(p[P.BALL_WAVES])
    scale = c[C.OVERSIZE_SCALE]
    rate = lv[L.ROLL] * speed
    ahead = scale * rate * p[P.CONTACT_DAMPING]
    here, rates = turned_back(lv, math.cos(rolled), math.sin(rolled))
    inner, outer = vector_of(here, 0), vector_of(here, 1)
    inner_across, outer_across = vector_of(here, 2), vector_of(here, 3)
    inner_rate, outer_rate = vector_of(rates, 0), vector_of(rates, 1)
    for j in range(0, int(p[P.LANES]), FOUR):
        a = three(p, axes + j)
        height, rise, height_o, rise_o = pair_of_sums(p, form, orders, dot(a, inner), dot(a, outer))
        swept = dot(a, inner_rate)
        swept_o = dot(a, outer_rate)
        store(w, T.INNER + j, load(w, T.INNER + j) + (scale * height + ahead * rise * swept))
        store(w, T.OUTER + j, load(w, T.OUTER + j) + (scale * height_o + ahead * rise_o * swept_o))
        store(w, T.FORM_SLOPE + j, scale * rise * dot(a, inner_across))
        store(w, T.FORM_SLOPE_OUTER + j, scale * rise_o * dot(a, outer_across))
