"""Lines of a set in fidelity response: what drives one bearing moves shaft, housing and all bearings.

Each bearing keeps what drives its rings line by line (``fidelities.response.lines``), at angles of its own
orbit. The set's equations at a line's frequency are the sum of the shaft's and the housing's and of
``T^T m Z_b T`` of every bearing, Z_b its rings' equations there.

A line is ``SP.line_size`` numbers (`members.line_size`): multiples of the angles, weight, bearing, then real
and imaginary parts of the coordinates (m, rad). A bearing's ``drives`` are lines of ``L.LINE_SIZE`` numbers
whose parts are accelerations of its free rings (m/s2, rad/s2). Other arguments: see `spindle.members`.
"""

from fmu_bearing.engine.dense import solve_columns
from fmu_bearing.engine.fidelities.condensed.dynamic_stiffness import modal_response, ring_dynamic_stiffness
from fmu_bearing.engine.fidelities.response.bearing import turned
from fmu_bearing.engine.fidelities.response.lines import STILL, counts_by, line_table
from fmu_bearing.engine.fidelities.response.strongest_lines import counted, drop_weak, place_for
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, SP, STRIDE, L, P, S, T
from fmu_bearing.engine.mechanics.trigonometry import ball_angles
from fmu_bearing.engine.newton.jacobian import is_angle
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import add_driven, shaft_matrix
from fmu_bearing.engine.spindle.elimination import keep_columns
from fmu_bearing.engine.spindle.shaft import unbalance


@kernel
def frequency(lv, lines, at, speed):
    """Angular frequency (rad/s) of the line at ``lines[at:]``; ``lv``: of the bearing that it comes from."""
    omega = lines[at + L.LINE_BALL] * lv[L.RATIO] + lines[at + L.LINE_SHAFT]
    return (omega + lines[at + L.LINE_ROLLED] * lv[L.ROLL]) * speed


@kernel
def prepare_equations(p, s, w, speed):
    """Make what the set's equations at any frequency consist of, for a shaft at ``speed`` (rad/s).

    Matrices of the coordinates by padded columns: mass, rates, places, with all bearings' rings.
    """
    lanes = members.padded_size(p)
    size = members.coordinates(p) * lanes
    _, table = members.complex_matrix(p)
    prepare_matrix(p, s, w, speed, 1.0, 0.0, 0.0, table + SP.LINE_MASS * size)
    prepare_matrix(p, s, w, speed, 0.0, 1.0, 0.0, table + SP.LINE_DAMPING * size)
    prepare_matrix(p, s, w, speed, 0.0, 0.0, 1.0, table + SP.LINE_STIFFNESS * size)


@kernel
def prepare_matrix(p, s, w, speed, by_mass, by_rate, by_place, to):
    """Put one of the shaft's matrices with that of all bearings' rings to ``ws[to:]``.

    ``by_mass``, ``by_rate``, ``by_place``: see `coupling.shaft_matrix`; one of them is one.
    """
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    spare = members.matrix(p)
    shaft_matrix(p, members.set_state(p, s), ws, speed, by_mass, by_rate, by_place, spare)
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        wb = members.work(p, w, b)
        for k in range(L.N):
            for i in range(L.N):
                at = i + L.COLUMN * k
                own = by_mass if i == k else 0.0
                wb[T.MATRIX + i * L.N + k] = own - by_rate * lv[L.JV + at] - by_place * lv[L.JX + at]
        add_driven(p, b, wb, T.MATRIX, L.N, 1, ws, spare)
    keep_columns(ws, spare, n, members.padded_size(p), ws, to)


@kernel
def set_equations(p, s, w, omega):
    """Put the set's equations at ``omega`` (rad/s) to its work space, by padded columns; no right side.

    From what `prepare_equations` has made, behind these equations.
    """
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    size = n * lanes
    re = members.matrix(p)
    im, table = members.complex_matrix(p)
    for i in range(0, size, FOUR):
        mass = load(ws, table + SP.LINE_MASS * size + i)
        store(ws, re + i, load(ws, table + SP.LINE_STIFFNESS * size + i) - omega * omega * mass)
        store(ws, im + i, omega * load(ws, table + SP.LINE_DAMPING * size + i))
    for i in range(lanes):
        ws[re + size + i] = 0.0
        ws[im + size + i] = 0.0
    beside = table + SP.LINE_MATRICES * size
    for i in range(2 * n * n):
        ws[beside + i] = 0.0
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        wb = members.work(p, w, b)
        modal_response(lv, 0.0, omega, wb)
        ring_dynamic_stiffness(lv, 0.0, omega, wb)
        add_driven(p, b, wb, T.FEEDTHROUGH_RE, 1, L.COLUMN, ws, beside)
        add_driven(p, b, wb, T.FEEDTHROUGH_IM, 1, L.COLUMN, ws, beside + n * n)
    for k in range(n):
        for i in range(n):
            ws[re + k * lanes + i] -= ws[beside + i * n + k]
            ws[im + k * lanes + i] -= ws[beside + n * n + i * n + k]


@kernel
def add_drive(p, b, wb, drive, at, ws, side):
    """Add what drives the rings of bearing ``b`` (accelerations, ``drive[at:]``) to a right side."""
    masses = members.row(p, b) + SP.ROW_MASS
    for i in range(L.COLUMN):
        wb[T.D + i] = p[masses + i] * drive[at + i] if i < L.N else 0.0
    members.project_forces(p, b, wb, T.D, ws, side)


