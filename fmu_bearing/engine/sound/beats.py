"""Mean squares of a sound that is a sum of lines, and how meters follow them.

A microphone's square is the sum of its lines' mean squares and, for each two lines, of a part that turns with
the difference of their phases. Where that turns slowly an exponential average follows it: two lines beat.
Faster parts (`SL.REACH`) are left out. Many pairs have the same difference of angles, so their products are
added up once (a *beat*).

With lines that last over a step, meters are moved exactly: the average of a constant and of a turning number
have closed forms.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, SD, SL
from fmu_bearing.engine.mechanics.trigonometry import cosine_and_sine
from fmu_bearing.engine.sound.transfer import write_gains

WEAK = 1e-10  # of the strongest line's weight: left out
_SOFT = 1e-8  # of the sum of all weights: in means and beats, but not in pressures at an instant
_PASSES = 4  # of the search for pairs: the heaviest first,
_LIGHTER = 0.1  # each down to that share of the pass before, of the sum of all lines' weights
_MOST_PAIRS = 4000
_STEADY = 1e-6  # rad: a beat that turns less in a step adds up as if it stood still


@kernel
def line_size(ps):
    """Return how many numbers a line has."""
    return SL.LINE_PRESSURE + 2 * int(ps[SD.H_MICS])


@kernel
def quantities(ps):
    """Return how many quantities are metered."""
    return SL.MEANS + int(ps[SD.H_BEARINGS]) + int(ps[SD.H_BANDS])


@kernel
def beat_size(ps):
    """Return how many numbers a beat has."""
    return SL.BEAT_PRODUCT + 2 * int(ps[SD.H_MICS]) * quantities(ps)


@kernel
def part_rows(ps):
    """Return how many rows of microphones are kept of each line while the means are made."""
    return SL.ROW_ALONE + int(ps[SD.H_BEARINGS])


@kernel
def part_size(ps):
    """Return how many numbers these rows have."""
    return 2 * part_rows(ps) * int(ps[SD.H_MICS])


@kernel
def add_rows(ps, ws, line, others, more, bearing):
    """Add the rows that the block ``others`` of a ``bearing`` has in its work space ``more`` to a line's.

    Both have the same microphones; their lanes may differ.
    """
    n = int(ps[SD.H_MICS])
    rows = int(others[SD.H_W_ROWS])
    to = int(ps[SD.H_W_PARTS]) + line * part_size(ps)
    half = part_rows(ps) * n
    for mic in range(n):
        lane = int(ps[int(ps[SD.H_AT_ORDER]) + mic])
        other = int(others[int(others[SD.H_AT_ORDER]) + mic])
        for part in range(2):
            at, of = to + part * half + lane, rows + part * SL.ROW_ALONE * n + other
            for row in range(SL.ROW_ALONE):
                ws[at + row * n] += more[of + row * n]
            if bearing < int(ps[SD.H_BEARINGS]):
                ws[at + (SL.ROW_ALONE + bearing) * n] += more[of]


@kernel
def weight_of_rows(ps, ws):
    """Sum over the microphones of the squared pressure (Pa2) of the rows in ``ws``."""
    n = int(ps[SD.H_MICS])
    at = int(ps[SD.H_W_ROWS])
    total = 0.0
    for i in range(n):
        total += ws[at + i] ** 2 + ws[at + SL.ROW_ALONE * n + i] ** 2
    return total


@kernel
def weigh_line(ps, ss, ws, line):
    """Write the sum over the microphones of a line's squared pressure (Pa2) to its weight, and return it."""
    n = int(ps[SD.H_MICS])
    at = int(ps[SD.H_W_PARTS]) + line * part_size(ps)
    total = 0.0
    for i in range(n):
        total += ws[at + i] ** 2 + ws[at + part_rows(ps) * n + i] ** 2
    ss[int(ps[SD.H_S_LINES]) + line * line_size(ps) + SL.LINE_WEIGHT] = total
    return total


