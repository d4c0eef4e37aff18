"""Tables on a terminal fit its width."""

import errno
import os

import pytest
from typer.testing import CliRunner

from fmu_bearing.cli import app
from fmu_bearing.results.table import show, write_csv
from tests.conftest import EXAMPLES


@pytest.fixture
def printed(monkeypatch, capsys):
    def call(*arguments, width=80):
        monkeypatch.setenv("COLUMNS", str(width))
        show(*arguments)
        return capsys.readouterr().out.splitlines()

    return call


def test_a_narrow_table_is_a_table(printed):
    lines = printed("title", ("a", "b"), [["1", "[2]"], ["3", "4"]])
    assert len(lines) == 7 and "[2]" in lines[4]


def test_cells_are_broken_between_words(printed):
    lines = printed("title", ("a", "b"), [["key", "word " * 40]])
    assert max(map(len, lines)) <= 80
    assert sum(line.count("word") for line in lines) == 40


def test_no_word_of_a_head_is_cut(printed):
    """The levels of `sound`: heads take two or three lines, and all words are there."""
    columns = ["microphone", "Leq, dB", "LAeq, dB(A)"]
    columns += [f"{name}, dB(A)" for name in ("inner ring", "outer ring", "cage", "balls")]
    row = ["microphone at 126 deg", *["57.2"] * 6]
    lines = printed("levels", columns, [row] * 4)
    assert max(map(len, lines)) <= 80 and not any("\u2026" in line for line in lines)
    head = " ".join(lines[:5])
    assert all(word in head for name in columns for word in name.split())
    assert sum(line.count("microphone at 126 deg") for line in lines) == 4


@pytest.mark.parametrize("width", [80, 60])
def test_a_table_that_is_too_wide_is_reported_row_by_row(printed, width):
    columns = tuple(f"column-{k}" for k in range(15))
    lines = printed("title", columns, [[f"cell-{i}-{k}" for k in range(15)] for i in range(3)], width=width)
    assert max(map(len, lines)) <= width and lines[0] == "title"
    for i in range(3):
        for k in range(1, 15):
            assert any(line.split() == [f"column-{k}", f"cell-{i}-{k}"] for line in lines)


@pytest.mark.parametrize(
    "words",
    [
        ("scene", "show", EXAMPLES / "7003C-spindle.toml"),
        ("scene", "catalogue", "materials"),
        ("scene", "catalogue", "lubricants"),
        ("info", EXAMPLES / "7003C-spindle.toml"),
    ],
    ids=lambda words: words[1] if isinstance(words, tuple) else str(words),
)
def test_tables_of_commands_fit_80_columns(monkeypatch, words):
    monkeypatch.setenv("COLUMNS", "80")
    done = CliRunner().invoke(app, [str(word) for word in words])
    lines = done.stdout.splitlines()
    if words[1] == "show":  # below its values stand some lines in words
        lines = lines[: next(k for k, line in enumerate(lines) if line.startswith("scene "))]
    elif words[0] == "info":
        lines = lines[1:]  # and above it the operating point
    assert done.exit_code == 0 and len(lines) > 5 and max(map(len, lines)) <= 80


def test_a_table_for_which_there_is_no_room_leaves_no_file(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OSError, match="No space left"):
        write_csv(tmp_path / "a.csv", ["a"], [["1"]])
    assert list(tmp_path.iterdir()) == []
