"""Lines of a set in fidelity response: what drives one bearing moves shaft, housing and all bearings.

Each bearing keeps what drives its rings line by line (``fidelities.response.lines``), at angles of its own
orbit. The set's equations at a line's frequency are the sum of the shaft's and the housing's and of
``T^T m Z_b T`` of every bearing, Z_b its rings' equations there.

A line is ``SP.line_size`` numbers (`members.line_size`): multiples of the angles, weight, bearing, then real
and imaginary parts of the coordinates (m, rad). A bearing's ``drives`` are lines of ``L.LINE_SIZE`` numbers
whose parts are accelerations of its free rings (m/s2, rad/s2). Other arguments: see `spindle.members`.
"""

from fmu_bearing.engine.dense import solve_complex
from fmu_bearing.engine.fidelities.response.bearing import turned
from fmu_bearing.engine.fidelities.response.lines import (
    STILL,
    counts_by,
    drop_weak,
    line_equations,
    line_table,
    weakest,
)
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, LN, SP, STRIDE, L, P, S, T
from fmu_bearing.engine.mechanics.trigonometry import ball_angles
from fmu_bearing.engine.newton.jacobian import is_angle
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import add_driven, shaft_matrix


@kernel
def frequency(lv, lines, at, speed):
    """Angular frequency (rad/s) of the line at ``lines[at:]``; ``lv``: of the bearing that it comes from."""
    omega = lines[at + L.LINE_BALL] * lv[L.RATIO] + lines[at + L.LINE_SHAFT]
    return (omega + lines[at + L.LINE_ROLLED] * lv[L.ROLL]) * speed


@kernel
def set_equations(p, s, w, speed, omega):
    """Put the set's equations at ``omega``, for a shaft at ``speed`` (rad/s), to its work space.

    The right side is zero. Real parts by rows of one more than the coordinates, then imaginary parts.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    re = members.matrix(p)
    im = re + n * (n + 1)
    real = im + n * (n + 1)
    imaginary = real + n * n
    shaft_matrix(p, own, ws, speed, -omega * omega, 0.0, 1.0, real)
    shaft_matrix(p, own, ws, speed, 0.0, omega, 0.0, imaginary)
    for b in range(members.count(p)):
        pb = members.parameters(p, b)
        wb = members.work(p, w, b)
        for i in range(LN.COMPLEX):
            wb[T.LINE_FORCE + i] = 0.0
        line_equations(pb, members.condensed(members.state(p, s, b)), omega, wb)
        add_driven(p, b, wb, T.LINE_RE, T.LINE_ROW, 1, ws, real)
        add_driven(p, b, wb, T.LINE_IM, T.LINE_ROW, 1, ws, imaginary)
    for i in range(n):
        for k in range(n):
            ws[re + i * (n + 1) + k] = ws[real + i * n + k]
            ws[im + i * (n + 1) + k] = ws[imaginary + i * n + k]
        ws[re + i * (n + 1) + n] = 0.0
        ws[im + i * (n + 1) + n] = 0.0


@kernel
def add_drive(p, b, wb, drive, at, ws, side):
    """Add what drives the rings of bearing ``b`` (accelerations, ``drive[at:]``) to a right side."""
    n = members.coordinates(p)
    masses = members.row(p, b) + SP.ROW_MASS
    force = members.vector(p, SP.FORCE)
    for i in range(members.padded_size(p)):
        ws[force + i] = 0.0
    for i in range(L.COLUMN):
        wb[T.D + i] = p[masses + i] * drive[at + i] if i < L.N else 0.0
    members.pull(p, b, wb, T.D, ws, force)
    for i in range(n):
        ws[side + i * (n + 1)] += ws[force + i]


@kernel
def weight_of_set(p, w, omega, x):
    """Weight of displacements at ``ws[x:]`` and of as many imaginary ones: see ``response.lines.weight_of``.

    The sum over all bearings' rings.
    """
    ws = members.set_work(p, w)
    size = 0.0
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        for part in range(2):
            members.moved(p, b, ws, x + part * members.padded_size(p), wb, T.D)
            for i in range(L.TURN):
                if not is_angle(i):
                    size += wb[T.D + i] ** 2
    return counts_by(omega) * size


@kernel
def keep_line(p, s, w, b, a, shaft, rolled, omega):
    """Keep the answer at ``omega`` (rad/s) to the right side in the work space as a line of bearing ``b``.

    ``a``, ``shaft``, ``rolled``: multiples of ball 0's angle, the shaft's and the balls' own turning.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    re = members.matrix(p)
    im = re + n * (n + 1)
    if not solve_complex(ws[re:im], ws[im : im + n * (n + 1)], n, n + 1):
        return
    found = members.vector(p, SP.RESIDUAL)  # with the vector behind it
    for i in range(lanes):
        ws[found + i] = ws[re + i * (n + 1) + n] if i < n else 0.0
        ws[found + lanes + i] = ws[im + i * (n + 1) + n] if i < n else 0.0
    weight = weight_of_set(p, w, omega, found)
    if not (weight < 1e9):
        return
    lines = own[members.lines(p) :]
    size = members.line_size(p)
    count = members.march(p) + SP.LINES
    into = int(own[count])
    if into == L.MOST_LINES * members.count(p):
        into = weakest(lines, size, into)
        if lines[into * size + SP.LINE_WEIGHT] >= weight:
            return
    else:
        own[count] += 1.0
    at = into * size
    lines[at + SP.LINE_BALL] = a
    lines[at + SP.LINE_SHAFT] = shaft
    lines[at + SP.LINE_ROLLED] = rolled
    lines[at + SP.LINE_WEIGHT] = weight
    lines[at + SP.LINE_MEMBER] = b
    for i in range(2 * lanes):
        lines[at + SP.LINE_REAL + i] = ws[found + i]


