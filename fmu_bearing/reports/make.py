"""`report`: from a scene, a recording, or a file of either, to a page."""

import os
import pathlib
import warnings as python_warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

from fmu_bearing.acoustics.analysis.field import form_of
from fmu_bearing.engine.constants import RPM
from fmu_bearing.extras import need
from fmu_bearing.files import check_file, rescued, write_whole
from fmu_bearing.progress import Stopped, Tell, silent
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.recording.studies.spread import Spread, spread
from fmu_bearing.reports.data.microphones import Microphones, at_microphones
from fmu_bearing.reports.data.observed_run import STEP, observed
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.modes.modes_section import section as what_vibrates
from fmu_bearing.reports.page.blocks import CUT, Absent, Section
from fmu_bearing.reports.page.render import render
from fmu_bearing.reports.sections import (
    accelerometers,
    arrangement,
    ball_contacts,
    conditions,
    envelopes,
    error_motion,
    friction,
    ring_motion,
    summary,
)
from fmu_bearing.reports.sections.seats import seats
from fmu_bearing.reports.sections.verdict_table import judged, overall_of
from fmu_bearing.reports.sections.what_to_change import section as what_to_change
from fmu_bearing.reports.sound import directivity_balloon, levels_and_spectra, playback, waterfall
from fmu_bearing.run.choose import resolve
from fmu_bearing.scene import SceneSource, read_scene, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.origins import origins, with_surface
from fmu_bearing.scene.surface import Surface
from fmu_bearing.scene.surface_file import read_surface

Source = Recording | SceneSource
DURATION = 0.5  # s that are shown
SETTLE = 0.1  # s left out at the beginning, in which the start-up dies away
RUN_UP = 1.0  # s a run-up takes
RADIUS = 1.0  # m: of the sphere on which directivity is shown
_SHORTEST = 0.02  # s
_SLOW = ("changes", "directivity")  # sections


@dataclass(frozen=True)
class Report:
    """The report that was written.

    Attributes
    ----------
    path : Path
    size : int
        In bytes.
    sections : dict
        Why a section is missing, by its key; empty text: it is there.
    figures : dict
        The figures at the top of the page, by name with unit.
    warnings : list of str
    recording : Recording
        The recording that the page shows.
    verdict : str
        The gravest of all verdicts; empty where there is no scene to judge.
    """

    path: pathlib.Path
    size: int
    sections: dict[str, str]
    figures: dict[str, float]
    warnings: list[str]
    recording: Recording
    verdict: str


def report(source: Source, output: str | os.PathLike[str], **options: Any) -> pathlib.Path:
    """Write the report of a run as one HTML page that needs no network, and return its path.

    The parameters are those of `make`, which also returns sections, figures and warnings.

    Examples
    --------
    >>> from fmu_bearing import Bearing
    >>> from fmu_bearing.reports import report
    >>> bearing = Bearing("examples/scenes/7003C-bare.toml", fidelity="rings")
    >>> page = report(bearing.scene, "report.html", duration=0.05, radiation_model="compact", changes=False)
    >>> page.name, 2e6 < page.stat().st_size < 3e6
    ('report.html', True)
    """
    return make(source, output, **options).path


