"""Excitation of the rings line by line, and the linear answer to it (level `response`).

Held at their equilibrium, the rings feel from a ball at azimuth theta a force f(theta), and by a height h
under it g(theta) h + m(theta) h'' (the ball's inertia). Both vary with theta where a radial load makes the
balls unequal, and are expanded in circumferential orders l. Evenly spaced balls let through only
combinations that add up to multiples of their number Z:

* wave of order n of the inner race with order l of g: a = k Z = n + l, b = -n (lines turn with a theta_0 +
  b angle of the shaft); for purely axial load l = 0, +-1 only;
* of the outer race: a = k Z = n + l, b = 0;
* varying compliance, f itself: a = l = k Z, b = 0;
* unequal balls: a = l, b = 0 with the discrete transform of their sizes;
* unbalance: a = 0, b = 1.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import solve_complex
from fmu_bearing.engine.fidelities.condensed.balls import carried, stand
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, L, P, S, T, W, Y
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.newton.jacobian import inertia

REACH = 8  # highest circumferential order l of the balls' unequal loads
_HEIGHT = 1e-9  # m, for differences; heights' accelerations by (3e4 rad/s)^2 times that
_BEND = 1.0  # m/s2
_WEAK = 1e-5  # of the strongest line's velocity: left out
# scratch in the Jacobian's block, which these levels do not use: samples over the orbit, then transforms
_KINDS = 5  # force; by height inner, outer; by its acceleration inner, outer
_SAMPLES = 96
X_SAMPLES = 0  # kind, component, azimuth
X_COS = X_SAMPLES + _KINDS * 10 * _SAMPLES
X_SIN = X_COS + _SAMPLES
X_G = X_SIN + _SAMPLES  # kind, order 0 .. REACH (0 .. 2 Z for the force), real 10, imaginary 10
X_FORCE = 20  # one line's excitation: real 10, imaginary 10


@kernel
def order_amplitudes(p, lv):
    """Complex amplitudes W_n of the race heights, h = Re sum W_n e^(i n psi), by the discrete transform."""
    for race in range(2):
        for n in range(1, L.ORDERS + 1):
            at = L.WAVES + race * 2 * L.ORDERS + 2 * (n - 1)
            lv[at] = 0.0
            lv[at + 1] = 0.0
            if p[P.WAVINESS] == 0.0:
                continue
            table = int(p[P.AT_WAVES]) + race * 2 * P.WAVE_INTERVALS
            cr = math.cos(2.0 * PI * n / P.WAVE_INTERVALS)
            ci = -math.sin(2.0 * PI * n / P.WAVE_INTERVALS)
            er = 1.0
            ei = 0.0
            for i in range(P.WAVE_INTERVALS):
                lv[at] += p[table + 2 * i] * er
                lv[at + 1] += p[table + 2 * i] * ei
                kept = er
                er = er * cr - ei * ci
                ei = kept * ci + ei * cr
            lv[at] *= 2.0 / P.WAVE_INTERVALS
            lv[at + 1] *= 2.0 / P.WAVE_INTERVALS


@kernel
def sample_orbit(p, c, lv, speed, x, w):
    """Fill ``x`` with the forces of one ball on the rings all round, and their derivatives; the count.

    The rings stand at ``w[W_Y:]``. All balls are moved through one spacing in equal parts.
    """
    balls = int(p[P.BALLS])
    lanes = int(p[P.LANES])
    parts = max(_SAMPLES // balls, 1)
    q = w[T.Q : T.Q + 12]
    for i in range(L.N):
        q[i] = w[W.STAGE + Y.Q0 + i]
    kept = c[C.OVERSIZE_SCALE]
    c[C.OVERSIZE_SCALE] = 0.0
    for part in range(parts):
        stand(p, c, lv, 2.0 * PI * part / (balls * parts), 0.0, 0.0, speed, w)
        for kind in range(_KINDS):
            row = T.INNER + (kind - 1) * STRIDE if kind < 3 else T.BEND + (kind - 3) * STRIDE
            step = _HEIGHT if kind < 3 else _BEND
            if kind > 0:
                for j in range(lanes):
                    w[row + j] = step
            carried(p, c, lv, speed, q, w)
            carried(p, c, lv, speed, q, w)
            if kind > 0:
                for j in range(lanes):
                    w[row + j] = 0.0
            for i in range(10):
                for j in range(balls):
                    at = (kind * 10 + i) * _SAMPLES + j * parts + part
                    x[X_SAMPLES + at] = w[T.FORCE + i * STRIDE + j]
                    if kind > 0:
                        x[X_SAMPLES + at] -= x[X_SAMPLES + i * _SAMPLES + j * parts + part]
                        x[X_SAMPLES + at] /= step
    c[C.OVERSIZE_SCALE] = kept
    return balls * parts


@kernel
def transform(x, kind, order, count, out):
    """Circumferential order of one kind of sample: real parts of 10 components, then imaginary parts."""
    for i in range(20):
        x[out + i] = 0.0
    for m in range(count):
        place = (order * m) % count
        co = x[X_COS + place] / count
        si = x[X_SIN + place] / count
        for i in range(10):
            value = x[X_SAMPLES + (kind * 10 + i) * _SAMPLES + m]
            x[out + i] += value * co
            x[out + 10 + i] -= value * si


@kernel
def coefficients(x, kind, order, target, w):
    """Transform at any order in the table, of either sign, into ``w[target:]`` (20 numbers)."""
    at = X_G + ((kind - 1) * (REACH + 1) + abs(order)) * 20
    sign = 1.0 if order >= 0 else -1.0
    for i in range(10):
        w[target + i] = x[at + i]
        w[target + 10 + i] = sign * x[at + 10 + i]


@kernel
def keep(p, lv, a, b, omega, force, w):
    """Answer to one line's force (``w[force:]``: 10 real, 10 imaginary parts) kept among the lines."""
    if abs(omega) < 1e-3:
        return
    re = w[T.SPARE : T.SPARE + 132]
    im = w[T.SPARE + 132 : T.SPARE + 264]
    for i in range(L.N):
        for k in range(L.N):
            at = i + 12 * k
            re[i * 12 + k] = -omega * omega * lv[L.MASS + at] - lv[L.JX + at]
            im[i * 12 + k] = -omega * (lv[L.JV + at] + lv[L.EXTRA + at])
        per = 1.0 / inertia(p, i)
        place = i if i < 8 else i - 1
        re[i * 12 + 11] = w[force + place] * per if i != 8 else 0.0
        im[i * 12 + 11] = w[force + 10 + place] * per if i != 8 else 0.0
    if not solve_complex(re, im, L.N):
        return
    into = int(lv[L.COUNT])
    size = answer_size(omega, re, im)
    if not (size < 1e9):
        return
    if into == L.MOST_LINES:
        # full: the weakest line makes room, if it is weaker than this one
        into = weakest(lv)
        if stored_size(lv, into) >= size:
            return
    else:
        lv[L.COUNT] += 1.0
    at = L.LINES + into * L.LINE_SIZE
    lv[at] = a
    lv[at + 1] = b
    for i in range(L.N):
        if i != 8:
            place = i if i < 8 else i - 1
            lv[at + 2 + place] = re[i * 12 + 11]
            lv[at + 12 + place] = im[i * 12 + 11]


