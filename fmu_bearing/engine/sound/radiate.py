"""From one motion sample to the pressure at every microphone: channels, decimation, filters.

One call of `push` takes one sample of the motion at ``RAW_RATE``. Every fourth call a sample at ``RATE``
comes out of the decimator, passes the microphones' low-frequency limit, enters the history, runs through
all filters and moves the meters. State depends on the samples alone, never on how steps are cut.
"""

from fmu_bearing.engine.choices import CONTACTS, SCALARS
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR, SD
from fmu_bearing.engine.sound import channels, meter
from fmu_bearing.engine.sound.convolve import convolve
from fmu_bearing.engine.sound.section import filter_section

__all__ = ["push", "reset"]

_WRAP = SD.DECIMATOR_TAPS - 1  # the raw history is a power of two long


@kernel
def reset(ss):
    """Forget everything: the next `push` is the first."""
    for i in range(len(ss)):
        ss[i] = 0.0


@kernel
def push(ps, ss, ws, motion, time_weighting, metering_start):
    """Take one motion sample (see `layout.motion`) and update filters and meters.

    ``time_weighting`` is the meters' time constant in s, ``metering_start`` the time in s from the first
    sample on at which they begin. The first sample is taken to have lasted for ever, so that constant
    accelerations (the balls' centripetal one) make no start-up step.
    """
    n = int(ps[SD.H_CHANNELS])
    raw = int(ss[SD.SS_RAW])
    history = SD.SS_TABLES
    row = raw & _WRAP
    fresh = ss[history + row * n : history + (row + 1) * n]
    form = int(ps[SD.H_FORM])
    if form == SCALARS:
        channels.scalars(ps, motion, fresh)
    elif form == CONTACTS:
        channels.contacts(ps, motion, fresh)
    else:
        channels.accelerations(ps, ws, motion, fresh)
    high_pass = int(ps[SD.H_S_HIGH_PASS])
    if raw == 0:
        _settle(ps, ss, fresh, history, high_pass, n)
    ss[SD.SS_RAW] = raw + 1.0
    if raw % SD.DECIMATION != 0:
        return
    count = int(ss[SD.SS_COUNT])
    place = count % int(ps[SD.H_ROWS])
    _decimate(ps, ss, ws, history, row, n)
    _high_pass(ps, ss, ws, high_pass, int(ps[SD.H_S_CHANNELS]) + place * n, n)
    convolve(ps, ss, ws, place, count)
    meter.update(ps, ss, ws, time_weighting, metering_start)
    ss[SD.SS_COUNT] = count + 1.0


@kernel
def _settle(ps, ss, fresh, history, high_pass, n):
    """Fill the raw history with the first sample and let the high-pass rest on it."""
    for row in range(1, SD.DECIMATOR_TAPS):
        older = ss[history + row * n : history + (row + 1) * n]
        for c in range(n):
            older[c] = fresh[c]
    at = int(ps[SD.H_AT_DECIMATOR])
    gain = 0.0
    for i in range(SD.DECIMATOR_TAPS):
        gain += ps[at + i]
    at = int(ps[SD.H_AT_HIGH_PASS])
    # A high-pass puts out zero at rest: its first state then cancels b0 x, its second b0 x + b1 x.
    for c in range(n):
        x = gain * fresh[c]
        ss[high_pass + c] = -ps[at + SD.B0] * x
        ss[high_pass + n + c] = ps[at + SD.B2] * x


@kernel
def _decimate(ps, ss, ws, history, row, n):
    """Low-pass the raw history into the first ``n`` places of ``ws``, four rows at a time."""
    at = int(ps[SD.H_AT_DECIMATOR])
    out = ws[0:n]
    for c in range(n):
        out[c] = 0.0
    for block in range(SD.DECIMATOR_TAPS // FOUR):
        i = FOUR * block
        k = i + 2
        p0 = history + ((row - i) & _WRAP) * n
        p1 = history + ((row - i - 1) & _WRAP) * n
        p2 = history + ((row - k) & _WRAP) * n
        p3 = history + ((row - k - 1) & _WRAP) * n
        x0 = ss[p0 : p0 + n]
        x1 = ss[p1 : p1 + n]
        x2 = ss[p2 : p2 + n]
        x3 = ss[p3 : p3 + n]
        g0 = ps[at + i]
        g1 = ps[at + i + 1]
        g2 = ps[at + k]
        g3 = ps[at + k + 1]
        for c in range(n):
            out[c] += (g0 * x0[c] + g1 * x1[c]) + (g2 * x2[c] + g3 * x3[c])


@kernel
def _high_pass(ps, ss, ws, state, place, n):
    """Lower limit of the microphones; writes the row of the channel history that starts at ``place``.

    The channels stand in the first ``n`` places of ``ws``.
    """
    at = int(ps[SD.H_AT_HIGH_PASS])
    x = ws[0:n]
    filter_section(ps, at, ss, state, x, n)
    y = ss[place : place + n]
    lanes = int(ps[SD.H_AT_LANES])
    for c in range(n):
        y[int(ps[lanes + c])] = x[c]
