"""The three-ball example runs, its table holds the paper's values beside ours, its page says what it says."""

import csv
import re
import subprocess
import sys

import pytest

from tests.examples.conftest import ROOT


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("impact")
    command = [sys.executable, str(ROOT / "examples" / "impact" / "three_balls.py")]
    command += ["--short", "--output-dir", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return out


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return {row["case"]: row for row in csv.DictReader(file)}


@pytest.mark.heavy
def test_table_holds_ours_beside_the_papers(folder):
    assert {path.name for path in folder.iterdir()} == {
        "three_balls.md",
        "three_balls.csv",
        "three_balls.png",
    }
    table = rows(folder / "three_balls.csv")
    papers = [float(row["paper"]) for row in table.values() if row["paper"]]
    assert papers == [0.524, 0.352, 0.543]
    touching, far = table["in contact, 0.5 m/s, Hertz"], table["gap O2-O3 20 um"]
    assert float(touching["no scattering, max"]) == pytest.approx(0.15, abs=0.005)
    assert float(touching["rigid max"]) == pytest.approx(0.405, abs=0.002)
    assert float(far["rigid max"]) > float(touching["rigid max"])


@pytest.mark.heavy
def test_page_repeats_what_the_example_computes(folder):
    """The fast cases stand in the page with the same figures."""
    page = (ROOT / "docs" / "results" / "three_balls.md").read_text(encoding="utf-8")
    made = (folder / "three_balls.md").read_text(encoding="utf-8")
    lines = [line for line in made.splitlines() if re.match(r"\| (in contact|gap)", line)]
    assert len(lines) == 6
    for line in lines:
        wanted, (found,) = line.split(" | "), _like(line, page)
        for a, b in zip(wanted[2:], found.split(" | ")[2:], strict=True):
            # another machine may round otherwise
            assert float(b.strip(" |")) == pytest.approx(float(a.strip(" |")), rel=5e-3, abs=2e-3)


def _like(line, page):
    """Lines of the page about the same case with as many columns."""
    case = line.split(" | ")[0]
    same = [other for other in page.splitlines() if other.split(" | ")[0] == case]
    return [other for other in same if other.count("|") == line.count("|")]
