"""The search: bounded least squares on logarithms, from several starts, averaged over seeds.

1. From the scene and from places spread over the bounds, a search with one seed each: resonances make the
   misfit bumpy.
2. From the best, a search with all seeds, levels weighted by noise and by their spread over seeds.
3. Where the scene's own fidelity is another than the search's, the difference between both at the solution is
   added to every later level, and the search goes on, until the difference stays.
4. Direct runs in the scene's own fidelity give the levels that are reported.
"""

import math
import pathlib
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import qmc

from fmu_bearing.acoustics.analysis.field import form_of
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.identification.data import Datum
from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.identification.free import Free, box, scene_values, start_point
from fmu_bearing.identification.model import Levels, check_length
from fmu_bearing.identification.result import Compared, Estimate, Identified
from fmu_bearing.identification.statistics import (
    Spread,
    at_bound,
    determined,
    level_covariance,
    remarks,
    uncertainty,
    whitener,
    widened,
)
from fmu_bearing.progress import Stopped, work
from fmu_bearing.run.choose import resolve
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import Scene

PER_KEY = 3  # fitted values that one free key needs
_STEP = {"response": 0.02}  # of ln, or of the width of the bounds, for derivatives
_STEP_NOISY = 0.05  # where the integrator's error has to be drowned
_OUTSIDE = 2.0  # standard deviations from which soft_l1 counts a residual less
_LOST = 50.0  # standard deviations, in place of a level that cannot be computed
_SPREAD_SEEDS = 12  # for the covariance of levels
_APART = 0.05  # of a logarithm: ends of searches nearer than that are one
_TRIED = 8  # places per further start; the best of them start a search
_ROUGH = {"max_nfev": 8, "ftol": 1e-2, "xtol": 1e-2, "gtol": 1e-3}
_FINE = {"max_nfev": 12, "ftol": 1e-3, "xtol": 1e-3, "gtol": 1e-4}
_NEAR, _FAR = 0.05, 1.0  # deviations of ln or of the bounds between which levels may bend
_STAYS = 0.02  # of ln or of the bounds: the spread over seeds is the same
_CORRECTIONS = 3
_SETTLED = 0.2  # dB rms: the difference between fidelities stays


def search(
    scene: Scene, data: Sequence[Datum], free: Sequence[Free], *, fidelity: str | None, seeds: int,
    starts: int, duration: float | None, settle: float | None, few: bool, folder: pathlib.Path | None,
    workers: int, progress: bool | None,
) -> Identified:  # fmt: skip
    """Identify free numbers from data; see `fmu_bearing.identify`.

    Raises
    ------
    IdentifyError
        For settings that are refused, too few data, and a scene that cannot be run as it is.
    Stopped
        On Ctrl-C, with the best so far as ``state``.
    """
    for name, value in (("seeds", seeds), ("starts", starts), ("workers", workers)):
        if not (isinstance(value, int) and value >= 1):
            raise IdentifyError(f"{name} = {value} is refused: give 1 or more")
    check_length(duration, settle)
    check_count(sum(row.fit for row in data), len(free), few)
    model = "compact" if scene.sound is None else scene.sound.radiation_model
    if form_of(model) != "vectors" and any(row.quantity.channel is not None for row in data):
        raise IdentifyError(
            f'velocities cannot be computed beside radiation_model = "{model}", whose channels hold none: '
            "use bem or compact"
        )
    own = resolve(scene)[0]
    chosen = _fidelity(own, fidelity)
    # a search tries values that are never run again; warnings about the result appear when it is run
    with _bar(progress) as display, warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        levels = Levels(
            own, data, free, duration=duration, settle=settle, folder=folder, workers=workers,
            finished_run=display.ran,
        )  # fmt: skip
        state = _Search(levels, chosen, seeds, starts, display)
        try:
            return state.run()
        except KeyboardInterrupt:
            raise Stopped(state.interrupted()) from None


def check_count(fitted: int, free: int, few: bool) -> None:
    """Refuse fewer fitted values than the free keys need.

    Raises
    ------
    IdentifyError
        With the number of keys that the data carry.
    """
    if fitted < free:
        raise IdentifyError(
            f"{fitted} fitted values cannot determine {free} free keys: free at most {fitted}, or measure "
            "more"
        )
    if fitted < PER_KEY * free and not few:
        carried = fitted // PER_KEY
        fewer = f"free {carried} of them" if carried else "measure more"
        raise IdentifyError(
            f"{fitted} fitted values carry {carried} free keys ({PER_KEY} values each), and {free} are free: "
            f"{fewer}{', measure more' if carried else ''}, or allow it knowingly with few=True (--few): the "
            "result then repeats the values rather than explaining them"
        )


