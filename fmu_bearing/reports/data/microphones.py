"""Pressures, levels and spectra at the microphones, computed once for several sections."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.lines import Line, strongest_lines
from fmu_bearing.acoustics.analysis.third_octave import nominal_frequency
from fmu_bearing.recording.measurements.measure import fine, strongest
from fmu_bearing.recording.measurements.signals import Levels, Signals, signals_at
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Absent
from fmu_bearing.results.levels import ROUNDING

#: Microphones with spectra and sound of their own, and those in tables.
SHOWN, LISTED = 4, 48
LINES = 12  # strongest lines of a microphone that the page names
#: Hz: ends of frequency axes that a page can open with; the last is the end of the audible range.
ENDS = (1000.0, 5000.0, 10_000.0, 20_000.0)
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
    signals : Signals
        Pressures at them.
    """

    subject: Subject
    names: list[str]
    positions: list[tuple[float, float, float]]
    signals: Signals

    @property
    def rate(self) -> float:
        """Samples per second."""
        return self.subject.recording.rate

    @property
    def pressure(self) -> NDArray[np.float64]:
        """All together (Pa), shape (microphones, samples)."""
        return self.signals.pressures["total"]

    @cached_property
    def levels(self) -> dict[str, Levels]:
        """Equivalent levels (dB) by weighting ``"Z"``, ``"A"`` and component, at each microphone."""
        return {weighting: self.signals.levels(weighting) for weighting in "ZA"}

    @cached_property
    def components(self) -> list[str]:
        """``"total"``, then the components that are not silent but for rounding."""
        parts = [name for name in self.signals.pressures if name != "total"]
        return ["total", *(name for name in parts if self.levels["Z"][name].max() >= ROUNDING)]

    @cached_property
    def shown(self) -> list[int]:
        """Places in the list of those with spectra: all if few, else evenly spread."""
        count = len(self.names)
        if count <= SHOWN:
            return list(range(count))
        return [round(k * count / SHOWN) for k in range(SHOWN)]

    @property
    def _heard(self) -> Signals:
        pressures = {name: self.signals.pressures[name] for name in self.components}
        return replace(self.signals, pressures=pressures)

    @cached_property
    def spectra(self) -> tuple[NDArray[np.float64], Levels]:
        """Frequencies (Hz) and levels (dB) by component, shape (shown, bins)."""
        return self._heard.spectra(fine(self.subject.recording), self.shown)

    @cached_property
    def lines(self) -> list[list[Line]]:
        """Strongest lines of each spectrum shown, explained where the bearing is known."""
        recording, (frequency, levels) = self.subject.recording, self.spectra
        if recording.scene is None:
            return [strongest_lines(frequency, values, LINES) for values in levels["total"]]
        return [strongest(recording, frequency, values, LINES) for values in levels["total"]]

    @property
    def reach(self) -> float:
        """First of `ENDS` (Hz) below which all strongest lines lie, so that a picture opens with them."""
        highest = max((line.frequency for lines in self.lines for line in lines), default=0.0)
        return next((end for end in ENDS if highest < end), ENDS[-1])

    @cached_property
    def third_octaves(self) -> tuple[list[float], Levels]:
        """Nominal frequencies (Hz), and levels (dB) by component, shape (shown, bands)."""
        centres, levels = self._heard.third_octaves(self._settle, self.shown)
        return [nominal_frequency(centre) for centre in centres], levels

    @property
    def _settle(self) -> float:
        return min(0.1, _SETTLE * self.subject.recording.size / self.rate)

    @property
    def third_octave_time(self) -> float:
        """Time (s) over which third octaves are averaged."""
        return self.subject.recording.size / self.rate - self._settle

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
            '(page "Listening to a run: analysis of the sound" of the documentation)'
        )
    names, positions = [name for name, _ in places], [place for _, place in places]
    return Microphones(subject, names, positions, signals_at(recording, names, subject.radiation_model))
