"""Builds the FMU of a scene: ``python build_fmu.py SCENE.toml -o Bearing.fmu``."""

from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.fmi.description import description_xml
from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import SceneError, read_scene

HERE = Path(__file__).resolve().parent
DEFAULT_SCENE = HERE / "examples" / "scenes" / "7003C-spindle.toml"
DESCRIPTION = HERE / "modelDescription" / "modelDescription.xml"


def main(
    scene: Annotated[Path, typer.Argument(help="Scene to build from (TOML).")] = DEFAULT_SCENE,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="FMU to write; default: Bearing<designation>.fmu here."),
    ] = None,
    write_description: Annotated[
        bool, typer.Option(help="Only renew modelDescription/modelDescription.xml from the scene.")
    ] = False,
) -> None:
    """Build a co-simulation FMU (FMI 2.0) of the bearing that a scene describes."""
    try:
        model = prepare(read_scene(scene))
        if write_description:
            DESCRIPTION.write_bytes(description_xml(model))
            typer.echo(f"{DESCRIPTION}: {len(model.variables)} variables")
        else:
            typer.echo(f"built {build(model, output)}")
    except (SceneError, OSError) as error:
        message = "; ".join(line.strip() for line in str(error).splitlines() if line.strip())
        typer.echo(f"error: {message}", err=True)
        raise typer.Exit(2) from None


if __name__ == "__main__":
    typer.run(main)
