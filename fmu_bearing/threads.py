"""Processors that there are, and linear algebra on one thread.

Matrices of bearings have some hundred rows. The threads of a linear algebra library then wait for each other
longer than they compute: on a machine with other work an operating point took 14 times the processor time.
"""

import os
import sys
from collections.abc import Callable
from functools import lru_cache, wraps
from typing import ParamSpec, TypeVar

from threadpoolctl import ThreadpoolController

_Given = ParamSpec("_Given")
_Found = TypeVar("_Found")


def cores() -> int:
    """Return how many processors this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


@lru_cache(maxsize=1)
def _libraries(modules: int) -> ThreadpoolController:
    """Return the linear algebra libraries of this process; looked for again when more modules are loaded.

    Other packages bring libraries of their own, of which each keeps its own threads.
    """
    import scipy.linalg  # noqa: F401 - has a library of its own beside NumPy's: both must be there to be found

    return ThreadpoolController()


def one_thread(function: Callable[_Given, _Found]) -> Callable[_Given, _Found]:
    """Let a function solve its matrices on one thread, whatever the libraries are set to outside of it."""

    @wraps(function)
    def limited(*args: _Given.args, **kwargs: _Given.kwargs) -> _Found:
        with _libraries(len(sys.modules)).limit(limits=1):
            return function(*args, **kwargs)

    return limited
