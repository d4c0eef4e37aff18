"""From fitted values to the numbers of a scene: `fmu_bearing.identify` on a paper's fitted values alone.

A page names its free keys with their bounds; there are never more of them than fitted values. The search
starts at the scene's own numbers, which are the catalogue's defaults. A fitted value that is an interval is
fitted at its middle. What is run is kept on disk, so that an interrupted search goes on from there.

The impact-noise paper's level, the largest of a 5 ms history, is none that `identify` knows. It has one free
number for one value, so a bounded search for a zero does.
"""

import math
import pathlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from scipy.optimize import brentq

from examples.papers.case import Changes, changed
from examples.papers.values import FIT, Value
from fmu_bearing.results.table import markdown
from fmu_bearing.scene.values import value_at

if TYPE_CHECKING:
    from fmu_bearing.identification import Identified
    from fmu_bearing.identification.free import Free

Bounds = Mapping[str, tuple[float, float]]
#: A_1 of both races together, over all that the catalogue's grades have and what a scene allows beyond.
AMPLITUDE = "imperfections.*_race_amplitude_um"
BOTH = ("imperfections.inner_race_amplitude_um", "imperfections.outer_race_amplitude_um")
AMPLITUDE_UM = (0.03, 5.0)
EXPONENT = "imperfections.waviness_exponent"
#: Least standard deviation of a fitted level (dB): no sound level meter of the time was better.
LEAST_DB = 0.5
CLOSE_DB = 0.1  # that search ends so near to its value
MOST = 10  # steps of it


@dataclass(frozen=True)
class Number:
    """One identified number: its keys, value before and after, and what is known about it."""

    name: str
    keys: tuple[str, ...]
    before: float
    after: float
    known: str


@dataclass(frozen=True)
class Answer:
    """What was identified.

    Attributes
    ----------
    numbers : tuple of Number
    changes : tuple of (str, float)
        Keys of the scene with their identified values.
    left : tuple of (str, float, float)
        Fitted values by name: our level less the paper's middle (dB), before and after.
    remarks : tuple of str
        What the search says about itself.
    command : str
        The same by the command line; empty where it cannot be done there.
    """

    numbers: tuple[Number, ...]
    changes: Changes
    left: tuple[tuple[str, float, float], ...]
    remarks: tuple[str, ...] = ()
    command: str = ""

    @property
    def words(self) -> str:
        """Tables of the numbers and of what is left of the fitted values, and the remarks."""
        numbers = markdown(
            ["number", "default", "identified", ""],
            [[one.name, f"{one.before:.3g}", f"{one.after:.3g}", one.known] for one in self.numbers],
        )
        left = markdown(
            ["fitted value", "ours - paper before, dB", "after"],
            [[name, f"{before:+.1f}", f"{after:+.1f}"] for name, before, after in self.left],
        )
        return "\n".join([numbers, left, *(f"* {remark}" for remark in self.remarks)])


def check_count(free: int, values: Sequence[Value]) -> tuple[Value, ...]:
    """Return the fitted values.

    Raises
    ------
    ValueError
        When there are more free numbers than fitted values.
    """
    chosen = tuple(value for value in values if value.role == FIT)
    if free > len(chosen):
        raise ValueError(f"{free} free numbers, but {len(chosen)} fitted values")
    return chosen


def measured_row(value: Value) -> dict[str, object]:
    """Return a value as `fmu_bearing.identify` reads it, without its place; an interval at its middle."""
    kind, _, inside = value.quantity.partition(" ")
    return {
        "speed_rpm": value.rpm,
        "quantity": f"{kind}[{inside}]" if inside else kind,
        "value_dB": round(value.paper.middle, 2),
        "std_dB": round(max(value.paper.deviation, LEAST_DB), 2),
        "role": value.role,
    }


