"""A run that would take years says so while it can be ended."""

import signal
import threading
import warnings

import pytest

from fmu_bearing import simulate
from fmu_bearing.run.simulate import duration
from fmu_bearing.scene.read import with_fidelity


@pytest.mark.heavy
@pytest.mark.parametrize(("step", "stop", "points"), [(1e-9, 1e6, "1e\\+15"), (1e-3, 1e9, "1e\\+12")])
def test_it_is_reported_with_the_time_it_would_take(silent, step, stop, points):
    rings = with_fidelity(silent, model="rings")
    timer = threading.Timer(2.5, signal.raise_signal, (signal.SIGINT,))
    timer.start()
    with pytest.warns(UserWarning, match=rf"has {points} points of 1 variables: about .* (years|days) more"):
        run = simulate(rings, stop, step=step, outputs=["friction_torque"])
    timer.join()
    assert run.ended == "interrupted"


def test_a_short_run_is_not(silent):
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "this run has")
        simulate(with_fidelity(silent, model="rings"), 1e-2, step=1e-4, outputs=["friction_torque"])


def test_a_slow_run_that_ends_soon_is_not(silent, monkeypatch):
    monkeypatch.setattr("fmu_bearing.run.simulate._FIRST", 0.0)
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "this run has")
        simulate(with_fidelity(silent, model="rings"), 1e-2, step=1e-4, outputs=["friction_torque"])


def test_much_memory_is_reported(silent, monkeypatch):
    monkeypatch.setattr("fmu_bearing.run.simulate._FIRST", 0.0)
    monkeypatch.setattr("fmu_bearing.run.simulate._MUCH", 1e3)
    with pytest.warns(UserWarning, match="and 1.6e-06 GB; take a longer step"):
        simulate(with_fidelity(silent, model="rings"), 1e-2, step=1e-4, outputs=["friction_torque"])


def test_times_in_words():
    assert [duration(t) for t in (5.0, 600.0, 9e4, 1e6, 1e12)] == [
        "5 s",
        "10 min",
        "25 h",
        "11.6 days",
        "3.17e+04 years",
    ]
