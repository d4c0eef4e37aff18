"""The scenes of a data set: values of each class by Latin hypercube, sizes of defects from a few."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic.fields import FieldInfo

from fmu_bearing.dataset.plan import Class, Draw, Plan
from fmu_bearing.interface.names import UnknownName, known
from fmu_bearing.scene import Scene
from fmu_bearing.scene.units import symbol
from fmu_bearing.scene.values import fields_of
from fmu_bearing.sweeps.axes import Axis, SweepError, key_of
from fmu_bearing.sweeps.ranges import Range

DEFECTS = "imperfections.defect"
#: Keys of a defect that say where it is; all others shape it, and with it the table of its contact.
_PLACES = ("angle_deg", "ball", "tilt_deg", "bearing")
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_RANGE = re.compile(rf"\s*({_NUMBER})\s*:\s*({_NUMBER})\s*(log)?\s*")


@dataclass(frozen=True)
class Choice:
    """One key that takes some values, all equally likely; a single one: it is fixed."""

    key: str
    values: tuple[Any, ...]

    def at(self, shares: NDArray[np.float64]) -> list[Any]:
        """Return the values at shares, 0 to 1."""
        places = np.minimum((shares * len(self.values)).astype(int), len(self.values) - 1)
        return [self.values[place] for place in places]

    def words(self) -> str:
        """Return key and values in words."""
        return f"{self.key} {', '.join(str(value) for value in self.values)} {symbol(self.key)}".rstrip()


@dataclass(frozen=True)
class Drawn:
    """The values of one run.

    Attributes
    ----------
    label : str
        Name of its class.
    values : dict
        By dotted key of the scene; ``imperfections.defect`` holds a list of tables.
    """

    label: str
    values: dict[str, Any]


def latin(rng: np.random.Generator, count: int, keys: int) -> NDArray[np.float64]:
    """Return points as shares of the ranges, shape (count, keys): each range's n-th parts hold one each.

    Source: McKay, Beckman and Conover (1979).
    """
    order = np.argsort(rng.random((count, keys)), axis=0)
    return (order + rng.random((count, keys))) / count


def drawn(plan: Plan, scene: Scene) -> list[Drawn]:
    """Return the values of all runs, classes mixed.

    Raises
    ------
    SweepError
        With a line for each key or draw that is refused.
    """
    fields = fields_of(scene)
    problems: list[str] = []
    runs: list[Drawn] = []
    for place, (one, count) in enumerate(zip(plan.classes, plan.counts(), strict=True)):
        try:
            keys = _of_class(scene, fields, plan, one)
            defects = [_defect(fields, defect) for defect in one.defects]
        except SweepError as problem:
            problems += str(problem).splitlines()
            continue
        rng = np.random.default_rng([plan.seed, place])
        values = _columns(rng, list(keys.values()), count)
        tables = [_tables(rng, defect, count, plan.sizes) for defect in defects]
        for k in range(count):
            here = {key: column[k] for key, column in values.items()}
            if one.defects:
                here[DEFECTS] = [table[k] for table in tables]
            runs.append(Drawn(one.name, here))
    if problems:
        raise SweepError("\n".join(dict.fromkeys(problems)))
    return [runs[k] for k in np.random.default_rng([plan.seed]).permutation(len(runs))]


def words(plan: Plan, scene: Scene) -> list[tuple[Class, list[str]]]:
    """Return the draws of each class in words."""
    fields = fields_of(scene)
    return [
        (one, [
            *(draw.words() for draw in _of_class(scene, fields, plan, one).values()),
            *(draw.words() for defect in one.defects for draw in _defect(fields, defect)),
        ])
        for one in plan.classes
    ]  # fmt: skip


def _columns(
    rng: np.random.Generator, draws: Sequence[Range | Choice], count: int
) -> dict[str, list[Any]]:  # fmt: skip
    """Return the values of each key in each of some runs, by a Latin hypercube."""
    shares = latin(rng, count, len(draws))
    return {draw.key: draw.at(shares[:, k]) for k, draw in enumerate(draws)}


def _tables(
    rng: np.random.Generator, draws: Sequence[Range | Choice], count: int, sizes: int
) -> list[dict[str, Any]]:  # fmt: skip
    """Return the table of a defect in each run: a few shapes in turn, each run with a place of its own."""
    head = f"{DEFECTS}."
    placed = [draw for draw in draws if draw.key.removeprefix(head) in _PLACES]
    shaped = [draw for draw in draws if draw.key.removeprefix(head) not in _PLACES]
    few = min(sizes, count)
    shapes, places = _columns(rng, shaped, few), _columns(rng, placed, count)
    return [
        {key.removeprefix(head): column[k % few] for key, column in shapes.items()}
        | {key.removeprefix(head): column[k] for key, column in places.items()}
        for k in range(count)
    ]


def _of_class(
    scene: Scene, fields: Mapping[str, FieldInfo], plan: Plan, one: Class
) -> dict[str, Range | Choice]:  # fmt: skip
    """Return the draws of a class by dotted key: those of all classes, and its own over them."""
    return _keys(scene, fields, plan.draw) | _keys(scene, fields, one.draw)


def _keys(scene: Scene, fields: Mapping[str, FieldInfo], draws: Draw) -> dict[str, Range | Choice]:
    """Return draws of keys of a scene, which may be short names, by dotted key."""
    found: dict[str, Range | Choice] = {}
    problems = []
    for given, asked in draws.items():
        key = key_of(scene, given)
        try:
            known(key, list(fields), "key of a scene")
            if key in found:
                raise SweepError(f"draw {key} is given twice")
            found[key] = _draw(key, asked, fields.get(key))
        except (UnknownName, SweepError) as problem:
            problems += [line.removeprefix("there is ") for line in str(problem).splitlines()]
    if problems:
        raise SweepError("\n".join(problems))
    return found


def _defect(fields: Mapping[str, FieldInfo], draws: Draw) -> list[Range | Choice]:
    """Return draws of the keys of a defect; unknown ones are left to the check of the scene."""
    keys = {f"{DEFECTS}.{name}": asked for name, asked in draws.items()}
    return [_draw(key, asked, fields.get(key)) for key, asked in keys.items()]


def _draw(key: str, asked: Any, field: FieldInfo | None) -> Range | Choice:
    """Return a draw from what a plan gives: a value, an array, or the text of a range."""
    if isinstance(asked, list):
        if not asked:
            raise SweepError(f"draw {key} has no values")
        return Choice(key, tuple(asked))
    if not isinstance(asked, str) or ":" not in asked:
        return Choice(key, (asked,))
    match = _RANGE.fullmatch(asked)
    if match is None:
        raise SweepError(f'draw {key} = \'{asked}\' is refused: write "LOW:HIGH" or "LOW:HIGHlog"')
    low, high, log = float(match[1]), float(match[2]), match[3] is not None
    if not low < high:
        raise SweepError(f"draw {key} = '{asked}' is refused: give the lower end first")
    if log and low <= 0.0 <= high:
        raise SweepError(f"draw {key} = '{asked}' is refused: a logarithmic range does not hold 0")
    whole = field is not None and _whole(field.annotation)
    if whole and (log or not (low.is_integer() and high.is_integer())):
        raise SweepError(f"draw {key} = '{asked}' is refused: it takes whole numbers, from \"LOW:HIGH\"")
    ends = (int(low), int(high)) if whole else (low, high)
    return Range(Axis(key, key.rpartition(".")[2], ends, symbol(key)), log, whole)


def _whole(annotation: Any) -> bool:
    """Whether a field takes whole numbers alone."""
    kinds = set(get_args(annotation)) | {annotation}
    return int in kinds and float not in kinds
