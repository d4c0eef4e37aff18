"""``fmu-bearing stiffness``: stiffness and damping of a bearing for rotor programs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fmu_bearing.cli.base import (
    Catalogues,
    Json,
    Refusal,
    SceneFile,
    app,
    print_json,
    progress,
    quiet_warnings,
    refusals,
    tell,
)
from fmu_bearing.cli.runs import Settings, settings_of

if TYPE_CHECKING:
    from fmu_bearing.modal.stiffness import Stiffness

_ENDINGS = {"csv": ".csv", "netcdf": ".nc", "ross": ".toml"}
_VALUES = "LOW:HIGH:COUNT, LOW:HIGH:COUNTlog or VALUE,VALUE,..."
_COLUMNS = (
    "r/min", "preload, N", "K axial, N/um", "K radial, N/um", "K tilt, N m/mrad", "load centre, mm",
    "C axial, N s/m", "C radial, N s/m", "C tilt, mN m s/rad",
)  # fmt: skip


@app.command()
def stiffness(
    scene: SceneFile,
    speeds: Annotated[
        str | None, typer.Option(metavar="VALUES", help=f"r/min; default: the scene's. {_VALUES}.")
    ] = None,
    preloads: Annotated[
        str | None, typer.Option(metavar="VALUES", help="N, in the same way; default: the scene's.")
    ] = None,
    frequencies: Annotated[
        str | None, typer.Option(metavar="VALUES", help="Hz, in the same way; default: 8 from 50 to 10000.")
    ] = None,
    settings: Settings = None,
    spacing: Annotated[
        str, typer.Option(help="held: balls keep their distances, as in a cage; free: they do not.")
    ] = "held",
    form: Annotated[
        str, typer.Option("--format", metavar="NAME", help=f"What is written: {', '.join(_ENDINGS)}.")
    ] = "csv",
    mirrored: Annotated[
        bool, typer.Option("--mirrored", help="For ross: the bearing carries the other way.")
    ] = False,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="File; default: stiffness with the format's ending.")
    ] = None,
    picture: Annotated[
        Path | None, typer.Option(help="Picture of K and C over speed to write: .png, .svg or .pdf.")
    ] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Compute stiffness and damping over speed, preload and frequency; write them for rotor programs."""
    from fmu_bearing.modal.stiffness import stiffness as table_of
    from fmu_bearing.run.pictures import check_picture, save

    with refusals(), quiet_warnings():
        target = _target(form, output)
        if mirrored and form != "ross":
            raise Refusal("--mirrored belongs to --format ross: tables are in the bearing's own axes")
        if picture is not None:
            check_picture(picture)
        axes = [
            _numbers(option, text)
            for option, text in (
                ("--speeds", speeds), ("--frequencies", frequencies), ("--preloads", preloads),
            )
        ]  # fmt: skip
        bar = None if as_json else lambda values: progress(values, description="speeds")
        found = table_of(
            scene, axes[0], axes[1], preloads=axes[2], inputs=settings_of(settings),
            spacing=spacing, track=bar, check=_check_ross if form == "ross" else None,
        )  # type: ignore[arg-type]  # fmt: skip
        files = _write(found, form, target, mirrored)
        if picture is not None:
            save(found.picture(), picture)
            files.append(picture)
    if as_json:
        print_json(_document(found, form, mirrored) | {"files": files})
        return
    _show(found)
    if form == "ross":
        for preload in found.preloads:
            _show_planes(found, float(preload), mirrored)
    for line in found.cautions():
        tell(f"caution: {line}")
    typer.echo(f"written: {', '.join(map(str, files))}")
