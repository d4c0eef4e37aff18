"""The FMU in a master: values, what is refused and how it is said, and the log."""

import ctypes
import math
import time
from contextlib import ExitStack

import fmpy
import pytest
from fmpy.fmi1 import FMICallException

from .conftest import DISCARD, ERROR, OK, STEP, WARNING


def test_start_values_are_those_of_the_description(master):
    bearing = master()
    for variable in bearing.description.modelVariables:
        if variable.start is not None and variable.type != "String":
            assert bearing.get(variable.name) == float(variable.start), variable.name


def test_outputs_read_before_initialisation_are_zero_and_said_once(master):
    bearing, other = master(), master().start()
    assert bearing.read("preload", "friction_torque", "heat.oil") == (OK, [500.0, 0.0, 0.0])
    assert bearing.read("heat.oil") == (OK, [0.0])
    (said,) = bearing.log
    assert said[0] == WARNING
    before, _, after = said[2].partition(": ")
    assert before == "friction_torque is read before initialisation"
    assert after == "outputs are 0 until fmi2EnterInitializationMode is called"
    assert bearing.start().run(2) == other.run(2)
    assert bearing.reset() == OK
    assert bearing.read("heat.oil") == (OK, [0.0])
    assert bearing.log[-1][2].startswith("heat.oil is read before initialisation")


def test_outputs_follow_the_inputs_while_initialising(master):
    bearing, other = master(), master()
    assert bearing.setup() == bearing.enter() == OK
    before = bearing.get("contact.inner.load_mean")
    assert bearing.set("preload", 300.0) == OK
    after = bearing.get("contact.inner.load_mean")
    assert bearing.exit() == OK
    other.start(preload=300.0)
    assert before > after > 0.0
    assert bearing.everything() == other.everything()
    assert bearing.run(2) == other.run(2)


def test_setting_an_input_changes_no_output_until_the_next_step(master):
    # what dependencies="" in ModelStructure/Outputs promises
    bearing = master().start()
    bearing.run(1)
    outputs = [name for name, variable in bearing.by_name.items() if variable.causality == "output"]
    before = bearing.read(*outputs)
    assert bearing.set("shaft_speed", 1000.0) == bearing.set("preload", 200.0) == OK
    assert bearing.read(*outputs) == before


# --- refusals ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 2e4, -1.0])
def test_bad_value_is_named_and_not_taken(master, expected, value):
    bearing, untouched = master().start(), master().start()
    answer = bearing.set("preload", value)
    assert bearing.log[-1][:2] == (DISCARD, "logStatusDiscard")
    assert f"preload = {float(value)!r} is refused: allowed are 0 to 10000 N" in bearing.messages
    before = bearing.everything()
    assert before == untouched.everything()
    next_step = bearing.step(0.0)
    assert (answer, next_step) == expected["value out of range"]
    if next_step == OK:
        assert bearing.everything() == untouched.run(1)[0]
        return
    assert bearing.everything() == before
    assert bearing.last_time() == (OK, 0.0)
    assert bearing.set("preload", float(bearing.by_name["preload"].start)) == OK
    assert bearing.run(2) == untouched.run(2)


def test_others_of_the_same_call_are_taken(master, expected):
    bearing = master().start()
    answer = bearing.set_many(shaft_speed=1500.0, preload=math.nan, oil_temperature=300.0)
    assert answer == expected["value out of range"][0]
    assert bearing.read("shaft_speed", "preload", "oil_temperature") == (OK, [1500.0, 500.0, 300.0])


