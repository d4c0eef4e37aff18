"""Master of the co-simulation: motor, bearing and thermal network in one process, with FMPy.

Each communication step goes motor, bearing, thermal network, every model with the newest values there are:

1. the motor advances with the torque the bearing took at the end of the last step;
2. the bearing advances to the motor's new speed (it ramps its speed over the step, so it neither lags nor
   jumps) with the temperatures at the beginning of the step;
3. the thermal network advances with the bearing's heats, which are means over this very step: no joule is
   lost between the two.
"""

import math
import shutil
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

import numpy as np
from fmpy import extract, instantiate_fmu, read_model_description
from fmpy.fmi1 import FMICallException
from numpy.typing import NDArray

TEMPERATURES = ("oil_temperature", "inner_ring_temperature", "outer_ring_temperature")
HEATS = ("heat.inner_ring", "heat.outer_ring", "heat.oil")
MOTOR_OUTPUTS = ("shaft_speed", "speed_setpoint", "motor_torque", "electrical_power")
THERMAL_OUTPUTS = ("balls_temperature", "housing_temperature")
STATUS = ("ok", "warning", "discard", "error", "fatal", "pending")


class SimulationError(RuntimeError):
    """An FMU refused a call; the message names the FMU and what it said.

    ``recording`` holds what a co-simulation had computed by then.
    """

    recording: "Recording | None" = None


