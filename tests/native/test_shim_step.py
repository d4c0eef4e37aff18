"""Communication steps: refusals, failures that leave no trace, rates of inputs and outputs."""

import math

import pytest

from tests.messages import says

from . import toy
from .master import DISCARD, ERROR, OK

# A copy of the state for each step; one for four; one for as many as take 0.25 s.
JOURNALS = {"each": {}, "four": {"journal": 4}, "span": {"journal": 100, "journal_span": 0.25}}


@pytest.fixture(params=JOURNALS)
def copies(request):
    return request.param


@pytest.fixture
def resources(copies, tmp_path):
    return toy.write_model(tmp_path, **JOURNALS[copies])


def test_steps_advance_time_and_state(master):
    one = master().start(speed=2.0)
    one.run(4, size=0.25)
    assert one.get("angle") == 1.0 + 2.0
    assert one.last_time() == (OK, 1.0)


@pytest.mark.parametrize("size", [0.0, -0.1, math.nan, math.inf, -math.inf])
def test_step_that_is_no_step_is_an_error(master, size):
    one = master().start()
    before = one.everything()
    assert one.step(0.0, size) == ERROR
    message = f"step from 0.0 s by {size!r} s refused: the step {size!r} s is not a positive, finite number"
    assert message in one.messages
    assert one.everything() == before
    assert one.step(0.0) == ERROR


@pytest.mark.parametrize("time", [0.0, 1.0, math.nan, math.inf, 0.1 + 2e-9, 0.1 - 2e-9])
def test_wrong_communication_time_is_an_error(master, time):
    one = master().start()
    one.run(1)
    assert one.step(time) == ERROR
    assert f"the communication time {time!r} s is not the time reached, 0.1 s" in one.messages


def test_masters_may_count_time_in_different_ways(master):
    one = master().start(time=1e6)
    assert one.step(1e6 + 5e-7) == OK  # 1e-12 of the time
    assert one.step(1e6 + 0.1) == OK
    assert one.step(1e6 + 0.2 + 3e-6) == ERROR


def test_step_that_fails_leaves_no_trace(master):
    one, untouched = master().start(speed=5.0), master().start(speed=5.0)
    assert one.run(1) == untouched.run(1)
    assert one.set("trouble", 1.0) == OK
    before = one.everything()
    assert one.step(0.1, 0.2) == DISCARD
    assert one.last_time() == (OK, pytest.approx(0.2, abs=1e-15))  # half of the step
    assert one.everything() == before
    status, category, message = one.log[-1]
    assert (status, category) == (DISCARD, "logStatusDiscard")
    assert says(
        message, "0.1 s by 0.2 s ... reached 0.2 s ... speed = 5, load = 50, trouble = 1, no_start = 0"
    )
    assert one.set("trouble", 0.0) == OK
    after, other = one.run(2, 0.1), untouched.run(2, 0.1)
    assert after == other


@pytest.mark.parametrize("steps", range(1, 10))
def test_failure_after_some_steps_leaves_no_trace(master, steps):
    def lead(one):
        for i in range(steps):
            assert one.set("speed", 3.0 * i - 7.0) == OK
            if i % 3 == 1:
                assert one.rate("load", 40.0) == OK
            assert one.step(0.0625 * i, 0.0625) == OK
        return one.everything()

    one, untouched = master().start(), master().start()
    before = lead(one)
    assert before == lead(untouched)
    one.slope("angle")
    time = 0.0625 * steps
    for _ in range(3):
        assert one.set("trouble", 1.0) == OK
        assert one.step(time) == DISCARD
        assert one.everything() == before
        assert one.slope("angle") == untouched.slope("angle")
        assert one.set("trouble", 0.0) == OK
    assert one.run(6, time) == untouched.run(6, time)


def test_smaller_step_after_a_failure(master):
    one, other = master().start(), master().start()
    assert one.set("trouble", 1.0) == other.set("trouble", 1.0) == OK
    assert one.step(0.0, 0.1) == DISCARD
    assert one.step(0.0, 1e-3) == OK
    assert one.last_time() == (OK, 1e-3)
    other.run(1, size=1e-3)
    assert one.everything() == other.everything()


