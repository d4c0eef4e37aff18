"""What the balls do in the sound of a line (fidelity `response`): their accelerations by harmonics.

A ball's place between the rings is, to first order, linear in the rings' motion, in the heights under it and
in the slope across its track, with coefficients that depend on its azimuth alone: orders l. Across its track
it lags behind its place of rest (``condensed.ball_motion``). The harmonic mu of all balls (their sum times
exp(i mu theta)) takes up

* of a motion of the rings at a line's frequency: l = -mu, at the same frequency (and l + mu = +-Z);
* of wave n of a race: n + l = N, with N + mu a multiple of the number of balls Z, at the frequency that the
  harmonic has from outside: mu times the cage's speed above the one that a ball feels;
* of unequal loads round the orbit: N = l alone;
* of what differs from ball to ball (size, form): any a = l + mu, with the transform over the balls.

So waves that move no ring sound too. ``x``: scratch of the lines, see `layout.lines`.
"""

from fmu_bearing.engine.choices import CONTACTS
from fmu_bearing.engine.fidelities.condensed.transverse import pattern_answer
from fmu_bearing.engine.fidelities.response.lines import (
    form_sums,
    orders,
    size_sums,
    wave_of,
)
from fmu_bearing.engine.fidelities.response.samples import order_of
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR, LN, SD, C, L, P, Q
from fmu_bearing.engine.sound.transfer import add_channel

_SMALL = 2e-3  # of the largest order of a place: left out, 0.02 dB


@kernel
def reach_of_rings(x):
    """Highest order of the balls' places by the rings' coordinates that is not small."""
    largest = 0.0
    highest = 0
    for order in range(LN.REACH + 1):
        found = 0.0
        for i in range(L.N * FOUR):
            found = max(found, abs(x[LN.FOLLOW + order * L.N * FOUR + i]))
        largest = max(largest, found)
        if found > _SMALL * largest:
            highest = order
    return highest


@kernel
def reach_of_heights(x):
    """Highest order of the balls' places by the races' heights that is not small."""
    largest = 0.0
    highest = 0
    for order in range(LN.REACH + 1):
        found = 0.0
        for race in range(2):
            at = order_of(LN.BY_HEIGHT + race, order) + LN.PLACES
            for i in range(LN.COMPONENTS - LN.PLACES):
                found = max(found, max(abs(x[at + i]), abs(x[at + LN.IMAGINARY + i])))
        largest = max(largest, found)
        if found > _SMALL * largest:
            highest = order
    return highest


@kernel
def add_ball_motion(p, lv, ps, ws, mu, omega, speed, place, away, rolled):
    """Add the accelerations of all balls to the channels of their harmonic ``mu``.

    ``place``: complex places x, r (m) that a ball would rest at, times the number of balls or summed over
    them; ``away``: across the track; ``rolled``: velocity (m/s) that rolling gives there. ``omega``: of the
    line (rad/s), seen from outside.
    """
    orbit = lv[L.RATIO] * speed
    seen = omega - mu * orbit  # by a ball
    xr, xi, rr, ri = place
    sr, si = away
    if lv[L.SIDE_SQUARE] != 0.0:
        gr, gi = pattern_answer(lv, seen)
        ahead = seen * p[P.CONTACT_DAMPING]
        dr = lv[L.SIDE_SQUARE] * (sr - ahead * si) + lv[L.SIDE_RATE] * rolled[0]
        di = lv[L.SIDE_SQUARE] * (si + ahead * sr) + lv[L.SIDE_RATE] * rolled[1]
        lag_re, lag_im = gr * dr - gi * di - sr, gr * di + gi * dr - si
        xr += lv[L.SIDE] * lag_re
        xi += lv[L.SIDE] * lag_im
        rr += lv[L.SIDE + 1] * lag_re
        ri += lv[L.SIDE + 1] * lag_im
    if int(ps[SD.H_FORM]) == CONTACTS:
        at = int(ps[SD.H_AT_SCALARS])
        sine, cosine = ps[at + SD.SCALAR_SINE], ps[at + SD.SCALAR_COSINE]
        re, im = -seen * (sine * xi + cosine * ri), seen * (sine * xr + cosine * rr)
        add_contacts(ps, ws, SD.FAMILY_BALLS, mu, omega, re, im)
        return
    squared = seen * seen
    turned = squared + orbit * orbit  # its radius changes the centripetal acceleration,
    coriolis = 2.0 * seen * orbit  # and its velocity turns
    if mu == 0:
        at = SD.C_BALLS
        add_channel(ps, ws, at + SD.MEAN_X, -squared * xr, -squared * xi)
        add_channel(ps, ws, at + SD.MEAN_R, -turned * rr, -turned * ri)
        return
    at = SD.C_HARMONICS + SD.HARMONIC_SIZE * (abs(mu) - 1)
    half = 0.5 if mu > 0 else -0.5
    add_harmonic(ps, ws, at + SD.HARMONIC_X_COS, half, -squared * xr, -squared * xi)
    add_harmonic(ps, ws, at + SD.HARMONIC_R_COS, half, -turned * rr, -turned * ri)
    add_harmonic(ps, ws, at + SD.HARMONIC_T_COS, half, -coriolis * ri, coriolis * rr)


