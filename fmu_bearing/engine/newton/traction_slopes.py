"""How the traction of one race's contacts changes with sliding, spin, entrainment, load and ellipse.

A strip of the regularised law answers a change of its own sliding by a symmetric 2 x 2 matrix; sliding and
spins of the contact reach the strip, and its force comes back, through the same two levers: its place along
the major axis and the sag of the contact's curved surface. The other laws, and any law in oil that friction
heats, are functions of eight numbers with logarithms of logarithms: they are differentiated by differences of
the law alone.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STRIDE, K, P, R, W
from fmu_bearing.engine.mechanics.inlet import LIGHTEST, SLOWEST_2, inlet_factors, local_powers
from fmu_bearing.engine.mechanics.race import plain_traction
from fmu_bearing.engine.mechanics.traction import lubricated_traction

# steps of the differences: small against the laws' own scales (1e-4 m/s, 1 rad/s over a contact), large
# against rounding
_VELOCITY = 1e-7
_RATE = 1e-3
_SHARE = 1e-6  # of load and semi-major axis


@kernel
def add_strip(w, column, j, ft, fm, offset, sag):
    """Add a strip's change of force along and across the track, with its moments, to a column."""
    at = W.CONTACT + K.TRACTION + column * K.TRACTION_SIZE + j
    store(w, at, load(w, at) + ft)
    at += STRIDE
    store(w, at, load(w, at) + fm)
    at += STRIDE
    store(w, at, load(w, at) - offset * ft)
    at += STRIDE
    store(w, at, load(w, at) + sag * fm)
    at += STRIDE
    store(w, at, load(w, at) - sag * ft)


@kernel
def strip_slopes(p, lanes, race, w):
    """Fill the columns of the regularised law, strip by strip as ``race.traction`` walks over them."""
    row = W.RACE + race * R.SIZE
    per_profile = 0.5 / p[P.RACES + race * P.RACE_SIZE + P.RACE_PROFILE_RADIUS]
    mu = p[P.MU]
    strips = int(p[P.STRIPS])
    nodes = int(p[P.AT_STRIPS])
    for j in range(0, lanes, FOUR):
        half = load(w, row + R.HALF + j)
        pressing = load(w, row + R.LOAD + j)
        scale = load(w, row + R.SCALE + j)
        entrain = load(w, row + R.ENTRAIN + j)
        # the scale's own change with the entrainment speed, see race.normal
        steeper = p[P.SLIDE_TO_ROLL] * entrain / math.sqrt(entrain * entrain + 1e-8) * scale
        an = load(w, row + R.AN + j)
        at = load(w, row + R.AT + j)
        am = load(w, row + R.AM + j)
        for k in range(strips):
            offset = p[nodes + k] * half
            sag = offset * offset * per_profile
            ut = load(w, row + R.UT + j) - offset * an - sag * am
            um = load(w, row + R.UM + j) + sag * at
            per_square = 1.0 / (ut * ut + um * um + scale * scale)
            share = -mu * p[nodes + strips + k] * math.sqrt(per_square)
            pull = share * pressing
            tt = pull * (1.0 - ut * ut * per_square)
            tm = -pull * ut * um * per_square
            mm = pull * (1.0 - um * um * per_square)
            add_strip(w, K.UT, j, tt, tm, offset, sag)
            add_strip(w, K.UM, j, tm, mm, offset, sag)
            add_strip(w, K.AN, j, -offset * tt, -offset * tm, offset, sag)
            add_strip(w, K.AT, j, sag * tm, sag * mm, offset, sag)
            add_strip(w, K.AM, j, -sag * tt, -sag * tm, offset, sag)
            add_strip(w, K.LOAD, j, share * ut, share * um, offset, sag)
            less = -pull * per_square * steeper
            add_strip(w, K.ENTRAIN, j, less * ut, less * um, offset, sag)
            # a longer ellipse: its places grow with it, their sag twice as fast, and so do the moment arms
            more_t = -offset * an - 2.0 * sag * am
            more_m = 2.0 * sag * at
            ft = tt * more_t + tm * more_m
            fm = tm * more_t + mm * more_m
            add_strip(w, K.HALF, j, ft, fm, offset, sag)
            moments = W.CONTACT + K.TRACTION + K.HALF * K.TRACTION_SIZE + 2 * STRIDE + j
            store(w, moments, load(w, moments) - offset * pull * ut)
            store(w, moments + STRIDE, load(w, moments + STRIDE) + 2.0 * sag * pull * um)
            store(w, moments + 2 * STRIDE, load(w, moments + 2 * STRIDE) - 2.0 * sag * pull * ut)