def make(
    source: Source,
    output: str | os.PathLike[str],
    *,
    duration: float = DURATION,
    settle: float = SETTLE,
    speed: float | None = None,
    radiation_model: str | None = None,
    run_up: tuple[float, float] | None = None,
    run_up_time: float = RUN_UP,
    radius: float = RADIUS,
    title: str = "",
    changes: bool | None = None,
    envelope: bool | None = None,
    surface: Surface | str | os.PathLike[str] | None = None,
    keep: str | os.PathLike[str] | None = None,
    tell: Tell = silent,
    progress: bool | None = None,
) -> Report:
    """Run a scene, or take a recording, and write its report.

    Parameters
    ----------
    source : Recording, Scene or path
        A scene file (``.toml``) or a scene in memory, which are run; or a recording (``.npz``), whose
        report has the sections that its variables allow.
    output : path
        HTML file; its folder is made.
    duration, settle : float
        Length of the run (s), and the time left out before it.
    speed : float, optional
        Shaft speed (rad/s) in place of the scene's.
    radiation_model : str, optional
        In place of the scene's ``sound.radiation_model``.
    run_up : (float, float), optional
        Shaft speeds (rad/s) of a second run that rises evenly from one to the other, for the waterfall.
    run_up_time : float
        Time (s) it takes.
    radius : float
        Of the sphere on which directivity is shown (m).
    title : str
        Heading; default: the scene's name.
    changes : bool, optional
        Whether the page says what to change; default: yes, but without levels where rings bend, because
        their runs take 40 s, and of a set, 10 s for each bearing.
    envelope : bool, optional
        Whether the page has envelope spectra; default: where a bearing has a local defect.
    surface : Surface or path, optional
        A surface that was found from a vibration test, or its file: a scene takes its median law, and the
        range of the level its draws.
    keep : path, optional
        Where to keep the run (``.npz``), before the page is made.
    tell : callable
        Takes a line of text before each piece of work.
    progress : bool, optional
        Progress bars of the runs; default: on a terminal.

    Returns
    -------
    Report

    Raises
    ------
    MissingExtra
        Without the extra ``report`` (plotly, jinja2).
    OSError
        When the page cannot be written; raised before the run.
    ValueError
        For a source, a time or a speed that is refused.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt`, after the page was written with what is finished: ``found`` is the
        report. Before 20 ms of the run are there, no page is written.
    """
    need("plotly.graph_objects", "a report")
    need("jinja2", "a report")
    path = check_file(output, ".html", "a report")
    rough = surface if surface is None or isinstance(surface, Surface) else read_surface(surface)
    _check(duration, settle, radius, run_up, run_up_time)
    left: list[str] = []  # what Ctrl-C leaves out
    subject = _subject(source, duration, settle, speed, radiation_model, radius, rough, tell, progress, left)
    unkept = None
    if keep is not None:
        try:
            rescued(subject.recording.save, pathlib.Path(keep))
        except OSError as problem:  # the page is made first
            unkept = problem
    rising, sure = None, None
    if run_up and not left:
        with _leaving(left, "the run-up"):
            rising = _run_up(subject, run_up, run_up_time, tell, progress)
    with python_warnings.catch_warnings(record=True) as caught:
        python_warnings.simplefilter("always", UserWarning)
        sections, microphones = _sections(subject, rising, changes, envelope, tell, left)
    subject.warnings += [str(each.message) for each in caught if issubclass(each.category, UserWarning)]
    notes = summary.warnings_of(subject)
    if not left:
        with _leaving(left, "the range of the level"):
            sure = _spread(subject, microphones, rough, tell)
    shown = summary.tiles(subject, microphones, sure)
    verdicts = judged(subject)
    cards, figures = summary.cards(subject, () if verdicts is None else verdicts.found)
    overall = None if verdicts is None else overall_of(verdicts.found, subject.several)
    scene = subject.recording.scene
    heading = title or ("Recording" if scene is None else scene.name)
    tell("writing the page")
    text = render(
        heading, conditions.source_words(subject), subject.source, sections, shown,
        summary.sentences(subject, microphones, sure), notes, None if verdicts is None else verdicts.table,
        overall=overall, cards=cards, kind=f"{'Spindle' if subject.several else 'Bearing'} report",
    )  # fmt: skip
    data = text.encode("utf-8")
    rescued(partial(write_whole, data=data), path)
    made = Report(
        path, len(data), {section.key: section.missing for section in sections},
        {tile["key"]: tile["value"] for tile in shown} | figures, notes, subject.recording,
        "" if overall is None else overall.judgement,
    )  # fmt: skip
    if left:
        raise Stopped(made, ", ".join(left))
    if unkept is not None:
        raise unkept
    return made


@contextmanager
def _leaving(left: list[str], what: str) -> Iterator[None]:
    """On Ctrl-C in the block leave ``what`` out and go on."""
    try:
        yield
    except KeyboardInterrupt:
        left.append(what)


