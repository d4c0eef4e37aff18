"""``fmu-bearing sensitivity --method``: several values of a scene at once."""

import textwrap
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from fmu_bearing.cli import base
from fmu_bearing.cli.runs import split
from fmu_bearing.progress import Stopped

if TYPE_CHECKING:
    from fmu_bearing.scene import Scene
    from fmu_bearing.sweeps.global_sensitivity import GlobalSensitivity


@dataclass(frozen=True)
class Study:
    """What the command line asks for.

    Attributes
    ----------
    method : str
    vary : list of str
        Texts of the ranges.
    samples : int, optional
    variables : list of str, optional
    times : dict
        ``settle`` and ``window``, s, where they are given.
    workers : int, optional
    """

    method: str
    vary: list[str]
    samples: int | None
    variables: list[str] | None
    times: dict[str, float]
    workers: int | None


def several(
    source: "Path | Scene", study: Study, plot: Path | None, output: Path, force: bool, as_json: bool
) -> None:  # fmt: skip
    """Run a study of several values, and write and print what it finds."""
    from fmu_bearing.results.picture_parts import check_picture
    from fmu_bearing.scene import scene_of
    from fmu_bearing.sweeps import sampling
    from fmu_bearing.sweeps.global_sensitivity import evaluated, lay_out
    from fmu_bearing.sweeps.plan import SETTLE, WINDOW
    from fmu_bearing.sweeps.ranges import parse_range
    from fmu_bearing.sweeps.runs import run_plan
    from fmu_bearing.sweeps.store import Store

    pairs = [parse_range(text) for text in study.vary]
    ranges = dict(pairs)
    if len(ranges) < len(pairs):
        raise base.Refusal("a range is given twice: give each --vary once")
    sampling.check(study.method, study.samples)  # names the extra, which brings Matplotlib too
    picture = check_picture(plot or output / "sensitivity.png")
    base.check_new(force, picture)
    base.check_new_in(force, output, "sensitivity.md", "sensitivity.csv")
    settle, window = study.times.get("settle", SETTLE), study.times.get("window", WINDOW)
    names = split(study.variables)
    layout = lay_out(scene_of(source), ranges, study.method, study.samples, settle, window, names)
    if layout.plan.note:
        base.tell(layout.plan.note)
    try:
        outcomes = run_plan(layout.plan, Store(output), study.workers)
    except Stopped as stop:
        base.tell(
            f"interrupted: what is finished is kept; the same command runs the {stop.missing} that are left"
        )
        raise typer.Exit(base.INTERRUPTED) from None
    indices = evaluated(layout, outcomes)
    early = any(not outcome.lasting for outcome in outcomes.values())
    base.end(base.ENDED_EARLY if early else 0, _report(indices, picture, output, as_json))


def _report(indices: "GlobalSensitivity", picture: Path, output: Path, as_json: bool) -> base.Writing:
    """Write table and picture; print the table; return what was written."""
    from fmu_bearing.sweeps.index_picture import index_picture

    with base.Writing() as written:
        written += indices.write(output)
        written.draw(partial(index_picture, indices), picture)
    columns, cells = indices.table()
    if as_json:
        files = dict(zip(("page", "csv", "picture"), written, strict=False))
        rows = [dict(zip(columns, row, strict=True)) for row in cells]
        base.print_json(indices.summary() | {"indices": rows, "files": files})
        return written
    size = len(indices.keys)
    for at in range(0, len(cells), size):  # a table per figure: it fits the terminal
        name, unit = cells[at][:2]
        title = f"{indices.layout.plan.scene.name}: what {name} rests on"
        if indices.layout.method == "morris":
            title += f", {unit}" if unit else ""
        base.show(title, columns[2:], [row[2:] for row in cells[at : at + size]])
    for line in (indices.conditions(), *indices.remarks()):
        typer.echo(textwrap.fill(line, 80))
    if written:
        typer.echo(f"written: {', '.join(map(str, written))}")
    return written
