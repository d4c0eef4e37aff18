"""Variables over time: a table with names and units."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.results.variable_names import unit_of
from fmu_bearing.scene import Scene


@dataclass(repr=False)
class Series:
    """Variables over time, SI units; `Run` describes them, and adds how it ended, files and pictures."""

    name: str
    table: NDArray[Any]
    units: dict[str, str] = field(default_factory=dict)
    scene: Scene | None = None

    @property
    def time(self) -> NDArray[np.float64]:
        """Communication points (s), shape (points,)."""
        return np.asarray(self.table["time"], dtype=float)

    @property
    def names(self) -> list[str]:
        """Names of the variables kept."""
        return columns_of(self.table)

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in (self.table.dtype.names or ()):
            raise KeyError(f"'{name}' was not kept; kept: {', '.join(self.names)}")
        return np.asarray(self.table[name], dtype=float)

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.table)

    def _units(self) -> dict[str, str]:
        """Units by name, where the run has none those of our FMUs."""
        return {name: self.units.get(name) or unit_of(name) for name in self.names}

    def _reached(self) -> float:
        return float(self.time[-1]) if len(self) else float("nan")


def columns_of(table: NDArray[Any]) -> list[str]:
    """Return the names of a table's columns but ``time``."""
    return [name for name in table.dtype.names or () if name != "time"]


def structured(columns: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    """Columns of numbers as one structured array."""
    table = np.zeros(len(next(iter(columns.values()))), dtype=[(name, np.float64) for name in columns])
    for name, values in columns.items():
        table[name] = values
    return table
