"""Third octaves of every microphone's pressure: four second-order sections per band, bands side by side."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD

SECTIONS = 4
# Per microphone: two states of each section, then the running mean square; all BAND_LANES wide.
MEAN = 2 * SECTIONS * SD.BAND_LANES
SIZE = MEAN + SD.BAND_LANES
_L = SD.BAND_LANES


@kernel
def update(ps, ss, ws, pressures, fraction):
    """Move all bands by one sample of the pressures at ``ws[pressures]``; means by ``fraction``."""
    scratch = int(ps[SD.H_W_TRANSFORM])
    x = ws[scratch : scratch + _L]
    for mic in range(int(ps[SD.H_MICS])):
        at = int(ps[SD.H_S_BANDS]) + SIZE * mic
        pressure = ws[pressures + mic]
        for i in range(_L):
            x[i] = pressure
        for section in range(SECTIONS):
            q = int(ps[SD.H_AT_BANDS]) + 5 * _L * section
            _section(ps[q : q + 5 * _L], ss[at + 2 * _L * section : at + 2 * _L * (section + 1)], x)
        mean = ss[at + MEAN : at + SIZE]
        for i in range(_L):
            mean[i] += fraction * (x[i] * x[i] - mean[i])


@kernel
def _section(k, s, x):
    """One section of every band, in place; rows of ``k`` are b0, b1, b2, a1, a2.

    One slice each for numbers and states, with constant rows: only so is the loop a vector loop.
    """
    for i in range(_L):
        y = k[i] * x[i] + s[i]
        s[i] = k[_L + i] * x[i] - k[3 * _L + i] * y + s[_L + i]
        s[_L + i] = k[2 * _L + i] * x[i] - k[4 * _L + i] * y
        x[i] = y
