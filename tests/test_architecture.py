"""The rules that tools can check: style, format, types, and who may import whom."""

import ast
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[1]
MAX_LINES = 450  # beyond about 400 a file probably holds two things
LINT_IMPORTS = "from importlinter.cli import lint_imports_command; lint_imports_command()"


def check(*arguments):
    """Run a tool with this interpreter in the repository; its output is the failure message."""
    done = subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        pytest.fail(done.stdout + done.stderr, pytrace=False)


@pytest.mark.lint
def test_style():
    check("-m", "ruff", "check", ".")


@pytest.mark.lint
def test_format():
    check("-m", "ruff", "format", "--check", ".")


@pytest.mark.lint
def test_types():
    check("-m", "mypy")


@pytest.mark.lint
def test_imports():
    check("-c", LINT_IMPORTS)


@pytest.mark.lint
def test_files_are_short():
    long = {}
    for path in (ROOT / "fmu_bearing").rglob("*.py"):
        lines = len(path.read_text(encoding="utf-8").splitlines())
        if lines > MAX_LINES:
            long[path.relative_to(ROOT).as_posix()] = lines
    assert not long


def test_the_engine_needs_no_other_room():
    """Importing the engine loads nothing else of the project and no workshop library (Numba loads SciPy)."""
    code = (
        "import sys, fmu_bearing.engine.abi\n"
        "rooms = {m.split('.')[1] for m in sys.modules if m.startswith('fmu_bearing.')}\n"
        "strangers = {'pydantic', 'matplotlib', 'fmpy', 'pythonfmu', 'typer'} & set(sys.modules)\n"
        "assert rooms == {'engine'}, rooms\n"
        "assert not strangers, strangers\n"
    )
    check("-c", code)


@pytest.mark.lint
def test_no_process_is_waited_for_without_end():
    """Every process that a test runs has a timeout: one that hangs fails its test, not the whole run."""
    endless, waiting = [], ("subprocess.run", "subprocess.check_output", "subprocess.check_call")
    for path in sorted((ROOT / "tests").rglob("*.py")):
        calls = (n for n in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(n, ast.Call))
        for call in (one for one in calls if ast.unparse(one.func) in waiting):
            if not {"timeout", None} & {given.arg for given in call.keywords}:
                endless.append(f"{path.relative_to(ROOT)}:{call.lineno}")
    assert not endless
