"""Covariance of levels and of identified values, and what it says in plain sentences.

A measured level differs from the computed one by noise of the measurement and by phases of the surfaces that
is unknown: a model averaged over seeds is not the one bearing that was measured. Levels of one run move
together when phases change, so their deviations over seeds enter as a covariance, not as more noise.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.identification.free import Free

FACTOR_OF_TWO = math.log(2.0)
_QUARTER = 0.25  # of the width of the bounds; knowing nothing gives 0.29
_ALIKE = 0.8  # correlation from which two keys are named together
_NAMED = 0.35  # share of a direction from which a key is named
_WIDEST = 4.0  # by how much a bend of the levels may widen a deviation
_AT = 1e-3  # of the width of the bounds


@dataclass(frozen=True)
class Spread:
    """Uncertainty of identified coordinates.

    Attributes
    ----------
    covariance : ndarray, shape (keys, keys)
        Infinite where nothing is known.
    singular_values : ndarray, shape (keys,)
        Of the whitened jacobian.
    directions : ndarray, shape (keys, keys)
        One per row.
    scale : float
        Factor on stated standard deviations, at least 1, that residuals ask for.
    """

    covariance: NDArray[np.float64]
    singular_values: NDArray[np.float64]
    directions: NDArray[np.float64]
    scale: float

    @property
    def deviations(self) -> NDArray[np.float64]:
        """Standard deviation along each direction."""
        with np.errstate(divide="ignore"):
            deviations: NDArray[np.float64] = self.scale / self.singular_values
        return deviations


def shrunk_covariance(samples: NDArray[np.float64]) -> NDArray[np.float64]:
    """Covariance of columns from few rows, correlations shrunk towards zero.

    Source: Schaefer and Strimmer, Stat. Appl. Genet. Mol. Biol. 4 (2005), 32, target D: the share of
    shrinkage is the sum of the variances of the correlations over the sum of their squares.

    Parameters
    ----------
    samples : ndarray, shape (rows, columns)
        One row gives no covariance: zeros.
    """
    count, size = samples.shape
    if count < 2:
        return np.zeros((size, size))
    centred = samples - samples.mean(axis=0)
    deviation = np.sqrt((centred**2).sum(axis=0) / (count - 1))
    if count < 4:
        return np.diag(deviation**2)
    standard = np.divide(centred, deviation, out=np.zeros_like(centred), where=deviation > 0.0)
    products = standard[:, :, None] * standard[:, None, :]
    correlation = products.sum(axis=0) / (count - 1)
    variance = count / (count - 1) ** 3 * ((products - products.mean(axis=0)) ** 2).sum(axis=0)
    beside = ~np.eye(size, dtype=bool)
    squares = float((correlation[beside] ** 2).sum())
    share = 1.0 if squares == 0.0 else min(1.0, max(0.0, float(variance[beside].sum()) / squares))
    shrunk = (1.0 - share) * correlation
    np.fill_diagonal(shrunk, 1.0)
    covariance: NDArray[np.float64] = shrunk * np.outer(deviation, deviation)
    return covariance


def level_covariance(
    std: NDArray[np.float64], over_seeds: NDArray[np.float64], averaged: int
) -> NDArray[np.float64]:
    """Covariance (dB^2) of measured minus computed levels.

    Parameters
    ----------
    std : ndarray, shape (values,)
        Of the measurement (dB).
    over_seeds : ndarray, shape (seeds, values)
        Computed levels (dB).
    averaged : int
        Number of seeds whose mean is compared: the mean of few is not the mean of all.
    """
    return np.diag(std**2) + (1.0 + 1.0 / averaged) * shrunk_covariance(over_seeds)


def whitener(covariance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the symmetric inverse root: residuals become independent, and each stays by its value."""
    values, vectors = np.linalg.eigh(covariance)
    root: NDArray[np.float64] = (vectors / np.sqrt(values)) @ vectors.T
    return root


def uncertainty(jacobian: NDArray[np.float64], residual: NDArray[np.float64]) -> Spread:
    """Uncertainty from whitened jacobian, shape (values, keys), and residuals, shape (values,).

    Residuals that exceed their standard deviations widen it (Birge's ratio); smaller ones do not narrow it.
    """
    count, keys = jacobian.shape
    left = count - keys
    scale = 1.0 if left <= 0 else max(1.0, math.sqrt(float(residual @ residual) / left))
    _, singular_values, directions = np.linalg.svd(jacobian, full_matrices=True)
    values = np.zeros(keys)
    values[: len(singular_values)] = singular_values
    tiny = 1e-9 * max(float(values.max(initial=0.0)), 1e-300)
    inverse = np.where(values > tiny, 1.0 / np.maximum(values, tiny), 1e9)
    covariance = scale**2 * (directions.T * inverse**2) @ directions
    return Spread(covariance, values, directions, scale)


