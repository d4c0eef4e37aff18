"""Figures that compare runs: vibration, loads, friction, sound."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import SP, P, U, Z
from fmu_bearing.run.paces import COMMUNICATION, Paces, paces
from fmu_bearing.scene import Scene

SAMPLE = 1e-4  # s between the points at which velocities, loads and torque are read
#: A perfect bearing's rings move by no more (m/s): below it, relative errors of velocity mean nothing.
SILENT = 2e-7
#: While its speed changes they move by 2.2e-7 m/s (pair of 7003C, from rest in 1 s): five times `SILENT`.
SILENT_RAMP = 1e-6
#: dB(A); differences between inaudible sounds are not counted.
INAUDIBLE = 0.0

_LOAD = tuple(Z.BEARING_OUTPUTS.index(f"contact.{side}.load_mean") for side in ("inner", "outer"))
_ANGLE = tuple(Z.BEARING_OUTPUTS.index(f"contact.{side}.angle_mean") for side in ("inner", "outer"))
_TORQUE = Z.BEARING_OUTPUTS.index("friction_torque")
_CAGE = Z.BEARING_OUTPUTS.index("cage.speed_ratio")
_LEVEL = Z.MIC_OUTPUTS.index("leq_a")


@dataclass(frozen=True)
class Figures:
    """Figures of a bearing over a window of time; pairs are inner, outer, of a set one after the other.

    Attributes
    ----------
    ring_rms : tuple of float
        Rms velocity of each ring about its mean, the three axes together (m/s).
    load, angle : tuple of float
        Mean load (N) and contact angle (rad) of a ball at each race.
    torque : float
        Mean friction torque (N m).
    cage_ratio : float
        Mean speed of the cage over the shaft's; of a set, of its first bearing.
    levels : tuple of float
        A-weighted equivalent level at each microphone (dB); empty without sound.
    """

    ring_rms: tuple[float, ...]
    load: tuple[float, ...]
    angle: tuple[float, ...]
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


def errors(found: Figures, truth: Figures, silent: float = SILENT) -> Errors:
    """Differences of ``found`` from ``truth``.

    Ring velocities count from ``silent`` (m/s) on, sound levels from ``INAUDIBLE`` on.
    """
    rms = [
        max(value, silent) / max(true, silent)
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
        Ring velocities (m/s), six columns per bearing, every ``SAMPLE`` of the window.
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
    blocks = [sound] if isinstance(sound, np.ndarray) else list(sound)
    bearing = Arrays.of(scene, **parameters)
    bearing.init()
    bearing.run(warm_up, COMMUNICATION)
    found = paces(bearing, budget) if budget else Paces()
    z = _read(bearing, window)
    levels = _levels(scene, blocks, warm_up, window, parameters) if blocks and blocks[0].size else ()
    return Measured(_figures(z, levels), np.hstack([rows[:, :6] for rows in z]), found)


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
    bearing = Arrays.of(scene, *blocks, METERING_START=warm_up)
    bearing.u[U.SPEED] = first
    bearing.init()
    bearing.run(warm_up, COMMUNICATION)
    z = _read(bearing, window, first, last)
    return _figures(z, _meters(bearing) if blocks else ())


def _read(
    bearing: Arrays, window: float, first: float | None = None, last: float = 0.0
) -> NDArray[np.float64]:
    """Return the outputs of each bearing every ``SAMPLE``; from ``first`` to ``last`` (rad/s) if given."""
    places = bearing.outputs_of_bearings
    z = np.empty((len(places), round(window / SAMPLE), len(Z.BEARING_OUTPUTS)))
    for k in range(z.shape[1]):
        if first is not None:
            bearing.u[U.SPEED] = first + (last - first) * (k + 1) / z.shape[1]
        bearing.step(SAMPLE)
        for rows, place in zip(z, places, strict=True):
            rows[k] = bearing.z[place : place + rows.shape[1]]
    return z


def _figures(z: NDArray[np.float64], levels: tuple[float, ...]) -> Figures:
    """Return the figures of outputs over time, shape (bearings, times, outputs)."""
    mean = z.mean(1)
    return Figures(
        tuple(float(one) for rows in z for one in ring_rms(rows[:, :6])),
        tuple(float(row[place]) for row in mean for place in _LOAD),
        tuple(float(row[place]) for row in mean for place in _ANGLE),
        float(mean[:, _TORQUE].sum()),
        float(mean[0, _CAGE]),
        levels,
    )


def _levels(
    scene: Scene, blocks: list[NDArray[np.float64]], warm_up: float, window: float,
    parameters: dict[str, float],
) -> tuple[float, ...]:  # fmt: skip
    """A-weighted equivalent levels (dB) over the window, as the engine's own meters show them."""
    bearing = Arrays.of(scene, *blocks, **parameters | {"METERING_START": warm_up})
    bearing.init()
    bearing.run(warm_up + window, COMMUNICATION)
    return _meters(bearing)


def _meters(bearing: Arrays) -> tuple[float, ...]:
    """A-weighted equivalent levels (dB) that the meters show."""
    p = bearing.p
    first = Z.mics(int(p[P.BALLS]))
    if SP.has_shaft(p):
        block = int(p[P.SET])
        first = int(p[block + SP.AT_Z]) + SP.z_mics(int(p[block + SP.BEARINGS]))
    per_mic = len(Z.MIC_OUTPUTS)
    levels = bearing.z[first + _LEVEL : first + int(p[P.MICS]) * per_mic : per_mic]
    return tuple(float(level) for level in levels)
