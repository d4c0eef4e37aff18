"""Derivatives of inputs and outputs in time, and communication steps of any length."""

import math

import pytest

from .conftest import DISCARD, ERROR, OK, STEP

SIZE = 1e-4  # s


def accepts_rates(bearing, expected):
    """Whether the build takes rates; where it does not, that is the answer it must give, and it goes on."""
    answer = bearing.rate("preload", 0.0)
    assert answer == expected["input derivative"]
    if answer == OK:
        return True
    assert bearing.description.coSimulation.canInterpolateInputs is False
    assert bearing.step(0.0) == OK
    return False


def test_ramp_of_the_speed_by_its_rate(master, expected):
    # set to where it ends, the speed ramps over the step from where it was: the same ramp, so the same bits.
    # The rate is a power of two and so are the steps, which makes the ends exact.
    by_rate, by_value = master().start(shaft_speed=1024.0), master().start(shaft_speed=1024.0)
    if not accepts_rates(by_rate, expected):
        return
    size, rate, speed = 2.0**-13, 2.0**16, 1024.0
    for i in range(20):
        assert by_rate.rate("shaft_speed", rate) == OK
        speed += rate * size
        assert by_value.set("shaft_speed", speed) == OK
        assert by_rate.step(i * size, size) == by_value.step(i * size, size) == OK
        assert by_rate.everything() == by_value.everything()
    assert by_rate.get("shaft_speed") == speed == 1024.0 + 20 * 8.0
    # the rate held for one step
    assert by_rate.step(20 * size, size) == by_value.step(20 * size, size) == OK
    assert by_rate.everything() == by_value.everything()


def test_ramp_of_a_held_input_by_its_rate(master, expected):
    # over a step the engine holds the preload: in the middle of its ramp
    by_rate, by_value = master().start(), master().start()
    if not accepts_rates(by_rate, expected):
        return
    rate, load = -4096.0, 500.0
    size = 2.0**-13
    for i in range(10):
        assert by_rate.rate("preload", rate) == OK
        assert by_value.set("preload", load + 0.5 * (rate * size)) == OK
        load += rate * size
        assert by_rate.step(i * size, size) == by_value.step(i * size, size) == OK
        outputs = [name for name in by_rate.by_name if by_rate.by_name[name].causality == "output"]
        assert by_rate.read(*outputs) == by_value.read(*outputs)
        assert by_rate.get("preload") == load


def ramp(bearing, steps, with_rates):
    """Place of the inner ring after 2 ms in which the preload falls from 500 to 300 N, in so many steps."""
    time, size, rate = 0.0, 2e-3 / steps, -200.0 / 2e-3
    for _ in range(steps):
        if with_rates:
            assert bearing.rate("preload", rate) == OK
        assert bearing.step(time, size) == OK
        time += size
        if not with_rates:
            assert bearing.set("preload", 500.0 + rate * time) == OK
    return bearing.get("inner_ring.displacement.x")


def test_rates_of_held_inputs_are_of_second_order(master, expected):
    # a ramp held in the middle of each step is right to second order in the step (errors fall to a quarter
    # when it is halved), one held at its beginning to first order (to a half)
    def run(steps, with_rates):
        bearing = master()
        assert bearing.set("imperfection.scale", 0.0) == bearing.set("tolerance", 1e-6) == OK
        return ramp(bearing.start(shaft_speed=300.0), steps, with_rates)

    if not accepts_rates(master().start(), expected):
        return
    exact = run(640, with_rates=True)
    held, rated = ([run(steps, way) - exact for steps in (10, 20, 40, 80)] for way in (False, True))
    assert 4e-7 < held[0] < 6e-7  # m, of 28.5 um
    for a, b in zip(held, held[1:], strict=False):
        assert 1.8 < a / b < 2.3, held
    for a, b in zip(rated, rated[1:], strict=False):
        assert 3.7 < a / b < 4.8, rated


def test_rate_that_would_leave_the_range(master, expected):
    bearing, other = master().start(), master().start()
    if not accepts_rates(bearing, expected):
        return
    assert bearing.rate("preload", 1e9) == OK
    before = bearing.everything()
    assert bearing.step(0.0) == DISCARD
    assert "with its rate an input would leave its range: preload = 200500.0 is refused" in bearing.messages
    assert bearing.everything() == before
    assert bearing.rate("preload", 0.0) == OK
    assert bearing.run(2) == other.run(2)
    assert bearing.rate("preload", math.nan) == DISCARD
    assert bearing.rate("preload", 1.0, order=2) == ERROR


def test_derivatives_of_outputs(master, expected):
    bearing = master().start()
    names = ("friction_torque", "inner_ring.velocity.z", "mic[1].pressure")
    answer, slope = bearing.slope(names[0])
    assert answer == expected["output derivative"]
    if answer == ERROR:
        assert bearing.description.coSimulation.maxOutputDerivativeOrder == 0
        assert bearing.step(0.0) == OK
        return
    assert slope == 0.0
    for i in range(5):
        before = [bearing.get(name) for name in names]
        assert bearing.step(i * SIZE, SIZE) == OK
        for name, value in zip(names, before, strict=True):
            assert bearing.slope(name) == (OK, (bearing.get(name) - value) / SIZE)


# --- communication steps ------------------------------------------------------------------------------------


def test_steps_of_changing_length(master):
    bearing, time = master().start(), 0.0
    for size in (1e-6, 3e-3, 1e-5, 1.7e-4, 1e-12, 2e-4, 1e-3):
        assert bearing.step(time, size) == OK
        time += size
        assert bearing.last_time() == (OK, pytest.approx(time, abs=1e-15))
    assert not any(map(math.isnan, bearing.everything()))
    # a kinematic value that does not depend on the way there
    assert bearing.get("cage.speed_ratio") == pytest.approx(0.42, abs=0.02)
    assert bearing.step(time, STEP) == OK


def steady(bearing, size, until=0.15, begin=0.1):
    """Means of torque and heat over the last third, and level at the end, of a run at constant inputs."""
    count = round(until / size)
    sums = dict.fromkeys(("friction_torque", "heat.oil", "heat.inner_ring"), 0.0)
    taken = 0
    for i in range(count):
        assert bearing.step(i * size, size) == OK
        if i * size >= begin:
            taken += 1
            for name in sums:
                sums[name] += bearing.get(name)
    return {name: total / taken for name, total in sums.items()}, bearing.get("mic[1].leq")


def test_results_do_not_depend_on_the_communication_step(master):
    # design figures: steady means to 0.5 %, levels to 0.3 dB. Heats are means over each step; the torque is
    # that of the step's end, so it is compared between steps short enough to sample its ripple
    fine, loud = steady(master().start(), 5e-5)
    for size in (1e-4, 2e-4):
        means, level = steady(master().start(), size)
        for name, mean in means.items():
            assert mean == pytest.approx(fine[name], rel=5e-3), (name, size)
        assert level == pytest.approx(loud, abs=0.3)
    means, level = steady(master().start(), 1e-3)
    assert means["heat.oil"] == pytest.approx(fine["heat.oil"], rel=5e-3)
    assert level == pytest.approx(loud, abs=0.3)
