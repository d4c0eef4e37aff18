"""A bearing shifted across its axis: the same places and velocities, counted from farther on."""

import numpy as np

from fmu_bearing.engine.layout import P, Q, Y
from fmu_bearing.engine.statics.place import shift_bearing
from fmu_bearing.prepare.model import pack

ASIDE = np.array([2e-4, -5e-4])  # m, y and z


def cartesian(y, p):
    """Places, velocities and spins of the balls in fixed axes y, z; shape (balls, 2) each."""
    balls = int(p[P.BALLS])
    row = {
        name: y[getattr(Y, name) : getattr(Y, name) + balls] for name in ("TH", "R", "VR", "OM", "WR", "WT")
    }
    radius = p[P.PITCH_RADIUS] + row["R"]
    outwards = np.array([-np.sin(row["TH"]), np.cos(row["TH"])]).T
    ahead = np.array([-np.cos(row["TH"]), -np.sin(row["TH"])]).T
    places = radius[:, None] * outwards
    velocities = row["VR"][:, None] * outwards + (radius * row["OM"])[:, None] * ahead
    return places, velocities, row["WR"][:, None] * outwards + row["WT"][:, None] * ahead


def test_a_shift_keeps_velocities_and_moves_places(scene):
    p = pack(scene("7003C-spindle"), np.empty(0))
    rng = np.random.default_rng(3)
    y = np.zeros(Y.SIZE)
    lanes = int(p[P.LANES])
    y[Y.TH : Y.TH + lanes] = 2.0 * np.pi * np.arange(lanes) / lanes + 0.02 * rng.standard_normal(lanes)
    for name, size in (("R", 1e-5), ("VR", 0.1), ("OM", 400.0), ("WX", 3e3), ("WR", 1e3), ("WT", 50.0)):
        first = getattr(Y, name)
        y[first : first + lanes] = size * (1.0 + 0.1 * rng.standard_normal(lanes))
    y[Y.Q0 : Y.Q0 + Q.SIZE] = 1e-6 * rng.standard_normal(Q.SIZE)
    before, bodies = cartesian(y, p), y[Y.Q0 : Y.Q0 + Q.SIZE].copy()
    shift_bearing(p, y, *ASIDE)
    after = cartesian(y, p)
    np.testing.assert_allclose(after[0], before[0] + ASIDE, rtol=0.0, atol=1e-17 + 1e-15 * 0.02)
    np.testing.assert_allclose(after[1], before[1], rtol=0.0, atol=1e-14 * 10.0)
    np.testing.assert_allclose(after[2], before[2], rtol=0.0, atol=1e-15 * 1e4)
    moved = np.zeros(Q.SIZE)
    for body in (Q.INNER, Q.OUTER, Q.CAGE):
        moved[[body + Q.Y, body + Q.Z]] = ASIDE
    np.testing.assert_array_equal(y[Y.Q0 : Y.Q0 + Q.SIZE], bodies + moved)
    shift_bearing(p, y, *-ASIDE)
    for one, other in zip(cartesian(y, p), before, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12)
