"""Free numbers: keys of the scene that are identified, their bounds and their scale."""

import fnmatch
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.interface.names import UnknownName, known
from fmu_bearing.scene import Scene
from fmu_bearing.scene.units import symbol
from fmu_bearing.scene.values import fields_of, limits, value_at

_DECADES = 1.0  # to either side of the start, where no bounds are given
_SYNTAX = "KEY or KEY=LOW:HIGH, KEY dotted, * for any text"
Bounds = tuple[float, float] | None
Wanted = Sequence[str] | Mapping[str, Bounds]


@dataclass(frozen=True)
class Free:
    """One free number.

    Attributes
    ----------
    key : str
        As it was asked for; may hold ``*``.
    keys : tuple of str
        Dotted keys it moves. Several keep their ratios: one factor acts on all.
    starts : tuple of float
        Their values in the scene, in the scene's units; the first is the number that is shown.
    low, high : float
        Bounds of the first.
    log : bool
        Whether its logarithm is searched; that is so where the key cannot be negative.
    guessed : bool
        Whether the scene has 0, which has no logarithm, and ``starts`` the middle of the bounds instead.
    """

    key: str
    keys: tuple[str, ...]
    starts: tuple[float, ...]
    low: float
    high: float
    log: bool
    guessed: bool = False

    @property
    def start(self) -> float:
        """Value in the scene."""
        return self.starts[0]

    @property
    def unit(self) -> str:
        """Unit of the key."""
        return symbol(self.keys[0])

    @property
    def scale(self) -> float:
        """One unit of the coordinate: 1 in ln, or the width of the bounds in the key's unit."""
        return 1.0 if self.log else self.high - self.low

    def coordinate(self, value: float) -> float:
        """Coordinate of a value: ln, or parts of the width of the bounds."""
        return math.log(value) if self.log else value / self.scale

    def value(self, coordinate: float) -> float:
        """Value of a coordinate."""
        value = math.exp(coordinate) if self.log else coordinate * self.scale
        return min(max(value, self.low), self.high)  # rounding of the logarithm

    def values(self, coordinate: float) -> dict[str, float]:
        """Values of all its keys."""
        value = self.value(coordinate)
        if len(self.keys) == 1:
            return {self.keys[0]: value}
        return {key: value / self.start * own for key, own in zip(self.keys, self.starts, strict=True)}


def free_numbers(scene: Scene, wanted: Wanted, conditions: Iterable[str] = ()) -> tuple[Free, ...]:
    """Return the free numbers of a scene.

    Parameters
    ----------
    scene : Scene
        Where the search starts.
    wanted : sequence of str, or mapping
        Keys, such as ``"imperfections.unbalance_um"`` or ``"imperfections.*_race_amplitude_um"``, each with
        bounds behind it where the default is not wanted (``"KEY=LOW:HIGH"``); or bounds by key, None for the
        default: a decade to either side of the start, within what the key allows.
    held : iterable of str
        Keys that the data set, which cannot be free.

    Raises
    ------
    IdentifyError
        With a line per key that is refused.
    """
    given = wanted if isinstance(wanted, Mapping) else _parsed(wanted)
    if not given:
        raise IdentifyError(f"no key is free: give {_SYNTAX}, such as --free imperfections.unbalance_um")
    problems, numbers = [], []
    taken: dict[str, str] = {key: "a condition of the data" for key in conditions}
    for key, bounds in given.items():
        try:
            one = _free(scene, key, bounds)
            for each in one.keys:
                if each in taken:
                    raise IdentifyError(f"{each} is {taken[each]} already: it cannot be free under '{key}'")
                taken[each] = f"free under '{key}'"
            numbers.append(one)
        except IdentifyError as problem:
            problems += str(problem).splitlines()
    if problems:
        raise IdentifyError("\n".join(problems))
    return tuple(numbers)


def _parsed(texts: Sequence[str]) -> dict[str, Bounds]:
    if isinstance(texts, str):
        texts = [texts]
    by_key: dict[str, Bounds] = {}
    for text in texts:
        key, equals, rest = (part.strip() for part in text.partition("="))
        if key in by_key:
            raise IdentifyError(f"{key} is free twice: give it once")
        bounds: Bounds = None
        if equals:
            try:
                low, high = (float(part) for part in rest.split(":"))
            except ValueError:
                raise IdentifyError(f"free key '{text}' is refused: write {_SYNTAX}") from None
            bounds = (low, high)
        by_key[key] = bounds
    return by_key


