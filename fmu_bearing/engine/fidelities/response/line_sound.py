"""Sound of fidelity `response` from its lines: levels and pressures without samples.

Each line of the rings, and each line of what balls do without them (``ball_sound``), is a sound of one
frequency. Its complex pressure at every microphone is found when lines are renewed. Between communication
points only phases turn and meters are moved (``sound.beats``). Transients after jumps and at the start are
left out, as for motion.

Pressures come as late as in the other fidelities: phases are those of that time ago.
Arguments: see `spindle.members`; ``ps``, ``ss``, ``ws``: sound block of the first bearing, which meters.
"""

import math

from fmu_bearing.engine.choices import CONTACTS
from fmu_bearing.engine.fidelities.response import ball_sound
from fmu_bearing.engine.fidelities.response.coupled_lines import frequency
from fmu_bearing.engine.fidelities.response.lines import STILL, line_table, orders
from fmu_bearing.engine.fidelities.response.strongest_lines import counted, place_for
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import LN, SD, SL, SP, C, L, P, Q, S, T, W
from fmu_bearing.engine.readout.motion import sound_block
from fmu_bearing.engine.sound import beats
from fmu_bearing.engine.sound.transfer import add_channel, bound, clear_channels, radiate
from fmu_bearing.engine.spindle import members

_LEAST = 1e-14  # s: averages of up to 10 s do not move in less, which rounding leaves where metering begins
_HASH_SHAFT, _HASH_ROLLED, _HASH_MEMBER = 31, 17, 101  # so that few lines share a chain


@kernel
def from_lines(p):
    """Whether the sound is made of lines."""
    return p[P.SOUND_SIZE] != 0.0 and sound_block(p)[SD.H_LINES] != 0.0


@kernel
def chain_of(ball, shaft, rolled, member):
    """Return the number of the chain in which a line of these multiples is."""
    key = ball + _HASH_SHAFT * shaft + _HASH_ROLLED * rolled + _HASH_MEMBER * member
    return int(key) % SL.HEADS


@kernel
def begin_table(ps, ss, ws):
    """Empty the table of lines and its chains."""
    ss[SD.SS_LINES] = 0.0
    heads = int(ps[SD.H_W_INDEX]) + SL.INDEX_ROWS * int(ps[SD.H_LINES])
    for i in range(SL.HEADS):
        ws[heads + i] = -1.0
    ws[note(ps, SL.NOTE_STRONGEST)] = 0.0


@kernel
def write_line(ps, ss, ws, line, ball, shaft, rolled, member, omega):
    """Write multiples and frequency of a line, and clear its rows."""
    at = int(ps[SD.H_S_LINES]) + line * beats.line_size(ps)
    ss[at + SL.LINE_BALL] = ball
    ss[at + SL.LINE_SHAFT] = shaft
    ss[at + SL.LINE_ROLLED] = rolled
    ss[at + SL.LINE_MEMBER] = member
    ws[int(ps[SD.H_W_INDEX]) + line] = omega
    rows = int(ps[SD.H_W_PARTS]) + line * beats.part_size(ps)
    for i in range(beats.part_size(ps)):
        ws[rows + i] = 0.0


@kernel
def find_line(ps, ss, ws, ball, shaft, rolled, member):
    """Return the number of the line of these multiples among those of the rings; -1: none."""
    index = int(ps[SD.H_W_INDEX])
    heads = index + SL.INDEX_ROWS * int(ps[SD.H_LINES])
    line = int(ws[heads + chain_of(ball, shaft, rolled, member)])
    while line >= 0:
        at = int(ps[SD.H_S_LINES]) + line * beats.line_size(ps)
        if (
            ss[at + SL.LINE_BALL] == ball
            and ss[at + SL.LINE_SHAFT] == shaft
            and ss[at + SL.LINE_ROLLED] == rolled
            and ss[at + SL.LINE_MEMBER] == member
        ):
            return line
        line = int(ws[index + SL.INDEX_NEXT * int(ps[SD.H_LINES]) + line])
    return -1


