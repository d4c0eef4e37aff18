"""A wheel with kernels inside: its first run compiles nothing."""

import compileall
import os
import subprocess
import sys
import zipfile

import pytest

from fmu_bearing.compiled.platforms import PLATFORMS, host
from fmu_bearing.fmi.native.prebuilt import WHEEL_TAGS, fill
from tests.conftest import ROOT

_FIRST = """
import sys, time
from fmu_bearing import build_fmu, simulate
run = simulate(sys.argv[1], 2e-3)
print(time.process_time())
print(build_fmu(sys.argv[1], sys.argv[2]).path)
"""


def test_every_platform_has_a_tag():
    assert set(WHEEL_TAGS) == set(PLATFORMS)


@pytest.mark.heavy
def test_the_first_run_from_a_wheel_compiles_nothing(tmp_path, scene_file):
    """Neither kernels nor, for the machine's own platform, a C compiler: 5 s to the first result."""
    pytest.importorskip("ziglang")
    fill(tmp_path / "prebuilt", host())
    environment = {**os.environ, "FMU_BEARING_PREBUILT": str(tmp_path / "prebuilt")}
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "wheel", "--no-deps", "-w", tmp_path, ROOT], env=environment, check=True)
    (wheel,) = tmp_path.glob("*.whl")
    assert WHEEL_TAGS[host().name].split("-")[-1] in wheel.name
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "site")
    compileall.compile_dir(tmp_path / "site", quiet=1)  # as an installation does
    lonely = {
        "PATH": "",
        "CC": "",
        "HOME": str(tmp_path),
        "PYTHONPATH": str(tmp_path / "site"),
        "FMU_BEARING_CACHE": str(tmp_path / "empty"),
    }
    run = [sys.executable, "-c", _FIRST, str(scene_file), str(tmp_path / "bearing.fmu")]
    ran = subprocess.run(run, env=lonely, cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    assert "compiling" not in ran.stderr
    assert not list((tmp_path / "empty").glob("compiled-*/*.o"))
    # Imports, filters and the run: 2.8 s of an idle machine's processor, up to 7.5 s where others work on the
    # second core. Compiling would take 90 s.
    assert float(ran.stdout.split()[0]) < 15.0
