"""Pressures, levels and spectra at the microphones, computed once for several sections."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import level_spectrum
from fmu_bearing.acoustics.analysis.third_octave import nominal_frequency, third_octave_levels
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Absent
from fmu_bearing.results.levels import ROUNDING

#: Microphones with spectra and sound of their own, and those in tables.
SHOWN, LISTED = 4, 48
_FINEST = 5.0  # Hz
_SETTLE = 0.25  # of the recording, at most 0.1 s: third-octave filters settle


@dataclass(eq=False)
class Microphones:
    """Pressures at the scene's microphones, whole and by component.

    Attributes
    ----------
    subject : Subject
    names : list of str
        Of the microphones listed.
    positions : list of (x, y, z)
        In m.
    parts : dict
        Pressure (Pa) of each component, shape (microphones, samples); empty for a recording of pressures.
    pressure : ndarray, shape (microphones, samples)
        All together (Pa).
    """

    subject: Subject
    names: list[str]
    positions: list[tuple[float, float, float]]
    parts: dict[str, NDArray[np.float64]]
    pressure: NDArray[np.float64]

    @property
    def rate(self) -> float:
        """Samples per second."""
        return self.subject.recording.rate

    @cached_property
    def components(self) -> list[str]:
        """``"total"``, then the components that are not silent but for rounding."""
        squares = {name: np.mean(part**2, axis=1) for name, part in self.parts.items()}
        return ["total", *(name for name, values in squares.items() if level(values).max() >= ROUNDING)]

    @cached_property
    def shown(self) -> list[int]:
        """Places in the list of those with spectra: all if few, else evenly spread."""
        count = len(self.names)
        if count <= SHOWN:
            return list(range(count))
        return [round(k * count / SHOWN) for k in range(SHOWN)]

    def signal(self, component: str) -> NDArray[np.float64]:
        """Pressures (Pa) of a component or of all, shape (microphones, samples)."""
        return self.pressure if component == "total" else self.parts[component]

    @cached_property
    def levels(self) -> dict[str, dict[str, NDArray[np.float64]]]:
        """Equivalent levels (dB) by weighting ``"Z"``, ``"A"`` and component, at each microphone.

        Totals are the recording's own; radiation models of the papers add energies there.
        """
        recording, levels = self.subject.recording, {}
        for weighting in ("Z", "A"):
            if recording.history.size:
                total = recording.levels(self.positions, self.subject.radiation_model, weighting)
            else:  # places may be unknown
                total = level(recording.mean_square(self.pressure, weighting))
            levels[weighting] = {"total": total}
            for name in self.components[1:]:
                levels[weighting][name] = level(recording.mean_square(self.parts[name], weighting))
        return levels

    @property
    def resolution(self) -> float:
        """Spacing of lines in spectra (Hz)."""
        return max(_FINEST, self.rate / self.subject.recording.size)

    @cached_property
    def spectra(self) -> dict[str, list[tuple[NDArray[np.float64], NDArray[np.float64]]]]:
        """Frequencies (Hz) and levels (dB) by component, at each of `shown`."""
        return {
            name: [level_spectrum(self.signal(name)[k], self.rate, self.resolution) for k in self.shown]
            for name in self.components
        }

    @cached_property
    def third_octaves(self) -> tuple[list[float], dict[str, NDArray[np.float64]]]:
        """Nominal frequencies (Hz), and levels (dB) by component, shape (shown, bands)."""
        settle = min(0.1, _SETTLE * self.subject.recording.size / self.rate)
        levels, centres = {}, np.empty(0)
        for name in self.components:
            centres, levels[name] = third_octave_levels(self.signal(name)[self.shown], self.rate, settle)
        return [nominal_frequency(centre) for centre in centres], levels

    @property
    def third_octave_time(self) -> float:
        """Time (s) over which third octaves are averaged."""
        whole = self.subject.recording.size / self.rate
        return whole - min(0.1, _SETTLE * whole)

    @property
    def loudest(self) -> int:
        """Place in the list of the microphone with the largest A-weighted level."""
        return int(np.argmax(self.levels["A"]["total"]))


def at_microphones(subject: Subject) -> Microphones:
    """Compute the pressures at the recording's microphones.

    Raises
    ------
    Absent
        When there are none.
    """
    recording = subject.recording
    places = list(recording.microphones)[:LISTED]
    if not places:
        raise Absent(
            "the scene has no microphones: add [[sound.microphone]] to it, or give places to `measure` "
            "(see the "
            "page on analysis)"
        )
    names, positions = [name for name, _ in places], [place for _, place in places]
    if not recording.history.size:
        return Microphones(subject, names, positions, {}, recording.recorded[: len(places)])
    parts = recording.partial(positions, subject.radiation_model)
    pressure = sum(parts.values(), np.zeros((len(places), recording.size)))
    return Microphones(subject, names, positions, parts, pressure)
