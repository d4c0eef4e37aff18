"""Write the validation pages of the three papers: ``python -m examples.papers.run [PAGE ...]``.

Per page: identify the free numbers from the fitted values, run every operating point with its seeds and the
speeds around it, write the page. What is computed is kept under ``--cache``: a run that is interrupted goes
on from there.
"""

import argparse
import os
import pathlib
import time
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from types import ModuleType

from examples.papers import impact_noise, multi_source, sound_field
from examples.papers.case import ROOT
from examples.papers.page import Output
from examples.papers.runs import Runs
from fmu_bearing.extras import MissingExtra, need

PAGES: dict[str, ModuleType] = {module.NAME: module for module in (multi_source, sound_field, impact_noise)}
MODELS = ("compact", "bem")  # those that evaluate recordings at any place
DEFAULT_MODEL = "bem"


def run(
    names: Iterable[str],
    radiation_model: str,
    *,
    quick: bool,
    jobs: int,
    cache: pathlib.Path,
    root: pathlib.Path,
) -> list[pathlib.Path]:
    """Run all cases of the pages and write them; returns the pages written."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    # linear algebra libraries must not start threads of their own beside the workers
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    output = Output(root)
    output.make()
    written = []
    with ProcessPoolExecutor(jobs) as pool, Progress(*columns) as bar:
        runs = Runs(pool, bar, radiation_model, quick, cache)
        for name in names:
            written.append(output.write(name, PAGES[name].page_of(runs, output)))
    return written


def main(arguments: list[str] | None = None) -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(prog="python -m examples.papers.run", description=__doc__)
    parser.add_argument("pages", nargs="*", metavar="PAGE", help=f"of {', '.join(PAGES)}; default: all")
    parser.add_argument(
        "--radiation-model",
        choices=MODELS,
        default=DEFAULT_MODEL,
        help=f"physical radiation model (default {DEFAULT_MODEL})",
    )
    parser.add_argument("--quick", action="store_true", help="tiny cases: to see that it works")
    parser.add_argument("--jobs", type=int, default=2, help="processes (default 2)")
    parser.add_argument("--cache", type=pathlib.Path, default=ROOT / "out" / "papers")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT, help="where docs/ lies")
    given = parser.parse_args(arguments)
    unknown = [name for name in given.pages if name not in PAGES]
    if unknown:
        parser.error(f"no page named {', '.join(unknown)}; there are {', '.join(PAGES)}")
    try:
        need("matplotlib", "a page with pictures")  # refused before minutes of computing
    except MissingExtra as missing:
        parser.error(str(missing))
    clock = time.perf_counter()
    pages = run(
        given.pages or list(PAGES), given.radiation_model,
        quick=given.quick, jobs=given.jobs, cache=given.cache, root=given.output,
    )  # fmt: skip
    for path in pages:
        print(path)
    print(f"{time.perf_counter() - clock:.0f} s")


if __name__ == "__main__":
    main()
