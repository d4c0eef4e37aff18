"""Processes that this program starts: none takes code from the current folder, none outlives the program.

For ``python -m`` and ``python -c``, with which processes of Python are started, the current folder is the
first place of modules: a file ``json.py`` there, which came with somebody's scene, would be run.
"""

import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

__all__ = ["end_with_parent", "python", "run", "start", "surroundings"]

#: Leaves the current folder out of the places of modules, in children of children as well.
_SAFE = {"PYTHONSAFEPATH": "1"}
_PACKAGES = str(Path(__file__).parents[1])
_TICK = 1.0  # s between two looks at the parent


def python(module: str, *words: str) -> list[str]:
    """Return the command that runs a module of Python; to be started by `start` or `run`."""
    return [sys.executable, "-P", "-m", module, *words]


def start(
    command: Sequence[str], more: dict[str, str] | None = None, **options: Any
) -> subprocess.Popen[Any]:
    """Start a process that finds this package where this process has it.

    Parameters
    ----------
    command : sequence of str
    more : dict, optional
        Environment variables to set.
    **options
        Of `subprocess.Popen`.
    """
    return subprocess.Popen(command, env=_variables(more), **options)


def run(command: Sequence[str], **options: Any) -> subprocess.CompletedProcess[Any]:
    """Run a process, as `start`, until it ends; options are those of `subprocess.run`."""
    return subprocess.run(command, env=_variables(), **options)


def _variables(more: dict[str, str] | None = None) -> dict[str, str]:
    # an empty entry is the current folder
    places = [_PACKAGES, *filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep))]
    return {**os.environ, **_SAFE, **(more or {}), "PYTHONPATH": os.pathsep.join(places)}


@contextmanager
def surroundings(more: dict[str, str]) -> Iterator[None]:
    """Set environment variables meanwhile, for processes that multiprocessing starts."""
    wanted = {**_SAFE, **more}
    before = {name: os.environ.get(name) for name in wanted}
    os.environ.update(wanted)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def end_with_parent() -> None:
    """End this process when the one that started it has ended, as after SIGKILL or for want of memory.

    On Windows only processes of multiprocessing notice that.
    """
    from multiprocessing import parent_process

    known, number = parent_process(), os.getppid()

    def watch() -> None:
        if known is not None:
            known.join()
        elif sys.platform == "win32":
            return
        else:
            while os.getppid() == number:
                time.sleep(_TICK)
        os._exit(1)

    threading.Thread(target=watch, name="parent", daemon=True).start()
