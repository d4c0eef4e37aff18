"""Every entry computes the same bits from objects made the lean way and the plain way.

The lean way leaves out what LLVM proved before: that no kernel raises. Here is what replaces the proof.
"""

import os
import subprocess
import sys
import zipfile

import pytest

from fmu_bearing import build_fmu
from fmu_bearing.compiled import make
from fmu_bearing.compiled.platforms import instruction_set, own
from fmu_bearing.compiled.settings import SETTINGS, lean
from fmu_bearing.compiled.units import UNITS
from tests.conftest import ROOT

#: Compiles units the plain way and keeps their objects in a folder. Numba has all its passes, arrays, counts
#: of references and checks of status; LLVM proves that nothing raises. Only what follows for each kernel is
#: left out, and changes no code: it is neither linked with all that it calls, nor made executable.
_PLAIN = """
import pathlib, sys
import llvmlite.binding as llvm
from numba.core import cpu, registry
from fmu_bearing.compiled import lean, lower
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import own

registry.cpu_target.target_context.codegen()._library_class = lean.Library
cpu.CPUContext.get_executable = lean._no_executable
cpu.CPUContext.create_cpython_wrapper = lean._nothing
lean.install = lambda: None
parse = llvm.parse_assembly

def uncounted(code):
    counts = "NRT_MemInfo_call_dtor" in code  # the module of Numba that counts references
    return parse(lower._uncounted(str(parse(code)))) if counts else parse(code)

llvm.parse_assembly = uncounted

suffix, folder, *units = sys.argv[1:]
for unit in units:
    code = lower.portable_code(unit, lambda done: None, True)
    made = object_code(code, own(), suffix, lambda done: None)
    pathlib.Path(folder, f"{unit}.o").write_bytes(made)
"""


def _digests(*folder):
    """Digest by case, from the package's objects or those of a folder, in a process of its own."""
    ran = subprocess.run(
        [sys.executable, "-m", "tests.compiled.bits", *map(str, folder)], cwd=ROOT, capture_output=True,
        text=True, timeout=600,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    pairs = (line.split(" ", 1) for line in ran.stdout.splitlines())
    return {name: digest for digest, name in pairs}


pytestmark = [
    pytest.mark.bits,
    pytest.mark.skipif(
        not lean(make.version("numba")), reason="this Numba is compiled with the plain way only"
    ),
]


@pytest.fixture(scope="module")
def lean_way():
    """Digests from the package's own objects."""
    found = _digests()
    assert len(set(found.values())) == len(found) >= 28  # all differ, and none is lost
    return found


def test_every_entry_computes_the_plain_ways_bits(lean_way, tmp_path):
    """Fidelities, sets, a port, sound and what Python alone calls."""
    suffix = instruction_set(own())
    made = make.objects(own(), UNITS, [suffix])
    compilers = [
        subprocess.Popen(
            [sys.executable, "-c", _PLAIN, suffix, str(tmp_path), *units],
            env={**os.environ, **SETTINGS}, stderr=subprocess.PIPE, text=True,
        )
        for units in (["step"], ["init", "study", "sound"])
    ]  # fmt: skip
    for compiler in compilers:
        _, complaint = compiler.communicate(timeout=2400)
        assert compiler.returncode == 0, complaint
    for unit in UNITS:
        assert (tmp_path / f"{unit}.o").read_bytes() != made[unit, suffix]  # two ways, two objects
    assert _digests(tmp_path) == lean_way


def test_units_for_single_bearings_compute_the_same_bits(lean_way):
    found = _digests("single")
    assert len(found) == 10
    assert found == {name: lean_way[name] for name in found}


def test_an_fmu_only_for_here_computes_the_same_bits(scene_file, tmp_path):
    """Its reference results, of a single bearing, are those of the FMU for everybody."""
    results = []
    for only_here in (True, False):
        built = build_fmu(scene_file, tmp_path / "bearing.fmu", "native", only_here=only_here)
        with zipfile.ZipFile(built.path) as fmu:
            names = [name for name in fmu.namelist() if name.endswith(".csv")]
            results.append({name: fmu.read(name) for name in names})
            (library,) = (fmu.read(name) for name in fmu.namelist() if name.startswith("binaries/"))
            results[-1]["size"] = len(library)
    sizes = [one.pop("size") for one in results]
    assert sizes[0] < 0.5 * sizes[1]
    assert results[0] and results[0] == results[1]
