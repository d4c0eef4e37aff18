"""Progress of long work: a bar on a terminal, lines in a log, on standard error."""

import sys
import time
from types import TracebackType
from typing import Any, Self

__all__ = ["Display"]

_PAUSE = 10.0  # s between two lines in a log


class Display:
    """Shows what is done, how far it is and how long it has taken.

    Parameters
    ----------
    what : str
    """

    def __init__(self, what: str) -> None:
        self.what = what
        self._begin = self._told = time.monotonic()
        self._estimated = False
        self._bar: Any = None
        self._shown = 0.0

    def __enter__(self) -> Self:
        if sys.stderr is not None and sys.stderr.isatty():
            self._bar = _bar()
            self._task = self._bar.add_task(self.what, total=1.0)
            self._bar.start()
        else:
            self.tell(f"{self.what} ...")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.stop()
        elif kind is None:
            self.tell(f"{self.what}: done after {time.monotonic() - self._begin:.0f} s")

    def at(self, done: float, rest: float | None = None) -> None:
        """Show the part (0 to 1) that is done, and the time (s) of the rest where it is known.

        The part that is shown never goes back; the time follows what is known. A log gets a line as soon as a
        time is known that is worth one.
        """
        self._shown = max(self._shown, done)
        now = time.monotonic()
        past = now - self._begin
        more = "" if rest is None else f", about {rest:.0f} s more"
        first = rest is not None and rest >= _PAUSE and not self._estimated
        if self._bar is not None:
            self._bar.update(self._task, completed=self._shown, description=self.what + more)
        elif now - self._told >= _PAUSE or first:
            self._told = now
            self.tell(f"{self.what}: {self._shown:.0%} after {past:.0f} s{more}")
        self._estimated |= rest is not None

    def tell(self, text: str) -> None:
        """Show a line."""
        if self._bar is not None:
            self._bar.console.print(text, highlight=False)
        elif sys.stderr is not None:
            print(text, file=sys.stderr, flush=True)


def _bar() -> Any:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        console=Console(stderr=True),
    )
