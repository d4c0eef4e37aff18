"""One FMU instance from instantiation to termination: the rules of FMI around an :class:`Instance`.

A session handles value references, phases and refusals, and is independent of the FMU tool. Every call
returns normally, whatever its arguments, and logs what it refused. A refused value stays noted, and every
step is refused until a valid value replaces it, because pythonfmu cannot refuse a single value.
"""

import math
from collections.abc import Callable, Sequence
from enum import Enum
from typing import Any

import numpy as np

from fmu_bearing.engine.layout import P
from fmu_bearing.fmi.state import State, StateError
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import Model

__all__ = ["DISCARD", "ERROR", "WARNING", "Phase", "Session"]

WARNING, DISCARD, ERROR = "warning", "discard", "error"  # severities handed to the log

_FAILED, _UNSETTLED = -1, -2  # keys beside the value references: until reset, until initialised again
_NONE: frozenset[int] = frozenset()
_TUNABLES = slice(0, P.TUNABLE)  # the head of p, all that can be set there


class Phase(Enum):
    """Phase of an instance (FMI 2.0.5, section 4.2.4)."""

    INSTANTIATED = "before initialisation"
    INITIALISING = "in initialisation"
    STEPPING = "between steps"
    TERMINATED = "after termination"


_PHASES = tuple(Phase)


