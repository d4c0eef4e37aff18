"""The bearings of a scene: one way through a single bearing and through a set."""

import numpy as np
import pytest

from fmu_bearing import read_scene
from fmu_bearing.arrays import Arrays
from fmu_bearing.interface import variables
from fmu_bearing.interface.inputs import input_values
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.member import one_of, set_of
from tests.conftest import EXAMPLES, GATES
from tests.spindle.sets import scene, tables

SETS = EXAMPLES.parent / "spindle_set"
SINGLE = GATES / "7003C-bare.toml"


def test_bearings_of_a_set_are_in_their_order_from_the_nose():
    data = tables(bearings=[{}, {"seat": "sliding"}])
    data["spindle"]["preload"] = {"kind": "spring", "force_N": 300.0}
    given = Scene.from_dict(data)
    found = given.bearings()
    assert [(one.number, one.sign, one.seat, one.prefix) for one in found] == [
        (1, 1, "fixed", "bearing[1]."), (2, -1, "sliding", "bearing[2]."),
    ]  # fmt: skip
    # decimal prefixes divide: 70 mm is the double nearest to 0.07 m
    assert [one.position for one in found] == [0.04, 0.07]
    assert [one.scene for one in found] == [one_of(given, 0), one_of(given, 1)]


def test_each_bearing_of_a_set_has_its_own_seed():
    given = scene(rpm=10e3).replace({"imperfections": {"grade": "P4", "seed": 5}})
    assert [one.scene.imperfections.seed for one in given.bearings()] == [5, 6]


def test_a_single_bearing_is_the_whole_scene():
    given = read_scene(SINGLE)
    (one,) = given.bearings()
    assert (one.number, one.sign, one.position, one.seat, one.prefix) == (1, 1, 0.0, "pedestal", "")
    assert one.scene is given


@pytest.mark.parametrize("path", [SINGLE, SETS / "7003C-QBC.toml"], ids=["single", "set"])
def test_the_prefix_is_that_of_the_variables(path):
    given = read_scene(path)
    names = {variable.name for variable in variables(given, 0.0)}
    alone = {variable.name for variable in variables(read_scene(SINGLE), 0.0)}
    shared = {name for name in alone if name.startswith(("contact.", "heat."))}
    assert len(shared) > 10
    for one in given.bearings():
        assert {one.prefix + name for name in shared} <= names


@pytest.mark.parametrize("path", [SINGLE, SETS / "7003C-DB.toml"], ids=["single", "set"])
def test_arrays_and_model_have_the_inputs_of_the_scene(path):
    given = read_scene(path).replace({"sound": None})
    expected = input_values(given)
    for variable in variables(given, 0.0):
        if variable.array == "u":
            assert expected[variable.index] == variable.start, variable.name
    assert np.array_equal(prepare(given).inputs, expected)
    assert np.array_equal(Arrays.of(given).u, expected)


def test_what_needs_one_kind_of_scene_says_so():
    with pytest.raises(
        SceneError, match=r"^7003C-bare: has one bearing on its mounting; a set .* \[spindle\]"
    ):
        set_of(read_scene(SINGLE))
    with pytest.raises(SceneError, match=r"^7003C-DB: has a set of bearings on one shaft; .* \[mounting\]"):
        _ = read_scene(SETS / "7003C-DB.toml").mounted
