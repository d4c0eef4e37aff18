"""The FMU under test, and instances of it whose calls return their status."""

import itertools
import math
import struct
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from ctypes import byref
from pathlib import Path
from typing import Any, NamedTuple

import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy
from fmpy.model_description import ModelDescription, ScalarVariable

OK, DISCARD = 0, 2
_STATUS = ("fmi2OK", "fmi2Warning", "fmi2Discard", "fmi2Error", "fmi2Fatal", "fmi2Pending")
_METHOD = {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean"}
_NAMES = itertools.count(1)


class NoInstance(RuntimeError):
    """The FMU gave no instance; the message says why."""


class Answer(NamedTuple):
    """Status of a call and what it returned; nothing unless it is fmi2OK or fmi2Warning."""

    status: int
    value: Any = None

    @property
    def good(self) -> bool:
        """Whether the call succeeded."""
        return self.status == OK

    @property
    def words(self) -> str:
        """Return the status as FMI names it."""
        return _STATUS[self.status] if 0 <= self.status < len(_STATUS) else f"status {self.status}"


class Instance:
    """One instance; named as FMPy's methods, its calls return status and value."""

    def __init__(self, folder: Path, description: ModelDescription, guid: str | None = None) -> None:
        self.log: list[str] = []
        self.name = f"instance{next(_NAMES)}"
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._hear)
        self._callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        self._callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(fmpy.free)
        addLoggerProxy(byref(self._callbacks))
        try:
            self._slave = FMU2Slave(
                guid=description.guid if guid is None else guid,
                modelIdentifier=description.coSimulation.modelIdentifier,
                unzipDirectory=str(folder), instanceName=self.name,
            )  # fmt: skip
            self._slave.instantiate(callbacks=self._callbacks, loggingOn=True)
        except Exception as problem:  # FMPy raises plain Exceptions
            raise NoInstance("; ".join([str(problem), *self.log[-2:]])) from None

    def _hear(self, _environment: Any, _name: Any, _status: int, _category: Any, message: Any) -> None:
        self.log.append((message or b"").decode("utf-8", "replace").strip())

    def __getattr__(self, method: str) -> Any:
        function = getattr(self._slave, method)

        def call(*arguments: Any) -> Answer:
            try:
                return Answer(OK, function(*arguments))
            except FMICallException as problem:
                return Answer(problem.status)

        return call

    def free(self) -> None:
        """Free the instance."""
        self._slave.freeInstance()


class Subject:
    """An unpacked FMU: its description, and instances of it.

    Attributes
    ----------
    folder : Path
    description : ModelDescription
        Of FMPy.
    step : float
        Communication step of the checks (s): that of the default experiment, or 1 ms.
    start : float
        Start time of the checks (s).
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.description = fmpy.read_model_description(str(folder), validate=False)
        experiment = self.description.defaultExperiment
        self.start = float((experiment and experiment.startTime) or 0.0)
        self.step = float((experiment and experiment.stepSize) or 1e-3)
        self.numeric = [v for v in self.description.modelVariables if v.type in _METHOD]

    @property
    def can(self) -> Any:
        """Capability flags, as FMPy has them."""
        return self.description.coSimulation

    @contextmanager
    def instances(self, count: int = 1, guid: str | None = None) -> Iterator[list[Instance]]:
        """Yield so many fresh instances at a time, freed at the end."""
        made: list[Instance] = []
        try:
            for _ in range(count):
                made.append(Instance(self.folder, self.description, guid))
            yield made
        finally:
            for one in made:
                one.free()

    @contextmanager
    def started(self, changes: Mapping[str, float] | None = None) -> Iterator[Instance]:
        """Yield an initialised instance.

        Raises
        ------
        NoInstance
            When it cannot be initialised, which a separate check reports.
        """
        with self.instances() as (one,):
            self.initialise(one, changes)
            yield one

    def initialise(self, one: Instance, changes: Mapping[str, float] | None = None) -> None:
        """Bring a fresh instance to its first communication point."""
        answers = [one.setupExperiment(None, self.start)]
        answers += [self.set(one, name, value) for name, value in (changes or {}).items()]
        answers += [one.enterInitializationMode(), one.exitInitializationMode()]
        bad = [answer for answer in answers if answer.status > 1]
        if bad:
            said = f": {one.log[-1]}" if one.log else ""
            raise NoInstance(f"cannot be initialised at its start values ({bad[0].words}{said})")

    def run(self, one: Instance, count: int, first: int = 0) -> list[Answer]:
        """Take equal steps from the communication point number ``first``; return the answers."""
        return [one.doStep(self.start + (first + i) * self.step, self.step, False) for i in range(count)]

    def real_inputs(self) -> list[ScalarVariable]:
        """Real inputs, continuous ones first."""
        inputs = [v for v in self.numeric if v.causality == "input" and v.type == "Real"]
        return sorted(inputs, key=lambda v: v.variability != "continuous")

    def set(self, one: Instance, name: str, value: float) -> Answer:
        """Set a number by name."""
        variable = next(v for v in self.numeric if v.name == name)
        return getattr(one, f"set{_METHOD[variable.type]}")([variable.valueReference], [value])

    def read(self, one: Instance, variable: ScalarVariable) -> Answer:
        """Read a number; the value is a float."""
        answer = getattr(one, f"get{_METHOD[variable.type]}")([variable.valueReference])
        return Answer(answer.status, None if answer.value is None else float(answer.value[0]))

    def everything(self, one: Instance) -> dict[str, float]:
        """Return all numbers by name; NaN for those that cannot be read."""
        numbers: dict[str, float] = {}
        for method in ("Real", "Integer", "Boolean"):
            some = [v for v in self.numeric if _METHOD[v.type] == method]
            answer = (
                getattr(one, f"get{method}")([v.valueReference for v in some]) if some else Answer(OK, [])
            )
            values = answer.value if answer.value is not None else [math.nan] * len(some)
            numbers |= {v.name: float(value) for v, value in zip(some, values, strict=True)}
        return numbers

    def outputs(self, one: Instance) -> dict[str, float]:
        """Return all numeric outputs by name."""
        names = {v.name for v in self.numeric if v.causality == "output"}
        return {name: value for name, value in self.everything(one).items() if name in names}

    def nudged(self) -> dict[str, float]:
        """Return every Real input moved by a little, within its range."""
        moved = {}
        for variable in self.real_inputs():
            start = float(variable.start or 0.0)
            nominal = float(variable.nominal or 1.0)
            value = start + 0.01 * max(abs(start), abs(nominal))
            if variable.max is not None and value > float(variable.max):
                value = start - 0.01 * max(abs(start), abs(nominal))
            moved[variable.name] = value
        return moved


def difference(one: Mapping[str, float], other: Mapping[str, float]) -> str:
    """Name the first variable whose bits differ, with both values; empty where none does."""
    for name, value in one.items():
        if struct.pack("<d", value) != struct.pack("<d", other[name]):
            count = sum(struct.pack("<d", v) != struct.pack("<d", other[n]) for n, v in one.items())
            return f"{name} = {value!r} and {other[name]!r} ({count} of {len(one)} variables differ)"
    return ""


def not_finite(values: Mapping[str, float]) -> str:
    """Name variables that are no finite numbers; empty where all are."""
    bad = [f"{name} = {value!r}" for name, value in values.items() if not math.isfinite(value)]
    return ", ".join(bad[:3]) + (f" and {len(bad) - 3} more" if len(bad) > 3 else "")
