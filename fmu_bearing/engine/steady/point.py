"""The operating point of a bearing: even balls, balls under loads across the axis, a cage that whirls.

With nothing across the axis the balls are equal and the cage is in the middle (``even``). A load across the
axis makes the balls orbit unevenly, so that they push the cage aside, where it rests (a pattern at rest).
Nothing but the film holds the cage there, and its own centrifugal force drives it out: where its whirl about
that place grows (``growth``), it goes round in its lands (a pattern that turns), which raises torque and heat
by up to a fifth. Where the whirl decays the cage rests.

A search goes in pieces, none longer than one elimination of a pattern's equations, so that a model in a loop
in real time can make one per step; what a piece leaves to the next are ``PT.KEPT_SIZE`` numbers.
"""

import math

from fmu_bearing.engine.choices import BALL_GUIDED, OUTER_GUIDED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, ST, C, F, P, Q, R, W, Y
from fmu_bearing.engine.mechanics.bodies import guiding_ring
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.statics.axial import quasistatic
from fmu_bearing.engine.statics.place import upright_point
from fmu_bearing.engine.status import OK
from fmu_bearing.engine.steady.even import BOTH, OUTER, equalise_balls, settle_evenly
from fmu_bearing.engine.steady.growth import NOTHING, SHIFTS, begin_growth, growth_beside, land_speed
from fmu_bearing.engine.steady.newton import FAILED, GOES_ON, SETTLED, displace_cage, settle_once
from fmu_bearing.engine.steady.pattern import tail, take

#: What was found of the steady state: see `settle`; the last: nothing, but see `needs_carrying`.
NOT_FOUND, EVEN_BALLS, REST, WHIRL, CARRIED = range(5)
SEARCHING = -1  # nothing yet
# Stages of a search: even balls, the pattern at rest with pockets as they are, then with softer ones, the
# whirl's growth, the whirl.
_EVEN, _DIRECTLY, _SOFTLY, _GROWING, _WHIRLING = range(5)

# A whirl is looked for near the lands at the speed at which it grows, from where Newton's method came to the
# outer orbit in all cases tried with an orbit that the film holds (from half the clearance it ended in the
# middle at times); then from the dry stop, at a speed from where it came to orbits that the stop holds.
_ASIDE = 0.7  # of the clearance
_BEHIND_STOP = 0.01  # of the clearance
_TURNING = 0.55  # of shaft speed, in lands on the inner ring
# Of the clearance: a smaller orbit changes the lands' drag by less than 0.5 %, and runs pass it.
_LEAST = 0.1
_DIRECT = 8  # rounds with pockets as stiff as they are
_ROUNDS = 60
# Then pockets of this share of their stiffness, stiffer by this factor, and on by steps of the last one: of
# 240 cases (three bearings, 5,000 to 20,000 r/min, radial loads of 0.05 to 0.8 of the preload) the first way
# closed 233, the second 3, the third 2. Balls that soft pockets hardly hold go 0.2 mm along their orbits.
_WAYS = ((1e-3, 10.0), (1e-3, 1e3), (1e-4, 100.0))
_STIFFER = 100.0
_REACH = 3.0
_ACROSS = 1e-12  # m, rad: rings less apart are in line
_PRESSED = 5e-7  # m: into a spherical pocket at first; one that is not touched has no slope
_LOADED = 1e-3  # N: with less at a race its ball is loose


@kernel
def is_loaded(p, c, y, fixed):
    """Whether anything acts across the axis, or fixed rings are off the axis."""
    if fixed > OUTER:
        for i in range(Q.Y, Q.OUTER):
            other = Q.OUTER + (i if i < Q.INNER_BY else i + 1)
            if abs(y[Y.Q0 + i] - y[Y.Q0 + other]) > _ACROSS:
                return True
    elif c[C.LOAD_Y] != 0.0 or c[C.LOAD_Z] != 0.0 or p[P.MISALIGNMENT_Y] != 0.0:
        return True
    return p[P.GRAVITY] != 0.0 or p[P.MISALIGNMENT_Z] != 0.0