@kernel
def add_contacts(ps, ws, family, mu, omega, re, im):
    """Add the rate of one family's harmonic ``mu`` (form contacts).

    ``re``, ``im``: its normal velocities (m/s) times exp(i mu theta), summed; ``omega`` (rad/s): of the line,
    seen from outside.
    """
    at = (1 + 2 * int(ps[SD.H_HARMONICS])) * family
    if mu == 0:
        add_channel(ps, ws, at, -omega * im, omega * re)
    else:
        half = 0.5 if mu > 0 else -0.5
        add_harmonic(ps, ws, at + 2 * abs(mu) - 1, half, -omega * im, omega * re)


@kernel
def add_ring_contacts(p, lv, ps, ws, q, re, im, omega, speed, shift):
    """Add what both rings do at their contacts (form contacts); arguments: see `follow_rings`."""
    at = int(ps[SD.H_AT_SCALARS])
    balls = p[P.BALLS]
    turned = omega + shift * balls * lv[L.RATIO] * speed
    for order in range(-1, 2):
        mu = int(shift * balls) - order
        if abs(mu) > int(ps[SD.H_HARMONICS]):
            continue
        for ring in range(2):
            first = Q.OUTER if ring == 1 else Q.INNER
            if order == 0:
                by = balls * ps[at + SD.SCALAR_SINE]
                vr, vi = -by * omega * q[im + first], by * omega * q[re + first]
            else:
                # z cos - y sin of a ball's angle
                by = 0.5 * balls * ps[at + SD.SCALAR_COSINE] * omega
                yr, yi = order * q[re + first + Q.Y], order * q[im + first + Q.Y]
                vr = -by * (q[im + first + Q.Z] + yr)
                vi = by * (q[re + first + Q.Z] - yi)
            add_contacts(ps, ws, SD.FAMILY_OUTER if ring == 1 else SD.FAMILY_INNER, mu, turned, vr, vi)


@kernel
def add_harmonic(ps, ws, channel, half, re, im):
    """Add half of a sum times exp(i mu theta) to its cosine's and, a quarter turn on, to its sine's channel.

    ``half``: negative for a negative order mu.
    """
    add_channel(ps, ws, channel, abs(half) * re, abs(half) * im)
    add_channel(ps, ws, channel + 1, half * im, -half * re)


@kernel
def follow_rings(p, lv, x, ps, ws, q, re, im, omega, speed, shift):
    """Add what the balls do as they follow the rings, at complex coordinates ``q[re:]`` and ``q[im:]``.

    ``omega``: of the rings' line (rad/s). Seen through so many balls as the harmonic has periods, order l is
    order l less Z: the harmonics l + mu = ``shift`` Z turn ``shift`` Z cage speeds faster than the rings do.
    """
    balls = p[P.BALLS]
    highest = int(ps[SD.H_HARMONICS])
    reach = reach_of_rings(x)
    turned = omega + shift * balls * lv[L.RATIO] * speed
    for order in range(-reach, reach + 1):
        mu = int(shift * balls) - order
        if abs(mu) > highest:
            continue
        sign = 1.0 if order >= 0 else -1.0  # order -l is the conjugate of order l
        xr, xi, rr, ri = 0.0, 0.0, 0.0, 0.0
        for i in range(L.N):
            at = LN.FOLLOW + (abs(order) * L.N + i) * FOUR
            a, b = q[re + i], q[im + i]
            xr += x[at] * a - sign * x[at + 1] * b
            xi += x[at] * b + sign * x[at + 1] * a
            rr += x[at + 2] * a - sign * x[at + FOUR - 1] * b
            ri += x[at + 2] * b + sign * x[at + FOUR - 1] * a
        place = balls * xr, balls * xi, balls * rr, balls * ri
        away = (
            lv[L.SIDE] * place[0] + lv[L.SIDE + 1] * place[2],
            lv[L.SIDE] * place[1] + lv[L.SIDE + 1] * place[FOUR - 1],
        )
        rolled = rolled_by_rings(lv, order, balls, q, re, im, omega)
        add_ball_motion(p, lv, ps, ws, mu, turned, speed, place, away, rolled)


@kernel
def rolled_by_rings(lv, order, balls, q, re, im, omega):
    """Velocity (m/s) across the track that rolling gives all balls, of one order round the orbit: complex."""
    if abs(order) > 1:
        return 0.0, 0.0
    total_re, total_im = 0.0, 0.0
    for i in range(L.N):
        vr, vi = -omega * q[im + i], omega * q[re + i]
        if order == 0:
            by = lv[L.SIDE_GUIDE + i]
            total_re += by * vr
            total_im += by * vi
        else:
            # cos and -sin of a ball's angle
            by = 0.5 * lv[L.SIDE_GUIDE + L.COLUMN + i]
            aside = 0.5 * order * lv[L.SIDE_GUIDE + 2 * L.COLUMN + i]
            total_re += by * vr - aside * vi
            total_im += by * vi + aside * vr
    return balls * total_re, balls * total_im


