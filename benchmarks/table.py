"""Rows of the main table."""

import math
from dataclasses import dataclass, field

from fmu_bearing.results.table import number

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
    limit: float = 1e-3  # error that the goal allows; infinite where the fidelity is an approximation
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
            for word, bad in (("speed", self.cpu < self.goal), ("error", not self.error <= self.limit))
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


def fill_ratios(rows: list[Row]) -> None:
    """Give our rows their speed over each peer's in the same case, by CPU time: the machine may be shared."""
    speed = {(row.case, row.solver): row.cpu for row in rows if not row.ours}
    for row in rows:
        if row.ours:
            for column, peer in PEERS.items():
                row.ratios[column] = row.cpu / speed.get((row.case, peer), math.nan)
