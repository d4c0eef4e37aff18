"""``fmu-bearing sound``: levels, spectra, directivity and WAV files of a scene or a recording."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.settings import source_of
from fmu_bearing.files import check_folder, rescued
from fmu_bearing.progress import steps, work

if TYPE_CHECKING:
    from collections.abc import Callable

    from fmu_bearing.acoustics.analysis.field import Position
    from fmu_bearing.recording.channels.microphone_places import Places
    from fmu_bearing.recording.recording import Recording
    from fmu_bearing.recording.studies.spread import Spread
    from fmu_bearing.scene.surface import Surface

_RECORDING = "recording.npz"
#: What may be written into the folder.
_FILES = (
    _RECORDING, "levels.csv", "spectrum.csv", "third-octaves.csv", "planes.csv", "spectrum.png",
    "third-octaves.png", "planes.png", "lines.md", "orders.csv", "orders.png", "spectra.nc", "*.wav",
)  # fmt: skip


@base.app.command()
def sound(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="SCENE|RECORDING|RESULT",
            help="Scene (.toml), recording (.npz), or result of an FMU run with pressures (.csv).",
        ),
    ],
    duration: options.Duration = options.DURATION,
    settle: options.Settle = options.SETTLE,
    speed: options.Speed = None,
    run_up: Annotated[
        str | None,
        typer.Option(
            "--run-up",
            metavar="FROM:TO",
            help="Speed in r/min at the beginning and at the end of --duration; levels over order and speed "
            "are then written, too.",
        ),
    ] = None,
    settings: options.Settings = None,
    fidelity: options.Fidelity = None,
    radiation_model: options.RadiationModel = None,
    microphone: Annotated[
        list[str] | None, typer.Option("--microphone", "-m", help="Only these microphones, by name.")
    ] = None,
    microphone_at: Annotated[
        list[str] | None,
        typer.Option(
            "--microphone-at",
            metavar="X,Y,Z",
            help="A place in mm, from the bearing's centre, of a set from the nose; once per place. Without "
            "--microphone the scene's are left out.",
        ),
    ] = None,
    scene: Annotated[
        Path | None, typer.Option(help="With a result (.csv): the scene of the FMU that was run.")
    ] = None,
    resolution: Annotated[
        float | None, typer.Option(help="Of the spectra, Hz; default: 5, or as fine as a shorter one allows.")
    ] = None,
    at: Annotated[
        list[float] | None,
        typer.Option(
            "--at", metavar="HZ", help="What makes the noise at this frequency; once per frequency."
        ),
    ] = None,
    wav: Annotated[bool, typer.Option(help="Write WAV files.")] = True,
    wav_format: Annotated[
        str, typer.Option(metavar="16|24|float", help="Samples of WAV files: PCM of 16 or 24 bits, or float.")
    ] = "float",
    directivity: Annotated[bool, typer.Option(help="Measure three planes.")] = True,
    spread: Annotated[
        bool, typer.Option(help="Range of the levels over seeds and assumed surfaces, some seconds more.")
    ] = True,
    surface: options.SurfaceFile = None,
    plot: options.Plot = None,
    output: options.Folder = Path("out/sound"),
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Measure levels, spectra, third octaves and directivity; write tables, pictures, netCDF and WAV.

    Where the speed changes, of a recording or result too, an order map is written in place of the strongest
    lines. --plot writes the picture of the spectra, as spectrum.png in the folder, to a file.
    """
    from fmu_bearing.acoustics.analysis.audio import check_format
    from fmu_bearing.recording.channels.microphone_places import named_places
    from fmu_bearing.recording.measurements.at_frequency import noise_at
    from fmu_bearing.recording.measurements.sound_analysis import analyse_sound, spectra_picture, write_all
    from fmu_bearing.recording.record import Recording, record
    from fmu_bearing.recording.studies.spread import doubt_of
    from fmu_bearing.scene import scene_of
    from fmu_bearing.scene.exclusions import require
    from fmu_bearing.scene.surface_file import read_surface

    with base.refusals():
        check_folder(output)  # refused before the run
        base.check_new_in(force, output, *_FILES)
        check_format(wav_format)
        base.check_new(force, plot)
        chosen = source_of(source, settings, fidelity)
        turning = (
            base.shaft_speed(speed, chosen)
            if run_up is None
            else _ramp(run_up, source, speed, settle, duration)
        )
        rough = None if surface is None else read_surface(surface)
        places = _places(microphone, microphone_at)
        files, code = base.Writing(), 0
        if source.suffix == ".npz":
            recording = Recording.load(source)
        elif source.suffix == ".csv":
            recording = Recording.from_fmu(source, scene, settle)
        else:
            if resolution is not None and resolution * duration < 1.0:
                raise base.Refusal(
                    f"--resolution {resolution:g} Hz needs --duration {1.0 / resolution:g} s or more, "
                    f"not {duration:g} s"
                )
            found = scene_of(chosen)
            found = found if rough is None else rough.scene(found)
            require(found, "measurement")
            named_places(found.microphones, places)
            recording, code = base.so_far(partial(
                record, found, duration, speed=turning, settle=settle, radiation_model=radiation_model,
                warn=False, keep=True,
            ))  # fmt: skip
            with files:
                rescued(recording.save, output / _RECORDING)
                files.append(output / _RECORDING)
                for old in (found for name in _FILES[1:] for found in output.glob(name)):  # of another run
                    old.unlink()
            if code:
                directivity = spread = False
                base.tell(
                    f"without directivity and range: `fmu-bearing sound {output / _RECORDING}` gives them"
                )
        with work("sound at the microphones"):
            analysis = analyse_sound(recording, places, radiation_model, resolution)
            sources = [noise_at(recording, analysis, frequency) for frequency in at or ()]
        sure = None
        try:
            with work("directivity, tables and pictures"), files:
                files += write_all(
                    recording, analysis, output, radiation_model, wav, directivity, base.tell, wav_format
                )
                files.draw(partial(spectra_picture, recording, analysis), plot)
            if spread:
                sure = _spread(recording, places, radiation_model, rough, as_json)
        except KeyboardInterrupt:
            base.tell(
                "interrupted: these are the levels; missing: files that are not named below, their range"
            )
            code = base.INTERRUPTED
        doubted = doubt_of(recording)
    if as_json:
        base.print_json(
            {"levels": analysis.summary(), "doubt": doubted, "files": files}
            | ({"at": [one.summary() for one in sources]} if sources else {})
            | ({"spread": sure.summary()} if sure else {})
        )
    else:
        columns, rows = analysis.rows()
        heading = _heading(recording)
        heading = f"in doubt, see below: {heading}" if doubted else heading
        base.show(heading, [name.replace("_", " ") for name in columns], rows)
        for one in sources:
            base.show(f"{one.frequency:g} Hz: third octave of {one.band:g} Hz", *one.rows())
            for line in one.sentences():
                typer.echo(f"{one.frequency:g} Hz: {line}")
        if doubted:
            base.tell(f"{doubted}.")
        if sure is not None:
            base.show("uncertainty of these levels", *sure.rows())
            base.tell(sure.remark())
        if files:
            base.tell(f"written: {output}: {', '.join(path.name for path in files)}")
    base.end(code, files)