@kernel
def place_by(lv, x, kind, order):
    """How a ball's place of rest answers one kind of excitation through ``order``.

    x, r, across; real and imaginary.
    """
    at = order_of(kind, abs(order))
    sign = 1.0 if order >= 0 else -1.0
    xr, rr = x[at + LN.PLACES], x[at + LN.PLACES + 1]
    ar = lv[L.SIDE] * x[at + LN.AWAY] + lv[L.SIDE + 1] * x[at + LN.AWAY + 1]
    at += LN.IMAGINARY
    xi, ri = x[at + LN.PLACES], x[at + LN.PLACES + 1]
    ai = lv[L.SIDE] * x[at + LN.AWAY] + lv[L.SIDE + 1] * x[at + LN.AWAY + 1]
    return xr, sign * xi, rr, sign * ri, ar, sign * ai


@kernel
def added_places(sums, by, re, im):
    """Add complex places ``by`` times ``re`` + i ``im`` to ``sums``."""
    a, b, c, d, e, f = by
    xr, xi, rr, ri, ar, ai = sums
    return (
        xr + a * re - b * im, xi + a * im + b * re, rr + c * re - d * im, ri + c * im + d * re,
        ar + e * re - f * im, ai + e * im + f * re,
    )  # fmt: skip


@kernel
def add_found(p, lv, ps, ws, mu, omega, speed, sums):
    """Add the motion of the balls' harmonic ``mu``, which rest at the places ``sums``."""
    xr, xi, rr, ri, ar, ai = sums
    place = xr, xi, rr, ri
    add_ball_motion(p, lv, ps, ws, mu, omega, speed, place, (ar, ai), (0.0, 0.0))


@kernel
def drive_by_inner(p, c, lv, x, ps, ws, n, a, reach, speed):
    """Fill the balls' channels of what wave ``n`` of the inner race does at ``a`` times ball 0's angle."""
    orbit = lv[L.RATIO] * speed
    harmonics = int(ps[SD.H_HARMONICS])
    re, im = wave_of(p, 0, n, p[P.BALLS] * c[C.OVERSIZE_SCALE])
    for order in range(-reach, reach + 1):
        mu = a - n - order
        if abs(mu) > harmonics:
            continue
        by = place_by(lv, x, LN.BY_HEIGHT, order)
        sums = added_places((0.0, 0.0, 0.0, 0.0, 0.0, 0.0), by, re, im)
        add_found(p, lv, ps, ws, mu, a * orbit - n * speed, speed, sums)


@kernel
def drive_by_orbit(p, c, lv, x, ps, ws, a, reach, speed):
    """Do the same for what turns with the balls alone: outer race, unequal loads and sizes; ``a`` > 0."""
    orbit = lv[L.RATIO] * speed
    balls = int(p[P.BALLS])
    scale = c[C.OVERSIZE_SCALE]
    harmonics = int(ps[SD.H_HARMONICS])
    highest = orders(p)
    dr, di = size_sums(p, a, scale)
    for mu in range(-harmonics, harmonics + 1):
        order = a - mu
        sums = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        if a % balls == 0:
            if abs(order) <= LN.REACH:
                sums = added_places(sums, rest_of_orbit(lv, x, order), 2.0 * balls, 0.0)
            for n in range(max(order - reach, 1), min(order + reach, highest) + 1):
                re, im = wave_of(p, 1, n, balls * scale)
                sums = added_places(sums, place_by(lv, x, LN.BY_HEIGHT + 1, order - n), re, im)
        if abs(order) <= reach:
            for race in range(2):
                sums = added_places(sums, place_by(lv, x, LN.BY_HEIGHT + race, order), dr, di)
        add_found(p, lv, ps, ws, mu, a * orbit, speed, sums)


@kernel
def rest_of_orbit(lv, x, order):
    """Order of the balls' places as their loads leave them; the real part counts both its signs."""
    at = LN.REST + FOUR * abs(order)
    sign = 1.0 if order >= 0 else -1.0
    xr, xi, rr, ri = x[at], sign * x[at + 1], x[at + 2], sign * x[at + FOUR - 1]
    across_re = lv[L.SIDE] * xr + lv[L.SIDE + 1] * rr
    return xr, xi, rr, ri, across_re, lv[L.SIDE] * xi + lv[L.SIDE + 1] * ri


@kernel
def drive_by_form(p, c, lv, x, ps, ws, m, a, reach, speed):
    """Do the same for order ``m`` of the balls' form at ``a`` times ball 0's angle."""
    orbit = lv[L.RATIO] * speed
    rate = m * lv[L.ROLL] * speed
    harmonics = int(ps[SD.H_HARMONICS])
    for order in range(-reach, reach + 1):
        mu = a - order
        if abs(mu) > harmonics:
            continue
        sums = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for form in range(LN.FORMS):
            re, im = form_sums(p, x, form, m, a, 2.0 * c[C.OVERSIZE_SCALE])
            kind = LN.BY_HEIGHT + form if form < 2 else LN.BY_LEAN + form - 2
            sums = added_places(sums, place_by(lv, x, kind, order), re, im)
        add_found(p, lv, ps, ws, mu, a * orbit + rate, speed, sums)
