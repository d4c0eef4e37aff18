"""Adaptive communication steps: going back leaves no trace, and they are better than longer fixed ones."""

import csv

import numpy as np
import pytest


@pytest.fixture
def together(fmus):
    """A function that initialises the three FMUs, the bearing a stand-in; freed at the end."""
    from adaptive import Exchange
    from coupling import Plan

    made = []

    def make():
        made.append(Exchange(fmus, Plan(end_time=0.1, ramp_time=0.05), 1.0))
        return made[-1]

    yield make
    for one in made:
        one.free()


def accept(before, after):
    return 0.0


def refuse(before, after):
    assert before != after
    return 2.0


def test_a_refused_step_leaves_no_trace(together):
    """In any of the three, to the bit: not in what is read, nor in what a controller remembers."""
    tried, straight = together(), together()
    for k in range(20):
        for h in (3e-3, 1.7e-3):
            before = tried.values()
            assert tried.step(k * 1e-3, h, refuse) == 2.0
            assert tried.values() == before
        assert tried.step(k * 1e-3, 1e-3, accept) == straight.step(k * 1e-3, 1e-3, accept) == 0.0
        assert tried.values() == straight.values()
    assert tried.motor.get(["motor_torque"]) == straight.motor.get(["motor_torque"])
    assert tried.thermal.get(["energy.supplied"]) == straight.thermal.get(["energy.supplied"])


def test_a_step_that_an_fmu_refuses_is_taken_back(together):
    one = together()
    before = one.values()
    one.motor.set({"start_speed": 0.0})
    one.thermal.set({"capacity.oil": 0.0})  # no step can be taken with it, by the last of the three
    assert one.step(0.0, 1e-3, accept) == np.inf
    assert one.values() == before


@pytest.mark.heavy
def test_adaptive_steps_follow_the_error(tmp_path):
    import adaptive

    adaptive.main(quick=True, output=tmp_path)
    with (tmp_path / "adaptive.csv").open(encoding="utf-8", newline="") as file:
        even, tight, loose = csv.DictReader(file)
    assert (even["accepted"], even["refused"]) == ("60", "0")
    taken = [int(row["accepted"]) + int(row["refused"]) for row in (tight, loose)]
    # ten times the error a step: 90 steps and 35, refused ones included
    assert int(tight["refused"]) > 0 and taken[1] < 45 < 60 < taken[0]
    # the torque rises, so that errors of one sign add up: 0.41, 0.48 and 0.67 rad/s
    off = [float(row["speed off, rad/s"]) for row in (tight, even, loose)]
    assert off[0] < off[1] < off[2] < 1.0
    for row in (tight, loose):
        assert float(row["shortest, ms"]) < 0.2 and float(row["longest, ms"]) > 1.0
    assert (tmp_path / "adaptive.png").stat().st_size > 10_000
