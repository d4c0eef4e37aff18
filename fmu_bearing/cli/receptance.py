"""``fmu-bearing receptance``: motion of the nose per force on it, over frequency."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli import base
from fmu_bearing.cli.options import (
    Catalogues,
    Force,
    Json,
    Plot,
    Preloads,
    SceneFile,
    Settings,
    Speeds,
    output as written_to,
)
from fmu_bearing.cli.settings import changed, numbers
from fmu_bearing.files import check_file
from fmu_bearing.progress import steps

if TYPE_CHECKING:
    from fmu_bearing.modal.receptance.receptance_table import Place
    from fmu_bearing.modal.receptance.scene_receptance import Receptance


@base.app.command()
def receptance(
    scene: SceneFile,
    speeds: Speeds = None,
    preloads: Preloads = None,
    frequencies: Annotated[
        str | None, typer.Option(metavar="VALUES", help="Hz, same syntax; default: 20:5000:2491.")
    ] = None,
    at: Annotated[str, typer.Option(metavar="NAME", help="nose, or tip of the scene's [tool].")] = "nose",
    settings: Settings = None,
    plot: Plot = None,
    output: Annotated[
        Path | None, written_to("Numbers: .csv, or .uff for modal analysis; default: none.")
    ] = None,
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Compute the receptance of the nose, motion per force, over frequency, speed and preload.

    All of its five motions and forces are in the files: along the axis, across it, tilts. Of a single bearing
    the nose is the inner ring with its rotor. The table has the stiffness at the lowest frequency and at the
    peak, and how much the nose moves across a force.
    """
    from fmu_bearing.modal.receptance.receptance_files import ENDINGS
    from fmu_bearing.modal.receptance.scene_receptance import receptance as table_of
    from fmu_bearing.scene import read_scene

    with base.refusals():
        place = _place(at)
        asked = {
            name: numbers(name, text)
            for name, text in (("speeds", speeds), ("preloads", preloads), ("frequencies", frequencies))
        }
        given = read_scene(scene)
        for speed in asked["speeds"] or ():
            base.shaft_speed(speed, given, "--speeds")
        if output is not None:
            check_file(output, ENDINGS, "a receptance")
        base.check_new(force, output, plot)
        chosen, inputs = changed(given, settings)
        table, code = base.so_far(partial(
            table_of, chosen, asked["frequencies"], speeds=asked["speeds"], preloads=asked["preloads"],
            inputs=inputs, at=place, track=partial(steps, what="receptance", unit="speeds"),
        ))  # fmt: skip
        files = write(table, output, plot)
    if as_json:
        base.print_json(table.summary() | {"files": files})
        return base.end(code, files)
    show(table)
    base.end(code, files, named=True)


def _place(text: str) -> "Place":
    if text not in ("nose", "tip"):
        raise base.Refusal(f"--at {text} is refused: it is nose or tip")
    return "tip" if text == "tip" else "nose"


def write(table: "Receptance", output: Path | None, plot: Path | None) -> base.Writing:
    """Write the files that are asked for and return them."""
    with base.Writing() as files:
        if output is not None:
            files.append(table.save(output))
        files.draw(table.picture, plot)
    return files


def show(table: "Receptance") -> None:
    """Print the peaks of a receptance and its cautions."""
    from fmu_bearing.modal.receptance.receptance_picture import WHERE
    from fmu_bearing.modal.receptance.receptance_table import Peak
    from fmu_bearing.results.base import table as rows_of

    title = f"{table.scene.name}: the {WHERE[table.place]}, from {table.frequencies[0]:g} Hz"
    base.show(title, *rows_of(Peak, table.peaks()))
    for line in table.cautions():
        base.tell(f"caution: {line}")
