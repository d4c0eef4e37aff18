"""Accelerometers: what one reads of the motion of its body, and the engine's block of those of a bearing.

A sensor reads M (1 a + sum over the modes of R_k (F_s + s F_d)): a is the acceleration of its body there, F_s
and F_d are the seat's stiffness and damping times the acceleration where the seat holds it, so that the force
of the seat is (F_s + s F_d) / s2; R_k = 1 / (m (s2 + 2 z w s + w2)), so that s2 R_k times that force is the
acceleration of a mode; and M = w2 / (w2 + 2 z w s + s2) of the mounted sensor.

Poles within the band are sections of second order, which the engine runs (`engine.sound.accelerometer`):
filters of 20 ms at most could not ring as long. What is left is smooth, and `fir.fit` fits it.
"""

import cmath
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters.blocks import Wire
from fmu_bearing.acoustics.filters.fir import WEAK, delay_of, fit
from fmu_bearing.acoustics.filters.pack import pack
from fmu_bearing.acoustics.radiation.frequencies import STOP, fit_frequencies
from fmu_bearing.engine.choices import ChannelForm
from fmu_bearing.engine.layout import SD

Complex = NDArray[np.complex128]
Row = NDArray[np.float64]

#: Worst deviation of a filter that is let pass: 0.05 dB.
_TOLERANCE = 10 ** (0.05 / 20) - 1.0


def _laplace(frequency: Row) -> Complex:
    """Return s (rad/s) at ``frequency`` (Hz)."""
    return np.asarray(2j * np.pi * np.asarray(frequency), dtype=np.complex128)


@dataclass(frozen=True)
class Pole:
    """A pair of poles of second order: angular frequency (rad/s) and damping over the critical one."""

    omega: float
    zeta: float

    def denominator(self, s: Complex) -> Complex:
        """Return s2 + 2 z w s + w2."""
        return s**2 + 2.0 * self.zeta * self.omega * s + self.omega**2

    @property
    def in_band(self) -> bool:
        """Whether it rings below the end of the sensors' band."""
        return self.omega < 2.0 * np.pi * STOP

    @property
    def section(self) -> tuple[float, float]:
        """A1 and A2 of the section 1 / (1 + A1/z + A2/z2) at ``SD.RATE`` with the same poles; 0, 0: none."""
        if not self.in_band:
            return 0.0, 0.0
        one = self.omega * (-self.zeta + cmath.sqrt(self.zeta**2 - 1.0)) / SD.RATE
        other = self.omega * (-self.zeta - cmath.sqrt(self.zeta**2 - 1.0)) / SD.RATE
        first, second = cmath.exp(one), cmath.exp(other)
        return -(first + second).real, (first * second).real

    def undone(self, frequency: Row) -> Complex:
        """Return one over the section's response at ``frequency`` (Hz)."""
        a1, a2 = self.section
        z = np.exp(-2j * np.pi * frequency / SD.RATE)
        return 1.0 + a1 * z + a2 * z**2


@dataclass(frozen=True)
class Sensor:
    """One accelerometer, on plain numbers.

    Attributes
    ----------
    name : str
    number : int
        Place among the scene's, from 0.
    reads : ndarray
        Weights of the raw row (`SD.R_ACCELERATION`: accelerations of its outer ring, rates of its spins,
        flexural coordinates) in the acceleration at its place and along its axis.
    springs, dampers : ndarray
        The same of that axis's part of what the seat's stiffness (N/m) and damping (N s/m) make of the
        acceleration.
    modes : sequence of (Pole, float)
        Of the structure, each with its mass (kg).
    mount : Pole, optional
        Of the mounted sensor.
    """

    name: str
    number: int
    reads: Row
    springs: Row
    dampers: Row
    modes: Sequence[tuple[Pole, float]] = ()
    mount: Pole | None = None

    @property
    def rows(self) -> list[Row]:
        """Weights of its channels: what it reads, then what drives modes, if there are any."""
        return [self.reads, self.springs, self.dampers] if self.modes else [self.reads]

    def mounted(self, frequency: Row) -> Complex:
        """Return the response of its mounting at ``frequency`` (Hz)."""
        s = _laplace(frequency)
        if self.mount is None:
            return np.ones_like(s)
        return self.mount.omega**2 / self.mount.denominator(s)

    def responses(self, frequency: Row) -> list[Complex]:
        """Return what it reads per unit of each of its channels, at ``frequency`` (Hz): all modes added."""
        s = _laplace(frequency)
        mounted = self.mounted(frequency)
        modal: Complex = sum(
            (1.0 / (mass * pole.denominator(s)) for pole, mass in self.modes), np.zeros_like(s)
        )
        return [mounted, mounted * modal, mounted * modal * s][: len(self.rows)]


