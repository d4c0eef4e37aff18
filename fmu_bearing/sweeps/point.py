"""One point of a sweep: a run of a scene from its steady state, and its figures over a window."""

import functools
import hashlib
import itertools
import json
import math
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import U
from fmu_bearing.files import plain_file
from fmu_bearing.prepare.accelerometers import sensor_blocks
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.run.figures import code_digest, parts_of, rows_over, values_of
from fmu_bearing.run.metrics import SAMPLE
from fmu_bearing.run.paces import COMMUNICATION
from fmu_bearing.scene import Scene
from fmu_bearing.sweeps.figures import error_motions, figures_of

#: Sound block of each bearing; a single empty one without sound.
Blocks = tuple[NDArray[np.float64], ...]


@dataclass(frozen=True)
class Task:
    """Input of a worker for one point.

    Attributes
    ----------
    key : str
        Of scene, settings and code: equal keys give equal figures.
    scene : Scene
    settle, window : float
        Time (s) left out, and over which figures are taken.
    figures : tuple of str
    sound : Scene or None
        A scene of the sweep with the same sound block; None: no sound.
    code : str
        Digest of the code that is to run it.
    """

    key: str
    scene: Scene
    settle: float
    window: float
    figures: tuple[str, ...]
    sound: Scene | None
    code: str


@dataclass(frozen=True)
class Outcome:
    """Result of a point.

    Attributes
    ----------
    figures : tuple of float
        In the order of the task's; NaN where there is none.
    reason : str
        Why there are no figures; empty: there are.
    wall : float
        Seconds it took.
    lasting : bool
        Whether another try would give the same result; False after the loss of a worker.
    """

    figures: tuple[float, ...]
    reason: str = ""
    wall: float = math.nan
    lasting: bool = True


#: What runs a task; on a cluster it is given the sound blocks, too.
Run = Callable[..., Outcome]


def nothing(task: Task, reason: str, wall: float = math.nan, *, lasting: bool = False) -> Outcome:
    """Return an outcome without figures."""
    return Outcome((math.nan,) * len(task.figures), reason, wall, lasting)


def task_of(
    scene: Scene, settle: float, window: float, figures: tuple[str, ...], sound: Scene | None
) -> Task:  # fmt: skip
    """Return the task of a scene; its key names scene, settings and code."""
    key = key_of(scene, settle, window, figures)
    return Task(key, scene, settle, window, figures, sound, code_digest())


def key_of(scene: Scene, *settings: Any) -> str:
    """Return the key of a run: of scene, settings and code."""
    parts = [scene.model_dump(mode="json"), *settings, code_digest()]
    if scene.sound is not None and scene.sound.table_file is not None:
        parts.append(_content(scene.sound.table_file))
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:24]


def run_point(task: Task, blocks: Blocks | None = None) -> Outcome:
    """Run one point; where that fails the outcome has the reason.

    ``blocks``: the sound blocks, where they came with the task; default: from this machine's cache.
    """
    begin = clock.perf_counter()
    if task.code != code_digest():
        return nothing(task, f"the worker has other code ({code_digest()}) than the sweep ({task.code})")
    try:
        figures = _measured(task, blocks_of(task.sound) if blocks is None else blocks)
    except (ValueError, ArithmeticError) as refusal:
        reason = " ".join(str(refusal).split())
        return nothing(task, reason, clock.perf_counter() - begin, lasting=True)
    return Outcome(figures, "", clock.perf_counter() - begin)


def _measured(task: Task, sounds: Blocks) -> tuple[float, ...]:
    scene = task.scene
    read = any(name.startswith("accelerometer[") for name in task.figures)
    sensors = sensor_blocks(scene) if read and scene.accelerometers else None
    bearing = Arrays.sensing(scene, sounds, sensors, METERING_START=task.settle).init()
    if task.settle > 0.0:
        steps = math.ceil(task.settle / COMMUNICATION)
        bearing.run(task.settle, task.settle / steps)
    there = figures_of(scene, task.figures, strict=False)  # an axis may remove the cage or a ball
    count = max(4, round(task.window / SAMPLE)) * parts_of(there)
    h = task.window / count
    rows = rows_over(bearing, there, itertools.repeat(h, count))
    figures = values_of(there, rows, h, bearing.u[U.SPEED]) | error_motions(there, scene)
    return tuple(figures.get(name, math.nan) for name in task.figures)


@functools.lru_cache(maxsize=2)
def blocks_of(scene: Scene | None) -> Blocks:
    """Sound blocks of a scene, kept in this process and on this machine's disk; one empty without scene."""
    return (np.empty(0),) if scene is None else tuple(sound_blocks(scene))


def _content(path: str) -> str:
    try:
        return hashlib.sha256(plain_file(path).read_bytes()).hexdigest()
    except OSError:
        return "not read"
