"""Static stiffness of a set over speed and preload: its points, its file, the command, refusals."""

import csv

import numpy as np
import pytest

from fmu_bearing import read_scene, set_stiffness, shaft_statics
from tests.conftest import EXAMPLES
from tests.spindle.sets import scene

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


def test_stiffness_of_a_pair_follows_hertz_over_the_preload():
    # at standstill, while the contact angle hardly grows, stiffness goes with F^(1/3)
    found = set_stiffness(scene(), preloads=[0.01, 0.08])
    first, second = found.named("axial_stiffness")[0]
    # the angle grows by 1e-3 of its tangent
    assert second / first == pytest.approx(2.0, rel=0.01)


def test_a_set_without_preload_has_none_to_change():
    with pytest.raises(ValueError, match=r"has no \[spindle.preload\]"):
        set_stiffness(scene("++", (40.0, 55.0), None, load={"force_x_N": 100.0}), preloads=[1.0])


def test_points_are_those_of_the_statics_and_the_file_holds_them(tmp_path):
    speeds, preloads = [0.0, 15e3], [100.0, 200.0, 300.0]
    found = set_stiffness(DB, speeds, preloads)
    assert found.static.shape == (2, 3, 5, 5)
    keys = {"operation.speed_rpm": 15e3, "spindle.preload.preload_N": 200.0}
    one = shaft_statics(read_scene(DB).replace(keys))
    np.testing.assert_array_equal(found.static[1, 1], one.stiffness)
    assert found.named("nose_stiffness_bending")[1, 1] == one.nose_stiffness_bending
    # more preload, more stiffness; speed takes some away
    assert np.all(np.diff(found.named("axial_stiffness"), axis=1) > 0.0)
    with found.save(tmp_path / "k.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [(float(row["speed_rpm"]), float(row["preload_N"])) for row in rows] == [
        (speed, preload) for speed in speeds for preload in preloads
    ]
    assert float(rows[4]["K_bz_bz [N.m/rad]"]) == one.stiffness[4, 4]
    assert float(rows[4]["K_nose [N/m]"]) == one.nose_stiffness
    with pytest.raises(ValueError, match="written as .csv"):
        found.save(tmp_path / "k.nc")


def test_springs_take_the_force_as_preload():
    spring = {"spindle.preload": {"kind": "spring", "force_N": 100.0}, "spindle.bearing[2].seat": "sliding"}
    given = scene(preload=None, changes=spring)
    found = set_stiffness(given, preloads=[300.0])
    expected = shaft_statics(given.replace({"spindle.preload.force_N": 300.0}))
    np.testing.assert_array_equal(found.static[0, 0], expected.stiffness)
