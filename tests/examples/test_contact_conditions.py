"""The contact-condition examples run; the page repeats what they compute, and its own sentences hold."""

import csv
import importlib.util
import re
import subprocess
import sys

import numpy as np
import pytest

from tests.examples.conftest import ROOT

RESULTS = ROOT / "docs" / "results"
PAGE = (ROOT / "docs" / "contact-conditions.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Text that the short run writes."""
    out = tmp_path_factory.mktemp("conditions")
    command = [sys.executable, str(ROOT / "examples" / "impact" / "contact_conditions.py")]
    done = subprocess.run(
        [*command, "--short", "--output-dir", str(out)], capture_output=True, text=True, timeout=240
    )
    assert done.returncode == 0, done.stderr
    assert {path.name for path in out.iterdir()} == {
        f"contact_conditions.{end}" for end in ("md", "csv", "png")
    }
    return (out / "contact_conditions.md").read_text(encoding="utf-8")


def part(text, title):
    """Rows of the table under a title, as lists of cells."""
    (found,) = re.findall(rf"^##+ {title}[^\n]*\n(.*?)(?=^#|\Z)", text, flags=re.MULTILINE | re.DOTALL)
    lines = [line for line in found.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]\d+)?")


def assert_same(cell, other):
    """Equal words, and numbers within one unit of the last printed digit: another machine may round it."""
    assert NUMBER.sub("#", cell) == NUMBER.sub("#", other)
    for one, printed in zip(NUMBER.findall(cell), NUMBER.findall(other), strict=True):
        mantissa, _, power = printed.partition("e")
        digit = 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))
        assert float(one) == pytest.approx(float(printed), abs=1.001 * digit), (cell, other)


@pytest.mark.heavy
@pytest.mark.parametrize(
    "title",
    [
        "Natural frequencies", "What moves", "Springs between", "Three balls", "The paper's peaks",
        "Matches within",
    ],
)  # fmt: skip
def test_results_repeat_what_the_example_computes(made, title):
    stored = (RESULTS / "contact_conditions.md").read_text(encoding="utf-8")
    ours, theirs = part(made, title), part(stored, title)
    assert len(ours) == len(theirs) > 1
    for one, other in zip(ours, theirs, strict=True):
        for cell, wanted in zip(one, other, strict=True):
            assert_same(cell, wanted)


@pytest.mark.pages
def test_page_has_the_frequencies_of_the_results():
    stored = {row[0]: row for row in part((RESULTS / "contact_conditions.md").read_text(), "Natural freq")}
    rows = part(PAGE, "The bearing, kHz")[:6]
    for condition, still, reported in rows:
        own = stored[condition]
        assert still == own[1]
        plain = [entry for entry in reported.removesuffix(" ...").split(", ") if "balls" not in entry]
        assert len(plain) >= 5
        assert set(plain) <= set(own[2].split(", "))


@pytest.mark.pages
@pytest.mark.parametrize(("title", "kept"), [("What the patch", 6), ("Matches within", 5)])
def test_rows_of_the_page_are_those_of_the_results(title, kept):
    stored = part((RESULTS / "contact_conditions.md").read_text(encoding="utf-8"), title)
    names = {"rigid rings": "ring modes: none", "free rings, outer": "outer ring, free"}
    tables = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in PAGE.splitlines() if line[:1] == "|"
    ]
    found = 0
    for row in tables:
        name = names.get(row[0], row[0])
        same = [other for other in stored if other[0] == name]
        if same and len(row) >= 5:
            cells = [cell.removesuffix(" %") for cell in row[1 : 1 + kept]]
            found += cells == same[0][1 : 1 + len(cells)]
    assert found >= 6


@pytest.mark.pages
def test_page_has_the_choice_and_the_contradictions():
    stored = (RESULTS / "contact_conditions.md").read_text(encoding="utf-8")
    first = part(stored, "Matches with free choice")[0]
    assert f"finds {first[2].split()[0]} matches of 9" in PAGE.replace("\n", " ")
    assert f"p = {first[4]}." in PAGE
    reported = PAGE[PAGE.index("Contradictions:") : PAGE.index("Our own peaks")]
    for figure in ("277 kHz", "53.9 kHz", "0.8 and 0.7 %", "7.9 to 124.4", "88 %"):
        assert figure in re.sub(r"\s+", " ", reported), figure
        assert figure in re.sub(r"\s+", " ", stored), figure


@pytest.mark.heavy
def test_a_ball_peaks_at_the_chain_of_balls():
    """The page's figures are the results', and one band of them is computed again."""
    with (RESULTS / "own_peaks.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for reported in part(PAGE, "Our own peaks"):
        own = [row for row in rows if (row["r/min"], row["band, kHz"]) == (reported[0], reported[1])]
        assert reported[2:5] == [row["matches"] for row in own]
    spec = importlib.util.spec_from_file_location("own", ROOT / "examples" / "impact" / "own_peaks.py")
    own = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(own)
    scene = own.read_scene(own.SCENE)
    exact = scene.model_copy(update={"fidelity": scene.fidelity.model_copy(update=own.ACCURACY)})
    found = own.peaks(own.acceleration(exact, 20000.0)["tangential"], 54e3, 200e3)
    # chain of balls on races that hold their radii; lines of 20 ms, steps of 0.5 us
    chain = np.cos(np.pi / 12) * np.array([111.55, 124.41, 128.80])
    assert found / 1e3 == pytest.approx(chain, rel=1e-3)
    listed = re.findall(
        r"\d+\.\d+", next(row["peaks, kHz"] for row in rows if row["direction"] == "tangential")
    )
    assert np.array(listed, dtype=float) == pytest.approx(chain, rel=1e-3)
