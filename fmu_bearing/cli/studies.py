"""``fmu-bearing choose``, ``tradeoff``, ``sensitivity``, ``changes``: accuracy, what figures rest on."""

import textwrap
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli import base, options
from fmu_bearing.cli.settings import at_speed, source_of
from fmu_bearing.cli.several import Study, several
from fmu_bearing.files import check_folder
from fmu_bearing.progress import steps, work

if TYPE_CHECKING:
    from fmu_bearing.scene import Scene

#: s: the windows of a quick study.
_QUICK = 0.005


@base.app.command()
def choose(
    scene: options.SceneFile,
    speed: options.Speed = None,
    settings: options.Settings = None,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Find the cheapest fidelity, method and step within the scene's accuracy; print all candidates.

    What is chosen is kept, and an FMU of fidelity auto names it: its short runs are always the same, without
    --settle.
    """
    from fmu_bearing.run import choose as choosing
    from fmu_bearing.scene import scene_of

    with base.refusals(), work("short runs of all candidates"):
        choice, code = base.so_far(
            partial(choosing.chosen, scene_of(source_of(scene, at_speed(speed, settings, scene))))
        )
    if as_json:
        base.print_json(choice.summary())
    else:
        where = " / ".join(choice.probed)
        base.show(f"{choice.scene}: errors against fidelity full at {where}", *choice.table())
        typer.echo(choosing.LEGEND)
        if choice.chosen != choosing.NONE:
            typer.echo(choice.words())
    base.end(code)


@base.app.command()
def tradeoff(
    scene: options.SceneFile,
    settle: Annotated[
        float | None,
        options.settle("; default 0.05, the reference takes most of the time; 0.005 with --quick"),
    ] = None,
    speed: options.Speed = None,
    settings: options.Settings = None,
    quick: options.Quick = False,
    plot: options.Plot = None,
    output: options.Folder = Path("out/tradeoff"),
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Measure error and speed of fidelities, methods, steps, strips and terms; write table and chart.

    The chart is tradeoff.png in the folder, or the file of --plot. All fidelities are measured, so there is
    no --fidelity.
    """
    from fmu_bearing.accuracy import tradeoff as trading
    from fmu_bearing.accuracy.chart import draw
    from fmu_bearing.extras import need
    from fmu_bearing.results.picture_parts import check_picture

    with base.refusals():
        # refused before minutes of measuring
        need("matplotlib", "the chart")
        check_folder(output)
        chart = check_picture(plot or output / "tradeoff.png")
        base.check_new(force, chart)
        base.check_new_in(force, output, "tradeoff.md", "tradeoff.csv")
        source = source_of(scene, at_speed(speed, settings, scene))
        times: dict[str, float] = {"warm_up": _QUICK, "window": _QUICK, "budget": 0.01} if quick else {}
        times |= {} if settle is None else {"warm_up": settle}
        with work(f"tradeoff of {scene.stem}"):
            study, code = base.so_far(partial(
                trading.tradeoff, source, trading.QUICK if quick else trading.SETTINGS,
                track=partial(steps, what="variants"), **times,
            ))  # fmt: skip
        with base.Writing() as files:
            files += study.write(output)
            draw(study, chart)
            files.append(chart)
    if as_json:
        base.print_json(study.summary() | {"files": files})
    else:
        base.show(f"{study.scene}: accuracy and cost", *study.short())
        typer.echo(study.advice)
        typer.echo("All columns, and settings with fewer strips or terms, are in the file.")
    base.end(code, files, named=not as_json)


@base.app.command()
def sensitivity(
    scene: options.SceneFile,
    method: Annotated[
        str | None,
        typer.Option(
            "--method",
            metavar="NAME",
            help="morris or sobol: the values of --vary vary together; default: each assumed value alone.",
        ),
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            "--vary",
            metavar="KEY=LOW..HIGH",
            help="With --method: a range, KEY=LOW..HIGH or KEY=LOW..HIGHlog, KEY as of a sweep's axis; two "
            "or more, one option each.",
        ),
    ] = None,
    samples: Annotated[
        int | None,
        typer.Option(
            "--samples",
            metavar="N",
            help="With --method: N (keys + 1) runs for morris, default 16; N (keys + 2) for sobol, a power "
            "of two, default 64.",
        ),
    ] = None,
    variables: options.Figures = None,
    settle: Annotated[
        float | None,
        options.settle("; default 0.03, for some fifty short runs, 0.02 with --method; 0.005 with --quick"),
    ] = None,
    window: Annotated[
        float | None,
        typer.Option(
            "--window",
            metavar="S",
            help="Time over which figures are read, s; default 0.06, 0.1 with --method; 0.005 with --quick.",
        ),
    ] = None,
    workers: options.Workers = None,
    speed: options.Speed = None,
    settings: options.Settings = None,
    quick: options.Quick = False,
    plot: options.Plot = None,
    output: options.Folder = Path("out/sensitivity"),
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Change every assumed value of a scene, one at a time, or some of any kind at once; print the effect.

    One at a time, all runs have fidelity full, so there is no --fidelity; with --method they have the
    scene's. The options --vary, --samples, --variables, --workers and --plot go with --method; the picture is
    sensitivity.png in the folder, or the file of --plot. Finished runs are kept there: the same command goes
    on where an earlier one was interrupted.
    """
    times: dict[str, float] = {"settle": _QUICK, "window": _QUICK} if quick else {}
    given = {"settle": settle, "window": window}
    times |= {name: value for name, value in given.items() if value is not None}
    with base.refusals():
        check_folder(output)  # refused before minutes of measuring
        source = partial(source_of, scene, at_speed(speed, settings, scene))
        if method is None:
            of_several = {
                "--vary": vary, "--samples": samples, "--variables": variables, "--workers": workers,
                "--plot": plot,
            }  # fmt: skip
            for name, value in of_several.items():
                if value is not None:
                    raise base.Refusal(f"{name} needs --method morris or --method sobol")
            base.check_new_in(force, output, "sensitivity.md", "sensitivity.csv")
            _each_alone(source(), scene.stem, times, quick, output, as_json)
        else:
            study = Study(
                method, vary or [], 4 if quick and samples is None else samples, variables, times, workers
            )
            several(source(), study, plot, output, force, as_json)


def _each_alone(
    source: "Path | Scene", name: str, times: dict[str, float], quick: bool, output: Path, as_json: bool
) -> None:  # fmt: skip
    """Change one assumed value at a time."""
    from fmu_bearing.accuracy import sensitivity as moving

    keys = moving.QUICK if quick else tuple(moving.ASSUMED)
    spans = {"warm_up" if one == "settle" else one: value for one, value in times.items()}
    with work(f"sensitivity of {name}"):
        study, code = base.so_far(
            partial(moving.sensitivity, source, keys, track=partial(steps, what="moves"), **spans)
        )
    with base.Writing() as files:
        files += study.write(output)
    if as_json:
        base.print_json(study.summary() | {"files": files})
    else:
        base.show(f"{study.scene}: what rests on assumed values", *study.table())
    base.end(code, files, named=not as_json)


@base.app.command()
def changes(
    scene: options.SceneFile,
    seeds: options.Seeds = options.SEEDS,
    levels: Annotated[
        bool, typer.Option("--levels/--no-levels", help="Levels take nearly all of the time.")
    ] = True,
    speed: options.Speed = None,
    settings: options.Settings = None,
    fidelity: options.Fidelity = None,
    radiation_model: options.RadiationModel = None,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Change one choice of a designer at a time; rank the effects on level, life and friction torque.

    Levels are differences of short runs with the same seeds, whose length follows from the speed: there is
    no --settle.
    """
    from fmu_bearing.accuracy.changes import changes as changing

    with base.refusals(), work(f"changes of {scene.stem}"):
        source = source_of(scene, at_speed(speed, settings, scene), fidelity)
        study, code = base.so_far(partial(
            changing, source, seeds=seeds, levels=levels, radiation_model=radiation_model, tell=base.tell
        ))  # fmt: skip
    if as_json:
        base.print_json(study.summary())
        return base.end(code)
    base.show(f"{study.scene.name}: what to change", *study.table())
    for line in (f"unchanged: {study.unchanged()}", study.resonance(), study.conditions(), *study.remarks()):
        if line:
            typer.echo(textwrap.fill(line, 80))
    base.end(code)