@kernel
def answer_size(omega, re, im):
    """Velocity of the rings' translations squared (m2/s2) in a solved system."""
    size = 0.0
    for i in range(8):
        if i < 3 or i >= 5:
            size += re[i * 12 + 11] ** 2 + im[i * 12 + 11] ** 2
    return omega * omega * size


@kernel
def stored_size(lv, k):
    """Displacement of the rings' translations squared (m2) in a kept line."""
    at = L.LINES + k * L.LINE_SIZE
    size = 0.0
    for i in range(8):
        if i < 3 or i >= 5:
            size += lv[at + 2 + i] ** 2 + lv[at + 12 + i] ** 2
    return size


@kernel
def weakest(lv):
    """Index of the kept line with the least displacement."""
    best = 0
    for k in range(1, int(lv[L.COUNT])):
        if stored_size(lv, k) < stored_size(lv, best):
            best = k
    return best


@kernel
def drop_weak(lv, orbit, speed):
    """Leave out lines whose velocity is nothing beside the strongest."""
    most = 0.0
    count = int(lv[L.COUNT])
    for k in range(count):
        at = L.LINES + k * L.LINE_SIZE
        most = max(most, (lv[at] * orbit + lv[at + 1] * speed) ** 2 * stored_size(lv, k))
    into = 0
    for k in range(count):
        at = L.LINES + k * L.LINE_SIZE
        if (lv[at] * orbit + lv[at + 1] * speed) ** 2 * stored_size(lv, k) > _WEAK * _WEAK * most:
            for i in range(L.LINE_SIZE):
                lv[L.LINES + into * L.LINE_SIZE + i] = lv[at + i]
            into += 1
    lv[L.COUNT] = into


