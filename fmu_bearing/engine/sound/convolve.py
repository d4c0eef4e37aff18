"""Filters: each bank of channels by a direct part, and by blocks in the frequency domain where it is long.

The direct form takes one sum per tap. The blocks are uniformly partitioned overlap-save convolution
(Stockham 1966; partitions: Kulp 1988): every B samples the last 2 B of all channels are transformed once,
multiplied by the spectra of all filters' parts, and the sums transformed back into the next B samples of
every output. A part of lags p B .. (p + 1) B - 1 needs p >= 1, so that its input is complete when its
output begins: shorter lags go by the direct form (Gardner 1995), and nothing comes later than without
blocks. Up to two block lengths share one filter, the longer for the later lags.

The work of a block falls on its first sample: one sample in B costs up to about B times the mean.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.sound.places import (
    BANK_AT_TAPS,
    BANK_AT_TARGETS,
    BANK_CHANNEL,
    BANK_COUNT,
    BANK_DELAY,
    BANK_LEVELS,
    BANK_SIZE,
    BANK_TAPS,
    H_AT_BANKS,
    H_AT_LEVELS,
    H_BANKS,
    H_CHANNELS,
    H_LEVELS,
    H_OUTPUTS,
    H_ROWS,
    H_S_CHANNELS,
    H_W_LANES,
    H_W_OUTPUTS,
    H_W_TRANSFORM,
    LEVEL_AT_TURNS,
    LEVEL_BLOCK,
    LEVEL_S_FUTURE,
    LEVEL_S_SPECTRA,
    LEVEL_SIZE,
    LEVEL_SLOTS,
    MAX_CHANNELS,
    PART_AT,
    PART_COUNT,
    PART_FIRST,
)
from fmu_bearing.engine.sound.transform import butterflies, fold, reversed_bits, unfold


@kernel
def convolve(ps, ss, ws, place, count):
    """Filter outputs of sample ``count``, whose channels stand in row ``place`` of the history."""
    n_out = int(ps[H_OUTPUTS])
    out = ws[int(ps[H_W_OUTPUTS]) : int(ps[H_W_OUTPUTS]) + n_out]
    for i in range(n_out):
        out[i] = 0.0
    banks = int(ps[H_AT_BANKS])
    for bank in range(int(ps[H_BANKS])):
        at = banks + BANK_SIZE * bank
        if ps[at + BANK_TAPS] > 0.0:
            _direct(ps, ss, ws, at, place, out)
    for level in range(int(ps[H_LEVELS])):
        at = int(ps[H_AT_LEVELS]) + LEVEL_SIZE * level
        block = int(ps[at + LEVEL_BLOCK])
        step = count % block
        if step == 0 and count > 0:
            _renew(ps, ss, ws, at, level, place, count // block - 1)
        future = int(ps[at + LEVEL_S_FUTURE]) + step * n_out
        row = ss[future : future + n_out]
        for i in range(n_out):
            out[i] += row[i]


@kernel
def _direct(ps, ss, ws, at, place, out):
    """Direct part of the bank described at ``ps[at]``, added to its outputs.

    Channels of a bank lie side by side in history and taps, so the inner loop is one vector loop without a
    running sum, the same on every machine.
    """
    n = int(ps[H_CHANNELS])
    rows = int(ps[H_ROWS])
    first = int(ps[H_S_CHANNELS]) + int(ps[at + BANK_CHANNEL])
    m = int(ps[at + BANK_COUNT])
    row = place - int(ps[at + BANK_DELAY])
    if row < 0:
        row += rows
    taps = int(ps[at + BANK_AT_TAPS])
    lanes = int(ps[H_W_LANES])
    y = ws[lanes : lanes + m]
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
    targets = int(ps[at + BANK_AT_TARGETS])
    for c in range(m):
        out[int(ps[targets + c])] += y[c]


@kernel
def _renew(ps, ss, ws, at, level, place, newest):
    """Transform the block of inputs that has just become complete, number ``newest``; fill the next outputs.

    ``place`` is the history's row of the sample after that block.
    """
    n = int(ps[H_CHANNELS])
    n_out = int(ps[H_OUTPUTS])
    rows = int(ps[H_ROWS])
    block = int(ps[at + LEVEL_BLOCK])
    slots = int(ps[at + LEVEL_SLOTS])
    table = int(ps[at + LEVEL_AT_TURNS])
    turns = ps[table : table + 2 * (block + 1)]
    work = int(ps[H_W_TRANSFORM])
    spectra = int(ps[at + LEVEL_S_SPECTRA])
    size = 2 * (block + 1) * n
    z = ws[work : work + 2 * block * n]
    row = place - 2 * block
    if row < 0:
        row += rows
    channels = int(ps[H_S_CHANNELS])
    for k in range(block):
        to = reversed_bits(k, block) * 2 * n
        for part in range(2):
            x = ss[channels + row * n : channels + (row + 1) * n]
            y = z[to + part * n : to + (part + 1) * n]
            for c in range(n):
                y[c] = x[c]
            row = row + 1 if row < rows - 1 else 0
    butterflies(z, n, block, turns, -1.0)
    slot = spectra + (newest % slots) * size
    unfold(z, n, block, turns, ss[slot : slot + size])
    total = ws[work : work + 2 * (block + 1) * n_out]
    for i in range(len(total)):
        total[i] = 0.0
    banks = int(ps[H_AT_BANKS])
    for bank in range(int(ps[H_BANKS])):
        b = banks + BANK_SIZE * bank
        if ps[b + BANK_LEVELS + 3 * level + PART_COUNT] > 0.0:
            _multiply(ps, ss, ws, b, level, block, slots, spectra, newest, total)
    z = ws[work + len(total) : work + len(total) + 2 * block * n_out]
    fold(total, n_out, block, turns, z)
    butterflies(z, n_out, block, turns, 1.0)
    future = int(ps[at + LEVEL_S_FUTURE])
    scale = 1.0 / block
    half = block // 2
    kept = z[half * 2 * n_out :]  # the second half of the circle is free of wrapped samples
    rows_out = ss[future : future + block * n_out]
    for i in range(len(rows_out)):
        rows_out[i] = scale * kept[i]


@kernel
def _multiply(ps, ss, ws, b, level, block, slots, spectra, newest, total):
    """Add what the parts of the bank at ``ps[b]`` make of the stored spectra to the outputs' ``total``."""
    n = int(ps[H_CHANNELS])
    n_out = int(ps[H_OUTPUTS])
    m = int(ps[b + BANK_COUNT])
    channel = int(ps[b + BANK_CHANNEL])
    parts = b + BANK_LEVELS + 3 * level
    first = int(ps[parts + PART_FIRST])
    n_parts = int(ps[parts + PART_COUNT])
    filters = int(ps[parts + PART_AT])
    targets = int(ps[b + BANK_AT_TARGETS])
    # Sums at two places a constant apart in one slice, two parts at a time: only so is it a vector loop.
    y = ws[int(ps[H_W_LANES]) : int(ps[H_W_LANES]) + 2 * MAX_CHANNELS]
    known = max(min(n_parts, newest + 2 - first), 0)  # before the first block there was silence
    step = (block + 1) * 2 * m
    for k in range(block + 1):
        for c in range(m):
            y[c] = 0.0
            y[MAX_CHANNELS + c] = 0.0
        h = filters + k * 2 * m
        for pair in range(known // 2):
            number = newest + 1 - first - 2 * pair
            p0 = spectra + ((number % slots) * (block + 1) + k) * 2 * n + channel
            p1 = spectra + (((number - 1) % slots) * (block + 1) + k) * 2 * n + channel
            xr = ss[p0 : p0 + m]
            xi = ss[p0 + n : p0 + n + m]
            hr = ps[h : h + m]
            hi = ps[h + m : h + 2 * m]
            vr = ss[p1 : p1 + m]
            vi = ss[p1 + n : p1 + n + m]
            gr = ps[h + step : h + step + m]
            gi = ps[h + step + m : h + step + 2 * m]
            h += 2 * step
            for c in range(m):
                y[c] += (hr[c] * xr[c] - hi[c] * xi[c]) + (gr[c] * vr[c] - gi[c] * vi[c])
                y[MAX_CHANNELS + c] += (hr[c] * xi[c] + hi[c] * xr[c]) + (gr[c] * vi[c] + gi[c] * vr[c])
        if known % 2 == 1:
            number = newest + 2 - first - known
            p0 = spectra + ((number % slots) * (block + 1) + k) * 2 * n + channel
            xr = ss[p0 : p0 + m]
            xi = ss[p0 + n : p0 + n + m]
            hr = ps[h : h + m]
            hi = ps[h + m : h + 2 * m]
            for c in range(m):
                y[c] += hr[c] * xr[c] - hi[c] * xi[c]
                y[MAX_CHANNELS + c] += hr[c] * xi[c] + hi[c] * xr[c]
        at = 2 * n_out * k
        for c in range(m):
            target = at + int(ps[targets + c])
            total[target] += y[c]
            total[target + n_out] += y[MAX_CHANNELS + c]
