"""From motion samples to the pressure at every microphone: decimation, channels, filters.

`push` takes one sample of the motion at ``RAW_RATE``. Two half-band filters, one behind the other, halve the
rate of its numbers twice: every fourth sample makes one at ``RATE`` due. What is due waits, up to ``BATCH``
samples, and passes `filtered` together: each number goes the same way however many there are, but what the
filters keep is fetched once. There the second half-band filter works, the channels are formed, pass the
microphones' low-frequency limit, enter the history and run through all filters. State depends on the samples
alone, never on how steps are cut, once nothing waits.
"""

from fmu_bearing.engine.choices import SCALARS
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, MO, SD
from fmu_bearing.engine.sound import channels
from fmu_bearing.engine.sound.convolve import convolve, in_fours
from fmu_bearing.engine.sound.high_pass import high_pass

__all__ = ["filtered", "push", "reset", "waiting"]

_MANY = 4 * FOUR  # numbers whose sums are in registers at once


@kernel
def reset(ss):
    """Forget everything: the next `push` is the first."""
    for i in range(len(ss)):
        ss[i] = 0.0


@kernel
def push(ps, ss, motion):
    """Take one motion sample (see `layout.motion`); no more than ``BATCH`` may be `waiting` before.

    The decimator takes the first sample to have lasted for ever; for the high-pass see `high_pass`.
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
    if raw % SD.HALF == 0:
        row = int(ps[SD.H_S_SECOND]) + raw // SD.HALF % SD.SECOND_ROWS * wide
        _halve_first(ps, ss, raw % SD.FIRST_ROWS, ss[row : row + wide])


@kernel
def waiting(ss):
    """Return how many samples at ``RATE`` wait for `filtered`."""
    return (int(ss[SD.SS_RAW]) + SD.DECIMATION - 1) // SD.DECIMATION - int(ss[SD.SS_COUNT])


@kernel
def filtered(ps, ss, ws):
    """Let the samples that wait pass the filters, whose outputs are then in ``ws``; return how many they are.

    Whoever reads the outputs counts them in ``SS_COUNT``.
    """
    batch = waiting(ss)
    if batch <= 0:
        return 0
    wide = int(ps[SD.H_RAW])
    n = int(ps[SD.H_CHANNELS])
    count = int(ss[SD.SS_COUNT])
    second = int(ps[SD.H_S_SECOND])
    newest = count * SD.HALF % SD.SECOND_ROWS
    halve(
        ps, int(ps[SD.H_AT_SECOND]), SD.SECOND_TAPS, ss, second, SD.SECOND_ROWS, newest, batch,
        ws[0 : batch * wide],
    )  # fmt: skip
    formed = int(ps[SD.H_W_FORMED])
    rows = int(ps[SD.H_ROWS])
    for k in range(batch):
        x = ws[formed + k * n : formed + (k + 1) * n]
        _form(ps, ss, ws, ws[k * wide : (k + 1) * wide], (count + k + SD.BATCH) % SD.TURN_ROWS, x)
        high_pass(ps, ss, x, (count + k) % rows, count + k)
    pitch = in_fours(int(ps[SD.H_OUTPUTS]))
    out = int(ps[SD.H_W_OUTPUTS])
    for k in range(batch):
        y = ws[out + k * pitch : out + (k + 1) * pitch]
        convolve(ps, ss, ws, y, (count + k) % rows, count + k)
    return batch


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
def _form(ps, ss, ws, x, row, out):
    """Form the channels ``out`` of the decimated raw row ``x``, with the angles of ``row``."""
    lanes = int(ps[SD.H_BALL_LANES])
    turns = int(ps[SD.H_S_TURNS]) + 2 * lanes * row
    channels.form(ps, ws, x, ss[turns : turns + 2 * lanes], out)


@kernel
def _settle(ps, ss, motion):
    """Fill the histories of the decimator and of the balls' angles with the first sample."""
    wide = int(ps[SD.H_RAW])
    for row in range(1, SD.FIRST_ROWS):
        for i in range(wide):
            ss[SD.SS_TABLES + row * wide + i] = ss[SD.SS_TABLES + i]
    second = int(ps[SD.H_S_SECOND])
    x = ss[second : second + wide]
    _halve_first(ps, ss, 0, x)
    for row in range(1, SD.SECOND_ROWS):
        for i in range(wide):
            ss[second + row * wide + i] = x[i]
    for row in range(SD.TURN_ROWS):
        _keep_turns(ps, ss, motion, row)