def test_zeros_of_a_master_that_loads_wait_for_true_values(master):
    """Masters set every input to 0 while they load: it begins with its start values, but steps wait."""
    bearing, untouched = master(), master().start()
    inputs = [v.name for v in bearing.description.modelVariables if v.causality == "input"]
    kelvins = [name for name in inputs if "temperature" in name]
    for name in inputs:
        assert bearing.set(name, 0.0) == OK
    assert [text for status, _, text in bearing.log if status == WARNING and "not taken yet" in text]
    said = "oil_temperature = 0.0 is refused: allowed are 233 to 473 K; initialisation uses the start value"
    assert f"{said} 293.15" in bearing.messages
    # 0 is a speed, a load and a preload: those were taken
    for name in ("shaft_speed", "preload"):
        assert bearing.set(name, untouched.get(name)) == OK
    assert bearing.start().get("oil_temperature") == 293.15
    assert bearing.everything() == untouched.everything()
    assert bearing.step(0.0) == DISCARD
    status, _, late = bearing.log[-1]
    assert status == DISCARD and all(f"{name} = 0.0 is refused: allowed are" in late for name in kelvins)
    assert late.endswith("set before the end of initialisation, and no value in the range has come since")
    assert bearing.last_time() == (OK, 0.0)
    for name in kelvins:  # each step waits for another one
        assert bearing.set(name, untouched.get(name)) == OK
        assert bearing.step(0.0) == DISCARD
    assert bearing.set("pedestal_stiffness", untouched.get("pedestal_stiffness")) == OK
    assert bearing.run(2) == untouched.run(2)


@pytest.mark.parametrize("size", [STEP, 0.5 * STEP])
def test_a_step_that_waits_in_vain_is_refused_for_good(master, expected, size):
    """FMPy repeats a discarded step for ever; others repeat it with half of its size."""
    bearing = master()
    assert bearing.set("shaft_speed", 1e6) == bearing.set("oil_temperature", 0.0) == OK
    bearing.start()
    assert bearing.step(0.0) == DISCARD
    assert bearing.set("oil_temperature", 300.0) == OK
    assert bearing.step(0.0) == DISCARD  # one of the two values came
    assert bearing.set("preload", 400.0) == OK  # which does not matter
    assert bearing.step(0.0, size) == expected["step refused again"]
    (late,) = [text for _, category, text in bearing.log if category == "logStatusError"]
    assert "shaft_speed = 1000000.0 is refused: allowed are -10472 to 10472 rad/s; set before" in late
    assert late.startswith(f"step from 0.0 s by {size!r} s refused: ")
    assert late.endswith("no value in the range has come since; again, and nothing was changed")


def test_the_other_refusals_of_a_step_do_not_repeat_for_ever(master, expected):
    bearing, other = master().start(), master().start()
    assert [bearing.step(0.0, size) for size in (1e6, 2e6, 1e6)] == [DISCARD] * 3  # each is another request
    assert bearing.step(0.0, 1e6) == expected["step refused again"]
    assert other.step(0.0, 1e6) == DISCARD
    state = other.keep()
    for change in (lambda: other.set("preload", 450.0), lambda: other.put_back(state)):
        assert change() == OK
        assert other.step(0.0, 1e6) == DISCARD
    other.release(state)
    assert other.step(0.0) == OK
    assert other.step(STEP, 1e6) == DISCARD


def test_stock_fmpy_ends_at_a_start_value_out_of_range(fmu, flavour, expected):
    log = []
    begun = time.perf_counter()
    with ExitStack() as stack:
        raised = flavour == "native" and stack.enter_context(
            pytest.raises(FMICallException, match=r"fmi2DoStep failed with status 3 \(error\)")
        )
        found = fmpy.simulate_fmu(
            str(fmu), stop_time=0.01, output_interval=1e-3, start_values={"preload": -5.0}, timeout=30.0,
            debug_logging=True, logger=lambda *said: log.append(said[-1].decode()),
        )  # fmt: skip
    assert time.perf_counter() - begun < 20.0  # s: it takes a second, and the Python build loads its kernels
    assert any("preload = -5.0 is refused: allowed are 0 to 10000 N" in said for said in log)
    if raised:
        assert log[-1].endswith("; again, and nothing was changed")
    else:  # pythonfmu asks it to end
        assert found["time"].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("goes_on", [False, True])
