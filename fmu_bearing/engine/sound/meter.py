"""Sound level meters: one per microphone, moved by one pressure sample after the other.

Form scalars (radiation model ``paper``): components and their sources add as energies (multi-source paper,
eqs. 43 and 46), only the instantaneous pressure, and with it the third octaves, is a plain sum. Other forms:
everything adds as pressures, and levels are of the sum; the energy sum over the components is metered beside
it.

Exponential averages are divided by the sum of their weights since metering began, so that a steady sound
reads its level at once instead of climbing to it.
"""

import math

from fmu_bearing.engine.choices import SCALARS
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD, Z
from fmu_bearing.engine.sound import thirds
from fmu_bearing.engine.sound.convolve import in_fours
from fmu_bearing.engine.sound.section import filter_section

_FLOOR = 1e-20  # Pa^2
_REFERENCE = 4e-10  # Pa^2
_FAST = 1.0 - math.exp(-1.0 / (SD.RATE * SD.FAST))
_SLOW = 1.0 - math.exp(-1.0 / (SD.RATE * SD.SLOW))
# Squares of each sample in ``ws`` from ``H_W_METERS`` on, one row of microphones each, places as in
# ``MIC_OUTPUTS``: total and its A-weighted twin, components, energy sum, kinds.
_TOTAL, _TOTAL_A = SD.M_LEVEL, SD.M_LEVEL_A


@kernel
def update(ps, ss, ws, batch, time_weighting, metering_start):
    """Move all meters by ``batch`` samples, whose filter outputs are in ``ws``, and count these."""
    gather(ps, ss, ws, batch)
    for k in range(batch):
        follow(ps, ss, ws, k, time_weighting, metering_start)
        ss[SD.SS_COUNT] += 1.0


@kernel
def gather(ps, ss, ws, batch):
    """Add up what filter outputs bring each microphone: rows of pressures, or with form scalars of energies.

    A block of rows per sample. Rows of several bearings may be added (`add`) before `follow` squares and
    meters them.
    """
    n = int(ps[SD.H_MICS])
    rows = int(ps[SD.H_W_METERS])
    size = SD.METERS * n
    squares = ws[rows : rows + batch * size]
    for i in range(batch * size):
        squares[i] = 0.0
    if int(ps[SD.H_FORM]) == SCALARS:
        for k in range(batch):
            _energies(ps, ss, ws, k, squares[k * size : (k + 1) * size], n)
    else:
        _pressures(ps, ws, batch, squares, n)


@kernel
def add(ps, ws, others, more, batch):
    """Add the rows that another block ``others`` has gathered in ``more`` to those in ``ws``.

    Both have the same microphones; their lanes may differ.
    """
    n = int(ps[SD.H_MICS])
    order = int(ps[SD.H_AT_ORDER])
    other = int(others[SD.H_AT_ORDER])
    for mic in range(n):
        to = int(ps[SD.H_W_METERS]) + int(ps[order + mic])
        of = int(others[SD.H_W_METERS]) + int(others[other + mic])
        for row in range(batch * SD.METERS):
            ws[to + row * n] += more[of + row * n]


@kernel
def square(ps, ws, k, mic):
    """Square (Pa2) that the rows of sample ``k`` bring microphone ``mic``: what its level is of."""
    n = int(ps[SD.H_MICS])
    at = _rows_of(ps, k) + int(ps[int(ps[SD.H_AT_ORDER]) + mic])
    if int(ps[SD.H_FORM]) != SCALARS:
        return ws[at] * ws[at]
    total = 0.0
    for row in range(SD.M_PART, SD.PLAIN):
        total += ws[at + row * n]
    return total


@kernel
def _rows_of(ps, k):
    """Place of the rows of sample ``k``."""
    return int(ps[SD.H_W_METERS]) + k * SD.METERS * int(ps[SD.H_MICS])


@kernel
def begun(count, metering_start):
    """Whether metering has begun with the sample that has this number."""
    return count >= metering_start * SD.RATE


@kernel
def fraction_of(time_weighting):
    """Weight of one sample in an exponential average of this time constant (s)."""
    return 1.0 - math.exp(-1.0 / (SD.RATE * time_weighting)) if time_weighting > 0.0 else 1.0


