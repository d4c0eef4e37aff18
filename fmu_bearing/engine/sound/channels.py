"""Channels of the sound filters, in two halves: what a motion sample gives, and what the balls make of it.

The first half takes from a motion sample the numbers that are decimated, its raw row; the second forms the
channels at the lower rate. A ball's sound orbits with it: its signal times cosine and sine of multiples of
its angle, summed over the balls, is what fixed filters need. The cosines belong to the sample in the
decimator's middle. That the product comes behind the decimator and not before changes nothing but the
decimator's response, taken at the frequency before the product: it is flat to 1e-4 up to 22 kHz, which
leaves 2 kHz of shift, and what folds below is down by 84 dB.

`acoustics.registry` gives the form of each radiation model, `choices.CHANNEL_FORMS` the forms.
"""

import math

from fmu_bearing.engine.choices import CONTACTS, SCALARS, SENSORS
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, load, splat, sum_lanes
from fmu_bearing.engine.layout import FOUR, MO, SD, STRIDE

_FLOOR2 = SD.SPEED_FLOOR**2
_RATE = MO.ACCELERATION - MO.VELOCITY  # from a velocity of a body to its rate; the same for its spin
_TURNING = MO.SPIN - MO.VELOCITY  # from a velocity of a body to its angular velocity
_BALL_RATE = MO.BALL_ACCELERATION - MO.BALL_VELOCITY  # the same for the balls' rows
_BALL_TURNING = MO.BALL_SPIN - MO.BALL_VELOCITY


@kernel
def keep(ps, motion, row):
    """Fill a raw row from a motion sample."""
    chosen = int(ps[SD.H_FORM])
    if chosen == SCALARS:
        _keep_scalars(ps, motion, row)
    elif chosen == CONTACTS:
        _keep_contacts(ps, motion, row)
    elif chosen == SENSORS:
        _keep_outer_ring(ps, motion, row)
    else:
        _keep_accelerations(ps, motion, row)


@kernel
def form(ps, ws, x, turns, out):
    """Form the channels ``out`` from a decimated raw row ``x`` and the balls' cosines and sines ``turns``.

    For their order see `layout.sound_filters.formed`.
    """
    chosen = int(ps[SD.H_FORM])
    if chosen == SCALARS:
        for c in range(len(out)):
            out[c] = x[c]
    elif chosen == CONTACTS:
        _form_contacts(ps, x, turns, ws[int(ps[SD.H_W_SCRATCH]) :], out)
    elif chosen == SENSORS:
        _weigh_outer_ring(ps, x, out)
    else:
        _form_accelerations(ps, x, turns, ws[int(ps[SD.H_W_SCRATCH]) :], out)


@kernel
def _multiples(turns, lanes, orders, table):
    """Cosines, then sines of the multiples 1 .. ``orders`` of every ball's angle, ball after ball.

    Four balls at a time.
    """
    size = 2 * orders
    for j in range(0, lanes, FOUR):
        first_cosine, first_sine = load(turns, j), load(turns, lanes + j)
        c, s = splat(1.0), splat(0.0)
        at = size * j
        for m in range(orders):
            turned = c * first_cosine - s * first_sine
            s = c * first_sine + s * first_cosine
            c = turned
            for k in range(FOUR):
                table[at + size * k + m] = lane(c, k)
                table[at + size * k + orders + m] = lane(s, k)


@kernel
def _project(x, rows, lanes, turns, orders, sums, table):
    """Sum each row of ``x`` over the balls times cosines, then times sines of ``orders`` multiples.

    ``sums`` takes row after row, ``table`` the multiples. Four balls at a time.
    """
    size = 2 * orders
    _multiples(turns, lanes, orders, table)
    for i in range(rows * size):
        sums[i] = 0.0
    for j in range(0, lanes, FOUR):
        k = j + 2
        t0 = table[size * j : size * (j + 1)]
        t1 = table[size * (j + 1) : size * k]
        t2 = table[size * k : size * (k + 1)]
        t3 = table[size * (k + 1) : size * (k + 2)]
        for row in range(rows):
            first = lanes * row + j
            x0 = x[first]
            x1 = x[first + 1]
            x2 = x[first + 2]
            x3 = x[lanes * row + k + 1]
            out = sums[size * row : size * (row + 1)]
            for i in range(size):
                out[i] += (x0 * t0[i] + x1 * t1[i]) + (x2 * t2[i] + x3 * t3[i])