@kernel
def eccentricity(p, c, y):
    """Distance of the cage's middle from that of the ring that guides it, over the clearance of the lands."""
    k = Y.Q0 + Q.CAGE
    ring, _ = guiding_ring(p)
    aside_y = y[k + Q.Y] - y[Y.Q0 + ring + Q.Y]
    aside_z = y[k + Q.Z] - y[Y.Q0 + ring + Q.Z]
    return math.sqrt(aside_y * aside_y + aside_z * aside_z) / c[C.LAND_CLEARANCE]


@kernel
def press_spheres(p, w):
    """Move the balls of the unknowns along their orbits, behind or ahead as they are, into their spheres.

    Nothing but these carries the cage.
    """
    balls = int(p[P.BALLS])
    at = W.PATTERN + PT.UNKNOWNS
    cage = at + tail(p) + Q.CAGE
    wide = p[P.POCKET_CLEARANCE] + _PRESSED
    for j in range(balls):
        angle = 2.0 * math.pi * j / p[P.BALLS]
        co = math.cos(angle)
        si = math.sin(angle)
        axial = w[at + j] - w[cage]
        deep = w[at + balls + j] + w[cage + Q.Y] * si - w[cage + Q.Z] * co
        around = math.sqrt(max(wide * wide - axial * axial - deep * deep, 0.0))
        lead = at + 2 * balls + j
        around = math.copysign(around, w[lead]) - w[cage + Q.Y] * co - w[cage + Q.Z] * si
        w[lead] = around / p[P.PITCH_RADIUS]


@kernel
def begin_pattern(p, y, even, w):
    """Put to the unknowns the places of the state ``y`` with the means of the ``even`` one."""
    balls = int(p[P.BALLS])
    take(p, even, 0.0, w)
    at = W.PATTERN + PT.UNKNOWNS
    last = at + tail(p)
    for i in range(PT.BALL):
        if i == PT.PLACED - 1:
            continue
        mean = 0.0
        row = i if i < PT.PLACED else (Y.WX - Y.X) // (Y.R - Y.X) + i - PT.PLACED
        row = Y.X + row * (Y.R - Y.X)
        for j in range(balls):
            mean += y[row + j] / balls
        for j in range(balls):
            shift = 0.0 if i < PT.PLACED else w[at + i * balls + j] - mean
            w[at + i * balls + j] = y[row + j] + shift
    for i in range(Q.CAGE):
        if i != Q.OUTER + Q.TURN:
            w[last + i] = y[Y.Q0 + i]
    ring, tilt = guiding_ring(p)
    for i in (Q.Y, Q.Z):
        w[last + Q.CAGE + i] = y[Y.Q0 + ring + i]
    w[last + Q.CAGE + Q.BY] = y[Y.Q0 + tilt]
    w[last + Q.CAGE + Q.BZ] = y[Y.Q0 + tilt + 1]
    if p[P.CAGE] != 0.0 and p[P.GUIDANCE] == BALL_GUIDED:
        for i in (Q.Y, Q.Z):
            w[last + Q.CAGE + i] = 0.5 * (y[Y.Q0 + i] + y[Y.Q0 + Q.OUTER + i])
        press_spheres(p, w)


@kernel
def enter(w, stage, way):
    """Enter a stage of a search."""
    w[W.PATTERN + PT.STAGE] = stage
    w[W.PATTERN + PT.WAY] = way
    w[W.PATTERN + PT.ROUND] = 0.0


@kernel
def rest_softly(p, c, y, speed, fixed, even, rest, w, jac):
    """One round with pockets of a share of their stiffness: see ``_WAYS``; as `settle_once`."""
    ahead = math.copysign(1.0, speed)
    n = int(w[W.PATTERN + PT.WAY])
    softest, factor = _WAYS[0]
    if n == 1:
        softest, factor = _WAYS[1]
    elif n == 2:
        softest, factor = _WAYS[2]
    if w[W.PATTERN + PT.SHARE] == 0.0:
        begin_pattern(p, y, even, w)
        w[W.PATTERN + PT.SHARE] = softest
    share = w[W.PATTERN + PT.SHARE]
    stiffness = c[C.POCKET]
    c[C.POCKET] = share * stiffness
    reach = _REACH if share == softest else 1.0
    came = settle_once(p, c, speed, fixed, ahead, False, reach, rest, w, jac)
    c[C.POCKET] = stiffness
    if came != SETTLED or share >= 1.0:
        return came
    w[W.PATTERN + PT.SHARE] = min(1.0, (factor if share == softest else _STIFFER) * share)
    w[W.PATTERN + PT.ROUND] = -1.0
    return GOES_ON


