"""Direct form or blocks: the cheapest way to run a set of filters, and the spectra the blocks need.

A filter of T taps behind a delay of D samples reaches the lags D .. D + T - 1. Blocks of B samples serve the
lags from B + W on, cut into parts of B, when their outputs are ready W samples after the end of their inputs
(`engine.sound.convolve`). Lags below the first span's stay with the direct form. With two block lengths the
shorter serves up to where the longer one begins.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters import shares
from fmu_bearing.engine.layout import FOUR

#: Block lengths that are tried: none, one, two.
CHOICES: tuple[tuple[int, ...], ...] = (
    (), (16,), (32,), (64,), (128,), (256,), (16, 64), (16, 128), (32, 64), (32, 128), (32, 256), (64, 512),
)  # fmt: skip
_UNEVEN = 1.2  # early work per sample against the mean, at most
_AT_ONCE = 32  # samples: the longest block whose early work may fall on one sample, twice in 1 ms
_LONGEST_GAP = 6  # lanes

#: Block lengths that the kernels have room and shares for.
SHORTEST, LONGEST = 2 * FOUR, 512

#: Who hears a channel: group of microphones, delay, and which of several filters behind that delay.
Key = tuple[int, int, int]


@dataclass(frozen=True)
class Bank:
    """Neighbouring lanes filtered side by side: ``taps`` has one column per lane, newest first.

    ``targets`` is the output each column adds to.
    """

    lane: int
    delay: int
    taps: NDArray[np.float64]
    targets: tuple[int, ...]


@dataclass(frozen=True)
class Wire:
    """One channel's filter: behind ``delay`` samples, for microphones of one ``group``, to one output."""

    group: int
    channel: int
    delay: int
    taps: NDArray[np.float64]
    target: int


