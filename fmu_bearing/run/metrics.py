"""Figures that compare runs: vibration, loads, friction, sound."""

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import U
from fmu_bearing.run.figures import (
    A_LEVEL,
    RINGS,
    Figure,
    figures_of,
    of_each,
    rows_over,
    signals_of,
    values_of,
)
from fmu_bearing.run.march import at_speeds
from fmu_bearing.run.paces import COMMUNICATION, Paces, paces
from fmu_bearing.scene import Scene

SAMPLE = 1e-4  # s between the points at which velocities, loads and torque are read
#: A perfect bearing's rings move by no more (m/s): below it, relative errors of velocity mean nothing.
SILENT = 2e-7
#: While its speed changes they move by 2.2e-7 m/s (pair of 7003C, from rest in 1 s): five times `SILENT`.
SILENT_RAMP = 1e-6
#: dB(A); differences between inaudible sounds are not counted.
INAUDIBLE = 0.0

#: Figures of a run by name (`run.figures`), SI units.
Figures = dict[str, float]
_MOTION = "_ring.velocity"
#: What is compared: of each bearing rings, loads, angles and the cage, the torque of all, microphones.
_COMPARED = (
    *(f"{ring}.velocity" for ring in RINGS),
    *(f"contact.{side}.{what}" for what in ("load_mean", "angle_mean") for side in ("inner", "outer")),
    "cage.speed_ratio", "friction_torque",
)  # fmt: skip
_HEARD = (f"mic[*].{A_LEVEL}",)


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


def of_kind(figures: Mapping[str, float], end: str) -> list[float]:
    """Return the figures whose names end so, in the order of inner and outer, then of the bearings."""
    return [value for name, value in figures.items() if name.endswith(end)]


def errors(figures: Figures, truth: Figures, silent: float = SILENT) -> Errors:
    """Differences of ``figures`` from ``truth``.

    Ring velocities count from ``silent`` (m/s) on, sound levels from ``INAUDIBLE`` on.
    """

    def pairs(end: str) -> Iterable[tuple[float, float]]:
        return zip(of_kind(figures, end), of_kind(truth, end), strict=True)

    rms = [max(value, silent) / max(true, silent) for value, true in pairs(_MOTION)]
    sound = [abs(max(value, INAUDIBLE) - max(true, INAUDIBLE)) for value, true in pairs(f".{A_LEVEL}")]
    # NumPy's maximum passes on what is not a number, Python's may not
    return Errors(
        ring_rms=float(np.max([abs(ratio - 1.0) for ratio in rms])),
        ring_level=float(np.max([abs(20.0 * math.log10(ratio)) for ratio in rms])),
        load=float(np.max([relative(*pair) for pair in pairs(".load_mean")])),
        torque=relative(figures["friction_torque"], truth["friction_torque"]),
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
    figures : dict of str to float
    rings : ndarray
        Ring velocities (m/s) every ``SAMPLE`` of the window, three columns for each ring: all inner rings,
        then all outer ones.
    paces : Paces
        How fast it ran.
    """

    figures: Figures
    rings: NDArray[np.float64]
    paces: Paces = field(default_factory=Paces)


def measure(
    scene: Scene, sound: NDArray[np.float64] | Sequence[NDArray[np.float64]], warm_up: float, window: float,
    *, budget: float = 0.0, **parameters: float,
) -> Measured:  # fmt: skip
    """Run a scene from its quasi-static state for ``warm_up`` (s), then read its figures over ``window`` (s).

    Parameters
    ----------
    scene : Scene
        Its fidelity is not ``auto``.
    sound : ndarray or sequence of ndarray
        Its sound block, of a set one per bearing; empty: no sound levels. Sound is computed in a second run
        of the same motion.
    budget : float
        Wall time (s) of each of two timed runs for each of the `paces`; 0: none.
    parameters : float
        Values for places of ``p``, as in :class:`Arrays`.

    Raises
    ------
    EngineError
        If the engine refuses.
    """
    blocks = [one for one in ([sound] if isinstance(sound, np.ndarray) else sound) if one.size]
    bearing = Arrays.of(scene, **parameters).init()
    bearing.run(warm_up, COMMUNICATION)
    found = paces(bearing, budget) if budget else Paces()
    wanted = _figures(scene, _COMPARED)
    rows = rows_over(bearing, wanted, itertools.repeat(SAMPLE, round(window / SAMPLE)))
    values = values_of(wanted, rows, SAMPLE, bearing.u[U.SPEED])
    if blocks:
        loud = Arrays.of(scene, *blocks, **parameters | {"METERING_START": warm_up}).init()
        loud_figures, steps = _figures(scene, _HEARD), round((warm_up + window) / COMMUNICATION)
        late = rows_over(loud, loud_figures, itertools.repeat(COMMUNICATION, steps))
        values |= values_of(loud_figures, late, COMMUNICATION, loud.u[U.SPEED])
    rings = [signals_of(one, wanted, rows)[1:] for one in wanted if one.name.endswith(_MOTION)]
    return Measured(values, np.hstack(rings), found)


def measure_between(
    scene: Scene, sound: Sequence[NDArray[np.float64]], warm_up: float, window: float, first: float,
    last: float,
) -> Figures:  # fmt: skip
    """Run a scene at another speed, or while its speed changes, and read its figures over ``window`` (s).

    From the quasi-static state at the speed ``first`` (rad/s) for ``warm_up`` (s); over the window the speed
    changes evenly to ``last``. Other inputs and the waves of the races are the scene's. Arguments else, and
    refusals, as for `measure`, whose second run this saves.
    """
    blocks = [one for one in sound if one.size]
    bearing = Arrays.of(scene, *blocks, METERING_START=warm_up).at({U.SPEED: first}).init()
    bearing.run(warm_up, COMMUNICATION)
    wanted = _figures(scene, (*_COMPARED, *(_HEARD if blocks else ())))
    count = round(window / SAMPLE)
    speeds = (first + (last - first) * (k + 1) / count for k in range(count))
    rows = rows_over(bearing, wanted, at_speeds(bearing, speeds, SAMPLE))
    return values_of(wanted, rows, SAMPLE, last)


def _figures(scene: Scene, names: Sequence[str]) -> tuple[Figure, ...]:
    return figures_of(scene, of_each(scene, names), strict=False)