def _free(scene: Scene, key: str, bounds: Bounds) -> Free:
    fields = fields_of(scene)
    if "*" in key:
        matching = [k for k in fields if fnmatch.fnmatchcase(k, key.replace("[", "[[]"))]
        there = {k: value_at(scene, k) for k in matching}
        keys = [k for k, value in there.items() if _is_real(value) and value != 0.0]
        if not keys:
            raise IdentifyError(f"free key '{key}' matches no number of the scene that is not 0")
    else:
        try:
            known(key, list(fields), "key of a scene")
        except UnknownName as problem:
            raise IdentifyError(f"free key: {problem}") from None
        keys = [key]
    starts = [value_at(scene, k) for k in keys]
    for k, start in zip(keys, starts, strict=True):
        if not _is_real(start):
            shown = "not set in the scene" if start is None else f"{start!r}, which is not a real number"
            same = [f for f in fields if f.endswith(k[k.rfind(".") :]) and _is_real(value_at(scene, f))]
            instead = f"; it has {' and '.join(same)}" if start is None and same else ""
            raise IdentifyError(
                f"free key {k} is {shown}: only numbers that the scene has can be identified{instead}"
            )
    low, high = limits(fields[keys[0]])
    log = low >= 0.0
    if len(keys) > 1 and (not log or min(starts) <= 0.0):
        raise IdentifyError(
            f"free key '{key}' matches values that are not all positive: give them one by one"
        )
    return _bounded(key, tuple(keys), tuple(map(float, starts)), (low, high), bounds, log)


def _bounded(
    key: str, keys: tuple[str, ...], starts: tuple[float, ...], allowed: tuple[float, float], bounds: Bounds,
    log: bool,
) -> Free:  # fmt: skip
    start = starts[0]
    if bounds is None:
        if log and start == 0.0:
            raise IdentifyError(f"free key {key} starts at 0: give bounds above 0, {key}=LOW:HIGH")
        if log:
            factor = 10.0**_DECADES
            low, high = max(start / factor, allowed[0]), min(start * factor, allowed[1])
        else:
            low, high = allowed
    else:
        low, high = bounds
    if not (math.isfinite(low) and math.isfinite(high)):
        raise IdentifyError(f"free key {key} has no natural bounds: give {key}=LOW:HIGH")
    if not low < high:
        raise IdentifyError(f"free key {key}={low:g}:{high:g}: the lower bound must be below the upper one")
    if low < allowed[0] or high > allowed[1]:
        raise IdentifyError(
            f"free key {key}={low:g}:{high:g} reaches outside {allowed[0]:g} to {allowed[1]:g}, which the "
            "scene allows"
        )
    if log and low <= 0.0:
        raise IdentifyError(f"free key {key}={low:g}:{high:g}: a logarithmic key needs bounds above 0")
    guessed = log and start == 0.0
    if not low <= start <= high:
        if guessed:
            starts = (math.sqrt(low * high), *starts[1:])  # the middle: the scene has none
        else:
            raise IdentifyError(f"free key {key}={low:g}:{high:g} leaves out its start {start:g}")
    return Free(key, keys, starts, float(low), float(high), log, guessed)


def _is_real(value: Any) -> bool:
    return isinstance(value, float)


def start_point(free: Sequence[Free]) -> NDArray[np.float64]:
    """Coordinates of the scene."""
    return np.array([one.coordinate(one.start) for one in free])


def box(free: Sequence[Free]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lower and upper bounds of the coordinates."""
    return (
        np.array([one.coordinate(one.low) for one in free]),
        np.array([one.coordinate(one.high) for one in free]),
    )


def scene_values(free: Sequence[Free], x: NDArray[np.float64]) -> dict[str, float]:
    """Values of all keys at coordinates."""
    return {key: value for one, at in zip(free, x, strict=True) for key, value in one.values(at).items()}
