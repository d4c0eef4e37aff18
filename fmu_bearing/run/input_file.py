"""CSV files of inputs over time: columns by name, in SI units or in r/min and degC, points or commas."""

import math
import os
import pathlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.interface.names import known
from fmu_bearing.results.result import ResultError
from fmu_bearing.results.series import structured
from fmu_bearing.results.table import Cell, read_rows
from fmu_bearing.scene.units import UNITS, convert, split_unit, symbol

#: Suffixes of column names by the SI unit of the input: other units than the input's own.
SUFFIXES = {
    "rad/s": ("_rpm",),
    "K": ("_degC", "_K"),
    "N": ("_N",),
    "N/m": ("_N_m",),
}
_TIMES = ("time", "time_s")


class Bounded(Protocol):
    """An input with a range and a unit."""

    @property
    def unit(self) -> str:
        """SI unit."""
        ...

    def limits(self) -> tuple[float, float, float]:
        """Return the least and the largest value, infinite where there is none, and what rounding may add."""
        ...


@dataclass(frozen=True)
class Column:
    """A column of a file: its name there, the input it gives, and the suffix of its unit (empty: SI)."""

    title: str
    name: str
    suffix: str = ""

    def si(self, value: float) -> float:
        """Return a value of the column in SI units."""
        return convert(value, self.suffix) if self.suffix else value

    def shown(self, value: float) -> str:
        """Return a value in SI units as the column would have it."""
        factor, offset = UNITS[self.suffix] if self.suffix else (1.0, 0.0)
        return f"{(value - offset) / factor:.6g}"


def read_inputs(path: str | os.PathLike[str], inputs: Mapping[str, Bounded]) -> NDArray[Any]:
    """Read a CSV file with ``time`` (s) first and inputs by name behind it, as a table in SI units.

    A name may carry a unit: ``shaft_speed_rpm``, ``oil_temperature_degC``. Columns are separated by commas,
    semicolons or tabs; beside semicolons and tabs numbers may have a decimal comma. Times may repeat (a
    jump) but not fall.

    Raises
    ------
    ResultError
        With the line and column of the first value that is refused.
    """
    path = pathlib.Path(path)
    rows = _rows(path)
    number, titles = rows[0]
    columns = [_column(path, title, inputs, first=k == 0) for k, title in enumerate(titles)]
    _check_names(path, columns)
    table = np.empty((len(rows) - 1, len(columns)))
    for place, (number, cells) in enumerate(rows[1:]):
        if len(cells) != len(columns):
            raise ResultError(
                f"{path}: line {number} has {len(cells)} values for {len(columns)} columns; with decimal "
                "commas separate the columns by semicolons"
            )
        for k, (cell, column) in enumerate(zip(cells, columns, strict=True)):
            table[place, k] = _value(path, number, cell, column, inputs.get(column.name))
        if place and table[place, 0] < table[place - 1, 0]:
            raise ResultError(
                f"{path}: line {number}: time falls from {table[place - 1, 0]:g} to {table[place, 0]:g} s; "
                "it must rise, or repeat where values jump"
            )
    return structured({column.name: table[:, k] for k, column in enumerate(columns)})


def _rows(path: pathlib.Path) -> list[tuple[int, list[Cell]]]:
    """Return the line of names and at least one of values."""
    try:
        rows = read_rows(path)
    except ValueError as problem:
        raise ResultError(str(problem)) from None
    if len(rows) < 2:
        raise ResultError(f"{path}: holds no values: write a line of names, such as time,shaft_speed_rpm")
    return rows


def _column(path: pathlib.Path, title: str, inputs: Mapping[str, Bounded], first: bool) -> Column:
    """Return what a column of this title gives."""
    if first:
        if title not in _TIMES:
            raise ResultError(f"{path}: the first column must be 'time' (s), not '{title}'")
        return Column(title, "time")
    if title in inputs:
        return Column(title, title)
    name, suffix = split_unit(title)
    if name in inputs and suffix:
        unit = inputs[name].unit
        if suffix not in SUFFIXES.get(unit, ()):
            others = ", ".join(name + other for other in SUFFIXES.get(unit, ()))
            raise ResultError(
                f"{path}: column '{title}': {name} is not given in {symbol(title)}; write {name} ({unit})"
                + (f" or {others}" if others else "")
            )
        return Column(title, name, suffix)
    try:
        units = [one + ending for one in inputs for ending in SUFFIXES.get(inputs[one].unit, ())]
        known(title, [*inputs, *units], "input")
    except ValueError as problem:
        raise ResultError(f"{path}: column '{title}': {problem}") from None
    raise AssertionError(title)


def _check_names(path: pathlib.Path, columns: Sequence[Column]) -> None:
    names = [column.name for column in columns]
    for column in columns:
        if names.count(column.name) > 1:
            raise ResultError(f"{path}: column '{column.title}': {column.name} is given more than once")


def _value(path: pathlib.Path, line: int, cell: Cell, column: Column, bounds: Bounded | None) -> float:
    """Return a cell's value in SI units."""
    where = f"{path}: line {line}, column '{column.title}'"
    try:
        given = float(cell)
    except ValueError:
        given = math.nan
    if not math.isfinite(given):
        raise ResultError(f"{where}: '{cell.written}' is not a finite number")
    value = column.si(given)
    if bounds is None:
        return value
    low, high, slack = bounds.limits()
    if not low - slack <= value <= high + slack:
        unit = symbol(column.title) if column.suffix else bounds.unit
        raise ResultError(
            f"{where}: {cell.written} is refused: "
            f"allowed are {column.shown(low)} to {column.shown(high)} {unit}"
        )
    return value
