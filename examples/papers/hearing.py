"""Levels of a recording, source by source.

Most radiation models add pressures: a component is one source, and the total is the coherent sum. Radiation
model ``paper`` adds energies: each component is several sources (multi-source paper, eqs. 43 and 46).

Paths depend on bodies and places, not on the run: they are made once per scene and kept, since boundary
elements take a second per circle.
"""

import fcntl
import functools
import hashlib
import pathlib
import pickle
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.signal import sosfilt

from fmu_bearing.acoustics.analysis.field import Channels, Circle, joined
from fmu_bearing.acoustics.analysis.spectrum import amplitude_spectrum
from fmu_bearing.acoustics.filters.design import radiators_of
from fmu_bearing.acoustics.filters.weighting import a_weighting_sections, level
from fmu_bearing.acoustics.radiation.compact import Path
from fmu_bearing.acoustics.registry import Radiation
from fmu_bearing.elastic.modes import ring_modes
from fmu_bearing.engine.layout import SD
from fmu_bearing.engine.sources import rooms_digest
from fmu_bearing.files import own_folder, read_own, write_whole
from fmu_bearing.recording.channels.sources import air_of
from fmu_bearing.recording.record import Recording
from fmu_bearing.scene import Scene

#: Keys of ``sound`` that change no motion and no path.
LISTENING = (
    "radiation_model", "microphone", "circle", "metering_start_s", "time_weighting", "third_octaves",
    "details",
)  # fmt: skip
Sources = dict[str, NDArray[np.float64]]
Places = Sequence[Sequence[float]]
NAMES = {"inner_ring": "inner ring", "outer_ring": "outer ring", "cage": "cage", "balls": "balls"}
_SEARCH = 0.004  # relative: how far from its frequency a line is looked for
_STEPS = 9


class Ear:
    """A recording through paths that are kept on disk.

    Parameters
    ----------
    recording : Recording
    radiation_model : str
    cache : pathlib.Path
        Folder of the kept paths.
    """

    def __init__(self, recording: Recording, radiation_model: str, cache: pathlib.Path) -> None:
        if recording.scene is None:
            raise ValueError("this recording has no scene: nothing says what radiates")
        self.recording, self.radiation_model, self.cache = recording, radiation_model, cache
        self.scene: Scene = recording.scene
        self.channels = Channels(recording.history)

    def parts(self, places: Places, label: Callable[[Path], int]) -> dict[int, NDArray[np.float64]]:
        """Pressures (Pa), shape (mics, size), summed over paths with one label."""
        points = tuple((float(x), float(y), float(z)) for x, y, z in places)
        record = self.recording
        window = slice(record.first, record.first + record.size)
        found: dict[int, NDArray[np.float64]] = {}
        for circle in _kept_paths(self.scene, self.radiation_model, points, record.harmonics, self.cache):
            for name, part in self.channels.pressures(circle, label).items():
                total = found.setdefault(name, np.zeros((len(points), record.size)))
                total[list(circle.members)] += part[:, window]
        return found

    def sources(self, places: Places) -> Sources:
        """Pressures of each component's sources, shape (sources, mics, size) by component, and ``total``.

        The energies of an entry's sources add. The total of radiation model ``paper`` holds all its sources;
        that of every other model holds one, the coherent sum.
        """
        if self.radiation_model != "paper":
            parts = self.parts(places, lambda path: path.component)
            found = {SD.COMPONENTS[k]: part[None] for k, part in parts.items()}
            return found | {"total": np.sum(list(parts.values()), axis=0)[None]}
        many = len(SD.COMPONENTS)
        parts = self.parts(places, lambda path: many * path.channel + path.component)
        found = {
            name: np.array([part for key, part in parts.items() if key % many == k])
            for k, name in enumerate(SD.COMPONENTS)
            if any(key % many == k for key in parts)
        }
        return found | {"total": np.concatenate(list(found.values()))}

    def pressure(self, places: Places) -> NDArray[np.float64]:
        """Coherent sum of all sources (Pa), shape (mics, size)."""
        return self.parts(places, lambda path: 0)[0]

    def levels(self, places: Places) -> NDArray[np.float64]:
        """Equivalent level (dB) of the total, shape (mics,)."""
        if self.radiation_model == "paper":
            return equivalent(self.sources(places)["total"])
        return level((self.pressure(places) ** 2).mean(axis=1))