@kernel
def tried_row(column):
    """Row of ``race`` that holds what the column is for."""
    if column < K.ENTRAIN:
        return R.UT + column * STRIDE
    if column == K.ENTRAIN:
        return R.ENTRAIN
    return R.LOAD if column == K.LOAD else R.HALF


@kernel
def tried_slopes(p, c, lanes, race, w):
    """Fill the columns of any other law by its differences, all balls at once; its rows stay as they were."""
    row = W.RACE + race * R.SIZE
    unmoved = W.CONTACT + K.BEFORE
    for i in range(K.TRACTION_SIZE):
        w[unmoved + i] = w[row + R.FT + i]
    for column in range(K.INPUTS):
        moved = row + tried_row(column)
        out = W.CONTACT + K.TRACTION + column * K.TRACTION_SIZE
        for j in range(STRIDE):
            given = w[moved + j]
            step = _RATE if column == K.AN or column == K.AT or column == K.AM else _VELOCITY
            if column >= K.LOAD:
                step = _SHARE * given + LIGHTEST * (1.0 if column == K.LOAD else 0.0)
            w[W.CONTACT + K.PLACE + j] = given
            w[moved + j] = given + step
        lubricated_traction(p, c, lanes, race, w)
        for j in range(lanes):
            given = w[W.CONTACT + K.PLACE + j]
            per = 1.0 / (w[moved + j] - given + 1e-300)
            if column == K.HALF:
                per *= given
            for i in range(K.FORCES):
                at = i * STRIDE + j
                w[out + at] = (w[row + R.FT + at] - w[unmoved + at]) * per
        for j in range(STRIDE):
            w[moved + j] = w[W.CONTACT + K.PLACE + j]
    for i in range(K.TRACTION_SIZE):
        w[row + R.FT + i] = w[unmoved + i]


@kernel
def rolling_slopes(p, c, lanes, race, w):
    """Add the rolling resistance to the columns it depends on: a moment about the rolling axis."""
    row = W.RACE + race * R.SIZE
    lost = p[P.RACES + race * P.RACE_SIZE + P.RACE_HYSTERESIS]
    law, factors = p[P.ROLLING_LAW], inlet_factors(p, c, race)
    first = W.CONTACT + K.TRACTION + (K.FORCES - 1) * STRIDE
    for j in range(0, lanes, FOUR):
        roll = load(w, row + R.ROLL + j)
        turning = load(w, row + R.AM + j)
        speed = load(w, row + R.ENTRAIN + j)
        pressing = load(w, row + R.LOAD + j)
        half = load(w, row + R.HALF + j)
        # roll over turning is as smooth as turning over its size; at standstill both vanish
        square = turning * turning
        at = first + K.AM * K.TRACTION_SIZE + j
        store(w, at, load(w, at) + roll * turning / ((square + 1e-30) * (square + 1.0)))
        solid = -lost * half * turning / math.sqrt(square + 1.0)  # of hysteresis, per load
        oil = roll - solid * pressing
        by_speed, by_load = local_powers(law, factors, speed, pressing)
        at = first + K.ENTRAIN * K.TRACTION_SIZE + j
        store(w, at, load(w, at) + by_speed * oil * speed / (speed * speed + SLOWEST_2))
        at = first + K.LOAD * K.TRACTION_SIZE + j
        store(w, at, load(w, at) + by_load * oil / (pressing + LIGHTEST) + solid)
        at = first + K.HALF * K.TRACTION_SIZE + j
        store(w, at, load(w, at) + solid * pressing)


@kernel
def clear_traction(w):
    """Set all columns of traction to zero."""
    for i in range(K.INPUTS * K.TRACTION_SIZE):
        w[W.CONTACT + K.TRACTION + i] = 0.0


@kernel
def traction_slopes(p, c, lanes, race, w):
    """Fill the columns of traction of one race, zero before, at the state that the rows of ``w`` hold."""
    if plain_traction(p):
        strip_slopes(p, lanes, race, w)
    else:
        tried_slopes(p, c, lanes, race, w)
    rolling_slopes(p, c, lanes, race, w)
