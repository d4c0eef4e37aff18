"""Two scenes, recordings or runs side by side: levels, spectra, loads, angles, torque, keys that differ."""

import html
import math
import os
import pathlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from fmu_bearing.acoustics.analysis.third_octave import nominal_frequency
from fmu_bearing.extras import need
from fmu_bearing.progress import Tell, silent
from fmu_bearing.recording.measurements import pictures
from fmu_bearing.recording.record import DURATION, record
from fmu_bearing.recording.recording import Recording
from fmu_bearing.recording.studies.comparison_data import RECORDED, ComparisonData, of_recording, of_run
from fmu_bearing.recording.studies.finding import SEEDS, Finding, judged
from fmu_bearing.recording.studies.pairs import BandPair, FigurePair, KeyPair, LevelPair
from fmu_bearing.results.base import Quantity, Result, table
from fmu_bearing.results.result import ENDINGS, Run
from fmu_bearing.results.table import Table, html_table, write_csv
from fmu_bearing.results.variable_names import unit_of
from fmu_bearing.run.choose import resolve
from fmu_bearing.run.figures import table_unit
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.values import flat

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: What can be compared: a scene, which is run, or what came of a run; in memory or as a file.
Compared = Recording | Run | SceneSource
SETTLE = 0.1  # s left out at the beginning, in which the start-up dies away
_HIGHEST = 20_000.0  # Hz
_NONE = (math.nan, math.nan)  # dB and dB(A)


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Result):
    """Two finished runs, A and B; differences are B minus A."""

    quantities = (
        Quantity("keys", of=lambda found: {one.key: one.summary() for one in found.differing()}), "a", "b",
    )  # fmt: skip

    a: ComparisonData
    b: ComparisonData
    """What was measured on each: names, levels, spectra, third octaves, figures."""
    keys: dict[str, tuple[Any, Any]]
    """Keys in which the scenes differ, in the units of the keys; None where a scene has no such key. Empty
    where a scene is not known."""

    @property
    def microphones(self) -> list[str]:
        """Names of all microphones, names of A first."""
        return list(self.a.levels | self.b.levels)

    def loudest(self) -> str:
        """Return the microphone of both at which A is loudest in dB(A).

        Raises
        ------
        ValueError
            Where they have no microphone in common.
        """
        both = [name for name in self.a.levels if name in self.b.levels]
        if not both:
            raise ValueError(
                "A and B have no microphone with the same name: give the scenes the same [sound]"
            )
        return max(both, key=lambda name: self.a.levels[name][1])

    def differing(self) -> list[KeyPair]:
        """Return the keys in which the scenes differ."""
        return [KeyPair(key, *pair) for key, pair in self.keys.items()]

    def records(self) -> Sequence[LevelPair | FigurePair]:
        """Return the levels at each microphone; where there is none the means."""
        a, b = self.a.levels, self.b.levels
        levels = [LevelPair(name, *a.get(name, _NONE), *b.get(name, _NONE)) for name in self.microphones]
        return levels or self.means()

    def means(self) -> list[FigurePair]:
        """Return the means of contact loads, contact angles and friction torque."""
        rows = []
        for name in self.a.figures | self.b.figures:
            unit, factor = table_unit(unit_of(name))
            a, b = (factor * side.figures.get(name, math.nan) for side in (self.a, self.b))
            rows.append(FigurePair(name, unit, a, b))
        return rows

    def levels_table(self) -> Table:
        """Levels (dB and dB(A)) of A and B at each microphone, with differences."""
        return table(LevelPair, self.records() if self.microphones else [])

    def third_octaves_table(self, microphone: str | None = None) -> Table:
        """Third-octave levels (dB) of A and B at a microphone; default: `loudest`."""
        name = self._common_microphone(microphone)
        a, b = self.a.third_octaves.get(name, {}), self.b.third_octaves.get(name, {})
        return table(BandPair, [
            BandPair(nominal_frequency(f), a.get(f, math.nan), b.get(f, math.nan))
            for f in sorted(a.keys() | b.keys())
        ])  # fmt: skip

    def figures_table(self) -> Table:
        """Means of contact loads, contact angles and friction torque, with differences."""
        return table(FigurePair, self.means())

    def keys_table(self) -> Table:
        """Keys in which the scenes differ."""
        return table(KeyPair, self.differing())

    def tables(self, microphone: str | None = None) -> dict[str, Table]:
        """All tables that have rows, by title; third octaves at a microphone (default: `loudest`).

        Raises
        ------
        ValueError
            For a microphone that is not in both.
        """
        wanted: dict[str, Callable[[], Table]] = {
            "what differs in the scenes": self.keys_table,
            "levels": self.levels_table,
            "loads, angles, torque": self.figures_table,
        }
        tables = {title: make() for title, make in wanted.items()}
        if microphone is not None or any(name in self.b.third_octaves for name in self.a.third_octaves):
            name = self._common_microphone(microphone)
            tables[f"third octaves at {name}"] = self.third_octaves_table(name)
        return {title: made for title, made in tables.items() if made[1]}

    def plot(
        self, microphone: str | None = None, highest: float = _HIGHEST, title: str | None = None
    ) -> "Figure":
        """Draw the spectra of A and B at a microphone (default: `loudest`), up to ``highest`` (Hz).

        Each has its own panel, with the other one behind it in grey.
        Third octaves are drawn where a run kept no pressures.

        Raises
        ------
        ValueError
            For a microphone that is not in both, or without spectra and third octaves.
        MissingExtra
            Without Matplotlib.
        """
        need("matplotlib", "a picture")
        name = self._common_microphone(microphone)
        heading = f"microphone {name}" if title is None else title
        sides = {f"A: {self.a.name}": self.a, f"B: {self.b.name}": self.b}
        ends = {
            label: side.excitation_end
            for label, side in sides.items()
            if side.excitation_end is not None
        }  # fmt: skip
        if self.a.spectrum is not None and self.b.spectrum is not None:
            frequency = self.a.spectrum.frequency
            shown = frequency[frequency <= highest]
            levels = {
                label: np.interp(shown, side.spectrum.frequency, side.spectrum[name])
                for label, side in sides.items()
                if side.spectrum is not None
            }
            return pictures.sides_picture(shown, levels, heading, ends)
        bands = sorted(self.a.third_octaves.get(name, {}).keys() & self.b.third_octaves.get(name, {}).keys())
        if not bands:
            raise ValueError(
                "there is no spectrum to draw: keep mic[*].pressure at Recording.PRESSURE_STEP, or compare "
                "scenes or recordings"
            )
        rows = {label: [side.third_octaves[name][f] for f in bands] for label, side in sides.items()}
        letters = {label[0]: end for label, end in ends.items()}
        return pictures.third_octave_picture(bands, rows, heading, letters)

    def conditions(self) -> str:
        """Return fidelity and radiation model of A and B, in words."""
        words = [_computed(self.a), _computed(self.b)]
        return words[0] if words[0] == words[1] else f"A: {words[0]}; B: {words[1]}"

    def finding(
        self,
        microphone: str | None = None,
        seeds: int = SEEDS,
        track: Callable[[Sequence[int]], Iterable[int]] = iter,
    ) -> Finding:
        """Judge the difference of the levels at a microphone (default: `loudest`), by short runs.

        Parameters
        ----------
        microphone : str, optional
        seeds : int
            How many draws of the surfaces, the same for A and B; 0: the difference is not judged.
        track : callable
            Passes the draws on one by one, to show progress.

        Raises
        ------
        ValueError
            For a microphone that is not in both.
        """
        return judged(self.a, self.b, self._common_microphone(microphone), seeds, track)

    def doubts(self) -> list[str]:
        """Return why figures of A and of B are in doubt, in sentences; none: they are not."""
        return [f"{letter}: {side.doubt}." for letter, side in (("A", self.a), ("B", self.b)) if side.doubt]

    def save(self, folder: str | os.PathLike[str], microphone: str | None = None) -> list[pathlib.Path]:
        """Write `tables` as CSV into a folder, which is made; return the files."""
        files = []
        for title, made in self.tables(microphone).items():
            stem = title.split(" at ")[0].replace(",", "").replace(" ", "-")
            files.append(write_csv(pathlib.Path(folder) / f"{stem}.csv", *made))
        return files

    def __repr__(self) -> str:
        return f"Comparison(A: {self.a.name}, B: {self.b.name}, {len(self.keys)} keys differ)"

    def _repr_html_(self) -> str:
        lines = (f"{self!r}; {self.conditions()}; differences are B minus A", *self.doubts())
        parts = [f"<p>{html.escape(line)}</p>" for line in lines]
        return "".join(parts + [html_table(title, *made) for title, made in self.tables().items()])

    def _common_microphone(self, microphone: str | None) -> str:
        """Name of a microphone that both have."""
        if microphone is None:
            return self.loudest()
        if microphone not in self.a.levels or microphone not in self.b.levels:
            both = ", ".join(name for name in self.a.levels if name in self.b.levels) or "none"
            raise ValueError(f"A and B do not both have a microphone '{microphone}'; both have {both}")
        return microphone