@kernel
def unbalance_line(p, s, w, speed):
    """Line of the shaft's heavy spots."""
    if p[int(p[P.SET]) + SP.UNBALANCED] == 0.0 or abs(speed) < STILL:
        return
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    spots = members.table(p, SP.AT_UNBALANCE)
    set_equations(p, s, w, speed, speed)
    re = members.matrix(p) + n
    im = re + n * (n + 1)
    for i in range(n):
        ws[re + i * (n + 1)] = speed * speed * p[spots + i]
        ws[im + i * (n + 1)] = -speed * speed * p[spots + lanes + i]
    keep_line(p, s, w, 0, 0.0, 1.0, 0.0, speed)


@kernel
def answer_lines(p, s, w, speed):
    """Renew the lines of the set at ``speed`` (rad/s), when each bearing has found what drives it."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    count = members.march(p) + SP.LINES
    own[count] = 0.0
    unbalance_line(p, s, w, speed)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        drives = sb[line_table(members.parameters(p, b)) :]
        for k in range(int(lv[L.COUNT])):
            at = k * L.LINE_SIZE
            if not (drives[at + L.LINE_WEIGHT] > 0.0):
                continue
            omega = frequency(lv, drives, at, speed)
            set_equations(p, s, w, speed, omega)
            side = members.matrix(p) + n
            add_drive(p, b, wb, drives, at + L.LINE_REAL, ws, side)
            add_drive(p, b, wb, drives, at + L.LINE_IMAGINARY, ws, side + n * (n + 1))
            keep_line(
                p, s, w, b, drives[at + L.LINE_BALL], drives[at + L.LINE_SHAFT], drives[at + L.LINE_ROLLED],
                omega,
            )  # fmt: skip
    own[count] = drop_weak(own[members.lines(p) :], members.line_size(p), int(own[count]))


@kernel
def line_phases(p, s, w, lines, first, many, ahead):
    """Phases of ``many`` lines from ``first`` on, ``ahead`` (s): cosines, sines, then frequencies (rad/s).

    They go to the rows ``T.COS``, ``T.SIN`` and ``T.DX`` of the first bearing's work space ``w``.
    """
    speed = s[S.SPEED] + ahead * s[S.SPEED_RATE]
    travelled = ahead * (s[S.SPEED] + 0.5 * ahead * s[S.SPEED_RATE])
    size = members.line_size(p)
    for k in range(many):
        at = (first + k) * size
        lv = members.condensed(members.state(p, s, int(lines[at + SP.LINE_MEMBER])))
        phase = lines[at + SP.LINE_BALL] * (lv[L.THETA] + lv[L.RATIO] * travelled)
        phase += lines[at + SP.LINE_SHAFT] * (s[S.ANGLE] + travelled)
        w[T.PHASES + k] = phase + lines[at + SP.LINE_ROLLED] * (lv[L.ROLLED] + lv[L.ROLL] * travelled)
        w[T.DX + k] = frequency(lv, lines, at, speed)
    # what follows the last line is a phase of another time, and not used
    ball_angles(w, T.PHASES, (many + FOUR - 1) // FOUR * FOUR, w)


@kernel
def sum_set_lines(p, s, w, ahead):
    """Places, rates and accelerations of the coordinates at ``ahead`` (s) from the present time."""
    own = members.set_state(p, s)
    lanes = members.padded_size(p)
    mean = members.history(p)
    lines = own[members.lines(p) :]
    size = members.line_size(p)
    count = int(own[members.march(p) + SP.LINES])
    for i in range(lanes):
        own[SP.S_HEAD + i] = own[mean + i]
        own[SP.S_HEAD + lanes + i] = 0.0
        own[SP.S_HEAD + 2 * lanes + i] = 0.0
    for first in range(0, count, STRIDE):
        many = min(count - first, STRIDE)
        line_phases(p, s, w, lines, first, many, ahead)
        for g in range(0, lanes, FOUR):
            place = load(own, SP.S_HEAD + g)
            rate = load(own, SP.S_HEAD + lanes + g)
            acc = load(own, SP.S_HEAD + 2 * lanes + g)
            for k in range(many):
                at = (first + k) * size + SP.LINE_REAL + g
                x, y = turned(lines, at, at + lanes, w[T.COS + k], w[T.SIN + k])
                omega = w[T.DX + k]
                place += x
                rate -= omega * y
                acc -= omega * omega * x
            store(own, SP.S_HEAD + g, place)
            store(own, SP.S_HEAD + lanes + g, rate)
            store(own, SP.S_HEAD + 2 * lanes + g, acc)
