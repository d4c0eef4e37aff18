"""``fmu-bearing choose``, ``tradeoff``, ``sensitivity``, ``changes``: accuracy, what figures rest on."""

import textwrap
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli.base import (
    Catalogues,
    Folder,
    Json,
    Quick,
    SceneFile,
    app,
    print_json,
    progress,
    refusals,
    tell,
)
from fmu_bearing.files import check_folder


@app.command()
def choose(scene: SceneFile, catalogue: Catalogues = None, as_json: Json = False) -> None:
    """Find the cheapest fidelity, method and step within the scene's accuracy; print all candidates."""
    from fmu_bearing.results.table import show
    from fmu_bearing.run import choose as choosing
    from fmu_bearing.scene import read_scene

    with refusals():
        choice = choosing.chosen(read_scene(scene))
    if as_json:
        print_json({"chosen": choice.summary, "candidates": named(choosing.COLUMNS, choice.cells())})
    else:
        where = " / ".join(choice.probed)
        show(f"{choice.scene}: errors against fidelity full at {where}", choosing.SHORT, choice.table())
        typer.echo(choice.summary)


@app.command()
def tradeoff(
    scene: SceneFile,
    output: Folder = Path("out/tradeoff"),
    quick: Quick = False,
    chart: Annotated[
        Path | None, typer.Option(help="Chart to write; default: tradeoff.png in the folder.")
    ] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Measure error and speed of fidelities, methods, steps, strips and terms; write table and chart."""
    from fmu_bearing.accuracy import tradeoff as trading
    from fmu_bearing.accuracy.chart import draw
    from fmu_bearing.extras import need
    from fmu_bearing.results.picture_parts import check_picture
    from fmu_bearing.results.table import show

    with refusals():
        # refused before minutes of measuring
        need("matplotlib", "the chart")
        check_folder(output)
        chart = check_picture(chart or output / "tradeoff.png")
        bar = partial(progress, description="variants")
        if quick:
            study = trading.tradeoff(
                scene, trading.QUICK, warm_up=0.005, window=0.005, budget=0.01, track=bar
            )
        else:
            study = trading.tradeoff(scene, track=bar)
        trading.write(study, output)
        draw(study, chart)
    files = [output / "tradeoff.md", output / "tradeoff.csv", chart]
    if as_json:
        print_json({"settings": named(trading.COLUMNS, study.cells()), "files": files})
    else:
        show(f"{study.scene}: accuracy and cost", trading.COLUMNS, study.cells())
        typer.echo(f"written: {', '.join(map(str, files))}")


@app.command()
def sensitivity(
    scene: SceneFile,
    output: Folder = Path("out/sensitivity"),
    quick: Quick = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Change every assumed value of a scene, one at a time, and print the effect."""
    from fmu_bearing.accuracy import sensitivity as moving
    from fmu_bearing.results.table import show

    with refusals():
        check_folder(output)  # refused before minutes of measuring
        bar = partial(progress, description="moves")
        if quick:
            study = moving.sensitivity(scene, moving.QUICK, warm_up=0.005, window=0.005, track=bar)
        else:
            study = moving.sensitivity(scene, track=bar)
        moving.write(study, output)
    files = [output / "sensitivity.md", output / "sensitivity.csv"]
    if as_json:
        print_json({"moves": named(moving.COLUMNS, study.cells()), "files": files})
    else:
        show(f"{study.scene}: what rests on assumed values", moving.COLUMNS, study.cells())
        typer.echo(f"written: {', '.join(map(str, files))}")


@app.command()
def changes(
    scene: SceneFile,
    seeds: Annotated[int, typer.Option(help="Draws of the surfaces with which levels are compared.")] = 5,
    levels: Annotated[
        bool, typer.Option("--levels/--no-levels", help="Levels take nearly all of the time.")
    ] = True,
    radiation_model: Annotated[
        str | None, typer.Option(metavar="NAME", help="How sound is radiated; default: the scene's.")
    ] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Change one choice of a designer at a time; rank the effects on level, life and friction torque."""
    from fmu_bearing.accuracy.changes import changes as changing
    from fmu_bearing.results.table import show

    with refusals():
        found = changing(scene, seeds=seeds, levels=levels, radiation_model=radiation_model, tell=tell)
    if as_json:
        print_json(found.summary())
        return
    show(f"{found.scene.name}: what to change", *found.table())
    for line in (f"unchanged: {found.unchanged()}", found.resonance(), found.conditions(), *found.remarks()):
        if line:
            typer.echo(textwrap.fill(line, 80))


def named(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[dict[str, str]]:
    """Rows of a table with their columns' names."""
    return [dict(zip(columns, row, strict=True)) for row in rows]
