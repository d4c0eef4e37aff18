"""A local defect in one bearing of a set: whose balls it meets, and its scale, which the whole set has."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import C, P, R, S
from fmu_bearing.prepare import defect_blocks
from fmu_bearing.prepare.model import pack
from tests.engine.defects import smooth
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene as set_of

SPALL = {"on": "outer", "shape": "spall", "length_mm": 0.5, "depth_um": 50.0, "angle_deg": 90.0, "bearing": 2}
NONE = {
    "seed": 1, "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0, "waviness_exponent": 1.0,
}  # fmt: skip


@pytest.fixture
def pair(monkeypatch):
    """A pair with a spall in its second bearing, of a made-up table."""
    monkeypatch.setattr(defect_blocks, "defect_table", lambda shape, *_: smooth(shape.length, lost=1e-6))
    run = SetRun(set_of("+-", rpm=10e3, changes={"imperfections": NONE | {"defect": [SPALL]}}))
    run.p = pack(run.scene, np.empty(0))
    run.block = int(run.p[P.SET])
    return run.init()


def swing(run, duration):
    """Of the loads at the outer races: the widest swing (N) of a ball in each bearing."""
    loads = []
    for _ in range(round(duration / 2e-5)):
        assert run.step(2e-5) == 0
        kept = S.CONTACTS + R.KEPT + R.KEPT_LOAD
        loads.append([run.state(b)[kept : kept + 12].copy() for b in range(2)])
    return np.ptp(np.array(loads), axis=0).max(axis=1)


def test_it_meets_the_balls_of_its_bearing_alone(pair):
    first, second = swing(pair, 4e-3)
    assert second > 10.0
    assert first < 0.4 * second  # the shaft shakes it


def test_its_scale_is_set_once_for_all_bearings_and_counts_as_work(pair):
    swing(pair, 2e-3)
    for scale in (0.0, 0.7):
        pair.p[P.DEFECT_SCALE] = scale
        swing(pair, 2e-3)
        assert [pair.state(b)[S.C + C.DEFECT_SCALE] for b in range(2)] == [0.0, scale]
    assert abs(pair.imbalance) < 1e-4 * pair.heat
