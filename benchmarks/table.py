"""Rows, and where they go: terminal, Markdown, CSV."""

import csv
import math
import pathlib
from dataclasses import dataclass, field

COLUMNS = (
    "case", "solver", "setting", "error", "sim/wall", "sim/CPU", "goal", "verdict",
    "x EXUDYN", "x Radau", "x LSODA", "x BDF", "x CVODE", "remark",
)  # fmt: skip
PEERS = {f"x {name}": name for name in ("EXUDYN", "Radau", "LSODA", "BDF", "CVODE")}


@dataclass
class Row:
    """One line of the main table. NaN: not measured; ``error`` is relative; speeds are simulated s per s."""

    case: str
    solver: str
    setting: str = ""
    error: float = math.nan
    wall: float = math.nan
    cpu: float = math.nan
    goal: float = 0.0
    limit: float = 1e-3  # error that the goal allows; infinite where the level is an approximation
    remark: str = ""
    ours: bool = True
    ratios: dict[str, float] = field(default_factory=dict)

    @property
    def verdict(self) -> str:
        """``met`` or what was missed; empty without a goal or a measurement."""
        if not self.goal or math.isnan(self.wall):
            return ""
        missed = [
            word
            for word, bad in (("speed", self.wall < self.goal), ("error", not self.error <= self.limit))
            if bad
        ]
        return "missed: " + ", ".join(missed) if missed else "met"

    def cells(self) -> list[str]:
        """Texts in the order of ``COLUMNS``."""
        goal = f"{self.goal:g}" if self.goal else ""
        return [
            self.case, self.solver, self.setting, number(self.error), number(self.wall), number(self.cpu),
            goal, self.verdict, *(number(self.ratios.get(column, math.nan)) for column in PEERS), self.remark,
        ]  # fmt: skip


def number(value: float) -> str:
    """Two or three digits, empty for NaN."""
    if math.isnan(value):
        return ""
    if value == 0.0 or 0.01 <= abs(value) < 1e4:
        return f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"
    return f"{value:.1e}"


def fill_ratios(rows: list[Row]) -> None:
    """Give our rows their speed over each peer's in the same case, by CPU time: the machine may be shared."""
    speed = {(row.case, row.solver): row.cpu for row in rows if not row.ours}
    for row in rows:
        if row.ours:
            for column, peer in PEERS.items():
                row.ratios[column] = row.cpu / speed.get((row.case, peer), math.nan)


def markdown(columns: tuple[str, ...], rows: list[list[str]]) -> str:
    """Pipe table."""
    lines = ["| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def show(title: str, columns: tuple[str, ...], rows: list[list[str]]) -> None:
    """Print one table to the terminal."""
    from rich.console import Console
    from rich.table import Table

    table = Table(columns[0], title=title)
    table.columns[0].no_wrap = True
    for name in columns[1:]:
        table.add_column(name)
    for row in rows:
        table.add_row(*row)
    console = Console()
    Console(width=max(console.width, 190)).print(table)


def write_csv(path: pathlib.Path, columns: tuple[str, ...], rows: list[list[str]]) -> None:
    """Comma-separated values with a head line."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)
