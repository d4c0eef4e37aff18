"""Sound level meters: one per microphone, moved by one pressure sample at a time.

Compact rung: components add as pressures, levels are of the sum. Paper rung: components and their sources
add as energies (multi-source paper, eqs. 43 and 46), only the instantaneous pressure is a plain sum.

Fast and Slow are exponential averages divided by the sum of their weights since metering began, so that
a steady sound reads its level at once instead of climbing to it.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import MIC_OUTPUTS
from fmu_bearing.engine.sound.places import (
    DECIMATOR_TAPS,
    H_AT_A_WEIGHTING,
    H_AT_COMPONENTS,
    H_AT_MICS,
    H_CHANNELS,
    H_LANES,
    H_MICS,
    H_OUTPUTS,
    H_ROWS,
    H_RUNG,
    M_FAST,
    M_FAST_A,
    M_PART,
    M_PRESSURE,
    M_SUM,
    M_SUM_A,
    METER_SIZE,
    MIC_AT_WEIGHTS,
    MIC_COUNT,
    MIC_FIRST,
    MIC_SIZE,
    RATE,
    RUNG_PAPER,
    SS_COUNT,
    SS_METERED,
    SS_TABLES,
    SS_WEIGHT,
)

_N_OUT = len(MIC_OUTPUTS)
_FLOOR = 1e-20  # Pa^2
_REFERENCE = 4e-10  # Pa^2


@kernel
def update(ps, ss, ws, lanes, time_weighting, metering_start):
    """Move all meters by one sample; filter outputs stand in ``ws``, A-weighting state at ``ss[lanes]``."""
    n_out = int(ps[H_OUTPUTS])
    n_mics = int(ps[H_MICS])
    n_lanes = int(ps[H_LANES])
    outputs = int(ps[H_CHANNELS])
    weighted = outputs + n_out
    parts = weighted + n_lanes
    meters = lanes + 6 * n_lanes
    paper = int(ps[H_RUNG]) == RUNG_PAPER
    for mic in range(n_mics):
        pressure = _combine(ps, ws, mic, outputs, parts + 8 * mic, paper)
        ss[meters + METER_SIZE * mic + M_PRESSURE] = pressure
        if not paper:
            ws[weighted + mic] = pressure
    if paper:
        for i in range(n_out):
            ws[weighted + i] = ws[outputs + i]
    _a_weight(ps, ss, ws, lanes, weighted, n_lanes)
    if ss[SS_COUNT] < metering_start * RATE:
        return
    fraction = 1.0
    if time_weighting > 0.0:
        fraction = 1.0 - math.exp(-1.0 / (RATE * time_weighting))
    ss[SS_METERED] += 1.0
    ss[SS_WEIGHT] += fraction * (1.0 - ss[SS_WEIGHT])
    for mic in range(n_mics):
        part = parts + 8 * mic
        energy_a = 0.0
        if paper:
            at = int(ps[H_AT_MICS]) + MIC_SIZE * mic
            first = weighted + int(ps[at + MIC_FIRST])
            for i in range(first, first + int(ps[at + MIC_COUNT])):
                energy_a += ws[i] ** 2
        else:
            energy_a = ws[weighted + mic] ** 2
        at = meters + METER_SIZE * mic
        energy = ws[part + 4]
        ss[at + M_FAST] += fraction * (energy - ss[at + M_FAST])
        ss[at + M_FAST_A] += fraction * (energy_a - ss[at + M_FAST_A])
        ss[at + M_SUM] += energy
        ss[at + M_SUM_A] += energy_a
        for k in range(4):
            ss[at + M_PART + k] += fraction * (ws[part + k] - ss[at + M_PART + k])


@kernel
def _combine(ps, ws, mic, outputs, part, paper):
    """Pressure at one microphone; its components' squares go to ``ws[part]``, the total's to ``part + 4``."""
    at = int(ps[H_AT_MICS]) + MIC_SIZE * mic
    first = int(ps[at + MIC_FIRST])
    weights = int(ps[at + MIC_AT_WEIGHTS])
    components = int(ps[H_AT_COMPONENTS])
    for k in range(5):
        ws[part + k] = 0.0
    pressure = 0.0
    for i in range(int(ps[at + MIC_COUNT])):
        k = int(ps[components + first + i])
        value = ps[weights + i] * ws[outputs + first + i]
        pressure += value
        if paper:
            ws[part + k] += value * value
        else:
            ws[part + k] += value
    if paper:
        for k in range(4):
            ws[part + 4] += ws[part + k]
    else:
        for k in range(4):
            ws[part + k] = ws[part + k] ** 2
        ws[part + 4] = pressure * pressure
    return pressure


@kernel
def _a_weight(ps, ss, ws, lanes, weighted, n):
    """A-weight the ``n`` signals at ``ws[weighted]`` in place, lanes side by side."""
    x = ws[weighted : weighted + n]
    for section in range(3):
        at = int(ps[H_AT_A_WEIGHTING]) + 5 * section
        b0 = ps[at]
        b1 = ps[at + 1]
        b2 = ps[at + 2]
        a1 = ps[at + 3]
        a2 = ps[at + 4]
        state = lanes + 2 * n * section
        s1 = ss[state : state + n]
        s2 = ss[state + n : state + 2 * n]
        for c in range(n):
            value = b0 * x[c] + s1[c]
            s1[c] = b1 * x[c] - a1 * value + s2[c]
            s2[c] = b2 * x[c] - a2 * value
            x[c] = value


@kernel
def _decibel(mean_square):
    return 10.0 * math.log10((mean_square + _FLOOR) / _REFERENCE)


@kernel
def levels(ps, ss, z, offset):
    """Write the ``MIC_OUTPUTS`` of every microphone into ``z`` from ``offset`` on.

    Levels in dB re 20 uPa, never below -106 dB and always finite; the floor before metering has begun.
    """
    n = int(ps[H_CHANNELS])
    lanes = SS_TABLES + n * (DECIMATOR_TAPS + 2 + int(ps[H_ROWS]))
    meters = lanes + 6 * int(ps[H_LANES])
    count = 1.0
    weight = 1.0
    if ss[SS_METERED] > 0.0:
        count = ss[SS_METERED]
        weight = ss[SS_WEIGHT]
    for mic in range(int(ps[H_MICS])):
        at = meters + METER_SIZE * mic
        out = offset + _N_OUT * mic
        z[out] = ss[at + M_PRESSURE]
        z[out + 1] = _decibel(ss[at + M_FAST] / weight)
        z[out + 2] = _decibel(ss[at + M_FAST_A] / weight)
        z[out + 3] = _decibel(ss[at + M_SUM] / count)
        z[out + 4] = _decibel(ss[at + M_SUM_A] / count)
        for k in range(4):
            z[out + 5 + k] = _decibel(ss[at + M_PART + k] / weight)
