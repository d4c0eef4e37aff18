"""The sources of the shim compile without a warning for every platform of the FMU."""

import importlib.util
import sys
from pathlib import Path

import pytest

from fmu_bearing.compiled import platforms

from . import toy


@pytest.mark.heavy
@pytest.mark.parametrize("platform", platforms.PLATFORMS)
def test_shim_and_host_compile_for(platform, tmp_path):
    if importlib.util.find_spec("ziglang") is None:
        pytest.skip("needs pip install 'fmu-bearing[cross]'")
    target = platforms.PLATFORMS[platform]
    compiler = (sys.executable, "-m", "ziglang", "cc", "-target", target.zig)
    flags = [*toy.WARNINGS, "-O2", f"-I{toy.HEADERS}", f'-DFB_KERNELS="{toy.KERNELS}"']
    if len(target.instruction_sets) > 1:
        flags.append("-DFB_X86")
    sources = [*sorted(toy.SHIM.glob("*.c")), *map(Path, toy.HOST)]
    for source in sources:
        made = tmp_path / f"{source.stem}.o"
        toy.run([*compiler, *flags, "-c", str(source), "-o", str(made)])
        assert made.stat().st_size > 0
