"""What choices of a designer change in a scene: level, life, friction torque; ranked, and in words."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.accuracy.alternatives import Alternative
from fmu_bearing.design import verdict
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.table import Table
from fmu_bearing.scene import Scene
from fmu_bearing.scene.values import value_at

#: The figures by which changes are ranked.
RANKED = ("level", "life", "torque")
MORE_IS_BETTER = {"level": False, "life": True, "torque": False, "stiffness": True}
#: Changes below these are none: dB, and share of life, torque and stiffness.
LEAST_DB, LEAST = 0.1, 0.01
#: N mm: below it a torque is rounding, of a bearing without friction or at rest.
FRICTIONLESS = 1e-6
_SUBJECT = 60  # characters of a warning that name its subject, before any number


class Point(NamedTuple):
    """Figures of an operating point without a run.

    Friction torque (N mm), L10r (h; NaN: not rated), radial stiffness of the bearing (N/um, the mean of y and
    z), and what the engine warns of. Of a set torque and life of all bearings together, and the stiffness of
    the shaft across at its nose.
    """

    torque: float
    life: float
    stiffness: float
    cautions: tuple[str, ...] = ()


class LevelBasis(NamedTuple):
    """How levels were computed: level of the unchanged scene (dB(A)), microphone, models, times (s), seeds.

    ``doubt``: why they are in doubt; empty: they are not.
    """

    level: float = math.nan
    microphone: str = ""
    fidelity: str = ""
    radiation_model: str = ""
    settle: float = 0.0
    duration: float = 0.0
    seeds: tuple[int, ...] = ()
    doubt: str = ""


@dataclass(frozen=True)
class Change(Result):
    """One choice and what it changes."""

    quantities = (
        "topic = choice.topic", "change = choice.words", "values = choice.values", "level_change_dB = level",
        Quantity("level_change_low_dB", of=lambda one: one.level_range[0]),
        Quantity("level_change_high_dB", of=lambda one: one.level_range[1]),
        Quantity("level_is_found", of=lambda one: one.acts("level")),
        "life_h = _after.life", Quantity("life_ratio [1]", of=lambda one: one.ratio("life")),
        "torque_N_mm = _after.torque", Quantity("torque_ratio [1]", of=lambda one: one.ratio("torque")),
        "stiffness_N_um = _after.stiffness",
        Quantity("stiffness_ratio [1]", of=lambda one: one.ratio("stiffness")),
        "cautions", "reason",
    )  # fmt: skip

    choice: Alternative
    """Topic, words and values of the scene."""
    before: Point
    """The operating point of the unchanged scene."""
    after: Point | None = None
    """That of the changed one; None where there is none."""
    levels: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    """Differences of the level (dB) with the same seed; empty without levels. Shape (seeds,)."""
    reason: str = ""
    """Why there are no figures; empty: there are."""

    @property
    def level(self) -> float:
        """Mean over the seeds of the level's difference (dB); NaN without levels."""
        return float(self.levels.mean()) if self.levels.size else math.nan

    @property
    def level_range(self) -> tuple[float, float]:
        """Least and largest difference of the level over the seeds (dB)."""
        if not self.levels.size:
            return math.nan, math.nan
        return float(self.levels.min()), float(self.levels.max())

    @property
    def _after(self) -> Point:
        return self.after or Point(math.nan, math.nan, math.nan)

    def ratio(self, figure: str) -> float:
        """Return ``life``, ``torque`` or ``stiffness`` over that of the unchanged scene; NaN without."""
        if self.after is None:
            return math.nan
        old, new = getattr(self.before, figure), getattr(self.after, figure)
        return float(new / old) if old and math.isfinite(old) else math.nan

    def gain(self, figure: str) -> float:
        """Return how much better a figure gets: dB, or the logarithm of its ratio; NaN: it does not apply."""
        if figure == "level":
            return -self.level
        ratio = self.ratio(figure)
        sign = 1.0 if MORE_IS_BETTER[figure] else -1.0
        return sign * math.log(ratio) if ratio > 0.0 else math.nan

    def acts(self, figure: str) -> bool:
        """Whether a figure changes by more than nothing, and a level rises or falls with every seed."""
        size = abs(self.gain(figure))
        if figure != "level":
            return size >= math.log1p(LEAST)
        low, high = self.level_range
        # what is printed as 0.1 dB counts as such, in either direction
        return size >= 0.5 * LEAST_DB and low * high > 0.0

    @property
    def depends_on_seed(self) -> bool:
        """Whether one draw of the surfaces gets audibly quieter and another louder: no finding."""
        low, high = self.level_range
        return low <= 0.0 <= high and high - low >= LEAST_DB

    @property
    def cautions(self) -> tuple[str, ...]:
        """Warnings of the changed operating point that the unchanged one does not give."""
        known = {text[:_SUBJECT] for text in self.before.cautions}
        return (
            () if self.after is None else tuple(t for t in self.after.cautions if t[:_SUBJECT] not in known)
        )


