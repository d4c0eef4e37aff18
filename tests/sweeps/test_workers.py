"""Worker processes: results do not depend on how many there are, and none is lost with a worker."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from fmu_bearing.progress import Stopped
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.sweeps import local, runs, sweep
from fmu_bearing.sweeps.runs import run_plan
from fmu_bearing.sweeps.store import Store
from tests.conftest import EXAMPLES, ROOT
from tests.sweeps import points


@pytest.fixture
def trace(tmp_path, monkeypatch):
    folder = tmp_path / "trace"
    folder.mkdir()
    monkeypatch.setenv(points.TRACE, str(folder))
    return folder


@pytest.fixture(scope="module")
def silent(scene):
    return scene("7003C-bare").model_copy(update={"sound": None})


@pytest.mark.heavy
def test_two_workers_give_the_bits_of_one(silent):
    """Also in another order, and whatever else is in the sweep."""
    axes = {"seed": [1, 2], "speed": [9000, 12000]}
    options = {"settle": 2e-3, "window": 3e-3}
    rings = with_fidelity(silent, model="rings")
    one = sweep(rings, axes, workers=1, **options)
    two = sweep(rings, {name: values[::-1] for name, values in axes.items()}, workers=2, **options)
    equal = two.sortby(["seed", "speed_rpm"])
    for name in one.data_vars:
        if name != "wall":
            np.testing.assert_array_equal(one[name].values, equal[name].values, err_msg=name)
    # the seed is one that matters
    velocity = one["outer_ring.velocity"]
    assert (abs(velocity.sel(seed=1) / velocity.sel(seed=2) - 1.0) > 1e-3).all()


@pytest.mark.heavy
def test_lost_workers_lose_no_point(silent, trace, monkeypatch):
    """One death costs a try; a point that always kills its worker, or fails, stops no other."""
    monkeypatch.setattr(local, "TRIES", 2)
    made = points.small(silent)
    ends = [(points.rpm(task), outcome) for task, outcome in local.processes(made.tasks, 2, points.troubled)]
    assert sorted(speed for speed, _ in ends) == [1000.0 * k for k in range(1, 7)]  # none lost, none doubled
    found = dict(ends)
    assert found[4000.0].reason == "failed: its worker process died 2 times" and not found[4000.0].lasting
    assert found[3000.0].reason == "failed: KeyError: 'a fault of the program'" and not found[3000.0].lasting
    assert np.isnan(found[4000.0].figures).all() and np.isnan(found[3000.0].figures).all()
    assert all(found[speed].figures == (speed,) for speed in (1000.0, 2000.0, 5000.0, 6000.0))
    assert points.tries(trace) == {1e3: 1, 2e3: 2, 3e3: 1, 4e3: 2, 5e3: 1, 6e3: 1}


def test_a_restart_runs_only_what_is_missing(silent, trace, tmp_path):
    made = points.small(silent)
    store = Store(tmp_path / "out")
    before = run_plan(made, store, workers=1, run=points.plain)
    files = sorted((tmp_path / "out" / "points").iterdir())
    assert len(files) == 6 and len(list(trace.iterdir())) == 6
    files[0].write_text(files[0].read_text()[:-20])  # cut short
    files[1].write_text(
        files[1].read_text().replace('"contact.inner.load_mean": ', '"contact.inner.load_mean": 1')
    )
    files[2].unlink()
    again = run_plan(made, store, workers=1, run=points.plain)
    assert again == before
    assert sorted(points.tries(trace).values()) == [1, 1, 1, 2, 2, 2]
    assert run_plan(made, store, workers=1, run=points.plain) == before and len(list(trace.iterdir())) == 9


def test_what_failed_with_its_worker_is_tried_again_by_a_restart(silent, tmp_path):
    made = points.small(silent, speeds=[1000])
    store = Store(tmp_path)
    store.keep(made.tasks[0], local.nothing(made.tasks[0], "failed: its worker process died 3 times"))
    assert store.load(made.tasks[0]) is None
    store.keep(made.tasks[0], local.nothing(made.tasks[0], "no equilibrium", 0.1, lasting=True))
    assert store.load(made.tasks[0]).reason == "no equilibrium"


def test_ctrl_c_keeps_what_is_finished(silent, trace, tmp_path, monkeypatch):
    """The workers leave Ctrl-C to the parent, and none outlives it."""
    made = points.small(silent, speeds=range(1000, 9000, 1000))
    store = Store(tmp_path / "out")

    def three_then_ctrl_c(tasks, workers, run):
        for count, end in enumerate(local.processes(tasks, workers - 1, run), start=1):
            if count == 4:
                os.kill(os.getpid(), signal.SIGINT)
            yield end

    monkeypatch.setattr(runs, "processes", three_then_ctrl_c)
    with pytest.raises(Stopped) as caught:
        run_plan(made, store, workers=2, run=points.slow)
    assert caught.value.missing == "5 of 8 points"
    assert len(caught.value.found) == 3 == len(list((tmp_path / "out" / "points").glob("*.json")))
    workers = {int(path.read_text()) for path in trace.iterdir()}
    late = time.monotonic() + 20.0
    while any(alive(pid) for pid in workers) and time.monotonic() < late:
        time.sleep(0.05)
    assert workers and not any(alive(pid) for pid in workers)


#: A sweep of many points, of which each takes a moment.
SWEEP = """
from fmu_bearing import read_scene
from fmu_bearing.sweeps import local
from tests.sweeps import points

if __name__ == "__main__":
    scene = read_scene({scene!r}).model_copy(update={{"sound": None}})
    made = points.small(scene, speeds=range(1000, 60000, 500))
    list(local.processes(made.tasks, 2, points.slow))
"""


@pytest.mark.heavy
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs /proc")
def test_workers_end_with_a_program_that_is_killed(trace, tmp_path):
    """Their pipes stay open, as they hold both ends: nothing else would end them."""
    script = tmp_path / "it.py"
    script.write_text(SWEEP.format(scene=str(EXAMPLES / "7003C-bare.toml")), "utf-8")
    places = os.pathsep.join([str(ROOT), *filter(None, sys.path)])
    with subprocess.Popen([sys.executable, str(script)], env={**os.environ, "PYTHONPATH": places}) as program:
        try:
            late = time.monotonic() + 60.0
            while len(workers := {path.name.split("-")[1] for path in trace.iterdir()}) < 2:
                assert program.poll() is None and time.monotonic() < late
                time.sleep(0.05)
        finally:
            program.kill()
    late = time.monotonic() + 20.0
    while any(alive(pid) for pid in workers) and time.monotonic() < late:
        time.sleep(0.05)
    assert not any(alive(pid) for pid in workers)


def alive(pid):
    """Whether a process runs; one that waits to be collected does not."""
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().split(")")[1].split()[0] != "Z"
    except OSError:
        return False
