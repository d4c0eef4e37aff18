"""Losses that are frozen: with even balls, and what uneven ones add.

The point that fidelities rings and response are linearised about has even balls and a centred cage. Torque,
heat and orbit speed belong to the whole steady state (``steady.point``), with balls that loads across the
axis make uneven or a cage that whirls. That takes some ten times as long to find: it is renewed when the
speed or a load has moved by 5 %, and in between what it adds goes with the losses of the even balls. The
search goes in pieces, one per millisecond that is simulated, and takes some 10 to 30 of them. A cage takes
longer to find its whirl. Where it finds no steady state, losses are those of `condensed.carried`.
"""

import math

from fmu_bearing.engine.choices import OUTER_GUIDED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, STRIDE, C, F, L, P, Q, S, T, W, Y
from fmu_bearing.engine.mechanics.bodies import guiding_ring
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.seals import seal_moment
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.steady.point import (
    EVEN_BALLS,
    NOT_FOUND,
    SEARCHING,
    begin_search,
    losing_state,
    needs_carrying,
    search,
    state_at,
)

_MOVED = 0.05  # of speed, loads, and of viscosity at least
_MOVED_MOST = 0.15  # of viscosity: what uneven balls add goes with the losses of even ones but for some
_ADDED = 5e-4  # of these losses: a share that they add changes by 1.6 times itself with all of the viscosity
_ADDED_BY = 1.6
_ACROSS = 0.01  # of the preload: of a load across the axis, so that rounding in a set's rest counts as none
_GROWN = 2e-8  # m: of a contact's geometry, some hundredths of its approach
_GONE = 4.0  # times these: a search for what was there then serves nothing
_HEATS = 3


@kernel
def summarise_frozen(p, s, y, f, w):
    """Losses by source at the frozen state ``y`` with its right-hand side ``f``; the state in ``s`` stays.

    A step's first sound sample is interpolated from what ``s`` was published with.
    """
    heat = s[S.F + F.HEAT_OIL]
    s[S.F + F.HEAT_OIL] = f[F.HEAT_OIL]
    for j in range(STRIDE):
        w[T.FROZEN_ROWS + j] = s[S.Y + Y.OM + j]
        w[T.FROZEN_ROWS + STRIDE + j] = s[S.Y + Y.R + j]
        s[S.Y + Y.OM + j] = y[Y.OM + j]
        s[S.Y + Y.R + j] = y[Y.R + j]
    summarise(p, s, w)
    s[S.F + F.HEAT_OIL] = heat
    for j in range(STRIDE):
        s[S.Y + Y.OM + j] = w[T.FROZEN_ROWS + j]
        s[S.Y + Y.R + j] = w[T.FROZEN_ROWS + STRIDE + j]


@kernel
def freeze_losses(p, c, y, speed, turning, s, w):
    """Put what is lost at the state ``y`` to ``lv`` and ``s``; its right-hand side stays in ``w``.

    But for what the seals lose, which no state of the balls changes (`publish.publish_moving`). ``speed`` of
    the shaft (rad/s) for which, ``turning`` at which it is found.
    """
    lv = s[S.CONDENSED :]
    f = w[T.FROZEN_F : T.FROZEN_F + F.SIZE]
    right_hand_side(p, c, y, 0.0, turning, 0.0, w, f)
    if p[P.SEAL_TORQUE] != 0.0:
        slide = turning - y[Y.V0 + Q.OUTER + Q.TURN]
        f[F.HEAT] -= seal_moment(p, slide) * slide
    summarise_frozen(p, s, y, f, w)
    share = speed / turning
    for i in range(_HEATS):
        lv[L.HEAT + i] = share * share * f[F.HEAT + i]
    for i in range(S.LOSSES):
        s[S.LOSS + i] *= share * share
    twist = 0.0
    for j in range(int(p[P.BALLS])):
        twist += w[W.BODY + (Q.OUTER + Q.TURN) * STRIDE + j]
    if p[P.CAGE] != 0.0 and p[P.GUIDANCE] == OUTER_GUIDED:
        # the lands brake the cage on the outer ring: all that turns this is what its seat does not hold
        turn = Q.OUTER + Q.TURN
        twist = p[P.OUTER_POLAR] * f[F.BODY + turn]
        twist += c[C.PEDESTAL_ROTATIONAL] * y[Y.Q0 + turn] + c[C.DAMPING_SPIN] * y[Y.V0 + turn]
    lv[L.TWIST] = share * twist
    if p[P.SEAL_TORQUE] != 0.0:
        lv[L.TWIST] += seal_moment(p, speed)


