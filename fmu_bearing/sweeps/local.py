"""Points on processes of this machine; the point of a process that dies is run again."""

import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from typing import Any

from threadpoolctl import threadpool_limits

from fmu_bearing.children import end_with_parent, surroundings
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.point import Outcome, Run, Task, blocks_of, nothing, run_point

TRIES = 3  # of a point whose worker dies
_START = 10.0  # s that a process may take to come to life before it can be ended
_ONE_THREAD = dict.fromkeys(  # there is one process per core
    ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"), "1"
)
_CANNOT_START = (
    "the worker processes cannot start: a script that calls sweep must do so under "
    "`if __name__ == '__main__':`, as each worker reads it; or give workers=1, which needs none"
)


def here(tasks: Iterable[Task], run: Run = run_point) -> Iterator[tuple[Task, Outcome]]:
    """Run points in this process, one after another."""
    with threadpool_limits(1):  # as in worker processes
        for task in tasks:
            try:
                outcome = run(task)
            except Exception as fault:  # of one point, which ends no sweep
                outcome = nothing(task, failed(fault))
            yield task, outcome


def processes(
    tasks: Sequence[Task], workers: int, run: Run = run_point
) -> Iterator[tuple[Task, Outcome]]:  # fmt: skip
    """Run points in worker processes and yield each as it ends.

    A point whose worker dies is run ``TRIES`` times at most; then this is its reason.

    Raises
    ------
    SweepError
        When no worker starts.
    """
    sounds = list(dict.fromkeys(task.sound for task in tasks if task.sound is not None))
    with surroundings(_ONE_THREAD), hired(min(workers, len(tasks))) as crew:
        # each sound is prepared by one worker, before any two meet the same one; both take it from disk then
        for _ in spread(crew, [(sound, _prepare_sound) for sound in sounds]):
            pass
        for task, outcome in spread(crew, [(task, run) for task in tasks]):
            yield task, outcome if isinstance(outcome, Outcome) else nothing(task, str(outcome))


def failed(fault: BaseException) -> str:
    """Return the outcome of a point that failed by an error of the program."""
    return f"failed: {type(fault).__name__}: {' '.join(str(fault).split())}"


def _prepare_sound(scene: Any) -> None:
    """Fill the cache on disk; a sound that cannot be prepared is reported by each of its points."""
    with suppress(ValueError):
        blocks_of(scene)


class _Worker:
    """One process. It has a pool of its own, so that its death belongs to a known task."""

    def __init__(self) -> None:
        self.task: Future[Any] | None = None
        self._start()

    def _start(self) -> None:
        self._pool = ProcessPoolExecutor(1, mp_context=get_context("spawn"))
        with _deaf():
            self.greeting: Future[int] = self._pool.submit(_begin)

    @property
    def alive(self) -> bool:
        """Whether it has ever started."""
        return self.greeting.done() and self.greeting.exception() is None

    def give(self, run: Callable[[Any], Any], item: Any) -> Future[Any]:
        """Start on an item, by a new process where the last one has died."""
        try:
            self.task = self._pool.submit(run, item)
        except BrokenProcessPool:
            self._pool.shutdown(wait=False)
            self._start()
            self.task = self._pool.submit(run, item)
        return self.task

    def end(self, at_once: bool) -> None:
        if at_once and self.task is not None and not self.task.done():
            wait([self.greeting], timeout=_START)
            if self.alive:
                with suppress(OSError):  # it may have ended by itself
                    os.kill(self.greeting.result(), signal.SIGTERM)
        self._pool.shutdown(wait=not at_once, cancel_futures=True)


def _begin() -> int:
    """Leave Ctrl-C to the parent, which also receives it; return the process's number."""
    end_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    return os.getpid()


@contextmanager
def hired(count: int) -> Iterator[list[_Worker]]:
    """Start workers and end them, at once after an error."""
    crew = [_Worker() for _ in range(count)]
    finished = False
    try:
        yield crew
        finished = True
    finally:
        for worker in crew:
            worker.end(at_once=not finished)


def spread(
    crew: list[_Worker], jobs: Iterable[tuple[Any, Callable[[Any], Any]]]
) -> Iterator[tuple[Any, Any]]:  # fmt: skip
    """Give each job's item to its function on the next free worker; yield items with their results."""
    waiting = deque((item, run, 1) for item, run in jobs)
    busy: dict[Future[Any], tuple[_Worker, Any, Callable[[Any], Any], int]] = {}
    free = list(crew)
    while waiting or busy:
        while waiting and free:
            worker = free.pop()
            item, run, number = waiting.popleft()
            busy[worker.give(run, item)] = (worker, item, run, number)
        for done in wait(busy, return_when=FIRST_COMPLETED).done:
            worker, item, run, number = busy.pop(done)
            problem = done.exception()
            if isinstance(problem, BrokenProcessPool):
                if not worker.alive:
                    raise SweepError(_CANNOT_START)
                if number < TRIES:
                    waiting.appendleft((item, run, number + 1))
                else:
                    yield item, f"failed: its worker process died {number} times"
            elif problem is not None:
                yield item, failed(problem)
            else:
                yield item, done.result()
            free.append(worker)


@contextmanager
def _deaf() -> Iterator[None]:
    """Make processes that start meanwhile ignore Ctrl-C."""
    if threading.current_thread() is not threading.main_thread():
        yield  # only the main thread may handle signals
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
