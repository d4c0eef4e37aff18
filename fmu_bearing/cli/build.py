"""``fmu-bearing build``: the FMU of a scene."""

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli.base import app, check_new, print_json, refusals, tell
from fmu_bearing.cli.options import Catalogues, Fidelity, Force, Json, SceneFile, Settings, output as target
from fmu_bearing.cli.settings import source_of
from fmu_bearing.compiled.platforms import PLATFORMS

Output = Annotated[Path | None, target("FMU to write; default: Bearing<designation>.fmu here.")]
Flavour = Annotated[
    str | None,
    typer.Option(
        metavar="native|python",
        help="native: compiled, runs without Python; python: runs in the installed package. "
        "Default: native where a library can be made.",
    ),
]
Platforms = Annotated[
    str | None,
    typer.Option(
        metavar="NAME,...",
        help=f"Platforms of a native FMU: {', '.join(PLATFORMS)}, or all; default: this machine's.",
    ),
]
OnlyHere = Annotated[
    bool,
    typer.Option(
        "--only-here",
        help="A native FMU for this machine's instruction set and this scene: half the time to compile.",
    ),
]


def named(platforms: str | None) -> list[str]:
    """Return platforms from names with commas between, or ``all``."""
    names = list(PLATFORMS) if platforms == "all" else [n.strip() for n in (platforms or "").split(",")]
    return [name for name in names if name]


@app.command()
def build(
    scene: SceneFile,
    settings: Settings = None,
    fidelity: Fidelity = None,
    output: Output = None,
    force: Force = False,
    flavour: Flavour = None,
    platforms: Platforms = None,
    only_here: OnlyHere = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Build the co-simulation FMU (FMI 2.0) of a scene."""
    from fmu_bearing.fmi.description import identifier
    from fmu_bearing.run.build import build_fmu
    from fmu_bearing.scene import scene_of

    with refusals():
        source = scene_of(source_of(scene, settings, fidelity))
        check_new(force, output or Path(f"{identifier(source)}.fmu"))
        built = build_fmu(source, output, flavour, named(platforms), tell, only_here)
    if as_json:
        print_json(asdict(built))
    else:
        typer.echo(f"built {built}")
