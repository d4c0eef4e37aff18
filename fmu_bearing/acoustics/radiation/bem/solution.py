"""Surface pressures of a scene's bodies over frequency, kept on disk, and what they sound like anywhere."""

import itertools
import os
import pathlib
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from fmu_bearing.acoustics.radiation.bem.band import Band
from fmu_bearing.acoustics.radiation.bem.rational import AT_ONCE, FIRST
from fmu_bearing.acoustics.radiation.bem.task import Task
from fmu_bearing.compiled.show import Display
from fmu_bearing.files import cache_root, read_arrays
from fmu_bearing.progress import work
from fmu_bearing.threads import cores

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

#: Frequencies (Hz) of one band per mesh: low frequencies need fewer elements. The ends bound the band; all
#: are solved where intervals are halved.
BASE_FREQUENCIES = (
    (20.0, 50.0, 100.0, 200.0, 350.0, 500.0, 750.0, *np.arange(1000.0, 6001.0, 1000.0)),
    tuple(np.arange(6000.0, 22_001.0, 1000.0)),
)


#: Wavelengths that a sphere round the bodies gains in one band at most: bands of larger bodies are cut, as
#: frequencies grow with wavelengths, and their time with the mesh. One band of 16 takes four times as long.
_WAVES = 10.0


def bases(task: Task) -> list[tuple[float, ...]]:
    """Frequencies (Hz) of all bands of a task: `BASE_FREQUENCIES`, cut evenly where bodies are large."""
    bands = []
    for base in BASE_FREQUENCIES:
        low, high = base[0], base[-1]
        parts = int(np.ceil(task.waves(low, high) / _WAVES))
        if parts <= 1:
            bands.append(tuple(base))
            continue
        for first, last in itertools.pairwise(np.linspace(low, high, parts + 1).tolist()):
            inner = [f for f in base if first < f < last]
            # four points at least: a cubic takes as many
            bands.append(tuple(np.union1d(inner, np.linspace(first, last, 4)).tolist()))
    return bands


#: Frequencies that the preparation of a band takes as long as: 0.8 to 1.7, up to 4 in bodies hardly larger
#: than their bearing, whose elements are short against their distance from each other.
_PREPARED = 1.5


class Solution:
    """A task solved in all bands, and the fields anywhere in the air."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.bands = [Band(task, base) for base in bases(task)]

    @property
    def points(self) -> Real:
        """Points (x, r) on the skins in m, shape (nodes, 2)."""
        return self.bands[-1].points

    def ball_drive(self, order: int, axis: int) -> int:
        """Place of the balls' drive of a circumferential order along x (0), r (1) or theta (2)."""
        return self.bands[0].ball_drive(order, axis)

    def transfer(self, points: Real, wanted: Real) -> Complex:
        """Pressures (Pa per unit of each drive, in air of 1 kg/m3) at points (x, r), at frequencies (Hz).

        Shape (points, drives, frequencies).
        """
        # where bands meet the lower one counts, which has the coarser mesh
        ends = [band.frequencies[-1] for band in self.bands[:-1]]
        band_of = np.searchsorted(ends, wanted)
        parts = [band.transfer(points, wanted[band_of == i]) for i, band in enumerate(self.bands)]
        return np.concatenate(parts, axis=2)


@lru_cache(maxsize=4)
def _remembered(key: str) -> list[Solution]:
    return []


def solution(task: Task) -> Solution:
    """Solution of a task: from memory, from disk, or solved now.

    Solutions are kept beside the compiled kernels, in the folder ``sound`` (`files.cache_root`).
    """
    key = task.key()
    known = _remembered(key)
    if known:
        return known[0]
    field_solution = Solution(task)
    if not task.baffled:  # faces in a rigid wall do not hear each other: nothing to solve
        path = cache_root() / "sound" / f"{key}.npz"
        if not _load(path, field_solution):
            _solve_all(field_solution)
            _save(path, field_solution)
    known.append(field_solution)
    return field_solution


def _solve_all(field_solution: Solution) -> None:
    """Solve all bands; frequencies are shared among the machine's cores."""
    names = " and ".join(body.name for body in field_solution.task.bodies)
    what = f"boundary elements of {names}, once for these bodies"
    # No more at a time than there are cores: each holds matrices of all orders, and the first would end late.
    workers = min(cores(), FIRST)
    with (
        work(what, elsewhere=True), Display(what) as display, threadpool_limits(1),
        ThreadPoolExecutor(workers) as pool,
    ):  # fmt: skip

        def solved() -> None:
            display.at(*progress(field_solution.bands, min(workers, AT_ONCE)))

        usual = [band.expected for band in field_solution.bands]
        for i, band in enumerate(field_solution.bands):
            band.search(pool, solved)
            _learn(field_solution.bands, usual, i + 1)


def _learn(bands: Sequence[Band], usual: Sequence[float], done: int) -> None:
    """Expect of the other bands what the first ones, ``done``, took over their ``usual`` number.

    Those of them whose intervals were halved say nothing.
    """
    known = [
        (band.done, number) for band, number in zip(bands[:done], usual, strict=False) if len(band.probed)
    ]
    if known:
        took, expected = np.sum(known, axis=0)
        for band, number in zip(bands[done:], usual[done:], strict=True):
            band.expect(number * took / expected)


def progress(bands: Sequence[Band], at_once: int) -> tuple[float, float]:
    """Part of the work that is done, and time (s) of the rest with so many frequencies ``at_once``.

    A band takes as long as its frequencies have so far; one that is not begun as the one before, by
    `Band.cost`. Its preparation counts as `_PREPARED` frequencies.
    """
    done = left = rest = unit = 0.0
    for band in bands:
        begun = bool(band.seconds)
        unit = float(np.mean(band.seconds)) / band.cost if begun else unit
        done += band.cost * (band.done + _PREPARED * begun)
        left += band.cost * (band.left + _PREPARED * (not begun))
        rest += unit * band.cost * (band.left / at_once + _PREPARED * (not begun))
    return done / (done + left), rest


_TABLES = ("frequencies", "surface", "probed")


def _load(path: pathlib.Path, field_solution: Solution) -> bool:
    try:
        kept = read_arrays(path)
        tables = [[kept[f"{name}{i}"] for name in _TABLES] for i in range(len(field_solution.bands))]
    except (OSError, ValueError, KeyError):
        return False  # absent or damaged: solve again
    for band, (frequencies, surface, probed) in zip(field_solution.bands, tables, strict=True):
        if surface.shape != (len(frequencies), *band.surface.shape[1:]) or not np.isfinite(surface).all():
            return False
        if probed.shape[1:3] != band.probed.shape[1:3] or len(probed) not in {0, len(frequencies)}:
            return False
        band.frequencies, band.surface, band.probed = frequencies, surface, probed
    return True


def _save(path: pathlib.Path, field_solution: Solution) -> None:
    """Keep a solution; a cache that cannot be written is no reason to fail."""
    tables: dict[str, Any] = {
        f"{name}{i}": getattr(band, name) for name in _TABLES for i, band in enumerate(field_solution.bands)
    }
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(f".{os.getpid()}.npz")
        np.savez(partial, **tables)
        partial.replace(path)
    except OSError:
        pass
