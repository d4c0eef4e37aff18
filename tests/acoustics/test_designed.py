"""Filters kept as numbers: designed once more, by SciPy."""

import numpy as np
import pytest
from scipy.signal import remez

from fmu_bearing.acoustics.filters import designed
from fmu_bearing.acoustics.filters.weighting import a_weighting_sections, free_section
from fmu_bearing.acoustics.radiation.frequencies import BAND, STOP
from fmu_bearing.engine.layout import SD

#: Taps of the band limit, odd: it has a middle; weight of its stop band against its pass band.
LIMIT_TAPS, LIMIT_WEIGHT = 93, 3.0


def outer(taps, edge):
    """Twice the outer taps of a half-band filter that is flat up to ``edge`` (in sample rates)."""
    edges = [0.0, 2.0 * edge, 0.5 - 1e-9, 0.5]
    return remez((taps + 1) // 2, edges, [1.0, 0.0], weight=[1.0, 1e-9], fs=1.0)


def limit():
    edges = [0.0, BAND[1], STOP, SD.RATE / 2]
    return remez(LIMIT_TAPS, edges, [1.0, 0.0], weight=[1.0, LIMIT_WEIGHT], fs=SD.RATE)


EQUIRIPPLE = {
    "FIRST_STAGE": lambda: outer(SD.FIRST_TAPS, STOP / SD.RAW_RATE),
    "SECOND_STAGE": lambda: outer(SD.SECOND_TAPS, STOP * SD.HALF / SD.RAW_RATE),
    "BAND_LIMIT": limit,
}


@pytest.mark.parametrize("name", EQUIRIPPLE)
def test_equiripple_filters(name):
    """1e-12 of one: an exchange that ends at other extremes of the ripple moves taps by more than 1e-9."""
    taps = EQUIRIPPLE[name]()
    half = taps[: (len(taps) + 1) // 2]
    assert getattr(designed, name) == pytest.approx(half, abs=1e-12), f"now {half.tolist()}"


def test_a_weighting():
    """1e-7: a fit by least squares ends where rounding hides the slope, at the root of 1e-16."""
    assert list(designed.A_WEIGHTING) == [SD.RATE]
    fixed = a_weighting_sections(SD.RATE)[:2]
    found = free_section(fixed, SD.RATE)
    assert found[0] == pytest.approx(designed.A_WEIGHTING[SD.RATE], abs=1e-7), f"now {found.tolist()}"
    assert np.array_equal(a_weighting_sections(SD.RATE)[2], designed.A_WEIGHTING[SD.RATE])
