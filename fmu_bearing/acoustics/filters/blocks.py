"""Direct form or blocks: the cheapest way to run a set of filters, and the spectra the blocks need.

A filter of T taps behind a delay of D samples reaches the lags D .. D + T - 1. With blocks of B samples the
lags below B stay with the direct form, the others are cut into parts of B (`engine.sound.convolve`). With two
block lengths the shorter serves up to the longer one.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

#: Block lengths that are tried: none, one, two.
CHOICES: tuple[tuple[int, ...], ...] = (
    (), (16,), (32,), (64,), (128,), (256,), (16, 64), (16, 128), (32, 64), (32, 128), (32, 256), (64, 512),
)  # fmt: skip
# Cost of a loop before its first pass, in products with their sums: measured, x86-64 with AVX2.
_ROW, _PART = 20.0, 30.0
_PRODUCT = 4.0  # of complex numbers against real ones
_STAGE, _FOLD = 3.5, 1.0  # of one sample's Fourier transform: per stage, and besides
_LONGEST_GAP = 6  # lanes

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
    """What one block length does of one lane: spectra (part, 2, frequency) from part ``first`` on."""

    lane: int
    output: int
    first: int
    spectra: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of parts."""
        return len(self.spectra)


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


def spans(lengths: Sequence[int]) -> list[tuple[int, int, float]]:
    """Block length, first lag and lag after the last of each span."""
    ends = [*lengths[1:], np.inf][: len(lengths)]
    return [(block, block, end) for block, end in zip(lengths, ends, strict=True)]


def head(bank: Bank, lengths: Sequence[int]) -> NDArray[np.float64]:
    """Taps that stay with the direct form, filled up to a multiple of four."""
    limit = len(bank.taps) if not lengths else max(min(lengths[0] - bank.delay, len(bank.taps)), 0)
    rows = bank.taps[:limit]
    return np.concatenate([rows, np.zeros((-limit % 4, rows.shape[1]))])


def part_range(bank: Bank, column: int, block: int, low: float, high: float) -> tuple[int, int]:
    """First and last-plus-one part of a filter whose lags from ``low`` to ``high`` go by ``block``."""
    used = np.flatnonzero(bank.taps[:, column])
    taps = int(used[-1]) + 1 if len(used) else 0
    begin, end = max(low, bank.delay), min(high, bank.delay + taps)
    if end <= begin:
        return 0, 0
    return int(begin // block), int(-(-end // block))


def filters(banks: Sequence[Bank], block: int, low: float, high: float) -> list[Filter]:
    """Return what goes by one block length, in the order of outputs."""
    found = []
    for bank in banks:
        for column, output in enumerate(bank.targets):
            first, last = part_range(bank, column, block, low, high)
            if last == first:
                continue
            lags = np.zeros((last - first) * block)
            begin, end = int(max(low, bank.delay)), int(min(high, last * block, bank.delay + len(bank.taps)))
            lags[begin - first * block : end - first * block] = bank.taps[
                begin - bank.delay : end - bank.delay, column
            ]
            spectra = np.fft.rfft(lags.reshape(-1, block), 2 * block, axis=1)
            parts = np.stack([spectra.real, spectra.imag], axis=1)
            found.append(Filter(bank.lane + column, output, first, parts))
    return sorted(found, key=lambda one: (one.output, one.lane))


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
    total = sum(len(head(bank, lengths)) * (bank.taps.shape[1] + _ROW) for bank in banks)
    for block, low, high in spans(lengths):
        lanes = set()
        for bank in banks:
            for column in range(bank.taps.shape[1]):
                first, last = part_range(bank, column, block, low, high)
                total += (last - first) * (_PRODUCT * (block + 1) + _PART) / block
                if last > first:
                    lanes.add(bank.lane + column)
        total += (outputs + len(lanes)) * (_STAGE * np.log2(block) + _FOLD)
    return float(total)


def choose(banks: Sequence[Bank], outputs: int) -> tuple[int, ...]:
    """Block lengths with the least work; empty: the direct form."""
    return min(CHOICES, key=lambda lengths: cost(banks, lengths, outputs))
