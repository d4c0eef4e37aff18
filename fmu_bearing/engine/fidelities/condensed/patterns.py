"""Balls and cage beside the condensed balls, stepped in time by their modes: see `operator`.

A mode z' = lambda z + a q + b q' + c e is driven by the rings' places q and by how far balls rest from where
these would take them, e. Over a step it is solved exactly, stable however stiff (exponential integrators:
Hochbruck and Ostermann 2010), for q a cubic through places and velocities at both ends, and e a polynomial
through its last values. With b q' integrated by parts q counts by a + lambda b. What belongs to the end of
the step is that of the trial state.
"""

from fmu_bearing.engine.complex_numbers import complex_at, pair, real_times, square
from fmu_bearing.engine.dense import times
from fmu_bearing.engine.fidelities.condensed.drives import (
    active,
    add_input,
    add_product,
    by_families,
    find_away,
    find_drive,
    groups,
    keep_drive,
    modes_of,
    share_of_loaded_balls,
    show_linear,
)
from fmu_bearing.engine.fidelities.condensed.dynamic_stiffness import modes_on_rings
from fmu_bearing.engine.fidelities.condensed.families import add_members, family_size, member, side
from fmu_bearing.engine.fidelities.condensed.operator import mode_of, put, static_mode
from fmu_bearing.engine.fidelities.condensed.phi import moments, weigh
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store
from fmu_bearing.engine.layout import FOUR, F, L, T, W, Y

# Radians per step of a mode beyond which it follows its drive: there a polynomial through five places of rest
# makes what is fast in them larger, three serve.
_STIFF = 20.0
_SAME = 1e-9  # of a step: with so little difference the weights of another one serve
# s: in which the share of loaded balls follows, a period of a ring's mode: at once, balls that come and
# go between two trial states leave no step to go on with
_LATELY = 1e-4
# s: in which what a new operator adds beside the one before comes in. At once it is a step of the force at
# each renewal of a run-up, every 2 ms: a comb of lines 35 dB below the spectrum.
_COMES_IN = 2e-3


@kernel
def prepare_step(lv, h, w):
    """Fill what is left of the modes after a step ``h`` (s), and what the drives add, where that changes."""
    known = min(lv[L.KNOWN], 3.0)
    # equal steps of a communication step differ by rounding
    same = abs(h - lv[L.MODES_STEP]) <= _SAME * h and known == lv[L.MODES_KNOWN]
    if same or not active(lv):
        return
    lv[L.MODES_STEP] = h
    lv[L.MODES_KNOWN] = known
    found = complex_at(w, T.KEPT, 6)
    for family in range(2):
        value = L.FAMILY + family * L.FAMILY_SIZE + L.VALUE
        gain = L.MODES_GAIN + family * L.COMPLEX
        for m in range(modes_of(lv, family)):
            x = real_times(h, mode_of(lv, value, m))
            moments(x, found)
            m0, m1, m2, m3, m4 = found[1], found[2], found[3], found[4], found[5]
            put(lv, L.MODES_STAY + family * L.COMPLEX, m, found[0])
            put(lv, gain + L.GAIN_PLACE, m, h * (3.0 * m2 - 2.0 * m3))
            put(lv, gain + L.GAIN_SLOPE, m, h * h * (m3 - m2))
            put(lv, gain + L.GAIN_FROM_PLACE, m, h * (m0 - 3.0 * m2 + 2.0 * m3))
            put(lv, gain + L.GAIN_FROM_SLOPE, m, h * h * (m1 - 2.0 * m2 + m3))
            weights = weigh(m0, m1, m2, m3, m4, known, square(x) > _STIFF * _STIFF)
            for k in range(L.HISTORY):
                put(lv, gain + L.GAIN_AWAY + k * L.BOTH, m, h * weights[k])


@kernel
def begin_step(lv, w):
    """Write what the modes do in a step whose drives at the end are zero to ``T.MODES_FREE``."""
    if not active(lv):
        return
    by_place, by_slope = L.MODES_DRIVEN + L.BY_PLACE * L.BOTH, L.MODES_DRIVEN + L.BY_SLOPE * L.BOTH
    by_rate, by_away = L.MODES_DRIVEN + L.BY_RATE * L.BOTH, L.MODES_DRIVEN + L.BY_AWAY * L.BOTH
    for family in range(2):
        first = family * L.COMPLEX
        for m in range(first, first + groups(lv, family), FOUR):
            # what the rates alone have done goes as the mode itself
            zr = load(lv, L.MODES_NOW + m) - load(lv, by_rate + m)
            zi = load(lv, L.MODES_NOW + L.MODES + m) - load(lv, by_rate + L.MODES + m)
            sr, si = load(lv, L.MODES_STAY + m), load(lv, L.MODES_STAY + L.MODES + m)
            re, im = sr * zr - si * zi, sr * zi + si * zr
            gain = L.MODES_GAIN + m
            re, im = add_product(lv, gain + L.GAIN_FROM_PLACE, lv, by_place + m, re, im)
            re, im = add_product(lv, gain + L.GAIN_FROM_SLOPE, lv, by_slope + m, re, im)
            for k in range(L.HISTORY - 1):
                gain = L.MODES_GAIN + L.GAIN_AWAY + (1 + k) * L.BOTH
                re, im = add_product(lv, gain + m, lv, by_away + k * L.BOTH + m, re, im)
            keep_drive(w, T.MODES_FREE + m, re, im)


