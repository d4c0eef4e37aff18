"""Checks of declared capabilities: variable steps, derivatives, states, reference results."""

import csv
import math
from collections.abc import Iterator
from xml.etree import ElementTree

from fmu_bearing.validation.remarks import Remark, Skip
from fmu_bearing.validation.subject import Instance, Subject, difference, not_finite

#: Where FMI-LS-REF puts reference results; as in ``fmi.reference``, which would take seconds to import.
FOLDER = "extra/org.fmi-standard.fmi-ls-ref"

_STEPS = 5
_DIGITS = 9  # of reference results
_SMALL = 1e-6  # of a variable's range: what another C library may change in a short run


def variable_steps(subject: Subject) -> Iterator[Remark]:
    """Take communication steps of changing length, where the description declares it."""
    if not subject.can.canHandleVariableCommunicationStepSize:
        raise Skip("canHandleVariableCommunicationStepSize is false")
    with subject.started() as one:
        time = subject.start
        for factor in (1.0, 0.5, 1.5, 0.1):
            answer = one.doStep(time, factor * subject.step, False)
            called = f"fmi2DoStep with {factor:g} of the last step's length"
            if answer.status > 1:
                yield Remark(called, answer.words, "fmi2OK", "4.3.1")
                return
            time += factor * subject.step
        if wrong := not_finite(subject.outputs(one)):
            yield Remark("steps of changing length", wrong, "finite outputs", "4.3.1")


def input_derivatives(subject: Subject) -> Iterator[Remark]:
    """Take rates of inputs, and steps with them, where the description declares it."""
    if not subject.can.canInterpolateInputs:
        raise Skip("canInterpolateInputs is false")
    inputs = [v for v in subject.real_inputs() if v.variability == "continuous"]
    if not inputs:
        raise Skip("there is no continuous Real input")
    with subject.started() as one:
        for variable in inputs:
            answer = one.setRealInputDerivatives([variable.valueReference], [1], [0.0])
            if answer.status > 1:
                called = f"fmi2SetRealInputDerivatives of {variable.name}"
                yield Remark(called, answer.words, "fmi2OK", "4.2.1")
                return
        (answer,) = subject.run(one, 1)
        if answer.status > 1:
            yield Remark("fmi2DoStep after fmi2SetRealInputDerivatives", answer.words, "fmi2OK", "4.2.1")


def output_derivatives(subject: Subject) -> Iterator[Remark]:
    """Give derivatives of outputs to the order that the description declares."""
    order = int(subject.can.maxOutputDerivativeOrder or 0)
    outputs = [v for v in subject.numeric if v.causality == "output" and v.type == "Real"]
    if not order or not outputs:
        raise Skip("maxOutputDerivativeOrder is 0" if not order else "there is no Real output")
    with subject.started() as one:
        subject.run(one, 2)
        for variable in outputs:
            answer = one.getRealOutputDerivatives([variable.valueReference], [1])
            if answer.status > 1 or not math.isfinite(answer.value[0]):
                came = answer.words if answer.status > 1 else repr(answer.value[0])
                called = f"fmi2GetRealOutputDerivatives of {variable.name}"
                yield Remark(called, came, "a finite number", "4.2.1")
                return


def directional_derivatives(subject: Subject) -> Iterator[Remark]:
    """Give directional derivatives where the description declares it."""
    if not subject.can.providesDirectionalDerivative:
        raise Skip("providesDirectionalDerivative is false")
    inputs, outputs = subject.real_inputs(), [u.variable for u in subject.description.outputs]
    if not inputs or not outputs:
        raise Skip("there is no Real input or no output")
    with subject.started() as one:
        subject.run(one, 1)
        # an output need not depend on every input
        for variable in inputs:
            answer = one.getDirectionalDerivative(
                [outputs[0].valueReference], [variable.valueReference], [1.0]
            )
            if answer.status <= 1:
                return
        called = f"fmi2GetDirectionalDerivative of {outputs[0].name} by {variable.name}"
        yield Remark(called, answer.words, "fmi2OK", "2.1.9")


