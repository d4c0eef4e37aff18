"""The recipes of docs/architecture.md: applied to a copy of the package, they do what they say.

A step is a paragraph that ends with a file, a place in it and a colon, and the block that follows::

    In `FILE`, after the line with `TEXT`:      also: before the line, in place of the line
    At the end of `FILE`:
    New file `FILE`:

The text has to stand in exactly one line of the file. Commands stand after "Run this:".
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass, field

import pytest

from tests.pages import DOCS, ROOT

pytestmark = pytest.mark.pages

PAGE = DOCS / "architecture.md"
COPIED = ("fmu_bearing", "tests", "examples", "pyproject.toml", "docs/cli.md")
#: Recipes that change kernels or step a bearing in all fidelities: the copy's engine is compiled for them.
COMPILED = ("Add a force", "Add a spring", "Add an output", "Add an integrator")
#: End of the copy's ``optimise.py``. Tests of recipes run milliseconds of a bearing.
UNOPTIMISED = """

from tests.compiled import unoptimised  # noqa: E402

unoptimised.install()
"""
#: Compiles what these tests call. Asked one by one, units for single bearings would be compiled beside them.
READY = """
from fmu_bearing.compiled import ready
from fmu_bearing.compiled.units import UNITS
ready(*(unit for unit in UNITS if unit != "sound"))
"""

_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", flags=re.MULTILINE | re.DOTALL)
_STEP = re.compile(
    r"(?:New file `(?P<new>[^`]+)`"
    r"|At the end of `(?P<end>[^`]+)`"
    r"|In `(?P<file>[^`]+)`, (?P<where>after|before|in place of) the line with `(?P<text>[^`]+)`):$"
)


@dataclass
class Recipe:
    """Steps (match of the paragraph's end, block) and commands of one recipe."""

    steps: list = field(default_factory=list)
    commands: list = field(default_factory=list)


def recipes():
    """Recipes of the page by their title."""
    text = PAGE.read_text(encoding="utf-8").split("\n## Recipes\n")[1].split("\n## ")[0]
    found = {}
    for section in text.split("\n### ")[1:]:
        title, body = section.split("\n", 1)
        recipe, start = Recipe(), 0
        for block in _BLOCK.finditer(body):
            before = " ".join(body[start : block.start()].strip().rsplit("\n\n", 1)[-1].split())
            start = block.end()
            if before == "Run this:":
                recipe.commands += [shlex.split(line) for line in block[2].splitlines()]
            else:
                step = _STEP.search(before)
                assert step is not None, f"{title}: no step is: {before}"
                recipe.steps.append((step, block[2]))
        found[title] = recipe
    return found


RECIPES = recipes()


def apply(folder, step, block):
    """Do one step of a recipe in a copy; return the file's path from the copy's root."""
    name = step["new"] or step["end"] or step["file"]
    path = folder / name
    if step["new"]:
        assert not path.exists(), name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(block, encoding="utf-8")
        return name
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    if step["end"]:
        lines.append(block)
    else:
        places = [i for i, line in enumerate(lines) if step["text"] in line]
        assert len(places) == 1, f"{name}: {step['text']!r} stands in {len(places)} lines"
        first = places[0] + (step["where"] == "after")
        lines[first : places[0] + (step["where"] != "before")] = [block]
    path.write_text("".join(lines), encoding="utf-8")
    return name


@dataclass
class Copy:
    """A copy of the package with all recipes applied: files they touched, what did not fit."""

    folder: pathlib.Path
    touched: set = field(default_factory=set)
    misfits: dict = field(default_factory=dict)

    def run_tests(self, titles):
        """Run the commands of recipes, all in one process: each would spend seconds on imports."""
        commands = [command for title in titles for command in RECIPES[title].commands]
        self.run([*commands[0][:3], *(word for command in commands for word in command[3:])])

    def run(self, command):
        """Run a command with the copy's package and kernels; its output is the failure message."""
        own = {"PYTHONPATH": str(self.folder), "FMU_BEARING_CACHE": str(self.folder / "cache")}
        command = [sys.executable if word == ".venv/bin/python" else word for word in command]
        done = subprocess.run(
            command, cwd=self.folder, env=os.environ | own, capture_output=True, text=True, timeout=1800
        )
        if done.returncode != 0:
            pytest.fail(f"{shlex.join(command)}\n{done.stdout}{done.stderr}", pytrace=False)


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    made = Copy(tmp_path_factory.mktemp("recipes"))
    for name in COPIED:
        if (ROOT / name).is_dir():
            # with the compiled files: they know the time and the size of their source, and a copy keeps both
            unfinished = shutil.ignore_patterns("*.pyc.*", "*.tmp.*")  # another worker may be writing them
            shutil.copytree(ROOT / name, made.folder / name, ignore=unfinished)
        else:
            (made.folder / name).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / name, made.folder / name)
    for title, recipe in RECIPES.items():
        for step, block in recipe.steps:
            try:
                made.touched.add(apply(made.folder, step, block))
            except AssertionError as misfit:
                made.misfits.setdefault(title, []).append(str(misfit).split("\n")[0])
    return made


def test_every_recipe_has_steps_and_a_command():
    others = {
        "bearing to the catalogue", "bearing type", "radiation model", "property of a material", "command"
    }  # fmt: skip
    assert {*COMPILED, *(f"Add a {name}" for name in others)} == set(RECIPES)
    for recipe in RECIPES.values():
        assert recipe.steps
        assert [words[:3] for words in recipe.commands] == [[".venv/bin/python", "-m", "pytest"]]
        # each brings the test that it is held to
        assert recipe.steps[0][0]["new"] or recipe.steps[-1][0]["new"]


@pytest.mark.parametrize("title", RECIPES)
def test_every_step_finds_its_place(title, copy):
    assert title not in copy.misfits, copy.misfits[title]


def test_changed_files_keep_the_style(copy):
    changed = sorted(name for name in copy.touched if name.endswith(".py"))
    copy.run([sys.executable, "-m", "ruff", "check", "--no-cache", *changed])
    copy.run([sys.executable, "-m", "ruff", "format", "--check", "--no-cache", *changed])


def test_changed_packages_keep_their_maps(copy):
    copy.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/test_maps.py"])


@pytest.mark.heavy
def test_recipes_without_kernels(copy):
    copy.run_tests([title for title in RECIPES if title not in COMPILED])


@pytest.mark.heavy
def test_recipes_with_kernels(copy):
    with (copy.folder / "fmu_bearing/compiled/optimise.py").open("a", encoding="utf-8") as file:
        file.write(UNOPTIMISED)
    copy.run([sys.executable, "-c", READY])
    copy.run_tests(COMPILED)
