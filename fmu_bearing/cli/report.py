"""``fmu-bearing report``: one HTML page about a run."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.settings import source_of
from fmu_bearing.files import check_file

Source = Annotated[
    Path, typer.Argument(metavar="SCENE|RUN.npz", help="Scene file (TOML), or a recording of a run (.npz).")
]
Page = Annotated[Path, options.output("HTML file to write.")]


@base.app.command()
def report(
    source: Source,
    output: Page = Path("report.html"),
    force: options.Force = False,
    duration: options.Duration = options.DURATION,
    settle: options.Settle = options.SETTLE,
    speed: options.Speed = None,
    settings: options.Settings = None,
    fidelity: options.Fidelity = None,
    radiation_model: options.RadiationModel = None,
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
    envelope: Annotated[
        bool | None,
        typer.Option(
            "--envelope/--no-envelope",
            help="Whether it has envelope spectra; default: where a bearing has a local defect.",
        ),
    ] = None,
    surface: options.SurfaceFile = None,
    keep: Annotated[
        Path | None, typer.Option(metavar="RUN.npz", help="Keep the run, for another report without running.")
    ] = None,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Write a report of a run: one HTML page that needs a browser and nothing else."""
    with base.refusals():
        turning = base.shaft_speed(speed, source)
        speeds = None if run_up is None else base.span(run_up, source)
        base.check_new(force, output, keep)
        if keep is not None:  # refused before the run
            check_file(keep, ".npz", "a run")
        from fmu_bearing.reports import make  # loads slowly, and no other command has use for it

        chosen = source_of(source, settings, fidelity)
        made, code = base.so_far(partial(
            make, chosen, output, duration=duration, settle=settle, radiation_model=radiation_model,
            radius=radius, title=title, speed=turning, run_up=speeds, run_up_time=run_up_time,
            changes=changes, envelope=envelope, surface=surface, keep=keep, tell=base.tell,
        ))  # fmt: skip
    missing = {key: reason for key, reason in made.sections.items() if reason}
    if as_json:
        base.print_json({
            "path": made.path, "bytes": made.size, "figures": made.figures, "missing": missing,
            "sections": list(made.sections), "warnings": made.warnings, "verdict": made.verdict,
        })  # fmt: skip
        return base.end(code)
    for key, reason in missing.items():
        base.tell(f"not in the report: {key}: {reason}")
    for warning in made.warnings:
        base.tell(f"warning: {warning}")
    typer.echo(f"written: {made.path} ({made.size / 1e6:.1f} MB)")
    base.end(code)