@kernel
def settle_lines(ps, ss, ws):
    """Leave out weak lines, write the others' pressures to the table, let all turn forwards; the count."""
    n = int(ps[SD.H_MICS])
    size = line_size(ps)
    wide = part_size(ps)
    half = part_rows(ps) * n
    table, parts, index = int(ps[SD.H_S_LINES]), int(ps[SD.H_W_PARTS]), int(ps[SD.H_W_INDEX])
    most = 0.0
    count = int(ss[SD.SS_LINES])
    for line in range(count):
        weigh_line(ps, ss, ws, line)
        most = max(most, ss[table + line * size + SL.LINE_WEIGHT])
    into = 0
    for line in range(count):
        at = table + line * size
        if not (ss[at + SL.LINE_WEIGHT] > WEAK * most):
            continue
        to = table + into * size
        omega = ws[index + line]
        sign = 1.0 if omega >= 0.0 else -1.0
        for i in range(SL.LINE_WEIGHT):
            ss[to + i] = sign * ss[at + i]
        ss[to + SL.LINE_WEIGHT] = ss[at + SL.LINE_WEIGHT]
        ss[to + SL.LINE_MEMBER] = ss[at + SL.LINE_MEMBER]
        ws[index + into] = abs(omega)
        for i in range(half):
            ws[parts + into * wide + i] = ws[parts + line * wide + i]
            ws[parts + into * wide + half + i] = sign * ws[parts + line * wide + half + i]
        for i in range(n):
            ss[to + SL.LINE_PRESSURE + i] = ws[parts + into * wide + i]
            ss[to + SL.LINE_PRESSURE + n + i] = ws[parts + into * wide + half + i]
        into += 1
    ss[SD.SS_LINES] = into
    return into


@kernel
def gain_of(ps, quantity):
    """Place among a line's gains of the filter of a quantity; -1: it has none."""
    if quantity == SL.MEAN_TOTAL_A:
        return SL.GAIN_A
    band = quantity - SL.MEANS - int(ps[SD.H_BEARINGS])
    return SL.GAIN_BANDS + band if band >= 0 else -1


@kernel
def row_of(ps, quantity):
    """Row of a line's parts that a quantity is of."""
    if quantity <= SL.MEAN_TOTAL_A:
        return SL.ROW_TOTAL
    row = SL.ROW_PART + quantity - SL.MEAN_PART
    return row if row < SL.ROW_ALONE + int(ps[SD.H_BEARINGS]) else SL.ROW_TOTAL


@kernel
def renew_means(ps, ss, ws):
    """Mean squares of all lines and their beats, from the lines' parts and frequencies in ``ws``."""
    n = int(ps[SD.H_MICS])
    wide, half = part_size(ps), part_rows(ps) * n
    parts, index, means = int(ps[SD.H_W_PARTS]), int(ps[SD.H_W_INDEX]), int(ps[SD.H_S_MEANS])
    gains, filters = int(ps[SD.H_W_GAINS]), SL.GAIN_BANDS + int(ps[SD.H_BANDS])
    count = int(ss[SD.SS_LINES])
    for line in range(count):
        write_gains(ps, ws, gains + line * filters, ws[index + line])
    for q in range(quantities(ps)):
        row = row_of(ps, q) * n
        gain = gain_of(ps, q)
        for i in range(n):
            ss[means + q * n + i] = 0.0
        for line in range(count):
            by = 0.5 * ws[gains + line * filters + gain] if gain >= 0 else 0.5
            at = parts + line * wide + row
            for i in range(n):
                ss[means + q * n + i] += by * (ws[at + i] ** 2 + ws[at + half + i] ** 2)
    sort_lines(ps, ws, count)
    find_beats(ps, ss, ws, count)


@kernel
def sort_lines(ps, ws, count):
    """Put the numbers of the lines in order of their frequencies (Shell 1959)."""
    index = int(ps[SD.H_W_INDEX])
    order = index + SL.INDEX_SORTED * int(ps[SD.H_LINES])
    for i in range(count):
        ws[order + i] = i
    gap = 1
    while gap < count:
        gap = 3 * gap + 1
    while gap > 1:
        gap //= 3
        for i in range(gap, count):
            number = ws[order + i]
            omega = ws[index + int(number)]
            k = i
            while k >= gap and ws[index + int(ws[order + k - gap])] > omega:
                ws[order + k] = ws[order + k - gap]
                k -= gap
            ws[order + k] = number


