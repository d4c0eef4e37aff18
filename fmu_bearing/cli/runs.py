"""``fmu-bearing simulate`` and ``plot``: a run of a scene or an FMU, its results, its pictures."""

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli.base import (
    ENDED_EARLY,
    INTERRUPTED,
    Catalogues,
    Json,
    Refusal,
    app,
    print_json,
    refusals,
    shaft_speed,
)
from fmu_bearing.files import check_file

if TYPE_CHECKING:
    from fmu_bearing.results.result import Run

Source = Annotated[Path, typer.Argument(metavar="SCENE|FMU", help="Scene file (.toml) or FMU (.fmu).")]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", "-s", metavar="NAME=VALUE", help="Start value of an input or parameter, SI units."),
]
Variables = Annotated[
    list[str] | None,
    typer.Option(
        "--variables",
        "-v",
        metavar="NAME,...",
        help="Variables, with commas between or one option each; * matches any text.",
    ),
]


@app.command()
def simulate(
    source: Source,
    stop_time: Annotated[float, typer.Option("--stop-time", "-t", help="End of the run, s.")] = 0.1,
    step: Annotated[float, typer.Option(help="Communication step, s.")] = 1e-3,
    speed: Annotated[float | None, typer.Option(help="Shaft speed, r/min.")] = None,
    inputs: Annotated[
        Path | None,
        typer.Option(
            "--input",
            "-i",
            help="CSV with time (s) and inputs, SI units, or shaft_speed_rpm, oil_temperature_degC.",
        ),
    ] = None,
    settings: Settings = None,
    variables: Variables = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Result to write: .csv as FMPy has it, or .nc.")
    ] = Path("result.csv"),
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Run a scene or an FMU. After a refused step or Ctrl-C the results so far are kept."""
    from fmu_bearing.results import result as results
    from fmu_bearing.run.simulate import EndedEarly, simulate as run_it

    with refusals():
        warnings.simplefilter("ignore", EndedEarly)  # printed below
        check_file(results.check_target(output))  # refused before the run
        turning = shaft_speed(speed)
        start = _settings(settings) | ({} if turning is None else {"shaft_speed": turning})
        run = run_it(
            source, stop_time, step=step, inputs=inputs, start_values=start, outputs=split(variables),
            progress=False if as_json else None,
        )  # fmt: skip
        run.save(output)
        doubted = "" if run.scene is None else _doubt(run, start, inputs is not None)
    if as_json:
        print_json(run.summary() | {"file": output, "doubt": doubted})
    else:
        if run.note:
            typer.echo(f"error: {run.note}", err=True)
        typer.echo(
            f"written: {output}, {len(run)} points to {run.time[-1]:g} s, {len(run.names)} variables, "
            f"in {run.wall:.2g} s"
        )
        if doubted:
            typer.echo(f"{doubted}.")
    if not run.complete:
        raise typer.Exit(INTERRUPTED if run.ended == results.INTERRUPTED else ENDED_EARLY)


@app.command()
def plot(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Result of a run: .csv or .nc.")],
    variables: Variables = None,
    scene: Annotated[
        Path | None,
        typer.Option(help="Scene of the run, for the names of microphones; a result in .nc knows it."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Picture: .png or .svg; default: beside the result.")
    ] = None,
    catalogue: Catalogues = None,
) -> None:
    """Draw variables over time, one panel per unit: speeds in r/min, levels from the first valid sample."""
    from fmu_bearing.results.result import Run
    from fmu_bearing.results.time_pictures import draw
    from fmu_bearing.scene import read_scene

    with refusals():
        run = Run.load(result)
        picture = output or result.with_suffix(".png")
        if scene is not None:
            run.scene = read_scene(scene)
        draw(run, picture, split(variables))
    typer.echo(f"written: {picture}")


def _doubt(run: "Run", start: dict[str, float], table: bool) -> str:
    """Return why a run's figures are in doubt: levels, or all where a ring whirls by itself at its start."""
    from fmu_bearing.modal.campbell.weak import doubt, is_of_levels

    assert run.scene is not None
    found = doubt(run.scene, start)
    if is_of_levels(found) and not any(unit == "dB" for unit in run.units.values()):
        return ""
    return f"at the values of the start, {found}" if table and found else found


def split(options: list[str] | None) -> list[str] | None:
    """Return names from options, each with commas between its names; None where none is given."""
    if not options:
        return None
    return [name.strip() for option in options for name in option.split(",") if name.strip()]


def _settings(settings: list[str] | None) -> dict[str, float]:
    """Return values by name from ``NAME=VALUE``."""
    found = {}
    for setting in settings or ():
        name, equals, text = setting.partition("=")
        try:
            found[name.strip()] = float(text)
        except ValueError:
            equals = ""
        if not equals:
            raise Refusal(f"--set {setting}: write NAME=VALUE with a number in SI units, as preload=300")
    return found
