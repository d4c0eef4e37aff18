"""From the channels of one line to the pressure at every microphone, by the transfer functions.

A line is a sound of one frequency: its channels are complex numbers, real part of value times exp(i phase).
Transfer functions are cubics between nodes, their flight taken out.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD, SL

_BINS = 1.0 / (2.0 * PI * SD.NODE_STEP)


@kernel
def clear_channels(ps, ws):
    """Set the channels of the next line to zero."""
    at = int(ps[SD.H_W_CHANNELS])
    wide = int(ps[SD.H_CHANNELS])
    for i in range(2 * wide):
        ws[at + i] = 0.0
    ws[at + 2 * wide] = wide
    ws[at + 2 * wide + 1] = -1.0


@kernel
def add_channel(ps, ws, channel, value):
    """Add a complex number to a channel of the line."""
    wide = int(ps[SD.H_CHANNELS])
    at = int(ps[SD.H_W_CHANNELS])
    ws[at + channel] += value.real
    ws[at + wide + channel] += value.imag
    at += 2 * wide
    ws[at] = min(ws[at], channel)
    ws[at + 1] = max(ws[at + 1], channel)


@kernel
def lower_limit(ps, omega):
    """Complex response of the microphones' high-pass (`sound.high_pass`) at ``omega`` (rad/s)."""
    at = int(ps[SD.H_AT_HIGH_PASS])
    follow, steer = ps[at + SD.HIGH_PASS_FOLLOW], ps[at + SD.HIGH_PASS_STEER]
    # z - 1
    re = math.cos(omega / SD.RATE) - 1.0
    im = math.sin(omega / SD.RATE)
    top_re, top_im = re * re - im * im, 2.0 * re * im
    low_re = top_re + (follow + steer) * re + steer
    low_im = top_im + (follow + steer) * im
    per = ps[at + SD.HIGH_PASS_GAIN] / (low_re * low_re + low_im * low_im)
    return per * (top_re * low_re + top_im * low_im), per * (top_im * low_re - top_re * low_im)


@kernel
def section_gain(ps, at, stride, c1, s1):
    """Squared magnitude of a section's response; its numbers at ``ps[at:]``, ``stride`` apart.

    ``c1``, ``s1``: cosine and sine of the phase from sample to sample.
    """
    c2, s2 = c1 * c1 - s1 * s1, 2.0 * s1 * c1
    b0, b1, b2 = ps[at + SD.B0 * stride], ps[at + SD.B1 * stride], ps[at + SD.B2 * stride]
    a1, a2 = ps[at + SD.A1 * stride], ps[at + SD.A2 * stride]
    top = (b0 + b1 * c1 + b2 * c2) ** 2 + (b1 * s1 + b2 * s2) ** 2
    return top / ((1.0 + a1 * c1 + a2 * c2) ** 2 + (a1 * s1 + a2 * s2) ** 2)


@kernel
def write_gains(ps, ws, to, omega):
    """Write squared magnitudes of the meters' filters at ``omega`` (rad/s) to ``ws[to:]``: see `SL`."""
    c1, s1 = math.cos(omega / SD.RATE), math.sin(omega / SD.RATE)
    gain = 1.0
    for section in range(SD.A_SECTIONS):
        gain *= section_gain(ps, int(ps[SD.H_AT_A_WEIGHTING]) + SD.SECTION * section, 1, c1, s1)
    ws[to + SL.GAIN_A] = gain
    for band in range(int(ps[SD.H_BANDS])):
        gain = 1.0
        for section in range(SD.BAND_SECTIONS):
            at = int(ps[SD.H_AT_BANDS]) + SD.SECTION * SD.BAND_LANES * section + band
            gain *= section_gain(ps, at, SD.BAND_LANES, c1, s1)
        ws[to + SL.GAIN_BANDS + band] = gain


@kernel
def bound(ps, ws, omega):
    """Return a bound on the root of a line's squared pressures (Pa2), summed over the microphones.

    The line whose channels are in ``ws``.
    """
    node = int(abs(omega) * _BINS)
    if node >= SD.NODES - 1:
        return 0.0
    wide = int(ps[SD.H_CHANNELS])
    channels = int(ps[SD.H_W_CHANNELS])
    bounds = int(ps[SD.H_AT_BOUNDS]) + node // SD.BOUND_NODES * wide
    total = 0.0
    for channel in range(int(ws[channels + 2 * wide]), int(ws[channels + 2 * wide + 1]) + 1):
        size = abs(ws[channels + channel]) + abs(ws[channels + wide + channel])
        total += size * ps[bounds + channel]
    return total


