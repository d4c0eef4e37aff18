"""The bearing as a pythonfmu slave: base class of the stub module inside the FMU.

With pythonfmu 0.7.0, an exception that leaves one of these methods becomes fmi2Fatal and frees the Python
objects twice. Therefore none may leave. The only way to refuse anything is to refuse a step (``do_step``
returns ``False``: fmi2Discard). Reset makes a new object of this class.
"""

import functools
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar
from xml.etree.ElementTree import Element

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from fmu_bearing.fmi import host, resources
from fmu_bearing.fmi.description import LOG_CATEGORIES, description_element, fmi_type
from fmu_bearing.fmi.session import DISCARD, ERROR, WARNING, Session
from fmu_bearing.fmi.state import State, StateError

__all__ = ["BearingSlave"]

_STATUS = {WARNING: Fmi2Status.warning, DISCARD: Fmi2Status.discard, ERROR: Fmi2Status.error}


def _contained(fallback: Any) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Keep exceptions of a method inside: log them, refuse every later step, return ``fallback``."""

    def decorate(method: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(method)
        def contained(self: "BearingSlave", *arguments: Any) -> Any:
            try:
                return method(self, *arguments)
            except Exception:
                self.session.fail(f"{method.__name__} failed: {traceback.format_exc()}")
                return fallback(*arguments) if callable(fallback) else fallback

        return contained

    return decorate


def _zeros(references: list[int]) -> list[float]:
    return [0.0] * len(references)


class BearingSlave(Fmi2Slave):
    """Slave that reads its model from the FMU's resources, beside the stub.

    A stub names the model it was built for by its fingerprint; resources with another one are refused.
    """

    fingerprint: ClassVar[str] = ""
    log_categories: ClassVar[dict[str, str]] = LOG_CATEGORIES

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        try:
            host.leave_search_path(self.resources)
            host.finalise_before_exit(self.resources, type(self).__name__)
            self.model = resources.load(Path(self.resources), self.fingerprint)
            self.session = Session(self.model, self._note)
        except Exception as error:
            # fmi2Instantiate then returns NULL and loses the reason
            print(f"{self.instance_name}: cannot instantiate: {error}", file=sys.stderr)
            raise
        self.modelName = type(self).__name__
        self._types = [fmi_type(variable) for variable in self.model.variables]

    def _note(self, severity: str, message: str) -> None:
        self.log(message, _STATUS[severity])

    def to_xml(self, model_options: dict[str, str] | None = None) -> Element:
        """Return ``modelDescription.xml`` as a tree; options of pythonfmu's builder change nothing."""
        return description_element(self.model, "python")

    @_contained(None)
    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Take start time and tolerance; the stop time does not matter to the model."""
        self.session.setup(start_time, tolerance)

    @_contained(None)
    def enter_initialization_mode(self) -> None:
        """Begin to initialise."""
        self.session.enter_initialisation()

    @_contained(None)
    def exit_initialization_mode(self) -> None:
        """Put the bearing into its steady state at the inputs."""
        self.session.exit_initialisation()

    @_contained(False)
    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance; ``False`` (fmi2Discard) where the step is refused, with the state unchanged."""
        return self.session.step(current_time, step_size)

    @_contained(None)
    def terminate(self) -> None:
        """End stepping."""
        self.session.terminate()

    @_contained(_zeros)
    def get_real(self, vrs: list[int]) -> list[float]:
        """Return Reals."""
        return self.session.get(vrs, "Real")

    @_contained(_zeros)
    def get_integer(self, vrs: list[int]) -> list[int]:
        """Return Integers and Enumerations."""
        return [int(value) for value in self.session.get(vrs, "Integer")]

    @_contained(None)
    def set_real(self, vrs: list[int], values: list[float]) -> None:
        """Take Reals."""
        self.session.set(vrs, values, "Real")

    @_contained(None)
    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        """Take Integers and Enumerations."""
        self.session.set(vrs, values, "Integer")

    @_contained(lambda vrs: [False] * len(vrs))
    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Return nothing of use: the interface has no Booleans."""
        return [bool(value) for value in self.session.get(vrs, "Boolean")]

    @_contained(lambda vrs: [""] * len(vrs))
    def get_string(self, vrs: list[int]) -> list[str]:
        """Return Strings, all of them constants."""
        return [str(value) for value in self.session.get(vrs, "String")]

    @_contained(None)
    def set_boolean(self, vrs: list[int], values: list[bool]) -> None:
        """Refuse: the interface has no Booleans."""
        self.session.set(vrs, values, "Boolean")

    @_contained(None)
    def set_string(self, vrs: list[int], values: list[str]) -> None:
        """Refuse: all Strings are constants."""
        self.session.set(vrs, values, "String")

    # --- state: pythonfmu calls these names ------------------------------------------------------
    @_contained(lambda: StateError("no state could be taken"))
    def _get_fmu_state(self) -> State:
        return self.session.state()

    @_contained(None)
    def _set_fmu_state(self, state: State | StateError) -> None:
        try:
            if isinstance(state, StateError):
                raise state
            self.session.restore(state)
        except StateError as problem:
            self.session.fail(f"state not taken: {problem}")

    @classmethod
    def _fmu_state_to_bytes(cls, state: State | StateError) -> bytes:
        return state.to_bytes(cls.fingerprint) if isinstance(state, State) else b""

    @classmethod
    def _fmu_state_from_bytes(cls, data: bytes) -> State | StateError:
        # An exception would be fatal to the instance: what is wrong comes out when the state is set.
        try:
            return State.from_bytes(bytes(data), cls.fingerprint)
        except Exception as error:
            return error if isinstance(error, StateError) else StateError(f"the state is damaged: {error}")
