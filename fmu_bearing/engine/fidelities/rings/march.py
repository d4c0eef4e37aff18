"""Fidelity `rings`: the rings' degrees of freedom in time, of a set its coordinates, the balls condensed.

Newmark's method with beta = 1/12 (Fox and Goodwin 1949; the same as Numerov's for the positions): fourth
order in the positions for any force that depends on position and time, second order in the small terms
that depend on velocity. Beta's next term, which depends on the mode, keeps resonances in their place
(:func:`predictor.displaced`). Linearly implicit: the accelerations are guessed from earlier ones and
corrected by one evaluation with the inverse of B - h/2 J_v - h^2 beta J_x (B: masses), whose J is renewed
only when the correction stops contracting. A second evaluation follows where the first correction, times the
contraction measured now and then, would leave too much. Newmark's own velocity is true but for h^2/12 times
the rate of acceleration, which outputs take away again, and which is exchanged when the step changes.

A step is repeated at half its length when the correction does not settle, when balls find no rest, or when
the third difference of the accelerations shows that it is too long. Arguments: see `correction`.
"""

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.ball_motion import move_balls, move_places
from fmu_bearing.engine.fidelities.condensed.balls import count_settled
from fmu_bearing.engine.fidelities.condensed.defects import show_directions
from fmu_bearing.engine.fidelities.condensed.patterns import keep_patterns, prepare_step
from fmu_bearing.engine.fidelities.condensed.rows import turn_balls
from fmu_bearing.engine.fidelities.condensed.shared import advance, build_operator, keep_end, show_end
from fmu_bearing.engine.fidelities.rings import equations, frozen_points, growth, predictor
from fmu_bearing.engine.fidelities.rings.correction import correct
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, SP, STRIDE, H, L, P, S, T, U, W, Y
from fmu_bearing.engine.mechanics.race import passing_time, wave_time
from fmu_bearing.engine.readout.defects import watch_defects
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import grow
from fmu_bearing.engine.spindle.sound_sum import emit, sampled
from fmu_bearing.engine.status import NOT_CONVERGED, OK

_LONGEST = 2e-5  # s
# Radians per step. The highest ring mode: below the 2.45 at which the method turns unstable, with room for
# stiffness that varies. The fastest wave: the method errs by 1/240 of what it excites, 0.04 dB; at 10 kHz
# the step is 16 us.
_MODE = 2.2
_WAVE = 1.0
_PROBE = 32  # steps between measurements of the contraction
_SLOW = 0.25  # contraction beyond which a new Jacobian (23 evaluations) pays
# Shares of the tolerance: what the correction may leave in a step, and what the step's own error estimate
# may reach. Both repeat at every step and mostly alternate in sign.
_CORRECTION = 0.01
_TRUNCATION = 1.0
_GROW = 1.0 / 40  # of the allowed error: twice the step makes 16 times the error
FIRST = 1.0 / 16  # of the longest step: the first one
_PATIENCE = 8  # steps before a longer one is tried
_HURRY = 3.0  # of what is frozen; what it jumps by at a renewal moves the rings


@kernel
def longest_step(p, highest, speed):
    """Longest internal step (s) at ``speed``: see the limits above; ``highest``: mode (rad/s)."""
    h = min(_LONGEST, p[P.MAX_STEP])
    h = min(h, _MODE / (highest + 1.0))
    return min(h, _WAVE * wave_time(p, speed), passing_time(p, speed))


@kernel
def longest_of_all(p, own, speed):
    """Longest internal step (s) at ``speed`` (rad/s)."""
    # a shaft that bends has modes far above those that matter: see `displace`
    highest = 0.0 if equations.bends(p) else own[members.march(p) + H.HIGHEST]
    longest = longest_step(members.parameters(p, 0), highest, speed)
    for b in range(1, members.bearing_count(p)):
        longest = min(longest, longest_step(members.parameters(p, b), highest, speed))
    return longest


