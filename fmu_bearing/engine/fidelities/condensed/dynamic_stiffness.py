"""What balls and cage do beside balls at rest, at one complex rate: see `condensed.operator`.

A motion is the real part of a complex number times exp((growth + i omega) t); that of a line does not grow. A
family of two planes answers it forward
and backward: with U = u_0 + i u_1, u_0 gives half of either, u_1 half of either a quarter turn on.
"""

from fmu_bearing.engine.complex_numbers import complex_at, pair, real_times
from fmu_bearing.engine.fidelities.condensed.drives import active, add_product, groups
from fmu_bearing.engine.fidelities.condensed.families import family_size, member, planes, side
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store, sum_four
from fmu_bearing.engine.layout import FOUR, LN, L, P, T


@kernel
def modal_response(lv, growth, omega, w):
    """Put 1 / (growth + i omega - lambda) of all modes to ``T.MODAL_RESPONSE``, then at minus ``omega``.

    ``growth``: 1/s, ``omega``: rad/s.
    """
    if not active(lv):
        return
    for family in range(2):
        value = L.FAMILY + family * L.FAMILY_SIZE + L.VALUE
        for whirl in range(2):
            turning = omega if whirl == 0 else -omega
            into = T.MODAL_RESPONSE + whirl * L.BOTH + family * L.COMPLEX
            for m in range(0, groups(lv, family), FOUR):
                re = growth - load(lv, value + m)
                im = turning - load(lv, value + L.MODES + m)
                per = 1.0 / (re * re + im * im + 1e-300)
                store(w, into + m, per * re)
                store(w, into + L.MODES + m, -1.0 * per * im)


@kernel
def drive_modes(lv, family, whirl, by_place, by_rate, growth, omega, w, to):
    """Put the modes of a family, driven at a whirl of ``omega`` (rad/s), to the complex row ``w[to:]``.

    By a place through the row ``lv[by_place:]`` and its rate through ``lv[by_rate:]``.
    """
    at = T.MODAL_RESPONSE + whirl * L.BOTH + family * L.COMPLEX
    for m in range(0, groups(lv, family), FOUR):
        vr, vi = load(lv, by_rate + m), load(lv, by_rate + L.MODES + m)
        xr = load(lv, by_place + m) - omega * vi + growth * vr
        xi = load(lv, by_place + L.MODES + m) + omega * vr + growth * vi
        gr, gi = load(w, at + m), load(w, at + L.MODES + m)
        store(w, to + m, xr * gr - xi * gi)
        store(w, to + L.MODES + m, xr * gi + xi * gr)


@kernel
def modes_on_rings(lv, family, out, driven, x):
    """Return what modes of a family at ``x[driven:]`` do, by the row ``lv[out:]``; complex."""
    re, im = splat(0.0), splat(0.0)
    for m in range(0, groups(lv, family), FOUR):
        re, im = add_product(lv, out + m, x, driven + m, re, im)
    return complex(sum_four(re), sum_four(im))


@kernel
def both_whirls(forward, backward):
    """Complex motion of a plane in itself and a quarter turn on, by a forward and a backward whirl."""
    one, other = real_times(0.5, forward), real_times(0.5, backward).conjugate()
    return one + other, one - other


@kernel
def add_beside(w, i, k, sign, z):
    """Add ``sign`` times a complex number to what coordinate ``i`` of the rings does by coordinate ``k``."""
    w[T.FEEDTHROUGH_RE + i + L.COLUMN * k] += sign * z.real
    w[T.FEEDTHROUGH_IM + i + L.COLUMN * k] += sign * z.imag


@kernel
def ring_dynamic_stiffness(lv, growth, omega, w):
    """Put accelerations by the rings' displacements to ``T.FEEDTHROUGH_RE``, ``_IM``, by columns.

    At ``growth`` (1/s) and ``omega`` (rad/s), after `modal_response`.
    """
    for at in range(0, L.MATRIX, FOUR):
        rate = load(lv, L.FEEDTHROUGH_RATE + at)
        store(w, T.FEEDTHROUGH_RE + at, load(lv, L.FEEDTHROUGH_PLACE + at) + growth * rate)
        store(w, T.FEEDTHROUGH_IM + at, omega * rate)
    if not active(lv):
        return
    for family in range(2):
        f = L.FAMILY + family * L.FAMILY_SIZE
        for b in range(family_size(family)):
            by_place, by_rate = f + L.IN_PLACE + b * L.COMPLEX, f + L.IN_RATE + b * L.COMPLEX
            forward, backward = T.DRIVEN + b * L.COMPLEX, T.DRIVEN + (L.FAMILY_RINGS + b) * L.COMPLEX
            drive_modes(lv, family, 0, by_place, by_rate, growth, omega, w, forward)
            drive_modes(lv, family, 1, by_place, by_rate, growth, -omega, w, backward)
        for a in range(family_size(family)):
            out = f + L.OUT + a * L.COMPLEX
            for b in range(family_size(family)):
                forward = modes_on_rings(lv, family, out, T.DRIVEN + b * L.COMPLEX, w)
                backward = modes_on_rings(lv, family, out, T.DRIVEN + (L.FAMILY_RINGS + b) * L.COMPLEX, w)
                own, turned = both_whirls(forward, backward)
                for plane in range(planes(family)):
                    sign = side(plane, a) * side(plane, b)
                    add_beside(w, member(family, plane, a), member(family, plane, b), sign, own)
                if family == 1:
                    # i times the turned one by the second plane's motion, minus that in it by the first one's
                    aside = complex(-turned.imag, turned.real)
                    add_beside(w, member(1, 0, a), member(1, 1, b), side(1, b), aside)
                    add_beside(w, member(1, 1, a), member(1, 0, b), -side(1, a), aside)


@kernel
def add_ball_response(p, lv, w, re, im):
    """Add accelerations by the balls' places of rest in ``T.LINE_FORCE`` to the right side, see `lines`."""
    if not active(lv):
        return
    away = complex_at(w, T.LINE_FORCE + 2 * LN.AWAY, L.AWAYS * L.PATTERNS)
    for family in range(2):
        f = L.FAMILY + family * L.FAMILY_SIZE
        per = planes(family) / p[P.BALLS]
        for k in range(L.AWAYS):
            row = f + L.IN_AWAY + k * L.COMPLEX
            for whirl in range(2):
                driven = T.DRIVEN + (L.AWAYS * whirl + k) * L.COMPLEX
                drive_modes(lv, family, whirl, row, row, 0.0, 0.0, w, driven)
        for a in range(family_size(family)):
            out = f + L.OUT + a * L.COMPLEX
            i, j = T.LINE_SIDE + member(family, 0, a), T.LINE_SIDE + member(1, 1, a)
            for k in range(L.AWAYS):
                forward = modes_on_rings(lv, family, out, T.DRIVEN + k * L.COMPLEX, w)
                backward = modes_on_rings(lv, family, out, T.DRIVEN + (L.AWAYS + k) * L.COMPLEX, w)
                own, turned = both_whirls(forward, backward)
                # contacts with balls at rest have pushed already
                coupling = pair(lv, f + L.COUPLING + 2 * (L.AWAYS * a + k))
                own, turned = own - coupling.real, turned - complex(0.0, coupling.imag)
                x = real_times(per, away[L.AWAYS * family + k])
                first = own * x
                if family == 1:
                    y = real_times(per, away[2 * L.AWAYS + k])
                    first += 1j * (turned * y)
                    second = real_times(side(1, a), own * y - 1j * (turned * x))
                    re[j] += second.real
                    im[j] += second.imag
                re[i] += first.real
                im[i] += first.imag
