"""Compile all kernels once and keep them: ``python -m fmu_bearing.engine``."""

import time

import numpy as np

from fmu_bearing.engine import abi, layout
from fmu_bearing.engine.jit import cache_directory


def main() -> None:
    """Call every entry with arrays that it refuses at once: enough for the compiler, no simulation."""
    begin = time.perf_counter()
    empty = np.full(layout.P_TABLES, np.nan)
    inputs = np.full(len(layout.INPUTS), np.nan)
    p, s, z, w = empty, np.zeros(8), np.zeros(8), np.zeros(8)
    p.setflags(write=False)
    abi.init(p, inputs, s, z, w, 0.0)
    abi.step(p, inputs, s, z, w, -1.0)
    abi.outputs.compile(abi.step.signatures[0][0:1] + abi.step.signatures[0][2:4])
    print(f"kernels ready after {time.perf_counter() - begin:.1f} s in {cache_directory()}")


if __name__ == "__main__":
    main()
