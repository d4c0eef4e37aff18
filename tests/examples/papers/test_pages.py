"""The papers' pages: a tiny run of each, what is kept, levels of their sources."""

import csv
import re

import pytest

from examples.papers import case as case_module, lines, multi_source, printed, sound_field
from examples.papers.case import Case
from examples.papers.hearing import Ear, equivalent, line
from examples.papers.identification import BOTH
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


def test_tiny_pages_are_whole(tiny):
    root, pages = tiny
    assert [path.name for path in pages] == [f"{name}.md" for name in PAGES]
    for path in pages:
        text = path.read_text("utf-8")
        assert not re.search(r"\{\w*\}", text)  # nothing left to fill in
        heads = ["## Values", "## Slope with speed", "## What was identified", "## Statements by class"]
        assert [text.index(head) for head in heads] == sorted(text.index(head) for head in heads)
        assert text.index("Fitted:") < text.index("Checked, nothing was fitted to them:")
        assert "nan" not in text
        for picture in re.findall(r"\]\(\.\./images/papers/([\w-]+\.png)\)", text):
            assert (root / "docs" / "images" / "papers" / picture).stat().st_size < 200_000
    # radiation model compact shows no circle of the 7009C, and says so
    field = (root / "docs" / "papers" / "sound-field.md").read_text("utf-8")
    assert sound_field.NO_CIRCLE in field and "sound-field.png" not in field


def test_a_page_lists_only_fitted_values_as_fitted(tiny):
    root, _ = tiny
    for name in PAGES:
        text = (root / "docs" / "papers" / f"{name}.md").read_text("utf-8")
        table = text[text.index("Fitted:") : text.index("Checked, nothing")]
        shown = [row.split(" | ")[0].strip("| ") for row in table.splitlines() if row.startswith("| ")][2:]
        assert set(shown) <= FITTED[name]


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
    assert angles == [15.0 * k for k in range(24)]
    with (folder / "multi-source-printed.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {row["reading"] for row in rows} == {"energies", "printed"}
    assert all(row["P1"] == row["P3"] for row in rows)  # the equations have no angles


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
    one = Case("7003C-spindle", 28000, multi_source.CHANGES, 1, 0.01, 0.052)
    recording = one.recording(radiation_model, tmp_path)
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
    recording = Case(printed.SCENE, 28000, whirl, 1, 0.05, 0.06).recording("paper_vector", tmp_path)
    ear = Ear(recording, "paper_vector", tmp_path)
    f_r = 28000 / 60
    both = line(printed.sources_at(ear, 0.105)["total"][:, 0], recording.rate, f_r)
    once = line(ear.parts([(0.0, 0.105, 0.0)], lambda path: path.component)[1], recording.rate, f_r)
    outer = line(printed.sources_at(ear, 0.105)["outer_ring"][:, 0], recording.rate, f_r)
    assert outer - once == pytest.approx(3.01, abs=0.2)  # one of two equal components; friction turns some
    assert both > outer


@pytest.mark.heavy
def test_short_pages_say_what_is_known(tmp_path, monkeypatch):
    monkeypatch.setattr(lines, "SPEEDS", (20000, 30000))
    monkeypatch.setattr(multi_source, "SPEEDS", (10000, 20000, 26000, 28000, 30000))
    monkeypatch.setattr(printed, "SPEEDS", (10000, 15000, 20000, 26000, 28000, 30000))
    monkeypatch.setattr("examples.papers.runs.SEEDS", (1, 2))
    monkeypatch.setenv("PYTHONWARNINGS", "ignore")
    (path,) = run(["multi-source"], "compact", quick=False, jobs=2, cache=tmp_path / "cache", root=tmp_path)
    text = path.read_text("utf-8")
    # what three numbers can reach, they reach: fitted values to the decibel
    rows = [row for row in text.splitlines() if row.startswith("| P")]
    fitted = [row.split(" | ") for row in rows if row.split(" | ")[0].strip("| ") in FITTED["multi-source"]]
    left = [float(cells[2].strip(" |")) for cells in fitted if len(cells) == 3]
    assert len(left) == 3 and max(abs(x) for x in left) <= 1.0
    # a residual of the printed reading is the distance to the interval that the paper's rounding leaves
    printed_part = text[text.index("Reading `energies`. Of") : text.index("Reading `printed`. Of")]
    row = next(row for row in printed_part.splitlines() if row.startswith("| P3, 30,000 r/min"))
    low, high = (float(word) for word in row.split(" | ")[2].split(" to "))
    ours, residual = float(row.split(" | ")[3]), float(row.split(" | ")[5])
    assert residual == pytest.approx(max(low - ours, 0.0) * -1.0 + max(ours - high, 0.0), abs=0.11)
