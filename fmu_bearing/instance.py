"""One running bearing, or set of bearings: the model's numbers, its state, and access by name.

The same object serves the library and the FMU, so that both give the same bits.
"""

import math
import warnings
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays, EngineError
from fmu_bearing.cautions import cautions
from fmu_bearing.compiled import call
from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.layout import SP, P, S
from fmu_bearing.engine.status import OK
from fmu_bearing.interface import Variable
from fmu_bearing.interface.inputs import led_inputs
from fmu_bearing.interface.outputs import first_output
from fmu_bearing.prepare.model import Model

_LONGEST_TEXT = 57  # of a value that is repeated in a message
# Steps of rings and response after which the state is copied: a copy takes longer than a step of response.
# A refused step repeats those since. A step of full takes longer than a copy.
_REPEATED = 32
_RELATIVE_SLACK = 1e-12  # a value at a bound may carry rounding from a unit conversion


def number(name: str, value: object) -> float:
    """Return a value as float; ``ValueError`` for text, truth values and what is not a single number."""
    if type(value) is float:
        return value
    try:
        if isinstance(value, str | bytes | bool):
            raise TypeError
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        text = repr(value)
        text = text if len(text) <= _LONGEST_TEXT else f"{text[:_LONGEST_TEXT]}..."
        raise ValueError(f"{name} = {text} is refused: give a number, SI units") from None


def check(variable: Variable, value: float) -> None:
    """Raise ``ValueError`` unless ``value`` may be set."""
    low = -math.inf if variable.min is None else variable.min
    high = math.inf if variable.max is None else variable.max
    slack = _RELATIVE_SLACK * max(abs(low) if low > -math.inf else 0.0, abs(high) if high < math.inf else 0.0)
    if not math.isfinite(value) or not low - slack <= value <= high + slack:
        unit = f" {variable.unit}" if variable.unit else ""
        raise ValueError(f"{variable.name} = {value} is refused: allowed are {low:g} to {high:g}{unit}")


