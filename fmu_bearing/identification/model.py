"""Computed levels for values of the free keys: one run per condition and seed."""

import hashlib
import math
import pathlib
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import SD
from fmu_bearing.identification.data import Datum
from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.identification.free import Free, scene_values
from fmu_bearing.identification.quantities import LINE
from fmu_bearing.identification.run_cache import RunCache
from fmu_bearing.identification.sensors import Sensors
from fmu_bearing.prepare.sound_block import sound_key
from fmu_bearing.recording.channels.sources import bodies_of
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.run.figures import THIRD_OCTAVE, code_digest
from fmu_bearing.scene import Scene

_TURNS = 8  # of the shaft in a run, at least: lines of the shaft are separate
_LENGTH = 0.1  # s, at least
_BINS = 6  # in a third octave, at least
_SETTLE = {"response": 0.03, "rings": 0.04}  # s: response is steady from the start, the high-pass is not
_SETTLE_FULL = 0.05  # s
_STEP = 4e-3  # s: inputs are held, so long steps cost nothing but the history of the channels
_THIRD = 0.23  # width of a third octave over its centre


class Levels:
    """Levels that a scene gives at the measured places.

    Parameters
    ----------
    scene : Scene
        With a fidelity that is not ``auto``.
    data : sequence of Datum
    free : sequence of Free
    duration, settle : float, optional
        In s.
    folder : Path, optional
        Where runs are kept.
    workers : int
        Threads.
    finished_run : callable
        Called after each new run.

    Attributes
    ----------
    runs : int
        Runs computed, kept ones left out.
    """

    def __init__(
        self, scene: Scene, data: Sequence[Datum], free: Sequence[Free], *, duration: float | None = None,
        settle: float | None = None, folder: pathlib.Path | None = None, workers: int = 1,
        finished_run: Callable[[], None] = lambda: None,
    ) -> None:  # fmt: skip
        self.scene, self.data, self.free, self.workers, self.finished_run = (
            scene,
            data,
            free,
            workers,
            finished_run,
        )
        self.cache = RunCache(folder)
        self.groups: dict[tuple[tuple[str, float], ...], list[int]] = {}
        for place, row in enumerate(data):
            self.groups.setdefault(row.conditions, []).append(place)
        self.duration, self.settle = duration or self._length(), settle
        self.background = 10.0 ** (np.array([row.background for row in data]) / 10.0)
        self.runs = 0
        self._sensors: dict[str, Sensors] = {}
        self._lock = threading.Lock()

    def _length(self) -> float:
        """Length (s) of a run: turns of the shaft, and bins in the narrowest band."""
        own = self.scene.operation.speed_rpm
        speeds = [dict(group).get("operation.speed_rpm", own) for group in self.groups]
        slowest = min(abs(speed) for speed in speeds) / 60.0
        bands = [row.quantity.frequency for row in self.data if row.quantity.kind == THIRD_OCTAVE]
        turns = _TURNS / slowest if any(row.quantity.kind == LINE for row in self.data) and slowest else 0.0
        return max(_LENGTH, min(turns, 1.0), *(_BINS / (_THIRD * band) for band in bands), 0.0)

    def at(
        self, x: NDArray[np.float64], seeds: Sequence[int], fidelity: str, check: bool = False
    ) -> NDArray[np.float64]:
        """Levels (dB) without background, shape (seeds, values); NaN where the scene cannot be run.

        Conditions under which nothing is fitted are run with ``check`` only, and have NaN otherwise.
        """
        values = scene_values(self.free, x)
        asked = [group for group, rows in self.groups.items() if check or any(self.data[k].fit for k in rows)]
        jobs = [(k, seed, group) for k, seed in enumerate(seeds) for group in asked]
        computed = np.full((len(seeds), len(self.data)), np.nan)

        def run(job: tuple[int, int, tuple[tuple[str, float], ...]]) -> tuple[float, ...]:
            return self._run(values | dict(job[2]), job[1], fidelity, self.groups[job[2]])

        if self.workers == 1:
            rows = [run(job) for job in jobs]
        else:
            with ThreadPoolExecutor(self.workers) as pool:
                try:
                    rows = list(pool.map(run, jobs))
                except KeyboardInterrupt:
                    pool.shutdown(cancel_futures=True)
                    raise
        for (k, _, group), levels in zip(jobs, rows, strict=True):
            computed[k, self.groups[group]] = levels
        return computed

    def with_background(self, raw: NDArray[np.float64], offset: NDArray[np.float64]) -> NDArray[np.float64]:
        """Levels (dB) with an offset (dB) of the bearing's sound, and the background, shape of ``raw``."""
        return np.asarray(10.0 * np.log10(10.0 ** ((raw + offset) / 10.0) + self.background))

    def scene_at(self, x: NDArray[np.float64]) -> Scene:
        """Return the scene with the values of the free keys, conditions as they were.

        Raises
        ------
        SceneError
            Where the values are refused.
        """
        return self.scene.replace(scene_values(self.free, x))

    def _run(
        self, values: dict[str, float], seed: int, fidelity: str, places: Sequence[int]
    ) -> tuple[float, ...]:
        rows = [self.data[k] for k in places]
        try:
            drawn = {} if self.scene.imperfections is None else {"imperfections.seed": seed}
            scene = self.scene.replace(values | drawn | {"fidelity.model": fidelity})
        except ValueError:  # a combination that no scene may have
            return (math.nan,) * len(rows)
        settle = self._settle(fidelity)
        key = self._key(scene, rows, settle)
        levels = self.cache.get(key)
        if levels is None:
            try:
                levels = tuple(map(float, self._measure(scene, rows, settle)))
            except (ValueError, ArithmeticError):
                levels = (math.nan,) * len(rows)
            self.cache.put(key, levels)
            with self._lock:
                self.runs += 1
            self.finished_run()
        return levels

    def reason(self, x: NDArray[np.float64], seed: int, fidelity: str) -> str:
        """Why levels cannot be computed, in words; empty: they can."""
        for group, places in self.groups.items():
            try:
                values = scene_values(self.free, x) | dict(group)
                scene = self.scene.replace(values | {"fidelity.model": fidelity})
                self._measure(scene, [self.data[k] for k in places], self._settle(fidelity))
            except (ValueError, ArithmeticError) as problem:
                where = ", ".join(f"{key} = {value:g}" for key, value in group)
                return f"{where}: {problem}" if where else str(problem)
        return ""

    def _settle(self, fidelity: str) -> float:
        return _SETTLE.get(fidelity, _SETTLE_FULL) if self.settle is None else self.settle

    def _measure(self, scene: Scene, rows: Sequence[Datum], settle: float) -> NDArray[np.float64]:
        made = record(scene, self.duration, settle=settle, step=_STEP, progress=False, warn=False)
        return self._sensors_of(scene, made).levels(made, rows)

    def _sensors_of(self, scene: Scene, made: Recording) -> Sensors:
        """Paths of the geometry: made once, as boundary elements take seconds."""
        key = f"{sound_key(scene)} {[bearing.position for bearing in scene.bearings()]} {bodies_of(scene)}"
        with self._lock:
            if key not in self._sensors:
                if len(self._sensors) > 2:  # a free geometry: few are needed again
                    self._sensors.pop(next(iter(self._sensors)))
                self._sensors[key] = Sensors(made, self.data)
            return self._sensors[key]

    def _key(self, scene: Scene, rows: Sequence[Datum], settle: float) -> str:
        asked = [(row.position, row.quantity.text) for row in rows]
        text = f"{scene.model_dump_json()} {asked} {self.duration} {settle} {code_digest()}"
        return hashlib.sha256(text.encode()).hexdigest()[:24]


def check_length(duration: float | None, settle: float | None) -> None:
    """Refuse lengths (s) that make no run."""
    for name, value, low in (("duration", duration, 64.0 / SD.RATE), ("settle", settle, 0.0)):
        if value is not None and not (math.isfinite(value) and low <= value <= 60.0):
            raise IdentifyError(f"{name} = {value} s lies outside {low:.3g} to 60 s")