@kernel
def _keep_accelerations(ps, motion, row):
    """Form vectors: accelerations of bodies, balls and flexural coordinates."""
    for body in range(SD.BODIES):
        b = MO.PER_BODY * body
        for k in range(SD.AXES):
            row[SD.C_INNER + SD.AXES * body + k] = motion[b + MO.ACCELERATION + k]
        row[SD.C_TILTS + SD.TILTS * body] = motion[b + MO.SPIN_RATE + 1]
        row[SD.C_TILTS + SD.TILTS * body + 1] = motion[b + MO.SPIN_RATE + 2]
    lanes = int(ps[SD.H_BALL_LANES])
    to = SD.C_BALLS
    for k in range(SD.AXES):
        a = MO.BALL_ACCELERATION + STRIDE * k
        x = motion[a : a + lanes]
        y = row[to : to + lanes]
        for j in range(lanes):
            y[j] = x[j]
        to += lanes
    for i in range(int(ps[SD.H_FLEXURES])):
        row[to + i] = motion[MO.FLEXURES + i]


@kernel
def _form_accelerations(ps, x, turns, table, out):
    """Form vectors: the balls' accelerations as circumferential harmonics, the rest as it is.

    For their order see `layout.sound_filters.formed`.
    """
    lanes = int(ps[SD.H_BALL_LANES])
    orders = int(ps[SD.H_HARMONICS])
    for c in range(SD.C_BALLS):
        out[c] = x[c]
    balls = x[SD.C_BALLS : SD.C_BALLS + SD.AXES * lanes]
    out[SD.C_BALLS + SD.MEAN_X] = sum_lanes(balls, 0, lanes)
    out[SD.C_BALLS + SD.MEAN_R] = sum_lanes(balls, lanes, lanes)
    harmonics = SD.HARMONIC_SIZE * orders
    _project(balls, SD.AXES, lanes, turns, orders, out[SD.C_HARMONICS : SD.C_HARMONICS + harmonics], table)
    first = SD.C_BALLS + SD.AXES * lanes
    for i in range(int(ps[SD.H_FLEXURES])):
        out[SD.C_HARMONICS + harmonics + i] = x[first + i]


@kernel
def _keep_outer_ring(ps, motion, row):
    """Form sensors: accelerations of the outer ring as a body, and of all flexural coordinates."""
    for k in range(SD.AXES):
        row[SD.R_ACCELERATION + k] = motion[MO.OUTER + MO.ACCELERATION + k]
        row[SD.R_SPIN_RATE + k] = motion[MO.OUTER + MO.SPIN_RATE + k]
    for i in range(int(ps[SD.H_FLEXURES])):
        row[SD.R_FLEXURES + i] = motion[MO.FLEXURES + i]


@kernel
def _weigh_outer_ring(ps, x, out):
    """Form sensors: each channel is the sum of a row's numbers times weights, a row of these per channel."""
    wide = SD.R_FLEXURES + int(ps[SD.H_FLEXURES])
    at = int(ps[SD.H_AT_SCALARS])
    for c in range(len(out)):
        total = 0.0
        for i in range(wide):
            total += ps[at + i] * x[i]
        out[c] = total
        at += wide


@kernel
def _keep_scalars(ps, motion, row):
    """Form scalars: time derivatives of the multi-source paper's eqs. 16, 19, 28 and 41."""
    at = int(ps[SD.H_AT_SCALARS])
    for body in range(SD.BODIES):
        v = MO.PER_BODY * body
        a = v + _RATE
        w = v + _TURNING
        g = w + _RATE
        spin = 4.0 * motion[w] ** 2 + motion[w + 1] ** 2 + motion[w + 2] ** 2
        rate = 4.0 * motion[w] * motion[g] + motion[w + 1] * motion[g + 1] + motion[w + 2] * motion[g + 2]
        row[SD.C_POINTS + body] = ps[at + SD.SCALAR_BODY + body] * rate / math.sqrt(spin + _FLOOR2)
        row[SD.C_PISTONS + body] = motion[a]
        across = motion[v + 1] ** 2 + motion[v + 2] ** 2
        power = motion[v + 1] * motion[a + 1] + motion[v + 2] * motion[a + 2]
        row[SD.C_CYLINDERS + body] = power / math.sqrt(across + _FLOOR2)
    for part in range(SD.PAPER_BALL):
        first = MO.BALL_VELOCITY + _BALL_TURNING * part
        v = motion[first : first + SD.AXES * STRIDE]
        a = motion[first + _BALL_RATE : first + _BALL_RATE + SD.AXES * STRIDE]
        scale = 1.0 if part == 0 else ps[at + SD.SCALAR_BALL]
        for j in range(int(ps[SD.H_BALLS])):
            r = STRIDE + j
            th = r + STRIDE
            square = v[j] ** 2 + v[r] ** 2 + v[th] ** 2
            power = v[j] * a[j] + v[r] * a[r] + v[th] * a[th]
            row[SD.C_PAPER_BALLS + SD.PAPER_BALL * j + part] = scale * power / math.sqrt(square + _FLOOR2)


