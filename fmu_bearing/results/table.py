"""Tables of results for terminal, Markdown and CSV; description of the machine."""

import csv
import html
import io
import math
import os
import pathlib
import platform
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import numba
import numpy as np

from fmu_bearing import __version__
from fmu_bearing.engine.sources import source_hash
from fmu_bearing.files import write_whole

if TYPE_CHECKING:
    from rich.console import Console


#: Columns and rows of texts.
Table = tuple[list[str], list[list[str]]]


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


def number(value: float | None) -> str:
    """Two or three digits, empty for NaN and for None."""
    if value is None or math.isnan(value):
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


def html_table(caption: str, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table for notebooks."""
    lines = [("th", columns), *(("td", row) for row in rows)]
    cells = ("".join(f"<{tag}>{html.escape(text)}</{tag}>" for text in line) for tag, line in lines)
    body = "".join(f"<tr>{row}</tr>" for row in cells)
    return f"<table><caption>{html.escape(caption)}</caption>{body}</table>"


def terminal() -> "Console":
    """Return what prints on the terminal, and ends as all else does where its reader has read enough."""
    from rich.console import Console

    class Terminal(Console):
        def on_broken_pipe(self) -> None:
            raise BrokenPipeError

    return Terminal()


def show(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print one table within the width of the terminal, of 80 characters where there is none.

    Heads and cells are broken between words. A table that is too wide even so is printed row by row, a line
    per column.
    """
    from rich.table import Table
    from rich.text import Text

    console = terminal()
    widths = _widths(columns, rows, console.width - 3 * len(columns) - 1)  # a frame and two spaces each
    if widths is None:
        # an empty line, because what follows is no part of the last row
        print("\n".join([*row_by_row(title, columns, rows, console.width), ""]))
        return
    table = Table(title=title)
    for k, (name, width) in enumerate(zip(columns, widths, strict=True)):
        table.add_column(name, width=width, no_wrap=k == 0)
    for row in rows:
        table.add_row(*map(Text, row))  # brackets in a cell are no markup
    console.print(table)


def _widths(columns: Sequence[str], rows: Sequence[Sequence[str]], room: int) -> list[int] | None:
    """Return a width (characters) per column, no more than ``room`` together; None where words do not fit.

    The first column is not broken. Rich alone cuts words of some columns to leave others more.
    """
    from rich.cells import cell_len

    texts = [[name, *(row[k] for row in rows)] for k, name in enumerate(columns)]
    whole = [max(map(cell_len, text)) for text in texts]
    least = [max(cell_len(word) for text in own for word in [*text.split(), ""]) for own in texts]
    least[0] = whole[0]
    if sum(least) > room:
        return None
    widths = least
    for limit in range(max(whole) + 1):  # the widest columns give way first
        wider = [max(low, min(own, limit)) for low, own in zip(least, whole, strict=True)]
        if sum(wider) > room:
            break
        widths = wider
    spare = room - sum(widths)
    lacking = [k for k, width in enumerate(widths) if width < whole[k]]
    return [width + (k in lacking[:spare]) for k, width in enumerate(widths)]


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


def write_csv(path: pathlib.Path, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> pathlib.Path:
    """Write comma-separated values with a head line, all of the file or none, and return the file."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return write_whole(path, text.getvalue().encode())