def _fidelity(scene: Scene, wanted: str | None) -> str:
    """Fidelity of the search."""
    if wanted is None:
        return "response" if Setting("response").carries(scene) else "full"
    if wanted not in FIDELITIES:
        raise IdentifyError(f"fidelity '{wanted}' is unknown: there are {', '.join(FIDELITIES)}")
    if against := Setting(wanted).against(scene):
        raise IdentifyError(f"fidelity '{wanted}' does not compute this scene: {against}; use full")
    return wanted


@dataclass
class _Best:
    """Best point so far."""

    x: NDArray[np.float64]
    cost: float = math.inf
    computed: NDArray[np.float64] | None = None


class _Search:
    """State of one search."""

    def __init__(self, levels: Levels, fidelity: str, seeds: int, starts: int, display: "_Display") -> None:
        self.levels, self.fidelity, self.starts, self.display = levels, fidelity, starts, display
        self.own = levels.scene.fidelity.model
        self.free, self.data = levels.free, levels.data
        flaws = levels.scene.imperfections
        first = 0 if flaws is None else flaws.seed
        step = levels.scene.seeds_apart
        every = tuple(range(first, first + step * max(seeds, _SPREAD_SEEDS), step))
        self.more = every[:1] if flaws is None else every
        self.seeds = self.more[:seeds]
        self.value = np.array([row.value for row in self.data])
        self.std = np.array([row.std for row in self.data])
        self.fit = np.array([row.fit for row in self.data])
        self.low, self.high = box(self.free)
        self.offset = np.zeros(len(self.data))
        self.white = np.diag(1.0 / self.std[self.fit])
        self.weighed: NDArray[np.float64] | None = None
        self.start = self._inside(start_point(self.free))
        self.best = _Best(self.start)
        self.before = np.full(len(self.data), np.nan)
        self.rivals: list[NDArray[np.float64]] = []

    def run(self) -> Identified:
        """Search and report."""
        self.display.say("the scene as it is")
        self.before = self._mean(self.start, self.seeds, self.own, check=True)
        self._require(self.before, self.own)
        self._require(self._mean(self.start, self.seeds[:1])[self.fit], self.fidelity)
        self._weigh(self.start)
        ends = self._from_several_starts()
        x = ends[0]
        for number in range(_CORRECTIONS):
            self.display.say(f"all seeds, round {number + 1}")
            self._weigh(x)
            if number:
                x = self._descend(x, self.seeds, **_FINE)
            else:
                x, *self.rivals = self._ranked(ends)
            if self.own == self.fidelity:
                if number:
                    break
                continue
            if self._correct(x) < _SETTLED and number:
                break
        return self._report(x)

    def _from_several_starts(self) -> list[NDArray[np.float64]]:
        """Different ends of rough searches with one seed, the best first, no more than three."""
        tries = [self.start]
        if self.starts > 1:
            self.display.say("places within the bounds")
            tries += self._promising(self.starts - 1)
        ends = []
        for number, x in enumerate(tries):
            self.display.say(f"start {number + 1} of {len(tries)}")
            end = self._descend(x, self.seeds[:1], **_ROUGH)
            ends.append((self._cost(end, self.seeds), number, end))
        return _distinct([end for _, _, end in sorted(ends, key=lambda one: one[:2])])[:3]

    def _ranked(self, ends: Sequence[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
        """Return the ends of searches with all seeds from these places, the best first."""
        ranked = [self._descend(end, self.seeds, **_ROUGH) for end in ends]
        return _distinct(sorted(ranked, key=lambda end: self._cost(end, self.seeds)))

    def _rivals(self, x: NDArray[np.float64], spread: Spread) -> list[str]:
        """Sentences on other solutions that the data do not rule out at two standard deviations."""
        deviations = np.sqrt(np.diag(spread.covariance))
        here, said = self._cost(x, self.seeds), []
        for other in self.rivals:
            far = np.abs(other - x) > 2.0 * deviations
            if far.any() and self._cost(other, self.seeds) < here + 2.0 * spread.scale**2:
                values = ", ".join(
                    f"{one.key} = {one.value(at):.3g}"
                    for one, at, moved in zip(self.free, other, far, strict=True)
                    if moved
                )
                said.append(
                    f"another solution fits nearly as well: {values}. The intervals are about the better "
                    "one; measure at a further speed to distinguish them"
                )
        return said

    def _promising(self, count: int) -> list[NDArray[np.float64]]:
        """Return the best of places spread over the middle of the bounds.

        Where amplitudes are free, a common difference in dB costs nothing: the first step takes it away.
        """
        size = 2 ** math.ceil(math.log2(_TRIED * count))
        unit = qmc.Sobol(len(self.free), scramble=False).fast_forward(1).random(size)  # the first is a corner
        places = self.low + (0.2 + 0.6 * unit) * (self.high - self.low)
        levelled = any(key.startswith("imperfections.") for one in self.free for key in one.keys)
        costs = []
        for x in places:
            residual = self._residual(x, self.seeds[:1])
            costs.append(float(np.sum((residual - levelled * residual.mean()) ** 2)))
        return [places[k] for k in np.argsort(costs)[:count]]

    def _descend(self, x: NDArray[np.float64], seeds: Sequence[int], **ends: Any) -> NDArray[np.float64]:
        result = least_squares(
            lambda at: self._residual(at, seeds), self._inside(x), lambda at: self._slopes(at, seeds),
            (self.low, self.high), loss="soft_l1", f_scale=_OUTSIDE, **ends,
        )  # fmt: skip
        return np.asarray(result.x)

    def _mean(
        self, x: NDArray[np.float64], seeds: Sequence[int], fidelity: str | None = None, check: bool = False
    ) -> NDArray[np.float64]:
        """Mean level (dB) over seeds of every value; of checked ones too if asked for."""
        fidelity = fidelity or self.fidelity
        offset = self.offset if fidelity == self.fidelity else np.zeros_like(self.offset)
        return np.asarray(
            self.levels.with_background(self.levels.at(x, seeds, fidelity, check), offset).mean(axis=0)
        )

    def _residual(self, x: NDArray[np.float64], seeds: Sequence[int]) -> NDArray[np.float64]:
        """Weighted residuals of the fitted values."""
        computed = self._mean(x, seeds)
        off = (computed - self.value)[self.fit]
        if np.isnan(off).any():
            return np.full(len(off), _LOST)
        residual: NDArray[np.float64] = self.white @ off
        if len(seeds) == len(self.seeds):
            cost = _soft(residual)
            self.display.misfit(float(np.sqrt(np.mean(off**2))))
            if cost < self.best.cost:
                self.best.x, self.best.cost, self.best.computed = x.copy(), cost, computed
        return residual

    def _cost(self, x: NDArray[np.float64], seeds: Sequence[int]) -> float:
        return _soft(self._residual(x, seeds))

    def _slopes(self, x: NDArray[np.float64], seeds: Sequence[int]) -> NDArray[np.float64]:
        """Weighted slopes of the fitted values, shape (values, keys)."""
        slopes = self._raw_slopes(x, seeds)[self.fit]
        return np.asarray(self.white @ np.nan_to_num(slopes))

    def _raw_slopes(self, x: NDArray[np.float64], seeds: Sequence[int]) -> NDArray[np.float64]:
        """Slopes (dB per unit of the coordinate) of all values, by differences, shape (values, keys)."""
        here = self._mean(x, seeds)
        step = _STEP.get(self.fidelity, _STEP_NOISY)
        columns = []
        for k in range(len(self.free)):
            way = step if x[k] + step <= self.high[k] else -step
            moved = x.copy()
            moved[k] += way
            columns.append((self._mean(moved, seeds) - here) / way)
        return np.column_stack(columns)

    def _weigh(self, x: NDArray[np.float64]) -> None:
        """Renew the weights of the levels: noise of the data, and spread over seeds at ``x``."""
        if self.weighed is not None and np.abs(x - self.weighed).max() < _STAYS:
            return
        self.weighed = x.copy()
        over = self.levels.with_background(self.levels.at(x, self.more, self.fidelity), self.offset)
        over = over[:, self.fit]
        over = over[~np.isnan(over).any(axis=1)]
        covariance = level_covariance(self.std[self.fit], over, len(self.seeds))
        self.white = whitener(covariance)
        self.best.cost = math.inf  # costs of other weights do not compare
        self._residual(x, self.seeds)

    def _correct(self, x: NDArray[np.float64]) -> float:
        """Renew the difference between the scene's fidelity and the search's; its change (dB rms)."""
        own = self.levels.at(x, self.seeds, self.own).mean(axis=0)
        new = own - self.levels.at(x, self.seeds, self.fidelity).mean(axis=0)
        self._require(new[self.fit], self.own, x)
        change = float(np.sqrt(np.mean((new - self.offset)[self.fit] ** 2)))
        self.offset = np.nan_to_num(new)  # of what is checked only, nothing is known nor needed
        return change

    def _require(
        self, levels: NDArray[np.float64], fidelity: str, x: NDArray[np.float64] | None = None
    ) -> None:
        if np.isnan(levels).any():
            reason = self.levels.reason(self.start if x is None else x, self.seeds[0], fidelity)
            where = "the scene as it is" if x is None else "the solution"
            raise IdentifyError(
                f"{where} cannot be run with fidelity {fidelity}: {reason or 'no reason found'}"
            )

    def _inside(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        margin = 1e-6 * (self.high - self.low)
        return np.clip(x, self.low + margin, self.high - margin)

    def _report(self, x: NDArray[np.float64]) -> Identified:
        self.display.say("uncertainty")
        self._weigh(x)
        slopes = np.nan_to_num(self._raw_slopes(x, self.seeds))
        after = self._mean(x, self.seeds, self.own, check=True)
        self._require(after, self.own, x)
        off = (after - self.value)[self.fit]
        spread = uncertainty(self.white @ slopes[self.fit], self.white @ off)
        spread = widened(spread, self._growth(x, spread))
        over = self.levels.with_background(
            self.levels.at(x, self.more, self.fidelity, check=True), self.offset
        )
        return self._identified(x, after, np.nanstd(over, axis=0, ddof=min(1, len(over) - 1)), slopes, spread)

    def _growth(self, x: NDArray[np.float64], spread: Spread) -> NDArray[np.float64]:
        """Square of the weighted change a deviation away over what slopes predict, on the smaller side."""
        here, growth = self._mean(x, self.seeds), np.ones(len(x))
        for k, direction in enumerate(spread.directions):
            deviation = min(float(spread.deviations[k]) / spread.scale, _FAR)
            if deviation < _NEAR:  # levels are straight there
                continue
            for way in (deviation, -deviation):
                there = self._inside(x + way * direction)
                part = float((there - x) @ direction) / way  # of the deviation, where a bound is near
                change = self.white @ (self._mean(there, self.seeds) - here)[self.fit]
                if part > 0.2 and np.isfinite(change).all():
                    expected = (part * deviation * spread.singular_values[k]) ** 2
                    growth[k] = min(growth[k], float(change @ change) / max(expected, 1e-12))
        return growth

    def interrupted(self) -> Identified:
        """Return the best so far; nothing more is run, and the uncertainty is unknown."""
        keys, values = len(self.free), len(self.data)
        unknown = np.full((keys, keys), np.nan)
        spread = Spread(unknown, np.full(keys, np.nan), unknown, 1.0)
        after = np.full(values, np.nan) if self.best.computed is None else self.best.computed
        slopes = np.full((values, keys), np.nan)
        return self._identified(self.best.x, after, np.full(values, np.nan), slopes, spread, complete=False)

    def _identified(
        self, x: NDArray[np.float64], after: NDArray[np.float64], over: NDArray[np.float64],
        slopes: NDArray[np.float64], spread: Spread, complete: bool = True,
    ) -> Identified:  # fmt: skip
        deviations = np.sqrt(np.diag(spread.covariance))
        values = [one.value(at) for one, at in zip(self.free, x, strict=True)]
        estimates = tuple(
            Estimate(
                one,
                value,
                float(deviation * one.scale),
                determined(one, float(deviation)),
                at_bound(one, value),
            )
            for one, value, deviation in zip(self.free, values, deviations, strict=True)
        )
        said = ["interrupted: the best values so far, their uncertainty is unknown"]
        if complete:
            said = remarks(self.free, spread, values, int(self.fit.sum())) + self._rivals(x, spread)
        said += [
            f"{one.key} is 0 in the scene: the search, and the values under 'before', begin in the middle "
            f"of its bounds, {one.start:.3g}"
            for one in self.free
            if one.guessed
        ]
        return Identified(
            self.levels.scene_at(x), self.levels.scene, estimates,
            tuple(Compared(*row) for row in zip(self.data, map(float, self.before), map(float, after),
                                                map(float, over), strict=True)),
            slopes[self.fit], spread.covariance, spread.singular_values, spread.directions, spread.scale,
            tuple(said), self.fidelity, self.seeds, self.levels.runs, complete, scene_values(self.free, x),
        )  # fmt: skip


def _distinct(places: Sequence[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
    """Return the places without those that lie beside an earlier one."""
    kept: list[NDArray[np.float64]] = []
    for place in places:
        if all(np.abs(place - other).max() > _APART for other in kept):
            kept.append(place)
    return kept


def _soft(residual: NDArray[np.float64]) -> float:
    """Cost of soft_l1, as `scipy.optimize.least_squares` has it."""
    return float(_OUTSIDE**2 * np.sum(np.sqrt(1.0 + (residual / _OUTSIDE) ** 2) - 1.0))


@dataclass
class _Display:
    """What is shown while a search runs."""

    say: Callable[[str], None]
    ran: Callable[[], None]
    misfit: Callable[[float], None]


@contextmanager
def _bar(shown: bool | None) -> Iterator[_Display]:
    """Show stage, number of runs, misfit now and at best."""
    with work("identify", unit="runs", shown=shown) as display:
        best = math.inf

        def misfit(rms: float) -> None:
            nonlocal best
            best = min(best, rms)
            display.at(display.done, f"{rms:.2f} dB rms, best {best:.2f} dB")

        yield _Display(display.named, lambda: display.at(display.done + 1.0), misfit)
