"""Ranges of a set's inputs: as wide as what its fidelities compute, no narrower than its own values."""

import pytest

from fmu_bearing import Bearing
from fmu_bearing.interface.inputs import inputs_of
from fmu_bearing.scene.read import with_fidelity
from tests.spindle.sets import scene as set_of

FOUR = ("++--", (40.0, 60.0, 130.0, 150.0))


def moments(scene):
    return [one for one in inputs_of(scene) if one.name.startswith("nose.moment")]


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["nose.moment.y", "nose.moment.z"])
def test_the_end_of_the_range_of_moments_is_computed(name):
    scene = with_fidelity(set_of(*FOUR, rpm=10e3), model="full")
    most = next(one.max for one in moments(scene) if one.name == name)
    # 5 x 4 x 3.46 kN x (0.150 + 0.026) m; C0 of a 7003C by ISO 76 is 3.46 kN with 12 balls of 4.5 mm on 26 mm
    assert 9e3 < most < 15e3
    bearing = Bearing(scene)
    bearing.init()
    with pytest.warns(UserWarning, match="shoulder"):  # it is far beyond what a bearing survives
        bearing.step(1e-3, {name: most})
    assert bearing.time == pytest.approx(1e-3)


def test_a_load_of_the_scene_far_ahead_of_the_nose_is_in_the_range():
    scene = set_of(*FOUR, rpm=10e3)
    load = scene.spindle.load.model_copy(update={"force_z_N": 1e5, "position_mm": -1000.0})
    scene = scene.model_copy(update={"spindle": scene.spindle.model_copy(update={"load": load})})
    for one in moments(scene):
        assert one.min <= one.start <= one.max
    assert max(one.max for one in moments(scene)) == pytest.approx(2e5)  # twice 100 kN at 1 m
