"""Communication steps beside the clock: what they cost by fidelity, and what to change where they come late.

The loop runs as fast as it can; no step waits for the clock. A step is a call of the kernel that fmi2DoStep
of a native FMU calls. What the FMU does besides, and what its master adds, is not in it: through FMPy a step
took 2 to 13 us more (means of 1000 steps in turn with those of the FMU, `rings` and `response` of the
7003C-spindle at 1 ms, 2-core AMD EPYC virtual machine, Python 3.11, Numba 0.68).
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from time import perf_counter, thread_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays, Refused
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import U
from fmu_bearing.prepare.sound import sound_blocks
from fmu_bearing.results.table import machine, number
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.sound import Microphone

__all__ = ["COLUMNS", "SHORT", "Realtime", "Timed", "realtime"]

COLUMNS = (
    "fidelity", "microphones", "phase", "steps", "mean, us", "p50", "p99", "worst", "worst over mean", "late",
)  # fmt: skip
#: The columns of a table for a terminal: the steps of all rows are as many.
SHORT = ("fidelity", "microphones", "phase", "mean, us", "p50", "p99", "worst", "late")
DURATION = 0.5  # s of each phase
WARM_UP = 10  # steps that are not timed: they touch memory and fill caches for the first time
_MOST_STEPS = 1_000_000
_AMPLE = 0.8  # of the step: what takes more has little margin
_SHORT = 1e-4  # s: internal steps are some tens of microseconds long, and a call computes one at least
_HELD = "held"
#: Runs one by one, as a progress bar wants them.
Track = Callable[[Sequence["_Case"]], Iterable["_Case"]]


@dataclass(frozen=True)
class Timed:
    """What the steps of one phase took.

    Attributes
    ----------
    fidelity : str
    microphones : int
        0: the sound is not computed.
    phase : str
    cpu : ndarray, shape (steps,)
        Time of the processor for this thread (s): other work on the machine enters through caches alone.
    clock : ndarray, shape (steps,)
        Time of the clock (s).
    """

    fidelity: str
    microphones: int
    phase: str
    cpu: NDArray[np.float64]
    clock: NDArray[np.float64]

    @property
    def case(self) -> tuple[str, int]:
        """Fidelity and microphones."""
        return self.fidelity, self.microphones

    def late(self, step: float) -> int:
        """Return how many steps took longer on the clock than the ``step`` (s) that they simulate."""
        return int((self.clock > step).sum())

    def cells(self, step: float) -> list[str]:
        """Return the row of the table."""
        micro = 1e6 * self.cpu
        figures = (micro.mean(), *np.quantile(micro, (0.5, 0.99)), micro.max())
        return [
            self.fidelity, str(self.microphones or "none"), self.phase, str(micro.size),
            *(f"{one:.0f}" if one >= 10.0 else f"{one:.1f}" for one in figures),
            f"{micro.max() / micro.mean():.2f}", str(self.late(step)),
        ]  # fmt: skip


@dataclass(frozen=True)
class _Case:
    """A fidelity with or without sound."""

    fidelity: str
    scene: Scene

    @property
    def microphones(self) -> int:
        """Number of microphones that are computed."""
        return 0 if self.scene.sound is None else len(self.scene.sound.points())


@dataclass(frozen=True)
class _Cost:
    """What a case costs over all of its phases."""

    case: tuple[str, int]  # fidelity, and number of microphones
    phases: dict[str, NDArray[np.float64]]

    @property
    def worst(self) -> float:
        """Longest step (s)."""
        return max(float(cpu.max()) for cpu in self.phases.values())

    @property
    def mean(self) -> float:
        """Mean of the phase that takes most (s)."""
        return max(float(cpu.mean()) for cpu in self.phases.values())

    @property
    def name(self) -> str:
        """Fidelity and sound in words."""
        return _name(*self.case)

    def longer(self, step: float) -> float:
        """Return the shortest multiple of ``step`` (s) that so many steps in a row keep; infinite: none."""
        sums = [np.concatenate(([0.0], np.cumsum(cpu))) for cpu in self.phases.values()]
        for count in range(2, min(one.size for one in sums) // 2):
            if all((one[count:] - one[:-count]).max() <= count * step for one in sums):
                return count * step
        return math.inf


@dataclass(frozen=True)
class Realtime:
    """Times of the steps of a scene.

    Attributes
    ----------
    scene : Scene
    step : float
        Communication step (s).
    timed : tuple of Timed
        By fidelity, without sound before with it, by phase.
    left_out : dict
        Reasons by fidelity, or fidelity and sound, that could not run.
    machine : str
    """

    scene: Scene
    step: float
    timed: tuple[Timed, ...]
    left_out: dict[str, str]
    machine: str

    def table(self, columns: Sequence[str] = COLUMNS) -> tuple[Sequence[str], list[list[str]]]:
        """Return columns, of `COLUMNS`, and rows."""
        rows = [dict(zip(COLUMNS, one.cells(self.step), strict=True)) for one in self.timed]
        return columns, [[row[name] for name in columns] for row in rows]

    def summary(self) -> dict[str, Any]:
        """Return all as numbers and words, SI units."""
        rows = [
            {
                "fidelity": one.fidelity, "microphones": one.microphones, "phase": one.phase,
                "steps": one.cpu.size, "mean_s": float(one.cpu.mean()),
                "p50_s": float(np.quantile(one.cpu, 0.5)), "p99_s": float(np.quantile(one.cpu, 0.99)),
                "worst_s": float(one.cpu.max()), "late": one.late(self.step),
            }
            for one in self.timed
        ]  # fmt: skip
        return {
            "scene": self.scene.name, "step_s": self.step, "machine": self.machine, "steps": rows,
            "left_out": self.left_out, "advice": self.advice(),
        }  # fmt: skip

    def advice(self) -> str:
        """Return in two or three sentences which fidelity keeps the step and what to change.

        A fidelity keeps the step if its worst step takes no more of the processor than the step is long. The
        most complete one that does is named, with sound where there is any.
        """
        costs = self._costs()
        kept = [one for one in costs if one.worst <= self.step]
        if not kept:
            return self._none(costs)
        best = kept[0]
        words = [f"{_capital(best.name)} keeps the step of {_time(self.step)}: {self._share(best.worst)}."]
        sounding = max(count for _, count in (one.case for one in costs))
        missed = [one for one in costs if one.worst > self.step]
        if best.case[1] < sounding:
            words.append(f"With sound none does: {self._change([one for one in missed if one.case[1]])}.")
        elif not missed and len(costs) > 1:
            words.append("So does every other that was timed.")
        elif missed:
            words.append(f"{_capital(missed[0].name)} does not: {self._change(missed[:1], 'it')}.")
        if late := sum(one.late(self.step) for one in self.timed if one.case == best.case):
            words.append(
                f"By the clock {late} of its steps came late all the same, as other work took the processor."
            )
        return " ".join(words)

    def _none(self, costs: list[_Cost]) -> str:
        """Advice where nothing keeps the step."""
        near = min(costs, key=lambda one: one.worst)
        words = [
            f"No fidelity keeps the step of {_time(self.step)}: {near.name} takes up to {_time(near.worst)}."
        ]
        held = [one for one in costs if one.phases[_HELD].max() <= self.step]
        if held:
            words.append(
                f"At the held speed {held[0].name} does: {self._share(float(held[0].phases[_HELD].max()))}."
            )
        words.append(f"To change: {self._change(costs)}.")
        return " ".join(words)

    def _costs(self) -> list[_Cost]:
        """Costs with sound, the most complete fidelity first, then without."""
        cases = list(dict.fromkeys(one.case for one in self.timed))
        cases.sort(key=lambda case: (-case[1], FIDELITIES.index(case[0])))  # type: ignore[arg-type]
        return [_Cost(case, {o.phase: o.cpu for o in self.timed if o.case == case}) for case in cases]

    def _share(self, worst: float) -> str:
        """Words for the worst step beside the step."""
        share = worst / self.step
        margin = ", which leaves little margin" if share > _AMPLE else ""
        return f"its worst step takes {_time(worst)}, {number(100.0 * share)} % of it{margin}"

    def _change(self, costs: list[_Cost], who: str = "") -> str:
        """Words for what lets one of several cases keep up: a longer step where one helps, else less work.

        ``who``: in place of the name of a case that was named already.
        """
        for one in costs:
            if (longer := one.longer(self.step)) < math.inf:
                return f"{who or one.name} would keep a step of {_time(longer)}, or a buffer as long"
        first = costs[0]
        if self.step < _SHORT:
            return f"give a longer step; below {_time(_SHORT)} the cost of a step falls less than its length"
        steps = "its steps" if who else f"steps of {first.name}"
        reason = f"{steps} take {_time(first.mean)} on average, so that a longer one helps little"
        return f"{reason}; take {', '.join([*self._less(first), 'or a faster machine'])}"

    def _less(self, cost: _Cost) -> list[str]:
        """Name what the scene could leave out."""
        fidelity, count = cost.case
        faster = [one.case[0] for one in self._costs() if one.case[1] == count and one.mean < self.step]
        ways = [f"fidelity {faster[0]}"] if faster else []
        if count:
            ways += ["fewer microphones", "no sound"] if count > 1 else ["no sound"]
        if fidelity == FIDELITIES[0] and self.scene.imperfections is not None:  # others hardly change
            ways.append("a lower highest order of waves (`imperfections.highest_frequency_kHz`)")
        return ways


def realtime(
    source: SceneSource,
    step: float = 1e-3,
    *,
    duration: float = DURATION,
    speeds: tuple[float, float] | None = None,
    fidelities: Sequence[str] | None = None,
    microphones: int | None = None,
    track: Track = iter,
) -> Realtime:
    """Time the communication steps of a scene: a run-up, then the speed held.

    Parameters
    ----------
    source : Scene or path
    step : float
        Communication step (s).
    duration : float
        Simulated time of each of the two phases (s).
    speeds : (float, float), optional
        Shaft speeds before and after the run-up (rad/s); two equal ones are held, without a run-up. Default:
        from ``operation.lowest_speed_rpm``, or half of the scene's speed, to the scene's speed.
    fidelities : sequence of str, optional
        Default: all.
    microphones : int, optional
        The first so many of the scene's; 0: without sound alone. Default: without sound, and with all.
    track : callable, optional
        Passes the runs on one by one, to show progress.

    Returns
    -------
    Realtime
        ``table()``, ``advice()`` and ``summary()``; figures are those of this machine.

    Raises
    ------
    ValueError
        For a step, a duration or a name that is refused, and where no fidelity can run.
    SceneError
        For a scene that is refused.

    Examples
    --------
    >>> from fmu_bearing import realtime
    >>> found = realtime("examples/scenes/7003C-bare.toml", 1e-3, duration=0.02, fidelities=["response"])
    >>> [(one.microphones, one.phase, one.cpu.size) for one in found.timed]
    [(0, 'run-up', 20), (0, 'held', 20), (4, 'run-up', 20), (4, 'held', 20)]
    """
    scene = scene_of(source)
    steps = _steps(step, duration)
    first, last = speeds or _speeds(scene)
    left_out: dict[str, str] = {}
    cases = list(_cases(scene, _known(fidelities), microphones, left_out))
    found: list[Timed] = []
    for case in track(cases):
        try:
            found += _timed(case, step, steps, first, last)
        except (ValueError, Refused) as problem:
            left_out[_name(case.fidelity, case.microphones)] = str(problem)
    if not found:
        reasons = "; ".join(dict.fromkeys(left_out.values()))
        raise ValueError(f"no fidelity of {scene.name} could be timed: {reasons}")
    return Realtime(scene, step, tuple(found), left_out, machine())


def _steps(step: float, duration: float) -> int:
    """Return the number of steps of a phase."""
    for name, value in (("step", step), ("duration", duration)):
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} = {value:g} s is refused: give a finite time above 0")
    count = round(duration / step)
    if not 2 <= count <= _MOST_STEPS:
        raise ValueError(
            f"a duration of {duration:g} s in steps of {step:g} s is refused: allowed are 2 to "
            f"{_MOST_STEPS:,} steps; give a duration of {2 * step:g} to {_MOST_STEPS * step:g} s"
        )
    return count


def _known(fidelities: Sequence[str] | None) -> Sequence[str]:
    """Return the fidelities that are asked for."""
    for one in fidelities or ():
        if one not in FIDELITIES:
            raise ValueError(f"fidelity = {one!r} is refused: known are {', '.join(FIDELITIES)}")
    return fidelities or FIDELITIES


def _speeds(scene: Scene) -> tuple[float, float]:
    """Return the scene's range of speeds (rad/s)."""
    own = scene.operation.speed_rpm
    lowest = scene.operation.lowest_speed_rpm
    return RPM * (0.5 * own if lowest is None else math.copysign(lowest, own)), RPM * own


