"""Wheels as `make wheels` builds them: what is inside, and a first run from one that compiles nothing.

Kernels that no test runs are not optimised here; `tests/native/test_cross_builds.py` makes them as for users.
"""

import email
import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from dataclasses import dataclass
from pathlib import Path

import pytest

from fmu_bearing.compiled import disk_cache
from fmu_bearing.compiled.make import bitcode, folder, objects, sources_key
from fmu_bearing.compiled.platforms import PLATFORMS, host, instruction_set
from fmu_bearing.compiled.units import UNITS, object_name
from fmu_bearing.fmi.native.link import LINKED, library_name
from fmu_bearing.fmi.native.prebuilt import WHEEL_TAGS
from tests.compiled import first_use, unoptimised
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
BITCODE = b"BC\xc0\xde"


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
            inside = [name for name in names if name.startswith(first_use.INSIDE)]
            prebuilt = {name.removeprefix(first_use.INSIDE): archive.read(name) for name in inside}
        return cls(path, fields["Tag"], fields["Root-Is-Purelib"] == "true", prebuilt)


def kernel_files():
    """Return all files of kernels that wheels need, by name; optimised are those that this machine runs."""
    own = objects(host(), UNITS, [instruction_set(host())])
    files = {object_name(unit, host().name, one): data for (unit, one), data in own.items()}
    files |= {f"{unit}.bc": bitcode(unit) for unit in LINKED}
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
    code = {f"{unit}.bc" for unit in LINKED}  # of the units in FMUs for other platforms
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


@pytest.mark.heavy
def test_every_wheel_is_small_and_typed(wheels):
    for wheel in wheels.values():
        assert first_use.look_into(wheel.path) > 500_000  # the package's own files take more than this


@pytest.mark.parametrize(
    ("size", "names", "words"), [(11_000_000, [], "11.00 MB"), (0, ["a.py"], "py.typed")]
)
def test_a_wheel_that_is_large_or_untyped_is_refused(size, names, words, tmp_path):
    path = tmp_path / "a.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("filling", b"0" * size)
        for name in names:
            archive.writestr(name, "")
    with pytest.raises(first_use.Problem, match=words):
        first_use.look_into(path)


def test_a_slow_first_run_is_refused():
    first_use.on_time({"scene new": 99.0, "simulate my.toml": 4.9})
    with pytest.raises(first_use.Problem, match=r"15\.1 CPU s"):
        first_use.on_time({"scene new": 1.0, "simulate my.toml": 15.1})


@pytest.fixture(scope="module")
def installed(wheels, tmp_path_factory):
    """Python of a new environment in which pip has installed the wheel of this machine.

    What the package needs is that of the environment that runs the tests, so that nothing is loaded down.
    """
    python = first_use.environment(tmp_path_factory.mktemp("environment"))
    first_use.pip(python, "install", "--no-index", "--no-deps", wheels[WHEEL_TAGS[host().name]].path)
    site = subprocess.run(
        [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
        check=True, stdout=subprocess.PIPE, text=True, timeout=600,
    ).stdout.strip()  # fmt: skip
    # behind the environment's own packages; links in there, to a checkout, are not followed
    places = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    Path(site, "outer.pth").write_text("\n".join(sorted(places)) + "\n", encoding="utf-8")
    first_use.pip(python, "check")  # of versions that the wheel asks for
    return python


@pytest.mark.heavy
def test_the_first_use_of_a_wheel_compiles_nothing(installed, tmp_path):
    """The README's commands and an FMU in FMPy, without a compiler or any other program."""
    seconds = first_use.first_use(installed, tmp_path)
    commands = [" ".join(name.split()[:2]) for name in seconds]
    assert commands == ["scene new", "simulate my.toml", "info my.toml", "build my.toml"]
    # 5.2 to 6.4 s of a processor whose cores four other programs share; compiling would take 90 s
    first_use.on_time(seconds)
