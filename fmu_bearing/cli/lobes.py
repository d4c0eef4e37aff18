"""``fmu-bearing lobes``: how deep a spindle may cut before it chatters, over speed."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli import base
from fmu_bearing.cli.options import Catalogues, Force, Json, Plot, SceneFile, Settings, output as written_to
from fmu_bearing.cli.settings import AXIS as _SYNTAX, changed, numbers
from fmu_bearing.files import check_file
from fmu_bearing.progress import steps

_SHOWN = 8  # pockets in the table


@base.app.command()
def lobes(
    scene: SceneFile,
    speeds: Annotated[
        str | None,
        typer.Option(
            metavar="VALUES", help=f"r/min: {_SYNTAX}; default: 401 from a quarter to 1.25 of the scene's."
        ),
    ] = None,
    frequencies: Annotated[
        str | None,
        typer.Option(metavar="VALUES", help="Hz of chatter, same syntax; default: 20:5000:2491."),
    ] = None,
    settings: Settings = None,
    plot: Plot = None,
    output: Annotated[Path | None, written_to("Limits over speed, .csv; default: none.")] = None,
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Compute how deep the scene's [milling] may cut over speed, before it chatters (zero order).

    The receptance is that of the tip of [tool], or of the nose without one, with its cross terms, at each
    speed. The table has the deepest cuts between lobes, the last line the verdict on the scene's own cut.
    """
    from fmu_bearing.machining.stability import lobes as computed
    from fmu_bearing.scene import read_scene

    with base.refusals():
        asked = {
            name: numbers(name, text) for name, text in (("speeds", speeds), ("frequencies", frequencies))
        }
        given = read_scene(scene)
        for speed in asked["speeds"] or ():
            base.shaft_speed(speed, given, "--speeds")
        if output is not None:
            check_file(output, ".csv", "a table of lobes")
        base.check_new(force, output, plot)
        chosen, inputs = changed(given, settings)
        found = computed(
            chosen, asked["speeds"], frequencies=asked["frequencies"], inputs=inputs,
            track=partial(steps, what="receptance", unit="speeds"),
        )  # fmt: skip
        with base.Writing() as files:
            if output is not None:
                files.append(found.save(output))
            files.draw(found.picture, plot)
    if as_json:
        base.print_json(found.summary() | {"files": files})
        return base.end(0, files)
    from fmu_bearing.machining.lobes_result import Limit
    from fmu_bearing.results.base import table

    if pockets := found.pockets()[:_SHOWN]:
        base.show(f"{found.scene.name}: deepest between lobes", *table(Limit, pockets))
    typer.echo(found.verdict().replace("; ", ";\n"))
    for line in found.cautions():
        base.tell(f"caution: {line}")
    base.end(0, files, named=True)
