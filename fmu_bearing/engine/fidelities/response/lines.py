"""Excitation of the rings line by line, and the linear response to it (fidelity `response`).

Held at their equilibrium, the rings feel from a ball at azimuth theta a force f(theta), and by a height h
under it g(theta) h; what balls and cage do beside that answers to where the height lets the ball rest
(``beside``). All vary with theta where a radial load makes the
balls unequal, and are expanded in circumferential orders l. Evenly spaced balls let through only
combinations that add up to multiples of their number Z:

* wave of order n of the inner race with order l of g: a = k Z = n + l, b = -n (lines turn with a theta_0 +
  b angle of the shaft); for purely axial load l = 0, +-1 only;
* of the outer race: a = k Z = n + l, b = 0;
* varying compliance, f itself: a = l = k Z, b = 0;
* unequal balls: a = l, b = 0 with the discrete transform of their sizes;
* unbalance: a = 0, b = 1;
* form of the balls: its order m over a ball's own turning with any order l of g: a = l, third multiple m
  (``L.ROLLED``); the balls, each with an axis of its own, add up to the discrete transform over them.
"""

import math

from fmu_bearing.engine.complex_numbers import complex_at, pair, real_times
from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import solve_columns
from fmu_bearing.engine.fidelities.condensed.dynamic_stiffness import (
    add_ball_response,
    modal_response,
    ring_dynamic_stiffness,
)
from fmu_bearing.engine.fidelities.condensed.rows import component
from fmu_bearing.engine.fidelities.response.ball_orders import form_of, form_orders
from fmu_bearing.engine.fidelities.response.samples import (
    highest_order,
    keep_places,
    kinds_of_sample,
    order_of,
    parts_of_spacing,
    place_of,
    sample_orbit,
    signed,
    transform,
)
from fmu_bearing.engine.fidelities.response.strongest_lines import counted, drop_weak, place_for
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, LN, STRIDE, C, L, P, Q, S, T
from fmu_bearing.engine.newton.body_slopes import inertia
from fmu_bearing.engine.newton.jacobian import is_angle

_RADIATES = 6300.0  # rad/s: from here on lines count by their acceleration
KINDS = 3  # of candidates: with the shaft, with the balls' orbit, by the balls' form
STILL = 1e-3  # rad/s: a line as slow as that is none


@kernel
def line_table(p):
    """Place of the lines in ``s``: behind the sound's part, where fidelity full has its flexure."""
    return S.SOUND + int(p[P.SOUND_STATE])


@kernel
def orders(p):
    """Highest order of waviness that excites; 0 where it is left out."""
    return int(p[P.WAVE_ORDERS]) if p[P.WAVINESS] != 0.0 else 0


@kernel
def line_matrix(lv, omega, w, re, im):
    """Put the coefficients of the rings' equations at ``omega`` (rad/s), per own inertia, by columns.

    After `dynamic_stiffness.modal_response`.
    """
    ring_dynamic_stiffness(lv, 0.0, omega, w)
    for at in range(0, T.LINE_SIDE, FOUR):
        store(re, at, -1.0 * load(lv, L.JX + at) - load(w, T.FEEDTHROUGH_RE + at))
        store(im, at, -omega * load(lv, L.JV + at) - load(w, T.FEEDTHROUGH_IM + at))
    for n in range(L.N):
        re[n * L.DIAGONAL] -= omega * omega
        re[n * L.COLUMN + L.N] = 0.0
        im[n * L.COLUMN + L.N] = 0.0


@kernel
def line_side(p, lv, w, re, im):
    """Put ``T.LINE_FORCE`` as accelerations of the rings to the right side, after `modal_response`."""
    for i in range(L.COLUMN):
        moves = i < L.N and i != L.TURN
        at = T.LINE_FORCE + 2 * component(i)
        per = 1.0 / inertia(p, i) if moves else 0.0
        re[T.LINE_SIDE + i] = w[at] * per if moves else 0.0
        im[T.LINE_SIDE + i] = w[at + 1] * per if moves else 0.0
    add_ball_response(p, lv, w, re, im)
    re[T.LINE_SIDE + L.N] = 0.0
    im[T.LINE_SIDE + L.N] = 0.0


