"""Sound of a set of bearings: a short run at the scene's loads, recorded with its channels.

The run also keeps what error motion needs.
"""

import numpy as np

from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.progress import Tell
from fmu_bearing.recording.record import OUTPUTS, record
from fmu_bearing.recording.recording import Recording
from fmu_bearing.reports.data.microphones import Microphones, at_microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Absent, Section, Table, Words
from fmu_bearing.reports.sound import levels_and_spectra, playback
from fmu_bearing.results.levels import decibels
from fmu_bearing.scene import Scene

DURATION, SETTLE = 0.3, 0.05  # s that are measured, and left out before
_AXIS = tuple(f"shaft.nose.{name}" for name in (
    "displacement.x", "displacement.y", "displacement.z", "tilt.y", "tilt.z",
))  # fmt: skip


def sound_of_set(scene: Scene, tell: Tell) -> tuple[list[Section], Microphones, Subject]:
    """Run a set, and return the sections about its sound, the levels, and the run with the axis of rotation.

    Lines are explained by what cages and balls of this run did.

    Raises
    ------
    Absent
        Where the scene has no sound.
    """
    if scene.sound is None or not scene.microphones:
        raise Absent("the scene has no microphones: add `[sound]` with [[sound.microphone]] to it")
    if np.isclose(scene.operation.speed_rpm, 0.0):
        raise Absent("the shaft does not turn")
    tell(f"running {scene.name} for {SETTLE + DURATION:g} s, for its sound")
    recording = record(
        scene, DURATION, settle=SETTLE, step=Recording.PRESSURE_STEP, outputs=(*OUTPUTS, *_AXIS),
        progress=False, warn=False,
    )  # fmt: skip
    subject = Subject(recording, recording.radiation_model)
    microphones = at_microphones(subject)
    words = (
        f"A run of {SETTLE + DURATION:g} s from the steady state, fidelity {subject.fidelity}, radiation "
        f"model {subject.radiation_model}, {scene.operation.speed_rpm:,.0f} r/min; the first {SETTLE:g} "
        "s are left out."
    )
    blocks = [*levels_and_spectra.levels(subject, microphones).blocks, _by_bearing(subject, microphones)]
    sections = [
        Section("levels", "Levels and sources", [*blocks, Words(words, "note")]),
        levels_and_spectra.spectra(subject, microphones),
        playback.audio(microphones),
    ]
    return sections, microphones, subject


def _by_bearing(subject: Subject, microphones: Microphones) -> Table:
    """Return the level of each bearing alone."""
    recording = subject.recording
    parts = recording.partial(microphones.positions, subject.radiation_model, by="bearing")
    levels = {name: level(recording.mean_square(part, "A")) for name, part in parts.items()}
    rows = [
        [name, *(decibels(float(values[k])) for values in levels.values())]
        for k, name in enumerate(microphones.names)
    ]
    heads = [f"bearing {name[len('bearing[') : -1]}, dB(A)" for name in levels]
    return Table(
        "Levels of each bearing alone", ["microphone", *heads], rows,
        note="Over the same time as the levels above. Pressures add with their phases. A dash: silent. What "
        "moves with several bearings, as a housing, counts for the first.",
    )  # fmt: skip
