"""Time marching: a bearing that was started goes from point to point, and is read at each.

`march` steps for runs, recordings, points of a sweep, figures that compare runs, times beside the clock and
the motion of the nose. What a caller wants of a run it keeps in ``read``. Inputs are set by the iterable of
steps, before each step. A refused step raises the bearing's `EngineError`: what was read until then stays.
"""

import signal
import threading
import time as clock
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Protocol

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import U
from fmu_bearing.instance import Instance
from fmu_bearing.progress import work
from fmu_bearing.run.inputs import Signal

#: Takes how far a piece of work is and returns whether it goes on.
Proceed = Callable[[float], bool]


class Stepped(Protocol):
    """What can be stepped: an `Instance`, or its `Arrays`."""

    def step(self, h: float) -> None:
        """Advance by ``h`` (s)."""


def march(
    bearing: Stepped, steps: Iterable[float], read: Callable[[], Any] | None = None,
    proceed: Proceed | None = None,
) -> bool:  # fmt: skip
    """Step a started bearing, and read it after each step.

    Parameters
    ----------
    bearing : Instance or Arrays
    steps : iterable of float
        Lengths (s). An iterator may set inputs before it gives the next one, as `to_points` does.
    read : callable, optional
        Is called after each step; for ``proceed`` it returns how far the work is.
    proceed : callable, optional
        As `underway` gives it; default: all steps are made.

    Returns
    -------
    bool
        Whether all steps were made.

    Raises
    ------
    EngineError
        If a step is refused.
    """
    for h in steps:
        bearing.step(h)
        done: Any = None if read is None else read()
        if proceed is not None and not proceed(done):
            return False
    return True


def begin(bearing: Instance, inputs: Mapping[str, Signal]) -> Instance:
    """Start a bearing at its inputs, those given by name (SI units) at time 0; `EngineError` as it does."""
    set_inputs(bearing, inputs, 0.0)
    bearing.initialise()
    return bearing


def to_points(
    bearing: Instance, times: Iterable[float], inputs: Mapping[str, Signal] | None = None
) -> Iterator[float]:
    """Yield the steps (s) to points in time (s), where inputs have the values at the point from there on.

    ``inputs``: numbers or functions of time by name, SI units; the speed ramps to its value over the step.
    """
    for time in times:
        set_inputs(bearing, inputs or {}, time)
        yield time - bearing.time


def at_speeds(bearing: Arrays, speeds: Iterable[float], h: float) -> Iterator[float]:
    """Yield steps of ``h`` (s), over each of which the speed goes to the next of those given (rad/s)."""
    for speed in speeds:
        bearing.u[U.SPEED] = speed
        yield h


def set_inputs(bearing: Instance, inputs: Mapping[str, Signal], time: float) -> None:
    """Set inputs to their values at ``time`` (s)."""
    for name, value in inputs.items():
        bearing.set(name, float(value(time)) if callable(value) else float(value))


@contextmanager
def underway(
    what: str, total: float, unit: str = "s", *, shown: bool | None = None, keep: bool = False,
    stops: bool = True,
) -> Iterator[Proceed]:  # fmt: skip
    """Show the progress of a march, and end it on Ctrl-C at the end of a step.

    Parameters
    ----------
    what, total, unit, shown, keep
        As for `progress.work`; in seconds the pace is shown, too (simulated per wall second).
    stops : bool
        Whether the first Ctrl-C makes ``proceed`` return False, and a second interrupts; else the first does.
    """
    asked = threading.Event()
    # only the main thread may handle signals
    handles = stops and threading.current_thread() is threading.main_thread()
    before = signal.getsignal(signal.SIGINT) if handles else None

    def ask(number: int, frame: Any) -> None:
        if asked.is_set():
            raise KeyboardInterrupt
        asked.set()

    if handles:
        signal.signal(signal.SIGINT, ask)
    try:
        with work(what, total, unit, shown=shown, keep=keep) as display:
            begun = clock.perf_counter()

            def proceed(done: float) -> bool:
                pace = f"{done / max(clock.perf_counter() - begun, 1e-9):.2g} simulated/wall"
                display.at(done, pace if unit == "s" else None)
                return not asked.is_set()

            yield proceed
    finally:
        if handles:
            signal.signal(signal.SIGINT, before)
