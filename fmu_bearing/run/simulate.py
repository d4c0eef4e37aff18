"""Runs of a scene or of an FMU over given inputs: the points and values of ``fmpy.simulate_fmu``."""

import math
import os
import pathlib
import time as clock
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from fmpy.simulation import Input as FmpyInput
from numpy.typing import NDArray

from fmu_bearing.instance import EngineError, Instance, number
from fmu_bearing.interface import Variable
from fmu_bearing.interface.names import chosen_names, known
from fmu_bearing.prepare.model import Model, prepare
from fmu_bearing.results.result import COMPLETE, INTERRUPTED, REFUSED, Run
from fmu_bearing.results.series import columns_of, structured
from fmu_bearing.results.variable_names import by_name
from fmu_bearing.run.choose import resolve
from fmu_bearing.run.inputs import Input, Inputs, input_table
from fmu_bearing.run.march import Proceed, march, underway
from fmu_bearing.scene import SceneSource, scene_of
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.words import loose_words

if TYPE_CHECKING:
    from fmu_bearing.run.simulate_fmu import FmuPlayer

_ROUNDING = 1e-9  # of a run, by which its step may seem longer
_FIRST = 1.0  # s of waiting after which a run is estimated
_LONG, _MUCH = 3600.0, 4e9  # s, bytes: beyond these a run may be a slip of the keyboard


def simulate(
    source: SceneSource | Model,
    stop_time: float,
    *,
    step: float = 1e-3,
    inputs: Inputs | None = None,
    input_from_start: bool = False,
    start_values: Mapping[str, float] | None = None,
    outputs: Sequence[str] | None = None,
    progress: bool | None = None,
    watch: Callable[[Instance], None] | None = None,
) -> Run:
    """Run a bearing from its steady state and keep its variables at the communication points.

    The library runs a scene, with results that equal those of ``fmpy.simulate_fmu`` on its FMU to the last
    bit; FMPy runs an FMU. Inputs are set at the beginning of each step, as FMPy does; the speed then ramps to
    its value over the step. A run of more than an hour or 4 GB says so after its first second.

    Whether a ring whirls by itself, where figures of fidelities rings and response are of an unstable point,
    is not asked: it takes several times as long as a short run. `fmu-bearing simulate`, `record`,
    `operating_point` with its verdicts, and `modes` say so.

    Parameters
    ----------
    source : Scene, Model or path
        A scene file (``.toml``), an FMU (``.fmu``), or a scene in memory.
        Fidelity ``auto`` is resolved first.
    stop_time : float
        End of the run (s).
    step : float
        Communication step (s), at the end of which variables are kept.
    inputs : mapping, structured array or path, optional
        Numbers or functions of time (s) by name, of inputs and tunable parameters; or a table with ``time``
        and columns of them, linear in between, or a CSV file of one (`run.input_file.read_inputs`). SI units;
        columns of a file may be in r/min and degC by their names. Inputs that are not named keep their start
        values. Beyond the times of a table its first and last values are held, with a warning.
    input_from_start : bool
        Shift the times of a table or file so that the first is 0.
    start_values : mapping, optional
        Inputs and parameters at the start, SI units.
    outputs : sequence of str, optional
        Variables to keep, with ``*`` for any text (``"mic[*].leq"``); default: all outputs.
    progress : bool, optional
        Show a progress bar; default: on a terminal.
    watch : callable, optional
        Is called with the bearing at each point that is kept; not of an FMU, whose state is its own.

    Returns
    -------
    Run
        Shorter than asked for, with a warning, when a step is refused or on Ctrl-C; see ``Run.ended``.

    Raises
    ------
    ValueError
        For times, names or values that are refused before the run begins.

    Examples
    --------
    >>> from fmu_bearing import simulate
    >>> run = simulate(
    ...     "examples/scenes/7003C-bare.toml", 3e-3, inputs={"shaft_speed": lambda t: 2000.0 + 1e4 * t}
    ... )
    >>> len(run), f"{1e3 * run['friction_torque'][-1]:.0f} N.mm"
    (4, '22 N.mm')
    """
    _check_times(stop_time, step)
    if isinstance(source, str | os.PathLike) and pathlib.Path(source).suffix == ".fmu":
        from fmu_bearing.run.simulate_fmu import open_fmu

        if watch is not None:
            raise ValueError("watch: an FMU does not show its state; give the scene it was built from")
        player: FmuPlayer | _Library = open_fmu(pathlib.Path(source))
        _warn_of_loose(player, start_values)
    else:
        player = _Library(model_of(source), watch)
    table = input_table(inputs, player.inputs, stop_time, step, input_from_start)
    names = chosen_names(outputs, player.readable, player.outputs)
    for name in by_name(start_values):
        known(name, player.settable, "input or parameter")
    with underway(player.name, stop_time, shown=progress, keep=True) as proceed:
        begin = clock.perf_counter()
        estimate = _Estimate(stop_time, step, len(names), proceed)
        columns, ended, note = player.run(stop_time, step, table, dict(start_values or {}), names, estimate)
        wall = clock.perf_counter() - begin
    if note:
        warnings.warn(note, EndedEarly, stacklevel=2)
    units = {name: player.readable[name] for name in names}
    return Run(player.name, columns, units, player.scene, wall, ended, note)


