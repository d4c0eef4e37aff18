"""The FMU in a master: order of calls, steps, refusals, and what follows them."""

import ctypes
import math
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from fmu_bearing.instance import Instance

from .conftest import DISCARD, ERROR, OK, STEP

# Nothing holds the outer ring against this load: it gives way until the engine gives up, after 4 ms.
# a ring that hangs 2.5 mm aside on a soft pedestal, which a stiff one flings
SOFT, HARD = {"radial_load.z": -300.0, "pedestal_stiffness": 1.2e5}, {"pedestal_stiffness": 1e11}
HARD_STEP = 0.01  # s, over half of it never reached


def test_fmu_gives_the_bits_of_the_library(master, model):
    bearing = master().start()
    alone = Instance(model)
    alone.initialise(0.0)
    names = [v.name for v in model.variables if v.type == "Real"]
    names += [v.name for v in model.variables if v.type == "Integer"]
    for i, speed in enumerate((2000.0, 2100.0, 1900.0)):
        bearing.set("shaft_speed", speed)
        alone.set("shaft_speed", speed)
        assert bearing.step(i * STEP) == OK
        alone.step(STEP)
        assert bearing.everything() == [alone.get(name) for name in names]


def test_versions(master):
    functions = master().functions
    assert functions.fmi2GetVersion() == b"2.0"
    assert functions.fmi2GetTypesPlatform() == b"default"


@pytest.mark.parametrize(
    ("behaviour", "options", "words"),
    [
        (
            "another GUID",
            {"guid": "{00000000-0000-0000-0000-000000000000}"},
            "wrong GUID: the host asks for {0000",
        ),
        ("model exchange", {"kind": 0}, "for co-simulation, not for model exchange"),
    ],
)
def test_instance_that_is_not_to_be(master, expected, behaviour, options, words):
    one = master(**options)
    if expected[behaviour] is None:
        assert one.instance is None
        assert one.log[-1][:2] == (ERROR, "logStatusError")
        assert words in one.messages
    else:
        assert one.start().step(0.0) == OK
    assert master().start().step(0.0) == OK  # others go on


# --- order of calls -----------------------------------------------------------------------------------

# Phase to bring an instance to, the call that is out of order there, and its name in messages.
WRONG = (
    ("instantiated", "exit", "exitInitializationMode called before initialisation"),
    ("initialising", "enter", "enterInitializationMode called in initialisation"),
    ("initialising", "setup", "setupExperiment called in initialisation"),
    ("stepping", "enter", "enterInitializationMode called between steps"),
    ("stepping", "exit", "exitInitializationMode called between steps"),
    ("stepping", "setup", "setupExperiment called between steps"),
    ("terminated", "exit", "exitInitializationMode called after termination"),
)


def bring(bearing, phase):
    if phase == "initialising":
        assert bearing.setup() == bearing.enter() == OK
    elif phase != "instantiated":
        bearing.start()
    if phase == "terminated":
        assert bearing.call("Terminate") == OK
    return bearing


@pytest.mark.parametrize(("phase", "call", "words"), WRONG, ids=lambda value: str(value)[:30])
def test_call_out_of_order(master, expected, phase, call, words):
    bearing, other = bring(master(), phase), master().start()
    answer = getattr(bearing, call)()
    assert bearing.log[-1][:2] == (ERROR, "logStatusError")
    assert (answer, bearing.step(0.0)) == expected["call out of order"]
    assert words in bearing.messages
    assert bearing.step(0.0) == expected["call out of order"][1]  # nothing but reset or a state helps
    assert bearing.reset() == OK
    assert bearing.start().run(2) == other.run(2)


def test_an_earlier_state_ends_an_error(master, expected):
    bearing = master().start()
    good = bearing.keep()
    assert (bearing.enter(), bearing.step(0.0)) == expected["call out of order"]
    values = bearing.everything()
    assert bearing.put_back(good) == OK
    assert bearing.everything() == values
    assert bearing.step(0.0) == OK
    bearing.release(good)


