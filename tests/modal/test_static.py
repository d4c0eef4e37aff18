"""The engine's quasi-static stiffness, which its Newton steps take, against the energy in the contacts."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import EQ, P, Q, S, Y
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.engine.helpers import quiet
from tests.engine.quasistatic import Bearing
from tests.modal.energy import stiffness


def state_of(bearing, offset):
    """State at the equilibrium that the quasi-static kernel found, the outer ring's centre at the origin."""
    s = np.zeros(S.size(bearing.p))
    s[S.C : S.C + bearing.c.size] = bearing.c
    y = s[S.Y : S.Y + Y.SIZE]
    for j in range(bearing.balls):
        y[Y.X + j], y[Y.R + j] = bearing.row(EQ.X)[j], bearing.row(EQ.R)[j]
        y[Y.TH + j] = 2.0 * np.pi * j / bearing.balls
    y[Y.Q0 : Y.Q0 + 5] = bearing.shift
    y[Y.Q0 + Q.OUTER + Q.BY : Y.Q0 + Q.OUTER + Q.BZ + 1] = offset
    y[Y.Q0 + Q.INNER_BY : Y.Q0 + Q.INNER_BZ + 1] += offset
    return s


@pytest.mark.parametrize("rpm", [0.0, 20e3])
@pytest.mark.parametrize("load", [(500, 0, 0, 0, 0), (500, 100, -300, 1.0, -0.5), (100, 0, -800, 0, 0)])
def test_it_is_that_of_the_quasi_static_kernel(scene, load, rpm):
    offset = (1e-4, -2e-4)
    bearing = Bearing(quiet(scene("7003C-bare"))).solve(rpm, load, offset)
    found, known = stiffness(bearing.p, state_of(bearing, offset)), bearing.stiffness
    scale = np.sqrt(np.outer(np.diag(known), np.diag(known)))
    # the kernel turns loads with the ring's tilts to first order, at 1e-3 rad a millionth of the stiffness;
    # its moments are about the ring's moving centre: loads of 1e3 N over 1e8 N/m and 1e-2 m
    np.testing.assert_allclose(found / scale, known / scale, rtol=0, atol=2e-3)
    np.testing.assert_allclose(np.diag(found), np.diag(known), rtol=1e-3)


def test_it_is_that_of_the_outputs_under_axial_load(scene):
    silent = quiet(scene("7003C-bare"))
    bearing = Instance(prepare(silent, fidelity="full"))
    bearing.initialise()
    matrix = stiffness(bearing.p, bearing.s)
    # the outputs leave out how a load turns about the axis, some 1e-4, and gravity loads balls unevenly
    assert matrix[0, 0] == pytest.approx(bearing.get("stiffness.axial"), rel=1e-4)
    assert matrix[2, 2] == pytest.approx(bearing.get("stiffness.radial"), rel=1e-3)
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-9 * matrix.max())
    assert (np.linalg.eigvalsh(matrix / np.sqrt(np.outer(np.diag(matrix), np.diag(matrix)))) > 0.0).all()


def test_a_bearing_that_carries_nothing_has_none(scene):
    silent = quiet(scene("7003C-bare"))
    bearing = Instance(prepare(silent, fidelity="full"))
    bearing.initialise()
    s = bearing.s.copy()
    s[S.Y + Y.Q0] -= 4e-5  # the inner ring away from the balls, into the middle of its play of 80 um
    assert np.abs(stiffness(bearing.p, s)).max() < 1e-2  # N/m: of 1e8; what holds a loose ball
    assert bearing.p[P.BALLS] == 12