def model_of(source: SceneSource | Model, **fidelity: Any) -> Model:
    """Return the model of a scene, with other values of keys of ``[fidelity]``; ``auto`` is resolved."""
    if not isinstance(source, Model):
        return prepare(resolve(with_fidelity(source, **fidelity) if fidelity else scene_of(source))[0])
    if fidelity:
        raise ValueError("a prepared Model has its fidelity: give the scene to change it")
    return source


class EndedEarly(UserWarning):
    """A run ended before its stop time; ``Run.note`` says the same."""


class _Estimate:
    """Progress that warns once, after the first second, of a run that takes very long or much memory."""

    def __init__(self, stop_time: float, step: float, names: int, proceed: Proceed) -> None:
        self.stop_time, self.step, self.names, self.proceed = stop_time, step, names, proceed
        self.begin = clock.perf_counter()
        self.warned = False

    def __call__(self, time: float) -> bool:
        if not self.warned and clock.perf_counter() - self.begin > _FIRST:
            self.warned = True
            self._warn(time)
        return self.proceed(time)

    def _warn(self, time: float) -> None:
        points = self.stop_time / self.step
        left = (clock.perf_counter() - self.begin) * (self.stop_time / time - 1.0)
        memory = 8.0 * points * (self.names + 1)
        if left > _LONG or memory > _MUCH:
            warnings.warn(
                f"this run has {points:.3g} points of {self.names} variables: about {duration(left)} more at "
                f"this pace, and {1e-9 * memory:.3g} GB; take a longer step (--step, now {self.step:g} s), "
                "an earlier end or fewer variables, or end it by Ctrl-C, which keeps what was computed",
                stacklevel=2,
            )


