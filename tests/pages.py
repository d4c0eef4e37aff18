"""Run the code blocks of a documentation page in order, as a reader would."""

import contextlib
import io
import os
import pathlib
import re
import shlex
import subprocess
import sys

import typer
from typer.testing import CliRunner

from fmu_bearing.cli import app
from tests.blocks import blocks, commands

ROOT = pathlib.Path(__file__).parents[1]
DOCS = ROOT / "docs"

#: Frames of tables in a terminal, which a page may leave out.
_FRAMES = re.compile(r"[│┃┏┓┗┛┡┩└┘┳┻╇┷┴━─|]")
_NUMBER = re.compile(r"[+-]?\d+(?:\.(\d+))?")


def run_page(page, folder, monkeypatch, shown=False):
    """Run Python blocks, ``fmu-bearing`` and other programs of ``sh`` blocks; write blocks that name a file.

    Returns the names that the Python blocks leave behind. Blocks of other kinds are not run: ``bash`` is for
    installation. With ``shown``, the lines of a ``text`` block are lines that the block before it printed.
    """
    (folder / "examples").symlink_to(ROOT / "examples")
    (folder / "out").mkdir()
    monkeypatch.chdir(folder)
    names, printed = {"__name__": "page"}, ""
    for language, file, text in blocks(page):
        if file is not None:
            (folder / file).write_text(text, encoding="utf-8")
        elif language == "python":
            reported = io.StringIO()
            with contextlib.redirect_stdout(reported):
                exec(compile(text, str(page), "exec"), names)
            printed = reported.getvalue()
        elif language == "sh":
            printed = "".join(_run(words) for words in commands(text))
        elif language == "text" and shown:
            unseen = not_printed(text, printed)
            assert not unseen, f"{page}: {unseen}\nnot among\n{printed}"
    return names


def not_printed(shown, printed):
    """Lines of a page that a program did not print, in their order; a number's last digit may differ."""
    left = iter([_words(line) for line in printed.splitlines()])
    return [
        line
        for line in shown.splitlines()
        if (words := _words(line)) and not any(_equal_words(words, other) for other in left)
    ]


def _words(line):
    return _FRAMES.sub(" ", line).split()


def _equal_words(shown, printed):
    """Whether two lines have the same words; rounding may move a last digit from one machine to another."""
    return len(shown) == len(printed) and all(map(_same, shown, printed))


def _same(shown, printed):
    number = _NUMBER.fullmatch(shown)
    if number is None or _NUMBER.fullmatch(printed) is None:
        return shown == printed
    return abs(float(shown) - float(printed)) <= 1.01 * 10.0 ** -len(number[1] or "")


def _run(words):
    """Run a command line and return what it printed."""
    if words[0] == "fmu-bearing":
        done = CliRunner().invoke(app, words[1:])
        assert done.exit_code == 0, f"{shlex.join(words)}\n{done.output}\n{done.exception!r}"
        return done.output
    path = f"{pathlib.Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(words, capture_output=True, text=True, env=os.environ | {"PATH": path}, timeout=600)
    assert done.returncode == 0, f"{shlex.join(words)}\n{done.stdout}{done.stderr}"
    return done.stdout


def parse(words):
    """Let the application read a command line without running it; click's exceptions say what is wrong."""
    command, rest = typer.main.get_command(app), list(words[1:])
    while rest and rest[0] in getattr(command, "commands", {}):
        command = command.commands[rest.pop(0)]
    command.make_context(command.name, rest)