def states(subject: Subject) -> Iterator[Remark]:
    """Continue with the same bits from a state that was kept and put back."""
    if not subject.can.canGetAndSetFMUstate:
        raise Skip("canGetAndSetFMUstate is false")
    with subject.started() as one:
        subject.run(one, _STEPS)
        kept = one.getFMUstate()
        if kept.status > 1:
            yield Remark("fmi2GetFMUstate", kept.words, "fmi2OK", "2.1.8")
            return
        yield from _continues(subject, one, one, kept.value, "fmi2GetFMUstate and fmi2SetFMUstate")
        one.freeFMUstate(kept.value)


def serialised_states(subject: Subject) -> Iterator[Remark]:
    """Continue with the same bits from a state that went through bytes, in another instance."""
    if not subject.can.canSerializeFMUstate:
        raise Skip("canSerializeFMUstate is false")
    count = 1 if subject.can.canBeInstantiatedOnlyOncePerProcess else 2
    with subject.instances(count) as made:
        one, other = made[0], made[-1]
        for each in made:
            subject.initialise(each)
        subject.run(one, _STEPS)
        kept = one.getFMUstate()
        data = one.serializeFMUstate(kept.value) if kept.good else kept
        back = other.deSerializeFMUstate(data.value) if data.good else data
        if not back.good:
            called = "fmi2GetFMUstate, fmi2SerializeFMUstate and fmi2DeSerializeFMUstate"
            yield Remark(called, back.words, "fmi2OK", "2.1.8")
            return
        yield from _continues(subject, one, other, back.value, "fmi2DeSerializeFMUstate and fmi2SetFMUstate")
        one.freeFMUstate(kept.value)
        other.freeFMUstate(back.value)


def _continues(
    subject: Subject, one: Instance, other: Instance, state: object, called: str
) -> Iterator[Remark]:
    """Go on in one instance, put the state into the other and go on there."""
    there = subject.everything(one)
    subject.run(one, _STEPS, _STEPS)
    wanted = subject.everything(one)
    answer = other.setFMUstate(state)
    if answer.status > 1:
        yield Remark("fmi2SetFMUstate", answer.words, "fmi2OK", "2.1.8")
        return
    if found := difference(there, subject.everything(other)):
        yield Remark(called, found, "the values kept", "2.1.8")
        return
    subject.run(other, _STEPS, _STEPS)
    if found := difference(wanted, subject.everything(other)):
        yield Remark(f"{_STEPS} steps after {called}", found, "the same bits as without", "2.1.8")


def reference_results(subject: Subject) -> Iterator[Remark]:
    """Reproduce the reference results inside the FMU (FMI-LS-REF).

    Equal are nine digits, as they are written, or 1e-6 of a variable's range, as another C library
    may move them.
    """
    file = subject.folder / FOLDER / "reference.exp"
    if not file.is_file():
        raise Skip("the FMU holds no reference results")
    experiment = ElementTree.parse(file).getroot().find("Experiment")
    references = None if experiment is None else experiment.find("References")
    if experiment is None or references is None:
        yield Remark(f"{FOLDER}/reference.exp", "names no results", "an Experiment with References")
        return
    size = float(experiment.get("stepSize", subject.step))
    with (file.parent / references.get("source", "")).open(encoding="ascii", newline="") as text:
        names, *rows = csv.reader(text)
    variables = [next(v for v in subject.numeric if v.name == name) for name in names[1:]]
    table = [[float(cell) for cell in row[1:]] for row in rows]
    spans = [max(column) - min(column) + _tiny(column) for column in zip(*table, strict=True)]
    with subject.started() as one:
        for i, wanted in enumerate(table):
            if i and one.doStep(subject.start + (i - 1) * size, size, False).status > 1:
                yield Remark(f"fmi2DoStep number {i} of the reference results", "refused", "fmi2OK", "4.2.2")
                return
            for variable, value, span in zip(variables, wanted, spans, strict=True):
                came = subject.read(one, variable).value
                if f"{came:.{_DIGITS}g}" == f"{value:.{_DIGITS}g}" or abs(came - value) <= _SMALL * span:
                    continue
                called = f"{variable.name} at {i * size:g} s of the reference results"
                yield Remark(called, repr(came), f"{value!r} within {_SMALL * span:.2g}")
                return


def _tiny(column: tuple[float, ...]) -> float:
    """Return a lower bound of the range, for constant variables."""
    return 1e-3 * max(abs(value) for value in column)
