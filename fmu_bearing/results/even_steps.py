"""Even spacing of times and frequencies: one rule for spectra, envelopes and universal files."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Of a step: how far a value may be from an even grid. Loggers round times to six decimals, which is up to
#: 2.6 % of a step at 51.2 kHz, the fastest of the usual rates. Were the samples themselves off by up to 3 %,
#: at random, a tone at a quarter of the rate would have an error 31 dB below it: 0.03 / sqrt(3) of a step is
#: 0.027 rad there.
ALLOWED = 0.03


class Spacing(NamedTuple):
    """How evenly values rise: mean step, and the value that is farthest from the even grid through them."""

    step: float
    """First to last over their number less one; 0 for fewer than two."""
    off: float
    """Of the farthest value, in steps; infinite where values do not rise."""
    worst: int
    """Where the gap to the next value differs most from the middle one."""
    gaps: NDArray[np.float64]

    @property
    def even(self) -> bool:
        """Whether the values are two or more on an even grid."""
        return self.gaps.size > 0 and self.off <= ALLOWED

    def words(self, unit: str) -> str:
        """Return the least and the largest gap in words, for messages."""
        if not self.gaps.size:
            return "fewer than two"
        return f"{self.gaps.min():.4g} to {self.gaps.max():.4g} {unit} apart"


def spacing(values: ArrayLike) -> Spacing:
    """Return how evenly values are spaced; the grid is the straight line that fits them best."""
    given = np.ravel(np.asarray(values, dtype=float))
    gaps = np.diff(given)
    if not gaps.size:
        return Spacing(0.0, math.inf, 0, gaps)
    step = float(given[-1] - given[0]) / gaps.size
    worst = int(np.argmax(np.abs(gaps - np.median(gaps))))
    if gaps.min() <= 0.0:
        return Spacing(step, math.inf, int(np.argmin(gaps)), gaps)
    count = np.arange(given.size) - 0.5 * gaps.size
    off = (given - given.mean()) / step - count
    off -= count * (float(count @ off) / float(count @ count))
    return Spacing(step, float(np.abs(off).max()), worst, gaps)
