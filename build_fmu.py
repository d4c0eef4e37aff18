"""Builds the FMU of a scene: ``python build_fmu.py SCENE.toml -o Bearing.fmu``."""

from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli.base import refusals, tell
from fmu_bearing.cli.build import Flavour, OnlyHere, Output, Platforms, named
from fmu_bearing.fmi.description import description_xml
from fmu_bearing.run.build import build_fmu, model_of

HERE = Path(__file__).resolve().parent
DEFAULT_SCENE = HERE / "examples" / "scenes" / "7003C-spindle.toml"
DESCRIPTION = HERE / "modelDescription" / "modelDescription.xml"


def main(
    scene: Annotated[Path, typer.Argument(help="Scene to build from (TOML).")] = DEFAULT_SCENE,
    output: Output = None,
    flavour: Flavour = None,
    platforms: Platforms = None,
    only_here: OnlyHere = False,
    write_description: Annotated[
        bool, typer.Option(help="Only renew modelDescription/modelDescription.xml from the scene.")
    ] = False,
) -> None:
    """Build a co-simulation FMU (FMI 2.0) of the bearing that a scene describes."""
    with refusals():
        if write_description:
            model = model_of(scene, tell)
            DESCRIPTION.write_bytes(description_xml(model))
            typer.echo(f"{DESCRIPTION}: {len(model.variables)} variables")
        else:
            typer.echo(f"built {build_fmu(scene, output, flavour, named(platforms), tell, only_here)}")


if __name__ == "__main__":
    typer.run(main)
