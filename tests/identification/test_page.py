"""docs/identification.md: its table, command and Python run; its quantities are those that there are."""

import re

import pytest

from fmu_bearing.identification.quantities import parse_quantity
from fmu_bearing.scene import read_scene
from tests.pages import DOCS, run_page

pytestmark = pytest.mark.pages

PAGE = DOCS / "identification.md"


@pytest.mark.heavy
def test_the_page_runs(tmp_path, monkeypatch):
    names = run_page(PAGE, tmp_path, monkeypatch)
    assert read_scene(tmp_path / "out" / "identified.toml").name == "7003C-spindle"
    listed = re.findall(r"`out/identified/([\w.]+)`", PAGE.read_text("utf-8"))
    there = {path.name for path in (tmp_path / "out" / "identified").iterdir()}
    assert set(listed) | {"values.csv", "jacobian.csv"} == there
    found = names["found"]
    assert found.evaluations == 0  # all kept by the command
    assert len(found.compared) == 14 and found.rms() < found.rms(before=True) + 0.1


def test_quantities_of_the_page_can_be_read():
    table = PAGE.read_text("utf-8").split("| quantity | meaning |")[1].split("\n\n")[0]
    cells = [row.split(" | ")[0] for row in table.splitlines()[2:]]
    names = [name for cell in cells for name in re.findall(r"`([^`]+)`", cell)]
    assert len(names) == 11
    for name in names:
        parse_quantity(name.removeprefix("background_"))
