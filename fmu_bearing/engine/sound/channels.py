"""Channels of the sound filters, formed from one motion sample: one kernel per rung that needs its own."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import MO_BALLS, MO_CAGE, MO_PER_BALL
from fmu_bearing.engine.sound.places import (
    C_BALLS,
    C_CYLINDERS,
    C_PAPER_BALLS,
    C_PISTONS,
    C_POINTS,
    C_TILTS,
    H_AT_SCALARS,
    H_BALLS,
    H_FLEXURES,
    H_HARMONICS,
    H_W_TRANSFORM,
    MAX_HARMONICS,
    SCALAR_BALL,
    SCALAR_COSINE,
    SCALAR_ORBIT,
    SCALAR_SINE,
    SPEED_FLOOR,
)

_FLOOR2 = SPEED_FLOOR**2
_ROW = MAX_HARMONICS


@kernel
def _turns(c1, s1, table, orders):
    """Cosines and sines of the multiples of an angle, 8 or 16 of them: rows 0 and 1 of the ``table``.

    By doubling: each half turned by its last multiple makes the next, which is short and vectorised.
    """
    table[0] = c1
    table[_ROW] = s1
    table[1] = c1 * c1 - s1 * s1
    table[_ROW + 1] = 2.0 * c1 * s1
    c = table[1]
    s = table[_ROW + 1]
    for m in range(2):
        table[2 + m] = table[m] * c - table[_ROW + m] * s
        table[_ROW + 2 + m] = table[m] * s + table[_ROW + m] * c
    c = table[3]
    s = table[_ROW + 3]
    for m in range(4):
        table[4 + m] = table[m] * c - table[_ROW + m] * s
        table[_ROW + 4 + m] = table[m] * s + table[_ROW + m] * c
    if orders > 8:
        c = table[7]
        s = table[_ROW + 7]
        for m in range(8):
            table[8 + m] = table[m] * c - table[_ROW + m] * s
            table[_ROW + 8 + m] = table[m] * s + table[_ROW + m] * c


@kernel
def accelerations(ps, ws, motion, fresh):
    """Channels of the vector rungs: accelerations, the balls' as circumferential harmonics."""
    orders = int(ps[H_HARMONICS])
    balls = int(ps[H_BALLS])
    for body in range(3):
        for k in range(3):
            fresh[3 * body + k] = motion[12 * body + 3 + k]
        fresh[C_TILTS + 2 * body] = motion[12 * body + 10]
        fresh[C_TILTS + 2 * body + 1] = motion[12 * body + 11]
    at = int(ps[H_W_TRANSFORM])
    table = ws[at : at + 8 * _ROW]  # one slice and constant rows: only so is the loop a vector loop
    for i in range(2 * _ROW, 8 * _ROW):
        table[i] = 0.0
    lanes = 8 if orders <= 8 else _ROW  # whole vectors; what is beyond the orders is not used
    x = 0.0
    r = 0.0
    for j in range(balls):
        b = MO_BALLS + MO_PER_BALL * j
        ax = motion[b + 3]
        ar = motion[b + 4]
        along = motion[b + 5]
        x += ax
        r += ar
        _turns(motion[b + 12], motion[b + 13], table, orders)
        for i in range(lanes):
            c = table[i]
            s = table[_ROW + i]
            table[2 * _ROW + i] += ax * c
            table[3 * _ROW + i] += ax * s
            table[4 * _ROW + i] += ar * c
            table[5 * _ROW + i] += ar * s
            table[6 * _ROW + i] += along * c
            table[7 * _ROW + i] += along * s
    fresh[C_BALLS] = x
    fresh[C_BALLS + 1] = r
    for i in range(orders):
        for k in range(6):
            fresh[C_BALLS + 2 + 6 * i + k] = table[(2 + k) * _ROW + i]
    flex = MO_BALLS + MO_PER_BALL * balls
    q = C_BALLS + 2 + 6 * orders
    for i in range(int(ps[H_FLEXURES])):
        fresh[q + i] = motion[flex + i]


