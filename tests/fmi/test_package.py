"""The file: what is in it, and that it is the same whenever and wherever it is built."""

import dataclasses
import hashlib
import os
import re
import runpy
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest

import fmu_bearing
from fmu_bearing.compiled.platforms import host
from fmu_bearing.engine.layout import P
from fmu_bearing.files import cache_root
from fmu_bearing.fmi import resources
from fmu_bearing.fmi.package import ChoiceError, build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene

from .conftest import OK, ROOT, STEP
from .differences import DIFFERENCES


def command(*arguments, **environment):
    return subprocess.run(
        [sys.executable, str(ROOT / "build_fmu.py"), *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, "COLUMNS": "200", **environment},
        timeout=600,
    )


def test_building_twice_gives_identical_bytes(model, fmu, flavour, tmp_path):
    again = build(model, tmp_path / "other name.fmu", flavour).path
    assert again.read_bytes() == fmu.read_bytes()


@pytest.mark.heavy
def test_another_process_builds_identical_bytes_and_says_what(fmu, flavour, scene_file, tmp_path):
    target = tmp_path / "new folder" / "Bearing.fmu"
    where = {"PYTHONHASHSEED": "7", "TZ": "Asia/Tokyo", "LC_ALL": "C"}
    built = command(scene_file, "-o", target, "--flavour", flavour, **where)
    assert built.returncode == 0, built.stderr
    assert hashlib.sha256(target.read_bytes()).digest() == hashlib.sha256(fmu.read_bytes()).digest()
    line = built.stdout.strip()
    assert "\n" not in line
    made = fmpy.read_model_description(str(target))
    platforms = {"native": f"native build for {host().name};", "python": "python build for linux64, win64;"}
    for part in (str(target), made.guid, f"{len(made.modelVariables)} variables", "KiB", platforms[flavour]):
        assert part in line


@pytest.mark.heavy
def test_without_a_scene_the_default_one_is_built(tmp_path):
    target = tmp_path / "Bearing.fmu"
    built = command("-o", target)
    assert built.returncode == 0, built.stderr
    assert fmpy.read_model_description(str(target)).modelName == "7003C-spindle"
    with zipfile.ZipFile(target) as archive:
        assert b'radiation_model = "bem"' in archive.read("resources/scene.toml")


@pytest.mark.parametrize("case", ["missing", "broken", "wrong value", "no place", "folder"])
def test_errors_take_one_line_and_exit_code_2(case, scene_file, tmp_path, monkeypatch, capsys):
    scene, target = tmp_path / "scene.toml", tmp_path / "b.fmu"
    text = scene_file.read_text(encoding="utf-8")
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
    monkeypatch.setattr(sys, "argv", ["build_fmu.py", str(scene), "-o", str(target)])
    monkeypatch.setenv("COLUMNS", "200")
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(ROOT / "build_fmu.py"), run_name="__main__")
    said = capsys.readouterr()
    assert (ended.value.code, said.out) == (2, "")
    assert len(said.err.strip().splitlines()) == 1, said.err
    assert "Traceback" not in said.err
    assert list(tmp_path.glob("*.fmu")) == []


def test_an_fmu_only_for_here_takes_no_platforms(model, tmp_path):
    with pytest.raises(ChoiceError, match="is for this machine: name no platforms"):
        build(model, tmp_path / "bearing.fmu", platforms=["win64"], only_here=True)
    assert list(tmp_path.iterdir()) == []


COMMON = (
    "modelDescription.xml",
    "model.png",
    "documentation/index.html",
    "documentation/fmi-ls-ref.txt",
    "documentation/licenses/license.txt",
    "extra/org.fmi-standard.fmi-ls-ref/fmi-ls-manifest.xml",
    "extra/org.fmi-standard.fmi-ls-ref/reference.csv",
    "extra/org.fmi-standard.fmi-ls-ref/reference.exp",
    "resources/scene.toml",
)
PYTHON = (
    "binaries/linux64/Bearing7003C.so",
    "binaries/win64/Bearing7003C.dll",
    "documentation/externalDependencies.txt",
    "documentation/licenses/pythonfmu.txt",
    "resources/parameters.npy",
    "resources/slavemodule.txt",
)


