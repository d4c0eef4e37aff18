"""Tables of results and what makes them: ``python -m benchmarks.tables [NAME ...]``, or ``make tables``.

Each table says which version of the package and which engine made it. Those that another engine made are made
again, one after the other, as times want the machine for themselves; interrupted, the next call goes on with
the first that is still old. ``--stale`` names them, and ends with 1 if there are any: a release has none.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import time

from fmu_bearing.engine.sources import source_hash

ROOT = pathlib.Path(__file__).parents[1]
RESULTS = ROOT / "docs" / "results"
#: Tables that no command here can remake, and why; they carry a date.
APART = {
    "ross": "ROSS 3 needs Python 3.13 and an environment of its own",
    "quick_fidelities": "parts of `benchmarks.quick_fidelities`, `quick_gates`, `quick_limits`: hours",
    "steps_of_full": "surveys from which constants of the method were chosen",
}
_SPINDLE = "examples/scenes/7003C-spindle.toml"
_HERE = "docs/results"
_FMU_BEARING = ("-m", "fmu_bearing")
#: What Python is called with for each table, those of speeds first; a command may make several.
COMMANDS: dict[tuple[str, ...], tuple[str, ...]] = {
    ("tradeoff",): (
        *_FMU_BEARING, "tradeoff", _SPINDLE, "--output", _HERE, "--force",
        "--plot", "docs/images/tradeoff.png",
    ),
    ("tradeoff_db", "tradeoff_qbc"): ("-m", "benchmarks.set_tradeoff", _HERE),
    ("costs",): ("-m", "benchmarks.costs", f"{_HERE}/costs.md"),
    ("realtime",): ("-m", "benchmarks.realtime", f"{_HERE}/realtime.md"),
    ("benchmark",): ("-m", "benchmarks.run", "--output", _HERE),
    ("sets",): ("-m", "benchmarks.sets", f"{_HERE}/sets.md"),
    ("scenes",): ("-m", "benchmarks.scenes", "--output", _HERE),
    ("band",): ("-m", "benchmarks.band", "--output", _HERE),
    ("commands",): ("-m", "benchmarks.commands", f"{_HERE}/commands.md"),
    ("sensitivity",): (*_FMU_BEARING, "sensitivity", _SPINDLE, "--output", _HERE, "--force"),
    ("first_sound",): ("-m", "benchmarks.first_sound", f"{_HERE}/first_sound.md"),
    ("dataset",): ("-m", "benchmarks.dataset", f"{_HERE}/dataset.md"),
    ("settled",): ("-m", "benchmarks.settled", f"{_HERE}/settled.md"),
    ("vibration",): ("-m", "benchmarks.vibration", f"{_HERE}/vibration.md"),
    ("coupling",): (
        "examples/spindle_cosimulation/stability.py", "--results", _HERE, "--images", "docs/images",
    ),
    ("sweep",): (
        "examples/sweep/critical_speed.py", "--output-dir", _HERE, "--picture", "docs/images/sweep.png",
    ),
    ("axial_mode",): ("examples/modes/axial_mode.py", "--output-dir", _HERE),
    ("contact_conditions",): ("examples/impact/contact_conditions.py", "--output-dir", _HERE),
    ("three_balls",): ("examples/impact/three_balls.py", "--output-dir", _HERE),
    ("measured",): ("-m", "benchmarks.measured.run"),
    ("own_peaks",): ("examples/impact/own_peaks.py", "--output-dir", _HERE),
}  # fmt: skip
_ENGINE = re.compile(r"fmu-bearing (\S+), engine ([0-9a-f]{16})")


def made_by(text: str) -> tuple[str, str] | None:
    """Return version and engine that a table names; None where it names none."""
    found = _ENGINE.search(text)
    return None if found is None else (found[1], found[2])


def stale(folder: pathlib.Path = RESULTS) -> dict[str, str]:
    """Return the tables that another engine made, by name: what they say."""
    found = {}
    for path in sorted(folder.glob("*.md")):
        made = made_by(path.read_text("utf-8"))
        if path.stem not in APART and (made is None or made[1] != source_hash()):
            found[path.stem] = f"engine {made[1] if made else 'not named'}, now {source_hash()}"
    return found


def make(names: list[str]) -> list[str]:
    """Make tables of these names, all that are old by default; return those whose command failed."""
    old = names or list(stale())
    due = [(made, command) for made, command in COMMANDS.items() if set(made) & set(old)]
    failed = []
    for k, (made, command) in enumerate(due, start=1):
        print(f"{k} of {len(due)}: {', '.join(made)}", flush=True)
        begun = time.perf_counter()
        if subprocess.run([sys.executable, *command], cwd=ROOT, check=False).returncode:
            failed += made
        print(f"{k} of {len(due)}: after {time.perf_counter() - begun:.0f} s", flush=True)
    return failed


def main() -> int:
    """Make old tables or those named, or name the old ones; 1 where some are old or failed."""
    known = [name for made in COMMANDS for name in made]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("name", nargs="*", help=f"of {', '.join(known)}; default: those of another engine")
    parser.add_argument("--stale", action="store_true", help="name those of another engine, and make none")
    given = parser.parse_args()
    if unknown := set(given.name) - set(known):
        parser.error(f"{', '.join(sorted(unknown))}: no such table; there are {', '.join(known)}")
    if given.stale:
        found = [f"{name}: {text}" for name, text in stale().items()]
    else:
        found = [f"{name}: its command failed" for name in make(given.name)]
    print("\n".join(found))
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
