"""Lines of local defects: their frequencies and names in spectra, pictures, and Campbell diagrams."""

import json
import math

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr

from fmu_bearing import Run, read_scene
from fmu_bearing.acoustics.analysis.lines import explain, kinematic_lines
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.modal.campbell.excitation_lines import Rates, defect_order, lines, lines_of_defects
from fmu_bearing.modal.modes.energies import BACKWARD, FORWARD
from fmu_bearing.recording.measurements import pictures
from fmu_bearing.results.defect_lines import defect_labels, defect_lines, marked
from tests.conftest import GATES, ROOT

BARE = read_scene(GATES / "7003C-bare.toml")
DEFECTS = (
    {"on": "outer", "shape": "spall", "length_mm": 0.6, "depth_um": 100.0},
    {"on": "inner", "shape": "pit", "length_mm": 0.3, "depth_um": 50.0},
    {"on": "ball", "shape": "dent", "length_mm": 0.3, "depth_um": 5.0, "ball": 2},
)
SCENE = BARE.replace({"imperfections.defect": DEFECTS})
#: Of a bearing of 12 balls at 100 Hz whose cage turns at 0.41 of the shaft.
TURNS = KinematicFrequencies(100.0, 41.0, 270.0, 12 * 59.0, 12 * 41.0)


def test_each_defect_has_the_line_of_its_place():
    outer, inner, ball = defect_lines(SCENE, [TURNS])
    assert (outer.name, outer.frequency, outer.modulator) == ("f_o", 492.0, "f_r")
    assert (inner.name, inner.frequency, inner.side) == ("f_i", 708.0, 100.0)
    assert (ball.name, ball.frequency, ball.side) == ("2 f_b", 540.0, 41.0)
    assert [one.variable for one in (outer, ball)] == ["defect[1]", "defect[3]"]
    assert marked((outer, inner, ball)) == {"f_o": "defect 1", "f_i": "defect 2", "2 f_b": "defect 3"}
    assert defect_lines(BARE, [TURNS]) == ()


def test_in_a_set_a_line_says_whose_it_is():
    pair = read_scene(ROOT / "examples" / "spindle_set" / "7003C-DB.toml").replace(
        {"imperfections": {"grade": "P4", "seed": 1, "defect": [DEFECTS[0] | {"bearing": 2}]}}
    )
    slower = KinematicFrequencies(*(0.9 * one for one in TURNS))
    (line,) = defect_lines(pair, [TURNS, slower])
    assert (line.defect, line.variable) == ("defect 1 of bearing 2", "bearing[2].defect[1]")
    assert line.frequency == pytest.approx(0.9 * 492.0) and line.bearing == 1


def test_lines_of_a_spectrum_are_named_after_the_defect_and_explain_first():
    plain = {one.name: one for one in kinematic_lines(TURNS, 5000.0)}
    known = kinematic_lines(TURNS, 5000.0, defects=marked(defect_lines(SCENE, [TURNS])))
    named = {one.name: one for one in known}
    assert len(known) == len(plain)  # no line is new
    for name, source in (
        ("f_o", 1), ("3 f_o + 2 f_r", 1), ("2 f_i - f_r", 2), ("2 f_b", 3), ("4 f_b - f_c", 3)
    ):  # fmt: skip
        line = named[f"{name} (defect {source})"]
        assert line.frequency == plain[name].frequency and line.rank <= plain[name].rank
    # odd multiples of f_b, and side bands by what does not modulate a defect, are as they were
    for name in ("f_b", "3 f_b", "f_o + f_c", "2 f_b", "f_r"):
        assert (name in named) == (name != "2 f_b")
    # 2 f_i - f_r is 1316 Hz, and a sum of another kind that is as near is less simple
    best, _ = explain(1316.0, known, 2.0)
    assert best is not None and best.name == "2 f_i - f_r (defect 2)"


