"""Libraries for every platform: what they export and ask for, and two of them run under emulators.

The host's library is looked at in the quick tests, all five in the heavy ones. Emulators run only on
request, as they are large: set FMU_BEARING_EMULATORS=1.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import cli
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.optimise import MATHEMATICS
from fmu_bearing.compiled.platforms import PLATFORMS, host as own_platform
from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.fmi.native import link
from fmu_bearing.fmi.native.link import library
from fmu_bearing.fmi.native.model_file import model_bytes
from tests.compiled import unoptimised
from tests.conftest import GATES

from . import binaries, careless, toy
from .master import SIGNATURES

FUNCTIONS = {f"fmi2{name}" for name in SIGNATURES} | {
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2GetVersion",
    "fmi2GetTypesPlatform",
}
#: What the shim uses of the C library, and names the mathematics have there.
C_LIBRARY = MATHEMATICS | set(
    "calloc malloc realloc free fopen fclose fread fseek ftell getenv snprintf memchr memcmp strchr strcmp "
    "strlen strncmp strrchr strspn strstr strtod strtol fmax".split()
)
#: The same functions under the names that macOS' headers and code generator give them, and its loader.
DARWIN = set(
    "bzero __bzero memset_pattern16 __memcpy_chk __snprintf_chk __sincos_stret dyld_stub_binder".split()
)
#: Written into every library of its kind by Zig's linker; no function.
MARKERS = {"_mh_dylib_header", "__dso_handle"}
SYSTEM = {
    ".so": {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"},
    ".dylib": {"/usr/lib/libSystem.B.dylib"},
    ".dll": {"kernel32.dll"},
}
OLDEST_GLIBC = (2, 17)
#: Beside this machine's the platform whose kernels are optimised as for users: of one instruction set, and of
#: the system that has names of its own for most functions that an optimiser adds.
OPTIMISED = "aarch64-darwin"


def check_symbols(platform, data):
    """Nothing but FMI comes out, nothing but the C library goes in; returns what was read."""
    found = binaries.read(data)
    assert found.machine == ("x86-64" if platform.triple.startswith("x86_64") else "aarch64")
    assert found.exports - (MARKERS if platform.suffix == ".dylib" else set()) == FUNCTIONS
    if platform.suffix == ".dll":  # its run-time library adds what a DLL needs to start
        strange = {name for name in found.needed if not name.lower().startswith("api-ms-win-crt-")}
        assert {name.lower() for name in strange} <= SYSTEM[".dll"]
    else:
        assert found.imports <= C_LIBRARY | (DARWIN if platform.suffix == ".dylib" else set())
        assert found.needed <= SYSTEM[platform.suffix]
    return found


def test_library_of_this_machine(compiler):
    platform = own_platform()
    if platform is None:
        pytest.skip("there is no native build for this machine")
    check_symbols(platform, library(platform))


def test_reader_reports_what_is_too_much(compiler, tmp_path):
    # the toy without hidden symbols and with one more: what the test above has to notice
    source = tmp_path / "more.c"
    source.write_text('#include <stdio.h>\nint more(void);\nint more(void) { return puts(""); }\n')
    toy.run([compiler, "-shared", "-fPIC", str(source), "-o", str(tmp_path / "more.so")])
    found = binaries.read((tmp_path / "more.so").read_bytes())
    assert found.exports == {"more"}
    assert found.imports - C_LIBRARY == {"puts"}


@pytest.fixture
def no_zig(monkeypatch):
    """As if Zig were not installed."""
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(
        link.importlib.util, "find_spec", lambda name: None if name == "ziglang" else find_spec(name)
    )


def test_platform_without_its_compiler_names_the_extra(no_zig):
    other = next(name for name in PLATFORMS if PLATFORMS[name] != own_platform())
    with pytest.raises(BuildError) as refusal:
        link.compiler_for(PLATFORMS[other])
    assert str(refusal.value) == (
        f"{other}: another platform than this machine's needs the package ziglang: "
        "pip install 'fmu-bearing[cross]'"
    )


@pytest.mark.heavy
def test_command_without_the_compiler_ends_with_one_line(no_zig, monkeypatch, tmp_path):
    monkeypatch.setattr(link, "folder", lambda: tmp_path / "no libraries kept")
    other = next(name for name in PLATFORMS if PLATFORMS[name] != own_platform())
    path = GATES / "7003C-bare.toml"
    ran = CliRunner().invoke(
        cli.app, ["build", str(path), "--platforms", other, "-o", str(tmp_path / "bearing.fmu")]
    )
    assert ran.exit_code == 2
    assert [line for line in ran.output.splitlines() if line.startswith("error: ")] == [
        f"error: {other}: another platform than this machine's needs the package ziglang: "
        "pip install 'fmu-bearing[cross]'"
    ]
    assert not (tmp_path / "bearing.fmu").exists()


def test_machine_without_any_compiler_says_what_to_install(no_zig, monkeypatch):
    if own_platform() is None:
        pytest.skip("there is no native build for this machine")
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr(link.shutil, "which", lambda name: None)
    for prefer in ("auto", "portable", "zig"):
        with pytest.raises(BuildError, match=r"there is no C compiler; install one \(Debian: gcc\), or pip"):
            link.compiler_for(own_platform(), prefer)


def test_named_platforms_are_for_old_systems_too(zig, compiler):
    platform = own_platform()
    if platform is None:
        pytest.skip("there is no native build for this machine")
    assert not link.compiler_for(platform).name.startswith("zig")
    assert link.compiler_for(platform, "portable").name.startswith("zig")


def test_named_platform_without_zig_takes_the_own_compiler(no_zig, compiler):
    platform = own_platform()
    if platform is None:
        pytest.skip("there is no native build for this machine")
    assert link.compiler_for(platform, "portable") == link.compiler_for(platform, "cc")


@pytest.fixture(scope="session")
def zig():
    if importlib.util.find_spec("ziglang") is None:
        pytest.skip("Zig is not installed: pip install 'fmu-bearing[cross]'")
    return (sys.executable, "-m", "ziglang", "cc")


@pytest.fixture
def quick_objects(monkeypatch, tmp_path_factory):
    """Most platforms' libraries of kernels that are not optimised, kept where no user finds them.

    All symbols of shim and kernels are in them. What the optimiser adds is looked for in two platforms'.
    """
    objects, place = link.objects, tmp_path_factory.getbasetemp() / "quick libraries"
    optimised = {OPTIMISED, getattr(own_platform(), "name", "")}

    def made(platform, units, sets):
        if platform.name in optimised:
            return objects(platform, units, sets)
        return {
            (unit, one): unoptimised.object_of(unit, platform.name, one) for unit in units for one in sets
        }

    monkeypatch.setattr(link, "objects", made)
    monkeypatch.setattr(link, "folder", lambda: place)


@pytest.mark.heavy
@pytest.mark.parametrize("name", PLATFORMS)
def test_library_of_every_platform(zig, quick_objects, name):
    platform = PLATFORMS[name]
    data = library(platform, prefer="zig")
    found = check_symbols(platform, data)
    for version in found.versions:
        assert tuple(map(int, version.removeprefix("GLIBC_").split("."))) <= (*OLDEST_GLIBC, 0), version
    if platform.suffix == ".so":
        assert found.versions
    if name == "aarch64-darwin":
        assert found.signed  # nothing unsigned runs there
    assert found.name in ("", "bearing.dll", "@rpath/bearing.dylib")
    # the same sources give the same bytes, wherever the compiler's files of the moment lie
    again = link.link(
        link.compiler_for(platform, "zig"),
        platform,
        link.shim_sources(),
        link.kernels_of(platform),
        engine_digest().hex(),
    )
    assert again == data


@pytest.mark.heavy
def test_one_fmu_for_all_platforms(zig, quick_objects, tmp_path, scene):
    from fmu_bearing.fmi.package import build
    from fmu_bearing.prepare.model import prepare

    built = build(prepare(scene("7003C-spindle")), tmp_path / "all.fmu", platforms=list(PLATFORMS))
    assert built.platforms == tuple(sorted(PLATFORMS))
    assert f"native build for {', '.join(sorted(PLATFORMS))};" in str(built)
    with zipfile.ZipFile(built.path) as archive:
        for name, platform in PLATFORMS.items():
            inside = archive.read(f"binaries/{name}/{built.identifier}{platform.suffix}")
            check_symbols(platform, inside)


# --- emulators ------------------------------------------------------------------------------------------
def _wine():
    for name in ("wine64", "wine", "/usr/lib/wine/wine64"):
        if found := shutil.which(name):
            return found
    return None


@pytest.fixture(params=["win64", "aarch64-linux"])
def emulator(request):
    """Name of a platform and how to run its programs; skips where that was not asked for, or is not there."""
    name = request.param
    if os.environ.get("FMU_BEARING_EMULATORS") != "1":
        pytest.skip(
            "emulators run on request: set FMU_BEARING_EMULATORS=1 (Debian: wine64 for win64; qemu-user and "
            "libc6-arm64-cross for aarch64-linux)"
        )
    if name == "win64":
        command = [_wine()]
        if not command[0]:
            pytest.skip("there is no Wine (Debian: wine64)")
    else:
        qemu = shutil.which("qemu-aarch64") or shutil.which("qemu-aarch64-static")
        root = Path("/usr/aarch64-linux-gnu")
        if not qemu or not root.is_dir():
            pytest.skip("there is no qemu-aarch64 with a C library (Debian: qemu-user, libc6-arm64-cross)")
        command = [qemu, "-L", str(root)]
    return name, command


#: Speeds in rad/s that the shaft is brought to in turn.
_SPEEDS = (700.0, 900.0, 1200.0)


@pytest.fixture(scope="module")
def spindle(tmp_path_factory):
    """Folder with the model of the spindle, its GUID, the commands of a run, and references of its Reals."""
    from fmu_bearing.fmi.description import interface_guid
    from fmu_bearing.prepare.model import prepare
    from fmu_bearing.scene import read_scene

    path = GATES / "7003C-spindle.toml"
    found = read_scene(path)
    model = prepare(
        found.model_copy(update={"sound": found.sound.model_copy(update={"radiation_model": "compact"})})
    )
    guid = interface_guid(model, "native")
    folder = tmp_path_factory.mktemp("spindle")
    (folder / "model.bin").write_bytes(model_bytes(model, guid, engine_digest().hex()))
    names = [variable.name for variable in model.variables]
    shown = [
        reference
        for reference, variable in enumerate(model.variables)
        if variable.type == "Real" and variable.causality in ("output", "local")
    ]
    commands = ["start:0.0"]
    for speed in _SPEEDS:
        commands += [f"set:{names.index('shaft_speed')}:{speed}", "step:1e-4:10"]
        commands.append("get:" + ",".join(map(str, shown)))
    return folder, guid, commands, [names[reference] for reference in shown]


def _values(ran):
    assert ran.returncode == 0, (ran.stdout[-2000:], ran.stderr[-2000:])
    lines = [line.split() for line in ran.stdout.splitlines() if line and not line.startswith("log ")]
    return np.array([[float(number) for number in line] for line in lines])


@pytest.mark.heavy
def test_library_runs_under_an_emulator(emulator, zig, host, spindle, tmp_path, monkeypatch):
    name, command = emulator
    folder, guid, commands, names = spindle
    platform = PLATFORMS[name]
    mine = tmp_path / "own"
    mine.write_bytes(library(own_platform()))
    own = subprocess.run(
        [host, mine, guid, folder.as_uri(), *commands], capture_output=True, text=True, timeout=600
    )
    expected = _values(own)
    assert expected.shape == (len(_SPEEDS), len(names))
    program = tmp_path / ("host.exe" if name == "win64" else "host")
    toy.run(
        [*zig, "-target", platform.zig, "-std=c99", "-O2", f"-I{toy.HEADERS}", *toy.HOST, "-o",
         str(program), *(() if name == "win64" else ("-ldl", "-lpthread", "-lm"))]
    )  # fmt: skip
    made = tmp_path / f"bearing{platform.suffix}"
    made.write_bytes(library(platform, prefer="zig"))
    place, where = (f"Z:{made}", f"file:///Z:{folder}") if name == "win64" else (made, folder.as_uri())
    monkeypatch.setenv("WINEPREFIX", str(tmp_path / "wine"))
    monkeypatch.setenv("WINEDEBUG", "-all")
    ran = subprocess.run(
        [*command, program, place, guid, where, *commands], capture_output=True, text=True, timeout=900
    )
    found = _values(ran)
    assert found.shape == expected.shape
    size = np.abs(expected).max(axis=0)
    off = (np.abs(found - expected) / np.where(size > 0.0, size, 1.0)).max(axis=0)
    worst = int(off.argmax())
    print(
        f"{name}: {np.mean(found == expected):.0%} of the values equal bit for bit, the largest difference "
        f"{off[worst]:.2g} of the value, in {names[worst]}"
    )
    # other mathematics libraries round differently in the last place; a step multiplies that
    assert off[worst] < 1e-6, (names[worst], found[:, worst], expected[:, worst])
    if name == "win64":
        backslashes = str(folder).replace("/", "\\")
        for where in (rf"\\?\Z:{backslashes}", rf"file:///\\?\Z:{backslashes}", f"file:////?/Z:{folder}"):
            ran = subprocess.run([*command, program, place, guid, where, "start"], timeout=900)
            assert ran.returncode == 0, where


@pytest.mark.heavy
def test_careless_host_under_an_emulator(emulator, zig, compiler, resources, tmp_path, monkeypatch):
    name, command = emulator
    platform = PLATFORMS[name]
    sets = [suffix for suffix, _ in platform.instruction_sets]
    target = (*zig, "-target", platform.zig)
    (tmp_path / "own").mkdir()
    kernels = careless.hostile_kernels(tmp_path / "own", [compiler])
    own = careless.build(tmp_path / "own", [compiler], kernels, toy.KERNELS)
    kernels = careless.hostile_kernels(tmp_path, target, sets=sets)
    program = careless.build(tmp_path, target, kernels, toy.KERNELS, sets=sets)
    monkeypatch.setenv("WINEPREFIX", str(tmp_path / "wine"))
    monkeypatch.setenv("WINEDEBUG", "-all")
    bad = tmp_path / "bad"
    found = careless.play(program, resources, bad, seed=1, rounds=50, seconds=300, emulator=command)
    # the library answers every call the same
    assert found == careless.play(own, resources, bad, seed=1, rounds=50)
