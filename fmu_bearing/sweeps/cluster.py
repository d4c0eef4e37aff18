"""Points on the workers of a Dask cluster; only the client writes results."""

import contextlib
import logging
import math
import re
import time as clock
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from types import ModuleType
from typing import Any

from fmu_bearing.extras import need
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.local import failed
from fmu_bearing.sweeps.point import Outcome, Run, Task, blocks_of, code_digest, nothing, run_point

TIMEOUT = 10.0  # s in which a scheduler has to answer, and to have a worker
_AHEAD = 4  # tasks per thread of the cluster that are handed out at once: none waits, none drowns it
_ASK = 2.0  # s between questions how large the cluster is
_LOOK = 0.02  # s between two looks for what has ended
ALONE = 30.0  # s without any worker: a nanny takes seconds to start another in the place of one that died
_KEPT = "finished points are kept where a folder is given: the same command goes on"
_LOGGERS = ("distributed", "tornado", "asyncio")
_NOTHING = logging.CRITICAL + 1
_ADDRESS = re.compile(r"(\w+://)?[^/\s]+:\d+")
_WAY_OUT = "install the same version of fmu-bearing, NumPy and Numba there"


def cluster(
    tasks: Sequence[Task], address: str, run: Run = run_point, timeout: float = TIMEOUT
) -> Iterator[tuple[Task, Outcome]]:
    """Run points on a cluster and yield each as it ends.

    The scheduler gives the points of a lost worker to others; one that has taken several workers with it (the
    scheduler's ``allowed-failures``, 3) is reported as failed. Each sound is prepared by one worker, once.

    Parameters
    ----------
    address : str
        Of the scheduler, such as ``tcp://host:8786``.
    timeout : float
        Seconds in which the scheduler has to answer, and to have a worker.

    Raises
    ------
    SweepError
        For what is not an address; when no scheduler answers, it has no workers, or their code differs from
        the client's.
    MissingExtra
        Without Dask.
    """
    distributed = checked(address)
    with _client(distributed, address, timeout) as client:
        _check_workers(client, address, timeout)
        sounds = {
            task.sound: client.submit(blocks_of, task.sound, pure=False)
            for task in {t.sound: t for t in tasks if t.sound is not None}.values()
        }
        waiting = iter(tasks)
        running: dict[Any, Task] = {}
        finished = distributed.as_completed(loop=client.loop, with_results=True, raise_errors=False)

        crew = _Crew(client, address)

        def more() -> None:
            room = _AHEAD * max(1, crew.threads()) - len(running)
            for _, task in zip(range(room), waiting, strict=False):
                future = client.submit(run, task, sounds.get(task.sound), key=f"fmu-bearing-{task.key}")
                running[future] = task
                finished.add(future)

        more()
        while running:
            ended = finished.next_batch(block=False)
            if not ended:
                crew.threads()
                clock.sleep(_LOOK)
            for future, result in ended:
                task = running.pop(future)
                if future.cancelled():
                    raise SweepError(f"the scheduler at {address} was lost; {_KEPT}")
                yield task, _outcome(task, result[1] if future.status == "error" else result)
            if ended:
                more()


class _Crew:
    """How many threads a cluster has, asked from time to time: workers come and go."""

    def __init__(self, client: Any, address: str) -> None:
        self._client, self._address = client, address
        self._asked, self._there, self._count = -math.inf, clock.monotonic(), 0

    def threads(self) -> int:
        """Return their number.

        Raises
        ------
        SweepError
            When the scheduler is lost, or has had no workers for some time: it would wait without end.
        """
        now = clock.monotonic()
        if now - self._asked > _ASK:  # it takes milliseconds
            try:
                self._count = sum(self._client.nthreads().values())
            except (OSError, ValueError, RuntimeError):  # as Dask calls a connection that is lost
                raise SweepError(f"the scheduler at {self._address} was lost; {_KEPT}") from None
            self._asked = now
            self._there = now if self._count else self._there
            if now - self._there > ALONE:
                raise SweepError(
                    f"the scheduler at {self._address} has had no workers for {ALONE:g} s: start some with "
                    f"`dask worker {self._address}`; {_KEPT}"
                )
        return self._count


def checked(address: str) -> ModuleType:
    """Return Dask's package, and refuse what can be refused before anything is written or run.

    Raises
    ------
    SweepError
        For what is not an address of a scheduler.
    MissingExtra
        Without Dask.
    """
    distributed = need("distributed", "a sweep on a Dask cluster")
    if _ADDRESS.fullmatch(address) is None:
        raise SweepError(f"scheduler = '{address}' is refused: write its address, such as tcp://host:8786")
    return distributed


def _outcome(task: Task, result: Any) -> Outcome:
    """Return the outcome of a task, or one that reports its failure."""
    if isinstance(result, Outcome):
        return result
    if isinstance(result, ValueError):  # of its sound, which another task prepared
        return nothing(task, " ".join(str(result).split()), lasting=True)
    return nothing(task, failed(result))


@contextlib.contextmanager
def _client(distributed: Any, address: str, timeout: float) -> Iterator[Any]:
    """Connect to a scheduler; the data it holds for this client are released at the end in every case."""
    with _quiet():
        try:
            client = distributed.Client(address, timeout=timeout, set_as_default=False)
        except (OSError, TimeoutError) as problem:
            raise SweepError(
                f"no scheduler answered at {address} within {timeout:g} s ({type(problem).__name__}): start "
                "one with `dask scheduler`, or leave out --scheduler to use this machine"
            ) from None
        try:
            yield client
        finally:
            with contextlib.suppress(OSError, TimeoutError):  # the scheduler may be gone
                client.close(timeout=timeout)


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask's loggers silent, which print tracebacks of lost connections: a refusal is one line, ours."""
    names = [name for name in logging.root.manager.loggerDict if name.split(".")[0] in _LOGGERS]
    before = {name: logging.getLogger(name).level for name in names}
    try:
        for name in names:
            logging.getLogger(name).setLevel(_NOTHING)
        yield
    finally:
        for name, level in before.items():
            logging.getLogger(name).setLevel(level)


def _check_workers(client: Any, address: str, timeout: float) -> None:
    """Refuse a cluster without workers, or with workers of other code."""
    try:
        client.wait_for_workers(1, timeout=timeout)
    except TimeoutError:
        raise SweepError(
            f"the scheduler at {address} has no workers: start some with `dask worker {address}`"
        ) from None
    ours = _code()
    for worker, theirs in client.run(_code, on_error="return").items():
        if isinstance(theirs, BaseException):
            raise SweepError(f"worker {worker} cannot load fmu-bearing ({theirs}): {_WAY_OUT}")
        if theirs != ours:
            raise SweepError(f"worker {worker} has fmu-bearing {theirs}, this side {ours}: {_WAY_OUT}")


def _code() -> str:
    return f"{version('fmu-bearing')}, code {code_digest()}"
