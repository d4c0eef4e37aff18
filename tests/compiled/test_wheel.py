"""Wheels as `make wheels` builds them: what is inside, and a first run from one that compiles nothing.

Kernels that no test runs are not optimised here; `tests/native/test_cross_builds.py` makes them as for users.
"""

import email
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from dataclasses import dataclass
from pathlib import Path

import pytest

from fmu_bearing.compiled import disk_cache
from fmu_bearing.compiled.make import bitcode, folder, objects, sources_key
from fmu_bearing.compiled.platforms import PLATFORMS, host, instruction_set
from fmu_bearing.compiled.units import UNITS, object_name
from fmu_bearing.fmi.native.link import library_name
from fmu_bearing.fmi.native.prebuilt import WHEEL_TAGS
from tests.compiled import unoptimised
from tests.conftest import ROOT
from tests.native import binaries

#: Another platform than this machine's, of one instruction set.
FOREIGN = "aarch64-linux" if host() != PLATFORMS["aarch64-linux"] else "aarch64-darwin"
#: Format of objects and libraries, and processor.
FORMATS = {
    "linux64": ("ELF", "x86-64"),
    "aarch64-linux": ("ELF", "aarch64"),
    "win64": ("COFF", "x86-64"),
    "darwin64": ("Mach-O", "x86-64"),
    "aarch64-darwin": ("Mach-O", "aarch64"),
}
INSIDE = "fmu_bearing/compiled/prebuilt/"
BITCODE = b"BC\xc0\xde"
#: What a user does first, where no compiler is found.
_FIRST = """
import sys, time
sys.modules["ziglang"] = None  # as if it were not installed
import fmu_bearing
run = fmu_bearing.simulate(sys.argv[1], 2e-3)
print(time.process_time())
print(fmu_bearing.__file__)
print(fmu_bearing.build_fmu(sys.argv[1], sys.argv[2]).platforms)
"""


@dataclass(frozen=True)
class Wheel:
    """A wheel: its file, the tag in its metadata, and what lies in its folder of compiled kernels."""

    path: Path
    tag: str
    pure: bool
    prebuilt: dict[str, bytes]

    @classmethod
    def read(cls, path):
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            (about,) = (name for name in names if name.endswith(".dist-info/WHEEL"))
            fields = email.message_from_bytes(archive.read(about))
            prebuilt = {name.removeprefix(INSIDE): archive.read(name) for name in names if INSIDE in name}
        return cls(path, fields["Tag"], fields["Root-Is-Purelib"] == "true", prebuilt)


def kernel_files():
    """Return all files of kernels that wheels need, by name; optimised are those that this machine runs."""
    own = objects(host(), UNITS, [instruction_set(host())])
    files = {object_name(unit, host().name, one): data for (unit, one), data in own.items()}
    files |= {f"{unit}.bc": bitcode(unit) for unit in UNITS}
    for platform in (host(), PLATFORMS[FOREIGN]):
        for suffix, _ in platform.instruction_sets:
            for unit in UNITS:
                name = object_name(unit, platform.name, suffix)
                files[name] = files.get(name) or unoptimised.object_of(unit, platform.name, suffix)
    return files


@pytest.fixture(scope="module")
def wheels(tmp_path_factory):
    """Wheels of this machine's platform, of a foreign one, and the universal one, by tag.

    By the recipe of `make wheels`, with this interpreter in place of the environment that it makes.
    """
    pytest.importorskip("ziglang")
    if host() is None or shutil.which("make") is None:
        pytest.skip("no wheel can be made for this machine, or make is not installed")
    out, cache = tmp_path_factory.mktemp("out"), tmp_path_factory.mktemp("cache")
    files = kernel_files()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FMU_BEARING_CACHE", str(cache))
        for name, data in files.items():
            assert disk_cache.write(folder() / name, data, print)
    command = [
        "make", "wheels", f"PLATFORMS={host().name} {FOREIGN}", f"OUT={out}",
        f"BIN={Path(sys.executable).parent}", "VENV=any", "--old-file=any/.installed-test",
    ]  # fmt: skip
    outer = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")  # of the call of make that may have begun the tests
    environment = {name: value for name, value in os.environ.items() if name not in outer}
    environment["FMU_BEARING_CACHE"] = str(cache)
    subprocess.run(command, cwd=ROOT, env=environment, check=True, timeout=600)
    found = [Wheel.read(path) for path in (out / "wheels").glob("*.whl")]
    assert len(found) == 3
    return {wheel.tag: wheel for wheel in found}