@kernel
def _keep_contacts(ps, motion, row):
    """Form contacts: rates of normal velocities at the contacts, and these times the orbit's speed.

    The sources orbit with the balls. Their strength is the normal velocity of the body there, so its rate
    holds the change of the normal along the orbit as well: for a ring, a.n + omega v.dn/dtheta.
    """
    scalar = int(ps[SD.H_AT_SCALARS])
    sine = ps[scalar + SD.SCALAR_SINE]
    cosine = ps[scalar + SD.SCALAR_COSINE]
    slowness = 1.0 / ps[scalar + SD.SCALAR_ORBIT]
    lanes = int(ps[SD.H_BALL_LANES])
    rows = SD.FAMILY_ROWS * lanes
    for family in range(SD.FAMILIES):
        rates = row[rows * family + SD.FAMILY_RATE * lanes : rows * family + (SD.FAMILY_RATE + 1) * lanes]
        turns = row[rows * family + SD.FAMILY_TURN * lanes : rows * family + (SD.FAMILY_TURN + 1) * lanes]
        v = MO.PER_BODY * family
        a = v + _RATE
        for j in range(int(ps[SD.H_BALLS])):
            c = motion[MO.COS + j]
            s = motion[MO.SIN + j]
            omega = slowness * motion[MO.BALL_VELOCITY + 2 * STRIDE + j]
            if family == SD.FAMILY_BALLS:
                r = STRIDE + j
                value = sine * motion[MO.BALL_VELOCITY + j] + cosine * motion[MO.BALL_VELOCITY + r]
                rate = sine * motion[MO.BALL_ACCELERATION + j] + cosine * (
                    motion[MO.BALL_ACCELERATION + r] + omega * motion[MO.BALL_VELOCITY + r + STRIDE]
                )
            elif family == SD.FAMILY_CAGE:
                value = -c * motion[v + 1] - s * motion[v + 2]
                rate = (
                    -c * motion[a + 1] - s * motion[a + 2] + omega * (s * motion[v + 1] - c * motion[v + 2])
                )
            else:
                value = sine * motion[v] + cosine * (c * motion[v + 2] - s * motion[v + 1])
                rate = sine * motion[a] + cosine * (
                    c * motion[a + 2] - s * motion[a + 1] - omega * (c * motion[v + 1] + s * motion[v + 2])
                )
            rates[j] = rate
            turns[j] = omega * value
        for j in range(int(ps[SD.H_BALLS]), lanes):
            rates[j] = 0.0
            turns[j] = 0.0


@kernel
def _form_contacts(ps, x, turns, table, out):
    """Form contacts: rates of normal velocities times cosine and sine, by harmonics.

    The rate of v_n cos(m theta), not v_n' cos(m theta), is what a fixed filter needs, because the place
    moves too.
    """
    lanes = int(ps[SD.H_BALL_LANES])
    orders = int(ps[SD.H_HARMONICS])
    size = 2 * orders
    rows = SD.FAMILIES * SD.FAMILY_ROWS
    sums = table[size * lanes : size * (lanes + rows)]
    _project(x, rows, lanes, turns, orders, sums, table)
    for family in range(SD.FAMILIES):
        rate = SD.FAMILY_ROWS * family + SD.FAMILY_RATE
        turn = SD.FAMILY_ROWS * family + SD.FAMILY_TURN
        q = (size + 1) * family
        out[q] = sum_lanes(x, lanes * rate, lanes)
        for m in range(orders):
            out[q + 1 + 2 * m] = sums[size * rate + m] - (m + 1.0) * sums[size * turn + orders + m]
            out[q + 2 + 2 * m] = sums[size * rate + orders + m] + (m + 1.0) * sums[size * turn + m]
