"""Comparison of a run with a reference: tolerances by unit, time grids that may differ, readable reports.

Allowed is ``atol + rtol * (largest magnitude in the reference's column)``. The relative part is scaled by the
column's magnitude and not by each value, because oscillating values pass through zero.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.results.result import Run
from fmu_bearing.results.variable_names import unit_of

Tolerance = float | Mapping[str, float]

#: Relative tolerance where none is given. The same FMU gives the same bits on the same machine; another C
#: library or instruction set changes the last ones. Measured on the 7003C in its spindle: the last bit of the
#: preload moves torque and velocities by at most 7e-9 of their largest in 30 ms at 20,000 r/min.
RTOL = 1e-5
#: Absolute tolerance by unit where none is given. Levels are logarithms, so ratios do not suit them; a
#: temperature is always about 300 K.
ATOL = {"dB": 0.01, "K": 0.01}
_NOT_RELATIVE = ("dB", "K")
_SAME_TIME = 1e-9  # s, or of the last time where that is larger


@dataclass(frozen=True)
class Departure:
    """A variable that departs from its reference.

    Attributes
    ----------
    name, unit : str
    time : float
        Of the first point beyond the tolerance (s).
    value, expected : float
        There.
    allowed : float
        Tolerance, in the variable's unit.
    worst_time, worst : float
        Time and size of the largest departure.
    points, of : int
        How many points are beyond the tolerance.
    """

    name: str
    unit: str
    time: float
    value: float
    expected: float
    allowed: float
    worst_time: float
    worst: float
    points: int
    of: int

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        off = abs(self.value - self.expected)
        return (
            f"{self.name}: first at t = {self.time:.6g} s: "
            f"{self.value:.9g} instead of {self.expected:.9g}{unit}, "
            f"off by {off:.3g}, allowed {self.allowed:.3g}; "
            f"most at {self.worst_time:.6g} s, by {self.worst:.3g}; {self.points} of {self.of} points"
        )


def compare(
    run: Run, reference: Run, rtol: Tolerance | None = None, atol: Tolerance | None = None
) -> list[Departure]:
    """Compare a run with a reference at the reference's times.

    Parameters
    ----------
    run : Run
        May hold more variables and other times: values in between are taken linearly.
    reference : Run
    rtol, atol : float or mapping, optional
        One number for all, or numbers by name of the variable or by unit
        (``{"N": 1e-4, "mic[1].leq": 0.5}``); a name goes before a unit, and ``""`` is the unit of plain
        numbers. Others keep `RTOL` and `ATOL`.

    Returns
    -------
    list of Departure
        Variables beyond the tolerance, by time of the first point.

    Raises
    ------
    ValueError
        When the run lacks a variable of the reference or ends before it.

    Examples
    --------
    >>> import numpy as np
    >>> from fmu_bearing.results.result import Run
    >>> from fmu_bearing.results.series import structured
    >>> time = np.array([0.0, 1.0, 2.0])
    >>> wanted = Run("a", structured({"time": time, "x": np.array([0.0, 1.0, 2.0])}))
    >>> found = Run("b", structured({"time": time, "x": np.array([0.0, 1.0, 2.5])}))
    >>> print(compare(found, wanted)[0])
    x: first at t = 2 s: 2.5 instead of 2, off by 0.5, allowed 2e-05; most at 2 s, by 0.5; 1 of 3 points
    """
    missing = [name for name in reference.names if name not in run.names]
    if missing:
        raise ValueError(
            f"the run lacks {', '.join(missing)}, which the reference holds; it holds {', '.join(run.names)}"
        )
    begin, end = float(reference.time[0]), float(reference.time[-1])
    slack = _SAME_TIME * max(1.0, abs(end))
    if run.time[0] > begin + slack or run.time[-1] < end - slack:
        raise ValueError(
            f"the run goes from {run.time[0]:g} to {run.time[-1]:g} s, the reference from {begin:g} to "
            f"{end:g} s: let it cover the reference"
        )
    differences = []
    for name in reference.names:
        unit = run.units.get(name) or reference.units.get(name) or unit_of(name)
        wanted = reference[name]
        allowed = _chosen(atol, name, unit, ATOL.get(unit, 0.0)) + _chosen(
            rtol, name, unit, 0.0 if unit in _NOT_RELATIVE else RTOL
        ) * float(np.max(np.abs(wanted)))
        departure = _departure(name, unit, reference.time, _at(run, name, reference.time), wanted, allowed)
        if departure is not None:
            differences.append(departure)
    return sorted(differences, key=lambda departure: departure.time)


def _chosen(given: Tolerance | None, name: str, unit: str, default: float) -> float:
    if given is None:
        return default
    if isinstance(given, Mapping):
        return float(given.get(name, given.get(unit, default)))
    return float(given)


def _at(run: Run, name: str, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of a run at other times; as they are where the times are the same."""
    if same_times(run.time, times):
        return run[name]
    return np.interp(times, run.time, run[name])


def same_times(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    """Return whether two runs have the same points, but for rounding."""
    slack = _SAME_TIME * max(1.0, abs(float(other[-1])))
    return len(one) == len(other) and bool(np.max(np.abs(one - other)) <= slack)


def _departure(
    name: str, unit: str, time: NDArray[np.float64], values: NDArray[np.float64],
    wanted: NDArray[np.float64], allowed: float,
) -> Departure | None:  # fmt: skip
    off = np.abs(values - wanted)
    beyond = ~(off <= allowed)  # what is not a number is beyond
    if not beyond.any():
        return None
    first = int(np.argmax(beyond))
    worst = int(np.argmax(np.where(np.isfinite(off), off, np.inf)))
    return Departure(
        name, unit, float(time[first]), float(values[first]), float(wanted[first]), allowed,
        float(time[worst]), float(off[worst]), int(beyond.sum()), len(time),
    )  # fmt: skip


def report(run: Run, reference: Run, source: str, departures: list[Departure]) -> str:
    """Describe how a run departs from a reference; empty where it does not."""
    if not departures:
        return ""
    grid = "" if same_times(run.time, reference.time) else ", the run's values interpolated to them"
    head = (
        f"{run.name} departs from {source} in {len(departures)} of {len(reference.names)} variables "
        f"({len(reference)} points to {reference.time[-1]:g} s{grid}):"
    )
    return "\n".join([head, *(f"  {departure}" for departure in departures)])
