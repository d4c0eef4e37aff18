"""A bearing whose rings are held: at its equilibrium it gives back the load and the stiffness there."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import EQ, U
from fmu_bearing.engine.status import OK
from tests.engine.helpers import RPM
from tests.engine.quasistatic import Bearing


@pytest.mark.parametrize(
    ("rpm", "load"),
    [(0.0, (500, 0, -300, 0.5, -1.0)), (20e3, (500, 80, -300, 0.5, -1.0)), (20e3, (200, 0, -1000, 0, 0))],
)
def test_held_at_its_equilibrium_a_bearing_carries_the_load(scene, rpm, load):
    bearing = Bearing(scene("7003C-bare")).solve(rpm, load)
    bearing.u[U.SPEED] = rpm * RPM
    force, out = np.zeros(5), np.zeros(EQ.SIZE)
    ring = bearing.shift
    assert call("held", bearing.p, bearing.u, bearing.c, ring, force, out, bearing.w) == OK
    # the equilibrium's own residual: 1e-9 of the load
    np.testing.assert_allclose(-force, load, rtol=0, atol=2e-6)
    found = out[EQ.STIFFNESS : EQ.STIFFNESS + 25].reshape(5, 5)
    scale = np.sqrt(np.outer(np.diag(found), np.diag(found)))
    assert np.abs(found - bearing.stiffness).max() < 1e-7 * np.abs(found).max()
    assert np.abs((found - bearing.stiffness) / scale).max() < 1e-6
    balls = slice(EQ.LOAD_I, EQ.LOAD_I + bearing.balls)
    np.testing.assert_allclose(out[balls], bearing.row(EQ.LOAD_I), rtol=1e-6, atol=1e-6)
