"""CSV files of inputs over time: columns by name, in SI units or in r/min and degC, points or commas."""

import os
import pathlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.interface.names import known
from fmu_bearing.results.column_units import Title, Unit, unit_of_suffix, unit_of_title
from fmu_bearing.results.result import ResultError
from fmu_bearing.results.rows import read_columns
from fmu_bearing.results.series import structured
from fmu_bearing.scene.units import split_unit, symbol

#: Suffixes of column names by the SI unit of the input: other units than the input's own.
SUFFIXES = {"rad/s": ("_rpm",), "K": ("_degC", "_K"), "N": ("_N",), "N/m": ("_N_m",)}


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
    """A column of a file: its title, the input it gives, and the unit of its values (None: SI)."""

    title: Title
    name: str
    unit: Unit | None = None

    def si(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return values of the column in SI units."""
        return values if self.unit is None else self.unit.to_si(values)

    def shown(self, value: float) -> str:
        """Return a value in SI units as the column would have it."""
        return f"{value if self.unit is None else self.unit.from_si(value):.6g}"


def read_inputs(path: str | os.PathLike[str], inputs: Mapping[str, Bounded]) -> NDArray[Any]:
    """Read a CSV file with ``time`` (s) first and inputs by name behind it, as a table in SI units.

    A name may carry a unit: ``shaft_speed_rpm``, ``oil_temperature_degC``, ``preload [kN]``; units may also
    have a row of their own. Columns are separated by commas, semicolons or tabs; beside semicolons and tabs
    numbers may have a decimal comma. Times may repeat (a jump) but not fall.

    Raises
    ------
    ResultError
        With the line and column of the first value that is refused.
    """
    path = pathlib.Path(path)
    try:
        titles, lines, values = read_columns(path)
    except ValueError as problem:
        raise ResultError(str(problem)) from None
    columns = [Column(titles[0], "time"), *(_column(path, title, inputs) for title in titles[1:])]
    _check_names(path, columns)
    table = {column.name: column.si(values[:, place]) for place, column in enumerate(columns)}
    for place, column in enumerate(columns[1:], start=1):
        low, high, slack = inputs[column.name].limits()
        si = table[column.name]
        wrong = ~((si >= low - slack) & (si <= high + slack))
        if wrong.any():
            row = int(np.argmax(wrong))
            unit = inputs[column.name].unit if column.unit is None else column.unit.shown
            raise ResultError(
                f"{path}: line {lines[row]}, column '{column.title.written}': {values[row, place]:.6g} is "
                f"refused: allowed are {column.shown(low)} to {column.shown(high)} {unit}"
            )
    return structured(table)


def _column(path: pathlib.Path, title: Title, inputs: Mapping[str, Bounded]) -> Column:
    """Return what a column of this title gives."""
    given = unit_of_title(title)
    name, suffix = (str(title), "") if title in inputs else split_unit(title)
    if name in inputs:
        si = inputs[name].unit
        of_name = unit_of_suffix(suffix, si) if suffix else None
        unit = given or of_name
        fits = suffix in ("", *SUFFIXES.get(si, ())) and (unit is None or unit.si == si)
        fits &= bool(given) == bool(title.unit) and (not (given and of_name) or given[:2] == of_name[:2])
        if fits:
            return Column(title, name, None if unit is None or unit[:2] == (1.0, 0.0) else unit)
        others = ", ".join(name + other for other in SUFFIXES.get(si, ()))
        raise ResultError(
            f"{path}: column '{title.written}': {name} is not given in "
            f"{title.unit or symbol(title)}; write {name} ({si})" + (f" or {others}" if others else "")
        )
    try:
        units = [one + ending for one in inputs for ending in SUFFIXES.get(inputs[one].unit, ())]
        known(title, [*inputs, *units], "input")
    except ValueError as problem:
        raise ResultError(f"{path}: column '{title.written}': {problem}") from None
    raise AssertionError(title)


def _check_names(path: pathlib.Path, columns: Sequence[Column]) -> None:
    names = [column.name for column in columns]
    for column in columns:
        if names.count(column.name) > 1:
            raise ResultError(
                f"{path}: column '{column.title.written}': {column.name} is given more than once"
            )