class Fmu:
    """One instance of an FMI 2.0 co-simulation FMU, with variables by name.

    Use as a context manager: the instance and its unzipped files go with it.
    """

    def __init__(self, path: Path, name: str) -> None:
        if not path.is_file():
            raise FileNotFoundError(f"no FMU at {path}; `make demo` builds it")
        self.name = name
        self.messages: list[str] = []
        self.description = read_model_description(str(path))
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self._folder = extract(str(path))
        try:
            self._slave = instantiate_fmu(
                self._folder,
                self.description,
                fmi_type="CoSimulation",
                debug_logging=True,
                logger=self._log,
            )
        except Exception as error:
            shutil.rmtree(self._folder, ignore_errors=True)
            raise SimulationError(f"{name}: cannot be instantiated: {self._why(error)}") from error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: Any) -> None:
        self._slave.freeInstance()
        shutil.rmtree(self._folder, ignore_errors=True)

    def enter_initialization(self, **values: float) -> None:
        """Set values (names may need ``**{"a.b": 1.0}``) and begin to initialise at time 0."""
        self._call(self._slave.setupExperiment, startTime=0.0)
        self.set(values)
        self._call(self._slave.enterInitializationMode)

    def exit_initialization(self) -> None:
        """Finish initialisation."""
        self._call(self._slave.exitInitializationMode)

    def step(self, time: float, h: float) -> None:
        """Advance from ``time`` by ``h``, both in s."""
        self._call(self._slave.doStep, currentCommunicationPoint=time, communicationStepSize=h)

    def keep(self) -> Any:
        """Return the instance's state, for :meth:`put_back`; :meth:`forget` it afterwards."""
        return self._call(self._slave.getFMUstate)

    def put_back(self, state: Any) -> None:
        """Return to a state kept; the next step is from its time."""
        self._call(self._slave.setFMUstate, state)

    def forget(self, state: Any) -> None:
        """Free a state kept."""
        self._call(self._slave.freeFMUstate, state)

    def set(self, values: dict[str, float]) -> None:
        """Set Real variables by name."""
        if values:
            references = [self._reference(name) for name in values]
            self._call(self._slave.setReal, references, list(values.values()))

    def get(self, names: Iterable[str]) -> list[float]:
        """Values of Real variables by name."""
        return self._call(self._slave.getReal, [self._reference(name) for name in names])

    def reader(self, names: Iterable[str]) -> Callable[[], list[float]]:
        """Return a function that reads these variables, with the names looked up once."""
        references = [self._reference(name) for name in names]
        return lambda: self._call(self._slave.getReal, references)

    def start(self, name: str) -> float:
        """Start value of a variable, as its description has it."""
        return float(self.variables[name].start)

    def resource(self, name: str) -> Path:
        """Path of a file in the FMU's resources, which need not exist."""
        return Path(self._folder) / "resources" / name

    def having(self, names: Iterable[str]) -> list[str]:
        """Return the ``names`` that this FMU has."""
        return [name for name in names if name in self.variables]

    def _reference(self, name: str) -> int:
        try:
            return self.variables[name].valueReference
        except KeyError:
            raise SimulationError(f"{self.name}: has no variable '{name}'") from None

    def _call(self, function: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
        try:
            return function(*arguments, **named)
        except FMICallException as error:
            raise SimulationError(f"{self.name}: {self._why(error)}") from error

    def _why(self, error: Exception) -> str:
        return " ".join((self.messages[-1] if self.messages else str(error)).split())

    def _log(
        self, _environment: Any, _instance: bytes, status: int, _category: bytes, message: bytes
    ) -> None:
        if status in (1, 2, 3, 4):
            self.messages.append(f"{STATUS[status]}: {message.decode('utf-8', 'replace')}")


@dataclass(frozen=True)
class Plan:
    """What to run.

    Attributes
    ----------
    end_time : float
        s.
    communication_step : float
        s; shortened a little where it does not divide the end time.
    start_speed, target_speed : float
        rad/s, before and after the run-up.
    ramp_time : float
        s.
    metering_start : float
        s; levels are metered from here on, when the start-up has died away.
    true_until, thermal_rate : float
        s, and seconds of the thermal network per second of the others from then on. What turns settles within
        milliseconds and temperatures take minutes: between them lies time in which only these change.
    """

    end_time: float = 1.0
    communication_step: float = 5e-4
    start_speed: float = 2000.0 * math.pi / 30.0
    target_speed: float = 20000.0 * math.pi / 30.0
    ramp_time: float = 0.7
    metering_start: float = 0.02
    true_until: float = math.inf
    thermal_rate: float = 1.0

    def thermal_time(self, time: float) -> float:
        """Time of the thermal network (s) when the others are at ``time``."""
        return time + (self.thermal_rate - 1.0) * max(time - self.true_until, 0.0)


@dataclass
class Recording:
    """Rows over time; ``table`` makes the structured array that FMPy's writers and plots take."""

    names: list[str]
    rows: list[list[float]] = field(default_factory=list)

    def table(self) -> NDArray[np.void]:
        """Structured array with one field per name; ``time`` is the first."""
        kinds = np.dtype([(name, np.float64) for name in self.names])
        return np.array([tuple(row) for row in self.rows], dtype=kinds)


def bearing_names(bearing: Fmu) -> list[str]:
    """Names of what changes in the bearing, without the velocities of single balls: those fill files."""
    return [
        name
        for name, variable in bearing.variables.items()
        if variable.type == "Real"
        and variable.causality in ("output", "local")
        and variable.variability not in ("constant", "fixed")
        and "ball[" not in name
    ]


def exchanged(bearing: Fmu, thermal: Fmu) -> tuple[list[str], list[str]]:
    """Names of temperatures that the thermal network gives to the bearing, and of heats that it takes.

    Both FMUs have them under the same names: of one bearing, or of each bearing of a set and of its shaft and
    housing.
    """
    temperatures, heats = (
        [name for name in bearing.having(thermal.variables) if thermal.variables[name].causality == causality]
        for causality in ("output", "input")
    )
    return temperatures, heats


def run(
    motor: Fmu,
    bearing: Fmu,
    thermal: Fmu,
    plan: Plan,
    progress: Callable[[float], bool] = lambda _: True,
    recorded: Iterable[str] = (),
) -> Recording:
    """Run the three FMUs together.

    Parameters
    ----------
    motor, bearing, thermal : Fmu
        Fresh instances.
    plan : Plan
    progress : callable
        Called after each step with the time reached in s; ``False`` stops the run.
    recorded : iterable of str
        Variables of the bearing that are kept; default: all that :func:`bearing_names` returns.

    Returns
    -------
    Recording
        Up to where the run came, one row per communication point, the start included.

    Raises
    ------
    SimulationError
        If an FMU refuses a call; it carries what was computed.
    """
    recorded = list(recorded) or bearing_names(bearing)
    network = [name for name in thermal.variables if name.endswith("_temperature")]
    network = [name for name in network if thermal.variables[name].causality == "output"]
    recording = Recording(["time", *MOTOR_OUTPUTS, *network, *recorded])
    readers = (motor.reader(MOTOR_OUTPUTS), thermal.reader(network), bearing.reader(recorded))
    exchange = exchanger(motor, bearing, thermal)

    def record(time: float) -> None:
        recording.rows.append([time, *(value for reader in readers for value in reader())])

    initialise(motor, bearing, thermal, plan)
    record(0.0)
    count = max(1, math.ceil(plan.end_time / plan.communication_step - 1e-9))
    for k in range(count):
        now, after = plan.end_time * k / count, plan.end_time * (k + 1) / count
        try:
            exchange(now, after, plan.thermal_time)
        except SimulationError as error:
            error.recording = recording
            raise
        record(after)
        if not progress(after):
            break
    return recording


def exchanger(motor: Fmu, bearing: Fmu, thermal: Fmu) -> Callable[..., None]:
    """Return a function that takes all three from one communication point to the next (both in s).

    Its third argument, if given, turns them into times of the thermal network.
    """
    warm, warming = exchanged(bearing, thermal)
    torque, heats = bearing.reader(["friction_torque"]), bearing.reader(warming)
    speed, temperatures = motor.reader(["shaft_speed"]), thermal.reader(warm)

    def exchange(now: float, after: float, thermal_time: Callable[[float], float] = float) -> None:
        motor.set({"load_torque": torque()[0]})
        motor.step(now, after - now)
        bearing.set(
            {"shaft_speed": speed()[0], **dict(zip(warm, temperatures(), strict=True))},
        )
        bearing.step(now, after - now)
        thermal.set(dict(zip(warming, heats(), strict=True)))
        begin = thermal_time(now)
        thermal.step(begin, thermal_time(after) - begin)

    return exchange


def initialise(motor: Fmu, bearing: Fmu, thermal: Fmu, plan: Plan) -> None:
    """Bring all to time 0: the bearing first, for the motor needs its inertia and its torque."""
    thermal.enter_initialization()
    thermal.exit_initialization()
    given = {"shaft_speed": plan.start_speed, "sound.metering_start": plan.metering_start}
    begin = {name: given[name] for name in bearing.having(given)}
    warm, _ = exchanged(bearing, thermal)
    bearing.enter_initialization(**begin, **dict(zip(warm, thermal.get(warm), strict=True)))
    bearing.exit_initialization()
    (torque,) = bearing.get(["friction_torque"])
    (inertia,) = bearing.get(["rotor.inertia"])
    motor.enter_initialization(
        start_speed=plan.start_speed,
        target_speed=plan.target_speed,
        ramp_time=plan.ramp_time,
        rotor_inertia=inertia,
        load_torque=torque,
    )
    motor.exit_initialization()
