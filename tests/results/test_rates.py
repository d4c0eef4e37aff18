"""Rates of the balls in a state: by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from fmu_bearing.engine.layout import P, S, Y
from fmu_bearing.results.rates import ball_rates, frequencies


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_spin_counts_in_the_axes_that_orbit(way):
    """Orbits of 2 and 4 rad/s; absolute spins that are, beside them, (3, 4, 0) and (0, 8, -6) rad/s."""
    p, s = np.zeros(P.BALLS + 1), np.zeros(S.Y + Y.SIZE)
    p[P.BALLS] = 2.0
    for row, values in ((Y.OM, (2.0, 4.0)), (Y.WX, (5.0, 4.0)), (Y.WR, (4.0, 8.0)), (Y.WT, (0.0, -6.0))):
        s[S.Y + row : S.Y + row + 2] = way * np.array(values)
    orbit, spin = ball_rates(SimpleNamespace(p=p, s=s))
    assert orbit == pytest.approx(3.0, rel=1e-15)
    assert spin == pytest.approx(0.5 * (5.0 + 10.0), rel=1e-15)
    found = frequencies(way * 8.0, orbit, spin, 12)
    assert 2.0 * np.pi * np.array(found) == pytest.approx([8.0, 3.0, 7.5, 60.0, 36.0], rel=1e-14)
