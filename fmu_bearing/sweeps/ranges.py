"""Ranges of a study of sensitivity: a dotted key of the scene, and the values between which it may lie."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.scene import Scene
from fmu_bearing.scene.values import value_at
from fmu_bearing.sweeps.axes import Axis, SweepError, axes_of, key_of

SYNTAX = "KEY=LOW..HIGH or KEY=LOW..HIGHlog"
_RANGE = re.compile(r"(.+?)\.\.(.+?)(log)?")


@dataclass(frozen=True)
class Range:
    """One varied key; all values between its ends are equally likely.

    Attributes
    ----------
    axis : Axis
        The key with its unit and meaning; its values are the two ends.
    log : bool
        Whether the logarithms are equally likely in place of the values.
    whole : bool
        Whether the key takes whole numbers, of which each is equally likely.
    """

    axis: Axis
    log: bool = False
    whole: bool = False

    @property
    def key(self) -> str:
        """Dotted key of the scene."""
        return self.axis.key

    def at(self, shares: NDArray[np.float64]) -> list[float]:
        """Return the values at shares of the range, 0 to 1, in the key's unit."""
        low, high = self.axis.values
        if self.whole:
            values = np.minimum(np.floor(low + shares * (high - low + 1)), high)
            return [int(value) for value in values]
        values = low * (high / low) ** shares if self.log else low + shares * (high - low)
        return [float(value) for value in np.clip(values, low, high)]

    def words(self) -> str:
        """Return key, ends and unit in words."""
        low, high = self.axis.values
        steps = ", by its logarithm" if self.log else ""
        return f"{self.key} {low:g} to {high:g} {self.axis.unit}".rstrip() + steps


def parse_range(text: str) -> tuple[str, str]:
    """Return key and ends of a range as the command line takes it: ``speed=8000..20000``.

    Raises
    ------
    SweepError
        For text that is not a range.
    """
    key, equals, ends = (part.strip() for part in text.partition("="))
    if not (key and equals and ends):
        raise SweepError(f"range '{text}' is refused: write {SYNTAX}")
    return key, ends


def ranges_of(scene: Scene, wanted: Mapping[str, Sequence[float] | str]) -> tuple[Range, ...]:
    """Return the ranges of a study of a scene.

    Parameters
    ----------
    wanted : mapping
        By dotted key or short name as of an axis: two ends, or text such as ``"8000..20000"`` and
        ``"1e7..1e8log"``.

    Raises
    ------
    SweepError
        With a line for each range that is refused, or where there are fewer than two.
    """
    if len(wanted) < 2:
        raise SweepError(f"give two ranges or more ({SYNTAX}); one value alone is varied by a sweep")
    problems: list[str] = []
    ends: dict[str, list[float]] = {}
    logs: dict[str, bool] = {}
    for given, asked in wanted.items():
        key = key_of(scene, given)
        present = value_at(scene, key)
        try:
            if key in ends:
                raise SweepError(f"range {key} is given twice")
            if isinstance(present, bool | str | tuple):
                raise SweepError(f"range {key} is refused: it is {present!r}, and numbers alone have a range")
            low, high, log = _ends(given, asked)
        except SweepError as problem:
            problems.append(str(problem))
            continue
        ends[key], logs[key] = [low, high], log
    if problems:
        raise SweepError("\n".join(problems))
    ranges = []
    for axis in axes_of(scene, ends):
        whole = all(isinstance(value, int) for value in axis.values)
        if isinstance(value_at(scene, axis.key), int) and not whole:
            raise SweepError(f"range {axis.key} is refused: its ends are whole numbers")
        if whole and logs[axis.key]:
            raise SweepError(f"range {axis.key} is refused: whole numbers have no logarithmic range")
        ranges.append(Range(axis, logs[axis.key], whole))
    return tuple(ranges)


def _ends(key: str, asked: Sequence[float] | str) -> tuple[float, float, bool]:
    """Return the ends of a range, and whether it is logarithmic."""
    log, pair = False, asked
    if isinstance(asked, str):
        match = _RANGE.fullmatch(asked.strip())
        if match is None:
            raise SweepError(f"range {key} = '{asked}' is refused: write {SYNTAX}")
        pair, log = (match[1], match[2]), match[3] is not None  # type: ignore[assignment]
    try:
        low, high = (float(end) for end in pair)
    except (TypeError, ValueError):
        raise SweepError(f"range {key} = {asked!r} is refused: give two numbers, {SYNTAX}") from None
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise SweepError(f"range {key} = {asked!r} is refused: give finite ends, the lower one first")
    if log and low <= 0.0:
        raise SweepError(f"range {key} = {asked!r} is refused: a logarithmic range lies above 0")
    return low, high, log
