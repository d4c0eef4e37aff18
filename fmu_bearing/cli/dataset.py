"""``fmu-bearing dataset``: labelled waveforms of many runs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.settings import source_of
from fmu_bearing.files import check_folder
from fmu_bearing.progress import Stopped

if TYPE_CHECKING:
    from fmu_bearing.dataset import Layout

PlanFile = Annotated[Path, typer.Argument(metavar="PLAN", help="Plan of the data set (TOML).")]


@base.app.command()
def dataset(
    plan: PlanFile,
    workers: options.Workers = None,
    scheduler: options.Scheduler = None,
    settings: options.Settings = None,
    fidelity: options.Fidelity = None,
    output: options.Folder = Path("out/dataset"),
    force: options.Force = False,
    dry_run: options.DryRun = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Run a plan of labelled scenes; write waveforms, labels and a data card.

    Finished runs are kept in the folder: the same command goes on where an earlier one was interrupted.
    Another set in the folder is replaced with --force alone.
    """
    from fmu_bearing.dataset import lay_out, read_plan, run
    from fmu_bearing.dataset.store import Runs
    from fmu_bearing.extras import need
    from fmu_bearing.scene import scene_of
    from fmu_bearing.sweeps.cluster import checked
    from fmu_bearing.sweeps.runs import estimate

    with base.refusals():
        need("h5netcdf", "the waveforms of a data set")
        if scheduler is not None:
            checked(scheduler)
        check_folder(output)
        asked = read_plan(plan)
        made = lay_out(asked, scene_of(source_of(Path(asked.scene), settings, fidelity)))
        for note in made.notes:
            base.tell(note)
        if dry_run:
            store = Runs(output) if output.is_dir() else None
            base.show_estimate(estimate(made, store, workers, run), "runs", as_json)
            return
        text = asked.model_copy(update={"scene": "scene.toml"}).to_toml()
        texts = {"scene.toml": made.scene.to_toml(), "plan.toml": text}
        base.keep_texts(
            texts, output, force, "scene.toml", "plan.toml", "waveforms.nc", "labels.csv", "README.md"
        )
        _run(made, output, workers, scheduler, as_json)


def _run(made: "Layout", output: Path, workers: int | None, scheduler: str | None, as_json: bool) -> None:
    """Run what is not finished, write the files, print a summary."""
    from fmu_bearing.dataset import run_layout, write
    from fmu_bearing.dataset.store import Runs

    store, code = Runs(output), 0
    before = sum(store.has(task) for task in made.tasks)
    if before:
        base.tell(f"{before} of {len(made.tasks)} runs are kept in {output}: the others follow")
    try:
        outcomes = run_layout(made, store, workers, scheduler)
    except Stopped as stop:
        outcomes, code = stop.found, base.INTERRUPTED
        again = f"fmu-bearing dataset {output / 'plan.toml'} -o {output}"
        base.tell(f"interrupted: what is finished is kept; `{again}` runs the {stop.missing} that are left")
    if any(not outcome.lasting for outcome in outcomes.values()):
        code = code or base.ENDED_EARLY
    files: dict[str, Path] = {}
    with base.Writing() as written:
        files = write(made, outcomes, store, output)
    bad = [outcome.reason for outcome in outcomes.values() if outcome.reason]
    if as_json:
        base.print_json({
            "scene": made.scene.name, "runs": len(made.tasks), "finished": len(outcomes), "kept": before,
            "refused": len(bad), "reasons": sorted(set(bad)), "sensors": made.sensors, "files": files,
        })  # fmt: skip
    else:
        counted = f"{len(outcomes)} of {len(made.tasks)} runs"
        typer.echo(f"{counted}, {len(bad)} refused; written: {', '.join(map(str, files.values()))}")
        for reason in sorted(set(bad))[:5]:
            typer.echo(f"refused: {reason}")
    base.end(code, written)
