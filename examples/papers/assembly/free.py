"""All free modes of a ring up to a frequency, by frequency: what sound is compared with."""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.fourier import Elastic, Solid
from fmu_bearing.elastic.modes import family, gyroscopic, meshed
from fmu_bearing.elastic.section import FINENESS, Section

_PER_WAVE = 6  # quadratic elements to the shortest wave that is listed
_FIRST = 6  # modes of one order sought at first; twice as many until the highest lies beyond the limit


class FreeMode(NamedTuple):
    """Mode of a free ring: circumferential order, family, frequency in Hz, g (`elastic.modes.RingMode`)."""

    order: int
    family: str
    frequency: float
    gyroscopic: float


@lru_cache(maxsize=64)
def free_modes(section: Section, material: Elastic, highest: float) -> tuple[FreeMode, ...]:
    """All modes of a free ring up to a frequency (Hz), by frequency, the rigid ones first.

    Families: ``rigid``; of order 0 ``breathing`` (radial), ``roll`` (the section turns) and ``torsion``
    (about the axis); of higher orders ``in-plane`` and ``out-of-plane``. Families of order 1 and above have
    two modes of the same frequency, listed once.

    Raises
    ------
    ValueError
        When the frequency is beyond the mesh's reach.
    """
    check_reach(section, material, highest)
    ring = meshed(section, material, FINENESS)
    found: list[FreeMode] = []
    order, below = 0, True
    # every order's lowest elastic mode is higher than that of the order before, from 2 on
    while below or order <= 2:
        frequencies, shapes = modes_below(ring, order, highest)
        below = bool(frequencies.size)
        for frequency, shape in zip(frequencies, shapes.T, strict=True):
            kind = "rigid" if frequency == 0.0 else family(ring, order, shape)
            found.append(FreeMode(order, kind, float(frequency), gyroscopic(ring, shape)))
        order += 1
    return tuple(sorted(found, key=lambda mode: (mode.frequency, mode.order)))


def check_reach(section: Section, material: Elastic, highest: float) -> None:
    """Refuse a frequency (Hz) whose shear wave the section's mesh does not resolve.

    Raises
    ------
    ValueError
        When it is beyond the mesh's reach.
    """
    element = max(section.width, section.high - section.low) / FINENESS
    reach = math.sqrt(material.shear_modulus / material.density) / (_PER_WAVE * element)
    if not 0.0 < highest <= reach:
        raise ValueError(
            f"highest = {highest:g} Hz is refused; allowed: above 0 to {reach:.3g} Hz, where the mesh of the "
            f"section still has {_PER_WAVE} elements to a shear wave"
        )


def modes_below(
    ring: Solid, order: int, highest: float, held: bool = False
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """All modes of one harmonic up to a frequency (Hz), as `Solid.modes` gives them."""
    count = _FIRST
    frequencies, shapes = ring.modes(order, count, held)
    while frequencies[-1] <= highest:
        count *= 2
        frequencies, shapes = ring.modes(order, count, held)
    below = frequencies <= highest
    return frequencies[below], shapes[:, below]