@kernel
def find_beats(ps, ss, ws, count):
    """Add up the products of all lines that are close to each other, by how they turn."""
    index, table, size = int(ps[SD.H_W_INDEX]), int(ps[SD.H_S_LINES]), line_size(ps)
    order = index + SL.INDEX_SORTED * int(ps[SD.H_LINES])
    sizes = index + SL.INDEX_SIZE * int(ps[SD.H_LINES])
    total = 0.0
    for line in range(count):
        weight = ss[table + line * size + SL.LINE_WEIGHT]
        ws[sizes + line] = math.sqrt(weight)
        total += weight
    ss[SD.SS_BEATS] = 0.0
    left = _MOST_PAIRS
    above = 1e300
    for _ in range(_PASSES):
        least = total * _LIGHTER if above == 1e300 else above * _LIGHTER
        for i in range(count):
            one = int(ws[order + i])
            for k in range(i + 1, count):
                other = int(ws[order + k])
                if ws[index + other] - ws[index + one] > SL.REACH:
                    break
                product = ws[sizes + one] * ws[sizes + other]
                if least <= product < above and left > 0:
                    add_pair(ps, ss, ws, one, other)
                    left -= 1
        above = least


@kernel
def add_pair(ps, ss, ws, one, other):
    """Add the product of two lines to the beat that turns as they do; a new one if there is room."""
    n = int(ps[SD.H_MICS])
    size, wide = line_size(ps), beat_size(ps)
    a = int(ps[SD.H_S_LINES]) + one * size
    b = int(ps[SD.H_S_LINES]) + other * size
    at = int(ps[SD.H_S_BEATS])
    same = ss[a + SL.LINE_MEMBER] == ss[b + SL.LINE_MEMBER]
    ball = ss[a + SL.LINE_BALL] - (ss[b + SL.LINE_BALL] if same else 0.0)
    other_ball = 0.0 if same else ss[b + SL.LINE_BALL]
    rolled = ss[a + SL.LINE_ROLLED] - (ss[b + SL.LINE_ROLLED] if same else 0.0)
    other_rolled = 0.0 if same else ss[b + SL.LINE_ROLLED]
    shaft = ss[a + SL.LINE_SHAFT] - ss[b + SL.LINE_SHAFT]
    slot = -1
    count = int(ss[SD.SS_BEATS])
    for beat in range(count):
        k = at + beat * wide
        if (
            ss[k + SL.BEAT_BALL] == ball
            and ss[k + SL.BEAT_SHAFT] == shaft
            and ss[k + SL.BEAT_ROLLED] == rolled
            and ss[k + SL.BEAT_ONE] == ss[a + SL.LINE_MEMBER]
            and ss[k + SL.BEAT_OTHER] == ss[b + SL.LINE_MEMBER]
            and ss[k + SL.BEAT_OTHER_BALL] == other_ball
            and ss[k + SL.BEAT_OTHER_ROLLED] == other_rolled
        ):
            slot = k
            break
    if slot < 0:
        if count >= SL.MOST_BEATS:
            return
        slot = at + count * wide
        for i in range(wide):
            ss[slot + i] = 0.0
        ss[slot + SL.BEAT_ONE] = ss[a + SL.LINE_MEMBER]
        ss[slot + SL.BEAT_OTHER] = ss[b + SL.LINE_MEMBER]
        ss[slot + SL.BEAT_BALL] = ball
        ss[slot + SL.BEAT_OTHER_BALL] = other_ball
        ss[slot + SL.BEAT_SHAFT] = shaft
        ss[slot + SL.BEAT_ROLLED] = rolled
        ss[slot + SL.BEAT_OTHER_ROLLED] = other_rolled
        ss[SD.SS_BEATS] = count + 1.0
    parts, half = int(ps[SD.H_W_PARTS]), part_rows(ps) * n
    x, y = parts + one * part_size(ps), parts + other * part_size(ps)
    gains, filters = int(ps[SD.H_W_GAINS]), SL.GAIN_BANDS + int(ps[SD.H_BANDS])
    many = quantities(ps)
    for q in range(many):
        gain = gain_of(ps, q)
        by = 1.0
        if gain >= 0:
            by = math.sqrt(ws[gains + one * filters + gain] * ws[gains + other * filters + gain])
        row = row_of(ps, q) * n
        re = slot + SL.BEAT_PRODUCT + q * n
        im = re + many * n
        for i in range(row, row + n):
            xr, xi, yr, yi = ws[x + i], ws[x + half + i], ws[y + i], ws[y + half + i]
            ss[re + i - row] += by * (xr * yr + xi * yi)
            ss[im + i - row] += by * (xi * yr - xr * yi)


