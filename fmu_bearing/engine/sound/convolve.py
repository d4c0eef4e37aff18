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
from fmu_bearing.engine.layout import FOUR, SD
from fmu_bearing.engine.sound.transform import combine, divide, fold, reversed_bits, unfold


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
        share = int(ps[at + SD.SPAN_AT_SHARES]) + step
        if count >= block and ps[share] < ps[share + 1]:
            _work(ps, ss, at, place - step, count // block - 1, int(ps[share]), int(ps[share + 1]))
        row = step - int(ps[at + SD.SPAN_WAIT])
        if row < 0:
            row += block
        future = int(ps[at + SD.SPAN_S_FUTURE]) + row * n_out
        y = ss[future : future + n_out]
        for i in range(n_out):
            out[i] += y[i]


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
    n = int(ps[at + SD.SPAN_LANES])
    n_out = int(ps[SD.H_OUTPUTS])
    block = int(ps[at + SD.SPAN_BLOCK])
    half = block // 2
    stages = half * (int(ps[at + SD.SPAN_STAGES]) - 1)
    table = int(ps[at + SD.SPAN_AT_TURNS])
    turns = ps[table : table + 2 * (block + 1)]
    work = int(ps[at + SD.SPAN_S_TRANSFORM])
    z = ss[work : work + 2 * (block + 1) * max(n, n_out)]
    lanes = (n + FOUR - 1) // FOUR
    outputs = (n_out + FOUR - 1) // FOUR
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
    n = int(ps[at + SD.SPAN_LANES])
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


@kernel
def _keep(ps, ss, at, newest, z, begin, end):
    """Copy the spectra in ``z`` to what is kept of block ``newest``; units: lanes four by four."""
    n = int(ps[at + SD.SPAN_LANES])
    rows = int(ps[at + SD.SPAN_BLOCK]) + 1
    last = FOUR - 1
    for lane in range(FOUR * max(begin, 0), min(FOUR * end, n), FOUR):
        if lane + FOUR > n:
            for left in range(lane, n):
                p0 = _slot(ps, at, left, newest, rows)
                for k in range(rows):
                    ss[p0 + k] = z[2 * n * k + left]
                    ss[p0 + rows + k] = z[2 * n * k + n + left]
            return
        p0 = _slot(ps, at, lane, newest, rows)
        p1 = _slot(ps, at, lane + 1, newest, rows)
        p2 = _slot(ps, at, lane + 2, newest, rows)
        p3 = _slot(ps, at, lane + last, newest, rows)
        for k in range(rows):
            x = z[2 * n * k + lane :]
            ss[p0 + k] = x[0]
            ss[p1 + k] = x[1]
            ss[p2 + k] = x[2]
            ss[p3 + k] = x[last]
            ss[p0 + rows + k] = x[n]
            ss[p1 + rows + k] = x[n + 1]
            ss[p2 + rows + k] = x[n + 2]
            ss[p3 + rows + k] = x[n + last]


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
    wide = 2 * int(ps[SD.H_OUTPUTS])
    block = int(ps[at + SD.SPAN_BLOCK])
    half = block // 2
    scale = 1.0 / block
    future = int(ps[at + SD.SPAN_S_FUTURE])
    for k in range(max(begin, 0), end):
        p = 2 * reversed_bits(k, half) * wide
        q = p + wide
        a = z[p:q]
        b = z[q : q + wide]
        y = ss[future + wide * k : future + wide * (k + 1)]
        for i in range(wide):
            y[i] = scale * (a[i] - b[i])


@kernel
def _finish(ps, ss, at, newest, z, begin, end):
    """Spectra of outputs, written to ``z``: what is prepared, and the first parts with block ``newest``.

    Units: outputs four by four.
    """
    n = int(ps[SD.H_OUTPUTS])
    rows = int(ps[at + SD.SPAN_BLOCK]) + 1
    gap = SD.MAX_FREQUENCIES
    last = FOUR - 1
    for output in range(FOUR * max(begin, 0), min(FOUR * end, n), FOUR):
        if output + FOUR > n:
            for left in range(output, n):
                y0 = _add_filters(ps, ss, at, left, newest)
                for k in range(rows):
                    z[2 * n * k + left] = y0[k]
                    z[2 * n * k + n + left] = y0[gap + k]
            return
        y0 = _add_filters(ps, ss, at, output, newest)
        y1 = _add_filters(ps, ss, at, output + 1, newest)
        y2 = _add_filters(ps, ss, at, output + 2, newest)
        y3 = _add_filters(ps, ss, at, output + last, newest)
        for k in range(rows):
            x = z[2 * n * k + output :]
            x[0] = y0[k]
            x[1] = y1[k]
            x[2] = y2[k]
            x[last] = y3[k]
            x[n] = y0[gap + k]
            x[n + 1] = y1[gap + k]
            x[n + 2] = y2[gap + k]
            x[n + last] = y3[gap + k]


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
