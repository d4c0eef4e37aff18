"""The motion of rings and shaft that grows most by itself, with balls and cage frozen.

About the frozen point all move as q exp(s t), where the dynamic stiffness D(s) q is zero: that of shaft,
housing and rings, of balls at rest, and of what balls and cage do beside these (`condensed.operator`).
Newton's method for q and s together (Ruhe 1973, SIAM J. Numer. Anal. 10, 674) goes on from starts that grow:
motions that decay are farther from them. A first round leaves s, so that the nearest motion comes forward. Of
1,920 scenes, the catalogue's and drawn ones, 257 have a motion of the rings that grows by 3 1/s and more by
the eigenvalues of the whole matrix (`modal.equations.quick`), and the search finds it in all but one.

The search follows each renewal of what is frozen, one round after the other, beside the march; what it finds
is ``solver.growth``. Arguments: see `spindle.members`.
"""

import math

from fmu_bearing.engine.complex_numbers import complex_at, real_times, square
from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import solve_columns
from fmu_bearing.engine.fidelities.condensed.dynamic_stiffness import modal_response, ring_dynamic_stiffness
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, C, H, L, P, Q, S, T
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import add_driven, shaft_matrix
from fmu_bearing.engine.spindle.elimination import keep_columns

_STARTS = 16.0  # with 12, and without the first round, up to 16 of 123 are missed
_LOWEST, _HIGHEST = 2.0 * PI * 120.0, 2.0 * PI * 9000.0  # rad/s: of the starts, evenly by their logarithms
_GROWING = 0.2  # of that: growth at the starts
_ORBIT = 1.03  # of the orbits' speed: one more start; a cage on its way round is near it
_SLOWEST = 2.0 * PI * 100.0  # rad/s: a slower motion belongs to the mounting
_ROUNDS = 11.0  # from one start; 5 to 8 are needed
_WAIT = 2e-3  # s of simulated time between two rounds, 0.25 s for all starts
_DIFFERENCE = 1e-5  # of the rate: the step of the slope of D
_SETTLED = 1e-5  # of the rate: a smaller change ends the rounds
_STEP = 0.3  # of the rate: the longest change
_DAMPED = 0.5  # of the rate: what decays or grows faster does not swing
_ACROSS = 0.5  # of the load along the axis, chosen: with more across it rings are not at the frozen point
# of the orbits' speed, chosen: balls that drift along their orbits with the cage move no ring
_BESIDE = 0.02


@kernel
def rests_as_frozen(p, s, b):
    """Whether bearing ``b`` carries about what it was frozen with, along its axis alone.

    Else balls at rest count as they press where the rings are: a ring on a soft pedestal that a load sinks
    by a millimetre decays there, while it would grow by 151 1/s at the frozen point.
    """
    if not members.has_shaft(p):
        c = L.CONDITIONS
        lv = members.condensed(s)
        return math.hypot(lv[c + C.LOAD_Y], lv[c + C.LOAD_Z]) <= _ACROSS * abs(lv[c + C.PRELOAD])
    own = members.set_state(p, s)
    at = members.per_bearing(p, b) + SP.LOAD
    return math.hypot(own[at + Q.Y], own[at + Q.Z]) <= _ACROSS * abs(own[at + Q.X])


