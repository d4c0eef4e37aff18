"""Pressure at any place from recorded channels, by exact multiplication in the frequency domain.

The engine streams sound to the scene's microphones through short filters. This module takes the channels that
such a run leaves behind (one row per sample at ``RATE``, behind decimator and high-pass) to microphones that
the run did not know, through the same paths, without filters: one long transform of the channels, the
decimator's response divided out, the microphones' band limit put in, times each path's transfer function
between its tabulated frequencies.
"""

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft

from fmu_bearing.acoustics.filters.fir import band_limit, decimator_response
from fmu_bearing.acoustics.radiation.frequencies import STOP, fit_frequencies, spline_of
from fmu_bearing.acoustics.radiation.radiators import Path
from fmu_bearing.acoustics.registry import Radiation, recipe_of
from fmu_bearing.engine.choices import ChannelForm
from fmu_bearing.engine.layout import SD

Position = tuple[float, float, float]
_Responses = Callable[[NDArray[np.float64]], dict[tuple[int, float], NDArray[np.complex128]]]

#: Rows that a recording must reach beyond the last pressure wanted: the band limit rings that long (5 ms).
TAIL = 256
_SETTLE = 4096  # rows of zeros behind the recording, so that the end does not reach round to the beginning
_BLOCK = 16_384  # frequencies worked on at once: bounds the memory


@dataclass(frozen=True)
class Circle:
    """Microphones that share transfer functions: their places in the list asked for, and their paths."""

    members: tuple[int, ...]
    paths: tuple[Path, ...]


def joined(sources: Sequence[tuple[Radiation, Sequence[Position]]]) -> Iterator[Circle]:
    """Yield the paths from the channels of several bearings to microphones, circle by circle.

    Parameters
    ----------
    sources
        Of each bearing what radiates, and the places in m in its own axes, in one order. Its channels follow
        those of the bearings before it.

    Raises
    ------
    ValueError
        For a microphone inside a body.
    """
    shared: dict[tuple[int, ...], list[int]] = {}
    groups = [
        {i: k for k, members in enumerate(radiation.circles(places)) for i in members}
        for radiation, places in sources
    ]
    for i in range(len(sources[0][1])):
        shared.setdefault(tuple(group[i] for group in groups), []).append(i)
    for members in shared.values():
        paths: list[Path] = []
        first = 0
        for number, (radiation, places) in enumerate(sources):
            paths += [
                replace(path, channel=first + path.channel, bearing=number)
                for path in radiation.paths(places, members)
            ]
            first += radiation.channels
        yield Circle(tuple(members), tuple(paths))


def form_of(model: str) -> ChannelForm:
    """Return which form of channels a radiation model hears: ``"vectors"``, or a paper's own.

    Raises
    ------
    ValueError
        When there is no such model.
    """
    return recipe_of(model).form


def kind_of(path: Path) -> str:
    """Source type of a path: one of ``layout.sound_filters.KINDS``."""
    return SD.KINDS[path.kind]


