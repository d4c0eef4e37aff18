"""What an identification found: values with their uncertainty, levels before and after, sentences."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.identification.data import Datum
from fmu_bearing.identification.free import Free
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene

FAR = 5.0  # standard deviations: of a million values one is so far off by chance
_VISIBLE = 0.1  # dB: what is printed
_MOST = 6  # values named


@dataclass(frozen=True)
class Estimate(Result):
    """One identified number."""

    quantities = (
        Quantity(" = key", "key"), Quantity(" = free.unit", "unit"),
        Quantity(" = free.start", "before", ".3g"),
        Quantity("value [as unit]", "identified", ".3g"), "unit = free.unit", "before [as unit] = free.start",
        Quantity("", "from", ".3g", of=lambda one: one.interval()[0]),
        Quantity("", "to (2 std)", ".3g", of=lambda one: one.interval()[1]),
        "interval [as unit]", "determined", "at_bound", Quantity(" = known", ""),
    )  # fmt: skip

    free: Free
    """Key, unit, start, bounds."""
    value: float
    """In the key's unit."""
    std: float
    """Standard deviation of ln(value) where the key is logarithmic, else in the key's unit; NaN: unknown."""
    determined: bool
    """Whether the data determine it: its standard deviation is less than a factor of two, or than a quarter
    of the width of the bounds."""
    at_bound: str = ""
    """``"low"``, ``"high"`` or empty."""

    @property
    def key(self) -> str:
        """As it was asked for."""
        return self.free.key

    def interval(self, deviations: float = 2.0) -> tuple[float, float]:
        """Lower and upper value, so many standard deviations away, within the bounds."""
        if math.isnan(self.std):
            return math.nan, math.nan
        if self.free.log:
            # a factor beyond e^50 is not a number worth showing
            factor = math.exp(min(deviations * self.std, 50.0))
            low, high = self.value / factor, self.value * factor
        else:
            low, high = self.value - deviations * self.std, self.value + deviations * self.std
        return max(low, self.free.low), min(high, self.free.high)

    def summary(self) -> dict[str, Any]:
        """Return the values by name; the deviation is that of the logarithm where the key says so."""
        return super().summary() | {"std_ln" if self.free.log else "std": self.std}

    @property
    def known(self) -> str:
        """What limits the value, in words; empty: nothing."""
        if not self.determined:
            return "not determined"
        return f"at its {self.at_bound} bound" if self.at_bound else ""

    @property
    def words(self) -> str:
        """Value with its uncertainty in words, as the scene's comment has it."""
        before = f"before: {self.free.start:.3g}"
        if math.isnan(self.std):
            return f"identified, uncertainty unknown; {before}"
        if not self.determined:
            return f"not determined by the data; {before}"
        low, high = self.interval()
        bound = f", at its {self.at_bound} bound" if self.at_bound else ""
        return f"identified: {low:.3g} to {high:.3g} (2 standard deviations){bound}; {before}"


@dataclass(frozen=True)
class Compared(Result):
    """One measured value beside the computed ones."""

    quantities = (
        Quantity("role", "role"), Quantity("value = datum.label", "value"),
        Quantity("measured_dB = datum.value", "measured, dB", ".1f"),
        Quantity("std_dB = datum.std", "std", ".1f"),
        Quantity("before_dB", "before", ".1f"), Quantity("after_dB", "after", ".1f"),
        Quantity("off_dB", "after - measured", "+.1f", of=lambda one: one.after - one.datum.value),
        Quantity("spread_dB", "over seeds", ".1f"),
    )  # fmt: skip

    datum: Datum
    before: float
    after: float
    """Computed with the scene as it was, and with the identified values, in the scene's own fidelity, mean
    over seeds, background added (dB)."""
    spread: float
    """Standard deviation of the computed level over seeds (dB)."""

    @property
    def role(self) -> str:
        """``fit``, or ``check``: it was not fitted."""
        return "fit" if self.datum.fit else "check"

    @property
    def sigma(self) -> float:
        """Standard deviation (dB) that noise and unknown phases give measured minus computed."""
        return math.hypot(self.datum.std, 0.0 if math.isnan(self.spread) else self.spread)


