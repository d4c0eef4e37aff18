"""`validate`: all checks of one FMU, in separate processes, so that a crash does not end the caller's."""

import json
import os
import queue
import signal
import tempfile
import threading
import zipfile
from collections.abc import Callable
from pathlib import Path
from subprocess import PIPE
from typing import IO, Any
from xml.etree import ElementTree

from fmu_bearing import children
from fmu_bearing.file_words import FMU, trouble
from fmu_bearing.files import plain_file
from fmu_bearing.validation.checks import CHECKS, NEEDED, meaning_of, name_of
from fmu_bearing.validation.remarks import FINDING, SKIPPED, Result
from fmu_bearing.validation.tools import TOOLS, words

LIMIT = 60.0  # s: any check of a bearing takes seconds
_ALL = (*TOOLS, *CHECKS)
_DESCRIPTION = "modelDescription.xml"
_LOADING = 60.0  # s, for the process to begin
_LAST_WORDS = 2  # lines of standard error that a finding repeats


class NotAnFmu(ValueError):
    """A file that is not an FMU for FMI 2.0 co-simulation."""


def validate(
    path: str | os.PathLike[str], limit: float = LIMIT, tell: Callable[[str], None] = lambda _: None
) -> list[Result]:
    """Check an FMI 2.0 co-simulation FMU: its description by other tools, its behaviour by own checks.

    Parameters
    ----------
    path : path
        The FMU.
    limit : float
        Time (s) that a check may take; one that takes longer is ended and is a finding.
    tell : callable, optional
        Takes the name of each check before it is run.

    Returns
    -------
    list of Result
        One for each check, in the order they were run.

    Raises
    ------
    NotAnFmu
        For a file that is not an FMU, or for another version or kind of FMI.

    Examples
    --------
    >>> from fmu_bearing.validation import validate
    >>> results = validate("out/Bearing7003C.fmu")  # doctest: +SKIP
    >>> [r.check for r in results if r.outcome == "finding"]  # doctest: +SKIP
    []
    """
    path = Path(path)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "fmu"
        _unpack(path, folder)
        problem = _kind(path, folder)
        results = _Process(path, folder, limit, tell).results(len(TOOLS) if problem else len(_ALL))
    for result in results[len(TOOLS) :] if problem else ():
        result.add(SKIPPED, f"the description cannot be read: {problem}")
    return results


def _unpack(path: Path, folder: Path) -> None:
    try:
        with zipfile.ZipFile(plain_file(path)) as archive:
            if _DESCRIPTION not in archive.namelist():
                raise NotAnFmu(f"{path}: is not an FMU: it holds no {_DESCRIPTION}")
            archive.extractall(folder)  # leaves out what points outside the folder
    except NotAnFmu:
        raise
    except Exception as problem:  # zipfile and zlib raise what they come upon in damaged files
        raise NotAnFmu(f"{path}: {trouble(path, FMU, problem, 'FMU', known=False)}") from None


def _kind(path: Path, folder: Path) -> str:
    """Return why the description cannot be read; another version or kind is refused."""
    try:
        root = ElementTree.parse(folder / _DESCRIPTION).getroot()
    except Exception as problem:  # of what is no XML, or in an encoding that is not known
        return str(problem) or repr(problem)
    version = root.get("fmiVersion", "")
    if version != "2.0" or root.find("CoSimulation") is None:
        kind = "co-simulation" if root.find("CoSimulation") is not None else "model exchange only"
        raise NotAnFmu(
            f"{path}: is FMI {version or 'of no version'}, {kind}; only FMI 2.0 co-simulation is checked"
        )
    try:
        from fmu_bearing.validation.subject import Subject

        Subject(folder)
    except Exception as problem:  # FMPy raises what it comes upon
        return str(problem) or repr(problem)
    return ""


class _Process:
    """Runs the checks in one separate process; after a check that ended it, in a new one."""

    def __init__(self, path: Path, folder: Path, limit: float, tell: Callable[[str], None]) -> None:
        self.path, self.folder, self.limit, self.tell = path, folder, limit, tell
        self.found = [words(tool) for tool in TOOLS]
        self.found += [Result(name_of(check), meaning_of(check)) for check in CHECKS]

    def _together(self) -> int:
        """Return how many checks a process may run: one where it may make one instance."""
        root = ElementTree.parse(self.folder / _DESCRIPTION).getroot().find("CoSimulation")
        once = root is not None and root.get("canBeInstantiatedOnlyOncePerProcess") == "true"
        return 1 if once else len(_ALL)

    def results(self, end: int) -> list[Result]:
        """Run all up to a number, and return all."""
        number, alone = 0, False
        together = self._together() if end == len(_ALL) else end
        while number < end:
            count = min(1 if alone else together, end - number)
            at, how = self._process(number, count)
            if not how:
                number, alone = number + count, False
            elif at > max(number, len(TOOLS)):
                also = "earlier instances in that process may have had an effect; it is run again alone"
                self.found[at].add(FINDING, f"{how}; {also}")
                number, alone = at, True
            else:
                # that another tool takes long is no fault of the FMU
                self.found[at].add(SKIPPED if at < len(TOOLS) and "longer" in how else FINDING, how)
                number, alone = at + 1, False
                if _ALL[at] in NEEDED:
                    for result in self.found[number:]:
                        result.add(SKIPPED, f"'{self.found[at].check}' did not come to an end")
                    break
        return self.found

    def _process(self, first: int, count: int) -> tuple[int, str]:
        """Run some checks; return which one ended the process, and how; None if all came to an end."""
        asked = (str(self.path), str(self.folder), str(first), str(count))
        command = children.python("fmu_bearing.validation.worker", *asked)
        with (
            tempfile.TemporaryFile() as errors,
            children.start(command, stdout=PIPE, stderr=errors) as process,
        ):
            assert process.stdout is not None
            at, late = self._listen(process.stdout, first)
            if late:
                process.kill()
            code = process.wait()
            if late:
                return at, f"the check took longer than {self.limit:g} s and was ended"
            return at, f"the process ended {_how(code)}{_last_words(errors)}" if code else ""

    def _listen(self, stream: IO[bytes], first: int) -> tuple[int, bool]:
        """Read the reports of the process until it ends; return its last check, and whether it was late."""
        lines: queue.Queue[bytes] = queue.Queue()
        threading.Thread(target=_forward, args=(stream, lines), daemon=True).start()
        at, wait = first, self.limit + _LOADING
        while True:
            try:
                line = lines.get(timeout=wait)
            except queue.Empty:
                return at, True
            if not line:
                return at, False
            said: dict[str, Any] = json.loads(line)
            wait = self.limit
            if "begins" in said:
                at = said["begins"]
                self.tell(self.found[at].check)
            for severity, detail in said.get("details", ()):
                self.found[at].add(severity, detail)


def _forward(stream: IO[bytes], lines: "queue.Queue[bytes]") -> None:
    """Pass on lines, and an empty one at the end."""
    for line in stream:
        lines.put(line)
    lines.put(b"")


def _how(code: int) -> str:
    if code >= 0:
        return f"with exit code {code}"
    try:
        return f"by signal {-code} ({signal.Signals(-code).name})"
    except ValueError:
        return f"by signal {-code}"


def _last_words(errors: IO[bytes]) -> str:
    errors.seek(0)
    lines = [line.strip() for line in errors.read().decode("utf-8", "replace").splitlines() if line.strip()]
    return f": {'; '.join(lines[-_LAST_WORDS:])}" if lines else ""
