"""Tables of results older than the engine: ``python -m benchmarks.stale`` names them, and ends with 1.

Each table says which version of the package and which engine made it. A release has none that is older.
"""

import pathlib
import re
import sys

from fmu_bearing.engine.sources import source_hash

RESULTS = pathlib.Path(__file__).parents[1] / "docs" / "results"
#: Tables that no command here can remake, and why; they carry a date.
APART = {"ross.md": "ROSS 3 needs Python 3.13 and an environment of its own"}
_ENGINE = re.compile(r"fmu-bearing (\S+), engine ([0-9a-f]{16})")


def made_by(text: str) -> tuple[str, str] | None:
    """Return version and engine that a table names; None where it names none."""
    found = _ENGINE.search(text)
    return None if found is None else (found[1], found[2])


def stale(folder: pathlib.Path = RESULTS) -> list[str]:
    """Return a line for each table that another engine made."""
    lines = []
    for path in sorted(folder.glob("*.md")):
        made = made_by(path.read_text("utf-8"))
        if path.name not in APART and (made is None or made[1] != source_hash()):
            lines.append(f"{path.name}: engine {made[1] if made else 'not named'}, now {source_hash()}")
    return lines


if __name__ == "__main__":
    found = stale()
    print("\n".join(found))
    sys.exit(bool(found))
