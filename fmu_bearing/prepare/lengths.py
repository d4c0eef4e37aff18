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


def parts_of(p: NDArray[np.float64]) -> list[tuple[slice, slice]]:
    """Return the places of each bearing's parameters in ``p`` and state in ``s``; all of a single one's."""
    if not SP.has_shaft(p):
        return [(slice(None), slice(None))]
    first, count = SP.first(p, SP.AT_ROWS), int(p[int(p[P.SET]) + SP.BEARINGS])
    places = []
    for row in p[first : first + count * SP.ROW].reshape(count, SP.ROW):
        at_p, at_s = int(row[SP.ROW_P]), int(row[SP.ROW_S])
        sizes = int(row[SP.ROW_P_SIZE]), int(row[SP.ROW_S_SIZE])
        places.append((slice(at_p, at_p + sizes[0]), slice(at_s, at_s + sizes[1])))
    return places


def lengths(p: NDArray[np.float64]) -> Lengths:
    """Return the lengths of the arrays that go with the parameters ``p``."""
    if SP.has_shaft(p):
        outputs = int(p[int(p[P.SET]) + SP.SIZE_Z])
    else:
        counts = P.BALLS, P.MICS, P.BANDS, P.MODES, P.DEFECTS, P.ACCELEROMETERS
        outputs = Z.size(*(int(p[place]) for place in counts))
    return Lengths(SP.inputs(p), S.size(p), outputs, W.size(p))
