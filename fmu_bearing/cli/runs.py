"""``fmu-bearing simulate`` and ``plot``: a run of a scene or an FMU, its results, its pictures."""

import warnings
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.settings import changed, start_of
from fmu_bearing.engine.constants import RPM
from fmu_bearing.files import rescued

if TYPE_CHECKING:
    from fmu_bearing.results.result import Run
    from fmu_bearing.scene import Scene

Source = Annotated[Path, typer.Argument(metavar="SCENE|FMU", help="Scene file (.toml) or FMU (.fmu).")]


@base.app.command()
def simulate(
    source: Source,
    stop_time: Annotated[float, typer.Option("--stop-time", "-t", help="End of the run, s.")] = 0.1,
    step: options.Step = 1e-3,
    settle: Annotated[
        float, options.settle("; default 0: a result begins with the steady state it starts from")
    ] = 0.0,
    speed: options.Speed = None,
    fidelity: options.Fidelity = None,
    inputs: Annotated[
        Path | None,
        typer.Option(
            "--input",
            "-i",
            help="CSV with time (s) and inputs, SI units, or shaft_speed_rpm, oil_temperature_degC.",
        ),
    ] = None,
    input_from_start: Annotated[
        bool, typer.Option("--input-from-start", help="Shift the times of --input so that the first is 0.")
    ] = False,
    settings: options.Settings = None,
    variables: options.Variables = None,
    plot: options.Plot = None,
    output: Annotated[Path, options.output("Result to write: .csv as FMPy has it, .nc, or .uff.")] = Path(
        "result.csv"
    ),
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Run a scene or an FMU. After a refused step or Ctrl-C the results so far are kept."""
    from fmu_bearing.results import result as results
    from fmu_bearing.results.time_pictures import draw
    from fmu_bearing.run.simulate import EndedEarly, simulate as run_it

    with base.refusals():
        warnings.simplefilter("ignore", EndedEarly)  # printed below
        results.check_target(output, endings=results.WRITTEN)  # refused before the run
        base.check_new(force, output, plot)
        if settle and not 0.0 < settle < stop_time:
            raise base.Refusal(f"--settle {settle:g} s is refused: allowed are 0 to less than --stop-time")
        if input_from_start and inputs is None:
            raise base.Refusal(
                "--input-from-start is refused: it shifts the times of --input, which is not given"
            )
        chosen, start, whose = _begun(source, settings, fidelity)
        turning = base.shaft_speed(speed, whose)
        if (asked := start.get("shaft_speed")) is not None:
            base.shaft_speed(asked / RPM, whose, "--set shaft_speed_rpm")
        start |= {} if turning is None else {"shaft_speed": turning}
        run = run_it(
            chosen, stop_time, step=step, inputs=inputs, input_from_start=input_from_start,
            start_values=start, outputs=split(variables),
        )  # fmt: skip
        if settle and run.time[-1] >= settle:
            run = replace(run, table=run.table[run.time >= settle])
        with base.Writing() as files:
            rescued(run.save, output)
            files.append(output)
        with files:
            if plot is not None:
                draw(run, plot, split(variables))
                files.append(plot)
        doubted = "" if run.scene is None else _doubt(run, start, inputs is not None)
    if as_json:
        base.print_json(run.summary() | {"files": files, "doubt": doubted})
    else:
        if run.note:
            typer.echo(f"error: {run.note}", err=True)
        if files:
            typer.echo(
                f"written: {', '.join(map(str, files))}, {len(run)} points to {run.time[-1]:g} s, "
                f"{len(run.names)} variables, in {run.wall:.2g} s"
            )
        if doubted:
            typer.echo(f"{doubted}.")
    early = base.INTERRUPTED if run.ended == results.INTERRUPTED else base.ENDED_EARLY
    base.end(0 if run.complete else early, files)


@base.app.command()
def plot(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Result of a run: .csv or .nc.")],
    variables: options.Variables = None,
    scene: Annotated[
        Path | None,
        typer.Option(help="Scene of the run, for the names of microphones; a result in .nc knows it."),
    ] = None,
    output: Annotated[
        Path | None, options.output("Picture: .png, .svg or .pdf; default: beside the result.")
    ] = None,
    force: options.Force = False,
    catalogue: options.Catalogues = None,
) -> None:
    """Draw variables over time, one panel per unit: speeds in r/min, levels from the first valid sample."""
    from fmu_bearing.results.result import Run
    from fmu_bearing.results.time_pictures import draw
    from fmu_bearing.scene import read_scene

    with base.refusals():
        run = Run.load(result)
        picture = output or result.with_suffix(".png")
        base.check_new(force, picture)
        if scene is not None:
            run.scene = read_scene(scene)
        draw(run, picture, split(variables))
    typer.echo(f"written: {picture}")


def _doubt(run: "Run", start: dict[str, float], table: bool) -> str:
    """Return why a run's figures are in doubt: those that it has of levels and velocities, or all of them."""
    from fmu_bearing.cautions import in_doubt, largest_of
    from fmu_bearing.modal.campbell.doubts import doubt, is_of_levels, is_of_motion

    assert run.scene is not None
    found = doubt(run.scene, start)
    units = set(run.units.values())
    if is_of_levels(found) and "dB" not in units or is_of_motion(found) and not units & {"dB", "m/s"}:
        found = ""
    elif table and found:
        found = f"at the values of the start, {found}"
    return in_doubt(largest_of(run.names, run.__getitem__), found)


def split(options: list[str] | None) -> list[str] | None:
    """Return names from options, each with commas between its names; None where none is given."""
    if not options:
        return None
    return [name.strip() for option in options for name in option.split(",") if name.strip()]


def _begun(
    source: Path, settings: list[str] | None, fidelity: str | None
) -> tuple["Path | Scene", dict[str, float], "Path | Scene"]:
    """Return what is run, with keys and fidelity of the command line, the values it starts with, its scene.

    The scene of an FMU is the one inside; of another tool's FMU it is the FMU itself.
    """
    from fmu_bearing.interface.parameters import parameters
    from fmu_bearing.run.simulate_fmu import open_fmu
    from fmu_bearing.scene.read import read_scene, with_fidelity

    if source.suffix == ".fmu":
        if fidelity is not None:
            raise base.Refusal(f"--fidelity is refused: that of {source} was settled when it was built")
        player = open_fmu(source)
        units = {name: one.unit for name, one in player.inputs.items()}
        return source, start_of(settings, units, player.settable), player.scene or source
    if not settings and fidelity is None:
        return source, {}, source
    scene = read_scene(source)
    scene = scene if fidelity is None else with_fidelity(scene, model=fidelity)
    scene, start = changed(scene, settings, [variable.name for variable in parameters(scene)])
    return scene, start, scene
