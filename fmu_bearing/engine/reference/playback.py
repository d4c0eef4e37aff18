"""Motion samples played to the sound block, without a bearing."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD
from fmu_bearing.engine.sound import meter, radiate


@kernel
def play(ps, ss, ws, motion, z, pressures, samples, time_weighting, start, mics, outputs, first):
    """Push ``samples`` motion samples, the rows of ``motion`` over and over from row ``first`` on.

    ``ps``, ``ss``, ``ws`` parameters, state and work space of the sound block; ``z`` outputs, ``outputs``
    numbers per microphone; ``pressures``: a row of ``mics`` pressures (Pa) per sample of the microphones.
    """
    for i in range(samples):
        radiate.push(ps, ss, motion[(first + i) % len(motion)])
        meter.update(ps, ss, ws, radiate.filtered(ps, ss, ws), time_weighting, start)
        if len(pressures) and i % SD.DECIMATION == 0:
            meter.levels(ps, ss, z, 0)
            for m in range(mics):
                pressures[i // SD.DECIMATION, m] = z[outputs * m]
    meter.levels(ps, ss, z, 0)
