"""Signals that an envelope analysis takes by default, and the files of its results."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np

from fmu_bearing.extras import available
from fmu_bearing.progress import Tell, silent
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.recorded_signals import ACCELERATION, recorded_signal, signal_names
from fmu_bearing.recording.measurements.envelope import Envelope
from fmu_bearing.recording.measurements.envelope_lines import EnvelopeLine
from fmu_bearing.recording.measurements.kurtogram import Band
from fmu_bearing.recording.measurements.sound_analysis import stems
from fmu_bearing.recording.measurements.uff_files import write_signals
from fmu_bearing.results.base import table, write_rows
from fmu_bearing.results.picture_parts import save
from fmu_bearing.results.table import Table, write_csv

#: What may be written into a folder.
FILES = (
    "envelope-*.csv",
    "envelope-*.png",
    "lines-*.csv",
    "kurtogram-*.csv",
    "kurtogram-*.png",
    "signals.uff",
)
#: Columns that a terminal has room for.
_COLUMNS = ("line", "of", "Hz", "found at, Hz", "of the mean, %", "over the median, dB")
_MOST = 12  # lines of a table, names in a message


def usual_signals(recording: ChannelHistory) -> list[str]:
    """Return the signals that an envelope analysis takes without names.

    Its accelerometers; without any both radial accelerations of the outer ring of each bearing, as the one
    across the load sees little of a defect; of rings that a rigid housing holds, those of the inner ring. Of
    a recording of pressures the microphones; of a measured record its sole column beside time and speed, of
    several those that are named acceleration or have its unit.

    Raises
    ------
    ValueError
        Where there are none of these.
    """
    found = list(recording.accelerometers)
    if found:
        return found
    names = signal_names(recording)
    for ring in ("outer_ring", "inner_ring"):
        ends = tuple(f"{ring}.acceleration.{way}" for way in "yz")
        own = [name for name in names if name.endswith(ends)]
        found = [name for name in own if np.ptp(recorded_signal(recording, name).values) > 0.0]
        if found:
            return found
    found = [name for name, _ in recording.microphones]
    if found:
        return found
    columns = [name for name in names if name != "shaft_speed"]
    found = [name for name in columns if _accelerates(recording, name)] if len(columns) > 1 else columns
    if not found:
        shown = ", ".join(columns[:_MOST]) + (f" and {len(columns) - _MOST} more" if columns[_MOST:] else "")
        raise ValueError(
            "there is neither an acceleration nor a microphone here, whose envelope is usual: name signals "
            f"(--signal); there are {shown or 'none, as no variable was kept at even times'}"
        )
    return found


def _accelerates(recording: ChannelHistory, name: str) -> bool:
    """Whether a column is an acceleration by its name or its unit."""
    return "acceleration" in name.casefold() or recording.units.get(name) == ACCELERATION


def lines_table(found: Envelope) -> Table:
    """Return the lines far over the median, farthest first, as columns and rows of texts."""
    return table(EnvelopeLine, found.far()[:_MOST], _COLUMNS)


def write_envelopes(
    recording: ChannelHistory, envelopes: Sequence[Envelope], folder: Path,
    radiation_model: str | None = None, tell: Tell = silent,
) -> list[Path]:  # fmt: skip
    """Write spectra, lines, kurtograms and signals of envelopes; return the files."""
    files: list[Path] = []
    drawn = available("matplotlib", "a picture", "pictures", tell)
    for stem, one in zip(stems([found.name for found in envelopes]), envelopes, strict=True):
        files.append(write_csv(folder / f"envelope-{stem}.csv", *one.spectrum_table()))
        if one.lines:
            files.append(write_rows(folder / f"lines-{stem}.csv", one.lines))
        pictures = {f"envelope-{stem}.png": one.picture}
        if one.kurtogram is not None:
            columns = table(Band, one.kurtogram.records())
            files.append(write_csv(folder / f"kurtogram-{stem}.csv", *columns))
            pictures[f"kurtogram-{stem}.png"] = partial(one.kurtogram.picture, one.name)
        for name, figure in pictures.items() if drawn else ():
            save(figure(), folder / name)
            files.append(folder / name)
    files.append(
        write_signals(recording, folder / "signals.uff", [one.name for one in envelopes], radiation_model)
    )
    return files
