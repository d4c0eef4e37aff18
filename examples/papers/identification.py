"""From fitted values to the numbers of a scene: one number for each fitted value, and nothing else.

The search starts at the scene's own numbers, which are the catalogue's defaults. A fitted value that is an
interval is fitted at its middle. Levels are medians over neighbouring speeds and seeds, as everywhere on the
pages. `fmu_bearing.identify` averages over seeds at the measured speeds alone, so a search of a few lines for
as many numbers as values does it here: each level follows its own number about one to one in dB.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from examples.papers.case import Changes, changed
from examples.papers.values import FIT, Met, Value
from fmu_bearing.results.table import markdown
from fmu_bearing.scene.values import value_at

#: A_1 of both races together, over all that the catalogue's grades have and what a scene allows beyond.
BOTH = ("imperfections.inner_race_amplitude_um", "imperfections.outer_race_amplitude_um")
GRADE_UM, EXPONENT = 0.3, 1.35  # of the catalogue
CLOSE_DB = 0.1  # that the search ends so near to its values
MOST = 8  # steps of it
_SLOPES = (0.3, 3.0)  # dB per dB: a step never takes a level for flatter or steeper


@dataclass(frozen=True)
class Number:
    """A free number of a scene and the value that it is identified from.

    Attributes
    ----------
    name, unit : str
        As the page calls it.
    keys : tuple of str
        Dotted keys of the scene that share it.
    value : str
        Name of the fitted value.
    bounds : (float, float)
    plausible : callable
        What the identified number would mean for a real part, in words.
    per_unit : float, optional
        Change of the value (dB) by 1 of the number, as a first guess; none: the value follows it in dB.
    against : str
        Fitted value whose miss is taken off: a level at a second speed less the one at the first.
    held_order : float
        Of an exponent of waves: the order whose amplitude it leaves alone. It eases the search and does not
        change where it ends.
    """

    name: str
    unit: str
    keys: tuple[str, ...]
    value: str
    bounds: tuple[float, float]
    plausible: Callable[[float], str]
    per_unit: float | None = None
    against: str = ""
    held_order: float = 1.0

    def steps(self, number: float, start: float) -> float:
        """How far a number is from the search's start, in dB of its value."""
        if self.per_unit is None:
            return 20.0 * math.log10(number / start)
        return self.per_unit * (number - start)

    def at(self, steps: float, start: float) -> float:
        """Return the number so many steps from the start."""
        if self.per_unit is None:
            return start * 10.0 ** (steps / 20.0)
        return start + steps / self.per_unit


def amplitude(value: str, most: float = 5.0) -> Number:
    """Return A_1 of both races (up to ``most`` um) as the number that a level decides."""
    return Number("A_1 of both races", "um", BOTH, value, (0.03, most), _over_grade)


def _over_grade(number: float) -> str:
    return f"{number / GRADE_UM:.0f} times what grade P4 has: an effective amplitude, no race's"


def exponent(value: str, against: str, held_order: float) -> Number:
    """Return the exponent p of the waves, decided by a level at twice the speed of another fitted one.

    Waves of half the order sound there at the same frequency: 1 of p is 20 lg 2 dB.
    """
    return Number(
        "exponent p of the waves", "", ("imperfections.waviness_exponent",), value, (0.5, 3.0),
        lambda p: f"ground races have 1 to 2 (default {EXPONENT:g})", 20.0 * math.log10(2.0), against,
        held_order,
    )  # fmt: skip


@dataclass(frozen=True)
class Found:
    """An identified number: value before and after, the level it was found from, and its range over seeds."""

    number: Number
    before: float
    after: float
    fitted: Met
    seeds: tuple[float, float]
    at_bound: str = ""


@dataclass(frozen=True)
class Answer:
    """What was identified.

    Attributes
    ----------
    found : tuple of Found
    changes : tuple of (str, float)
        Keys of the scene with their identified values.
    tries : int
        Steps of the search.
    """

    found: tuple[Found, ...]
    changes: Changes
    tries: int

    @property
    def words(self) -> str:
        """Table of the numbers."""
        columns = ["number", "start", "identified", "range over seeds", "from", "paper", "ours", "plausible?"]
        return markdown(columns, [_row(one) for one in self.found])


