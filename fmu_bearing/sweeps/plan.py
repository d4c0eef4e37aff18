"""The points of a sweep, which are all checked before the first is run."""

import itertools
import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from fmu_bearing.extras import BENDING, need
from fmu_bearing.prepare.sound_block import sound_key
from fmu_bearing.run.choose import resolve
from fmu_bearing.run.figures import Figure
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of
from fmu_bearing.scene.values import value_at
from fmu_bearing.scene.words import is_loose, loose_words
from fmu_bearing.sweeps.axes import Axis, SweepError, axes_of
from fmu_bearing.sweeps.figures import figures_of
from fmu_bearing.sweeps.point import Task, task_of

SETTLE = 0.02  # s
WINDOW = 0.1  # s: 33 turns at 20,000 r/min
_MOST = 20  # lines of a refusal


@dataclass(frozen=True)
class Plan:
    """All points of a sweep, or of a study that samples ranges.

    Attributes
    ----------
    scene : Scene
        The varied scene, with fidelity ``auto`` resolved.
    axes : tuple of Axis
    settle, window : float
        In s.
    figures : tuple of Figure
    tasks : tuple of Task
        One per point; of a sweep with the last axis fastest.
    note : str
        How fidelity ``auto`` was resolved, and why.
    """

    scene: Scene
    axes: tuple[Axis, ...]
    settle: float
    window: float
    figures: tuple[Figure, ...]
    tasks: tuple[Task, ...]
    note: str = ""

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis of a sweep."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def sounds(self) -> tuple[Scene, ...]:
        """Scenes whose sound is prepared, once each."""
        return tuple(dict.fromkeys(task.sound for task in self.tasks if task.sound is not None))


def plan(
    source: SceneSource,
    axes: Mapping[str, Sequence[Any] | str],
    settle: float = SETTLE,
    window: float = WINDOW,
    figures: Sequence[str] | None = None,
) -> Plan:
    """Check a sweep and lay out its points.

    Raises
    ------
    SweepError
        With a line for each key, value and combination that is refused.
    SceneError
        For a scene file that is refused.
    UnknownName
        For an unknown figure.
    MissingExtra
        Where a ring bends, without scikit-fem.
    """
    scene = scene_of(source)
    sweep_axes = axes_of(scene, axes)
    points = list(itertools.product(*(axis.values for axis in sweep_axes)))
    return plan_of(scene, sweep_axes, points, settle, window, figures)


def plan_of(
    scene: Scene,
    axes: tuple[Axis, ...],
    points: Sequence[Sequence[Any]],
    settle: float,
    window: float,
    figures: Sequence[str] | None,
) -> Plan:
    """Check given points of a scene and lay them out.

    Parameters
    ----------
    axes : tuple of Axis
        What is varied.
    points : sequence of sequence
        The values of the axes at each point, in the keys' units. Equal points have equal tasks.

    Raises
    ------
    SweepError, UnknownName, MissingExtra
        As `plan`.
    """
    _check_times(settle, window)
    note = ""
    if "fidelity.model" not in {axis.key for axis in axes}:
        scene, choice = resolve(scene)
        note = "" if choice is None else choice.words()
    scenes = varied(scene, [{a.key: v for a, v in zip(axes, point, strict=True)} for point in points])
    if any(one.bends for one in scenes):
        need("skfem", BENDING)  # reported once, and not as the reason of every point
    for model in dict.fromkeys(one.fidelity.model for one in scenes if is_loose(one)):
        warnings.warn(loose_words(model), stacklevel=3)  # once, and not by each worker
    kept = figures_of(scene, figures)
    names = tuple(figure.name for figure in kept)
    first: dict[str, Scene] = {}  # the first scene of all with the same sound
    tasks = []
    for one in scenes:
        silent = one.sound is None or not one.microphones
        sound = None if silent else first.setdefault(sound_key(one), one)
        tasks.append(task_of(one, settle, window, names, sound))
    return Plan(scene, axes, settle, window, kept, tuple(tasks), note)


def varied(scene: Scene, points: Sequence[Mapping[str, Any]]) -> list[Scene]:
    """Return the scene of each point, whose values are given by dotted key.

    Raises
    ------
    SweepError
        With all refusals, each once.
    """
    scenes: list[Scene] = []
    problems = [
        f"{key}: the scene has no table [{table}]; add it to vary what it holds"
        for key in dict.fromkeys(key for point in points for key in point)
        if (table := key.rpartition(".")[0]) and value_at(scene, table) is None
    ]
    if problems:
        raise SweepError("\n".join(problems))
    for chosen in points:
        if chosen.get("fidelity.model") == "auto":
            problems.append(
                "fidelity.model = 'auto' is refused as a value of an axis: it is decided by timing; give "
                "full, rings or response"
            )
            continue
        try:
            scenes.append(scene.replace(chosen))
        except SceneError as problem:
            problems += [line.removeprefix(f"{scene.name}: ") for line in problem.problems]
    lines = list(dict.fromkeys(problems))
    if lines:
        more = [f"and {len(lines) - _MOST} more"] if len(lines) > _MOST else []
        raise SweepError("\n".join([*lines[:_MOST], *more]))
    return scenes


def _check_times(settle: float, window: float) -> None:
    if not (math.isfinite(settle) and 0.0 <= settle <= 1e3):
        raise SweepError(f"settle = {settle} s is refused: allowed are 0 to 1000 s")
    if not (math.isfinite(window) and 1e-3 <= window <= 1e3):
        raise SweepError(f"window = {window} s is refused: allowed are 0.001 to 1000 s")


__all__ = ["SETTLE", "WINDOW", "Plan", "SceneError", "plan", "plan_of", "varied"]