def _cases(
    scene: Scene, fidelities: Sequence[str], microphones: int | None, left_out: dict[str, str]
) -> Iterator[_Case]:
    """Yield fidelities without sound and with it; those that the scene cannot have are noted."""
    places = [] if scene.sound is None else scene.sound.points()
    if microphones is not None and not 0 <= microphones <= len(places):
        raise ValueError(f"microphones = {microphones} is refused: the scene has {len(places)}")
    silent = scene.model_copy(update={"sound": None})
    sounding = scene if microphones is None else _first(scene, microphones)
    for fidelity in fidelities:
        try:
            yield _Case(fidelity, with_fidelity(silent, model=fidelity))
            if sounding.sound is not None:
                yield _Case(fidelity, with_fidelity(sounding, model=fidelity))
        except SceneError as problem:
            left_out[fidelity] = str(problem)


def _first(scene: Scene, microphones: int) -> Scene:
    """Return a scene with the first of its microphones."""
    if scene.sound is None or not microphones:
        return scene.model_copy(update={"sound": None})
    kept = [
        Microphone(name=name, x_mm=1e3 * x, y_mm=1e3 * y, z_mm=1e3 * z)
        for name, (x, y, z) in scene.sound.points()[:microphones]
    ]
    sound = scene.sound.model_copy(update={"microphone": tuple(kept), "circle": None})
    return scene.model_copy(update={"sound": sound})


