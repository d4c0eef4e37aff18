"""Pressures and levels at any microphone, computed from the recorded channels of a run.

The motion does not depend on the microphones, so the channels give the pressure at any place
(``acoustics.analysis.field``).
"""

import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.field import Blocks, Channels, Circle, Position, form_of, joined, kind_of
from fmu_bearing.acoustics.filters.weighting import a_weighting_db, a_weighting_sections, level
from fmu_bearing.acoustics.radiation.radiators import Path
from fmu_bearing.engine.layout import SD
from fmu_bearing.prepare.imperfections import excitation_end
from fmu_bearing.recording.channels.accelerometers import noise_of, read_all
from fmu_bearing.recording.channels.microphone_places import Places, named_places
from fmu_bearing.recording.channels.sources import air_of, sources_of
from fmu_bearing.recording.channels.turning import Turning
from fmu_bearing.scene import Scene

_FLIGHT = 0.1  # s: room for microphones to 34 m without another transform
_TOGETHER = 32  # microphones evaluated at once by `Recording.levels`
_SPLIT: dict[str, Callable[[Path], str]] = {
    "component": lambda path: SD.COMPONENTS[path.component],
    "kind": kind_of,
    "bearing": lambda path: f"bearing[{path.bearing + 1}]",
}
_NO_WEIGHTING = 'weighting = "{}": only "A" and "Z" (none) are known'


