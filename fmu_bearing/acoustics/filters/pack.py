"""Lays the sound block flat: head, tables, and the places of the kernels' state and work."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters import shares
from fmu_bearing.acoustics.filters.blocks import (
    LONGEST,
    SHORTEST,
    Bank,
    Job,
    Span,
    Wire,
    choose,
    filters,
    head,
    jobs,
    segments,
    spans,
    wired,
)
from fmu_bearing.acoustics.filters.fir import decimator_stages, outer_taps
from fmu_bearing.acoustics.filters.weighting import a_weighting_sections, band_sections, high_pass_gains
from fmu_bearing.engine.choices import CHANNEL_FORMS, ChannelForm
from fmu_bearing.engine.layout import SD, SL, Z
from fmu_bearing.engine.sound.convolve import in_fours

MICROPHONE_LOW_LIMIT = 5.0  # Hz, second order: of a half-inch measurement microphone (assumed)
_KEEP = [0, 1, 2, 4, 5]  # of a section: the leading denominator coefficient is 1


class Source(Protocol):
    """What the engine forms channels of."""

    @property
    def form(self) -> ChannelForm:
        """How channels are formed."""
        ...

    @property
    def channels(self) -> int:
        """Number of channels."""
        ...

    @property
    def balls(self) -> int:
        """Number of balls."""
        ...

    @property
    def harmonics(self) -> int:
        """Highest circumferential order of the balls."""
        ...

    @property
    def modes(self) -> Sequence[Any]:
        """Flexural modes, two coordinates each."""
        ...

    @property
    def scalars(self) -> Sequence[float] | NDArray[np.float64]:
        """Numbers that the channels are formed with."""
        ...


@dataclass(frozen=True)
class Group:
    """Microphones that share filters: weights (output, microphone) of the outputs from ``first`` on."""

    members: tuple[int, ...]
    first: int
    weights: NDArray[np.float64]


@dataclass(frozen=True)
class Ray:
    """One channel's way to the microphones of one group, for lines.

    ``nodes``: value and slope of its transfer function, shape (``SD.NODES``, ``SD.NODE_SIZE``).
    """

    channel: int
    output: int
    factor: float
    nodes: NDArray[np.float64]


@dataclass(frozen=True)
class Lines:
    """What a block of lines has: rays and flight (s) of every group.

    ``bearings``: of a set, whose levels alone are kept; ``metered``: whether this block's meters read them.
    """

    rays: Sequence[Sequence[Ray]]
    flights: Sequence[float]
    bearings: int = 0
    metered: bool = True


class _Block:
    """A head and the tables behind it; offsets count from the start of the block."""

    def __init__(self) -> None:
        self.head = np.zeros(SD.HEAD_SIZE)
        self._tables: list[NDArray[np.float64]] = []
        self._end = SD.HEAD_SIZE

    def put(self, numbers: Any) -> int:
        """Append numbers and return where they begin."""
        flat = np.asarray(numbers, dtype=float).ravel()
        self._tables.append(flat)
        place, self._end = self._end, self._end + flat.size
        return place

    def flat(self) -> NDArray[np.float64]:
        """All of it in one array."""
        return np.concatenate([self.head, *self._tables])


def pack(
    radiation: Source,
    wires: Sequence[Wire],
    groups: Sequence[Group],
    sources: Sequence[tuple[int, int]],
    *,
    details: bool,
    thirds: bool,
    lengths: Sequence[int] | None,
    lines: Lines | None = None,
) -> NDArray[np.float64]:
    """Lay out a sound block.

    Parameters
    ----------
    sources
        Component and kind of every output.
    details, thirds
        Which meters are kept.
    lengths
        Block lengths of the convolution; default: the cheapest.
    lines
        What a block of lines needs, in the place of ``wires``.

    Raises
    ------
    ValueError
        When a block is shorter than 8 or longer than 512 samples.
    """
    channels = radiation.channels
    banks, order = wired(wires, channels)
    if lengths is None:
        lengths = choose(banks, len(sources))
    for length in lengths:
        if not SHORTEST <= length <= LONGEST:
            raise ValueError(f"blocks of {length} samples: {SHORTEST} to {LONGEST} are possible")
    block = _Block()
    head = block.head
    head[SD.H_FORM] = CHANNEL_FORMS[radiation.form]
    head[SD.H_BALLS] = radiation.balls
    lanes = in_fours(radiation.balls)
    head[SD.H_BALL_LANES] = lanes
    head[SD.H_HARMONICS] = radiation.harmonics
    head[SD.H_FLEXURES] = 2 * len(radiation.modes)
    head[SD.H_RAW] = in_fours(_raw(radiation, lanes))
    head[SD.H_CHANNELS] = channels
    head[SD.H_BANKS] = len(banks)
    head[SD.H_SPANS] = len(lengths)
    head[SD.H_OUTPUTS] = len(sources)
    head[SD.H_MICS] = sum(len(group.members) for group in groups)
    head[SD.H_GROUPS] = len(groups)
    head[SD.H_LANES] = len(sources) if radiation.form == "scalars" else head[SD.H_MICS]
    head[SD.H_DETAILS] = details
    head[SD.H_BANDS] = len(Z.BANDS) if thirds else 0
    first, second = decimator_stages()
    head[SD.H_AT_FIRST] = block.put(outer_taps(first))
    head[SD.H_AT_SECOND] = block.put(outer_taps(second))
    head[SD.H_AT_HIGH_PASS] = block.put(high_pass_gains(SD.RATE, MICROPHONE_LOW_LIMIT))
    head[SD.H_AT_A_WEIGHTING] = block.put(a_weighting_sections(SD.RATE)[:, _KEEP])
    head[SD.H_AT_BANDS] = block.put(_band_table() if thirds else [])
    head[SD.H_AT_SCALARS] = block.put(radiation.scalars)
    _put_sources(block, sources)
    _put_groups(block, groups, lines)
    head[SD.H_AT_LANES] = block.put(order)
    formed = SD.formed(int(head[SD.H_FORM]), radiation.harmonics, channels)
    head[SD.H_AT_FORMED] = block.put([order[channel] for channel in formed])
    if lines is not None:
        head[SD.H_AT_BOUNDS] = block.put(_bounds(groups, lines, channels))
        _place_lines(block, lines)
        return block.flat()
    served = spans(banks, lengths, len(sources))
    deepest = _put_banks(block, banks, served)
    rows, slots = _put_spans(block, banks, served)
    head[SD.H_ROWS] = max([deepest, *(2 * length + 1 for length in lengths)]) + SD.BATCH
    _place_state(block, rows, slots)
    _place_work(block)
    return block.flat()


def _raw(radiation: Source, lanes: int) -> int:
    """Count of the numbers of a motion sample that are decimated; ``lanes``: of the balls."""
    if radiation.form == "scalars":
        return radiation.channels
    if radiation.form == "contacts":
        return SD.contact_row(lanes)
    if radiation.form == "sensors":
        return SD.R_FLEXURES + 2 * len(radiation.modes)
    return SD.vector_row(lanes, 2 * len(radiation.modes))


def _band_table() -> NDArray[np.float64]:
    """Sections, then coefficients, then bands side by side; spare lanes stay silent."""
    table = np.zeros((SD.BAND_SECTIONS, SD.SECTION, SD.BAND_LANES))
    for lane, nominal in enumerate(Z.BANDS):
        table[:, :, lane] = band_sections(SD.RATE, nominal)[:, _KEEP]
    return table


def _put_sources(block: _Block, sources: Sequence[tuple[int, int]]) -> None:
    kinds = sorted(set(sources))
    block.head[SD.H_SOURCES] = len(kinds)
    block.head[SD.H_AT_SOURCES] = block.put(kinds)
    block.head[SD.H_AT_OUTPUTS] = block.put([kinds.index(source) for source in sources])


def _put_groups(block: _Block, groups: Sequence[Group], lines: Lines | None) -> None:
    rows = []
    tables: dict[int, int] = {}
    lane = 0
    order = np.zeros(sum(len(group.members) for group in groups))
    for number, group in enumerate(groups):
        outputs, mics = group.weights.shape
        row = [group.first, outputs, lane, mics, block.put(group.weights), 0, 0, 0.0]
        if lines is not None:
            rays = sorted(lines.rays[number], key=lambda ray: ray.channel)
            for ray in rays:
                if id(ray.nodes) not in tables:
                    tables[id(ray.nodes)] = block.put(ray.nodes)
            first = np.searchsorted(
                [ray.channel for ray in rays], np.arange(int(block.head[SD.H_CHANNELS]) + 1)
            )
            flat = [[ray.channel, ray.output, ray.factor, tables[id(ray.nodes)]] for ray in rays]
            row[SD.GROUP_AT_RAYS :] = [block.put(flat), block.put(first), lines.flights[number]]
        rows.append(row)
        order[list(group.members)] = lane + np.arange(mics)
        lane += mics
    block.head[SD.H_AT_GROUPS] = block.put(rows)
    block.head[SD.H_AT_ORDER] = block.put(order)


def _put_banks(block: _Block, banks: Sequence[Bank], served: Sequence[Span]) -> int:
    """Put the direct parts of all banks; return how much history they need."""
    rows = []
    deepest = 1
    for bank in banks:
        direct = head(bank, served)
        if len(direct):
            deepest = max(deepest, bank.delay + len(direct))
        lanes = bank.taps.shape[1]
        place = block.put(np.pad(direct, ((0, 0), (0, in_fours(lanes) - lanes))))
        runs = [(output, len(list(run))) for output, run in groupby(bank.targets)]
        rows.append([bank.lane, lanes, bank.delay, len(direct), place, len(runs), block.put(runs)])
    block.head[SD.H_AT_BANKS] = block.put(rows)
    return deepest


def _put_spans(
    block: _Block, banks: Sequence[Bank], served: Sequence[Span]
) -> tuple[list[list[int]], list[list[int]]]:
    """Put the jobs of every span; return each span's row, begun, and its lanes' slots."""
    span_rows = []
    slots = []
    outputs = int(block.head[SD.H_OUTPUTS])
    for span in served:
        given = filters(banks, span)
        runs = segments(one.lane for one in given)
        lanes = [lane for first, count in runs for lane in range(first, first + count)]
        length = span.block
        now, then = jobs(given, span, outputs)
        rows = [
            [SD.sums_place(job.output, length), job.adds, len(job.filters)]
            + [block.put(_filter_rows(block, job, lanes))]
            for job in (*now, *then)
        ]
        early = shares.early(length, len(lanes), outputs, [job.parts for job in now])
        late = shares.late(length, [job.parts for job in then])
        units = shares.first_units(early, late, length, span.wait)
        turns = np.pi * np.arange(length + 1) / length
        span_rows.append(
            [length, span.wait, length.bit_length() - 1, len(lanes), len(runs), block.put(runs)]
            + [len(rows), block.put(rows), len(early), block.put(units)]
            + [block.put([np.cos(turns), np.sin(turns)])]
        )
        slots.append(
            [max(1, *(one.first + one.count - 1 for one in given if one.lane == lane)) for lane in lanes]
        )
    return span_rows, slots


def _filter_rows(block: _Block, job: Job, lanes: Sequence[int]) -> list[list[int]]:
    """Put the spectra of a job's filters; return these, of a span that transforms ``lanes``."""
    return [
        [lanes.index(one.lane), max(one.first - 1, 0), one.count, block.put(one.spectra)]
        for one in job.filters
    ]