@functools.lru_cache(maxsize=8)
def _read(path: pathlib.Path) -> list[Circle]:
    return pickle.loads(read_own(path))


def _kept_paths(
    scene: Scene, radiation_model: str, places: tuple[tuple[float, float, float], ...], harmonics: int,
    cache: pathlib.Path,
) -> list[Circle]:  # fmt: skip
    """Paths to places: from the cache, or made and put there."""
    sound = "" if scene.sound is None else scene.sound.model_dump_json(exclude=set(LISTENING))
    body = (
        scene.bearing.model_dump_json(exclude={"ball_springs"}),
        scene.materials.model_dump_json(),
        scene.mounting.model_dump_json(include={"housing", "flexure"}),
    )
    text = repr((radiation_model, sound, body, places, harmonics, sources_hash()))
    path = cache / "paths" / f"{hashlib.sha256(text.encode()).hexdigest()[:16]}.pickle"
    own_folder(path.parent)  # what is unpickled is run
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # other workers want the same paths: one makes them
        if not path.exists():
            modes = ring_modes(scene) if radiation_model != "paper" else ()
            radiation = Radiation(radiation_model, radiators_of(scene), air_of(scene), harmonics, modes)
            made = list(joined([(radiation, places)]))
            write_whole(path, pickle.dumps(made))
    return _read(path)


@functools.cache
def sources_hash() -> str:
    """Hash (12 hex digits) of the sources of sound and elasticity: what is kept follows the code."""
    return rooms_digest("acoustics", "elastic")[:12]


def equivalent(sources: NDArray[np.float64]) -> NDArray[np.float64]:
    """Equivalent level (dB) at each microphone, shape (mics,), of sources (sources, mics, size)."""
    return level((sources**2).mean(axis=2).sum(axis=0))


def below(sources: NDArray[np.float64], rate: float, highest: float) -> NDArray[np.float64]:
    """Level (dB) at each microphone of sources (sources, mics, size), of frequencies up to ``highest`` Hz."""
    size = sources.shape[-1]
    lines = np.fft.rfft(sources, axis=-1)
    chosen = np.fft.rfftfreq(size, 1.0 / rate) <= highest
    # Parseval: every line but the mean counts twice; the one at half the rate lies above any ``highest`` here
    energy = np.abs(lines[..., 0]) ** 2 + 2.0 * (np.abs(lines[..., 1:][..., chosen[1:]]) ** 2).sum(axis=-1)
    return level(energy.sum(axis=0) / size**2)


def spectrum(sources: NDArray[np.float64], rate: float, step: float, last: float) -> NDArray[np.float64]:
    """Levels (dB) of one microphone's sources (sources, size) at 0, ``step``, ... ``last`` Hz."""
    squares = sum(amplitude_spectrum(source, rate, step)[1] ** 2 for source in sources)
    return level(squares)[: round(last / step) + 1]


def line(sources: NDArray[np.float64], rate: float, frequency: float) -> float:
    """Level (dB) of the line at ``frequency`` (Hz) in one microphone's sources (sources, size).

    Largest value within 0.4 % of it, seen through one Hann window over the whole recording: lines closer
    than two windows (4 / duration) merge.
    """
    size = sources.shape[-1]
    window = np.hanning(size)
    time = np.arange(size) / rate
    around = frequency * (1.0 + _SEARCH * np.linspace(-1.0, 1.0, _STEPS))
    turn = np.exp(-2j * np.pi * around[:, None] * time) * (window * np.sqrt(2.0) / window.sum())
    mean = sources.mean(axis=-1, keepdims=True)
    return float(level((np.abs((sources - mean) @ turn.T) ** 2).sum(axis=0).max()))


def a_weighted(pressure: NDArray[np.float64], rate: float) -> NDArray[np.float64]:
    """A-weighted pressure; the filter rests at the first sample, so leave out the first milliseconds."""
    return sosfilt(a_weighting_sections(rate), pressure, axis=-1)
