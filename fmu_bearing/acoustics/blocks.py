"""Direct form or blocks: the cheapest way to run a set of filters, and the spectra the blocks need.

A filter of T taps behind a delay of D samples reaches the lags D .. D + T - 1. With blocks of B samples the
lags below B stay with the direct form, the others are cut into parts of B (`engine.sound.convolve`). With two
block lengths the shorter serves up to the longer one.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

#: Block lengths that are tried: none, one, two.
CHOICES: tuple[tuple[int, ...], ...] = (
    (), (16,), (32,), (64,), (128,), (256,), (16, 128), (32, 128), (32, 256), (64, 512),
)  # fmt: skip
# Cost of a loop before its first lane, in lanes' products and sums: measured, x86-64 with four lanes.
_ROW, _PART = 10.0, 60.0
_PRODUCT = 4.0  # of complex numbers against real ones


@dataclass(frozen=True)
class Bank:
    """Neighbouring channels filtered side by side: ``taps`` has one column per channel, newest first.

    ``targets`` is the output each column adds to.
    """

    channel: int
    delay: int
    taps: NDArray[np.float64]
    targets: tuple[int, ...]


@dataclass(frozen=True)
class Parts:
    """What one block length does of a bank: its first part's number, and spectra (part, frequency, 2, m)."""

    first: int
    spectra: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of parts."""
        return len(self.spectra)


def spans(levels: Sequence[int]) -> list[tuple[int, int, float]]:
    """Block length, first lag and lag after the last of each level."""
    ends = [*levels[1:], np.inf][: len(levels)]
    return [(block, block, end) for block, end in zip(levels, ends, strict=True)]


def head(bank: Bank, levels: Sequence[int]) -> NDArray[np.float64]:
    """Taps that stay with the direct form, filled up to a multiple of four."""
    limit = len(bank.taps) if not levels else max(min(levels[0] - bank.delay, len(bank.taps)), 0)
    rows = bank.taps[:limit]
    return np.concatenate([rows, np.zeros((-limit % 4, rows.shape[1]))])


def part_range(bank: Bank, block: int, low: float, high: float) -> tuple[int, int]:
    """First and last-plus-one part of a bank whose lags from ``low`` to ``high`` go by ``block``."""
    begin, end = max(low, bank.delay), min(high, bank.delay + len(bank.taps))
    if end <= begin:
        return 0, 0
    return int(begin // block), int(-(-end // block))


def parts(bank: Bank, block: int, low: float, high: float) -> Parts:
    """Spectra of a bank's parts."""
    first, last = part_range(bank, block, low, high)
    count, m = last - first, bank.taps.shape[1]
    lags = np.zeros((count * block, m))
    for row, taps in enumerate(bank.taps):
        lag = bank.delay + row
        if low <= lag < high and count:
            lags[lag - first * block] = taps
    spectra = np.fft.rfft(lags.reshape(count, block, m), 2 * block, axis=1)
    return Parts(first, np.stack([spectra.real, spectra.imag], axis=2))


def cost(banks: Sequence[Bank], levels: Sequence[int], channels: int, outputs: int) -> float:
    """Rough work per sample, in products of one lane."""
    total = 0.0
    for bank in banks:
        m = bank.taps.shape[1]
        total += len(head(bank, levels)) * (m + _ROW)
        for block, low, high in spans(levels):
            first, last = part_range(bank, block, low, high)
            total += (last - first) * (block + 1) / block * (_PRODUCT * m + _PART)
    for block in levels:
        total += (channels + outputs) * (2.5 * np.log2(block) + 5.0)
    return total


def choose(banks: Sequence[Bank], channels: int, outputs: int) -> tuple[int, ...]:
    """Block lengths with the least work; empty: the direct form."""
    return min(CHOICES, key=lambda levels: cost(banks, levels, channels, outputs))