@kernel
def balls_through(p, speed):
    """Which way balls run through a whirl, 1 or -1: one in the outer ring falls behind, another overtakes."""
    return math.copysign(1.0, speed if p[P.GUIDANCE] == OUTER_GUIDED else -speed)


@kernel
def begin_whirl(p, c, speed, even, whirl, w, jac):
    """Put the cage aside and the balls where that puts them; False where there is no solution."""
    turning = math.copysign(w[W.PATTERN + PT.FOUND_TURNING], speed)
    aside = _ASIDE
    if w[W.PATTERN + PT.WAY] != 0.0:
        aside = p[P.LAND_STOP_FRACTION] + _BEHIND_STOP
        turning = _TURNING * land_speed(p, speed)
    ahead = balls_through(p, speed)
    take(p, even, turning, w)
    return displace_cage(p, c, speed, aside * c[C.LAND_CLEARANCE], ahead, whirl, w, jac)


@kernel
def whirl_once(p, c, speed, fixed, even, whirl, w, jac):
    """One round towards an orbit of the cage, without loads; as `settle_once`."""
    load_y, load_z = c[C.LOAD_Y], c[C.LOAD_Z]
    neutral_y, neutral_z = c[C.NEUTRAL_Y], c[C.NEUTRAL_Z]
    c[C.LOAD_Y] = 0.0
    c[C.LOAD_Z] = 0.0
    c[C.NEUTRAL_Y] = 0.0
    c[C.NEUTRAL_Z] = 0.0
    aligned = p[P.MISALIGNMENT_Y] == 0.0 and p[P.MISALIGNMENT_Z] == 0.0
    round_seat = c[C.PEDESTAL_Y] == c[C.PEDESTAL_Z] and c[C.PEDESTAL_YZ] == 0.0
    # a ring that cannot turn with the whirl counts as fixed
    holds = fixed if aligned and round_seat else max(fixed, OUTER)
    came = FAILED
    if w[W.PATTERN + PT.ROUND] > 0.0 or begin_whirl(p, c, speed, even, whirl, w, jac):
        ahead = balls_through(p, speed)
        came = settle_once(p, c, speed, holds, ahead, True, 1.0, whirl, w, jac)
    c[C.LOAD_Y] = load_y
    c[C.LOAD_Z] = load_z
    c[C.NEUTRAL_Y] = neutral_y
    c[C.NEUTRAL_Z] = neutral_z
    return came


@kernel
def along_axis(p, c, y, speed, fixed, state, w):
    """Quasi-static ``state`` with nothing across the axis, of the loads or fixed rings of the state ``y``.

    That state itself where there is none.
    """
    outer = y[Y.Q0 + Q.OUTER]
    shift = y[Y.Q0] - outer
    status = OK
    # where mount or springs hold the ring along the axis, its place varies less than the balls' load
    if fixed < BOTH and p[P.RIGID] == 0.0 and p[P.SUPPORT_STIFFNESS] == 0.0:
        axial = w[W.STILL_EQUILIBRIUM : W.STILL_END]
        status = quasistatic(p, c, speed, axial)
        shift = axial[ST.AXIAL_SHIFT]
        outer = c[C.PRELOAD] / c[C.PEDESTAL_AXIAL]
    if status == OK:
        status = upright_point(p, c, speed, shift, outer, state, w)
    if status != OK:
        for i in range(Y.SIZE):
            state[i] = y[i]


@kernel
def state_at(w, place):
    """Return the state at ``w[W.PATTERN + place:]``."""
    return w[W.PATTERN + place : W.PATTERN + place + Y.SIZE]


@kernel
def begin_search(y, w):
    """Begin the search for the steady state near the quasi-static state ``y``."""
    even, rest, whirl = state_at(w, PT.EVEN_STATE), state_at(w, PT.REST_STATE), state_at(w, PT.WHIRL_STATE)
    for i in range(Y.SIZE):
        even[i] = y[i]
        rest[i] = 0.0
        whirl[i] = 0.0
    for i in range(PT.STAGE, PT.SIZE):
        w[W.PATTERN + i] = 0.0
    enter(w, _EVEN, 0.0)


