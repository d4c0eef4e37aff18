"""Uncertainty of a level: its range over seeds and assumed surfaces, and the largest contribution to it.

The phases of waviness are drawn from a seed that means nothing, and the power law of the surfaces is assumed.
Both are drawn again in cheap runs (fidelity ``response``, rigid rings; ``full`` where a mode is weakly
damped), and the differences of their levels are added to the level in question. Where a surface was found
from a measurement, its draws take the place of the assumed law.
"""

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.cautions import in_doubt
from fmu_bearing.engine.constants import RPM
from fmu_bearing.modal.campbell.doubts import doubt, reason_for_doubt
from fmu_bearing.recording.channels.microphone_places import Places
from fmu_bearing.recording.record import RecordingSource, recording_of
from fmu_bearing.recording.recording import Recording
from fmu_bearing.recording.studies.level_estimator import LevelEstimator, check_model
from fmu_bearing.results.base import Quantity, Result, table
from fmu_bearing.results.table import Table
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import Scene
from fmu_bearing.scene.imperfections import ASSUMED_EXPONENTS, Imperfections
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.surface import Surface, check_taken
from fmu_bearing.scene.surface_file import read_surface

#: Wraps a list of draws and yields them.
Bar = Callable[[Sequence[Imperfections]], Iterable[Imperfections]]
SEEDS = 8
_SEEDS_FULL = 3  # with fidelity full, which costs a hundred times as much
_AROUND = 0.3  # else: this much to either side
_FACTOR = 2.0  # on A_1, either way
#: Draws of a surface that was found; a further one lies between the ends of n with (n - 1) / (n + 1): 95 %.
_DRAWS = 40
_DRAWS_FULL = 6  # with fidelity full: 71 %


@dataclass(frozen=True)
class LevelRange(Result):
    """The level at one microphone (dB, weighted as asked for) and its range, as in `Spread`."""

    quantities = (
        Quantity("microphone", "microphone"),
        Quantity("level_dB"),
        *(Quantity("", unit, ".1f", of=lambda row: row.level) for unit in ("dB", "dB(A)")),
        Quantity("", "range", of=lambda row: f"{row.low:.0f} to {row.high:.0f}"),
        "low_dB", "high_dB", Quantity("seeds_dB", "seeds, dB", ".1f"), "exponent_dB", "amplitude_dB",
        "energy_share [1]", Quantity("decides", "what decides"),
    )  # fmt: skip

    microphone: str
    level: float
    low: float
    high: float
    seeds: float
    exponent: float
    amplitude: float
    energy_share: dict[str, float]
    decides: str


@dataclass(frozen=True)
class Spread(Result):
    """Range of levels over seeds and the assumed surface law."""

    quantities = "strongest_line_Hz = line", "line_stays_in_draws [1] = stays", "doubt"

    names: tuple[str, ...]
    """Microphones."""
    weighting: str
    """``"A"`` or ``"Z"``."""
    levels: NDArray[np.float64]
    """The levels in question (dB). Shape (mics,)."""
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    """Their range over all draws. Shape (mics,)."""
    seeds: NDArray[np.float64]
    exponent: NDArray[np.float64]
    amplitude: NDArray[np.float64]
    """Range (dB) over the seeds; change from the lower to the higher exponent p, and over a factor of 4 in
    A_1 and the form of the balls. Shape (mics,)."""
    sources: dict[str, NDArray[np.float64]]
    """Share of the energy that each imperfection makes alone, by name. Shape (mics,)."""
    line: float
    """Frequency (Hz) of the strongest line at the loudest microphone."""
    stays: tuple[int, int]
    """In how many draws, of how many, that line stays the strongest."""
    drawn: int = SEEDS
    """How many other seeds were drawn."""
    doubt: str = ""
    weak: str = ""
    """Why the levels in question are in doubt; what made fidelity full draw the range."""
    surface: int = 0
    """How many draws of a surface that was found make the range; 0: the law is assumed."""

    @property
    def line_is_found(self) -> bool:
        """Whether the strongest line stays the strongest in most draws."""
        return 2 * self.stays[0] > self.stays[1]

    @property
    def over(self) -> str:
        """What the range is taken over."""
        return "draws of the measured surface" if self.surface else "seeds and assumed surfaces"

    def remark(self) -> str:
        """Return one sentence on what varies in the range."""
        if self.surface:
            share = 100.0 * (self.surface - 1.0) / (self.surface + 1.0)
            return (
                f"Range over {self.surface} draws of the surface that was found: {share:.0f} % of levels lie "
                "within it as far as the surface alone decides." + self._with_full()
            )
        return (
            f"Range over {self.drawn} seeds and, where waviness follows the law, over its exponent and a "
            "factor of two in its amplitude either way, that of the balls too. Both are assumed. It is "
            "the range of what surfaces make, not of what a machine makes besides." + self._with_full()
        )

    def _with_full(self) -> str:
        return f" Drawn with fidelity full, because {self.weak}." if self.weak else ""

    def decides(self, mic: int) -> str:
        """Return what moves the level at a microphone most, and the imperfection that makes most of it."""
        causes = {
            "phases and sizes drawn from the seed": self.seeds[mic],
            "exponent of the surfaces": abs(self.exponent[mic]),
            "amplitude of the surfaces": abs(self.amplitude[mic]),
        }
        if self.surface:
            causes = {"what the measured surface leaves open": self.high[mic] - self.low[mic]}
        cause = max(causes, key=lambda name: causes[name])
        words = f"{cause} ({causes[cause]:.1f} dB)"
        if self.sources:
            source = max(self.sources, key=lambda name: self.sources[name][mic])
            words += f"; {source} {100.0 * self.sources[source][mic]:.0f} % of the energy"
        return words

    def records(self) -> tuple[LevelRange, ...]:
        """Return the level at each microphone with its range."""
        return tuple(
            LevelRange(
                name, float(self.levels[k]), float(self.low[k]), float(self.high[k]), float(self.seeds[k]),
                float(self.exponent[k]), float(self.amplitude[k]),
                {source: float(share[k]) for source, share in self.sources.items()}, self.decides(k),
            )
            for k, name in enumerate(self.names)
        )  # fmt: skip

    def rows(self) -> Table:
        """Columns and rows of a table."""
        unit = "dB(A)" if self.weighting == "A" else "dB"
        heads = ["microphone", unit, "range", "seeds, dB", "what decides"]
        return table(LevelRange, self.records(), heads)

    def summary(self) -> dict[str, Any]:
        """Return the ranges by microphone, for machines."""
        return {one.microphone: one.summary() for one in self.records()} | super().summary()


