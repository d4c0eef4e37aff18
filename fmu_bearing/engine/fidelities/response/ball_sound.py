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
from fmu_bearing.engine.complex_numbers import pair
from fmu_bearing.engine.fidelities.condensed.transverse import pattern_receptance
from fmu_bearing.engine.fidelities.response.lines import form_sums, orders, size_sums, wave_of
from fmu_bearing.engine.fidelities.response.samples import largest_of, order_of, place_of, signed
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR, LN, SD, C, L, P, Q
from fmu_bearing.engine.mechanics.triples import added, scaled
from fmu_bearing.engine.sound.transfer import add_channel

_SMALL = 2e-3  # of the largest order of a place: left out, 0.02 dB


@kernel
def reach_of_rings(x):
    """Highest order of the balls' places by the rings' coordinates that is not small."""
    largest = 0.0
    highest = 0
    for order in range(LN.REACH + 1):
        amplitude = largest_of(x, LN.FOLLOW + order * L.N * FOUR, L.N * FOUR)
        largest = max(largest, amplitude)
        if amplitude > _SMALL * largest:
            highest = order
    return highest


@kernel
def reach_of_heights(x):
    """Highest order of the balls' places by the races' heights that is not small."""
    largest = 0.0
    highest = 0
    for order in range(LN.REACH + 1):
        amplitude = 0.0
        for race in range(2):
            places = place_of(LN.BY_HEIGHT + race, order) + 2 * LN.PLACES
            amplitude = max(amplitude, largest_of(x, places, LN.COMPLEX - 2 * LN.PLACES))
        largest = max(largest, amplitude)
        if amplitude > _SMALL * largest:
            highest = order
    return highest


@kernel
def add_ball_motion(p, lv, ps, ws, mu, omega, speed, place, rolled):
    """Add the accelerations of all balls to the channels of their harmonic ``mu``.

    ``place``: complex places x, r and across the track (m) that a ball would rest at, times the number of
    balls or summed over them; ``rolled``: velocity (m/s) that rolling gives across. ``omega``: of the line
    (rad/s), seen from outside.
    """
    orbit = lv[L.RATIO] * speed
    seen = omega - mu * orbit  # by a ball
    x, r, across = place
    if lv[L.SIDE_SQUARE] != 0.0:
        ahead = complex(1.0, seen * p[P.CONTACT_DAMPING])
        driven = lv[L.SIDE_SQUARE] * (ahead * across) + lv[L.SIDE_RATE] * rolled
        lag = pattern_receptance(lv, seen) * driven - across
        x += lv[L.SIDE] * lag
        r += lv[L.SIDE + 1] * lag
    if int(ps[SD.H_FORM]) == CONTACTS:
        at = int(ps[SD.H_AT_SCALARS])
        pressed = ps[at + SD.SCALAR_SINE] * x + ps[at + SD.SCALAR_COSINE] * r
        add_contacts(ps, ws, SD.FAMILY_BALLS, mu, omega, complex(0.0, seen) * pressed)
        return
    squared = seen * seen
    turned = squared + orbit * orbit  # its radius changes the centripetal acceleration,
    coriolis = 2.0 * seen * orbit  # and its velocity turns
    if mu == 0:
        add_channel(ps, ws, SD.C_BALLS + SD.MEAN_X, -squared * x)
        add_channel(ps, ws, SD.C_BALLS + SD.MEAN_R, -turned * r)
        return
    at = SD.C_HARMONICS + SD.HARMONIC_SIZE * (abs(mu) - 1)
    half = 0.5 if mu > 0 else -0.5
    add_harmonic(ps, ws, at + SD.HARMONIC_X_COS, half, -squared * x)
    add_harmonic(ps, ws, at + SD.HARMONIC_R_COS, half, -turned * r)
    add_harmonic(ps, ws, at + SD.HARMONIC_T_COS, half, complex(0.0, coriolis) * r)


@kernel
def add_contacts(ps, ws, family, mu, omega, velocity):
    """Add the rate of one family's harmonic ``mu`` (form contacts).

    ``velocity``: complex, along the normals (m/s) times exp(i mu theta), summed; ``omega`` (rad/s): of the
    line, seen from outside.
    """
    at = (1 + 2 * int(ps[SD.H_HARMONICS])) * family
    rate = complex(0.0, omega) * velocity
    if mu == 0:
        add_channel(ps, ws, at, rate)
    else:
        add_harmonic(ps, ws, at + 2 * abs(mu) - 1, 0.5 if mu > 0 else -0.5, rate)


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
            moved = complex(q[re + first], q[im + first])
            by = balls * ps[at + SD.SCALAR_SINE]
            if order != 0:
                # z cos - y sin of a ball's angle
                moved = complex(q[re + first + Q.Z], q[im + first + Q.Z])
                moved += complex(0.0, order) * complex(q[re + first + Q.Y], q[im + first + Q.Y])
                by = 0.5 * balls * ps[at + SD.SCALAR_COSINE]
            family = SD.FAMILY_OUTER if ring == 1 else SD.FAMILY_INNER
            add_contacts(ps, ws, family, mu, turned, complex(0.0, by * omega) * moved)


