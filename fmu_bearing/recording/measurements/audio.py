"""WAV files in pascals: `write_wav`, `read_wav` and `resample` of ``acoustics.analysis.audio``.

Examples
--------
>>> import numpy as np
>>> from fmu_bearing import audio
>>> pressure = 0.5 * np.sin(2000.0 * np.pi * np.arange(4800) / 48000.0)  # Pa
>>> audio.write_wav("tone.wav", pressure, 48000.0, full_scale=2.0)  # a sample of 1.0 is 2 Pa
>>> back, rate = audio.read_wav("tone.wav")
>>> round(float(back.max()), 3), rate  # Pa, Hz
(0.5, 48000.0)
"""

from fmu_bearing.acoustics.analysis.audio import read_wav, resample, write_wav

__all__ = ["read_wav", "resample", "write_wav"]
