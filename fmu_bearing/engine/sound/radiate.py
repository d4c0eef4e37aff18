"""From one motion sample to the pressure at every microphone: decimation, channels, filters.

One call of `push` takes one sample of the motion at ``RAW_RATE``. Two half-band filters, one behind the
other, halve the rate of its numbers twice: every fourth call a row at ``RATE`` comes out. The channels are
formed of it, pass the microphones' low-frequency limit, enter the history, run through all filters and move
the meters. State depends on the samples alone, never on how steps are cut.
"""

from fmu_bearing.engine.choices import SCALARS
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR, MO, SD
from fmu_bearing.engine.sound import channels, meter
from fmu_bearing.engine.sound.convolve import convolve
from fmu_bearing.engine.sound.high_pass import high_pass

__all__ = ["filtered", "push", "reset"]


@kernel
def reset(ss):
    """Forget everything: the next `push` is the first."""
    for i in range(len(ss)):
        ss[i] = 0.0


@kernel
def push(ps, ss, ws, motion, time_weighting, metering_start):
    """Take one motion sample (see `layout.motion`) and update filters and meters.

    ``time_weighting`` is the meters' time constant in s, ``metering_start`` the time in s from the first
    sample on at which they begin.
    """
    if filtered(ps, ss, ws, motion):
        meter.update(ps, ss, ws, time_weighting, metering_start)
        ss[SD.SS_COUNT] += 1.0


@kernel
def filtered(ps, ss, ws, motion):
    """Take one motion sample; whether it brings filter outputs at ``RATE``, which are then in ``ws``.

    Whoever reads them counts them in ``SS_COUNT``. The decimator takes the first sample to have lasted for
    ever; for the high-pass see `high_pass`.
    """
    raw = int(ss[SD.SS_RAW])
    wide = int(ps[SD.H_RAW])
    row = SD.SS_TABLES + raw % SD.FIRST_ROWS * wide
    channels.keep(ps, motion, ss[row : row + wide])
    if raw == 0:
        _settle(ps, ss, motion)
    elif raw % SD.DECIMATION == SD.TURNING:
        _keep_turns(ps, ss, motion, raw // SD.DECIMATION % SD.TURN_ROWS)
    ss[SD.SS_RAW] = raw + 1.0
    if raw % SD.HALF != 0:
        return False
    half = raw // SD.HALF
    newest = half % SD.SECOND_ROWS
    second = int(ps[SD.H_S_SECOND])
    row = second + newest * wide
    halve(
        ps, int(ps[SD.H_AT_FIRST]), SD.FIRST_TAPS, ss, SD.SS_TABLES, raw % SD.FIRST_ROWS, ss[row : row + wide]
    )
    if half % SD.HALF != 0:
        return False
    x = ws[0:wide]
    halve(ps, int(ps[SD.H_AT_SECOND]), SD.SECOND_TAPS, ss, second, newest, x)
    count = int(ss[SD.SS_COUNT])
    place = count % int(ps[SD.H_ROWS])
    _form(ps, ss, ws, count % SD.TURN_ROWS)
    high_pass(ps, ss, ws[wide : wide + int(ps[SD.H_CHANNELS])], place, count)
    convolve(ps, ss, ws, place, count)
    return True


@kernel
def _keep_turns(ps, ss, motion, row):
    """Keep cosines and sines of the balls' angles until their sample is in the decimator's middle."""
    if int(ps[SD.H_FORM]) == SCALARS:
        return
    lanes = int(ps[SD.H_BALL_LANES])
    at = int(ps[SD.H_S_TURNS]) + 2 * lanes * row
    for j in range(lanes):
        ss[at + j] = motion[MO.COS + j]
        ss[at + lanes + j] = motion[MO.SIN + j]


@kernel
def _form(ps, ss, ws, row):
    """Form the channels behind the raw row at the head of ``ws``, with the angles of ``row``."""
    wide = int(ps[SD.H_RAW])
    lanes = int(ps[SD.H_BALL_LANES])
    turns = int(ps[SD.H_S_TURNS]) + 2 * lanes * row
    out = ws[wide : wide + int(ps[SD.H_CHANNELS])]
    channels.form(ps, ws, ws[0:wide], ss[turns : turns + 2 * lanes], out)


@kernel
def _settle(ps, ss, motion):
    """Fill the histories of the decimator and of the balls' angles with the first sample."""
    wide = int(ps[SD.H_RAW])
    for row in range(1, SD.FIRST_ROWS):
        for i in range(wide):
            ss[SD.SS_TABLES + row * wide + i] = ss[SD.SS_TABLES + i]
    second = int(ps[SD.H_S_SECOND])
    x = ss[second : second + wide]
    halve(ps, int(ps[SD.H_AT_FIRST]), SD.FIRST_TAPS, ss, SD.SS_TABLES, 0, x)
    for row in range(1, SD.SECOND_ROWS):
        for i in range(wide):
            ss[second + row * wide + i] = x[i]
    for row in range(SD.TURN_ROWS):
        _keep_turns(ps, ss, motion, row)


@kernel
def halve(ps, at, taps, ss, history, newest, out):
    """Half-band filter over the last ``taps`` rows of the ring ``ss[history:]``, which has one row more.

    ``ps[at:]`` holds the outer taps (see `layout.sound`), ``newest`` is the newest row. Two pairs of rows at
    a time.
    """
    wide = len(out)
    rows = taps + 1
    p = history + (newest + rows - taps // 2) % rows * wide
    x = ss[p : p + wide]
    for c in range(wide):
        out[c] = 0.5 * x[c]
    left = newest  # row before the sum's first half moves back in time, that of the second half forward
    right = (newest + 2) % rows
    for i in range(at, at + rows // FOUR, 2):
        p0 = history + left * wide
        q0 = history + right * wide
        left = (left + rows - 2) % rows
        right = (right + 2) % rows
        p1 = history + left * wide
        q1 = history + right * wide
        left = (left + rows - 2) % rows
        right = (right + 2) % rows
        x0 = ss[p0 : p0 + wide]
        y0 = ss[q0 : q0 + wide]
        x1 = ss[p1 : p1 + wide]
        y1 = ss[q1 : q1 + wide]
        g0 = ps[i]
        g1 = ps[i + 1]
        for c in range(wide):
            out[c] += g0 * (x0[c] + y0[c]) + g1 * (x1[c] + y1[c])
