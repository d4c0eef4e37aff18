"""What chance gives where peaks are matched with many natural frequencies."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Chance:
    """Peaks that lie near a natural frequency, beside what peaks thrown at random would do.

    Attributes
    ----------
    peaks, matches : int
        How many peaks lie in the range, and how many of them within the tolerance of a natural frequency.
    coverage : float
        Share of the range's logarithmic axis that lies within the tolerance of a natural frequency.
    expected : float
        Matches of as many peaks thrown evenly on the logarithmic axis.
    probability : float
        Probability that such peaks give as many matches or more.
    """

    peaks: int
    matches: int
    coverage: float
    expected: float
    probability: float


def at_least(matches: int, probabilities: ArrayLike) -> float:
    """Probability of ``matches`` or more successes in independent trials of unequal probabilities.

    The Poisson-binomial law by its recursion over trials (Wang 1993); with equal ones the binomial law.

    Raises
    ------
    ValueError
        For a probability outside 0 to 1.
    """
    trials = np.asarray(probabilities, dtype=float).ravel()
    if not np.all((trials >= 0.0) & (trials <= 1.0)):
        raise ValueError("probabilities lie between 0 and 1")
    law = np.zeros(trials.size + 1)
    law[0] = 1.0
    for p in trials:
        law[1:] = law[1:] * (1.0 - p) + law[:-1] * p
        law[0] *= 1.0 - p
    return float(min(1.0, law[max(matches, 0) :].sum()))


def chance(peaks: ArrayLike, modes: ArrayLike, tolerance: float, lowest: float, highest: float) -> Chance:
    """Match peaks with natural frequencies, and say what chance gives.

    Parameters
    ----------
    peaks, modes : array_like
        Frequencies, Hz. Peaks outside the range are left out; modes outside may still reach into it.
    tolerance : float
        A peak matches if it is within this share of a mode's frequency.
    lowest, highest : float
        The range (Hz) in which peaks were looked for.

    Raises
    ------
    ValueError
        For frequencies or a tolerance that are not positive, or an empty range.
    """
    found = _positive("peaks", peaks)
    left, right = _bands(modes, tolerance, lowest, highest)
    found = found[(found >= lowest) & (found <= highest)]
    covered = float(np.sum(right - left) / math.log(highest / lowest))
    matches = int(_inside(np.log(found), left, right).sum())
    trials = np.full(found.size, covered)
    return Chance(found.size, matches, covered, covered * found.size, at_least(matches, trials))


def best_of(
    peaks: ArrayLike,
    choices: Sequence[ArrayLike],
    tolerance: float,
    lowest: float,
    highest: float,
    draws: int = 20_000,
    seed: int = 1,
) -> tuple[int, float]:
    """Index of the choice of modes that matches most, and how often chance's own best choice does as well.

    Whoever tries several stiffnesses or conditions and keeps the best match has to count them: random peaks
    may choose too. ``draws`` sets of as many peaks are thrown evenly on the logarithmic axis, each matched
    with every choice. Ties go to the choice that is least probable alone.

    Raises
    ------
    ValueError
        As `chance`; without any choice.
    """
    if not choices:
        raise ValueError("choices is empty: give one set of modes or more")
    own = [chance(peaks, modes, tolerance, lowest, highest) for modes in choices]
    best = max(range(len(own)), key=lambda k: (own[k].matches, -own[k].probability))
    ends = math.log(lowest), math.log(highest)
    thrown = np.random.default_rng(seed).uniform(*ends, (draws, own[best].peaks))
    most = np.zeros(draws, dtype=np.int64)
    for modes in choices:
        left, right = _bands(modes, tolerance, lowest, highest)
        most = np.maximum(most, _inside(thrown, left, right).sum(axis=1))
    return best, float(np.mean(most >= own[best].matches))


def _positive(name: str, values: ArrayLike) -> Array:
    found = np.asarray(values, dtype=float).ravel()
    if not np.all(np.isfinite(found) & (found > 0.0)):
        raise ValueError(f"{name} hold a frequency that is not positive and finite")
    return found


def _bands(modes: ArrayLike, tolerance: float, lowest: float, highest: float) -> tuple[Array, Array]:
    """Return ends (ln Hz) of what the modes' tolerances cover of the range, joined where they overlap."""
    if not 0.0 < tolerance < 1.0:
        raise ValueError(f"tolerance {tolerance}: give a share between 0 and 1")
    if not 0.0 < lowest < highest < math.inf:
        raise ValueError(f"range {lowest} to {highest} Hz: give 0 < lowest < highest")
    centres = np.log(np.sort(_positive("modes", modes)))
    ends = math.log(lowest), math.log(highest)
    left = np.clip(centres + math.log1p(-tolerance), *ends)
    right = np.clip(centres + math.log1p(tolerance), *ends)
    if not centres.size:
        return left, right
    apart = np.concatenate(([True], left[1:] > right[:-1]))  # all bands are equally wide
    last = np.concatenate((np.flatnonzero(apart)[1:] - 1, [centres.size - 1]))
    return left[apart], right[last]


def _inside(places: Array, left: Array, right: Array) -> NDArray[np.bool_]:
    """Whether places lie in one of the bands."""
    band = np.searchsorted(left, places, side="right") - 1
    if not left.size:
        return np.zeros(places.shape, dtype=bool)
    return (band >= 0) & (places <= right[np.maximum(band, 0)])
