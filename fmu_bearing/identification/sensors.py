"""Levels of a recording at the measured places: paths made once per geometry, one spectrum per run.

Each run is one block under a Hann window. Level, third octave and line are sums over one spectrum, which
costs milliseconds where filters over the samples cost tenths of a second. Against `ChannelHistory.levels` a
steady sound differs by hundredths of a dB.
"""

from collections.abc import Sequence

import numpy as np
import scipy
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.field import Position, Transfer
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.acoustics.filters.fir import band_limit, decimator_response
from fmu_bearing.acoustics.filters.weighting import REFERENCE_PRESSURE, a_weighting_db, band_sections
from fmu_bearing.acoustics.radiation.frequencies import STOP
from fmu_bearing.engine.layout import SD
from fmu_bearing.identification.data import VELOCITY_REFERENCE, Datum
from fmu_bearing.identification.quantities import LINE, Quantity
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.run.figures import A_LEVEL, LEVEL, THIRD_OCTAVE

_SEARCH = 0.004  # relative: how far from its frequency a line is looked for, as balls slide
_STEPS = 9
_LOWEST = 20.0  # Hz: velocities count from there on, as for sound
_FLOOR = 1e-12  # of the reference's square: -120 dB, so that levels of nothing stay finite


class Sensors:
    """Paths from channels to microphones, for runs of one geometry and one length.

    Parameters
    ----------
    recording : ChannelHistory
        Any run of the geometry.
    rows : sequence of Datum
        All that will be asked for.
    """

    def __init__(self, recording: ChannelHistory, rows: Sequence[Datum]) -> None:
        places = dict.fromkeys(row.position for row in rows if row.position is not None)
        self.positions: list[Position] = list(places)
        self.size = recording.size
        self.energies = recording.radiation_model.startswith("paper")
        channels = recording.history.shape[1]
        paths = recording.paths(self.positions) if places else ()
        self.transfers = [Transfer(circle, channels) for circle in paths]
        #: Channels of each bearing; a set's follow one another.
        self.each = channels // (1 if recording.scene is None else len(recording.scene.bearings()))
        # the papers' own channels hold no accelerations of bodies
        bodies = [] if self.energies else [
            self.channel(row.quantity) for row in rows if row.quantity.channel is not None
        ]  # fmt: skip
        sounding = {path.channel for transfer in self.transfers for path in transfer.circle.paths}
        #: Channels that anything here depends on: a housing hides the balls.
        self.used = np.array(sorted({int(c) for c in (*sounding, *bodies)}))
        frequency = np.fft.rfftfreq(self.size, 1.0 / SD.RATE).astype(np.float64)
        self.keep = (frequency > 0.0) & (frequency < STOP)
        self.frequency = frequency[self.keep]
        self.window = np.hanning(self.size)
        # squares of the spectrum add up to the mean square
        self.scale = np.sqrt(2.0 / self.size / np.sum(self.window**2)) * _shape(self.frequency)
        self.slow = _slow_part(self.size)
        self.slow_fit = np.linalg.pinv(self.slow * self.window[:, None]) * self.window
        self.inverse = np.where(self.frequency < _LOWEST, 0.0, 0.5 / np.pi / self.frequency)  # s: to velocity
        self.response = self.at(self.frequency)
        self.weights = {A_LEVEL: 10.0 ** (a_weighting_db(self.frequency) / 10.0)}

    def at(self, frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Responses of all microphones to the used channels, shape (mics, channels, frequencies)."""
        parts = [transfer(frequency) for transfer in self.transfers]
        responses = np.zeros((len(self.positions), len(self.used), len(frequency)), complex)
        for transfer, part in zip(self.transfers, parts, strict=True):
            responses[list(transfer.circle.members)] = part[:, self.used]
        return responses

    def channel(self, quantity: Quantity) -> int:
        """Place of a body's acceleration among all channels."""
        assert quantity.channel is not None
        return quantity.bearing * self.each + quantity.channel

    def place(self, quantity: Quantity) -> int:
        """Place of a body's acceleration among the used channels."""
        return int(np.searchsorted(self.used, self.channel(quantity)))

    def levels(self, recording: ChannelHistory, rows: Sequence[Datum]) -> NDArray[np.float64]:
        """Levels (dB) of a run in the order of rows: pressure re 20 uPa, velocity re 1 nm/s."""
        channels = recording.channels[:, self.used]
        channels = channels - self.slow @ (self.slow_fit @ channels)
        spectra = scipy.fft.rfft(channels.T * self.window, axis=1)[:, self.keep] * self.scale
        squares = self.squares(self.response, spectra)
        lines = _Lines(self, channels, recording.bearing_kinematics())
        levels = np.empty(len(rows))
        for k, row in enumerate(rows):
            quantity = row.quantity
            if quantity.kind == LINE:
                square = lines.square(row)
            else:
                if row.position is not None:
                    bins = squares[self.positions.index(row.position)]
                else:
                    bins = np.abs(spectra[self.place(quantity)] * self.inverse) ** 2
                square = float(bins @ self._weight(quantity.kind, quantity.frequency))
            reference = REFERENCE_PRESSURE if row.position is not None else VELOCITY_REFERENCE
            levels[k] = 10.0 * np.log10(square / reference**2 + _FLOOR)
        return levels

    def squares(
        self, response: NDArray[np.complex128], spectra: NDArray[np.complex128]
    ) -> NDArray[np.float64]:
        """Mean squares (Pa^2), shape (mics, frequencies), of spectra (channels, frequencies)."""
        if self.energies:  # radiation models of the papers add energies, source by source
            return np.asarray((np.abs(response * spectra) ** 2).sum(axis=1))
        # microphone by microphone: in the processor's cache
        return np.array([np.abs((path * spectra).sum(axis=0)) ** 2 for path in response])

    def _weight(self, kind: str, centre: float) -> NDArray[np.float64]:
        """Weights of the bins of a quantity."""
        if kind == LEVEL:
            return np.ones(len(self.frequency))
        key = kind if kind != THIRD_OCTAVE else f"{kind} {centre}"
        if key not in self.weights:
            response = scipy.signal.sosfreqz(band_sections(SD.RATE, centre), self.frequency, fs=SD.RATE)[1]
            self.weights[key] = np.abs(response) ** 2
        return self.weights[key]


#: Frequencies (Hz), spectra of the channels there, and mean squares (Pa^2) at the microphones.
_Around = tuple[NDArray[np.float64], NDArray[np.complex128], NDArray[np.float64]]


class _Lines:
    """Lines of one run. A line is the largest value within 0.4 % of its frequency in any bearing."""

    def __init__(
        self, sensors: Sensors, channels: NDArray[np.float64], kinematics: Sequence[KinematicFrequencies]
    ) -> None:
        self.sensors, self.channels, self.kinematics = sensors, channels, kinematics
        self.known: dict[tuple[float, ...], _Around] = {}

    def square(self, row: Datum) -> float:
        """Mean square of a line at one place."""
        around, spectra, squares = self._at(
            tuple(dict.fromkeys(row.quantity.line(one) for one in self.kinematics))
        )
        if row.position is not None:
            return float(squares[self.sensors.positions.index(row.position)].max())
        velocity = spectra[self.sensors.place(row.quantity)] / (2.0 * np.pi * around)
        return float((np.abs(velocity) ** 2).max())

    def _at(self, frequencies: tuple[float, ...]) -> _Around:
        if frequencies not in self.known:
            for frequency in frequencies:
                if not 0.0 < frequency < 0.45 * SD.RATE:
                    raise ValueError(f"a line at {frequency:.0f} Hz lies outside what a recording holds")
            around = np.outer(frequencies, 1.0 + _SEARCH * np.linspace(-1.0, 1.0, _STEPS)).ravel()
            window = self.sensors.window * (np.sqrt(2.0) / self.sensors.window.sum())
            time = np.arange(len(window)) / SD.RATE
            angle = 2.0 * np.pi * around[:, None] * time
            real, imaginary = (
                (np.cos(angle) * window) @ self.channels,
                (np.sin(angle) * window) @ self.channels,
            )
            spectra = (real - 1j * imaginary).T
            spectra = spectra * _shape(around)
            squares = self.sensors.squares(self.sensors.at(around), spectra)
            self.known[frequencies] = (around, spectra, squares)
        return self.known[frequencies]


def _slow_part(size: int) -> NDArray[np.float64]:
    """Return mean and slope, shape (samples, 2): what the high-pass leaves of a run's start.

    Divided by the frequency, as a velocity is, it would drown all else.
    """
    return np.column_stack([np.ones(size), np.linspace(-1.0, 1.0, size)])


def _shape(frequency: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the factor that undoes the decimator, up to the microphones' band limit."""
    return np.asarray(band_limit(frequency) / decimator_response(frequency))