def test_every_platform_has_a_tag_and_a_format():
    assert set(WHEEL_TAGS) == set(PLATFORMS) == set(FORMATS)


@pytest.mark.heavy
@pytest.mark.parametrize("own", [True, False], ids=["own", "foreign"])
def test_a_wheel_holds_what_its_platform_runs(wheels, own):
    platform = host() if own else PLATFORMS[FOREIGN]
    wheel = wheels[WHEEL_TAGS[platform.name]]
    assert wheel.path.name.endswith(f"-{wheel.tag}.whl")
    assert not wheel.pure
    objects = {
        object_name(unit, platform.name, suffix) for unit in UNITS for suffix, _ in platform.instruction_sets
    }
    code = {f"{unit}.bc" for unit in UNITS}
    assert wheel.prebuilt.keys() == {*objects, *code, library_name(platform), "key", "tag", "about.txt"}
    for name in objects:
        assert binaries.object_format(wheel.prebuilt[name]) == FORMATS[platform.name], name
    for name in code:
        assert wheel.prebuilt[name].startswith(BITCODE), name
    library = binaries.read(wheel.prebuilt[library_name(platform)])
    assert library.machine == FORMATS[platform.name][1]
    assert {"fmi2Instantiate", "fmi2DoStep", "fmi2FreeInstance"} <= library.exports
    assert wheel.prebuilt["key"].decode().strip() == sources_key()
    ran = "the tests ran these kernels" if own else "these kernels were never run"
    assert ran in wheel.prebuilt["about.txt"].decode()


@pytest.mark.heavy
def test_the_universal_wheel_holds_no_kernels(wheels):
    wheel = wheels["py3-none-any"]
    assert wheel.pure
    assert not wheel.prebuilt


@pytest.fixture(scope="module")
def installed(wheels, tmp_path_factory):
    """Python of a new environment in which pip has installed the wheel of this machine.

    What the package needs is that of the environment that runs the tests, so that nothing is loaded down.
    """
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, with_pip=True)
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    pip = [python, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    wheel = wheels[WHEEL_TAGS[host().name]].path
    subprocess.run([*pip, "install", "--no-index", "--no-deps", wheel], check=True, timeout=600)
    site = subprocess.run(
        [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
        check=True, stdout=subprocess.PIPE, text=True, timeout=600,
    ).stdout.strip()  # fmt: skip
    # behind the environment's own packages; links in there, to a checkout, are not followed
    places = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    Path(site, "outer.pth").write_text("\n".join(sorted(places)) + "\n", encoding="utf-8")
    subprocess.run([*pip, "check"], check=True, timeout=600)  # of versions that the wheel asks for
    return python, Path(site)


@pytest.mark.heavy
def test_the_first_run_from_a_wheel_compiles_nothing(installed, tmp_path, scene_file):
    """Neither kernels nor, for the machine's own platform, a C compiler: 5 s to the first result."""
    python, site = installed
    lonely = {"PATH": "", "CC": "", "HOME": str(tmp_path), "FMU_BEARING_CACHE": str(tmp_path / "empty")}
    run = [python, "-c", _FIRST, str(scene_file), str(tmp_path / "bearing.fmu")]
    ran = subprocess.run(run, env=lonely, cwd=tmp_path, capture_output=True, text=True, timeout=600)
    assert ran.returncode == 0, ran.stderr
    seconds, place, platforms = ran.stdout.splitlines()
    assert Path(place).is_relative_to(site)
    assert platforms == str((host().name,))  # a native build
    assert "compiling" not in ran.stderr
    assert not list((tmp_path / "empty").glob("compiled-*"))
    with zipfile.ZipFile(tmp_path / "bearing.fmu") as fmu:
        (library,) = (name for name in fmu.namelist() if name.endswith(host().suffix))
        assert fmu.read(library) == (site / INSIDE / library_name(host())).read_bytes()
    # Imports, filters, the run, and 2.9 s of Numba for two kernels of boundary elements: 4.3 to 7.2 s of a
    # processor whose cores others share. Compiling the engine would take 90 s.
    assert float(seconds) < 15.0