def _place_state(block: _Block, rows: Sequence[list[int]], slots: Sequence[list[int]]) -> None:
    """Give every part of the state its place, complete the spans' ``rows`` with them and put these.

    ``slots``: how many past spectra each lane of each span holds.
    """
    head = block.head
    channels, mics = int(head[SD.H_CHANNELS]), int(head[SD.H_MICS])
    end = SD.SS_TABLES + SD.FIRST_ROWS * int(head[SD.H_RAW])

    def room(size: float) -> int:
        nonlocal end
        place, end = end, end + int(size)
        return place

    head[SD.H_S_SECOND] = room(SD.SECOND_ROWS * head[SD.H_RAW])
    head[SD.H_S_TURNS] = room(SD.TURN_ROWS * 2 * head[SD.H_BALL_LANES])
    head[SD.H_S_HIGH_PASS] = room(SD.HIGH_PASS_STATES * channels)
    head[SD.H_S_CHANNELS] = room(head[SD.H_ROWS] * channels)
    complete = []
    for row, counts in zip(rows, slots, strict=True):
        length = row[SD.SPAN_BLOCK]
        lanes = [[count, room(count * 2 * (length + 1))] for count in counts]
        outputs = int(head[SD.H_OUTPUTS])
        transform = room(2 * (length + 1) * in_fours(max(len(lanes), outputs)))
        sums = room(SD.sums_place(outputs - 1, length) + SD.MAX_FREQUENCIES + length + 1)
        complete.append([*row, block.put(lanes), transform, sums, room(length * in_fours(outputs))])
    head[SD.H_AT_SPANS] = block.put(complete)
    head[SD.H_S_A_WEIGHTING] = room(SD.A_SECTIONS * SD.SECTION_STATES * head[SD.H_LANES])
    head[SD.H_S_METERS] = room(SD.METERS * mics)
    head[SD.H_S_BANDS] = room(SD.BAND_SIZE * mics if head[SD.H_BANDS] else 0)
    head[SD.H_STATE] = end


