"""Levels of a scene and of its changes at one microphone, by short runs with the same seeds."""

import math
import warnings

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.cautions import in_doubt
from fmu_bearing.engine.constants import RPM
from fmu_bearing.modal.campbell.doubts import doubt, reason_for_doubt
from fmu_bearing.recording.studies.level_estimator import LevelEstimator
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity

_SEEDS_FULL = 3  # of fidelity full, which costs ten times as much
_SETTLE, _DURATION = 0.02, 0.06  # s
_TURNS, _LONGEST = 20.0, 0.15  # of the shaft, and s: how long the run of a slow bearing is


class ChangeLevels:
    """Levels of a scene and its changes, with the same seeds, where the unchanged one is loudest."""

    def __init__(self, estimator: LevelEstimator) -> None:
        self.estimator = estimator
        self.fidelity = self.microphone = self.doubt = ""
        self.seeds: tuple[int, ...] = ()
        self.before: NDArray[np.float64] = np.empty(0)
        self.level = math.nan
        self._loudest = 0

    def begin(self, scene: Scene, seeds: int) -> None:
        """Choose fidelity and microphone, and compute the level of the unchanged scene.

        Raises
        ------
        ValueError
            Where it cannot be run.
        """
        assert scene.imperfections is not None
        self.fidelity, levels = self._choose(scene)
        by = self.estimator.radiation_model
        self.doubt = doubt(with_fidelity(scene, model=self.fidelity), radiation_model=by)
        if self.fidelity == "full":
            seeds = min(seeds, _SEEDS_FULL)
        self.seeds = tuple((scene.imperfections.seed + k * scene.seeds_apart) % 2**31 for k in range(seeds))
        self._loudest = int(np.argmax(levels))
        self.microphone = scene.microphones[self._loudest].name
        self.estimator.doubts = {}
        self.before = self.levels(scene)
        self.doubt = in_doubt(self.estimator.doubts, self.doubt)
        self.level = float(self.before[0])

    def levels(self, scene: Scene) -> NDArray[np.float64]:
        """Level (dB(A)) at the loudest microphone by seed."""
        return np.array([self._all(scene, self.fidelity, seed)[self._loudest] for seed in self.seeds])

    def _choose(self, scene: Scene) -> tuple[str, NDArray[np.float64]]:
        """Return the cheapest fidelity within the scene's accuracy, and its levels at all microphones.

        Rings that bend need fidelity full, and what `reason_for_doubt` names is judged by it. Else the level
        of full decides, of one run with the scene's own seed: a cage that is loud sounds in full alone, and
        makes changes of preload go the other way (a steel DB set at 18,000 r/min).
        """
        assert scene.imperfections is not None
        own, seed = scene.fidelity.model, scene.imperfections.seed
        if scene.bends:
            return "full", self._all(scene, "full", seed)
        if own in ("rings", "response"):
            return own, self._all(scene, own, seed)
        full = self._all(scene, "full", seed)
        if reason_for_doubt(scene, radiation_model=self.estimator.radiation_model):
            return "full", full
        at = int(np.argmax(full))
        for fidelity in ("response", "rings"):
            try:
                levels = self._all(scene, fidelity, seed)
            except ValueError:
                continue
            if abs(levels[at] - full[at]) <= scene.fidelity.accuracy.level_dB:
                return fidelity, levels
        return "full", full

    def _all(self, scene: Scene, fidelity: str, seed: int) -> NDArray[np.float64]:
        """Level (dB(A)) at all microphones."""
        assert scene.imperfections is not None
        flaws = scene.imperfections.model_copy(update={"seed": seed})
        drawn = with_fidelity(scene.model_copy(update={"imperfections": flaws}), model=fidelity)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # printed with each choice's operating point
            return np.asarray(level(self.estimator.spectrum(drawn).sum(axis=1)))


def change_levels(scene: Scene, radiation_model: str | None = None) -> "tuple[ChangeLevels | None, str]":
    """Return what computes levels of short runs of a scene, or the reason why nothing can."""
    sound, flaws = scene.sound, scene.imperfections
    if sound is None or not scene.microphones:
        return None, "the scene has no microphones"
    if flaws is None:
        return None, "the scene has no imperfections, and a perfect bearing is silent"
    if scene.operation.speed_rpm == 0.0:
        return None, "the shaft does not turn"
    turns = _TURNS / abs(scene.operation.speed_rpm * RPM / (2.0 * math.pi))
    duration = min(max(_DURATION, turns), _LONGEST)
    try:
        estimator = LevelEstimator(
            [place.position_m for place in scene.microphones], radiation_model or sound.radiation_model, "A",
            duration, _SETTLE,
        )  # fmt: skip
    except ValueError as problem:
        return None, str(problem)
    return ChangeLevels(estimator), ""
