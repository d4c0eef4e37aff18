"""Which source makes the noise at a frequency: by component, and by the line that is nearest to it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.lines import KinematicLine, Line, nearest_line, separable, tolerance
from fmu_bearing.acoustics.analysis.third_octave import EDGE, nominal_frequency
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.measurements.measure import known_lines, strongest
from fmu_bearing.recording.measurements.sound_analysis import SoundAnalysis
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.table import Table

#: What a kinematic frequency arises from, by its carrier.
_ARISES = {
    "f_r": "unbalance",
    "f_i": "waves of the inner race",
    "f_o": "waves of the outer race, and the balls passing",
    "f_b": "form of the balls",
    "f_c": "the cage, or one ball larger than the others",
    "f_w": "the whirl of the cage",
}


@dataclass(frozen=True)
class NoiseAt(Result):
    """Who makes the noise in the third octave that holds a frequency."""

    quantities = (
        "frequency_Hz", "third_octave_Hz = band", Quantity("levels_dB", of=lambda one: {
            name: {source: row[k] for source, row in one.levels.items()} for k, name in enumerate(one.names)
        }),
        Quantity("line [Hz, dB]", of=lambda one: _values(one.line)),
        Quantity("strongest [Hz, dB]", of=lambda one: _values(one.strongest)),
        Quantity("nearest [Hz]", of=lambda one: None if one.nearest is None else {
            "frequency_Hz": one.nearest.frequency, "name": one.nearest.name,
        }),
        "words = sentences",
    )  # fmt: skip

    frequency: float
    band: float
    """Hz: the one asked for, and the nominal centre of its third octave."""
    names: tuple[str, ...]
    """Microphones."""
    levels: dict[str, NDArray[np.float64]]
    """Level (dB) in the third octave, in total and of each component alone. Shape (mics,)."""
    line: Line | None
    """The line in the band that is nearest to the frequency, at the microphone that is loudest in the band;
    None where none stands out."""
    nearest: KinematicLine | None
    """The kinematic frequency nearest to that line, or to the frequency; None where the bearing is unknown.
    """
    excitation_end: float | None
    """Hz: above it no surface of the scene excites the bearing."""
    strongest: Line | None = None
    """The strongest line in the band at that microphone."""

    @property
    def loudest(self) -> int:
        """Place of the microphone that is loudest in the band."""
        return int(np.argmax(self.levels["total"]))

    def rows(self) -> Table:
        """Columns and rows of a table for people; what is below 0 dB is a dash."""
        columns = ["microphone", *(f"{name.replace('_', ' ')}, dB" for name in self.levels)]
        shown = [
            [f"{level:.1f}" if level > 0.0 else "-" for level in row]
            for row in np.array([*self.levels.values()]).T
        ]
        return columns, [[name, *row] for name, row in zip(self.names, shown, strict=True)]

    def sentences(self) -> list[str]:
        """Return which component and which line make the noise, and what excites that line."""
        said = []
        parts = {name: float(row[self.loudest]) for name, row in self.levels.items() if name != "total"}
        if parts:
            first, *rest = sorted(parts, key=lambda name: -parts[name])
            ahead = f", {parts[first] - parts[rest[0]]:.1f} dB above the next" if rest else ""
            said.append(f"at {self.names[self.loudest]} {first.replace('_', ' ')} radiates most{ahead}")
        end = self.excitation_end
        if end is not None and self.frequency > end:
            return [*said, f"no surface of the scene excites it: they end at {1e-3 * end:.3g} kHz"]
        if self.line is None and self.nearest is None:
            return said  # neither bearing nor speed is known, or the speed changes
        if self.line is None:
            return [*said, "no line stands out in the band", self._unexplained(self.frequency)]
        said.append(f"the nearest line is at {self.line.frequency:.1f} Hz, {self.line.level:.1f} dB")
        if not self.line.name:
            said.append(self._unexplained(self.line.frequency))
        elif self.line.words == self.line.name:
            said.append(f"it is {self.line.name}: {_source(self.line.name)}")
        else:
            said.append(
                f"the simplest of {self.line.fits} multiples and sums of kinematic frequencies that fit is "
                f"{self.line.name}: {_source(self.line.name)}"
            )
        most = self.strongest
        if most is not None and most.frequency != self.line.frequency:
            words = f": {most.words}" if most.name else ""
            said.append(
                f"the strongest line of the third octave is at {most.frequency:.1f} Hz, {most.level:.1f} dB"
                + words
            )
        return said

    def _unexplained(self, place: float) -> str:
        """Return what is nearest to a place (Hz) that no kinematic frequency explains."""
        if self.nearest is None:
            return "no kinematic frequency fits"
        away = place - self.nearest.frequency
        return (
            f"no kinematic frequency fits; the nearest is {self.nearest.name}, {abs(away):.1f} Hz "
            f"{'below' if away > 0.0 else 'above'}: {_source(self.nearest.name)}"
        )


def noise_at(recording: ChannelHistory, analysis: SoundAnalysis, frequency: float) -> NoiseAt:
    """Return which component and which line make the noise at a frequency.

    Parameters
    ----------
    recording, found
        As given to and returned by `analyse_sound`.
    frequency : float
        Hz, in one of the third octaves that were measured.

    Raises
    ------
    ValueError
        For a frequency beside the third octaves.
    """
    low, high = analysis.bands[0] / EDGE, analysis.bands[-1] * EDGE
    if not low <= frequency <= high:
        raise ValueError(f"at {frequency:g} Hz: there are third octaves from {low:.3g} to {high:.5g} Hz only")
    place = int(np.argmin(np.abs(np.log(analysis.bands / frequency))))
    centre = float(analysis.bands[place])
    levels = {"total": analysis.third_octaves[:, place]}
    levels |= {name: values[:, place] for name, values in analysis.third_octave_parts.items()}
    line, most, nearest = None, None, None
    if recording.scene is not None and not recording.changes_speed:
        spectrum = analysis.spectra["total"][int(np.argmax(levels["total"]))]
        lines = strongest(recording, analysis.frequency, spectrum, len(analysis.frequency))
        inside = [one for one in lines if centre / EDGE <= one.frequency <= centre * EDGE]
        most = inside[0] if inside else None
        line = min(inside, key=lambda one: abs(one.frequency - frequency), default=None)
        about = frequency if line is None else line.frequency
        known = known_lines(recording, float(analysis.frequency[-1]))
        within = tolerance(about, float(analysis.frequency[1]))
        nearest = nearest_line(about, separable(known, within))
    return NoiseAt(
        frequency, nominal_frequency(centre), analysis.names, levels, line, nearest,
        recording.excitation_end, most,
    )  # fmt: skip


def _values(line: Line | None) -> dict[str, float | int | str] | None:
    """Return a line's values for JSON; None where there is none."""
    if line is None:
        return None
    return {
        "frequency_Hz": line.frequency, "level_dB": line.level, "explained_by": line.name, "fits": line.fits,
    }  # fmt: skip


def _source(name: str) -> str:
    """Return what a kinematic line arises from: its name begins with its carrier, maybe with a factor."""
    return next(words for carrier, words in _ARISES.items() if carrier in name.split(" ")[:2])
