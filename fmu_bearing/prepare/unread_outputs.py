"""What need not be computed, because no variable shows it: balls, contacts, sound and its details, sensors.

An FMU has no way to such numbers, so none is read that is not computed.
"""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import SD, SP, P, Z
from fmu_bearing.interface import Variable
from fmu_bearing.prepare.lengths import parts_of

_OF_BALLS = (
    *range(Z.CONTACT, Z.CONTACT + 2 * Z.CONTACT_SIZE), Z.LAMBDA, Z.AXIAL_STIFFNESS, Z.RADIAL_STIFFNESS,
    Z.SHOULDER, Z.SHOULDER + 1,
)  # fmt: skip


def without_unread(p: NDArray[np.float64], shown: Iterable[Variable]) -> NDArray[np.float64]:
    """Return the parameters ``p``, read-only, with the switches of what ``shown`` variables need.

    What is left on has the same bits.
    """
    parameters = p.copy()
    read = {variable.index for variable in shown if variable.array == "z"}
    bands, mics = int(p[P.BANDS]), int(p[P.MICS])
    together, parts = SP.has_shaft(p), parts_of(p)
    sizes = [_size(p[part]) for part, _ in parts]
    own = sum(sizes)
    first = own + SP.z_mics(len(parts)) if together else Z.mics(int(p[P.BALLS]))
    octaves = first + Z.PER_MIC * mics
    alone = octaves + bands * mics
    behind = alone + (len(parts) * mics if together else 0)
    microphone_places = range(first, behind)
    sensors = behind + (0 if together else 2 * int(p[P.MODES]) + Z.PER_DEFECT * int(p[P.DEFECTS]))
    sensor_places = range(sensors, sensors + Z.PER_ACCELEROMETER * int(p[P.ACCELEROMETERS]))
    for b, (part, _) in enumerate(parts):
        of, at = parameters[part], sum(sizes[:b]) if together else 0
        balls = {at + one for one in (*_OF_BALLS, *range(Z.BALLS, Z.mics(int(of[P.BALLS]))))}
        if together:
            forces = own + SP.Z_FORCES + b * SP.Z_FORCE
            balls |= set(range(forces, forces + SP.Z_FORCE))
        of[P.READ_BALLS] = not read.isdisjoint(balls)
        of[P.READ_SOUND] = not read.isdisjoint(microphone_places)
        if p[P.ACCELEROMETERS] != 0.0:
            of[P.READ_SENSORS] = not read.isdisjoint(sensor_places)
        block = int(of[P.AT_SOUND])
        if block == 0:
            continue
        details = {first + k * Z.PER_MIC + row for k in range(mics) for row in range(SD.PLAIN, SD.METERS)}
        if read.isdisjoint(details):
            of[block + SD.H_DETAILS] = 0.0
        if read.isdisjoint(range(octaves, alone)):
            of[block + SD.H_BANDS] = 0.0
    parameters.setflags(write=False)
    return parameters


def _size(p: NDArray[np.float64]) -> int:
    """Return how many outputs one of several bearings has, without sound."""
    return Z.size(int(p[P.BALLS]), 0, 0, int(p[P.MODES]), int(p[P.DEFECTS]))