@kernel
def accept_balls(p, s, h, w):
    """Move the balls' state and the angle of ball 0 to the end of the step."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    lanes = int(p[P.LANES])
    move_places(lv, lanes)
    for row in range(0, 2 * STRIDE, STRIDE):
        for j in range(row, row + lanes, FOUR):
            store(lv, L.X + j, load(w, T.X + j))
    if p[P.SOUND_SIZE] != 0.0:
        move_balls(p, lv, h, w, W.STAGE + Y.V0, w)
    keep_patterns(p, lv, h, w)
    count_settled(lv, lanes, w)
    turn_balls(s, h)


@kernel
def try_step(p, s, w, h, tolerance):
    """One attempt of length ``h``: its error over the allowed one, or -1 with a fresh Jacobian in vain."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    numbers = members.march(p)
    vectors = members.history(p)
    predictor.change_spacing(own, numbers, vectors, lanes, members.coordinates(p), h)
    equations.share_march(p, s)
    for _ in range(2):
        if (
            own[numbers + H.CONTRACTION] > _SLOW
            and own[numbers + H.FRESH] == 0.0
            and not equations.renew(p, s, w)
        ):
            return -1.0
        for b in range(members.bearing_count(p)):
            prepare_step(members.condensed(members.state(p, s, b)), h, members.work(p, w, b))
        if abs(h - own[numbers + H.FACTOR_STEP]) > 0.05 * h:
            if not equations.factor_step(p, s, w, h):
                return -1.0
            own[numbers + H.FACTOR_STEP] = h
        probe = s[S.STEPS] % _PROBE == 0.0
        left = correct(p, s, w, h, _CORRECTION * tolerance, probe)
        if left >= 0.0:
            acc = members.vector(p, SP.ACCELERATION)
            third = predictor.judged(own, numbers, vectors, lanes, ws, acc, members.vector(p, SP.INCREMENT))
            return 0.01 * h * third / (_TRUNCATION * tolerance)
        if own[numbers + H.FRESH] != 0.0:
            return -1.0
        own[numbers + H.CONTRACTION] = 1.0
    return -1.0


@kernel
def emit_rings(p, s, w, h):
    """Sound samples of the step ``h`` (s) just made; publish its end."""
    equations.show(p, s)
    emit_shown(p, s, w, h)


@kernel
def emit_shown(p, s, w, h):
    """Sound samples of the step ``h`` (s) to the rings as they are shown; publish its end."""
    for b in range(members.bearing_count(p)):
        show_end(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b), h)
    emit(p, s, w, h)
    for b in range(members.bearing_count(p)):
        keep_end(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))


@kernel
def watches(p):
    """Whether a bearing has local defects, whose passing balls are watched."""
    found = False
    for b in range(members.bearing_count(p)):
        if members.parameters(p, b)[P.DEFECTS] != 0.0:
            found = True
    return found


@kernel
def accept(p, s, w, h):
    """Move the state to the end of the step ``h`` (s)."""
    own = members.set_state(p, s)
    vectors = members.history(p)
    lanes = members.padded_size(p)
    predictor.move_on(
        own, vectors, lanes, members.set_work(p, w), members.vector_at(lanes, SP.ACCELERATION),
        members.vector_at(lanes, SP.PLACE), members.vector_at(lanes, SP.NEWMARK),
    )  # fmt: skip
    numbers = members.march(p)
    own[numbers + H.KNOWN] += 1.0
    own[numbers + H.CALM] += 1.0
    own[numbers + H.FRESH] = 0.0
    for b in range(members.bearing_count(p)):
        accept_balls(members.parameters(p, b), members.state(p, s, b), h, members.work(p, w, b))
        bearing_at = members.per_bearing(p, b)
        own[bearing_at + SP.OFFSET] += h * own[bearing_at + SP.OFFSET_RATE]
    equations.share_march(p, s)
    if sampled(p) or watches(p):
        emit_rings(p, s, w, h)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        advance(pb, sb, h)
        if pb[P.DEFECTS] != 0.0:
            show_directions(pb, members.condensed(sb), sb, S.DEFECT_AXES)
            watch_defects(pb, sb, h)


