"""``fmu-bearing stiffness``: stiffness and damping of a scene's bearings for rotor programs."""

import glob
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

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
    from fmu_bearing.steady.stiffness.bearing_stiffness import BearingStiffness
    from fmu_bearing.steady.stiffness.nose_stiffness import NoseStiffness
    from fmu_bearing.steady.stiffness.scene_stiffness import Stiffness
    from fmu_bearing.steady.stiffness.stiffness_table import Spacing

_ENDINGS = {"csv": ".csv", "netcdf": ".nc", "ross": ".toml"}
_COLUMNS = ("r/min", "N", "K axial", "K radial", "K tilt", "C axial", "C radial", "C tilt")
_PERCENT = 100.0


@base.app.command()
def stiffness(
    scene: SceneFile,
    speeds: Speeds = None,
    preloads: Preloads = None,
    frequencies: Annotated[
        str | None, typer.Option(metavar="VALUES", help="Hz, same syntax; default: 8 from 50 to 10000.")
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
    plot: Plot = None,
    output: Annotated[Path | None, written_to("Default: stiffness and the format's ending.")] = None,
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Compute stiffness and damping over speed, preload and frequency; write them for rotor programs.

    Of a set of bearings on one shaft: also the static stiffness at its nose over speed and preload; with
    csv in FILE itself, each bearing's table in FILE-1, FILE-2 and so on.

    With --format ross the file NAME.toml becomes NAME-1.toml to NAME-3.toml: bearing elements of ROSS 3 in
    three planes, which are the bearing together. A table has what they lack of it.
    """
    from fmu_bearing.scene import read_scene
    from fmu_bearing.steady.stiffness.scene_stiffness import stiffness as table_of

    with base.refusals():
        if mirrored and form != "ross":
            raise base.Refusal("--mirrored is for --format ross: tables are in the bearing's own axes")
        asked = {
            name: numbers(name, text)
            for name, text in (("speeds", speeds), ("preloads", preloads), ("frequencies", frequencies))
        }
        given = read_scene(scene)
        for speed in asked["speeds"] or ():
            base.shaft_speed(speed, given, "--speeds")
        target = _target(form, output, asked)
        base.check_new(force, target, plot)
        base.check_new_in(force, target.parent, f"{glob.escape(target.stem)}-[0-9]*{target.suffix}")
        chosen, inputs = changed(given, settings)
        if mirrored and chosen.assembly.joined:
            raise base.Refusal(
                "--mirrored is for one bearing: of a set the scene gives the direction of each bearing"
            )
        table, code = base.so_far(partial(
            table_of, chosen, asked["speeds"], asked["frequencies"], preloads=asked["preloads"],
            inputs=inputs, spacing=_spacing(spacing), track=partial(steps, what="stiffness", unit="speeds"),
        ))  # fmt: skip
        with base.Writing() as files:
            files += table.save(target) if form != "ross" else _elements(table, target, mirrored)
            files.draw(table.picture, plot)
    if as_json:
        base.print_json(_document(table, form) | {"files": files})
        return base.end(code, files)
    if table.nose is not None:
        _show_nose(table.nose)
    _show(table)
    for one in table.bearings if form == "ross" else ():
        _show_planes(one)
    for line in table.cautions():
        base.tell(f"caution: {line}")
    base.end(code, files, named=True)


def _spacing(text: str) -> "Spacing":
    if text not in ("held", "free"):
        raise base.Refusal(f"--spacing {text} is refused: it is held or free")
    return "free" if text == "free" else "held"


def _target(form: str, output: Path | None, asked: dict[str, list[float] | None]) -> Path:
    """Return the file to write, checked before anything is computed."""
    from fmu_bearing.results.result import check_target
    from fmu_bearing.steady.stiffness.ross import check_axes

    if form not in _ENDINGS:
        raise base.Refusal(f"--format {form} is refused: it is {', '.join(_ENDINGS)}")
    target = output or Path(f"stiffness{_ENDINGS[form]}")
    check_file(target, _ENDINGS[form], f"--format {form}")
    if form != "ross":
        return check_target(target)
    check_axes(len(asked["speeds"] or (0.0,)), len(asked["frequencies"] or range(8)))
    return target


def _elements(table: "Stiffness", target: Path, mirrored: bool) -> list[Path]:
    """Write three elements per bearing and preload, and return the files."""
    files: list[Path] = []
    for bearing, file in zip(table.bearings, table.files(target), strict=True):
        for preload in bearing.preloads:
            name = file if len(bearing.preloads) == 1 else file.with_stem(f"{file.stem}-{preload:.12g}N")
            files += bearing.to_ross(name, preload, mirrored=mirrored or bearing.sign < 0)
    return files


def _show_nose(table: "NoseStiffness") -> None:
    """Print the static stiffness of a set's shaft."""
    from fmu_bearing.steady.stiffness.nose_stiffness import NAMED

    rows = [
        [
            f"{speed:g}",
            f"{preload:g}",
            *(f"{factor * table.named(attribute)[i, k]:.2f}" for _, attribute, _, factor in NAMED),
        ]
        for i, speed in enumerate(table.speeds)
        for k, preload in enumerate(table.preloads)
    ]
    columns = ("r/min", "N", *(f"K {words}" for words, *_ in NAMED))
    base.show(f"{table.scene.name} at the nose, static: K in N/um and N m/mrad", columns, rows)


def _show(table: "Stiffness") -> None:
    """Print the tables of the bearings at their middle frequency."""
    at, several = len(table.frequencies) // 2, table.nose is not None
    rows = []
    for bearing in table.bearings:
        for i, speed in enumerate(table.speeds):
            for k, preload in enumerate(table.preloads):
                stiff, damped = bearing.K[i, k, at].diagonal(), bearing.C[i, k, at].diagonal()
                row = [str(bearing.number)] if several else []
                row += [f"{speed:g}", f"{preload:g}", f"{1e-6 * stiff[0]:.2f}", f"{1e-6 * stiff[1]:.1f}"]
                row += [f"{1e-3 * stiff[4]:.3f}", f"{damped[0]:.1f}", f"{damped[1]:.1f}"]
                rows.append([*row, f"{1e3 * damped[4]:.2f}"])
    units = "K in N/um and N m/mrad, C in N s/m and mN m s/rad"
    columns = ("bearing", *_COLUMNS) if several else _COLUMNS
    base.show(f"{table.scene.name} at {table.frequencies[at]:.4g} Hz: {units}", columns, rows)
    apart = max(bearing.against_static() for bearing in table.bearings)
    low = f"{table.frequencies[0]:.4g} Hz"
    typer.echo(
        f"below {low}, the lowest frequency computed: K for frequency to 0 (static) differs by at most "
        f"{_PERCENT * apart:.2g} % from K at {low}"
    )


def _show_planes(table: "BearingStiffness") -> None:
    """Print where the three planes are and how far they are from the bearing, at the worst frequency."""
    from fmu_bearing.steady.stiffness.planes import ERRORS

    name = f"bearing {table.number}: " if table.on_shaft else ""
    rows = []
    for preload in table.preloads:
        off = _PERCENT * table.plane_errors(float(preload)).max(axis=1)
        for speed, one in zip(table.speeds, off, strict=True):
            rows.append([f"{speed:g}", f"{preload:g}", *(f"{value:.2g}" for value in one)])
    base.show(f"{name}error of the three planes, %, at the worst frequency", ("r/min", "N", *ERRORS), rows)
    places = table.planes(float(table.preloads[0])).places
    typer.echo(
        f"planes at {', '.join(f'{1e3 * place:.4g}' for place in places)} mm from the centre of the balls; "
        "the axial stiffness is in the middle one"
    )


def _document(table: "Stiffness", form: str) -> dict[str, Any]:
    """Return all numbers by name, for machines."""
    result = table.summary()
    for bearing, document in zip(table.bearings, result["bearings"], strict=True):
        if form == "ross":
            document["planes"] = [
                {
                    "preload_N": float(preload),
                    "places_mm": [1e3 * place for place in bearing.planes(float(preload)).places],
                    "errors": bearing.plane_errors(float(preload)),
                }
                for preload in bearing.preloads
            ]
    return result
