"""Processes that commands start: they take no code from the current folder, and end with the program."""

import os
import re
import subprocess
import sys

import pytest

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.platforms import host, platform_named
from fmu_bearing.fmi.native.link import compiler_for
from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from tests.conftest import EXAMPLES, ROOT
from tests.native_builds import no_native_fmu

SCENE = str(EXAMPLES / "7003C-bare.toml")
#: Modules that a child needs, of Python and of others, and some that Python takes where they are there.
NAMES = (
    "json", "queue", "socket", "ziglang", "logging", "tempfile", "zipfile", "pathlib", "random", "struct",
    "subprocess", "threading", "typing", "dataclasses", "numpy", "fmpy", "ctypes", "multiprocessing",
    "pickle", "fmu_bearing", "sitecustomize", "usercustomize", "fmu_manipulation_toolbox", "llvmlite",
    "pkgutil",
)  # fmt: skip
#: Those that Python itself takes for `python -m`, before any program begins.
EARLY = ("pkgutil", "sitecustomize", "usercustomize", "fmu_bearing", "typing")
#: What a trap does: it leaves word, and ends the process.
TRAP = """
import os
with open({mark!r}, "a") as file:
    file.write(__name__ + " ")
os._exit(77)
"""


@pytest.fixture
def trapped(tmp_path):
    """A folder with traps; the function runs a command in it and returns what it printed."""
    folder, mark = tmp_path / "received", tmp_path / "mark"
    folder.mkdir()
    for name in NAMES:
        (folder / f"{name}.py").write_text(TRAP.format(mark=str(mark)), "utf-8")

    def run(*command, without=(), **options):
        for name in without:
            (folder / f"{name}.py").unlink()
        filled = [word.format(out=tmp_path / "out") for word in command]
        places = os.pathsep.join([*filter(None, sys.path)])
        ran = subprocess.run(
            filled, cwd=folder, capture_output=True, text=True, timeout=600,
            env={**os.environ, "PYTHONPATH": places} | options,
        )  # fmt: skip
        assert not mark.exists(), f"run in place of Python's: {mark.read_text()}"
        return ran

    return run


@pytest.fixture(scope="module")
def fmu(scene, tmp_path_factory):
    silent = scene("7003C-bare").model_copy(update={"sound": None})
    try:
        return str(build(prepare(silent), tmp_path_factory.mktemp("fmu") / "a.fmu", "native").path)
    except BuildError as problem:
        no_native_fmu(problem)


PROGRAM = (sys.executable, "-P", "-m", "fmu_bearing")


def test_the_traps_work(trapped):
    """Without the precaution each of these commands would run one."""
    with pytest.raises(AssertionError, match="run in place of Python's: json"):
        trapped(sys.executable, "-c", "import json")


@pytest.mark.heavy
def test_validate(trapped, fmu):
    ran = trapped(*PROGRAM, "validate", fmu)
    assert ran.returncode == 0, ran.stdout + ran.stderr


@pytest.mark.skipif(host() is None, reason="no platform of FMI 2.0")
def test_linking(trapped, tmp_path):
    """What `build` runs, on a source without kernels, whose compilation takes minutes."""
    try:
        compiler_for(host(), "cc")
    except BuildError as problem:
        no_native_fmu(problem)
    (tmp_path / "one.c").write_text("int one(void) { return 1; }")
    script = (
        "from pathlib import Path; from fmu_bearing.fmi.native.link import compiler_for, host, link; "
        f"p = host(); made = link(compiler_for(p, 'cc'), p, [Path({str(tmp_path / 'one.c')!r})], [], '0'); "
        "print(len(made))"
    )
    ran = trapped(sys.executable, "-P", "-c", script)
    assert ran.stdout and int(ran.stdout) > 1000, ran.stderr


def test_zig(trapped):
    """Asked for its version: a first link for another platform takes it minutes."""
    pytest.importorskip("ziglang", reason="the package ziglang is not installed")
    command = [*compiler_for(platform_named("win64"), "zig").command, "--version"]
    ran = trapped(sys.executable, "-P", "-c", f"from fmu_bearing import children; children.run({command!r})")
    assert "clang" in ran.stdout and ran.returncode == 0, ran.stderr


@pytest.mark.parametrize(
    "words",
    [
        pytest.param(  # it loads tables and clusters, which takes tens of seconds beside other work
            ("sweep", "{scene}", "--axis", "speed=9000,9500", "--settle", "0.001", "--window", "0.002"),
            marks=pytest.mark.heavy,
        ),
        pytest.param(
            ("sensitivity", "{scene}", "--method", "morris", "--vary", "mounting.preload_N=100..200",
             "--vary", "operation.speed_rpm=9000..9500", "--samples", "4", "--variables",
             "contact.inner.load_mean"),
            marks=pytest.mark.heavy,
        ),
    ],
    ids=["sweep", "sensitivity"],
)  # fmt: skip
def test_workers(trapped, words, scene, tmp_path):
    path = tmp_path / "silent.toml"
    path.write_text(scene("7003C-bare").model_copy(update={"sound": None}).to_toml(), "utf-8")
    filled = [word.format(scene=path) for word in words]
    ran = trapped(*PROGRAM, *filled, "-w", "2", "-o", "{out}")
    assert ran.returncode == 0, ran.stderr


def test_the_compiler(trapped):
    """Without units it starts, sends nothing and ends; its modules are loaded all the same."""
    # an empty entry, as PYTHONPATH=$PYTHONPATH:... often leaves it, is the current folder
    script = (
        "import os; os.environ['PYTHONPATH'] = ':' + os.environ['PYTHONPATH']; "
        "from fmu_bearing.children import python, run; "
        "print(run(python('fmu_bearing.compiled.worker', 'lean')).returncode)"
    )
    ran = trapped(sys.executable, "-P", "-c", script)
    assert ran.stdout == "0\n", ran.stderr


@pytest.mark.heavy
def test_the_program_itself_once_it_runs(trapped):
    """`python -m` looks into the current folder until the program begins, and no longer."""
    ran = trapped(sys.executable, "-m", "fmu_bearing", "info", SCENE, without=EARLY)
    assert ran.returncode == 0, ran.stderr


def test_one_place_starts_processes():
    """A place of its own would need the precautions of its own."""
    starts = re.compile(
        r"subprocess\.|Popen\(|sys\.executable|os\.(system|exec|spawn|popen|posix_spawn)|fork\("
    )
    found = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "fmu_bearing").rglob("*.py")
        if starts.search(path.read_text("utf-8"))
    }
    assert found == {"fmu_bearing/children.py"}
