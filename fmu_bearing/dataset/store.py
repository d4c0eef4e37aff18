"""Finished runs on disk, each with scene, labels and waveforms in a file of its own that is written whole."""

import hashlib
import json
import pathlib
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.dataset.run import RunOutcome, size_of
from fmu_bearing.files import read_arrays, whole
from fmu_bearing.sweeps.point import Outcome, Task

FOLDER = "runs"


class Runs:
    """Outcomes by key under a folder, as `sweeps.store.Store` keeps points.

    Memory holds labels alone: `read` gives the waveforms of one run.
    """

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder / FOLDER
        self.folder.mkdir(parents=True, exist_ok=True)

    def has(self, task: Task) -> bool:
        """Whether there is a file of a run, which `load` may refuse."""
        return self._path(task).is_file()

    def load(self, task: Task) -> RunOutcome | None:
        """Return the kept outcome of a run without its waveforms, or None."""
        try:
            run, kept = self._read(task)
            if kept.size != (0 if run["reason"] else size_of(task)):
                return None
            return RunOutcome((), str(run["reason"]), float(run["wall_s"]), True, dict(run["labels"]))
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return None

    def keep(self, task: Task, outcome: Outcome) -> Outcome:
        """Write a run, unless another try may give another result; return it without its waveforms."""
        if not outcome.lasting:
            return outcome
        done = outcome if isinstance(outcome, RunOutcome) else RunOutcome((), outcome.reason, outcome.wall)
        kept = np.empty((0, 0), np.float32) if done.waveforms is None else done.waveforms
        run = {
            "key": task.key, "code": task.code, "scene": done.scene or task.scene.to_toml(),
            "labels": done.labels, "reason": done.reason, "wall_s": done.wall, "waveforms": _digest(kept),
        }  # fmt: skip
        with whole(self._path(task)) as file:
            np.savez(file, head=np.array(json.dumps({"check": _check(run), "run": run})), waveforms=kept)
        return replace(done, scene="", waveforms=None)

    def read(self, task: Task) -> tuple[str, NDArray[np.float32]]:
        """Return scene (TOML) and waveforms of a run that is kept, shape (sensors, samples), or of size 0.

        Raises
        ------
        ValueError
            For a file that is damaged.
        OSError
            Where there is none.
        """
        run, kept = self._read(task)
        return str(run["scene"]), kept

    def _read(self, task: Task) -> tuple[dict[str, Any], NDArray[np.float32]]:
        arrays = read_arrays(self._path(task), ["head", "waveforms"])
        head, kept = json.loads(str(arrays["head"])), arrays["waveforms"]
        run: dict[str, Any] = head["run"]
        if head["check"] != _check(run) or run["key"] != task.key or run["waveforms"] != _digest(kept):
            raise ValueError(f"{self._path(task)}: is damaged")
        return run, kept

    def _path(self, task: Task) -> pathlib.Path:
        return self.folder / f"{task.key}.npz"


def _check(run: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(run, sort_keys=True).encode()).hexdigest()[:16]


def _digest(waveforms: NDArray[np.float32]) -> str:
    return hashlib.sha256(waveforms.tobytes()).hexdigest()[:16]
