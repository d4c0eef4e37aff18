"""Levels, spectra, third octaves and lines of a recording in one call, and their files."""

import itertools
import math
import pathlib
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.audio import write_wav
from fmu_bearing.acoustics.analysis.field import Position
from fmu_bearing.acoustics.analysis.lines import Line
from fmu_bearing.extras import available, need
from fmu_bearing.progress import Tell, silent
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.microphone_places import Places
from fmu_bearing.recording.channels.sources import centre_of
from fmu_bearing.recording.measurements import measure, pictures, tables
from fmu_bearing.recording.measurements.signals import signals_at
from fmu_bearing.results.base import Quantity, Result, table, write_netcdf
from fmu_bearing.results.levels import decibels
from fmu_bearing.results.picture_parts import COLOURS, save
from fmu_bearing.results.table import Table, markdown, write_csv

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

_SETTLE = 0.02  # s left to filters of third octaves, at most a fifth of the recording
_LINES = 12
_BARS = 8  # microphones side by side in a picture
_TURNS = 10  # of the shaft in a block of an order map; fewer where there would be less than
_BLOCKS = 8  # of them, one after the other


def _part(name: str) -> Quantity:
    """Return the level of one component."""
    return Quantity(f"laeq_{name}_dB [dB(A)]", f"{name}, dB(A)", decibels, of=lambda row: row.parts.get(name))


@dataclass(frozen=True)
class MicrophoneLevels(Result):
    """Equivalent levels at one microphone, and in dB(A) those of the components that are known alone."""

    quantities = (
        Quantity("microphone", "microphone"), Quantity("leq_dB", "Leq, dB", decibels),
        Quantity("laeq_dB [dB(A)]", "LAeq, dB(A)", decibels), *map(_part, list(COLOURS)[1:]),
    )  # fmt: skip

    microphone: str
    leq: float
    laeq: float
    parts: dict[str, float]

    def summary(self) -> dict[str, Any]:
        """Return the levels that are known, for machines."""
        return {key: value for key, value in super().summary().items() if value is not None}


@dataclass(frozen=True)
class SoundAnalysis(Result):
    """Levels, spectra and lines at the microphones of a recording."""

    names: tuple[str, ...]
    """Microphones."""
    levels: NDArray[np.float64]
    """Equivalent level in dB and dB(A), as `ChannelHistory.levels` computes it. Shape (mics, 2)."""
    parts: dict[str, NDArray[np.float64]]
    """Level (dB(A)) of each component alone; empty for a recording of pressures. Shape (mics,)."""
    frequency: NDArray[np.float64]
    """In Hz. Shape (bins,)."""
    spectra: dict[str, NDArray[np.float64]]
    """Levels (dB) of the total and of each component. Shape (mics, bins)."""
    bands: NDArray[np.float64]
    """Centres of third octaves (Hz). Shape (bands,)."""
    third_octaves: NDArray[np.float64]
    """In dB. Shape (mics, bands)."""
    third_octave_parts: dict[str, NDArray[np.float64]]
    """Those (dB) of each component alone; empty for a recording of pressures. Shape (mics, bands)."""
    lines: list[Line]
    """Strongest lines at the first microphone; empty where the bearing is not known or the speed changes."""
    positions: tuple[Position, ...]
    """Places (m) of the microphones."""

    def records(self) -> tuple[MicrophoneLevels, ...]:
        """Return the levels at each microphone."""
        return tuple(
            MicrophoneLevels(name, z, a, {part: float(values[k]) for part, values in self.parts.items()})
            for k, (name, (z, a)) in enumerate(zip(self.names, self.levels.tolist(), strict=True))
        )

    def rows(self) -> Table:
        """Columns and rows of a table of levels; a dash for a component that is silent."""
        parts = (f"{name}, dB(A)" for name in self.parts)
        return table(MicrophoneLevels, self.records(), ["microphone", "Leq, dB", "LAeq, dB(A)", *parts])

    def summary(self) -> dict[str, Any]:
        """Return levels by microphone, for machines."""
        return {one.microphone: one.summary() for one in self.records()}

    def to_xarray(self) -> "xarray.Dataset":
        """Return spectra and third octaves with microphones and sources as coordinates."""
        xr = need("xarray", "a dataset")
        spectra = np.stack([self.spectra[name] for name in self.spectra])
        every = {"total": self.third_octaves} | self.third_octave_parts
        thirds = np.stack([every[name] for name in self.spectra])
        decibel = {"units": "dB", "long_name": "level re 20 uPa"}
        return xr.Dataset(
            {
                "spectrum": (("source", "microphone", "frequency"), spectra, decibel),
                "third_octaves": (("microphone", "band"), self.third_octaves, decibel),
                "third_octaves_by_source": (("source", "microphone", "band"), thirds, decibel),
                "leq": ("microphone", self.levels[:, 0], decibel),
                "laeq": ("microphone", self.levels[:, 1], decibel | {"units": "dB(A)"}),
            },
            {
                "source": list(self.spectra),
                "microphone": list(self.names),
                "frequency": ("frequency", self.frequency, {"units": "Hz"}),
                "band": ("band", self.bands, {"units": "Hz", "long_name": "third-octave centre"}),
            },
        )


