"""Static stiffness of a set over speed and preload: its points, its file, the command, refusals."""

import csv

import numpy as np
import pytest

from fmu_bearing import operating_point, read_scene, statics, stiffness
from tests.conftest import EXAMPLES
from tests.spindle.sets import scene

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


def test_stiffness_of_a_pair_follows_hertz_over_the_preload():
    # at standstill, while the contact angle hardly grows, stiffness goes with F^(1/3)
    found = stiffness(scene(), None, [1e3], preloads=[0.01, 0.08])
    first, second = found.named("axial_stiffness")[0]
    # the angle grows by 1e-3 of its tangent
    assert second / first == pytest.approx(2.0, rel=0.01)


def test_a_set_without_preload_has_none_to_change():
    with pytest.raises(ValueError, match=r"has no \[spindle.preload\]"):
        stiffness(scene("++", (40.0, 55.0), None, load={"force_x_N": 100.0}), preloads=[1.0])


def test_points_are_those_of_the_statics_and_the_file_holds_them(tmp_path):
    speeds, preloads = [0.0, 15e3], [100.0, 200.0, 300.0]
    found = stiffness(DB, speeds, [1e3], preloads=preloads)
    assert found.nose.static.shape == (2, 3, 5, 5)
    keys = {"operation.speed_rpm": 15e3, "spindle.preload.preload_N": 200.0}
    one = statics(read_scene(DB).replace(keys))
    np.testing.assert_array_equal(found.nose.static[1, 1], one.stiffness)
    assert found.named("nose_stiffness_bending")[1, 1] == one.nose_stiffness_bending
    # more preload, more stiffness; speed takes some away
    assert np.all(np.diff(found.named("axial_stiffness"), axis=1) > 0.0)
    files = found.save(tmp_path / "k.csv")
    assert [file.name for file in files] == ["k.csv", "k-1.csv", "k-2.csv"]
    with files[0].open() as file:
        rows = list(csv.DictReader(file))
    assert [(float(row["speed_rpm"]), float(row["preload_N"])) for row in rows] == [
        (speed, preload) for speed in speeds for preload in preloads
    ]
    assert float(rows[4]["K_bz_bz [N.m/rad]"]) == one.stiffness[4, 4]
    assert float(rows[4]["K_nose [N/m]"]) == one.nose_stiffness
    with pytest.raises(ValueError, match="written as .csv"):
        found.nose.save(tmp_path / "k.nc")


def test_bearings_of_a_set_have_tables_of_their_own(tmp_path):
    """Matrices of each operating point, in the bearings' own axes; loads differ, so does stiffness."""
    found = stiffness(DB, [15e3], [0.1, 1e3])
    points = operating_point(DB).bearings
    for table, point in zip(found.bearings, points, strict=True):
        np.testing.assert_array_equal(table.static[0, 0], point.stiffness)
        # friction lets the spins follow at 0.1 Hz
        np.testing.assert_allclose(table.K[0, 0, 0], point.stiffness, rtol=1e-4, atol=2e3)
        assert table.on_shaft and table.scene.name == "7003C-DB"
    front, rear = found.bearings
    assert (front.number, front.sign, rear.number, rear.sign) == (1, 1, 2, -1)
    assert front.static[0, 0, 0, 0] > 1.2 * rear.static[0, 0, 0, 0]
    heads = [line.split(":")[0] for line in found.cautions() if line.startswith("bearing")]
    assert set(heads) <= {"bearing 1", "bearing 2"}
    assert len(set(found.cautions())) == len(found.cautions())


def test_a_single_bearing_has_no_nose():
    found = stiffness(EXAMPLES / "7003C-spindle.toml", [15e3], [1e3])
    assert found.nose is None and len(found.bearings) == 1
    with pytest.raises(ValueError, match="one bearing has no nose of a shaft"):
        found.named("axial_stiffness")


def test_inputs_of_a_set_count():
    warm = {"bearing[1].inner_ring_temperature": 333.15, "nose.force.z": -200.0}
    found = stiffness(DB, [15e3], [1e3], inputs=warm)
    cool = stiffness(DB, [15e3], [1e3])
    loads = [one.nose.points[0][0] for one in (cool, found)]
    assert loads[1].bearings[0].axial > 1.1 * loads[0].bearings[0].axial
    assert loads[1].load[2] - loads[0].load[2] == pytest.approx(-150.0)
    with pytest.raises(ValueError, match="preload is an axis of the table"):
        stiffness(DB, inputs={"preload": 3.0})


def test_springs_take_the_force_as_preload():
    spring = {"spindle.preload": {"kind": "spring", "force_N": 100.0}, "spindle.bearing[2].seat": "sliding"}
    given = scene(preload=None, changes=spring)
    found = stiffness(given, None, [1e3], preloads=[300.0])
    expected = statics(given.replace({"spindle.preload.force_N": 300.0}))
    np.testing.assert_array_equal(found.nose.static[0, 0], expected.stiffness)
