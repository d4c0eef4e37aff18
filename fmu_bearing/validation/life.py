"""Checks of instances: loading, start values, a first step, independence, reset.

Each check yields its remarks; the first line of its docstring is the requirement on the FMU.
"""

import math
from collections.abc import Iterator

from fmu_bearing.validation.remarks import FINDING, NOTE, Remark, Skip
from fmu_bearing.validation.subject import NoInstance, Subject, difference, not_finite

_STEPS = 5
_FIRST = 3  # of equal kind that are listed
_ROUNDING = 1e-14  # relative: 17 digits bring a double back, 16 need not
_OTHER_GUID = "{00000000-0000-0000-0000-000000000000}"


def instantiates(subject: Subject) -> Iterator[Remark]:
    """Load the library and make instances, two at a time unless the description allows only one."""
    count = 1 if subject.can.canBeInstantiatedOnlyOncePerProcess else 2
    try:
        with subject.instances(count):
            pass
    except NoInstance as problem:
        yield Remark(f"fmi2Instantiate, {count} at a time", str(problem), "an instance", "2.1.5")


def versions(subject: Subject) -> Iterator[Remark]:
    """Name FMI 2.0 and the default platform types as the library's versions."""
    with subject.instances() as (one,):
        for function, expected in (("getVersion", "2.0"), ("getTypesPlatform", "default")):
            came = getattr(one, function)().value
            if came != expected:
                name = f"fmi2{function[0].upper()}{function[1:]}"
                yield Remark(name, repr(came), repr(expected), "2.1.4")


def other_guid(subject: Subject) -> Iterator[Remark]:
    """Refuse an instance to a host whose description has another GUID."""
    try:
        with subject.instances(guid=_OTHER_GUID):
            called = f"fmi2Instantiate with GUID {_OTHER_GUID}"
            yield Remark(called, "an instance", "none: the GUID has to be compared", "2.1.5", NOTE)
    except NoInstance:
        return


def start_values(subject: Subject) -> Iterator[Remark]:
    """Hold the start values of the description, before initialisation and after it."""
    started = [v for v in subject.numeric if v.start is not None]
    fixed = [v for v in started if v.causality in ("input", "parameter") or v.variability == "constant"]
    with subject.instances() as (one,):
        for moment, variables in (("after fmi2Instantiate", started), ("after initialisation", fixed)):
            if moment == "after initialisation":
                subject.initialise(one)
            wrong: dict[str, list[Remark]] = {NOTE: [], FINDING: []}
            for variable in variables:
                answer = subject.read(one, variable)
                called = f"fmi2Get{variable.type} of {variable.name} {moment}"
                if answer.status > 1:
                    # before initialisation FMI lets a host read nothing
                    open_to_fmus = moment == "after fmi2Instantiate"
                    severity = NOTE if open_to_fmus else FINDING
                    wrong[severity].append(Remark(called, answer.words, "its start value", "2.1.7", severity))
                    break
                wanted = float({"true": 1, "false": 0}.get(str(variable.start), variable.start))
                if answer.value != wanted:
                    # a tool may have rounded the number when it wrote the description
                    severity = NOTE if math.isclose(answer.value, wanted, rel_tol=_ROUNDING) else FINDING
                    remark = Remark(called, repr(answer.value), f"start = {wanted!r}", "2.2.7", severity)
                    wrong[severity].append(remark)
            for remarks in wrong.values():
                yield from remarks[:_FIRST]


def finite(subject: Subject) -> Iterator[Remark]:
    """Give finite outputs after initialisation and after the first steps."""
    with subject.instances() as (one,):
        try:
            subject.initialise(one)
        except NoInstance as problem:
            yield Remark(
                "fmi2EnterInitializationMode, fmi2ExitInitializationMode", str(problem), "fmi2OK", "4.2.4"
            )
            return
        for count in (0, _STEPS):
            answers = subject.run(one, count)
            bad = [answer.words for answer in answers if answer.status > 1]
            if bad:
                said = f" ({one.log[-1]})" if one.log else ""
                called = f"fmi2DoStep, {count} times {subject.step:g} s at start values"
                yield Remark(called, bad[0] + said, "fmi2OK", "4.2.2")
                return
            wrong = not_finite(subject.outputs(one))
            if wrong:
                yield Remark(
                    f"outputs after {count} steps of {subject.step:g} s", wrong, "finite numbers", "2.1.7"
                )


def independent(subject: Subject) -> Iterator[Remark]:
    """Step to the same bits alone and beside another instance that is driven otherwise."""
    if subject.can.canBeInstantiatedOnlyOncePerProcess:
        raise Skip("the description allows one instance per process")
    with subject.started() as alone:
        subject.run(alone, _STEPS)
        wanted = subject.everything(alone)
    with subject.instances(2) as (one, other):
        subject.initialise(one)
        subject.initialise(other, subject.nudged())
        for i in range(_STEPS):
            subject.run(other, 1, i)
            subject.run(one, 1, i)
        found = difference(wanted, subject.everything(one))
    if found:
        called = f"{_STEPS} steps alone, and in turns with a second instance with other inputs"
        yield Remark(called, found, "the same bits", "2.1.5")


def reset(subject: Subject) -> Iterator[Remark]:
    """Reset gives the state of a fresh instance: the same run gives the same bits."""
    with subject.instances() as (one,):
        subject.initialise(one)
        before = subject.everything(one)
        subject.run(one, _STEPS)
        after = subject.everything(one)
        for name, value in subject.nudged().items():
            subject.set(one, name, value)
        subject.run(one, 2, _STEPS)
        answer = one.reset()
        if answer.status > 1:
            yield Remark("fmi2Reset between steps", answer.words, "fmi2OK", "2.1.6")
            return
        try:
            subject.initialise(one)
        except NoInstance as problem:
            yield Remark("initialisation after fmi2Reset", str(problem), "as when fresh", "2.1.6")
            return
        moments = ("initialisation", f"initialisation and {_STEPS} steps")
        for moment, wanted in zip(moments, (before, after), strict=True):
            if moment != "initialisation":
                subject.run(one, _STEPS)
            found = difference(wanted, subject.everything(one))
            if found:
                yield Remark(f"{moment}, fresh and after fmi2Reset", found, "the same bits", "2.1.6")
                return
