"""Fidelity `response`: the rings' steady linear answer to every excitation, as a sum of lines.

The rings rest at their static equilibrium; mass, damping and stiffness are as in fidelity `rings` there,
with the balls' stiffness averaged over the orbit. Each line turns with a ball 0's angle + b shaft's angle + m
times the angle by which the balls have turned in their orbiting axes. a, b and m are whole, so that phases
run on through changes of speed; amplitudes are renewed with what is ``held`` (speed by 1 %, conditions by
0.1 %), and at once: the transient of the change is left out.

Between communication points nothing is stepped but these angles, and sound is a sum of lines, too
(``sound``). Where it is sampled (recordings, radiation models of the papers), samples are interpolated
between states 19.5 us apart. Arguments: see `spindle.members`.
"""

import math

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.ball_motion import move_places, rest_balls
from fmu_bearing.engine.fidelities.condensed.rows import keep_balls, show_balls, turn_balls
from fmu_bearing.engine.fidelities.condensed.shared import advance, flat
from fmu_bearing.engine.fidelities.full.start import begin_means
from fmu_bearing.engine.fidelities.response import bearing
from fmu_bearing.engine.fidelities.response.coupled_lines import answer_lines, sum_set_lines
from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.fidelities.response.sound import (
    follow_lines,
    from_lines,
    renew_sound,
    show_pressures,
    sound_moved,
)
from fmu_bearing.engine.fidelities.rings import equations, held
from fmu_bearing.engine.fidelities.rings.march import emit_shown
from fmu_bearing.engine.fidelities.rings.rest import at_rest
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, STRIDE, C, L, P, S, T, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.rest import start_vector
from fmu_bearing.engine.status import NO_START, OK


@kernel
def show_guess(p, s, w, row):
    """Put the balls' places of row ``row`` of every bearing to its trial rows, on races without waves."""
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        for i in range(Y.SIZE):
            wb[W.STAGE + i] = 0.0
        lv = members.condensed(sb)
        show_balls(lv, row, wb)
        flat(members.parameters(p, b), sb[S.C : S.C + C.SIZE], lv, wb)


@kernel
def rest_from(p, s, w, speed, x, at):
    """Find the rest of all bodies, from the coordinates ``x[at:]`` and the balls' places ``L.EVEN``.

    Returns whether there is one; where there is none, these are taken as the rest.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    mean = members.history(p)
    place = members.vector(p, SP.PLACE)
    for i in range(members.padded_size(p)):
        ws[place + i] = x[at + i]
    show_guess(p, s, w, L.EVEN)
    found = at_rest(p, s, w, speed)
    for i in range(members.padded_size(p)):
        own[mean + i] = ws[place + i] if found else x[at + i]
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        if found:
            keep_balls(members.work(p, w, b), lv, L.EVEN)
        members.moved(p, b, own, mean, lv, L.MEAN)
        lv[L.MEAN] += own[members.per_bearing(p, b) + SP.OFFSET]
    return found


@kernel
def linearise(p, s, w, speed):
    """Renew derivatives of all bearings and the lines at ``speed`` (rad/s); False if there are none."""
    together = members.has_shaft(p)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        pb = members.parameters(p, b)
        if not bearing.linearise(pb, sb, not together, speed, members.work(p, w, b)):
            return False
    if together:
        answer_lines(p, s, w, speed)
    renew_sound(p, s, w, speed)
    return True


@kernel
def place(p, s, w, ahead, near):
    """Shaft, housing, rings and balls at ``ahead`` (s, may be negative) from the present time.

    ``near``: whether the balls' last places are good guesses.
    """
    if members.has_shaft(p):
        sum_set_lines(p, s, w, ahead)
        equations.show_rings(p, s)
    else:
        lv = members.condensed(s)
        theta, rolled, angle, speed = bearing.angles_at(s, ahead)
        bearing.sum_lines(lv, s[line_table(p) :], theta, rolled, angle, lv[L.RATIO] * speed, speed, w)
    for b in range(members.count(p)):
        bearing.settle(members.parameters(p, b), members.state(p, s, b), ahead, near, members.work(p, w, b))


@kernel
def keep_ball_loads(p, s, w):
    """Keep what the inner rings put on their balls, these being where `place` has found them."""
    if not members.has_shaft(p):
        return
    own = members.set_state(p, s)
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        lv = members.condensed(members.state(p, s, b))
        masses = members.row(p, b) + SP.ROW_MASS
        for i in range(SP.PLANE):
            load = -p[masses + i] * lv[L.A0 + i]
            for k in range(L.N):
                load += p[masses + i] * lv[L.MASS + i + L.COLUMN * k] * lv[L.A0 + k]
            for j in range(int(members.parameters(p, b)[P.BALLS])):
                load -= wb[T.FORCE + i * STRIDE + j]
            own[members.per_bearing(p, b) + SP.LOAD + i] = load


@kernel
def show(p, s, w, near):
    """State for outputs at the present time, the balls' rates from two places a little apart."""
    place(p, s, w, -bearing.BACK, near)
    for b in range(members.count(p)):
        bearing.keep_back(members.state(p, s, b))
    place(p, s, w, 0.0, True)
    for b in range(members.count(p)):
        pb = members.parameters(p, b)
        rest_balls(pb, members.condensed(members.state(p, s, b)), members.work(p, w, b))
    keep_ball_loads(p, s, w)
    equations.publish_rings(p, s)