def compare(
    a: Compared,
    b: Compared,
    *,
    duration: float = DURATION,
    settle: float = SETTLE,
    fidelity: str | None = None,
    radiation_model: str | None = None,
    tell: Tell = silent,
    progress: bool | None = None,
) -> Comparison:
    """Compare two scenes, recordings or runs: sound, loads, angles, torque, and the keys that differ.

    Parameters
    ----------
    a, b : Recording, Run, Scene or path
        Scenes (``.toml``) are recorded; recordings (``.npz``) and runs (``.csv``, ``.nc``) are taken as they
        are. Of a run, levels are read from its meters (``mic[1].leq``), unless it kept ``mic[1].pressure`` at
        `Recording.PRESSURE_STEP`.
    duration, settle : float
        Length (s) of the recording of a scene, and time left out before it.
    fidelity, radiation_model : str, optional
        In place of the scenes' own.
    tell : callable
        Takes a line of text before each piece of work.
    progress : bool, optional
        Progress bars of the runs; default: on a terminal.

    Returns
    -------
    Comparison

    Raises
    ------
    ValueError
        For a file, a time or a choice that is refused.

    Examples
    --------
    >>> from fmu_bearing import compare, read_scene
    >>> light = read_scene("examples/scenes/7003C-bare.toml").replace({"mounting.preload_N": 100})
    >>> found = compare(
    ...     light,
    ...     light.replace({"mounting.preload_N": 400}),
    ...     duration=0.05,
    ...     fidelity="rings",
    ...     radiation_model="compact",
    ... )
    >>> found.keys
    {'mounting.preload_N': (100.0, 400.0)}
    >>> found.b.figures["contact.inner.load_mean"] > 2.0 * found.a.figures["contact.inner.load_mean"]
    True
    """
    sources = [_loaded(source) for source in (a, b)]  # what cannot be read is refused before a run
    sides = [
        _finished(letter, name, source, duration, settle, fidelity, radiation_model, tell, progress)
        for letter, (name, source) in zip("AB", sources, strict=True)
    ]
    scenes = [side.scene for side in sides]
    keys: dict[str, tuple[Any, Any]] = {}
    if scenes[0] is not None and scenes[1] is not None:
        ours, theirs = flat(scenes[0]), flat(scenes[1])
        pairs = {key: (ours.get(key), theirs.get(key)) for key in ours | theirs if key != "name"}
        keys = {key: pair for key, pair in pairs.items() if pair[0] != pair[1]}
    return Comparison(sides[0], sides[1], keys)


