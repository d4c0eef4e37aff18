"""Compile all kernels once and keep them: ``python -m fmu_bearing.engine``."""

import subprocess
import sys
import time

import numpy as np

from fmu_bearing.engine import abi
from fmu_bearing.engine.jit import cache_directory
from fmu_bearing.engine.layout import P, U


def compile_entry(name: str) -> None:
    """Call an entry with arrays that it refuses at once: enough for the compiler, no simulation."""
    p = np.full(P.TABLES, np.nan)
    inputs = np.full(len(U.INPUTS), np.nan)
    s, z, w = np.zeros(8), np.zeros(8), np.zeros(8)
    p.setflags(write=False)
    if name == "init":
        abi.init(p, inputs, s, z, w, 0.0)
    else:
        abi.step(p, inputs, s, z, w, -1.0)
        abi.outputs.compile(abi.step.signatures[0][0:1] + abi.step.signatures[0][2:4])


def main() -> None:
    """Compile the entries side by side: each is one long task for one core."""
    if len(sys.argv) > 1:
        compile_entry(sys.argv[1])
        return
    begin = time.perf_counter()
    with subprocess.Popen([sys.executable, "-m", "fmu_bearing.engine", "init"]) as other:
        compile_entry("step")
    if other.returncode != 0:
        sys.exit(other.returncode)
    print(f"kernels ready after {time.perf_counter() - begin:.1f} s in {cache_directory()}")


if __name__ == "__main__":
    main()
