"""The README's commands exist and its Python runs as printed."""

import contextlib
import io
import re
import subprocess

import pytest

from fmu_bearing import build_fmu
from tests.blocks import blocks, commands
from tests.pages import ROOT, run_page

pytestmark = pytest.mark.pages

PAGE = ROOT / "README.md"
README = PAGE.read_text(encoding="utf-8")
FIRST = README[: README.index("\n## ")]


@pytest.mark.parametrize("command", re.findall(r"^make (\w+)", FIRST, flags=re.MULTILINE))
def test_make_knows_the_target(command):
    # -n prints what would be done and does nothing
    done = subprocess.run(["make", "-n", command], cwd=ROOT, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr


def test_python_of_the_readme_runs(example, tmp_path, monkeypatch):
    """Of the scene that make demo builds, but for the sound of boundary elements."""
    (code,) = (text for language, _, text in blocks(PAGE) if language == "python")
    assert len(code.strip().splitlines()) <= 10
    (tmp_path / "out").mkdir()
    build_fmu(example("7003C-spindle"), tmp_path / "out" / "Bearing7003C.fmu", "native")
    monkeypatch.chdir(tmp_path)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(code, "README.md", "exec"), {})
    torque, level = map(float, re.search(r"(\S+) N\.m, (\S+) dB\(A\)", printed.getvalue()).groups())
    # the order of a 17 mm spindle bearing: some N.mm, and a sound between a quiet room and a workshop
    assert 1e-3 < torque < 0.1
    assert 30.0 < level < 110.0


def test_commands_of_the_readme_run_in_order(tmp_path, monkeypatch):
    sh = [commands(text) for language, _, text in blocks(PAGE) if language == "sh"]
    assert [words[0] for block in sh for words in block] == ["make", "make", *["fmu-bearing"] * 4]
    page = tmp_path / "page.md"
    page.write_text(README[len(FIRST) :], "utf-8")
    run_page(page, tmp_path, monkeypatch)
    made = {path.name for path in tmp_path.iterdir()}
    assert made == {"examples", "out", "page.md", "my.toml", "run.csv", "my.fmu"}


def test_the_first_screen_has_a_picture_two_commands_and_python():
    assert FIRST.count("![") == 1
    assert re.findall(r"^(make \w+)", FIRST, flags=re.MULTILINE) == ["make demo", "make test"]
    assert "simulate_fmu(" in FIRST and len(FIRST.splitlines()) <= 45
    assert len(README.splitlines()) <= 60


def test_files_named_in_the_readme_exist():
    links = re.findall(r"\]\(([^)#:]*)\)", README)
    assert len(links) > 15
    for path in links:
        assert (ROOT / path).exists(), path
