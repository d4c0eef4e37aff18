"""The file: what is in it, and that it is the same whenever and wherever it is built."""

import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile

import fmpy
import pytest

from fmu_bearing.fmi import resources
from fmu_bearing.fmi.package import build
from fmu_bearing.scene import read_scene

from .conftest import DEFAULT_SCENE, ROOT, STEP


def command(*arguments, **environment):
    return subprocess.run(
        [sys.executable, str(ROOT / "build_fmu.py"), *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, "COLUMNS": "200", **environment},
    )


def test_building_twice_gives_identical_bytes(model, fmu, tmp_path):
    again = build(model, tmp_path / "other name.fmu").path
    assert again.read_bytes() == fmu.read_bytes()


def test_another_process_builds_identical_bytes(fmu, tmp_path):
    target = tmp_path / "b.fmu"
    built = command(DEFAULT_SCENE, "-o", target, PYTHONHASHSEED="7", TZ="Asia/Tokyo", LC_ALL="C")
    assert built.returncode == 0, built.stderr
    assert hashlib.sha256(target.read_bytes()).digest() == hashlib.sha256(fmu.read_bytes()).digest()


def test_command_says_what_was_built(tmp_path, description):
    target = tmp_path / "new folder" / "Bearing.fmu"
    built = command("-o", target)  # no scene: the default one
    assert built.returncode == 0, built.stderr
    line = built.stdout.strip()
    assert "\n" not in line
    for part in (str(target), description.guid, f"{len(description.modelVariables)} variables", "KiB"):
        assert part in line


@pytest.mark.parametrize("case", ["missing", "broken", "wrong value", "no place", "folder"])
def test_errors_take_one_line_and_exit_code_2(case, tmp_path):
    scene, target = tmp_path / "scene.toml", tmp_path / "b.fmu"
    text = DEFAULT_SCENE.read_text(encoding="utf-8")
    if case == "broken":
        scene.write_text("name = \n")
    elif case == "wrong value":
        scene.write_text(text.replace("preload_N =", "preload_N = -1 #"), encoding="utf-8")
    elif case != "missing":
        scene.write_text(text, encoding="utf-8")
    if case == "no place":
        (tmp_path / "file").write_text("")
        target = tmp_path / "file" / "b.fmu"
    elif case == "folder":
        target = tmp_path
    built = command(scene, "-o", target)
    assert built.returncode == 2
    assert built.stdout == ""
    assert len(built.stderr.strip().splitlines()) == 1, built.stderr
    assert "Traceback" not in built.stderr
    assert list(tmp_path.glob("*.fmu")) == []


def test_contents(fmu, model):
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
        assert names == sorted(names)
        assert {info.date_time for info in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        for name in (
            "modelDescription.xml",
            "model.png",
            "documentation/index.html",
            "documentation/externalDependencies.txt",
            "documentation/licenses/license.txt",
            "documentation/licenses/pythonfmu.txt",
            "resources/scene.toml",
            "resources/parameters.npy",
            "binaries/linux64/Bearing7003C.so",
            "binaries/win64/Bearing7003C.dll",
        ):
            assert name in names
        licence = archive.read("documentation/licenses/license.txt").decode("utf-8")
        assert licence == (ROOT / "LICENSE").read_text(encoding="utf-8")
        page = archive.read("documentation/index.html").decode("utf-8")
        stub = archive.read("resources/slavemodule.txt").decode("ascii")
        assert f"resources/{stub}.py" in names
    assert "Validity range" in page
    assert "$" not in page.split("<h2>Scene</h2>")[0]
    for variable in model.variables:
        assert f"<code>{variable.name}</code>" in page


def test_scene_inside_is_the_scene(unpacked, model):
    assert read_scene(unpacked / "resources" / "scene.toml") == model.scene


def test_model_inside_is_the_model(unpacked, model):
    inside = resources.load(unpacked / "resources", resources.fingerprint(model))
    assert inside.parameters.tobytes() == model.parameters.tobytes()
    assert inside.variables == model.variables


def test_damaged_numbers_are_refused(master, unpacked, tmp_path, capfd):
    folder = tmp_path / "damaged"
    shutil.copytree(unpacked, folder)
    file = folder / "resources" / "parameters.npy"
    data = bytearray(file.read_bytes())
    data[-3] ^= 1
    file.write_bytes(data)
    resources.load.cache_clear()
    with pytest.raises(Exception, match="instantiate"):
        master(folder)
    assert "damaged" in capfd.readouterr().err
    master().start().step(0.0)  # others go on


def test_model_of_another_engine_is_refused(unpacked, model, monkeypatch):
    # its kernels would read offsets where there are none, and write beyond the arrays
    expected = resources.fingerprint(model)
    monkeypatch.setattr(resources, "engine_digest", lambda: b"another engine")
    resources.load.cache_clear()
    with pytest.raises(ValueError, match="another version"):
        resources.load(unpacked / "resources", expected)


def test_stub_has_a_module_name_of_its_own(unpacked, model, tmp_path, master):
    # a second scene with the same bearing in the same process must not get the first one's model
    scene = tmp_path / "softer.toml"
    text = DEFAULT_SCENE.read_text(encoding="utf-8")
    scene.write_text(text.replace("preload_N =", "preload_N = 77.0 #"), encoding="utf-8")
    target = tmp_path / "softer.fmu"
    assert command(scene, "-o", target).returncode == 0
    folder = tmp_path / "softer"
    fmpy.extract(target, folder)
    one, other = master().start(), master(folder).start()
    assert other.get("preload") == 77.0
    assert one.get("preload") != 77.0
    stubs = {next((each / "resources").glob("*.py")).stem for each in (unpacked, folder)}
    assert len(stubs) == 2


def test_blanks_in_paths(fmu, tmp_path):
    target = tmp_path / "a folder" / "my bearing.fmu"
    target.parent.mkdir()
    shutil.copy(fmu, target)
    unpacked = tmp_path / "unpacked here and there"
    fmpy.extract(target, unpacked)
    result = fmpy.simulate_fmu(
        str(unpacked), stop_time=2 * STEP, step_size=STEP, output_interval=STEP, output=["friction_torque"]
    )
    assert len(result) == 3


def test_many_instances_one_after_another(master, unpacked):
    # pythonfmu 0.7.0 frees the stub's namespace under our feet unless it is held
    path = sys.path.copy()
    for _ in range(20):
        bearing = master()
        bearing.slave.reset()
    assert bearing.get("shaft_speed") == float(bearing.by_name["shaft_speed"].start)
    assert sys.path == path


def test_resources_need_no_repository(fmu):
    # nothing inside points to the machine it was built on
    with zipfile.ZipFile(fmu) as archive:
        for name in archive.namelist():
            if not name.startswith("binaries/"):
                assert str(ROOT).encode() not in archive.read(name), name
    assert importlib.util.find_spec("fmu_bearing") is not None
