"""Sweeps on 1 and more workers: pace, what handing a point over costs, how much data goes back and forth.

Worker processes of this machine and a Dask cluster of this machine run the same points, 7003C in its spindle
at level rings with compact sound. Starting workers is told apart: it is paid once. Usage, on a machine that
does nothing else: ``python -m benchmarks.sweep [--points 64] [--repeats 3]``.
"""

import argparse
import contextlib
import os
import pickle
import time
from collections.abc import Callable, Iterator

from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.study.sweep.cluster import cluster
from fmu_bearing.study.sweep.local import here, processes
from fmu_bearing.study.sweep.plan import Plan, plan
from fmu_bearing.study.sweep.point import Outcome, Task, run_point
from fmu_bearing.study.table import machine, markdown

SCENE = "examples/scenes/7003C-spindle.toml"
EMPTY = 400  # points that compute nothing, to time the handing over


def nothing_to_do(task: Task, block: object = None) -> Outcome:
    return Outcome((0.0,) * len(task.figures))


def points(count: int) -> Plan:
    scene: Scene = with_fidelity(read_scene(SCENE), level="rings")
    sound = scene.sound.model_copy(update={"rung": "compact", "details": False})
    return plan(scene.model_copy(update={"sound": sound}), {"speed": f"10000:40000:{count}"})


def drained(ends: Iterator) -> tuple[float, float]:
    """Seconds to the first point, and from there to the last."""
    begin = time.perf_counter()
    next(ends)
    first = time.perf_counter()
    for _ in ends:
        pass
    return first - begin, time.perf_counter() - first


@contextlib.contextmanager
def dask(workers: int) -> Iterator[str]:
    from distributed import LocalCluster

    options = {"processes": True, "threads_per_worker": 1, "dashboard_address": None, "silence_logs": 50}
    with LocalCluster(n_workers=workers, **options) as found:
        yield found.scheduler_address


def paces(tasks: tuple[Task, ...], repeats: int, run: Callable) -> list[tuple[str, int, float, float]]:
    """Executor, workers, seconds to the first point, seconds per further point: the best of the repeats."""
    found = []

    def best(name: str, workers: int, ends: Callable[[], Iterator]) -> None:
        times = [drained(ends()) for _ in range(repeats)]
        found.append((name, workers, min(t[0] for t in times), min(t[1] for t in times) / (len(tasks) - 1)))

    best("this process", 1, lambda: here(tasks, run))
    for workers in range(1, (os.cpu_count() or 1) + 1):
        best("processes", workers, lambda workers=workers: processes(tasks, workers, run))
        with dask(workers) as address:
            best("Dask, this machine", workers, lambda address=address: cluster(tasks, address, run))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=64)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    made = points(given.points)
    for task in made.tasks[:2]:  # kernels and sound are loaded, and on disk
        run_point(task)
    real = paces(made.tasks, given.repeats, run_point)
    alone = next(pace for name, workers, _, pace in real if name == "processes" and workers == 1)
    rows = [
        [name, str(workers), f"{first:.1f}", f"{1e3 * pace:.0f}", f"{alone / pace:.2f}"]
        for name, workers, first, pace in real
    ]
    load = " ".join(f"{x:.1f}" for x in os.getloadavg())
    print(f"{machine()}; load average at the end {load}\n")
    print(f"{given.points} points of 120 ms, level rings, 4 microphones; best of {given.repeats}\n")
    print(markdown(("on", "workers", "first point, s", "each further, ms", "over 1 process"), rows))
    bare = paces(points(EMPTY).tasks, 1, nothing_to_do)
    rows = [[name, str(workers), f"{1e3 * pace:.2f}"] for name, workers, _, pace in bare]
    print(f"Handing over alone, {EMPTY} points that compute nothing:\n")
    print(markdown(("on", "workers", "each, ms"), rows))
    task, outcome = made.tasks[0], run_point(made.tasks[0])
    sent, back = len(pickle.dumps(task)), len(pickle.dumps(outcome))
    print(f"A task is {sent} bytes, what comes back {back} bytes ({len(outcome.figures)} figures).")


if __name__ == "__main__":
    main()
