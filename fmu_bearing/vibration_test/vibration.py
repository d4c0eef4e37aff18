"""The vibration test of a bearing over seeds, with both loading pieces, and each source by itself."""

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.progress import keeping
from fmu_bearing.results.base import Result, table
from fmu_bearing.results.table import Table
from fmu_bearing.scene import Scene, SceneSource
from fmu_bearing.vibration_test.anderon import Unit, micrometres
from fmu_bearing.vibration_test.band import Band
from fmu_bearing.vibration_test.files import picture, write
from fmu_bearing.vibration_test.lines import (
    OrderEnergies,
    VibrationLine,
    by_order,
    digits,
    frequencies,
    named_lines,
    spinning,
)
from fmu_bearing.vibration_test.reading import Reading, levels, reading
from fmu_bearing.vibration_test.remarks import remarks
from fmu_bearing.vibration_test.rig import BANDS, PIECES, Piece, bands, rig
from fmu_bearing.vibration_test.subject import subject

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: One run: words, the scene of the rig.
_Run = tuple[str, Scene]
#: Wraps the list of runs and yields them.
Bar = Callable[[Sequence[_Run]], Iterable[_Run]]
SEEDS = 8
_MOST_SEEDS = 1000
_LINES = 12  # of each band
_FORM = "form of the balls"
_HIGHEST_LIMIT = 1e4  # um/s