def test_whether_a_refused_step_asks_the_host_to_end(master, expected, goes_on):
    bearing, answer = master().start(), ctypes.c_int(7)
    assert bearing.step(0.0, 1e6) == DISCARD
    assert not goes_on or bearing.step(0.0) == OK
    assert bearing.call("GetBooleanStatus", 3, ctypes.byref(answer)) == OK
    assert answer.value == expected["asked to end after fmi2Discard"]


def test_a_value_that_waits_is_part_of_the_state(master):
    bearing, other = master(), master()
    assert bearing.set("oil_temperature", 0.0) == OK
    bearing.start()
    state = bearing.keep()
    assert bearing.set("oil_temperature", 300.0) == bearing.step(0.0) == OK
    assert bearing.put_back(state) == OK
    assert bearing.step(0.0) == DISCARD
    status, copy = other.from_bytes(bearing.to_bytes(state))
    assert status == other.put_back(copy) == OK
    assert other.step(0.0) == DISCARD
    bearing.release(state), other.release(copy)
    bearing.reset()
    assert bearing.start().step(0.0) == OK


def test_what_is_no_number_does_not_wait(master, expected):
    bearing = master()
    answer = bearing.set("oil_temperature", math.nan)
    assert (answer, bearing.start().step(0.0)) == expected["value out of range"]
    assert "value not taken: oil_temperature = nan is refused" in bearing.messages
    assert bearing.get("oil_temperature") == 293.15


def test_a_parameter_out_of_range_does_not_wait(master, expected):
    bearing = master()
    answer = bearing.set("max_internal_step", 1.0)
    assert (answer, bearing.start().step(0.0)) == expected["value out of range"]


def test_bound_may_carry_rounding(master):
    bearing = master().start()
    assert bearing.set("preload", 1e4 * (1.0 + 1e-13)) == OK
    assert bearing.step(0.0) == OK
    # 10 kN reach beyond the shoulders, which it says; it is not refused
    assert all("beyond its shoulder" in text for _, _, text in bearing.log)


def test_parameters_are_fixed_after_initialisation(master, expected):
    bearing = master().start()
    before = bearing.get("max_internal_step")
    assert bearing.set("max_internal_step", before) == OK
    answer = bearing.set("max_internal_step", 0.5 * before)
    assert bearing.get("max_internal_step") == before
    assert (answer, bearing.step(0.0)) == expected["parameter after initialisation"]
    assert "parameters cannot be set between steps" in bearing.messages


@pytest.mark.parametrize(
    "name", ["friction_torque", "rotor.inertia", "mic[1].position.x", "solver.steps", "fidelity"]
)
def test_what_is_computed_or_constant_cannot_be_set(master, expected, name):
    bearing = master().start()
    before = bearing.get(name)
    answer = bearing.set(name, 0)
    assert (answer, bearing.step(0.0)) == expected["what cannot be set"]
    assert f"{name} = 0" in bearing.messages
    assert "is refused: it is computed, not set" in bearing.messages
    assert bearing.get(name) == before


def test_tolerance_of_the_experiment_wins(master):
    bearing = master()
    assert bearing.set("tolerance", 1e-3) == OK
    assert bearing.start(tolerance=1e-4).get("tolerance") == 1e-4


def test_tolerance_out_of_range_counts_as_the_bound(master):
    for given, taken in ((0.0, 1e-6), (1e-7, 1e-6), (0.5, 0.1)):
        bearing = master()
        assert bearing.setup(0.0, given) == OK
        assert bearing.log[-1][0] == WARNING
        assert f"tolerance {given!r} is taken as {taken!r}: allowed are 1e-06 to 0.1" in bearing.messages
        assert bearing.enter() == bearing.exit() == bearing.step(0.0) == OK
        assert bearing.get("tolerance") == taken