@kernel
def take_inputs(p, u, s, w, h):
    """Set conditions, loads and ramps; renew what is frozen where it is out of date. Status code.

    In pieces, one per `frozen_points.PIECE` of simulated time (`make_piece`). Between them the march goes on
    with the operators of before. A search for what uneven balls add waits.
    """
    own = members.set_state(p, s)
    at = members.march(p)
    off = frozen_points.set_inputs(p, u, s, w, h)
    if members.has_shaft(p):
        # the steady forces were found at a speed before that of the points
        aim = own[at + SP.AIM]
        off = max(off, abs(u[U.SPEED] - aim) / (0.01 * abs(aim) + 1e-3))
    renewed = frozen_points.due(p, s, off, _HURRY, False, h)
    due = frozen_points.pieces_due(p, s, h)
    if frozen_points.speeds_differ(u[U.SPEED], members.condensed(members.state(p, s, 0))[L.FROZEN_SPEED]):
        due = frozen_points.MOST
    while due >= 1.0:
        due -= 1.0
        if own[at + SP.STAGE] == 0.0 and renewed:
            renewed = False
            own[at + SP.STAGE] = 1.0
        if own[at + SP.STAGE] != 0.0:
            if not make_piece(p, u, s, w):
                own[at + SP.STAGE] = 0.0
                return NOT_CONVERGED
        elif frozen_points.searching(p, s):
            renewed = frozen_points.search_piece(p, s, w)
        else:
            break
    growth.search(p, s, w, h)
    return OK


@kernel
def count_pieces(p):
    """Return how many pieces a renewal has."""
    count = members.bearing_count(p)
    return 2 + 2 * count if members.has_shaft(p) else 2


@kernel
def make_piece(p, u, s, w):
    """Make the next piece of the renewal that goes on; False where there is no rest.

    Of a set: where it rests, by how much each bearing's steady force exceeds the quasi-static one there, then
    where it rests with all bearings' points, for the inputs of now. At last each bearing's operator.
    """
    own = members.set_state(p, s)
    at = members.march(p)
    pieces = count_pieces(p)
    piece = int(own[at + SP.STAGE]) - 1
    own[at + SP.STAGE] = piece + 2.0
    if piece + 1 == pieces:
        own[at + SP.STAGE] = 0.0
        own[at + SP.NEW] = 1.0
        frozen_points.pause(p, s, pieces)
    b = piece + members.bearing_count(p) - pieces  # whose operator is due; none: negative
    if b >= 0:
        build_operator(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))
        return restart_here(p, s, w)
    if b == -1:
        return frozen_points.freeze_points(p, u, True, False, s, w) == OK
    if piece == 0:
        return frozen_points.rest_set(p, u, True, s, w) == OK
    frozen_points.renew_excess_force(p, u, piece - 1, s, w)
    return True


@kernel
def restart_here(p, s, w):
    """Let the march begin with what is frozen now; False where balls find no rest."""
    own = members.set_state(p, s)
    own[members.march(p) + H.KNOWN] = 0.0
    equations.share_march(p, s)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        for i in range(Y.SIZE):
            wb[W.STAGE + i] = 0.0
    return equations.restart_march(p, s, w)


@kernel
def go_on(p, u, s, w, h, remaining, end):
    """Step through what remains (s) of the communication step ``h`` (s) to time ``end``; status code."""
    own = members.set_state(p, s)
    speed = u[U.SPEED]
    numbers = members.march(p)
    tolerance = steps.velocity_tolerance(p, speed)
    longest = longest_of_all(p, own, max(abs(s[S.SPEED]), abs(speed)))
    left = steps.most_attempts(h, longest, 100.0)
    growing = p[P.FITS] != 0.0 and s[S.SPEED_RATE] != 0.0
    while steps.unfinished(remaining, h, end):
        cap = min(s[S.STEP], longest)
        length = steps.even_length(remaining, cap)
        if growing:
            grow(p, u, s, w, s[S.SPEED] + length * s[S.SPEED_RATE])
        error = try_step(p, s, w, length, tolerance)
        left -= 1.0
        if not (0.0 <= error <= 1.0):
            if not steps.rejected(s, 0.5 * length, h) or left < 0.0:
                return NOT_CONVERGED
            continue
        if left < 0.0:
            return NOT_CONVERGED
        accept(p, s, w, length)
        remaining = end - s[S.TIME]
        if error < _GROW and own[numbers + H.CALM] >= _PATIENCE and own[numbers + H.KNOWN] >= 3.0:
            s[S.STEP] = min(longest, 2.0 * cap)
    return OK
