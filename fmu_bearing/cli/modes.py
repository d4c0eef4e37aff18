"""``fmu-bearing modes``: natural frequencies of a mounted bearing, and over speed what excites them."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fmu_bearing.cli import base, options
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
#: Columns that a terminal has room for.
_OF_MODES = ("Hz", "damping, %", "whirl", "what moves most", "kinetic energy, %")
_OF_CROSSINGS = ("r/min", "Hz", "mode", "damping, %", "line", "made by, order")
_FILES = (
    "modes.csv",
    "modes.uff",
    "campbell.csv",
    "crossings.csv",
    "campbell.png",
    "shaft.png",
    "modes.html",
)


@base.app.command()
def modes(
    scene: options.SceneFile,
    speed: options.Speed = None,
    speeds: Speeds = None,
    settings: options.Settings = None,
    highest: Annotated[float, typer.Option(help="Highest frequency, kHz.")] = 20.0,
    plot: options.Plot = None,
    output: Annotated[Path | None, options.output("Write tables, picture and page there.", "FOLDER")] = None,
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Show natural frequencies, damping, direction and what moves; with --speeds what excites them.

    With --plot, the picture of it, or --output the Campbell diagram is computed in any case. The folder gets
    modes.csv, modes.uff with the shapes for programs of modal analysis, campbell.csv, crossings.csv,
    campbell.png and modes.html, with the shapes moving; of a set shaft.png instead, the line of the shaft.
    """
    from fmu_bearing.modal.campbell.over_speed import campbell as over_speed
    from fmu_bearing.modal.modes.points import modes as at_speed
    from fmu_bearing.scene import read_scene
    from fmu_bearing.sweeps.axes import parse_values

    with base.refusals():
        if output is not None:
            check_folder(output)
            base.check_new_in(force, output, *_FILES)
        base.check_new(force, plot)
        chosen, inputs = changed(read_scene(scene), settings)
        turning = base.shaft_speed(speed, chosen)
        if plot is not None and speeds is None and not chosen.operation.speed_rpm:
            raise base.Refusal(
                "--plot draws a Campbell diagram, and the scene's shaft does not turn: give --speeds"
            )
        with work(f"modes of {chosen.name}"):
            study = at_speed(chosen, inputs | ({} if turning is None else {"shaft_speed": turning}))
        free = at_speed(chosen, inputs | {"shaft_speed": 0.0}, friction=False) if study.rpm == 0.0 else None
        diagram = None
        if speeds is not None or plot is not None or output is not None and chosen.operation.speed_rpm:
            rows = None if speeds is None else parse_values("speeds", speeds)
            rest = {name: value for name, value in inputs.items() if name != "shaft_speed"}
            diagram = over_speed(
                chosen, rows, inputs=rest, highest=1e3 * highest, tell=base.tell,
                track=partial(steps, what="Campbell diagram", unit="speeds"),
            )  # fmt: skip
        with base.Writing() as files:
            if output is not None:
                _write(output, study, diagram, files)
            if diagram is not None:
                files.draw(diagram.picture, plot)
    if as_json:
        base.print_json(_summary(study, diagram, 1e3 * highest) | {"files": files})
        return base.end(0, files)
    _show(study, 1e3 * highest, "contacts stick" if free else "")
    if free:
        _show(free, 1e3 * highest, "without friction")
    if diagram is not None:
        _show_crossings(diagram)
    for line in dict.fromkeys(study.cautions() + (diagram.cautions() if diagram else [])):
        base.tell(f"caution: {line}")
    base.end(0, files, named=True)


def _show(study: "Modes", highest: float, words: str) -> None:
    from fmu_bearing.modal.modes.mode import Mode
    from fmu_bearing.results.base import table
    from fmu_bearing.scene.words import designation_words

    typer.echo(
        f"{study.scene.name}: {designation_words(study.scene)}, {study.rpm:,.0f} r/min, fidelity full "
        f"without cage and imperfections{', ' + words if words else ''}"
    )
    base.show("modes", *table(Mode, study.records(highest), _OF_MODES))


def _show_crossings(diagram: "Campbell") -> None:
    from fmu_bearing.modal.campbell.diagram import Crossing
    from fmu_bearing.results.base import table

    counted = diagram.crossings(in_scene=True)
    if counted:
        base.show("crossings within 20 dB of the largest", *table(Crossing, counted, _OF_CROSSINGS))
    typer.echo(f"{len(diagram.crossings())} crossings, {len(counted)} of them count. {diagram.verdict()}")


def _summary(study: "Modes", diagram: "Campbell | None", highest: float) -> dict[str, Any]:
    rows = {"modes": study.records(highest), "apart": study.records(highest, apart=True)}
    result = study.summary() | rows
    if diagram is not None:
        result |= diagram.summary()
        result["cautions"] = list(dict.fromkeys(study.cautions() + diagram.cautions()))
    return result


def _write(folder: Path, study: "Modes", diagram: "Campbell | None", files: base.Writing) -> None:
    """Write tables, and for a diagram its picture and page; add each to the files."""
    from fmu_bearing.results.base import write_rows

    files.append(write_rows(folder / "modes.csv", study.records()))
    files.append(study.save(folder / "modes.uff"))
    if diagram is None:
        base.tell("no Campbell diagram: the scene's shaft does not turn; give --speeds")
        return
    files.append(write_rows(folder / "campbell.csv", diagram.table()))
    files.append(write_rows(folder / "crossings.csv", diagram.crossings()))
    if available("matplotlib", "a picture", "no campbell.png", base.tell):
        files.draw(diagram.picture, folder / "campbell.png")
    if study.on_shaft:
        if available("matplotlib", "a picture", "no shaft.png", base.tell):
            files.draw(study.picture, folder / "shaft.png")
        return  # the page draws one bearing
    if available("plotly", "a page", "no modes.html", base.tell):
        from fmu_bearing.reports.modes.modes_section import modes_page

        files.append(modes_page(diagram, folder / "modes.html", study))
