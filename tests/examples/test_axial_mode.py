"""The example with modes in short, its committed table, and the page that shows it."""

import csv
import subprocess
import sys

import pytest

from tests.examples.conftest import ROOT

PAGE = ROOT / "docs" / "modes.md"


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return {row[0]: row[1:] for row in list(csv.reader(file))[1:]}


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    out = tmp_path_factory.mktemp("axial")
    command = [sys.executable, str(ROOT / "examples" / "modes" / "axial_mode.py"), "--short"]
    done = subprocess.run([*command, "--output-dir", str(out)], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return rows(out / "axial_mode.csv")


@pytest.mark.heavy
def test_the_committed_table_is_what_the_example_gives(short):
    known = rows(ROOT / "docs" / "results" / "axial_mode.csv")
    assert set(short) == {"200", "500", "650"} and set(short) < set(known)
    for preload, cells in short.items():
        for own, other in zip(cells, known[preload], strict=True):
            assert (own == "") == (other == "")
            if own:
                assert float(own) == pytest.approx(float(other), rel=0.01, abs=0.011)


@pytest.mark.heavy
def test_the_vibration_follows_the_distance_from_what_excites(short):
    """The decision of the page: 650 N shakes least, 200 N most."""
    inner = {preload: float(cells[-2]) for preload, cells in short.items()}
    assert inner["650"] < 0.5 * inner["500"] < 0.25 * inner["200"]
    # 0.95 %, printed with one digit
    assert abs(float(short["200"][5])) <= 1.0 < 3.0 < float(short["500"][3]) < 5.0


@pytest.mark.pages
def test_the_sentences_below_the_table_of_the_page_hold():
    """The table itself is written from the results (tests/figures.py)."""
    known = rows(ROOT / "docs" / "results" / "axial_mode.csv")
    margin, shaken = ({preload: float(row[column]) for preload, row in known.items()} for column in (3, 6))
    assert abs(margin["400"]) < abs(margin["500"]) and shaken["400"] > shaken["500"] > 2.0 * shaken["650"]
    assert shaken["200"] / shaken["500"] == pytest.approx(3.0, abs=0.5)


@pytest.mark.pages
def test_the_page_shows_what_the_command_gives():
    from fmu_bearing import modes

    found = modes(ROOT / "examples" / "scenes" / "7003C-spindle.toml")
    lines = PAGE.read_text("utf-8").splitlines()
    first = lines.index("| Hz | damping, % | whirl | what moves most | kinetic energy, % |")
    for line in lines[first + 2 : first + 7]:
        hertz, damping, whirl, name, _ = line.strip("| ").split(" | ")
        mode = found.named(name, whirl.strip("-"))
        assert float(hertz.replace(",", "")) == pytest.approx(mode.frequency, abs=0.06)
        assert float(damping) == pytest.approx(100.0 * mode.damping, abs=0.006)
