"""Channels of the sound filters, formed from one motion sample: one kernel per form.

Which radiation model takes which form stands in `acoustics.registry`, the forms in `choices.CHANNEL_FORMS`.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import MO, SD, STRIDE

_FLOOR2 = SD.SPEED_FLOOR**2
_RATE = MO.ACCELERATION - MO.VELOCITY  # from a velocity of a body to its rate; the same for its spin
_TURNING = MO.SPIN - MO.VELOCITY  # from a velocity of a body to its angular velocity


@kernel
def accelerations(ps, ws, motion, fresh):
    """Form vectors: accelerations, the balls' as circumferential harmonics."""
    orders = int(ps[SD.H_HARMONICS])
    balls = int(ps[SD.H_BALLS])
    for body in range(SD.BODIES):
        b = MO.PER_BODY * body
        for k in range(SD.AXES):
            fresh[SD.C_INNER + SD.AXES * body + k] = motion[b + MO.ACCELERATION + k]
        fresh[SD.C_TILTS + SD.TILTS * body] = motion[b + MO.SPIN_RATE + 1]
        fresh[SD.C_TILTS + SD.TILTS * body + 1] = motion[b + MO.SPIN_RATE + 2]
    at = int(ps[SD.H_W_TRANSFORM])
    turns = ws[at : at + 2 * STRIDE]  # cosine and sine of the present multiple of every ball's angle
    x = 0.0
    r = 0.0
    for j in range(balls):
        b = MO.BALLS + MO.PER_BALL * j
        x += motion[b + MO.ACCELERATION]
        r += motion[b + MO.ACCELERATION + 1]
        turns[j] = motion[b + MO.COS]
        turns[STRIDE + j] = motion[b + MO.SIN]
    fresh[SD.C_BALLS + SD.MEAN_X] = x
    fresh[SD.C_BALLS + SD.MEAN_R] = r
    for m in range(orders):
        q = SD.C_HARMONICS + SD.HARMONIC_SIZE * m
        _harmonic(motion, turns, balls, fresh[q : q + SD.HARMONIC_SIZE])
    flex = MO.BALLS + MO.PER_BALL * balls
    q = SD.C_HARMONICS + SD.HARMONIC_SIZE * orders
    for i in range(int(ps[SD.H_FLEXURES])):
        fresh[q + i] = motion[flex + i]


@kernel
def _harmonic(motion, turns, balls, harmonic):
    """One harmonic of the balls' accelerations; then ``turns`` moves on to the next."""
    xc = 0.0
    xs = 0.0
    rc = 0.0
    rs = 0.0
    tc = 0.0
    ts = 0.0
    for j in range(balls):
        b = MO.BALLS + MO.PER_BALL * j
        a = b + MO.ACCELERATION
        c = turns[j]
        s = turns[STRIDE + j]
        xc += motion[a] * c
        xs += motion[a] * s
        rc += motion[a + 1] * c
        rs += motion[a + 1] * s
        tc += motion[a + 2] * c
        ts += motion[a + 2] * s
        turns[j] = c * motion[b + MO.COS] - s * motion[b + MO.SIN]
        turns[STRIDE + j] = c * motion[b + MO.SIN] + s * motion[b + MO.COS]
    harmonic[SD.HARMONIC_X_COS] = xc
    harmonic[SD.HARMONIC_X_SIN] = xs
    harmonic[SD.HARMONIC_R_COS] = rc
    harmonic[SD.HARMONIC_R_SIN] = rs
    harmonic[SD.HARMONIC_T_COS] = tc
    harmonic[SD.HARMONIC_T_SIN] = ts


@kernel
def scalars(ps, motion, fresh):
    """Form scalars: time derivatives of the multi-source paper's eqs. 16, 19, 28 and 41."""
    at = int(ps[SD.H_AT_SCALARS])
    for body in range(SD.BODIES):
        v = MO.PER_BODY * body
        a = v + _RATE
        w = v + _TURNING
        g = w + _RATE
        spin = 4.0 * motion[w] ** 2 + motion[w + 1] ** 2 + motion[w + 2] ** 2
        rate = 4.0 * motion[w] * motion[g] + motion[w + 1] * motion[g + 1] + motion[w + 2] * motion[g + 2]
        fresh[SD.C_POINTS + body] = ps[at + SD.SCALAR_BODY + body] * rate / math.sqrt(spin + _FLOOR2)
        fresh[SD.C_PISTONS + body] = motion[a]
        across = motion[v + 1] ** 2 + motion[v + 2] ** 2
        power = motion[v + 1] * motion[a + 1] + motion[v + 2] * motion[a + 2]
        fresh[SD.C_CYLINDERS + body] = power / math.sqrt(across + _FLOOR2)
    for j in range(int(ps[SD.H_BALLS])):
        b = MO.BALLS + MO.PER_BALL * j
        for part in range(SD.PAPER_BALL):
            v = b + _TURNING * part
            a = v + _RATE
            square = motion[v] ** 2 + motion[v + 1] ** 2 + motion[v + 2] ** 2
            power = motion[v] * motion[a] + motion[v + 1] * motion[a + 1] + motion[v + 2] * motion[a + 2]
            scale = 1.0 if part == 0 else ps[at + SD.SCALAR_BALL]
            q = SD.C_PAPER_BALLS + SD.PAPER_BALL * j + part
            fresh[q] = scale * power / math.sqrt(square + _FLOOR2)


@kernel
def contacts(ps, motion, fresh):
    """Form contacts: rates of normal velocities at the contacts, by harmonics.

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
        c = motion[b + MO.COS]
        s = motion[b + MO.SIN]
        omega = motion[b + 2] / pitch
        for family in range(SD.FAMILIES):
            v = b if family == SD.FAMILY_BALLS else MO.PER_BODY * family
            a = v + _RATE
            if family == SD.FAMILY_BALLS:
                value = sine * motion[v] + cosine * motion[v + 1]
                rate = sine * motion[a] + cosine * (motion[a + 1] + omega * motion[v + 2])
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
