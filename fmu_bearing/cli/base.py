"""The application, error messages, and what commands do to files.

Exit codes: 0 done; 1 a check has findings; 2 refused (a scene, an option, a file, a missing extra); 3 the
computation ended early; 130 interrupted. In the last two cases the results so far are written.

Commands import their modules when they run, so that help and completion answer at once.
"""

import os
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Self, TypeVar

import typer
from rich.console import Console
from rich.markup import escape
from typer.core import TyperGroup

from fmu_bearing.engine.constants import RPM
from fmu_bearing.progress import Stopped, lines, work

if TYPE_CHECKING:
    from fmu_bearing.scene import Scene

Result = TypeVar("Result")
FOUND, REFUSED, ENDED_EARLY, INTERRUPTED = 1, 2, 3, 130
#: A number with a decimal comma, which no option takes.
FINISHED = (".npz", ".csv", ".nc")  # endings of recordings and results
DECIMAL_COMMA = re.compile(r"[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]+)?")
#: What Typer raises for words that are no command, option or value; it names only the kind for values.
_Usage: Any = typer.BadParameter.__base__


class Commands(TyperGroup):
    """The commands."""

    def __init__(self, **more: Any) -> None:
        super().__init__(**more)
        _keep_brackets(self)

    def make_context(self, *arguments: Any, **more: Any) -> Any:
        """Read the words before the command; what cannot be read is refused in one line."""
        with _one_line():
            return super().make_context(*arguments, **more)

    def invoke(self, ctx: Any) -> Any:
        """Run a command, its warnings one line each. Ctrl-C ends it; what it keeps by itself is kept."""
        try:
            with quiet_warnings(), _one_line(), lines(tell), work("fmu-bearing", shown=False):
                return super().invoke(ctx)
        except KeyboardInterrupt as stop:
            typer.echo(str(stop) or "interrupted", err=True)
            raise typer.Exit(INTERRUPTED) from None
        except BrokenPipeError:
            # who reads has read enough, as `head` does: what is left in the buffer goes nowhere
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            raise typer.Exit() from None


def _keep_brackets(command: Any) -> None:
    """Escape square brackets in the help of a command and all below it: Rich would take ``[tool]`` as markup.

    Typer builds the commands once per call, so no text is escaped twice.
    """
    for one in (command, *command.params):
        for name in ("help", "short_help", "epilog"):
            if text := getattr(one, name, None):
                setattr(one, name, escape(text))
    for below in getattr(command, "commands", {}).values():
        _keep_brackets(below)


@contextmanager
def _one_line() -> Iterator[None]:
    """Refuse options and arguments in one line, as all else is refused."""
    try:
        yield
    except _Usage as error:
        if type(error).__name__ == "NoArgsIsHelpError":
            raise
        path = error.ctx.command_path if error.ctx else "fmu-bearing"
        message = " ".join(error.format_message().split()).rstrip(".")
        more = "" if message.endswith("?") else f"; `{path} --help` lists what there is"
        if "valid number" in message or "valid float" in message:
            message = message.partition(", unable to")[0]
            more = ", with a point where it is decimal, as 0.5" + more
        typer.echo(f"error: {message[0].lower()}{message[1:]}{more}", err=True)
        raise typer.Exit(REFUSED) from None


app = typer.Typer(
    cls=Commands,
    help="Ball bearings and their sound: scenes, runs, FMUs, studies, reports.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    epilog="Exit codes: 0 done; 1 a check found something; 2 refused; 3 ended early and 130 interrupted, "
    "with what was computed written.",
)


def _version(asked: bool) -> None:
    if asked:
        from fmu_bearing import __version__

        typer.echo(f"fmu-bearing {__version__}")
        raise typer.Exit()