def test_a_picture_of_a_spectrum_marks_them():
    mpl.use("Agg")
    frequency = np.arange(0.0, 2000.0, 5.0)
    figure = pictures.spectrum_picture(
        frequency, {"total": np.full(frequency.size, 30.0)}, TURNS, defects=defect_lines(SCENE, [TURNS])
    )
    (ax,) = figure.axes
    marks = [line for line in ax.lines if line.get_gid() == "defect"]
    assert [float(line.get_xdata()[0]) for line in marks] == [492, 984, 1476, 708, 1416, 540, 1080, 1620]
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert words == ["total", "defect 1, f_o", "defect 2, f_i", "defect 3, 2 f_b"]


def test_a_campbell_diagram_has_lines_of_every_order_of_the_rings():
    at = Rates(*(np.array([one]) for one in TURNS))
    found = list(lines_of_defects(SCENE, at, {0, 1, 2}, 1000.0))
    by_source = {source: {one.name for one in found if one.source == source} for source in
                 ("defect 1", "defect 2", "defect 3")}  # fmt: skip
    assert by_source["defect 1"] == {"f_o", "2 f_o"}
    assert {"f_i", "f_i + f_r", "f_i - f_r", "f_i + 2 f_r", "f_i - 2 f_r"} == by_source["defect 2"]
    assert {"2 f_b", "2 f_b + f_c", "2 f_b - f_c"} <= by_source["defect 3"]
    line = next(one for one in found if one.name == "f_i - 2 f_r")
    assert (line.order, line.direction, float(line.frequency[0])) == (2, BACKWARD, 508.0)
    assert line.amplitude == defect_order(SCENE.bearing, SCENE.imperfections.defect[1], 10)
    both = [one for one in found if one.name == "f_o" and one.order == 1]
    assert {one.direction for one in both} == {FORWARD, BACKWARD}
    assert all(one.present for one in found)
    assert {one.source for one in lines(SCENE, at, {1}, 1000.0)} >= set(by_source)
    assert not [one for one in lines(BARE, at, {1}, 1000.0) if one.source.startswith("defect")]


def test_the_height_of_an_order_is_that_of_the_path_of_a_rigid_ball():
    bearing, spall = SCENE.bearing, SCENE.imperfections.defect[0]
    around = 0.5e-3 * (26.0 + 4.5 * math.cos(math.radians(15.0)))
    rolling = 1.0 / (2.0 / 4.5e-3 - 1.0 / around)
    angle = np.linspace(-math.pi, math.pi, 2**18, endpoint=False)
    path = np.maximum(0.5 * 0.6e-3 - np.abs(around * angle), 0.0) ** 2 / (2.0 * rolling)
    for order in (11, 23):
        exact = 2.0 * abs(np.mean(np.minimum(path, 1e-4) * np.exp(-1j * order * angle)))
        # low orders see the area alone: the spectrum of a triangle ends a little early
        assert defect_order(bearing, spall, order) == pytest.approx(exact, rel=0.02)
    # a shallow one is as deep as its depth
    shallow = spall.model_copy(update={"depth_um": 0.5})
    exact = 2.0 * np.mean(np.minimum(path, 5e-7))
    assert defect_order(bearing, shallow, 1) == pytest.approx(exact, rel=1e-3)


def test_a_file_has_the_table_of_defects_in_an_attribute(tmp_path):
    run = Run("a", np.array([(0.0, 1.0)], dtype=[("time", float), ("friction_torque", float)]), {}, SCENE)
    path = run.save(tmp_path / "a.nc")
    with xr.open_dataset(path, engine="h5netcdf") as data:
        table = json.loads(data.attrs["defects"])
    assert [one["defect"] for one in table] == ["defect[1]", "defect[2]", "defect[3]"]
    assert table[1] == DEFECTS[1] | {"defect": "defect[2]", "line": "f_i", "side_bands": "f_r"}
    assert Run.load(path).scene == SCENE
    assert defect_labels(BARE) == defect_labels(None) == {}