@kernel
def copy_losses(lv, s, out, to):
    """Put the losses that are frozen to ``L.LOST`` numbers at ``out[to:]``."""
    for i in range(_HEATS):
        out[to + i] = lv[L.HEAT + i]
    for i in range(S.LOSSES):
        out[to + _HEATS + i] = s[S.LOSS + i]
    out[to + _HEATS + S.LOSSES] = lv[L.TWIST]


@kernel
def set_losses(lv, s, x, at):
    """Hold the losses at ``x[at:]``."""
    for i in range(_HEATS):
        lv[L.HEAT + i] = x[at + i]
    for i in range(S.LOSSES):
        s[S.LOSS + i] = x[at + _HEATS + i]
    lv[L.TWIST] = x[at + _HEATS + S.LOSSES]


@kernel
def moved(now, then, times):
    """Whether a number is ``times`` as far as it may be from what it was."""
    return abs(now - then) > times * (_MOVED * abs(then) + 1e-12)


@kernel
def race_growth(c, lv, at):
    """How far (m) contacts have moved with the conditions ``c`` from those in ``lv[at:]``.

    Groove circles count by their distance: where both grow together, contacts are as they were.
    """
    inner, outer = C.RACES, C.RACES + C.RACE_SIZE
    most = 0.0
    for i in (C.GROOVE_X, C.GROOVE_RADIUS):
        apart = c[outer + i] - c[inner + i]
        most = max(most, abs(apart - (lv[at + outer + i] - lv[at + inner + i])))
    for race in range(2):
        k = C.RACES + race * C.RACE_SIZE + C.FREE
        most = max(most, abs(c[k] - lv[at + k]))
    return most


@kernel
def by_viscosity(lv):
    """How much farther than other conditions viscosity may move, see `_ADDED`."""
    added = abs(lv[L.MORE]) + abs(lv[L.MORE + 1]) + abs(lv[L.MORE + 2])
    if not (added > 0.0):
        return _MOVED_MOST / _MOVED
    return min(max(_ADDED * lv[L.MORE_TOTAL] / (_ADDED_BY * added * _MOVED), 1.0), _MOVED_MOST / _MOVED)


@kernel
def away(lv, c, speed, found_speed, conditions, times):
    """Whether speed, loads or sizes are ``times`` as far as they may be from those in ``lv``."""
    far = moved(speed, lv[found_speed], times)
    for i in (C.PRELOAD, C.PEDESTAL):
        if moved(c[i], lv[conditions + i], times):
            far = True
    if moved(c[C.VISCOSITY], lv[conditions + C.VISCOSITY], times * by_viscosity(lv)):
        far = True
    for i in (C.LOAD_Y, C.LOAD_Z):
        then = lv[conditions + i]
        if abs(c[i] - then) > times * (_MOVED * abs(then) + _ACROSS * abs(c[C.PRELOAD]) + 1e-12):
            far = True
    return far or race_growth(c, lv, conditions) > times * _GROWN