def test_tolerance_that_is_no_number_is_an_error(master, expected):
    bearing = master()
    answer = bearing.setup(0.0, math.nan)
    bearing.enter()
    bearing.exit()
    assert (answer, bearing.step(0.0)) == expected["tolerance not finite"]
    assert "the experiment's tolerance nan is not a finite number" in bearing.messages


@pytest.mark.parametrize("reference", [100_000, "preload"])
def test_unknown_reference_is_an_error(master, expected, reference):
    # there is none, or it is that of a Real
    bearing, other = master().start(), master().start()
    status, values = bearing.read(reference, kind="Integer")
    assert values == [0]
    assert (status, bearing.step(0.0)) == expected["unknown value reference"]
    number = bearing.references.get(reference, reference)
    assert f"there is no Integer with value reference {number}" in bearing.messages
    answer = other._set(number, 3, "Integer")
    assert (answer, other.step(0.0)) == expected["unknown value reference"]


@pytest.mark.parametrize("kind", ["Boolean", "String"])
def test_types_that_the_interface_does_not_have(master, expected, kind):
    bearing, other = master().start(), master().start()
    status, values = bearing.read("preload", kind=kind)
    assert not values[0]
    assert (status, bearing.step(0.0)) == expected["unknown value reference"]
    answer = other.set("preload", b"x" if kind == "String" else 1, kind)
    assert (answer, other.step(0.0)) == expected["unknown value reference"]
    assert f"there is no {kind} with value reference" in other.messages


def test_no_value_is_ever_nan(master):
    bearing = master()
    assert not any(map(math.isnan, bearing.everything()))
    assert not any(map(math.isnan, bearing.start().everything()))
    assert not any(map(math.isnan, bearing.run(1)[0]))


# --- the log ----------------------------------------------------------------------------------------------


def categories(*names):
    return len(names), (ctypes.c_char_p * max(1, len(names)))(*(name.encode() for name in names))


def provoke(bearing):
    """Make a message of category discard, and one of category error."""
    bearing.reset()
    bearing.start()
    bearing.set("preload", -1.0)
    bearing.exit()


def test_nothing_is_logged_with_logging_off(master):
    bearing = master(logging=False)
    provoke(bearing)
    assert bearing.log == []


BOTH = {"logStatusDiscard", "logStatusError"}


@pytest.mark.parametrize(
    ("names", "received"),
    [
        ((), BOTH),
        (("logStatusError",), {"logStatusError"}),
        (("logStatusDiscard",), {"logStatusDiscard"}),
        (("logStatusDiscard", "logStatusError"), BOTH),
        (("logStatusWarning",), set()),
    ],
)
def test_log_categories_can_be_asked_for(master, names, received):
    bearing = master(logging=False)
    assert bearing.call("SetDebugLogging", 1, *categories(*names)) == OK
    provoke(bearing)
    assert {category for _, category, _ in bearing.log} == received
    bearing.log.clear()
    assert bearing.call("SetDebugLogging", 0, 0, None) == OK
    provoke(bearing)
    assert bearing.log == []


def test_category_that_means_all(master, expected):
    bearing = master(logging=False)
    assert bearing.call("SetDebugLogging", 1, *categories("logAll")) == OK
    provoke(bearing)
    assert {category for _, category, _ in bearing.log} == expected["category logAll"]


def test_category_that_there_is_not(master, expected):
    bearing = master().start()
    answer = bearing.call("SetDebugLogging", 1, *categories("nonsense"))
    assert answer == expected["unknown log category"]
    assert ("there is no log category nonsense" in bearing.messages) == (answer == ERROR)
    assert bearing.step(0.0) == OK


def test_warning_of_a_state_beyond_the_shoulder(master):
    bearing = master().start(preload=1e4)
    assert bearing.log[-1][:2] == (1, "logStatusWarning")
    assert "deg beyond its shoulder (bearing.inner_ring_outer_diameter_mm)" in bearing.messages
    assert bearing.run(1, size=STEP)
