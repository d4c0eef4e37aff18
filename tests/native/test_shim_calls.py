"""Which call is allowed when, and that no call brings the process down."""

from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p

import pytest

from .master import DISCARD, ERROR, OK, SIGNATURES, Callbacks
from .toy import GUID

WORDS = {
    "instantiated": "before initialisation",
    "initialising": "in initialisation",
    "stepping": "between steps",
    "terminated": "after termination",
    "failed": "after an error",
}

# The call, what it is named in messages, and the phases in which it is allowed.
ORDER = (
    (lambda m: m.setup(), "setupExperiment", {"instantiated"}),
    (lambda m: m.enter(), "enterInitializationMode", {"instantiated"}),
    (lambda m: m.exit(), "exitInitializationMode", {"initialising"}),
    (lambda m: m.step(0.0), "doStep", {"stepping"}),
    (lambda m: m.call("Terminate"), "terminate", {"stepping"}),
    (lambda m: m.set("speed", 1.0), "setting values", {"instantiated", "initialising", "stepping"}),
    (lambda m: m.rate("speed", 1.0), "setRealInputDerivatives", {"instantiated", "initialising", "stepping"}),
    (lambda m: m.slope("angle")[0], "getRealOutputDerivatives", {"stepping", "terminated", "failed"}),
    (lambda m: m.last_time()[0], "getStatus", {"stepping", "terminated", "failed"}),
    (lambda m: m.read("angle")[0], "getting values", set(WORDS)),
    (lambda m: m.call("Reset"), "reset", set(WORDS)),
    (lambda m: m.release(m.keep()), "FMU state", set(WORDS)),
    (lambda m: m.call("SetDebugLogging", 1, 0, None), "setDebugLogging", set(WORDS)),
)


def bring(master, phase):
    """Lead an instance into a phase."""
    one = master()
    if phase in ("stepping", "terminated"):
        one.start()
    if phase == "initialising":
        assert one.setup() == one.enter() == OK
    if phase == "terminated":
        assert one.call("Terminate") == OK
    if phase == "failed":
        assert one.call("Terminate") == ERROR
    one.log.clear()
    return one


@pytest.mark.parametrize("phase", WORDS)
@pytest.mark.parametrize(("call", "name", "phases"), ORDER, ids=[row[1] for row in ORDER])
def test_order_of_calls(master, phase, call, name, phases):
    one = bring(master, phase)
    status = call(one)
    if phase in phases:
        assert status == OK, one.messages
    else:
        assert status == ERROR
        assert one.log[-1][:2] == (ERROR, "logStatusError")
        assert f"{name} called {WORDS[phase]}" in one.messages
        assert one.call("Reset") == OK
        one.start().run(1)


def test_error_stays_until_reset_or_an_earlier_state(master):
    one = master().start()
    good = one.keep()
    before = one.everything()
    assert one.step(0.5) == ERROR
    assert one.step(0.0) == ERROR
    assert one.everything() == before
    bad = one.keep()
    assert one.put_back(good) == OK
    assert one.step(0.0) == OK
    assert one.put_back(bad) == OK
    assert one.step(0.0) == ERROR
    assert one.call("Reset") == OK
    one.start().run(1)
    assert one.release(good) == one.release(bad) == OK


def test_error_of_one_instance_is_not_that_of_another(master):
    pair = master().start(), master().start()
    assert pair[0].step(7.0) == ERROR
    assert pair[1].step(0.0) == OK


def test_versions(functions):
    assert functions.fmi2GetVersion() == b"2.0"
    assert functions.fmi2GetTypesPlatform() == b"default"


@pytest.mark.parametrize("name", SIGNATURES)
def test_no_instance_is_an_error(functions, name):
    numbers = {c_int: 0, c_double: 0.0, c_size_t: 0}
    zeros = [numbers.get(kind) for kind in SIGNATURES[name]]
    assert getattr(functions, f"fmi2{name}")(None, *zeros) == ERROR
    functions.fmi2FreeInstance(None)


def pointers(name):
    """Places of the arguments that are pointers to something the call needs."""
    kinds = SIGNATURES[name]
    return [i for i, kind in enumerate(kinds) if kind in (c_void_p, c_char_p) or hasattr(kind, "contents")]