@dataclass(frozen=True, eq=False)
class Vibration(Result):
    """What the vibration test of a bearing reads."""

    quantities = (
        "scene = scene.name", "speed_rpm = scene.operation.speed_rpm", "load_N = scene.mounted.preload_N",
        "rings_bend = scene.bends", "seeds [1]", "bands = _by_band", "lines", "remarks",
    )  # fmt: skip

    scene: Scene
    """Of the test, on the soft piece, with the first seed."""
    seeds: tuple[int, ...]
    """Of the surfaces."""
    readings: dict[Piece, tuple[Reading, ...]]
    """Of each seed, by loading piece: ``"soft"``, ``"firm"``."""
    alone: dict[str, Reading]
    """Of each source alone, with the first seed on the soft piece."""
    limits: tuple[float, ...] = ()
    """Of L, M and H, um/s."""

    @property
    def bands(self) -> tuple[Band, ...]:
        """The bands L, M and H."""
        values = {piece: [levels(self.scene, one) for one in ones] for piece, ones in self.readings.items()}
        alone = {source: levels(self.scene, one) for source, one in self.alone.items()}
        limits = dict(zip(BANDS, self.limits, strict=False))
        by_piece = {
            piece: {name: np.array([one[name] for one in ones]) for name in BANDS}
            for piece, ones in values.items()
        }
        return tuple(
            Band(
                name, low, high, by_piece["soft"][name], by_piece["firm"][name],
                {source: one[name] for source, one in alone.items()}, limits.get(name),
            )
            for name, (low, high) in bands(self.scene).items()
        )  # fmt: skip

    @property
    def frequency(self) -> NDArray[np.float64]:
        """Frequencies of the spectra, Hz."""
        return self.readings["soft"][0].frequency

    def spectrum(self, piece: Piece = "soft") -> NDArray[np.float64]:
        """Return the rms velocity of each bin, um/s, root mean square over the seeds."""
        return np.sqrt(np.mean([one.energy for one in self.readings[piece]], axis=0))

    @property
    def lines(self) -> tuple[VibrationLine, ...]:
        """The strongest lines of each band on the soft piece, 12 at most, by band and strongest first."""
        rates = frequencies(self.scene, self.readings["soft"][0])
        if _FORM in self.alone:
            rates = spinning(rates, self.alone[_FORM])
        return named_lines(self.scene, self.frequency, self.spectrum() ** 2, self.alone, rates, _LINES)

    def by_order(self, source: str) -> OrderEnergies:
        """Return the energies of the waves of one source alone, in the bands.

        Raises
        ------
        ValueError
            For a source that the scene does not have.
        """
        if source not in self.alone:
            raise ValueError(f"there is no source '{source}' here; there are {', '.join(self.alone)}")
        energies = self.alone[source]
        rates = frequencies(self.scene, energies)
        return by_order(self.scene, energies, spinning(rates, energies) if source == _FORM else rates, source)

    def anderon(self) -> dict[str, float]:
        """Return the mean of each band on the soft piece, in Anderon."""
        return {band.name: band.mean / micrometres(self.scene)[band.name] for band in self.bands}

    def table(self, unit: Unit = "um/s") -> Table:
        """Return columns and rows for people: each loading piece, the limits, each source alone.

        Parameters
        ----------
        unit : str
            ``"um/s"`` or ``"anderon"``.
        """
        scale = micrometres(self.scene, unit)
        several = len(self.seeds) > 1

        def row(words: str, values: Sequence[float | None]) -> list[str]:
            return [words, *(
                "" if value is None else digits(value / scale[name])
                for name, value in zip(BANDS, values, strict=True)
            )]  # fmt: skip

        bands = self.bands
        rows = []
        for piece in PIECES:
            of = [getattr(band, piece) for band in bands]
            mean = f", mean of {len(self.seeds)} seeds" if several else ""
            rows.append(row(f"{piece} piece{mean}", [float(values.mean()) for values in of]))
            if several:
                ranges = [
                    f"{digits(values.min() / scale[band.name])} to {digits(values.max() / scale[band.name])}"
                    for band, values in zip(bands, of, strict=True)
                ]
                rows.append([f"{piece} piece, range", *ranges])
        if self.limits:
            rows.append(row("limit", [band.limit for band in bands]))
        rows += [row(f"{source} alone", [band.alone[source] for band in bands]) for source in self.alone]
        return [unit, *(f"{band.name}, {band.low:g} to {band.high:g} Hz" for band in bands)], rows

    def lines_table(self, count: int = _LINES) -> Table:
        """Return columns and rows for people: the strongest lines of each band, ``count`` at most."""
        by_band = ([line for line in self.lines if line.band == band][:count] for band in BANDS)
        return table(VibrationLine, [line for lines in by_band for line in lines])

    def records(self) -> tuple[VibrationLine, ...]:
        """Return `lines`."""
        return self.lines

    def _by_band(self) -> dict[str, dict[str, Any]]:
        """Return the bands by name, with the mean in Anderon."""
        anderon = self.anderon()
        return {band.name: band.summary() | {"mean_anderon": anderon[band.name]} for band in self.bands}

    @property
    def remarks(self) -> tuple[str, ...]:
        """What to know of these figures, a sentence each."""
        bands = self.bands
        means = {band.name: (band.mean, float(band.firm.mean())) for band in bands}
        limits = {band.name: band.limit for band in bands if band.limit is not None}
        spin = frequencies(self.scene, self.readings["soft"][0]).f_b
        return tuple(remarks(self.scene, spin, means, limits))

    def picture(self, unit: Unit = "um/s") -> "Figure":
        """Draw the bands as bars, with their range over the seeds and the limits."""
        several = f", {len(self.seeds)} seeds" if len(self.seeds) > 1 else ""
        title = f"{self.scene.name}, vibration test{several}"
        return picture(title, self.bands, micrometres(self.scene, unit), unit)

    def save(self, folder: str | os.PathLike[str], unit: Unit = "um/s") -> list[Path]:
        """Write ``bands.png``, ``lines.csv`` and ``spectrum.csv`` into a folder, which is made.

        ``spectrum.csv`` has the rms velocity of each bin on both pieces, and of each source alone.

        Returns
        -------
        list of Path
        """
        spectra = {"frequency, Hz": self.frequency}
        spectra |= {f"{piece} piece, um/s": self.spectrum(piece) for piece in PIECES}
        spectra |= {f"{name} alone, um/s": np.sqrt(one.energy) for name, one in self.alone.items()}
        return write(Path(folder), self.picture(unit), self.lines, spectra)


