"""Write the validation pages of the three papers: ``python -m examples.papers.run [PAGE ...]``.

Recordings and reductions are kept under ``--cache``: a run that is interrupted, or repeated with another
radiation model, goes on from there.
"""

import argparse
import os
import pathlib
import time
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from types import ModuleType
from typing import Any

from examples.papers import impact_noise, multi_source, sound_field
from examples.papers.calibration import ROUNDS, Calibration, calibrate
from examples.papers.case import ROOT, Case, code_hash, kept
from examples.papers.hearing import Ear
from examples.papers.page import Output
from fmu_bearing.extras import MissingExtra, need

PAGES: dict[str, ModuleType] = {module.NAME: module for module in (multi_source, sound_field, impact_noise)}
MODELS = ("compact", "bem")  # those that evaluate recordings at any place
DEFAULT_MODEL = "bem"


def evaluate(name: str, case: Case, radiation_model: str, quick: bool, cache: pathlib.Path) -> dict[str, Any]:
    """Return the result of one case with one radiation model (worker)."""
    module = PAGES[name]
    place = cache / name / f"{case.key(radiation_model)}-{radiation_model}-{code_hash(*module.MODULES)}.json"
    return kept(
        place,
        lambda: module.reduce(Ear(case.recording(radiation_model, cache), radiation_model, cache), quick),
    )


def calibration_of(name: str, radiation_model: str, quick: bool, cache: pathlib.Path) -> Calibration:
    """Calibration of one page (worker)."""
    module = PAGES[name]

    def level(scale: float) -> float:
        case = module.calibration_case(scale, quick)
        place = (
            cache
            / name
            / f"{case.key(radiation_model)}-{radiation_model}-{code_hash(*module.MODULES)}-level.json"
        )
        found = kept(
            place,
            lambda: {
                "dB": module.calibration_level(
                    Ear(case.recording(radiation_model, cache), radiation_model, cache)
                )
            },
        )
        return float(found["dB"])

    return calibrate(module.CALIBRATION[1], level, 3 if quick else ROUNDS)


def models_of(module: ModuleType, radiation_model: str) -> list[str]:
    """Radiation models a page shows."""
    return [radiation_model, *(["paper"] if module.PAPER_MODEL_TOO and radiation_model != "paper" else [])]


def run(
    names: list[str], radiation_model: str, *, quick: bool, jobs: int, cache: pathlib.Path, root: pathlib.Path
) -> list[pathlib.Path]:
    """Run all cases of the pages and write them; returns the pages written."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    results: dict[str, dict[str, dict[Case, dict[str, Any]]]] = {
        name: {one: {} for one in models_of(PAGES[name], radiation_model)} for name in names
    }
    calibrations: dict[str, Calibration] = {}
    # linear algebra libraries must not start threads of their own beside the workers
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    with ProcessPoolExecutor(jobs) as pool, Progress(*columns) as bar:
        tasks = {name: bar.add_task(f"{name}: calibration", total=1) for name in names}
        waiting: dict[Future[Any], tuple[Any, ...]] = {
            pool.submit(calibration_of, name, radiation_model, quick, cache): (name,) for name in names
        }
        while waiting:
            done = next(as_completed(waiting))
            name, *case = waiting.pop(done)
            if not case:
                calibrations[name] = done.result()
                scale = calibrations[name].scale
                jobs_here = [(one, c) for one in results[name] for c in PAGES[name].cases(scale, quick)]
                for one, point in jobs_here:
                    waiting[pool.submit(evaluate, name, point, one, quick, cache)] = (name, one, point)
                bar.update(tasks[name], description=name, total=len(jobs_here))
                continue
            one, point = case
            results[name][one][point] = done.result()
            bar.advance(tasks[name])
    output = Output(root)
    output.make()
    return [
        output.write(name, PAGES[name].write(results[name], calibrations[name], radiation_model, output))
        for name in names
    ]


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
        need("matplotlib", "a page with pictures")  # told before minutes of computing
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