def _timed(case: _Case, step: float, steps: int, first: float, last: float) -> Iterator[Timed]:
    """Run a case; times by phase."""
    bearing = Arrays.of(case.scene, *sound_blocks(case.scene))
    bearing.u[U.SPEED] = first
    bearing.init()
    bearing.run(WARM_UP * step, step)
    rising = first + (last - first) * np.arange(1, steps + 1) / steps
    phases = {} if first == last else {"run-up": rising}
    for phase, speeds in (phases | {_HELD: np.full(steps, last)}).items():
        cpu, clock = np.zeros(steps), np.zeros(steps)
        for k in range(steps):
            bearing.u[U.SPEED] = speeds[k]
            begun, begin = perf_counter(), thread_time()
            bearing.step(step)
            cpu[k], clock[k] = thread_time() - begin, perf_counter() - begun
        yield Timed(case.fidelity, case.microphones, phase, cpu, clock)


def _name(fidelity: str, microphones: int) -> str:
    sound = f"with {microphones} microphone{'s' * (microphones > 1)}" if microphones else "without sound"
    return f"{fidelity} {sound}"


def _capital(words: str) -> str:
    return words[0].upper() + words[1:]


def _time(seconds: float) -> str:
    """Return a time in the unit that suits it."""
    for unit, scale in (("s", 1.0), ("ms", 1e3)):
        if seconds * scale >= 0.9995:  # what three digits round to 1
            return f"{seconds * scale:.3g} {unit}"
    return f"{seconds * 1e6:.3g} us"
