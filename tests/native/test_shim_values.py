"""Values: what is taken, what is refused and how it is said, and what is read when."""

import ctypes
import locale
import math
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from .master import DISCARD, ERROR, OK, WARNING, Master, load
from .toy import IS_X86, compile_library, write_model


def test_starts_are_read_before_initialisation(master):
    one = master()
    assert one.read("speed", "load", "tolerance", "gain") == (OK, [3.0, 50.0, 1e-3, 1.0])
    assert one.read("angle", "margin") == (OK, [0.0, 0.0])


def test_constants_of_every_type(master):
    one = master()
    assert one.get("fixed_real") == 2.5
    assert one.get("fixed_whole", "Integer") == 7
    assert one.get("fixed_truth", "Boolean") == 1
    assert one.get("fixed_text", "String").decode() == "grün"


def test_integers_of_the_engine(master):
    one = master().start()
    one.run(3)
    assert one.get("steps", "Integer") == 3


def test_kernels_get_the_lengths_of_the_arrays(master):
    assert master().start().get("sizes") == 3 + 4 + 5 + 7 + 2


def best_level():
    """Level of x86-64 that this processor has."""
    if not (IS_X86 and Path("/proc/cpuinfo").exists()):
        pytest.skip("needs x86-64 and Linux's list of what it can")
    flags = f" {Path('/proc/cpuinfo').read_text()} "
    return 3 if all(f" {flag} " in flags for flag in ("avx2", "bmi2", "fma", "movbe", "abm")) else 2


def test_instruction_set_is_chosen_when_an_instance_is_made(master, monkeypatch):
    best = best_level()
    assert master().start().get("mark", "Integer") == best
    monkeypatch.setenv("FMU_BEARING_ISA", "v2")
    assert master().start().get("mark", "Integer") == 2
    monkeypatch.setenv("FMU_BEARING_ISA", "v9")
    assert master().start().get("mark", "Integer") == best


@pytest.fixture(scope="module")
def narrow(compiler, tmp_path_factory):
    """Functions of a library with the newer instruction set alone, for models whose p[1] is not zero."""
    options = ("-DFB_NEWER_ONLY", "-DFB_ALONE=1")
    return load(compile_library(tmp_path_factory.mktemp("narrow"), *options, compiler=(compiler,)))


@pytest.mark.heavy
def test_library_with_one_instruction_set_takes_it_or_says_why_not(narrow, resources, monkeypatch):
    monkeypatch.setenv("FMU_BEARING_ISA", "v2")
    best = best_level()
    one = Master(narrow, resources)
    if best == 3:
        assert one.start().get("mark", "Integer") == 3
        one.free()
    else:
        assert "built for x86-64-v3 alone (AVX2), which this processor lacks" in one.messages


def test_library_for_single_bearings_refuses_a_set(narrow, tmp_path):
    one = Master(narrow, write_model(tmp_path, parameters=[1e-3, 0.0, 42.0]))
    assert one.instance is None
    assert "holds the equations of single bearings alone, and the model is a set" in one.messages


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -1e-3, 1e4 + 1e-3])
def test_value_out_of_range_is_not_taken(master, value):
    one, untouched = master().start(), master().start()
    assert one.set("load", value) == DISCARD
    assert one.log[-1][:2] == (DISCARD, "logStatusDiscard")
    assert f"load = {value!r} is refused: allowed are 0 to 10000 N" in one.messages
    assert one.get("load") == 50.0
    assert one.run(2) == untouched.run(2)


def test_bound_may_carry_rounding(master):
    one = master().start()
    assert one.set("load", 1e4 * (1 + 1e-13)) == OK
    assert one.set("load", -1e-9) == OK
    assert one.set("load", 1e4 * (1 + 1e-11)) == DISCARD


def test_others_of_the_same_call_are_taken(master):
    one = master().start()
    assert one.set_many(speed=7.0, load=math.nan, trouble=0.5) == DISCARD
    assert one.read("speed", "load", "trouble") == (OK, [7.0, 50.0, 0.5])


def test_bad_start_value_leaves_the_good_one(master):
    one = master()
    assert one.set("load", 80.0) == one.set("load", -5.0) == OK  # waits: see tests/fmi/test_values.py
    assert one.set("tolerance", 1.0) == DISCARD
    one.start()
    assert one.read("load", "load_held", "tolerance") == (OK, [50.0, 50.0, 1e-3])
    assert one.step(0.0) == DISCARD
    assert one.set("load", 70.0) == one.step(0.0) == OK


@pytest.mark.parametrize("name", ["angle", "fixed_real"])
def test_what_is_computed_cannot_be_set(master, name):
    one = master().start()
    assert one.set(name, 1.0) == ERROR
    assert f"{name} = 1.0 is refused: it is computed, not set" in one.messages
    assert one.step(0.0) == ERROR


