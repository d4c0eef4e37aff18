"""Values readable from a paper: where each is printed, what it is used for, and how far ours lie from it.

A value that the paper gives only as a difference and a percentage of it, both rounded, is an interval; its
residual is the distance to that interval. Each value is either *fitted* (numbers of the scene are identified
from it) or *checked* (nothing is); the files under ``data`` say which.
"""

import csv
import math
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal

import numpy as np

DATA = pathlib.Path(__file__).parent / "data"
FIT, CHECK = "fit", "check"


@dataclass(frozen=True)
class Interval:
    """Closed interval that a value lies in; of one point where the paper prints the value itself.

    Where the paper's figures leave only a lower bound, ``high`` is infinite and the bound is the middle.
    """

    low: float
    high: float

    @property
    def middle(self) -> float:
        """Its midpoint."""
        return 0.5 * (self.low + self.high) if math.isfinite(self.high) else self.low

    def distance(self, value: float) -> float:
        """Return how far ``value`` lies above (positive) or below it; 0 inside."""
        return max(value - self.high, 0.0) - max(self.low - value, 0.0)


def recovered(difference: str, percent: str) -> Interval:
    """Interval of a value of which the paper prints a difference and that difference in per cent of it.

    Parameters
    ----------
    difference, percent : str
        As printed: the number of decimals says how they were rounded (half a unit of the last one each way).

    Raises
    ------
    ValueError
        Where the percentage may be zero, so that the value has no upper bound.

    Examples
    --------
    >>> found = recovered("0.24", "0.28")
    >>> round(found.low, 1), round(found.high, 1)
    (82.5, 89.1)
    """
    (d_low, d_high), (q_low, q_high) = _rounded(difference), _rounded(percent)
    if d_low < 0.0 or q_low <= 0.0:
        raise ValueError(f"{difference} of {percent} %: too coarsely rounded to recover a value from")
    return Interval(100.0 * d_low / q_high, 100.0 * d_high / q_low)


def _rounded(printed: str) -> tuple[float, float]:
    """Return the range of numbers that are printed so."""
    number = Decimal(printed)
    exponent = number.as_tuple().exponent
    if not isinstance(exponent, int):
        raise ValueError(f"{printed} is no number")
    half = Decimal(1).scaleb(exponent) / 2
    return float(number - half), float(number + half)


@dataclass(frozen=True)
class Value:
    """One value of a paper.

    Attributes
    ----------
    name : str
        What it is, in words; unique within the paper.
    role : str
        ``fit`` or ``check``.
    group : str
        Values of one group are averaged together: ``measured``, ``calculated`` and the like.
    quantity, place : str
        What is read from our runs, and where; each page knows its own.
    rpm : float
    paper : Interval
    source : str
        Figure, table or derivation.
    without : str
        Why it stays out of every average; empty for all others.
    marked : str
        What else is in it by the paper's own words: averages and slopes are given with and without it.
    """

    name: str
    role: str
    group: str
    quantity: str
    place: str
    rpm: float
    paper: Interval
    source: str
    without: str = ""
    marked: str = ""


@dataclass(frozen=True)
class Met:
    """A value of a paper and ours.

    Attributes
    ----------
    value : Value
    ours : mapping of int to tuple of float
        By seed: one number for each speed around the value's own.
    """

    value: Value
    ours: Mapping[int, tuple[float, ...]]

    @property
    def level(self) -> float:
        """Median of ours over speeds and seeds (of dB values as they are)."""
        return float(np.median(np.concatenate(list(self.ours.values()))))

    @property
    def by_seed(self) -> tuple[float, ...]:
        """Median over the speeds for each seed."""
        return tuple(float(np.median(numbers)) for _, numbers in sorted(self.ours.items()))

    @property
    def residual(self) -> float:
        """Distance of the median from the paper's interval."""
        return self.value.paper.distance(self.level)

    @property
    def from_middle(self) -> float:
        """Difference of the median from the middle of the paper's interval."""
        return self.level - self.value.paper.middle


def read(name: str) -> tuple[Value, ...]:
    """Return the values of one paper from ``data/NAME.csv``.

    A row gives either ``value`` or ``difference`` and ``percent``, as printed; ``>80`` is a lower bound that
    the paper's figures leave. With ``above`` the value is the one calculated there, which lies the same
    difference above the measured one that the percentage is of.

    Raises
    ------
    ValueError
        Naming the row that gives both or neither, has an unknown role, or repeats a name.
    """
    found: list[Value] = []
    with (DATA / f"{name}.csv").open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            what = row["name"]
            if bool(row["value"]) == bool(row["difference"]) or bool(row["difference"]) != bool(
                row["percent"]
            ):
                raise ValueError(f"{name}, {what}: give value, or difference and percent")
            if row["role"] not in (FIT, CHECK):
                raise ValueError(f"{name}, {what}: role is {FIT} or {CHECK}, not {row['role']!r}")
            if what in {one.name for one in found}:
                raise ValueError(f"{name}: two values are called {what}")
            paper = _given(row["value"]) if row["value"] else recovered(row["difference"], row["percent"])
            derived = f"{row['difference']} dB are {row['percent']} %" if row["difference"] else ""
            if row["above"]:
                more = float(row["difference"])
                paper = Interval(paper.low + more, paper.high + more)
                derived = f"{row['difference']} dB above what is measured, which are {row['percent']} %"
            source = ": ".join(text for text in (row["source"], derived) if text)
            found.append(
                Value(
                    what, row["role"], row["group"], row["quantity"], row["place"], float(row["rpm"]),
                    paper, source, row["without"], row["marked"],
                )
            )  # fmt: skip
    return tuple(found)


def _given(text: str) -> Interval:
    """Interval of a value as a table has it: one number, or a lower bound after ``>``."""
    number = float(text.removeprefix(">"))
    return Interval(number, math.inf if text.startswith(">") else number)


def met(values: Iterable[Value], ours: Iterable[tuple[int, Mapping[str, float]]]) -> list[Met]:
    """Join values with ours.

    Parameters
    ----------
    values : iterable of Value
        Those that no run has are left out.
    ours : iterable of (seed, mapping)
        One mapping for each run: ours by name, of the values at the run's speed.
    """
    found: dict[str, dict[int, tuple[float, ...]]] = {}
    for seed, numbers in ours:
        for name, number in numbers.items():
            by_seed = found.setdefault(name, {})
            by_seed[seed] = (*by_seed.get(seed, ()), number)
    return [Met(value, found[value.name]) for value in values if value.name in found]


def rms(found: Iterable[Met], *, middle: bool = False) -> float:
    """Root mean square of residuals (of differences from the middles with ``middle``); NaN of none.

    Values that stay out of averages (`Value.without`) are not counted.
    """
    return _rms(one.from_middle if middle else one.residual for one in found if not one.value.without)


def rms_by_seed(found: Sequence[Met]) -> tuple[float, ...]:
    """Root mean square of residuals for each seed alone, of seeds that all values were run with."""
    rest = [one for one in found if not one.value.without]
    seeds = sorted(set.intersection(*(set(one.ours) for one in rest))) if rest else []
    return tuple(_rms(one.value.paper.distance(float(np.median(one.ours[s]))) for one in rest) for s in seeds)


def _rms(numbers: Iterable[float]) -> float:
    squares = [number * number for number in numbers]
    return math.sqrt(math.fsum(squares) / len(squares)) if squares else math.nan


def slope(speeds: Sequence[float], levels: Sequence[float]) -> float:
    """Slope (dB per decade of speed) of the straight line through levels over log speed, least squares."""
    return float(np.polyfit(np.log10(speeds), levels, 1)[0])
