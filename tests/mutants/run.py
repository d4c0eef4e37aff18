"""Runs mutants: each in a copy of the repository, against the tests that may kill it, until the first does.

::

    python -m tests.mutants.run --list fits            # those of one list, quick tests
    python -m tests.mutants.run --id pockets --tests tests/prepare
    python -m tests.mutants.run --alive --heavy        # those that live, heavy tests

Copies lie under ``--folder``; mutants of the engine share one, which is compiled once (`schemata`). What was
found is written into the lists: killers and processor seconds. A mutant that lives keeps no killers.
"""

import argparse
import contextlib
import importlib
import os
import re
import resource
import shutil
import signal
import sys
import tempfile
import zlib
from collections.abc import Sequence
from pathlib import Path

from tests.mutants import schemata
from tests.mutants.candidates import candidates
from tests.mutants.entries import LISTS, ROOT, Mutant, mutants, read

#: What tests read beside the package and themselves.
COPIED = ("fmu_bearing", "tests", "examples", "benchmarks", "docs", "modelDescription", "pyproject.toml",
          "build_fmu.py", "README.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE",
          "constraints.txt")  # fmt: skip
#: What tests and the package load of others, loaded once.
LOADED = ("numba", "scipy.signal", "scipy.optimize", "scipy.interpolate", "scipy.linalg",
          "scipy.sparse.linalg", "pydantic", "typer", "rich", "matplotlib.pyplot", "plotly.graph_objects",
          "pytest", "hypothesis")  # fmt: skip
_FAILED = re.compile(r"^(?:FAILED|ERROR) (tests/.+?)(?: - .*)?$", re.M)
_RUNS = re.compile(r"^(tests/\S+::.+?)(?: (?:PASSED|FAILED|SKIPPED|ERROR|XFAIL).*)?$", re.M)


def copied(folder: Path) -> Path:
    """A copy of the repository, made where there is none yet."""
    if not folder.exists():
        folder.mkdir(parents=True)
        for name in COPIED:
            source = ROOT / name
            (shutil.copytree if source.is_dir() else shutil.copy2)(source, folder / name)
    return folder


def numbered(every: Sequence[Mutant]) -> list[tuple[int, Mutant]]:
    """Mutants of the engine by their numbers."""
    return [(number, one) for number, one in enumerate(every, 1) if one.engine]


def woven(folder: Path, every: Sequence[Mutant]) -> Path:
    """The copy with all mutants of the engine."""
    if not folder.exists():
        schemata.weave(copied(folder), numbered(every))
    return folder


def pytest(
    root: Path, files: Sequence[str], marks: str, number: int, seconds: int, until: str = "-x"
) -> tuple[int, str, float]:
    """Run tests until the first fails; return the exit code, what was printed, and processor seconds.

    In a process that branches off this one, which has loaded what takes seconds to load.
    """
    words = [until, "-v", "--tb=no", "-rfE", "-p", "no:cacheprovider"]
    words += ["-o", f"timeout={seconds}", "-m", marks]
    before = sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    with tempfile.TemporaryFile("w+") as out:
        sys.stdout.flush()
        if not (child := os.fork()):
            code = 70
            try:
                for here, stream in ((1, out), (2, out)):
                    os.dup2(stream.fileno(), here)
                os.chdir(root)
                sys.path[:] = [str(root), *(one for one in sys.path if Path(one or ".").resolve() != ROOT)]
                for name in [one for one in sys.modules if one.split(".")[0] in ("tests", "fmu_bearing")]:
                    del sys.modules[name]
                os.environ |= {"PYTHONPATH": str(root), schemata.VARIABLE: str(number)}
                resource.setrlimit(resource.RLIMIT_CPU, (4 * seconds, 4 * seconds + 5))
                code = int(importlib.import_module("pytest").main([*words, *files]))
                sys.stdout.flush()
            finally:
                os._exit(code)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        out.seek(0)
        text = out.read()
    return code, text, sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2]) - before