@kernel
def set_rings(pb, lv, x, ps, ws, q, re, im, omega, speed):
    """Fill the channels of what a line does to one bearing: coordinates ``q[re:]`` and ``q[im:]``."""
    clear_channels(ps, ws)
    if int(ps[SD.H_FORM]) == CONTACTS:
        ball_sound.add_ring_contacts(pb, lv, ps, ws, q, re, im, omega, speed, 0)
    else:
        add_bodies(ps, ws, q, re, im, -omega * omega)
    ball_sound.follow_rings(pb, lv, x, ps, ws, q, re, im, omega, speed, 0)


@kernel
def add_bodies(ps, ws, q, re, im, squared):
    """Add the accelerations of both rings (form vectors), ``squared`` times their coordinates."""
    for k in range(SD.AXES):
        a, b = Q.INNER + k, Q.OUTER + k
        add_channel(ps, ws, SD.C_INNER + k, squared * complex(q[re + a], q[im + a]))
        add_channel(ps, ws, SD.C_OUTER + k, squared * complex(q[re + b], q[im + b]))
    for k in range(SD.TILTS):
        a, b = Q.INNER + Q.INNER_BY + k, Q.OUTER + Q.BY + k
        add_channel(ps, ws, SD.C_TILTS + k, squared * complex(q[re + a], q[im + a]))
        add_channel(ps, ws, SD.C_TILTS + SD.TILTS + k, squared * complex(q[re + b], q[im + b]))


@kernel
def scratch_of(sb):
    """Return the scratch of a bearing's lines."""
    return sb[S.JAC : S.JAC + LN.SIZE]


@kernel
def sound_of_rings(p, s, w, line, lines, at, omega, speed):
    """Add what all bearings sound by as the rings move in a line at ``lines[at:]``."""
    ps = sound_block(p)
    first = members.work(p, w, 0)[W.SOUND :]
    lanes = members.padded_size(p)
    for b in range(members.bearing_count(p)):
        pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
        block = sound_block(pb)
        if block[SD.H_SOURCES] == 0.0:
            continue
        members.driven_motion(p, b, lines, at, wb, T.D)
        members.driven_motion(p, b, lines, at + lanes, wb, T.A)
        ws = wb[W.SOUND :]
        set_rings(pb, members.condensed(sb), scratch_of(sb), block, ws, wb, T.D, T.A, omega, speed)
        if radiate(block, ws, omega):
            beats.add_rows(ps, first, line, block, ws, b)


@kernel
def ring_lines(p, s):
    """Lines of the rings: the array, how many numbers a line has, where its coordinates begin, how many."""
    own = members.set_state(p, s)
    if members.has_shaft(p):
        count = int(own[members.march(p) + SP.LINES])
        return own[members.lines(p) :], members.line_size(p), SP.LINE_REAL, count
    return s[line_table(p) :], L.LINE_SIZE, L.LINE_REAL, int(s[S.CONDENSED + L.COUNT])


@kernel
def add_rings(p, s, w, speed, first, many):
    """Begin the table with lines of the rings: ``many`` from number ``first`` on; whether more are left."""
    ps, ss = sound_block(p), s[S.SOUND :]
    ws = members.work(p, w, 0)[W.SOUND :]
    together = members.has_shaft(p)
    lines, size, values, count = ring_lines(p, s)
    index = int(ps[SD.H_W_INDEX])
    heads = index + SL.INDEX_ROWS * int(ps[SD.H_LINES])
    if first == 0:
        begin_table(ps, ss, ws)
    for line in range(first, min(first + many, count)):
        at = line * size
        member = int(lines[at + SP.LINE_MEMBER]) if together else 0
        ball, shaft, rolled = lines[at + L.LINE_BALL], lines[at + L.LINE_SHAFT], lines[at + L.LINE_ROLLED]
        omega = frequency(members.condensed(members.state(p, s, member)), lines, at, speed)
        write_line(ps, ss, ws, line, ball, shaft, rolled, member, omega)
        chain = heads + chain_of(ball, shaft, rolled, member)
        ws[index + SL.INDEX_NEXT * int(ps[SD.H_LINES]) + line] = ws[chain]
        ws[chain] = line
        sound_of_rings(p, s, w, line, lines, at + values, omega, speed)
        most = note(ps, SL.NOTE_STRONGEST)
        ws[most] = max(ws[most], beats.weigh_line(ps, ss, ws, line))
        ss[SD.SS_LINES] = line + 1.0
    return count > first + many