@kernel
def at_end(lv, w, m):
    """Four modes at the end of a step, by the drives of the trial state: real and imaginary parts."""
    driven = T.MODES_DRIVEN + m
    re = load(w, T.MODES_FREE + m) + load(w, driven + L.BY_RATE * L.BOTH)
    im = load(w, T.MODES_FREE + L.MODES + m) + load(w, driven + L.BY_RATE * L.BOTH + L.MODES)
    gain = L.MODES_GAIN + m
    re, im = add_product(lv, gain + L.GAIN_PLACE, w, driven + L.BY_PLACE * L.BOTH, re, im)
    re, im = add_product(lv, gain + L.GAIN_SLOPE, w, driven + L.BY_SLOPE * L.BOTH, re, im)
    return add_product(lv, gain + L.GAIN_AWAY, w, driven + L.BY_AWAY * L.BOTH, re, im)


@kernel
def add_modes_on_rings(lv, x, z, w):
    """Add what the modes ``x[z:]`` do to the rings to ``T.ADDED``.

    Beside the contacts of balls at rest: with the rings' own terms; as far as balls are loaded.
    """
    share = lv[L.SHARE]
    for family in range(2):
        f = L.FAMILY + family * L.FAMILY_SIZE
        for a in range(family_size(family)):
            pushed = modes_on_rings(lv, family, f + L.OUT + a * L.COMPLEX, z + family * L.COMPLEX, x)
            for k in range(L.AWAYS):
                away = pair(w, T.AWAY_NOW + T.FAMILY_AWAY * family + 2 * k)
                pushed -= pair(lv, f + L.COUPLING + 2 * (L.AWAYS * a + k)) * away
            w[T.ADDED + member(family, 0, a)] += share * pushed.real
            if family == 1:
                w[T.ADDED + member(1, 1, a)] += share * side(1, a) * pushed.imag
    times(lv, L.FEEDTHROUGH_PLACE, w, T.LINEAR, w, T.V)
    times(lv, L.FEEDTHROUGH_RATE, w, W.STAGE + Y.V0, w, T.D)
    for i in range(L.N):
        w[T.ADDED + i] += share * (w[T.V + i] + w[T.D + i])


@kernel
def add_patterns(p, lv, h, w):
    """Add what balls and cage do at the end of a step ``h`` (s) to the accelerations at ``w[W.F + F.BODY:]``.

    The rings are in the trial state, after :func:`begin_step` and a sweep.
    """
    for i in range(0, L.COLUMN, FOUR):
        store(w, T.ADDED + i, splat(0.0))
    if active(lv):
        show_linear(lv, w)
        find_away(p, lv, w)
        find_drive(lv, w)
        for family in range(2):
            first = family * L.COMPLEX
            for m in range(first, first + groups(lv, family), FOUR):
                re, im = at_end(lv, w, m)
                keep_drive(w, T.MODES_END + m, re, im)
        add_modes_on_rings(lv, w, T.MODES_END, w)
    left = 1.0 - h / (h + _COMES_IN)
    for i in range(L.N):
        w[T.ADDED + i] += left * lv[L.JUMP + i]
        w[W.F + F.BODY + i] += w[T.ADDED + i]


@kernel
def correct_patterns(lv, h, counts, w):
    """Move the drive on by what the last change ``T.D`` of the trial accelerations does to it.

    The velocities that drive the modes are the true ones: see `rings.correction.true_rates`. ``counts``: what
    the last acceleration counts in its own rate, times h.
    """
    if not active(lv):
        return
    by_velocity = h * (0.5 - counts / 12.0)  # half less a twelfth of it
    by_place = h * h / 12.0
    by_families(w, T.D, T.PLACES, w)
    for family in range(2):
        f = L.FAMILY + family * L.FAMILY_SIZE
        into = T.MODES_DRIVEN + family * L.COMPLEX
        for m in range(0, groups(lv, family), FOUR):
            re, im = splat(0.0), splat(0.0)
            rr, ri = splat(0.0), splat(0.0)
            for b in range(family_size(family)):
                change = pair(w, T.PLACES + T.FAMILY_PLACES * family + 2 * b)
                re, im = add_input(lv, f + L.IN_WHOLE + b * L.COMPLEX, change, m, re, im)
                rr, ri = add_input(lv, f + L.IN_RATE + b * L.COMPLEX, change, m, rr, ri)
            move_drive(w, into + L.BY_PLACE * L.BOTH + m, by_place, re, im)
            move_drive(w, into + L.BY_SLOPE * L.BOTH + m, by_velocity, re, im)
            move_drive(w, into + L.BY_RATE * L.BOTH + m, by_place, rr, ri)