def spread(
    source: RecordingSource,
    microphones: Places = None,
    *,
    radiation_model: str | None = None,
    weighting: str = "A",
    seeds: int = SEEDS,
    surface: Surface | str | os.PathLike[str] | None = None,
    bar: Bar = iter,
) -> Spread:
    """Find the range of a recording's levels over seeds and the assumed surface law.

    Parameters
    ----------
    source : Recording, Scene or path
        A recording with its scene, at one speed, or its file (``.npz``); or a scene or its file (``.toml``),
        which is recorded for 0.5 s.
    microphones : sequence of str or (x, y, z), optional
        Names of some of the scene's, or places (m); default: all of the scene's.
    radiation_model, weighting
        As for `Recording.levels`.
    seeds : int
        How many other seeds are drawn; 3 at most where a weakly damped mode needs fidelity full.
    surface : Surface or path, optional
        A surface that was found from a measurement, or its file: 40 of its draws make the range (6 where a
        weakly damped mode needs fidelity full) in the place of the assumed law.
    bar : callable
        Wraps the list of draws, to show progress; default: no progress is shown.

    Returns
    -------
    Spread

    Raises
    ------
    ValueError
        Without scene, imperfections or microphones, where the speed changes, and for a surface where a race
        has explicit harmonics.

    Examples
    --------
    >>> from fmu_bearing import record, spread, with_fidelity
    >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
    >>> recording = record(scene, 0.05, radiation_model="compact")
    >>> found = spread(recording, ["P1"], seeds=2)
    >>> bool(found.low[0] <= found.levels[0] <= found.high[0])
    True
    """
    if seeds < 1:
        raise ValueError(f"seeds = {seeds}: give 1 or more")
    recording = recording_of(source, radiation_model=radiation_model)
    if recording.scene is None or not recording.history.size:
        raise ValueError("a spread needs a recording with its scene and channels: fmu_bearing.record")
    check_model(recording.radiation_model)
    scene = at_speed(recording)
    if scene.imperfections is None:
        raise ValueError("the scene has no imperfections: its level has no spread over them")
    chosen = recording.named(microphones)
    places = [place for _, place in chosen]
    estimator = LevelEstimator(places, radiation_model or recording.radiation_model, weighting)
    flaws = scene.imperfections
    weak = Setting("response").against(scene.with_rigid_rings())
    weak = weak or reason_for_doubt(scene, radiation_model=radiation_model or recording.radiation_model)
    fidelity, seeds = ("full", min(seeds, _SEEDS_FULL)) if weak else ("response", seeds)
    others = list(_corners(flaws)) if surface is None else _found(surface, scene, bool(weak))
    draws = [flaws, *flaws.redrawn(seeds, scene.seeds_apart), *others]
    spectra = [estimator.spectrum(_drawn(scene, draw, fidelity)) for draw in bar(draws)]
    levels = level(np.array([each.sum(axis=1) for each in spectra]))
    change = levels - levels[0]
    here = recording.levels(places, radiation_model, weighting)
    law = surface is None and flaws.follows_law
    corners = change[1 + seeds :].reshape(-1, 2, len(places)) if law else np.zeros((2, 2, 1))
    within = change if surface is None else change[1 + seeds :]
    loudest = int(np.argmax(here))
    strongest = np.array([each[loudest].argmax() for each in spectra])
    stays = int((np.abs(strongest[1:] - strongest[0]) <= 1).sum())
    return Spread(
        tuple(name for name, _ in chosen),
        weighting,
        here,
        here + within.min(axis=0),
        here + within.max(axis=0),
        np.ptp(change[: 1 + seeds], axis=0),
        (corners[1] - corners[0]).mean(axis=0) * np.ones(len(places)),
        (corners[:, 1] - corners[:, 0]).mean(axis=0) * np.ones(len(places)),
        _shares(scene, flaws, estimator, fidelity),
        float(estimator.frequency[strongest[0]]),
        (stays, len(draws) - 1),
        seeds,
        doubt_of(recording),
        weak,
        0 if surface is None else len(others),
    )


