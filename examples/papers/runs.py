"""Cases evaluated on the cores given, with progress; results are kept on disk."""

import importlib
import pathlib
import warnings
from collections.abc import Sequence
from concurrent.futures import Executor, as_completed
from typing import TYPE_CHECKING, Any

from examples.papers.case import QUICK_SEEDS, SEEDS, Case, code_hash, kept
from examples.papers.hearing import Ear

if TYPE_CHECKING:
    from rich.progress import Progress

Results = dict[Case, dict[str, Any]]


def evaluate(
    name: str, what: str, case: Case, radiation_model: str, quick: bool, cache: pathlib.Path
) -> dict[str, Any]:
    """Return what a page's function ``what`` makes of one case (worker)."""
    module = importlib.import_module(f"examples.papers.{name.replace('-', '_')}")
    key = f"{case.key(radiation_model)}-{radiation_model}-{code_hash(*module.MODULES)}"
    place = cache / name / f"{key}-{what}{'-quick' if quick else ''}.json"

    def compute() -> dict[str, Any]:
        # of contact ellipses that reach a shoulder at large amplitudes, once per run: the page says so
        warnings.simplefilter("ignore", UserWarning)
        ear = Ear(case.recording(radiation_model, cache), radiation_model, cache)
        found: dict[str, Any] = getattr(module, what)(ear, quick)
        return found

    return kept(place, compute)


class Runs:
    """Evaluates cases.

    Attributes
    ----------
    radiation_model : str
    quick : bool
        Tiny cases with few seeds: to see that it works.
    cache : pathlib.Path
    jobs : int
        Processes.
    seeds : tuple of int
    """

    def __init__(
        self, pool: Executor, bar: "Progress", radiation_model: str, quick: bool, cache: pathlib.Path,
        jobs: int,
    ) -> None:  # fmt: skip
        self._pool, self._bar = pool, bar
        self.radiation_model, self.quick, self.cache, self.jobs = radiation_model, quick, cache, jobs
        self.seeds = QUICK_SEEDS if quick else SEEDS

    def all(
        self, name: str, cases: Sequence[Case], words: str, *, what: str = "reduce",
        radiation_model: str | None = None,
    ) -> Results:  # fmt: skip
        """Results of all cases, in their order."""
        task = self._bar.add_task(words, total=len(cases))
        model = radiation_model or self.radiation_model
        waiting = {
            self._pool.submit(evaluate, name, what, case, model, self.quick, self.cache): case
            for case in cases
        }
        found: Results = {}
        try:
            for done in as_completed(waiting):
                found[waiting[done]] = done.result()
                self._bar.advance(task)
        except BaseException:
            for future in waiting:
                future.cancel()
            raise
        return {case: found[case] for case in cases}