@kernel
def add_wave(lv, x, race, n, order, factor, rate, tau, force, w):
    """Add ``factor`` times wave ``n`` of a race through order ``order`` of the balls to ``w[force:]``.

    ``rate``: of the balls against the race (rad/s); contact damping advances the height by ``tau``.
    """
    at = L.WAVES + race * 2 * L.ORDERS + 2 * (n - 1)
    co = math.cos(n * rate * tau)
    si = math.sin(n * rate * tau)
    hr = factor * (lv[at] * co - lv[at + 1] * si)
    hi = factor * (lv[at] * si + lv[at + 1] * co)
    squared = n * rate * n * rate
    g = T.SPARE + 300
    coefficients(x, 1 + race, order, g, w)
    coefficients(x, 3 + race, order, g + 20, w)
    for i in range(10):
        gr = w[g + i] - squared * w[g + 20 + i]
        gi = w[g + 10 + i] - squared * w[g + 30 + i]
        w[force + i] += gr * hr - gi * hi
        w[force + 10 + i] += gr * hi + gi * hr


@kernel
def steady_lines(p, c, lv, x, count, orbit, speed, w):
    """Lines that turn with the balls alone: outer race, varying compliance, unequal balls."""
    balls = int(p[P.BALLS])
    scale = c[C.OVERSIZE_SCALE]
    tau = p[P.CONTACT_DAMPING]
    force = T.SPARE + 270
    sizes = int(p[P.AT_OVERSIZE])
    g = T.SPARE + 300
    for a in range(1, L.ORDERS + REACH + 1):
        for i in range(20):
            w[force + i] = 0.0
        if a % balls == 0:
            if 2 * a < count:
                transform(x, 0, a, count, X_G + 4 * (REACH + 1) * 20)
                for i in range(20):
                    w[force + i] += 2.0 * balls * x[X_G + 4 * (REACH + 1) * 20 + i]
            for n in range(max(a - REACH, 1), min(a + REACH, L.ORDERS) + 1):
                add_wave(lv, x, 1, n, a - n, balls * scale, orbit, tau, force, w)
        if a <= REACH:
            dr = 0.0
            di = 0.0
            for j in range(balls):
                dr += scale * p[sizes + j] * math.cos(2.0 * PI * a * j / balls)
                di += scale * p[sizes + j] * math.sin(2.0 * PI * a * j / balls)
            for race in range(2):
                coefficients(x, 1 + race, a, g, w)
                for i in range(10):
                    # half a diameter under either race, and both signs of the order
                    w[force + i] += w[g + i] * dr - w[g + 10 + i] * di
                    w[force + 10 + i] += w[g + i] * di + w[g + 10 + i] * dr
        keep(p, lv, a, 0.0, a * orbit, force, w)


@kernel
def shaft_lines(p, c, lv, x, orbit, speed, w):
    """Lines that turn with the shaft: unbalance and the waves of the inner race."""
    balls = int(p[P.BALLS])
    scale = c[C.OVERSIZE_SCALE]
    tau = p[P.CONTACT_DAMPING]
    force = T.SPARE + 270
    for i in range(20):
        w[force + i] = 0.0
    push = p[P.INNER_MASS] * c[C.ECCENTRICITY] * speed * speed
    # (0, -sin, cos) of the shaft's angle
    w[force + 11] = push
    w[force + 2] = push
    keep(p, lv, 0.0, 1.0, speed, force, w)
    for n in range(1, L.ORDERS + 1):
        lowest = max((n - REACH + balls - 1) // balls, 0)
        for k in range(lowest, (n + REACH) // balls + 1):
            for i in range(20):
                w[force + i] = 0.0
            add_wave(lv, x, 0, n, k * balls - n, balls * scale, orbit - speed, tau, force, w)
            keep(p, lv, k * balls, -1.0 * n, k * balls * orbit - n * speed, force, w)


@kernel
def renew_lines(p, s, speed, w):
    """All lines at ``speed`` (rad/s) about the equilibrium in ``w[W_Y:]``, with the derivatives in ``lv``."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    x = s[S.JAC : S.CONDENSED]
    orbit = lv[L.RATIO] * speed
    count = sample_orbit(p, c, lv, speed, x, w)
    for m in range(count):
        x[X_COS + m] = math.cos(2.0 * PI * m / count)
        x[X_SIN + m] = math.sin(2.0 * PI * m / count)
    for kind in range(1, _KINDS):
        for order in range(REACH + 1):
            transform(x, kind, order, count, X_G + ((kind - 1) * (REACH + 1) + order) * 20)
    lv[L.COUNT] = 0.0
    shaft_lines(p, c, lv, x, orbit, speed, w)
    steady_lines(p, c, lv, x, count, orbit, speed, w)
    drop_weak(lv, orbit, speed)
