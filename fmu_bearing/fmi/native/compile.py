"""Kernels ahead of time: Numba's portable LLVM code, made once, as object files for each platform.

Both are kept in the user's cache directory under a hash of the engine's sources and of the compilers'
versions, so that only the first build on a machine takes minutes.
"""

import hashlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import llvmlite
import numba

from fmu_bearing.engine.jit import cache_directory
from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.files import write_whole
from fmu_bearing.fmi.native import entries, optimise
from fmu_bearing.fmi.native.entries import SETTINGS
from fmu_bearing.fmi.native.optimise import BuildError
from fmu_bearing.fmi.native.platforms import Platform
from fmu_bearing.progress import Tell, silent

__all__ = ["BuildError", "kernel_folder", "objects", "portable_code"]


def kernel_folder() -> Path:
    """Folder of everything compiled ahead of time from these sources by these compilers."""
    found = hashlib.sha256(engine_digest())
    for source in (Path(entries.__file__), Path(optimise.__file__)):
        found.update(source.read_bytes())
    found.update(f"{numba.__version__} {llvmlite.__version__}".encode())
    return cache_directory().parent / f"native-{found.hexdigest()[:16]}"


def portable_code(tell: Tell = silent) -> Path:
    """LLVM bitcode of the kernels, made by a process of its own unless it is there.

    Raises
    ------
    BuildError
        If Numba cannot compile the kernels.
    """
    path = kernel_folder() / "kernels.bc"
    if path.is_file():
        return path
    tell("compiling the kernels ahead of time: some minutes, once for this version")
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / path.name
        ran = subprocess.run(
            [sys.executable, "-m", entries.__name__, str(made)],
            env={**os.environ, **SETTINGS},
            capture_output=True,
            text=True,
        )
        if ran.returncode != 0 or not made.is_file():
            raise BuildError(f"Numba could not compile the kernels ahead of time: {ran.stderr[-2000:]}")
        return write_whole(path, made.read_bytes())


def objects(platform: Platform, tell: Tell = silent) -> list[Path]:
    """Object files of the kernels for a platform, one per instruction set, made unless they are there.

    Raises
    ------
    BuildError
        If an object would need more than the C library's mathematics.
    """
    folder = kernel_folder()
    wanted = {
        folder / f"{platform.name}-{suffix}.o": (suffix, processor)
        for suffix, processor in platform.instruction_sets
    }
    missing = [path for path in wanted if not path.is_file()]
    if missing:
        code = portable_code(tell)
        tell(f"optimising the kernels for {platform.name}: a minute per instruction set, once")
        # one process each: LLVM's passes hold the interpreter
        running = [
            subprocess.Popen(
                [
                    sys.executable,
                    "-m",
                    optimise.__name__,
                    str(code),
                    platform.name,
                    wanted[path][0],
                    str(path),
                ],
                stderr=subprocess.PIPE,
                text=True,
            )
            for path in missing
        ]
        for process in running:
            _, complaint = process.communicate()
            if process.returncode != 0:
                raise BuildError(complaint.strip()[-2000:])
    return list(wanted)
