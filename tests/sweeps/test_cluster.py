"""A Dask cluster: a worker lost in the middle costs nothing; refusals are one line."""

import os
import signal
import socket
import subprocess
import sys
import time

import pytest

from fmu_bearing.sweeps import cluster as room
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.cluster import cluster
from fmu_bearing.sweeps.point import run_point
from tests.conftest import ROOT
from tests.sweeps import points

# Clusters are for long sweeps; that workers change no result is tested in test_workers.
pytestmark = pytest.mark.heavy

distributed = pytest.importorskip("distributed", reason="Dask is not installed: extra 'cluster'")


@pytest.fixture(scope="module")
def silent(scene):
    return scene("7003C-bare").model_copy(update={"sound": None})


@pytest.fixture(scope="module")
def trace(tmp_path_factory):
    """Set before the workers start, who inherit it."""
    folder = tmp_path_factory.mktemp("trace")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(points.TRACE, str(folder))
        yield folder


@pytest.fixture(scope="module")
def dask(trace):
    options = {"processes": True, "threads_per_worker": 1, "dashboard_address": ":0", "silence_logs": 50}
    with distributed.LocalCluster(n_workers=2, **options) as found:
        yield found


def test_a_worker_lost_in_the_middle_costs_nothing(silent, dask, trace):
    made = points.small(silent, speeds=range(1000, 13000, 1000))
    victim = next(iter(dask.workers.values())).process.pid
    ended = []
    for task, outcome in cluster(made.tasks, dask.scheduler_address, points.slow):
        ended.append(points.rpm(task))
        assert outcome.figures == (points.rpm(task),)
        if len(ended) == 3:
            os.kill(victim, signal.SIGKILL)
    assert sorted(ended) == [1000.0 * k for k in range(1, 13)]  # none lost, none doubled
    tries = points.tries(trace)
    assert set(tries) == set(ended)
    # what the lost worker was at, or had finished and nobody had fetched, was run again, nothing else
    assert sum(tries.values()) - len(tries) <= 3


def test_figures_are_those_of_this_process(silent, dask):
    made = points.small(silent, speeds=[3000, 9000])
    far = {task.key: outcome.figures for task, outcome in cluster(made.tasks, dask.scheduler_address)}
    assert far == {task.key: run_point(task).figures for task in made.tasks}


def test_workers_with_other_code_are_refused(silent, dask, monkeypatch):
    monkeypatch.setattr(room, "code_digest", lambda: "0123456789abcdef")
    with pytest.raises(SweepError, match=r"worker tcp://\S+ has fmu-bearing .*this side .*0123456789abcdef"):
        next(cluster(points.small(silent).tasks, dask.scheduler_address))


def test_a_scheduler_that_does_not_answer(silent):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    begin = time.monotonic()
    with pytest.raises(SweepError, match=f"no scheduler answered at {address} within 1 s"):
        next(cluster(points.small(silent).tasks, address, timeout=1.0))
    assert time.monotonic() - begin < 10.0
    with pytest.raises(SweepError, match="scheduler = 'somewhere' is refused"):
        next(cluster(points.small(silent).tasks, "somewhere"))


@pytest.fixture
def apart(trace):
    """A scheduler and one worker without a nanny, which would start another."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address, started = f"tcp://127.0.0.1:{port}", []
    places = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *filter(None, sys.path)])}
    for words in (
        ["dask_scheduler", "--port", str(port), "--no-dashboard"],
        ["dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"],
    ):
        command = [sys.executable, "-m", f"distributed.cli.{words[0]}", *words[1:]]
        started.append(subprocess.Popen(command, env=places, stderr=subprocess.DEVNULL))
    yield address, *started
    for one in started:
        one.kill()
        one.wait(timeout=20)


@pytest.mark.parametrize(
    ("lost", "said"), [(1, "has had no workers for 3 s: start some with"), (0, "was lost; finished points")]
)
def test_a_cluster_that_is_lost_ends_the_sweep(lost, said, apart, silent, monkeypatch, capfd):
    """The last worker, or the scheduler: without workers the sweep would wait without end."""
    monkeypatch.setattr(room, "ALONE", 3.0)
    address, *started = apart
    made = points.small(silent, speeds=range(1000, 41000, 250))
    found = []
    with pytest.raises(SweepError, match=said):
        for _, outcome in cluster(made.tasks, address, points.slow, timeout=60.0):
            found.append(outcome)
            if len(found) == 3:
                started[lost].kill()
    assert 3 <= len(found) < 160
    assert "Traceback" not in capfd.readouterr().err