def analyse_sound(
    recording: ChannelHistory,
    microphones: Places = None,
    radiation_model: str | None = None,
    resolution: float | None = None,
) -> SoundAnalysis:
    """Measure levels, spectra, third octaves and lines at the scene's microphones.

    Parameters
    ----------
    recording : ChannelHistory
    microphones : sequence of str or (x, y, z), optional
        Names of some of them, or places (m); default: all.
    radiation_model : str, optional
        In place of the recording's.
    resolution : float, optional
        Of the spectra (Hz); default: 5, or what a shorter recording allows.

    Raises
    ------
    ValueError
        For an unknown microphone, or a recording too short for the resolution.
    """
    names, places = zip(*recording.named(microphones), strict=True)
    signals = signals_at(recording, microphones, radiation_model)
    frequency, spectra = signals.spectra(resolution or measure.fine(recording))
    bands, octaves = signals.third_octaves(min(_SETTLE, 0.2 * recording.size / recording.rate))
    lines = (
        []
        if recording.scene is None or recording.changes_speed
        else measure.strongest(recording, frequency, spectra["total"][0], _LINES)
    )
    weighted = signals.levels("A")
    levels = np.column_stack([signals.levels("Z")["total"], weighted.pop("total")])
    thirds = octaves.pop("total")
    return SoundAnalysis(names, levels, weighted, frequency, spectra, bands, thirds, octaves, lines, places)


def write_all(
    recording: ChannelHistory,
    analysis: SoundAnalysis,
    folder: pathlib.Path,
    radiation_model: str | None = None,
    wav: bool = True,
    directivity: bool = True,
    tell: Tell = silent,
    wav_format: str = "float",
) -> list[pathlib.Path]:
    """Write tables (CSV) and sounds (WAV), and as far as installed pictures (PNG) and spectra (netCDF).

    Where the speed changes, levels over order and speed at the first microphone are among them.

    Parameters
    ----------
    recording, found
        As given to and returned by `analyse_sound`.
    folder : Path
        Made where it is missing.
    radiation_model : str, optional
        For the directivity.
    wav, directivity : bool
        Whether to write these; a recording of pressures has no directivity.
    tell : callable
        Takes a line about each file that is left out.
    wav_format : str
        Of the samples, as of `write_wav`.

    Returns
    -------
    list of Path
        Files written.
    """
    drawn = available("matplotlib", "a picture", "pictures", tell)
    made = _Made(recording, analysis, folder, radiation_model, drawn, tell)
    made.table("levels.csv", analysis.rows())
    first = {name: levels[0] for name, levels in analysis.spectra.items()}
    made.table("spectrum.csv", tables.spectrum_table(analysis.frequency, first))
    thirds = dict(zip(analysis.names, analysis.third_octaves, strict=True))
    alone = {
        f"{name} {part}": levels[k]
        for k, name in enumerate(analysis.names)
        for part, levels in analysis.third_octave_parts.items()
    }
    made.table("third-octaves.csv", tables.third_octave_table(analysis.bands, thirds | alone))
    made.picture("spectrum.png", partial(spectra_picture, recording, analysis))
    bars = partial(pictures.third_octave_picture, analysis.bands, *_loudest(analysis, thirds))
    made.picture("third-octaves.png", partial(bars, recording.excitation_end))
    if analysis.lines:
        head = f"Strongest lines at {analysis.names[0]}\n\n"
        made.file("lines.md").write_text(head + markdown(*tables.lines_table(analysis.lines)), "utf-8")
    if recording.changes_speed:
        _orders(made)
    if wav:
        _sounds(made, wav_format)
    if directivity and recording.history.size:
        _directivity(made)
    netcdf = available("xarray", "netCDF", "spectra.nc", tell)
    if netcdf and available("h5netcdf", "netCDF", "spectra.nc", tell):
        write_netcdf(made.file("spectra.nc"), analysis.to_xarray())
    return made.files


