"""The verdicts on the first screen: of the run where it kept its extremes, else of the operating point."""

from dataclasses import replace

import pytest

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.verdict import overall
from fmu_bearing.design.verdicts import verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.sections.summary import tiles
from fmu_bearing.reports.sections.verdict_table import judged, overall_of


@pytest.fixture(scope="module")
def subject(full):
    return Subject(full, full.radiation_model, "test")


def point_of(subject):
    """The operating point at the run's speed."""
    return operating_point(subject.recording.scene.replace({"operation.speed_rpm": subject.speed / RPM}))


def test_rows_are_those_of_the_run_that_the_table_heads(subject):
    """Pressure, film and shoulder are those of the run's extremes, as the figures above the table."""
    rpm, point = subject.speed / RPM, point_of(subject)
    (bearing,) = point.bearings
    for ring in ("inner", "outer"):
        bearing.contacts[ring]["pressure_max"] = subject.output(f"contact.{ring}.pressure_max").max()
        bearing.contacts[ring]["shoulder_margin"] = subject.output(f"contact.{ring}.shoulder_margin").min()
    point = replace(point, bearings=(replace(bearing, film=subject.output("film.lambda_min").min()),))
    table = judged(subject).table
    assert table.rows == [[v.label, v.text, v.judgement, v.limit, v.source] for v in verdicts(point)]
    assert f"{rpm:,.0f} r/min" in table.caption
    # the caption names all rows that differ from those of the perfect bearing
    steady = {one.key: one.text for one in verdicts(point_of(subject))}
    moved = {one.key for one in verdicts(point) if one.text != steady[one.key]}
    assert moved <= {"pressure", "static_safety_pressure", "film", "shoulder"}
    assert "static safety by ball loads" in table.caption
    for one in verdicts(point):
        assert one.advice[1:] in table.note


def test_the_table_judges_the_pressure_of_the_card_above_it(rings):
    """2.0 GPa marks races: the perfect bearing has 1.89, this run more."""
    run = Subject(rings, rings.radiation_model, "test")
    (card,) = [one for one in tiles(run, None) if one["key"] == "pressure_GPa"]
    (row,) = [row for row in judged(run).table.rows if row[0].startswith("pressure")]
    assert row[1] == f"{card['value']:.2f}" and card["value"] > 2.0
    assert row[2] == "change"


def test_a_recording_without_these_outputs_is_judged_as_the_perfect_bearing(subject):
    recording = subject.recording
    kept, recording.outputs = recording.outputs, {}
    try:
        table = judged(subject).table
    finally:
        recording.outputs = kept
    assert table.rows == [
        [v.label, v.text, v.judgement, v.limit, v.source] for v in verdicts(point_of(subject))
    ]
    assert table.caption.endswith("r/min: perfect bearing in its steady state")


def test_the_overall_verdict_is_the_gravest(subject, full_report, full_page):
    found = judged(subject).found
    order = ("change", "watch", "good", "not judged")
    gravest = order[min(order.index(one.judgement) for one in found)]
    assert full_report.verdict == overall(found) == gravest != "good"
    shown = overall_of(found)
    beyond = [one for one in found if one.judgement in ("change", "watch")]
    assert len(shown.beyond) == len(beyond) and shown.beyond[0].endswith(f"({gravest})")
    begin = full_page.text.index('id="overall"')
    assert begin < full_page.text.index('class="tiles"')
    assert f"Overall verdict: {gravest}" in full_page.sections["summary"]
    for one in beyond:
        assert f"{one.label} {one.text}, limit {one.limit} ({one.judgement})" in shown.beyond
    assert overall([]) == "not judged"
    good = [one for one in found if one.judgement == "good"]
    assert overall(good) == "good" and overall_of(good).words.endswith("all are within it")


def test_a_recording_without_scene_has_none(subject):
    recording = subject.recording
    scene, recording.scene = recording.scene, None
    try:
        assert judged(Subject(recording, "compact")) is None
    finally:
        recording.scene = scene


def test_the_page_shows_them_before_the_sections(full_page):
    page = full_page.text
    begin, end = page.index('id="summary"'), page.index('id="conditions"')
    assert begin < page.index("Verdicts at") < end
    assert 'class="judged-watch"' in page[begin:end] or 'class="judged-good"' in page[begin:end]