def test_strings_cannot_be_set(master):
    one = master().start()
    assert one.set("fixed_text", b"blue", "String") == ERROR
    assert "fixed_text is refused: it is computed, not set" in one.messages
    assert one.get("fixed_text", "String").decode() == "grün"


def test_parameters_are_fixed_between_steps(master):
    one = master()
    assert one.set("gain", 2.0) == OK
    one.start()
    assert one.set("gain", 2.0) == OK
    one.run(1)
    assert one.set("gain", 3.0) == ERROR
    assert "gain = 3.0 is refused: parameters cannot be set between steps" in one.messages
    assert one.get("gain") == 2.0
    assert one.step(0.1) == ERROR


@pytest.mark.parametrize("kind", ["Real", "Integer", "Boolean", "String"])
def test_unknown_reference(master, kind):
    one = master().start()
    status, values = one.read(4_000_000_000, kind=kind)
    assert status == ERROR
    assert not values[0]
    assert f"there is no {kind} with value reference 4000000000" in one.messages
    two = master().start()
    assert two.set(99, b"x" if kind == "String" else 1, kind) == ERROR
    assert f"there is no {kind} with value reference 99" in two.messages


@pytest.mark.parametrize("kind", ["Integer", "Boolean", "String"])
def test_reference_of_another_type(master, kind):
    one = master().start()
    assert one.read("angle", kind=kind)[0] == ERROR
    two = master().start()
    assert two.set("speed", b"x" if kind == "String" else 1, kind) == ERROR
    assert f"there is no {kind} with value reference 0" in two.messages


def test_known_values_are_read_beside_unknown_ones(master):
    one = master().start()
    assert one.read("speed", 77, "load") == (ERROR, [3.0, 0.0, 50.0])


# --- initialisation -------------------------------------------------------------------------------


def test_outputs_follow_the_inputs_in_initialisation(master):
    one, other = master(), master()
    assert one.setup() == one.enter() == OK
    assert one.get("load_held") == 50.0
    assert one.set("load", 70.0) == OK
    assert one.get("load_held") == 70.0
    assert one.get("angle") == 1.0  # initialised again from an empty state, not on top of the last time
    assert one.exit() == OK
    other.start(load=70.0)
    assert one.run(2) == other.run(2)


def test_inputs_read_in_initialisation_settle_nothing(master):
    one = master()
    assert one.set("no_start", 4.0) == OK
    assert one.setup() == one.enter() == OK
    assert one.read("speed", "gain") == (OK, [3.0, 1.0])
    assert one.log == []


def test_no_equilibrium_is_an_error_at_the_end_of_initialisation(master):
    one = master()
    assert one.set("no_start", 4.0) == OK
    assert one.setup(2.0) == one.enter() == OK
    assert one.exit() == ERROR
    expected = "initialisation at t = 2.0 s: there is no equilibrium; inputs were speed = 3, load = 50, "
    assert one.log[-1] == (ERROR, "logStatusError", f"{expected}trouble = 0, no_start = 4")
    assert one.set("no_start", 0.0) == ERROR
    assert one.call("Reset") == OK
    one.start().run(1)


def test_no_equilibrium_while_asking_can_be_mended(master):
    one, other = master(), master().start()
    assert one.setup() == one.enter() == OK
    assert one.set("no_start", 4.0) == OK
    assert one.read("speed", "angle") == (ERROR, [3.0, 0.0])  # reading never answers fmi2Discard
    assert "there is no equilibrium" in one.messages
    assert one.set("no_start", 0.0) == OK
    assert one.get("angle") == 1.0
    assert one.exit() == OK
    assert one.run(2) == other.run(2)


def test_engine_refusal_without_text_has_a_number(master):
    one = master()
    assert one.set("no_start", 57.0) == OK
    assert one.setup() == one.enter() == OK
    assert one.exit() == ERROR
    assert "status 57" in one.messages


def test_caution_after_initialisation(master):
    one = master().start(load=150.25)
    assert one.log == [
        (WARNING, "logStatusWarning", "the margin is short by 100.5 half newtons"),
    ]
    assert master().start(load=100.0).log == []


def test_caution_about_an_input(master):
    one = master().start(load=0.25)
    assert one.log == [(WARNING, "logStatusWarning", "the load is 0 N")]


def test_caution_after_a_step_is_given_once(master):
    one = master().start(load=100.0)
    assert one.set("load", 110.0) == OK
    assert one.step(0.0, 1e-3) == one.step(1e-3, 1e-3) == OK
    assert one.log == [(WARNING, "logStatusWarning", "the margin is short by 20.0 half newtons")]


def test_tolerance_of_the_experiment_wins(master):
    one = master()
    assert one.set("tolerance", 1e-2) == OK
    one.start(tolerance=1e-4)
    assert one.get("tolerance") == 1e-4