@dataclass
class _Made:
    """A folder with the files of one recording; ``drawn``: pictures too."""

    recording: ChannelHistory
    analysis: SoundAnalysis
    folder: pathlib.Path
    radiation_model: str | None
    drawn: bool
    tell: Tell
    files: list[pathlib.Path] = field(default_factory=list)

    def file(self, name: str) -> pathlib.Path:
        """Return the path of one more file."""
        self.files.append(self.folder / name)
        return self.files[-1]

    def table(self, name: str, table: Table) -> None:
        """Write a table."""
        write_csv(self.file(name), *table)

    def picture(self, name: str, figure: "Callable[[], Figure]") -> None:
        """Draw a picture."""
        if self.drawn:
            save(figure(), self.file(name))


def _loudest(
    analysis: SoundAnalysis, thirds: dict[str, NDArray[np.float64]]
) -> tuple[dict[str, NDArray[np.float64]], str]:
    """Return the microphones whose bars have room in a picture, and what it says of the others."""
    if len(thirds) <= _BARS:
        return thirds, ""
    loud = sorted(np.argsort(-analysis.levels[:, 1])[:_BARS].tolist())
    names = [analysis.names[k] for k in loud]
    return {name: thirds[name] for name in names}, f"the {_BARS} loudest of {len(thirds)} microphones"


def spectra_picture(recording: ChannelHistory, analysis: SoundAnalysis) -> "Figure":
    """Draw the spectra at the first microphone, with the bearing's frequencies; Matplotlib is needed."""
    audible = analysis.frequency <= 20_000.0
    still = recording.scene is not None and not recording.changes_speed
    kinematics = recording.common_kinematics if still else None
    shown = {name: levels[0][audible] for name, levels in analysis.spectra.items()}
    frequency, end = analysis.frequency[audible], recording.excitation_end
    defects = recording.defect_lines() if still else ()
    return pictures.spectrum_picture(
        frequency, shown, kinematics, analysis.names[0], end, analysis.lines, defects
    )


def _sounds(made: _Made, wav_format: str) -> None:
    """Write one WAV file per microphone, all with one scale so that their loudness can be compared."""
    recording, analysis = made.recording, made.analysis
    known = dict(recording.microphones)
    both = zip(analysis.names, analysis.positions, strict=True)
    asked = [name if name in known else place for name, place in both]
    pressures = recording.pressure(asked, made.radiation_model)
    peak = float(np.max(np.abs(pressures)))
    scale = 10.0 ** math.ceil(math.log10(max(peak, 1e-6)))
    for stem, pressure in zip(stems(analysis.names), pressures, strict=True):
        write_wav(made.file(f"{stem}.wav"), pressure, recording.rate, scale, wav_format)


def _orders(made: _Made) -> None:
    """Write the order map at the first microphone."""
    recording, name = made.recording, made.analysis.names[0]
    place = name if name in dict(recording.microphones) else made.analysis.positions[0]
    turns = abs(float(recording.angle[-1] - recording.angle[0])) / (2.0 * math.pi)
    resolution = 1.0 / min(_TURNS, max(1, int(turns / _BLOCKS)))
    try:
        orders = measure.run_up(recording, place, resolution=resolution, radiation_model=made.radiation_model)
    except ValueError as problem:
        made.tell(f"no order map: {problem}")
        return
    made.table("orders.csv", tables.order_table(orders))
    kinematics = recording.common_kinematics
    end = recording.excitation_end
    made.picture("orders.png", partial(pictures.order_picture, orders, kinematics, name, end))


def stems(names: Sequence[str]) -> list[str]:
    """Names of signals as names of files, each its own, also where large and small letters are one.

    A place, ``(0, -300, 0) mm``, is ``at-0--300-0-mm``: programs take a name that begins with a dash for an
    option, and one that begins with a point is hidden.
    """
    taken: set[str] = set()
    files = []
    for name in names:
        plain = re.sub(r"[^\w.-]+|^\.", "-", name)
        plain = f"at{plain}" if plain.startswith("-") else plain
        candidates = itertools.chain([plain], (f"{plain}-{number}" for number in itertools.count(2)))
        files.append(next(stem for stem in candidates if stem.casefold() not in taken))
        taken.add(files[-1].casefold())
    return files


def _directivity(made: _Made) -> None:
    """Write levels in three planes.

    At the distance of the nearest microphone, or where a circle of that radius meets a body at 1 m.
    """
    middle = (centre_of(made.recording.scene), 0.0, 0.0)
    for radius in (min(math.dist(place, middle) for place in made.analysis.positions), 1.0):
        try:
            planes = measure.planes(
                made.recording, radius, count=36, weighting="A", radiation_model=made.radiation_model
            )
        except ValueError as problem:
            made.tell(f"no directivity at {1e3 * radius:.0f} mm: {problem}")
            continue
        where = f"at {1e3 * radius:.0f} mm"
        made.table("planes.csv", tables.round_table(planes, f" {where}"))
        made.picture("planes.png", partial(pictures.planes_picture, planes, where))
        return