def _check(
    duration: float, settle: float, radius: float, run_up: tuple[float, float] | None, run_up_time: float
) -> None:
    lowest = {"duration": _SHORTEST, "run_up_time": 0.1, "settle": 0.0, "radius": 1e-3}
    given = {"duration": duration, "run_up_time": run_up_time, "settle": settle, "radius": radius}
    for name, value in given.items():
        if not lowest[name] <= value < 1e4:
            unit = "m" if name == "radius" else "s"
            raise ValueError(f"{name} = {value:g} {unit}: it must be {lowest[name]:g} {unit} or more")
    if run_up is not None and not abs(run_up[1] - run_up[0]) > 1.0:
        raise ValueError("a run-up needs two speeds that differ: 5000:30000, for example")


def _subject(
    source: Source, duration: float, settle: float, speed: float | None, radiation_model: str | None,
    radius: float, surface: Surface | None, tell: Tell, progress: bool | None, left: list[str],
) -> Subject:  # fmt: skip
    """Load a recording, or run a scene; ``left`` gets what Ctrl-C leaves out."""
    text, whence = "", []
    if isinstance(source, str | os.PathLike):
        file = pathlib.Path(source)
        if file.suffix == ".npz":
            tell(f"reading {file.name}")
            return _taken(Recording.load(file), f"recording {file.name}", radiation_model, radius, speed)
        source = read_scene(file)
        text, whence = file.read_text("utf-8-sig"), origins(file)
    if isinstance(source, Recording):
        return _taken(source, "a recording in memory", radiation_model, radius, speed)
    given = scene_of(source)
    require(given, "report")
    given = given if surface is None else surface.scene(given)
    if given.fidelity.model == "auto":
        tell("fidelity auto: finding the cheapest within the scene's accuracy")
    scene, choice = resolve(given)
    if choice is not None:
        tell(choice.words())
    tell(f"running {scene.name}, fidelity {scene.fidelity.model}, for {settle + duration:g} s")
    try:
        recording, notes = observed(
            scene, duration, speed=speed, settle=settle, radiation_model=radiation_model, progress=progress
        )
    except Stopped as stop:
        recording, notes = stop.found
        left.append(stop.missing)
        duration = recording.size / recording.rate
    whole = settle + duration
    origin = f"scene {scene.name}, run for {whole:.4g} s of which the last {duration:.4g} s are shown"
    if choice is not None:
        origin += f"; {choice.words()}"
    if surface is not None:
        origin += f"; surfaces: the median law of {surface.words}"
        whence = with_surface(whence, surface)
    return Subject(recording, recording.radiation_model, origin, text, whence, notes, radius)


def _spread(
    subject: Subject, microphones: Microphones | None, surface: Surface | None, tell: Tell
) -> Spread | None:
    """Range of the level at the loudest microphone; None where there is none."""
    if microphones is None:
        return None
    tell("range of the level over seeds and assumed surfaces")
    try:
        return spread(
            subject.recording,
            [microphones.names[microphones.loudest]],
            radiation_model=subject.radiation_model,
            surface=surface,
        )
    except ValueError:
        return None  # no scene, no waviness, or a speed that changes


def _taken(
    recording: Recording, origin: str, radiation_model: str | None, radius: float, speed: float | None
) -> Subject:
    """Take a recording; ``ValueError`` for an option that needs another run."""
    if recording.scene is not None:
        require(recording.scene, "report")
    if speed is not None:
        raise ValueError(
            "the speed of a recording cannot be changed: give the scene to run it at another one"
        )
    if radiation_model is not None and recording.history.size == 0:
        raise ValueError(
            f'radiation_model = "{radiation_model}" needs channels, and this recording holds pressures only: '
            "leave radiation_model out, or give the scene"
        )
    if radiation_model is not None and form_of(radiation_model) != form_of(recording.radiation_model):
        raise ValueError(
            f'radiation_model = "{radiation_model}" needs other channels than this recording with '
            f'"{recording.radiation_model}" has: give the scene'
        )
    return Subject(recording, radiation_model or recording.radiation_model, origin, radius=radius)


