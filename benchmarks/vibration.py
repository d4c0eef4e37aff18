"""The vibration test of two bearings by tolerance class: ``python -m benchmarks.vibration [FILE]``.

Rms velocities of the bands with both loading pieces, their range over seeds, and each source alone. The
picture of the 7003C of class P4 is written where ``--picture`` names a file. Five minutes of one core.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from fmu_bearing import vibration
from fmu_bearing.results.picture_parts import save
from fmu_bearing.results.table import machine, markdown, tenths, write_csv
from fmu_bearing.vibration_test.rig import BANDS, PIECES
from fmu_bearing.vibration_test.vibration import Vibration

#: Bearing, class, whether its rings stay round, seeds.
CASES = (
    ("7003C", "P4", False, 8),
    ("7003C", "P2", False, 4),
    ("7003C", "P5", False, 4),
    ("7003C", "P4", True, 4),
    ("7009C", "P4", False, 2),
)
_ENDS = ("mean", "low", "high", "std, %")
COLUMNS = (
    "bearing",
    "class",
    "rings",
    "seeds",
    "what",
    *(f"{band} {end}" for band in BANDS for end in _ENDS),
)

_HEAD = """Made by `python -m benchmarks.vibration`: rms velocity (um/s) of hybrid bearings in the vibration
test, fidelity `full`: mean, lowest and highest of the seeds, and their standard deviation in per cent of the
mean. Rows of one source alone are of the first seed.
"""


def rows(found: Vibration) -> Iterator[list[str]]:
    """Yield what was read, and the figures of each band."""
    bands = found.bands
    for piece in PIECES:
        cells: list[str] = []
        for one in bands:
            values = getattr(one, piece)
            share = 100.0 * np.std(values, ddof=1) / values.mean()
            cells += [tenths(values.mean()), tenths(values.min()), tenths(values.max()), f"{share:.0f}"]
        yield [f"{piece} piece", *cells]
    for source in found.alone:
        yield [
            f"{source} alone",
            *(cell for one in bands for cell in (tenths(one.alone[source]), "", "", "")),
        ]


def main() -> None:
    """Print the rows as they come; write the table to a file where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", nargs="?", type=Path, help="where to write the table, .md and .csv")
    parser.add_argument("--picture", type=Path, help="where to write the picture")
    given = parser.parse_args()
    table: list[list[str]] = []
    for name, grade, rigid, seeds in CASES:
        found = vibration(name, seeds, grade=grade, rigid=rigid)
        case = [name, grade, "round" if rigid else "bend", str(seeds)]
        for row in rows(found):
            table.append([*case, *row])
            print(*table[-1], sep=" | ", flush=True)
        if given.picture is not None and (name, grade, rigid) == CASES[0][:3]:
            save(found.picture(), given.picture)
    if given.file is not None:
        head = f"# Vibration test\n\n{machine()}\n\n{_HEAD}\n"
        given.file.with_suffix(".md").write_text(head + markdown(COLUMNS, table), encoding="utf-8")
        write_csv(given.file.with_suffix(".csv"), COLUMNS, table)


if __name__ == "__main__":
    main()
