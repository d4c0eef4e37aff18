"""One run of a data set: the waveforms of its sensors, and the labels that the run itself gives."""

import math
import time as clock
import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.dataset.plan import RATE
from fmu_bearing.dataset.sensors import margin, radiation_model_of, resampled, sensors_of, signals
from fmu_bearing.engine.sources import rooms_digest
from fmu_bearing.recording.record import record
from fmu_bearing.recording.recording import Recording
from fmu_bearing.scene import Scene
from fmu_bearing.sweeps.point import Outcome, Task, code_digest, key_of, nothing

Label = float | int | str
_RESTARTS = "solver.restarts"


@dataclass(frozen=True)
class RunTask(Task):
    """Input of a worker for one run; its ``figures`` are the names of the sensors."""

    rate: int = RATE


@dataclass(frozen=True)
class RunOutcome(Outcome):
    """Result of a run.

    Attributes
    ----------
    labels : dict
        By name, with the unit.
    scene : str
        The scene as TOML; empty: it is on disk.
    waveforms : ndarray of float32, shape (sensors, samples), or None
        None: they are on disk.
    """

    labels: dict[str, Label] = field(default_factory=dict)
    scene: str = ""
    waveforms: NDArray[np.float32] | None = None


def task_of(scene: Scene, settle: float, length: float, rate: int, sensors: tuple[str, ...]) -> RunTask:
    """Return the task of a scene; its key names scene, settings and code."""
    key = key_of(scene, settle, length, rate, sensors, rooms_digest("dataset"))
    return RunTask(key, scene, settle, length, sensors, None, code_digest(), rate)


def samples(length: float, rate: int) -> int:
    """Return the samples of a waveform."""
    return round(length * rate)


def size_of(task: Task) -> int:
    """Return the numbers that the waveforms of a run have together."""
    assert isinstance(task, RunTask)
    return len(task.figures) * samples(task.window, task.rate)


def run(task: RunTask, blocks: Any = None) -> Outcome:
    """Run one scene; where that fails the outcome has the reason. ``blocks``: none, for a cluster's sake."""
    begin = clock.perf_counter()
    if task.code != code_digest():
        return nothing(task, f"the worker has other code ({code_digest()}) than the set ({task.code})")
    try:
        labels, waveforms = computed(task.scene, task.settle, task.window, task.rate, task.figures)
    except (ValueError, ArithmeticError) as refusal:
        reason = " ".join(str(refusal).split())
        return nothing(task, reason, clock.perf_counter() - begin, lasting=True)
    return RunOutcome((), "", clock.perf_counter() - begin, True, labels, task.scene.to_toml(), waveforms)


def computed(
    scene: Scene, settle: float, length: float, rate: int, sensors: tuple[str, ...]
) -> tuple[dict[str, Label], NDArray[np.float32]]:
    """Return labels and waveforms of a scene, by one `record`, whose samples are taken inside the engine."""
    units = sensors_of(scene, sensors)
    size, more = samples(length, rate), margin(rate)
    counts = [f"defect[{k}].passages" for k in range(1, defects_of(scene) + 1)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # the layout has said it once
        recording = record(
            scene, (math.ceil(length * RATE) + 2 * more) / RATE,
            settle=(round(settle * RATE) - more) / RATE, radiation_model=radiation_model_of(scene, units),
            outputs=counts, warn=False, progress=False,
        )  # fmt: skip
        read = signals(recording, units)
    kept = resampled(read, rate, size)
    if not np.isfinite(kept).all():
        raise ArithmeticError("the waveforms are not finite")
    labels = measured(recording) | passages(recording, counts, settle, length)
    return labels | shapes(units, kept), kept


def defects_of(scene: Scene) -> int:
    """Return the number of local defects of a scene."""
    return 0 if scene.imperfections is None else len(getattr(scene.imperfections, "defect", ()))


def measured(recording: Recording) -> dict[str, Label]:
    """Return frequencies (Hz) as the bearings turned, and restarts of the solver."""
    scene = recording.scene
    assert scene is not None
    labels = dict[str, Label]()
    for bearing, turned in zip(scene.bearings(), recording.bearing_kinematics(), strict=True):
        labels |= {f"{bearing.prefix}{name}_Hz": value for name, value in turned._asdict().items()}
    return labels | {_RESTARTS: int(recording.outputs[_RESTARTS][-1])}


def passages(recording: Recording, counts: list[str], settle: float, length: float) -> dict[str, Label]:
    """Return how many balls passed each defect while the waveforms were taken."""
    ends = np.searchsorted(recording.output_time, (settle, settle + length), side="right") - 1
    return {name: int(np.subtract(*recording.outputs[name][ends[::-1]])) for name in counts}


def shapes(units: dict[str, str], waveforms: NDArray[np.float32]) -> dict[str, Label]:
    """Return rms about the mean, largest amount and kurtosis (3: Gaussian) of each waveform as it is kept."""
    labels: dict[str, Label] = {}
    for (name, unit), one in zip(units.items(), waveforms.astype(np.float64), strict=True):
        about = one - one.mean()
        square = float(np.mean(about**2))
        labels[f"rms.{name} [{unit}]"] = math.sqrt(square)
        labels[f"peak.{name} [{unit}]"] = float(np.abs(about).max())
        labels[f"kurtosis.{name}"] = float(np.mean(about**4)) / square**2 if square > 0.0 else math.nan
    return labels
