"""Objects of the kernels: taken from the wheel, read from the cache, or compiled now with progress.

The cache is keyed by the sources of the engine and of this package and by the versions of Python, Numba and
llvmlite, never by the place of the installation: a checkout, a wheel and an FMU that is built share it.
"""

import contextlib
import functools
import hashlib
import json
import os
import queue
import sys
import threading
import time
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path
from subprocess import PIPE, Popen

from fmu_bearing import children
from fmu_bearing.compiled import disk_cache
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.platforms import Platform
from fmu_bearing.compiled.settings import SETTINGS, TESTED, lean
from fmu_bearing.compiled.show import Display
from fmu_bearing.compiled.units import SINGLE, UNITS, object_name
from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.files import cache_root, own_folder
from fmu_bearing.progress import work

__all__ = ["PREBUILT", "bitcode", "folder", "kept", "objects", "prebuilt", "sources_key"]

#: Objects and bitcode that a wheel brings along, with the key of the sources they were made from.
PREBUILT = Path(__file__).parent / "prebuilt"
#: Modules of this package that decide what is in an object.
_MAKERS = ("units", "single", "settings", "lower", "lean", "flat", "platforms", "optimise")
#: Units whose portable code one process makes in turn: most kernels of the later ones are through with the
#: first. The longest to optimise comes first: another process does so meanwhile. Two processes from the
#: start, with `full` apart from the other fidelities, took 91 s instead of 97 on two cores, but 180 CPU s
#: instead of 135.
_TOGETHER = (UNITS, tuple(SINGLE.values()))
_CODE = ".bc"  # of files of portable code
_TICK = 0.2  # s
_END_OF_WORDS = 1000  # characters of either end of what a process that failed has written
#: Of a process's work: how far the bar may run ahead of what was reported. Of an object LLVM's longest task
#: is as much (`optimise`).
_LONGEST_GUESS = 0.6
#: Processor's time (s) of the portable code of each unit, those before it being done, and of its object: what
#: the bar is divided by. Of step measured (idle two-core AMD EPYC virtual machine, Python 3.11, Numba 0.68),
#: of the others estimated from shares of it under load.
_SECONDS = {
    "step": (47.0, 38.0),
    "init": (4.0, 6.0),
    "study": (2.0, 13.0),
    "sound": (1.0, 1.0),
}


@functools.cache
def sources_key() -> str:
    """Hash (64 hex digits) of all sources that objects are made from."""
    digest = hashlib.sha256(engine_digest())
    for name in _MAKERS:
        digest.update((Path(__file__).parent / f"{name}.py").read_bytes())
    return digest.hexdigest()


def folder() -> Path:
    """Folder of what these sources and these compilers make, this user's own.

    Raises
    ------
    CacheError
        As `files.own_folder`.
    """
    versions = f"{sys.version_info[:2]} {version('numba')} {version('llvmlite')}"
    key = hashlib.sha256(f"{sources_key()} {versions}".encode()).hexdigest()
    return own_folder(cache_root() / f"compiled-{key[:16]}")


def objects(platform: Platform, units: Iterable[str], sets: Iterable[str]) -> dict[tuple[str, str], bytes]:
    """Object files by unit and instruction set, compiled unless they are there.

    Raises
    ------
    BuildError
        If the kernels cannot be compiled.
    CacheError
        If others can write to the folder that they are kept in.
    """
    wanted = {(unit, one): object_name(unit, platform.name, one) for unit in units for one in sets}
    by_key = {key: data for key, name in wanted.items() if (data := _there(name)) is not None}
    if len(by_key) < len(wanted):
        with disk_cache.alone(folder(), _tell):
            for key, name in wanted.items():  # another process may have made them meanwhile
                if key not in by_key and (data := _there(name)) is not None:
                    by_key[key] = data
            missing = [key for key in wanted if key not in by_key]
            if missing:
                by_key |= _compile(platform, missing)
    return by_key


