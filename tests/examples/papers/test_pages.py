"""The papers' pages: a tiny run of each, what is kept, levels of their sources."""

import csv
import math
import re

import pytest

from examples.papers import (
    case as case_module,
    lines,
    multi_source,
    printed,
    printed_motion,
    sound_field,
    values,
)
from examples.papers.case import ROOT, Case
from examples.papers.hearing import Ear, equivalent, line
from examples.papers.identification import BOTH
from examples.papers.reduced import sources_at
from examples.papers.run import PAGES, run
from tests.examples.papers.fitted import FITTED


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    """All pages from tiny cases: some twenty seconds of one core."""
    root = tmp_path_factory.mktemp("papers")
    with pytest.MonkeyPatch.context() as patch:
        # an instance in a worker warns of ellipses beyond the shoulder at large amplitudes
        patch.setenv("PYTHONWARNINGS", "ignore")
        pages = run(list(PAGES), "compact", quick=True, jobs=1, cache=root / "cache", root=root)
    return root, pages


@pytest.mark.heavy
def test_tiny_pages_are_whole(tiny):
    root, pages = tiny
    assert [path.name for path in pages] == [f"{name}.md" for name in PAGES]
    for path in pages:
        text = path.read_text("utf-8")
        assert not re.search(r"\{\w*\}", text)  # nothing left to fill in
        heads = ["## Verdict", "## Values", "## Slope with speed", "## What was identified"]
        heads += ["## Statements by class", "## What was run"]
        assert [text.index(head) for head in heads] == sorted(text.index(head) for head in heads)
        points = ["**In short:**", "**Fitted:**", "**Predicted:**", "**Nobody could know:**"]
        assert [text.index(head) for head in points] == sorted(text.index(head) for head in points)
        assert text.index("\nFitted:\n") < text.index("Checked, nothing was fitted to them:")
        assert "nan" not in text
        for picture in re.findall(r"\]\(\.\./images/papers/([\w-]+\.png)\)", text):
            assert (root / "docs" / "images" / "papers" / picture).stat().st_size < 200_000
    for name in PAGES:
        statements = (root / "docs" / "results" / "papers" / f"{name}-statements.md").read_text("utf-8")
        assert "| 1. " in statements and not re.search(r"\{\w*\}", statements)
    # radiation model compact shows no circle of the 7009C, and says so
    field = (root / "docs" / "papers" / "sound-field.md").read_text("utf-8")
    assert sound_field.NO_CIRCLE in field and "sound-field.png" not in field


@pytest.mark.heavy
def test_a_page_lists_only_fitted_values_as_fitted(tiny):
    root, _ = tiny
    for name in PAGES:
        text = (root / "docs" / "papers" / f"{name}.md").read_text("utf-8")
        table = text[text.index("\nFitted:\n") : text.index("Checked, nothing")]
        shown = [row.split(" | ")[0].strip("| ") for row in table.splitlines() if row.startswith("| ")][2:]
        assert set(shown) <= FITTED[name]