@kernel
def add_balls(p, s, w, b, ball, shaft, rolled, omega):
    """Add the sound of balls whose channels are filled to the line of these multiples, or as a new one."""
    ps, ss = sound_block(p), s[S.SOUND :]
    ws = members.work(p, w, 0)[W.SOUND :]
    block = sound_block(members.parameters(p, b))
    own = members.work(p, w, b)[W.SOUND :]
    least = beats.WEAK * ws[note(ps, SL.NOTE_STRONGEST)]
    if bound(block, own, omega) ** 2 <= least or not radiate(block, own, omega):
        return
    line = find_line(ps, ss, ws, ball, shaft, rolled, b)
    if line < 0:
        weight = beats.weight_of_rows(block, own)
        if not (weight > least):
            return
        table = ss[int(ps[SD.H_S_LINES]) :]
        most, count, size = int(ps[SD.H_LINES]), int(ss[SD.SS_LINES]), beats.line_size(ps)
        line = place_for(table, size, count, most, weight)
        if line < 0:
            return
        write_line(ps, ss, ws, line, ball, shaft, rolled, b, omega)
        table[line * size + SL.LINE_WEIGHT] = weight
        ss[SD.SS_LINES] = counted(table, size, count, most)
    beats.add_rows(ps, ws, line, block, own, b)


@kernel
def note(ps, place):
    """Place in ``ws`` of a note on the table of lines: ``SL.NOTE_STRONGEST`` and so on."""
    return int(ps[SD.H_W_INDEX]) + SL.INDEX_ROWS * int(ps[SD.H_LINES]) + SL.HEADS + place


@kernel
def in_band(omega):
    """Whether a frequency (rad/s) is one of lines that sound."""
    return STILL < abs(omega) < SD.TOP


@kernel
def sound_of_balls(p, s, w, b, speed, first, many):
    """Add what the balls of one bearing sound by without the rings; whether more is left.

    Of the lines that may be, ``many`` from number ``first`` on.
    """
    pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
    block, ws = sound_block(pb), wb[W.SOUND :]
    lv, c, x = members.condensed(sb), sb[S.C : S.C + C.SIZE], scratch_of(sb)
    orbit = lv[L.RATIO] * speed
    # without a rest about which to find lines nothing is known of the balls
    if lv[L.COUNT] == 0.0 or block[SD.H_SOURCES] == 0.0:
        return False
    balls = int(pb[P.BALLS])
    seen = 0
    reach = ball_sound.reach_of_heights(x)
    farthest = int(block[SD.H_HARMONICS]) + reach
    if pb[P.WAVINESS] != 0.0 and c[C.OVERSIZE_SCALE] != 0.0:
        for n in range(1, orders(pb) + 1):
            lowest = math.ceil((n - farthest) / balls)
            for k in range(lowest, math.floor((n + farthest) / balls) + 1):
                omega = k * balls * orbit - n * speed
                seen += 1
                if not (first < seen <= first + many and in_band(omega)):
                    continue
                clear_channels(block, ws)
                ball_sound.drive_by_inner(pb, c, lv, x, block, ws, n, k * balls, reach, speed)
                add_balls(p, s, w, b, k * balls, -1.0 * n, 0.0, omega)
    highest = max(orders(pb), LN.REACH) + int(block[SD.H_HARMONICS]) + reach
    for a in range(1, highest + 1):
        seen += 1
        left_out = (a % balls != 0 and a > farthest) or not in_band(a * orbit)
        if left_out or not first < seen <= first + many:
            continue
        clear_channels(block, ws)
        ball_sound.drive_by_orbit(pb, c, lv, x, block, ws, a, reach, speed)
        add_balls(p, s, w, b, a, 0.0, 0.0, a * orbit)
    waves = int(pb[P.BALL_WAVES]) if c[C.OVERSIZE_SCALE] != 0.0 else 0
    for m in range(1, waves + 1):
        for a in range(-farthest, farthest + 1):
            omega = a * orbit + m * lv[L.ROLL] * speed
            seen += 1
            if not (first < seen <= first + many and in_band(omega)):
                continue
            clear_channels(block, ws)
            ball_sound.drive_by_form(pb, c, lv, x, block, ws, m, a, reach, speed)
            add_balls(p, s, w, b, a, 0.0, m, omega)
    return seen > first + many


