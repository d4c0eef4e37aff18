"""How each ball moves across its track, for the sound of the balls themselves and for outputs beside it.

The condensed balls rest between the races at every instant (``balls``). Rings feel what the balls do across
their tracks in three patterns (``transverse``). A ball of its own form moves by itself, in no pattern. Its
place S across the track obeys the same equation,

    S'' = w^2 (S_0 - S) + c (U v - S'),

and is solved the same way, exactly for a drive that is a polynomial through its last values. Friction with
both races holds it back: a 7003C's ball at 30,000 r/min moves 4.5 dB less at 8.5 kHz than its place of rest.

What was found as a ball's place is that place advanced along the contacts by the damping time tau: along them
a ball is shown where it was found tau before.

Balls are marched only where they sound. Elsewhere they are shown where they rest.
"""

from fmu_bearing.engine.fidelities.condensed.transverse import continued, free_motion, guided, moved_on
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, select, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, F, L, P, T, Y

_DRIVES = 5  # that the polynomial goes through at most
_STEADY = 3.0  # known steps from which on the polynomial stays the same


@kernel
def forget_balls(lv):
    """Forget how the balls have moved: they are shown where they rest."""
    for i in range(L.OWN_PLACE, L.OWN_END):
        lv[i] = 0.0


@kernel
def rest_balls(p, lv, w):
    """After a sweep: let the balls march on from where they rest; until then they are shown there."""
    square = lv[L.SIDE_SQUARE]
    for j in range(0, int(p[P.LANES]), FOUR):
        rest = load(w, T.ASIDE + j)
        store(lv, L.OWN_PLACE + j, rest)
        store(lv, L.OWN_VELOCITY + j, splat(0.0))
        store(lv, L.OWN_REST + j, rest)
        store(lv, L.OWN_LOADED + j, splat(0.0))
        store(lv, L.OWN_DRIVEN + j, square * rest)


@kernel
def carry_balls(p, lv, w):
    """After a jump and a sweep: keep the balls' distances from rest and their velocities."""
    square = lv[L.SIDE_SQUARE]
    if square == 0.0:
        forget_balls(lv)
        return
    for j in range(0, int(p[P.LANES]), FOUR):
        rest = load(w, T.ASIDE + j)
        drive = load(lv, L.OWN_DRIVEN + j) + square * (rest - load(lv, L.OWN_REST + j))
        store(lv, L.OWN_PLACE + j, load(lv, L.OWN_PLACE + j) + (rest - load(lv, L.OWN_REST + j)))
        store(lv, L.OWN_REST + j, rest)
        store(lv, L.OWN_LOADED + j, load(w, T.LOADED + j))
        store(lv, L.OWN_DRIVEN + j, drive)


@kernel
def weigh_drives(lv, h):
    """Fill ``L.OWN_GAIN`` and ``L.OWN_KICK``: what each of the last drives does in a step ``h`` (s)."""
    if h != lv[L.SIDE_STEP]:
        free_motion(lv, h)
    for i in range(_DRIVES):
        b0, b1, b2, b3, b4 = continued(
            lv, h, 1.0 if i == 0 else 0.0, 1.0 if i == 1 else 0.0, 1.0 if i == 2 else 0.0,
            1.0 if i == 3 else 0.0, 1.0 if i == 4 else 0.0,
        )  # fmt: skip
        gain, kick = moved_on(lv, h, 0.0, 0.0, b0, b1, b2, b3, b4)
        lv[L.OWN_GAIN + i] = gain
        lv[L.OWN_KICK + i] = kick
    lv[L.OWN_STEP] = h


@kernel
def move_balls(p, lv, h, x, rates, w):
    """Move the balls across their tracks over a step ``h`` (s) to the places of rest of the last sweep.

    ``x[rates:]``: velocities of the rings at its end, by which rolling drives the balls in three patterns.
    """
    square, rate = lv[L.SIDE_SQUARE], lv[L.SIDE_RATE]
    if square == 0.0:
        return
    # friction's drive (m/s2)
    uniform, with_cosine = rate * guided(lv, 0, x, rates), rate * guided(lv, 1, x, rates)
    with_sine = rate * guided(lv, 2, x, rates)
    # whatever else changes the weights makes the march forget its steps
    if lv[L.KNOWN] <= _STEADY or h != lv[L.OWN_STEP]:
        weigh_drives(lv, h)
    stay, coast = lv[L.SIDE_STAY], lv[L.SIDE_COAST]
    g0, g1, g2 = lv[L.OWN_GAIN], lv[L.OWN_GAIN + 1], lv[L.OWN_GAIN + 2]
    g3, g4 = lv[L.OWN_GAIN + _DRIVES - 2], lv[L.OWN_GAIN + _DRIVES - 1]
    k0, k1, k2 = lv[L.OWN_KICK], lv[L.OWN_KICK + 1], lv[L.OWN_KICK + 2]
    k3, k4 = lv[L.OWN_KICK + _DRIVES - 2], lv[L.OWN_KICK + _DRIVES - 1]
    for j in range(0, int(p[P.LANES]), FOUR):
        rest, loaded = load(w, T.ASIDE + j), load(w, T.LOADED + j)
        rolled = uniform + with_cosine * load(w, T.COS + j) - with_sine * load(w, T.SIN + j)
        end = square * rest + loaded * rolled
        now, before = load(lv, L.OWN_DRIVEN + j), load(lv, L.OWN_BEFORE + j)
        earlier, earliest = load(lv, L.OWN_EARLIER + j), load(lv, L.OWN_EARLIEST + j)
        place, velocity = load(lv, L.OWN_PLACE + j), load(lv, L.OWN_VELOCITY + j)
        driven = (g0 * end + g1 * now) + (g2 * before + g3 * earlier) + g4 * earliest
        kicked = (k0 * end + k1 * now) + (k2 * before + k3 * earlier) + k4 * earliest
        store(lv, L.OWN_PLACE + j, stay * place + coast * velocity + driven)
        store(lv, L.OWN_VELOCITY + j, (stay - rate * coast) * velocity - square * coast * place + kicked)
        store(lv, L.OWN_REST + j, rest)
        store(lv, L.OWN_LOADED + j, loaded)
        store(lv, L.OWN_EARLIEST + j, earlier)
        store(lv, L.OWN_EARLIER + j, before)
        store(lv, L.OWN_BEFORE + j, now)
        store(lv, L.OWN_DRIVEN + j, end)