@kernel
def follow(ps, ss, ws, k, time_weighting, metering_start):
    """Square the rows of sample ``k`` and move all meters by this sample."""
    n = int(ps[SD.H_MICS])
    rows = _rows_of(ps, k)
    size = SD.METERS * n
    squares = ws[rows : rows + size]
    meters = ss[int(ps[SD.H_S_METERS]) : int(ps[SD.H_S_METERS]) + size]
    if int(ps[SD.H_FORM]) == SCALARS:
        _sum_components(squares, n)
        for i in range(n):
            squares[_TOTAL * n + i] = squares[SD.M_ENERGY * n + i]
    else:
        _square(ps, ss, ws, squares, n)
        _sum_components(squares, n)
    for i in range(n):
        meters[i] = squares[i]
    metered = begun(ss[SD.SS_COUNT], metering_start)
    if int(ps[SD.H_BANDS]) > 0:
        thirds.update(ps, ss, ws, rows, _FAST if metered else 0.0)
    if not metered:
        return
    fraction = fraction_of(time_weighting)
    ss[SD.SS_METERED] += 1.0
    ss[SD.SS_WEIGHT] += fraction * (1.0 - ss[SD.SS_WEIGHT])
    ss[SD.SS_FAST] += _FAST * (1.0 - ss[SD.SS_FAST])
    ss[SD.SS_SLOW] += _SLOW * (1.0 - ss[SD.SS_SLOW])
    _track(meters, SD.M_LEVEL, squares, _TOTAL, 2, n, fraction)
    _track(meters, SD.M_PART, squares, SD.M_PART, SD.PLAIN - SD.M_PART, n, fraction)
    add = meters[SD.M_SUM * n : (SD.M_SUM + 2) * n]
    seen = squares[_TOTAL * n : (_TOTAL + 2) * n]
    for i in range(2 * n):
        add[i] += seen[i]
    if int(ps[SD.H_DETAILS]) > 0:
        _track(meters, SD.M_FAST, squares, _TOTAL, 2, n, _FAST)
        _track(meters, SD.M_SLOW, squares, _TOTAL, 2, n, _SLOW)
        _track(meters, SD.M_ENERGY, squares, SD.M_ENERGY, SD.METERS - SD.M_ENERGY, n, fraction)


@kernel
def _track(meters, row, squares, source, count, n, fraction):
    """Exponential averages: ``count`` rows of ``meters`` follow as many of ``squares``."""
    mean = meters[row * n : (row + count) * n]
    fresh = squares[source * n : (source + count) * n]
    for i in range(count * n):
        mean[i] += fraction * (fresh[i] - mean[i])


@kernel
def _pressures(ps, ws, batch, squares, n):
    """Coherent sums: pressures of each source, of components, of kinds, of all."""
    at = int(ps[SD.H_W_SOURCES])
    size = int(ps[SD.H_SOURCES]) * n
    parts = ws[at : at + batch * size]
    for i in range(batch * size):
        parts[i] = 0.0
    pitch = in_fours(int(ps[SD.H_OUTPUTS]))
    outputs = int(ps[SD.H_W_OUTPUTS])
    sources = int(ps[SD.H_AT_OUTPUTS])
    for group in range(int(ps[SD.H_GROUPS])):
        g = int(ps[SD.H_AT_GROUPS]) + SD.GROUP_SIZE * group
        first = int(ps[g + SD.GROUP_FIRST])
        lane = int(ps[g + SD.GROUP_LANE])
        mics = int(ps[g + SD.GROUP_MICS])
        weights = int(ps[g + SD.GROUP_AT_WEIGHTS])
        for o in range(int(ps[g + SD.GROUP_COUNT])):
            to = int(ps[sources + first + o]) * n + lane
            value = ws[outputs + first + o : outputs + first + o + (batch - 1) * pitch + 1]
            for i in range(mics):
                weight = ps[weights + o * mics + i]
                for k in range(batch):
                    parts[k * size + to + i] += weight * value[k * pitch]
    for source in range(int(ps[SD.H_SOURCES])):
        at = int(ps[SD.H_AT_SOURCES]) + SD.SOURCE_SIZE * source
        component = (SD.M_PART + int(ps[at + SD.SOURCE_COMPONENT])) * n
        kind = (SD.M_KIND + int(ps[at + SD.SOURCE_KIND])) * n
        for k in range(batch):
            part = parts[k * size + source * n : k * size + (source + 1) * n]
            rows = squares[k * SD.METERS * n : (k + 1) * SD.METERS * n]
            for i in range(n):
                rows[i] += part[i]
                rows[component + i] += part[i]
                if kind < SD.METERS * n:
                    rows[kind + i] += part[i]


@kernel
def _square(ps, ss, ws, squares, n):
    """Pressures to their squares, the A-weighted one too; the row of pressures stays."""
    total = squares[0:n]
    at = int(ps[SD.H_W_WEIGHTED])
    weighted = ws[at : at + n]
    for i in range(n):
        weighted[i] = total[i]
    _a_weight(ps, ss, weighted, n)
    for i in range(n):
        squares[_TOTAL * n + i] = total[i] * total[i]
        squares[_TOTAL_A * n + i] = weighted[i] * weighted[i]
    for i in range(SD.M_PART * n, SD.METERS * n):
        squares[i] = squares[i] * squares[i]


