"""Running the points that are not finished, with progress."""

import time as clock
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing, contextmanager
from typing import Any, Protocol

from fmu_bearing.prepare.defect_blocks import missing_tables
from fmu_bearing.prepare.defects import defect_table
from fmu_bearing.progress import Stopped, work
from fmu_bearing.scene import Scene
from fmu_bearing.sweeps.local import here, processes
from fmu_bearing.sweeps.point import Outcome, Run, Task, run_point
from fmu_bearing.threads import cores

Outcomes = dict[str, Outcome]


class Planned(Protocol):
    """What is to be run: a `Plan` of a sweep, or of a data set."""

    @property
    def tasks(self) -> Sequence[Task]:
        """One per point."""

    @property
    def sounds(self) -> Sequence[Scene]:
        """Scenes whose sound is prepared, once each."""


class Keeps(Protocol):
    """Finished points on disk."""

    def load(self, task: Task) -> Outcome | None:
        """Return the kept outcome of a point, or None."""

    def keep(self, task: Task, outcome: Outcome) -> Outcome:
        """Write a point; return what of it stays in memory."""


def run_plan(
    plan: Planned, store: Keeps | None = None, workers: int | None = None, scheduler: str | None = None,
    progress: bool | None = None, run: Run = run_point, what: str = "points",
) -> Outcomes:  # fmt: skip
    """Run the points that ``store`` does not hold and return all outcomes by key.

    ``run``: what a worker does with a task; ``what``: the name of the points in the progress.

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
            _bar(what, len(tasks), len(outcomes), progress) as tell,
            closing(_ends(todo, workers, scheduler, run)) as ends,
        ):
            for task, outcome in ends:
                outcomes[task.key] = outcome if store is None else store.keep(task, outcome)
                tell(len(outcomes))
    except KeyboardInterrupt:
        raise Stopped(outcomes, f"{len(tasks) - len(outcomes)} of {len(tasks)} {what}") from None
    return outcomes


def finished(plan: Planned, store: Keeps | None) -> Outcomes:
    """Return the points of a plan that are in the store."""
    if store is None:
        return {}
    outcomes = ((task.key, store.load(task)) for task in plan.tasks)
    return {key: outcome for key, outcome in outcomes if outcome is not None}


def crew_size(tasks: int, workers: int | None) -> int:
    """Return how many processes are used: the cores, but no more than there are points."""
    return max(1, min(tasks, cores() if workers is None else workers))


def estimate(
    plan: Planned, store: Keeps | None, workers: int | None, run: Run = run_point
) -> dict[str, Any]:  # fmt: skip
    """Time one point, twice, and one table of a defect's contact; return what is left.

    The first run also loads kernels and prepares the sound. ``estimate_s`` is the time of all that is left,
    of which ``tables_s`` is for tables that are not kept.
    """
    done = finished(plan, store)
    kept = len(done)
    task = plan.tasks[len(plan.tasks) // 2]
    left = len({one.key for one in plan.tasks}) - kept
    crew = crew_size(left, workers)
    tables, table_s = _tables([one.scene for one in plan.tasks if one.key not in done], task.scene, crew)
    first, second = run(task), run(task)
    return {
        "points": len(plan.tasks), "kept": kept, "sounds": len(plan.sounds), "probe_s": second.wall,
        "first_s": first.wall, "workers": crew, "tables": tables, "table_s": table_s,
        "tables_s": tables * table_s, "estimate_s": left * second.wall / crew + tables * table_s,
        "reason": second.reason,
    }  # fmt: skip


def _tables(scenes: Sequence[Scene], probe: Scene, crew: int) -> tuple[int, float]:
    """Return how many tables of defects scenes lack beside those made now, and the time (s) of each.

    Those of ``probe``, which its run needs, are made and kept, else one of another scene. A table takes all
    cores as far as it can: several processes that make tables share them, and gain what one leaves idle.
    """
    own = missing_tables(probe)
    others = {name: given for one in scenes for name, given in missing_tables(one).items()}
    now = own or dict([*others.items()][:1])
    if not now:
        return 0, 0.0
    begun, used = clock.perf_counter(), clock.process_time()
    for given in now.values():
        defect_table(*given)
    wall, busy = clock.perf_counter() - begun, clock.process_time() - used
    return len(others.keys() - now.keys()), max(wall / crew, min(wall, busy / cores())) / len(now)


def _ends(
    tasks: list[Task], workers: int | None, scheduler: str | None, run: Run
) -> Generator[tuple[Task, Outcome]]:  # fmt: skip
    if scheduler is not None:
        from fmu_bearing.sweeps.cluster import cluster

        yield from cluster(tasks, scheduler, run)
    elif crew_size(len(tasks), workers) == 1:
        yield from here(tasks, run)
    else:
        yield from processes(tasks, crew_size(len(tasks), workers), run)


@contextmanager
def _bar(what: str, total: int, kept: int, shown: bool | None) -> Iterator[Callable[[int], None]]:
    """Show points done and left, the pace, and the time left."""
    name = what if not kept else f"{what} ({kept} kept)"
    with work(name, total, shown=shown, keep=True) as bar:
        bar.at(kept)
        begin = clock.perf_counter()

        def tell(done: int) -> None:
            pace = 60.0 * (done - kept) / max(clock.perf_counter() - begin, 1e-9)
            bar.at(done, f"{pace:.3g} {what}/min")

        yield tell
