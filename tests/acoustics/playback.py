"""Shared by the acoustics tests: two bearings in plain numbers, and a player of motion samples."""

import numpy as np
from scipy.signal import butter, freqz, lfilter

from fmu_bearing.acoustics.filters.design import block_of
from fmu_bearing.acoustics.filters.pack import MICROPHONE_LOW_LIMIT
from fmu_bearing.acoustics.radiation.radiators import Housing, Radiators, Ring
from fmu_bearing.acoustics.registry import Radiation
from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import MO, SD, STRIDE, Z

RHO, C = 1.225, 340.0
SMALL = Radiators(
    12, 4.5e-3, 26e-3, Ring(22e-3, 17e-3, 10e-3), Ring(35e-3, 30e-3, 10e-3), Ring(27.6e-3, 23.4e-3, 9.1e-3)
)
LARGE = Radiators(
    17, 8.731e-3, 60e-3, Ring(54e-3, 45e-3, 16e-3), Ring(75e-3, 66e-3, 16e-3), Ring(63.5e-3, 55.5e-3, 14e-3)
)
HOUSED = Radiators(
    SMALL.ball_count,
    SMALL.ball_diameter,
    SMALL.pitch_diameter,
    SMALL.inner_ring,
    SMALL.outer_ring,
    SMALL.cage,
    Housing(0.1, 0.16, 0.0595),
)
PAPER_POINTS = [(0.0, 0.105, 0.0), (0.0, 0.150, 0.0), (0.0, 0.0, 0.105), (-0.0805, 0.0, 0.0)]
PLACE = {name: i for i, name in enumerate(Z.MIC_OUTPUTS)}


def build(
    model, radiators, air, microphones, harmonics=4, *, modes=(), plane=None, table=None, details=True,
    thirds=False, lengths=None,
):  # fmt: skip
    """Sound block from plain numbers, microphones at places (x, y, z) in m."""
    radiation = Radiation(model, radiators, air, harmonics, tuple(modes), plane, table)
    return block_of(radiation, microphones, details=details, thirds=thirds, lengths=lengths)


class Player:
    """Feeds motion samples, repeated as often as needed, and keeps what the microphones read."""

    def __init__(self, ps, time_weighting=0.125, metering_start=0.0):
        self.ps, self.settings = ps, (time_weighting, metering_start)
        self.ss, self.ws = np.zeros(SD.state_size(ps)), np.zeros(SD.work_size(ps))
        self.mics = int(ps[SD.H_MICS])
        self.z = np.zeros(self.mics * (len(Z.MIC_OUTPUTS) + int(ps[SD.H_BANDS])))
        self.first = 0

    def play(self, motion, samples):
        """Return pressures, shape (samples / 4, mics)."""
        pressures = np.zeros((-(-samples // SD.DECIMATION), self.mics))
        call(
            "play", self.ps, self.ss, self.ws, motion, self.z, pressures, samples, motion.shape[1],
            *self.settings, self.mics, len(Z.MIC_OUTPUTS), self.first,
        )  # fmt: skip
        self.first += samples
        return pressures

    def reading(self, name, mic=0):
        return self.z[mic * len(Z.MIC_OUTPUTS) + PLACE[name]]


def still(radiators, samples):
    """Motion samples at rest, shape (samples, motion size); balls evenly round the pitch circle."""
    motion = np.zeros((samples, MO.SIZE))
    for j in range(radiators.ball_count):
        angle = 2 * np.pi * j / radiators.ball_count
        motion[:, MO.COS + j] = np.cos(angle)
        motion[:, MO.SIN + j] = np.sin(angle)
    return motion


def ball(j, row, axis=0):
    """Column of ball ``j`` in the rows x, r, theta of a quantity, by its place in a motion sample."""
    return row + STRIDE * axis + j


def raw_time(samples):
    return np.arange(samples) / SD.RAW_RATE


def chain(frequency):
    """What every pressure passes besides its transfer function: microphone's low limit and latency."""
    limit = freqz(*butter(2, MICROPHONE_LOW_LIMIT, "highpass", fs=SD.RATE), frequency, fs=SD.RATE)[1]
    return limit * np.exp(-2j * np.pi * np.asarray(frequency) * SD.LATENCY / SD.RATE)


def low_limit(x):
    """What the microphones' high-pass leaves of a signal at ``RATE``.

    While memory grows, sample by sample: the mean of all samples with weights 1, 2, 3 ..., moved by a slope
    whose gain rises with the square of time. From 45 ms on SciPy's Butterworth filter.
    """
    b, a = butter(2, MICROPHONE_LOW_LIMIT, "highpass", fs=SD.RATE)
    limit = 2.0 / (1.0 - a[2])
    grown = int(np.ceil(limit)) - 2
    mean, slope, y = x[0], 0.0, np.zeros(len(x))
    for n in range(1, min(grown, len(x))):
        y[n] = b[0] * (x[n] - mean - slope)
        mean = (n * (mean + slope) + 2.0 * x[n]) / (n + 2.0)
        slope += a.sum() * ((n + 2.0) / limit) ** 2 * y[n] / b[0]
    if len(x) > grown:
        y[grown:], _ = lfilter(b, a, x[grown:], zi=[-b[0] * (mean + slope), b[0] * mean])
    return y


def lines(pressure, frequencies):
    """Complex amplitudes of the last 0.01 s of a signal, which holds whole periods of 100 Hz multiples."""
    tail = pressure[-512:]
    n = np.arange(len(pressure) - 512, len(pressure))
    turn = np.exp(-2j * np.pi * np.asarray(frequencies)[:, None] * n / SD.RATE)
    return 2.0 / 512 * turn @ tail