@kernel
def settle_even_balls(p, c, y, speed, fixed, w, jac):
    """First stage of a search: as `search`, with the pattern at rest to go on with where loads ask for it."""
    even, rest = state_at(w, PT.EVEN_STATE), state_at(w, PT.REST_STATE)
    loaded = is_loaded(p, c, y, fixed)
    if loaded:
        # means over balls that loads across the axis make uneven are too far from even ones
        along_axis(p, c, y, speed, fixed, even, w)
    equalise_balls(p, c, even, speed)
    if not settle_evenly(p, c, even, speed, fixed, w, jac):
        return NOT_FOUND
    # patterns do not know springs between balls
    if loaded and p[P.SPRINGS] != 0.0:
        return EVEN_BALLS
    for i in range(Y.SIZE):
        rest[i] = even[i]
    if not loaded:
        return REST
    begin_pattern(p, y, even, w)
    enter(w, _DIRECTLY, 0.0)
    return SEARCHING


@kernel
def rest_once(p, c, y, speed, fixed, w, jac):
    """One round towards the pattern at rest; what is found."""
    even, rest = state_at(w, PT.EVEN_STATE), state_at(w, PT.REST_STATE)
    directly = w[W.PATTERN + PT.STAGE] == _DIRECTLY
    if directly:
        ahead = math.copysign(1.0, speed)
        came = settle_once(p, c, speed, fixed, ahead, False, 1.0, rest, w, jac)
    else:
        came = rest_softly(p, c, y, speed, fixed, even, rest, w, jac)
    if came == SETTLED:
        return REST
    w[W.PATTERN + PT.ROUND] += 1.0
    if came == GOES_ON and w[W.PATTERN + PT.ROUND] < (_DIRECT if directly else _ROUNDS):
        return SEARCHING
    # pockets that open or close between two balls are found by softer ones
    way = 0.0 if directly else w[W.PATTERN + PT.WAY] + 1.0
    if way == len(_WAYS):
        return EVEN_BALLS
    enter(w, _SOFTLY, way)
    w[W.PATTERN + PT.SHARE] = 0.0
    return SEARCHING


@kernel
def all_pressed(p, c, y, speed, w):
    """Whether all balls of the state ``y`` press both races."""
    right_hand_side(p, c, y, 0.0, speed, 0.0, w, w[W.F0 : W.F0 + F.SIZE])
    for j in range(int(p[P.BALLS])):
        if not (min(w[W.RACE + R.LOAD + j], w[W.RACE + R.SIZE + R.LOAD + j]) > _LOADED):
            return False
    return True


@kernel
def follow_whirl(p, c, speed, fixed, w, jac):
    """Stages of a search behind the pattern at rest: growth of the whirl, then the whirl; what is found."""
    even, rest, whirl = state_at(w, PT.EVEN_STATE), state_at(w, PT.REST_STATE), state_at(w, PT.WHIRL_STATE)
    if w[W.PATTERN + PT.STAGE] == _GROWING:
        if p[P.SPRINGS] != 0.0:
            w[W.PATTERN + PT.FOUND_GROWTH] = -NOTHING
            w[W.PATTERN + PT.FOUND_TURNING] = _TURNING * abs(speed)
        else:
            w[W.PATTERN + PT.ROUND] += 1.0
            ended = growth_beside(p, c, speed, fixed, rest, w, jac)
            if not ended and w[W.PATTERN + PT.ROUND] < SHIFTS:
                return SEARCHING
        if not (w[W.PATTERN + PT.FOUND_GROWTH] > 0.0):
            return REST
        enter(w, _WHIRLING, 0.0)
        return SEARCHING
    came = whirl_once(p, c, speed, fixed, even, whirl, w, jac)
    w[W.PATTERN + PT.ROUND] += 1.0
    # beyond ``P.LAND_STOP_FRACTION`` the dry stop carries the cage
    if came == SETTLED and eccentricity(p, c, whirl) > _LEAST:
        return WHIRL
    if came == GOES_ON and w[W.PATTERN + PT.ROUND] < _ROUNDS:
        return SEARCHING
    if w[W.PATTERN + PT.WAY] != 0.0:
        return REST
    enter(w, _WHIRLING, 1.0)
    return SEARCHING