@kernel
def weight_of_set(p, w, omega, x):
    """Weight of displacements at ``ws[x:]`` and of as many imaginary ones: see ``response.lines.weight_of``.

    The sum over all bearings' rings.
    """
    ws = members.set_work(p, w)
    size = 0.0
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        for part in range(2):
            members.driven_motion(p, b, ws, x + part * members.padded_size(p), wb, T.D)
            for i in range(L.TURN):
                if not is_angle(i):
                    size += wb[T.D + i] ** 2
    return counts_by(omega) * size


@kernel
def keep_line(p, s, w, b, a, shaft, rolled, omega):
    """Keep the response at ``omega`` (rad/s) to the right side in the work space as a line of bearing ``b``.

    ``a``, ``shaft``, ``rolled``: multiples of ball 0's angle, the shaft's and the balls' own turning.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    re = members.matrix(p)
    im, table = members.complex_matrix(p)
    if not solve_columns(ws[re:im], ws[im:table], n, lanes):
        return
    solution = members.vector(p, SP.RESIDUAL)  # with the vector behind it
    for i in range(lanes):
        ws[solution + i] = ws[re + n * lanes + i]
        ws[solution + lanes + i] = ws[im + n * lanes + i]
    weight = weight_of_set(p, w, omega, solution)
    lines = own[members.lines(p) :]
    size = members.line_size(p)
    most = L.MOST_LINES * members.bearing_count(p)
    count = int(own[members.march(p) + SP.LINES])
    into = place_for(lines, size, count, most, weight)
    if into < 0:
        return
    at = into * size
    lines[at + SP.LINE_BALL] = a
    lines[at + SP.LINE_SHAFT] = shaft
    lines[at + SP.LINE_ROLLED] = rolled
    lines[at + SP.LINE_WEIGHT] = weight
    lines[at + SP.LINE_MEMBER] = b
    for i in range(2 * lanes):
        lines[at + SP.LINE_REAL + i] = ws[solution + i]
    own[members.march(p) + SP.LINES] = counted(lines, size, count, most)


@kernel
def unbalance_line(p, s, w, speed):
    """Line of the unbalance."""
    if p[int(p[P.SET]) + SP.UNBALANCED] == 0.0 or abs(speed) < STILL:
        return
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    set_equations(p, s, w, speed)
    re = members.matrix(p) + n * lanes
    im, _ = members.complex_matrix(p)
    for i in range(n):
        first, second = unbalance(p, i)
        ws[re + i] = speed * speed * first
        ws[im + n * lanes + i] = -speed * speed * second
    keep_line(p, s, w, 0, 0.0, 1.0, 0.0, speed)


@kernel
def solve_lines(p, s, w, speed, first, many):
    """Renew the lines of the set at ``speed`` (rad/s), when each bearing has found what drives it.

    Of what drives the set, ``many`` from number ``first`` on; whether more is left.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    side = members.coordinates(p) * members.padded_size(p)
    im, _ = members.complex_matrix(p)
    count = members.march(p) + SP.LINES
    prepare_equations(p, s, w, speed)
    if first == 0:
        own[count] = 0.0
        unbalance_line(p, s, w, speed)
    seen = 0
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        drives = sb[line_table(members.parameters(p, b)) :]
        for k in range(int(lv[L.COUNT])):
            at = k * L.LINE_SIZE
            seen += 1
            if not (first < seen <= first + many and drives[at + L.LINE_WEIGHT] > 0.0):
                continue
            omega = frequency(lv, drives, at, speed)
            set_equations(p, s, w, omega)
            add_drive(p, b, wb, drives, at + L.LINE_REAL, ws, members.matrix(p) + side)
            add_drive(p, b, wb, drives, at + L.LINE_IMAGINARY, ws, im + side)
            keep_line(
                p, s, w, b, drives[at + L.LINE_BALL], drives[at + L.LINE_SHAFT], drives[at + L.LINE_ROLLED],
                omega,
            )  # fmt: skip
    if seen > first + many:
        return True
    own[count] = drop_weak(own[members.lines(p) :], members.line_size(p), int(own[count]))
    return False


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
def sum_set_lines(p, s, w, lines, count, mean, ahead, out):
    """Places, rates and accelerations of the coordinates at ``ahead`` (s) from the present time, to ``out``.

    By the sum of ``count`` lines, about the places ``mean``.
    """
    lanes = members.padded_size(p)
    size = members.line_size(p)
    for i in range(lanes):
        out[i] = mean[i]
        out[lanes + i] = 0.0
        out[2 * lanes + i] = 0.0
    for first in range(0, count, STRIDE):
        many = min(count - first, STRIDE)
        line_phases(p, s, w, lines, first, many, ahead)
        for g in range(0, lanes, FOUR):
            place = load(out, g)
            rate = load(out, lanes + g)
            acc = load(out, 2 * lanes + g)
            for k in range(many):
                at = (first + k) * size + SP.LINE_REAL + g
                x, y = turned(lines, at, at + lanes, w[T.COS + k], w[T.SIN + k])
                omega = w[T.DX + k]
                place += x
                rate -= omega * y
                acc -= omega * omega * x
            store(out, g, place)
            store(out, lanes + g, rate)
            store(out, 2 * lanes + g, acc)
