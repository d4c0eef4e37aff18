"""Maps that are true: the docstring of each package names what its folder holds, and nothing else."""

import ast
import pathlib
import re

import pytest

pytestmark = pytest.mark.pages

PACKAGE = pathlib.Path(__file__).parents[1] / "fmu_bearing"
PACKAGES = sorted(path.parent for path in PACKAGE.rglob("__init__.py"))
#: Names at the start of a row: ``a``, or ``a``, ``b`` where one row stands for several.
_ROW = re.compile(r"``\w+``(?:, ``\w+``)*(?=\s|$)")


def named(folder):
    """Modules and folders that the rows of the docstring's table name, in their order."""
    text = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""
    names = []
    for line in text.splitlines():
        row = _ROW.match(line)
        if row is not None:
            names += re.findall(r"\w+", row[0])
        elif names and not line.startswith(" "):  # not a row that goes on: the table has ended
            break
    return names


def there(folder):
    """Modules and folders of a package."""
    modules = {path.stem for path in folder.glob("*.py")} - {"__init__", "__main__"}
    return modules | {path.name for path in folder.iterdir() if path.is_dir() and path.name != "__pycache__"}


@pytest.mark.parametrize("folder", PACKAGES, ids=lambda path: path.relative_to(PACKAGE.parent).as_posix())
def test_docstring_is_the_map_of_its_folder(folder):
    names, files = named(folder), there(folder)
    assert len(names) == len(set(names)), "a name is given twice"
    missing, gone = files - set(names), set(names) - files
    assert not missing, "not in the docstring"
    assert not gone, "not in the folder"
