"""Communication steps beside the clock: what they cost by fidelity.

The loop runs as fast as it can; no step waits for the clock. A step is a call of the kernel that fmi2DoStep
of a native FMU calls. What the FMU does besides, and what its master adds, is not in it: through FMPy a step
took 7 to 12 us more in `response`, at most 10 in `rings`, and no more than the noise in `full` (means of 1000
steps in turn with those of the FMU, 7003C-spindle at 1 ms and held speed, 2-core AMD EPYC virtual machine,
Python 3.11, Numba 0.68).
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from time import perf_counter, thread_time

import numpy as np

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import U
from fmu_bearing.interface import fmu_variables, variables
from fmu_bearing.interface.inputs import input_values
from fmu_bearing.prepare.accelerometers import sensor_blocks
from fmu_bearing.prepare.model import pack
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.prepare.unread_outputs import without_unread
from fmu_bearing.progress import keeping
from fmu_bearing.results.table import machine
from fmu_bearing.run.march import at_speeds, march
from fmu_bearing.run.step_times import HELD, Realtime, Timed, name_of
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.sound import Microphone

__all__ = ["realtime"]

DURATION = 0.5  # s of each phase
WARM_UP = 10  # steps that are not timed: they touch memory and fill caches for the first time
_MOST_STEPS = 1_000_000
#: Runs one by one, as a progress bar wants them.
Track = Callable[[Sequence["_Case"]], Iterable["_Case"]]


@dataclass(frozen=True)
class _Case:
    """A fidelity with or without sound."""

    fidelity: str
    scene: Scene

    @property
    def microphones(self) -> int:
        """Number of microphones that are computed."""
        return 0 if self.scene.sound is None else len(self.scene.sound.points())

    @property
    def name(self) -> str:
        """Fidelity and sound in words."""
        return name_of(self.fidelity, self.microphones)


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

    Where ``fmu.outputs`` of the scene names what its FMU shows, no more is computed than the FMU does.

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
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with what is finished as ``timed``.

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
    shown = _shown(scene)
    left_out: dict[str, str] = {}
    cases = list(_cases(scene, _known(fidelities), microphones, left_out))
    timed: list[Timed] = []
    due = [case.name for case in cases]

    def study() -> Realtime:
        return Realtime(scene, step, tuple(timed), left_out, machine())

    with keeping(timed, study, lambda: ", ".join(due)):
        for case in track(cases):
            try:
                timed += [*_timed(case, step, steps, first, last, shown)]
            except ValueError as problem:
                left_out[case.name] = str(problem)
            due.remove(case.name)
    if not timed:
        reasons = "; ".join(dict.fromkeys(left_out.values()))
        raise ValueError(f"no fidelity of {scene.name} could be timed: {reasons}")
    return study()


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


def _shown(scene: Scene) -> frozenset[str] | None:
    """Return the names of what a scene's FMU shows, which alone it computes; None: ``fmu`` names none."""
    if scene.fmu is None or scene.fmu.outputs is None:
        return None
    plain = scene.model_copy(update={"fmu": scene.fmu.model_copy(update={"naming": "structured"})})
    return frozenset(one.name for one in fmu_variables(plain, variables(scene, 0.0)))


def _timed(
    case: _Case, step: float, steps: int, first: float, last: float, shown: frozenset[str] | None
) -> Iterator[Timed]:  # fmt: skip
    """Run a case, as its FMU does that shows these names, None: all; times by phase."""
    scene = case.scene
    packed = pack(scene, *sound_blocks(scene), sensors=sensor_blocks(scene))
    if shown is not None:
        packed = without_unread(packed, [
            one for one in variables(scene, 0.0) if one.array != "z" or one.name in shown
        ])  # fmt: skip
    bearing = Arrays(packed, input_values(scene)).at({U.SPEED: first}).init()
    bearing.run(WARM_UP * step, step)
    rising = first + (last - first) * np.arange(1, steps + 1) / steps
    phases = {} if first == last else {"run-up": rising}
    for phase, speeds in (phases | {HELD: np.full(steps, last)}).items():
        timed = _TimedSteps(bearing)
        march(timed, at_speeds(bearing, speeds, step))
        yield Timed(case.fidelity, case.microphones, phase, np.array(timed.cpu), np.array(timed.clock), step)


class _TimedSteps:
    """Steps a bearing and notes how long each step takes (s), of the processor and on the clock."""

    def __init__(self, bearing: Arrays) -> None:
        self.bearing = bearing
        self.cpu: list[float] = []
        self.clock: list[float] = []

    def step(self, h: float) -> None:
        """Advance by ``h`` (s)."""
        begun, begin = perf_counter(), thread_time()
        self.bearing.step(h)
        self.cpu.append(thread_time() - begin)
        self.clock.append(perf_counter() - begun)
