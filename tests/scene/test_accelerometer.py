"""Accelerometers in a scene's file: keys, what is refused and the way out."""

import pytest

from fmu_bearing import read_scene
from fmu_bearing.scene import Scene, SceneError, read_scene_text
from tests.spindle.sets import scene as set_of

BARE = read_scene("examples/scenes/7003C-bare.toml")
SPINDLE = read_scene("examples/scenes/7003C-spindle.toml")


def with_sensors(scene, *sensors):
    """The scene, read again with sensors; each is named DE unless it has a name."""
    data = scene.model_dump(mode="json", exclude_none=True)
    return Scene.from_dict(data | {"accelerometer": [{"name": "DE"} | sensor for sensor in sensors]})


def test_sensors_are_read_and_written_back():
    mode = {"frequency_Hz": 3100.0, "damping_ratio": 0.02, "mass_kg": 4.0}
    scene = with_sensors(
        BARE, {"direction": "axial", "radius_mm": 16.0, "resonance_kHz": 28.0, "mode": [mode]}
    )
    (sensor,) = scene.accelerometers
    assert (sensor.on, sensor.direction, sensor.mode[0].mass_kg) == ("outer ring", "axial", 4.0)
    assert read_scene_text(scene.to_toml()) == scene
    assert BARE.accelerometers == ()
    assert with_sensors(SPINDLE, {"on": "housing", "x_mm": 60.0}).accelerometers[0].on == "housing"


@pytest.mark.parametrize(
    ("sensors", "words"),
    [
        ([{"on": "inner ring"}], "turns with the shaft"),
        ([{"on": "housing"}], r"needs a table \[mounting.housing\]: add it, or give on"),
        ([{"bearing": 1}], "is of a set of bearings"),
        ([{}, {}], "names must differ: DE"),
        ([{"radius_mm": 3.0}], "= 3 is not on the outer ring, which is from 14.8 to 17.5 mm"),
        ([{"x_mm": 9.0}], "= 9 is not on the outer ring, which is from -5 to 5 mm"),
    ],
)
def test_what_one_bearing_cannot_have_is_refused(sensors, words):
    with pytest.raises(SceneError, match=words):
        with_sensors(BARE, *sensors)


@pytest.mark.parametrize(
    ("sensor", "words"),
    [
        ({}, r"accelerometer\[1\].bearing is missing: 1 to 2"),
        ({"bearing": 3}, "the set has bearings 1 to 2"),
        ({"bearing": 1}, "that housing does not move, so there is nothing to read"),
        ({"on": "housing"}, "that housing does not move"),
        ({"on": "housing", "bearing": 1}, "leave it out"),
    ],
)
def test_what_a_set_cannot_have_is_refused(sensor, words):
    with pytest.raises(SceneError, match=words):
        with_sensors(set_of("+-", (40.0, 70.0)), sensor)
