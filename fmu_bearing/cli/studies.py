"""``fmu-bearing choose``, ``tradeoff``, ``sensitivity``: error against cost, influence of assumed values."""

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
)
from fmu_bearing.files import check_folder


@app.command()
def choose(scene: SceneFile, catalogue: Catalogues = None, as_json: Json = False) -> None:
    """Find the cheapest fidelity, method and step within the scene's accuracy; print all candidates."""
    from fmu_bearing.run import choose as choosing
    from fmu_bearing.run.table import show
    from fmu_bearing.scene import read_scene

    with refusals():
        choice = choosing.chosen(read_scene(scene))
    if as_json:
        print_json({"chosen": choice.summary, "candidates": named(choosing.COLUMNS, choice.cells())})
    else:
        show(f"{choice.scene}: errors against fidelity full", choosing.COLUMNS, choice.cells())
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
    from fmu_bearing.run.pictures import check_picture
    from fmu_bearing.run.table import show

    with refusals():
        # told before minutes of measuring
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
    from fmu_bearing.run.table import show

    with refusals():
        check_folder(output)  # told before minutes of measuring
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


def named(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[dict[str, str]]:
    """Rows of a table with their columns' names."""
    return [dict(zip(columns, row, strict=True)) for row in rows]
