"""What a comparison reads of a run: levels, spectra, third octaves, loads, angles, torque."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.third_octave import centre_frequencies, nominal_frequency
from fmu_bearing.cautions import in_doubt, largest_of
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from fmu_bearing.recording.record import OUTPUTS
from fmu_bearing.recording.recording import Recording
from fmu_bearing.recording.studies.spread import doubt_of
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.levels import present
from fmu_bearing.results.result import Run
from fmu_bearing.results.spectra import MICROPHONE, Spectrum
from fmu_bearing.run.figures import A_LEVEL, LEVEL, THIRD_OCTAVE
from fmu_bearing.scene import Scene

#: Figures of a comparison: means of these, of a set for each bearing.
FIGURES = (
    "contact.inner.load_mean", "contact.inner.load_max", "contact.outer.load_mean", "contact.outer.load_max",
    "contact.inner.angle_mean", "contact.outer.angle_mean", "friction_torque",
)  # fmt: skip
#: Variables that a recording for a comparison keeps.
RECORDED = tuple(dict.fromkeys((*OUTPUTS, *FIGURES)))
_PRESSURE = "mic[1].pressure"
_METER = re.compile(rf"mic\[(\d+)\]\.({LEVEL}|{A_LEVEL}|{THIRD_OCTAVE}\[(\d+)\])")
_FAST = 40_000.0  # Hz: pressures that reach to 20 kHz


@dataclass(frozen=True, eq=False)
class ComparisonData(Result):
    """A run as a comparison reads it.

    Attributes
    ----------
    name : str
    scene : Scene or None
        The scene that was run, where it is known.
    levels : dict of str to (float, float)
        Equivalent level in dB and dB(A) by microphone; NaN where a run did not keep one.
    third_octaves : dict of str to dict
        Levels (dB) by microphone and exact centre (Hz).
    spectrum : Spectrum or None
        Levels over frequency at the microphones.
    figures : dict
        Means of the variables of `FIGURES` that were kept, SI units; of a set for each bearing too.
    excitation_end : float, optional
        Hz: up to where surfaces excite it; None: not known.
    doubt : str
        Why figures are in doubt (`modal.campbell.doubts`, `cautions.in_doubt`); empty: they are not, or
        nothing is known of it, as of a run whose inputs are not known.
    fidelity, radiation_model : str
        What it was computed with; empty: not known.
    """

    quantities = (
        "name",
        Quantity("levels", of=lambda side: {
            name: {"leq_dB": z, "laeq_dB": a} for name, (z, a) in side.levels.items()
        }),
        Quantity("third_octaves_dB", of=lambda side: {
            name: {f"{nominal_frequency(f):g}": value for f, value in bands.items()}
            for name, bands in side.third_octaves.items()
        }),
        "figures", "doubt", "fidelity", "radiation_model",
    )  # fmt: skip

    name: str
    scene: Scene | None
    levels: dict[str, tuple[float, float]]
    third_octaves: dict[str, dict[float, float]]
    spectrum: Spectrum | None
    figures: dict[str, float]
    excitation_end: float | None = None
    doubt: str = ""
    fidelity: str = ""
    radiation_model: str = ""


def _figures(columns: Mapping[str, NDArray[np.float64]]) -> dict[str, float]:
    """Return means of the variables of `FIGURES`, in its order."""
    return {
        key: float(np.mean(values))
        for figure in FIGURES
        for key, values in columns.items()
        if key == figure or key.endswith(f"].{figure}")
    }


def of_recording(recording: Recording, name: str = "", radiation_model: str | None = None) -> ComparisonData:
    """Measure a recording at its scene's microphones, in its radiation model unless another one is named."""
    own = name or ("recording" if recording.scene is None else recording.scene.name)
    kept = recording.within()
    figures = _figures(kept)
    fidelity = _fidelity(recording.scene)
    if not recording.microphones:
        return ComparisonData(
            own, recording.scene, {}, {}, None, figures, doubt=doubt_of(recording), fidelity=fidelity
        )
    sound = analyse_sound(recording, None, radiation_model)
    levels = {name: (float(z), float(a)) for name, (z, a) in zip(sound.names, sound.levels, strict=True)}
    bands = [float(f) for f in sound.bands]
    thirds = {
        name: dict(zip(bands, map(float, row), strict=True))
        for name, row in zip(sound.names, sound.third_octaves, strict=True)
    }
    units = ("dB",) * len(sound.names)
    spectrum = Spectrum(
        sound.names, sound.frequency, sound.spectra["total"], units, MICROPHONE, recording.excitation_end
    )
    return ComparisonData(
        own, recording.scene, levels, thirds, spectrum, figures, recording.excitation_end,
        doubt_of(recording), fidelity, radiation_model or recording.radiation_model,
    )  # fmt: skip


def of_run(run: Run, settle: float, radiation_model: str | None = None) -> ComparisonData:
    """Take the meters of a run at its end, and means after ``settle`` (s), or of all where it is shorter.

    A run that kept pressures often enough is measured as a recording is.

    Raises
    ------
    ValueError
        For a radiation model: that of a run is settled.
    """
    if radiation_model is not None:
        raise ValueError("the radiation model of a finished run cannot be changed: give its scene")
    times = run.time
    if _PRESSURE in run.names and len(times) > 2 and len(times) - 1 >= _FAST * (times[-1] - times[0]):
        left_out = settle if times[-1] - times[0] > settle else 0.0
        return of_recording(Recording.from_fmu(run.table, run.scene, left_out), run.name)
    after = times >= settle if (times >= settle).any() else np.full(len(times), True)
    figures = _figures({key: run[key][after] for key in run.names})
    levels, thirds = _meters(run)
    doubted = in_doubt(largest_of(run.names, run.__getitem__))
    sound = None if run.scene is None else run.scene.sound
    return ComparisonData(
        run.name, run.scene, levels, thirds, None, figures, run.excitation_end, doubted, _fidelity(run.scene),
        "" if sound is None else sound.radiation_model,
    )  # fmt: skip


def _fidelity(scene: Scene | None) -> str:
    return "" if scene is None else scene.fidelity.model


def _meters(run: Run) -> tuple[dict[str, tuple[float, float]], dict[str, dict[float, float]]]:
    """Equivalent levels and third octaves (dB) that a run's meters read at its end, by microphone."""
    known = [] if run.scene is None else [place.name for place in run.scene.microphones]
    nominal = {int(nominal_frequency(f)): float(f) for f in centre_frequencies()}
    read: dict[str, dict[str, float]] = {}
    thirds: dict[str, dict[float, float]] = {}
    for column in run.names:
        match = _METER.fullmatch(column)
        if match is None:
            continue
        k = int(match[1])
        name = known[k - 1] if k <= len(known) else f"mic[{k}]"
        value = float(_last(run[column]))
        if match[3] is None:
            read.setdefault(name, {})[match[2]] = value
        else:
            thirds.setdefault(name, {})[nominal[int(match[3])]] = value
    levels = {name: (found.get(LEVEL, np.nan), found.get(A_LEVEL, np.nan)) for name, found in read.items()}
    return levels, {name: bands for name, bands in thirds.items() if name in levels}


def _last(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Last level of a meter; NaN where metering has not begun."""
    return present(values[-1:], "dB")[0]