@kernel
def _halve_first(ps, ss, newest, out):
    """Decimator's first stage with the row ``newest`` of its history."""
    halve(ps, int(ps[SD.H_AT_FIRST]), SD.FIRST_TAPS, ss, SD.SS_TABLES, SD.FIRST_ROWS, newest, 1, out)


@kernel
def halve(ps, at, taps, ss, history, rows, newest, count, out):
    """Half-band filter over ``taps`` rows of the ring ``ss[history:]``, which has ``rows`` of them.

    ``ps[at:]`` holds the outer taps (see `layout.sound`). ``newest`` is the newest row of the first of
    ``count`` results, which take every other row; their rows in ``out`` have a multiple of four numbers.
    Sixteen of these at a time, whose sums stay in registers, of all results before the next ones.
    """
    wide = len(out) // count
    many = wide // _MANY * _MANY
    first = history
    for c in range(0, many, _MANY):
        row = newest
        for n in range(count):
            k = c + n * wide
            x0, x1, x2, x3 = _halve_sixteen(ps, at, taps, ss, first, rows, row, wide)
            store(out, k, x0)
            store(out, k + FOUR, x1)
            store(out, k + 2 * FOUR, x2)
            store(out, k + 3 * FOUR, x3)
            row = row + SD.HALF if row + SD.HALF < rows else row + SD.HALF - rows
        first += _MANY
    for c in range(many, wide, FOUR):
        row = newest
        for n in range(count):
            k = c + n * wide
            store(out, k, _halve_four(ps, at, taps, ss, first, rows, row, wide))
            row = row + SD.HALF if row + SD.HALF < rows else row + SD.HALF - rows
        first += FOUR


@kernel
def _halve_sixteen(ps, at, taps, ss, first, rows, newest, wide):
    """Sixteen numbers of `halve`: of the rows at ``ss[first:]``, ``wide`` apart."""
    m = first + _earlier(newest, taps // 2, rows) * wide
    left = first + newest * wide  # before the sum's first half moves back in time, the second half forward
    right = first + _earlier(newest, taps - 1, rows) * wide
    end = first + rows * wide
    a = 0.5 * load(ss, m)
    b = 0.5 * load(ss, m + FOUR)
    c = 0.5 * load(ss, m + 2 * FOUR)
    d = 0.5 * load(ss, m + 3 * FOUR)
    for i in range(at, at + (taps + 1) // FOUR, 2):
        p, q = left, right
        left, right = _apart(left, right, first, end, wide)
        g, h = ps[i], ps[i + 1]
        a += g * (load(ss, p) + load(ss, q)) + h * (load(ss, left) + load(ss, right))
        p += FOUR
        q += FOUR
        r = left + FOUR
        s = right + FOUR
        b += g * (load(ss, p) + load(ss, q)) + h * (load(ss, r) + load(ss, s))
        p += FOUR
        q += FOUR
        r += FOUR
        s += FOUR
        c += g * (load(ss, p) + load(ss, q)) + h * (load(ss, r) + load(ss, s))
        p += FOUR
        q += FOUR
        r += FOUR
        s += FOUR
        d += g * (load(ss, p) + load(ss, q)) + h * (load(ss, r) + load(ss, s))
        left, right = _apart(left, right, first, end, wide)
    return a, b, c, d


@kernel
def _halve_four(ps, at, taps, ss, first, rows, newest, wide):
    """Four numbers of `halve`, as `_halve_sixteen`."""
    left = first + newest * wide
    right = first + _earlier(newest, taps - 1, rows) * wide
    end = first + rows * wide
    a = 0.5 * load(ss, first + _earlier(newest, taps // 2, rows) * wide)
    for i in range(at, at + (taps + 1) // FOUR, 2):
        p, q = left, right
        left, right = _apart(left, right, first, end, wide)
        a += ps[i] * (load(ss, p) + load(ss, q)) + ps[i + 1] * (load(ss, left) + load(ss, right))
        left, right = _apart(left, right, first, end, wide)
    return a


@kernel
def _earlier(row, by, rows):
    """Row of the ring that is ``by`` rows before; a remainder would cost as much as ten products."""
    row -= by
    return row if row >= 0 else row + rows


@kernel
def _apart(left, right, first, end, wide):
    """Rows of the ring from ``first`` to ``end`` two before ``left`` and two behind ``right``."""
    left -= 2 * wide
    if left < first:
        left += end - first
    right += 2 * wide
    if right >= end:
        right -= end - first
    return left, right