def run(one: Mutant, root: Path, files: Sequence[str], marks: str, number: int, seconds: int) -> bool:
    """Run one mutant in a copy, note in it what killed it, and return whether something did."""
    path = root / one.file
    if not number:
        times = path.stat()
        path.write_text((ROOT / one.file).read_text("utf-8").replace(one.old, one.new), "utf-8")
        # no compiled module of another source fits it
        os.utime(path, (times.st_atime, times.st_mtime + 7.0 + zlib.crc32(one.new.encode()) % 1_000_000))
    one.seconds = 0.0
    try:
        for part in (files[:1], files[1:4], files[4:]):
            if not part or one.seconds > seconds:
                continue
            code, text, spent = pytest(root, part, marks, number, seconds)
            one.seconds += spent
            if code in (0, 5):  # all pass, or none of them has these marks
                continue
            if code == -signal.SIGXCPU:
                print(f"   {one.id}: no time left in {(_RUNS.findall(text) or part)[-1]}")
                continue
            failed = _FAILED.findall(text) or [(_RUNS.findall(text) or ["collection"])[-1]]
            one.killers = [failed[0].replace(str(root) + "/", "")]
            if code < 0 or not _FAILED.search(text):
                print(f"   ended by {code}: {text[-300:]}")
            return True
    finally:
        if not number:
            shutil.copy2(ROOT / one.file, path)
    return False


def noted(path: Path, one: Mutant) -> None:
    """Write a list again with one mutant as it was found; another run may have changed others meanwhile."""
    every = [one if there.id == one.id else there for there in read(path)]
    path.write_text("\n".join(there.to_toml() for there in every), "utf-8")


def main() -> None:
    """Run what the command line names."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    options.add_argument("--list", action="append", help="name of a list; default: all")
    options.add_argument("--id", action="append", help="name of a mutant, with or without number")
    options.add_argument("--alive", action="store_true", help="those that have no killer")
    options.add_argument("--tests", action="append", help="files or folders, in place of those of the room")
    options.add_argument("--heavy", action="store_true", help="heavy tests alone")
    options.add_argument("--longest", type=float, default=12.0, help="s: of a file of tests that is tried")
    options.add_argument("--seconds", type=int, default=120, help="of a processor for a mutant, about")
    options.add_argument("--most", type=int, default=30, help="files that are tried")
    options.add_argument("--folder", type=Path, default=ROOT / "out" / "mutants")
    options.add_argument("--check", action="store_true", help="that all killers pass on the program as it is")
    options.add_argument("--kind", choices=("python", "engine"), help="of the sources")
    given = options.parse_args()
    os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")
    for name in LOADED:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    every = mutants()
    numbers = {one.id: number for number, one in numbered(every)}
    if given.check:
        killers = sorted({killer for one in every for killer in one.killers})
        root = copied(given.folder / "python")
        code, text, _ = pytest(root, killers, "", 0, 3000, "--maxfail=1000")
        print(text[-2000:])
        sys.exit(code)
    marks = "heavy" if given.heavy else "not heavy and not bits and not lint"
    renewed: list[str] = []
    for path in sorted(LISTS.glob("*.toml")):
        there = read(path)
        for one in there:
            left_out = given.list and path.stem not in given.list or given.id and one.id not in given.id
            left_out = left_out or given.alive and (one.killers or one.alive)
            left_out = left_out or given.kind and (given.kind == "engine") != one.engine
            if left_out:
                continue
            kind = "engine" if one.engine else "python"
            root = woven(given.folder / kind, every) if one.engine else copied(given.folder / kind)
            if kind not in renewed:
                renewed.append(kind)  # tests may have become better since, a run have been ended
                for name in ("tests",) if one.engine else ("tests", "fmu_bearing"):
                    shutil.copytree(ROOT / name, root / name, dirs_exist_ok=True)
            files = given.tests or candidates(one, given.longest, given.most)
            before = one.killers
            killed = run(one, root, files, marks, numbers.get(one.id, 0), given.seconds)
            if not killed and not given.heavy and not given.tests:
                one.killers = []
            words = one.killers[0] if killed else f"LIVES after {len(files)} files (before: {before})"
            print(f"{one.id:34s} {one.seconds:5.0f} s  {words}", flush=True)
            noted(path, one)


if __name__ == "__main__":
    main()
