"""``fmu-bearing realtime``: what communication steps of a scene cost beside the clock."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli.base import (
    Catalogues,
    Json,
    Refusal,
    SceneFile,
    app,
    print_json,
    progress,
    refusals,
    shaft_speed,
    tell,
)
from fmu_bearing.cli.report import span
from fmu_bearing.cli.runs import split
from fmu_bearing.files import check_file


@app.command()
def realtime(
    scene: SceneFile,
    step: Annotated[float, typer.Option(metavar="S", help="Communication step.")] = 1e-3,
    duration: Annotated[
        float, typer.Option(metavar="S", help="Simulated time of the run-up, and as long the speed is held.")
    ] = 0.5,
    speed: Annotated[
        float | None, typer.Option(metavar="RPM", help="Shaft speed that is held, without a run-up.")
    ] = None,
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
    csv: Annotated[Path | None, typer.Option(help="Write the table to this file as well (.csv).")] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Time a scene's steps by fidelity, with sound and without; say which keeps up and what to change.

    Times are the processor's for one thread, in a loop that does not wait for the clock; late are steps that
    take longer on the clock than they simulate.
    """
    from fmu_bearing.results.table import show, write_csv
    from fmu_bearing.run.realtime import realtime as time_it
    from fmu_bearing.run.step_times import SHORT

    with refusals():
        if speed is not None and run_up is not None:
            raise Refusal("--speed and --run-up are refused together: a speed that is held has no run-up")
        if silent and microphones is not None:
            raise Refusal("--silent and --microphones are refused together: give one of them")
        if csv is not None and csv.suffix != ".csv":
            raise Refusal(f"--csv {csv} is refused: the table is written as .csv")
        if csv is not None:
            check_file(csv)
        held = shaft_speed(speed)
        speeds = (held, held) if held is not None else span(run_up) if run_up is not None else None
        found = time_it(
            scene, step, duration=duration, speeds=speeds, fidelities=split(fidelity),
            microphones=0 if silent else microphones, track=partial(progress, description="fidelities"),
        )  # fmt: skip
        if csv is not None:
            csv.parent.mkdir(parents=True, exist_ok=True)
            write_csv(csv, *found.table())
    if as_json:
        print_json(found.summary() | {"files": [] if csv is None else [csv]})
        return
    steps = found.timed[0].cpu.size
    show(f"{found.scene.name}: {steps} steps of {1e3 * step:g} ms, us of the processor", *found.table(SHORT))
    typer.echo(found.machine)
    typer.echo(found.advice())
    for name, reason in found.left_out.items():
        tell(f"not timed: {name}: {reason}")
    if csv is not None:
        typer.echo(f"written: {csv}")