@pytest.mark.parametrize("phase", ["instantiated", "initialising", "terminated"])
def test_step_out_of_order(master, expected, phase):
    bearing = bring(master(), phase)
    assert (bearing.step(0.0), bearing.step(0.0)) == expected["step out of order"]
    assert "doStep called" in bearing.messages
    assert bearing.reset() == OK
    assert bearing.start().step(0.0) == OK


def test_values_can_be_read_after_termination(master, expected):
    bearing = master().start()
    last = bearing.run(1)[0]
    assert bearing.call("Terminate") == OK
    assert bearing.everything() == last
    assert bearing.set("preload", 300.0) == expected["call out of order"][0]
    assert bearing.step(STEP) == expected["step out of order"][0]
    assert "after termination" in bearing.messages or "nothing can be set" in bearing.messages


@pytest.mark.parametrize("size", [0.0, -1e-4, math.nan, math.inf])
def test_step_that_is_no_step_is_refused(master, expected, size):
    bearing, untouched = master().start(), master().start()
    answers = bearing.step(0.0, size), bearing.step(0.0)
    assert answers == expected["step of no length"]
    assert f"the step {size!r} s is not a positive, finite number" in bearing.messages
    if answers[1] == OK:
        assert untouched.step(0.0) == OK
    assert bearing.everything() == untouched.everything()


@pytest.mark.parametrize("size", [1e6, 1e300])
def test_step_of_days_is_discarded_with_the_bound(master, size):
    bearing, untouched = master().start(), master().start()
    assert bearing.step(0.0, size) == DISCARD
    assert "the communication step must be above 0 s and below 1e6 s" in bearing.messages
    assert bearing.step(0.0) == untouched.step(0.0) == OK
    assert bearing.everything() == untouched.everything()


@pytest.mark.parametrize("time", [0.0, 1.0, math.nan, STEP + 2e-9])
def test_wrong_communication_time_is_refused(master, expected, time):
    bearing = master().start()
    bearing.run(1)
    assert (bearing.step(time), bearing.step(STEP)) == expected["wrong communication time"]
    assert f"the communication time {time!r} s is not the time reached, {STEP!r} s" in bearing.messages


def test_masters_may_count_time_in_different_ways(master):
    bearing = master().start(time=10.0)
    assert bearing.step(10.0) == OK
    assert bearing.step(10.0 + STEP + 1e-10) == OK


def test_start_time_must_be_finite(master, expected):
    bearing = master()
    answer = bearing.setup(math.nan)
    bearing.enter()
    bearing.exit()
    assert (answer, bearing.step(0.0)) == expected["start time"]
    assert "start time nan s is not a finite number" in bearing.messages


# --- steps that fail ------------------------------------------------------------------------------------


@pytest.mark.heavy
def test_step_that_does_not_converge(master, expected):
    bearing, other = master().start(**SOFT), master().start(**SOFT)
    before = bearing.run(1)[0]
    assert other.run(1)[0] == before
    state = bearing.keep()
    for name, value in HARD.items():
        assert bearing.set(name, value) == OK
    changed = bearing.everything()
    assert bearing.step(STEP, HARD_STEP) == DISCARD
    assert bearing.log[-1][:2] == (DISCARD, "logStatusDiscard")
    for part in (
        f"step from {STEP!r} s by {HARD_STEP:g} s refused",
        "could not be solved",
        "put an earlier one back (fmi2SetFMUstate), or begin again (fmi2Reset",
        "pedestal_stiffness = 1e+11",
    ):
        assert part in bearing.messages
    assert bearing.everything() == changed
    status, reached = bearing.last_time()
    assert status == OK
    if expected["last successful time"] == "of the engine":
        assert STEP < reached < STEP + HARD_STEP
        assert f"(reached {reached:.9g} s)" in bearing.messages
    else:
        assert reached == STEP
    # other inputs go on as if nothing had been tried, and so does the state before
    assert bearing.set("pedestal_stiffness", SOFT["pedestal_stiffness"]) == OK
    assert bearing.run(2, STEP) == other.run(2, STEP)
    assert bearing.put_back(state) == OK
    assert bearing.everything() == before
    assert bearing.step(STEP) == OK
    bearing.release(state)