CHANGES = {
    "an input": lambda one: one.set("load", 60.0),
    "the rate of an input": lambda one: one.rate("load", 40.0),
    "a state set": lambda one: one.put_back(one.keep()),
    "another step": lambda one: one.step(0.0, 0.2) - DISCARD,
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_step_refused_again_is_an_error_unless_something_was_changed(master, change):
    one = master().start()
    assert one.set("trouble", 1.0) == OK
    assert one.step(0.0, 0.1) == DISCARD
    assert one.set("load", 50.0) == one.rate("load", 0.0) == OK  # what they are already
    assert one.step(0.0, 0.1) == ERROR
    first, again = (text for status, _, text in one.log if "0.0 s by 0.1 s refused" in text)
    assert again == f"{first}; again, and nothing was changed"
    assert one.step(0.0, 0.05) == ERROR  # nothing leads on but a reset or an earlier state
    other = master().start()
    assert other.set("trouble", 1.0) == OK
    for _ in range(3):
        assert other.step(0.0, 0.1) == DISCARD
        assert other.set("trouble", 0.75) == other.set("trouble", 1.0) == OK
    assert other.step(0.0, 0.1) == DISCARD
    assert CHANGES[change](other) == OK
    assert other.step(0.0, 0.1) == DISCARD
    assert other.step(0.0, 0.1) == ERROR


def test_a_ramp_refused_again_is_an_error(master):
    one = master().start()
    assert one.rate("load", 1e6) == OK
    assert one.step(0.0, 0.5) == DISCARD
    assert one.rate("load", 1e6) == OK  # hosts with rates give them before each step
    assert one.step(0.0, 0.5) == ERROR
    assert one.log[-1][2].endswith("10000 N; again, and nothing was changed")


def test_failure_can_be_followed_by_an_earlier_state(master):
    one = master().start()
    state = one.keep()
    expected = one.run(2)
    assert one.set("trouble", 1.0) == OK
    assert one.step(0.2) == DISCARD
    assert one.put_back(state) == OK
    assert one.get("trouble") == 0.0
    assert one.run(2) == expected
    one.release(state)


def test_reset_equals_a_fresh_instance(master):
    used, fresh = master(), master().start()
    assert used.set("gain", 3.0) == used.set("tolerance", 0.01) == OK
    used.start(time=5.0, speed=8.0, load=10.0).run(3, 5.0)
    assert used.rate("speed", 1.0) == OK
    assert used.call("Reset") == OK
    assert used.slope("angle")[0] == ERROR  # not between steps
    assert used.call("Reset") == OK
    used.start()
    assert used.everything() == fresh.everything()
    assert used.slope("angle") == fresh.slope("angle") == (OK, 0.0)
    assert used.run(3) == fresh.run(3)


def test_interleaved_instances_equal_lone_ones(master):
    lone = [master().start(speed=speed).run(3) for speed in (2.0, -9.0)]
    pair = [master().start(speed=speed) for speed in (2.0, -9.0)]
    together = [[one.run(1, 0.1 * i)[0] for one in pair] for i in range(3)]
    assert [list(each) for each in zip(*together, strict=True)] == lone


# --- rates of inputs --------------------------------------------------------------------------------


def test_rate_of_the_ramped_input(master):
    # the engine ramps the speed from where it is to the value given: 3 to 3 + 4 * 0.5
    one = master().start()
    assert one.rate("speed", 4.0) == OK
    assert one.step(0.0, 0.5) == OK
    assert one.read("speed_reached", "speed") == (OK, [5.0, 5.0])
    assert one.get("angle") == 1.0 + 0.5 * (3.0 + 5.0) * 0.5
    assert one.step(0.5, 0.5) == OK  # the rate held for one step
    assert one.read("speed_reached", "speed") == (OK, [5.0, 5.0])


def test_rate_of_a_held_input(master):
    one = master().start()
    assert one.rate("load", 40.0) == OK
    assert one.step(0.0, 0.5) == OK
    assert one.read("load_held", "load") == (OK, [50.0 + 0.5 * 40.0 * 0.5, 70.0])
    assert one.step(0.5, 0.5) == OK
    assert one.get("load_held") == 70.0


def test_value_set_after_its_rate_is_where_the_ramp_begins(master):
    one = master().start()
    assert one.rate("load", 40.0) == OK
    assert one.set("load", 100.0) == OK
    assert one.step(0.0, 0.5) == OK
    assert one.read("load_held", "load") == (OK, [110.0, 120.0])


@pytest.mark.parametrize("rate", [1e6, -1e6, 1e308])
def test_ramp_out_of_range_is_refused(master, rate):
    one, other = master().start(), master().start()
    assert one.rate("load", rate) == OK
    before = one.everything()
    assert one.step(0.0, 0.5) == DISCARD
    assert f"load = {50.0 + 0.5 * rate!r} is refused: allowed are 0 to 10000 N" in one.messages
    assert one.everything() == before
    assert one.last_time() == (OK, 0.0)
    assert one.step(0.0, 0.25) == DISCARD  # the rate is still there
    assert one.rate("load", 0.0) == OK
    assert one.run(2) == other.run(2)


def test_failed_step_keeps_rates(master):
    one, other = master().start(), master().start()
    assert one.set("trouble", 1.0) == OK
    assert one.rate("load", 40.0) == other.rate("load", 40.0) == OK
    assert one.step(0.0, 0.5) == DISCARD
    assert one.get("load") == 50.0
    assert one.set("trouble", 0.0) == OK
    assert one.step(0.0, 0.5) == other.step(0.0, 0.5) == OK
    assert one.everything() == other.everything()


@pytest.mark.parametrize(
    ("start", "size", "status"),
    [
        (1e15, 1e-3, ERROR),  # doubles there are 0.125 s apart: time would not move
        (-1e15, 0.07, ERROR),  # it would move by 0.125 s
        (1e15, 1.0, OK),
        (1.7e9, 1e-5, OK),  # a clock of today: 2.4e-7 s apart
    ],
)
def test_a_step_that_the_time_cannot_hold_is_refused(master, start, size, status):
    one = master()
    assert one.setup(start) == one.enter() == one.exit() == OK
    assert one.step(start, size) == status
    assert ("begin the experiment at a start time nearer to 0 s" in one.messages) == (status == ERROR)


def test_rate_set_in_initialisation_holds_for_the_first_step(master):
    one = master()
    assert one.setup() == one.enter() == OK
    assert one.rate("speed", 4.0) == OK
    assert one.exit() == OK
    assert one.step(0.0, 0.5) == OK
    assert one.get("speed_reached") == 5.0


@pytest.mark.parametrize("rate", [math.nan, math.inf])
def test_rate_must_be_finite(master, rate):
    one = master().start()
    assert one.rate("speed", rate) == DISCARD
    assert f"speed = {rate!r} is refused: it must be finite" in one.messages
    assert one.step(0.0) == OK
    assert one.get("speed") == 3.0


@pytest.mark.parametrize("order", [0, 2, -1, -(2**31), 2**31 - 1])
def test_rates_are_of_order_one(master, order):
    one, two = master().start(), master().start()
    assert one.rate("speed", 1.0, order) == ERROR
    assert f"speed: derivatives of order {order} are not supported" in one.messages
    assert two.slope("angle", order) == (ERROR, 0.0)
    assert f"angle: derivatives of order {order} are not supported" in two.messages


@pytest.mark.parametrize("name", ["gain", "angle", "steps", "fixed_text", 12345])
def test_rate_of_what_is_no_input(master, name):
    one = master().start()
    assert one.rate(name, 1.0) == ERROR
    assert ("value reference 12345" if name == 12345 else name) in one.messages
    assert "is not an input" in one.messages


@pytest.mark.parametrize("name", ["gain", "speed", "margin", "steps", 12345])
def test_slope_of_what_is_no_output(master, name):
    one = master().start()
    assert one.slope(name) == (ERROR, 0.0)
    assert "is not an output" in one.messages


# --- rates of outputs -------------------------------------------------------------------------------


def slopes(values, size):
    return [(b - a) / size for a, b in zip(values, values[1:], strict=False)]


@pytest.mark.parametrize("first", [0, 1, 3])
def test_slope_is_the_difference_over_the_last_step(master, first):
    # whether it was asked for from the start or only later
    one = master().start()
    values, found = [one.get("angle")], []
    if first == 0:
        assert one.slope("angle") == (OK, 0.0)
    for i in range(5):
        assert one.set("speed", float(i * i)) == OK
        assert one.step(0.25 * i, 0.25) == OK
        values.append(one.get("angle"))
        if i + 1 >= first:
            found.append(one.slope("angle"))
    expected = slopes(values, 0.25)[max(0, first - 1) :]
    assert found == [(OK, slope) for slope in expected]


def test_slope_belongs_to_the_state(master):
    one, other = master().start(), master().start()
    assert one.set("speed", 10.0) == OK
    one.run(2)
    data = one.to_bytes(one.keep())
    expected = one.slope("angle")
    assert expected[1] != 0.0
    status, state = other.from_bytes(data)
    assert status == other.put_back(state) == OK
    assert other.slope("angle") == expected
    assert one.run(1, 0.2) == other.run(1, 0.2)
    assert one.slope("angle") == other.slope("angle")


def test_slope_survives_a_failed_step_once_it_was_asked_for(master, copies):
    one = master().start()
    one.run(1)
    slope = one.slope("angle")
    assert one.set("trouble", 1.0) == OK
    assert one.step(0.1) == DISCARD
    assert one.slope("angle") == slope
    other = master().start()
    other.run(1)
    assert other.set("trouble", 1.0) == OK
    assert other.step(0.1) == DISCARD
    # with a copy for each step it was overwritten, and nobody had asked
    assert other.slope("angle") == ((OK, 0.0) if copies == "each" else slope)