@kernel
def radiate(ps, ws, omega):
    """Put the pressures of the line whose channels are in ``ws`` to its rows there, at ``omega`` (rad/s).

    Whether it is within the microphones' band.
    """
    n = int(ps[SD.H_MICS])
    rows = int(ps[SD.H_W_ROWS])
    size = SL.ROW_ALONE * n
    for i in range(2 * size):
        ws[rows + i] = 0.0
    place = abs(omega) * _BINS
    node = int(place)
    if node >= SD.NODES - 1:
        return False
    sign = 1.0 if omega >= 0.0 else -1.0  # a line that turns backwards is the conjugate of one forwards
    limit_re, limit_im = lower_limit(ps, abs(omega))
    t = place - node
    u = 1.0 - t
    weights = u * u * (1.0 + 2.0 * t), t * u * u, t * t * (1.0 + 2.0 * u), -t * t * u
    outputs = int(ps[SD.H_W_OUTPUTS])
    for i in range(2 * int(ps[SD.H_OUTPUTS])):
        ws[outputs + i] = 0.0
    for group in range(int(ps[SD.H_GROUPS])):
        g = int(ps[SD.H_AT_GROUPS]) + SD.GROUP_SIZE * group
        late = abs(omega) * ps[g + SD.GROUP_FLIGHT]
        co, si = math.cos(late), -math.sin(late)
        turn = limit_re * co - limit_im * si, sign * (limit_re * si + limit_im * co)
        _add_rays(ps, ws, g, node, weights, turn, sign)
        _share(ps, ws, g)
    return True


@kernel
def _add_rays(ps, ws, g, node, weights, turn, sign):
    """Add the paths of one group, times ``turn``, to the outputs."""
    value0, slope0, value1, slope1 = weights
    turn_re, turn_im = turn
    channels = int(ps[SD.H_W_CHANNELS])
    wide = int(ps[SD.H_CHANNELS])
    outputs = int(ps[SD.H_W_OUTPUTS])
    high = int(ps[SD.H_OUTPUTS])
    first = int(ps[g + SD.GROUP_AT_FIRST])
    begin = int(ps[first + int(ws[channels + 2 * wide])])
    end = int(ps[first + int(ws[channels + 2 * wide + 1]) + 1])
    for ray in range(begin, end):
        r = int(ps[g + SD.GROUP_AT_RAYS]) + SD.RAY_SIZE * ray
        channel = channels + int(ps[r + SD.RAY_CHANNEL])
        re, im = ws[channel], ws[channel + wide]
        if re == 0.0 and im == 0.0:
            continue
        a = int(ps[r + SD.RAY_AT_NODES]) + SD.NODE_SIZE * node
        b = a + SD.NODE_SIZE
        factor = ps[r + SD.RAY_FACTOR]
        hr = value0 * ps[a + SD.NODE_REAL] + slope0 * ps[a + SD.NODE_REAL_SLOPE]
        hr = factor * (hr + value1 * ps[b + SD.NODE_REAL] + slope1 * ps[b + SD.NODE_REAL_SLOPE])
        hi = value0 * ps[a + SD.NODE_IMAGINARY] + slope0 * ps[a + SD.NODE_IMAGINARY_SLOPE]
        hi += value1 * ps[b + SD.NODE_IMAGINARY] + slope1 * ps[b + SD.NODE_IMAGINARY_SLOPE]
        hi *= sign * factor
        gr, gi = hr * turn_re - hi * turn_im, hr * turn_im + hi * turn_re
        to = outputs + int(ps[r + SD.RAY_OUTPUT])
        ws[to] += gr * re - gi * im
        ws[to + high] += gr * im + gi * re


@kernel
def _share(ps, ws, g):
    """Add the outputs of one group to the rows of its microphones: total, component, kind."""
    n = int(ps[SD.H_MICS])
    rows = int(ps[SD.H_W_ROWS])
    imaginary = SL.ROW_ALONE * n
    outputs = int(ps[SD.H_W_OUTPUTS])
    first, lane = int(ps[g + SD.GROUP_FIRST]), int(ps[g + SD.GROUP_LANE])
    mics, weights = int(ps[g + SD.GROUP_MICS]), int(ps[g + SD.GROUP_AT_WEIGHTS])
    for o in range(int(ps[g + SD.GROUP_COUNT])):
        re = ws[outputs + first + o]
        im = ws[outputs + int(ps[SD.H_OUTPUTS]) + first + o]
        if re == 0.0 and im == 0.0:
            continue
        source = int(ps[int(ps[SD.H_AT_OUTPUTS]) + first + o])
        at = int(ps[SD.H_AT_SOURCES]) + SD.SOURCE_SIZE * source
        part = rows + (SL.ROW_PART + int(ps[at + SD.SOURCE_COMPONENT])) * n + lane
        kind = SL.ROW_KIND + int(ps[at + SD.SOURCE_KIND])
        for i in range(mics):
            by = ps[weights + o * mics + i]
            total = rows + SL.ROW_TOTAL * n + lane + i
            ws[total] += by * re
            ws[total + imaginary] += by * im
            ws[part + i] += by * re
            ws[part + i + imaginary] += by * im
            if kind < SL.ROW_ALONE:
                same = rows + kind * n + lane + i
                ws[same] += by * re
                ws[same + imaginary] += by * im
