"""Run the code blocks of a documentation page in order, as a reader would."""

import os
import pathlib
import re
import shlex
import subprocess
import sys

import typer
from typer.testing import CliRunner

from fmu_bearing.cli import app

ROOT = pathlib.Path(__file__).parents[1]
DOCS = ROOT / "docs"

_BLOCK = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```', flags=re.MULTILINE | re.DOTALL)


def blocks(page):
    """Language, file name (or None) and text of every fenced block of a page."""
    text = pathlib.Path(page).read_text(encoding="utf-8")
    return [(match[1], match[2], match[3]) for match in _BLOCK.finditer(text)]


def commands(script):
    """Command lines of a block as lists of words; remarks and line breaks taken out."""
    lines = script.replace("\\\n", " ").splitlines()
    return [words for line in lines if (words := shlex.split(line, comments=True))]


def run_page(page, folder, monkeypatch):
    """Run Python blocks, ``fmu-bearing`` and other programs of ``sh`` blocks; write blocks that name a file.

    Returns the names that the Python blocks leave behind. Blocks of other kinds are not run: ``bash`` is for
    installation.
    """
    (folder / "examples").symlink_to(ROOT / "examples")
    (folder / "out").mkdir()
    monkeypatch.chdir(folder)
    names = {"__name__": "page"}
    for language, file, text in blocks(page):
        if file is not None:
            (folder / file).write_text(text, encoding="utf-8")
        elif language == "python":
            exec(compile(text, str(page), "exec"), names)
        elif language == "sh":
            for words in commands(text):
                _run(words)
    return names


def _run(words):
    if words[0] == "fmu-bearing":
        done = CliRunner().invoke(app, words[1:])
        assert done.exit_code == 0, f"{shlex.join(words)}\n{done.output}\n{done.exception!r}"
        return
    path = f"{pathlib.Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(words, capture_output=True, text=True, env=os.environ | {"PATH": path})
    assert done.returncode == 0, f"{shlex.join(words)}\n{done.stdout}{done.stderr}"


def parse(words):
    """Let the application read a command line without running it; click's exceptions say what is wrong."""
    command, rest = typer.main.get_command(app), list(words[1:])
    while rest and rest[0] in getattr(command, "commands", {}):
        command = command.commands[rest.pop(0)]
    command.make_context(command.name, rest)
