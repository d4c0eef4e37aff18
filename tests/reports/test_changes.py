"""The section "What to change": its numbers are those of `changes`, and it says why it is missing."""

import dataclasses
import math

import numpy as np
import pytest

from fmu_bearing import changes, read_scene
from fmu_bearing.accuracy import changes as room
from fmu_bearing.accuracy.alternatives import Alternative
from fmu_bearing.accuracy.changed import shown_hours, shown_level, shown_ratio
from fmu_bearing.progress import silent
from fmu_bearing.recording.studies.spread import at_speed
from fmu_bearing.reports.data.observed_run import observed
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Absent
from fmu_bearing.reports.sections import what_to_change
from fmu_bearing.reports.sections.what_to_change import section, shown
from tests.conftest import EXAMPLES
from tests.reports.reading import not_run, numbers


@pytest.fixture(scope="module")
def found(whole):
    return whole.found


def test_the_study_is_of_the_recordings_scene(full, whole):
    """The page's study is the public function's, at the speed that was run."""
    assert whole.scene == at_speed(full)
    assert whole.options["levels"] is True and whole.options["radiation_model"] == full.radiation_model
    assert what_to_change.changes is changes


def words(change):
    return change.choice.words.replace("->", "\u2192")


def test_bars_are_the_changes_ranked(found, full_page):
    ends = {
        "level": lambda each: each.level,
        "life": lambda each: math.log10(each.after.life / each.before.life),
        "torque": lambda each: each.after.torque - each.before.torque,
    }
    for figure, end in ends.items():
        acting = [each for each in found.ranked(figure) if each.acts(figure)]
        drawn, texts = {}, full_page.figures[f"changes-{figure}"]["layout"]["annotations"]
        for trace in full_page.traces(f"changes-{figure}"):
            drawn |= dict(zip(numbers(trace["y"]).astype(int).tolist(), numbers(trace["x"]), strict=True))
        assert sorted(drawn) == list(range(len(acting))) and len(acting) >= 5
        assert [drawn[k] for k in range(len(acting))] == pytest.approx(
            [end(each) for each in acting], rel=1e-9
        )
        for each, text in zip(acting, texts, strict=True):
            assert text["text"].startswith(words(each) + ": ")


def test_ranges_stand_beside_the_levels(found, full_page):
    acting = [each for each in found.ranked("level") if each.acts("level")]
    seen = 0
    for trace in full_page.traces("changes-level"):
        places = numbers(trace["y"]).astype(int)
        ends = numbers(trace["x"])
        lows = ends - numbers(trace["error_x"]["arrayminus"])
        highs = ends + numbers(trace["error_x"]["array"])
        for k, low, high in zip(places, lows, highs, strict=True):
            assert (low, high) == pytest.approx(acting[k].level_range, abs=1e-9)
            seen += 1
    assert seen == len(acting)


def test_the_table_has_every_change(found, full_page):
    head, *rows = full_page.tables["What each choice changes"]
    assert head == [
        "change", "level, dB(A)", "range over seeds, dB(A)", "life, h", "torque, N mm", "radial stiffness",
    ]  # fmt: skip
    for each, row in zip(found.ranked("level"), rows, strict=True):
        low, high = each.level_range
        idle = "no finding" if each.depends_on_seed else "none"
        assert row == [
            words(each), shown_level(each.level) if each.acts("level") else idle,
            f"{shown_level(low)} to {shown_level(high)}", shown_hours(each.after.life).removesuffix(" h"),
            f"{each.after.torque:.2f}", shown_ratio(each.ratio("stiffness")),
        ]  # fmt: skip


def test_sentences_name_the_cost(found, full_page):
    text = full_page.sections["changes"]
    count = f"{len(found.basis.seeds)} seeds"
    assert found.basis.microphone in text and count in text and found.unchanged() in text
    best = found.ranked("level")[0]
    low, high = sorted(map(abs, best.level_range))
    begin = f"{words(best)[0].upper()}{words(best)[1:]}: {abs(best.level):.1f} dB(A) quieter"
    assert f"{begin} ({low:.1f} to {high:.1f} over {count})" in text
    # less preload is longer life and less stiffness
    lightest = found.ranked("life")[0]
    (sentence,) = [s for s in full_page.paragraphs if s.startswith("Preload") and ": life" in s]
    gained, lost = sentence.split("; but ")
    assert "times as long" in gained and "torque" in gained and "radial stiffness" in lost
    # the bare bearing gets louder where less preload holds it: that is reported, too
    assert lightest.acts("level") and f"{abs(lightest.level):.1f} dB(A) louder" in lost
    assert lightest.ratio("stiffness") < 1.0 < lightest.ratio("life")


def test_cautions_and_refusals_are_reported(found):
    refused = room.Change(Alternative("balls", "balls -> gold", {}), found.before, reason="gold is soft")
    made = shown(dataclasses.replace(found, changes=(*found.changes, refused)))
    texts = [block.text for block in made.blocks if block.sort == "words"]
    assert any("Left out: balls \u2192 gold: gold is soft" in text for text in texts)


def test_what_makes_nothing_better_is_said(found):
    worse = [
        dataclasses.replace(each, levels=np.array([1.0, 2.0]))
        for each in found.changes
        if each.ratio("life") < 0.99
    ]
    made = shown(dataclasses.replace(found, changes=tuple(worse)))
    texts = [block.text for block in made.blocks if block.sort == "words"]
    assert "Rating life: no choice makes it better." in texts and "Level: no choice makes it better." in texts


@pytest.mark.heavy
def test_a_scene_that_bends_has_no_levels_unless_asked(scene, monkeypatch):
    recording = observed(scene("7009C-full-ceramic"), 0.02, settle=0.005)[0]
    monkeypatch.setattr(
        room, "alternatives", lambda scene: [Alternative("preload", "less", {"mounting.preload_N": 300.0})]
    )
    page = section(Subject(recording, "compact"), silent)
    charts = [block.key for block in page.blocks if block.sort == "chart"]
    assert charts == ["changes-torque"]  # rings of ceramics have no rating either
    (table,) = [block for block in page.blocks if block.sort == "table"]
    assert "--changes" in table.note and "rings of steel" in table.note


def test_a_set_has_no_levels_unless_asked(monkeypatch):
    monkeypatch.setattr(
        room,
        "alternatives",
        lambda scene: [Alternative("preload", "less", {"spindle.preload.preload_N": 80.0})],
    )
    page = section(not_run(read_scene(EXAMPLES.parent / "spindle_set" / "7003C-DB.toml")), silent)
    charts = [block.key for block in page.blocks if block.sort == "chart"]
    assert charts == ["changes-life", "changes-torque"]
    (table,) = [block for block in page.blocks if block.sort == "table"]
    assert "--changes" in table.note and "those of a set" in table.note


@pytest.mark.heavy
def test_a_recording_whose_speed_changes_has_none(rings):
    rising = rings.speed_points * np.linspace(1.0, 1.2, rings.speed_points.size)
    with pytest.raises(Absent, match="speed changes"):
        section(Subject(dataclasses.replace(rings, speed_points=rising), "compact"), silent)


def test_the_opening_says_whose_level_it_is(found):
    """A run of full prints another level of the same scene."""
    assert f"{found.basis.level:.1f} dB(A) by fidelity {found.basis.fidelity}" in found.unchanged()
