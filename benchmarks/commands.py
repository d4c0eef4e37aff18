"""Processor time of each command on a single bearing and on a pair. ``python -m benchmarks.commands [FILE]``

Every command runs in a process of its own, as from a shell. Times are user and system seconds of that process
and of those that it starts, with the start of Python (about a second). Kernels have been compiled before.
Sound is of radiation model ``compact``: boundary elements are solved once for each shape, and then kept.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from benchmarks.realtime import scenes
from fmu_bearing.results.table import machine, markdown, write_csv

COLUMNS = ("command", "single, CPU s", "DB, CPU s")
_LIMIT = 300.0  # s of the clock
_NEW = {"single": "", "DB": " --arrangement DB"}
_BRIEF = "--duration 0.2 --no-directivity --no-wav"
_MILLING = {"teeth": 4, "cutting_coefficient_N_mm2": 800.0, "radial_ratio": 0.3, "depth_mm": 0.1}
_FIT = {"bearing_class": "P4", "preload": "unmounted", "shaft": {"shaft_class": "js5"}}
#: In this order: some read what one before them wrote.
COMMANDS = (
    "scene new new.toml --bearing 7003C --speed 20000", "scene check S.toml", "scene show S.toml",
    "info S.toml", "fits F.toml", "modes S.toml", "stiffness S.toml --output K.csv",
    "receptance S.toml --output G.csv", "lobes M.toml --output L.csv",
    "simulate S.toml --stop-time 0.1 --output run.csv", "plot run.csv",
    "error-motion S.toml --fidelity rings --revolutions 20 --output error",
    "realtime S.toml --step 1e-3 --duration 0.05", "build S.toml --output S.fmu", "validate S.fmu",
    f"sound S.toml {_BRIEF} --no-spread --output sound",
    "sound sound/recording.npz --at 1700 --no-directivity --no-wav --no-spread --output at",
    f"sound S.toml {_BRIEF} --fidelity rings --output rings",
    "envelope sound/recording.npz --output envelope",
    "compare S.toml new.toml --fidelity rings --radiation-model compact --duration 0.1",
    "report S.toml --output S.html", "changes S.toml --no-levels", "choose S.toml",
    "sweep S.toml --axis speed=10000:14000:3 --output sweep", "sensitivity S.toml --quick --output study",
    "tradeoff S.toml --quick --output study", "vibration S.toml --seeds 1 --output test",
)  # fmt: skip

_HEAD = """Made by `python -m benchmarks.commands`: seconds of the processor (user and system, child processes
too) for each command in a process of its own. S.toml is the example 7003C-spindle, 20,000 r/min, or 7003C-DB,
15,000 r/min, with four microphones; F.toml is the same with js5 on P4, M.toml with a cut. `scene new` has
`--arrangement DB` for the pair. Sound is of radiation model `compact`; kernels were compiled before. Other
work ran beside: caches and clock are shared, so that a figure is good to some 20 %. `warm-up` compiles once,
`identify` needs a measurement, and `dataset` has a table of its own: they are left out.
"""


def spent(words: str, folder: Path) -> str:
    """Run a command; return its processor time (s), with its exit code where that is not 0."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "fmu_bearing", *words.split()]
    where = os.environ | {"PYTHONPATH": str(Path(__file__).parents[1])}
    try:
        done = subprocess.run(command, cwd=folder, env=where, capture_output=True, timeout=_LIMIT)
        remark = f" (exit code {done.returncode})" if done.returncode else ""
    except subprocess.TimeoutExpired:
        remark = f" (stopped after {_LIMIT:g} s)"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return f"{after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime:.1f}{remark}"


def rows(commands: tuple[str, ...] = COMMANDS) -> Iterator[list[str]]:
    """Time the commands on both scenes, one after another."""
    with tempfile.TemporaryDirectory() as name:
        folders = {words: Path(name) / words for words in _NEW}
        given = {words: scene for words, scene in scenes().items() if words in _NEW}
        for words, scene in given.items():
            folders[words].mkdir()
            brief = scene.replace({"sound.radiation_model": "compact"})
            (folders[words] / "S.toml").write_text(brief.to_toml(), encoding="utf-8")
            table = "mounting.fit" if scene.spindle is None else "spindle.fit"
            (folders[words] / "F.toml").write_text(brief.replace({table: _FIT}).to_toml(), encoding="utf-8")
            milled = brief.replace({"milling": _MILLING | {"radial_immersion": 0.5, "direction": "down"}})
            (folders[words] / "M.toml").write_text(milled.to_toml(), encoding="utf-8")
            spent("info S.toml", folders[words])  # the first process reads the package from the disk
        for one in commands:
            more = {words: add if one.startswith("scene new") else "" for words, add in _NEW.items()}
            yield [f"`{one}`", *(spent(one + more[words], folder) for words, folder in folders.items())]


def main() -> None:
    """Print the times as they come; write the table to a file where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", nargs="?", type=Path, help="where to write the table, .md and .csv")
    given = parser.parse_args()
    found = []
    for row in rows():
        print(*row, sep=" | ", flush=True)
        found.append(row)
    if given.file is not None:
        head = f"# Time of each command\n\n{machine()}\n\n{_HEAD}\n"
        given.file.with_suffix(".md").write_text(head + markdown(COLUMNS, found), encoding="utf-8")
        write_csv(given.file.with_suffix(".csv"), COLUMNS, found)


if __name__ == "__main__":
    main()
