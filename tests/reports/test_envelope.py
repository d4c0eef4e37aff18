"""The section on envelopes: where it is asked for, or where a bearing has a defect; what it shows."""

import numpy as np
import pytest

from fmu_bearing import measure
from fmu_bearing.recording.record import record
from fmu_bearing.reports import make
from fmu_bearing.scene.read import with_fidelity
from tests.reports.reading import Page


@pytest.fixture(scope="module")
def recording(scene):
    bare = with_fidelity(scene("7003C-bare"), model="rings")
    return record(bare, 0.1, radiation_model="compact", warn=False)


@pytest.fixture(scope="module")
def page(recording, tmp_path_factory):
    return Page(
        make(recording, tmp_path_factory.mktemp("page") / "a.html", changes=False, envelope=True).path
    )


@pytest.mark.heavy
def test_the_chart_is_that_of_the_measurement(recording, page):
    found = {way: measure.envelope_of(recording, f"outer_ring.acceleration.{way}") for way in "yz"}
    first = max(found.values(), key=lambda one: one.far()[0].over_median)
    spectrum, lines = page.traces("envelope", signal="0")
    # five digits are kept
    wanted = 100.0 * first.amplitude / first.mean
    assert spectrum["y"] == pytest.approx(wanted[: len(spectrum["y"])], rel=2e-5)
    assert spectrum["dx"] == pytest.approx(first.frequency[1] - first.frequency[0])
    far = first.far()[: len(lines["text"])]
    assert list(lines["text"]) == [line.name for line in far]
    assert lines["x"] == pytest.approx([line.found for line in far], rel=2e-5)
    assert len(page.traces("envelope", signal="1")) == 2
    for one in found.values():
        assert one.heading in page.text
    assert np.isfinite(spectrum["y"]).all() and "Envelope" in page.text


@pytest.mark.heavy
def test_it_is_left_out_unless_asked_for(recording, tmp_path):
    made = make(recording, tmp_path / "b.html", changes=False)
    assert "envelope" not in made.sections
    pit = {"on": "outer", "shape": "pit", "length_mm": 0.3, "depth_um": 50.0}
    recording.scene = recording.scene.replace({"imperfections.defect": [pit]})
    assert "envelope" in make(recording, tmp_path / "c.html", changes=False).sections


@pytest.mark.heavy
def test_a_run_up_says_why_it_has_none(scene, tmp_path):
    bare = with_fidelity(scene("7003C-bare"), model="rings")
    ramp = record(bare, 0.05, speed=lambda t: 1000.0 + 2000.0 * t, radiation_model="compact", warn=False)
    made = make(ramp, tmp_path / "c.html", changes=False, envelope=True)
    assert "the speed changes" in made.sections["envelope"]