def vibration(
    source: SceneSource,
    seeds: int = SEEDS,
    *,
    kind: str | None = None,
    grade: str | None = None,
    rigid: bool = False,
    speed_rpm: float | None = None,
    load_N: float | None = None,
    limits: Sequence[float] | None = None,
    unit: Unit = "um/s",
    bar: Bar = iter,
) -> Vibration:
    """Run the vibration test of a bearing: rms velocity of its outer ring in the bands L, M and H.

    Parameters
    ----------
    source : Scene, path or str
        A scene or its file (``.toml``), of a set its bearing; or a bearing of the catalogue by name.
    seeds : int
        How many seeds of the surfaces are run, the scene's own and those after it.
    kind, grade : str, optional
        Materials of a bearing by name (default: ``hybrid``), tolerance class of the surfaces (default: the
        scene's own surfaces; of a bearing by name P4).
    rigid : bool
        Whether the rings stay round: for comparison only.
    speed_rpm, load_N : float, optional
        In place of those of the standard.
    limits : sequence of float, optional
        Of L, M and H, in ``unit``.
    unit : str
        Of the limits: ``"um/s"`` or ``"anderon"``.
    bar : callable
        Wraps the list of runs, to show progress; default: no progress is shown.

    Returns
    -------
    Vibration

    Raises
    ------
    ValueError
        For values that are refused before the first run; see `subject` and `rig`.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with the seeds that are finished as ``readings``.

    Examples
    --------
    >>> from fmu_bearing import vibration, with_fidelity
    >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
    >>> found = vibration(scene, seeds=1, rigid=True)
    >>> [f"{band.name} {band.mean:.0f} um/s" for band in found.bands]
    ['L 26 um/s', 'M 77 um/s', 'H 40 um/s']
    """
    if isinstance(seeds, bool) or not isinstance(seeds, int) or not 1 <= seeds <= _MOST_SEEDS:
        raise ValueError(f"seeds = {seeds}: give a whole number from 1 to {_MOST_SEEDS}")
    given = subject(source, kind, grade)
    rigs = {
        piece: rig(given, piece=piece, rigid=rigid, speed_rpm=speed_rpm, load_N=load_N) for piece in PIECES
    }
    first = rigs["soft"]
    allowed = checked_values(limits, first, unit, "limits") if limits is not None else ()
    flaws = first.imperfections
    assert flaws is not None, "a subject has imperfections"
    drawn = [flaws, *flaws.redrawn(seeds - 1)]
    runs: list[_Run] = [
        (piece, rigs[piece].model_copy(update={"imperfections": one})) for one in drawn for piece in PIECES
    ]
    runs += [(one, first.model_copy(update={"imperfections": flaws.alone(one)})) for one in flaws.sources]
    readings: dict[str, list[Reading]] = {name: [] for name, _ in runs}
    whole = readings[PIECES[-1]]  # a seed is run on all pieces, on this one last

    def study() -> Vibration:
        return Vibration(
            first,
            tuple(one.seed for one in drawn[: len(whole)]),
            {piece: tuple(readings[piece][: len(whole)]) for piece in PIECES},
            {one: readings[one][0] for one in flaws.sources if readings[one]},
            allowed,
        )

    def missing() -> str:
        left = [f"{seeds - len(whole)} of {seeds} seeds"] if len(whole) < seeds else []
        return ", ".join([*left, *(f"{one} alone" for one in flaws.sources if not readings[one])])

    with keeping(whole, study, missing):
        for name, scene in bar(runs):
            readings[name].append(reading(scene))
    return study()


def checked_values(values: Sequence[float], scene: Scene, unit: Unit, name: str) -> tuple[float, ...]:
    """Return values of L, M and H in um/s.

    Parameters
    ----------
    values : sequence of float
        Three, in ``unit``.
    scene : Scene
        Of the test.
    unit, name : str
        Of the values.

    Raises
    ------
    ValueError
        For other than three values, and such as no bearing has.
    """
    if len(values) != len(BANDS):
        raise ValueError(f"{name}: {len(values)} values: give three, of {', '.join(BANDS)}")
    scale = micrometres(scene, unit)
    checked = tuple(float(value) * scale[band] for band, value in zip(BANDS, values, strict=True))
    for band, value in zip(BANDS, checked, strict=True):
        if not 0.0 < value <= _HIGHEST_LIMIT:
            raise ValueError(
                f"{name}: {band} = {value:g} um/s: give um/s above 0, {_HIGHEST_LIMIT:g} at most, or "
                "Anderon with the unit anderon"
            )
    return checked
