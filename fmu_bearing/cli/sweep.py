"""``fmu-bearing sweep``: a scene over a grid of its values."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.runs import split
from fmu_bearing.cli.settings import source_of
from fmu_bearing.files import check_folder
from fmu_bearing.progress import Stopped

if TYPE_CHECKING:
    from fmu_bearing.sweeps.plan import Plan
    from fmu_bearing.sweeps.runs import Outcomes

Source = Annotated[Path, typer.Argument(metavar="SCENE|SWEEP", help="Scene, or sweep file (TOML).")]
AxisTexts = Annotated[
    list[str] | None,
    typer.Option(
        "--axis",
        "-a",
        metavar="KEY=VALUES",
        help="What is varied: KEY=LOW:HIGH:COUNT, KEY=LOW:HIGH:COUNTlog, KEY=VALUE,VALUE,... KEY is dotted "
        "(mounting.preload_N) or speed, preload, pedestal, viscosity, seed, fidelity. Once per axis.",
    ),
]
Settle = Annotated[float | None, options.settle("; default 0.02, or the sweep file's: a map has many points")]
Window = Annotated[float | None, typer.Option(help="Time over which it is read, s; default 0.1.")]


@base.app.command()
def sweep(
    source: Source,
    axis: AxisTexts = None,
    variables: options.Figures = None,
    settle: Settle = None,
    window: Window = None,
    workers: options.Workers = None,
    scheduler: options.Scheduler = None,
    settings: options.Settings = None,
    fidelity: options.Fidelity = None,
    plot: options.Plot = None,
    output: options.Folder = Path("out/sweep"),
    force: options.Force = False,
    dry_run: options.DryRun = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Run a scene over all combinations of some of its values; write netCDF, CSV, a picture.

    Finished points are kept in the folder: the same command goes on where an earlier one was interrupted.
    The results of another sweep in the folder are replaced with --force alone. The picture is sweep.png
    there, or the file of --plot.
    """
    from fmu_bearing.extras import need
    from fmu_bearing.sweeps.cluster import checked

    with base.refusals():
        need("xarray", "a sweep")
        need("h5netcdf", "netCDF")
        if scheduler is not None:  # refused before a file is written
            checked(scheduler)
        check_folder(output)
        base.check_new(force, plot)
        made, text = _plan(source, axis, variables, settle, window, settings, fidelity)
        if not dry_run:
            _keep_plan(made, text, output, force)
        if made.note:
            base.tell(made.note)
        if dry_run:
            _estimate(made, output, workers, as_json)
        else:
            _run(made, output, workers, scheduler, plot, as_json)


def _plan(
    source: Path, axis: list[str] | None, variables: list[str] | None, settle: float | None,
    window: float | None, settings: list[str] | None, fidelity: str | None,
) -> tuple["Plan", str]:  # fmt: skip
    """Return the plan from file and options, which win, and the text of a file that repeats the sweep."""
    from fmu_bearing.scene import scene_of
    from fmu_bearing.sweeps.axes import SweepError, key_of, parse_axis
    from fmu_bearing.sweeps.description import Description, is_description, read_description
    from fmu_bearing.sweeps.plan import plan

    parsed = [parse_axis(text) for text in axis or []]
    known: dict[str, Any] = {"scene": str(source), "axes": {}}
    if is_description(source):
        known = read_description(source).model_dump()
    scene = scene_of(source_of(Path(known["scene"]), settings, fidelity))
    given = {key_of(scene, key): values for key, values in parsed}
    if len(given) < len(parsed):
        raise SweepError("an axis is given twice: give each --axis once")
    known["axes"] = {key_of(scene, key): values for key, values in known["axes"].items()} | given
    asked = split(variables)
    names = None if asked is None else tuple(asked)
    options = {"settle_s": settle, "window_s": window, "figures": names}
    known |= {key: value for key, value in options.items() if value is not None}
    if not known["axes"]:
        raise SweepError("a sweep needs an axis, for example --axis speed=8000:40000:9")
    wanted = Description.model_construct(**known)
    made = plan(scene, wanted.axes, wanted.settle_s, wanted.window_s, wanted.figures)
    return made, wanted.model_copy(update={"scene": "scene.toml"}).to_toml()