@kernel
def put_stiffness(p, s, w, growth, omega):
    """Put D at ``growth`` (1/s) and ``omega`` (rad/s) to the set's work space by padded columns."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    im, spare = members.complex_matrix(p)
    speed = members.condensed(members.state(p, s, 0))[L.FROZEN_SPEED]
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        modal_response(lv, growth, omega, members.work(p, w, b))
        ring_dynamic_stiffness(lv, growth, omega, members.work(p, w, b))
    for part in range(2):
        by_mass = growth * growth - omega * omega if part == 0 else 2.0 * growth * omega
        by_rate = growth if part == 0 else omega
        by_place = 1.0 - part
        beside = T.FEEDTHROUGH_RE if part == 0 else T.FEEDTHROUGH_IM
        shaft_matrix(p, own, ws, speed, by_mass, by_rate, by_place, spare)
        for b in range(members.bearing_count(p)):
            lv = members.condensed(members.state(p, s, b))
            wb = members.work(p, w, b)
            frozen = rests_as_frozen(p, s, b)
            place, rate = (L.FROZEN_JX, L.FROZEN_JV) if frozen else (L.JX, L.JV)
            for k in range(L.N):
                for i in range(L.N):
                    at = i + L.COLUMN * k
                    given = by_rate * lv[rate + at] + by_place * lv[place + at]
                    inertia = by_mass if i == k else 0.0
                    wb[T.MATRIX + i * L.N + k] = inertia - given - wb[beside + at]
            add_driven(p, b, wb, T.MATRIX, L.N, 1, ws, spare)
        if not members.has_shaft(p) and p[P.RIGID] != 0.0:
            # the mount holds the inner ring along the axis
            for k in range(n):
                ws[spare + Q.X * n + k] = 1.0 - part if k == Q.X else 0.0
        keep_columns(ws, spare, n, lanes, ws, members.matrix(p) if part == 0 else im)


@kernel
def add_motion(p, ws, own, scale):
    """Add ``scale`` times D times the motion of now to the right side: of D in the work space."""
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    re = members.matrix(p)
    im, _ = members.complex_matrix(p)
    side = n * lanes
    x = motion(p, own)
    for k in range(n):
        a = real_times(scale, x[k])
        for i in range(n):
            at = k * lanes + i
            ws[re + side + i] += ws[re + at] * a.real - ws[im + at] * a.imag
            ws[im + side + i] += ws[re + at] * a.imag + ws[im + at] * a.real


@kernel
def motion(p, own):
    """Complex coordinates of the motion that may grow (m, rad)."""
    lanes = members.padded_size(p)
    return complex_at(own, members.history(p) + H.GROWING * lanes, lanes)


@kernel
def improve(p, s, w):
    """Improve rate and motion by one round, the first one the motion alone.

    By how much of itself the rate has changed, negative on failure.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    at = members.march(p) + SP.RATE_NOW
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    re = members.matrix(p)
    im, free = members.complex_matrix(p)
    side = n * lanes
    growth, omega = own[at], own[at + 1]
    size = math.hypot(growth, omega)
    apart = _DIFFERENCE * size
    for i in range(lanes):
        ws[re + side + i] = 0.0
        ws[im + side + i] = 0.0
    put_stiffness(p, s, w, growth + apart, omega)
    add_motion(p, ws, own, 1.0 / apart)
    put_stiffness(p, s, w, growth, omega)
    add_motion(p, ws, own, -1.0 / apart)
    if not solve_columns(ws[re:im], ws[im:free], n, lanes):
        return -1.0
    levers = members.history(p) + H.LEVERS * lanes
    x = motion(p, own)
    total, by = 0.0, 0j
    for i in range(n):
        lever = own[levers + i] * own[levers + i]
        y = complex(ws[re + side + i], ws[im + side + i])
        total += lever * square(y)
        by += real_times(lever, y.conjugate() * x[i])
    if not (0.0 < total < math.inf):
        return -1.0
    per = 1.0 / math.sqrt(total)
    for i in range(n):
        x[i] = complex(per * ws[re + side + i], per * ws[im + side + i])
    if own[members.march(p) + SP.ROUND] == 0.0:
        return 1.0
    by = real_times(1.0 / total, by)
    change = math.hypot(by.real, by.imag) / size
    short = min(1.0, _STEP / (change + 1e-300))
    own[at] = growth - short * by.real
    own[at + 1] = omega - short * by.imag
    return change