def test_contents(fmu, model, flavour):
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
        assert {info.date_time for info in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        own = ["resources/model.bin", f"binaries/{host().name}/Bearing7003C{host().suffix}"]
        if flavour == "python":
            stub = archive.read("resources/slavemodule.txt").decode("ascii")
            own = [*PYTHON, f"resources/{stub}.py"]
        assert names == sorted((*COMMON, *own))
        licence = archive.read("documentation/licenses/license.txt").decode("utf-8")
        assert licence == (ROOT / "LICENSE").read_text(encoding="utf-8")
        page = archive.read("documentation/index.html").decode("utf-8")
    assert "Validity range" in page
    assert "$" not in page.split("<h2>Scene</h2>")[0]
    for variable in model.variables:
        assert f"<code>{variable.name}</code>" in page


def test_scene_inside_is_the_scene(unpacked, model):
    assert read_scene(unpacked / "resources" / "scene.toml") == model.scene


def test_model_inside_is_the_model(unpack, model):
    inside = resources.load(unpack("python") / "resources", resources.fingerprint(model))
    assert inside.parameters.tobytes() == model.parameters.tobytes()
    assert inside.variables == model.variables


def test_damaged_numbers_are_refused(master, unpacked, flavour, expected, tmp_path, capfd):
    folder = tmp_path / "damaged"
    shutil.copytree(unpacked, folder)
    file = folder / "resources" / {"native": "model.bin", "python": "parameters.npy"}[flavour]
    data = bytearray(file.read_bytes())
    data[-3] ^= 1
    file.write_bytes(data)
    resources.load.cache_clear()
    one = master(folder)
    assert one.instance is None
    said = {"log": one.messages, "stderr": capfd.readouterr().err}
    assert "damaged" in said[expected["reason of no instance"]]
    assert file.parent.name in said[expected["reason of no instance"]]
    assert master().start().step(0.0) == OK  # others go on


def test_model_of_another_engine_is_refused(unpack, model, monkeypatch):
    # its kernels would read offsets where there are none, and write beyond the arrays
    expected = resources.fingerprint(model)
    monkeypatch.setattr(resources, "engine_digest", lambda: b"another engine")
    resources.load.cache_clear()
    with pytest.raises(ValueError, match="another version"):
        resources.load(unpack("python") / "resources", expected)


def test_two_scenes_in_one_process(unpacked, flavour, scene_file, tmp_path, master):
    # a second scene with the same bearing in the same process must not get the first one's model
    scene = tmp_path / "softer.toml"
    text = scene_file.read_text(encoding="utf-8")
    scene.write_text(text.replace("preload_N =", "preload_N = 77.0 #"), encoding="utf-8")
    softer = build(prepare(read_scene(scene)), tmp_path / "softer.fmu", flavour).path
    folder = tmp_path / "softer"
    fmpy.extract(softer, folder)
    one, other, lone = master().start(), master(folder).start(), master().start()
    assert other.get("preload") == 77.0
    assert one.get("preload") != 77.0
    assert one.run(2) == lone.run(2) != other.run(2)
    if flavour == "python":
        stubs = {next((each / "resources").glob("*.py")).stem for each in (unpacked, folder)}
        assert len(stubs) == 2


def test_library_serves_every_scene(unpack, model, tmp_path):
    # of a native build, only model.bin differs
    numbers = model.parameters.copy()
    numbers[P.MU] *= 0.5
    other = build(dataclasses.replace(model, parameters=numbers), tmp_path / "o.fmu", "native")
    unpacked = unpack("native")
    libraries = list(unpacked.glob("binaries/*/*"))
    assert libraries
    with zipfile.ZipFile(other.path) as archive:
        for library in libraries:
            name = library.relative_to(unpacked).as_posix()
            assert archive.read(name) == library.read_bytes()
        assert archive.read("resources/model.bin") != (unpacked / "resources" / "model.bin").read_bytes()


def test_blanks_in_paths(fmu, tmp_path):
    target = tmp_path / "a folder" / "my bearing.fmu"
    target.parent.mkdir()
    shutil.copy(fmu, target)
    unpacked = tmp_path / "unpacked here and there"
    fmpy.extract(target, unpacked)
    plain = tmp_path / "plain"
    fmpy.extract(fmu, plain)
    blank, other = (
        fmpy.simulate_fmu(
            str(folder), stop_time=2 * STEP, step_size=STEP, output_interval=STEP, output=["friction_torque"]
        )["friction_torque"]
        for folder in (unpacked, plain)
    )
    # N m: the 7003C at 500 N; the same numbers wherever it lies
    assert len(blank) == 3 and (blank > 1e-3).all() and (blank < 0.1).all()
    assert blank.tobytes() == other.tobytes()


def test_many_instances_one_after_another(master):
    # pythonfmu 0.7.0 frees the stub's namespace under our feet unless it is held
    path = sys.path.copy()
    for _ in range(20):
        bearing = master()
        assert bearing.reset() == OK
    assert bearing.get("shaft_speed") == float(bearing.by_name["shaft_speed"].start)
    assert sys.path == path


def test_nothing_inside_points_to_where_it_was_built(fmu, flavour):
    """Neither the repository, nor the installed package, nor where kernels are kept is needed elsewhere."""
    places = {str(ROOT), str(Path(fmu_bearing.__file__).parent), str(cache_root())}
    seen = set()
    with zipfile.ZipFile(fmu) as archive:
        for name in archive.namelist():
            # pythonfmu's libraries come as they are and were built on a machine of theirs
            if flavour == "native" or not name.startswith("binaries/"):
                seen.add(name.split("/")[0])
                content = archive.read(name)
                assert [place for place in places if place.encode() in content] == [], name
    assert {"modelDescription.xml", "documentation", "resources"} <= seen
    assert ("binaries" in seen) == (flavour == "native")


@pytest.mark.pages
def test_documentation_names_every_difference():
    page = (ROOT / "docs" / "fmu.md").read_text(encoding="utf-8")
    named = re.findall(r"(?<!\*)\*([^*|]+)\*(?!\*)", page.split("## What it answers")[1])
    assert sorted(set(named) - {"italics"}) == sorted(row.behaviour for row in DIFFERENCES)
    assert all(row.native != row.python and row.why for row in DIFFERENCES)
