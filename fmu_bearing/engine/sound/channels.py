"""Channels of the sound filters, formed from one motion sample: one kernel per rung that needs its own."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import MO, SD
from fmu_bearing.engine.layout.sizes import STRIDE

_FLOOR2 = SD.SPEED_FLOOR**2


@kernel
def accelerations(ps, ws, motion, fresh):
    """Channels of the vector rungs: accelerations, the balls' as circumferential harmonics."""
    orders = int(ps[SD.H_HARMONICS])
    balls = int(ps[SD.H_BALLS])
    for body in range(3):
        for k in range(3):
            fresh[3 * body + k] = motion[12 * body + 3 + k]
        fresh[SD.C_TILTS + 2 * body] = motion[12 * body + 10]
        fresh[SD.C_TILTS + 2 * body + 1] = motion[12 * body + 11]
    at = int(ps[SD.H_W_TRANSFORM])
    turns = ws[at : at + 2 * STRIDE]  # cosine and sine of the present multiple of every ball's angle
    x = 0.0
    r = 0.0
    for j in range(balls):
        b = MO.BALLS + MO.PER_BALL * j
        x += motion[b + 3]
        r += motion[b + 4]
        turns[j] = motion[b + 12]
        turns[STRIDE + j] = motion[b + 13]
    fresh[SD.C_BALLS] = x
    fresh[SD.C_BALLS + 1] = r
    for m in range(orders):
        xc = 0.0
        xs = 0.0
        rc = 0.0
        rs = 0.0
        tc = 0.0
        ts = 0.0
        for j in range(balls):
            b = MO.BALLS + MO.PER_BALL * j
            c = turns[j]
            s = turns[STRIDE + j]
            xc += motion[b + 3] * c
            xs += motion[b + 3] * s
            rc += motion[b + 4] * c
            rs += motion[b + 4] * s
            tc += motion[b + 5] * c
            ts += motion[b + 5] * s
            turns[j] = c * motion[b + 12] - s * motion[b + 13]
            turns[STRIDE + j] = c * motion[b + 13] + s * motion[b + 12]
        q = SD.C_BALLS + 2 + 6 * m
        fresh[q] = xc
        fresh[q + 1] = xs
        fresh[q + 2] = rc
        fresh[q + 3] = rs
        fresh[q + 4] = tc
        fresh[q + 5] = ts
    flex = MO.BALLS + MO.PER_BALL * balls
    q = SD.C_BALLS + 2 + 6 * orders
    for i in range(int(ps[SD.H_FLEXURES])):
        fresh[q + i] = motion[flex + i]


@kernel
def scalars(ps, motion, fresh):
    """Channels of the paper rung: time derivatives of its eqs. 16, 19, 28 and 41."""
    at = int(ps[SD.H_AT_SCALARS]) + SD.SCALAR_BALL
    for body in range(3):
        b = 12 * body
        spin = 4.0 * motion[b + 6] ** 2 + motion[b + 7] ** 2 + motion[b + 8] ** 2
        rate = (
            4.0 * motion[b + 6] * motion[b + 9]
            + motion[b + 7] * motion[b + 10]
            + motion[b + 8] * motion[b + 11]
        )
        fresh[SD.C_POINTS + body] = ps[at + 1 + body] * rate / math.sqrt(spin + _FLOOR2)
        fresh[SD.C_PISTONS + body] = motion[b + 3]
        across = motion[b + 1] ** 2 + motion[b + 2] ** 2
        power = motion[b + 1] * motion[b + 4] + motion[b + 2] * motion[b + 5]
        fresh[SD.C_CYLINDERS + body] = power / math.sqrt(across + _FLOOR2)
    for j in range(int(ps[SD.H_BALLS])):
        b = MO.BALLS + MO.PER_BALL * j
        for part in range(2):
            v = b + 6 * part
            square = motion[v] ** 2 + motion[v + 1] ** 2 + motion[v + 2] ** 2
            power = motion[v] * motion[v + 3] + motion[v + 1] * motion[v + 4] + motion[v + 2] * motion[v + 5]
            scale = 1.0 if part == 0 else ps[at]
            fresh[SD.C_PAPER_BALLS + 2 * j + part] = scale * power / math.sqrt(square + _FLOOR2)


@kernel
def contacts(ps, motion, fresh):
    """Channels of the rung paper_contacts: rates of normal velocities at the contacts, by harmonics.

    The sources orbit with the balls. Their strength is the normal velocity of the body there, so its rate
    holds the change of the normal along the orbit as well: for a ring, a.n + omega v.dn/dtheta. The rate of
    v_n cos(m theta), not v_n' cos(m theta), is what a fixed filter needs, because the place moves too.
    """
    orders = int(ps[SD.H_HARMONICS])
    scalar = int(ps[SD.H_AT_SCALARS])
    sine = ps[scalar + SD.SCALAR_SINE]
    cosine = ps[scalar + SD.SCALAR_COSINE]
    pitch = ps[scalar + SD.SCALAR_ORBIT]
    wide = 1 + 2 * orders
    for i in range(len(fresh)):
        fresh[i] = 0.0
    for j in range(int(ps[SD.H_BALLS])):
        b = MO.BALLS + MO.PER_BALL * j
        c = motion[b + 12]
        s = motion[b + 13]
        omega = motion[b + 2] / pitch
        for family in range(4):
            if family < 2:
                o = 12 * family
                value = sine * motion[o] + cosine * (c * motion[o + 2] - s * motion[o + 1])
                rate = sine * motion[o + 3] + cosine * (
                    c * motion[o + 5] - s * motion[o + 4] - omega * (c * motion[o + 1] + s * motion[o + 2])
                )
            elif family == 2:
                o = MO.CAGE
                value = -c * motion[o + 1] - s * motion[o + 2]
                rate = (
                    -c * motion[o + 4] - s * motion[o + 5] + omega * (s * motion[o + 1] - c * motion[o + 2])
                )
            else:
                value = sine * motion[b] + cosine * motion[b + 1]
                rate = sine * motion[b + 3] + cosine * (motion[b + 4] + omega * motion[b + 2])
            q = family * wide
            fresh[q] += rate
            cm = 1.0
            sm = 0.0
            for m in range(orders):
                turned = cm * c - sm * s
                sm = cm * s + sm * c
                cm = turned
                turn = (m + 1.0) * omega * value
                fresh[q + 1 + 2 * m] += rate * cm - turn * sm
                fresh[q + 2 + 2 * m] += rate * sm + turn * cm
