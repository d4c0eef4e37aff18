"""What fidelity `response` keeps twice, and how the lines in use are exchanged for renewed ones.

Behind the part of the state that steps go on from (`front`) stand the inputs of a renewal and a second such
part, in which it goes on; then what is kept of a drift (``drift``). When it is complete, both parts exchange
their lines. Amplitudes at a resonance differ by a third where the speed has moved by half a per cent:
exchanged at once they would click, and the click would be louder than the lines for an average of 125 ms. So
the motion is that of the old lines, then that of both, and after `BLEND` that of the new ones. Phases of both
are those of now.

Arguments: see `spindle.members`.
"""

from fmu_bearing.engine.fidelities.condensed.rows import angles_at
from fmu_bearing.engine.fidelities.response.bearing import sum_lines
from fmu_bearing.engine.fidelities.response.coupled_lines import sum_set_lines
from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, L, P, S, T
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import inputs

BLEND = 4e-3  # s


@kernel
def front(p):
    """Return the length of the part of ``s`` that steps go on from."""
    if members.has_shaft(p):
        return int(p[int(p[P.SET]) + SP.FRONT])
    return line_table(p) + L.TABLE_SIZE


@kernel
def inputs_of(p, s):
    """Return the inputs that a renewal is for."""
    return s[front(p) : front(p) + inputs(p)]


@kernel
def back_of(p, s):
    """Return the state in which a renewal goes on; until it makes lines, it keeps those used before."""
    return s[front(p) + inputs(p) : 2 * front(p) + inputs(p)]


@kernel
def copy(source, target, begin, end):
    """Copy the numbers from ``begin`` to ``end``."""
    for i in range(begin, end):
        target[i] = source[i]


@kernel
def swap(one, other, begin, end):
    """Exchange the numbers from ``begin`` to ``end``."""
    for i in range(begin, end):
        value = one[i]
        one[i] = other[i]
        other[i] = value


@kernel
def set_tail(p):
    """Place in the set's own state behind the lines: their number and the equilibrium, of those before."""
    return members.lines(p) + L.MOST_LINES * members.bearing_count(p) * members.line_size(p)


@kernel
def exchange_lines(p, s):
    """Exchange the lines in use for those of the second state, which keeps them with their equilibrium."""
    back = back_of(p, s)
    if members.has_shaft(p):
        own, of = members.set_state(p, s), members.set_state(p, back)
        count = members.march(p) + SP.LINES
        first, tail = members.lines(p), set_tail(p)
        many = int(max(own[count], of[count]))
        swap(own, of, first, first + many * members.line_size(p))
        of[tail] = own[count]
        mean = members.history(p)
        for i in range(members.padded_size(p)):
            of[tail + SP.TAIL_MEAN + i] = own[mean + i]
        own[count] = of[count]
    else:
        lv, new = members.condensed(s), members.condensed(back)
        first = line_table(p)
        many = int(max(lv[L.COUNT], new[L.COUNT]))
        swap(s, back, first, first + many * L.LINE_SIZE)
        back[first + L.TABLE_COUNT] = lv[L.COUNT]
        for i in range(L.COLUMN):
            back[first + L.TABLE_MEAN + i] = lv[L.MEAN + i]
        lv[L.COUNT] = new[L.COUNT]
    members.set_state(p, s)[members.march(p) + SP.EXCHANGED] = s[S.TIME]


@kernel
def end_blend(p, s):
    """Let the lines in use be the only ones."""
    members.set_state(p, s)[members.march(p) + SP.EXCHANGED] = s[S.TIME] - 2.0 * BLEND


@kernel
def share_in_use(p, s, ahead):
    """Share (0 .. 1) of the lines in use in the motion at ``ahead`` (s) from the present time."""
    since = s[S.TIME] + ahead - members.set_state(p, s)[members.march(p) + SP.EXCHANGED]
    x = min(max(since / BLEND, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


@kernel
def back_in_use(p, s):
    """Whether the second state holds what later steps read: a renewal, or lines that are blended."""
    own = members.set_state(p, s)
    at = members.march(p)
    # the time since an exchange, or since `end_blend`, may be off by rounding
    return own[at + SP.STAGE] != 0.0 or s[S.TIME] - own[at + SP.EXCHANGED] < 1.5 * BLEND


@kernel
def settles(p, s, h):
    """Whether the lines in use have become the only ones within the step of ``h`` (s) just made."""
    return share_in_use(p, s, 0.0) >= 1.0 and share_in_use(p, s, -1.01 * h) < 1.0


@kernel
def blend(share, other, at, target, to, count):
    """Put ``1 - share`` of ``other[at:]`` to ``share`` of ``target[to:]``."""
    for i in range(count):
        target[to + i] = share * target[to + i] + (1.0 - share) * other[at + i]


@kernel
def move_rings(p, s, w, ahead):
    """Places, rates and accelerations of the coordinates at ``ahead`` (s) from the present time."""
    share = share_in_use(p, s, ahead)
    back = back_of(p, s)
    if members.has_shaft(p):
        own, of = members.set_state(p, s), members.set_state(p, back)
        first, tail, lanes = members.lines(p), set_tail(p), members.padded_size(p)
        count = int(own[members.march(p) + SP.LINES])
        sum_set_lines(p, s, w, own[first:], count, own[members.history(p) :], ahead, own[SP.S_HEAD :])
        if share < 1.0:
            ws = members.set_work(p, w)
            at = members.matrix(p)
            sum_set_lines(
                p, s, w, of[first:], int(of[tail]), of[tail + SP.TAIL_MEAN :], ahead, ws[at:],
            )  # fmt: skip
            blend(share, ws, at, own, SP.S_HEAD, 3 * lanes)
        return
    lv = members.condensed(s)
    first = line_table(p)
    theta, rolled, angle, speed = angles_at(s, ahead)
    sum_lines(lv, s[first:], int(lv[L.COUNT]), lv[L.MEAN :], theta, rolled, angle, speed, w, lv[L.Q0 :])
    if share < 1.0:
        table = back[first:]
        sum_lines(
            lv, table, int(table[L.TABLE_COUNT]), table[L.TABLE_MEAN :], theta, rolled, angle, speed, w,
            w[T.BLENDED :],
        )  # fmt: skip
        blend(share, w, T.BLENDED, lv, L.Q0, L.MEAN - L.Q0)
