"""Lays the sound block flat: head, tables, and the places of the kernels' state and work."""

from collections.abc import Sequence
from itertools import groupby
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters.blocks import Bank, Wire, choose, filters, head, segments, spans, wired
from fmu_bearing.acoustics.filters.fir import decimator
from fmu_bearing.acoustics.filters.weighting import a_weighting_sections, band_sections, high_pass_section
from fmu_bearing.acoustics.papers.scalars import paper_scalars
from fmu_bearing.acoustics.registry import Ladder
from fmu_bearing.engine import layout_sound as at
from fmu_bearing.engine.layout import BANDS, STRIDE
from fmu_bearing.engine.sound import thirds as bands

MICROPHONE_LOW_LIMIT = 5.0  # Hz, second order: of a half-inch measurement microphone (assumed)
_KEEP = [0, 1, 2, 4, 5]  # of a section: the leading denominator coefficient is 1


class Members(Protocol):
    """Microphones that share filters, see `stream.Group`."""

    @property
    def members(self) -> tuple[int, ...]:
        """Indices of the microphones."""

    @property
    def first(self) -> int:
        """First output."""

    @property
    def weights(self) -> NDArray[np.float64]:
        """Weights, shape (outputs, microphones)."""


class _Block:
    """A head and the tables behind it; offsets count from the start of the block."""

    def __init__(self) -> None:
        self.head = np.zeros(at.HEAD_SIZE)
        self._tables: list[NDArray[np.float64]] = []
        self._end = at.HEAD_SIZE

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
    ladder: Ladder,
    wires: Sequence[Wire],
    groups: Sequence[Members],
    sources: Sequence[tuple[int, int]],
    *,
    details: bool,
    thirds: bool,
    levels: Sequence[int] | None,
) -> NDArray[np.float64]:
    """Lay out a sound block.

    Parameters
    ----------
    sources
        Component and kind of every output.
    details, thirds
        Which meters are kept.
    levels
        Block lengths of the convolution; default: the cheapest.

    Raises
    ------
    ValueError
        When a block is longer than 512 samples.
    """
    channels = ladder.channels
    banks, lanes = wired(wires, channels)
    if levels is None:
        levels = choose(banks, len(sources))
    if max(levels, default=0) >= at.MAX_FREQUENCIES:
        raise ValueError(f"blocks of {max(levels)} samples are too long: 512 at most")
    block = _Block()
    found = block.head
    found[at.H_RUNG] = ladder.form
    found[at.H_BALLS] = ladder.radiators.ball_count
    found[at.H_HARMONICS] = ladder.harmonics
    found[at.H_FLEXURES] = 2 * len(ladder.modes)
    found[at.H_CHANNELS] = channels
    found[at.H_BANKS] = len(banks)
    found[at.H_LEVELS] = len(levels)
    found[at.H_OUTPUTS] = len(sources)
    found[at.H_MICS] = sum(len(group.members) for group in groups)
    found[at.H_GROUPS] = len(groups)
    found[at.H_LANES] = len(sources) if ladder.form == at.RUNG_PAPER else found[at.H_MICS]
    found[at.H_DETAILS] = details
    found[at.H_BANDS] = len(BANDS) if thirds else 0
    found[at.H_AT_DECIMATOR] = block.put(decimator())
    found[at.H_AT_HIGH_PASS] = block.put(high_pass_section(at.RATE, MICROPHONE_LOW_LIMIT)[_KEEP])
    found[at.H_AT_A_WEIGHTING] = block.put(a_weighting_sections(at.RATE)[:, _KEEP])
    found[at.H_AT_BANDS] = block.put(_band_table() if thirds else [])
    angle = ladder.radiators.contact_angle
    orbit = 0.5 * ladder.radiators.pitch_diameter
    found[at.H_AT_SCALARS] = block.put(
        [*paper_scalars(ladder.radiators), np.sin(angle), np.cos(angle), orbit]
    )
    _put_sources(block, sources)
    _put_groups(block, groups)
    found[at.H_AT_LANES] = block.put(lanes)
    deepest = _put_banks(block, banks, levels)
    rows = _put_levels(block, banks, levels)
    found[at.H_ROWS] = max([deepest, *(2 * length + 1 for length in levels)])
    _place_state(block, rows)
    _place_work(block, rows)
    return block.flat()


def _band_table() -> NDArray[np.float64]:
    """Sections, then coefficients, then bands side by side; spare lanes stay silent."""
    table = np.zeros((bands.SECTIONS, 5, at.BAND_LANES))
    for lane, nominal in enumerate(BANDS):
        table[:, :, lane] = band_sections(at.RATE, nominal)[:, _KEEP]
    return table


