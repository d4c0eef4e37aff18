"""Runs of the bearing FMU alone at a steady speed: the sound's spectrum, and what preload and oil do."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from coupling import TEMPERATURES, Fmu, Plan, Recording
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, kinematic_frequencies
from fmu_bearing.scene import read_scene, si

SAMPLE_RATE = 51200  # Hz: the usual rate of sound measurements, reaches beyond 20 kHz
SETTLE = 0.03  # s: what the quasi-static start leaves behind has died away after 10 to 20 ms

METERING_START = 0.02  # s: for levels over a whole run-up
AFTER_RAMP = 0.05  # s: the speed has settled, six time constants of the motor's control

#: Read at each value of a parameter that is varied; means over the run after SETTLE.
EFFECTS = (
    "friction_torque",
    "contact.inner.angle_mean",
    "contact.outer.angle_mean",
    "contact.inner.load_mean",
    "contact.outer.load_mean",
    "film.lambda_min",
)

Progress = Callable[[float], bool]


@dataclass(frozen=True)
class Point:
    """A steady state: shaft speed in rad/s, temperatures in K by name of the bearing's input."""

    shaft_speed: float
    temperatures: dict[str, float]


def microphones(bearing: Fmu) -> list[str]:
    """Prefixes of the bearing's microphones, such as ``mic[1]``, in the order of the FMU."""
    found = (re.fullmatch(r"(mic\[\w+\])\.spl", name) for name in bearing.variables)
    return [match.group(1) for match in found if match]


def _begin(bearing: Fmu, point: Point, changes: dict[str, float], metering_start: float) -> None:
    values = {"shaft_speed": point.shaft_speed, **point.temperatures, **changes}
    values |= {name: metering_start for name in bearing.having(["sound.metering_start"])}
    bearing.enter_initialization(**values)
    bearing.exit_initialization()


def record_sound(path: Path, point: Point, duration: float, progress: Progress) -> Recording:
    """Sound pressure in Pa at every microphone, sampled at ``SAMPLE_RATE`` for ``duration`` seconds.

    The communication step is the sampling period: outputs read at longer steps would alias.
    """
    with Fmu(path, "bearing") as bearing:
        prefixes = microphones(bearing)
        _begin(bearing, point, {}, SETTLE)
        first, count = round(SETTLE * SAMPLE_RATE), round((SETTLE + duration) * SAMPLE_RATE)
        read = bearing.reader([f"{prefix}.pressure" for prefix in prefixes])
        recording = Recording(["time", *(f"{prefix}.pressure" for prefix in prefixes)])
        for k in range(count):
            bearing.step(k / SAMPLE_RATE, 1.0 / SAMPLE_RATE)
            if k >= first:
                recording.rows.append([(k + 1) / SAMPLE_RATE, *read()])
            if not progress((k + 1) / SAMPLE_RATE):
                break
    return recording


def vary(
    path: Path, point: Point, parameter: str, values: list[float], duration: float, progress: Progress
) -> NDArray[np.void]:
    """Steady states of the bearing over one of its inputs or parameters.

    Returns a structured array with one row per value: the parameter, the means of ``EFFECTS`` and the
    equivalent levels (``mic[k].leq``) over ``duration`` seconds. The communication step is 0.1 ms, short
    enough for means of what fluctuates with the balls.
    """
    step = 1e-4
    first, count = round(SETTLE / step), round((SETTLE + duration) / step)
    with Fmu(path, "bearing") as description:
        names = description.having(EFFECTS)
        levels = [f"{prefix}.leq" for prefix in microphones(description)]
    recording = Recording([parameter, *names, *levels])
    for value in values:
        with Fmu(path, "bearing") as bearing:
            _begin(bearing, point, {parameter: value}, SETTLE)
            read = bearing.reader(names)
            rows = []
            for k in range(count):
                bearing.step(k * step, step)
                if k >= first:
                    rows.append(read())
                if not progress(step):
                    return recording.table()
            recording.rows.append([value, *np.mean(rows, axis=0), *(bearing.get(levels) if levels else ())])
    return recording.table()


def frequencies(bearing: Fmu, speed: float) -> KinematicFrequencies | None:
    """Kinematic frequencies in Hz at a shaft speed in rad/s; None if the FMU does not carry its scene.

    They follow from the bearing's dimensions in the scene inside the FMU and the mean of the loaded contact
    angles, which are a few degrees from the nominal one.
    """
    file = bearing.resource("scene.toml")
    if not file.is_file():
        return None
    geometry = si(read_scene(file).bearing)
    angles = bearing.get(["contact.inner.angle_mean", "contact.outer.angle_mean"])
    return kinematic_frequencies(
        speed,
        geometry.ball_count,
        geometry.ball_diameter,
        geometry.pitch_diameter,
        sum(angles) / 2.0,
    )


def later_leq(run: NDArray[np.void], name: str, plan: Plan) -> float:
    """Equivalent level in dB from the settled target speed to the end of a run.

    The FMU's Leq counts from the start of metering; the sound energy of the later part is a difference of
    two of its readings. Where the run did not come that far, the Leq of all of it is returned.
    """
    since = np.maximum(run["time"] - plan.metering_start, 0.0)
    energy = 10.0 ** (run[name] / 10.0) * since
    first = int(np.searchsorted(run["time"], plan.ramp_time + AFTER_RAMP))
    if first >= len(run) - 1:
        return float(run[name][-1])
    mean = (energy[-1] - energy[first]) / (since[-1] - since[first])
    return 10.0 * float(np.log10(max(mean, 1e-12)))


def point_at_end(run: NDArray[np.void]) -> Point:
    """Steady point where a co-simulation ended: the speed asked for and the temperatures reached."""
    last = run[-1]
    return Point(float(last["speed_setpoint"]), {name: float(last[name]) for name in TEMPERATURES})
