"""Reference rating life by ISO 16281, from the loads of the balls. Units N, Mrev; angles in rad."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike


def race_ratings(
    rating: float, balls: int, g: float, angle: float, conformities: Sequence[float]
) -> tuple[float, float]:
    """Return the load ratings (N) of one ball at the inner and at the outer race.

    Parameters
    ----------
    rating : float
        C (N).
    balls : int
    g : float
        D_w cos(alpha) / d_m.
    angle : float
        Contact angle (rad).
    conformities : sequence of float
        Inner and outer, at most 0.52 and 0.53: C knows no closer grooves.
    """
    inner, outer = conformities
    groove = (inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0)) ** 0.41
    r = 1.044 * ((1.0 - g) / (1.0 + g)) ** 1.72 * groove
    whole = rating / (balls * math.cos(angle) ** 0.7)
    ten_thirds = 10.0 / 3.0
    return whole / 0.407 * (1.0 + r**ten_thirds) ** 0.3, whole / 0.389 * (1.0 + r**-ten_thirds) ** 0.3


def reference_life(ratings: tuple[float, float], inner: ArrayLike, outer: ArrayLike) -> float:
    """Return L10r (Mrev) of a bearing whose inner ring turns; infinite without load.

    ``inner``, ``outer``: loads (N) of the balls at the races, shape (balls,).
    """
    one = np.mean(np.asarray(inner, float) ** 3) ** (1.0 / 3.0)
    other = np.mean(np.asarray(outer, float) ** (10.0 / 3.0)) ** 0.3
    if not one > 0.0 or not other > 0.0:
        return math.inf
    shares = (ratings[0] / one) ** (-10.0 / 3.0) + (ratings[1] / other) ** (-10.0 / 3.0)
    return float(shares**-0.9)
