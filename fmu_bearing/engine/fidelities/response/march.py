"""Fidelity `response`: the rings' steady linear response to every excitation, as a sum of lines.

The rings rest at their static equilibrium; mass, damping and stiffness are as in fidelity `rings` there,
with the balls' stiffness averaged over the orbit. Each line turns with a ball 0's angle + b shaft's angle + m
times the angle by which the balls have turned in their orbiting axes. a, b and m are whole, so that phases
run on through changes of speed; amplitudes are renewed with what is frozen (speed by 0.5 %, conditions by
0.1 %), in pieces (``renewal``), and blended (``exchange``): the transient of the change is left out.

Between communication points nothing is stepped but these angles, and sound is a sum of lines, too
(``sound``). Where it is sampled (recordings, radiation models of the papers), samples are interpolated
between states 19.5 us apart. Arguments: see `spindle.members`.
"""

import math

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.condensed.ball_motion import move_places, rest_balls
from fmu_bearing.engine.fidelities.condensed.rows import turn_balls
from fmu_bearing.engine.fidelities.condensed.shared import advance
from fmu_bearing.engine.fidelities.full.start import begin_means, exceeds_pedestal
from fmu_bearing.engine.fidelities.response import bearing, drift, renewal
from fmu_bearing.engine.fidelities.response.equilibrium import linearise, rest_from
from fmu_bearing.engine.fidelities.response.exchange import copy, move_rings, settles
from fmu_bearing.engine.fidelities.response.line_sound import follow_lines, from_lines, show_pressures
from fmu_bearing.engine.fidelities.rings import equations, frozen_points, growth
from fmu_bearing.engine.fidelities.rings.march import emit_shown
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, STRIDE, L, P, S, T, U
from fmu_bearing.engine.readout.contacts import knows_balls
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.sound_sum import reads_sensors
from fmu_bearing.engine.status import NO_START, OK, TOO_SOFT


@kernel
def place(p, s, w, ahead, near):
    """Shaft, housing, rings and balls at ``ahead`` (s, may be negative) from the present time.

    ``near``: whether the balls' last places are good guesses.
    """
    place_rings(p, s, w, ahead)
    for b in range(members.bearing_count(p)):
        bearing.settle(members.parameters(p, b), members.state(p, s, b), ahead, near, members.work(p, w, b))


@kernel
def place_rings(p, s, w, ahead):
    """As `place`, without the balls."""
    move_rings(p, s, w, ahead)
    if members.has_shaft(p):
        equations.show_rings(p, s)


@kernel
def keep_ball_loads(p, s, w):
    """Keep what the inner rings put on their balls, these being where `place` has found them."""
    if not members.has_shaft(p):
        return
    own = members.set_state(p, s)
    for b in range(members.bearing_count(p)):
        if not knows_balls(p, members.state(p, s, b)):
            continue
        wb = members.work(p, w, b)
        for i in range(SP.PLANE):
            load = 0.0
            for j in range(int(members.parameters(p, b)[P.BALLS])):
                load -= wb[T.FORCE + i * STRIDE + j]
            own[members.per_bearing(p, b) + SP.LOAD + i] = load


@kernel
def step_back(p, s, w):
    """Put rings and shaft to where they were `bearing.BACK` ago, by their rates and accelerations.

    What a line's third derivative leaves out is 3e-3 of a ball's velocity by it at 10 kHz. A second sum of
    all lines would take half of the time of a step.
    """
    back = bearing.BACK
    if members.has_shaft(p):
        x, lanes, first = members.set_state(p, s), members.padded_size(p), SP.S_HEAD
        kept, at = members.set_work(p, w), members.matrix(p)
    else:
        x, lanes, first = members.condensed(s), L.COLUMN, L.Q0
        kept, at = w, T.BLENDED
    for i in range(lanes):
        kept[at + i] = x[first + i]
        kept[at + lanes + i] = x[first + lanes + i]
        acc = x[first + 2 * lanes + i]
        x[first + i] -= back * (x[first + lanes + i] - 0.5 * back * acc)
        x[first + lanes + i] -= back * acc
    if members.has_shaft(p):
        equations.show_rings(p, s)


@kernel
def step_on(p, s, w):
    """Put rings and shaft to where they were before `step_back`."""
    if members.has_shaft(p):
        own, lanes, ws = members.set_state(p, s), members.padded_size(p), members.set_work(p, w)
        copy(ws[members.matrix(p) :], own[SP.S_HEAD :], 0, 2 * lanes)
        equations.show_rings(p, s)
    else:
        copy(w[T.BLENDED :], members.condensed(s)[L.Q0 :], 0, 2 * L.COLUMN)


@kernel
def show(p, s, w, near, every):
    """State for outputs at the present time, the balls' rates from two places a little apart.

    Balls that nobody reads are left as they are and count as unknown, unless ``every`` one is to be shown.
    """
    read = every
    for b in range(members.bearing_count(p)):
        read = read or members.parameters(p, b)[P.READ_BALLS] != 0.0
    place_rings(p, s, w, 0.0)
    if read:
        step_back(p, s, w)
        for b in range(members.bearing_count(p)):
            pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
            if every or pb[P.READ_BALLS] != 0.0:
                bearing.settle(pb, sb, -bearing.BACK, near and knows_balls(p, sb), wb)
                bearing.keep_back(sb)
        step_on(p, s, w)
    for b in range(members.bearing_count(p)):
        pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
        if every or pb[P.READ_BALLS] != 0.0:
            bearing.settle(pb, sb, 0.0, True, wb)
            rest_balls(pb, members.condensed(sb), wb)
        else:
            members.condensed(sb)[L.KNOWN] = 0.0
    keep_ball_loads(p, s, w)
    equations.publish_rings(p, s)


