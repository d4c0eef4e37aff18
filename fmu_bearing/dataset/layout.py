"""All runs of a data set, checked before the first is run."""

import math
from dataclasses import dataclass

from fmu_bearing.dataset.draw import DEFECTS, Drawn, drawn
from fmu_bearing.dataset.plan import Plan
from fmu_bearing.dataset.run import RunTask, task_of
from fmu_bearing.dataset.sensors import sensors_of
from fmu_bearing.extras import BENDING, need
from fmu_bearing.recording.channels.sources import air_of
from fmu_bearing.run.choose import resolve
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.values import value_at
from fmu_bearing.scene.words import is_loose, loose_words
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.plan import varied

_FIDELITY, _SPEED, _SEED = "fidelity.model", "operation.speed_rpm", "imperfections.seed"
#: What loads the bearings, of one and of a set: columns of the labels where the scene has them.
_LOADS = (
    "mounting.preload_N", "mounting.radial_load_y_N", "mounting.radial_load_z_N",
    "spindle.preload.preload_N", "spindle.preload.force_N",
    "spindle.load.force_x_N", "spindle.load.force_y_N", "spindle.load.force_z_N",
)  # fmt: skip


@dataclass(frozen=True)
class Layout:
    """A data set before it runs.

    Attributes
    ----------
    plan : Plan
    scene : Scene
        What the runs are drawn from, with fidelity ``auto`` resolved.
    sensors : dict
        Unit of each sensor by name.
    runs : tuple of Drawn
    tasks : tuple of RunTask
        One per run; runs that are equal have equal tasks.
    notes : tuple of str
        What to know about the draws.
    """

    plan: Plan
    scene: Scene
    sensors: dict[str, str]
    runs: tuple[Drawn, ...]
    tasks: tuple[RunTask, ...]
    notes: tuple[str, ...] = ()

    @property
    def sounds(self) -> tuple[Scene, ...]:
        """None: a recording has the sound of no microphone of its own."""
        return ()

    def columns(self) -> list[str]:
        """Return the keys of scenes that labels name: fidelity, speed, loads, seed, and what is drawn."""
        keys = dict.fromkeys((_FIDELITY, _SPEED, *_LOADS, _SEED))
        keys |= dict.fromkeys(key for run in self.runs for key in run.values if key != DEFECTS)
        scenes = [task.scene for task in self.tasks]
        there = [key for key in keys if any(value_at(scene, key) is not None for scene in scenes)]
        for scene in scenes:
            for k, defect in enumerate(value_at(scene, DEFECTS) or (), start=1):
                there += [f"{DEFECTS}[{k}].{name}" for name in defect.model_dump(exclude_none=True)]
        return list(dict.fromkeys(there))


def lay_out(plan: Plan, source: SceneSource | None = None) -> Layout:
    """Check a data set and lay out its runs; ``source``: in place of the plan's scene.

    Raises
    ------
    SweepError
        With a line for each key, value and combination that is refused.
    SceneError
        For a scene file that is refused.
    UnknownName
        For an unknown sensor.
    MissingExtra
        Where a ring bends, without scikit-fem.
    """
    scene = scene_of(plan.scene if source is None else source)
    require(scene, "recording")
    notes = []
    if _FIDELITY not in {key for one in plan.classes for key in plan.draw | one.draw}:
        scene, choice = resolve(scene)
        notes += [] if choice is None else [choice.words()]
    sensors = sensors_of(scene, plan.sensors)
    runs = drawn(plan, scene)
    scenes = varied(scene, [run.values for run in runs])
    if any(one.bends for one in scenes):
        need("skfem", BENDING)
    _check_flight(plan, scene, sensors)
    loose = dict.fromkeys(one.fidelity.model for one in scenes if is_loose(one))
    notes += [loose_words(model) for model in loose]
    names = tuple(sensors)
    tasks = tuple(task_of(one, plan.settle_s, plan.length_s, plan.rate_Hz, names) for one in scenes)
    if len(runs) > 1 and any(
        _SEED not in run.values and one.imperfections for run, one in zip(runs, scenes, strict=True)
    ):
        notes.append(
            f"the plan draws no {_SEED} for some runs: these have the same surfaces and ball sizes, as of "
            "one bearing"
        )
    return Layout(plan, scene, sensors, tuple(runs), tasks, tuple(notes))


def _check_flight(plan: Plan, scene: Scene, sensors: dict[str, str]) -> None:
    """Refuse a microphone that sound reaches only after what is left out."""
    for name, place in scene.microphones:
        flight = math.dist(place, (0.0, 0.0, 0.0)) / air_of(scene).sound_speed
        if name in sensors and flight > plan.settle_s:
            raise SweepError(
                f"settle_s = {plan.settle_s:g} is refused: sound takes {flight:.3g} s to microphone {name}; "
                "give more"
            )
