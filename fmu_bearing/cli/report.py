"""``fmu-bearing report``: one HTML page about a run."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli.base import (
    app,
    check_new,
    end,
    print_json,
    refusals,
    shaft_speed,
    so_far,
    span,
    tell,
)
from fmu_bearing.cli.options import (
    DURATION,
    SETTLE,
    Catalogues,
    Duration,
    Fidelity,
    Force,
    Json,
    RadiationModel,
    Settings,
    Settle,
    Speed,
    SurfaceFile,
    output as target,
)
from fmu_bearing.cli.settings import source_of
from fmu_bearing.files import check_file

Source = Annotated[
    Path, typer.Argument(metavar="SCENE|RUN.npz", help="Scene file (TOML), or a recording of a run (.npz).")
]
Page = Annotated[Path, target("HTML file to write.")]


@app.command()
def report(
    source: Source,
    output: Page = Path("report.html"),
    force: Force = False,
    duration: Duration = DURATION,
    settle: Settle = SETTLE,
    speed: Speed = None,
    settings: Settings = None,
    fidelity: Fidelity = None,
    radiation_model: RadiationModel = None,
    run_up: Annotated[
        str | None,
        typer.Option(metavar="RPM:RPM", help="Second run from one speed to the other, for the waterfall."),
    ] = None,
    run_up_time: Annotated[float, typer.Option(metavar="S", help="Time the run-up takes.")] = 1.0,
    radius: Annotated[float, typer.Option(metavar="M", help="Distance at which directivity is shown.")] = 1.0,
    title: Annotated[str, typer.Option(help="Heading; default: the scene's name.")] = "",
    changes: Annotated[
        bool | None,
        typer.Option(
            "--changes/--no-changes",
            help="Whether it says what to change; default: yes, without levels where rings bend and of sets.",
        ),
    ] = None,
    surface: SurfaceFile = None,
    keep: Annotated[
        Path | None, typer.Option(metavar="RUN.npz", help="Keep the run, for another report without running.")
    ] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Write a report of a run: one HTML page that needs a browser and nothing else."""
    with refusals():
        turning = shaft_speed(speed, source)
        speeds = None if run_up is None else span(run_up, source)
        check_new(force, output, keep)
        if keep is not None:  # refused before the run
            check_file(keep, ".npz", "a run")
        from fmu_bearing.reports import make  # loads slowly, and no other command has use for it

        chosen = source_of(source, settings, fidelity)
        made, code = so_far(partial(
            make, chosen, output, duration=duration, settle=settle, radiation_model=radiation_model,
            radius=radius, title=title, speed=turning, run_up=speeds, run_up_time=run_up_time,
            changes=changes, surface=surface, keep=keep, tell=tell,
        ))  # fmt: skip
    missing = {key: reason for key, reason in made.sections.items() if reason}
    if as_json:
        print_json({
            "path": made.path, "bytes": made.size, "figures": made.figures, "missing": missing,
            "sections": list(made.sections), "warnings": made.warnings, "verdict": made.verdict,
        })  # fmt: skip
        return end(code)
    for key, reason in missing.items():
        tell(f"not in the report: {key}: {reason}")
    for warning in made.warnings:
        tell(f"warning: {warning}")
    typer.echo(f"written: {made.path} ({made.size / 1e6:.1f} MB)")
    end(code)