def kept(platform: Platform, units: Iterable[str], suffix: str) -> bool:
    """Whether objects of units are there, so that nothing needs to be compiled."""
    return all(_there(object_name(unit, platform.name, suffix)) is not None for unit in units)


def bitcode(unit: str) -> bytes:
    """Portable code of a unit, which the objects of every platform are made from.

    Raises
    ------
    BuildError
        If no object was made from it here; `objects` makes both.
    """
    data = _there(f"{unit}{_CODE}")
    if data is None:
        raise BuildError(f"the portable code of {unit} is not kept: clear {folder()} and compile again")
    return data


def _tell(text: str) -> None:
    if sys.stderr is not None:
        print(text, file=sys.stderr, flush=True)


def _there(name: str) -> bytes | None:
    """Return a file that the wheel brought or the cache keeps."""
    brought = prebuilt(name)
    return disk_cache.read(folder() / name, _tell) if brought is None else brought


def prebuilt(name: str) -> bytes | None:
    """Return a file that the wheel brought along; ``None`` without one made from these sources."""
    try:
        if (PREBUILT / "key").read_text(encoding="ascii").strip() == sources_key():
            return (PREBUILT / name).read_bytes()
    except OSError:
        pass
    return None


def _compile(platform: Platform, missing: list[tuple[str, str]]) -> dict[tuple[str, str], bytes]:
    """Compile units by processes of their own, and keep what they make.

    Some make portable code of units in turn; others optimise what has come, side by side.
    """
    units = {unit for unit, _ in missing}
    codes = {unit: code for unit in units if (code := _there(f"{unit}{_CODE}"))}
    due = [
        _Worker(lacking)
        for together in _TOGETHER
        if (lacking := [unit for unit in together if unit in units - codes.keys()])
    ]
    due += [_Worker([unit], platform, one) for unit, one in missing]
    what = f"compiling the kernels for {platform.name}, once for this version"
    with work(what, elsewhere=True), Display(what) as display:
        if not lean(version("numba")):
            # Portable code with Numba 0.68, processor's time: init 326 s, step 402 s; lean 21 s and 28 s.
            display.tell(
                f"Numba {version('numba')} is not one of the versions tested "
                f"({', '.join(TESTED)}): the kernels are compiled the plain way, which takes "
                "minutes"
            )
        files = _run(due, codes, display)
        for name, data in files.items():
            if not disk_cache.write(folder() / name, data, display.tell):
                break
    return {(unit, one): files[object_name(unit, platform.name, one)] for unit, one in missing}


def _whole(unit: str) -> str:
    """Name of the unit that serves every scene."""
    return unit.removeprefix("single_")


def _run(due: list["_Worker"], codes: dict[str, bytes], display: Display) -> dict[str, bytes]:
    """Run workers, as many at a time as there are cores; end them all if one fails or on Ctrl-C.

    ``codes``: portable code by unit, to which what comes is added.
    """
    waiting = list(due)
    running: list[_Worker] = []
    at_once = max(1, os.cpu_count() or 1)
    try:
        while waiting or running:
            able = [worker for worker in waiting if worker.suffix is None or worker.units[0] in codes]
            for worker in able[: at_once - len(running)]:
                waiting.remove(worker)
                running.append(worker)
                worker.start(b"" if worker.suffix is None else codes[worker.units[0]])
            time.sleep(_TICK)
            for worker in list(running):
                if worker.ended():
                    running.remove(worker)
                for name, data in list(worker.files.items()):
                    if name.endswith(_CODE):
                        codes[name.removesuffix(_CODE)] = data
            done = sum(worker.part() * sum(worker.seconds) for worker in due)
            display.at(done / sum(sum(worker.seconds) for worker in due))
    finally:
        for worker in running:
            worker.kill()
    return {name: data for worker in due for name, data in worker.files.items()}


