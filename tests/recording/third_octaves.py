"""Fast third octaves of a recording, as a meter would read them at its last sample."""

import numpy as np
import scipy

from fmu_bearing.acoustics.filters.weighting import FAST, band_sections, level
from fmu_bearing.engine.layout import Z


def fast_levels(recording):
    """Levels (dB), shape (microphones, bands), with time weighting Fast from the first sample on.

    The filters begin with the run where the recording has it, and weights add up to one.
    """
    size = recording.size
    if recording.history.size:
        before = recording.first
        earlier = type(recording)(
            recording.scene, recording.radiation_model, recording.rate, 0.0, before + size,
            recording.output_time, recording.speed_points, {}, recording.history,
            microphones=recording.microphones, harmonics=recording.harmonics,
        )  # fmt: skip
        pressure = earlier.pressure()
    else:
        pressure = recording.recorded
    weights = np.exp(-np.arange(size)[::-1] / (recording.rate * FAST))
    found = [
        np.average(
            scipy.signal.sosfilt(band_sections(recording.rate, band), pressure)[:, -size:] ** 2,
            axis=1, weights=weights,
        )
        for band in Z.BANDS
    ]  # fmt: skip
    return level(np.array(found).T)