@kernel
def move_drive(w, at, by, re, im):
    """Add ``by`` times four complex numbers to a row."""
    store(w, at, load(w, at) + by * re)
    store(w, at + L.MODES, load(w, at + L.MODES) + by * im)


@kernel
def keep_patterns(p, lv, h, w):
    """Move the modes to the end of the step ``h`` (s)."""
    left = 1.0 - h / (h + _COMES_IN)
    for i in range(L.COLUMN):
        lv[L.JUMP + i] *= left
        lv[L.ADDED + i] = w[T.ADDED + i]
    if not active(lv):
        return
    lv[L.SHARE] += h / (h + _LATELY) * (share_of_loaded_balls(p, lv, w) - lv[L.SHARE])
    away = L.MODES_DRIVEN + L.BY_AWAY * L.BOTH
    for family in range(2):
        first = family * L.COMPLEX
        for m in range(first, first + groups(lv, family), FOUR):
            re, im = at_end(lv, w, m)
            keep_drive(lv, L.MODES_NOW + m, re, im)
            for part in range(m, m + 2 * L.MODES, L.MODES):
                for k in range(3, 0, -1):
                    store(lv, away + k * L.BOTH + part, load(lv, away + (k - 1) * L.BOTH + part))
                for k in range(4):
                    row = k * L.BOTH + part
                    store(lv, L.MODES_DRIVEN + row, load(w, T.MODES_DRIVEN + row))


@kernel
def carry_patterns(p, lv, w):
    """After a jump: put the modes to where their drive holds them, and add what they do to the rings.

    With a new operator `operator.find_operator` has left in the modes how far balls and cage are from there;
    else they keep their distance from where the drive before would hold them. What a new operator adds beside
    the one before, at a start beside nothing, comes in by and by. To the accelerations at
    ``w[W.F + F.BODY:]``, with the rings in the trial state and after a sweep.
    """
    for i in range(0, L.COLUMN, FOUR):
        store(w, T.ADDED + i, splat(0.0))
    if active(lv):
        carry_modes(p, lv, w)
    for i in range(L.N):
        if lv[L.MODES_NEW] != 0.0:
            lv[L.JUMP + i] = lv[L.ADDED + i] - w[T.ADDED + i]
        lv[L.ADDED + i] = w[T.ADDED + i] + lv[L.JUMP + i]
        w[W.F + F.BODY + i] += lv[L.ADDED + i]
    lv[L.MODES_NEW] = 0.0


@kernel
def carry_modes(p, lv, w):
    """As `carry_patterns`, with an operator, to ``T.ADDED``."""
    show_linear(lv, w)
    find_away(p, lv, w)
    find_drive(lv, w)
    for family in range(2):
        first = family * L.COMPLEX
        for m in range(modes_of(lv, family)):
            now = mode_of(lv, L.MODES_NOW + first, m)
            if lv[L.MODES_NEW] == 0.0:
                now -= static_mode(lv, family, m, lv, L.MODES_DRIVEN)
            put(lv, L.MODES_NOW + first, m, now + static_mode(lv, family, m, w, T.MODES_DRIVEN))
            for k in range(4):
                row = k * L.BOTH + first
                put(lv, L.MODES_DRIVEN + row, m, mode_of(w, T.MODES_DRIVEN + row, m))
    lv[L.SHARE] = share_of_loaded_balls(p, lv, w)
    add_modes_on_rings(lv, lv, L.MODES_NOW, w)


@kernel
def add_step(lv, cv, cx, x, at, row, column):
    """Add what rings do to themselves through balls and cage within a step to a matrix ``x[at:]``.

    Derivatives of accelerations, by rates times ``cv`` and by places times ``cx``, with the other sign.
    """
    if not active(lv):
        return
    share = lv[L.SHARE]
    for i in range(L.N):
        for k in range(L.N):
            beside = i + L.COLUMN * k
            own = cv * lv[L.FEEDTHROUGH_RATE + beside] + cx * lv[L.FEEDTHROUGH_PLACE + beside]
            x[at + i * row + k * column] -= share * own
    for family in range(2):
        f = L.FAMILY + family * L.FAMILY_SIZE
        gains = L.MODES_GAIN + family * L.COMPLEX
        for a in range(family_size(family)):
            for b in range(family_size(family)):
                total = 0j
                for m in range(modes_of(lv, family)):
                    gain = real_times(cx, mode_of(lv, gains + L.GAIN_PLACE, m))
                    gain += real_times(cv, mode_of(lv, gains + L.GAIN_SLOPE, m))
                    by = gain * mode_of(lv, f + L.IN_WHOLE + b * L.COMPLEX, m)
                    by += real_times(cx, mode_of(lv, f + L.IN_RATE + b * L.COMPLEX, m))
                    total += mode_of(lv, f + L.OUT + a * L.COMPLEX, m) * by
                add_members(real_times(-share, total), x, at, row, column, family, a, b)