def duration(seconds: float) -> str:
    """Return a time in words: seconds, minutes, hours, days or years."""
    for size, unit in ((31_557_600.0, "years"), (86_400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"


class _Library:
    """A model run by the package itself; `simulate_fmu.FmuPlayer` is an FMU with the same attributes."""

    def __init__(self, model: Model, watch: Callable[[Instance], None] | None = None) -> None:
        self.bearing, self.watch = Instance(model), watch
        variables: Mapping[str, Variable] = self.bearing.by_name
        self.name, self.scene = model.scene.name, model.scene
        self.readable = {name: v.unit for name, v in variables.items()}
        self.outputs = self.bearing.names("output")
        self.inputs = {
            name: Input(float(v.start or 0.0), v.min, v.max, v.unit)
            for name, v in variables.items()
            if v.causality == "input" or v.variability == "tunable"
        }
        self.settable = self.bearing.names("input", "parameter")

    def run(
        self, stop_time: float, step: float, table: NDArray[Any] | None, start: dict[str, float],
        names: Sequence[str], proceed: Proceed,
    ) -> tuple[NDArray[Any], str, str]:  # fmt: skip
        """Return the table of results, how the run ended, and why."""
        bearing, feed = self.bearing, _Feed(self.bearing, table)
        for name, value in start.items():
            bearing.set(name, value)
        feed.apply()
        bearing.initialise()
        take = bearing.reader(names)
        times, rows, ended, note = list[float](), list[NDArray[np.float64]](), COMPLETE, ""

        def read() -> float:
            if self.watch is not None:
                self.watch(bearing)
            times.append(feed.time)
            rows.append(take())
            return feed.time

        read()
        try:
            if not march(bearing, feed.steps(stop_time, step), read, proceed):
                ended, note = INTERRUPTED, f"interrupted at t = {feed.time:.6g} s of {stop_time:g} s"
        except EngineError as refusal:
            ended, note = REFUSED, str(refusal)
        columns = np.array(rows).reshape(len(rows), len(names)).T
        return structured({"time": np.array(times), **dict(zip(names, columns, strict=True))}), ended, note


class _Feed:
    """A table of inputs, prepared once for all steps; values and jumps are those of FMPy."""

    def __init__(self, bearing: Instance, table: NDArray[Any] | None) -> None:
        self.bearing, self.time = bearing, 0.0  # s: the point reached
        self.names = [] if table is None else columns_of(table)
        self.jumps: list[float] = []
        if table is not None:
            self.times = np.ascontiguousarray(table["time"])
            self.columns = np.stack([table[name] for name in self.names])
            self.jumps = np.unique(self.times[:-1][np.diff(self.times) == 0.0]).tolist()

    def apply(self, after_event: bool = False) -> None:
        """Set the inputs to their values at the point."""
        if self.names:
            values = FmpyInput.interpolate(self.time, self.times, self.columns, after_event=after_event)[0]
            for name, value in zip(self.names, np.ravel(values), strict=True):
                self.bearing.set(name, float(value))

    def steps(self, stop_time: float, step: float) -> Iterator[float]:
        """Yield the steps (s) to communication points, and to where inputs jump; inputs are set before."""
        count = 0
        while self.time < stop_time and not math.isclose(self.time, stop_time):
            following = min(self._next_jump(), (count + 1) * step)
            if following > stop_time and not math.isclose(following, stop_time):
                following = stop_time
            self.apply(after_event=True)
            h, self.time = following - self.time, following
            count += math.isclose(following, (count + 1) * step)
            yield h

    def _next_jump(self) -> float:
        later = (t for t in self.jumps if t > self.time and not math.isclose(t, self.time))
        return next(later, math.inf)


def _warn_of_loose(player: "FmuPlayer | _Library", start_values: Mapping[str, float] | None) -> None:
    """Warn of one of our FMUs that starts without preload: its own log is shown after a refusal only."""
    scene = player.scene
    if scene is None or scene.mounting is None or "preload" not in player.inputs:
        return
    if scene.fidelity.model == "auto" or scene.bearing.is_deep_groove:
        return
    if by_name(start_values).get("preload", player.inputs["preload"].start) == 0.0:
        warnings.warn(loose_words(scene.fidelity.model), stacklevel=3)


def _check_times(stop_time: float, step: float) -> None:
    for name, value in (("stop_time", stop_time), ("step", step)):
        number(name, value)
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} = {value} s: it must be a finite, positive number of seconds")
    if step > stop_time * (1.0 + _ROUNDING):
        warnings.warn(
            f"step = {step:g} s is longer than the run, which takes one step of {stop_time:g} s: give a "
            "shorter step or a later end",
            stacklevel=3,
        )