@kernel
def linearise_at_rest(p, s, w, speed):
    """Find the rest from the coordinates in ``SP.S_HEAD``, and lines about it; False if there are none."""
    rest_from(p, s, w, speed, members.set_state(p, s), SP.S_HEAD)
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        for i in range(2 * STRIDE):
            lv[L.X + i] = lv[L.EVEN + i]
    return linearise(p, s, w, speed)


@kernel
def start_response(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    status = frozen_points.start_frozen(p, u, s, w, t)
    if status != OK:
        return status
    own = members.set_state(p, s)
    speed = u[U.SPEED]
    if not linearise_at_rest(p, s, w, speed):
        # balls that hardly touch may rest at the quasi-static place alone, not where `full` starts
        status = frozen_points.freeze_from_zero(p, u, s, w)
        if status == OK and not linearise_at_rest(p, s, w, speed):
            status = NO_START
        if status != OK:
            return status
    growth.search_at_once(p, s, w)
    renewal.mirror(p, u, s)
    for b in range(members.bearing_count(p)):
        members.condensed(members.state(p, s, b))[L.KNOWN] = 1.0  # where they rest in the equilibrium
    show(p, s, w, True, True)
    for b in range(members.bearing_count(p)):
        begin_means(members.state(p, s, b))
    for i in range(2):
        own[SP.MEAN_HEAT + i] = 0.0
    if from_lines(p):
        show_pressures(p, s, w)
    return OK


@kernel
def turn_all(p, s, h):
    """Turn the balls of all bearings through ``h`` (s)."""
    for b in range(members.bearing_count(p)):
        turn_balls(members.state(p, s, b), h)


@kernel
def advance_all(p, s, h):
    """Time, angle, speed and sums of all bearings at the end of the step ``h`` (s)."""
    for b in range(members.bearing_count(p)):
        advance(members.parameters(p, b), members.state(p, s, b), h)


@kernel
def sound_on_the_way(p, s, w, h, speed, near):
    """Go through the communication step ``h`` (s) from state to state, with sound samples between them."""
    longest = bearing.sample_spacing(p, s, speed)
    for b in range(1, members.bearing_count(p)):
        longest = min(longest, bearing.sample_spacing(members.parameters(p, b), s, speed))
    count = math.ceil(h / longest - 1e-9)
    step = h / count
    for b in range(members.bearing_count(p)):
        bearing.begin_spacing(members.state(p, s, b), step)
    for _ in range(int(count)):
        for b in range(members.bearing_count(p)):
            lv = members.condensed(members.state(p, s, b))
            move_places(lv, int(members.parameters(p, b)[P.LANES]))
        place(p, s, w, step, near)
        for b in range(members.bearing_count(p)):
            bearing.follow_balls(
                members.parameters(p, b), members.state(p, s, b), step, members.work(p, w, b)
            )
        near = True
        keep_ball_loads(p, s, w)
        turn_all(p, s, step)
        emit_shown(p, s, w, step)
        advance_all(p, s, step)


@kernel
def motion_on_the_way(p, s, w, h, speed):
    """As `sound_on_the_way`, for accelerometers alone: no ball is placed, and the end is not shown."""
    longest = bearing.sample_spacing(p, s, speed)
    for b in range(1, members.bearing_count(p)):
        longest = min(longest, bearing.sample_spacing(members.parameters(p, b), s, speed))
    count = math.ceil(h / longest - 1e-9)
    for _ in range(int(count)):
        place_rings(p, s, w, h / count)
        turn_all(p, s, h / count)
        emit_shown(p, s, w, h / count)
        advance_all(p, s, h / count)


@kernel
def march_response(p, u, s, w, h):
    """Advance the state by the communication step ``h`` (s); status code."""
    own = members.set_state(p, s)
    speed = u[U.SPEED]
    near = True
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        steps.begin_means(sb)
        if not bearing.is_near(sb, speed, h):
            near = False
    off = frozen_points.set_inputs(p, u, s, w, h)
    if exceeds_pedestal(p, s):
        return TOO_SOFT
    status, fresh = renewal.go_on(p, u, s, w, h, off, drift.follow(p, u, s, w, h, off))
    if status != OK:
        return status
    if fresh:
        # what was renewed is for inputs ahead of these
        frozen_points.set_inputs(p, u, s, w, h)
        drift.begin_line(p, u, s, w)
    for b in range(members.bearing_count(p)):
        own[members.per_bearing(p, b) + SP.OFFSET_RATE] = 0.0
    growth.search(p, s, w, h)
    near = near and not fresh
    end = s[S.TIME] + h
    sampled = p[P.SOUND_SIZE] != 0.0 and not from_lines(p)
    if sampled:
        sound_on_the_way(p, s, w, h, speed, near)
    elif reads_sensors(p):
        motion_on_the_way(p, s, w, h, speed)
    else:
        turn_all(p, s, h)
        advance_all(p, s, h)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        sb[S.TIME] = end
        sb[S.SPEED] = speed
    if not sampled:
        # warnings are of loads and angles about the equilibrium
        show(p, s, w, near, fresh or settles(p, s, h))
    if from_lines(p) and p[P.READ_SOUND] != 0.0:
        follow_lines(p, s, w, h)
    for b in range(members.bearing_count(p)):
        steps.end_means(members.state(p, s, b), h)
    return OK