@dataclass(frozen=True)
class Sensors:
    """Accelerometers of one bearing as a source of channels; ``modes``: flexural, of both of its rings."""

    each: Sequence[Sensor]
    modes: Sequence[object] = ()
    form: ChannelForm = "sensors"
    balls: int = 0
    harmonics: int = 0

    @property
    def first(self) -> list[int]:
        """Number of the first channel of each sensor, and of all channels at the end."""
        return list(np.cumsum([0, *(len(one.rows) for one in self.each)]))

    @property
    def channels(self) -> int:
        """Number of channels."""
        return self.first[-1]

    @property
    def scalars(self) -> Row:
        """Weights of all channels, row after row."""
        return np.concatenate([row for one in self.each for row in one.rows])


def block_of(sensors: Sensors) -> Row:
    """Block of the accelerometers of one bearing for the engine.

    Raises
    ------
    ValueError
        When a filter misses its response by more than 0.05 dB.
    """
    wires: list[Wire] = []
    sources: list[tuple[int, int]] = []
    resonators: list[tuple[float, float]] = []
    for place, (sensor, (first, _)) in enumerate(zip(sensors.each, pairwise(sensors.first), strict=True)):
        for pole, taps in _filters(sensor):
            wires += [Wire(0, first + k, delay_of(0.0), one, len(sources)) for k, one in taps]
            sources.append((place, 0))
            resonators.append((0.0, 0.0) if pole is None else pole.section)
    resonators += [(0.0, 0.0) if one.mount is None else one.mount.section for one in sensors.each]
    block = pack(sensors, wires, [], sources, details=False, thirds=False, lengths=None)
    count = len(sensors.each)
    block[SD.H_MICS] = count
    block[SD.H_AT_RESONATORS], order = block.size, block.size + SD.RESONATOR * len(resonators)
    block[SD.H_AT_ORDER] = order
    block[SD.H_S_METERS] = block[SD.H_STATE]
    block[SD.H_S_RESONATORS] = block[SD.H_S_METERS] + SD.A_METERS * count
    block[SD.H_STATE] = block[SD.H_S_RESONATORS] + SD.RESONATOR * len(resonators)
    return np.concatenate([block, np.ravel(resonators), [one.number for one in sensors.each]])


def read(sensor: Sensor, channels: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the acceleration (m/s2) that a sensor reads, as the engine's, without its latency.

    ``channels``: those of the sensor at ``SD.RATE``, shape (channels, rows), from the engine's first row on.
    Shape (rows - `SD.LATENCY`,).
    """
    late = delay_of(0.0)
    delayed = np.pad(channels, ((0, 0), (late, 0)))[:, : channels.shape[1]]
    total = np.zeros(channels.shape[1])
    for pole, taps in _filters(sensor):
        driven = sum((scipy.signal.lfilter(one, 1.0, delayed[k]) for k, one in taps), np.zeros_like(total))
        total += driven if pole is None else scipy.signal.lfilter([1.0], [1.0, *pole.section], driven)
    if sensor.mount is not None:
        total = scipy.signal.lfilter([1.0], [1.0, *sensor.mount.section], total)
    return total[SD.LATENCY :]


def _filters(sensor: Sensor) -> list[tuple[Pole | None, list[tuple[int, Row]]]]:
    """Return the outputs of a sensor: its section, and channel and filter of each of its paths."""
    f = fit_frequencies()
    s = _laplace(f)
    mounted = sensor.mounted(f) * (1.0 if sensor.mount is None else sensor.mount.undone(f))
    outputs: list[tuple[Pole | None, list[tuple[int, Row]]]] = [
        (None, [(0, _fitted(sensor, mounted, np.abs(mounted)))])
    ]
    size = np.linalg.norm(sensor.reads[: SD.R_FLEXURES])
    for pole, mass in sensor.modes:
        undone = pole.undone(f)
        response = mounted * undone / (mass * pole.denominator(s))
        paths = []
        for channel, row, one in ((1, sensor.springs, response), (2, sensor.dampers, response * s)):
            drives = np.linalg.norm(row[: SD.R_FLEXURES])
            if drives > 0.0:  # beside what the sensor reads without modes, where that is more
                paths.append((channel, _fitted(sensor, one, np.abs(mounted * undone) * size / drives)))
        outputs.append((pole, paths))
    return outputs


def _fitted(sensor: Sensor, response: Complex, beside: Row) -> Row:
    """Return the filter of a response, whose errors count against ``beside`` where it is less."""
    taps, error = fit(response, 0.0, beside / WEAK)
    if error > _TOLERANCE:
        raise ValueError(
            f"no filter follows accelerometer {sensor.name}: it is off by {100.0 * error:.2g} %, allowed are "
            f"{100.0 * _TOLERANCE:.2g}; give its modes or its resonance more damping"
        )
    return taps
