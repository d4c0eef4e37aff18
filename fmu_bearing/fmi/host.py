"""Workarounds for errors of pythonfmu 0.7.0 in the process that loads the FMU."""

import ctypes
import sys
from pathlib import Path
from typing import Any

__all__ = ["finalise_before_exit", "keep", "leave_search_path"]

_loaded: list[ctypes.CDLL] = []


def finalise_before_exit(resources: str, identifier: str) -> bool:
    """End an interpreter that pythonfmu started, before the host's libraries are torn down.

    pythonfmu 0.7.0 ends the interpreter in a destructor of its library. In a host written in C that is
    after other libraries have been torn down, and NumPy then aborts the process on freed memory. The
    library exports ``finalizePythonInterpreter``; registered here with the C library, it runs first.

    Parameters
    ----------
    resources : str
        The FMU's resources; the library is looked for beside them.
    identifier : str
        Name of the library without suffix.

    Returns
    -------
    bool
        Whether anything had to be registered. In a Python host, on other systems (the Windows library
        does it itself) and with binaries unpacked elsewhere, nothing is.
    """
    if sys.orig_argv or not sys.platform.startswith("linux") or _loaded:
        return False
    library = Path(resources).parent / "binaries" / "linux64" / f"{identifier}.so"
    if not library.is_file():
        return False
    loaded = ctypes.CDLL(str(library))  # one more reference: the function must outlive the master's
    _loaded.append(loaded)
    register = ctypes.CDLL(None).__cxa_atexit
    register.argtypes = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
    register(ctypes.cast(loaded.finalizePythonInterpreter, ctypes.c_void_p), None, None)
    return True


def keep(namespace: dict[str, Any]) -> None:
    """Hold the stub's namespace once more, each time its body runs.

    pythonfmu 0.7.0 runs the body once per fmi2Instantiate to find the class, and then lets go of one
    reference to the module's namespace that it does not own. Without the one added here the namespace is
    freed in use: the second instance fails, or the process.
    """
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(namespace))


def leave_search_path(resources: str) -> None:
    """Take the FMU's resources from ``sys.path``, where pythonfmu puts them at each fmi2Instantiate."""
    if resources in sys.path:
        sys.path.remove(resources)