class Channels:
    """Spectra of recorded channels, ready to be taken to microphones.

    Parameters
    ----------
    history : ndarray, shape (rows, channels)
        Channel history from the engine's first sample on; rows are 1 / ``RATE`` apart.
    longest : float
        Longest flight (s) it will be used for.
    """

    def __init__(self, history: NDArray[np.float64], longest: float = 0.1) -> None:
        self.rows, self.longest = len(history), longest
        self.size = int(next_fast_len(self.rows + _SETTLE + round(longest * SD.RATE), real=True))
        frequency = np.fft.rfftfreq(self.size, 1.0 / SD.RATE).astype(np.float64)
        self.frequency = frequency[frequency < STOP]
        shape = np.empty(len(self.frequency), dtype=complex)
        for block in _blocks(len(shape)):
            part = self.frequency[block]
            shape[block] = band_limit(part) / decimator_response(part)
        self.spectra = np.empty((history.shape[1], len(shape)), dtype=complex)
        for c in range(history.shape[1]):
            self.spectra[c] = rfft(history[:, c], self.size)[: len(shape)] * shape

    def pressures(
        self, circle: Circle, label: Callable[[Path], Hashable] = lambda path: ""
    ) -> dict[Hashable, NDArray[np.float64]]:
        """Pressure (Pa) at the microphones of one circle, shape (members, rows), split by ``label``.

        No latency: row k is what arrives at time k / ``RATE``. The last `TAIL` rows are not to be used.
        """
        members = len(circle.members)
        parts = {label(path): np.zeros((members, self.size // 2 + 1), complex) for path in circle.paths}
        responses = _interpolated(circle.paths)
        for block in _blocks(len(self.frequency)):
            known = responses(self.frequency[block])
            for name in parts:
                chosen = [path for path in circle.paths if label(path) == name]
                products = np.array(
                    [self.spectra[path.channel, block] * known[_key(path)] for path in chosen]
                )
                weights = np.array([path.weights for path in chosen]).T
                parts[name][:, block] = weights @ products
        return {name: irfft(part, self.size, axis=1)[:, : self.rows] for name, part in parts.items()}

    def signals(self, columns: Sequence[int]) -> NDArray[np.float64]:
        """Return channels as microphones have their band, without latency, shape (columns, rows).

        The last `TAIL` rows are not to be used.
        """
        spectra = np.zeros((len(columns), self.size // 2 + 1), complex)
        spectra[:, : len(self.frequency)] = self.spectra[list(columns)]
        return np.asarray(irfft(spectra, self.size, axis=1)[:, : self.rows])


class Blocks:
    """Short-time spectra of recorded channels: mean squares at many places, quickly.

    Blocks of 1 / ``resolution`` s with half overlap (Hann window) are averaged in energy. Against the exact
    mean square of the same recording, this weighs its two ends less.

    Parameters
    ----------
    channels : ndarray, shape (samples, channels)
        Channels at ``RATE``.
    resolution : float
        Spacing of frequencies (Hz).

    Raises
    ------
    ValueError
        When the recording is shorter than one block.
    """

    def __init__(self, channels: NDArray[np.float64], resolution: float) -> None:
        size = round(SD.RATE / resolution)
        if size < 64 or size > len(channels):
            raise ValueError(
                f"a resolution of {resolution:g} Hz needs blocks of {size} samples (64 or more), the "
                f"recording has {len(channels)}"
            )
        window = scipy.signal.get_window("hann", size)
        frequency = np.fft.rfftfreq(size, 1.0 / SD.RATE).astype(np.float64)
        keep = (frequency > 0.0) & (frequency < STOP)
        self.frequency = frequency[keep]
        starts = range(0, len(channels) - size + 1, max(1, size // 2))
        scale = np.sqrt(2.0 / size / np.sum(window**2) / len(starts)) * band_limit(self.frequency)
        scale = scale / decimator_response(self.frequency)
        # shape (channels, blocks, frequencies): rms per bin once squared and summed over blocks
        self.spectra = np.array(
            [rfft(channels[start : start + size].T * window, axis=1)[:, keep] * scale for start in starts]
        ).transpose(1, 0, 2)

    def mean_squares(
        self, circle: Circle, label: Callable[[Path], Hashable] = lambda path: ""
    ) -> dict[Hashable, NDArray[np.float64]]:
        """Mean square pressure (Pa^2) per bin at one circle's microphones, (members, bins) by label."""
        known = _interpolated(circle.paths)(self.frequency)
        squares: dict[Hashable, NDArray[np.float64]] = {}
        for name in dict.fromkeys(label(path) for path in circle.paths):
            chosen = [path for path in circle.paths if label(path) == name]
            weights = np.array([path.weights for path in chosen]).T
            total = np.zeros((len(circle.members), len(self.frequency)))
            places_of = [path.channel for path in chosen]
            response = np.array([known[_key(path)] for path in chosen])
            for block in range(self.spectra.shape[1]):
                total += np.abs(weights @ (self.spectra[places_of, block] * response)) ** 2
            squares[name] = total
        return squares


class Transfer:
    """Transfer functions from channels to the microphones of one circle, for use at many frequencies.

    Parameters
    ----------
    circle : Circle
    channels : int
        Number of channels of the recordings it is used for.
    """

    def __init__(self, circle: Circle, channels: int) -> None:
        self.circle = circle
        self._responses = _interpolated(circle.paths)
        places = {key: k for k, key in enumerate(dict.fromkeys(map(_key, circle.paths)))}
        self._weights = np.zeros((len(circle.members), channels, len(places)))
        for path in circle.paths:
            self._weights[:, path.channel, places[_key(path)]] += path.weights

    def __call__(self, frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Pressure per channel (Pa per unit of the channel), shape (members, channels, frequencies)."""
        known = np.array(list(self._responses(frequency).values()))
        return np.asarray(np.tensordot(self._weights, known, 1))


def _key(path: Path) -> tuple[int, float]:
    """Identity of a transfer function: sources that share a response share its interpolant."""
    return id(path.response), path.flight


def _interpolated(paths: Sequence[Path]) -> _Responses:
    """Return a function that gives the responses of all paths at frequencies, by `_key` in the paths' order.

    Beyond the last tabulated frequency, where everything fades, the value there is held.
    """
    f = fit_frequencies()
    distinct = {_key(path): path for path in paths}
    flights = np.array([path.flight for path in distinct.values()])
    spline = spline_of(f, np.array([path.response for path in distinct.values()]), flights[:, None])

    def evaluate(frequency: NDArray[np.float64]) -> dict[tuple[int, float], NDArray[np.complex128]]:
        found = spline(np.minimum(frequency, f[-1]))
        turns = {flight: np.exp(-2j * np.pi * frequency * flight) for flight in set(flights)}
        return {key: row * turns[key[1]] for key, row in zip(distinct, found, strict=True)}

    return evaluate


def _blocks(count: int) -> Iterator[slice]:
    for start in range(0, count, _BLOCK):
        yield slice(start, min(start + _BLOCK, count))