def _put_sources(block: _Block, sources: Sequence[tuple[int, int]]) -> None:
    kinds = sorted(set(sources))
    block.head[at.H_SOURCES] = len(kinds)
    block.head[at.H_AT_SOURCES] = block.put(kinds)
    block.head[at.H_AT_OUTPUTS] = block.put([kinds.index(source) for source in sources])


def _put_groups(block: _Block, groups: Sequence[Members]) -> None:
    rows = []
    lane = 0
    order = np.zeros(sum(len(group.members) for group in groups))
    for group in groups:
        outputs, mics = group.weights.shape
        rows.append([group.first, outputs, lane, mics, block.put(group.weights)])
        order[list(group.members)] = lane + np.arange(mics)
        lane += mics
    block.head[at.H_AT_GROUPS] = block.put(rows)
    block.head[at.H_AT_ORDER] = block.put(order)


def _put_banks(block: _Block, banks: Sequence[Bank], levels: Sequence[int]) -> int:
    """Put the direct parts of all banks; return how much history they need."""
    rows = []
    deepest = 1
    for bank in banks:
        direct = head(bank, levels)
        if len(direct):
            deepest = max(deepest, bank.delay + len(direct))
        place = block.put(direct)
        runs = [(output, len(list(run))) for output, run in groupby(bank.targets)]
        lanes = bank.taps.shape[1]
        rows.append([bank.lane, lanes, bank.delay, len(direct), place, len(runs), block.put(runs)])
    block.head[at.H_AT_BANKS] = block.put(rows)
    return deepest


def _put_levels(block: _Block, banks: Sequence[Bank], levels: Sequence[int]) -> list[list[int]]:
    """Put the filters of every level; return the beginning of each level's row."""
    found = []
    for span in spans(levels):
        served = filters(banks, *span)
        runs = segments(one.lane for one in served)
        lanes = [lane for first, count in runs for lane in range(first, first + count)]
        rows = [
            [lanes.index(one.lane), one.output, one.first, one.count, block.put(one.spectra)]
            for one in served
        ]
        slots = max([1, *(one.first + one.count - 1 for one in served)])
        turns = np.pi * np.arange(span[0] + 1) / span[0]
        found.append(
            [span[0], slots, len(lanes), len(runs), block.put(runs), len(rows), block.put(rows)]
            + [block.put([np.cos(turns), np.sin(turns)])]
        )
    return found


def _place_state(block: _Block, levels: Sequence[list[int]]) -> None:
    """Give every part of the state its place, complete the rows of ``levels`` with them and put these."""
    found = block.head
    channels, mics = int(found[at.H_CHANNELS]), int(found[at.H_MICS])
    end = at.SS_TABLES + at.DECIMATOR_TAPS * channels

    def room(size: float) -> int:
        nonlocal end
        place, end = end, end + int(size)
        return place

    found[at.H_S_HIGH_PASS] = room(2 * channels)
    found[at.H_S_CHANNELS] = room(found[at.H_ROWS] * channels)
    rows = []
    for row in levels:
        length, slots, lanes = row[:3]
        spectra = room(slots * 2 * (length + 1) * lanes)
        rows.append([*row, spectra, room(length * found[at.H_OUTPUTS])])
    found[at.H_AT_LEVELS] = block.put(rows)
    found[at.H_S_A_WEIGHTING] = room(6 * found[at.H_LANES])
    found[at.H_S_METERS] = room(at.METERS * mics)
    found[at.H_S_BANDS] = room(bands.SIZE * mics if found[at.H_BANDS] else 0)
    found[at.H_STATE] = end


def _place_work(block: _Block, levels: Sequence[list[int]]) -> None:
    """Give every part of the work space its place; the decimated channels stand first."""
    found = block.head
    channels, outputs, mics = (int(found[k]) for k in (at.H_CHANNELS, at.H_OUTPUTS, at.H_MICS))
    scratch = [2 * STRIDE, at.BAND_LANES]
    scratch += [(4 * length + 2) * max(lanes, outputs) for length, _, lanes in (row[:3] for row in levels)]
    end = channels
    for place, size in (
        (at.H_W_OUTPUTS, outputs),
        (at.H_W_LANES, max(at.MAX_CHANNELS, 2 * at.MAX_FREQUENCIES)),
        (at.H_W_WEIGHTED, int(found[at.H_LANES])),
        (at.H_W_SOURCES, int(found[at.H_SOURCES]) * mics),
        (at.H_W_METERS, at.METERS * mics),
        (at.H_W_TRANSFORM, max(scratch)),
    ):
        found[place] = end
        end += size
    found[at.H_WORK] = end