def _bounds(groups: Sequence[Group], lines: Lines, channels: int) -> NDArray[np.float64]:
    """Root of the microphones' summed squared pressures per channel, the largest over each run of nodes.

    Shape (runs, channels). A tenth more covers what a cubic does between nodes.
    """
    runs = -(-SD.NODES // SD.BOUND_NODES)
    total = np.zeros((SD.NODES, channels))
    for group, rays in zip(groups, lines.rays, strict=True):
        largest = np.zeros((channels, group.weights.shape[1], SD.NODES))
        for ray in rays:
            size = np.hypot(ray.nodes[:, SD.NODE_REAL], ray.nodes[:, SD.NODE_IMAGINARY])
            weights = np.abs(ray.factor * group.weights[ray.output - group.first])
            largest[ray.channel] += weights[:, None] * size
        total += (largest**2).sum(1).T
    padded = np.zeros((runs * SD.BOUND_NODES + 1, channels))
    padded[: SD.NODES] = 1.1 * np.sqrt(total)
    return np.array([padded[k * SD.BOUND_NODES : (k + 1) * SD.BOUND_NODES + 1].max(0) for k in range(runs)])


def _place_lines(block: _Block, lines: Lines) -> None:
    """Give every part of the state and work of a block of lines its place."""
    head = block.head
    channels, outputs, mics = (int(head[k]) for k in (SD.H_CHANNELS, SD.H_OUTPUTS, SD.H_MICS))
    bearings, bands = lines.bearings, int(head[SD.H_BANDS])
    most = SL.most_lines(mics) * max(lines.bearings, 1) if lines.metered else 0
    head[SD.H_LINES] = max(most, 1)
    head[SD.H_BEARINGS] = bearings
    head[SD.H_DELAY] = SD.LATENCY / SD.RATE
    end = SD.SS_TABLES
    for place, size in (
        (SD.H_S_METERS, SD.METERS * mics),
        (SD.H_S_BANDS, bands * mics),
        (SD.H_S_LINES, most * SL.line_size(mics)),
        (SD.H_S_ALONE, bearings * mics),
        (SD.H_S_MEANS, SL.quantities(bearings, bands) * mics),
        (SD.H_S_BEATS, SL.MOST_BEATS * SL.beat_size(bearings, bands, mics) if most else 0),
    ):
        head[place] = end
        end += size
    head[SD.H_STATE] = end
    end = 0
    for place, size in (
        (SD.H_W_OUTPUTS, 2 * outputs),
        (SD.H_W_CHANNELS, 2 * channels + 2),
        (SD.H_W_ROWS, 2 * SL.ROW_ALONE * mics),
        (SD.H_W_PARTS, 2 * most * (SL.ROW_ALONE + bearings) * mics),
        (SD.H_W_INDEX, SL.INDEX_ROWS * most + SL.HEADS + SL.NOTES),
        (SD.H_W_GAINS, (SL.GAIN_BANDS + bands) * most),
        (SD.H_W_PHASES, 2 * most),
        (SD.H_W_TURNS, SL.TURN),
        (SD.H_W_ANGLES, SL.ANGLES * max(bearings, 1)),
    ):
        head[place] = end
        end += size
    head[SD.H_WORK] = end


def _place_work(block: _Block) -> None:
    """Give every part of the work space its place; the decimated rows are first."""
    head = block.head
    channels, outputs, mics = (int(head[k]) for k in (SD.H_CHANNELS, SD.H_OUTPUTS, SD.H_MICS))
    # of the balls' harmonics: sums and multiples
    rows = SD.FAMILIES * SD.FAMILY_ROWS + head[SD.H_BALL_LANES]
    scratch = [2 * int(head[SD.H_HARMONICS] * rows), SD.BAND_LANES]
    end = SD.BATCH * int(head[SD.H_RAW])
    for place, size in (
        (SD.H_W_FORMED, SD.BATCH * channels),
        (SD.H_W_OUTPUTS, SD.BATCH * in_fours(outputs)),
        (SD.H_W_LANES, SD.MAX_CHANNELS),
        (SD.H_W_WEIGHTED, int(head[SD.H_LANES])),
        (SD.H_W_SOURCES, SD.BATCH * int(head[SD.H_SOURCES]) * mics),
        (SD.H_W_METERS, SD.BATCH * SD.METERS * mics),
        (SD.H_W_SCRATCH, max(scratch)),
    ):
        head[place] = end
        end += size
    head[SD.H_WORK] = end