@pytest.mark.parametrize(("given", "taken"), [(0.0, 1e-6), (1e-7, 1e-6), (-1.0, 1e-6), (1.0, 0.1)])
def test_tolerance_beyond_its_range_counts_as_the_bound(master, given, taken):
    one = master()
    assert one.setup(tolerance=given) == OK
    said = f"the experiment's tolerance {given!r} is taken as {taken!r}: allowed are 1e-06 to 0.1"
    assert one.log == [(WARNING, "logStatusWarning", said)]
    assert one.get("tolerance") == taken
    assert one.enter() == one.exit() == one.step(0.0) == OK


@pytest.mark.parametrize("given", [math.nan, math.inf, -math.inf])
def test_tolerance_must_be_finite(master, given):
    one = master()
    assert one.setup(tolerance=given) == ERROR
    assert f"the experiment's tolerance {given!r} is not a finite number" in one.messages
    assert one.enter() == ERROR


@pytest.mark.parametrize("time", [math.nan, math.inf, -math.inf])
def test_start_time_must_be_finite(master, time):
    one = master()
    assert one.setup(time) == ERROR
    assert f"start time {time!r} s is not a finite number" in one.messages
    assert one.enter() == ERROR


# --- the log --------------------------------------------------------------------------------------


def names(*categories):
    return len(categories), (ctypes.c_char_p * max(1, len(categories)))(*(c.encode() for c in categories))


def test_nothing_is_logged_with_logging_off(master):
    one = master(logging=False).start(load=150.0)
    assert one.set("load", math.nan) == DISCARD
    assert one.step(5.0) == ERROR
    assert one.log == []


@pytest.mark.parametrize(
    ("categories", "expected"),
    [
        ((), {"logStatusWarning", "logStatusDiscard", "logStatusError"}),
        (("logAll",), {"logStatusWarning", "logStatusDiscard", "logStatusError"}),
        (("logStatusError",), {"logStatusError"}),
        (("logStatusDiscard", "logStatusWarning"), {"logStatusDiscard", "logStatusWarning"}),
    ],
)
def test_only_categories_asked_for_are_logged(master, categories, expected):
    one = master(logging=False)
    assert one.call("SetDebugLogging", 1, *names(*categories)) == OK
    one.start(load=150.0)
    assert one.set("load", math.nan) == DISCARD
    assert one.step(5.0) == ERROR
    assert {category for _, category, _ in one.log} == expected
    assert one.call("SetDebugLogging", 0, 0, None) == OK
    one.log.clear()
    assert one.step(5.0) == ERROR
    assert one.log == []


def test_unknown_category_is_named_and_changes_nothing(master):
    one = master().start()
    assert one.call("SetDebugLogging", 1, *names("logStatusError", "logStatusFoo")) == ERROR
    assert "there is no log category logStatusFoo; there are logAll, logStatusWarning" in one.messages
    assert one.set("load", math.nan) == DISCARD
    assert one.log[-1][0] == DISCARD
    assert one.step(0.0) == OK


def test_reset_keeps_the_log_as_it_was_set(master):
    one = master()
    assert one.call("SetDebugLogging", 0, 0, None) == OK
    assert one.call("Reset") == OK
    assert one.step(0.0) == ERROR
    assert one.log == []


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(value=st.floats().filter(lambda x: not 0.0 <= x <= 1e4))
def test_numbers_are_written_as_python_writes_them(master, value):
    one = master().start()
    if one.set("load", value) == DISCARD:
        assert f"load = {value!r} is refused" in one.messages
    else:
        assert value == pytest.approx(0.0, abs=1e-8) or value == pytest.approx(1e4, rel=1e-12)
    one.free()


EDGES = (1e16, 1e15, 123456789012345680.0, 1e-4, 1e-5, 1.5e-7, 1.7976931348623157e308, -0.1, 1 / 3, 2.0**-24)


@pytest.mark.parametrize("value", EDGES)
def test_numbers_at_the_edges_of_a_notation(master, value):
    one = master().start()
    assert one.step(value) == ERROR
    assert f"the communication time {value!r} s is not the time reached, 0.0 s" in one.messages


def decimal_comma():
    """Set a locale with a decimal comma; whether there is one on this machine."""
    for name in ("de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"):
        try:
            locale.setlocale(locale.LC_NUMERIC, name)
        except locale.Error:
            continue
        return True
    return False


def test_locale_of_the_host_does_not_change_messages(master):
    one = master()
    if not decimal_comma():
        pytest.skip("no locale with a decimal comma is installed")
    try:
        one.start(load=150.25)
        assert one.set("load", -0.5) == DISCARD
    finally:
        locale.setlocale(locale.LC_NUMERIC, "C")
    assert "short by 100.5 half" in one.messages
    assert "load = -0.5 is refused" in one.messages
