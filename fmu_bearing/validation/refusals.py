"""Checks of an FMU with invalid values, steps and times.

FMI 2.0 asks the host to avoid them and leaves the answer of the FMU open, so silent acceptance is a note. A
host that continues after a refusal relies on the state being unchanged.
"""

import math
from collections.abc import Iterator

from fmu_bearing.validation.remarks import FINDING, NOTE, Remark, Skip
from fmu_bearing.validation.subject import DISCARD, Instance, NoInstance, Subject, difference, not_finite

_REPEATS = 5
_TERMINATED = 3  # fmi2Terminated, a kind of status


def values_not_finite(subject: Subject) -> Iterator[Remark]:
    """Refuse NaN and infinity for an input, at once or by the next step, and go on."""
    inputs = subject.real_inputs()
    if not inputs:
        raise Skip("there is no Real input")
    for value in (math.nan, math.inf):
        yield from _bad_value(subject, inputs[0].name, value, float(inputs[0].start or 0.0))


def values_out_of_range(subject: Subject) -> Iterator[Remark]:
    """Refuse values outside an input's declared range, at once or by the next step."""
    bounded = [v for v in subject.real_inputs() if v.max is not None]
    if not bounded:
        raise Skip("no Real input declares a largest value")
    first = bounded[0]
    above = 2.0 * max(abs(float(first.max)), 1.0)
    yield from _bad_value(subject, first.name, above, float(first.start or 0.0))


def start_value_out_of_range(subject: Subject) -> Iterator[Remark]:
    """Let no host repeat a step for ever that a start value out of its range forbids.

    FMPy repeats a discarded step until the FMU answers another status, or that it wants to end.
    """
    bounded = [v for v in subject.real_inputs() if v.max is not None]
    if not bounded:
        raise Skip("no Real input declares a largest value")
    above = 2.0 * max(abs(float(bounded[0].max)), 1.0)
    with subject.instances() as (one,):
        try:
            subject.initialise(one, {bounded[0].name: above})
        except NoInstance:
            return
        for _ in range(_REPEATS):
            if one.doStep(subject.start, subject.step, False).status != DISCARD:
                return
        asks = one.getBooleanStatus(_TERMINATED)
        if not (asks.good and asks.value):
            yield Remark(
                f"{_REPEATS} times the same fmi2DoStep, with {bounded[0].name} = {above!r} set before "
                "initialisation",
                "fmi2Discard each time, without fmi2Terminated",
                "an end: some hosts repeat a discarded step for ever",
                "4.2.2",
                NOTE,
            )


def _bad_value(subject: Subject, name: str, value: float, good: float) -> Iterator[Remark]:
    called = f"fmi2SetReal({name} = {value!r}) and fmi2DoStep"
    with subject.started() as one:
        subject.run(one, 1)
        before = subject.outputs(one)
        answers = [subject.set(one, name, value), *subject.run(one, 1, 1)]
        words = " and ".join(answer.words for answer in answers)
        refused = [answer.status > 1 for answer in answers]
        if not any(refused):
            wrong = not_finite(subject.outputs(one))
            words += f", then {wrong}" if wrong else ""
            yield Remark(called, words, "a refusal of either", "2.2.7", FINDING if wrong else NOTE)
            return
        done = 1
        if refused[-1]:
            changed = difference(before, subject.outputs(one))
            if changed:
                yield Remark(f"outputs after {called}", changed, "those before", "4.2.2", NOTE)
        else:
            done = 2  # the value was not taken, the step was
        again = [subject.set(one, name, good), *subject.run(one, 1, done)]
        if any(answer.status > 1 for answer in again):
            words = " and ".join(answer.words for answer in again)
            yield Remark(
                f"fmi2SetReal({name} = {good!r}) and fmi2DoStep after it", words, "fmi2OK", "4.2.4", NOTE
            )


def steps_of_no_length(subject: Subject) -> Iterator[Remark]:
    """Refuse steps of zero, negative or NaN length, with the state as it was."""
    for size in (0.0, -subject.step, math.nan):
        with subject.started() as one:
            subject.run(one, 1)
            time = subject.start + subject.step
            yield from _bad_step(subject, one, time, size, f"fmi2DoStep with a step of {size!r} s")


def wrong_time(subject: Subject) -> Iterator[Remark]:
    """Refuse a step from another time than the one reached, with the state as it was."""
    with subject.started() as one:
        subject.run(one, 1)
        time = subject.start + 1000.0 * subject.step
        called = f"fmi2DoStep from {time:g} s at {subject.start + subject.step:g} s"
        yield from _bad_step(subject, one, time, subject.step, called)


def _bad_step(subject: Subject, one: Instance, time: float, size: float, called: str) -> Iterator[Remark]:
    before = subject.outputs(one)
    answer = one.doStep(time, size, False)
    after = subject.outputs(one)
    wrong = not_finite(after)
    if answer.status <= 1:
        came = f"{answer.words}{', then ' + wrong if wrong else ''}"
        yield Remark(called, came, "a refusal", "4.2.2", FINDING if wrong else NOTE)
    elif difference(before, after):
        yield Remark(
            f"outputs after {called}, refused", difference(before, after), "those before", "4.2.2", NOTE
        )