@dataclass(frozen=True)
class Identified(Result):
    """Result of `identify`."""

    quantities = (
        "scene = scene.name", "complete", "fidelity", "seeds [1]", "runs [1] = evaluations", "rms_dB = _rms",
        "residual_scale [1]", Quantity("values", of=lambda found: {one.key: one for one in found.estimates}),
        "levels = compared", "singular_values [1]", "correlation [1]", "remarks", "doubts",
    )  # fmt: skip

    scene: Scene
    """With the identified values, in its own fidelity."""
    start: Scene
    """As it was, fidelity ``auto`` resolved."""
    estimates: tuple[Estimate, ...]
    """One per free key."""
    compared: tuple[Compared, ...]
    """One per measured value, in the order of the data."""
    jacobian: NDArray[np.float64]
    """Change of each fitted level (dB) per unit of ln(value), or per width of the bounds for a key that is
    not logarithmic. Shape (fitted values, free keys)."""
    covariance: NDArray[np.float64]
    """Of these coordinates; linearised at the solution. Shape (free keys, free keys)."""
    singular_values: NDArray[np.float64]
    """Of the jacobian divided by the standard deviations of the levels, largest first: inverse standard
    deviations along `directions`. Shape (free keys,)."""
    directions: NDArray[np.float64]
    """Combinations of the coordinates, one per row. Shape (free keys, free keys)."""
    residual_scale: float
    """Factor by which residuals exceed the stated standard deviations; at least 1. Covariance holds it."""
    remarks: tuple[str, ...]
    """What the data cannot distinguish, what is at a bound, what the data cannot determine."""
    fidelity: str
    """Of the search."""
    seeds: tuple[int, ...]
    """Seeds averaged over."""
    evaluations: int = 0
    """Runs computed, without those that were kept from before."""
    complete: bool = True
    """False: the search was interrupted."""
    values: dict[str, float] = field(default_factory=dict)
    """Value of every key that was moved, in the scene's units."""

    @property
    def correlation(self) -> NDArray[np.float64]:
        """Correlation of the coordinates, shape (free keys, free keys)."""
        deviations = np.sqrt(np.diag(self.covariance))
        correlation: NDArray[np.float64] = self.covariance / np.outer(deviations, deviations)
        return correlation

    def rms(self, fit: bool = True, before: bool = False) -> float:
        """Root mean square of computed minus measured (dB), fitted or checked values; NaN: there are none."""
        off = [(one.before if before else one.after) - one.datum.value for one in self.compared
               if one.datum.fit is fit]  # fmt: skip
        return float(np.sqrt(np.mean(np.square(off)))) if off else math.nan

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences on what contradicts: values and data explain each other where there are none.

        Values more than five standard deviations off; a misfit that has become worse; checked values far
        worse than fitted ones. Without meaning for an interrupted search, which has none.
        """
        return tuple(_doubts(self)) if self.complete else ()

    def __getitem__(self, key: str) -> Estimate:
        for estimate in self.estimates:
            if key == estimate.key or key in estimate.free.keys:
                return estimate
        raise KeyError(f"'{key}' was not free; free: {', '.join(one.key for one in self.estimates)}")

    def records(self) -> tuple[Estimate, ...]:
        """Return the identified values."""
        return self.estimates

    def _rms(self) -> dict[str, float]:
        return {
            f"{role}_{when}": self.rms(role == "fit", when == "before")
            for role in ("fit", "check")
            for when in ("before", "after")
        }


def _doubts(result: Identified) -> Iterator[str]:
    off = [(abs(one.after - one.datum.value) / one.sigma, one) for one in result.compared]
    far = sorted((pair for pair in off if pair[0] > FAR), key=lambda pair: -pair[0])
    for sigmas, one in far[:_MOST]:
        role = "fitted" if one.datum.fit else "checked"
        yield (
            f"{one.datum.label} ({role}{f', {one.datum.source}' if one.datum.source else ''}): measured "
            f"{one.datum.value:.1f} dB, computed {one.after:.1f} dB, {sigmas:.0f} standard deviations apart: "
            "is the value right, and does the scene have what makes it?"
        )
    if len(far) > _MOST:
        yield f"and {len(far) - _MOST} more values beyond {FAR:g} standard deviations"
    before, after = result.rms(before=True), result.rms()
    if after > before + _VISIBLE and _sigma(result, True) < after:
        yield (
            f"fitted values are {after:.1f} dB rms off, {before:.1f} dB before: data that contradict each "
            "other, or that these keys cannot explain"
        )
    checked, count = result.rms(fit=False), sum(not one.datum.fit for one in result.compared)
    usual = max(after, _sigma(result, False)) if count else math.inf
    if checked > max(2.0, 1.0 + 2.0 / math.sqrt(max(count, 1))) * usual:
        yield (
            f"checked values are {checked:.1f} dB rms off, fitted ones {after:.1f} dB: the values found do "
            "not hold for what was not fitted"
        )


def _sigma(compared: Identified, fit: bool) -> float:
    """Rms (dB) of the standard deviations of fitted or checked values; NaN: there are none."""
    squares = [one.sigma**2 for one in compared.compared if one.datum.fit is fit]
    return float(np.sqrt(np.mean(squares))) if squares else math.nan