@kernel
def rate_weights(known, ahead):
    """Weights of the last five places, one step apart, in the rate ``ahead`` steps before the last one.

    Of the polynomial through ``known`` of them and the last one: with five of them and 1.1 radians per step
    samples between are off by 0.1 dB, with three by 1.7 dB.
    """
    s = -ahead
    # rates of Newton's polynomials through backward differences
    d1 = 1.0 if known >= 1.0 else 0.0
    d2 = 0.5 * (2.0 * s + 1.0) if known >= 2.0 else 0.0
    d3 = (3.0 * s * s + 6.0 * s + 2.0) / 6.0 if known >= 3.0 else 0.0
    d4 = (((4.0 * s + 18.0) * s + 22.0) * s + 6.0) / 24.0 if known >= 4.0 else 0.0
    return (
        d1 + d2 + d3 + d4,
        -(d1 + 2.0 * d2 + 3.0 * d3 + 4.0 * d4),
        d2 + 3.0 * d3 + 6.0 * d4,
        -(d3 + 4.0 * d4),
        d4,
    )


@kernel
def show_moving(p, lv, limit, y, f):
    """Write places, velocities and accelerations of the balls to ``y`` and ``f``.

    A ball that carries nothing has no place of its own to have a rate: zero there, and where the difference
    is more than the ``limit`` (m/s) of what a ball can do.
    """
    h = lv[L.SPACING]
    known = min(lv[L.KNOWN], L.HISTORY - 1.0)
    per = 1.0 / h if known >= 1.0 else 0.0
    bent = per * per if known >= 2.0 else 0.0
    v0, v1, v2, v3, v4 = rate_weights(known, min(p[P.CONTACT_DAMPING] * per, known))
    softx, softr = lv[L.SIDE], lv[L.SIDE + 1]
    square, rate = lv[L.SIDE_SQUARE], lv[L.SIDE_RATE]
    for j in range(0, int(p[P.LANES]), FOUR):
        x0, x1, x2 = load(lv, L.X + j), load(lv, L.X1 + j), load(lv, L.X2 + j)
        r0, r1, r2 = load(lv, L.R + j), load(lv, L.R1 + j), load(lv, L.R2 + j)
        vx = per * ((v0 * x0 + v1 * x1) + (v2 * x2 + v3 * load(lv, L.X3 + j)) + v4 * load(lv, L.X4 + j))
        vr = per * ((v0 * r0 + v1 * r1) + (v2 * r2 + v3 * load(lv, L.R3 + j)) + v4 * load(lv, L.R4 + j))
        rates = (load(lv, L.SETTLED + j) >= known + 1.0) & (max(abs(vx), abs(vr)) <= limit)
        valid = select(rates, splat(1.0), splat(0.0))
        vx, vr = valid * vx, valid * vr
        ax, ar = valid * bent * (x0 - 2.0 * x1 + x2), valid * bent * (r0 - 2.0 * r1 + r2)
        place, velocity = load(lv, L.OWN_PLACE + j), load(lv, L.OWN_VELOCITY + j)
        loaded = load(lv, L.OWN_LOADED + j)
        away = place - load(lv, L.OWN_REST + j)
        pushed = load(lv, L.OWN_DRIVEN + j) - square * place - rate * velocity
        velocity -= loaded * (softx * vx + softr * vr)
        pushed -= loaded * (softx * ax + softr * ar)
        store(y, Y.X + j, x0 + softx * away)
        store(y, Y.R + j, r0 + softr * away)
        store(y, Y.VX + j, vx + softx * velocity)
        store(y, Y.VR + j, vr + softr * velocity)
        store(f, F.X + j, ax + softx * pushed)
        store(f, F.R + j, ar + softr * pushed)


@kernel
def move_places(lv, lanes):
    """Move the balls' places on: the last ones become the places of a step before."""
    for row in range(0, 2 * STRIDE, STRIDE):
        for j in range(row, row + lanes, FOUR):
            store(lv, L.X4 + j, load(lv, L.X3 + j))
            store(lv, L.X3 + j, load(lv, L.X2 + j))
            store(lv, L.X2 + j, load(lv, L.X1 + j))
            store(lv, L.X1 + j, load(lv, L.X + j))