def _row(one: Found) -> list[str]:
    low, high = one.seeds
    bound = f" (at its {one.at_bound} bound)" if one.at_bound else ""
    name = ", ".join(filter(None, (one.number.name, one.number.unit)))
    return [
        name, f"{one.before:.3g}", f"{one.after:.3g}{bound}",
        f"{low:.3g} to {high:.3g}", one.number.value, f"{one.fitted.value.paper.middle:.1f}",
        f"{one.fitted.level:.1f}", one.number.plausible(one.after),
    ]  # fmt: skip


def check_numbers(numbers: Iterable[Number], values: Iterable[Value]) -> None:
    """Refuse numbers that are not identified from one fitted value each.

    Raises
    ------
    ValueError
        Naming the fitted values and those that the numbers are identified from.
    """
    fitted = sorted(value.name for value in values if value.role == FIT)
    asked = sorted(number.value for number in numbers)
    if asked != fitted:
        raise ValueError(f"numbers are identified from {asked}, but fitted values are {fitted}")


def identify(
    scene: str, fixed: Changes, numbers: tuple[Number, ...], values: Iterable[Value],
    levels: Callable[[Changes], Mapping[str, Met]], most: int = MOST,
) -> Answer:  # fmt: skip
    """Identify numbers of a scene, each from its own fitted value.

    Parameters
    ----------
    scene : str
        Name of the example scene.
    fixed : tuple of (str, value)
        Other changes to it.
    numbers : tuple of Number
    values : iterable of Value
        The paper's; one fitted value for each number.
    levels : callable
        Our fitted values by name, for some changes of the scene.
    most : int
        Steps at most.
    """
    check_numbers(numbers, values)
    own = changed(scene, fixed)
    start = [float(value_at(own, number.keys[0])) for number in numbers]
    ends = ([n.steps(n.bounds[k], x) for n, x in zip(numbers, start, strict=True)] for k in (0, 1))
    low, high = (np.array(end) for end in ends)

    def changes(steps: np.ndarray) -> Changes:
        amounts = [n.at(float(d), x) for n, x, d in zip(numbers, start, steps, strict=True)]
        scale = math.prod(n.held_order ** (a - x) for n, a, x in zip(numbers, amounts, start, strict=True))
        return tuple(
            (key, _round_off(min(a * scale, n.bounds[1]) if key in BOTH else a))
            for n, a in zip(numbers, amounts, strict=True)
            for key in n.keys
        )

    db, slope = np.zeros(len(numbers)), np.ones(len(numbers))
    seen: list[tuple[np.ndarray, np.ndarray, Mapping[str, Met]]] = []
    while len(seen) < most:
        met = levels(changes(db))
        miss = np.array([met[n.value].from_middle - (met[n.against].from_middle if n.against else 0.0)
                         for n in numbers])  # fmt: skip
        if seen:
            moved = db - seen[-1][0]
            rise = miss - seen[-1][1]
            secant = np.divide(rise, moved, out=slope.copy(), where=np.abs(moved) > 1e-3)
            slope = np.clip(secant, *_SLOPES)
        seen.append((db, miss, met))
        further = np.clip(db - miss / slope, low, high)
        if np.abs(miss).max() <= CLOSE_DB or np.abs(further - db).max() < 1e-3:
            break
        db = further
    db, miss, met = min(seen, key=lambda one: float(np.abs(one[1]).max()))
    after = changes(db)
    found = tuple(
        _found(number, x, dict(after)[number.keys[0]], met[number.value], float(s))
        for number, x, s in zip(numbers, start, slope, strict=True)
    )
    return Answer(found, after, len(seen))


def _found(number: Number, before: float, after: float, fitted: Met, slope: float) -> Found:
    """Join what is known of a number; seeds that are louder need less of it."""
    over = [number.at(-(level - fitted.level) / slope, after) for level in fitted.by_seed]
    ends = zip(("lower", "upper"), number.bounds, strict=True)
    bound = next((name for name, end in ends if math.isclose(after, end, rel_tol=1e-3)), "")
    return Found(number, before, after, fitted, (min(over), max(over)), bound)


def _round_off(value: float) -> float:
    """Four digits: what a page shows is what ran."""
    return float(f"{value:.4g}")