def good_arguments(name, one):
    """Arguments with which a call is not refused for a NULL."""
    array = {c_uint: (c_uint * 1)(0), c_double: (c_double * 1)(1.0), c_int: (c_int * 1)(1)}
    values = []
    for kind in SIGNATURES[name]:
        if kind is c_void_p:
            values.append(one.keep())
        elif kind is c_char_p:
            values.append(b" " * 1000)
        elif kind is POINTER(c_void_p):
            values.append(byref(c_void_p()))
        elif kind is POINTER(c_size_t):
            values.append(byref(c_size_t()))
        elif kind is POINTER(c_char_p):
            values.append((c_char_p * 1)(b"logAll"))
        elif hasattr(kind, "contents"):
            values.append(array[kind._type_])
        else:
            values.append(1.0 if kind is c_double else 1)
    return values


@pytest.mark.parametrize(
    ("name", "place"), [(name, place) for name in SIGNATURES for place in pointers(name)]
)
def test_missing_argument_is_refused(master, name, place):
    one = master().start()
    arguments = good_arguments(name, one)
    arguments[place] = None
    status = one.call(name, *arguments)
    if name == "FreeFMUstate":
        assert status == OK  # nothing to free
    else:
        assert status == ERROR
        assert one.log


@pytest.mark.parametrize("kind", ["Real", "Integer", "Boolean", "String"])
def test_no_values_need_no_arrays(master, kind):
    one = master().start()
    assert one.call(f"Get{kind}", None, 0, None) == OK
    assert one.call(f"Set{kind}", None, 0, None) == OK
    assert one.call("SetRealInputDerivatives", None, 0, None, None) == OK
    assert one.call("GetRealOutputDerivatives", None, 0, None, None) == OK
    assert one.step(0.0) == OK


def test_instantiate_without_callbacks(functions, resources):
    arguments = (b"toy", 1, b"x", resources.as_uri().encode())
    assert functions.fmi2Instantiate(*arguments, None, 0, 1) is None
    assert functions.fmi2Instantiate(*arguments, byref(Callbacks()), 0, 1) is None


def test_instance_without_logger_or_name_works(functions, resources):
    location, callbacks = resources.as_uri().encode(), Callbacks()
    instance = functions.fmi2Instantiate(None, 1, GUID.encode(), location, byref(callbacks), 0, 1)
    assert instance
    assert functions.fmi2Terminate(instance) == ERROR
    functions.fmi2FreeInstance(instance)


@pytest.mark.parametrize("guid", ["{0}", "", None])
def test_wrong_guid(master, guid):
    one = master(guid=guid)
    assert one.instance is None
    assert one.log[-1][:2] == (ERROR, "logStatusError")
    assert "wrong GUID" in one.messages
    assert f"asks for {'(null)' if guid is None else guid}, " in one.messages


def test_model_exchange_is_refused(master):
    one = master(kind=0)
    assert one.instance is None
    assert "co-simulation" in one.messages


def test_cancel_and_directional_derivatives_are_errors(master):
    one = master().start()
    assert one.call("CancelStep") == ERROR
    assert "a step cannot be cancelled" in one.messages
    assert one.step(0.0) == OK  # a host may call it while a step is running: the instance goes on
    two = master().start()
    unknown = (c_double * 1)()
    reference = (c_uint * 1)(0)
    assert two.call("GetDirectionalDerivative", reference, 1, reference, 1, unknown, unknown) == ERROR
    assert "directional derivatives" in two.messages


def test_status_of_the_last_step(master):
    one = master().start(time=2.0)
    assert one.last_time() == (OK, 2.0)
    assert one.step(2.0) == OK
    assert one.last_time() == (OK, 2.1)
    truth = c_int(5)
    assert one.call("GetBooleanStatus", 3, byref(truth)) == OK
    assert truth.value == 0
    for kind in (0, 1, 3):
        assert one.call("GetStatus", kind, byref(c_int())) == DISCARD
        assert one.call("GetRealStatus", kind, byref(c_double())) == DISCARD
        assert one.call("GetIntegerStatus", kind, byref(c_int())) == DISCARD
    assert one.call("GetStringStatus", 1, byref(c_char_p())) == DISCARD
    assert "no step is pending" in one.messages
    assert one.step(2.1) == OK