@kernel
def begin_at_start(p, s, w, speed):
    """Put the equilibrium to that of the start; a set comes to rest again with the balls' places there."""
    own = members.set_state(p, s)
    if not members.has_shaft(p):
        for i in range(members.padded_size(p)):
            own[members.history(p) + i] = own[SP.S_HEAD + i]
        return
    ws = members.set_work(p, w)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        lv = members.condensed(sb)
        for j in range(STRIDE):
            lv[L.EVEN + j] = sb[S.Y + Y.X + j]
            lv[L.EVEN_R + j] = sb[S.Y + Y.R + j]
    start = members.vector(p, SP.NEWMARK)
    for i in range(members.padded_size(p)):
        ws[start + i] = own[SP.S_HEAD + i]
    rest_from(p, s, w, speed, ws, start)


@kernel
def start_response(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    status = held.start_held(p, u, s, w, t)
    if status != OK:
        return status
    own = members.set_state(p, s)
    speed = u[SP.U_SPEED]
    begin_at_start(p, s, w, speed)
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        for i in range(2 * STRIDE):
            lv[L.X + i] = lv[L.EVEN + i]
    if not linearise(p, s, w, speed):
        return NO_START
    show(p, s, w, True)
    for b in range(members.count(p)):
        begin_means(members.state(p, s, b))
    for i in range(2):
        own[SP.MEAN_HEAT + i] = 0.0
    if from_lines(p):
        show_pressures(p, s, w)
    return OK


@kernel
def rest_at_inputs(p, s, w, speed):
    """Find the rest of a set from the last one, or from where `held.hold_all` has left it; whether found."""
    own = members.set_state(p, s)
    if not members.has_shaft(p):
        return rest_from(p, s, w, speed, own, members.history(p))
    ws = members.set_work(p, w)
    held_rest = members.vector(p, SP.NEWMARK)
    found = start_vector(p, SP.UNKNOWNS)
    for i in range(members.padded_size(p)):
        ws[held_rest + i] = ws[found + i] if i < members.coordinates(p) else 0.0
    held.take_offsets(p, own)
    if not rest_from(p, s, w, speed, own, members.history(p)):
        rest_from(p, s, w, speed, ws, held_rest)
    return True


@kernel
def renew(p, u, s, w):
    """Renew what is held, the equilibrium from the old one, and lines, for the inputs ``u``; status code.

    Where Newton's method does not reach the new equilibrium from the old one, it starts from the quasi-static
    one, which is taken as the equilibrium where there is no rest (as at the start). Where balls have no rest
    about which to find lines, the rings stay still there (``solver.restarts`` counts it, and a warning says
    so).
    """
    own = members.set_state(p, s)
    speed = u[SP.U_SPEED]
    for b in range(members.count(p)):
        members.condensed(members.state(p, s, b))[L.KNOWN] = 0.0
    if held.hold_all(p, u, s, w) == OK and rest_at_inputs(p, s, w, speed) and linearise(p, s, w, speed):
        return OK
    together = members.has_shaft(p)
    for again in range(1 if together else 2):
        status = held.hold_from_zero(p, u, s, w, again == 0)
        if status != OK:
            return status
        if together:
            rest_from(p, s, w, speed, own, SP.S_HEAD)
        else:
            begin_at_start(p, s, w, speed)
        if linearise(p, s, w, speed):
            return OK
    own[members.march(p) + SP.LINES] = 0.0
    for b in range(members.count(p)):
        members.condensed(members.state(p, s, b))[L.COUNT] = 0.0
    renew_sound(p, s, w, speed)
    s[S.RESTARTS] += 1.0
    return OK


@kernel
def turn_all(p, s, h):
    """Turn the balls of all bearings through ``h`` (s)."""
    for b in range(members.count(p)):
        turn_balls(members.state(p, s, b), h)


@kernel
def advance_all(p, s, h):
    """Time, angle, speed and sums of all bearings at the end of the step ``h`` (s)."""
    for b in range(members.count(p)):
        advance(members.state(p, s, b), h)


@kernel
def sound_on_the_way(p, s, w, h, speed, near):
    """Go through the communication step ``h`` (s) from state to state, with sound samples between them."""
    longest = bearing.sample_spacing(p, s, speed)
    for b in range(1, members.count(p)):
        longest = min(longest, bearing.sample_spacing(members.parameters(p, b), s, speed))
    count = math.ceil(h / longest - 1e-9)
    step = h / count
    for b in range(members.count(p)):
        bearing.begin_spacing(members.state(p, s, b), step)
    for _ in range(int(count)):
        for b in range(members.count(p)):
            lv = members.condensed(members.state(p, s, b))
            move_places(lv, int(members.parameters(p, b)[P.LANES]))
        place(p, s, w, step, near)
        for b in range(members.count(p)):
            bearing.follow_balls(
                members.parameters(p, b), members.state(p, s, b), step, members.work(p, w, b)
            )
        near = True
        keep_ball_loads(p, s, w)
        turn_all(p, s, step)
        emit_shown(p, s, w, step)
        advance_all(p, s, step)


@kernel
def march_response(p, u, s, w, h):
    """Advance the state by the communication step ``h`` (s); status code."""
    own = members.set_state(p, s)
    speed = u[SP.U_SPEED]
    near = True
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        steps.begin_means(sb)
        if not bearing.is_near(sb, speed, h):
            near = False
    renewed = held.set_inputs_of(p, u, s, w, h)
    for b in range(members.count(p)):
        own[members.per_bearing(p, b) + SP.OFFSET_RATE] = 0.0
    if renewed:
        near = False
        status = renew(p, u, s, w)
        if status != OK:
            return status
    elif sound_moved(p, s, speed):
        renew_sound(p, s, w, speed)
    end = s[S.TIME] + h
    sampled = p[P.SOUND_SIZE] != 0.0 and not from_lines(p)
    if sampled:
        sound_on_the_way(p, s, w, h, speed, near)
    else:
        turn_all(p, s, h)
        advance_all(p, s, h)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        sb[S.TIME] = end
        sb[S.SPEED] = speed
    if not sampled:
        show(p, s, w, near)
    if from_lines(p):
        follow_lines(p, s, w, h)
    for b in range(members.count(p)):
        steps.end_means(members.state(p, s, b), h)
    return OK