class _Worker:
    """A process that makes portable code of units, or optimises one, and what it has sent so far.

    Parameters
    ----------
    units : list of str
    platform, suffix : optional
        Of the object that it makes from portable code of the unit; without them it makes portable code.
    """

    def __init__(self, units: list[str], platform: Platform | None = None, suffix: str | None = None) -> None:
        self.units, self.platform, self.suffix = units, platform, suffix
        self.files: dict[str, bytes] = {}
        self._messages: queue.SimpleQueue[float] = queue.SimpleQueue()
        self._done, self._since, self._begin, self._shown = 0.0, 0.0, 0.0, 0.0
        self.seconds = [_SECONDS[_whole(unit)][platform is not None] for unit in units]
        self._process: Popen[bytes] | None = None

    def _command(self) -> list[str]:
        if self.platform is None or self.suffix is None:
            job = ["lean" if lean(version("numba")) else "plain", *self.units]
        else:
            job = [self.platform.name, *self.units, self.suffix]
        return children.python("fmu_bearing.compiled.worker", *job)

    def _due(self) -> set[str]:
        """Names of the files that it makes."""
        if self.platform is None or self.suffix is None:
            return {f"{unit}{_CODE}" for unit in self.units}
        return {object_name(unit, self.platform.name, self.suffix) for unit in self.units}

    def start(self, code: bytes) -> None:
        """Start the process, which is given portable code."""
        self._process = children.start(self._command(), SETTINGS, stdin=PIPE, stdout=PIPE, stderr=PIPE)
        self._complaint = b""
        self._begin = self._since = time.monotonic()
        self._readers = [threading.Thread(target=one, daemon=True) for one in (self._listen, self._collect)]
        for reader in self._readers:
            reader.start()
        assert self._process.stdin is not None
        # a process that is gone already leaves a broken pipe; its reason is given by `ended`
        with contextlib.suppress(OSError), self._process.stdin as stdin:
            stdin.write(code)

    def _listen(self) -> None:
        assert self._process is not None and self._process.stdout is not None
        for line in self._process.stdout:
            message = json.loads(line)
            if "file" in message:
                self.files[message["file"]] = self._process.stdout.read(message["size"])
            else:
                self._messages.put(message["done"])

    def _collect(self) -> None:
        assert self._process is not None and self._process.stderr is not None
        self._complaint = self._process.stderr.read()

    def ended(self) -> bool:
        """Whether it is through; ``BuildError`` with its last words if it failed."""
        assert self._process is not None
        if self._process.poll() is None:
            return False
        for reader in self._readers:
            reader.join()
        units = " and ".join(self.units)
        if self._process.returncode != 0:
            words = self._complaint.decode(errors="replace").strip()
            if len(words) > 2 * _END_OF_WORDS:  # Numba gives its reason first, and the calls to it behind
                words = f"{words[:_END_OF_WORDS]} [...] {words[-_END_OF_WORDS:]}"
            words = words or f"the process ended with code {self._process.returncode} and gave no reason"
            raise BuildError(f"the kernels could not be compiled ({units}): {words}")
        if lost := sorted(self._due() - self.files.keys()):
            raise BuildError(f"the kernels could not be compiled ({units}): not received: {', '.join(lost)}")
        self._done = 1.0
        return True

    def part(self) -> float:
        """Part that is done (0 to 1); between two reports it goes on at the pace so far."""
        now = time.monotonic()
        while not self._messages.empty():
            self._done, self._since = max(self._done, self._share(self._messages.get())), now
        if not 0.0 < self._done < 1.0:
            return self._done
        pace = self._done / max(self._since - self._begin, 1e-3)
        guess = min(self._done + min(pace * (now - self._since), _LONGEST_GUESS), 0.99)
        self._shown = max(self._shown, guess)
        return self._shown

    def _share(self, units: float) -> float:
        """Share (0 to 1) of the time that some of the units take."""
        whole = int(units)
        part = (units - whole) * self.seconds[whole] if whole < len(self.seconds) else 0.0
        return (sum(self.seconds[:whole]) + part) / sum(self.seconds)

    def kill(self) -> None:
        """End the process at once."""
        if self._process is not None and self._process.poll() is None:
            self._process.kill()
            self._process.wait()
