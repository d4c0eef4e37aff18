"""A run of an FMU by FMPy, with its log, and with the results so far when a step is refused."""

import pathlib
import re
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.model_description import ModelDescription
from numpy.typing import NDArray

from fmu_bearing.file_words import FMU, trouble
from fmu_bearing.files import plain_file
from fmu_bearing.results.result import COMPLETE, INTERRUPTED, REFUSED, ResultError
from fmu_bearing.results.series import columns_of, structured
from fmu_bearing.run.inputs import Input
from fmu_bearing.run.march import Proceed
from fmu_bearing.scene import SceneError, read_scene

_REFUSED_VALUE = re.compile(r"\S+ = \S+ is refused")
_LAST_LINES = 3  # of the FMU's log that go into a message


class FmuPlayer:
    """A co-simulation FMU that is run by ``fmpy.simulate_fmu``."""

    def __init__(self, path: pathlib.Path, description: ModelDescription) -> None:
        self.path, self.description = path, description
        variables = [v for v in description.modelVariables if v.type != "String"]
        self.name = description.modelName
        self.scene = _scene_inside(path)
        self.readable = {v.name: _unit(v) for v in variables}
        self.outputs = [v.name for v in variables if v.causality == "output"]
        own = {
            v.name: (v.causality, Input(float(v.start or 0.0), _bound(v.min), _bound(v.max), _unit(v)))
            for v in variables
            if v.causality in ("input", "parameter") and v.type == "Real"
        }
        self.inputs = {name: one for name, (causality, one) in own.items() if causality == "input"}
        self.ranges = {name: one for name, (_, one) in own.items()}
        self.settable = [v.name for v in variables if v.causality in ("input", "parameter")]

    def run(
        self, stop_time: float, step: float, table: NDArray[Any] | None, start: dict[str, float],
        names: Sequence[str], proceed: Proceed,
    ) -> tuple[NDArray[Any], str, str]:  # fmt: skip
        """Return the table of results, how the run ended, and why.

        A start value outside its range is refused before: FMPy would run up to the first step with it.
        """
        for name, value in start.items():
            if name in self.ranges:
                self.ranges[name].check_start(name, value)
        watch = _Watch(proceed, stop_time)
        with tempfile.TemporaryDirectory() as folder:
            self._unpack(folder)
            try:
                fmpy.simulate_fmu(
                    folder, start_time=0.0, stop_time=stop_time, output_interval=step,
                    fmi_type="CoSimulation", start_values=start, input=self._whole(table, start),
                    output=list(names), logger=watch.log, debug_logging=True,
                    step_finished=watch.step_finished, model_description=self.description,
                )  # fmt: skip
            except FMICallException as problem:
                watch.refused(str(problem))
                if watch.recorder is None:
                    raise ResultError(f"{self.path}: {watch.note}") from None
            except Exception as problem:  # FMPy raises plain Exceptions: no library for this platform, ...
                raise ResultError(f"{self.path}: {problem}") from None
        result = watch.recorder.result()
        rows = watch.rows if watch.ended == REFUSED else len(result)
        columns = {name: np.asarray(result[name], float)[:rows] for name in ("time", *names)}
        return structured(columns), watch.ended, watch.note

    def _unpack(self, folder: str) -> None:
        try:
            fmpy.extract(str(self.path), folder)
        except Exception as problem:  # of members that point outside, damaged ones, a full disk
            words = trouble(self.path, FMU, problem, known=False)
            raise ResultError(f"{self.path}: {words}") from None

    def _whole(self, table: NDArray[Any] | None, start: Mapping[str, float]) -> NDArray[Any] | None:
        """Return the table with a column for every input, as FMPy needs it; inputs not given are held."""
        if table is None:
            return None
        given = ["time", *columns_of(table)]
        constants = {name: one.start for name, one in self.inputs.items()} | dict(start)
        missing = [name for name in self.inputs if name not in given]
        constant = {name: np.full(len(table), constants[name]) for name in missing}
        return structured({name: table[name] for name in given} | constant)


class _Watch:
    """Callbacks of FMPy during a run."""

    def __init__(self, proceed: Proceed, stop_time: float) -> None:
        self.proceed, self.stop_time = proceed, stop_time
        self.recorder: Any = None
        self.rows = 1
        self.time = 0.0
        self.lines: list[str] = []
        self.ended, self.note = COMPLETE, ""

    def log(self, environment: Any, name: Any, status: int, category: Any, message: Any) -> None:
        """Take a message of the FMU's log if it is a warning or worse."""
        if status > 0:
            # a message is a format in which % and # are doubled
            text = message.decode("utf-8", "replace")
            self.lines.append(text.replace("%%", "%").replace("##", "#"))

    def step_finished(self, time: float, recorder: Any) -> bool:
        """Return whether to continue; FMPy itself would repeat a refused step for ever."""
        self.recorder = recorder
        if time <= self.time:
            self.refused(f"the step from t = {time:.9g} s was refused")
            return False
        self.time, self.rows = time, self.rows + 1
        if not self.proceed(time):
            self.ended = INTERRUPTED
            self.note = f"interrupted at t = {time:.6g} s of {self.stop_time:g} s"
        return self.ended == COMPLETE

    def refused(self, why: str) -> None:
        """Note why the run ends here, with the FMU's messages, each refused value once."""
        self.ended = REFUSED
        kept: list[str] = []
        for line in self.lines[-_LAST_LINES:]:
            again = _REFUSED_VALUE.search(line)
            if again is None or not any(again[0] in one for one in kept):
                kept.append(line)
        self.note = "; ".join([why.rstrip("."), *kept])  # FMPy ends its sentence


def open_fmu(path: pathlib.Path) -> FmuPlayer:
    """Open an FMU for a run.

    Raises
    ------
    ResultError
        When the file is not a co-simulation FMU that FMPy reads.
    """
    try:
        description = fmpy.read_model_description(str(plain_file(path)))
        if description.coSimulation is None:
            raise ResultError(f"{path}: is not a co-simulation FMU")
        return FmuPlayer(path, description)
    except ResultError:
        raise
    except Exception as problem:  # FMPy, zipfile and zlib raise what they come upon
        raise ResultError(f"{path}: {trouble(path, FMU, problem, 'FMU', known=False)}") from None


def _bound(value: str | float | None) -> float | None:
    """Return a bound of a variable, which FMPy may hold as text."""
    return None if value is None else float(value)


def _unit(variable: Any) -> str:
    """Return the unit of a variable or of its type."""
    declared = variable.declaredType.unit if variable.declaredType is not None else None
    return variable.unit or declared or ""


def _scene_inside(path: pathlib.Path) -> Any:
    """Return the scene that one of our FMUs carries, None for others."""
    with zipfile.ZipFile(path) as archive, tempfile.TemporaryDirectory() as folder:
        if "resources/scene.toml" not in archive.namelist():
            return None
        try:
            return read_scene(archive.extract("resources/scene.toml", folder))
        except SceneError:
            return None
