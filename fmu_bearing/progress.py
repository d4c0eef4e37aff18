"""Progress of long work: lines of text, passed to a callable; a bar on a terminal, lines in a log.

`work` opens a piece of work whose part done is known. On a terminal it draws a bar. Elsewhere nothing is
printed unless `lines` is active, as it is during a command: then one line each `EVERY` seconds says what goes
on, also while a piece of work computes without end in one call.
"""

import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence, Sized
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, TypeVar

Item = TypeVar("Item")
#: Takes one line about what is going on.
Tell = Callable[[str], None]
#: s between two lines where there is no terminal.
EVERY = 10.0


class Stopped(KeyboardInterrupt):
    """Ctrl-C within a study; ``found`` is the study of what was finished until then, ``missing`` the rest."""

    def __init__(self, found: Any, missing: str = "") -> None:
        super().__init__("interrupted")
        self.found, self.missing = found, missing


@contextmanager
def keeping(done: Sized, made: Callable[[], Any], missing: Callable[[], str] = str) -> Iterator[None]:
    """On Ctrl-C in the block raise `Stopped` with what ``made`` makes, unless nothing is done.

    ``missing`` says in words what is not done. What a study within the block has kept is of another kind.
    """
    try:
        yield
    except KeyboardInterrupt:
        if not len(done):
            raise KeyboardInterrupt from None
        raise Stopped(made(), missing()) from None


def silent(text: str) -> None:
    """Print nothing."""


@dataclass
class Work:
    """A piece of work that is open.

    Attributes
    ----------
    what : str
    total : float or None
        Where it ends, in ``unit``; None: not known.
    unit : str
    done : float
    note : str
        More about how it goes, as the pace.
    bar : bool
        Whether a terminal shows it, so that no line has to.
    """

    what: str
    total: float | None = None
    unit: str = ""
    done: float = 0.0
    note: str = ""
    bar: bool = False
    begun: float = field(default_factory=time.monotonic)
    _draw: Callable[..., None] | None = None

    def at(self, done: float, note: str | None = None) -> None:
        """Say how far it is."""
        self.done = done
        self.note = self.note if note is None else note
        if self._draw is not None:
            self._draw(completed=done, note=self.note)

    def named(self, what: str) -> None:
        """Give it another name: its next stage."""
        self.what = what
        if self._draw is not None:
            self._draw(description=what)

    def words(self) -> str:
        """Say in one line what it is, how far, and how long it has taken."""
        end = "" if self.total is None else f" of {self.total:.4g}"
        far = f"{self.done:.4g}{end} {self.unit}".rstrip() if end or self.done else ""
        past = f"after {time.monotonic() - self.begun:.0f} s"
        return f"{self.what}: {', '.join(part for part in (far, self.note, past) if part)}"


_open: list[Work] = []  # the outermost first


@contextmanager
def work(
    what: str, total: float | None = None, unit: str = "", *, shown: bool | None = None, keep: bool = False,
    elsewhere: bool = False,
) -> Iterator[Work]:  # fmt: skip
    """Open a piece of work, and close it at the end of the block.

    Parameters
    ----------
    what, total, unit
        As `Work` has them.
    shown : bool, optional
        Whether a bar is drawn; default: on a terminal.
    keep : bool
        Whether the bar stays on the terminal afterwards.
    elsewhere : bool
        Whether it shows by itself how far it is, so that neither bar nor lines are needed.
    """
    one = Work(what, total, unit)
    if shown is None:
        shown = sys.stderr is not None and sys.stderr.isatty()
    alone = not elsewhere and not any(other.bar for other in _open)
    display = _bar(one, keep) if shown and alone else None
    one.bar = elsewhere or display is not None
    _open.append(one)
    try:
        if display is None:
            yield one
        else:
            with display:
                yield one
    finally:
        _open[:] = [other for other in _open if other is not one]


def steps(values: Iterable[Item], what: str, unit: str = "") -> Iterator[Item]:
    """Pass values on one by one as a piece of work, whose total is their number where it is known."""
    with work(what, float(len(values)) if isinstance(values, Sequence) else None, unit) as one:
        for done, value in enumerate(values):
            one.at(float(done))
            yield value


@contextmanager
def lines(tell: Tell) -> Iterator[None]:
    """Tell each `EVERY` seconds what goes on, until the block ends; nothing while a bar is drawn."""
    ended = threading.Event()

    def beat() -> None:
        while not ended.wait(EVERY):
            now = list(_open)
            if now and not any(one.bar for one in now):
                tell("; ".join(one.words() for one in now))

    thread = threading.Thread(target=beat, name="progress", daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def _bar(one: Work, keep: bool) -> Any:
    """Return a bar that draws a piece of work."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    counted = "{task.completed:.4g}" + ("" if one.total is None else " of {task.total:.4g}") + " " + one.unit
    display = Progress(
        TextColumn("{task.description}"), BarColumn(), TextColumn(counted.rstrip()),
        TextColumn("{task.fields[note]}"),
        TimeElapsedColumn() if one.total is None else TimeRemainingColumn(),
        console=Console(stderr=True), transient=not keep,
    )  # fmt: skip
    task = display.add_task(one.what, total=one.total, note=one.note)
    one._draw = lambda **shown: display.update(task, **shown)
    return display
