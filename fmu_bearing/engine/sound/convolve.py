"""Filters: each bank of channels by a direct part, and by blocks in the frequency domain where it is long.

The direct form takes one sum per tap. The blocks are uniformly partitioned overlap-save convolution
(Stockham 1966; partitions: Kulp 1988): every B samples the last 2 B of all channels with long filters are
transformed once, multiplied by the spectra of all filters' parts, and the sums transformed back into the
next B samples of every output. Spectra lie one behind the other, so that each product is one vector loop
over frequencies and every filter has as many parts as its own length asks for. Up to two block lengths share
one filter, the longer for the later lags.

The work on a block of inputs is spread over the B samples that follow, in units of which every fourth sample
does its share (`acoustics.filters.shares`). First come the early units: the transforms and the products of
every filter's first part. The outputs need these `SPAN_WAIT` samples after the block's end, so a span serves
the lags from B + `SPAN_WAIT` on; shorter lags go by the direct form (Gardner 1995) or by the shorter blocks,
and nothing comes later than without blocks. Then come the late units: the products of all other parts, for
the block of outputs after the next. Without a wait the early units fall on one sample.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store, transposed
from fmu_bearing.engine.layout import FOUR, SD
from fmu_bearing.engine.sound.transform import combine, divide, fold, reversed_bits, unfold


@kernel
def in_fours(n):
    """Return ``n`` filled up to a multiple of four."""
    return (n + FOUR - 1) // FOUR * FOUR


@kernel
def convolve(ps, ss, ws, out, place, count):
    """Filter outputs ``out`` of sample ``count``, whose lanes are row ``place`` of the history."""
    n_out = len(out)
    for i in range(0, n_out, FOUR):
        store(out, i, splat(0.0))
    banks = int(ps[SD.H_AT_BANKS])
    for bank in range(int(ps[SD.H_BANKS])):
        at = banks + SD.BANK_SIZE * bank
        if ps[at + SD.BANK_TAPS] > 0.0:
            _direct(ps, ss, ws, at, place, out)
    for span in range(int(ps[SD.H_SPANS])):
        at = int(ps[SD.H_AT_SPANS]) + SD.SPAN_SIZE * span
        block = int(ps[at + SD.SPAN_BLOCK])
        step = count % block
        share = int(ps[at + SD.SPAN_AT_SHARES]) + step
        if count >= block and ps[share] < ps[share + 1]:
            _work(ps, ss, at, place - step, count // block - 1, int(ps[share]), int(ps[share + 1]))
        row = step - int(ps[at + SD.SPAN_WAIT])
        if row < 0:
            row += block
        future = int(ps[at + SD.SPAN_S_FUTURE]) + row * n_out
        for i in range(0, n_out, FOUR):
            store(out, i, load(out, i) + load(ss, future + i))


@kernel
def _direct(ps, ss, ws, at, place, out):
    """Direct part of the bank described at ``ps[at]``, added to its outputs.

    Lanes of a bank lie side by side in history and taps and go four by four, the last ones with lanes of
    other banks, whose sums nobody reads.
    """
    n = int(ps[SD.H_CHANNELS])
    rows = int(ps[SD.H_ROWS])
    first = int(ps[SD.H_S_CHANNELS]) + int(ps[at + SD.BANK_LANE])
    m = in_fours(int(ps[at + SD.BANK_COUNT]))
    row = place - int(ps[at + SD.BANK_DELAY])
    if row < 0:
        row += rows
    h = int(ps[at + SD.BANK_AT_TAPS])
    lanes = int(ps[SD.H_W_LANES])
    y = ws[lanes : lanes + m]
    for c in range(0, m, FOUR):
        store(y, c, splat(0.0))
    for _ in range(int(ps[at + SD.BANK_TAPS]) // FOUR):
        p0 = first + row * n
        row = row - 1 if row > 0 else rows - 1  # a remainder would cost more than the sums
        p1 = first + row * n
        row = row - 1 if row > 0 else rows - 1
        p2 = first + row * n
        row = row - 1 if row > 0 else rows - 1
        p3 = first + row * n
        row = row - 1 if row > 0 else rows - 1
        for c in range(0, m, FOUR):
            even = load(ps, h + c) * load(ss, p0 + c) + load(ps, h + m + c) * load(ss, p1 + c)
            odd = load(ps, h + 2 * m + c) * load(ss, p2 + c) + load(ps, h + 3 * m + c) * load(ss, p3 + c)
            store(y, c, load(y, c) + (even + odd))
        h += FOUR * m
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
def _work(ps, ss, at, place, newest, begin, end):
    """Do the units ``begin`` .. ``end`` - 1 on block ``newest``, whose inputs end before row ``place``."""
    early = int(ps[at + SD.SPAN_EARLY])
    if begin < early:
        _transform(ps, ss, at, place, newest, begin, min(end, early))
    jobs = int(ps[SD.H_OUTPUTS]) - early  # late ones come behind those of every output
    for unit in range(max(begin, early), end):
        _add_filters(ps, ss, at, jobs + unit, newest)


@kernel
def _transform(ps, ss, at, place, newest, begin, end):
    """Do early units: the transform, the products of first parts, and the transform back.

    Each of their kinds is counted from its own first one on.
    """
    n = in_fours(int(ps[at + SD.SPAN_LANES]))
    n_out = in_fours(int(ps[SD.H_OUTPUTS]))
    block = int(ps[at + SD.SPAN_BLOCK])
    half = block // 2
    stages = half * (int(ps[at + SD.SPAN_STAGES]) - 1)
    table = int(ps[at + SD.SPAN_AT_TURNS])
    turns = ps[table : table + 2 * (block + 1)]
    work = int(ps[at + SD.SPAN_S_TRANSFORM])
    z = ss[work : work + 2 * (block + 1) * max(n, n_out)]
    lanes = n // FOUR
    outputs = n_out // FOUR
    if begin < half:
        _gather(ps, ss, at, place, z, begin, min(end, half))
    first = half
    if begin < first + stages and end > first:
        combine(z, n, block, turns, begin - first, end - first)
    first += stages
    if begin <= first + half and end > first:
        unfold(z, n, block, turns, begin - first, end - first)
    first += half + 1
    if begin < first + lanes and end > first:
        _keep(ps, ss, at, newest, z, begin - first, end - first)
    first += lanes
    if begin < first + outputs and end > first:
        _finish(ps, ss, at, newest, z, begin - first, end - first)
    first += outputs
    if begin <= first + half and end > first:
        fold(z, n_out, block, turns, begin - first, end - first)
    first += half + 1
    if begin < first + stages and end > first:
        divide(z, n_out, block, turns, begin - first, end - first)
    first += stages
    if end > first:
        _put(ps, ss, at, z, begin - first, end - first)


@kernel
def _gather(ps, ss, at, place, z, begin, end):
    """Copy the span's lanes of the last two blocks before row ``place`` to ``z``, in bit-reversed order.

    The transform's first stage is done with it: the two rows that it combines are one block apart. Units:
    samples two by two.
    """
    lanes = int(ps[at + SD.SPAN_LANES])
    n = in_fours(lanes)
    block = int(ps[at + SD.SPAN_BLOCK])
    half = block // 2
    wide = 2 * n
    first = int(ps[at + SD.SPAN_AT_SEGMENTS])
    channels = int(ps[SD.H_S_CHANNELS])
    width = int(ps[SD.H_CHANNELS])
    rows = int(ps[SD.H_ROWS])
    for k in range(begin, end):
        to = 2 * reversed_bits(k, half) * wide
        for part in range(2):
            p = channels + (place - 2 * block + 2 * k + part + 2 * rows) % rows * width
            q = channels + (place - block + 2 * k + part + 2 * rows) % rows * width
            run = first
            for _ in range(int(ps[at + SD.SPAN_SEGMENTS])):
                lane = int(ps[run + SD.SEGMENT_LANE])
                m = int(ps[run + SD.SEGMENT_COUNT])
                run += SD.SEGMENT_SIZE
                a = ss[p + lane : p + lane + m]
                b = ss[q + lane : q + lane + m]
                x = z[to : to + m]
                y = z[to + wide : to + wide + m]
                for c in range(m):
                    x[c] = a[c] + b[c]
                for c in range(m):
                    y[c] = a[c] - b[c]
                to += m
            for spare in range(to, to + n - lanes):
                z[spare] = 0.0
                z[wide + spare] = 0.0
            to += n - lanes


@kernel
def _keep(ps, ss, at, newest, z, begin, end):
    """Copy the spectra in ``z`` to what is kept of block ``newest``; units: lanes four by four."""
    lanes = int(ps[at + SD.SPAN_LANES])
    n = in_fours(lanes)
    rows = int(ps[at + SD.SPAN_BLOCK]) + 1
    last = FOUR - 1
    for lane in range(FOUR * max(begin, 0), min(FOUR * end, lanes), FOUR):
        if lane + FOUR > lanes:
            for left in range(lane, lanes):
                p0 = _slot(ps, at, left, newest, rows)
                for k in range(rows):
                    ss[p0 + k] = z[2 * n * k + left]
                    ss[p0 + rows + k] = z[2 * n * k + n + left]
            return
        p0 = _slot(ps, at, lane, newest, rows)
        p1 = _slot(ps, at, lane + 1, newest, rows)
        p2 = _slot(ps, at, lane + 2, newest, rows)
        p3 = _slot(ps, at, lane + last, newest, rows)
        for part in range(2):
            of = part * n + lane
            to = part * rows
            for k in range(0, rows - 1, FOUR):
                x0, x1, x2, x3 = _square(z, 2 * n * k + of, 2 * n)
                store(ss, p0 + to + k, x0)
                store(ss, p1 + to + k, x1)
                store(ss, p2 + to + k, x2)
                store(ss, p3 + to + k, x3)
            to += rows - 1
            of += 2 * n * (rows - 1)
            ss[p0 + to] = z[of]
            ss[p1 + to] = z[of + 1]
            ss[p2 + to] = z[of + 2]
            ss[p3 + to] = z[of + last]


@kernel
def _square(z, at, step):
    """Four lanes of four rows of ``z``, ``step`` apart, as one vector per lane."""
    return transposed(load(z, at), load(z, at + step), load(z, at + 2 * step), load(z, at + 3 * step))


@kernel
def _slot(ps, at, lane, newest, rows):
    """Place of the spectrum of block ``newest`` of a lane."""
    past = int(ps[at + SD.SPAN_AT_PAST]) + SD.PAST_SIZE * lane
    return int(ps[past + SD.PAST_S_SPECTRA]) + 2 * rows * (newest % int(ps[past + SD.PAST_SLOTS]))


@kernel
def _put(ps, ss, at, z, begin, end):
    """Write the next outputs: the last stage of the transform back, for what has not wrapped round.

    Units: samples two by two. The rows of ``z`` are bit-reversed.
    """
    wide = 2 * in_fours(int(ps[SD.H_OUTPUTS]))
    block = int(ps[at + SD.SPAN_BLOCK])
    half = block // 2
    scale = 1.0 / block
    future = int(ps[at + SD.SPAN_S_FUTURE])
    for k in range(max(begin, 0), end):
        p = 2 * reversed_bits(k, half) * wide
        q = p + wide
        for i in range(0, wide, FOUR):
            store(ss, future + wide * k + i, scale * (load(z, p + i) - load(z, q + i)))


@kernel
def _finish(ps, ss, at, newest, z, begin, end):
    """Spectra of outputs, written to ``z``: what is prepared, and the first parts with block ``newest``.

    Units: outputs four by four.
    """
    outputs = int(ps[SD.H_OUTPUTS])
    n = in_fours(outputs)
    rows = int(ps[at + SD.SPAN_BLOCK]) + 1
    gap = SD.MAX_FREQUENCIES
    last = FOUR - 1
    for output in range(FOUR * max(begin, 0), min(FOUR * end, outputs), FOUR):
        if output + FOUR > outputs:
            for left in range(output, outputs):
                y0 = _add_filters(ps, ss, at, left, newest)
                for k in range(rows):
                    z[2 * n * k + left] = y0[k]
                    z[2 * n * k + n + left] = y0[gap + k]
            for spare in range(outputs, n):
                for k in range(rows):
                    z[2 * n * k + spare] = 0.0
                    z[2 * n * k + n + spare] = 0.0
            return
        y0 = _add_filters(ps, ss, at, output, newest)
        y1 = _add_filters(ps, ss, at, output + 1, newest)
        y2 = _add_filters(ps, ss, at, output + 2, newest)
        y3 = _add_filters(ps, ss, at, output + last, newest)
        for part in range(2):
            to = part * n + output
            of = part * gap
            for k in range(of, of + rows - 1, FOUR):
                x0, x1, x2, x3 = transposed(load(y0, k), load(y1, k), load(y2, k), load(y3, k))
                store(z, to, x0)
                store(z, to + 2 * n, x1)
                store(z, to + 4 * n, x2)
                store(z, to + 6 * n, x3)
                to += FOUR * 2 * n
            of += rows - 1
            z[to] = y0[of]
            z[to + 1] = y1[of]
            z[to + 2] = y2[of]
            z[to + last] = y3[of]


@kernel
def _add_filters(ps, ss, at, job, newest):
    """Add parts with blocks up to ``newest`` to the sums of an output, and return these.

    Slots not yet filled are silent.
    """
    row = int(ps[at + SD.SPAN_AT_JOBS]) + SD.JOB_SIZE * job
    rows = int(ps[at + SD.SPAN_BLOCK]) + 1
    sums = int(ps[at + SD.SPAN_S_SUMS]) + int(ps[row + SD.JOB_SUMS])
    y = ss[sums : sums + SD.MAX_FREQUENCIES + rows]
    if ps[row + SD.JOB_ADDS] == 0.0:
        for k in range(rows):
            y[k] = 0.0
            y[SD.MAX_FREQUENCIES + k] = 0.0
    one = int(ps[row + SD.JOB_AT_FILTERS])
    for _ in range(int(ps[row + SD.JOB_FILTERS])):
        past = int(ps[at + SD.SPAN_AT_PAST]) + SD.PAST_SIZE * int(ps[one + SD.FILTER_LANE])
        slots = int(ps[past + SD.PAST_SLOTS])
        slot = newest % slots - int(ps[one + SD.FILTER_BACK])
        if slot < 0:
            slot += slots
        _add_parts(ps, ss, y, one, int(ps[past + SD.PAST_S_SPECTRA]), slot, slots, rows)
        one += SD.FILTER_SIZE
    return y


@kernel
def _add_parts(ps, ss, y, row, spectra, slot, slots, rows):
    """Add one filter's parts times the stored spectra of its lane, from ``slot`` on back, to the sums ``y``.

    Two parts at a time, frequencies four by four; the last one, half the rate, is one more.
    """
    count = int(ps[row + SD.FILTER_COUNT])
    h = int(ps[row + SD.FILTER_AT])
    last = rows - 1
    for _ in range(count // 2):
        p = spectra + 2 * rows * slot
        slot = slot - 1 if slot > 0 else slots - 1
        q = spectra + 2 * rows * slot
        slot = slot - 1 if slot > 0 else slots - 1
        g = h + 2 * rows
        for k in range(0, last, FOUR):
            xr, xi, hr, hi = load(ss, p + k), load(ss, p + rows + k), load(ps, h + k), load(ps, h + rows + k)
            vr, vi, gr, gi = load(ss, q + k), load(ss, q + rows + k), load(ps, g + k), load(ps, g + rows + k)
            store(y, k, load(y, k) + ((hr * xr - hi * xi) + (gr * vr - gi * vi)))
            to = SD.MAX_FREQUENCIES + k
            store(y, to, load(y, to) + ((hr * xi + hi * xr) + (gr * vi + gi * vr)))
        y[last] += ps[h + last] * ss[p + last] + ps[g + last] * ss[q + last]
        h = g + 2 * rows
    if count % 2 == 1:
        p = spectra + 2 * rows * slot
        for k in range(0, last, FOUR):
            xr, xi, hr, hi = load(ss, p + k), load(ss, p + rows + k), load(ps, h + k), load(ps, h + rows + k)
            store(y, k, load(y, k) + (hr * xr - hi * xi))
            to = SD.MAX_FREQUENCIES + k
            store(y, to, load(y, to) + (hr * xi + hi * xr))
        y[last] += ps[h + last] * ss[p + last]
