"""The verdicts on the first screen are those of the operating point."""

import pytest

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.verdicts import verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.reports import report
from fmu_bearing.reports.subject import Subject
from fmu_bearing.reports.verdicts import verdict_table


@pytest.fixture(scope="module")
def subject(full):
    return Subject(full, full.radiation_model, "test")


def test_rows_are_those_of_the_operating_point(subject):
    rpm = subject.speed / RPM
    point = operating_point(subject.recording.scene.replace({"operation.speed_rpm": rpm}))
    table = verdict_table(subject)
    assert table.rows == [[v.label, v.text, v.judgement, v.limit, v.source] for v in verdicts(point)]
    assert f"{rpm:,.0f} r/min" in table.caption
    for one in verdicts(point):
        assert one.advice[1:] in table.note


def test_a_recording_without_scene_has_none(subject):
    recording = subject.recording
    scene, recording.scene = recording.scene, None
    try:
        assert verdict_table(subject) is None
    finally:
        recording.scene = scene


def test_the_page_shows_them_before_the_sections(full, tmp_path):
    page = report(full, tmp_path / "r.html").read_text("utf-8")
    begin, end = page.index('id="summary"'), page.index('id="conditions"')
    assert begin < page.index("Verdicts at") < end
    assert 'class="judged-watch"' in page[begin:end] or 'class="judged-good"' in page[begin:end]
