"""Fenced blocks of a page and the commands in them, read without the package being installed."""

import pathlib
import re
import shlex

_BLOCK = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```', flags=re.MULTILINE | re.DOTALL)


def blocks(page):
    """Language, file name (or None) and text of every fenced block of a page."""
    text = pathlib.Path(page).read_text(encoding="utf-8")
    return [(match[1], match[2], match[3]) for match in _BLOCK.finditer(text)]


def commands(script):
    """Command lines of a block as lists of words; remarks and line breaks taken out."""
    lines = script.replace("\\\n", " ").splitlines()
    return [words for line in lines if (words := shlex.split(line, comments=True))]