def _keep_plan(made: "Plan", text: str, folder: Path, force: bool) -> None:
    """Write the scene and a file that repeats the sweep; refuse to replace those of another sweep."""
    texts = {"scene.toml": made.scene.to_toml(), "sweep.toml": text}
    base.keep_texts(texts, folder, force, "scene.toml", "sweep.*")


def _run(
    made: "Plan", output: Path, workers: int | None, scheduler: str | None, plot: Path | None, as_json: bool
) -> None:  # fmt: skip
    from fmu_bearing.sweeps.runs import run_plan
    from fmu_bearing.sweeps.store import Store

    store, code = Store(output), 0
    try:
        outcomes = run_plan(made, store, workers, scheduler)
    except Stopped as stop:
        outcomes, code = stop.found, base.INTERRUPTED
        again = f"fmu-bearing sweep {output / 'sweep.toml'} -o {output}"
        base.tell(f"interrupted: what is finished is kept; `{again}` runs the {stop.missing} that are left")
    if any(not outcome.lasting for outcome in outcomes.values()):
        code = code or base.ENDED_EARLY
    base.end(code, _write(made, outcomes, output, plot, as_json))


def _write(
    made: "Plan", outcomes: "Outcomes", output: Path, plot: Path | None, as_json: bool
) -> base.Writing:
    """Write the results so far and print a summary; return what was written."""
    from fmu_bearing.extras import available
    from fmu_bearing.sweeps.figures import figures_of
    from fmu_bearing.sweeps.picture import MOST, save as save_picture, sweep_picture
    from fmu_bearing.sweeps.result import COLUMNS, dataset, extremes, save

    data = dataset(made, outcomes)
    files: dict[str, Path] = {}
    with base.Writing() as written:
        files |= save(data, output)
    drawable = outcomes and sum(size > 1 for size in made.shape) in (1, 2)
    if plot is not None and not drawable:
        base.tell(f"no {plot}: one or two axes with two values or more can be drawn")
    if drawable and available("matplotlib", "a picture", "sweep.png", base.tell):
        picture = plot or output / "sweep.png"
        asked = made.figures != figures_of(made.scene, None)
        drawn = [figure.name for figure in made.figures][:MOST] if asked else None
        with written:
            save_picture(sweep_picture(data, drawn), picture)
            files["picture"] = picture
    bad = {key: outcome.reason for key, outcome in outcomes.items() if outcome.reason}
    ranges = extremes(data)
    if as_json:
        base.print_json(
            {
                "scene": made.scene.name,
                "points": len(made.tasks),
                "finished": len(outcomes),
                "refused": len(bad),
                "reasons": sorted(set(bad.values())),
                "axes": {axis.key: axis.values for axis in made.axes},
                "figures": {row["figure"]: row for row in ranges},
                "files": files,
            }
        )
        return written
    rows = [[f"{cell:.5g}" if isinstance(cell, float) else cell for cell in row.values()] for row in ranges]
    base.show(str(data.attrs["title"]), COLUMNS, rows)
    counted = f"{len(outcomes)} of {len(made.tasks)} points"
    typer.echo(f"{counted}, {len(bad)} refused; written: {', '.join(map(str, files.values()))}")
    for reason in sorted(set(bad.values()))[:5]:
        typer.echo(f"refused: {reason}")
    return written


def _estimate(made: "Plan", output: Path, workers: int | None, as_json: bool) -> None:
    """Say how long the sweep is going to take."""
    from fmu_bearing.sweeps.runs import estimate
    from fmu_bearing.sweeps.store import Store

    base.show_estimate(estimate(made, Store(output) if output.is_dir() else None, workers), "points", as_json)
