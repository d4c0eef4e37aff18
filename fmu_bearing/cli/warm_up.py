"""``fmu-bearing warm-up``: compile before the first run needs it."""

import time
from typing import Annotated

import typer

from fmu_bearing.cli.base import app, refusals
from fmu_bearing.cli.build import named
from fmu_bearing.compiled.platforms import PLATFORMS
from fmu_bearing.progress import work

Libraries = Annotated[
    str | None,
    typer.Option(
        "--platforms",
        metavar="NAME,...",
        help=f"Also link the libraries of native FMUs: {', '.join(PLATFORMS)}, or all.",
    ),
]


@app.command("warm-up")
def warm_up(platforms: Libraries = None) -> None:
    """Compile the kernels now: for Python and, with --platforms, for FMUs."""
    from fmu_bearing.compiled import ready
    from fmu_bearing.compiled.units import UNITS
    from fmu_bearing.files import cache_root
    from fmu_bearing.fmi.native.link import library
    from fmu_bearing.fmi.package import check_choice

    begin = time.perf_counter()
    with refusals():
        names = named(platforms)
        check_choice("native", names)
        with work("compiling", elsewhere=True):
            ready(*UNITS)
            for name in names:
                library(PLATFORMS[name], "portable", typer.echo)
    typer.echo(f"ready after {time.perf_counter() - begin:.1f} s; kept in {cache_root()}")
