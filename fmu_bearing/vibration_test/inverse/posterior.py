"""Draws of the law that explain measured bands and lines: importance sampling.

Unknown are ln A_1, the exponent p and ln B, the form of the balls, each evenly within its bounds. Hidden are
the factors of the orders, the axes of the balls and how much the bending of the rings adds. For each draw of
all else the likelihood is known on a grid of ln A_1: its sum is the weight of the draw, and A_1 is drawn from
it. Exponents come from a first round of few draws. Where lines were measured, draws are chosen from many by
their strong orders first (importance resampling: Rubin 1988).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_ndtr

from fmu_bearing.prepare.imperfections import order_energies
from fmu_bearing.vibration_test.inverse.energies import Energies

#: Bounds of the exponent.
EXPONENTS = (0.9, 2.1)
DRAWS = 40_000
_KEPT = 1000  # equally likely draws that are returned
_FIRST = 6000  # draws of the first round
_POOL = 400_000  # draws among which lines choose
_STRONG = 0.01  # share of a window from which on an order counts as strong
_CHUNK = 4000  # draws at a time: some 30 MB
_EVEN = 0.2  # share of the draws that is even, whatever the first round says
_AROUND = 2.0  # times the standard deviation of the first round: that of proposed exponents
_STEP = 1.0 / 3.0  # of the grid of ln A_1, over the least standard deviation
_SEED = 20_151  # of all draws: the same question has the same answer


class Value(NamedTuple):
    """A measured value: rms velocity (um/s), its relative standard deviation, whether it is a limit."""

    velocity: float
    deviation: float
    at_most: bool = False


class Prior(NamedTuple):
    """Bounds of what is unknown: A_1 (um), exponent, form of the balls (nm)."""

    amplitude_um: tuple[float, float]
    ball_form_nm: tuple[float, float]
    exponent: tuple[float, float] = EXPONENTS


class Draws(NamedTuple):
    """Equally likely draws, each array of shape (draws,), and how they came about.

    Attributes
    ----------
    amplitude_um, exponent, ball_form_nm : ndarray
    seed, scatter : ndarray of int
        Of the balls, of the orders.
    effective : float
        How many independent draws these are worth.
    best : float
        Least sum of squared deviations over standard deviations of any draw.
    misfit : ndarray, shape (values,)
        Its deviations in ln: model over measured.
    """

    amplitude_um: NDArray[np.float64]
    exponent: NDArray[np.float64]
    ball_form_nm: NDArray[np.float64]
    seed: NDArray[np.int64]
    scatter: NDArray[np.int64]
    effective: float
    best: float
    misfit: NDArray[np.float64]


class _Proposed(NamedTuple):
    """Draws of all but A_1, with the logarithm of their prior over their proposal."""

    exponent: NDArray[np.float64]
    form: NDArray[np.float64]
    seed: NDArray[np.int64]
    bent: NDArray[np.int64]
    scatter: NDArray[np.int64]
    correction: NDArray[np.float64]

    def at(self, places: slice | NDArray[np.int64]) -> "_Proposed":
        """Return some of the draws."""
        return _Proposed(
            self.exponent[places], self.form[places], self.seed[places], self.bent[places],
            self.scatter[places], self.correction[places],
        )  # fmt: skip


class _Weighed(NamedTuple):
    """Logarithms of the weights, A_1 drawn for each, least chi^2 and the misfit there."""

    weight: NDArray[np.float64]
    amplitude: NDArray[np.float64]
    best: float
    misfit: NDArray[np.float64]


def posterior(
    energies: Energies, values: Sequence[Value], prior: Prior, scatter: bool = True, draws: int = DRAWS
) -> Draws:
    """Return draws that explain measured values.

    Parameters
    ----------
    found : Energies
        Its windows are those of the values.
    values : sequence of Value
    prior : Prior
    scatter : bool
        Whether orders scatter about the law.
    draws : int
        How many are weighed.
    """
    rng = np.random.default_rng(_SEED)
    first = _proposed(energies, prior, rng, min(_FIRST, draws))
    seen = _weighed(energies, values, prior, scatter, first, rng, lines=False)
    share = _shares(seen.weight + first.correction)
    middle = float(share @ first.exponent)
    width = _AROUND * float(np.sqrt(share @ (first.exponent - middle) ** 2)) + 0.02
    lines = any(name not in "LMH" for name in energies.names)
    propose = _chosen if lines and scatter else _proposed_around
    second = propose(energies, values, prior, rng, draws, (middle, width))
    weighed = _weighed(energies, values, prior, scatter, second, rng)
    share = _shares(weighed.weight + second.correction)
    # systematic resampling (Kitagawa 1996): evenly spaced numbers through the sums of the weights
    chosen = np.searchsorted(np.cumsum(share), (rng.uniform() + np.arange(_KEPT)) / _KEPT)
    chosen = rng.permutation(np.minimum(chosen, draws - 1))
    return Draws(
        weighed.amplitude[chosen], second.exponent[chosen], second.form[chosen], second.seed[chosen],
        second.scatter[chosen], float(1.0 / np.sum(share**2)), weighed.best, weighed.misfit,
    )  # fmt: skip


def _shares(weight: NDArray[np.float64]) -> NDArray[np.float64]:
    relative = np.exp(weight - weight.max())
    return relative / relative.sum()


def _proposed(
    energies: Energies, prior: Prior, rng: np.random.Generator, count: int,
    around: tuple[float, float] | None = None,
) -> _Proposed:  # fmt: skip
    """Draw all but A_1: the exponent evenly, or most of them from a normal distribution."""
    low, high = prior.exponent
    even = rng.uniform(low, high, count)
    if around is None:
        exponent, correction = even, np.zeros(count)
    else:
        middle, width = around
        normal = rng.normal(middle, width, count)
        exponent = np.where(rng.uniform(size=count) < _EVEN, even, normal)
        density = np.exp(-0.5 * ((exponent - middle) / width) ** 2) / (width * np.sqrt(2.0 * np.pi))
        proposal = _EVEN / (high - low) + (1.0 - _EVEN) * density
        inside = (exponent >= low) & (exponent <= high)
        correction = np.where(inside, -np.log(proposal * (high - low)), -np.inf)
    least, most = np.log(prior.ball_form_nm)
    form = np.exp(rng.uniform(float(least), float(most), count))
    return _Proposed(
        exponent, form, rng.integers(energies.seeds, size=count),
        rng.integers(energies.bending.shape[1], size=count), np.arange(count), correction,
    )  # fmt: skip


def _proposed_around(
    energies: Energies, values: Sequence[Value], prior: Prior, rng: np.random.Generator, count: int,
    around: tuple[float, float],
) -> _Proposed:  # fmt: skip
    return _proposed(energies, prior, rng, count, around)


def _chosen(
    energies: Energies, values: Sequence[Value], prior: Prior, rng: np.random.Generator, count: int,
    around: tuple[float, float],
) -> _Proposed:  # fmt: skip
    """Choose draws of which lines and bands are about as measured, from many, by their strong orders alone.

    Few scatter seeds agree with a line. The weak orders of a band count with their mean.
    """
    pool = _proposed(energies, prior, rng, _POOL, around)
    weighed = _weighed(energies.strong(around[0], _STRONG), values, prior, True, pool, rng, step=1.0)
    share = _EVEN / _POOL + (1.0 - _EVEN) * _shares(weighed.weight + pool.correction)
    chosen = rng.choice(_POOL, count, p=share / share.sum())
    drawn = pool.at(chosen)
    return drawn._replace(correction=drawn.correction - np.log(share[chosen] * _POOL))


def _weighed(
    energies: Energies, values: Sequence[Value], prior: Prior, scatter: bool, drawn: _Proposed,
    rng: np.random.Generator, lines: bool = True, step: float = _STEP,
) -> _Weighed:  # fmt: skip
    """Weigh draws, each over a grid of ln A_1, and draw A_1; without ``lines`` by the bands alone."""
    used = [k for k, name in enumerate(energies.names) if lines or name in "LMH"]
    least = min((values[k].deviation for k in used), default=1.0)
    low, high = np.log(prior.amplitude_um)
    grid = np.linspace(low, high, int(np.ceil((high - low) / (step * least))) + 1)
    measured = np.log([values[k].velocity for k in used])
    best, misfit = np.inf, np.zeros(len(values))
    weights, amplitudes = [], []
    for begin in range(0, len(drawn.exponent), _CHUNK):
        part = drawn.at(slice(begin, begin + _CHUNK))
        factors = (
            [order_energies(part.scatter[:, None], race, orders)
             for race, orders in enumerate((energies.inner_orders, energies.outer_orders))]
            if scatter else [1.0, 1.0]
        )  # fmt: skip
        races = energies.races(part.exponent, *factors)[:, used]
        balls = (energies.forms(part.exponent, part.seed, part.bent) * part.form[:, None] ** 2)[:, used]
        likelihood = np.zeros((len(part.exponent), grid.size))
        for column, k in enumerate(used):
            energy = np.exp(2.0 * grid) * races[:, column, None] + balls[:, column, None]
            off = (0.5 * np.log(np.maximum(energy, 1e-12)) - measured[column]) / values[k].deviation
            likelihood += log_ndtr(-off) if values[k].at_most else -0.5 * off**2
        top = likelihood.max(axis=1)
        inside = np.isfinite(part.correction)
        if -2.0 * top[inside].max(initial=-np.inf) < best:
            row = int(np.where(inside, top, -np.inf).argmax())
            best = float(-2.0 * top[row])
            energy = np.exp(2.0 * grid[likelihood[row].argmax()]) * races[row] + balls[row]
            misfit[used] = 0.5 * np.log(energy) - measured
        sums = np.cumsum(np.exp(likelihood - top[:, None]), axis=1)
        weights.append(top + np.log(sums[:, -1]))
        cells = (sums < rng.uniform(size=(len(top), 1)) * sums[:, -1:]).sum(axis=1)
        jitter = rng.uniform(-0.5, 0.5, len(top)) * (grid[1] - grid[0])
        amplitudes.append(np.exp(np.clip(grid[cells] + jitter, low, high)))
    return _Weighed(np.concatenate(weights), np.concatenate(amplitudes), best, misfit)