@kernel
def keep(p, lv, lines, alone, a, b, m, omega, w):
    """Keep the response at ``omega`` (rad/s) to the force ``T.LINE_FORCE`` as line ``a``, ``b``, ``m``.

    A bearing that is not ``alone`` keeps what drives its rings (m/s2, rad/s2): the set answers to it.
    """
    if abs(omega) < STILL:
        return
    re = w[T.LINE_RE : T.LINE_RE + T.LINE_SIDE + L.COLUMN]
    im = w[T.LINE_IM : T.LINE_IM + T.LINE_SIDE + L.COLUMN]
    modal_response(lv, 0.0, omega, w)
    line_side(p, lv, w, re, im)
    if alone:
        line_matrix(lv, omega, w, re, im)
        if not solve_columns(re, im, L.N, L.COLUMN):
            return
    size = weight_of(omega, re, im)
    if not alone:
        size /= omega**4  # as free rings would answer
    count = int(lv[L.COUNT])
    into = place_for(lines, L.LINE_SIZE, count, L.MOST_LINES, size)
    if into < 0:
        return
    at = into * L.LINE_SIZE
    lines[at + L.LINE_BALL] = a
    lines[at + L.LINE_SHAFT] = b
    lines[at + L.LINE_ROLLED] = m
    lines[at + L.LINE_WEIGHT] = size
    for i in range(L.COLUMN):
        moves = i < L.N and i != L.TURN
        lines[at + L.LINE_REAL + i] = re[T.LINE_SIDE + i] if moves else 0.0
        lines[at + L.LINE_IMAGINARY + i] = im[T.LINE_SIDE + i] if moves else 0.0
    lv[L.COUNT] = counted(lines, L.LINE_SIZE, count, L.MOST_LINES)


@kernel
def weight_of(omega, re, im):
    """Weight of a solved system: velocity squared (m2/s2) of the rings' translations, more where it radiates.

    A compact body's pressure grows with its acceleration, so above 1 kHz a line counts by that.
    """
    size = 0.0
    for i in range(L.TURN):
        if not is_angle(i):
            size += re[T.LINE_SIDE + i] ** 2 + im[T.LINE_SIDE + i] ** 2
    return counts_by(omega) * size


@kernel
def counts_by(omega):
    """Weight (1/s2) of squared displacements at ``omega`` (rad/s): see `weight_of`."""
    squared = omega * omega
    return squared * (1.0 + squared / (_RADIATES * _RADIATES))


@kernel
def wave_of(p, race, n, factor):
    """Wave ``n`` of a race (m) times ``factor``: complex."""
    at = int(p[P.AT_ORDERS]) + race * 2 * int(p[P.WAVE_ORDERS]) + 2 * (n - 1)
    return real_times(factor, pair(p, at))


@kernel
def add_order(x, kind, order, by, w):
    """Add ``by`` times an order, of either sign, of one kind of sample to ``T.LINE_FORCE``; complex."""
    found = order_of(x, kind, abs(order))
    force = complex_at(w, T.LINE_FORCE, LN.COMPONENTS)
    for i in range(LN.COMPONENTS):
        force[i] += signed(found[i], order) * by


@kernel
def add_wave(p, x, race, n, order, factor, rate, tau, w):
    """Add ``factor`` times wave ``n`` of a race through order ``order`` of the balls to ``T.LINE_FORCE``.

    ``rate``: of the balls against the race (rad/s); contact damping adds ``tau`` times the height's rate.
    """
    by = complex(1.0, n * rate * tau) * wave_of(p, race, n, factor)
    add_order(x, LN.BY_HEIGHT + race, order, by, w)


