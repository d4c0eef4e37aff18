"""The commands of docs/interop.md run as printed, and its table names the versions of constraints.txt."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import ROOT, needs_linux64

# Other masters; one FMU and three in FMPy are quick tests (tests/fmi, examples/test_cosimulation).
pytestmark = pytest.mark.heavy

CONSTRAINTS = (ROOT / "constraints.txt").read_text(encoding="utf-8")
PAGE = (ROOT / "docs" / "interop.md").read_text(encoding="utf-8")


@needs_linux64
def test_commands_run_as_printed(native, compiler, tmp_path):
    assert compiler
    if shutil.which("unzip") is None:
        pytest.skip("no unzip on the path; ecos needs it too")
    for name in ("examples", "tests"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "out").mkdir()
    shutil.copy(native, tmp_path / "out" / "Bearing7003C.fmu")
    script = "\n".join(re.findall(r"```sh\n(.*?)```", PAGE, flags=re.DOTALL))
    programs = Path(sys.executable).parent
    environment = os.environ | {
        "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": str(ROOT),
    }
    ran = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", script],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    made = {path.name for path in (tmp_path / "out").iterdir()}
    tables = {"fmpy.csv", "Bearing7003C.csv", "pair.csv", "spindle.csv"} | {
        f"spindle_{engine}.csv" for engine in ("fmpy", "ecos", "libcosim")
    }
    assert tables <= made
    for name in tables:
        assert len((tmp_path / "out" / name).read_text().splitlines()) > 5, name
    assert ran.stdout.count("largest difference to FMPy 0\n") == 3


@pytest.mark.parametrize(
    ("words", "package"),
    [
        ("FMPy", "fmpy"),
        ("ecos", "ecospy"),
        ("libcosimpy", "libcosimpy"),
        ("fmu-manipulation-toolbox", "fmu_manipulation_toolbox"),
        ("motor and thermal FMU", "pythonfmu"),
    ],
)
def test_versions(words, package):
    version = re.search(rf"^\| {words}[^|]*\| ([\d.]+) \|", PAGE, flags=re.MULTILINE)
    assert version is not None
    pinned = re.search(rf"^{package}==(.*)$", CONSTRAINTS, flags=re.MULTILINE | re.IGNORECASE)
    assert pinned is not None
    assert version[1] == pinned[1], "another version: look at its limits again and say so on the page"
