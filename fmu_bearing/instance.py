"""One running bearing: the model's numbers, its state, and access by name.

The same object serves the library and the FMU, so that both give the same bits.
"""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing import renamed
from fmu_bearing.compiled import Calls
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.layout import P, S, U, W, Z
from fmu_bearing.engine.status import BAD_INPUT, BAD_STEP, NO_START, NOT_CONVERGED, OK, RIGID_ONLY, TOO_SOFT
from fmu_bearing.interface import Variable
from fmu_bearing.prepare.model import Model

#: Messages for the status codes of the engine.
REASONS = {
    NOT_CONVERGED: "the equations could not be solved: even the shortest internal steps failed; "
    "change inputs by less at a time, or over more steps",
    BAD_INPUT: "an input is not finite or outside its range",
    BAD_STEP: "the communication step must be a positive, finite number of seconds",
    NO_START: "no quasi-static equilibrium was found for the initial inputs; "
    "give more preload or less radial load",
    RIGID_ONLY: "its rings bend, which needs fidelity full",
    TOO_SOFT: "the loads push the outer ring sideways by more than 0.3 of the pitch radius; "
    "give a stiffer pedestal or less radial load",
}


@dataclass(frozen=True)
class Caution:
    """A warning where a number is below a threshold: ``before``, ``scale`` times the number, ``after``.

    Attributes
    ----------
    index : int
        Place of the number in its array.
    threshold : float
    scale : float
        Factor on the number in the text.
    before, after : str
        Text around the number.
    decimals : int
        Digits of the number behind the point.
    array : str
        ``z`` or ``u``.
    """

    index: int
    threshold: float
    scale: float
    before: str
    after: str
    decimals: int = 1
    array: str = "z"


def _shoulder(ring: str, other: str) -> Caution:
    return Caution(
        Z.BEARING_OUTPUTS.index(f"contact.{ring}.shoulder_margin"),
        0.0,
        -180.0 / math.pi,
        f"the ellipse of the most loaded contact of the {ring} race reaches ",
        f" deg beyond its shoulder (bearing.{ring}_ring_{other}_diameter_mm): the edge cuts in there, while "
        "loads and stiffness are those of an unbroken groove; reduce preload or load",
    )


_WAVES = Caution(
    Z.BEARING_OUTPUTS.index("solver.wave_time"),
    9e-6,
    1e6,
    "the fastest wave of races and balls turns by one radian in ",
    " us, which internal steps have to follow: its frequency lies above 17 kHz; for speed give a lower "
    "imperfections.highest_order or highest_frequency_kHz, or one scene for low and one for high speeds",
)
_ALWAYS = (_shoulder("inner", "outer"), _shoulder("outer", "inner"), _WAVES)
_LOOSE = "preload = 0 N: no axial force holds balls and races together: loose balls skid or lift off; "
_ROLLS = {
    "full": "what they then do depends on gravity, loads and chance more than on the bearing",
    "rings": "fidelity rings has balls that always roll: its loads, levels and torque then mean little",
    "response": "fidelity response has balls that always roll and contacts that never open: its loads may be "
    "wrong by orders of magnitude",
}
_LONGEST_TEXT = 57  # of a value that is repeated in a message
_RELATIVE_SLACK = 1e-12  # a value at a bound may carry rounding from a unit conversion


def number(name: str, value: object) -> float:
    """Return a value as float; ``ValueError`` for text, truth values and what is no single number."""
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


def loose(fidelity: str) -> str:
    """Return the warning about a bearing without preload at a fidelity."""
    words = _LOOSE + _ROLLS[fidelity]
    return f"{words}; give a preload (mounting.preload_N, input preload), or expect no more than a trend"


def cautions(fidelity: str) -> tuple[Caution, ...]:
    """Return the warnings checked after initialisation and after each step, each given once."""
    before, nothing, after = loose(fidelity).partition("0")
    smallest = math.ulp(float(nothing))
    return (Caution(U.PRELOAD, smallest, 1.0, before, after, decimals=0, array="u"), *_ALWAYS)


class EngineError(ValueError):
    """The engine refused; the instance is as it was before the call."""


