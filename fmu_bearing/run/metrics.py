"""Figures that compare runs: vibration, loads, friction, sound; and the speed of a run."""

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import P, Z
from fmu_bearing.run.arrays import Arrays
from fmu_bearing.scene import Scene

SAMPLE = 1e-4  # s between the points at which velocities, loads and torque are read
COMMUNICATION = 1e-3  # s, of what is timed or only passed through
#: A perfect bearing's rings move by no more (m/s): below it, relative errors of velocity mean nothing.
SILENT = 2e-7
#: dB(A); differences between inaudible sounds are not counted.
INAUDIBLE = 0.0

_LOAD = tuple(Z.BEARING_OUTPUTS.index(f"contact.{side}.load_mean") for side in ("inner", "outer"))
_ANGLE = tuple(Z.BEARING_OUTPUTS.index(f"contact.{side}.angle_mean") for side in ("inner", "outer"))
_TORQUE = Z.BEARING_OUTPUTS.index("friction_torque")
_CAGE = Z.BEARING_OUTPUTS.index("cage.speed_ratio")
_LEVEL = Z.MIC_OUTPUTS.index("leq_a")


@dataclass(frozen=True)
class Figures:
    """Figures of a bearing over a window of time; pairs are inner, outer.

    Attributes
    ----------
    ring_rms : tuple of float
        Rms velocity of each ring about its mean, the three axes together (m/s).
    load, angle : tuple of float
        Mean load (N) and contact angle (rad) of a ball at each race.
    torque : float
        Mean friction torque (N m).
    cage_ratio : float
        Mean speed of the cage over the shaft's.
    levels : tuple of float
        A-weighted equivalent level at each microphone (dB); empty without sound.
    """

    ring_rms: tuple[float, float]
    load: tuple[float, float]
    angle: tuple[float, float]
    torque: float
    cage_ratio: float
    levels: tuple[float, ...] = ()


@dataclass(frozen=True)
class Errors:
    """Differences between figures; those of the worse ring, race and microphone count.

    Attributes
    ----------
    ring_rms, load, torque : float
        Relative.
    ring_level, level : float
        Of rms ring velocity and of sound (dB, dB(A)); ``level`` is NaN without sound.
    """

    ring_rms: float
    ring_level: float
    load: float
    torque: float
    level: float


def ring_rms(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rms velocity about the mean of inner and outer ring, the three axes together."""
    squares = ((rows - rows.mean(0)) ** 2).mean(0)
    return np.sqrt([squares[:3].sum(), squares[3:].sum()])


def errors(found: Figures, truth: Figures) -> Errors:
    """Differences of ``found`` from ``truth``.

    Ring velocities count from ``SILENT`` on, sound levels from ``INAUDIBLE`` on.
    """
    rms = [
        max(value, SILENT) / max(true, SILENT)
        for value, true in zip(found.ring_rms, truth.ring_rms, strict=True)
    ]
    sound = [
        abs(max(value, INAUDIBLE) - max(true, INAUDIBLE))
        for value, true in zip(found.levels, truth.levels, strict=True)
    ]
    # NumPy's maximum passes on what is not a number, Python's may not
    return Errors(
        ring_rms=float(np.max([abs(ratio - 1.0) for ratio in rms])),
        ring_level=float(np.max([abs(20.0 * math.log10(ratio)) for ratio in rms])),
        load=float(np.max([relative(*pair) for pair in zip(found.load, truth.load, strict=True)])),
        torque=relative(found.torque, truth.torque),
        level=float(np.max(np.nan_to_num(sound, nan=math.inf))) if sound else math.nan,
    )


def relative(value: float, true: float) -> float:
    """Relative difference; none between two zeros."""
    if value == true:
        return 0.0
    return abs(value / true - 1.0) if true else math.inf


@dataclass(frozen=True)
class Measured:
    """What was measured on one run from a scene's quasi-static state.

    Attributes
    ----------
    figures : Figures
    rings : ndarray
        Ring velocities (m/s), six columns, every ``SAMPLE`` of the window.
    wall, cpu : float
        Simulated s per wall s and per CPU s, settled, without sound; NaN where not timed.
    """

    figures: Figures
    rings: NDArray[np.float64]
    wall: float = math.nan
    cpu: float = math.nan


def measure(
    scene: Scene, sound: NDArray[np.float64], warm_up: float, window: float, *, budget: float = 0.0,
    **parameters: float,
) -> Measured:  # fmt: skip
    """Run a scene from its quasi-static state for ``warm_up`` (s), then read its figures over ``window`` (s).

    Parameters
    ----------
    scene : Scene
        Its fidelity is not ``auto``.
    sound : ndarray
        Its sound block; empty: no sound levels. Sound is computed in a second run of the same motion.
    budget : float
        Wall time (s) of each of two timed runs; 0: none.
    parameters : float
        Values for places of ``p``, as in :class:`Arrays`.

    Raises
    ------
    Refused
        If the engine refuses.
    """
    bearing = Arrays.of(scene, None, **parameters)
    bearing.init()
    bearing.run(warm_up, COMMUNICATION)
    wall, cpu = speed(bearing, budget, 2, 1.0) if budget else (math.nan, math.nan)
    z = np.empty((round(window / SAMPLE), len(Z.BEARING_OUTPUTS)))
    for row in z:
        bearing.step(SAMPLE)
        row[:] = bearing.z[: row.size]
    mean = z.mean(0)
    rms = ring_rms(z[:, :6])
    figures = Figures(
        (float(rms[0]), float(rms[1])),
        (float(mean[_LOAD[0]]), float(mean[_LOAD[1]])),
        (float(mean[_ANGLE[0]]), float(mean[_ANGLE[1]])),
        float(mean[_TORQUE]),
        float(mean[_CAGE]),
        _levels(scene, sound, warm_up, window, parameters) if sound.size else (),
    )
    return Measured(figures, z[:, :6], wall, cpu)


def _levels(
    scene: Scene, sound: NDArray[np.float64], warm_up: float, window: float, parameters: dict[str, float]
) -> tuple[float, ...]:
    """A-weighted equivalent levels (dB) over the window, as the engine's own meters show them."""
    bearing = Arrays.of(scene, sound, **parameters, METERING_START=warm_up)
    bearing.init()
    bearing.run(warm_up + window, COMMUNICATION)
    sizes = int(bearing.p[P.BALLS]), int(bearing.p[P.MICS])
    levels = bearing.z[Z.mics(sizes[0]) + _LEVEL : Z.bands(*sizes) : len(Z.MIC_OUTPUTS)]
    return tuple(float(level) for level in levels)


def speed(
    bearing: Arrays, budget: float, repeats: int, longest: float, communication: float = COMMUNICATION
) -> tuple[float, float]:
    """Return simulated s per wall s and per CPU s, best of ``repeats`` runs from the bearing's state.

    A run lasts about ``budget`` s of wall time and at most ``longest`` s of simulated time, in communication
    steps of ``communication`` (s).
    """
    state = bearing.s.copy()
    clock = time.perf_counter()
    bearing.run(2 * communication, communication)
    pilot = (time.perf_counter() - clock) / 2
    steps = max(1, min(round(longest / communication), round(budget / pilot)))
    wall = cpu = float("inf")
    for _ in range(repeats):
        bearing.s[:] = state
        clock, used = time.perf_counter(), time.process_time()
        bearing.run(steps * communication, communication)
        wall = min(wall, time.perf_counter() - clock)
        cpu = min(cpu, time.process_time() - used)
    bearing.s[:] = state
    simulated = steps * communication
    return simulated / wall, simulated / cpu