def by_identify(
    scene: str, fixed: Changes, free: Bounds, rows: Sequence[Mapping[str, object]], values: Sequence[Value],
    *, seeds: int, folder: pathlib.Path, workers: int, radiation_model: str, quick: bool = False,
) -> Answer:  # fmt: skip
    """Identify free keys with `fmu_bearing.identify`.

    A law's exponent that the fitted values do not determine would end wherever half a decibel of misfit
    drives it. It is then held at its default, and the rest identified again.

    Parameters
    ----------
    scene : str
        Name of the example scene.
    fixed : tuple of (str, value)
        Other changes to it.
    free : mapping
        Bounds by dotted key; ``*`` in a key: one factor on all that match.
    rows : sequence of mapping
        The fitted values as `fmu_bearing.identification.data.read_data` wants them, in the order of the
        fitted ones among ``values``.
    values : sequence of Value
    seeds, folder, workers
        As `fmu_bearing.identify` has them.
    radiation_model : str
    quick : bool
        Short runs, the first free key from the first fitted value: to see that it works.
    """
    from fmu_bearing.identification import identify

    chosen = check_count(len(free), values)
    if quick:
        chosen, rows, free = chosen[:1], rows[:1], dict(list(free.items())[:1])
    start = changed(scene, (*fixed, ("sound.radiation_model", radiation_model)))

    def search(keys: Bounds) -> "Identified":
        return identify(
            start, list(rows), dict(keys), seeds=seeds, starts=1, few=True, folder=folder, workers=workers,
            progress=False, **({"duration": 0.02, "settle": 0.01} if quick else {}),
        )  # fmt: skip

    found, held = search(free), ()
    if EXPONENT in free and len(free) > 1 and not found[EXPONENT].determined:
        was = found[EXPONENT]
        words = f"held at the default: free, it ends at {was.value:.3g}, not determined by the fitted values"
        held = (Number(EXPONENT, (EXPONENT,), was.free.start, was.free.start, words),)
        found = search({key: bounds for key, bounds in free.items() if key != EXPONENT})
    numbers = held + tuple(
        Number(one.key, one.free.keys, one.free.start, one.value, _known(one)) for one in found.estimates
    )
    numbers = tuple(sorted(numbers, key=lambda one: list(free).index(one.name)))
    left = tuple(
        (value.name, one.before - value.paper.middle, one.after - value.paper.middle)
        for value, one in zip(chosen, found.compared, strict=True)
    )
    return Answer(
        numbers, tuple((key, round_off(value)) for key, value in found.values.items()), left,
        tuple(found.remarks), command(scene, [one.free for one in found.estimates]),
    )  # fmt: skip


def _known(estimate) -> str:
    """Uncertainty of an estimate in words."""
    if estimate.at_bound:
        return f"at its {estimate.at_bound} bound"
    if not estimate.determined:
        return "not determined"
    low, high = estimate.interval()
    return f"{low:.3g} to {high:.3g} (2 standard deviations)"


def round_off(value: float) -> float:
    """Four digits: what a page shows is what ran."""
    return float(f"{value:.4g}")


def command(scene: str, free: "Sequence[Free]") -> str:
    """Return the command line that does the same from the table of measured values."""
    name = {"7003C-spindle": "multi-source", "7009C-full-ceramic": "sound-field"}.get(scene, scene)
    keys = " \\\n    ".join(f"--free '{one.key}={one.low:g}:{one.high:g}'" for one in free)
    return (
        f"fmu-bearing identify examples/scenes/{scene}.toml docs/results/papers/{name}-measured.csv \\\n"
        f"    {keys} \\\n    --few --seeds 8 -o identified.toml"
    )


def by_bracket(
    scene: str, fixed: Changes, values: Sequence[Value], level: Callable[[Changes], float]
) -> Answer:
    """Identify A_1 of both races from one fitted value.

    Parameters
    ----------
    scene, fixed, values
        As for `by_identify`.
    level : callable
        Our level (dB) of the fitted value for some changes, mean over the seeds.
    """
    (value,) = check_count(1, values)
    start = float(value_at(changed(scene, fixed), BOTH[0]))
    target = value.paper.middle
    low, high = (20.0 * math.log10(bound / start) for bound in AMPLITUDE_UM)
    seen: dict[float, float] = {}

    def changes(db: float) -> Changes:
        amplitude = round_off(start * 10.0 ** (db / 20.0))
        return tuple((key, amplitude) for key in BOTH)

    def miss(db: float) -> float:
        if db not in seen:
            seen[db] = level(changes(db)) - target
        return seen[db]

    def near(db: float) -> float:
        # within `CLOSE_DB` counts as met, which ends the search
        return miss(db) if abs(miss(db)) > CLOSE_DB else 0.0

    other = min(max(-near(0.0), low), high)  # sound follows its excitation about one to one
    while near(0.0) * near(other) > 0.0 and other not in (low, high):
        other = min(max(other - 1.5 * near(other), low), high)
    if near(0.0) * near(other) < 0.0:
        brentq(near, 0.0, other, xtol=0.01, maxiter=MOST, disp=False)
    best = min(seen, key=lambda db: abs(seen[db]))
    after = round_off(start * 10.0 ** (best / 20.0))
    known = "at its bound" if best in (low, high) else f"{len(seen)} tries"
    return Answer(
        (Number(AMPLITUDE, BOTH, start, after, known),), changes(best), ((value.name, seen[0.0], seen[best]),)
    )
