"""Pressures at microphones, in all and of each component alone, and what is read of them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import level_spectrum
from fmu_bearing.acoustics.analysis.third_octave import third_octave_levels
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.microphone_places import Places

#: Levels (dB) of all together (``"total"``, first) and of each component alone.
Levels = dict[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Signals:
    """Pressures at places of a recording.

    Attributes
    ----------
    recording : ChannelHistory
    places, radiation_model
        As for `ChannelHistory.pressure`.
    pressures : dict
        In Pa: all together (``"total"``, first), and each component alone; shape (mics, samples).
    """

    recording: ChannelHistory
    places: Places
    radiation_model: str | None
    pressures: dict[str, NDArray[np.float64]]

    def levels(self, weighting: str) -> Levels:
        """Equivalent levels, shape (mics,); in total as `ChannelHistory.levels`."""
        total = self.recording.levels(self.places, self.radiation_model, weighting)
        parts = {
            name: level(self.recording.mean_square(rows, weighting))
            for name, rows in self.pressures.items()
            if name != "total"
        }
        return {"total": total} | parts

    def spectra(
        self, resolution: float, mics: Sequence[int] | slice = slice(None)
    ) -> tuple[NDArray[np.float64], Levels]:
        """Frequencies (Hz), and levels at some of the places, shape (mics, bins)."""
        frequency, levels = np.empty(0), {}
        for name, rows in self.pressures.items():
            read = [level_spectrum(row, self.recording.rate, resolution) for row in rows[mics]]
            frequency, levels[name] = read[0][0], np.array([values for _, values in read])
        return frequency, levels

    def third_octaves(
        self, settle: float, mics: Sequence[int] | slice = slice(None)
    ) -> tuple[NDArray[np.float64], Levels]:
        """Exact centres (Hz), and levels at some of the places, shape (mics, bands).

        ``settle``: time (s) that is left to the filters.
        """
        centres, levels = np.empty(0), {}
        for name, rows in self.pressures.items():
            centres, levels[name] = third_octave_levels(rows[mics], self.recording.rate, settle)
        return centres, levels


def signals_at(recording: ChannelHistory, places: Places, radiation_model: str | None = None) -> Signals:
    """Return the pressures at places; a recording of pressures has those of no component."""
    if recording.history.size:
        parts = recording.partial(places, radiation_model)
        pressures = {"total": sum(parts.values(), np.zeros_like(next(iter(parts.values()))))} | parts
    else:
        pressures = {"total": recording.pressure(places)}
    return Signals(recording, places, radiation_model, pressures)