@kernel
def add_harmonic(ps, ws, channel, half, value):
    """Add half of a sum times exp(i mu theta) to its cosine's and, a quarter turn on, to its sine's channel.

    ``half``: negative for a negative order mu.
    """
    add_channel(ps, ws, channel, abs(half) * value)
    add_channel(ps, ws, channel + 1, complex(0.0, -half) * value)


@kernel
def with_across(lv, x, r):
    """Complex places x, r of a ball, then what they are across its track."""
    return x, r, lv[L.SIDE] * x + lv[L.SIDE + 1] * r


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
        along, out = 0j, 0j
        for i in range(L.N):
            at = LN.FOLLOW + (abs(order) * L.N + i) * FOUR
            moved = complex(q[re + i], q[im + i])
            along += signed(pair(x, at), order) * moved
            out += signed(pair(x, at + 2), order) * moved
        place = with_across(lv, balls * along, balls * out)
        rolled = rolled_by_rings(lv, order, balls, q, re, im, omega)
        add_ball_motion(p, lv, ps, ws, mu, turned, speed, place, rolled)


@kernel
def rolled_by_rings(lv, order, balls, q, re, im, omega):
    """Velocity (m/s) across the track that rolling gives all balls, of one order round the orbit: complex."""
    total = 0j
    for i in range(L.N if abs(order) <= 1 else 0):
        by = complex(lv[L.SIDE_ROLLING + i], 0.0)
        if order != 0:
            # cos and -sin of a ball's angle
            aside = 0.5 * order * lv[L.SIDE_ROLLING + 2 * L.COLUMN + i]
            by = complex(0.5 * lv[L.SIDE_ROLLING + L.COLUMN + i], aside)
        total += by * (complex(0.0, omega) * complex(q[re + i], q[im + i]))
    return balls * total


@kernel
def place_by(lv, x, kind, order):
    """How a ball's place of rest answers one kind of excitation through ``order``: complex x, r, across."""
    found = order_of(x, kind, abs(order))
    _, _, across = with_across(lv, signed(found[LN.AWAY], order), signed(found[LN.AWAY + 1], order))
    return signed(found[LN.PLACES], order), signed(found[LN.PLACES + 1], order), across


@kernel
def drive_by_inner(p, c, lv, x, ps, ws, n, a, reach, speed):
    """Fill the balls' channels of what wave ``n`` of the inner race does at ``a`` times ball 0's angle."""
    orbit = lv[L.RATIO] * speed
    harmonics = int(ps[SD.H_HARMONICS])
    height = wave_of(p, 0, n, p[P.BALLS] * c[C.OVERSIZE_SCALE])
    for order in range(-reach, reach + 1):
        mu = a - n - order
        if abs(mu) > harmonics:
            continue
        place = scaled(height, place_by(lv, x, LN.BY_HEIGHT, order))
        add_ball_motion(p, lv, ps, ws, mu, a * orbit - n * speed, speed, place, 0j)


@kernel
def drive_by_orbit(p, c, lv, x, ps, ws, a, reach, speed):
    """Do the same for what turns with the balls alone: outer race, unequal loads and sizes; ``a`` > 0."""
    orbit = lv[L.RATIO] * speed
    balls = int(p[P.BALLS])
    scale = c[C.OVERSIZE_SCALE]
    harmonics = int(ps[SD.H_HARMONICS])
    highest = orders(p)
    sizes = size_sums(p, a, scale)
    for mu in range(-harmonics, harmonics + 1):
        order = a - mu
        place = 0j, 0j, 0j
        if a % balls == 0:
            if abs(order) <= LN.REACH:
                place = scaled(2.0 * balls, rest_of_orbit(lv, x, order))
            for n in range(max(order - reach, 1), min(order + reach, highest) + 1):
                height = wave_of(p, 1, n, balls * scale)
                place = added(place, scaled(height, place_by(lv, x, LN.BY_HEIGHT + 1, order - n)))
        if abs(order) <= reach:
            for race in range(2):
                place = added(place, scaled(sizes, place_by(lv, x, LN.BY_HEIGHT + race, order)))
        add_ball_motion(p, lv, ps, ws, mu, a * orbit, speed, place, 0j)


@kernel
def rest_of_orbit(lv, x, order):
    """Order of the balls' places as their loads leave them; the real part counts both its signs."""
    at = LN.REST + FOUR * abs(order)
    return with_across(lv, signed(pair(x, at), order), signed(pair(x, at + 2), order))


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
        place = 0j, 0j, 0j
        for form in range(LN.FORMS):
            sums = form_sums(p, x, form, m, a, 2.0 * c[C.OVERSIZE_SCALE])
            kind = LN.BY_HEIGHT + form if form < 2 else LN.BY_LEAN + form - 2
            place = added(place, scaled(sums, place_by(lv, x, kind, order)))
        add_ball_motion(p, lv, ps, ws, mu, a * orbit + rate, speed, place, 0j)
