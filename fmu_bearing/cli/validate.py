"""``fmu-bearing validate``: whether an FMU conforms to FMI 2.0."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli.base import FOUND, Refusal, app, print_json, refusals
from fmu_bearing.cli.options import Json
from fmu_bearing.progress import work

if TYPE_CHECKING:
    from fmu_bearing.validation import Result

_COLOURS = {"passed": "green", "skipped": "dim", "note": "yellow", "finding": "bold red"}


@app.command()
def validate(
    fmu: Annotated[Path, typer.Argument(metavar="FMU", help="FMU for FMI 2.0 co-simulation, of any tool.")],
    limit: Annotated[
        float, typer.Option(min=0.1, help="Seconds that a check may take before it is ended.")
    ] = 60.0,
    as_json: Json = False,
) -> None:
    """Check an FMU: FMPy, fmutool, and its behaviour in a process of its own.

    Exit code 0: no finding (notes are no findings); 1: findings; 2: not an FMU for FMI 2.0 co-simulation.
    """
    from fmu_bearing import validation

    with refusals(), work("checking") as status:
        try:
            results = validation.validate(fmu, limit, lambda name: status.named(f"checking: {name}"))
        except validation.NotAnFmu as problem:
            raise Refusal(str(problem)) from None
    counts = {outcome: sum(r.outcome == outcome for r in results) for outcome in _COLOURS}
    if as_json:
        print_json({"fmu": fmu, "counts": counts, "results": [asdict(result) for result in results]})
    else:
        _show(fmu, results)
        typer.echo(f"{fmu}: " + ", ".join(f"{count} {outcome}" for outcome, count in counts.items()))
    if counts["finding"]:
        raise typer.Exit(FOUND)


def _show(fmu: Path, results: "list[Result]") -> None:
    from rich.table import Table

    from fmu_bearing.results.table import terminal

    table = Table("check", "result", "detail", title=f"{fmu.name}: FMI 2.0 co-simulation")
    table.columns[0].no_wrap = table.columns[1].no_wrap = True
    for result in results:
        colour = _COLOURS[result.outcome]
        detail = "\n".join(result.details) or result.meaning
        table.add_row(result.check, f"[{colour}]{result.outcome}[/]", detail.replace("[", r"\["))
    terminal().print(table)
