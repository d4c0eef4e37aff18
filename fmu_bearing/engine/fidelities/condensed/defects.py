"""Local defects under balls that rest between the races; tables and law are those of `mechanics.defects`.

Where each ball is over each defect follows from the time, as race heights do: by the orbit that is frozen,
on a ball by the spin and the contact directions that are (`ball_form`). What a ring moves aside is added on a
race: micrometres, but the load under an edge of a deep defect changes by some per cent in one.

Contact damping acts on the rate of what is left of the approach. To first order that is what is left at the
approach advanced by it, plus tau times its slope along the track times the speed there: see `balls`.

What a defect pushes along its track, the load times the slope of the table, is T on the ball. It rolls on
both races, which hold it on its orbit by -T/2 each, in `full` within some microseconds: so the ring with the
defect feels -T/2 and the other one T/2. What a defect on a ball pushes turns the ball above all: left out.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.fidelities.condensed.ball_form import turned_back, vector_of
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import DE, MAX_DEFECTS, STRIDE, C, L, P, T
from fmu_bearing.engine.mechanics.contact import hertz
from fmu_bearing.engine.mechanics.defects import (
    LEAST_GAIN,
    LEAST_SCALE,
    acts_across,
    head_of,
    scaled_left_over,
    table_of,
    within,
)
from fmu_bearing.engine.mechanics.pose import bearing_angle
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.mechanics.triples import added, cross, dot, scaled

_FAR = 1.0  # m: a place beyond any table
_ASIDE = 1e-3  # m: more than rings move aside, but on pedestals as soft as `full` alone carries


@kernel
def place_balls_over(p, head, table, angle, ahead, race, meet, w):
    """Put the places of all balls over a defect of a race, with it centred, to row ``meet`` of ``T.OVER``.

    ``angle`` (rad): of ball 0 from the defect; ``ahead`` (rad): by which it changes in the damping time.
    """
    radius = p[head + DE.RADIUS + race]
    balls = int(p[P.BALLS])
    first = p[table + DE.TABLE_HEAD]
    last = p[table + DE.TABLE_HEAD + int(p[table + DE.PLACES]) - 1]
    w[T.MEET_AHEAD + meet] = radius * ahead
    for j in range(int(p[P.LANES])):
        own = j if j < balls else 0
        x = radius * wrap(angle + 2.0 * PI * own / balls)
        if x > first - _ASIDE and x < last + _ASIDE:
            w[T.OVER + meet * STRIDE + j] = x
            w[T.MEETS + race * STRIDE + j] = 1.0


@kernel
def place_ball_over(p, lv, head, table, scale, rolled, ahead, race, meet, w):
    """Put the place of a race over a defect of a ball to row ``meet`` of ``T.OVER``, and its scale there.

    As `mechanics.defects.meet_on_ball`. ``rolled`` (rad): by which the balls have turned; ``ahead`` (rad): by
    which they do in the damping time.
    """
    here, rates = turned_back(lv, math.cos(rolled), math.sin(rolled))
    e, e_rate = vector_of(here, race), vector_of(rates, race)
    m, m_rate = vector_of(here, 2 + race), vector_of(rates, 2 + race)
    t, t_rate = cross(m, e), added(cross(m_rate, e), cross(m, e_rate))
    d = p[head + DE.DIRECTION], p[head + DE.DIRECTION + 1], p[head + DE.DIRECTION + 2]
    de, dt = dot(d, e), dot(d, t)
    if not (de > 0.0):
        return
    radius = p[head + DE.RADIUS + race]
    x = radius * math.atan2(-dt, de)
    edges = head + DE.ACROSS + 2 * race
    share, _ = acts_across(radius * dot(d, m), p[edges], p[edges + 1])
    if not within(p, table, x) or scale * share < LEAST_SCALE:
        return
    turned = (dt * dot(d, e_rate) - de * dot(d, t_rate)) / (de * de + dt * dt)
    w[T.MEET_SCALE + meet] = scale * share
    w[T.MEET_AHEAD + meet] = radius * turned * ahead
    balls = int(p[P.BALLS])
    for j in range(int(p[P.LANES])):
        if (j if j < balls else 0) == int(p[head + DE.OF_BALL]):
            w[T.OVER + meet * STRIDE + j] = x
            w[T.MEETS + race * STRIDE + j] = 1.0


@kernel
def place_defects(p, c, lv, theta, rolled, inner_angle, outer_angle, speed, w):
    """Put where the balls are over the defects to ``T.MEETS`` on; arguments: see `balls.set_angles`."""
    tau = p[P.CONTACT_DAMPING]
    orbit = lv[L.RATIO] * speed
    for i in range(2 * STRIDE):
        w[T.MEETS + i] = 0.0
        w[T.PUSH + i] = 0.0
    for i in range(2 * MAX_DEFECTS * STRIDE):
        w[T.OVER + i] = _FAR
    for k in range(int(p[P.DEFECTS])):
        head = head_of(p, k)
        scale = c[C.OVERSIZE_SCALE] * c[C.DEFECT_SCALE + k]
        for race in range(2):
            meet = race * MAX_DEFECTS + k
            table = table_of(p, head, race)
            w[T.MEET_SCALE + meet] = scale
            if table == 0 or not (scale > LEAST_SCALE):
                continue
            if p[head + DE.ON] == DE.BALL:
                turning = tau * lv[L.ROLL] * speed
                place_ball_over(p, lv, head, table, scale, rolled, turning, race, meet, w)
            else:
                passing = tau * (orbit - speed if race == 0 else orbit)
                angle = theta - (inner_angle if race == 0 else outer_angle) - p[head + DE.ANGLE]
                place_balls_over(p, head, table, angle, passing, race, meet, w)


@kernel
def meet_defects(p, c, race, heights, row, w):
    """Put defects into the contacts of the balls with a race, in its rows from ``row`` on.

    ``heights``: row of the race's heights. Changes load and slopes of the balls within reach, and writes
    what they push along the track to ``T.PUSH``; after `place_defects`.
    """
    stiffness = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
    free = c[C.RACES + race * C.RACE_SIZE + C.FREE]
    for j in range(int(p[P.LANES])):
        if w[T.MEETS + race * STRIDE + j] == 0.0:
            continue
        at = row + j
        left, gain, bend, ahead, along = w[at + T.APPROACH], 1.0, 0.0, 0.0, 0.0
        met = False
        for k in range(int(p[P.DEFECTS])):
            meet = race * MAX_DEFECTS + k
            x = w[T.OVER + meet * STRIDE + j]
            head = head_of(p, k)
            table = table_of(p, head, race)
            if p[head + DE.ON] != DE.BALL:
                x += p[head + DE.RADIUS + race] * bearing_angle(w[at + T.QR], w[at + T.QT])
            if table != 0 and within(p, table, x):
                met = True
                left, own, slope, by_two, _, _, _ = scaled_left_over(
                    p, table, w[T.MEET_SCALE + meet], left, x
                )
                own = max(own, LEAST_GAIN)
                bend = own * bend + by_two * gain * gain
                ahead = own * ahead + slope * w[T.MEET_AHEAD + meet]
                along *= own
                if p[head + DE.ON] != DE.BALL:
                    along += slope * p[head + DE.RADIUS + race]
                gain *= own
        if not met:
            w[T.PUSH + race * STRIDE + j] = 0.0
            continue
        pressed, stiff, _ = hertz(stiffness, left + ahead)
        w[at + T.LOAD] = gain * pressed
        w[at + T.STIFF] = max(gain * gain * stiff + bend * pressed, 0.0)
        w[at + T.ACROSS] = gain * pressed / (free + w[at + T.APPROACH] - w[heights + j])
        w[T.PUSH + race * STRIDE + j] = pressed * along / (p[P.PITCH_RADIUS] + w[T.R + j])


@kernel
def push_ring(p, race, row, force, w):
    """Add what defects push along the track to forces and moments on a ring, in its rows from ``force`` on.

    ``row``: rows of the contacts. The force acts at the balls' middles, as the normal one.
    """
    for j in range(int(p[P.BALLS])):
        if w[T.MEETS + j] + w[T.MEETS + STRIDE + j] != 0.0:
            ft = 0.5 * (w[T.PUSH + race * STRIDE + j] - w[T.PUSH + (1 - race) * STRIDE + j])
            co, si = w[T.COS + j], w[T.SIN + j]
            gr = -w[row + T.QX + j] * ft
            w[force + T.FY + j] -= co * ft
            w[force + T.FZ + j] -= si * ft
            w[force + T.MY + j] -= si * gr
            w[force + T.MZ + j] += co * gr


@kernel
def show_directions(p, lv, out, at):
    """Put the directions of defects on balls, as they are turned now, to ``out[at:]``."""
    cosine, sine = math.cos(lv[L.ROLLED]), math.sin(lv[L.ROLLED])
    axis = lv[L.ROLL_AXIS], lv[L.ROLL_AXIS + 1], lv[L.ROLL_AXIS + 2]
    for k in range(int(p[P.DEFECTS])):
        head = head_of(p, k)
        if p[head + DE.ON] == DE.BALL:
            d = p[head + DE.DIRECTION], p[head + DE.DIRECTION + 1], p[head + DE.DIRECTION + 2]
            still = scaled(dot(axis, d), axis)
            moving = added(d, scaled(-1.0, still))
            x, r, t = added(still, added(scaled(cosine, moving), scaled(sine, cross(axis, d))))
            to = at + DE.VECTOR * k
            out[to] = x
            out[to + 1] = r
            out[to + 2] = t


@kernel
def most_taken(p, table, scale, approach):
    """Most (m) that a defect takes of an ``approach`` (m), at the places of its table."""
    most = 0.0
    for i in range(int(p[table + DE.PLACES])):
        left, _, _, _, _, _, _ = scaled_left_over(p, table, scale, approach, p[table + DE.TABLE_HEAD + i])
        most = max(most, approach - left)
    return most


@kernel
def taken_by_defects(p, c, w):
    """Largest share that a defect takes of both approaches of the most loaded ball; contacts are in ``w``.

    Infinite where no ball is pressed into both races.
    """
    share = 0.0
    most, at = 0.0, 0
    for j in range(int(p[P.BALLS]) if p[P.DEFECTS] != 0.0 else 0):
        inner, outer = w[T.CONTACT + T.APPROACH + j], w[T.CONTACT_OUTER + T.APPROACH + j]
        if inner > 0.0 and outer > 0.0 and inner + outer > most:
            most, at = inner + outer, j
    for k in range(int(p[P.DEFECTS])):
        scale = c[C.OVERSIZE_SCALE] * c[C.DEFECT_SCALE + k]
        for race in range(2):
            table = table_of(p, head_of(p, k), race)
            if table == 0 or not (scale > LEAST_SCALE):
                continue
            if most == 0.0:
                return math.inf
            approach = w[T.CONTACT + race * T.CONTACT_SIZE + T.APPROACH + at]
            share = max(share, most_taken(p, table, scale, approach) / most)
    return share
