"""Running the points that are not finished, with progress."""

import time as clock
from collections.abc import Callable, Generator, Iterator
from contextlib import closing, contextmanager

from fmu_bearing.progress import Stopped, work
from fmu_bearing.sweeps.local import here, processes
from fmu_bearing.sweeps.plan import Plan
from fmu_bearing.sweeps.point import Outcome, Task
from fmu_bearing.sweeps.store import Store
from fmu_bearing.threads import cores

Outcomes = dict[str, Outcome]


def run_plan(
    plan: Plan, store: Store | None = None, workers: int | None = None, scheduler: str | None = None,
    progress: bool | None = None,
) -> Outcomes:  # fmt: skip
    """Run the points that ``store`` does not hold and return all outcomes by key.

    Raises
    ------
    Stopped
        On Ctrl-C, with the outcomes as ``found``; finished points are in the store.
    SweepError
        When no worker is available.
    """
    outcomes = finished(plan, store)
    # points with the same sound follow each other, so that a worker keeps one sound at a time
    order = {scene: place for place, scene in enumerate(plan.sounds)}
    tasks = {task.key: task for task in plan.tasks}  # equal points are run once
    todo = sorted(
        (task for key, task in tasks.items() if key not in outcomes),
        key=lambda task: -1 if task.sound is None else order[task.sound],
    )
    if not todo:
        return outcomes
    try:
        with (
            _bar(len(tasks), len(outcomes), progress) as tell,
            closing(_ends(todo, workers, scheduler)) as ends,
        ):
            for task, outcome in ends:
                outcomes[task.key] = outcome
                if store is not None:
                    store.keep(task, outcome)
                tell(len(outcomes))
    except KeyboardInterrupt:
        raise Stopped(outcomes, f"{len(tasks) - len(outcomes)} of {len(tasks)} points") from None
    return outcomes


def finished(plan: Plan, store: Store | None) -> Outcomes:
    """Return the points of a plan that are in the store."""
    if store is None:
        return {}
    outcomes = ((task.key, store.load(task)) for task in plan.tasks)
    return {key: outcome for key, outcome in outcomes if outcome is not None}


def crew_size(tasks: int, workers: int | None) -> int:
    """Return how many processes are used: the cores, but no more than there are points."""
    return max(1, min(tasks, cores() if workers is None else workers))


def _ends(
    tasks: list[Task], workers: int | None, scheduler: str | None
) -> Generator[tuple[Task, Outcome]]:  # fmt: skip
    if scheduler is not None:
        from fmu_bearing.sweeps.cluster import cluster

        yield from cluster(tasks, scheduler)
    elif crew_size(len(tasks), workers) == 1:
        yield from here(tasks)
    else:
        yield from processes(tasks, crew_size(len(tasks), workers))


@contextmanager
def _bar(total: int, kept: int, shown: bool | None) -> Iterator[Callable[[int], None]]:
    """Show points done and left, the pace, and the time left."""
    name = "points" if not kept else f"points ({kept} kept)"
    with work(name, total, shown=shown, keep=True) as bar:
        bar.at(kept)
        begin = clock.perf_counter()

        def tell(done: int) -> None:
            pace = 60.0 * (done - kept) / max(clock.perf_counter() - begin, 1e-9)
            bar.at(done, f"{pace:.3g} points/min")

        yield tell