def _ramp(
    text: str, source: Path, speed: float | None, settle: float, duration: float
) -> "Callable[[float], float]":
    """Return the shaft's speed (rad/s) over time (s) of a run-up, which begins after the start-up."""
    if source.suffix in (".npz", ".csv"):
        raise base.Refusal(f"--run-up is refused: {source.name} has a speed of its own; leave it out")
    if speed is not None:
        raise base.Refusal("--run-up and --speed are refused together: give one of them")
    low, high = base.span(text, source)
    return lambda time: low + (high - low) * min(max(time - settle, 0.0) / duration, 1.0)


def _places(names: list[str] | None, at: list[str] | None) -> "list[str | Position] | None":
    """Return microphones by name and places (m) from text (mm); None: those of the scene."""
    if not at:
        return None if names is None else list(names)
    places: list[str | Position] = list(names or ())
    for text in at:
        try:
            x, y, z = (1e-3 * float(part) for part in text.split(","))
        except ValueError:
            raise base.Refusal(
                f"--microphone-at {text} is refused: write three numbers in mm, as 0,1000,0"
            ) from None
        places.append((x, y, z))
    return places


def _heading(recording: "Recording") -> str:
    """Return "levels", what radiates, and how far the surfaces excite it."""
    scene, end = recording.scene, recording.excitation_end
    words = "levels"
    if scene is not None and scene.sound is not None:
        words += f", radiator {scene.sound.radiator}"
    return words if end is None else f"{words}, surfaces excite up to {1e-3 * end:.3g} kHz"


def _spread(
    recording: "Recording",
    microphones: "Places",
    radiation_model: str | None,
    surface: "Surface | None",
    quiet: bool,
) -> "Spread | None":
    """Range of the levels, or None with a line why there is none."""
    from fmu_bearing.recording.studies.spread import spread

    bar = partial(steps, what="range of levels", unit="draws")
    try:
        return spread(recording, microphones, radiation_model=radiation_model, surface=surface, bar=bar)
    except ValueError as reason:
        if not quiet:
            base.tell(f"no range of the levels: {reason}")
        return None
