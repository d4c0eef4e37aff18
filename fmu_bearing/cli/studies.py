"""``fmu-bearing choose``, ``tradeoff``, ``sensitivity``, ``changes``: accuracy, what figures rest on."""

import textwrap
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli.base import app, check_new, check_new_in, print_json, refusals, tell
from fmu_bearing.cli.options import (
    SEEDS,
    Catalogues,
    Fidelity,
    Folder,
    Force,
    Json,
    Plot,
    Quick,
    RadiationModel,
    SceneFile,
    Seeds,
    Settings,
    Speed,
    settle as time_left_out,
)
from fmu_bearing.cli.settings import at_speed, source_of
from fmu_bearing.files import check_folder
from fmu_bearing.progress import steps, work

#: s: the windows of a quick study.
_QUICK = 0.005


@app.command()
def choose(
    scene: SceneFile,
    speed: Speed = None,
    settings: Settings = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Find the cheapest fidelity, method and step within the scene's accuracy; print all candidates.

    What is chosen is kept, and an FMU of fidelity auto names it: its short runs are always the same, without
    --settle.
    """
    from fmu_bearing.results.table import show
    from fmu_bearing.run import choose as choosing
    from fmu_bearing.scene import scene_of

    with refusals(), work("short runs of all candidates"):
        choice = choosing.chosen(scene_of(source_of(scene, at_speed(speed, settings))))
    if as_json:
        print_json({"chosen": choice.summary, "candidates": named(choosing.COLUMNS, choice.cells())})
    else:
        where = " / ".join(choice.probed)
        show(f"{choice.scene}: errors against fidelity full at {where}", choosing.SHORT, choice.table())
        typer.echo(choice.summary)


@app.command()
def tradeoff(
    scene: SceneFile,
    settle: Annotated[
        float | None,
        time_left_out("; default 0.05, the reference takes most of the time; 0.005 with --quick"),
    ] = None,
    speed: Speed = None,
    settings: Settings = None,
    quick: Quick = False,
    plot: Plot = None,
    output: Folder = Path("out/tradeoff"),
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Measure error and speed of fidelities, methods, steps, strips and terms; write table and chart.

    The chart is tradeoff.png in the folder, or the file of --plot. All fidelities are measured, so there is
    no --fidelity.
    """
    from fmu_bearing.accuracy import tradeoff as trading
    from fmu_bearing.accuracy.chart import draw
    from fmu_bearing.extras import need
    from fmu_bearing.results.picture_parts import check_picture
    from fmu_bearing.results.table import show

    with refusals():
        # refused before minutes of measuring
        need("matplotlib", "the chart")
        check_folder(output)
        chart = check_picture(plot or output / "tradeoff.png")
        check_new(force, chart)
        check_new_in(force, output, "tradeoff.md", "tradeoff.csv")
        source = source_of(scene, at_speed(speed, settings))
        times: dict[str, float] = {"warm_up": _QUICK, "window": _QUICK, "budget": 0.01} if quick else {}
        times |= {} if settle is None else {"warm_up": settle}
        with work(f"tradeoff of {scene.stem}"):
            study = trading.tradeoff(
                source, trading.QUICK if quick else trading.SETTINGS, track=partial(steps, what="variants"),
                **times,
            )  # fmt: skip
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
    settle: Annotated[
        float | None, time_left_out("; default 0.03, for some fifty short runs; 0.005 with --quick")
    ] = None,
    speed: Speed = None,
    settings: Settings = None,
    quick: Quick = False,
    output: Folder = Path("out/sensitivity"),
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Change every assumed value of a scene, one at a time, and print the effect.

    All runs have fidelity full, so there is no --fidelity.
    """
    from fmu_bearing.accuracy import sensitivity as moving
    from fmu_bearing.results.table import show

    with refusals():
        check_folder(output)  # refused before minutes of measuring
        check_new_in(force, output, "sensitivity.md", "sensitivity.csv")
        source = source_of(scene, at_speed(speed, settings))
        times: dict[str, float] = {"warm_up": _QUICK, "window": _QUICK} if quick else {}
        times |= {} if settle is None else {"warm_up": settle}
        with work(f"sensitivity of {scene.stem}"):
            study = moving.sensitivity(
                source, moving.QUICK if quick else tuple(moving.ASSUMED), track=partial(steps, what="moves"),
                **times,
            )  # fmt: skip
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
    seeds: Seeds = SEEDS,
    levels: Annotated[
        bool, typer.Option("--levels/--no-levels", help="Levels take nearly all of the time.")
    ] = True,
    speed: Speed = None,
    settings: Settings = None,
    fidelity: Fidelity = None,
    radiation_model: RadiationModel = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Change one choice of a designer at a time; rank the effects on level, life and friction torque.

    Levels are differences of short runs with the same seeds, whose length follows from the speed: there is
    no --settle.
    """
    from fmu_bearing.accuracy.changes import changes as changing
    from fmu_bearing.results.table import show

    with refusals(), work(f"changes of {scene.stem}"):
        source = source_of(scene, at_speed(speed, settings), fidelity)
        found = changing(source, seeds=seeds, levels=levels, radiation_model=radiation_model, tell=tell)
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
