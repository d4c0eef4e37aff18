"""``fmu-bearing identify``: numbers of a scene from measured levels."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.settings import source_of
from fmu_bearing.progress import Stopped

if TYPE_CHECKING:
    from fmu_bearing.identification import Identified

_FILES = ("levels.csv", "values.csv", "jacobian.csv", "report.md", "levels.png")
Data = Annotated[
    Path,
    typer.Argument(
        metavar="MEASURED",
        help="Measured values (CSV): microphone, speed_rpm, quantity, value_dB, std_dB, role and more.",
    ),
]
Keys = Annotated[
    list[str] | None,
    typer.Option(
        "--free",
        "-f",
        metavar="KEY[=LOW:HIGH]",
        help="Dotted key to identify, * for any text; once per key. Default bounds: a decade each way.",
    ),
]


@base.app.command()
def identify(
    scene: options.SceneFile,
    measured: Data,
    free: Keys = None,
    background: Annotated[
        Path | None, typer.Option(help="Background levels (CSV with the same columns), added as energy.")
    ] = None,
    settings: options.Settings = None,
    fidelity: Annotated[
        str | None,
        typer.Option(
            "--fidelity",
            metavar="NAME",
            help="Fidelity of the search; default: response, for hundreds of runs, or full where rings bend.",
        ),
    ] = None,
    seeds: Annotated[
        int | None, typer.Option(min=1, help="Seeds averaged over; default 4, for hundreds of runs.")
    ] = None,
    starts: Annotated[int | None, typer.Option(min=1, help="Starting points; default 3.")] = None,
    duration: Annotated[
        float | None,
        typer.Option(
            "--duration",
            "-t",
            metavar="S",
            help="Length of each run, s; default 0.1 or more: there are hundreds.",
        ),
    ] = None,
    settle: Annotated[
        float | None, options.settle("; default 0.03 to 0.05 by fidelity: hundreds of short runs")
    ] = None,
    few: Annotated[bool, typer.Option("--few", help="Allow fewer than three values per free key.")] = False,
    accept: Annotated[
        bool, typer.Option("--accept", help="Take levels outside 20 to 160 dB and speeds below 500 r/min.")
    ] = False,
    anyway: Annotated[
        bool, typer.Option("--anyway", help="Write the scene though it and the data contradict each other.")
    ] = False,
    workers: Annotated[
        int, typer.Option("--workers", "-w", min=1, help="Threads; default 1: each run keeps a core busy.")
    ] = 1,
    plot: options.Plot = None,
    output: Annotated[Path, options.output("Scene to write; a folder beside it takes all else.")] = Path(
        "identified.toml"
    ),
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Find the values of free keys that explain measured levels; write scene, tables, report, picture.

    Computed levels are kept in the folder: the same command goes on where an earlier one was interrupted,
    with --force where that one wrote its best so far. --plot writes a copy of the picture there, levels.png.
    """
    from fmu_bearing.identification import SEEDS, STARTS, identify as search
    from fmu_bearing.identification.files import output_paths

    with base.refusals():
        path, folder = output_paths(output)
        base.check_new(force, path, plot)
        base.check_new_in(force, folder, *_FILES)
        source = source_of(scene, settings)
        code = 0
        try:
            result = search(
                source, measured, free or [], background=background, fidelity=fidelity, seeds=seeds or SEEDS,
                starts=starts or STARTS, duration=duration, settle=settle, few=few, accept=accept,
                folder=folder, workers=workers,
            )  # fmt: skip
        except Stopped as stop:
            result, code = stop.found, base.INTERRUPTED
            base.tell(
                "interrupted: these are the best values so far; the same command with --force goes on, from "
                f"{folder / 'runs.jsonl'}"
            )
        files = _write(result, path, scene if source == scene else None, plot, as_json, anyway)
    base.end(code, files)


def _write(
    result: "Identified", path: Path, scene: Path | None, plot: Path | None, as_json: bool, anyway: bool
) -> base.Writing:  # fmt: skip
    """Print values, levels and remarks, and write the files, which are returned."""
    from fmu_bearing.identification.files import misfit_words, write_all
    from fmu_bearing.identification.result import Compared, Estimate
    from fmu_bearing.results.base import table

    refused = bool(result.doubts) and not anyway
    with base.Writing() as files:
        if not refused:
            files += write_all(result, path, scene, base.tell, anyway=anyway)
        if plot is not None and not refused:
            from fmu_bearing.identification.picture import identified_picture, save

            save(identified_picture(result), plot)
            files.append(plot)
    if as_json:
        base.print_json(result.summary() | {"files": files})
    else:
        base.show("Measured and computed levels", *table(Compared, result.compared))
        base.show("Identified values", *table(Estimate, result.estimates))
        typer.echo(misfit_words(result))
        for remark in (*(() if refused else result.doubts), *result.remarks):
            typer.echo(f"* {remark}")
        if files:
            typer.echo(f"written: {', '.join(map(str, files))}")
    if refused:
        write_all(result, path, scene, base.tell)  # which says why not
    return files