@pytest.mark.heavy
def test_tiny_results_stand_in_csv(tiny):
    root, _ = tiny
    folder = root / "docs" / "results" / "papers"
    with (folder / "multi-source-levels.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {row["seed"] for row in rows} == {"1", "2"}
    total = next(row for row in rows if row["component"] == "total")
    assert float(total["P1"]) > float(total["P2"]) > 40.0  # a spindle, 105 and 150 mm from it
    with (folder / "impact-noise-planes.csv").open() as file:
        angles = [float(row["angle_deg"]) for row in csv.DictReader(file)]
    assert angles == [5.0 * k for k in range(72)]
    with (folder / "multi-source-printed.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {row["reading"] for row in rows} == {"energies", "printed"}
    assert all(row["P1"] == row["P3"] for row in rows)  # the equations have no angles


@pytest.mark.heavy
def test_a_repeated_run_takes_what_is_kept(tiny, monkeypatch):
    root, pages = tiny
    before = [path.read_text("utf-8") for path in pages]

    def refuse(*_, **__):
        raise AssertionError("a kept case was run again")

    monkeypatch.setattr(case_module, "record", refuse)
    again = run(list(PAGES), "compact", quick=True, jobs=1, cache=root / "cache", root=root)
    assert [path.read_text("utf-8") for path in again] == before


@pytest.mark.parametrize("radiation_model", ["compact", "paper"])
def test_sources_add_up_to_the_recordings_own_level(radiation_model, tmp_path):
    one = Case("7003C-spindle", 28000, (), 1, 0.01, 0.052)
    recording = one.recording(radiation_model)
    sources = Ear(recording, radiation_model, tmp_path).sources(recording.positions)
    assert set(sources) == {"inner_ring", "outer_ring", "cage", "balls", "total"}
    # the paper's energy sum, or the coherent one: two ways through the same paths
    assert equivalent(sources["total"]) == pytest.approx(
        recording.levels(radiation_model=radiation_model), abs=0.01
    )


def test_printed_energies_of_unbalance_are_those_of_a_whirl(tmp_path):
    # rings on a soft pedestal whirl with unbalance: both components equal, so each direction hears the same
    silent = tuple((key, 0.0) for key in BOTH)
    whirl = (*printed.CHANGES, *silent, ("imperfections.ball_diameter_spread_nm", 0.0))
    recording = Case(printed.SCENE, 28000, whirl, 1, 0.05, 0.06).recording("paper_vector")
    ear = Ear(recording, "paper_vector", tmp_path)
    f_r = 28000 / 60
    both = line(sources_at(ear, 0.105)["total"][:, 0], recording.rate, f_r)
    once = line(ear.parts([(0.0, 0.105, 0.0)], lambda path: path.component)[1], recording.rate, f_r)
    outer = line(sources_at(ear, 0.105)["outer_ring"][:, 0], recording.rate, f_r)
    assert outer - once == pytest.approx(3.01, abs=0.2)  # one of two equal components; friction turns some
    assert both > outer


@pytest.mark.heavy
def test_short_pages_say_what_is_known(tmp_path, monkeypatch):
    speeds = (10000, 15000, 20000, 26000, 28000, 30000)
    for module in (lines, multi_source, printed):
        monkeypatch.setattr(module, "SPEEDS", speeds)
    monkeypatch.setattr("examples.papers.runs.SEEDS", (1, 2))
    monkeypatch.setattr("examples.papers.runs.AROUND", (1.0,))
    monkeypatch.setattr("examples.papers.runs.FEW_AROUND", (1.0,))
    monkeypatch.setattr(multi_source, "CORNERS", multi_source.CORNERS[:1])
    # one speed, one correction left out, one turn: test_printed_motion.py runs more and reads the figures
    brief = ((printed_motion.ALONE,), ("traction_law",), 1.0)
    monkeypatch.setattr(printed_motion.results, "__defaults__", brief)
    monkeypatch.setenv("PYTHONWARNINGS", "ignore")
    (path,) = run(["multi-source"], "compact", quick=False, jobs=2, cache=tmp_path / "cache", root=tmp_path)
    text = path.read_text("utf-8")
    assert (path.parent / "printed-motion.md").exists()
    rows = [row.strip("| ").split(" | ") for row in text.splitlines() if row.startswith("| P")]
    # what two numbers can reach, they reach: the search ends within 0.1 dB of its values
    fitted = {row[0]: float(row[5]) for row in rows if row[0] in FITTED["multi-source"] and len(row) == 6}
    assert set(fitted) == FITTED["multi-source"] and max(map(abs, fitted.values())) <= 0.11
    # a residual of a printed reading is the distance to the interval that the paper's rounding leaves
    (row,) = (row for row in rows if row[0] == "P3, 30,000 r/min" and len(row) == 8)
    low, high = (float(word) for word in row[1].split(" to "))
    for level, residual in ((float(row[2]), float(row[4])), (float(row[5]), float(row[7]))):
        assert residual == pytest.approx(max(level - high, 0.0) - max(low - level, 0.0), abs=0.11)


@pytest.mark.pages
def test_committed_pages_show_every_value_and_their_verdict_its_rms():
    for name in PAGES:
        text = (ROOT / "docs" / "papers" / f"{name}.md").read_text("utf-8")
        part = text[text.index("\n## Values") : text.index("\n## Slope with speed")]
        rows = [row.strip("| ").split(" | ") for row in part.splitlines() if row.startswith("| ")]
        rows = [row for row in rows if len(row) == 6]
        residuals = []
        for value in values.read(name):
            # a mark follows a value's name in brackets
            (row,) = (row for row in rows if f"{row[0]} (".startswith(f"{value.name} ("))
            ours, residual = float(row[3]), float(row[5])
            assert residual == pytest.approx(value.paper.distance(ours), abs=0.11)  # both rounded
            if value.role == "check" and not value.without:
                residuals.append(residual)
            elif value.role == "fit":
                assert abs(value.paper.middle - ours) <= 0.16  # a search ends within 0.1 dB
        rms = float(re.search(r"values are ([\d.]+)\s+dB\s+rms", text).group(1))
        assert rms == pytest.approx(math.sqrt(sum(r * r for r in residuals) / len(residuals)), abs=0.06)
