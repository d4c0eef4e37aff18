"""The FMU in a master: what it answers to right and to wrong calls."""

import math

import pytest
from fmpy.fmi1 import FMICallException

from fmu_bearing.instance import Instance

from .conftest import STEP

DISCARD, ERROR = 2, 3


def refused(call, *arguments):
    """Whether fmpy reports fmi2Discard, and nothing worse, for a call."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    return caught.value.status == DISCARD


def test_start_values_are_those_of_the_description(master):
    bearing = master()
    for variable in bearing.description.modelVariables:
        if variable.start is not None:
            assert bearing.get(variable.name) == float(variable.start), variable.name


def test_fmu_gives_the_bits_of_the_library(master, model):
    bearing = master().start()
    alone = Instance(model)
    alone.initialise(0.0)
    reals = [v.name for v in model.variables if v.type == "Real"]
    for i, speed in enumerate((2000.0, 2100.0, 1900.0)):
        bearing.set("shaft_speed", speed)
        alone.set("shaft_speed", speed)
        bearing.step(i * STEP)
        alone.step(STEP)
        assert bearing.reals() == [alone.get(name) for name in reals]


def test_outputs_follow_the_inputs_while_initialising(master):
    bearing, other = master(), master()
    bearing.slave.setupExperiment(startTime=0.0)
    bearing.slave.enterInitializationMode()
    before = bearing.get("contact.inner.load_mean")
    bearing.set("preload", 300.0)
    after = bearing.get("contact.inner.load_mean")
    bearing.slave.exitInitializationMode()
    other.start(preload=300.0)
    assert before > after > 0.0
    assert bearing.reals() == other.reals()
    assert bearing.run(2) == other.run(2)


def test_setting_an_input_changes_no_output_until_the_next_step(master):
    # what dependencies="" in ModelStructure/Outputs promises
    bearing = master().start()
    bearing.run(1)
    outputs = [v.valueReference for v in bearing.description.modelVariables if v.causality == "output"]
    before = bearing.slave.getReal(outputs)
    bearing.set("shaft_speed", 1000.0)
    bearing.set("preload", 200.0)
    assert bearing.slave.getReal(outputs) == before


def test_reset_equals_a_fresh_instance(master):
    used, fresh = master(), master().start()
    used.start(preload=250.0, shaft_speed=500.0)
    used.run(3)
    used.set("preload", math.nan)
    used.slave.reset()
    used.start()
    assert used.run(3) == fresh.run(3)


def test_interleaved_instances_equal_lone_ones(master):
    loads = (400.0, 250.0)
    lone = [master().start(preload=load).run(3) for load in loads]
    pair = [master().start(preload=load) for load in loads]
    together = [[one.run(1, i * STEP)[0] for one in pair] for i in range(3)]
    assert [list(each) for each in zip(*together, strict=True)] == lone


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 2e4, -1.0])
def test_bad_value_is_named_and_refuses_the_step(master, value):
    bearing, untouched = master().start(), master().start()
    bearing.set("preload", value)
    assert bearing.log[-1][:2] == (DISCARD, "logStatusDiscard")
    for part in ("preload", str(float(value)), "0 to 10000"):
        assert part in bearing.messages
    before = bearing.reals()
    assert refused(bearing.step, 0.0)
    assert bearing.reals() == before == untouched.reals()
    assert bearing.slave.getRealStatus(2) == 0.0  # fmi2LastSuccessfulTime
    bearing.set("preload", float(bearing.by_name["preload"].start))
    assert bearing.run(2) == untouched.run(2)


def test_bad_value_before_initialisation_is_not_forgotten(master):
    bearing = master().start(oil_temperature=20.0)  # degC where K is asked
    assert refused(bearing.step, 0.0)
    assert "oil_temperature" in bearing.messages
    bearing.set("oil_temperature", 293.15)
    bearing.step(0.0)


@pytest.mark.parametrize("size", [0.0, -1e-4, math.nan, math.inf])
def test_step_that_is_no_step_is_refused(master, size):
    bearing, untouched = master().start(), master().start()
    assert refused(bearing.step, 0.0, size)
    assert repr(size) in bearing.messages
    assert bearing.run(1) == untouched.run(1)


@pytest.mark.parametrize("time", [0.0, 1.0, math.nan, STEP + 2e-9])
def test_wrong_communication_time_is_refused(master, time):
    bearing = master().start()
    bearing.run(1)
    assert refused(bearing.step, time)
    assert repr(time) in bearing.messages
    assert repr(STEP) in bearing.messages
    bearing.step(STEP)


def test_masters_may_count_time_in_different_ways(master):
    bearing = master().start(time=10.0)
    bearing.step(10.0)
    bearing.step(10.0 + STEP + 1e-10)


def test_calls_out_of_order_are_refused_until_reset(master):
    bearing = master()
    assert refused(bearing.step, 0.0)
    bearing.slave.exitInitializationMode()
    assert bearing.log[-1][:2] == (ERROR, "logStatusError")
    assert refused(bearing.start().step, 0.0)
    bearing.slave.reset()
    bearing.start().step(0.0)
    bearing.slave.terminate()
    assert refused(bearing.step, STEP)


def test_parameters_are_fixed_after_initialisation(master):
    bearing = master().start()
    before = bearing.get("max_internal_step")
    bearing.set("max_internal_step", 0.5 * before)
    assert bearing.get("max_internal_step") == before
    assert refused(bearing.step, 0.0)
    bearing.set("max_internal_step", before)
    bearing.step(0.0)


def test_outputs_and_constants_cannot_be_set(master):
    for name in ("friction_torque", "rotor.inertia"):
        bearing = master().start()
        bearing.set(name, 0.0)
        assert name in bearing.messages
        assert refused(bearing.step, 0.0)


def test_tolerance_of_the_experiment_wins(master):
    bearing = master()
    bearing.set("tolerance", 1e-3)
    assert bearing.start(tolerance=1e-4).get("tolerance") == 1e-4
    bearing.slave.reset()
    assert refused(bearing.start(tolerance=math.nan).step, 0.0)
    assert "tolerance = nan" in bearing.messages


def test_unknown_reference_is_an_error(master):
    bearing = master().start()
    assert bearing.slave.getReal([100_000]) == [0.0]
    assert "100000" in bearing.messages
    assert refused(bearing.step, 0.0)
    other = master().start()
    other.slave.setInteger([other.by_name["preload"].valueReference], [3])
    assert refused(other.step, 0.0)


def test_nothing_is_logged_with_logging_off(master):
    bearing = master(logging=False).start(preload=-1.0)
    assert refused(bearing.step, 0.0)
    assert bearing.log == []


def test_one_log_category_can_be_asked_for(master):
    bearing = master()
    bearing.slave.setDebugLogging(True, ["logStatusError"])
    bearing.start(preload=-1.0)
    assert bearing.log == []
    bearing.slave.enterInitializationMode()
    assert [category for _, category, _ in bearing.log] == ["logStatusError"]


def test_no_value_is_ever_nan(master):
    bearing = master()
    assert not any(map(math.isnan, bearing.reals()))
    assert not any(map(math.isnan, bearing.start().reals()))
    assert not any(map(math.isnan, bearing.run(1)[0]))
