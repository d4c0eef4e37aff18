"""What drives the modes of balls and cage: the rings' places, and how far balls rest from where these lead.

See `operator`; `patterns` steps them.
"""

from fmu_bearing.engine.complex_numbers import complex_at, pair, real_times
from fmu_bearing.engine.fidelities.condensed.balls import loaded_share
from fmu_bearing.engine.fidelities.condensed.families import family_size
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store, sum_four, sum_lanes
from fmu_bearing.engine.layout import FOUR, L, P, Q, T, W, Y

# Eighth power of a ball's share of the load it was linearised at: 1e-4 of one that has all is left out, half
# of one that has a third.
_LIGHT = 1e-4


@kernel
def share_of_loaded_balls(p, lv, w):
    """Return the share of balls that both races load as at the frozen point; others rest where they are."""
    return min(1.0, lv[L.PRESS + L.PRESS_WHOLE] * sum_lanes(w, T.LOADED, int(p[P.LANES])) / p[P.BALLS])


@kernel
def modes_of(lv, family):
    """Return the number of modes of a family."""
    return int(lv[L.OPERATOR + family])


@kernel
def groups(lv, family):
    """Return the number of lanes in use for a family."""
    return (modes_of(lv, family) + FOUR - 1) // FOUR * FOUR


@kernel
def active(lv):
    """Whether there is an operator: else balls follow statically."""
    return lv[L.OPERATOR] != 0.0


@kernel
def by_families(x, at, to, w):
    """Put the rings' numbers ``x[at:]`` by families to ``w[to:]``: four complex ones each, see `families`."""
    one, two = complex_at(w, to, L.FAMILY_RINGS), complex_at(w, to + T.FAMILY_PLACES, L.FAMILY_RINGS)
    outer = at + Q.OUTER
    one[0], one[1], one[2], one[3] = x[at + Q.X], x[outer + Q.X], x[outer + Q.TURN], 0.0
    two[0], two[1] = complex(x[at + Q.Z], x[at + Q.Y]), complex(x[at + Q.INNER_BY], -x[at + Q.INNER_BZ])
    two[2], two[3] = complex(x[outer + Q.Z], x[outer + Q.Y]), complex(x[outer + Q.BY], -x[outer + Q.BZ])


@kernel
def linear_place(lv, family, k, w):
    """Return the complex place of rest x or r (``k``) of a pattern that the rings' linear motion gives."""
    total = 0j
    for part in range(2):
        follow = L.FAMILY + family * L.FAMILY_SIZE + L.FOLLOW + 2 * (2 * part + k) * L.FAMILY_RINGS
        place = (T.PLACES if part == 0 else T.RATES) + T.FAMILY_PLACES * family
        for b in range(family_size(family)):
            total += pair(lv, follow + 2 * b) * pair(w, place + 2 * b)
    return total


@kernel
def pressing(w, k, tau):
    """Complex coordinate at place ``k`` of a family's, ahead by its rate for ``tau`` (s)."""
    return pair(w, T.PLACES + k) + real_times(tau, pair(w, T.RATES + k))


@kernel
def linear_approach(lv, race, tau, x0, r0, x, r, w):
    """Return by how much the rings' linear motion presses a contact (m): uniform, then complex of family 1.

    ``x0``, ``r0``: the linear places of a ball, of family 0; ``x``, ``r``: complex, of family 1; ``tau`` (s):
    of contact damping.
    """
    at = L.PRESS + race * L.PRESS_SIZE
    ex, er, lever = lv[at], lv[at + 1], lv[at + L.PRESS_LEVER]
    one = T.FAMILY_PLACES + 2 * 2 * race
    still = ex * x0 + er * r0 - ex * pressing(w, 2 * race, tau).real
    turned = real_times(ex, x) + real_times(er, r - pressing(w, one, tau))
    return still, turned - real_times(lever, pressing(w, one + 2, tau))


@kernel
def load_after_move(w, at, j):
    """Return loads (N) of four contacts, rows from ``at`` on, with the balls where the sweep put them.

    To first order, as what rings feel: by the loads before the sweep, what a ball adds would change from one
    correction to the next by as much as the first one corrects.
    """
    along = load(w, at + T.EX + j) * load(w, T.DX + j) + load(w, at + T.ER + j) * load(w, T.DR + j)
    return max(load(w, at + T.LOAD + j) + load(w, at + T.STIFF + j) * along, 0.0)