@kernel
def keep_loud(ps, ss):
    """Leave lines out of the table, when their means and beats are made, that no pressure shows."""
    size, table = line_size(ps), int(ps[SD.H_S_LINES])
    count = int(ss[SD.SS_LINES])
    total = 0.0
    for line in range(count):
        total += ss[table + line * size + SL.LINE_WEIGHT]
    into = 0
    for line in range(count):
        at = table + line * size
        if ss[at + SL.LINE_WEIGHT] > _SOFT * total:
            for i in range(size):
                ss[table + into * size + i] = ss[at + i]
            into += 1
    ss[SD.SS_LINES] = into


@kernel
def turn_beats(ps, ss, ws, h):
    """Cosines, sines and rates of the beats over a step of ``h`` (s), from their phases in ``ws``."""
    at = int(ps[SD.H_W_TURNS])
    for k in range(at, at + int(ss[SD.SS_BEATS]), FOUR):
        begin, end = load(ws, k + SL.TURN_BEGIN), load(ws, k + SL.TURN_END)
        store(ws, k + SL.TURN_RATE, (end - begin) * (1.0 / h))
        cosine, sine = cosine_and_sine(begin)
        store(ws, k + SL.TURN_BEGIN, cosine)
        store(ws, k + SL.TURN_BEGIN_SIN, sine)
        cosine, sine = cosine_and_sine(end)
        store(ws, k + SL.TURN_END, cosine)
        store(ws, k + SL.TURN_END_SIN, sine)


@kernel
def begin_average(ps, ss, ws, h, tau):
    """Write what each beat's product counts in an average of time constant ``tau`` (s) over ``h`` (s).

    Returns what is left of its value before.
    """
    stays = math.exp(-h / tau)
    at = int(ps[SD.H_W_TURNS])
    for k in range(at, at + int(ss[SD.SS_BEATS]), FOUR):
        turned = load(ws, k + SL.TURN_RATE) * tau
        re = load(ws, k + SL.TURN_END) - stays * load(ws, k + SL.TURN_BEGIN)
        im = load(ws, k + SL.TURN_END_SIN) - stays * load(ws, k + SL.TURN_BEGIN_SIN)
        per = 1.0 / (1.0 + turned * turned)  # over 1 + j rate tau
        store(ws, k + SL.TURN_RE, per * (re + turned * im))
        store(ws, k + SL.TURN_IM, per * (im - turned * re))
    return stays


@kernel
def begin_sum(ps, ss, ws, h):
    """Write what each beat's product counts in the sum of samples at ``SD.RATE`` over ``h`` (s)."""
    at = int(ps[SD.H_W_TURNS])
    for k in range(at, at + int(ss[SD.SS_BEATS])):
        rate = ws[k + SL.TURN_RATE]
        if abs(rate * h) < _STEADY:
            ws[k + SL.TURN_RE] = SD.RATE * h * ws[k + SL.TURN_BEGIN]
            ws[k + SL.TURN_IM] = SD.RATE * h * ws[k + SL.TURN_BEGIN_SIN]
        else:
            ws[k + SL.TURN_RE] = SD.RATE * (ws[k + SL.TURN_END_SIN] - ws[k + SL.TURN_BEGIN_SIN]) / rate
            ws[k + SL.TURN_IM] = -SD.RATE * (ws[k + SL.TURN_END] - ws[k + SL.TURN_BEGIN]) / rate


