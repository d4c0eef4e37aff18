"""Tables of results for terminal, Markdown and CSV; description of the machine."""

import csv
import math
import os
import pathlib
import platform
from collections.abc import Sequence

import numba
import numpy as np


def machine() -> str:
    """Processor, cores and the versions that matter for speed."""
    model = platform.processor() or platform.machine()
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    if cpuinfo.exists():
        names = [line for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        model = names[0].split(":", 1)[1].strip() if names else model
    return (
        f"{model}, {os.cpu_count()} cores (one used), {platform.system()}; "
        f"Python {platform.python_version()}, NumPy {np.__version__}, Numba {numba.__version__}"
    )


def number(value: float) -> str:
    """Two or three digits, empty for NaN."""
    if math.isnan(value):
        return ""
    if value == 0.0 or 0.01 <= abs(value) < 1e4:
        return f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"
    return f"{value:.1e}"


def markdown(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Pipe table."""
    lines = ["| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def show(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]], width: int = 190) -> None:
    """Print one table to the terminal, at least ``width`` characters wide."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(columns[0], title=title)
    table.columns[0].no_wrap = True
    for name in columns[1:]:
        table.add_column(name)
    for row in rows:
        table.add_row(*map(Text, row))  # brackets in a cell are no markup
    console = Console()
    Console(width=max(console.width, width)).print(table)


def write_csv(path: pathlib.Path, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Comma-separated values with a head line."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)