@kernel
def search(p, c, y, speed, fixed, whirls, w, jac):
    """Make one piece of a search that `begin_search` has begun: `SEARCHING`, or what was found.

    Parameters as of `settle`, the same for all pieces; ``whirls``: whether to look for whirls.
    """
    if speed == 0.0:
        return NOT_FOUND
    if w[W.PATTERN + PT.STAGE] >= _GROWING:
        return follow_whirl(p, c, speed, fixed, w, jac)
    if w[W.PATTERN + PT.STAGE] == _EVEN:
        outcome = settle_even_balls(p, c, y, speed, fixed, w, jac)
    else:
        outcome = rest_once(p, c, y, speed, fixed, w, jac)
    if outcome != REST or not whirls or p[P.CAGE] == 0.0 or p[P.LAND] == 0.0:
        return outcome
    # an orbit of the cage is found with even balls, and says nothing where loads leave some loose
    if not all_pressed(p, c, state_at(w, PT.REST_STATE), speed, w):
        return REST
    enter(w, _GROWING, 0.0)
    begin_growth(p, speed, w)
    return SEARCHING


@kernel
def settle_at_rest(p, c, y, speed, fixed, w, jac):
    """As `settle`, but look for no whirl: `NOT_FOUND`, `EVEN_BALLS` or `REST`."""
    begin_search(y, w)
    outcome = SEARCHING
    while outcome == SEARCHING:
        outcome = search(p, c, y, speed, fixed, False, w, jac)
    return outcome


@kernel
def settle(p, c, y, speed, fixed, w, jac):
    """Find the steady state near the quasi-static state ``y`` at shaft ``speed`` (rad/s); ``y`` stays.

    Parameters: ``c`` without imperfections; ``fixed``: see `even.is_constrained`; ``jac``: scratch for a
    Jacobian. Returns what was found, and leaves it in ``PT.EVEN_STATE``, ``PT.REST_STATE`` and
    ``PT.WHIRL_STATE``: `NOT_FOUND`; `EVEN_BALLS`: these, but not where loads across the axis put them;
    `REST`: the cage rests, or no whirl was found; `WHIRL`: it whirls.
    """
    begin_search(y, w)
    outcome = SEARCHING
    while outcome == SEARCHING:
        outcome = search(p, c, y, speed, fixed, True, w, jac)
    return outcome


@kernel
def needs_carrying(p, c, y, fixed, outcome):
    """Whether loads across the axis act and no steady state of unequal balls is known: see `carried`.

    ``outcome``: of a search from the quasi-static state ``y``. Springs between balls keep even ones.
    """
    if outcome == EVEN_BALLS:
        return p[P.SPRINGS] == 0.0
    return outcome == NOT_FOUND and is_loaded(p, c, y, fixed)


@kernel
def settle_perfect(p, c, y, speed, fixed, w, jac):
    """As :func:`settle`, with imperfections in ``c`` that count as none meanwhile."""
    scale = c[C.OVERSIZE_SCALE]
    eccentric = c[C.ECCENTRICITY]
    of_cage = c[C.CAGE_ECCENTRICITY]
    c[C.OVERSIZE_SCALE] = 0.0
    c[C.ECCENTRICITY] = 0.0
    c[C.CAGE_ECCENTRICITY] = 0.0
    outcome = settle(p, c, y, speed, fixed, w, jac)
    c[C.OVERSIZE_SCALE] = scale
    c[C.ECCENTRICITY] = eccentric
    c[C.CAGE_ECCENTRICITY] = of_cage
    return outcome


@kernel
def losing_state(outcome, w):
    """State that has the losses of the operating point, by the ``outcome`` of :func:`settle`."""
    at = W.PATTERN + (
        PT.WHIRL_STATE if outcome == WHIRL else PT.REST_STATE if outcome == REST else PT.EVEN_STATE
    )
    return w[at : at + Y.SIZE]
