"""The README's commands exist and its Python runs as printed."""

import contextlib
import io
import pathlib
import re
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from fmu_bearing import cli

pytestmark = pytest.mark.pages

ROOT = pathlib.Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


@pytest.mark.parametrize("command", re.findall(r"^make (\w+)", README, flags=re.MULTILINE))
def test_make_knows_the_target(command):
    # -n prints what would be done and does nothing
    done = subprocess.run(["make", "-n", command], cwd=ROOT, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr


def test_python_of_the_readme_runs(example_file, tmp_path, monkeypatch):
    code = blocks("python")[0]
    assert len(code.strip().splitlines()) <= 12
    (tmp_path / "out").mkdir()
    # of the scene that make demo builds, but for the sound of boundary elements
    command = [sys.executable, str(ROOT / "build_fmu.py"), str(example_file), "-o", "out/Bearing7003C.fmu"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True, timeout=600)
    monkeypatch.chdir(tmp_path)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(code, "README.md", "exec"), {})
    torque, level = map(float, re.search(r"(\S+) N\.m, (\S+) dB\(A\)", printed.getvalue()).groups())
    # the order of a 17 mm spindle bearing: some N.mm, and a sound between a quiet room and a workshop
    assert 1e-3 < torque < 0.1
    assert 30.0 < level < 110.0


def test_commands_of_the_readme_run_in_order(tmp_path, monkeypatch):
    first, partner, more = blocks("sh")
    lines = [line.split("#")[0].split() for line in f"{first}{more}".splitlines() if line]
    assert len(lines) == 7 and all(line[0] == "fmu-bearing" for line in lines)
    assert partner.startswith("make demo")
    monkeypatch.chdir(tmp_path)
    for line in lines:
        done = CliRunner().invoke(cli.app, line[1:])
        assert done.exit_code == 0, (line, done.output)
        if line[1] == "info":
            assert "caution" not in done.stderr  # the first example is a sound one
    files = {path.name for path in tmp_path.iterdir()}
    assert files == {"my.toml", "run.csv", "run.png", "sound", "my.fmu"}
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(blocks("python")[1], "README.md", "exec"), {})
    assert re.match(r"Run\(my, 21 points to 0.02 s, \d+ variables\) 0\.0\d+", printed.getvalue())


def test_the_first_screen_has_a_picture_the_installation_and_three_commands():
    screen = README[: README.index("make demo")]
    assert screen.count("![") == 1
    assert ".[all]" in blocks("bash")[0]
    commands = [line.split()[1:3] for line in blocks("sh")[0].splitlines()]
    assert [words[0] for words in commands] == ["scene", "info", "build"]
    assert len(screen.splitlines()) <= 45  # lines of a screen, with the picture's own height


def test_files_named_in_the_readme_exist():
    links = re.findall(r"\]\((docs/[^)#]*)\)", README)
    assert links
    for path in links:
        assert (ROOT / path).exists(), path
