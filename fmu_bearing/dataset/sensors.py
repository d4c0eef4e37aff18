"""What the sensors of a run read, at the rate of a data set."""

import functools
from collections.abc import Sequence
from math import gcd

import numpy as np
import scipy
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.field import form_of
from fmu_bearing.dataset.plan import RATE
from fmu_bearing.interface.names import known
from fmu_bearing.recording.recording import Recording
from fmu_bearing.scene import Scene

_RINGS = ("inner_ring", "outer_ring")
_STOP = 90.0  # dB by which what would fold is weakened
_WIDTH = 0.1  # of the rate: the filter falls from 0.4 to 0.5 of it
PRESSURE, ACCELERATION = "Pa", "m/s2"


def sensors_of(scene: Scene, asked: Sequence[str] = ()) -> dict[str, str]:
    """Return the unit of each sensor that is kept, by name.

    Default: all accelerometers, of a scene without them all microphones.

    Raises
    ------
    UnknownName
        For a name that the scene does not have, with the nearest.
    ValueError
        Where nothing is there to be read.
    """
    mounted = {one.name: ACCELERATION for one in scene.accelerometers}
    heard = {name: PRESSURE for name, _ in scene.microphones}
    heads = [bearing.prefix + ring for bearing in scene.bearings() for ring in _RINGS]
    rings = {f"{head}.acceleration.{axis}": ACCELERATION for head in heads for axis in "xyz"}
    there = rings | heard | mounted
    for name in asked:
        known(name, list(there), "sensor of the scene")
    chosen = {name: there[name] for name in asked} or mounted or heard
    if not chosen:
        raise ValueError(
            f"{scene.name}: has no accelerometer and no microphone: add [[accelerometer]], or name sensors "
            "in the plan, such as outer_ring.acceleration.z"
        )
    return chosen


def signals(recording: Recording, units: dict[str, str]) -> NDArray[np.float64]:
    """Return what sensors read at the engine's rate (Pa, m/s2), shape (sensors, samples)."""
    heard = [name for name, unit in units.items() if unit == PRESSURE]
    pressures = dict(zip(heard, recording.pressure(heard), strict=True)) if heard else {}
    mounted = recording.accelerometers
    read = recording.acceleration, lambda name: recording.signal(name).values
    return np.array([
        pressures[name] if name in pressures else read[name not in mounted](name) for name in units
    ])  # fmt: skip


def radiation_model_of(scene: Scene, units: dict[str, str]) -> str | None:
    """Return the radiation model to record with, whose channels hold what is read; None: the scene's."""
    rings = any(".acceleration." in name for name in units)
    own = None if scene.sound is None else scene.sound.radiation_model
    if own is not None and form_of(own) != "vectors" and rings:
        if PRESSURE in units.values():
            raise ValueError(
                f"{scene.name}: channels of radiation_model = {own} hold no accelerations of the rings: read "
                "them apart from the microphones, or set sound.radiation_model to another"
            )
        return "compact"
    return own


def margin(rate: int) -> int:
    """Return how many samples of the engine `resampled` needs before and behind what it returns."""
    if rate == RATE:
        return 0
    up, down, taps = _filter(rate)
    return down * -(-len(taps) // (2 * up * down))  # of these each has its own place among the samples kept


def resampled(signal: NDArray[np.float64], rate: int, size: int) -> NDArray[np.float32]:
    """Return the middle of signals at another rate (Hz), shape (sensors, size).

    Linear phase, no delay; flat to 0.4 of the rate, what lies above half of it is 90 dB down.

    Parameters
    ----------
    signal : ndarray, shape (sensors, samples)
        At the engine's rate, `margin` longer at either end.
    """
    if rate == RATE:
        return signal[:, :size].astype(np.float32)
    up, down, taps = _filter(rate)
    found = scipy.signal.resample_poly(signal, up, down, axis=1, window=taps)
    first = margin(rate) // down * up
    return found[:, first : first + size].astype(np.float32)


@functools.cache
def _filter(rate: int) -> tuple[int, int, NDArray[np.float64]]:
    """Return both factors from the engine's rate to another, and a low-pass by Kaiser's window."""
    common = gcd(rate, RATE)
    up, down = rate // common, RATE // common
    both = RATE * up
    count, beta = scipy.signal.kaiserord(_STOP, 2.0 * _WIDTH * rate / both)
    taps = scipy.signal.firwin(count | 1, (0.5 - 0.5 * _WIDTH) * rate, window=("kaiser", beta), fs=both)
    return up, down, taps
