"""From one motion sample to the pressure at every microphone: channels, decimation, filters.

One call of `push` takes one sample of the motion at ``RAW_RATE``. Every fourth call a sample at ``RATE``
comes out of the decimator, passes the microphones' low-frequency limit, enters the history, runs through
all filter banks and moves the meters. State depends on the samples alone, never on how steps are cut.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import MO_BALLS, MO_PER_BALL
from fmu_bearing.engine.sound import meter
from fmu_bearing.engine.sound.places import (
    BANK_AT_TAPS,
    BANK_CHANNEL,
    BANK_COUNT,
    BANK_DELAY,
    BANK_OUTPUT,
    BANK_SIZE,
    BANK_TAPS,
    C_BALLS,
    C_CYLINDERS,
    C_PISTONS,
    C_POINTS,
    DECIMATION,
    DECIMATOR_TAPS,
    H_AT_BANKS,
    H_AT_DECIMATOR,
    H_AT_HIGH_PASS,
    H_AT_SCALARS,
    H_BALLS,
    H_BANKS,
    H_CHANNELS,
    H_HARMONICS,
    H_ROWS,
    H_RUNG,
    RUNG_PAPER,
    SPEED_FLOOR,
    SS_COUNT,
    SS_RAW,
    SS_TABLES,
    state_size,
    work_size,
)

__all__ = ["push", "reset", "state_size", "work_size"]

_WRAP = DECIMATOR_TAPS - 1  # the raw history is a power of two long
_FLOOR2 = SPEED_FLOOR**2


@kernel
def reset(ss):
    """Forget everything: the next `push` is the first."""
    for i in range(len(ss)):
        ss[i] = 0.0


@kernel
def push(ps, ss, ws, motion, time_weighting, metering_start):
    """Take one motion sample (layout ``MO_*``) and update filters and meters.

    ``time_weighting`` is the meters' time constant in s, ``metering_start`` the time in s from the first
    sample on at which they begin. The first sample is taken to have lasted for ever, so that constant
    accelerations (the balls' centripetal one) make no start-up step.
    """
    n = int(ps[H_CHANNELS])
    raw = int(ss[SS_RAW])
    history = SS_TABLES
    row = raw & _WRAP
    fresh = ss[history + row * n : history + (row + 1) * n]
    if int(ps[H_RUNG]) == RUNG_PAPER:
        _scalars(ps, motion, fresh)
    else:
        _accelerations(ps, motion, fresh)
    high_pass = history + DECIMATOR_TAPS * n
    if raw == 0:
        _settle(ps, ss, fresh, history, high_pass, n)
    ss[SS_RAW] = raw + 1.0
    if raw % DECIMATION != 0:
        return
    count = int(ss[SS_COUNT])
    rows = int(ps[H_ROWS])
    channels = high_pass + 2 * n
    place = count % rows
    _decimate(ps, ss, ws, history, row, n)
    _high_pass(ps, ss, ws, high_pass, channels + place * n, n)
    _filter(ps, ss, ws, channels, place, n)
    meter.update(ps, ss, ws, channels + rows * n, time_weighting, metering_start)
    ss[SS_COUNT] = count + 1.0


@kernel
def _accelerations(ps, motion, fresh):
    """Channels of the compact rung: accelerations, the balls' as circumferential harmonics."""
    harmonics = int(ps[H_HARMONICS])
    for body in range(3):
        for k in range(3):
            fresh[3 * body + k] = motion[12 * body + 3 + k]
    for c in range(C_BALLS, len(fresh)):
        fresh[c] = 0.0
    for j in range(int(ps[H_BALLS])):
        b = MO_BALLS + MO_PER_BALL * j
        ax = motion[b + 3]
        ar = motion[b + 4]
        at = motion[b + 5]
        c1 = motion[b + 12]
        s1 = motion[b + 13]
        fresh[C_BALLS] += ax
        fresh[C_BALLS + 1] += ar
        c = 1.0
        s = 0.0
        for m in range(harmonics):
            turned = c * c1 - s * s1
            s = c * s1 + s * c1
            c = turned
            q = C_BALLS + 2 + 6 * m
            fresh[q] += ax * c
            fresh[q + 1] += ax * s
            fresh[q + 2] += ar * c
            fresh[q + 3] += ar * s
            fresh[q + 4] += at * c
            fresh[q + 5] += at * s


@kernel
def _scalars(ps, motion, fresh):
    """Channels of the paper rung: time derivatives of its eqs. 16, 19, 28 and 41."""
    at = int(ps[H_AT_SCALARS])
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
            fresh[C_BALLS + 2 * j + part] = scale * power / math.sqrt(square + _FLOOR2)


@kernel
def _settle(ps, ss, fresh, history, high_pass, n):
    """Fill the raw history with the first sample and let the high-pass rest on it."""
    for row in range(1, DECIMATOR_TAPS):
        older = ss[history + row * n : history + (row + 1) * n]
        for c in range(n):
            older[c] = fresh[c]
    at = int(ps[H_AT_DECIMATOR])
    gain = 0.0
    for i in range(DECIMATOR_TAPS):
        gain += ps[at + i]
    at = int(ps[H_AT_HIGH_PASS])
    # A high-pass puts out zero at rest: its first state then cancels b0 x, its second b0 x + b1 x.
    for c in range(n):
        x = gain * fresh[c]
        ss[high_pass + c] = -ps[at] * x
        ss[high_pass + n + c] = ps[at + 2] * x


@kernel
def _decimate(ps, ss, ws, history, row, n):
    """Low-pass the raw history into the first ``n`` places of ``ws``, four rows at a time."""
    at = int(ps[H_AT_DECIMATOR])
    out = ws[0:n]
    for c in range(n):
        out[c] = 0.0
    for block in range(DECIMATOR_TAPS // 4):
        i = 4 * block
        p0 = history + ((row - i) & _WRAP) * n
        p1 = history + ((row - i - 1) & _WRAP) * n
        p2 = history + ((row - i - 2) & _WRAP) * n
        p3 = history + ((row - i - 3) & _WRAP) * n
        x0 = ss[p0 : p0 + n]
        x1 = ss[p1 : p1 + n]
        x2 = ss[p2 : p2 + n]
        x3 = ss[p3 : p3 + n]
        g0 = ps[at + i]
        g1 = ps[at + i + 1]
        g2 = ps[at + i + 2]
        g3 = ps[at + i + 3]
        for c in range(n):
            out[c] += (g0 * x0[c] + g1 * x1[c]) + (g2 * x2[c] + g3 * x3[c])


@kernel
def _high_pass(ps, ss, ws, state, place, n):
    """Lower limit of the microphones; writes the row of the channel history that starts at ``place``."""
    at = int(ps[H_AT_HIGH_PASS])
    b0 = ps[at]
    b1 = ps[at + 1]
    b2 = ps[at + 2]
    a1 = ps[at + 3]
    a2 = ps[at + 4]
    x = ws[0:n]
    s1 = ss[state : state + n]
    s2 = ss[state + n : state + 2 * n]
    y = ss[place : place + n]
    for c in range(n):
        value = b0 * x[c] + s1[c]
        s1[c] = b1 * x[c] - a1 * value + s2[c]
        s2[c] = b2 * x[c] - a2 * value
        y[c] = value


@kernel
def _filter(ps, ss, ws, channels, place, n):
    """Run every bank over the channel history; outputs stand in ``ws`` after the ``n`` channels.

    Channels of a bank lie side by side in history and taps, so the inner loop is one vector loop without a
    running sum, the same on every machine.
    """
    rows = int(ps[H_ROWS])
    banks = int(ps[H_AT_BANKS])
    for bank in range(int(ps[H_BANKS])):
        at = banks + BANK_SIZE * bank
        first = channels + int(ps[at + BANK_CHANNEL])
        m = int(ps[at + BANK_COUNT])
        row = place - int(ps[at + BANK_DELAY])
        if row < 0:
            row += rows
        taps = int(ps[at + BANK_AT_TAPS])
        output = n + int(ps[at + BANK_OUTPUT])
        y = ws[output : output + m]
        for c in range(m):
            y[c] = 0.0
        for block in range(int(ps[at + BANK_TAPS]) // 4):
            i = 4 * block
            p0 = first + row * n
            row = row - 1 if row > 0 else rows - 1  # a remainder would cost more than the sums
            p1 = first + row * n
            row = row - 1 if row > 0 else rows - 1
            p2 = first + row * n
            row = row - 1 if row > 0 else rows - 1
            p3 = first + row * n
            row = row - 1 if row > 0 else rows - 1
            x0 = ss[p0 : p0 + m]
            x1 = ss[p1 : p1 + m]
            x2 = ss[p2 : p2 + m]
            x3 = ss[p3 : p3 + m]
            h0 = ps[taps + i * m : taps + (i + 1) * m]
            h1 = ps[taps + (i + 1) * m : taps + (i + 2) * m]
            h2 = ps[taps + (i + 2) * m : taps + (i + 3) * m]
            h3 = ps[taps + (i + 3) * m : taps + (i + 4) * m]
            for c in range(m):
                y[c] += (h0[c] * x0[c] + h1[c] * x1[c]) + (h2[c] * x2[c] + h3[c] * x3[c])
