"""Every entry computes the same bits from objects made the lean way and the plain way.

The lean way leaves out what LLVM proved before: that no kernel raises. Here is what replaces the proof.
"""

import os
import subprocess
import sys

import pytest

from fmu_bearing.compiled import make
from fmu_bearing.compiled.platforms import instruction_set, own
from fmu_bearing.compiled.settings import SETTINGS, lean
from fmu_bearing.compiled.units import UNITS
from tests.conftest import ROOT

#: Compiles a unit the plain way and keeps its object.
_PLAIN = """
import pathlib, sys
from fmu_bearing.compiled.lower import portable_code
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import own

unit, suffix, target = sys.argv[1:]
code = portable_code(unit, lambda done: None, False)
pathlib.Path(target).write_bytes(object_code(code, own(), suffix, lambda done: None))
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


@pytest.mark.heavy
@pytest.mark.skipif(not lean(make.version("numba")), reason="this Numba is compiled with the plain way only")
def test_every_entry_computes_the_plain_ways_bits(tmp_path):
    """Fidelities, sets, a port, sound and what Python alone calls.

    The plain way takes 446 s of a processor and 14 GB of memory for `step`, 366 s for `init`, 84 s for
    `study`.
    """
    suffix = instruction_set(own())
    made = make.objects(own(), UNITS, [suffix])
    for unit in UNITS:
        target = tmp_path / f"{unit}.o"
        compiled = subprocess.run(
            [sys.executable, "-c", _PLAIN, unit, suffix, str(target)],
            env={**os.environ, **SETTINGS}, stderr=subprocess.PIPE, text=True, timeout=2400,
        )  # fmt: skip
        assert compiled.returncode == 0, compiled.stderr
        assert target.read_bytes() != made[unit, suffix]  # two ways, two objects
    lean_way = _digests()
    assert len(set(lean_way.values())) == len(lean_way) >= 28  # all differ, and none is lost
    assert _digests(tmp_path) == lean_way