@dataclass(frozen=True)
class Filter:
    """What one span does of one lane: spectra (part, 2, frequency) from part ``first`` on."""

    lane: int
    output: int
    first: int
    spectra: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of parts."""
        return len(self.spectra)


@dataclass(frozen=True)
class Job:
    """Products that add to one output; ``adds``: to those of late jobs before."""

    output: int
    adds: bool
    filters: list[Filter]

    @property
    def parts(self) -> int:
        """Number of parts."""
        return sum(one.count for one in self.filters)


def wired(wires: Sequence[Wire], channels: int) -> tuple[list[Bank], list[int]]:
    """Banks of a set of filters, and the lane of each channel.

    Channels that the same groups hear with the same delays lie side by side, in the order of their outputs,
    the silent ones last. Short gaps in a bank are filled with silence: one long vector loop beats two
    short ones.
    """
    by_channel: dict[int, dict[Key, Wire]] = {}
    for wire in wires:
        known = by_channel.setdefault(wire.channel, {})
        again = sum(key[:2] == (wire.group, wire.delay) for key in known)
        known[wire.group, wire.delay, again] = wire
    keys = sorted({key for known in by_channel.values() for key in known})
    order = sorted(
        by_channel,
        key=lambda channel: (
            sorted(by_channel[channel]),
            [wire.target for _, wire in sorted(by_channel[channel].items())],
            channel,
        ),
    )
    banks = []
    for key in keys:
        side: dict[int, Wire] = {}
        for lane, channel in enumerate(order):
            if key not in by_channel[channel]:
                continue
            if side and lane - max(side) > _LONGEST_GAP + 1:
                banks.append(_bank(side))
                side = {}
            side[lane] = by_channel[channel][key]
        banks.append(_bank(side))
    order += [channel for channel in range(channels) if channel not in by_channel]
    return banks, [order.index(channel) for channel in range(channels)]


def _bank(side: dict[int, Wire]) -> Bank:
    """Bank of neighbouring lanes with their filters."""
    first, last = min(side), max(side)
    one = side[first]
    table = np.zeros((max(len(wire.taps) for wire in side.values()), last - first + 1))
    for lane, wire in side.items():
        table[: len(wire.taps), lane - first] = wire.taps
    targets = tuple(side[lane].target if lane in side else one.target for lane in range(first, last + 1))
    return Bank(first, one.delay, table, targets)


@dataclass(frozen=True)
class Span:
    """Lags from ``low`` up to before ``high`` that blocks of ``block`` samples serve."""

    block: int
    low: int
    high: float

    @property
    def wait(self) -> int:
        """Samples from the end of a block of inputs until the outputs that it serves begin."""
        return self.low - self.block


def spans(banks: Sequence[Bank], lengths: Sequence[int], outputs: int) -> list[Span]:
    """One span per block length; each begins where its work is spread evenly.

    The first one, if its blocks are short, waits no longer than until the first filter works: taps of the
    direct form would cost more. The second begins a whole number of the first one's blocks later.
    """
    if not lengths:
        return []
    reach = _reach(banks)
    first = lengths[0]
    low = _even(reach, first, first, FOUR, outputs)
    if first <= _AT_ONCE:
        unused = int(np.min(reach[1], initial=low)) // FOUR * FOUR
        low = max(first, min(low, unused))
    if len(lengths) == 1:
        return [Span(first, low, np.inf)]
    second = lengths[1]
    begin = low + -(-(second - low) // first) * first
    middle = _even(reach, second, begin, first, outputs)
    return [Span(first, low, middle), Span(second, middle, np.inf)]


def _reach(banks: Sequence[Bank]) -> NDArray[np.int64]:
    """Lane, first lag, lag after the last, and output of every filter, as rows."""
    reaches = []
    for bank in banks:
        for column, output in enumerate(bank.targets):
            used = np.flatnonzero(bank.taps[:, column])
            if len(used):
                reaches.append([bank.lane + column, bank.delay, bank.delay + int(used[-1]) + 1, output])
    return np.array(reaches, dtype=np.int64).reshape(-1, 4).T


def _even(reach: NDArray[np.int64], block: int, begin: int, stride: int, outputs: int) -> int:
    """First lag ``begin`` + k ``stride`` with no more early work per sample than `_UNEVEN` times the mean."""
    lags = range(begin, max(2 * block - 2 * FOUR, begin) + 1, stride)
    for low in lags:
        early, late = work(reach, Span(block, low, np.inf), outputs)
        if early / (low - block + FOUR) <= _UNEVEN * (early + late) / block:
            return low
    return lags[-1]


def work(reach: NDArray[np.int64], span: Span, outputs: int) -> tuple[float, float]:
    """Early and late work on a block of a span, in products of one lane (`shares`)."""
    lane, begin, end, _ = reach
    first, last = _parts(begin, end, span)
    now = np.sum((first == 0) & (last > 0))
    lanes = len(np.unique(lane[last > first]))
    later = np.sum(last - np.maximum(first, 1), where=last > 1)
    before = shares.early(span.block, lanes, outputs, [0] * outputs).sum() + shares.products(span.block, now)
    return float(before), float(shares.products(span.block, later))


def _parts(begin: NDArray[np.int64], end: NDArray[np.int64], span: Span) -> tuple[Any, Any]:
    """First and last-plus-one part in a span of filters that reach from ``begin`` to ``end``."""
    low, high = np.maximum(begin, span.low), np.minimum(end, span.high)
    none = high <= low
    first = np.where(none, 0, (low - span.low) // span.block)
    last = np.where(none, 0, -(-(high - span.low) // span.block))
    return first.astype(np.int64), last.astype(np.int64)


def head(bank: Bank, served: Sequence[Span]) -> NDArray[np.float64]:
    """Taps that stay with the direct form, filled up to a multiple of four."""
    limit = len(bank.taps) if not served else max(min(served[0].low - bank.delay, len(bank.taps)), 0)
    rows = bank.taps[:limit]
    return np.concatenate([rows, np.zeros((-limit % 4, rows.shape[1]))])


def filters(banks: Sequence[Bank], span: Span) -> list[Filter]:
    """Return what goes by one span, in the order of outputs."""
    chosen = []
    for bank in banks:
        for column, output in enumerate(bank.targets):
            one = Bank(bank.lane + column, bank.delay, bank.taps[:, column : column + 1], (output,))
            reach = _reach([one])
            if not reach.size:
                continue
            first, last = (int(part[0]) for part in _parts(reach[1], reach[2], span))
            if last == first:
                continue
            lags = np.zeros((last - first) * span.block)
            start = span.low + first * span.block
            begin = max(start, bank.delay)
            end = int(min(span.high, span.low + last * span.block, reach[2, 0]))
            lags[begin - start : end - start] = one.taps[begin - bank.delay : end - bank.delay, 0]
            spectra = np.fft.rfft(lags.reshape(-1, span.block), 2 * span.block, axis=1)
            parts = np.stack([spectra.real, spectra.imag], axis=1)
            chosen.append(Filter(one.lane, output, first, parts))
    return sorted(chosen, key=lambda one: (one.output, one.lane))


def jobs(given: Sequence[Filter], span: Span, outputs: int) -> tuple[list[Job], list[Job]]:
    """One early job for the first part of each output, and late jobs for the others, none of them large."""
    parts = sum(one.count for one in given)
    limit = 2 * max(2, parts // (2 * span.block))  # about one job per sample; parts go two by two
    now, then = [], []
    for output in range(outputs):
        mine = [one for one in given if one.output == output]
        late: list[list[Filter]] = []
        for one in mine:
            for begin in range(max(1 - one.first, 0), one.count, limit):
                piece = Filter(one.lane, output, one.first + begin, one.spectra[begin : begin + limit])
                if not late or sum(other.count for other in late[-1]) + piece.count > limit:
                    late.append([])
                late[-1].append(piece)
        first = [Filter(one.lane, output, 0, one.spectra[:1]) for one in mine if one.first == 0]
        now.append(Job(output, bool(late), first))
        then += [Job(output, k > 0, some) for k, some in enumerate(late)]
    return now, then


def segments(lanes: Iterable[int]) -> list[tuple[int, int]]:
    """Return the runs of neighbours among ``lanes``: first lane and count."""
    runs: list[tuple[int, int]] = []
    for lane in sorted(set(lanes)):
        if runs and lane == sum(runs[-1]):
            runs[-1] = (runs[-1][0], runs[-1][1] + 1)
        else:
            runs.append((lane, 1))
    return runs


def cost(banks: Sequence[Bank], lengths: Sequence[int], outputs: int) -> float:
    """Rough work per sample, in products of one lane."""
    served = spans(banks, lengths, outputs)
    reach = _reach(banks)
    total = sum(len(head(bank, served)) * (bank.taps.shape[1] + shares.LOOP) for bank in banks)
    return float(total + sum(sum(work(reach, span, outputs)) / span.block for span in served))


def choose(banks: Sequence[Bank], outputs: int) -> tuple[int, ...]:
    """Block lengths with the least work; empty: the direct form."""
    return min(CHOICES, key=lambda lengths: cost(banks, lengths, outputs))
