"""``fmu-bearing vibration``: the vibration test of a bearing by itself."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli import base, inverse
from fmu_bearing.cli.options import Catalogues, Fidelity, Folder, Force, Json, Settings
from fmu_bearing.cli.settings import scene_with
from fmu_bearing.files import check_folder
from fmu_bearing.progress import steps
from fmu_bearing.scene.template import MATERIALS

SEEDS = 8  # draws of the surfaces
_SHOWN = 4  # lines of a band


@base.app.command()
def vibration(
    source: Annotated[
        str,
        typer.Argument(
            metavar="SCENE|BEARING",
            help="Scene (.toml), of a set its bearing; or a bearing of the catalogue.",
        ),
    ],
    kind: Annotated[
        str | None,
        typer.Option(
            metavar="|".join(MATERIALS),
            help="Materials of a bearing by name; default: what its designation says.",
        ),
    ] = None,
    grade: Annotated[
        str | None,
        typer.Option(
            help="Tolerance class of the surfaces; default: the scene's own, of a bearing by name P4."
        ),
    ] = None,
    seeds: Annotated[int, typer.Option(help="Draws of the surfaces, the first one the scene's own.")] = SEEDS,
    limits: Annotated[
        str | None, typer.Option(metavar="L,M,H", help="What the bands may have, in the unit of --unit.")
    ] = None,
    unit: Annotated[
        str, typer.Option(metavar="um/s|anderon", help="Of --limits, the table and the picture.")
    ] = "um/s",
    rigid: Annotated[
        bool, typer.Option("--rigid", help="Rings stay round: for comparison, they read too little.")
    ] = False,
    load: Annotated[
        float | None, typer.Option(metavar="N", help="Axial load, N; default: by the outside diameter.")
    ] = None,
    speed: Annotated[
        float | None,
        typer.Option("--speed", metavar="RPM", help="Shaft speed, r/min; default: by the outside diameter."),
    ] = None,
    measured: inverse.Values = None,
    line: inverse.Lines = None,
    std: inverse.Deviation = None,
    at_most: inverse.AtMost = False,
    exact_law: inverse.ExactLaw = False,
    settings: Settings = None,
    fidelity: Fidelity = None,
    output: Folder = Path("out/vibration"),
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Run the vibration test of a bearing: velocity of the outer ring in the bands L, M and H, um/s rms.

    The inner ring turns on an arbor, the outer ring rests on a loading piece, soft or firm, and is read at
    three places. Shown are both pieces with their range over the seeds, and each source of vibration alone.
    Written are bands.png, lines.csv (the strongest lines, named, with what makes them) and spectrum.csv.
    Speed, loads, arbor and loading pieces are assumed.

    With --measured the way is the other one: from values of a supplier's test to the surfaces.
    """
    from fmu_bearing.extras import need
    from fmu_bearing.vibration_test.anderon import UNITS
    from fmu_bearing.vibration_test.files import FILES
    from fmu_bearing.vibration_test.subject import subject
    from fmu_bearing.vibration_test.vibration import vibration as test

    asked = inverse.Asked(measured, line or (), std, at_most, exact_law)
    with base.refusals():
        known = {str(one): one for one in UNITS}
        if unit not in known:
            raise base.Refusal(f"--unit {unit} is refused: it is {' or '.join(UNITS)}")
        _check_rig(settings)
        asked.refuse_alone()
        bearing = scene_with(subject(source, kind, grade), settings, fidelity)
        base.shaft_speed(speed, bearing)
        if measured is not None:
            inverse.unused({"--limits": limits, "--rigid": rigid, "--seeds": seeds != SEEDS})
            inverse.find(bearing, asked, output, force, known[unit], speed, load, as_json)
            return
        check_folder(output)
        base.check_new_in(force, output, *FILES)
        need("matplotlib", "a picture")
        allowed = None if limits is None else _limits(limits)
        test_, code = base.so_far(partial(
            test, bearing, seeds, rigid=rigid,
            speed_rpm=speed, load_N=load, limits=allowed, unit=known[unit],
            bar=partial(steps, what="vibration test", unit="runs"),
        ))  # fmt: skip
        with base.Writing() as files:
            files += test_.save(output, known[unit])
    if as_json:
        base.print_json(test_.summary() | {"files": files})
        return base.end(code, files)
    at = test_.scene.operation.speed_rpm
    heading = f"{test_.scene.name}: vibration test, {at:g} r/min, {test_.scene.mounted.preload_N:g} N"
    base.show(heading, *test_.table(known[unit]))
    base.show(f"strongest lines, {_SHOWN} of each band", *test_.lines_table(_SHOWN))
    for remark in test_.remarks:
        typer.echo(remark)
    base.end(code, files, named=True)


def _check_rig(settings: Sequence[str] | None) -> None:
    """Refuse keys of the scene that the rig replaces: a change of them would change nothing."""
    for one in settings or ():
        key = one.partition("=")[0].strip()
        if key.startswith(("mounting.", "operation.")):
            raise base.Refusal(
                f"--set {one} is refused: mounting, speed and temperatures are the rig's here; give --speed "
                "and --load for its speed and axial load"
            )


def _limits(text: str) -> list[float]:
    """Return the numbers of ``--limits``."""
    try:
        return [float(one) for one in text.split(",")]
    except ValueError:
        raise base.Refusal(f"--limits {text} is refused: write three numbers, as 52,18,18") from None