def widened(spread: Spread, growth: NDArray[np.float64]) -> Spread:
    """Return the uncertainty with each direction's deviation as levels really change along it.

    Near a resonance levels bend: slopes at the solution alone claim too much on the flatter side.

    Parameters
    ----------
    spread : Spread
        From slopes.
    growth : ndarray, shape (keys,)
        Square of the weighted change of the levels over what slopes predict, one deviation away along each
        direction, on the side where it is smaller. What exceeds 1 narrows nothing.
    """
    factor = 1.0 / np.clip(growth, 1.0 / _WIDEST**2, 1.0)
    scaled = (spread.directions @ spread.covariance @ spread.directions.T) * np.sqrt(np.outer(factor, factor))
    covariance = spread.directions.T @ scaled @ spread.directions
    return Spread(covariance, spread.singular_values, spread.directions, spread.scale)


def determined(one: Free, deviation: float) -> bool:
    """Whether a key is known to a factor of two, or to a quarter of the width of its bounds."""
    return deviation < (FACTOR_OF_TWO if one.log else _QUARTER)


def at_bound(one: Free, value: float) -> str:
    """Return ``"low"``, ``"high"`` or nothing."""
    place = one.coordinate(value)
    low, high = one.coordinate(one.low), one.coordinate(one.high)
    near = _AT * (high - low)
    return "low" if place - low < near else "high" if high - place < near else ""


def remarks(
    free: Sequence[Free], spread: Spread, values: Sequence[float], fitted: int
) -> list[str]:  # fmt: skip
    """Say what the data cannot distinguish, what is at a bound, and what they cannot determine."""
    said = []
    names = [one.key for one in free]
    if fitted < 3 * len(free):
        keys = "key" if len(free) == 1 else "keys"
        left = "nothing is left over that could contradict them" if fitted <= len(free) else (
            "little is left over that could contradict them"
        )  # fmt: skip
        said.append(
            f"{fitted} fitted values carry {fitted // 3} free keys, three each, and {len(free)} {keys} are "
            f"free: the result repeats the values, {left}"
        )
    if spread.scale > 1.2:
        said.append(
            f"residuals are {spread.scale:.1f} times what the standard deviations of data and seeds allow: "
            "the uncertainties are widened by that, and the model may lack something"
        )
    deviations = np.sqrt(np.diag(spread.covariance))
    for one, value in zip(free, values, strict=True):
        side = at_bound(one, value)
        if side:
            said.append(
                f"{one.key} is at its {side} bound, {one.low if side == 'low' else one.high:g}: the best "
                "value may lie beyond, and its uncertainty is not an interval about it"
            )
    known = [determined(one, float(d)) for one, d in zip(free, deviations, strict=True)]
    for k, direction in enumerate(spread.directions):
        deviation = float(spread.deviations[k])
        if deviation < FACTOR_OF_TWO:
            continue
        parts = [i for i in np.argsort(-np.abs(direction)) if abs(direction[i]) > _NAMED]
        if len(parts) == 1:
            said.append(f"the data do not determine {names[parts[0]]}: {_reach(free[parts[0]], deviation)}")
        else:
            said.append(
                f"the data do not distinguish {' and '.join(names[i] for i in parts)}: "
                f"{_together(names, direction, parts)} changes no level by more than its uncertainty, over a "
                f"factor of {_factor(deviation)} either way"
            )
    said += _pairs(names, spread.covariance, known)
    return said


def _pairs(names: Sequence[str], covariance: NDArray[np.float64], known: Sequence[bool]) -> list[str]:
    """Sentences on pairs of determined keys that move the levels in the same way."""
    deviation = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(deviation, deviation)
    sentences = []
    for i in range(len(names)):
        for k in range(i):
            if abs(correlation[i, k]) >= _ALIKE and known[i] and known[k]:
                way = "trade against each other" if correlation[i, k] < 0.0 else "rise and fall together"
                sentences.append(
                    f"{names[k]} and {names[i]} {way} (correlation {correlation[i, k]:+.2f}): both are known "
                    "less well than one would be with the other fixed"
                )
    return sentences


def _reach(one: Free, deviation: float) -> str:
    if one.log:
        return f"a factor of {_factor(deviation)} either way changes no level by more than its uncertainty"
    return "no value within its bounds changes a level by more than its uncertainty"


def _factor(deviation: float) -> str:
    return f"{math.exp(deviation):.2g}" if deviation < 10.0 else "any size"


def _together(names: Sequence[str], direction: NDArray[np.float64], parts: Sequence[int]) -> str:
    """Words for a combination: which go up, which go down."""
    sign = np.sign(direction[parts[0]])
    up = [names[i] for i in parts if sign * direction[i] > 0.0]
    down = [names[i] for i in parts if sign * direction[i] < 0.0]
    return f"raising {' and '.join(up)}" + (f" while lowering {' and '.join(down)}" if down else " together")
