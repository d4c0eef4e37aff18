"""Levels before metering begins: absent from pictures and summaries, finite numbers in results."""

import numpy as np
import pytest

from fmu_bearing import Bearing, simulate
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.results.levels import SILENCE, present
from fmu_bearing.results.result import Run
from fmu_bearing.results.time_pictures import time_picture
from fmu_bearing.scene.read import with_fidelity

LEVELS = ["mic[1].spl_a", "mic[1].leq"]
START = 0.02  # s, of the gate scenes


@pytest.fixture(scope="module")
def run(scene):
    return simulate(with_fidelity(scene("7003C-bare"), model="rings"), 0.04, outputs=[*LEVELS, "heat.oil"])


def test_silence_is_the_floor_of_the_meters(run):
    assert level(0.0) == pytest.approx(SILENCE, abs=1e-12)
    assert run["mic[1].leq"][0] == pytest.approx(SILENCE, abs=1e-12)


def test_pictures_begin_with_metering(run, tmp_path):
    """Of a run in memory and of its CSV file, which knows no units."""
    for one in (run, Run.load(run.save(tmp_path / "run.csv"))):
        for ax in time_picture(one).axes:
            low = ax.get_ylim()[0]
            for line in ax.lines:
                drawn = np.isfinite(line.get_ydata())
                # by the microphone's name where the scene is known
                if line.get_label() in (*LEVELS, "P1: spl_a", "P1: leq"):
                    assert np.array_equal(drawn, one.time > START - 1e-9)
                    assert low > 0.0  # the scene sounds at 40 dB and more
                else:
                    assert drawn.all()


def test_a_panel_without_any_level_says_so(scene):
    short = simulate(with_fidelity(scene("7003C-bare"), model="rings"), 3e-3, outputs=LEVELS)
    (ax,) = time_picture(short).axes
    assert [text.get_text() for text in ax.texts] == ["no level: metering has not begun"]
    assert np.isnan([line.get_ydata() for line in ax.lines]).all()
    last = short.summary()["last"]
    assert last["mic[1].leq"] == {"value": None, "unit": "dB"}
    assert "<td>mic[1].leq</td><td>-</td>" in short._repr_html_()


def test_results_stay_finite_and_summaries_keep_levels(run):
    assert all(np.isfinite(run[name]).all() for name in run.names)
    assert run.summary()["last"]["mic[1].leq"]["value"] == run["mic[1].leq"][-1]


def test_other_units_keep_small_numbers():
    assert np.array_equal(present([-200.0, 1.0], "N"), [-200.0, 1.0])
    assert np.isnan(present(SILENCE, "dB")) and present(-80.0, "dB") == -80.0


def test_a_bearing_shows_a_dash_before_metering(scene):
    bearing = Bearing(scene("7003C-bare"), fidelity="rings")
    bearing.init()
    table = bearing._repr_html_()
    assert "<td>mic[1].leq</td><td>-</td><td>dB</td>" in table and "-106" not in table
    assert bearing["mic[1].leq"] == pytest.approx(SILENCE)
