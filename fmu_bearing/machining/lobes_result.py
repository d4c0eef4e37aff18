"""Limit of the axial depth over speed, and the verdict on the scene's own cut."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.receptance.receptance_table import Place
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene

#: Of the limit: assumed damping and cutting coefficients move it by more than what is left (chosen).
MARGIN = 0.7
#: K: so much warmer inner rings are tried, as the growth of rings changes a preload by spacers (chosen).
WARMER = 10.0
_MOVES = 0.05  # of the limit: less is within what assumed damping makes of it


@dataclass(frozen=True)
class Limit(Result):
    """The limit at one speed."""

    quantities = (
        Quantity("speed_rpm = speed", "r/min", ",.0f"),
        Quantity("depth_mm = depth", "limit of the depth, mm", ".2f", factor=1e3),
        Quantity("frequency_Hz = frequency", "chatters at, Hz", ",.0f"),
    )

    speed: float
    """r/min."""
    depth: float
    """m: axial depth from which the cut chatters; infinite: none below the highest frequency."""
    frequency: float
    """Hz, at the limit."""


@dataclass(frozen=True)
class LobesTable(Result):
    """Numbers of `Lobes`, which adds files and a picture."""

    scene: Scene
    place: Place
    """Where the cut is: ``tip`` of the scene's tool, or the nose without one."""
    limits: tuple[Limit, ...]
    """Over rising speeds."""
    own: Limit
    """At the scene's speed."""
    coarse: tuple[float, ...]
    """r/min: where the receptance was computed; between them its inverse is interpolated."""
    warm: Limit | None = None
    """At the scene's speed with inner rings that are `WARMER`; None: there is no equilibrium then."""
    remarks: tuple[str, ...] = ()

    @property
    def speeds(self) -> NDArray[np.float64]:
        """r/min."""
        return np.array([one.speed for one in self.limits])

    @property
    def depths(self) -> NDArray[np.float64]:
        """Limit of the axial depth (m) over `speeds`."""
        return np.array([one.depth for one in self.limits])

    @property
    def least(self) -> Limit:
        """The least limit: a smaller depth is stable at any of the speeds."""
        return min(self.limits, key=lambda one: one.depth)

    @property
    def best(self) -> Limit:
        """The largest limit."""
        return max(self.limits, key=lambda one: one.depth)

    @property
    def depth(self) -> float:
        """Axial depth of the scene (m); NaN: none is given."""
        cut = self.scene.milling
        return math.nan if cut is None or cut.depth_mm is None else 1e-3 * cut.depth_mm

    @property
    def judgement(self) -> str:
        """``good``, ``watch`` (beyond `MARGIN` of the limit), ``change`` (beyond it), or empty: no depth."""
        if math.isnan(self.depth):
            return ""
        if self.depth >= self.own.depth:
            return "change"
        return "watch" if self.depth > MARGIN * self.own.depth else "good"

    def pockets(self) -> tuple[Limit, ...]:
        """Return the speeds between two lobes, where the limit is largest, from the deepest on."""
        inner = range(1, len(self.limits) - 1)
        d = self.depths
        found = [self.limits[k] for k in inner if d[k - 1] < d[k] >= d[k + 1]]
        return tuple(sorted(found, key=lambda one: -one.depth))

    def verdict(self) -> str:
        """Return in a sentence whether the scene's cut is stable, and the nearest way out where it is not.

        Last comes the speed of the largest limit, with the depth up to which one stays within `MARGIN` of it.
        """
        own, least = self.own, self.least
        beyond = f"the limit at {own.speed:,.0f} r/min is {_mm(own.depth)}"
        if math.isfinite(own.depth):
            beyond += f", where it chatters at {own.frequency:,.0f} Hz"
        always = f"{_mm(least.depth)} is stable at all of these speeds"
        if len(self.limits) > 1:
            always += f"; {self._best()}"
        if math.isnan(self.depth):
            return f"{_begin(beyond)}; {always}."
        words = {"good": "is stable", "watch": "is stable with little left", "change": "chatters"}
        sentence = f"{_mm(self.depth)} {words[self.judgement]}: {beyond}"
        way_out = self._way_out() if self.judgement != "good" else ""
        return f"{sentence}{way_out}; {always}."

    def _way_out(self) -> str:
        """Return the nearest speed at which the depth is within the margin, in words; empty: none."""
        good = [one for one in self.limits if self.depth <= MARGIN * one.depth]
        if not good:
            return ""
        near = min(good, key=lambda one: abs(one.speed - self.own.speed))
        there = f"{near.speed:,.0f} r/min, with a limit of {_mm(near.depth)}"
        return f"; the nearest speed for this depth is {there}"

    def _best(self) -> str:
        """Return the speed of the largest limit, in words."""
        best, ends = self.best, (self.limits[0].speed, self.limits[-1].speed)
        words = f"the best of {ends[0]:,.0f} to {ends[1]:,.0f} r/min is {best.speed:,.0f}, with "
        if not math.isfinite(best.depth):
            return f"{words}no limit below the highest frequency"
        return f"{words}a limit of {_mm(best.depth)}: stay below {_mm(MARGIN * best.depth)}, {MARGIN:g} of it"

    def records(self) -> tuple[Limit, ...]:
        """Return `limits`."""
        return self.limits

    def cautions(self) -> list[str]:
        """Return what limits these numbers, in sentences."""
        sentences = list(self.remarks)
        if self.warm is None or abs(_ratio(self.warm.depth, self.own.depth) - 1.0) > _MOVES:
            sentences.append(self._of_warmth())
        if self.place == "nose":
            sentences.append(
                "the cut is at the nose itself: a tool is softer than that, give [tool] with its sections"
            )
        return sentences

    def _of_warmth(self) -> str:
        """Return in words what warmer inner rings make of the limit at the scene's speed."""
        there = f"with inner rings {WARMER:g} K warmer, which changes the preload, "
        at, own = f"{self.own.speed:,.0f} r/min", _mm(self.own.depth)
        if self.warm is None:
            return f"{there}nothing holds at {at}: the limit of {own} is of the scene's temperatures"
        return f"{there}the limit at {at} is {_mm(self.warm.depth)} in place of {own}"


def _ratio(one: float, other: float) -> float:
    """Return one limit over another; 1 where both are infinite."""
    return 1.0 if one == other else one / other


def _mm(depth: float) -> str:
    return f"{1e3 * depth:.3g} mm" if math.isfinite(depth) else "none below the highest frequency"


def _begin(words: str) -> str:
    return words[0].upper() + words[1:]