@kernel
def follow_beyond(p, s, w, speed):
    """Add what balls sound by as the rings move, at other frequencies: see `ball_sound.follow_rings`.

    A bearing's own lines alone: where another bearing of the set moves the rings, angles of both would count.
    """
    together = members.has_shaft(p)
    lanes = members.padded_size(p)
    lines, size, values, count = ring_lines(p, s)
    for b in range(members.bearing_count(p)):
        pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
        block, lv, x = sound_block(pb), members.condensed(sb), scratch_of(sb)
        balls = int(pb[P.BALLS])
        reach = int(block[SD.H_HARMONICS]) + ball_sound.reach_of_rings(x)
        if block[SD.H_SOURCES] == 0.0 or reach < balls:
            continue
        ws = wb[W.SOUND :]
        for line in range(count):
            at = line * size
            if together and int(lines[at + SP.LINE_MEMBER]) != b:
                continue
            ball, shaft, rolled = lines[at + L.LINE_BALL], lines[at + L.LINE_SHAFT], lines[at + L.LINE_ROLLED]
            omega = frequency(lv, lines, at, speed)
            members.driven_motion(p, b, lines, at + values, wb, T.D)
            members.driven_motion(p, b, lines, at + values + lanes, wb, T.A)
            for shift in range(-1, 2, 2):
                turned = omega + shift * balls * lv[L.RATIO] * speed
                if not in_band(turned):
                    continue
                clear_channels(block, ws)
                if int(block[SD.H_FORM]) == CONTACTS:
                    ball_sound.add_ring_contacts(pb, lv, block, ws, wb, T.D, T.A, omega, speed, shift)
                ball_sound.follow_rings(pb, lv, x, block, ws, wb, T.D, T.A, omega, speed, shift)
                add_balls(p, s, w, b, ball + shift * balls, shaft, rolled, turned)


@kernel
def settle_sound(p, s, w):
    """Make means and beats of the lines' pressures."""
    ps, ss = sound_block(p), s[S.SOUND :]
    ws = members.work(p, w, 0)[W.SOUND :]
    beats.settle_lines(ps, ss, ws)
    beats.renew_means(ps, ss, ws)
    beats.keep_loud(ps, ss)


@kernel
def write_angles(p, s, ps, ws, ahead):
    """Angles of all bearings at ``ahead`` (s) from the present time."""
    travelled = ahead * (s[S.SPEED] + 0.5 * ahead * s[S.SPEED_RATE])
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        at = int(ps[SD.H_W_ANGLES]) + b * SL.ANGLES
        ws[at + SL.ANGLE_BALL] = lv[L.THETA] + lv[L.RATIO] * travelled
        ws[at + SL.ANGLE_SHAFT] = s[S.ANGLE] + travelled
        ws[at + SL.ANGLE_ROLLED] = lv[L.ROLLED] + lv[L.ROLL] * travelled


