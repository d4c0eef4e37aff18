"""Filters: each bank of channels by a direct part, and by blocks in the frequency domain where it is long.

The direct form takes one sum per tap. The blocks are uniformly partitioned overlap-save convolution
(Stockham 1966; partitions: Kulp 1988): every B samples the last 2 B of all channels with long filters are
transformed once, multiplied by the spectra of all filters' parts, and the sums transformed back into the
next B samples of every output. Spectra lie one behind the other, so that each product is one vector loop
over frequencies and every filter has as many parts as its own length asks for. A part of lags p B ..
(p + 1) B - 1 needs p >= 1, so that its input is complete when its output begins: shorter lags go by the
direct form (Gardner 1995), and nothing comes later than without blocks. Up to
two block lengths share one filter, the longer for the later lags.

The work of a block falls on its first sample: one sample in B costs up to about B times the mean.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR, SD
from fmu_bearing.engine.sound.transform import butterflies, fold, reversed_bits, unfold


@kernel
def convolve(ps, ss, ws, place, count):
    """Filter outputs of sample ``count``, whose lanes are row ``place`` of the history."""
    n_out = int(ps[SD.H_OUTPUTS])
    out = ws[int(ps[SD.H_W_OUTPUTS]) : int(ps[SD.H_W_OUTPUTS]) + n_out]
    for i in range(n_out):
        out[i] = 0.0
    banks = int(ps[SD.H_AT_BANKS])
    for bank in range(int(ps[SD.H_BANKS])):
        at = banks + SD.BANK_SIZE * bank
        if ps[at + SD.BANK_TAPS] > 0.0:
            _direct(ps, ss, ws, at, place, out)
    for span in range(int(ps[SD.H_SPANS])):
        at = int(ps[SD.H_AT_SPANS]) + SD.SPAN_SIZE * span
        block = int(ps[at + SD.SPAN_BLOCK])
        step = count % block
        if step == 0 and count > 0:
            _renew(ps, ss, ws, at, place, count // block - 1)
        future = int(ps[at + SD.SPAN_S_FUTURE]) + step * n_out
        row = ss[future : future + n_out]
        for i in range(n_out):
            out[i] += row[i]


@kernel
def _direct(ps, ss, ws, at, place, out):
    """Direct part of the bank described at ``ps[at]``, added to its outputs.

    Lanes of a bank lie side by side in history and taps, so the inner loop is one vector loop without a
    running sum, the same on every machine.
    """
    n = int(ps[SD.H_CHANNELS])
    rows = int(ps[SD.H_ROWS])
    first = int(ps[SD.H_S_CHANNELS]) + int(ps[at + SD.BANK_LANE])
    m = int(ps[at + SD.BANK_COUNT])
    row = place - int(ps[at + SD.BANK_DELAY])
    if row < 0:
        row += rows
    h = int(ps[at + SD.BANK_AT_TAPS])
    lanes = int(ps[SD.H_W_LANES])
    y = ws[lanes : lanes + m]
    for c in range(m):
        y[c] = 0.0
    for _ in range(int(ps[at + SD.BANK_TAPS]) // FOUR):
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
        h0 = ps[h : h + m]
        h += m
        h1 = ps[h : h + m]
        h += m
        h2 = ps[h : h + m]
        h += m
        h3 = ps[h : h + m]
        h += m
        for c in range(m):
            y[c] += (h0[c] * x0[c] + h1[c] * x1[c]) + (h2[c] * x2[c] + h3[c] * x3[c])
    run = int(ps[at + SD.BANK_AT_RUNS])
    c = 0
    for _ in range(int(ps[at + SD.BANK_RUNS])):
        count = int(ps[run + SD.RUN_COUNT])
        even = 0.0
        odd = 0.0
        for _ in range(count // 2):
            even += y[c]
            odd += y[c + 1]
            c += 2
        if count % 2 == 1:
            even += y[c]
            c += 1
        out[int(ps[run + SD.RUN_OUTPUT])] += even + odd
        run += SD.RUN_SIZE


@kernel
def _renew(ps, ss, ws, at, place, newest):
    """Transform the block of inputs that has just become complete, number ``newest``; fill the next outputs.

    ``place`` is the history's row of the sample after that block.
    """
    n = int(ps[at + SD.SPAN_LANES])
    n_out = int(ps[SD.H_OUTPUTS])
    block = int(ps[at + SD.SPAN_BLOCK])
    table = int(ps[at + SD.SPAN_AT_TURNS])
    turns = ps[table : table + 2 * (block + 1)]
    work = int(ps[SD.H_W_TRANSFORM])
    past = int(ps[at + SD.SPAN_AT_PAST])
    rows = block + 1
    z = ws[work : work + 2 * block * n]
    x = ws[work + 2 * block * n : work + 2 * (block + rows) * n]
    _gather(ps, ss, at, place, z)
    butterflies(z, n, block, turns, -1.0)
    unfold(z, n, block, turns, x)
    for lane in range(n):
        slot = newest % int(ps[past + SD.PAST_SLOTS])
        first = int(ps[past + SD.PAST_S_SPECTRA]) + 2 * rows * slot
        spectrum = ss[first : first + 2 * rows]
        for k in range(rows):
            spectrum[k] = x[2 * n * k + lane]
            spectrum[rows + k] = x[2 * n * k + n + lane]
        past += SD.PAST_SIZE
    total = ws[work : work + 2 * rows * n_out]
    _multiply(ps, ss, ws, at, newest, total)
    z = ws[work + len(total) : work + len(total) + 2 * block * n_out]
    fold(total, n_out, block, turns, z)
    butterflies(z, n_out, block, turns, 1.0)
    future = int(ps[at + SD.SPAN_S_FUTURE])
    scale = 1.0 / block
    half = block // 2
    after = z[half * 2 * n_out :]  # the second half of the circle is free of wrapped samples
    rows_out = ss[future : future + block * n_out]
    for i in range(len(rows_out)):
        rows_out[i] = scale * after[i]


@kernel
def _gather(ps, ss, at, place, z):
    """Copy the span's lanes of the last two blocks before row ``place`` to ``z``, in bit-reversed order."""
    n = int(ps[at + SD.SPAN_LANES])
    block = int(ps[at + SD.SPAN_BLOCK])
    segments = int(ps[at + SD.SPAN_AT_SEGMENTS])
    channels = int(ps[SD.H_S_CHANNELS])
    width = int(ps[SD.H_CHANNELS])
    rows = int(ps[SD.H_ROWS])
    row = place - 2 * block
    if row < 0:
        row += rows
    for k in range(block):
        to = reversed_bits(k, block) * 2 * n
        for _ in range(2):
            for segment in range(int(ps[at + SD.SPAN_SEGMENTS])):
                run = segments + SD.SEGMENT_SIZE * segment
                lane = channels + row * width + int(ps[run + SD.SEGMENT_LANE])
                count = int(ps[run + SD.SEGMENT_COUNT])
                x = ss[lane : lane + count]
                y = z[to : to + count]
                for c in range(count):
                    y[c] = x[c]
                to += count
            row = row + 1 if row < rows - 1 else 0