@kernel
def _energies(ps, ss, ws, k, squares, n):
    """Energy sums of the printed method for sample ``k``: every filter output is squared by itself."""
    out_at = int(ps[SD.H_W_OUTPUTS]) + k * in_fours(int(ps[SD.H_OUTPUTS]))
    lanes = int(ps[SD.H_LANES])
    at = int(ps[SD.H_W_WEIGHTED])
    weighted = ws[at : at + lanes]
    for i in range(lanes):
        weighted[i] = ws[out_at + i]
    _a_weight(ps, ss, weighted, lanes)
    sources = int(ps[SD.H_AT_OUTPUTS])
    table = int(ps[SD.H_AT_SOURCES])
    for group in range(int(ps[SD.H_GROUPS])):
        g = int(ps[SD.H_AT_GROUPS]) + SD.GROUP_SIZE * group
        first = int(ps[g + SD.GROUP_FIRST])
        lane = int(ps[g + SD.GROUP_LANE])
        mics = int(ps[g + SD.GROUP_MICS])
        weights = int(ps[g + SD.GROUP_AT_WEIGHTS])
        for o in range(int(ps[g + SD.GROUP_COUNT])):
            at = table + SD.SOURCE_SIZE * int(ps[sources + first + o])
            component = (SD.M_PART + int(ps[at + SD.SOURCE_COMPONENT])) * n + lane
            kind = (SD.M_KIND + int(ps[at + SD.SOURCE_KIND])) * n + lane
            for i in range(mics):
                w = ps[weights + o * mics + i]
                value = w * ws[out_at + first + o]
                energy = value * value
                squares[lane + i] += value
                squares[component + i] += energy
                if kind < SD.METERS * n:
                    squares[kind + i] += energy
                squares[_TOTAL_A * n + lane + i] += (w * weighted[first + o]) ** 2


@kernel
def _sum_components(squares, n):
    """Eq. 46 of the multi-source paper: energies of the components added."""
    total = squares[SD.M_ENERGY * n : (SD.M_ENERGY + 1) * n]
    for i in range(n):
        total[i] = 0.0
    for k in range(SD.M_PART, SD.PLAIN):
        part = squares[k * n : (k + 1) * n]
        for i in range(n):
            total[i] += part[i]


@kernel
def _a_weight(ps, ss, x, n):
    """A-weight the ``n`` signals ``x`` in place, lanes side by side."""
    for section in range(SD.A_SECTIONS):
        at = int(ps[SD.H_AT_A_WEIGHTING]) + SD.SECTION * section
        state = int(ps[SD.H_S_A_WEIGHTING]) + SD.SECTION_STATES * n * section
        filter_section(ps, at, ss, state, x, n)


@kernel
def decibel(mean_square):
    """Level (dB re 20 uPa) of a mean square (Pa2)."""
    return 10.0 * math.log10((mean_square + _FLOOR) / _REFERENCE)


@kernel
def levels(ps, ss, z, offset):
    """Write the ``MIC_OUTPUTS`` of every microphone into ``z`` from ``offset`` on, then its third octaves.

    Levels in dB re 20 uPa, never below -106 dB and always finite; the floor before metering has begun, and
    where the scene keeps no such meter.
    """
    n = int(ps[SD.H_MICS])
    meters = int(ps[SD.H_S_METERS])
    count = 1.0
    weight = 1.0
    fast = 1.0
    slow = 1.0
    if ss[SD.SS_METERED] > 0.0:
        count = ss[SD.SS_METERED]
        weight = ss[SD.SS_WEIGHT]
        fast = ss[SD.SS_FAST]
        slow = ss[SD.SS_SLOW]
    rows = SD.METERS if int(ps[SD.H_DETAILS]) > 0 else SD.PLAIN
    bands = int(ps[SD.H_BANDS])
    for mic in range(n):
        lane = int(ps[int(ps[SD.H_AT_ORDER]) + mic])
        out = offset + Z.PER_MIC * mic
        z[out + SD.M_PRESSURE] = ss[meters + lane]
        for row in range(1, SD.METERS):
            by = weight
            if row == SD.M_SUM or row == SD.M_SUM_A:
                by = count
            elif row == SD.M_FAST or row == SD.M_FAST_A:
                by = fast
            elif row == SD.M_SLOW or row == SD.M_SLOW_A:
                by = slow
            z[out + row] = decibel(ss[meters + row * n + lane] / by if row < rows else 0.0)
        mean = int(ps[SD.H_S_BANDS]) + SD.BAND_SIZE * lane + SD.BAND_MEAN
        apart = 1
        if ps[SD.H_LINES] != 0.0:  # rows of microphones
            mean = int(ps[SD.H_S_BANDS]) + lane
            apart = n
        first = offset + Z.PER_MIC * n + bands * mic
        for k in range(bands):
            z[first + k] = decibel(ss[mean + k * apart] / fast)
