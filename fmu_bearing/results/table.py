"""Tables of results for terminal, Markdown and CSV; rows of CSV files; description of the machine."""

import csv
import io
import math
import os
import pathlib
import platform
import re
import textwrap
from collections.abc import Iterator, Sequence

import numba
import numpy as np

from fmu_bearing import __version__
from fmu_bearing.engine.sources import source_hash
from fmu_bearing.file_words import TABLE, absent, instead, why
from fmu_bearing.files import read_text

_WIDEST = 10_000  # characters: no table is wider
_SEPARATORS = (";", "\t", ",")
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+(?:[eE][+-]?[0-9]+)?")


def machine() -> str:
    """Processor, cores and the versions that matter, of this package with the hash of its engine."""
    model = platform.processor() or platform.machine()
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    if cpuinfo.exists():
        names = [line for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        model = names[0].split(":", 1)[1].strip() if names else model
    return (
        f"{model}, {os.cpu_count()} cores (one used), {platform.system()}; "
        f"Python {platform.python_version()}, NumPy {np.__version__}, Numba {numba.__version__}; "
        f"fmu-bearing {__version__}, engine {source_hash()}"
    )


def number(value: float) -> str:
    """Two or three digits, empty for NaN."""
    if math.isnan(value):
        return ""
    if value == 0.0 or 0.01 <= abs(value) < 1e4:
        return f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"
    return f"{value:.1e}"


def tenths(value: float) -> str:
    """Return a number with one decimal; what rounds to nothing has no sign."""
    return f"{round(value, 1) + 0.0:.1f}"


def markdown(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Pipe table."""
    lines = ["| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def show(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print one table within the width of the terminal, of 80 characters where there is none.

    Cells are broken between words. A table that is too wide even so is printed row by row, a line per column.
    """
    from rich.console import Console
    from rich.measure import Measurement
    from rich.table import Table
    from rich.text import Text

    table = Table(columns[0], title=title)
    table.columns[0].no_wrap = True
    for name in columns[1:]:
        table.add_column(name)
    for row in rows:
        table.add_row(*map(Text, row))  # brackets in a cell are no markup
    console = Console()
    if Measurement.get(console, console.options.update(max_width=_WIDEST), table).minimum <= console.width:
        console.print(table)
    else:
        print("\n".join(row_by_row(title, columns, rows, console.width)))


def row_by_row(
    title: str, columns: Sequence[str], rows: Sequence[Sequence[str]], width: int
) -> Iterator[str]:  # fmt: skip
    """Yield the lines of a table row by row: the first cell, below it each column with its value."""
    yield title
    longest = min(max(map(len, columns[1:]), default=0), width // 2)
    for row in rows:
        yield ""
        yield from textwrap.wrap(row[0], width) or [""]
        for name, cell in zip(columns[1:], row[1:], strict=True):
            if cell:
                yield from textwrap.wrap(
                    cell, width, initial_indent=f"  {name:{longest}}  ", subsequent_indent=" " * (longest + 4)
                )


def write_csv(path: pathlib.Path, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Comma-separated values with a head line."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


class Cell(str):
    """A cell of a file, with a decimal point where the file has a comma; ``written``: as the file has it."""

    written: str

    def __new__(cls, written: str, comma: bool = False) -> "Cell":
        """Make a cell of a text; ``comma``: whether numbers may have a decimal comma."""
        decimal = comma and _DECIMAL_COMMA.fullmatch(written)
        cell = super().__new__(cls, written.replace(",", ".") if decimal else written)
        cell.written = written
        return cell


def read_rows(path: str | os.PathLike[str]) -> list[tuple[int, list[Cell]]]:
    """Read a CSV file: the cells of every line that holds any, without spaces round them, and its number.

    The first line says whether semicolons, tabs or commas separate the cells. Beside semicolons and tabs
    numbers may have a decimal comma. Lines that begin with # are remarks.

    Parameters
    ----------
    path : path
        Text in UTF-8, with or without byte order mark.

    Returns
    -------
    list of (int, list of Cell)
        A cell in quotes may go on over several lines; the last one counts.

    Raises
    ------
    ValueError
        For a file that is not there, that is no text, or whose lines are no cells.
    """
    try:
        text = read_text(path)
    except FileNotFoundError:
        raise ValueError(f"{path}: {absent(path)}") from None
    except (OSError, UnicodeDecodeError) as problem:
        words = f"cannot be read as text in UTF-8: {why(problem)}"
        raise ValueError(f"{path}: {instead(path, TABLE) or words}") from None
    if mistaken := instead(path, TABLE):
        raise ValueError(f"{path}: {mistaken}")
    # remarks become empty, so that lines keep their numbers and quotes in remarks open no cell
    lines = ["" if line.lstrip().startswith("#") else line for line in io.StringIO(text)]
    first = next((line for line in lines if line.strip()), "")
    separator = next((mark for mark in _SEPARATORS if mark in first), ",")
    reader = csv.reader(lines, delimiter=separator, skipinitialspace=True)
    rows = []
    try:
        for row in reader:
            cells = [Cell(cell.strip(), comma=separator != ",") for cell in row]
            if any(cells):
                rows.append((reader.line_num, cells))
    except csv.Error as problem:
        raise ValueError(f"{path}: line {reader.line_num}: is not a line of a table: {problem}") from None
    return rows
