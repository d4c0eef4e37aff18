"""The generated parts of the page on architecture name everything there is; lists of files name files."""

import importlib
import importlib.util
import re

import pytest

from fmu_bearing.engine.choices import FIDELITIES, METHODS
from tests import order
from tests.pages import DOCS, ROOT

pytestmark = pytest.mark.pages


@pytest.fixture(scope="module")
def structure():
    spec = importlib.util.spec_from_file_location("docs_structure", DOCS / "site" / "structure.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_page_asks_for_what_is_made(structure):
    page = (DOCS / "architecture.md").read_text(encoding="utf-8")
    made = re.findall(r"<!-- generated: (\w+) -->", page)
    assert made == ["floors", "rooms", "state", "fidelities"]
    assert all(getattr(structure, name)().strip() for name in made)


def test_every_package_has_its_floor_and_its_room(structure):
    floors, rooms = structure.floors(), structure.rooms()
    folder = ROOT / "fmu_bearing"
    for path in folder.iterdir():
        if path.name.startswith("__") or path.suffix == ".typed":  # says that types are given, holds nothing
            continue
        assert re.search(rf"\b{path.stem}\b", floors), path
        assert f"| `{path.stem}` |" in rooms, path
    for path in folder.glob("*/*.py"):
        assert path.stem.startswith("__") or f"`{path.stem}`" in rooms, path


@pytest.mark.parametrize("name", ["p", "u", "s", "z", "w", "c", "y"])
def test_every_place_of_an_array_is_listed(name, structure):
    source = (ROOT / "fmu_bearing" / "engine" / "layout" / f"{name}.py").read_text(encoding="utf-8")
    module = importlib.import_module(f"fmu_bearing.engine.layout.{name}")
    part = structure.state().split(f"### `{name}`\n")[1].split("\n### ")[0]
    places = re.findall(r"^([A-Z]\w*) = (?:_\w+|\w+\.index)\(.*\)(?:  #.*)?$", source, flags=re.MULTILINE)
    assert len(places) >= 8
    for place in places:
        assert f"| `{place}` | {getattr(module, place)} |" in part, place


def test_every_method_has_its_column(structure):
    table = structure.fidelities().splitlines()
    assert table[0] == "| fidelity | " + " | ".join(f"`{method}`" for method in METHODS) + " |"
    assert [row.split(" | ")[0] for row in table[2:]] == [f"| `{model}`" for model in FIDELITIES]


@pytest.mark.parametrize("run", ["quick", "heavy"])
def test_places_whose_times_are_listed_are_there(run):
    times = order.read(ROOT / "tests" / "times" / f"{run}.txt")
    assert len(times) > 20 and all((ROOT / name).exists() for name in times)
