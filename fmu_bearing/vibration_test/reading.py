"""What the sensor of a vibration test reads: spectrum of the outer ring's radial velocity at three places."""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import power_spectral_density
from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import Instance
from fmu_bearing.run.march import begin, march
from fmu_bearing.run.simulate import model_of
from fmu_bearing.scene import Scene
from fmu_bearing.vibration_test.rig import STEP, bands

_SETTLE, _LENGTH = 0.1, 0.5  # s: left out at the start, read; 0.25 to 2 s: L within 3 %, M 6 %, H 1 %
_PLACES = np.radians([0.0, 120.0, 240.0])  # from 12 o'clock about +X
_MICRO = 1e6


@dataclass(frozen=True, eq=False)
class Reading:
    """Spectrum of the radial velocity of the outer ring.

    Attributes
    ----------
    frequency : ndarray, shape (bins,)
        In Hz, from 0 on, evenly spaced.
    energy : ndarray, shape (bins,)
        Mean square velocity of each bin, (um/s)^2, mean over three places round the ring: sums over a band
        are squares of its rms velocity.
    seconds : float
        CPU time of the run (s).
    orbit : float
        Speed at which the balls orbit, over the shaft's.
    """

    frequency: NDArray[np.float64]
    energy: NDArray[np.float64]
    seconds: float
    orbit: float = float("nan")

    def rms(self, low: float, high: float) -> float:
        """Return the rms velocity (um/s) between two frequencies (Hz)."""
        return float(np.sqrt(self.energy @ share(self.frequency, low, high)))


def share(frequency: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    """Return how much of each bin lies between two frequencies (Hz): a bin on an edge lies in both bands."""
    width = frequency[1] - frequency[0]
    ends = np.minimum(frequency + 0.5 * width, high) - np.maximum(frequency - 0.5 * width, low)
    shares: NDArray[np.float64] = np.clip(ends / width, 0.0, 1.0)
    return shares


def reading(scene: Scene) -> Reading:
    """Run the scene of a vibration test and return what its sensor reads.

    At the angle theta from 12 o'clock about +X the ring moves outwards by v_z cos theta - v_y sin theta and
    by its bending. The sensor reads it where the middle plane of the groove meets the outside surface.

    Parameters
    ----------
    scene : Scene
        As `rig` gives it.

    Raises
    ------
    ValueError
        Where the run cannot be made, or a step is refused (`EngineError`, `SceneError`).
    """
    flexure = scene.mounted.flexure
    orders = () if flexure is None else flexure.outer_ring
    names = ["outer_ring.velocity.y", "outer_ring.velocity.z"]
    names += [f"outer_ring.flexure.n{order}.{part}" for order in orders for part in ("cosine", "sine")]
    ball = ("ball[1].velocity.y", "ball[1].velocity.z")
    begun = time.process_time()
    run = _run(scene, [*names, *ball])
    first, count = round(_SETTLE / STEP), round(_LENGTH / STEP)
    energies = []
    for place in _PLACES:
        speed = run[names[1]] * np.cos(place) - run[names[0]] * np.sin(place)
        for order in orders:
            name = f"outer_ring.flexure.n{order}."
            speed = speed + run[name + "cosine"] * np.cos(order * place)
            speed = speed + run[name + "sine"] * np.sin(order * place)
        kept = _MICRO * speed[first + 1 : first + 1 + count]
        frequency, density = power_spectral_density(kept, 1.0 / STEP)
        energies.append(density * (frequency[1] - frequency[0]))
    # the velocity of a ball turns as fast as the ball goes round
    turned = np.unwrap(np.arctan2(run[ball[1]], run[ball[0]]))[first:]
    shaft = scene.operation.speed_rpm * RPM * _LENGTH
    orbit = float((turned[-1] - turned[0]) / shaft)
    return Reading(frequency, np.mean(energies, axis=0), time.process_time() - begun, orbit)


def _run(scene: Scene, names: Sequence[str]) -> dict[str, NDArray[np.float64]]:
    """Return variables at all points of the run, the first at its start."""
    bearing = begin(Instance(model_of(scene)), {})
    take = bearing.reader(names)
    rows = [take()]
    points = STEP * np.arange(round((_SETTLE + _LENGTH) / STEP) + 1)
    march(bearing, np.diff(points).tolist(), lambda: rows.append(take()))
    return dict(zip(names, np.array(rows).T, strict=True))


def levels(scene: Scene, found: Reading) -> dict[str, float]:
    """Return the rms velocity (um/s) of each band of the test of a scene."""
    return {name: found.rms(low, high) for name, (low, high) in bands(scene).items()}