@dataclass(frozen=True)
class Changes(Result):
    """What the choices of a designer change in a scene."""

    quantities = (
        "scene = scene.name", "level_dB = basis.level", "life_h = before.life", "torque_N_mm = before.torque",
        "stiffness_N_um = before.stiffness", "microphone = basis.microphone", "fidelity = basis.fidelity",
        "radiation_model = basis.radiation_model", "settle_s = basis.settle", "duration_s = basis.duration",
        "seeds [1] = basis.seeds", "doubt = basis.doubt", "no_level", "no_life", "no_torque",
        "cautions = before.cautions", "near_resonance = resonances",
        Quantity("ranked_by", of=lambda found: found.figures[0]), "changes = records",
    )  # fmt: skip

    scene: Scene
    before: Point
    """Its operating point before any change."""
    basis: LevelBasis
    """Its level, and how levels were computed."""
    changes: tuple[Change, ...]
    """In the order of `alternatives`; those without figures are in it, with their reason."""
    no_level: str = ""
    no_life: str = ""
    """Why there are none; empty: there are."""

    def __repr__(self) -> str:
        found = len(self.changes) - len(self.refused)
        return f"Changes({self.scene.name!r}, {found} changes, {len(self.refused)} refused)"

    @property
    def figures(self) -> tuple[str, ...]:
        """Return the figures that there are, of level, life and torque."""
        missing = {"level": self.no_level, "life": self.no_life, "torque": self.no_torque}
        return tuple(name for name in RANKED if not missing.get(name))

    @property
    def no_torque(self) -> str:
        """Why there is no friction torque; empty: there is."""
        return "" if self.before.torque > FRICTIONLESS else "the scene has no friction"

    @property
    def stiff(self) -> str:
        """What the stiffness is, in words."""
        return "stiffness across at the nose" if self.scene.assembly.joined else "radial stiffness"

    @property
    def refused(self) -> list[Change]:
        """Choices without figures: the scene does not allow them, or there is no equilibrium."""
        return [each for each in self.changes if each.reason]

    def ranked(self, figure: str) -> list[Change]:
        """Return the changes with a figure, the best first; those that are no finding last."""
        there = [each for each in self.changes if math.isfinite(each.gain(figure))]
        return sorted(there, key=lambda each: (not each.acts(figure), -each.gain(figure)))

    def records(self) -> list[Change]:
        """Return the changes ranked by the first figure, then those without figures."""
        return [*self.ranked(self.figures[0]), *self.refused]

    def table(self) -> Table:
        """Columns and rows of a table, ranked by the first figure."""
        columns = ["change"] + (["dB(A)", "over seeds"] if "level" in self.figures else [])
        names = [name for name in ("life", "torque") if name in self.figures] + ["stiffness"]
        columns += [*names[:-1], "stiff."]
        rows = []
        for each in self.ranked(self.figures[0]):
            cells = [each.choice.words]
            if "level" in self.figures:
                low, high = each.level_range
                cells += [shown_level(each.level), f"{shown_level(low, 2)} to {shown_level(high, 2)}"]
                if not each.acts("level"):
                    cells[1] = "no finding" if each.depends_on_seed else "none"
            rows.append(cells + [shown_ratio(each.ratio(name)) for name in names])
        return columns, rows

    def resonances(self) -> list[str]:
        """Return topics of which less and more are both quieter: a strong line is near a resonance."""
        quieter = []
        topics = {"speed": "operation.speed_rpm"}
        if self.scene.assembly.can_preload:
            topics["preload"] = self.scene.assembly.preload_key
        for topic, key in topics.items():
            now = value_at(self.scene, key)
            rows = [e for e in self.changes if e.choice.topic == topic and e.levels.size]
            sides = [
                min(side, key=lambda e: abs(e.choice.values[key] - now))
                for side in (
                    [e for e in rows if e.choice.values[key] < now],
                    [e for e in rows if e.choice.values[key] > now],
                )
                if side
            ]
            if len(sides) == 2 and all(e.acts("level") and e.level < 0.0 for e in sides):
                quieter.append(topic)
        return quieter

    def resonance(self) -> str:
        """Return the remark on `resonances`; empty without."""
        topics = self.resonances()
        if not topics:
            return ""
        return (
            f"Less and more {' and '.join(topics)} are both quieter: a strong line meets a resonance at this "
            "operating point, so that almost any change moves it away."
        )

    def remarks(self) -> list[str]:
        """Return the warnings of single changes, and the choices that were left out."""
        warnings = [f"Unchanged: {text}." for text in (*self.before.cautions, self.basis.doubt) if text]
        warnings += [f"{each.choice.words}: {text}." for each in self.changes for text in each.cautions]
        return warnings + [f"Left out: {each.choice.words}: {each.reason}." for each in self.refused]

    def conditions(self) -> str:
        """Return how the figures were computed, in sentences."""
        h = self.basis
        names = {"life": "life (L10r, ISO 16281)", "torque": "torque"}
        there = [text for name, text in names.items() if name in self.figures]
        words = ", ".join([*there, self.stiff])
        several = len(self.scene.bearings()) > 1
        perfect = "perfect bearings, of all together" if several else "the perfect bearing"
        words = f"{words[0].upper()}{words[1:]}: operating point of {perfect}."
        for name, reason in (("life", self.no_life), ("torque", self.no_torque)):
            words += f" No {name}: {reason}." if reason else ""
        if self.no_level:
            return f"{words} No levels: {self.no_level}."
        return (
            f"{words} Levels: at {h.microphone}, the loudest microphone, fidelity {h.fidelity}, radiation "
            f"model {h.radiation_model}, {1e3 * h.duration:.0f} ms after {1e3 * h.settle:.0f} ms; mean and "
            f"range of the differences, which are taken with the same seed before and after a change, for "
            f"{len(h.seeds)} {'seed' if len(h.seeds) == 1 else 'seeds'}."
        )

    def unchanged(self) -> str:
        """Return the figures of the unchanged scene, in words."""
        b = self.before
        # the level of a run of fidelity full, printed elsewhere, is another one
        by = f" by fidelity {self.basis.fidelity}" if self.basis.fidelity else ""
        figures = [f"{self.basis.level:.1f} dB(A){by}"] if "level" in self.figures else []
        figures += [f"L10r {shown_hours(b.life)}"] if "life" in self.figures else []
        figures += [f"torque {b.torque:.3g} N mm"] if "torque" in self.figures else []
        return ", ".join([*figures, f"{self.stiff} {b.stiffness:.3g} N/um"])


def shown_level(change: float, digits: int = 3) -> str:
    """Return a difference of levels (dB) with its sign: a tenth of a dB, or fewer digits."""
    if abs(change) < 0.05:
        return "0.0"  # no -0.0
    return f"{change:+.1f}" if digits > 2 or abs(change) < 10.0 else f"{change:+.0f}"


def shown_hours(life: float) -> str:
    """Return a rating life (h) with three digits, see `design.verdict.shown_hours`."""
    figure = f"{float(f'{life:.3g}'):,.10g}"
    return f"{verdict.shown_hours(life, figure)} h"


def shown_ratio(ratio: float) -> str:
    """Return a ratio as ``x0.85``; below a hundredth of change as ``=``, empty for NaN."""
    if math.isnan(ratio):
        return ""
    if ratio > 0.0 and abs(math.log(ratio)) < math.log1p(LEAST):
        return "="
    return f"x{ratio:.2f}" if ratio < 10.0 else f"x{ratio:.1f}" if ratio < 100.0 else f"x{ratio:.0f}"