class Instance:
    """A bearing that can be stepped.

    Parameters
    ----------
    model : Model
        Prepared scene; never changed, so any number of instances may share it.
    tell : callable, optional
        Takes each warning, once; default: ``warnings.warn``.

    Examples
    --------
    >>> bearing = Instance(prepare(scene))            # doctest: +SKIP
    >>> bearing.initialise()                          # doctest: +SKIP
    >>> bearing.set("shaft_speed", 2100.0)            # doctest: +SKIP
    >>> bearing.step(1e-3)                            # doctest: +SKIP
    >>> bearing.get("friction_torque")                # doctest: +SKIP
    """

    def __init__(self, model: Model, tell: Callable[[str], None] | None = None) -> None:
        self.model = model
        self.tell = tell or (lambda text: warnings.warn(text, stacklevel=4))
        self.by_name = {variable.name: variable for variable in model.variables}
        self._cautions = cautions(FIDELITIES[int(model.parameters[P.FIDELITY])])
        self.reset()

    def reset(self) -> None:
        """Back to the state of a fresh instance."""
        model = self.model
        self.p: NDArray[np.float64] = model.parameters.copy()
        self.u: NDArray[np.float64] = np.zeros(len(U.INPUTS))
        sizes = (model.n_balls, model.n_mics, model.n_bands, model.n_modes)
        self.z: NDArray[np.float64] = np.zeros(Z.size(*sizes))
        self.s: NDArray[np.float64] = np.zeros(S.size(self.p))
        self._calls = Calls(self.p, self.u, self.s, self.z, np.zeros(W.size(self.p)))
        self._kept = self.s.copy()
        self.initialised = False
        self._due = self._cautions
        for variable in model.variables:
            if variable.array == "u" and variable.start is not None:
                self.u[variable.index] = variable.start

    @property
    def time(self) -> float:
        """Time reached (s)."""
        return float(self.s[S.TIME])

    def variable(self, name: str) -> Variable:
        """Variable of that name; ``KeyError`` for an unknown name, with the new name of an old one."""
        try:
            return self.by_name[name]
        except KeyError:
            now = f"; it is now '{renamed.VARIABLES[name]}'" if name in renamed.VARIABLES else ""
            raise KeyError(f"this bearing has no variable '{name}'{now}") from None

    def set(self, name: str, value: float) -> None:
        """Set an input, or a parameter before initialisation; ``ValueError`` if refused."""
        variable = self.variable(name)
        value = number(name, value)
        if variable.array == "u":
            check(variable, value)
            self.u[variable.index] = value
        elif variable.array == "p" and variable.causality == "parameter":
            if self.initialised:
                raise ValueError(f"{name} is fixed once the bearing is initialised; call reset() first")
            check(variable, value)
            self.p[variable.index] = value
        else:
            raise ValueError(f"{name} cannot be set: its causality is {variable.causality}")

    def get(self, name: str) -> float:
        """Value of any variable, SI units."""
        variable = self.variable(name)
        if variable.array == "":
            if variable.value is None:
                raise ValueError(f"{name} has no value: the table of variables gives it none")
            return variable.value
        return float({"u": self.u, "z": self.z, "p": self.p}[variable.array][variable.index])

    def initialise(self, time: float = 0.0) -> None:
        """Put the bearing into its quasi-static state at the inputs; ``EngineError`` if there is none."""
        status = self._calls.init(float(time))
        if status != OK:
            raise EngineError(f"initialisation at t = {time} s: {REASONS[status]}; {self._inputs()}")
        self.initialised = True
        self._due = self._cautions
        self._warn()

    def _warn(self) -> None:
        """Give the warnings about the state reached that were not given yet."""
        for one in self._due:
            value = (self.u if one.array == "u" else self.z)[one.index]
            if value < one.threshold:
                self._due = tuple(other for other in self._due if other is not one)
                self.tell(f"{one.before}{one.scale * value:.{one.decimals}f}{one.after}")

    def step(self, h: float) -> None:
        """Advance by ``h`` (s). The speed ramps to its input over the step; other inputs are held.

        ``EngineError`` if the step is refused; the state is then that before the call.
        """
        if not self.initialised:
            raise EngineError("the bearing must be initialised before it is stepped")
        h = number("step h", h)
        self._kept[:] = self.s
        status = self._calls.step(h)
        if status != OK:
            reached = self.time
            self.s[:] = self._kept
            raise EngineError(
                f"step of {h} s from t = {self.time:.9g} s (reached {reached:.9g} s): {REASONS[status]}; "
                f"{self._inputs()}"
            )
        self._warn()

    def _inputs(self) -> str:
        named = zip(U.INPUTS, self.u, strict=True)
        return "inputs were " + ", ".join(f"{name} = {value:.6g}" for name, value in named)
