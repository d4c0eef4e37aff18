"""Recordings of a bearing with a spall: its lines by the cage of the run, named in spectra and reports."""

import json

import matplotlib as mpl
import numpy as np
import pytest

from fmu_bearing import read_scene, record
from fmu_bearing.acoustics.analysis.lines import explain
from fmu_bearing.recording.measurements.measure import known_lines
from fmu_bearing.recording.record import OUTPUTS
from fmu_bearing.reports import make
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import GATES
from tests.engine.defects import groove

SPALL = {"on": "outer", "shape": "spall", "length_mm": 0.2, "width_mm": 2.0, "depth_um": 20.0}


@pytest.fixture(scope="module")
def recording():
    def table(shape, radius_x, radius_y, modulus):
        made = groove(shape.length, radius_x, shape.depth)
        return made._replace(touch=0.1 * made.touch, touch_x=0.1 * made.touch_x)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("fmu_bearing.prepare.defect_blocks.defect_table", table)
        scene = read_scene(GATES / "7003C-bare.toml").replace(
            {"sound.radiation_model": "compact", "imperfections.defect": [SPALL]}
        )
        yield record(
            with_fidelity(scene, model="rings"), 0.1, settle=0.02, progress=False, warn=False,
            outputs=(*OUTPUTS, "defect[1].passages"),
        )  # fmt: skip


def test_lines_are_at_multiples_of_the_run_s_passing_frequency(recording):
    (line,) = recording.defect_lines()
    (turns,) = recording.bearing_kinematics()
    assert recording.turning_known
    assert line.frequency == turns.f_o == pytest.approx(12.0 * turns.f_c)
    known = known_lines(recording, 5000.0)
    assert {one.name for one in known} >= {"f_o (defect 1)", "2 f_o (defect 1)", "f_o + f_r (defect 1)"}
    for n in (1, 2):
        best, _ = explain(n * line.frequency, known, 0.5)
        assert best.name == ("f_o (defect 1)" if n == 1 else "2 f_o (defect 1)")


def test_its_passages_are_kept_and_named(recording):
    passed = recording.outputs["defect[1].passages"]
    (line,) = recording.defect_lines()
    seconds = recording.output_time[-1] - recording.output_time[0]
    assert passed[-1] - passed[0] == pytest.approx(line.frequency * seconds, abs=1.5)
    assert json.loads(recording.to_xarray().attrs["defects"])[0]["line"] == "f_o"


@pytest.mark.heavy
def test_pictures_and_reports_name_the_line(recording, tmp_path):
    mpl.use("Agg")
    (ax,) = recording.plot("P1").axes
    assert "defect 1, f_o" in [text.get_text() for text in ax.get_legend().get_texts()]
    report = make(recording, tmp_path / "report.html", changes=False)
    page = (tmp_path / "report.html").read_text("utf-8")
    assert report is not None
    assert "balls past defect 1, with side bands by f_r: spall of 0.2 x 2 mm, 20 um deep" in page
    assert np.isfinite(recording.levels()).all()