@kernel
def find_away(p, lv, w):
    """Put how far the balls' places of rest are from where the rings' motion would take them to `T.AWAY_NOW`.

    Of family 0, then of family 1: complex x, r, then how far both contacts press, see ``L.AWAYS``. After a
    sweep, with the rings at the trial state. Balls that are farther away than contacts approach fade out, as
    loose ones and light ones do: nothing there is linear, and what one ball does would change with forces
    that nobody feels. Where all carry little, as much as they carry at the frozen point is no less than
    whole.
    """
    x0, r0 = linear_place(lv, 0, 0, w).real, linear_place(lv, 0, 1, w).real
    x1, r1 = linear_place(lv, 1, 0, w), linear_place(lv, 1, 1, w)
    tau = p[P.CONTACT_DAMPING]
    i0, i1 = linear_approach(lv, 0, tau, x0, r0, x1, r1, w)
    o0, o1 = linear_approach(lv, 1, tau, x0, r0, x1, r1, w)
    x0 += lv[L.AT_BALL]
    r0 += lv[L.AT_BALL + 1]
    per_i, per_o = lv[L.PRESS + L.PRESS_SOFT], lv[L.PRESS + L.PRESS_SIZE + L.PRESS_SOFT]
    i0 += per_i * lv[L.PRESS + L.PRESS_LOAD]
    o0 += per_o * lv[L.PRESS + L.PRESS_SIZE + L.PRESS_LOAD]
    per = 1.0 / lv[L.LOADED]
    whole = lv[L.PRESS + L.PRESS_WHOLE]
    xx, xr2, rr2 = lv[L.REACH], 2.0 * lv[L.REACH + 1], lv[L.REACH + 2]
    ux, ur, cx, cr, sx, sr = splat(0.0), splat(0.0), splat(0.0), splat(0.0), splat(0.0), splat(0.0)
    ui, uo, ci, cout, si_, sout = splat(0.0), splat(0.0), splat(0.0), splat(0.0), splat(0.0), splat(0.0)
    for j in range(0, int(p[P.LANES]), FOUR):
        co, si = load(w, T.COS + j), load(w, T.SIN + j)
        x = load(w, T.X + j) - x0 - (x1.real * co - x1.imag * si)
        r = load(w, T.R + j) - r0 - (r1.real * co - r1.imag * si)
        far = x * (xx * x + xr2 * r) + rr2 * r * r
        inner, outer = load_after_move(w, T.CONTACT, j), load_after_move(w, T.CONTACT_OUTER, j)
        loaded = per * inner * outer
        loaded *= loaded
        weight = load(lv, L.MASK + j) * min(1.0, whole * loaded_share(inner, outer)) * loaded * loaded
        weight /= (loaded * loaded + _LIGHT) * (1.0 + far * far)
        x, r = weight * x, weight * r
        ux, ur = ux + x, ur + r
        cx, cr = cx + co * x, cr + co * r
        sx, sr = sx - si * x, sr - si * r
        x = weight * (per_i * inner - i0 - (i1.real * co - i1.imag * si))
        r = weight * (per_o * outer - o0 - (o1.real * co - o1.imag * si))
        ui, uo = ui + x, uo + r
        ci, cout = ci + co * x, cout + co * r
        si_, sout = si_ - si * x, sout - si * r
    per = 1.0 / p[P.BALLS]
    one, two = complex_at(w, T.AWAY_NOW, L.AWAYS), complex_at(w, T.AWAY_NOW + T.FAMILY_AWAY, L.AWAYS)
    one[0], one[1] = per * sum_four(ux), per * sum_four(ur)
    one[2], one[3] = per * sum_four(ui), per * sum_four(uo)
    per *= 2.0
    two[0] = complex(per * sum_four(cx), per * sum_four(sx))
    two[1] = complex(per * sum_four(cr), per * sum_four(sr))
    two[2] = complex(per * sum_four(ci), per * sum_four(si_))
    two[3] = complex(per * sum_four(cout), per * sum_four(sout))


@kernel
def add_input(lv, row, z, m, re, im):
    """Return (``re``, ``im``) plus the row of four modes at ``lv[row + m:]`` times a complex number."""
    ar, ai = load(lv, row + m), load(lv, row + L.MODES + m)
    return re + (ar * z.real - ai * z.imag), im + (ar * z.imag + ai * z.real)


@kernel
def add_product(x, a, y, b, re, im):
    """Return (``re``, ``im``) plus the complex product of the rows ``x[a:]`` and ``y[b:]``, four modes."""
    ar, ai = load(x, a), load(x, a + L.MODES)
    br, bi = load(y, b), load(y, b + L.MODES)
    return re + (ar * br - ai * bi), im + (ar * bi + ai * br)


@kernel
def find_drive(lv, w):
    """Put what drives the modes at the trial state to ``T.MODES_DRIVEN``, after :func:`find_away`."""
    for family in range(2):
        f = L.FAMILY + family * L.FAMILY_SIZE
        into = T.MODES_DRIVEN + family * L.COMPLEX
        for m in range(0, groups(lv, family), FOUR):
            re, im = splat(0.0), splat(0.0)
            sr, si = splat(0.0), splat(0.0)
            rr, ri = splat(0.0), splat(0.0)
            for b in range(family_size(family)):
                whole = f + L.IN_WHOLE + b * L.COMPLEX
                here = T.FAMILY_PLACES * family + 2 * b
                place = pair(w, T.PLACES + here)
                re, im = add_input(lv, whole, place, m, re, im)
                rr, ri = add_input(lv, f + L.IN_RATE + b * L.COMPLEX, place, m, rr, ri)
                sr, si = add_input(lv, whole, pair(w, T.RATES + here), m, sr, si)
            keep_drive(w, into + L.BY_PLACE * L.BOTH + m, re, im)
            keep_drive(w, into + L.BY_SLOPE * L.BOTH + m, sr, si)
            keep_drive(w, into + L.BY_RATE * L.BOTH + m, rr, ri)
            re, im = splat(0.0), splat(0.0)
            for k in range(L.AWAYS):
                away = pair(w, T.AWAY_NOW + T.FAMILY_AWAY * family + 2 * k)
                re, im = add_input(lv, f + L.IN_AWAY + k * L.COMPLEX, away, m, re, im)
            keep_drive(w, into + L.BY_AWAY * L.BOTH + m, re, im)


@kernel
def keep_drive(w, at, re, im):
    """Write four complex numbers of a row."""
    store(w, at, re)
    store(w, at + L.MODES, im)


@kernel
def show_linear(lv, w):
    """Put the rings' trial places less the frozen ones to ``T.LINEAR``, and by families with their rates."""
    for i in range(L.N):
        w[T.LINEAR + i] = w[W.STAGE + Y.Q0 + i] - lv[L.AT_RINGS + i]
    by_families(w, T.LINEAR, T.PLACES, w)
    by_families(w, W.STAGE + Y.V0, T.RATES, w)
