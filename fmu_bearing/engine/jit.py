"""How kernels are compiled: one set of flags for all, entries cached once per machine.

``kernel`` marks a function called by other kernels. ``inlined`` marks one that is compiled into its caller.
For a loop over balls, literal arguments become constants there, and only with constant places does the loop
become a vector loop (4 times faster); for a large function with one caller it saves compiling all that it
calls once more, as Numba does for each kernel of a chain. ``entry`` marks what Python calls (and the
right-hand side, which tests and studies call by itself); its machine code is kept in the user's cache
directory under a hash of the engine's sources, so that a changed helper never meets a stale entry, a
read-only installation works, and an FMU that is unzipped anew compiles nothing.
"""

import os
import pathlib

import numba

from fmu_bearing.engine.sources import engine_digest

FLAGS = {"error_model": "numpy", "nogil": True, "fastmath": False, "boundscheck": False}

kernel = numba.njit(**FLAGS)
inlined = numba.njit(inline="always", **FLAGS)


def source_hash() -> str:
    """Hash (16 hex digits) of every source file of the engine."""
    return engine_digest().hex()[:16]


def cache_directory() -> pathlib.Path:
    """Directory of compiled kernels: ``FMU_BEARING_CACHE``, else the user's cache directory."""
    base = os.environ.get("FMU_BEARING_CACHE") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or os.path.expanduser("~/.cache"),
        "fmu-bearing",
    )
    return pathlib.Path(base) / f"kernels-{source_hash()}-numba{numba.__version__}"


def entry(function):
    """Compile ``function`` on its first call and keep the machine code for later processes."""
    before = numba.config.CACHE_DIR
    # Numba reads the directory when the function is wrapped; the process's own setting is put back.
    numba.config.CACHE_DIR = str(cache_directory())
    try:
        return numba.njit(cache=True, **FLAGS)(function)
    finally:
        numba.config.CACHE_DIR = before