@kernel
def scalars(ps, motion, fresh):
    """Channels of the paper rung: time derivatives of its eqs. 16, 19, 28 and 41."""
    at = int(ps[H_AT_SCALARS]) + SCALAR_BALL
    for body in range(3):
        b = 12 * body
        spin = 4.0 * motion[b + 6] ** 2 + motion[b + 7] ** 2 + motion[b + 8] ** 2
        rate = (
            4.0 * motion[b + 6] * motion[b + 9]
            + motion[b + 7] * motion[b + 10]
            + motion[b + 8] * motion[b + 11]
        )
        fresh[C_POINTS + body] = ps[at + 1 + body] * rate / math.sqrt(spin + _FLOOR2)
        fresh[C_PISTONS + body] = motion[b + 3]
        across = motion[b + 1] ** 2 + motion[b + 2] ** 2
        power = motion[b + 1] * motion[b + 4] + motion[b + 2] * motion[b + 5]
        fresh[C_CYLINDERS + body] = power / math.sqrt(across + _FLOOR2)
    for j in range(int(ps[H_BALLS])):
        b = MO_BALLS + MO_PER_BALL * j
        for part in range(2):
            v = b + 6 * part
            square = motion[v] ** 2 + motion[v + 1] ** 2 + motion[v + 2] ** 2
            power = motion[v] * motion[v + 3] + motion[v + 1] * motion[v + 4] + motion[v + 2] * motion[v + 5]
            scale = 1.0 if part == 0 else ps[at]
            fresh[C_PAPER_BALLS + 2 * j + part] = scale * power / math.sqrt(square + _FLOOR2)


@kernel
def contacts(ps, ws, motion, fresh):
    """Channels of the rung paper_contacts: rates of normal velocities at the contacts, by harmonics.

    The sources orbit with the balls. Their strength is the normal velocity of the body there, so its rate
    holds the change of the normal along the orbit as well: for a ring, a.n + omega v.dn/dtheta. The rate of
    v_n cos(m theta), not v_n' cos(m theta), is what a fixed filter needs, because the place moves too.
    """
    orders = int(ps[H_HARMONICS])
    scalar = int(ps[H_AT_SCALARS])
    sine = ps[scalar + SCALAR_SINE]
    cosine = ps[scalar + SCALAR_COSINE]
    pitch = ps[scalar + SCALAR_ORBIT]
    wide = 1 + 2 * orders
    at = int(ps[H_W_TRANSFORM])
    table = ws[at : at + 2 * _ROW]
    for i in range(len(fresh)):
        fresh[i] = 0.0
    for j in range(int(ps[H_BALLS])):
        b = MO_BALLS + MO_PER_BALL * j
        c = motion[b + 12]
        s = motion[b + 13]
        omega = motion[b + 2] / pitch
        _turns(c, s, table, orders)
        for family in range(4):
            if family < 2:
                o = 12 * family
                value = sine * motion[o] + cosine * (c * motion[o + 2] - s * motion[o + 1])
                rate = sine * motion[o + 3] + cosine * (
                    c * motion[o + 5] - s * motion[o + 4] - omega * (c * motion[o + 1] + s * motion[o + 2])
                )
            elif family == 2:
                o = MO_CAGE
                value = -c * motion[o + 1] - s * motion[o + 2]
                rate = (
                    -c * motion[o + 4] - s * motion[o + 5] + omega * (s * motion[o + 1] - c * motion[o + 2])
                )
            else:
                value = sine * motion[b] + cosine * motion[b + 1]
                rate = sine * motion[b + 3] + cosine * (motion[b + 4] + omega * motion[b + 2])
            q = family * wide
            fresh[q] += rate
            for m in range(orders):
                turn = (m + 1.0) * omega * value
                fresh[q + 1 + 2 * m] += rate * table[m] - turn * table[_ROW + m]
                fresh[q + 2 + 2 * m] += rate * table[_ROW + m] + turn * table[m]