@app.callback()
def _common(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """Options of the command itself."""


errors = Console(stderr=True)
tell = partial(typer.echo, err=True)


@contextmanager
def refusals() -> Iterator[None]:
    """Print a refusal in one line, without traceback, and end with code 2."""
    try:
        yield
    except Exception as error:
        if not isinstance(error, _refused()) or isinstance(error, BrokenPipeError):
            raise
        tell(f"error: {_words(error)}")
        raise typer.Exit(REFUSED) from None


def _words(error: Exception) -> str:
    """Return the message of a refusal in one line; those of the operating system name the file first."""
    from fmu_bearing.file_words import why

    name = getattr(error, "filename", None)
    words = f"{name}: {why(error)}" if name is not None else why(error)
    return "; ".join(line.strip() for line in words.splitlines() if line.strip())


@contextmanager
def quiet_warnings() -> Iterator[None]:
    """Print each warning in one line, without its place in the code."""
    with warnings.catch_warnings():
        warnings.simplefilter("always", UserWarning)
        warnings.showwarning = _caution  # type: ignore[assignment]
        yield


def _caution(message: Warning | str, category: type[Warning], *place: Any) -> None:
    """Print a warning of ours; Python's own developers' warnings stay silent."""
    if issubclass(category, UserWarning):
        tell(f"caution: {' '.join(str(message).split())}")


def _refused() -> tuple[type[Exception], ...]:
    """Return the exceptions that count as refusals. They are imported only after an error."""
    from fmu_bearing.compiled.errors import BuildError
    from fmu_bearing.extras import MissingExtra

    return (ValueError, OSError, BuildError, MissingExtra)


def shaft_speed(rpm: float | None, source: "Path | Scene", option: str = "--speed") -> float | None:
    """Return a shaft speed of the command line (r/min) in rad/s, None where none is given.

    ``source`` is the scene that is to turn so, or its file. A run that is finished turns no more.

    Raises
    ------
    Refusal
        For a speed outside the range of a scene's, in the unit in which it was given, and for one of a run
        that is finished.
    """
    if rpm is None:
        return None
    from fmu_bearing.scene.read import read_scene

    if isinstance(source, Path) and source.suffix in FINISHED:
        raise Refusal(f"{option} {rpm:g} r/min is refused: {source} is finished, and turned as it did")
    if isinstance(source, Path) and source.suffix == ".toml":
        source = read_scene(source)
    bearing = getattr(source, "bearing", None)
    if bearing is not None and not abs(rpm) <= (most := bearing.most_speed):
        raise Refusal(f"{option} {rpm:g} r/min is refused: allowed are {-most:g} to {most:g} r/min")
    return rpm * RPM


def span(text: str, scene: Path) -> tuple[float, float]:
    """Return two shaft speeds (rad/s) from two in r/min with a colon between."""
    try:
        first, last = (float(part) for part in text.split(":"))
    except ValueError:
        raise Refusal(
            f"--run-up {text}: write two speeds in r/min with a colon between, such as 5000:30000"
        ) from None
    rising = tuple(shaft_speed(rpm, scene, "--run-up") for rpm in (first, last))
    assert rising[0] is not None and rising[1] is not None
    return rising[0], rising[1]


class Refusal(ValueError):
    """A command cannot work with its arguments; the message says why and what to do."""


def so_far(study: Callable[[], Result]) -> tuple[Result, int]:
    """Return a study and 0, or after Ctrl-C what of it is finished and the exit code of that."""
    try:
        return study(), 0
    except Stopped as stop:
        missing = f"; missing: {stop.missing}" if stop.missing else ""
        tell(f"interrupted: these are the results up to that point{missing}")
        return stop.found, INTERRUPTED


class Writing(list[Path]):
    """The files that a command has written, in a block that writes them.

    What cannot be written, as on a full disk, ends the block and not the command: it prints what it has
    computed, and `end` says the error after that.
    """

    problem = ""

    def __enter__(self) -> Self:
        """Begin to write; several blocks in turn may."""
        return self

    def draw(self, figure: Callable[[], Any], path: Path | None) -> None:
        """Save a picture where one is asked for."""
        if path is not None:
            from fmu_bearing.results.picture_parts import save

            save(figure(), path)
            self.append(path)

    def __exit__(self, kind: Any, error: BaseException | None, trace: Any) -> bool:
        """Keep the first error of the operating system for `end`."""
        if not isinstance(error, OSError):
            return False
        self.problem = self.problem or _words(error)
        return True


def end(code: int, files: Writing | None = None, named: bool = False) -> None:
    """Say which files were written, if ``named``, and which could not be; end a command with a code not 0."""
    if named and files:
        tell(f"written: {', '.join(map(str, files))}")
    if files is not None and files.problem:
        tell(f"error: {files.problem}")
        code = code or REFUSED
    if code:
        raise typer.Exit(code)


def check_new(force: bool, *paths: Path | None) -> None:
    """Refuse to replace files that are there, unless ``--force`` is given.

    Raises
    ------
    Refusal
        With the files.
    """
    there = [path for path in paths if path is not None and path.is_file()]
    if there and not force:
        more = f" and {len(there) - 3} more" if len(there) > 3 else ""
        words = ", ".join(str(path) for path in there[:3]) + more
        raise Refusal(
            f"{words} {'is' if len(there) == 1 else 'are'} there already: name another place, or give "
            "--force to replace what is there"
        )


def check_new_in(force: bool, folder: Path | None, *patterns: str) -> None:
    """Refuse to replace files of a folder that have names of results, unless ``--force`` is given."""
    if folder is not None and folder.is_dir():
        check_new(force, *sorted({path for pattern in patterns for path in folder.glob(pattern)}))


def keep_texts(texts: dict[str, str], folder: Path, force: bool, *patterns: str) -> None:
    """Write files that repeat the work of a folder; refuse to replace the results of other work there."""
    if not all((folder / name).is_file() and (folder / name).read_text("utf-8") == new
               for name, new in texts.items()):  # fmt: skip
        check_new_in(force, folder, *patterns)
    folder.mkdir(parents=True, exist_ok=True)
    for name, new in texts.items():
        (folder / name).write_text(new, "utf-8")


def show_estimate(found: dict[str, Any], what: str, as_json: bool) -> None:
    """Print how long many runs are going to take (`sweeps.runs.estimate`)."""
    from fmu_bearing.run.simulate import duration

    if as_json:
        print_json(found)
        return
    typer.echo(
        f"{found['points']} {what}, {found['kept']} kept; one took {found['probe_s']:.3g} s "
        f"(the first {found['first_s']:.3g} s, with loading and sound): about "
        f"{duration(found['estimate_s'])} on {found['workers']} processes"
        + (
            f", of which {duration(found['tables_s'])} for {found['tables']} tables of the contact over a "
            f"defect, {found['table_s']:.3g} s each, which are kept for later"
            if found["tables"]
            else ""
        )
        + (f"; the probe was refused: {found['reason']}" if found["reason"] else "")
    )


def show(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print one table within the width of the terminal; see `results.table.show`."""
    from fmu_bearing.results import table

    table.show(title, columns, rows)


def print_json(result: Any) -> None:
    """Print ``result`` as JSON; NaN and infinity become null, because JSON does not have them."""
    from fmu_bearing.results.base import as_json

    typer.echo(as_json(result))
