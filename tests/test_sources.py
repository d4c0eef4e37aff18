"""Whatever takes a scene takes the path of its file."""

import pathlib

import numpy as np
import pytest

import fmu_bearing
from fmu_bearing import Recording, SceneError, record, spread
from fmu_bearing.accuracy.sensitivity import sensitivity
from fmu_bearing.accuracy.tradeoff import tradeoff
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.read import with_fidelity

#: Each public function that takes a scene, with what else it needs.
TAKE = {
    "Bearing": lambda scene: fmu_bearing.Bearing(scene),
    "compare": lambda scene: fmu_bearing.compare(scene, scene),
    "build_fmu": lambda scene: fmu_bearing.build_fmu(scene, "a.fmu"),
    "identify": lambda scene: fmu_bearing.identify(scene, [], ["mounting.preload_N"]),
    "record": lambda scene: record(scene, 0.01),
    "report": lambda scene: fmu_bearing.report(scene, "a.html"),
    "simulate": lambda scene: fmu_bearing.simulate(scene, 1e-3),
    "spread": lambda scene: spread(scene),
    "sweep": lambda scene: fmu_bearing.sweep(scene, {"preload": [1.0]}),
    "with_fidelity": lambda scene: fmu_bearing.with_fidelity(scene, tolerance=1e-3),
    "sensitivity": sensitivity,
    "tradeoff": tradeoff,
}


@pytest.fixture(scope="module")
def file(scene, tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "rings.toml"
    path.write_text(with_fidelity(scene("7003C-bare"), model="rings").to_toml(), "utf-8")
    return path


@pytest.mark.parametrize("kind", [str, pathlib.Path])
@pytest.mark.parametrize("name", TAKE)
def test_a_path_is_read(name, kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError, match=r"none\.toml: there is no such scene file"):
        TAKE[name](kind("none.toml"))


@pytest.mark.parametrize("name", TAKE)
def test_what_is_neither_scene_nor_path_is_refused(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError, match="a scene is a file, given by its path, or a Scene in memory, not"):
        TAKE[name]({})


def test_path_and_scene_give_the_same(file):
    ours, theirs = record(file, 0.01), record(read_scene(file), 0.01)
    assert np.array_equal(ours.channels, theirs.channels) and ours.scene == theirs.scene
    assert with_fidelity(file, tolerance=1e-4) == with_fidelity(read_scene(file), tolerance=1e-4)


def test_the_result_of_an_fmu_finds_its_microphones_by_the_path(file):
    table = np.zeros(200, dtype=[("time", float), ("mic[1].pressure", float)])
    table["time"] = np.arange(200) * Recording.PRESSURE_STEP
    ours = Recording.from_fmu(table, file, settle=0.0)
    assert ours.scene == read_scene(file) and ours.microphones[0][0] == "P1"


@pytest.mark.heavy
def test_the_spread_of_a_file_is_that_of_its_recording(file, tmp_path):
    recording = record(file, 0.1)
    recording.save(tmp_path / "run.npz")
    ours, theirs = (spread(source, ["P1"], seeds=1) for source in (tmp_path / "run.npz", recording))
    assert np.array_equal(ours.high, theirs.high)
    with pytest.raises(ValueError, match=r"none\.npz: there is no such file"):
        spread("none.npz")
