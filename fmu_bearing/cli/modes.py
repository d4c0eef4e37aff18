"""``fmu-bearing modes``: natural frequencies of a mounted bearing, and over speed what excites them."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fmu_bearing.cli.base import (
    Refusal,
    Writing,
    app,
    check_new,
    check_new_in,
    end,
    print_json,
    refusals,
    shaft_speed,
    tell,
)
from fmu_bearing.cli.options import (
    Catalogues,
    Force,
    Json,
    Plot,
    SceneFile,
    Settings,
    Speed,
    output as target,
)
from fmu_bearing.cli.settings import changed
from fmu_bearing.extras import available
from fmu_bearing.files import check_folder
from fmu_bearing.progress import steps, work

if TYPE_CHECKING:
    from fmu_bearing.modal.campbell.over_speed import Campbell
    from fmu_bearing.modal.modes.natural_modes import Modes

Speeds = Annotated[
    str | None,
    typer.Option(
        metavar="LOW:HIGH:COUNT", help="Campbell diagram over these speeds, r/min; also VALUE,VALUE,..."
    ),
]
_FILES = ("modes.csv", "campbell.csv", "crossings.csv", "campbell.png", "shaft.png", "modes.html")
_LARGEST = 3  # shares named in a row
_LEAST = 0.05  # of the kinetic energy: smaller shares are left out


@app.command()
def modes(
    scene: SceneFile,
    speed: Speed = None,
    speeds: Speeds = None,
    settings: Settings = None,
    highest: Annotated[float, typer.Option(help="Highest frequency, kHz.")] = 20.0,
    plot: Plot = None,
    output: Annotated[Path | None, target("Write tables, picture and page there.", "FOLDER")] = None,
    force: Force = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Show natural frequencies, damping, direction and what moves; with --speeds what excites them.

    With --plot, the picture of it, or --output the Campbell diagram is computed in any case. The folder gets
    modes.csv, campbell.csv, crossings.csv, campbell.png and modes.html, with the shapes moving; of a set
    shaft.png instead, the line of the shaft.
    """
    from fmu_bearing.modal.campbell.over_speed import campbell as over_speed
    from fmu_bearing.modal.modes.points import modes as at_speed
    from fmu_bearing.results.picture_parts import check_picture, save
    from fmu_bearing.scene import read_scene
    from fmu_bearing.sweeps.axes import parse_values

    with refusals():
        if output is not None:
            check_folder(output)
            check_new_in(force, output, *_FILES)
        if plot is not None:
            check_new(force, check_picture(plot))
        chosen, inputs = changed(read_scene(scene), settings)
        turning = shaft_speed(speed, chosen)
        if plot is not None and speeds is None and not chosen.operation.speed_rpm:
            raise Refusal(
                "--plot draws a Campbell diagram, and the scene's shaft does not turn: give --speeds"
            )
        with work(f"modes of {chosen.name}"):
            found = at_speed(chosen, inputs | ({} if turning is None else {"shaft_speed": turning}))
        free = at_speed(chosen, inputs | {"shaft_speed": 0.0}, friction=False) if found.rpm == 0.0 else None
        diagram = None
        if speeds is not None or plot is not None or output is not None and chosen.operation.speed_rpm:
            rows = None if speeds is None else parse_values("speeds", speeds)
            rest = {name: value for name, value in inputs.items() if name != "shaft_speed"}
            diagram = over_speed(
                chosen, rows, inputs=rest, highest=1e3 * highest, tell=tell,
                track=partial(steps, what="Campbell diagram", unit="speeds"),
            )  # fmt: skip
        with Writing() as files:
            if output is not None:
                _write(output, found, diagram, files)
            if plot is not None and diagram is not None:
                save(diagram.picture(), plot)
                files.append(plot)
    if as_json:
        print_json(_summary(found, diagram, 1e3 * highest) | {"files": files})
        return end(0, files)
    _show(found, 1e3 * highest, "contacts stick" if free else "")
    if free:
        _show(free, 1e3 * highest, "without friction")
    if diagram is not None:
        _show_crossings(diagram)
    for line in dict.fromkeys(found.cautions() + (diagram.cautions() if diagram else [])):
        tell(f"caution: {line}")
    if files:
        tell(f"written: {', '.join(map(str, files))}")
    end(0, files)