def test_short_step_that_does_not_converge_leaves_no_trace(master):
    # after many good ones: a build may go back by repeating them
    size, steps = 1e-4, 20
    bearing, other = master().start(**SOFT), master().start(**SOFT)
    before = bearing.run(steps, size=size)[-1]
    assert other.run(steps, size=size)[-1] == before
    for name, value in HARD.items():
        assert bearing.set(name, value) == OK
    changed = bearing.everything()
    assert bearing.step(steps * size, size) == DISCARD
    assert bearing.everything() == changed
    time, ends = steps * size, []
    for one in (bearing, other):
        assert one.set("radial_load.z", 0.0) == one.set("pedestal_stiffness", 1e6) == OK
        ends.append((one.step(time, 1e-6), one.step(time + 1e-6, 1e-6), one.everything()))
    assert ends[0] == ends[1]
    assert ends[0][0] == OK


def soft(bearing):
    """Set what has no equilibrium."""
    for name, value in (("preload", 0.0), ("radial_load.z", 3000.0), ("pedestal_stiffness", 1e4)):
        assert bearing.set(name, value) == OK


def test_initialisation_without_equilibrium(master, expected):
    bearing = bring(master(), "initialising")
    soft(bearing)
    assert (bearing.exit(), bearing.step(0.0)) == expected["no equilibrium"]
    assert "give a stiffer pedestal or less radial load; inputs were shaft_speed" in bearing.messages
    assert bearing.reset() == OK
    assert bearing.start().step(0.0) == OK


def test_initialisation_is_tried_again_with_other_inputs(master, expected):
    bearing, other = bring(master(), "initialising"), master().start()
    soft(bearing)
    assert bearing.read("friction_torque") == (expected["output without equilibrium"], [0.0])
    for name in ("preload", "radial_load.z", "pedestal_stiffness"):
        assert bearing.set(name, float(bearing.by_name[name].start)) == OK
    assert bearing.exit() == OK
    assert bearing.run(2) == other.run(2)


# --- status -----------------------------------------------------------------------------------------------


def test_last_successful_time(master, expected):
    bearing = master()
    assert bearing.last_time()[0] == expected["status before initialisation"]
    bearing = master().start(time=1.0)
    bearing.run(1, 1.0)
    assert bearing.last_time() == (OK, 1.0 + STEP)


def test_no_step_is_ever_pending(master, expected):
    bearing, value = master().start(), ctypes.c_int(7)
    assert bearing.call("GetStatus", 0, ctypes.byref(value)) == expected["status of a pending step"]
    assert bearing.call("GetIntegerStatus", 1, ctypes.byref(value)) == DISCARD
    assert value.value == 7
    assert bearing.call("GetBooleanStatus", 3, ctypes.byref(value)) == OK
    assert value.value == 0  # it does not ask to end
    text = ctypes.c_char_p(b"")
    assert bearing.call("GetStringStatus", 1, ctypes.byref(text)) == DISCARD
    assert bearing.call("GetRealStatus", 0, ctypes.byref(ctypes.c_double())) == DISCARD
    assert bearing.step(0.0) == OK


def test_calls_that_are_not_provided(master, expected):
    bearing = master().start()
    assert (bearing.call("CancelStep"), bearing.step(0.0)) == (ERROR, OK)
    bearing, number = master().start(), (ctypes.c_double * 1)(1.0)
    unknown, known = bearing._references(["friction_torque"]), bearing._references(["preload"])
    answer = bearing.call("GetDirectionalDerivative", unknown, 1, known, 1, number, (ctypes.c_double * 1)())
    assert (answer, bearing.step(0.0)) == expected["directional derivative"]


def test_cancelling_from_another_thread_leaves_the_step_as_it_is(master):
    bearing, other, size, answers = master().start(), master().start(), 0.02, []
    with ThreadPoolExecutor(1) as pool:
        step = pool.submit(bearing.step, 0.0, size)
        while not step.done():
            answers.append(bearing.call("CancelStep"))
            time.sleep(1e-3)
    assert set(answers) == {ERROR}
    assert step.result() == other.step(0.0, size) == OK
    assert bearing.run(1, size) == other.run(1, size)


# --- one process, several instances -----------------------------------------------------------------------


