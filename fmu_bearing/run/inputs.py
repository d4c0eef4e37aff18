"""Inputs of a run over time: numbers, functions of time, tables, CSV files, checked against their ranges."""

import math
import os
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.interface.names import known
from fmu_bearing.results.series import columns_of, structured
from fmu_bearing.run.input_file import read_inputs
from fmu_bearing.scene.problems import described

Signal = float | Callable[[float], float]
Inputs = Mapping[str, Signal] | NDArray[Any] | str | os.PathLike[str]
_SLACK = 1e-12  # of a bound: rounding of a unit conversion, as in `instance.Instance.check`
_EPSILON = 1e-9  # of a step: what rounding may leave between the last point and the stop time


@dataclass(frozen=True)
class Input:
    """Start value, range (None: no bound) and unit of an input."""

    start: float
    min: float | None = None
    max: float | None = None
    unit: str = ""

    def limits(self) -> tuple[float, float, float]:
        """Return the least and the largest value, infinite where there is none, and what rounding may add."""
        low = -math.inf if self.min is None else self.min
        high = math.inf if self.max is None else self.max
        slack = _SLACK * max((abs(bound) for bound in (low, high) if math.isfinite(bound)), default=0.0)
        return low, high, slack

    def check(self, name: str, table: NDArray[Any]) -> None:
        """Raise ``ValueError`` for the first value of a table's column that may not be set."""
        wrong = self._wrong(table[name])
        if wrong.any():
            first = table[int(np.argmax(wrong))]
            raise ValueError(f"input {name} = {first[name]:g} at t = {first['time']:g} s {self._refused()}")

    def check_start(self, name: str, value: float) -> None:
        """Raise ``ValueError`` for a value at the start that may not be set."""
        if self._wrong(np.array(value)):
            raise ValueError(f"{name} = {value:g} {self._refused()}")

    def _wrong(self, values: NDArray[np.float64]) -> NDArray[np.bool_]:
        low, high, slack = self.limits()
        return np.asarray(~(np.isfinite(values) & (values >= low - slack) & (values <= high + slack)))

    def _refused(self) -> str:
        low, high, _ = self.limits()
        return f"is refused: allowed are {low:g} to {high:g} {self.unit}".rstrip()


def input_table(
    inputs: Inputs | None,
    known_inputs: Mapping[str, Input],
    stop_time: float,
    step: float,
    from_start: bool = False,
) -> NDArray[Any] | None:
    """Return inputs as a table over time; None where there are none.

    A table that begins after the run's start or ends before its end is held there, with a warning.
    ``from_start``: shift its times so that the first is 0.

    Raises
    ------
    ValueError
        For an unknown input, a value outside its range, with its time, and a table whose times miss the run.
    """
    if inputs is None:
        return None
    if isinstance(inputs, Mapping):
        times = np.minimum(np.arange(math.ceil(stop_time / step - _EPSILON) + 1) * step, stop_time)
        columns = {"time": times} | {name: _sampled(name, signal, times) for name, signal in inputs.items()}
        table = structured(columns)
    else:
        if not isinstance(inputs, np.ndarray | str | os.PathLike):
            raise ValueError(
                f"inputs are values by name, a table or the path of a CSV file, not {described(inputs)}"
            )
        table = inputs if isinstance(inputs, np.ndarray) else read_inputs(inputs, known_inputs)
        if (table.dtype.names or ("",))[0] != "time":
            raise ValueError("a table of inputs needs 'time' (s) as its first column")
        if from_start and len(table):
            table = structured({name: table[name] for name in table.dtype.names or ()})
            table["time"] -= table["time"][0]
        _check_range(table, inputs, stop_time, step)
    for name in columns_of(table):
        known(name, list(known_inputs), "input")
        known_inputs[name].check(name, table)
    return table if columns_of(table) and len(table) else None


def _check_range(table: NDArray[Any], inputs: Any, stop_time: float, step: float) -> None:
    """Compare the times of a table with those of the run; a single row is a constant, for any time."""
    if len(table) < 2 or not columns_of(table):
        return
    first, last = float(table["time"][0]), float(table["time"][-1])
    where = "inputs" if isinstance(inputs, np.ndarray) else os.fspath(inputs)
    times = f"{where}: times are {first:.10g} to {last:.10g} s, the run takes 0 to {stop_time:g} s"
    shift = "--input-from-start (input_from_start=True) shifts the times so that the first is 0"
    if first >= stop_time or last <= 0.0:
        raise ValueError(f"{times}, so that only one of its rows would count: {shift}")
    notes = []
    if first > _EPSILON * step:
        notes.append(f"the first values are held before {first:g} s: {shift}")
    if last < stop_time - (1.0 + _EPSILON) * step:  # inputs are read at the beginning of each step
        notes.append(f"the last values are held after {last:g} s")
    if notes:
        warnings.warn(f"{times}: {'; '.join(notes)}", stacklevel=4)


def _sampled(name: str, signal: Signal, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of a number or a function of time at ``times``."""
    try:
        return np.array([float(signal(t) if callable(signal) else signal) for t in times])
    except (TypeError, ValueError):
        raise ValueError(
            f"input '{name}' must be a number or a function of time that gives one, not {signal!r}"
        ) from None
