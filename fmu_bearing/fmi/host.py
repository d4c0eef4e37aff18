"""Workarounds for errors of pythonfmu 0.7.0 in the process that loads the FMU."""

import atexit
import ctypes
import os
import sys
from pathlib import Path
from typing import Any

__all__ = ["finalise_before_exit", "keep", "leave_search_path", "release_at_exit"]

_loaded: dict[Path, ctypes.CDLL] = {}


def release_at_exit(library: Path) -> None:
    """Release what pythonfmu's library holds before a Python host ends, if the library is loaded then.

    A process that ends releases it twice with pythonfmu 0.7.0: when it destroys the objects of C++, and in a
    destructor of the library, which reads and writes memory that is free by then. As a rule nothing comes of
    it; now and then glibc aborts with "corrupted double-linked list". Masters that unload each library do
    not avoid it, because the first one stays loaded: it defines symbols that are unique in the process. The
    library exports ``finalizePythonInterpreter``, after which neither of the two finds anything to release.

    Parameters
    ----------
    library : Path
        Under the name by which the master loaded it.

    Notes
    -----
    On systems other than Linux the order is another one. Hosts in C need :func:`finalise_before_exit`: there
    Python may end while the library is being unloaded, and ``release`` would wait for the loader for ever.
    ``examples/spindle_cosimulation/build.py`` copies this function into FMUs that run without this package.
    """
    if not (sys.orig_argv and sys.platform.startswith("linux")):
        return

    def release() -> None:
        try:
            # found by its name, although masters have deleted the file by now
            ctypes.CDLL(str(library), os.RTLD_NOLOAD).finalizePythonInterpreter()
        except OSError:
            pass  # not loaded any more: unloading releases once

    atexit.register(release)


def finalise_before_exit(resources: str, identifier: str) -> None:
    """End an interpreter that pythonfmu started, before the host's libraries are torn down.

    pythonfmu 0.7.0 ends the interpreter in a destructor of its library. In a host written in C that is
    after other libraries have been torn down, and NumPy then aborts the process on freed memory. The
    library exports ``finalizePythonInterpreter``; registered here with the C library, it runs first. In a
    Python host there is no interpreter to end, and :func:`release_at_exit` does what is left.

    Parameters
    ----------
    resources : str
        The FMU's resources; the library is looked for beside them.
    identifier : str
        Name of the library without suffix. On other systems (the Windows library does it itself) and with
        binaries unpacked elsewhere nothing is registered.
    """
    library = Path(resources).parent / "binaries" / "linux64" / f"{identifier}.so"
    if not sys.platform.startswith("linux") or not library.is_file():
        return
    release_at_exit(library)
    if sys.orig_argv or library in _loaded:
        return
    loaded = ctypes.CDLL(str(library))  # one more reference: the function must outlive the master's
    _loaded[library] = loaded
    register = ctypes.CDLL(None).__cxa_atexit
    register.argtypes = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
    register(ctypes.cast(loaded.finalizePythonInterpreter, ctypes.c_void_p), None, None)


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
