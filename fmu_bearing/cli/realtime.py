"""``fmu-bearing realtime``: what communication steps of a scene cost beside the clock."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.runs import split
from fmu_bearing.cli.settings import source_of
from fmu_bearing.files import check_file
from fmu_bearing.progress import steps


@base.app.command()
def realtime(
    scene: options.SceneFile,
    step: options.Step = 1e-3,
    duration: options.Duration = options.DURATION,
    speed: options.Speed = None,
    settings: options.Settings = None,
    run_up: Annotated[
        str | None,
        typer.Option(
            metavar="RPM:RPM",
            help="Speeds of the run-up; default: from the scene's lowest speed, or half of its speed, to it.",
        ),
    ] = None,
    fidelity: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME,...", help="Fidelities; default: all that the scene allows."),
    ] = None,
    microphones: Annotated[
        int | None, typer.Option(metavar="N", help="The first N of the scene's microphones; default: all.")
    ] = None,
    silent: Annotated[bool, typer.Option("--silent", help="Without sound alone.")] = False,
    output: Annotated[Path | None, options.output("Write the table to this file as well (.csv).")] = None,
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Time a scene's steps by fidelity, with sound and without; say which keeps up and what to change.

    Times are the processor's for one thread, in a loop that does not wait for the clock; late are steps that
    take longer on the clock than they simulate. --duration is the simulated time of the run-up, and as long
    the speed is held; with --speed that speed is held, without a run-up. The first ten steps, which touch
    memory for the first time, are not timed; all others count, so there is no --settle.
    """
    from fmu_bearing.results.table import write_csv
    from fmu_bearing.run.realtime import realtime as time_it
    from fmu_bearing.run.step_times import SHORT

    with base.refusals():
        if speed is not None and run_up is not None:
            raise base.Refusal(
                "--speed and --run-up are refused together: a speed that is held has no run-up"
            )
        if silent and microphones is not None:
            raise base.Refusal("--silent and --microphones are refused together: give one of them")
        if output is not None:
            base.check_new(force, check_file(output, ".csv", "the table"))
        constant = base.shaft_speed(speed, scene)
        speeds = (
            (constant, constant)
            if constant is not None
            else base.span(run_up, scene)
            if run_up is not None
            else None
        )
        found, code = base.so_far(partial(
            time_it, source_of(scene, settings), step, duration=duration, speeds=speeds,
            fidelities=split(fidelity), microphones=0 if silent else microphones,
            track=partial(steps, what="fidelities"),
        ))  # fmt: skip
        with base.Writing() as files:
            if output is not None:
                files.append(write_csv(output, *found.table()))
    if as_json:
        base.print_json(found.summary() | {"files": files})
        return base.end(code, files)
    count = found.timed[0].cpu.size
    base.show(
        f"{found.scene.name}: {count} steps of {1e3 * step:g} ms, us of the processor", *found.table(SHORT)
    )
    typer.echo(found.machine)
    typer.echo(found.outputs())
    typer.echo(found.advice())
    for name, reason in found.left_out.items():
        base.tell(f"not timed: {name}: {reason}")
    base.end(code, files, named=True)
