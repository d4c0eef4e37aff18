"""Drawings of sets: lines of contact, pressure centres, the picture of the arrangements."""

import importlib.util
import math

import pytest

from examples.spindle_set.arrangements import draw_set
from fmu_bearing.reports.sections.arrangement import pressure_centres
from fmu_bearing.results.picture_parts import single
from tests.conftest import ROOT
from tests.spindle.sets import scene

SCRIPT = ROOT / "examples" / "spindle_set" / "arrangements.py"


@pytest.mark.parametrize(("signs", "apart"), [("+-", 1.0), ("-+", -1.0)])
def test_back_to_back_lines_meet_the_axis_outside_the_pair(signs, apart):
    given = scene(signs, (40.0, 70.0))
    reach = 0.5 * given.bearing.pitch_diameter_mm * math.tan(math.radians(15.0))
    front, rear = pressure_centres(given)
    assert rear - front == pytest.approx(30.0 + apart * 2.0 * reach)
    assert (rear - front > 30.0) == (signs == "+-")


def test_a_line_of_contact_has_the_contact_angle_and_crosses_its_ball():
    given = scene("+-", (40.0, 70.0))
    _, axes = single((4.0, 3.0))
    draw_set(given, axes)
    lines = [line for line in axes.lines if len(line.get_xdata()) == 2 and line.get_ydata()[1] != 0.0]
    assert len(lines) == 4
    pitch = 0.5 * given.bearing.pitch_diameter_mm
    for line, x, sign in zip(lines, (40.0, 40.0, 70.0, 70.0), (1, 1, -1, -1), strict=True):
        (x0, x1), (y0, y1) = line.get_data()
        assert sign * (x1 - x0) / abs(y1 - y0) == pytest.approx(math.tan(math.radians(15.0)))
        assert x0 + (x1 - x0) * pitch / abs(y1) == pytest.approx(x)


def test_the_script_draws_all_arrangements(tmp_path, monkeypatch):
    spec = importlib.util.spec_from_file_location("arrangements", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    for title, given in script.scenes().items():
        assert title.startswith(given.spindle.arrangement)
    target = tmp_path / "sets.png"
    monkeypatch.setattr("sys.argv", ["arrangements.py", str(target)])
    script.main()
    assert target.stat().st_size > 10_000
