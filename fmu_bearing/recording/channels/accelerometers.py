"""What accelerometers of a scene read, from the recorded channels of a run, and their noise."""

import zlib

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters.sensing import read
from fmu_bearing.prepare.accelerometers import sensors_of
from fmu_bearing.scene import Scene, SceneError


def read_all(scene: Scene, sensed: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Return acceleration (m/s2) by name: what accelerometers read without noise, at the channels' rows.

    ``sensed``: channels of all bearings, shape (rows, channels).

    Raises
    ------
    ValueError
        When these are not the scene's.
    """
    found: dict[str, NDArray[np.float64]] = {}
    begin = 0
    for sensors in sensors_of(scene):
        for sensor in sensors.each:
            end = begin + len(sensor.rows)
            found[sensor.name] = read(sensor, sensed[:, begin:end].T)
            begin = end
    if begin != sensed.shape[1]:
        raise SceneError(
            f"{scene.name}: its accelerometers have {begin} channels, the recording has {sensed.shape[1]}"
        )
    return found


def noise_of(scene: Scene, name: str, size: int) -> NDArray[np.float64]:
    """Return the noise (m/s2) of an accelerometer: white, by name and the seed of the imperfections."""
    (rms,) = (one.noise_m_s2 for one in scene.accelerometers if one.name == name)
    seed = 0 if scene.imperfections is None else scene.imperfections.seed
    draws: NDArray[np.float64] = np.random.default_rng([seed, zlib.crc32(name.encode())]).normal(size=size)
    return rms * draws