def _show(found: "Modes", highest: float, words: str) -> None:
    from fmu_bearing.results.table import show

    typer.echo(
        f"{found.scene.name}: {found.scene.bearing.designation}, {found.rpm:,.0f} r/min, fidelity full "
        f"without cage and imperfections{', ' + words if words else ''}"
    )
    rows = [
        [
            f"{row['frequency_Hz']:,.1f}", f"{100.0 * row['damping_ratio']:.2f}", row["direction"] or "-",
            row["name"] + (f" ({row['remark']})" if row["remark"] else ""), _shares(row["participation"]),
        ]
        for row in found.table(highest)
    ]  # fmt: skip
    show("modes", ("Hz", "damping, %", "whirl", "what moves most", "kinetic energy, %"), rows)


def _shares(participation: dict[str, float]) -> str:
    """Return the largest shares of a mode in text."""
    largest = [(name, share) for name, share in participation.items() if share >= _LEAST][:_LARGEST]
    return ", ".join(f"{name} {100.0 * share:.0f}" for name, share in largest)


def _show_crossings(diagram: "Campbell") -> None:
    from fmu_bearing.results.table import show

    counted = diagram.crossings(in_scene=True)
    rows = [
        [
            f"{one.rpm:,.0f}", f"{one.frequency:,.0f}", one.branch.label, f"{100.0 * one.damping:.2f}",
            one.line.name, f"{one.line.source} {one.line.surface_order or ''}".rstrip(),
        ]
        for one in counted
    ]  # fmt: skip
    columns = ("r/min", "Hz", "mode", "damping, %", "line", "made by, order")
    if rows:
        show("crossings within 20 dB of the largest", columns, rows)
    typer.echo(f"{len(diagram.crossings())} crossings, {len(rows)} of them count. {diagram.verdict()}")


def _summary(found: "Modes", diagram: "Campbell | None", highest: float) -> dict[str, Any]:
    result: dict[str, Any] = {
        "scene": found.scene.name, "speed_rpm": found.rpm, "modes": found.table(highest),
        "apart": found.table(highest, apart=True), "cautions": found.cautions(),
    }  # fmt: skip
    if diagram is not None:
        result |= {
            "campbell": diagram.table(),
            "crossings": [one.as_dict() for one in diagram.crossings()],
            "verdict": diagram.verdict(),
            "cautions": list(dict.fromkeys(found.cautions() + diagram.cautions())),
        }
    return result


def _write(folder: Path, found: "Modes", diagram: "Campbell | None", files: list[Path]) -> None:
    """Write tables, and for a diagram its picture and page; add each to the files."""
    from fmu_bearing.results.picture_parts import save

    folder.mkdir(parents=True, exist_ok=True)
    files.append(_csv(folder / "modes.csv", [_flat(row) for row in found.table()]))
    if diagram is None:
        tell("no Campbell diagram: the scene's shaft does not turn; give --speeds")
        return
    files.append(_csv(folder / "campbell.csv", diagram.table()))
    files.append(_csv(folder / "crossings.csv", [one.as_dict() for one in diagram.crossings()]))
    if available("matplotlib", "a picture", "no campbell.png", tell):
        save(diagram.picture(), folder / "campbell.png")
        files.append(folder / "campbell.png")
    if found.on_shaft:
        if available("matplotlib", "a picture", "no shaft.png", tell):
            save(found.picture(), folder / "shaft.png")
            files.append(folder / "shaft.png")
        return  # the page draws one bearing
    if available("plotly", "a page", "no modes.html", tell):
        from fmu_bearing.reports.modes.modes_section import modes_page

        files.append(modes_page(diagram, folder / "modes.html", found))


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    return {key: _shares(value) if isinstance(value, dict) else value for key, value in row.items()}


def _csv(path: Path, rows: list[dict[str, Any]]) -> Path:
    from fmu_bearing.results.table import write_csv

    columns = list(rows[0]) if rows else []
    write_csv(path, columns, [[_cell(row[key]) for key in columns] for row in rows])
    return path


def _cell(value: Any) -> str:
    return f"{value:.9g}" if isinstance(value, float) else str(value)
