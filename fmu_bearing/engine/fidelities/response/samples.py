"""Forces and places of the balls round their orbit, by circumferential orders (fidelity `response`).

One ball's forces on the rings, and its place between them, at azimuths round the orbit: at rest, and per
height under it and slope across its track. See `lines` for what they are for.
"""

from fmu_bearing.engine.complex_numbers import complex_at
from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.fidelities.condensed.balls import set_angles, solve_balls
from fmu_bearing.engine.fidelities.condensed.drives import load_after_move
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, LN, STRIDE, C, L, P, T, W, Y

_HEIGHT = 1e-9  # m, for differences
_LEAN = 1e-8  # m/rad
_SMALL = 1e-6  # of the largest coefficient of a kind: an order of the balls below it is left out


@kernel
def kinds_of_sample(p):
    """Kinds of sample that are needed: slopes across the track belong to the balls' form."""
    return LN.KINDS if p[P.BALL_WAVES] != 0.0 else LN.BY_LEAN


@kernel
def parts_of_spacing(balls):
    """Parts that one of so many ``balls`` is moved through its spacing in."""
    return max(LN.AZIMUTHS // balls, 1)


@kernel
def sample_orbit(p, c, lv, speed, x, w):
    """Fill ``x`` with the forces of one ball on the rings all round, and their derivatives; the count.

    The rings are at ``w[W.STAGE:]``. All balls are moved through one spacing in equal parts.
    """
    balls = int(p[P.BALLS])
    lanes = int(p[P.LANES])
    parts = parts_of_spacing(balls)
    kinds = kinds_of_sample(p)
    q = w[T.Q : T.Q + L.COLUMN]
    for i in range(L.N):
        q[i] = w[W.STAGE + Y.Q0 + i]
        w[T.AHEAD + i] = 0.0
    scale = c[C.OVERSIZE_SCALE]
    c[C.OVERSIZE_SCALE] = 0.0
    for part in range(parts):
        set_angles(p, c, lv, 2.0 * PI * part / (balls * parts), 0.0, 0.0, 0.0, 0.0, w)
        for kind in range(kinds):
            changed = T.FORM_SLOPE + (kind - LN.BY_LEAN) * STRIDE
            step = _LEAN
            if kind < LN.BY_LEAN:
                changed = T.INNER + (kind - LN.BY_HEIGHT) * STRIDE
                step = _HEIGHT
            if kind != LN.FORCE:
                for j in range(lanes):
                    w[changed + j] = step
            solve_balls(p, c, lv, speed, q, w)
            solve_balls(p, c, lv, speed, q, w)
            show_away(lv, lanes, w)
            if kind != LN.FORCE:
                for j in range(lanes):
                    w[changed + j] = 0.0
            for i in range(LN.COMPONENTS):
                row = T.FORCE + i * STRIDE if i < LN.PLACES else T.X + (i - LN.PLACES) * STRIDE
                for j in range(balls):
                    at = LN.SAMPLES + (kind * LN.COMPONENTS + i) * LN.AZIMUTHS + j * parts + part
                    x[at] = w[row + j]
                    if kind != LN.FORCE:
                        x[at] -= x[LN.SAMPLES + i * LN.AZIMUTHS + j * parts + part]
                        x[at] /= step
    c[C.OVERSIZE_SCALE] = scale
    return balls * parts


@kernel
def store_patterns(at, places, co, si, w):
    """Write four balls' numbers, and times cosine and minus sine of their angles, a pattern apart."""
    store(w, at, places)
    store(w, at + L.AWAYS * STRIDE, co * places)
    store(w, at + 2 * L.AWAYS * STRIDE, -1.0 * (si * places))


@kernel
def show_away(lv, lanes, w):
    """Put how far balls between races rest from the frozen point, by patterns, to ``T.AWAY``: `L.AWAYS`."""
    for j in range(0, lanes, FOUR):
        loaded = min(1.0, lv[L.PRESS + L.PRESS_WHOLE] * load(w, T.LOADED + j))
        x = loaded * (load(w, T.X + j) - lv[L.AT_BALL])
        r = loaded * (load(w, T.R + j) - lv[L.AT_BALL + 1])
        co, si = load(w, T.COS + j), load(w, T.SIN + j)
        store_patterns(T.AWAY + j, x, co, si, w)
        store_patterns(T.AWAY + STRIDE + j, r, co, si, w)
        for race in range(2):
            at, row = L.PRESS + race * L.PRESS_SIZE, T.CONTACT if race == 0 else T.CONTACT_OUTER
            pressed = lv[at + L.PRESS_SOFT] * (load_after_move(w, row, j) - lv[at + L.PRESS_LOAD])
            store_patterns(T.AWAY + (2 + race) * STRIDE + j, loaded * pressed, co, si, w)


@kernel
def transform(x, kind, order, count, out):
    """Circumferential order of one kind of sample into the complex vector ``x[out:]``."""
    found = complex_at(x, out, LN.COMPONENTS)
    for i in range(LN.COMPONENTS):
        found[i] = 0.0
    for m in range(count):
        place = (order * m) % count
        co, si = x[LN.COS + place] / count, x[LN.SIN + place] / count
        for i in range(LN.COMPONENTS):
            value = x[LN.SAMPLES + (kind * LN.COMPONENTS + i) * LN.AZIMUTHS + m]
            found[i] += complex(value * co, -value * si)


@kernel
def order_of(x, kind, order):
    """Complex vector in ``x`` of ``order`` (0 .. ``LN.REACH``) of one kind from ``LN.BY_HEIGHT`` on."""
    return complex_at(x, place_of(kind, order), LN.COMPONENTS)


@kernel
def place_of(kind, order):
    """Place of `order_of` in ``x``."""
    return LN.TABLE + ((kind - LN.BY_HEIGHT) * (LN.REACH + 1) + order) * LN.COMPLEX


@kernel
def signed(z, order):
    """Coefficient of an order of either sign, by that of its size."""
    return z if order >= 0 else z.conjugate()


@kernel
def keep_places(p, x, count, w):
    """Keep orders of the balls' places, as their loads leave them and as they follow the rings.

    From the samples and from ``T.FOLLOW``; orders that so few balls cannot tell apart are left out.
    """
    balls = int(p[P.BALLS])
    force = complex_at(x, LN.FORCE_ORDER, LN.COMPONENTS)
    for order in range(LN.REACH + 1):
        transform(x, LN.FORCE, order, count, LN.FORCE_ORDER)
        if order == 0:
            force[LN.PLACES + 1] += p[P.PITCH_RADIUS]
        rest = complex_at(x, LN.REST + FOUR * order, 2)
        for k in range(2):
            rest[k] = force[LN.PLACES + k]
        for i in range(L.N):
            follow = complex_at(x, LN.FOLLOW + (order * L.N + i) * FOUR, 2)
            for k in range(2):
                total = 0j
                for j in range(balls if 2 * order < balls else 0):
                    value = w[T.FOLLOW + i * T.FOLLOW_SIZE + k * STRIDE + j] / balls
                    place = (order * j) % balls
                    total += complex(value * x[LN.BALL_COS + place], -value * x[LN.BALL_SIN + place])
                follow[k] = total


@kernel
def highest_order(x, kind):
    """Highest order of one kind of sample that is more than rounding."""
    largest = 0.0
    highest = 0
    for order in range(LN.REACH + 1):
        size = largest_of(x, place_of(kind, order), LN.COMPLEX)
        if size > _SMALL * largest:
            highest = order
        largest = max(largest, size)
    return highest


@kernel
def largest_of(x, at, count):
    """Largest size of ``count`` numbers at ``x[at:]``."""
    size = 0.0
    for i in range(at, at + count):
        size = max(size, abs(x[i]))
    return size
