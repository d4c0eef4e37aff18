"""Scenes from tables and from other scenes: one check, that of scene files, with the same messages."""

import pathlib
import tomllib

import numpy as np
import pytest

from fmu_bearing.scene import Scene, SceneError, read_scene, read_scene_text, scene_of
from fmu_bearing.scene.read import catalogue
from tests.conftest import GATES
from tests.messages import says

FILE = GATES / "7003C-spindle.toml"
TEXT = FILE.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def spindle():
    return read_scene(FILE)


def reported(call, *arguments):
    """Lines of a refusal, the scene's name taken off."""
    with pytest.raises(SceneError) as caught:
        call(*arguments)
    assert all(line.startswith("7003C-spindle: ") for line in caught.value.problems)
    return [line.removeprefix("7003C-spindle: ") for line in caught.value.problems]


def test_tables_read_like_a_file(spindle):
    data = tomllib.loads(TEXT)
    before = str(data)
    assert Scene.from_dict(data) == spindle
    assert str(data) == before, "what is given is left as it was"
    assert Scene.from_dict(spindle.model_dump()) == spindle
    assert Scene.from_dict(spindle.model_dump(mode="json", exclude_none=True)) == spindle


def test_tables_take_catalogue_names_arrays_and_parts(spindle):
    flexure = {"outer_ring": np.array([2, 3]), "outer_seat_stiffness_N_m": np.float64(1e6)}
    found = Scene.from_dict(
        spindle.model_dump()
        | {"bearing": {"catalogue": "7003C"}, "materials": spindle.materials}
        | {"mounting": spindle.mounting.model_dump() | {"flexure": flexure}}
    )
    assert found.bearing.pitch_diameter_mm == catalogue("bearings")["7003C"]["pitch_diameter_mm"]
    assert found.materials == spindle.materials and found.mounting.flexure.outer_ring == (2, 3)


@pytest.mark.parametrize(
    ("key", "value", "old", "new"),
    [
        ("mounting.preload_N", -1, "preload_N = 500.0", "preload_N = -1"),
        ("mounting.preload_N", "500", "preload_N = 500.0", 'preload_N = "500"'),
        ("mounting.prelaod_N", 500, "[mounting]", "[mounting]\nprelaod_N = 500"),
        ("mounting.speed_rpm", 500, "[mounting]", "[mounting]\nspeed_rpm = 500"),
        ("operatoin.speed_rpm", 500, "[operation]", "[operatoin]\nspeed_rpm = 500\n[operation]"),
        ("fidelity.model", "ring", 'model = "full"', 'model = "ring"'),
        ("fidelity.level", "full", "[fidelity]", '[fidelity]\nlevel = "full"'),
        ("bearing.ball_count", 20, "ball_count = 12", "ball_count = 20"),
        ("sound.microphone[4].x_mm", 1e9, "x_mm = -80.5", "x_mm = 1000000000.0"),
    ],
)
def test_messages_are_those_of_a_file(spindle, key, value, old, new):
    assert old in TEXT
    with pytest.raises(SceneError) as of_file:
        read_scene_text(TEXT.replace(old, new, 1), "7003C-spindle")
    assert reported(spindle.replace, {key: value}) == [
        line.removeprefix("7003C-spindle: ") for line in of_file.value.problems
    ]


def test_replaced_values_stand_beside_the_old_ones(spindle):
    found = spindle.replace({"mounting.preload_N": 300, "sound.microphone[2].y_mm": np.float64(150.0)})
    assert found.mounting.preload_N == 300.0 and isinstance(found.mounting.preload_N, float)
    assert found.microphones[1].position_m[1] == 0.15
    y = spindle.sound.microphone[1].y_mm
    assert found.replace({"mounting.preload_N": 500.0, "sound.microphone[2].y_mm": y}) == spindle
    assert spindle.mounting.preload_N == 500.0
    assert spindle.replace({"sound": None, "mounting.housing": None}).microphones == []


def test_a_name_of_the_catalogue_replaces_what_its_entry_holds(spindle):
    found = spindle.replace({"bearing.catalogue": "7009C", "bearing.contact_damping_us": 1.0, "sound": None,
                             "mounting.housing": None})  # fmt: skip
    entry = catalogue("bearings")["7009C"]
    assert found.bearing.ball_count == entry["ball_count"] and found.bearing.contact_damping_us == 1.0
    graded = spindle.replace({"imperfections.unbalance_um": 0.5, "imperfections.grade": "P5"})
    grade = catalogue("grades")["P5"]
    assert graded.imperfections.inner_race_amplitude_um == grade["inner_race_amplitude_um"]
    assert graded.imperfections.unbalance_um == 0.5
    assert graded.imperfections.seed == spindle.imperfections.seed
    (line,) = reported(spindle.replace, {"bearing.catalogue": "7003"})
    assert line.startswith("bearing.catalogue = '7003' is not in the catalogue; did you mean '7003C'?")
    (line,) = reported(spindle.replace, {"materials.balls": "Si3N"})
    assert line.startswith("materials.balls = 'Si3N' is not in the catalogue; did you mean 'Si3N4'?")


def test_tables_are_made_as_a_file_makes_them(spindle):
    perfect = spindle.replace({"imperfections": None})
    lines = reported(perfect.replace, {"imperfections.seed": 3})
    assert "imperfections.unbalance_um is missing, for example unbalance_um = " in "".join(lines)
    for seeded in (
        perfect.replace({"imperfections": {"grade": "P4", "seed": 3}}),
        perfect.replace({"imperfections.grade": "P4", "imperfections.seed": 3}),
    ):
        assert seeded.imperfections.seed == 3 and seeded.imperfections.follows_law


def test_places_that_no_scene_has(spindle):
    (line,) = reported(spindle.replace, {"sound.microphone[99].x_mm": 1.0})
    assert line.endswith("[sound.microphone] has 4 members; give the whole array to lengthen it")
    (line,) = reported(spindle.replace, {"sound.microphone[0].x_mm": 1.0})
    assert line.endswith("members of [sound.microphone] are counted from 1, the first one is [1]")
    (line,) = reported(spindle.replace, {"sound.microphone.x_mm": 1.0})
    assert says(line, "sound.microphone is an array ... as in [1]")
    (line,) = reported(spindle.replace, {"name.first": "a"})
    assert line == "name.first is not a key of a scene; name is a value, no table"
    (line,) = reported(spindle.replace, {"mounting[1].preload_N": 1.0})
    assert line == "mounting[1].preload_N is not a key of a scene; mounting is not an array"


def test_all_problems_are_reported_at_once(spindle):
    lines = reported(spindle.replace, {"name.first": "a", "mounting.preload_N": 2e6, "bearing.bor_mm": 3.0})
    assert len(lines) == 3 and "did you mean 'bore_mm'?" in "".join(lines)


def test_a_scene_or_its_path(spindle):
    assert scene_of(spindle) is spindle
    assert scene_of(FILE) == scene_of(str(FILE)) == spindle
    with pytest.raises(SceneError, match="Scene.from_dict takes tables"):
        scene_of({"name": "a"})
    with pytest.raises(SceneError, match="no such scene file"):
        scene_of(pathlib.Path("none.toml"))
    with pytest.raises(TypeError, match="from_dict takes tables by name, not str"):
        Scene.from_dict("name = 1")
