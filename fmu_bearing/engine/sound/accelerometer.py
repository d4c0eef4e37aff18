"""Accelerometers: motion samples through the chain of the microphones, then resonances and meters.

A block of accelerometers is a sound block of form sensors: its channels are the accelerations of the body at
each sensor, and what the seat passes on to the structure. `radiate` decimates and filters them. What its
filters leave out are poles: each output passes a resonator, a mode of the structure or none, and the sum of a
sensor's outputs passes that of the mounted sensor. Finite filters would have to ring as long as these do.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD, P, S, W, Z
from fmu_bearing.engine.sound.convolve import in_fours
from fmu_bearing.engine.sound.meter import begun
from fmu_bearing.engine.sound.radiate import filtered, push, waiting

_LEAST = 1e-300  # m2/s4: a variance below is none


@kernel
def block_of(p):
    """Return the block of accelerometers of a bearing's parameters; empty: it carries none."""
    return p[int(p[P.AT_SENSORS]) : int(p[P.AT_SENSORS]) + int(p[P.SENSORS_SIZE])]


@kernel
def state_of(p, s):
    """Return the state of a bearing's accelerometers."""
    return s[S.SOUND + int(p[P.SENSORS_STATE]) :]


@kernel
def sense(p, s, w, metering_start):
    """Take the motion sample in ``W.MOTION`` of a bearing that may carry accelerometers."""
    if p[P.SENSORS_SIZE] == 0.0:
        return
    push(block_of(p), state_of(p, s), w[W.MOTION : W.SOUND])
    if waiting(state_of(p, s)) >= SD.BATCH:
        settle(p, s, w, metering_start)


@kernel
def settle(p, s, w, metering_start):
    """Let all samples that wait pass filters, resonators and meters of a bearing's accelerometers."""
    if p[P.SENSORS_SIZE] == 0.0:
        return
    ps, ss = block_of(p), state_of(p, s)
    ws = w[W.SOUND + int(p[P.SENSORS_WORK]) :]
    batch = filtered(ps, ss, ws)
    pitch = in_fours(int(ps[SD.H_OUTPUTS]))
    for k in range(batch):
        out = int(ps[SD.H_W_OUTPUTS]) + k * pitch
        _ring(ps, ss, ws[out : out + pitch])
        if begun(ss[SD.SS_COUNT], metering_start):
            ss[SD.SS_METERED] += 1.0
            _meter(ps, ss)
        ss[SD.SS_COUNT] += 1.0


@kernel
def _resonate(ps, at, ss, state, x):
    """Return the next number of an all-pole section at ``ps[at:]`` for ``x``."""
    value = x - ps[at] * ss[state] - ps[at + 1] * ss[state + 1]
    ss[state + 1] = ss[state]
    ss[state] = value
    return value


@kernel
def _ring(ps, ss, out):
    """Put the accelerations (m/s2) of one sample's filter outputs ``out`` to the first row of the meters."""
    sensors, outputs = int(ps[SD.H_MICS]), int(ps[SD.H_OUTPUTS])
    last = int(ps[SD.H_S_METERS]) + SD.A_LAST * sensors
    at, state = int(ps[SD.H_AT_RESONATORS]), int(ps[SD.H_S_RESONATORS])
    for i in range(sensors):
        ss[last + i] = 0.0
    for o in range(outputs):
        place = SD.RESONATOR * o
        value = _resonate(ps, at + place, ss, state + place, out[o])
        ss[last + int(ps[int(ps[SD.H_AT_OUTPUTS]) + o])] += value
    for i in range(sensors):
        place = SD.RESONATOR * (outputs + i)
        ss[last + i] = _resonate(ps, at + place, ss, state + place, ss[last + i])


@kernel
def _meter(ps, ss):
    """Add one sample to the sums of powers, and keep the largest amount."""
    n = int(ps[SD.H_MICS])
    at = int(ps[SD.H_S_METERS])
    for i in range(at, at + n):
        a = ss[i + SD.A_LAST * n]
        power = 1.0
        for row in range(SD.A_SUM, SD.A_PEAK):
            power *= a
            ss[i + row * n] += power
        ss[i + SD.A_PEAK * n] = max(ss[i + SD.A_PEAK * n], abs(a))


@kernel
def observe(p, s, z, first):
    """Write `Z.ACCELEROMETER_OUTPUTS` of a bearing's accelerometers; ``first``: place of the scene's first.

    Rms and peak are zero before metering has begun, and kurtosis is where nothing varies.
    """
    if p[P.SENSORS_SIZE] == 0.0:
        return
    ps, ss = block_of(p), state_of(p, s)
    n = int(ps[SD.H_MICS])
    count = max(ss[SD.SS_METERED], 1.0)
    for i in range(n):
        at = int(ps[SD.H_S_METERS]) + i
        to = first + Z.PER_ACCELEROMETER * int(ps[int(ps[SD.H_AT_ORDER]) + i])
        mean = ss[at + SD.A_SUM * n] / count
        square = ss[at + SD.A_SQUARE * n] / count
        cube = ss[at + SD.A_CUBE * n] / count
        fourth = ss[at + SD.A_FOURTH * n] / count
        variance = square - mean * mean
        about = fourth - mean * (4.0 * cube - mean * (6.0 * square - 3.0 * mean * mean))
        z[to + Z.ACCELERATION] = ss[at + SD.A_LAST * n]
        z[to + Z.ACCELERATION_RMS] = math.sqrt(square)
        z[to + Z.ACCELERATION_PEAK] = ss[at + SD.A_PEAK * n]
        varies = variance > _LEAST and variance > 1e-12 * square
        z[to + Z.KURTOSIS] = about / (variance * variance) if varies else 0.0
