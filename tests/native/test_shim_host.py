"""The library in a host without Python: what it needs, what it shows, what it answers."""

import _ctypes
import ctypes
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.platforms import host as machine
from fmu_bearing.fmi.native.link import compiler_for, link
from tests.native_builds import no_native_fmu

from . import toy


def declared():
    """Functions of FMI 2.0 for co-simulation, from the headers."""
    header = (toy.HEADERS / "fmi2Functions.h").read_text()
    common = header[header.index("Common Functions") : header.index("Functions for FMI2 for Model Exchange")]
    co_simulation = header[header.index("Functions for FMI2 for Co-Simulation") :]
    names = re.findall(r"#define (fmi2\w+)\s+fmi2FullName", common + co_simulation)
    return set(names)


def symbols(library, which):
    ran = subprocess.run(
        ["nm", "-D", which, str(library)], capture_output=True, text=True, check=True, timeout=600
    )
    return {line.split()[-1].split("@")[0] for line in ran.stdout.splitlines()}


@pytest.mark.skipif(shutil.which("nm") is None, reason="needs nm of the binutils")
def test_library_shows_the_functions_of_fmi_and_nothing_else(library):
    names = declared()
    assert len(names) == 34
    assert symbols(library, "--defined-only") == names


@pytest.mark.skipif(
    shutil.which("ldd") is None or "TOY_FLAGS" in os.environ, reason="needs ldd, and no sanitizer"
)
def test_library_needs_the_c_library_only(library):
    ran = subprocess.run(["ldd", str(library)], capture_output=True, text=True, check=True, timeout=600)
    names = {line.split()[0].split("/")[-1].split(".")[0] for line in ran.stdout.splitlines()}
    assert names <= {"linux-vdso", "libm", "libc", "ld-linux-x86-64", "ld-linux-aarch64"}


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs /proc")
@pytest.mark.parametrize("prefer", ["cc", pytest.param("zig", marks=pytest.mark.heavy)])
def test_library_stays_loaded(tmp_path, prefer):
    """ecos closes the library of an FMU that is there twice, and calls what it opened before."""
    source, made = tmp_path / "one.c", tmp_path / "made.so"
    source.write_text('__attribute__((visibility("default"))) int one(void) { return 1; }')
    try:
        compiler = compiler_for(machine(), prefer)
    except BuildError as problem:
        no_native_fmu(problem)
    made.write_bytes(link(compiler, machine(), [source], [], "0"))
    library = ctypes.CDLL(str(made))
    one = library.one
    _ctypes.dlclose(library._handle)
    assert str(made) in Path("/proc/self/maps").read_text()  # else the call would be a crash
    assert one() == 1


def run_host(host, library, resources, *commands):
    command = [str(host), str(library), toy.GUID, resources.as_uri(), *commands]
    return subprocess.run(command, capture_output=True, text=True, timeout=600)


def test_host_in_c(host, library, resources):
    ran = run_host(
        host, library, resources, "set:0:2", "start:1", "get:4,5", "step:0.5:4", "get:4,5", "terminate"
    )
    assert ran.returncode == 0, ran.stdout
    assert ran.stdout.splitlines() == ["1 50", "5 50"]


def test_host_prints_what_the_library_says(host, library, resources):
    ran = run_host(
        host, library, resources, "start", "expect:2", "set:1:-1", "expect:3", "terminate:x", "reset"
    )
    assert "log 2 logStatusDiscard host: value not taken: load = -1.0 is refused" in ran.stdout
    assert ran.returncode == 1  # terminate was no error
    assert "terminate answered 0 instead of 3" in ran.stdout


def test_host_times_and_threads(host, library, resources):
    commands = (
        "start",
        "time-step:0.001:1000",
        "time-get:1000:4,5,8",
        "time-state:100",
        "time-instantiate:20",
    )
    ran = run_host(host, library, resources, *commands, "threads:2:0.001:1000")
    assert ran.returncode == 0, ran.stdout
    shown = [line.split()[0] for line in ran.stdout.splitlines()]
    assert shown == ["doStep", "getReal", "state", "instantiate", "threads"]


def test_minimal_fmu_of_the_benchmark(host, compiler, tmp_path, pytestconfig):
    library = tmp_path / "minimal.so"
    source = str(pytestconfig.rootpath / "benchmarks" / "fmu" / "minimal_fmu.c")
    flags = [*toy.WARNINGS, "-O2", "-fPIC", "-fvisibility=hidden", f"-I{toy.HEADERS}", "-shared"]
    toy.run([compiler, *flags, source, "-o", str(library), "-lm"])
    command = [str(host), str(library), "{00000000-0000-0000-0000-000000000000}", "", "start:2", "set:3:7"]
    command += ["step:0.1:5", "get:3,8", "save:" + str(tmp_path / "s"), "load:" + str(tmp_path / "s")]
    ran = subprocess.run(
        [*command, "time:9", "expect:3", "step:1"], capture_output=True, text=True, timeout=600
    )
    assert ran.returncode == 0, ran.stdout
    assert ran.stdout.splitlines()[0] == "7 0"