@kernel
def size_sums(p, a, scale):
    """Sum of the balls' diameter deviations (m) times exp(i a angle from ball 0): complex."""
    balls = int(p[P.BALLS])
    total = 0j
    for j in range(balls):
        angle = 2.0 * PI * a * j / balls
        total += scale * p[int(p[P.AT_OVERSIZE]) + j] * complex(math.cos(angle), math.sin(angle))
    return total


@kernel
def form_sums(p, x, form, m, a, scale):
    """Sum of the balls' orders ``m`` of one form times exp(i a angle from ball 0): complex."""
    balls = int(p[P.BALLS])
    at = form_of(form, m)
    total = 0j
    turned = a % balls
    place = 0  # of a j among the balls
    for j in range(balls):
        turn = complex(x[LN.BALL_COS + place], x[LN.BALL_SIN + place])
        total += complex(x[at + j], x[at + STRIDE + j]) * turn
        place += turned
        if place >= balls:
            place -= balls
    return scale * total


@kernel
def steady_lines(p, c, lv, lines, alone, x, orbit, first, many, w):
    """Lines that turn with the balls alone: outer race, varying compliance, unequal balls.

    Of the candidates ``many`` from number ``first`` on; returns how many there are in all. So do
    `shaft_lines` and `form_lines`.
    """
    balls = int(p[P.BALLS])
    count = balls * parts_of_spacing(balls)
    scale = c[C.OVERSIZE_SCALE]
    tau = p[P.CONTACT_DAMPING]
    highest = orders(p)
    seen = 0
    for a in range(1, max(highest, LN.AZIMUTHS // 2) + LN.REACH + 1):
        if a % balls != 0 and a > LN.REACH:
            continue
        seen += 1
        if not first < seen <= first + many:
            continue
        for i in range(LN.COMPLEX):
            w[T.LINE_FORCE + i] = 0.0
        if a % balls == 0:
            if 2 * a < count:
                transform(x, LN.FORCE, a, count, LN.FORCE_ORDER)
                for i in range(LN.COMPLEX):
                    w[T.LINE_FORCE + i] += 2.0 * balls * x[LN.FORCE_ORDER + i]
            for n in range(max(a - LN.REACH, 1), min(a + LN.REACH, highest) + 1):
                add_wave(p, x, 1, n, a - n, balls * scale, orbit, tau, w)
        if a <= LN.REACH:
            sizes = size_sums(p, a, scale)
            for race in range(2):
                # half a diameter under either race, and both signs of the order
                add_order(x, LN.BY_HEIGHT + race, a, sizes, w)
        keep(p, lv, lines, alone, a, 0.0, 0.0, a * orbit, w)
    return seen


@kernel
def shaft_lines(p, c, lv, lines, alone, x, orbit, speed, first, many, w):
    """Lines that turn with the shaft: unbalance and the waves of the inner race; see `steady_lines`."""
    balls = int(p[P.BALLS])
    scale = c[C.OVERSIZE_SCALE]
    tau = p[P.CONTACT_DAMPING]
    if first == 0:
        for i in range(LN.COMPLEX):
            w[T.LINE_FORCE + i] = 0.0
        unbalance = p[P.INNER_MASS] * c[C.ECCENTRICITY] * speed * speed
        # (0, -sin, cos) of the shaft's angle
        w[T.LINE_FORCE + 2 * Q.Y + 1] = unbalance
        w[T.LINE_FORCE + 2 * Q.Z] = unbalance
        keep(p, lv, lines, alone, 0.0, 1.0, 0.0, speed, w)
    seen = 1
    for n in range(1, orders(p) + 1):
        lowest = max((n - LN.REACH + balls - 1) // balls, 0)
        for k in range(lowest, (n + LN.REACH) // balls + 1):
            seen += 1
            if not first < seen <= first + many:
                continue
            for i in range(LN.COMPLEX):
                w[T.LINE_FORCE + i] = 0.0
            add_wave(p, x, 0, n, k * balls - n, balls * scale, orbit - speed, tau, w)
            keep(p, lv, lines, alone, k * balls, -1.0 * n, 0.0, k * balls * orbit - n * speed, w)
    return seen


@kernel
def form_lines(p, c, lv, lines, alone, x, orbit, speed, first, many, w):
    """Lines of the balls' form; the samples round the orbit are overwritten; see `steady_lines`."""
    if p[P.BALL_WAVES] == 0.0 or c[C.OVERSIZE_SCALE] == 0.0:
        return 0
    rate = lv[L.ROLL] * speed
    highest = int(p[P.BALL_WAVES])
    reach = max(highest_order(x, LN.BY_HEIGHT), highest_order(x, LN.BY_HEIGHT + 1))
    if first == 0:
        form_orders(p, lv, highest, x)
    seen = 0
    for m in range(1, highest + 1):
        double = 2.0 * c[C.OVERSIZE_SCALE]  # the real part counts both signs of the order
        for a in range(-reach, reach + 1):
            seen += 1
            if not first < seen <= first + many:
                continue
            for i in range(LN.COMPLEX):
                w[T.LINE_FORCE + i] = 0.0
            for form in range(LN.FORMS):
                sums = form_sums(p, x, form, m, a, double)
                kind = LN.BY_HEIGHT + form if form < 2 else LN.BY_LEAN + form - 2
                # contact damping acts on heights alone, see `condensed.ball_form`
                ahead = m * rate * p[P.CONTACT_DAMPING] if kind < LN.BY_LEAN else 0.0
                add_order(x, kind, a, complex(1.0, ahead) * sums, w)
            keep(p, lv, lines, alone, a, 0.0, m, a * orbit + m * rate, w)
    return seen


@kernel
def begin_lines(p, s, speed, w):
    """Sample the orbit at ``speed`` (rad/s) about the equilibrium in ``w[W.STAGE:]``; no line is left.

    With derivatives in ``lv``.
    """
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    x = s[S.JAC : S.JAC + LN.SIZE]
    count = sample_orbit(p, c, lv, speed, x, w)
    for m in range(count):
        x[LN.COS + m] = math.cos(2.0 * PI * m / count)
        x[LN.SIN + m] = math.sin(2.0 * PI * m / count)
    for j in range(int(p[P.BALLS])):
        x[LN.BALL_COS + j] = math.cos(2.0 * PI * j / int(p[P.BALLS]))
        x[LN.BALL_SIN + j] = math.sin(2.0 * PI * j / int(p[P.BALLS]))
    for kind in range(LN.BY_HEIGHT, kinds_of_sample(p)):
        for order in range(LN.REACH + 1):
            transform(x, kind, order, count, place_of(kind, order))
    if p[P.SOUND_SIZE] != 0.0:
        keep_places(p, x, count, w)
    lv[L.COUNT] = 0.0


@kernel
def make_lines(p, s, alone, speed, kind, first, many, w):
    """Make ``many`` candidates for lines of one kind from number ``first`` on; whether more are left.

    ``kind``: of `KINDS`. ``alone``: whether the bearing answers by itself, see `keep`.
    """
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    x = s[S.JAC : S.JAC + LN.SIZE]
    orbit = lv[L.RATIO] * speed
    lines = s[line_table(p) :]
    if kind == 0:
        seen = shaft_lines(p, c, lv, lines, alone, x, orbit, speed, first, many, w)
    elif kind == 1:
        seen = steady_lines(p, c, lv, lines, alone, x, orbit, first, many, w)
    else:
        seen = form_lines(p, c, lv, lines, alone, x, orbit, speed, first, many, w)
    if seen > first + many:
        return True
    if kind == KINDS - 1 and alone:
        lv[L.COUNT] = drop_weak(lines, L.LINE_SIZE, int(lv[L.COUNT]))
    return False
