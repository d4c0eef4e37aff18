"""The page about a set of bearings: sections, figures, what it refuses."""

import pytest
from typer.testing import CliRunner

from fmu_bearing import operating_point, statics
from fmu_bearing.cli import app
from fmu_bearing.design.heat import heat_table
from fmu_bearing.progress import silent
from fmu_bearing.reports import make
from fmu_bearing.reports.set_page import _warmth
from tests.conftest import ROOT
from tests.reports.reading import Page
from tests.spindle.sets import scene

PAIR = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"


def test_page_of_a_pair_has_all_sections_and_the_figures_of_statics(tmp_path):
    made = make(PAIR, tmp_path / "pair.html")
    assert list(made.sections) == ["verdicts", "arrangement", "balls", "heat", "axial", "warmth"]
    assert not any(made.sections.values()) and made.recording is None
    text = made.path.read_text(encoding="utf-8")
    assert "DB (O)" in text and "bearing 2" in text and made.size == len(text.encode())
    found = statics(PAIR)
    assert made.figures["nose_stiffness"] == pytest.approx(1e-6 * found.nose_stiffness)
    assert made.figures["lift_off_N"] == pytest.approx(min(abs(x.load) for x in found.lift_off.values()))
    point = operating_point(PAIR)
    assert made.figures["life_h"] == pytest.approx(point.life)
    assert made.figures["heat_W"] == pytest.approx(point.heat.total)
    _, *rows = Page(made.path).tables["Friction and heat of the settled bearings, without waviness"]
    assert rows == heat_table(point.bearings)[1]
    assert any(line.startswith("bearing 1: contact pressure") for line in made.warnings)


def test_page_of_a_tandem_says_what_it_lacks(tmp_path):
    given = scene("++", (40.0, 70.0), None, 5e3, load={"force_x_N": 300.0})
    made = make(given, tmp_path / "tandem.html")
    assert made.sections["warmth"] == "a set that carries one way has no preload"
    assert made.sections["axial"] == "no axial load unloads a bearing of this set"


def test_speed_is_taken_and_runs_are_refused(tmp_path):
    made = make(PAIR, tmp_path / "fast.html", speed=1000.0)
    assert "9,549 r/min" in made.path.read_text(encoding="utf-8")
    with pytest.raises(ValueError, match="^run_up: 7003C-DB: cannot have a report of a run"):
        make(PAIR, tmp_path / "no.html", run_up=(500.0, 1000.0))
    kept = ["report", str(PAIR), "-o", str(tmp_path / "p.html"), "--keep", str(tmp_path / "r.npz")]
    shown = CliRunner().invoke(app, kept)
    assert (
        shown.exit_code != 0
        and "cannot have a report of a run: its report is made from statics"
        in shown.output.replace("\n", " ")
    )
    assert not (tmp_path / "p.html").exists()


@pytest.mark.parametrize(
    "option",
    [{"changes": True}, {"duration": 1.0}, {"settle": 0.2}, {"radius": 2.0}, {"run_up_time": 2.0}],
)
def test_options_of_a_run_are_refused(tmp_path, option):
    (name,) = option
    with pytest.raises(
        ValueError, match=f"^{name}: 7003C-DB: cannot have a report of a run: its report is made from statics"
    ):
        make(PAIR, tmp_path / "no.html", **option)
    assert not (tmp_path / "no.html").exists()


def test_inner_rings_of_their_own_temperature_become_warmer_too():
    given = scene(bearings=[{"inner_ring_temperature_degC": 45.0}, {}])
    found = statics(given)
    curves = {one.name: one.y for one in _warmth(given, found, silent).figure.data}
    warmer = given.replace(
        {"operation.inner_ring_temperature_degC": given.operation.inner_ring_temperature_degC + 20.0}
        | {"spindle.bearing[1].inner_ring_temperature_degC": 65.0}
        | {"spindle.shaft.temperature_degC": given.operation.inner_ring_temperature_degC}
    )
    wanted = statics(warmer).preloads["running"][0]
    assert curves["inner rings warmer"][-1] == pytest.approx(wanted, rel=1e-9)
    assert curves["inner rings warmer"][-1] > 1.2 * curves["inner rings warmer"][0]


def test_a_page_lacks_temperatures_that_no_scene_may_have(tmp_path):
    given = scene(changes={"operation.inner_ring_temperature_degC": 185.0})
    made = make(given, tmp_path / "hot.html")
    assert "allowed: -40 to 199" in made.sections["warmth"]
