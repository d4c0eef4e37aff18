"""Sweeps on 1 and more workers: pace, cost of handing over a point, amount of data exchanged.

Worker processes of this machine and a Dask cluster of this machine run the same points: the 7003C in its
spindle with fidelity rings and radiation model compact. The start of the workers is timed separately, because
it happens once. Usage, on a machine that does nothing else: ``python -m benchmarks.sweep [--points 16]
[--repeats 10]``.
"""

import argparse
import contextlib
import os
import pickle
import time
from collections.abc import Callable, Iterator

from benchmarks.cases import GATES
from fmu_bearing.results.table import machine, markdown
from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.sweeps.cluster import cluster
from fmu_bearing.sweeps.local import here, hired, spread
from fmu_bearing.sweeps.plan import Plan, plan
from fmu_bearing.sweeps.point import Outcome, Task, run_point

SCENE = GATES / "7003C-spindle.toml"
EMPTY = 400  # points that compute nothing, to time the handing over


def nothing_to_do(task: Task, block: object = None) -> Outcome:
    return Outcome((0.0,) * len(task.figures))


def points(count: int) -> Plan:
    scene: Scene = with_fidelity(read_scene(SCENE), model="rings")
    sound = scene.sound.model_copy(update={"radiation_model": "compact", "details": False})
    return plan(scene.model_copy(update={"sound": sound}), {"speed": f"10000:40000:{count}"})


def drained(ends: Iterator) -> float:
    """Seconds that all points take."""
    begin = time.perf_counter()
    for _ in ends:
        pass
    return time.perf_counter() - begin


@contextlib.contextmanager
def dask(workers: int) -> Iterator[str]:
    from distributed import LocalCluster

    options = {"processes": True, "threads_per_worker": 1, "dashboard_address": ":0", "silence_logs": 50}
    with LocalCluster(n_workers=workers, **options) as found:
        yield found.scheduler_address


def paces(tasks: tuple[Task, ...], repeats: int, run: Callable) -> list[tuple[str, int, float]]:
    """Executor, workers, seconds per point: the best of the repeats, by workers that have started."""
    jobs = [(task, run) for task in tasks]
    found = []
    with contextlib.ExitStack() as stack:
        ways: dict[tuple[str, int], Callable[[], Iterator]] = {("this process", 1): lambda: here(tasks, run)}
        for workers in range(1, (os.cpu_count() or 1) + 1):
            crew = stack.enter_context(hired(workers))
            ways["processes", workers] = lambda crew=crew: spread(crew, jobs)
            address = stack.enter_context(dask(workers))
            ways["Dask, this machine", workers] = lambda address=address: cluster(tasks, address, run)
        for ends in ways.values():
            drained(ends())
        # in turn, so that what else the machine does slows all the same
        times = [[drained(ends()) for ends in ways.values()] for _ in range(repeats)]
    for (name, workers), row in zip(ways, zip(*times, strict=True), strict=True):
        found.append((name, workers, min(row) / len(tasks)))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=16)
    parser.add_argument("--repeats", type=int, default=10)
    given = parser.parse_args()
    made = points(given.points)
    for task in made.tasks[:2]:  # kernels and sound are loaded, and on disk
        run_point(task)
    real = paces(made.tasks, given.repeats, run_point)
    alone = {name: pace for name, workers, pace in real if workers == 1}
    rows = [
        [name, str(workers), f"{1e3 * pace:.0f}", f"{alone[name] / pace:.2f}"] for name, workers, pace in real
    ]
    load = " ".join(f"{x:.1f}" for x in os.getloadavg())
    print(f"{machine()}; load average at the end {load}\n")
    print(f"{given.points} points of 120 ms, fidelity rings, 4 microphones; best of {given.repeats}\n")
    print(markdown(("on", "workers", "a point, ms", "over 1 worker"), rows))
    bare = paces(points(EMPTY).tasks, 3, nothing_to_do)
    rows = [[name, str(workers), f"{1e3 * pace:.2f}"] for name, workers, pace in bare]
    print(f"Handing over alone, {EMPTY} points that compute nothing:\n")
    print(markdown(("on", "workers", "each, ms"), rows))
    task, outcome = made.tasks[0], run_point(made.tasks[0])
    sent, back = len(pickle.dumps(task)), len(pickle.dumps(outcome))
    print(f"A task is {sent} bytes, what comes back {back} bytes ({len(outcome.figures)} figures).")


if __name__ == "__main__":
    main()
