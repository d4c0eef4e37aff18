"""What an identification found: values with their uncertainty, levels before and after, sentences."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.identification.data import Datum
from fmu_bearing.identification.free import Free
from fmu_bearing.scene import Scene

FAR = 5.0  # standard deviations: of a million values one is so far off by chance
_VISIBLE = 0.1  # dB: what is printed
_MOST = 6  # values named


@dataclass(frozen=True)
class Estimate:
    """One identified number.

    Attributes
    ----------
    free : Free
        Key, unit, start, bounds.
    value : float
        In the key's unit.
    std : float
        Standard deviation of ln(value) where the key is logarithmic, else in the key's unit; NaN: unknown.
    determined : bool
        Whether the data determine it: its standard deviation is less than a factor of two, or than a quarter
        of the width of the bounds.
    at_bound : str
        ``"low"``, ``"high"`` or empty.
    """

    free: Free
    value: float
    std: float
    determined: bool
    at_bound: str = ""

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
class Compared:
    """One measured value beside the computed ones.

    Attributes
    ----------
    datum : Datum
    before, after : float
        Computed with the scene as it was, and with the identified values, in the scene's own fidelity, mean
        over seeds, background added (dB).
    spread : float
        Standard deviation of the computed level over seeds (dB).
    """

    datum: Datum
    before: float
    after: float
    spread: float

    @property
    def sigma(self) -> float:
        """Standard deviation (dB) that noise and unknown phases give measured minus computed."""
        return math.hypot(self.datum.std, 0.0 if math.isnan(self.spread) else self.spread)


@dataclass(frozen=True)
class Identified:
    """Result of `identify`.

    Attributes
    ----------
    scene : Scene
        With the identified values, in its own fidelity.
    start : Scene
        As it was, fidelity ``auto`` resolved.
    estimates : tuple of Estimate
        One per free key.
    compared : tuple of Compared
        One per measured value, in the order of the data.
    jacobian : ndarray, shape (fitted values, free keys)
        Change of each fitted level (dB) per unit of ln(value), or per width of the bounds for a key that is
        not logarithmic.
    covariance : ndarray, shape (free keys, free keys)
        Of these coordinates; linearised at the solution.
    singular_values : ndarray, shape (free keys,)
        Of the jacobian divided by the standard deviations of the levels, largest first: inverse standard
        deviations along `directions`.
    directions : ndarray, shape (free keys, free keys)
        Combinations of the coordinates, one per row.
    residual_scale : float
        Factor by which residuals exceed the stated standard deviations; at least 1. Covariance holds it.
    remarks : tuple of str
        What the data cannot distinguish, what is at a bound, what the data cannot determine.
    fidelity : str
        Of the search.
    seeds : tuple of int
        Seeds averaged over.
    evaluations : int
        Runs computed, without those that were kept from before.
    complete : bool
        False: the search was interrupted.
    values : dict of str to float
        Value of every key that was moved, in the scene's units.
    """

    scene: Scene
    start: Scene
    estimates: tuple[Estimate, ...]
    compared: tuple[Compared, ...]
    jacobian: NDArray[np.float64]
    covariance: NDArray[np.float64]
    singular_values: NDArray[np.float64]
    directions: NDArray[np.float64]
    residual_scale: float
    remarks: tuple[str, ...]
    fidelity: str
    seeds: tuple[int, ...]
    evaluations: int = 0
    complete: bool = True
    values: dict[str, float] = field(default_factory=dict)

    @property
    def correlation(self) -> NDArray[np.float64]:
        """Correlation of the coordinates, shape (free keys, free keys)."""
        deviations = np.sqrt(np.diag(self.covariance))
        found: NDArray[np.float64] = self.covariance / np.outer(deviations, deviations)
        return found

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
        for one in self.estimates:
            if key == one.key or key in one.free.keys:
                return one
        raise KeyError(f"'{key}' was not free; free: {', '.join(one.key for one in self.estimates)}")

    def summary(self) -> dict[str, Any]:
        """Return values, misfits and remarks, for machines."""
        return {
            "scene": self.scene.name,
            "complete": self.complete,
            "fidelity": self.fidelity,
            "seeds": self.seeds,
            "runs": self.evaluations,
            "rms_dB": {
                f"{role}_{when}": self.rms(role == "fit", when == "before")
                for role in ("fit", "check")
                for when in ("before", "after")
            },
            "residual_scale": self.residual_scale,
            "values": {
                one.key: {
                    "value": one.value,
                    "unit": one.free.unit,
                    "before": one.free.start,
                    "std_ln" if one.free.log else "std": one.std,
                    "interval": one.interval(),
                    "determined": one.determined,
                    "at_bound": one.at_bound,
                }
                for one in self.estimates
            },
            "singular_values": self.singular_values,
            "correlation": self.correlation,
            "remarks": self.remarks,
            "doubts": self.doubts,
        }


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a search; ``best`` holds the best values so far, ``complete`` is False there."""

    def __init__(self, best: Identified) -> None:
        super().__init__("interrupted: these are the best values so far")
        self.best = best


def _doubts(found: Identified) -> Iterator[str]:
    off = [(abs(one.after - one.datum.value) / one.sigma, one) for one in found.compared]
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
    before, after = found.rms(before=True), found.rms()
    if after > before + _VISIBLE and _sigma(found, True) < after:
        yield (
            f"fitted values are {after:.1f} dB rms off, {before:.1f} dB before: data that contradict each "
            "other, or that these keys cannot explain"
        )
    checked, count = found.rms(fit=False), sum(not one.datum.fit for one in found.compared)
    usual = max(after, _sigma(found, False)) if count else math.inf
    if checked > max(2.0, 1.0 + 2.0 / math.sqrt(max(count, 1))) * usual:
        yield (
            f"checked values are {checked:.1f} dB rms off, fitted ones {after:.1f} dB: the values found do "
            "not hold for what was not fitted"
        )


def _sigma(found: Identified, fit: bool) -> float:
    """Rms (dB) of the standard deviations of fitted or checked values; NaN: there are none."""
    squares = [one.sigma**2 for one in found.compared if one.datum.fit is fit]
    return float(np.sqrt(np.mean(squares))) if squares else math.nan


def values_table(found: Identified) -> tuple[list[str], list[list[str]]]:
    """Columns and rows of the identified values."""
    rows = []
    for one in found.estimates:
        low, high = one.interval()
        known = (
            "not determined" if not one.determined else f"at its {one.at_bound} bound" if one.at_bound else ""
        )
        numbers = [f"{value:.3g}" for value in (one.free.start, one.value, low, high)]
        rows.append([one.key, one.free.unit, *numbers, known])
    return ["key", "unit", "before", "identified", "from", "to (2 std)", ""], rows


def levels_table(found: Sequence[Compared]) -> tuple[list[str], list[list[str]]]:
    """Columns and rows of measured and computed levels."""
    rows = [
        [
            "fit" if one.datum.fit else "check",
            one.datum.label,
            f"{one.datum.value:.1f}",
            f"{one.datum.std:.1f}",
            f"{one.before:.1f}",
            f"{one.after:.1f}",
            f"{one.after - one.datum.value:+.1f}",
            f"{one.spread:.1f}",
        ]
        for one in found
    ]
    return ["role", "value", "measured, dB", "std", "before", "after", "after - measured", "over seeds"], rows