def _run_up(
    subject: Subject, speeds: tuple[float, float], duration: float, tell: Tell, progress: bool | None
) -> Subject:
    """Second run, from one speed to the other."""
    scene = subject.scene
    words = f"{scene.name} from {speeds[0] / RPM:,.0f} to {speeds[1] / RPM:,.0f} r/min in {duration:g} s"
    tell(f"running up: {words}")
    recording = record(
        scene, duration, speed=waterfall.ramp(*speeds, duration, SETTLE), settle=SETTLE, step=4.0 * STEP,
        radiation_model=subject.radiation_model, progress=progress, warn=False,
    )  # fmt: skip
    return Subject(recording, subject.radiation_model, words, radius=subject.radius)


def _sections(
    subject: Subject,
    rising: Subject | None,
    changes: bool | None,
    envelope: bool | None,
    tell: Tell,
    left: list[str],
) -> tuple[list[Section], Microphones | None]:
    """All sections in the page's order; one that cannot be made gives the reason.

    After Ctrl-C in a run or the sound what takes longest is left out, after Ctrl-C in a section all that
    follows.
    """
    microphones: Microphones | None = None
    reason = ""
    tell("sound at the microphones")
    try:
        microphones = at_microphones(subject)
    except (Absent, ValueError) as problem:
        reason = str(problem)
    except KeyboardInterrupt:
        reason = CUT

    def with_sound(make_one: Callable[[Microphones], Section]) -> Callable[[], Section]:
        def made() -> Section:
            if microphones is None:
                raise Absent(reason)
            return make_one(microphones)

        return made

    plan: list[tuple[str, str, Callable[[], Section]]] = [
        ("conditions", "Operating point", lambda: conditions.conditions(subject)),
        ("fits", "Fits of the rings", lambda: seats(subject)),
        ("arrangement", "Arrangement", lambda: arrangement.arrangement(subject)),
        ("axial", "Axial load", lambda: arrangement.axial(subject)),
        ("warmth", "Preload and warmth", lambda: arrangement.warmth(subject)),
        ("levels", "Levels and sources", with_sound(lambda h: levels_and_spectra.levels(subject, h))),
        ("changes", "What to change", lambda: what_to_change(subject, tell, changes)),
        ("modes", "Modes", lambda: what_vibrates(subject)),
        ("spectra", "Spectra", with_sound(lambda h: levels_and_spectra.spectra(subject, h))),
        ("envelope", "Envelope", lambda: envelopes.envelopes(subject)),
        ("audio", "Listen", with_sound(playback.audio)),
        ("waterfall", "Waterfall", with_sound(lambda h: waterfall.fall(h, rising))),
        ("directivity", "Directivity", lambda: directivity_balloon.directivity(subject, microphones)),
        ("velocities", "Velocities", lambda: ring_motion.velocities(subject)),
        ("orbits", "Orbits", lambda: ring_motion.orbits(subject)),
        ("accelerometers", "Accelerometers", lambda: accelerometers.accelerometers(subject)),
        ("error-motion", "Error motion", lambda: error_motion.error_motion(subject)),
        ("contacts", "Contacts", lambda: ball_contacts.contacts(subject)),
        ("friction", "Friction and heat", lambda: friction.friction(subject)),
        ("assumptions", "Assumptions and choices", lambda: conditions.assumptions(subject)),
    ]
    scene = subject.recording.scene
    asked = dict.fromkeys(("arrangement", "axial", "warmth"), subject.several)
    asked |= {"accelerometers": scene is not None and bool(scene.accelerometers)}
    asked["envelope"] = bool(scene and scene.has_defects) if envelope is None else envelope
    asked |= {"fits": scene is not None and scene.fit is not None, "changes": changes is not False}
    sections: list[Section] = []
    stopped = False
    for key, title, make_one in plan:
        if not asked.get(key, True):
            continue
        if stopped or (left or reason == CUT) and key in _SLOW:
            sections.append(Section(key, title, (), CUT))
            continue
        tell(f"section: {title.lower()}")
        try:
            sections.append(make_one())
        except Absent as problem:
            sections.append(Section(key, title, (), str(problem)))
        except KeyboardInterrupt:
            sections.append(Section(key, title, (), CUT))
            stopped = True
    left += [section.key for section in sections if section.missing == CUT]
    return sections, microphones
