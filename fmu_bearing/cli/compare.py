"""``fmu-bearing compare``: two scenes, recordings or runs side by side."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli import options
from fmu_bearing.cli.base import Writing, app, check_new, check_new_in, end, print_json, refusals, show, tell
from fmu_bearing.cli.settings import at_speed, source_of
from fmu_bearing.files import check_folder
from fmu_bearing.progress import steps

_FILES = ("what-differs-in-the-scenes.csv", "levels.csv", "loads-angles-torque.csv", "third-octaves.csv")
_WHAT = "Scene (.toml), recording (.npz) or result of a run (.csv, .nc)."


@app.command()
def compare(
    a: Annotated[Path, typer.Argument(metavar="A", help=_WHAT)],
    b: Annotated[Path, typer.Argument(metavar="B", help=_WHAT)],
    duration: options.Duration = options.DURATION,
    settle: options.Settle = options.SETTLE,
    speed: options.Speed = None,
    settings: options.Settings = None,
    fidelity: options.Fidelity = None,
    radiation_model: options.RadiationModel = None,
    seeds: options.Seeds = options.SEEDS,
    plot: options.Plot = None,
    microphone: Annotated[
        str | None,
        typer.Option("--microphone", "-m", help="Of third octaves and picture; default: the loudest of A."),
    ] = None,
    output: Annotated[Path | None, options.output("Write the tables as CSV too.", "FOLDER")] = None,
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Compare levels, third octaves, loads, angles, torque; list the keys that differ. B minus A.

    What is set, as fidelity and speed, is set in both scenes. The difference of the levels is a finding where
    it has one sign with every seed: --seeds draws of the surfaces, the same for both, in short runs.
    """
    from fmu_bearing.recording.channels.microphone_places import named_places
    from fmu_bearing.recording.studies.compare import compare as compare_them
    from fmu_bearing.scene import read_scene

    with refusals():
        check_new(force, plot)
        for source in (a, b):  # an unknown microphone is reported before the runs
            if microphone is not None and source.suffix == ".toml":
                named_places(read_scene(source).microphones, microphone)
        if output is not None:
            check_folder(output)  # refused before the runs
            check_new_in(force, output, *_FILES)
        one, other = (source_of(source, at_speed(speed, settings, source)) for source in (a, b))
        comparison = compare_them(
            one, other, duration=duration, settle=settle, fidelity=fidelity, radiation_model=radiation_model,
            tell=tell,
        )  # fmt: skip
        tables = comparison.tables(microphone)
        both = bool(comparison.a.levels.keys() & comparison.b.levels.keys())
        track = partial(steps, what="draws of the surfaces")
        finding = comparison.finding(microphone, seeds, track) if both else None
        with Writing() as files:
            if output is not None:
                files += comparison.save(output, microphone)
            files.draw(partial(comparison.plot, microphone), plot)
    if as_json:
        print_json(
            comparison.summary() | {"finding": None if finding is None else finding.summary(), "files": files}
        )
        return end(0, files)
    for title, table in tables.items():
        show(f"levels, {comparison.conditions()}" if title == "levels" else title, *table)
    if not comparison.keys and comparison.a.scene is not None and comparison.b.scene is not None:
        typer.echo("the scenes do not differ")
    typer.echo(f"A: {a}, B: {b}; differences are B minus A")
    if finding is not None:
        typer.echo(finding.words())
    for line in comparison.doubts():
        tell(line)
    end(0, files, named=True)
