"""Whether the difference of two levels is a finding: it has one sign, whichever surfaces are drawn."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.modal.campbell.doubts import reason_for_doubt
from fmu_bearing.recording.studies.comparison_data import ComparisonData
from fmu_bearing.recording.studies.level_estimator import LevelEstimator
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity

SEEDS = 5
_FIDELITY = "response"
_LEAST = 0.1  # dB: what tables show of a level


@dataclass(frozen=True)
class Finding(Result):
    """What is known of the difference of two levels at a microphone."""

    quantities = (
        "microphone", "measured_dBA", "drawn_dBA", Quantity("least_dB", of=lambda _: _LEAST), "is_finding",
        "words",
    )  # fmt: skip

    microphone: str
    measured: float
    """B minus A, dB(A), of the runs that are compared."""
    drawn: tuple[float, ...] = ()
    """The same of short runs, dB(A), one for each seed; empty where there are none."""
    reason: str = ""
    """Why it is not judged; empty: it is."""

    @property
    def is_finding(self) -> bool | None:
        """Whether all differences have one sign and the measured one is 0.1 dB or more; None: not judged."""
        if self.reason:
            return None
        every = (self.measured, *self.drawn)
        return abs(self.measured) >= _LEAST and (min(every) > 0.0 or max(every) < 0.0)

    def words(self) -> str:
        """Say it in a sentence."""
        if self.reason:
            return f"Whether the difference is a finding was not judged: {self.reason}."
        verdict = f"is {'a' if self.is_finding else 'no'} finding"
        seeds = f"{len(self.drawn)} seed{'s' if len(self.drawn) > 1 else ''}"
        return (
            f"{self.measured:+.1f} dB(A) at {self.microphone} {verdict}: draws of the surfaces with {seeds}, "
            f"the same for A and B, differ by {min(self.drawn):+.1f} to {max(self.drawn):+.1f} dB(A) in "
            f"fidelity {_FIDELITY}; a finding is {_LEAST:g} dB or more and has one sign with every seed."
        )


def judged(
    a: ComparisonData,
    b: ComparisonData,
    microphone: str,
    seeds: int = SEEDS,
    track: Callable[[Sequence[int]], Iterable[int]] = iter,
) -> Finding:
    """Draw the surfaces of both again, with the same seeds, and compare the levels of short runs.

    Parameters
    ----------
    a, b : ComparisonData
    microphone : str
        One that both have.
    seeds : int
        How many draws, the scenes' own first; 0: the difference is not judged.
    track : callable
        Passes the draws on one by one, to show progress.
    """
    measured = b.levels[microphone][1] - a.levels[microphone][1]
    if reason := _obstacle(a, b, seeds):
        return Finding(microphone, measured, reason=reason)
    sides = [(side, _estimator(side, microphone)) for side in (a, b)]
    drawn = []
    try:
        for k in track(range(seeds)):
            low, high = (_level(side.scene, estimator, k) for side, estimator in sides)
            drawn.append(high - low)
    except ValueError as problem:
        return Finding(microphone, measured, reason=str(problem))
    return Finding(microphone, measured, tuple(drawn), _contradiction(a, b, measured, drawn[0]))


def _contradiction(a: ComparisonData, b: ComparisonData, measured: float, drawn: float) -> str:
    """Return that draws with the scenes' own surfaces go the other way than the runs, or ""."""
    assert a.scene is not None and b.scene is not None
    accuracy = a.scene.fidelity.accuracy.level_dB + b.scene.fidelity.accuracy.level_dB
    if a.fidelity == _FIDELITY or measured * drawn >= 0.0 or abs(measured - drawn) <= accuracy:
        return ""
    return (
        f"fidelities {a.fidelity} and {_FIDELITY} contradict each other, as where a cage is loud: the runs "
        f"differ by {measured:+.1f} dB(A), with the same surfaces in {_FIDELITY} by {drawn:+.1f}; "
        "`fmu-bearing sound` gives the range of each"
    )


def _obstacle(a: ComparisonData, b: ComparisonData, seeds: int) -> str:
    """Return why a difference cannot be judged; empty: it can."""
    for letter, side in (("A", a), ("B", b)):
        if side.scene is None:
            return f"the scene of {letter} is not known"
        if side.scene.imperfections is None:
            return f"{letter} has no imperfections, and a perfect bearing has no level that scatters"
        if side.radiation_model.startswith("paper"):
            return f"radiation model {side.radiation_model} needs channels of its own for each draw"
        why = Setting(_FIDELITY).against(side.scene)
        why = why or reason_for_doubt(side.scene, radiation_model=side.radiation_model)
        if why:
            return f"draws of {letter} need fidelity full: {why}; `fmu-bearing sound` gives the range of each"
    for what, one, other in (
        ("fidelity", a.fidelity, b.fidelity), ("radiation model", a.radiation_model, b.radiation_model),
    ):  # fmt: skip
        if one != other:
            return f"A has {what} {one} and B has {other}, whose difference is in it"
    return "" if seeds > 0 else "no seeds were requested"


def _estimator(side: ComparisonData, microphone: str) -> LevelEstimator:
    """Return what computes levels of a side at one of its microphones."""
    assert side.scene is not None
    places = [place.position_m for place in side.scene.microphones if place.name == microphone]
    return LevelEstimator(places, side.radiation_model, "A")


def _level(scene: Scene | None, estimator: LevelEstimator, k: int) -> float:
    """Return the level (dB(A)) of a scene whose surfaces are drawn with draw ``k`` after its own."""
    assert scene is not None and scene.imperfections is not None
    drawn = scene.imperfections.reseeded(k * scene.seeds_apart)
    one = with_fidelity(scene.model_copy(update={"imperfections": drawn}), model=_FIDELITY)
    return float(np.asarray(level(estimator.spectrum(one).sum(axis=1)))[0])