@kernel
def uneven_out_of_date(lv, c, speed):
    """Whether speed, loads or sizes have moved too far for what uneven balls add, and no search is going.

    A search for loads that have gone is given up.
    """
    if lv[L.SEARCH_STATE] == L.GOING:
        if not away(lv, c, speed, L.SEARCH_SPEED, L.SEARCH_CONDITIONS, _GONE):
            return False
        lv[L.SEARCH_STATE] = L.IDLE
        lv[L.SEARCH_BEFORE] = -1.0
    return lv[L.MORE_KNOWN] == L.UNKNOWN or away(lv, c, speed, L.MORE_SPEED, L.MORE_CONDITIONS, 1.0)


@kernel
def keep_part(w, lv, back, at, first, count):
    """Keep ``count`` numbers from ``first`` on in ``lv[at:]``, see `keep_pieces`; the place behind them."""
    for i in range(count):
        if back:
            w[W.PATTERN + first + i] = lv[at + i]
        else:
            lv[at + i] = w[W.PATTERN + first + i]
    return at + count


@kernel
def keep_pieces(w, lv, back):
    """Keep what a search leaves to its next piece; ``back``: put it back to the work space."""
    at = keep_part(w, lv, back, L.SEARCH_KEPT, PT.UNKNOWNS, PT.MOST)
    at = keep_part(w, lv, back, at, PT.EIGEN, PT.RIGHT)
    keep_part(w, lv, back, at, PT.FIRST_STATE, PT.FIRST_SIZE)


@kernel
def begin_uneven(c, speed, turning, rings_fixed, s, w):
    """Begin the search for what uneven balls add near the quasi-static state ``PT.FIRST_STATE``.

    ``c``: conditions without imperfections, with the loads; ``rings_fixed``: see `steady.even`. The losses
    that are frozen belong to even balls.
    """
    lv = s[S.CONDENSED :]
    first = state_at(w, PT.FIRST_STATE)
    lv[L.SEARCH_STATE] = L.GOING
    lv[L.SEARCH_SPEED] = speed
    lv[L.SEARCH_TURNING] = turning
    lv[L.SEARCH_FIXED] = rings_fixed
    lv[L.SEARCH_RATIO] = lv[L.RATIO]
    lv[L.SEARCH_TOTAL] = lv[L.HEAT] + lv[L.HEAT_OUTER] + lv[L.HEAT_OIL]
    copy_losses(lv, s, lv, L.SEARCH_LOST)
    own = lv[L.SEARCH_CONDITIONS : L.SEARCH_CONDITIONS + C.SIZE]
    for i in range(C.SIZE):
        own[i] = c[i]
    for i in range(PT.MOST):
        w[W.PATTERN + PT.UNKNOWNS + i] = 0.0
    for i in range(PT.RIGHT):
        w[W.PATTERN + PT.EIGEN + i] = 0.0
    begin_search(first, w)
    keep_pieces(w, lv, False)


@kernel
def go_on_uneven(p, s, w):
    """Make one piece of the search for what uneven balls add; its end puts that to ``L.MORE``."""
    lv = s[S.CONDENSED :]
    c = lv[L.SEARCH_CONDITIONS : L.SEARCH_CONDITIONS + C.SIZE]
    turning = lv[L.SEARCH_TURNING]
    keep_pieces(w, lv, True)
    first = state_at(w, PT.FIRST_STATE)
    outcome = search(p, c, first, turning, int(lv[L.SEARCH_FIXED]), True, w, s[S.JAC : S.CONDENSED])
    if outcome == SEARCHING:
        keep_pieces(w, lv, False)
        return
    lv[L.SEARCH_STATE] = L.ENDED
    lv[L.MORE_KNOWN] = L.FOUND
    if needs_carrying(p, c, first, int(lv[L.SEARCH_FIXED]), outcome):
        lv[L.MORE_KNOWN] = L.CARRIED
    lv[L.MORE_TOTAL] = lv[L.SEARCH_TOTAL]
    lv[L.MORE_SPEED] = lv[L.SEARCH_SPEED]
    c[C.NEUTRAL_Y] = 0.0
    c[C.NEUTRAL_Z] = 0.0
    for i in range(C.SIZE):
        lv[L.MORE_CONDITIONS + i] = c[i]
    lv[L.MORE_RATIO] = 1.0
    for i in range(L.LOST):
        lv[L.MORE + i] = 0.0
    lv[L.MORE_AWAY] = 0.0
    lv[L.MORE_WHIRL] = 0.0
    lv[L.MORE_PRESSED] = 1.0 if outcome == EVEN_BALLS else 0.0
    if outcome == NOT_FOUND or outcome == EVEN_BALLS:
        return
    whole = losing_state(outcome, w)
    mean = 0.0
    for j in range(int(p[P.BALLS])):
        mean += whole[Y.OM + j] / p[P.BALLS]
    lv[L.MORE_RATIO] = mean / (turning * lv[L.SEARCH_RATIO])
    copy_losses(lv, s, w, T.FROZEN_LOST)
    freeze_losses(p, c, whole, lv[L.SEARCH_SPEED], turning, s, w)
    keep_cage(p, lv, whole, w)
    copy_losses(lv, s, lv, L.MORE)
    set_losses(lv, s, w, T.FROZEN_LOST)
    for i in range(L.LOST):
        lv[L.MORE + i] -= lv[L.SEARCH_LOST + i]