def at_speed(recording: Recording) -> Scene:
    """Return the scene of a recording at the recording's speed.

    Raises
    ------
    ValueError
        Without scene, or where the speed changes.
    """
    if recording.scene is None:
        raise ValueError("the recording does not know its scene: give the scene")
    mean = float(np.mean(recording.speed))
    if recording.changes_speed:
        raise ValueError("the recording's speed changes: levels belong to one operating point")
    operation = recording.scene.operation.model_copy(update={"speed_rpm": mean / RPM})
    return recording.scene.model_copy(update={"operation": operation})


def doubt_of(recording: Recording) -> str:
    """Return why the levels of a recording are in doubt; empty: they are not, or nothing is known of it."""
    try:
        found = doubt(at_speed(recording), radiation_model=recording.radiation_model)
    except ValueError:
        found = ""
    return in_doubt(recording.doubts, found)


def _found(surface: Surface | str | os.PathLike[str], scene: Scene, weak: bool) -> list[Imperfections]:
    """Return draws of a surface that was found, with all that is no part of it as in the scene."""
    found = surface if isinstance(surface, Surface) else read_surface(surface)
    check_taken(scene.imperfections, scene.name)
    count = min(len(found), _DRAWS_FULL if weak else _DRAWS)
    return list(found.draws(count, scene.imperfections))


def _drawn(scene: Scene, flaws: Imperfections, fidelity: str) -> Scene:
    """Return the scene with other imperfections and rigid rings, in a fidelity."""
    return with_fidelity(scene.with_rigid_rings().model_copy(update={"imperfections": flaws}), model=fidelity)


def _corners(flaws: Imperfections) -> Iterator[Imperfections]:
    """Lower, then higher exponent, each with the lower, then the higher amplitude."""
    if not flaws.follows_law:
        return
    p = flaws.waviness_exponent or 0.0
    low, high = ASSUMED_EXPONENTS  # where the scene's lies within
    if not low <= p <= high:
        low, high = max(p - _AROUND, 0.0), p + _AROUND
    keys = ("inner_race_amplitude_um", "outer_race_amplitude_um", "ball_form_nm")
    for exponent in (low, high):
        for factor in (1.0 / _FACTOR, _FACTOR):
            scaled = {key: factor * getattr(flaws, key) for key in keys if getattr(flaws, key) is not None}
            yield flaws.model_copy(update={"waviness_exponent": exponent} | scaled)


def _shares(
    scene: Scene, flaws: Imperfections, estimator: LevelEstimator, fidelity: str
) -> dict[str, NDArray[np.float64]]:
    """Share of the energy that each imperfection makes alone."""
    heavy = bool(scene.assembly.heavy_spots)
    energies = {}
    for name in dict.fromkeys([*flaws.sources, *(["unbalance"] if heavy else [])]):
        own = scene.replace({"spindle.shaft.unbalance": []}) if heavy and name != "unbalance" else scene
        energies[name] = estimator.spectrum(_drawn(own, flaws.alone(name), fidelity)).sum(axis=1)
    whole = sum(energies.values(), np.full(len(estimator.places), 1e-30))
    return {name: energy / whole for name, energy in energies.items()}