def _loaded(source: Compared) -> tuple[str, Recording | Run | Scene]:
    """Return what is compared with the name of its file, read where it is one."""
    if isinstance(source, str | os.PathLike):
        path = pathlib.Path(source)
        if path.suffix == ".npz":
            return path.stem, Recording.load(path)
        if path.suffix in ENDINGS:
            return path.stem, Run.load(path)
        return path.stem, scene_of(source)
    return "", source if isinstance(source, Recording | Run) else scene_of(source)


def _finished(
    letter: str, name: str, source: Recording | Run | Scene, duration: float, settle: float,
    fidelity: str | None, radiation_model: str | None, tell: Tell, progress: bool | None,
) -> ComparisonData:  # fmt: skip
    """Run one side where it is a scene, and measure it."""
    if isinstance(source, Recording | Run):
        if fidelity is not None:
            raise ValueError(
                f"{letter} is a finished run, whose fidelity cannot be changed: give its scene, or leave "
                "fidelity out"
            )
        tell(f"{letter}: {source!r}")
        if isinstance(source, Run):
            return of_run(source, settle, radiation_model)
        return of_recording(source, name, radiation_model)
    scene = source
    require(scene, "comparison")
    if fidelity is not None:
        scene = with_fidelity(scene, model=fidelity)
    if scene.fidelity.model == "auto":
        tell(f"{letter}: fidelity auto: finding the cheapest within the scene's accuracy")
    scene = resolve(scene)[0]
    tell(f"{letter}: running {scene.name}, fidelity {scene.fidelity.model}, for {settle + duration:g} s")
    made = record(
        scene, duration, settle=settle, radiation_model=radiation_model, outputs=RECORDED, progress=progress,
        warn=False,
    )  # fmt: skip
    if scene.microphones:
        tell(f"{letter}: sound at the microphones, radiation model {made.radiation_model}")
    return of_recording(made, name, radiation_model)


def _computed(side: ComparisonData) -> str:
    """Return what a side was computed with, in words."""
    words = [f"fidelity {side.fidelity or 'not known'}"]
    if side.levels:
        words.append(f"radiation model {side.radiation_model or 'not known'}")
    return ", ".join(words)
