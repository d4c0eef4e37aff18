"""Write the page, its tables and the figures: ``python -m benchmarks.measured.run``, `make measured`."""

import argparse
import sys
from pathlib import Path

from benchmarks.measured.compared import everything
from benchmarks.measured.page import COLUMNS, all_rows, page, tables
from benchmarks.measured.pictures import draw, drawable
from fmu_bearing.results.table import write_csv

DOCS = Path(__file__).parents[2] / "docs"


def main() -> None:
    """Compute all, about five minutes of a processor, and write it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--output", type=Path, default=DOCS, help="folder of the page; default: docs")
    folder = parser.parse_args().output
    found = everything(lambda line: print(line, file=sys.stderr, flush=True))
    (folder / "results").mkdir(parents=True, exist_ok=True)
    write_csv(folder / "results" / "measured.csv", COLUMNS, list(all_rows(found)))
    for key, rows in found.items():
        if len(drawable(rows)) > 1:
            draw(drawable(rows), folder / "images" / "measured" / f"{key}.png")
    (folder / "results" / "measured.md").write_text(tables(found), encoding="utf-8")
    (folder / "measured.md").write_text(page(found), encoding="utf-8")


if __name__ == "__main__":
    main()