@kernel
def keep_cage(p, lv, y, w):
    """Keep where the cage is in its lands in the state ``y``, whose right-hand side was just evaluated."""
    if p[P.CAGE] == 0.0:
        return
    guide, _ = guiding_ring(p)
    cage, ring = Y.Q0 + Q.CAGE, Y.Q0 + guide
    away_y, away_z = y[cage + Q.Y] - y[ring + Q.Y], y[cage + Q.Z] - y[ring + Q.Z]
    rate_y, rate_z = y[Y.V0 + Q.CAGE + Q.Y], y[Y.V0 + Q.CAGE + Q.Z]
    square = away_y * away_y + away_z * away_z
    lv[L.MORE_AWAY] = math.sqrt(square)
    if square > 0.0:
        lv[L.MORE_WHIRL] = (away_y * rate_z - away_z * rate_y) / square
    pressed = 1.0
    for j in range(int(p[P.BALLS])):
        if not (w[W.POCKET + j] > 0.0):
            pressed = 0.0
    lv[L.MORE_PRESSED] = pressed


@kernel
def add_uneven(speed, s, w):
    """Add to the losses and the orbit of even balls at ``speed`` (rad/s) what uneven ones add; the torque."""
    lv = s[S.CONDENSED :]
    total = lv[L.HEAT] + lv[L.HEAT_OUTER] + lv[L.HEAT_OIL]
    share = total / lv[L.MORE_TOTAL] if lv[L.MORE_TOTAL] > 0.0 else 0.0
    copy_losses(lv, s, w, T.FROZEN_LOST)
    for i in range(L.LOST):
        w[T.FROZEN_LOST + i] += share * lv[L.MORE + i]
    set_losses(lv, s, w, T.FROZEN_LOST)
    lv[L.RATIO] *= lv[L.MORE_RATIO]
    lv[L.TORQUE] = 0.0
    if speed != 0.0:
        lv[L.TORQUE] = (lv[L.HEAT] + lv[L.HEAT_OUTER] + lv[L.HEAT_OIL]) / speed


@kernel
def freeze_uneven(p, speed, at_once, s, w):
    """Put what uneven balls add to the losses of even ones, frozen at ``speed`` (rad/s).

    ``at_once``: a search that was begun is made to its end first; or else what was found before serves, until
    the pieces of the search (`go_on_uneven`) have come to their end.
    """
    lv = s[S.CONDENSED :]
    while at_once and lv[L.SEARCH_STATE] == L.GOING:
        go_on_uneven(p, s, w)
    if lv[L.SEARCH_STATE] == L.ENDED:
        lv[L.SEARCH_STATE] = L.IDLE
    add_uneven(speed, s, w)