class Session:
    """Calls of an FMI master on one instance of a model.

    Parameters
    ----------
    model : Model
    log : callable
        Takes a severity (:data:`WARNING`, :data:`DISCARD` or :data:`ERROR`) and a message.
    """

    def __init__(self, model: Model, log: Callable[[str, str], None]) -> None:
        self.phase = Phase.INSTANTIATED
        self.time = 0.0
        self._refused: tuple[str, float] | None = None  # step refused last: why, and its size (s), see `step`
        self._variables = model.variables
        self._instance = Instance(model, lambda text: self._log(WARNING, text))
        self._log = log
        self._wrong: dict[int, str] = {}  # by value reference
        self._early = False  # that outputs were read before initialisation was said
        self._shown: list[Any] | None = None  # all values, until something changes
        self._kinds: dict[str, set[int]] = {}
        self._constants: list[Any] = [0.0] * len(model.variables)
        places: dict[str, list[tuple[int, int]]] = {"u": [], "p": [], "z": []}
        for reference, variable in enumerate(model.variables):
            self._kinds.setdefault(variable.type, set()).add(reference)
            if variable.array:
                places[variable.array].append((reference, variable.index))
            else:
                self._constants[reference] = variable.start if variable.value is None else variable.value
        self._computed = {reference for reference, _ in places["z"]}
        self._places = {name: np.array(pairs, int).reshape(-1, 2).T for name, pairs in places.items()}

    # --- values -----------------------------------------------------------------------------------
    def get(self, references: Sequence[int], kind: str) -> list[Any]:
        """Return values of variables of one type, ``Real``, ``Integer`` or ``String``.

        Outputs read during initialisation are those at its end. Before it they are 0, which is said once: FMI
        does not allow the call, but an error would end a host that shows values while it loads.
        """
        if self.phase is Phase.INSTANTIATED and not self._early:
            self._say_if_early(references)
        if self.phase is Phase.INITIALISING and not self._computed.isdisjoint(references):
            self._settle()
        if self._shown is None:
            self._shown = self._read()
        shown = self._shown
        known = self._kinds.get(kind, _NONE)
        if known.issuperset(references):
            return [shown[reference] for reference in references]
        strange = sorted(set(references) - known)
        self.fail(f"there is no {kind} with value reference {', '.join(map(str, strange))}")
        return ["" if kind == "String" else 0 for _ in references]

    def _say_if_early(self, references: Sequence[int]) -> None:
        for reference in references:
            if reference in self._computed:
                self._early = True
                self._log(
                    WARNING,
                    f"{self._variables[reference].name} is read before initialisation: outputs are 0 until "
                    "fmi2EnterInitializationMode is called",
                )
                return

    def _read(self) -> list[Any]:
        shown = self._constants.copy()
        for name, (references, indices) in self._places.items():
            values = getattr(self._instance, name)[indices].tolist()
            for reference, value in zip(references, values, strict=True):
                shown[reference] = value
        return shown

    def set(self, references: Sequence[int], values: Sequence[Any], kind: str) -> None:
        """Set values. A refused value is noted, and steps are refused until a valid one replaces it."""
        self._shown = None
        for reference, value in zip(references, values, strict=True):
            if reference not in self._kinds.get(kind, _NONE):
                self.fail(f"there is no {kind} with value reference {reference}")
                continue
            problem = self._take(reference, value)
            if problem and self._may_wait(reference, value):
                self._keep_waiting(reference, problem)
            elif problem:
                self._wrong[reference] = problem
                self._log(DISCARD, f"value not taken: {problem}")
            else:
                self._wrong.pop(reference, None)

    def _take(self, reference: int, value: Any) -> str:
        variable = self._variables[reference]
        refused = f"{variable.name} = {value!r} is refused: "
        if variable.causality not in ("input", "parameter") or variable.variability == "constant":
            return f"{refused}it is computed, not set"
        if self.phase is Phase.TERMINATED:
            return f"{refused}nothing can be set {self.phase.value}"
        if self.phase is Phase.STEPPING and variable.variability == "fixed":
            # the value it has already is no change, and ends an earlier refusal
            unchanged = value == self._instance.get(variable.name)
            return "" if unchanged else f"{refused}parameters cannot be set {self.phase.value}"
        if self.phase is not Phase.STEPPING:
            self._unsettle()
        before = self._instance.get(variable.name)
        try:
            self._instance.set(variable.name, value)
        except ValueError as error:
            return str(error)
        if value != before and not self._wrong:  # a refused value waits for its own true one
            self._refused = None
        return ""

    def _may_wait(self, reference: int, value: Any) -> bool:
        """Whether a value out of range waits for a better one.

        There are masters that set every input to 0 while they load, whatever its range, and give it its
        first true value in or after initialisation.
        """
        begun = self.phase in (Phase.STEPPING, Phase.TERMINATED)
        return self._variables[reference].causality == "input" and math.isfinite(value) and not begun

    def _keep_waiting(self, reference: int, problem: str) -> None:
        """Go on with the start value of an input, and refuse steps until a value in its range comes."""
        variable = self._variables[reference]
        assert variable.start is not None
        self._instance.set(variable.name, variable.start)
        self._wrong[reference] = (
            f"{problem}; set before the end of initialisation, and no value in the range has come since"
        )
        self._log(
            WARNING,
            f"value not taken yet: {problem}; initialisation uses the start value {variable.start!r}, and "
            "steps are refused until a value in the range comes",
        )

    # --- phases -----------------------------------------------------------------------------------
    def setup(self, start: float, tolerance: float | None) -> None:
        """Take start time (s) and relative tolerance, which wins over the parameter."""
        if self.phase is not Phase.INSTANTIATED:
            self.fail(f"setupExperiment called {self.phase.value}")
            return
        if math.isfinite(start):
            self.time = start
        else:
            self.fail(f"start time {start!r} s is not a finite number")
        if tolerance is not None:
            self._take_tolerance(tolerance)

    def _take_tolerance(self, tolerance: float) -> None:
        """Take the experiment's tolerance; beyond its range it counts as the bound."""
        for reference, variable in enumerate(self._variables):
            if variable.name != "tolerance":
                continue
            if not math.isfinite(tolerance):
                self.fail(f"the experiment's tolerance {tolerance!r} is not a finite number")
                return
            assert variable.min is not None and variable.max is not None
            taken = min(max(tolerance, variable.min), variable.max)
            self.set([reference], [taken], variable.type)
            if taken != tolerance:
                self._log(
                    WARNING,
                    f"the experiment's tolerance {tolerance!r} is taken as {taken!r}: allowed are "
                    f"{variable.min:g} to {variable.max:g}",
                )

    def enter_initialisation(self) -> None:
        """Begin to initialise."""
        if self.phase is Phase.INSTANTIATED:
            self.phase = Phase.INITIALISING
        else:
            self.fail(f"enterInitializationMode called {self.phase.value}")

    def exit_initialisation(self) -> None:
        """Put the bearing into its steady state at the inputs."""
        if self.phase is not Phase.INITIALISING:
            self.fail(f"exitInitializationMode called {self.phase.value}")
            return
        self._settle()
        self.phase = Phase.STEPPING

    def _settle(self) -> None:
        """Put the engine into its steady state at the inputs set so far, once."""
        if self._instance.initialised or _UNSETTLED in self._wrong:
            return
        self._shown = None
        try:
            self._instance.initialise(self.time)
        except EngineError as error:
            self._wrong[_UNSETTLED] = str(error)
            self._log(ERROR, str(error))

    def _unsettle(self) -> None:
        """Undo an initialisation that was made to read outputs, because another value is set."""
        self._wrong.pop(_UNSETTLED, None)
        instance = self._instance
        if instance.initialised:
            inputs, tunables = instance.u.copy(), instance.p[_TUNABLES].copy()
            instance.reset()
            instance.u[:] = inputs
            instance.p[_TUNABLES] = tunables

    def step(self, time: float, size: float) -> bool:
        """Advance from ``time`` by ``size`` (s); ``False``, state unchanged, where that is refused.

        There are masters that repeat a discarded step for ever, so one refused again for the same reason,
        with nothing changed in between, is logged as an error. A refused value is the same reason at any
        size.
        """
        same = math.inf if self._wrong else size
        problem = self._objection(time, size)
        if not problem:
            try:
                self._instance.step(size)
            except EngineError as error:
                problem = str(error)
        if problem:
            text = f"step from {time!r} s by {size!r} s refused: {problem}"
            if self._refused == (problem, same):
                self._log(ERROR, f"{text}; again, and nothing was changed")
            else:
                self._refused = (problem, same)
                self._log(DISCARD, text)
            return False
        self._shown = self._refused = None
        self.time = time + size
        return True

    def _objection(self, time: float, size: float) -> str:
        if self._wrong:
            return "; ".join(self._wrong.values())
        if self.phase is not Phase.STEPPING:
            return f"doStep called {self.phase.value}"
        if not (math.isfinite(size) and size > 0.0):
            return f"the step {size!r} s is not a positive, finite number"
        # masters count time in different ways: allow what adding up steps may lose
        if not abs(time - self.time) <= 1e-9 + 1e-12 * abs(self.time):
            return f"the communication time {time!r} s is not the time reached, {self.time!r} s"
        return ""

    def terminate(self) -> None:
        """End stepping; values can still be read."""
        if self.phase is not Phase.STEPPING:
            self._log(ERROR, f"terminate called {self.phase.value}")
        self.phase = Phase.TERMINATED

    def fail(self, message: str) -> None:
        """Note an error that only a reset or an earlier state can clear."""
        self._wrong[_FAILED] = message
        self._log(ERROR, message)

    # --- state ------------------------------------------------------------------------------------
    def state(self) -> State:
        """Return a copy of all that a later call depends on."""
        instance = self._instance
        return State(
            phase=_PHASES.index(self.phase),
            time=self.time,
            inputs=instance.u.copy(),
            tunables=instance.p[_TUNABLES].copy(),
            outputs=instance.z.copy(),
            engine=instance.s.copy(),
            settled=instance.initialised,
            wrong=tuple(self._wrong.items()),
        )

    def restore(self, state: State) -> None:
        """Go back to a state of this model: what follows is the same to the last bit.

        Raises
        ------
        StateError
            For arrays of other lengths than the model's, or no phase; nothing is taken then.
        """
        instance = self._instance
        places = instance.p[_TUNABLES], instance.u, instance.z, instance.s
        kept = state.tunables, state.inputs, state.outputs, state.engine
        if [one.size for one in places] != [one.size for one in kept]:
            raise StateError("the state is damaged: its arrays have other lengths than this model's")
        if state.phase not in range(len(_PHASES)):
            raise StateError("the state is damaged: it has no phase")
        for place, values in zip(places, kept, strict=True):
            place[:] = values
        instance.initialised = state.settled
        self.phase = _PHASES[state.phase]
        self.time = state.time
        self._wrong = dict(state.wrong)
        self._shown = self._refused = None