@kernel
def begin_from(p, s, start):
    """Begin with start number ``start``: what the last search found, near the orbits, then all the others."""
    own = members.set_state(p, s)
    at = members.march(p)
    own[at + SP.SEARCH] = start
    own[at + SP.ROUND] = 0.0
    if start == 1.0:
        for i in range(2):
            own[at + SP.RATE_NOW + i] = own[at + SP.RATE_KNOWN + i]
            own[at + SP.RATE_MOST + i] = 0.0
    elif start == 2.0:
        lv = members.condensed(members.state(p, s, 0))
        own[at + SP.RATE_NOW] = 0.0
        own[at + SP.RATE_NOW + 1] = _ORBIT * abs(lv[L.RATIO] * lv[L.FROZEN_SPEED])
    else:
        share = (start - 3.0) / (_STARTS - 1.0)
        omega = _LOWEST * math.exp(share * math.log(_HIGHEST / _LOWEST))
        own[at + SP.RATE_NOW] = _GROWING * omega
        own[at + SP.RATE_NOW + 1] = omega
    lanes = members.padded_size(p)
    levers = members.history(p) + H.LEVERS * lanes
    x = motion(p, own)
    turning = 1.0 if start % 2.0 == 0.0 else -1.0
    for i in range(members.coordinates(p)):
        # a bit of everything, by as much at the pitch circle, forward and backward by turns
        per = 1.0 / own[levers + i]
        x[i] = complex(per * math.cos(i), turning * per * math.sin(3.0 * i))


@kernel
def swings(p, s, growth, omega):
    """Whether a rate is that of a motion in which rings swing."""
    if omega < _SLOWEST or abs(growth) > _DAMPED * omega:
        return False
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        orbit = abs(lv[L.RATIO] * lv[L.FROZEN_SPEED])
        if abs(omega - orbit) < _BESIDE * orbit:
            return False
    return True


@kernel
def next_start(p, s):
    """Go on with the next start; behind the last one keep what was found."""
    own = members.set_state(p, s)
    at = members.march(p)
    start = own[at + SP.SEARCH] + 1.0
    if start <= 2.0 + _STARTS:
        begin_from(p, s, start)
        return
    own[at + SP.SEARCH] = 0.0
    for i in range(2):
        own[at + SP.RATE_KNOWN + i] = own[at + SP.RATE_MOST + i]
    s[S.GROWTH] = own[at + SP.RATE_MOST]


@kernel
def go_on(p, s, w):
    """Make one round of the search that is due or goes on; whether there was one."""
    own = members.set_state(p, s)
    at = members.march(p)
    if own[at + SP.SEARCH] == 0.0:
        if own[at + SP.NEW] == 0.0:
            return False
        own[at + SP.NEW] = 0.0
        begin_from(p, s, 1.0)
        if own[at + SP.RATE_NOW + 1] == 0.0:
            begin_from(p, s, 2.0)
    change = improve(p, s, w)
    own[at + SP.ROUND] += 1.0
    growth, omega = own[at + SP.RATE_NOW], own[at + SP.RATE_NOW + 1]
    if 0.0 <= change < _SETTLED:
        if growth > own[at + SP.RATE_MOST] and swings(p, s, growth, omega):
            own[at + SP.RATE_MOST] = growth
            own[at + SP.RATE_MOST + 1] = omega
            s[S.GROWTH] = max(s[S.GROWTH], growth)
        next_start(p, s)
    elif not (change >= 0.0 and abs(growth) < _DAMPED * omega) or own[at + SP.ROUND] >= _ROUNDS:
        next_start(p, s)
    return True


@kernel
def search_at_once(p, s, w):
    """Search from all starts now."""
    own = members.set_state(p, s)
    own[members.march(p) + SP.NEW] = 1.0
    s[S.GROWTH] = 0.0
    while go_on(p, s, w):
        pass


@kernel
def search(p, s, w, h):
    """Make the rounds due in a communication step of ``h`` (s)."""
    own = members.set_state(p, s)
    at = members.march(p)
    own[at + SP.WAITED] += h
    while own[at + SP.WAITED] >= _WAIT:
        own[at + SP.WAITED] -= _WAIT
        if not go_on(p, s, w):
            own[at + SP.WAITED] = 0.0
