"""Sound of a set of bearings: a short run at the scene's loads, its pressures and the levels of its parts.

The run also keeps what error motion needs.
"""

import re

import numpy as np

from fmu_bearing.engine.constants import RPM
from fmu_bearing.metrology.axis_watch import AxisWatch
from fmu_bearing.progress import Tell
from fmu_bearing.recording.recording import Recording
from fmu_bearing.reports.data.microphones import Microphones, at_microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Section, Table, Words
from fmu_bearing.reports.sound import levels_and_spectra, playback
from fmu_bearing.results.levels import decibels
from fmu_bearing.results.result import Run
from fmu_bearing.run.simulate import simulate
from fmu_bearing.scene import Scene
from fmu_bearing.steady.statics import Statics

DURATION, SETTLE = 0.3, 0.05  # s that are measured, and left out before
_ANGLES = ("contact.inner.angle_mean", "contact.outer.angle_mean")
_AXIS = ("shaft.nose.displacement.*", "shaft.nose.tilt.*")
_PART = re.compile(r"mic\[1\]\.(spl_(bearing\[\d+\]|inner_ring|outer_ring|cage|balls))")


def sound_of_set(scene: Scene, found: Statics, tell: Tell) -> tuple[list[Section], Microphones, Subject]:
    """Run a set, and return the sections about its sound, the levels, and the run with the axis of rotation.

    Lines are explained by the mean contact angles of all bearings, ``found``.

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
    outputs, watch = ["mic[*].pressure", "mic[*].spl_*", *_AXIS], AxisWatch()
    run = simulate(
        scene, SETTLE + DURATION, step=Recording.PRESSURE_STEP, outputs=outputs, progress=False, watch=watch
    )
    subject = Subject(_recording(run, scene, found, watch), "recorded")
    microphones = at_microphones(subject)
    blocks = [*levels_and_spectra.levels(subject, microphones).blocks[:1], _parts(run, scene)]
    words = (
        f"A run of {SETTLE + DURATION:g} s from the steady state, fidelity {scene.fidelity.model}, radiation "
        f"model {scene.sound.radiation_model}, {scene.operation.speed_rpm:,.0f} r/min; the first {SETTLE:g} "
        "s are left out."
    )
    sections = [
        Section("levels", "Levels and sources", [*blocks, Words(words, "note")]),
        levels_and_spectra.spectra(subject, microphones),
        playback.audio(microphones),
    ]
    return sections, microphones, subject


def _recording(run: Run, scene: Scene, found: Statics, watch: AxisWatch) -> Recording:
    """Return the pressures of a run as a recording, with the motion of the nose."""
    names = [name for name in run.names if name.endswith(".pressure") or name.startswith("shaft.nose.")]
    watched = watch.outputs(scene)
    heads = ("time", "shaft_speed", *names, *watched, *_ANGLES)
    table = np.empty(len(run), [(name, float) for name in heads])
    table["time"] = run.time
    table["shaft_speed"] = scene.operation.speed_rpm * RPM
    for race, name in enumerate(_ANGLES):
        table[name] = np.mean([one.contact_angles[race] for one in found.bearings])
    for name in names:
        table[name] = run[name]
    for name, values in watched.items():
        table[name] = values
    return Recording.from_fmu(table, scene, SETTLE)


def _parts(run: Run, scene: Scene) -> Table:
    """Return the time-weighted levels of bearings and of kinds of parts at the end of the run."""
    parts = [found[1] for name in run.names if (found := _PART.fullmatch(name))]
    rows = [
        [name, *(decibels(float(run[f"mic[{k}].{part}"][-1])) for part in parts)]
        for k, (name, _) in enumerate(scene.microphones, start=1)
    ]
    heads = [look.words(re.sub(r"\[(\d+)\]", r" \1", part.removeprefix("spl_"))) for part in parts]
    return Table(
        "Levels of parts alone at the end of the run, dB", ["microphone", *heads], rows,
        note="Time-weighted as the scene has it, of all bearings together by kind of part, and of each "
        "bearing where the housing does not radiate. A dash: silent.",
    )  # fmt: skip
