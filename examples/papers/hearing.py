"""Levels of a recording, source by source.

Most rungs add pressures: a component is one source, the total is the coherent sum. The rung ``paper`` adds
energies: each component is several sources (multi-source paper, eqs. 43 and 46).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.signal import sosfilt

from fmu_bearing.acoustics.field import Channels, circles
from fmu_bearing.acoustics.spectrum import amplitude_spectrum
from fmu_bearing.acoustics.stream import radiators_of
from fmu_bearing.acoustics.weighting import a_weighting_sections, level
from fmu_bearing.engine.sound.places import COMPONENTS
from fmu_bearing.study.heard import air_of
from fmu_bearing.study.recording import Recording

Sources = dict[str, NDArray[np.float64]]
NAMES = {"inner_ring": "inner ring", "outer_ring": "outer ring", "cage": "cage", "balls": "balls"}
_SEARCH = 0.004  # relative: how far from its frequency a line is looked for
_STEPS = 9


def heard(recording: Recording, positions: Sequence[Sequence[float]], rung: str) -> Sources:
    """Pressures (Pa) of each component's sources, shape (sources, mics, size) by component, and ``total``.

    Within an entry energies add: the total of a vector rung is one coherent sum, the total of rung ``paper``
    all its sources.
    """
    if rung != "paper":
        parts = recording.partial(positions, rung)
        found = {name: part[None] for name, part in parts.items()}
        return found | {"total": np.sum(list(parts.values()), axis=0)[None]}
    scene = recording.scene
    assert scene is not None
    channels = Channels(recording.history)
    lists: dict[str, list[NDArray[np.float64]]] = {}
    places = [(float(x), float(y), float(z)) for x, y, z in positions]
    known: dict[int, dict[int, NDArray[np.float64]]] = {}
    component: dict[int, int] = {}
    for circle in circles(rung, radiators_of(scene), air_of(scene), places, recording.harmonics):
        component |= {path.channel: path.component for path in circle.paths}
        parts = channels.pressures(circle, lambda path: path.channel)
        for channel, part in parts.items():
            cut = part[:, recording.first : recording.first + recording.size]
            known.setdefault(channel, {}).update(zip(circle.members, cut, strict=True))
    for channel, rows in known.items():
        signal = np.array([rows[i] for i in range(len(places))])
        lists.setdefault(COMPONENTS[component[channel]], []).append(signal)
    found = {name: np.array(rows) for name, rows in lists.items()}
    return found | {"total": np.concatenate(list(found.values()))}


def equivalent(sources: NDArray[np.float64]) -> NDArray[np.float64]:
    """Equivalent level (dB) at each microphone, shape (mics,), of sources (sources, mics, size)."""
    return level((sources**2).mean(axis=2).sum(axis=0))


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