@dataclass(repr=False)
class ChannelHistory(Turning):
    """Channels of a run, and the sound they give at any place; `Recording` adds files.

    Attributes
    ----------
    scene : Scene or None
        The scene that was run.
    radiation_model : str
        Used unless a call names another one; ``"recorded"``: pressures only.
    rate : float
        Samples per second.
    start : float
        Time (s after initialisation) of the first sample.
    size : int
        Number of samples.
    output_time : ndarray, shape (m,)
        Communication points (s), from initialisation on.
    speed_points : ndarray, shape (m,)
        Shaft speed there (rad/s); it is linear in between.
    outputs : dict
        Other variables at `output_time`, by name, SI units.
    history : ndarray, shape (rows, channels)
        Channels from initialisation on, beyond the last sample, of a set those of its bearings one after the
        other; empty where only pressures were recorded.
    recorded : ndarray, shape (mics, size)
        Pressures (Pa) where only they were recorded, else empty.
    microphones : tuple of (name, (x, y, z))
        The scene's microphones, places in m.
    harmonics : int
        Highest circumferential order of the balls' sound among the channels.
    sensed : ndarray, shape (rows, channels)
        Channels of the scene's accelerometers, in the rows of `history`; no columns without any.
    units : dict
        Units of variables that are none of our FMUs', by name, as the titles of a measured record give them.
    """

    scene: Scene | None
    radiation_model: str
    rate: float
    start: float
    size: int
    output_time: NDArray[np.float64]
    speed_points: NDArray[np.float64]
    outputs: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    history: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 0)))
    recorded: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 0)))
    microphones: tuple[tuple[str, Position], ...] = ()
    harmonics: int = 0
    sensed: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 0)))
    units: dict[str, str] = field(default_factory=dict)
    _spectra: Channels | None = field(default=None, repr=False, compare=False)

    def __repr__(self) -> str:
        name = "no scene" if self.scene is None else self.scene.name
        return (
            f"{type(self).__name__}({name}, radiation model {self.radiation_model}, "
            f"{self.size / self.rate:g} s at {self.rate:g} Hz from {self.start:g} s on, "
            f"{self.history.shape[1]} channels)"
        )

    @property
    def time(self) -> NDArray[np.float64]:
        """Time of each sample (s after initialisation), shape (size,)."""
        return self.start + np.arange(self.size) / self.rate

    @property
    def first(self) -> int:
        """Row of `history` that belongs to the first sample."""
        return round(self.start * self.rate)

    @property
    def channels(self) -> NDArray[np.float64]:
        """Channels at each sample, shape (size, channels); see ``engine.sound.places``."""
        return self.history[self.first : self.first + self.size]

    @property
    def speed(self) -> NDArray[np.float64]:
        """Shaft speed at each sample (rad/s), shape (size,)."""
        return np.interp(self.time, self.output_time, self.speed_points)

    @property
    def changes_speed(self) -> bool:
        """Whether the shaft's speed changes, by more than 1 % of its mean."""
        return bool(np.ptp(self.speed) > 0.01 * abs(float(np.mean(self.speed))))

    @property
    def angle(self) -> NDArray[np.float64]:
        """Angle (rad) the shaft has turned since initialisation at each sample, shape (size,)."""
        t, w = self.output_time, self.speed_points
        whole = np.concatenate([[0.0], np.cumsum(0.5 * (w[1:] + w[:-1]) * np.diff(t))])
        k = np.clip(np.searchsorted(t, self.time, side="right") - 1, 0, len(t) - 1)
        return whole[k] + 0.5 * (w[k] + self.speed) * (self.time - t[k])

    @property
    def positions(self) -> list[Position]:
        """Places (m) of the scene's microphones."""
        return [place for _, place in self.microphones]

    @property
    def excitation_end(self) -> float | None:
        """Frequency (Hz) up to which the scene's surfaces excite it at the mean speed; None: not known."""
        return None if self.scene is None else excitation_end(self.scene, float(np.mean(self.speed)))

    def pressure(self, positions: Places = None, radiation_model: str | None = None) -> NDArray[np.float64]:
        """Sound pressure (Pa) at places of your choice, shape (mics, size): the coherent sum of all sources.

        Parameters
        ----------
        positions : sequence of (x, y, z) or str, or str, optional
            Places in m, bearing centre at the origin (of a set the shaft's nose), or names of the scene's
            microphones; default: all of these.
        radiation_model : str, optional
            In place of the recording's own.

        Raises
        ------
        ValueError
            For an unknown name, a place inside a body, a radiation model that needs other channels, or, with
            a recording of pressures, for a place without microphone.

        Examples
        --------
        >>> from fmu_bearing import record, with_fidelity
        >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
        >>> recording = record(scene, 0.02, radiation_model="compact")
        >>> recording.pressure(["P1", (0.0, 0.3, 0.0)]).shape
        (2, 1024)
        """
        if self.history.size == 0:
            return self.recorded[self._recorded_rows(positions)]
        places = self.places(positions)
        total = np.zeros((len(places), self.size))
        for circle, parts in self._pressures_by_circle(places, radiation_model, lambda path: ""):
            for part in parts.values():
                total[list(circle.members)] += part
        return total

    @property
    def accelerometers(self) -> tuple[str, ...]:
        """Names of the accelerometers that were recorded."""
        if self.scene is None or self.sensed.size == 0:
            return ()
        return tuple(sensor.name for sensor in self.scene.accelerometers)

    def acceleration(
        self, names: str | Sequence[str] | None = None, *, noise: bool = True
    ) -> NDArray[np.float64]:
        """Acceleration (m/s2) that accelerometers of the scene read, the delay of the filters taken out.

        Parameters
        ----------
        names : str or sequence of str, optional
            Of one, shape (size,), or of several, shape (sensors, size); default: all of the scene.
        noise : bool
            With the noise that the scene gives them: white, drawn from the seed of its imperfections.

        Raises
        ------
        ValueError
            For an unknown name, or a recording without accelerometers.

        Examples
        --------
        >>> from fmu_bearing import record, with_fidelity
        >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
        >>> sensed = scene.replace({"accelerometer": [{"name": "DE"}]})
        >>> record(sensed, 0.02).acceleration("DE").shape
        (1024,)
        """
        known = self.accelerometers
        if self.scene is None or not known:
            raise ValueError("no accelerometer was recorded: add [[accelerometer]] to the scene")
        wanted = [names] if isinstance(names, str) else list(known if names is None else names)
        for name in wanted:
            if name not in known:
                raise ValueError(f"there is no accelerometer '{name}'; there are {', '.join(known)}")
        found = read_all(self.scene, self.sensed)
        values = np.array([found[name][self.first : self.first + self.size] for name in wanted])
        if noise:
            values += [noise_of(self.scene, name, self.size) for name in wanted]
        return values[0] if isinstance(names, str) else values

    def partial(
        self, positions: Places = None, radiation_model: str | None = None, by: str = "component"
    ) -> dict[str, NDArray[np.float64]]:
        """Sound pressure (Pa) of each source alone, shape (mics, size) by name; the sum is `pressure`.

        Parameters
        ----------
        positions, radiation_model
            As for `pressure`.
        by : str
            ``"component"`` (inner_ring, outer_ring, cage, balls), ``"kind"`` of source (radial, axial ...) or
            ``"bearing"`` (bearing[1] and so on of a set; a single one is bearing[1]).

        Raises
        ------
        ValueError
            As `pressure`; also for a recording of pressures, which has no components.
        """
        if by not in _SPLIT:
            raise ValueError(f'by = "{by}": sources are split by "component", "kind" or "bearing"')
        places = self.places(positions)
        pressures: dict[str, NDArray[np.float64]] = {}
        for circle, parts in self._pressures_by_circle(places, radiation_model, _SPLIT[by]):
            for name, part in parts.items():
                total = pressures.setdefault(name, np.zeros((len(places), self.size)))
                total[list(circle.members)] += part
        return pressures

    def levels(
        self,
        positions: Places = None,
        radiation_model: str | None = None,
        weighting: str = "Z",
        resolution: float | None = None,
    ) -> NDArray[np.float64]:
        """Equivalent level (dB re 20 uPa) over the recording at each place, shape (mics,).

        Radiation models of the papers add energies, source by source (multi-source paper, eqs. 43 and 46).
        ``fmu_bearing.spread(recording)`` computes how far a level depends on chance and on assumed surfaces.

        Parameters
        ----------
        positions, radiation_model
            As for `pressure`.
        weighting : str
            ``"Z"`` (none) or ``"A"``.
        resolution : float, optional
            Average over blocks of 1 / ``resolution`` s instead (Hz; 20, for example): far faster at many
            places, a few hundredths of a dB apart in a steady sound.
        """
        if self.history.size == 0:
            return level(self.mean_square(self.pressure(positions), weighting))
        places = self.places(positions)
        if resolution is not None:
            return self._quick_levels(places, radiation_model, weighting, resolution)
        mean_square = np.zeros(len(places))
        energies = (radiation_model or self.radiation_model).startswith("paper")
        for low in range(0, len(places), _TOGETHER):
            some = places[low : low + _TOGETHER]
            for circle, parts in self._pressures_by_circle(
                some,
                radiation_model,
                (lambda path: path.channel) if energies else (lambda path: 0),
                whole=True,
            ):
                rows = [low + i for i in circle.members]
                for part in parts.values():
                    mean_square[rows] += self.mean_square(part, weighting)
        return level(mean_square)

    def mean_squares(
        self, positions: Places = None, radiation_model: str | None = None, resolution: float = 20.0
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Frequencies (Hz), and mean square pressure (Pa^2) in each bin at each place, (mics, bins).

        From short-time spectra of the channels, which is fast at many places. Sums over all bins agree with
        `levels` at the same ``resolution``; sums over some bins give bands.
        """
        places = self.places(positions)
        blocks = Blocks(self.channels, resolution)
        energies = (radiation_model or self.radiation_model).startswith("paper")
        squares = np.zeros((len(places), len(blocks.frequency)))
        for circle in self._circles(places, radiation_model):
            parts = blocks.mean_squares(circle, (lambda path: path.channel) if energies else (lambda path: 0))
            squares[list(circle.members)] = sum(parts.values())
        return blocks.frequency, squares

    def _quick_levels(
        self, places: list[Position], radiation_model: str | None, weighting: str, resolution: float
    ) -> NDArray[np.float64]:
        """Levels by short-time spectra of the channels."""
        if weighting not in ("A", "Z"):
            raise ValueError(_NO_WEIGHTING.format(weighting))
        frequency, squares = self.mean_squares(places, radiation_model, resolution)
        weights = 10.0 ** (a_weighting_db(frequency) / 10.0) if weighting == "A" else np.ones(len(frequency))
        return level(squares @ weights)

    def mean_square(self, pressure: NDArray[np.float64], weighting: str = "Z") -> NDArray[np.float64]:
        """Mean square (Pa^2) over the recording's samples, the last ones of ``pressure``, shape (...,).

        Earlier samples let the filter of the A-weighting settle.
        """
        if weighting == "A":
            pressure = scipy.signal.sosfilt(a_weighting_sections(self.rate), pressure, axis=-1)
        elif weighting != "Z":
            raise ValueError(_NO_WEIGHTING.format(weighting))
        return np.asarray(np.mean(pressure[..., -self.size :] ** 2, axis=-1))

    def channel_signals(self, columns: Sequence[int]) -> NDArray[np.float64]:
        """Return columns of `history` over the recording, up to 20 kHz, shape (columns, size).

        The decimator's part is taken out, so that there is no latency: a value is of its time.
        """
        if self._spectra is None:
            self._spectra = Channels(self.history, _FLIGHT)
        return self._spectra.signals(columns)[:, self.first : self.first + self.size]

    def _pressures_by_circle(
        self, places: list[Position], radiation_model: str | None, label, whole: bool = False
    ) -> Iterator[tuple[Circle, dict[Any, NDArray[np.float64]]]]:
        """Yield each circle with its pressures by label; ``whole``: with the samples before the first one."""
        circles = self._circles(places, radiation_model)
        self._prepare(places)
        assert self._spectra is not None
        begin = 0 if whole else self.first
        for circle in circles:
            parts = self._spectra.pressures(circle, label)
            yield circle, {name: part[:, begin : self.first + self.size] for name, part in parts.items()}

    def _prepare(self, places: list[Position]) -> None:
        """Spectra of the channels, with room for the longest flight; a warning where it exceeds the start."""
        assert self.scene is not None
        ends = [bearing.position for bearing in self.scene.bearings()]
        longest = max(math.dist(place, (end, 0.0, 0.0)) for place in places for end in ends)
        longest /= air_of(self.scene).sound_speed
        if longest > self.start:
            warnings.warn(
                f"sound takes {longest:.3g} s to the farthest place, but the recording starts "
                f"{self.start:.3g} s after the bearing: record with a longer settle",
                stacklevel=4,
            )
        # the room depends on the places alone, so that a call gives the same bits whatever was asked before
        room = _FLIGHT if longest < _FLIGHT else 1.2 * longest
        if self._spectra is None or self._spectra.longest != room:
            self._spectra = Channels(self.history, room)

    def paths(self, positions: Places = None, radiation_model: str | None = None) -> list[Circle]:
        """Paths from the channels to places, for use with other recordings of the same bodies.

        ``positions``, ``radiation_model`` and errors as for `pressure`.
        """
        return list(self._circles(self.places(positions), radiation_model))

    def _circles(self, places: list[Position], radiation_model: str | None) -> Iterator[Circle]:
        """Paths from the channels to places, circle by circle."""
        if self.history.size == 0 or self.scene is None:
            raise ValueError(
                "only pressures were recorded: components and other places need the channels that "
                "fmu_bearing.record keeps"
            )
        radiation_model = self.radiation_model if radiation_model is None else radiation_model
        if form_of(radiation_model) != form_of(self.radiation_model):
            raise ValueError(
                f'radiation_model = "{radiation_model}" needs other channels than '
                f'"{self.radiation_model}": record with radiation_model="{radiation_model}"'
            )
        return joined(sources_of(self.scene, radiation_model, places, self.harmonics))

    def named(self, positions: Places = None) -> list[tuple[str, Position]]:
        """Names and places (m) of microphones, given as for `pressure`; a mere place is named in mm.

        Raises
        ------
        ValueError
            For an unknown name, with the known ones; for what is not a place; without any microphone.
        """
        return named_places(self.microphones, positions)

    def places(self, positions: Places = None) -> list[Position]:
        """Places (m) of microphones, given as for `named`."""
        return [place for _, place in self.named(positions)]

    def _recorded_rows(self, positions: Places) -> list[int]:
        """Rows of `recorded`; names find those whose place is unknown, of an FMU run without scene."""
        names = [name for name, _ in self.microphones]
        rows = []
        for name, place in self.named(positions):
            near = [i for i, known in enumerate(self.positions) if np.allclose(known, place, atol=1e-9)]
            if name not in names and not near:
                raise ValueError(
                    f"no microphone was recorded at {place} m, and only pressures were: record the scene "
                    "with fmu_bearing.record"
                )
            rows.append(names.index(name) if name in names else near[0])
        return rows
