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
    assert call("forces_at_displacement", bearing.p, bearing.u, bearing.c, ring, force, out, bearing.w) == OK
    # the equilibrium's own residual: 1e-9 of the load
    np.testing.assert_allclose(-force, load, rtol=0, atol=2e-6)
    found = out[EQ.STIFFNESS : EQ.STIFFNESS + 25].reshape(5, 5)
    scale = np.sqrt(np.outer(np.diag(found), np.diag(found)))
    assert np.abs(found - bearing.stiffness).max() < 1e-7 * np.abs(found).max()
    assert np.abs((found - bearing.stiffness) / scale).max() < 1e-6
    balls = slice(EQ.LOAD_I, EQ.LOAD_I + bearing.balls)
    np.testing.assert_allclose(out[balls], bearing.row(EQ.LOAD_I), rtol=1e-6, atol=1e-6)


def test_no_ring_gives_the_force_that_holds_balls_on_their_orbits(scene):
    """An inner ring beside the axis pushes balls along their orbits, the outer contacts only outwards."""
    bearing = Bearing(scene("7003C-bare")).solve(0.0, (500, 0, -75, 0, 0))
    upwards = np.cos(2.0 * np.pi * np.arange(bearing.balls) / bearing.balls)
    felt = (bearing.row(EQ.LOAD_O) * np.cos(bearing.row(EQ.ANGLE_O)) * upwards).sum()
    assert felt == pytest.approx(-75.020, abs=2e-3)
