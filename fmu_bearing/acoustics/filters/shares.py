"""Work on a block of inputs, in the units of `engine.sound.convolve`, and the samples' shares in it.

Costs are in products of one lane with their sums. The early units have to be done before the outputs begin,
the late ones before the next block.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import FOUR

# Cost of a loop before its first pass, and of a filter: measured, x86-64 with AVX2, as all of these.
LOOP, PART = 10.0, 15.0
_PRODUCT = 4.0  # of complex numbers against real ones
_PAIR = 3.0  # two rows of one of the transform's stages
_FOLD = 4.0  # two opposite frequencies, folded or unfolded
_GATHER, _PUT = 6.0, 4.0  # the outermost stages, with the copy from the history and to the outputs
_COPY = 5.0  # one frequency of a spectrum between lanes side by side and one behind the other


def products(block: int, parts: Any) -> Any:
    """Cost of so many parts of filters times spectra."""
    return parts * (_PRODUCT * (block + 1) + PART)


def early(block: int, lanes: int, outputs: int, parts: Sequence[int]) -> NDArray[np.float64]:
    """Costs of the early units; ``parts``: how many first parts each output has."""
    half = block // 2
    stages = half * (block.bit_length() - 2)
    fours = -(-outputs // FOUR)
    parts_of_four = np.append(parts, np.zeros(FOUR * fours - outputs)).reshape(fours, FOUR).sum(axis=1)
    copy = FOUR * _COPY * (block + 1)
    return np.concatenate(
        [
            np.full(half, _GATHER * lanes + LOOP),
            np.full(stages, _PAIR * lanes + LOOP),
            np.full(half + 1, _FOLD * lanes + LOOP),
            np.full(-(-lanes // FOUR), copy),
            copy + products(block, parts_of_four),
            np.full(half + 1, _FOLD * outputs + LOOP),
            np.full(stages, _PAIR * outputs + LOOP),
            np.full(half, _PUT * outputs + LOOP),
        ]
    )


def late(block: int, parts: Sequence[int]) -> NDArray[np.float64]:
    """Costs of the late units; ``parts``: how many each job has."""
    return np.asarray(products(block, np.array(parts, dtype=float)) + LOOP)


def first_units(
    before: NDArray[np.float64], after: NDArray[np.float64], block: int, wait: int
) -> NDArray[np.int64]:
    """First unit of every sample of a block, then the number of units.

    Every `FOUR` samples from 0 to ``wait`` (a multiple of `FOUR`) do the early units ``before``, the last of
    these at the last of them; every `FOUR` samples behind do the late ones ``after``. In between the samples
    have none: a share has a cost of its own.
    """
    early = _cuts(before, wait // FOUR + 1)
    late = _cuts(after, block // FOUR - len(early))
    done = np.repeat([*early, *(len(before) + late)], FOUR)
    return np.concatenate([[0], done]).astype(np.int64)


def _cuts(costs: NDArray[np.float64], shares: int) -> NDArray[np.int64]:
    """How many units are done after each of so many shares: a unit belongs to the one in which it begins."""
    begins = np.cumsum(costs) - costs
    return np.searchsorted(begins, np.sum(costs) / shares * np.arange(1, shares + 1))