@kernel
def track(ps, ss, ws, to, first, count, stays, fresh):
    """Move ``count`` numbers at ``ss[to:]``, averages or sums of what is metered from place ``first`` on.

    ``stays``: what is left of the old value; ``fresh``: what the lines' mean squares count.
    """
    means, turns = int(ps[SD.H_S_MEANS]) + first, int(ps[SD.H_W_TURNS])
    for i in range(count):
        ss[to + i] = stays * ss[to + i] + fresh * ss[means + i]
    many, wide = quantities(ps) * int(ps[SD.H_MICS]), beat_size(ps)
    product = int(ps[SD.H_S_BEATS]) + SL.BEAT_PRODUCT + first
    for beat in range(int(ss[SD.SS_BEATS])):
        re, im = ws[turns + SL.TURN_RE + beat], ws[turns + SL.TURN_IM + beat]
        at = product + beat * wide
        for i in range(count):
            ss[to + i] += ss[at + i] * re - ss[at + many + i] * im
    for i in range(count):
        ss[to + i] = max(ss[to + i], 0.0)


@kernel
def follow(ps, ss, ws, h, time_weighting):
    """Move the meters of all microphones by ``h`` (s)."""
    n = int(ps[SD.H_MICS])
    meters = int(ps[SD.H_S_METERS])
    details = int(ps[SD.H_DETAILS]) > 0
    stays = begin_average(ps, ss, ws, h, time_weighting)
    ss[SD.SS_WEIGHT] = 1.0 - stays * (1.0 - ss[SD.SS_WEIGHT])
    fresh = 1.0 - stays
    track(ps, ss, ws, meters + SD.M_LEVEL * n, SL.MEAN_TOTAL * n, 2 * n, stays, fresh)
    parts = SD.PLAIN - SD.M_PART
    track(ps, ss, ws, meters + SD.M_PART * n, SL.MEAN_PART * n, parts * n, stays, fresh)
    if details:
        kinds = SD.METERS - SD.M_KIND
        track(ps, ss, ws, meters + SD.M_KIND * n, SL.MEAN_KIND * n, kinds * n, stays, fresh)
        for i in range(n):
            total = 0.0
            for row in range(SD.M_PART, SD.PLAIN):
                total += ss[meters + row * n + i]
            ss[meters + SD.M_ENERGY * n + i] = total
    stays = begin_average(ps, ss, ws, h, SD.FAST)
    ss[SD.SS_FAST] = 1.0 - stays * (1.0 - ss[SD.SS_FAST])
    if details:
        track(ps, ss, ws, meters + SD.M_FAST * n, SL.MEAN_TOTAL * n, 2 * n, stays, 1.0 - stays)
    bands = int(ps[SD.H_BANDS])
    if bands > 0:
        first = (SL.MEANS + int(ps[SD.H_BEARINGS])) * n
        track(ps, ss, ws, int(ps[SD.H_S_BANDS]), first, bands * n, stays, 1.0 - stays)
    stays = begin_average(ps, ss, ws, h, SD.SLOW)
    ss[SD.SS_SLOW] = 1.0 - stays * (1.0 - ss[SD.SS_SLOW])
    if details:
        track(ps, ss, ws, meters + SD.M_SLOW * n, SL.MEAN_TOTAL * n, 2 * n, stays, 1.0 - stays)
    begin_sum(ps, ss, ws, h)
    ss[SD.SS_METERED] += SD.RATE * h
    track(ps, ss, ws, meters + SD.M_SUM * n, SL.MEAN_TOTAL * n, 2 * n, 1.0, SD.RATE * h)


@kernel
def sum_pressures(ps, ss, ws):
    """Write the pressures (Pa) of the lines at their phases in ``ws`` to the meters' first row.

    The phases are overwritten by their cosines.
    """
    n = int(ps[SD.H_MICS])
    count = int(ss[SD.SS_LINES])
    size = line_size(ps)
    phases = int(ps[SD.H_W_PHASES])
    sines = phases + int(ps[SD.H_LINES])
    for k in range(0, count, FOUR):
        cosine, sine = cosine_and_sine(load(ws, phases + k))
        store(ws, phases + k, cosine)
        store(ws, sines + k, sine)
    meters = int(ps[SD.H_S_METERS])
    for i in range(n):
        ss[meters + i] = 0.0
    for line in range(count):
        at = int(ps[SD.H_S_LINES]) + line * size + SL.LINE_PRESSURE
        co, si = ws[phases + line], ws[sines + line]
        for i in range(n):
            ss[meters + i] += ss[at + i] * co - ss[at + n + i] * si
