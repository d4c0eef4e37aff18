"""How kernels are compiled: one set of flags for all.

``kernel`` marks a function of the engine. What Python, tests and FMUs run is compiled ahead of time from all
kernels together (`fmu_bearing.compiled`); there LLVM decides what is compiled into its caller. Called by
itself, as tests of single kernels do, a kernel is compiled by Numba on its first call. If
``FMU_BEARING_KEEP_KERNELS`` names a folder, such machine code is kept there, under a hash of the engine's
sources, so that a changed helper never meets a stale kernel.
"""

import os
import pathlib

import numba

from fmu_bearing.engine.sources import source_hash

FLAGS = {"error_model": "numpy", "nogil": True, "fastmath": False, "boundscheck": False}
_KEEP = os.environ.get("FMU_BEARING_KEEP_KERNELS")


def kernel(function):
    """Mark ``function`` as a kernel."""
    if not _KEEP:
        return numba.njit(**FLAGS)(function)
    before = numba.config.CACHE_DIR
    # Numba reads the directory when the function is wrapped; the process's own setting is put back.
    numba.config.CACHE_DIR = str(pathlib.Path(_KEEP) / f"{source_hash()}-numba{numba.__version__}")
    try:
        return numba.njit(cache=True, **FLAGS)(function)
    finally:
        numba.config.CACHE_DIR = before
