"""Cases evaluated on the cores given, with progress; results are kept on disk."""

import pathlib
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, as_completed
from types import ModuleType
from typing import TYPE_CHECKING, Any

from examples.papers import floor, reduced
from examples.papers.case import AROUND, FEW_AROUND, FEW_SEEDS, SEEDS, Case, around, code_hash, kept
from examples.papers.hearing import Ear

if TYPE_CHECKING:
    from rich.progress import Progress

Results = dict[Case, dict[str, Any]]
_QUICK = ((1, 2), (1.0,))  # seeds, speeds over the named one


def evaluate(what: str, case: Case, radiation_model: str, cache: pathlib.Path) -> dict[str, Any]:
    """Return what a function of `reduced`, or `floor.floors`, makes of one case (worker)."""
    module: ModuleType = reduced if hasattr(reduced, what) else floor
    code = code_hash(module.__name__.rsplit(".", 1)[-1], "hearing")
    name = f"{case.key(radiation_model)}-{radiation_model}-{code}-{what}"

    def compute() -> dict[str, Any]:
        # of contact ellipses that reach a shoulder at large amplitudes, once per run: the page says so
        warnings.simplefilter("ignore", UserWarning)
        ear = Ear(case.recording(radiation_model), radiation_model, cache)
        found: dict[str, Any] = getattr(module, what)(ear, case)
        return found

    return kept(cache / what / f"{name}.json", compute)


class Runs:
    """Evaluates cases.

    Attributes
    ----------
    radiation_model : str
    quick : bool
        Tiny cases with few seeds, each at its own speed: to see that it works.
    cache : pathlib.Path
    """

    def __init__(
        self, pool: Executor, bar: "Progress", radiation_model: str, quick: bool, cache: pathlib.Path
    ) -> None:
        self._pool, self._bar = pool, bar
        self.radiation_model, self.quick, self.cache = radiation_model, quick, cache

    def around(self, cases: Sequence[Case]) -> list[Case]:
        """Return the cases of values: all seeds and nine speeds around each."""
        return around(cases, *(_QUICK if self.quick else (SEEDS, AROUND)))

    def few(self, cases: Sequence[Case]) -> list[Case]:
        """Return the cases of a whole range of speeds: two seeds and five speeds around each."""
        return around(cases, *(_QUICK if self.quick else (FEW_SEEDS, FEW_AROUND)))

    def one(self, place: pathlib.Path, compute: Callable[[], dict[str, Any]], words: str) -> dict[str, Any]:
        """Return what ``place`` (JSON) holds, or compute it in a worker and put it there."""
        task = self._bar.add_task(words, total=1)
        found: dict[str, Any] = self._pool.submit(kept, place, compute).result()
        self._bar.advance(task)
        return found

    def all(
        self, what: str, cases: Sequence[Case], words: str, radiation_model: str | None = None
    ) -> Results:
        """Results of all cases, in their order; of one that is asked for twice, one.

        Parameters
        ----------
        what : str
            A function of `reduced`, or ``floors``.
        cases : sequence of Case
        words : str
            Shown beside the bar.
        radiation_model : str, optional
            In place of the page's.
        """
        cases = list(dict.fromkeys(cases))
        task = self._bar.add_task(words, total=len(cases))
        model = radiation_model or self.radiation_model
        waiting = {self._pool.submit(evaluate, what, case, model, self.cache): case for case in cases}
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
