"""Sensitivity of a scene's figures to several of its values at once, by Morris's or Sobol's method.

Where `accuracy.sensitivity` moves one value at a time about the scene, here all vary together over ranges:
what two values do jointly counts, too. Points are those of a sweep: each is a run from its own steady state.
"""

import os
import pathlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.results.base import Study
from fmu_bearing.results.table import Table, machine, markdown
from fmu_bearing.run.figures import Figure
from fmu_bearing.scene import SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.sweeps import sampling
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.plan import SETTLE, WINDOW, Plan, plan_of
from fmu_bearing.sweeps.ranges import Range, ranges_of
from fmu_bearing.sweeps.runs import Outcomes, run_plan
from fmu_bearing.sweeps.store import Store

#: Heads of the table by method, in the order of `sampling.INDICES`.
COLUMNS = {
    "morris": ("figure", "unit", "key", "mu*", "+- of mu*", "mu", "sigma"),
    "sobol": ("figure", "unit", "key", "total", "+- of total", "first order", "+- of first"),
}
_MEANING = {
    "morris": (
        "mu* is the mean size of the change of the figure, in its unit, when the key moves through its whole "
        "range; mu the mean with its sign; sigma its spread, which is large where the effect is curved or "
        "depends on the other keys. Morris (1991), mu* by Campolongo et al. (2007)."
    ),
    "sobol": (
        "First order is the share of the figure's variance that the key makes alone, total the share in "
        "which it has a part; the difference is made jointly with other keys. Sobol (2001), estimators by "
        "Saltelli et al. (2010)."
    ),
}


@dataclass(frozen=True)
class Layout:
    """A study before it runs.

    Attributes
    ----------
    method : str
        ``morris`` or ``sobol``.
    samples : int
        Trajectories of Morris, or rows of Sobol's sequence.
    seed : int
        Of the samples.
    ranges : tuple of Range
    shares : ndarray, shape (points, keys)
        The points as shares of the ranges.
    plan : Plan
        The same points as runs.
    """

    method: str
    samples: int
    seed: int
    ranges: tuple[Range, ...]
    shares: NDArray[np.float64]
    plan: Plan


@dataclass(frozen=True)
class GlobalSensitivity(Study):
    """Indices of the figures of one scene, SI units.

    Attributes
    ----------
    layout : Layout
        What was asked for.
    values : ndarray, shape (points, figures)
        The figures at all points; NaN where there are none.
    indices : dict
        By name of `sampling.INDICES`: arrays of shape (figures, keys). ``mu_star``, ``mu`` and ``sigma`` in
        the figure's unit per whole range, ``S1`` and ``ST`` as shares; ``_conf`` is half the width of the
        95 % confidence interval, from resamples. NaN where too few samples are whole, 0 where the figure
        does not change.
    complete : tuple of int
        Per figure: samples that the indices rest on.
    reasons : tuple of str
        Why points have no figures, each once.
    """

    quantities = "method = layout.method", "samples [1] = layout.samples", "conditions", "remarks"
    stem = "sensitivity"

    layout: Layout
    values: NDArray[np.float64]
    indices: dict[str, NDArray[np.float64]]
    complete: tuple[int, ...]
    reasons: tuple[str, ...] = ()

    @property
    def keys(self) -> tuple[str, ...]:
        """Dotted keys that vary."""
        return tuple(one.key for one in self.layout.ranges)

    @property
    def figures(self) -> tuple[Figure, ...]:
        """What is read of each run."""
        return self.layout.plan.figures

    def ranked(self, figure: str) -> list[tuple[str, float]]:
        """Return the keys with the index that ranks them, ``mu_star`` or ``ST``, the largest first."""
        place = [one.name for one in self.figures].index(figure)
        index = self.indices[sampling.INDICES[self.layout.method][0]][place]
        order = np.argsort(-index, kind="stable")
        return [(self.keys[k], float(index[k])) for k in order]

    def table(self) -> Table:
        """Return `COLUMNS` of the method and texts: per figure a row per key, the most important first."""
        names = sampling.INDICES[self.layout.method]
        rows = []
        for place, figure in enumerate(self.figures):
            for key, _ in self.ranked(figure.name):
                at = self.keys.index(key)
                numbers = [_shown(float(self.indices[name][place, at])) for name in names]
                rows.append([figure.name, figure.unit, key, *numbers])
        return list(COLUMNS[self.layout.method]), rows

    def conditions(self) -> str:
        """Say in words what was run."""
        made, plan = self.layout, self.layout.plan
        count = len({task.key for task in plan.tasks})
        ranges = "; ".join(one.words() for one in made.ranges)
        return (
            f"All as in the scene ({plan.scene.operation.speed_rpm:,.0f} r/min) but for: {ranges}. "
            f"Method {made.method}, {made.samples} samples, {count} runs of fidelity "
            f"{plan.scene.fidelity.model}, read over {1e3 * plan.window:g} ms after {1e3 * plan.settle:g} ms."
        )

    def remarks(self) -> list[str]:
        """Say what the indices lack: samples that are left out, figures that do not change."""
        sentences = []
        fewest = min(self.complete)
        if fewest < self.layout.samples:
            sentences.append(
                f"figures rest on {fewest} of {self.layout.samples} samples at least: in the others a point "
                "has no figure" + ("" if not self.reasons else f" ({'; '.join(self.reasons[:3])})")
            )
        first = self.indices[sampling.INDICES[self.layout.method][0]]
        still = [figure.name for figure, row in zip(self.figures, first, strict=True) if not row.any()]
        if still:
            sentences.append(f"not changed by any of the keys: {', '.join(still)}")
        return sentences

    def markdown(self) -> str:
        """Return the study as a page."""
        made = self.layout
        words = [f"{line[0].upper()}{line[1:]}." for line in self.remarks()]
        head = (
            f"Made by `fmu-bearing sensitivity --method {made.method}`. {self.conditions()} "
            f"{_MEANING[made.method]} Behind +-: half the width of the 95 % confidence interval, from "
            f"resamples of the {made.samples} samples. Figures in SI units."
        )
        title = f"# What figures rest on: {made.plan.scene.name}"
        table = markdown(*self.table())
        return "\n\n".join([title, machine(), " ".join([head, *words]), table])


