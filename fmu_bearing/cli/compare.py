"""``fmu-bearing compare``: two scenes, recordings or runs side by side."""

from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli.base import Catalogues, Json, app, print_json, refusals, tell
from fmu_bearing.files import check_folder

_WHAT = "Scene (.toml), recording (.npz) or result of a run (.csv, .nc)."


@app.command()
def compare(
    a: Annotated[Path, typer.Argument(metavar="A", help=_WHAT)],
    b: Annotated[Path, typer.Argument(metavar="B", help=_WHAT)],
    duration: Annotated[float, typer.Option("--duration", "-t", help="Length of each recording, s.")] = 0.5,
    settle: Annotated[float, typer.Option(help="Time left out at the beginning, s.")] = 0.1,
    fidelity: Annotated[str | None, typer.Option(help="Fidelity in place of the scenes'.")] = None,
    radiation_model: Annotated[
        str | None, typer.Option(help="How radiation is computed, in place of the scenes'.")
    ] = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Picture of both spectra: .png, .svg or .pdf.")
    ] = None,
    microphone: Annotated[
        str | None,
        typer.Option("--microphone", "-m", help="Of third octaves and picture; default: the loudest of A."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FOLDER", help="Write the tables as CSV too.")
    ] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Compare levels, third octaves, loads, angles, torque; list the keys that differ. B minus A."""
    from fmu_bearing.recording.channels.microphone_places import named_places
    from fmu_bearing.recording.studies.compare import compare as compare_them
    from fmu_bearing.results.picture_parts import check_picture, save
    from fmu_bearing.results.table import show
    from fmu_bearing.scene import read_scene

    with refusals():
        if plot is not None:
            check_picture(plot)
        for source in (a, b):  # an unknown microphone is reported before the runs
            if microphone is not None and source.suffix == ".toml":
                named_places(read_scene(source).microphones, microphone)
        if output is not None:
            check_folder(output)  # refused before the runs
        found = compare_them(
            a, b, duration=duration, settle=settle, fidelity=fidelity, radiation_model=radiation_model,
            tell=tell, progress=False if as_json else None,
        )  # fmt: skip
        tables = found.tables(microphone)
        files = [] if output is None else found.save(output, microphone)
        if plot is not None:
            save(found.plot(microphone), plot)
            files.append(plot)
    if as_json:
        print_json(found.summary() | {"files": files})
        return
    for title, table in tables.items():
        show(title, *table)
    if not found.keys and found.a.scene is not None and found.b.scene is not None:
        typer.echo("the scenes do not differ")
    typer.echo(f"A: {a}, B: {b}; differences are B minus A")
    for line in found.doubts():
        tell(line)
    if files:
        tell(f"written: {', '.join(map(str, files))}")
