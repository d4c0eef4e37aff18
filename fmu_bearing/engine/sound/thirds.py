"""Third octaves of every microphone's pressure: four second-order sections per band, bands side by side."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD

_L = SD.BAND_LANES
_NUMBERS = SD.SECTION * _L  # of one section, all bands side by side
_STATES = SD.SECTION_STATES * _L


@kernel
def update(ps, ss, ws, pressures, fraction):
    """Move all bands by one sample of the pressures at ``ws[pressures]``; means by ``fraction``."""
    scratch = int(ps[SD.H_W_SCRATCH])
    x = ws[scratch : scratch + _L]
    for mic in range(int(ps[SD.H_MICS])):
        at = int(ps[SD.H_S_BANDS]) + SD.BAND_SIZE * mic
        pressure = ws[pressures + mic]
        for i in range(_L):
            x[i] = pressure
        for section in range(SD.BAND_SECTIONS):
            q = int(ps[SD.H_AT_BANDS]) + _NUMBERS * section
            state = at + SD.BAND_STATE + _STATES * section
            _section(ps[q : q + _NUMBERS], ss[state : state + _STATES], x)
        mean = ss[at + SD.BAND_MEAN : at + SD.BAND_SIZE]
        for i in range(_L):
            mean[i] += fraction * (x[i] * x[i] - mean[i])


@kernel
def _section(k, s, x):
    """One section of every band, in place; rows of ``k`` as in `SD.SECTION`.

    One slice each for numbers and states, with constant rows: only so is the loop a vector loop.
    """
    for i in range(_L):
        y = k[SD.B0 * _L + i] * x[i] + s[i]
        s[i] = k[SD.B1 * _L + i] * x[i] - k[SD.A1 * _L + i] * y + s[_L + i]
        s[_L + i] = k[SD.B2 * _L + i] * x[i] - k[SD.A2 * _L + i] * y
        x[i] = y
