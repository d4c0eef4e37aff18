"""``fmu-bearing fits``: what the tolerances of the seats do to a scene's bearings."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fmu_bearing.cli import options
from fmu_bearing.cli.base import Writing, app, check_new, end, print_json, refusals, show
from fmu_bearing.cli.settings import at_speed, source_of
from fmu_bearing.files import check_file
from fmu_bearing.progress import steps


@app.command()
def fits(
    scene: options.SceneFile,
    speed: options.Speed = None,
    settings: options.Settings = None,
    plot: options.Plot = None,
    output: Annotated[Path | None, options.output("Write the table to this file as well (.csv).")] = None,
    force: options.Force = False,
    catalogue: options.Catalogues = None,
    as_json: options.Json = False,
) -> None:
    """Show what the fits on shaft and in housing do, from the loosest to the tightest that classes allow.

    Each column is computed in full: interference, pressure, hoop stress, contact angle, preload, stiffness,
    life. --plot draws angle, preload, hoop stress and interference over speed and temperature.
    """
    from fmu_bearing.design.fit_curves import curves
    from fmu_bearing.design.fit_pictures import picture
    from fmu_bearing.design.fit_table import fit_rows, head, shown_tables
    from fmu_bearing.design.fits import fits as study
    from fmu_bearing.results.table import write_csv

    with refusals():
        if output is not None:
            check_file(output, ".csv", "the table")
        check_new(force, output, plot)
        result = study(
            source_of(scene, at_speed(speed, settings, scene)), partial(steps, what="fits", unit="columns")
        )
        drawn = None if plot is None else curves(result, partial(steps, what="curves", unit="fits"))
        with Writing() as files:
            if output is not None:
                numbers = [bearing.number for bearing in result.columns[0].bearings]
                rows = [[str(number), *row] for number in numbers for row in fit_rows(result, number)]
                files.append(write_csv(output, ("bearing", *head(result)), rows))
            if drawn is not None:
                files.draw(partial(picture, result, drawn), plot)
    if as_json:
        print_json(result.summary() | {"files": files})
        return end(0, files)
    for table in shown_tables(result):
        show(*table)
    for line in result.remarks:
        typer.echo(line)
    end(0, files, named=True)