@kernel
def _multiply(ps, ss, ws, at, newest, total):
    """Write the outputs' spectra ``total``: the sums over all filters of the span at ``ps[at]``.

    ``newest`` is the number of the block that has just been transformed. Slots not yet filled are silent.
    """
    block = int(ps[at + SD.SPAN_BLOCK])
    n_out = int(ps[SD.H_OUTPUTS])
    n_filters = int(ps[at + SD.SPAN_FILTERS])
    rows = block + 1
    row = int(ps[at + SD.SPAN_AT_FILTERS])
    y = ws[int(ps[SD.H_W_LANES]) : int(ps[SD.H_W_LANES]) + 2 * SD.MAX_FREQUENCIES]
    left = n_filters
    for output in range(n_out):
        for k in range(rows):
            y[k] = 0.0
            y[SD.MAX_FREQUENCIES + k] = 0.0
        while left > 0 and int(ps[row + SD.FILTER_OUTPUT]) == output:
            past = int(ps[at + SD.SPAN_AT_PAST]) + SD.PAST_SIZE * int(ps[row + SD.FILTER_LANE])
            slots = int(ps[past + SD.PAST_SLOTS])
            spectra = int(ps[past + SD.PAST_S_SPECTRA])
            slot = newest % slots + 1 - int(ps[row + SD.FILTER_FIRST])
            if slot < 0:
                slot += slots
            _add_parts(ps, ss, y, row, spectra, slot, slots, rows)
            row += SD.FILTER_SIZE
            left -= 1
        for k in range(rows):
            total[2 * n_out * k + output] = y[k]
            total[2 * n_out * k + n_out + output] = y[SD.MAX_FREQUENCIES + k]


@kernel
def _add_parts(ps, ss, y, row, spectra, slot, slots, rows):
    """Add one filter's parts times the stored spectra of its lane, from ``slot`` on back, to the sums ``y``.

    Sums at two places a constant apart in one slice, two parts at a time: only so is it a vector loop.
    """
    count = int(ps[row + SD.FILTER_COUNT])
    h = int(ps[row + SD.FILTER_AT])
    for _ in range(count // 2):
        p0 = spectra + 2 * rows * slot
        slot = slot - 1 if slot > 0 else slots - 1
        p1 = spectra + 2 * rows * slot
        slot = slot - 1 if slot > 0 else slots - 1
        xr = ss[p0 : p0 + rows]
        xi = ss[p0 + rows : p0 + 2 * rows]
        hr = ps[h : h + rows]
        hi = ps[h + rows : h + 2 * rows]
        h += 2 * rows
        vr = ss[p1 : p1 + rows]
        vi = ss[p1 + rows : p1 + 2 * rows]
        gr = ps[h : h + rows]
        gi = ps[h + rows : h + 2 * rows]
        h += 2 * rows
        for k in range(rows):
            y[k] += (hr[k] * xr[k] - hi[k] * xi[k]) + (gr[k] * vr[k] - gi[k] * vi[k])
            y[SD.MAX_FREQUENCIES + k] += (hr[k] * xi[k] + hi[k] * xr[k]) + (gr[k] * vi[k] + gi[k] * vr[k])
    if count % 2 == 1:
        p0 = spectra + 2 * rows * slot
        xr = ss[p0 : p0 + rows]
        xi = ss[p0 + rows : p0 + 2 * rows]
        hr = ps[h : h + rows]
        hi = ps[h + rows : h + 2 * rows]
        for k in range(rows):
            y[k] += hr[k] * xr[k] - hi[k] * xi[k]
            y[SD.MAX_FREQUENCIES + k] += hr[k] * xi[k] + hi[k] * xr[k]
