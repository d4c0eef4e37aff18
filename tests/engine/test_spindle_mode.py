"""The spindle scene's first lateral mode: stated at 467 Hz, 28,000 r/min."""

import numpy as np
import pytest
from scipy.linalg import eigh

from fmu_bearing.engine.layout import P, Q
from fmu_bearing.prepare.model import pack
from tests.engine.quasistatic import solve


def test_first_lateral_mode_is_at_28000_rpm(scene):
    spindle = scene("7003C-spindle")
    p = pack(spindle, np.empty(0))
    _, radial, tilt, coupling = solve(spindle, 28000, 500.0)["stiffness"]
    # inner z, inner tilt, outer z, outer tilt in one plane; gyroscopic terms and damping left out
    bearing = np.array([[radial, coupling], [coupling, tilt]])
    stiffness = np.block([[bearing, -bearing], [-bearing, bearing]])
    pedestal = spindle.mounting.pedestal_stiffness_N_m
    stiffness[1, 1] += p[P.SUPPORT_STIFFNESS + Q.INNER_BY]
    stiffness[2, 2] += pedestal
    stiffness[3, 3] += p[P.ROTATIONAL_RATIO] * pedestal
    mass = p[[P.INNER_MASS, P.INNER_TRANSVERSE, P.OUTER_MASS, P.OUTER_TRANSVERSE]]
    squares, shapes = eigh(stiffness, np.diag(mass))
    share = (shapes**2 * mass[:, None])[[0, 2]].sum(0)  # kinetic energy in translation
    lateral = np.flatnonzero(share > 0.5)[0]
    assert np.sqrt(squares[lateral]) / (2 * np.pi) == pytest.approx(467.0, rel=5e-3)
