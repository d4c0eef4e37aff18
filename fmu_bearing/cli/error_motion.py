"""``fmu-bearing error-motion``: synchronous and asynchronous error motion of the nose over speeds."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli import base
from fmu_bearing.cli.options import (
    Catalogues,
    Fidelity,
    Folder,
    Force,
    Json,
    Plot,
    SceneFile,
    Settings,
    Speeds,
)
from fmu_bearing.cli.settings import changed, numbers
from fmu_bearing.progress import steps

_PERCENT = 100.0


@base.app.command()
def error_motion(
    scene: SceneFile,
    speeds: Speeds = None,
    at: Annotated[
        float,
        typer.Option(
            "--at",
            metavar="MM",
            help="Place of the point: from the middle of a bearing; of a set from the nose, negative: ahead.",
        ),
    ] = 0.0,
    revolutions: Annotated[
        int | None, typer.Option(help="20 or more; default: 20 to 120, in which the cages turn most wholly.")
    ] = None,
    against: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="outer ring (default of a single bearing) or ground (of a set)."),
    ] = None,
    direction: Annotated[str, typer.Option(metavar="NAME", help="Of the polar plot.")] = "rotating",
    settings: Settings = None,
    fidelity: Fidelity = None,
    plot: Plot = None,
    output: Folder = Path("out/error-motion"),
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Compute error motion of the axis of rotation: synchronous, asynchronous, its lines and sources.

    Terms follow ISO 230-7, whose text was not at hand. --plot writes the polar plot, as polar.png in the
    folder, to a file.
    """
    from fmu_bearing.extras import available
    from fmu_bearing.files import check_folder
    from fmu_bearing.metrology.at_speed import DIRECTIONS
    from fmu_bearing.metrology.error_motion import FILES, error_motion as computed
    from fmu_bearing.scene.read import read_scene, with_fidelity

    with base.refusals():
        if direction not in DIRECTIONS:
            raise base.Refusal(f"--direction {direction} is refused: it is {', '.join(DIRECTIONS)}")
        rpm = numbers("speeds", speeds)
        given = read_scene(scene)
        for speed in rpm or ():
            base.shaft_speed(speed, given, "--speeds")
        check_folder(output)
        base.check_new_in(force, output, *FILES)
        base.check_new(force, plot)
        chosen, inputs = changed(given, settings)
        chosen = chosen if fidelity is None else with_fidelity(chosen, model=fidelity)
        motion, code = base.so_far(partial(
            computed, chosen, rpm, 1e-3 * at, revolutions, against, inputs=inputs,  # type: ignore[arg-type]
            track=partial(steps, what="error motion", unit="speeds"),
        ))  # fmt: skip
        drawn = available("matplotlib", "a picture", "no polar.png", base.tell)
        with base.Writing() as files:
            files += motion.save(output, direction, picture=drawn)
            files.draw(partial(motion.polar, direction), plot)
    if as_json:
        base.print_json(motion.summary() | {"files": files})
        return base.end(code, files)
    place = f"{motion.scene.name} at {at:g} mm, against the {motion.against}"
    base.show(f"error motion, {place}", *motion.table())
    base.show("largest lines, amplitudes", *motion.lines())
    if len(motion.speeds[0].nose.rates) > 1:
        base.show("asynchronous width, lines of one bearing alone", *motion.per_bearing())
    base.show("asynchronous width, lines of one source alone", *motion.per_source())
    for one in motion.speeds:
        typer.echo(
            f"{one.rpm:g} r/min: the lines hold {_PERCENT * one.explained:.0f} % of the energy of the "
            "asynchronous radial motion"
        )
    for line in motion.remarks():
        base.tell(f"remark: {line}")
    base.end(code, files, named=True)