def test_reset_equals_a_fresh_instance(master):
    used, fresh = master(), master().start()
    assert used.set("max_internal_step", 1e-5) == OK
    used.start(preload=250.0, shaft_speed=500.0, time=3.0).run(3, 3.0)
    used.set("preload", math.nan)
    assert used.reset() == OK
    used.start()
    assert used.everything() == fresh.everything()
    assert used.run(3) == fresh.run(3)


def test_interleaved_instances_equal_lone_ones(master):
    loads = (400.0, 250.0)
    lone = [master().start(preload=load).run(3) for load in loads]
    pair = [master().start(preload=load) for load in loads]
    together = [[one.run(1, i * STEP)[0] for one in pair] for i in range(3)]
    assert [list(each) for each in zip(*together, strict=True)] == lone


def test_error_of_one_instance_is_not_that_of_another(master, expected):
    pair, lone = (master().start(), master().start()), master().start()
    assert pair[0].step(7.0) == expected["wrong communication time"][0]
    assert pair[1].run(2) == lone.run(2)


def test_threads_step_at_the_same_time(master):
    # two instances in two threads give what they give alone, and neither holds the interpreter
    lone = [master().start(preload=load).run(3, size=5e-3) for load in (400.0, 250.0)]
    pair = [master().start(preload=load) for load in (400.0, 250.0)]
    together = [[], []]
    threads = [
        threading.Thread(target=lambda one=one, taken=taken: taken.extend(one.run(3, size=5e-3)))
        for one, taken in zip(pair, together, strict=True)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == lone
    # a long step leaves this thread free to count; with the interpreter held it would get hardly a turn
    stepped = threading.Thread(target=lambda: pair[0].step(3 * 5e-3, 0.1))
    stepped.start()
    turns = 0
    while stepped.is_alive():
        time.sleep(1e-3)
        turns += 1
    assert turns > 2  # some 50 on an idle machine
    assert pair[0].last_time() == (OK, pytest.approx(3 * 5e-3 + 0.1))


NOTHING = """
import ctypes, sys
library = ctypes.CDLL(sys.argv[1])
library.fmi2DoStep.argtypes = (ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int)
print(library.fmi2DoStep(None, 0.0, 1e-4, 1), flush=True)
"""


def test_no_instance(master, expected):
    ran = subprocess.run(
        [sys.executable, "-c", NOTHING, master().library], capture_output=True, text=True, timeout=600
    )
    if expected["NULL instead of an instance"] == ERROR:
        assert (ran.returncode, ran.stdout) == (0, f"{ERROR}\n"), ran.stderr
    else:
        assert ran.returncode != 0
        assert ran.stdout == ""


# A process of its own with no more than the calls of C: what pythonfmu does to some paths ends it.
CRASH = """
import ctypes, sys
path, location, guid = sys.argv[1:]
log = ctypes.CFUNCTYPE(None)(lambda *_: None)
c = ctypes.CDLL(None)
calls = (ctypes.c_void_p * 5)(*(ctypes.cast(f, ctypes.c_void_p).value for f in (log, c.calloc, c.free)))
library = ctypes.CDLL(path)
library.fmi2Instantiate.restype = ctypes.c_void_p
made = library.fmi2Instantiate(b"a", 1, guid.encode(), location.encode(), ctypes.byref(calls), 0, 0)
print("made" if made else "none", flush=True)
"""


@pytest.mark.parametrize("name", ["a blank", "a-b_c.d~e", "a#b", "100%", "a+b", "été"])
def test_paths(master, unpacked, expected, tmp_path, name):
    folder = tmp_path / name
    folder.symlink_to(unpacked, target_is_directory=True)
    plain = all(letter.isascii() and (letter.isalnum() or letter in " ._-~") for letter in name)
    if plain or expected["any path"]:
        assert master(folder).start().step(0.0) == OK
        return
    bearing = master()
    arguments = [bearing.library, (folder / "resources").as_uri(), bearing.description.guid]
    ran = subprocess.run(
        [sys.executable, "-c", CRASH, *arguments], capture_output=True, text=True, timeout=600
    )
    assert ran.returncode != 0
    assert ran.stdout == ""
