"""Samples of several ranges at once and the indices of what a figure rests on, by SALib.

Both methods work on shares of the ranges, 0 to 1, so that Morris's effects are in the figure's own unit per
whole range. A *sample* is a block of points that SALib evaluates together: a trajectory of Morris, or a row
of Saltelli's matrices with all of its exchanges.
"""

import warnings
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.extras import need
from fmu_bearing.sweeps.axes import SweepError

Method = Literal["morris", "sobol"]
METHODS: tuple[str, ...] = get_args(Method)
#: Samples where none are asked for: 10 to 50 trajectories are usual (Campolongo et al., 2007), Sobol's
#: sequence is balanced at powers of two; 64 give a first ranking.
SAMPLES = {"morris": 16, "sobol": 64}
#: The least that has a spread to speak of (assumed); more than the most would take days.
LEAST, MOST = 4, 65536
#: Names of the indices of each method, importance first.
INDICES = {"morris": ("mu_star", "mu_star_conf", "mu", "sigma"), "sobol": ("ST", "ST_conf", "S1", "S1_conf")}
CONFIDENCE = 0.95
_LEVELS = 4  # of Morris's grid, SALib's default
_RESAMPLES = 1000  # of the bootstrap: its half-width is then good to some per cent
_ROUNDING = 1e-9  # relative: a figure that moves by less does not change
_PURPOSE = "sensitivity over several values at once"


def check(method: str, samples: int | None, seed: int = 1) -> int:
    """Return the number of samples after all three are checked.

    Raises
    ------
    SweepError
        For another method, a number out of range, or one that is no power of two for Sobol's sequence.
    MissingExtra
        Without SALib (extra ``salib``).
    """
    if method not in METHODS:
        raise SweepError(f"method = '{method}' is refused: allowed are {' and '.join(METHODS)}")
    count = SAMPLES[method] if samples is None else samples
    if not LEAST <= count <= MOST:
        raise SweepError(f"samples = {count} is refused: allowed are {LEAST} to {MOST}")
    if method == "sobol" and count & (count - 1):
        near = 1 << count.bit_length()
        raise SweepError(
            f"samples = {count} is refused: Sobol's sequence is balanced at powers of two, as {near // 2} "
            f"and {near}"
        )
    if seed < 1:
        raise SweepError(f"seed = {seed} is refused: give 1 or more")
    need("SALib", _PURPOSE)
    return count


def block(method: str, keys: int) -> int:
    """Return the number of points of one sample."""
    return keys + (1 if method == "morris" else 2)


def shares(method: str, samples: int, keys: int, seed: int) -> NDArray[np.float64]:
    """Return points as shares of the ranges, shape (samples * block, keys), 0 to 1.

    Source: Morris (1991), 4 levels; Saltelli (2010) on Sobol's scrambled sequence, without second order.
    """
    if method == "morris":
        sample = need("SALib.sample.morris", _PURPOSE).sample
        return np.asarray(sample(_problem(keys), samples, num_levels=_LEVELS, seed=seed))
    sample = need("SALib.sample.sobol", _PURPOSE).sample
    return np.asarray(sample(_problem(keys), samples, calc_second_order=False, seed=seed))


def indices(
    method: str, points: NDArray[np.float64], values: NDArray[np.float64], seed: int
) -> tuple[dict[str, NDArray[np.float64]], int]:
    """Return the indices of one figure by `INDICES`, each of shape (keys,), and how many samples are whole.

    A sample with a point that has no value is left out whole.

    Parameters
    ----------
    points : ndarray, shape (samples * block, keys)
        As `shares` gives them.
    values : ndarray, shape (samples * block,)
        The figure at these points; NaN: it has none there.

    Returns
    -------
    dict
        NaN everywhere where fewer than `LEAST` samples are whole; 0 where the figure does not change.
    """
    keys = points.shape[1]
    size = block(method, keys)
    whole = np.isfinite(values.reshape(-1, size)).all(axis=1)
    kept = np.repeat(whole, size)
    x, y = points[kept], values[kept]
    count = int(whole.sum())
    if count < LEAST:
        return {name: np.full(keys, np.nan) for name in INDICES[method]}, count
    if np.ptp(y) <= _ROUNDING * np.abs(y).max():
        return {name: np.zeros(keys) for name in INDICES[method]}, count
    more: dict[str, Any] = {"num_resamples": _RESAMPLES, "conf_level": CONFIDENCE, "seed": seed}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of resamples that hold one value alone: their spread is 0
        if method == "morris":
            analysis = need("SALib.analyze.morris", _PURPOSE).analyze(
                _problem(keys), x, y, num_levels=_LEVELS, **more
            )
        else:
            analysis = need("SALib.analyze.sobol", _PURPOSE).analyze(
                _problem(keys), y, calc_second_order=False, **more
            )
    return {name: np.asarray(analysis[name], dtype=np.float64) for name in INDICES[method]}, count


def _problem(keys: int) -> dict[str, Any]:
    """Return what SALib calls a problem: so many shares."""
    names = [f"x{k}" for k in range(keys)]
    return {"num_vars": keys, "names": names, "groups": names, "bounds": [[0.0, 1.0]] * keys}