@kernel
def beat_phases(ps, ss, ws, to):
    """How far the beats have turned (rad) at the angles in ``ws``, to ``ws[to:]``."""
    angles, wide = int(ps[SD.H_W_ANGLES]), beats.beat_size(ps)
    for beat in range(int(ss[SD.SS_BEATS])):
        at = int(ps[SD.H_S_BEATS]) + beat * wide
        one = angles + int(ss[at + SL.BEAT_ONE]) * SL.ANGLES
        other = angles + int(ss[at + SL.BEAT_OTHER]) * SL.ANGLES
        phase = ss[at + SL.BEAT_BALL] * ws[one + SL.ANGLE_BALL]
        phase += ss[at + SL.BEAT_SHAFT] * ws[one + SL.ANGLE_SHAFT]
        phase += ss[at + SL.BEAT_ROLLED] * ws[one + SL.ANGLE_ROLLED]
        phase -= ss[at + SL.BEAT_OTHER_BALL] * ws[other + SL.ANGLE_BALL]
        ws[to + beat] = phase - ss[at + SL.BEAT_OTHER_ROLLED] * ws[other + SL.ANGLE_ROLLED]


@kernel
def follow_alone(p, s, ps, ss, ws, h):
    """Move the mean squares (Pa2) of each bearing of a set alone: rows of microphones, as in the means."""
    own = members.set_state(p, s)
    tau = p[P.TIME_WEIGHTING]
    stays = beats.begin_average(ps, ss, ws, h, tau)
    n = int(ps[SD.H_MICS])
    rows = int(ps[SD.H_S_ALONE])
    count = int(ps[SD.H_BEARINGS])
    beats.track(ps, ss, ws, rows, SL.MEANS * n, count * n, stays, 1.0 - stays)
    for b in range(count):
        for mic in range(n):
            lane = int(ps[int(ps[SD.H_AT_ORDER]) + mic])
            own[members.alone(p, b) + mic] = ss[rows + b * n + lane]


@kernel
def follow_lines(p, s, w, h):
    """Move meters and pressures over the step of ``h`` (s) just made; the state is at its end."""
    ps, ss = sound_block(p), s[S.SOUND :]
    ws = members.work(p, w, 0)[W.SOUND :]
    delay = ps[SD.H_DELAY]
    metered = min(h, s[S.TIME] - s[S.START] - p[P.METERING_START])
    if metered > _LEAST:
        turns = int(ps[SD.H_W_TURNS])
        write_angles(p, s, ps, ws, -delay - metered)
        beat_phases(ps, ss, ws, turns + SL.TURN_BEGIN)
        write_angles(p, s, ps, ws, -delay)
        beat_phases(ps, ss, ws, turns + SL.TURN_END)
        beats.turn_beats(ps, ss, ws, metered)
        if members.has_shaft(p):
            follow_alone(p, s, ps, ss, ws, metered)
        beats.follow(ps, ss, ws, metered, p[P.TIME_WEIGHTING])
    show_pressures(p, s, w)


@kernel
def show_pressures(p, s, w):
    """Pressures of the lines at the present state."""
    ps, ss = sound_block(p), s[S.SOUND :]
    ws = members.work(p, w, 0)[W.SOUND :]
    write_angles(p, s, ps, ws, -ps[SD.H_DELAY])
    phases, angles, size = int(ps[SD.H_W_PHASES]), int(ps[SD.H_W_ANGLES]), beats.line_size(ps)
    for line in range(int(ss[SD.SS_LINES])):
        at = int(ps[SD.H_S_LINES]) + line * size
        of = angles + int(ss[at + SL.LINE_MEMBER]) * SL.ANGLES
        phase = ss[at + SL.LINE_BALL] * ws[of + SL.ANGLE_BALL]
        phase += ss[at + SL.LINE_SHAFT] * ws[of + SL.ANGLE_SHAFT]
        ws[phases + line] = phase + ss[at + SL.LINE_ROLLED] * ws[of + SL.ANGLE_ROLLED]
    beats.sum_pressures(ps, ss, ws)
