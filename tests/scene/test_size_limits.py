"""Largest speeds follow the pitch diameter, and loads on sets the static rating, in scenes and in FMUs."""

import math

import numpy as np
import pytest

from fmu_bearing import SceneError, read_scene, simulate
from fmu_bearing.engine.constants import RPM
from fmu_bearing.interface.inputs import inputs_of
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.own_bearing import Dimensions
from fmu_bearing.scene.template import new_scene
from tests.conftest import EXAMPLES

PAIR = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
#: r/min that NSK prints of the 7900C with oil.
PRINTED = 109_400.0


@pytest.fixture(scope="module")
def small():
    """NSK's 7900C, of 16 mm pitch diameter, at its printed speed."""
    return read_scene_text(new_scene("small", "NSK-7900C", sound=False, speed_rpm=PRINTED, preload_N=60.0))


def test_the_largest_speed_is_that_of_the_7003c_in_nd_m(small):
    """2.6e6 mm r/min over 16 mm; from 26 mm on 100,000 r/min, which the FMU of the example always had."""
    assert small.bearing.most_speed == 162_500.0
    for key in ("speed_rpm", "lowest_speed_rpm"):
        assert small.replace({f"operation.{key}": 162_500.0})
        with pytest.raises(SceneError, match=rf"operation.{key} = 162501.0 is refused; .* to 162500 r/min"):
            small.replace({f"operation.{key}": 162_501.0})
    example = read_scene(EXAMPLES / "7003C-bare.toml")
    assert example.bearing.most_speed == 1e5 == read_scene(EXAMPLES / "7009C-steel.toml").bearing.most_speed
    with pytest.raises(SceneError, match="allowed: -100000 to 100000 r/min, n d_m of 2.6e6 mm r/min or more"):
        example.replace({"operation.speed_rpm": 100_001.0})


@pytest.mark.parametrize("arrangement", [None, "DB"])
def test_the_input_of_the_fmu_reaches_as_far(arrangement):
    text = new_scene("a", "NSK-7900C", sound=False, preload_N=15.0, arrangement=arrangement)
    for scene, most in ((read_scene_text(text), 162_500.0), (read_scene(PAIR), 100_000.0)):
        (speed,) = (one for one in inputs_of(scene) if one.name == "shaft_speed")
        assert -speed.min == speed.max == pytest.approx(most * RPM, rel=1e-5) and speed.max >= most * RPM


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
@pytest.mark.parametrize("rpm", [PRINTED, 162_500.0, -162_500.0])
def test_a_small_bearing_runs_at_its_limit(small, fidelity, rpm):
    """All is finite, and the cage turns at 0.40 to 0.45 of the shaft: 0.5 (1 - D_w/d_m) is 0.40."""
    run = simulate(small.replace({"operation.speed_rpm": rpm, "fidelity.model": fidelity}), 5e-3, step=1e-4)
    assert all(np.isfinite(run[name]).all() for name in run.names)
    assert 0.40 < float(run["cage.speed_ratio"][-1]) < 0.45
    assert math.copysign(1.0, float(run["friction_torque"][-1])) == math.copysign(1.0, rpm)


def test_the_smallest_bearing_runs_at_its_limit():
    """Of 2 mm bore, at 650,000 r/min: dental turbines turn at some 400,000."""
    scene = read_scene_text(new_scene("a", Dimensions(2.0, 6.0, 2.3), sound=False, preload_N=5.0))
    scene = scene.replace({"operation.speed_rpm": 650_000.0, "fidelity.model": "full"})
    assert scene.bearing.most_speed == 650_000.0
    run = simulate(scene, 1e-3, step=1e-4)
    assert all(np.isfinite(run[name]).all() for name in run.names)


def test_loads_on_a_set_are_bounded_by_what_its_bearings_carry():
    """Twice C0 each, as of one bearing: two 7003C 13.8 kN across, and 20 kN along the axis."""
    pair = read_scene(PAIR)
    bearing, number = pair.bearing, len(pair.spindle.bearing)
    most = {"x": number * bearing.most_preload, "y": number * bearing.most_radial}
    most["z"] = most["y"]
    inputs = {one.name: one for one in inputs_of(pair)}
    for axis, force in most.items():
        assert pair.replace({f"spindle.load.force_{axis}_N": -force})
        words = (
            f"force_{axis}_N = .* is refused; allowed: -{force:g} to {force:g} N, twice the static rating C0"
        )
        with pytest.raises(SceneError, match=f"spindle.load.{words} of its {number} bearings or more"):
            pair.replace({f"spindle.load.force_{axis}_N": 1.01 * force})
        assert -inputs[f"nose.force.{axis}"].min == inputs[f"nose.force.{axis}"].max == force


def test_a_large_set_takes_more_than_100_kn():
    """Two 7218 of 40 deg, C0 some 90 kN each: 17.8 kN, which Harris prints of one, is far below."""
    size = Dimensions(90.0, 160.0, 30.0, 40.0)
    text = new_scene(
        "a", size, kind="steel", speed_rpm=1000.0, preload_N=1000.0, sound=False, arrangement="DB"
    )
    pair = read_scene_text(text)
    assert pair.replace({"spindle.load.force_x_N": 150_000.0}).spindle.load.force_x_N == 150_000.0
