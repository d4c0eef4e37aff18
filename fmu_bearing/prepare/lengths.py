"""Lengths of the engine's arrays for given parameters: of one bearing or of a set."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import SP, P, S, W, Z


@dataclass(frozen=True)
class Lengths:
    """How many numbers ``u``, ``s``, ``z`` and ``w`` hold."""

    inputs: int
    state: int
    outputs: int
    work: int


def members(p: NDArray[np.float64]) -> list[tuple[slice, slice]]:
    """Return where the parameters and the state of each bearing of a set are in ``p`` and ``s``."""
    block = int(p[P.SET])
    first = block + int(p[block + SP.AT_ROWS])
    found = []
    for b in range(int(p[block + SP.BEARINGS])):
        row = p[first + b * SP.ROW : first + (b + 1) * SP.ROW]
        at_p, at_s = int(row[SP.ROW_P]), int(row[SP.ROW_S])
        sizes = int(row[SP.ROW_P_SIZE]), int(row[SP.ROW_S_SIZE])
        found.append((slice(at_p, at_p + sizes[0]), slice(at_s, at_s + sizes[1])))
    return found


def lengths(p: NDArray[np.float64]) -> Lengths:
    """Return the lengths of the arrays that go with the parameters ``p``."""
    if SP.has_shaft(p):
        outputs = int(p[int(p[P.SET]) + SP.SIZE_Z])
    else:
        outputs = Z.size(*(int(p[place]) for place in (P.BALLS, P.MICS, P.BANDS, P.MODES)))
    return Lengths(SP.inputs(p), S.size(p), outputs, W.size(p))