class Instance:
    """A bearing that can be stepped.

    Parameters
    ----------
    model : Model
        Prepared scene; never changed, so any number of instances may share it.
    tell : callable, optional
        Takes each warning, once; default: ``warnings.warn``.
    growth : bool
        Whether to warn of a motion that grows by itself. A caller that names it in its own words need not.

    Examples
    --------
    >>> bearing = Instance(prepare(scene))            # doctest: +SKIP
    >>> bearing.initialise()                          # doctest: +SKIP
    >>> bearing.set("shaft_speed", 2100.0)            # doctest: +SKIP
    >>> bearing.step(1e-3)                            # doctest: +SKIP
    >>> bearing.get("friction_torque")                # doctest: +SKIP
    """

    def __init__(self, model: Model, tell: Callable[[str], None] | None = None, growth: bool = True) -> None:
        self.model = model
        self.tell = tell or (lambda text: warnings.warn(text, stacklevel=4))
        self.by_name = {variable.name: variable for variable in model.variables}
        self._cautions = cautions(model, growth)
        self.reset()

    def reset(self) -> None:
        """Back to the state of a fresh instance."""
        self._arrays = Arrays(self.model.parameters.copy(), self.model.inputs)
        self.p, self.u, self.z = self._arrays.p, self._arrays.u, self._arrays.z
        self._state, self._calls = self._arrays.s, self._arrays.calls
        # where the steps noted since began: size (s) and inputs of each
        self._kept: NDArray[np.float64] = np.zeros(self._state.size)
        self._keep = self._calls.copier(self._state, self._kept)
        self._put_back = self._calls.copier(self._kept, self._state)
        self._since: list[tuple[float, NDArray[np.float64]]] = []
        self._most = 1 if self.p[P.FIDELITY] == FULL else _REPEATED
        self.initialised = False
        self._due = self._cautions

    @property
    def time(self) -> float:
        """Time reached (s)."""
        return float(self._state[S.TIME])

    @property
    def s(self) -> NDArray[np.float64]:
        """The engine's state. Whoever has it may write to it: the steps before are not repeated then."""
        self._since.clear()
        return self._state

    def variable(self, name: str) -> Variable:
        """Variable of that name; ``KeyError`` for an unknown name."""
        try:
            return self.by_name[name]
        except KeyError:
            if name in self.model.left_out:
                raise KeyError(
                    f"this FMU has no '{name}': fmu.outputs of its scene does not name it; add it there "
                    "and build the FMU again"
                ) from None
            raise KeyError(f"this bearing has no variable '{name}'") from None

    def names(self, *causalities: str) -> list[str]:
        """Return the names of variables of some causalities, in the order of the table."""
        return [name for name, one in self.by_name.items() if one.causality in causalities]

    def set(self, name: str, value: float) -> None:
        """Set an input, a parameter before initialisation, or a tunable one; ``ValueError`` if refused."""
        variable = self.variable(name)
        value = number(name, value)
        if variable.array == "u":
            check(variable, value)
            self.u[variable.index] = value
        elif variable.array == "p" and variable.causality == "parameter":
            if self.initialised and variable.variability == "fixed":
                raise ValueError(f"{name} is fixed once the bearing is initialised; call reset() first")
            check(variable, value)
            self.p[variable.index] = value
            self._since.clear()  # steps are repeated with the parameters that they had
        else:
            raise ValueError(f"{name} cannot be set: its causality is {variable.causality}")

    def get(self, name: str) -> float:
        """Value of any variable, SI units."""
        array, index = self._place(name)
        return float(array[index])

    def reader(self, names: Sequence[str]) -> Callable[[], NDArray[np.float64]]:
        """Return a function that reads variables (SI units, in this order) at each call, until `reset`.

        For loops that read many at every step: their places are looked up once.
        """
        groups: dict[int, tuple[NDArray[np.float64], list[int], list[int]]] = {}
        for k, (array, index) in enumerate(self._place(name) for name in names):
            _, columns, places = groups.setdefault(id(array), (array, [], []))
            columns.append(k)
            places.append(index)
        parts = [(array, np.array(to), np.array(at)) for array, to, at in groups.values()]

        def read() -> NDArray[np.float64]:
            row = np.empty(len(names))
            for array, columns, places in parts:
                row[columns] = array[places]
            return row

        return read

    def _place(self, name: str) -> tuple[NDArray[np.float64], int]:
        """Return the array and the place in it that hold a variable; ``ValueError`` where it has no value."""
        variable = self.variable(name)
        if variable.array == "":
            if variable.value is None:
                raise ValueError(f"{name} has no value: the table of variables gives it none")
            return np.array([variable.value]), 0
        return {"u": self.u, "z": self.z, "p": self.p}[variable.array], variable.index

    def initialise(self, time: float = 0.0) -> None:
        """Put the bearing into its steady state at the inputs; ``EngineError`` if there is none."""
        self._since.clear()
        status = self._calls.init(float(time))
        if status != OK:
            raise EngineError(
                f"initialisation at t = {time} s: {self._arrays.reason(status)}; {self._inputs()}"
            )
        self.initialised = True
        self._due = self._cautions
        self._warn()

    def _warn(self) -> None:
        """Give the warnings about the state reached that were not given yet."""
        for one in self._due:
            value = (self.u if one.array == "u" else self.z)[one.index]
            if one.due(value):
                self._due = tuple(other for other in self._due if other is not one)
                self.tell(f"{one.before}{one.scale * value:.{one.decimals}f}{one.after}")

    def step(self, h: float) -> None:
        """Advance by ``h`` (s). The speed ramps to its input over the step; other inputs are held.

        ``EngineError`` if the step is refused; the state is then that before the call.
        """
        if not self.initialised:
            raise EngineError("the bearing must be initialised before it is stepped")
        h = number("step h", h)
        if len(self._since) in (0, self._most):
            self._keep()
            self._since.clear()
        self._since.append((h, self.u.copy()))
        status = self._calls.step(h)
        if status != OK:
            reached = self.time
            self._go_back()
            raise EngineError(
                f"step of {h} s from t = {self.time:.9g} s (reached {reached:.9g} s): "
                f"{self._arrays.reason(status)}; {self._inputs()}"
            )
        self._warn()

    def _go_back(self) -> None:
        """Go back to before the last step: the engine repeats those before it to the last bit."""
        self._put_back()
        *before, (_, inputs) = self._since
        for h, earlier in before:
            self.u[:] = earlier
            if self._calls.step(h) != OK:
                raise EngineError("the steps before a refused one were not repeated; call reset()")
        self.u[:] = inputs
        self._since.clear()

    def port_derivatives(self, h: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return partial derivatives of force and moment at the end of a step of ``h`` (s).

        For bearings on another model's shaft (``spindle.shaft.external``), by the port's inputs, from the
        present state, which stays as it is, and at the present inputs: of ``port.force.*`` and
        ``port.moment.*`` (rows) by ``port.displacement.*`` and ``port.tilt.*`` at fixed rates, then by the
        rates at fixed place, shape (5, 5) each, SI units. They are differences of two steps for each input.
        ``h`` = 0: those at rest.

        Raises
        ------
        EngineError
            Before initialisation, and without a port.
        """
        places = led_inputs(self.model.scene)
        if not places or not self.initialised:
            why = "the bearings must be initialised" if places else "no other model owns the shaft"
            raise EngineError(f"there are no derivatives at a port: {why}")
        count = int(self.p[int(self.p[P.SET]) + SP.BEARINGS])
        first = first_output(self.model.scene, count) + SP.Z_PORT
        columns = []
        for place in places:
            change = np.zeros(2 * self.u.size)
            change[: self.u.size], change[self.u.size + place] = self.u, 1.0
            z, work = np.zeros(self.z.size), np.zeros(self._arrays.w.size)
            status = call("derivative", self.p, change, np.tile(self._state, 2), z, work, number("step h", h))
            if status != OK:
                raise EngineError(f"derivatives at the port over {h} s: {self._arrays.reason(status)}")
            columns.append(z[first : first + SP.PLANE])
        both = np.array(columns).T
        return both[:, : SP.PLANE], both[:, SP.PLANE :]

    def _inputs(self) -> str:
        named = ((v.name, self.u[v.index]) for v in self.model.variables if v.array == "u")
        return "inputs were " + ", ".join(f"{name} = {value:.6g}" for name, value in named)
