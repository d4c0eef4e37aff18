"""``fmu-bearing envelope``: envelope spectra of accelerations, pressures and variables, with their lines."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.settings import source_of
from fmu_bearing.files import check_folder, rescued
from fmu_bearing.progress import work

if TYPE_CHECKING:
    from fmu_bearing.recording.measurements.envelope import Envelope
    from fmu_bearing.recording.recording import Recording

_RECORDING = "recording.npz"
_STEP = 1.0 / 25_600.0  # s: between points of variables whose envelope is asked for
_TURNS = 4.0  # resolutions that the frequency of the cage takes to be apart from its side bands


@base.app.command()
def envelope(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="SCENE|RECORDING|RESULT",
            help="Scene (.toml), recording (.npz), or result or measured record at even steps (.csv, .nc).",
        ),
    ],
    signal: Annotated[
        list[str] | None,
        typer.Option(
            "--signal",
            metavar="NAME",
            help="Microphone, acceleration (outer_ring.acceleration.z) or variable, * matches any text; one "
            "option each; default: both radial accelerations of each outer ring.",
        ),
    ] = None,
    band: Annotated[
        str | None,
        typer.Option("--band", metavar="LOW:HIGH", help="Hz; default: the best one of the kurtogram."),
    ] = None,
    duration: options.Duration = options.DURATION,
    settle: options.Settle = options.SETTLE,
    speed: options.Speed = None,
    settings: options.Settings = None,
    fidelity: options.Fidelity = None,
    radiation_model: options.RadiationModel = None,
    scene: Annotated[
        Path | None,
        typer.Option(help="With a result or record (.csv): the scene that was run, for its lines."),
    ] = None,
    plot: options.Plot = None,
    output: Annotated[
        Path | None, options.output("Write tables, pictures and signals (.uff) there.", "FOLDER")
    ] = None,
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Show how often a band of a signal swells: strokes of defects, and what else passes the balls.

    A band-pass, the analytic signal, the spectrum of its square; lines are those of the bearing as its cage
    ran. A kurtogram chooses the band with the strongest strokes. --plot draws the first signal's spectrum.
    """
    from fmu_bearing.recording.measurements.envelope import envelope_of
    from fmu_bearing.recording.measurements.envelope_files import FILES, usual_signals, write_envelopes
    from fmu_bearing.recording.recording import Recording

    with base.refusals():
        if output is not None:
            check_folder(output)
            base.check_new_in(force, output, _RECORDING, *FILES)
        base.check_new(force, plot)
        chosen = source_of(source, settings, fidelity)
        ends, code = _ends(band), 0
        files = base.Writing()
        if source.suffix in (".csv", ".nc"):
            recording = _measured(source, scene, settle, speed)
        elif source.suffix == ".npz":
            base.shaft_speed(speed, source)
            recording = Recording.load(source)
        else:
            recording, code = _recorded(
                chosen, signal, duration=duration, settle=settle, speed=base.shaft_speed(speed, chosen),
                radiation_model=radiation_model,
            )  # fmt: skip
            if output is not None:
                with files:
                    rescued(recording.save, output / _RECORDING)
                    files.append(output / _RECORDING)
        names = usual_signals(recording) if signal is None else recording.signals_like(signal)
        with work("envelopes"):
            found = [envelope_of(recording, name, ends, radiation_model) for name in names]
        with files:
            if output is not None:
                files += write_envelopes(recording, found, output, radiation_model, base.tell)
            files.draw(found[0].picture, plot)
    if as_json:
        base.print_json({"envelopes": [one.summary() for one in found], "files": files})
        return base.end(code, files)
    for one in found:
        _show(one)
        _tell(recording, one)
    _caution(recording, found[0])
    base.end(code, files, named=True)


def _measured(source: Path, scene: Path | None, settle: float, speed: float | None) -> "Recording":
    """Return the signals of a result or a measured record; ``speed`` (r/min) is that of its shaft."""
    from fmu_bearing.recording.recording import Recording
    from fmu_bearing.results.result import Run
    from fmu_bearing.scene import scene_of

    run = Run.load(source)
    known = run.scene if scene is None else scene_of(scene)
    if speed is not None and known is None:
        raise base.Refusal(f"--speed {speed:g} r/min is refused: without --scene there are no lines to move")
    turning = None if known is None else base.shaft_speed(speed, known)
    return Recording.from_run(run, known, settle, turning)


def _recorded(source: Any, signals: list[str] | None, **more: Any) -> "tuple[Recording, int]":
    """Record a scene, with the variables among the signals at close points; return it and the exit code."""
    from fmu_bearing.interface import variables
    from fmu_bearing.interface.names import matching
    from fmu_bearing.recording.record import OUTPUTS, record
    from fmu_bearing.scene import scene_of
    from fmu_bearing.scene.exclusions import require

    found = scene_of(source)
    require(found, "measurement")
    known = [one.name for one in variables(found, 0.0)]
    kept = [name for pattern in signals or () for name in matching(pattern, known)]
    if kept:
        more |= {"outputs": (*OUTPUTS, "cage.speed_ratio", *kept), "step": _STEP}
    return base.so_far(partial(record, found, warn=False, keep=True, **more))


def _ends(band: str | None) -> tuple[float, float] | None:
    """Return the ends of a band (Hz) from two numbers with a colon between."""
    if band is None:
        return None
    try:
        low, high = (float(part) for part in band.split(":"))
    except ValueError:
        raise base.Refusal(f"--band {band}: write two frequencies in Hz with a colon, as 2000:6000") from None
    return low, high


def _show(found: "Envelope") -> None:
    """Print the lines of one signal that are far over the median."""
    from fmu_bearing.recording.measurements.envelope_files import lines_table
    from fmu_bearing.recording.measurements.envelope_lines import FAR

    kurtogram = found.kurtogram
    title = f"{found.name}, {found.strength}" + ("" if kurtogram is None else ", band by the kurtogram")
    columns, rows = lines_table(found)
    if rows:
        base.show(title, columns, rows)
    elif found.lines:
        typer.echo(f"{title}: no line of the bearing is {FAR:g} dB over the median")
    else:
        at = found.frequency[found.amplitude.argmax()]
        typer.echo(f"{title}: highest at {at:.1f} Hz; the bearing is not known, --scene names its lines")


def _tell(recording: "Recording", found: "Envelope") -> None:
    """Print what an envelope says in words, for a bearing that is known."""
    from fmu_bearing.recording.measurements.envelope_words import doubt, verdict

    if found.lines:
        rpm = 60.0 * recording.kinematics().f_r
        for words in (verdict(found), doubt(found, rpm, recording.turning_known)):
            if words:
                typer.echo(words)


def _caution(recording: "Recording", found: "Envelope") -> None:
    """Say where a recording is too short to tell lines of the cage apart."""
    if recording.scene is None:
        return
    slowest = min(one.f_c for one in recording.bearing_kinematics())
    if 0.0 < slowest < _TURNS * found.resolution:
        base.tell(
            f"caution: lines are {found.resolution:.3g} Hz wide and the cage turns {slowest:.3g} times per "
            f"second: give --duration {_TURNS / slowest:.2g} or more to tell its side bands apart"
        )