def _shown(value: float) -> str:
    return f"{value:.3g}" if np.isfinite(value) else ""


def lay_out(
    source: SceneSource,
    vary: Mapping[str, Sequence[float] | str],
    method: str,
    samples: int | None = None,
    settle: float = SETTLE,
    window: float = WINDOW,
    figures: Sequence[str] | None = None,
    seed: int = 1,
) -> Layout:
    """Check a study and lay out its points; the parameters are those of `global_sensitivity`."""
    count = sampling.check(method, samples, seed)
    scene = scene_of(source)
    require(scene, "sensitivity")
    ranges = ranges_of(scene, vary)
    shares = sampling.shares(method, count, len(ranges), seed)
    columns = [one.at(shares[:, k]) for k, one in enumerate(ranges)]
    points = list(zip(*columns, strict=True))
    made = plan_of(scene, tuple(one.axis for one in ranges), points, settle, window, figures)
    return Layout(method, count, seed, ranges, shares, made)


def evaluated(layout: Layout, outcomes: Outcomes) -> GlobalSensitivity:
    """Return the indices from the outcomes of all points.

    Raises
    ------
    SweepError
        Where too few samples are whole for any figure, with the reasons of the points.
    """
    rows = [outcomes[task.key] for task in layout.plan.tasks]
    values = np.array([row.figures for row in rows], dtype=np.float64)
    indices = [sampling.indices(layout.method, layout.shares, column, layout.seed) for column in values.T]
    reasons = tuple(dict.fromkeys(row.reason for row in rows if row.reason))
    complete = tuple(count for _, count in indices)
    if max(complete) < sampling.LEAST:
        raise SweepError(
            f"{max(complete)} of {layout.samples} samples have figures at all points, which is too few: "
            "narrow the ranges" + ("" if not reasons else f"; points were refused: {'; '.join(reasons[:3])}")
        )
    names = sampling.INDICES[layout.method]
    table = {name: np.array([one[name] for one, _ in indices]) for name in names}
    return GlobalSensitivity(layout, values, table, complete, reasons)


def global_sensitivity(
    source: SceneSource,
    vary: Mapping[str, Sequence[float] | str],
    *,
    method: str = "morris",
    samples: int | None = None,
    settle: float = SETTLE,
    window: float = WINDOW,
    figures: Sequence[str] | None = None,
    seed: int = 1,
    folder: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: bool | None = None,
) -> GlobalSensitivity:
    """Vary several values of a scene at once over ranges, and rank what each figure rests on.

    Parameters
    ----------
    source : Scene or path
        Runs have its fidelity; ``auto`` is resolved once, for the scene as it is.
    vary : mapping
        Two ranges or more by dotted key of the scene or short name, as the axes of `sweep`: lower and upper
        end in the key's unit, or text such as ``"8000..20000"`` and ``"1e7..1e8log"``.
    method : str
        ``morris``, a cheap ranking, with samples * (keys + 1) runs; or ``sobol``, shares of the variance,
        with samples * (keys + 2) runs.
    samples : int, optional
        4 to 65,536, for ``sobol`` a power of two. Default: 16 and 64.
    settle, window, figures, folder, workers, scheduler, progress
        As `sweep` has them.
    seed : int
        Of the samples, 1 or more; the scene's own seed of its imperfections is not changed by it.

    Returns
    -------
    GlobalSensitivity
        Indices with confidence. Samples with a point that cannot be run are left out whole.

    Raises
    ------
    ValueError
        For what is refused, all reported before anything is run (`SweepError`, `SceneError`), and where too
        few samples can be run.
    MissingExtra
        Without SALib (extra ``salib``).
    Stopped
        On Ctrl-C, a `KeyboardInterrupt`; finished points are in the folder.

    Notes
    -----
    Sources: Morris (1991), Technometrics 33, 161; Saltelli et al. (2010), Computer Physics Communications
    181, 259; both as computed by SALib.

    Examples
    --------
    >>> from fmu_bearing import global_sensitivity, read_scene, with_fidelity
    >>> scene = with_fidelity(read_scene("examples/scenes/7003C-bare.toml"), model="rings")
    >>> found = global_sensitivity(
    ...     scene.replace({"sound": None}),
    ...     {"preload": (200, 500), "bearing.ball_roughness_um": "0.005..0.02"},
    ...     samples=4,
    ...     settle=0.0,
    ...     window=0.001,
    ...     figures=["contact.inner.load_mean"],
    ...     workers=1,
    ... )
    >>> [key for key, _ in found.ranked("contact.inner.load_mean")]
    ['mounting.preload_N', 'bearing.ball_roughness_um']
    """
    if scheduler is not None:
        from fmu_bearing.sweeps.cluster import checked

        checked(scheduler)
    if workers is not None and workers < 1:
        raise SweepError(f"workers = {workers} is refused: give 1 or more")
    layout = lay_out(source, vary, method, samples, settle, window, figures, seed)
    store = None if folder is None else Store(pathlib.Path(folder))
    return evaluated(layout, run_plan(layout.plan, store, workers, scheduler, progress))
