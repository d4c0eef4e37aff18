"""The page about a set of bearings: sections, figures, what it refuses."""

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import operating_point, statics, with_fidelity
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.cli import app
from fmu_bearing.design.heat import heat_table
from fmu_bearing.design.torque_range import CAPTION
from fmu_bearing.design.verdict import overall
from fmu_bearing.design.verdicts import verdicts
from fmu_bearing.metrology.at_speed import AtSpeed
from fmu_bearing.metrology.axis_watch import AxisWatch
from fmu_bearing.metrology.nose import resampled
from fmu_bearing.progress import silent
from fmu_bearing.recording.record import record
from fmu_bearing.recording.recording import Recording
from fmu_bearing.recording.studies.spread import spread
from fmu_bearing.reports import make
from fmu_bearing.reports.page import look
from fmu_bearing.reports.set_page import _warmth
from fmu_bearing.reports.sound import set_sound
from fmu_bearing.run.simulate import simulate
from fmu_bearing.scene import Scene
from fmu_bearing.scene.words import materials_words
from tests.conftest import ROOT
from tests.reports.reading import Page
from tests.spindle.sets import scene, tables

PAIR = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"


def test_page_of_a_pair_has_all_sections_and_the_figures_of_statics(tmp_path):
    made = make(PAIR, tmp_path / "pair.html")
    assert list(made.sections) == [
        "verdicts",
        "conditions",
        "arrangement",
        "balls",
        "heat",
        "axial",
        "warmth",
        "levels",
        "error-motion",
        "assumptions",
    ]
    # it has no microphones, and so no run
    assert [key for key, why in made.sections.items() if why] == ["levels", "error-motion"]
    assert "no microphones" in made.sections["error-motion"] and "command" in made.sections["error-motion"]
    assert made.recording is None
    text = made.path.read_text(encoding="utf-8")
    assert "DB (O)" in text and "bearing 2" in text and made.size == len(text.encode())
    found = statics(PAIR)
    assert made.figures["nose_stiffness"] == pytest.approx(1e-6 * found.nose_stiffness)
    assert made.figures["lift_off_N"] == pytest.approx(min(abs(x.load) for x in found.lift_off.values()))
    point = operating_point(PAIR)
    assert made.figures["life_h"] == pytest.approx(point.life)
    assert made.figures["heat_W"] == pytest.approx(point.heat.total)
    _, *rows = Page(made.path).tables["Friction and heat of the settled bearings, without waviness"]
    assert rows == heat_table(point.bearings, point.torque_range)[1]
    _, *rows = Page(made.path).tables[f"F{CAPTION[1:]}"]
    assert rows == point.torque_range.table()[1]
    assert any(line.startswith("bearing 1: contact pressure") for line in made.warnings)


def test_the_first_screen_of_a_set_has_the_overall_verdict_and_a_card_for_each_bearing(tmp_path):
    """Cards hold the operating point's own figures; the overall verdict is the gravest of the library's."""
    made = make(PAIR, tmp_path / "pair.html")
    point = operating_point(PAIR)
    found = verdicts(point)
    gravest = next(one for one in ("change", "watch", "good") if any(v.judgement == one for v in found))
    assert made.verdict == overall(found) == gravest == "watch"
    page = Page(made.path)
    summary = page.sections["summary"]
    judged = [one for one in found if one.judgement != "not judged"]
    assert f"Overall verdict: {gravest}; of {len(judged)} figures with a limit" in summary
    assert (
        summary.index("Overall verdict") < summary.index("preload of bearing 1") < summary.index("Bearing 1 ")
    )
    for number, one in enumerate(point.bearings, start=1):
        own = {
            key.split(".")[1]: v for key, v in made.figures.items() if key.startswith(f"bearing[{number}]")
        }
        radial = 0.5 * (one.stiffness[1, 1] + one.stiffness[2, 2])
        assert own == pytest.approx({
            "axial_N": one.axial, "radial_N": one.radial,
            "preload_N": point.statics.preloads["running"][number - 1],
            "pressure_GPa": 1e-9 * max(one.contacts[ring]["pressure_max"] for ring in ("inner", "outer")),
            "heat_W": one.heat.total, "axial_stiffness": 1e-6 * one.stiffness[0, 0],
            "radial_stiffness": 1e-6 * radial, "life_h": one.life,
        }, rel=1e-9)  # fmt: skip
        assert f"Bearing {number} {overall(v for v in found if v.bearing == number)}" in summary
        for text in (f"{one.axial:.1f} N", f"{one.heat.total:.1f} W", f"{1e-6 * radial:.1f} N/um"):
            assert text in summary
    assert made.size < 2.2e6 and len(page.libraries) == 1


@pytest.mark.heavy  # statics and two runs
def test_the_sound_of_a_set_is_that_of_a_run(tmp_path, monkeypatch):
    """Levels of pressures, levels of parts at the end, and the loudest microphone on the first screen."""
    monkeypatch.setattr(set_sound, "DURATION", 0.06)
    monkeypatch.setattr(set_sound, "SETTLE", 0.02)
    places = [
        {"name": "P1", "x_mm": 60.0, "y_mm": 105.0, "z_mm": 0.0},
        {"name": "P2", "x_mm": -100.0, "y_mm": 0.0, "z_mm": 0.0},
    ]
    given = Scene.from_dict(tables(rpm=15e3) | {
        "sound": {"radiation_model": "compact", "microphone": places},
        "imperfections": {"grade": "P4", "seed": 1, "unbalance_um": 0.0},
    })  # fmt: skip
    made = make(given, tmp_path / "set.html")
    page = Page(made.path)
    assert [key for key, why in made.sections.items() if not why][-4:] == [
        "levels",
        "spectra",
        "audio",
        "assumptions",
    ]
    # 0.06 s are 15 revolutions
    assert "error motion needs 20" in made.sections["error-motion"]
    assert "the command error-motion does" in made.sections["error-motion"]
    kept = record(given, 0.06, settle=0.02, step=Recording.PRESSURE_STEP, progress=False, warn=False)
    head, *rows = page.tables["Equivalent levels re 20 uPa"]
    for weighting, column in (("Z", "Leq, dB"), ("A", "LAeq, dB(A)")):
        wanted = kept.levels(weighting=weighting)
        assert [float(row[head.index(column)]) for row in rows] == pytest.approx(wanted, abs=0.051)
    assert made.figures["laeq_dB"] == pytest.approx(max(kept.levels(weighting="A")), abs=0.06)
    # its range is beside it, of the same draws as the function's
    sure = spread(kept, [page_loudest(kept)])
    assert f"{sure.low[0]:.0f} to {sure.high[0]:.0f} over" in page.sections["summary"]
    alone = page.tables["Levels of each bearing alone"]
    assert alone[0] == ["microphone", "bearing 1, dB(A)", "bearing 2, dB(A)"]
    parts = kept.partial(by="bearing")
    for k, row in enumerate(alone[1:]):
        wanted = [level(kept.mean_square(part[k], "A")) for part in parts.values()]
        assert [float(cell) for cell in row[1:]] == pytest.approx(wanted, abs=0.051)
    lines = next(rows for title, rows in page.tables.items() if title.startswith("Strongest lines at"))
    assert lines[0][-1] == "loudest component" and all(row[-1] for row in lines[1:])
    # what was assumed is said, and of what the bearings are
    assert "values that the papers leave open" in page.sections["assumptions"]
    assert materials_words(given) in page.sections["conditions"]
    # units and names for people in the verdicts
    labels = [row[0] for row in page.tables["Verdicts on each bearing from its own loads"][1:]]
    assert "pressure, GPa" in labels and "n d_m, 1e6 mm r/min" in labels
    # outer rings in a housing at rest make no sound
    assert {row[head.index("outer ring, dB(A)")] for row in rows} == {"-"}
    assert len(page.sounds) == 2 and made.size < 2.5e6


def page_loudest(recording):
    """Name of the loudest microphone."""
    return recording.microphones[int(np.argmax(recording.levels(weighting="A")))][0]


@pytest.mark.heavy  # statics and two runs
def test_the_error_motion_of_a_set_is_that_of_its_nose(tmp_path, monkeypatch):
    """The section has the figures that the functions of `error_motion` find on a run of the same points."""
    monkeypatch.setattr(set_sound, "DURATION", 0.087625)
    monkeypatch.setattr(set_sound, "SETTLE", 0.0155)  # 21 whole revolutions to the 25th
    microphone = {"name": "P1", "x_mm": 60.0, "y_mm": 105.0, "z_mm": 0.0}
    given = with_fidelity(Scene.from_dict(tables(rpm=15e3) | {
        "sound": {"radiation_model": "compact", "microphone": [microphone]},
        "imperfections": {"grade": "P4", "seed": 1, "unbalance_um": 0.0},
    }), model="rings")  # fmt: skip
    made = make(given, tmp_path / "set.html")
    page = Page(made.path)
    assert made.sections["error-motion"] == "" and made.size < 2.6e6
    names = [f"shaft.nose.{name}" for name in ("displacement.x", "displacement.y", "displacement.z")]
    names += ["shaft.nose.tilt.y", "shaft.nose.tilt.z"]
    watch = AxisWatch()
    run = simulate(given, 0.103, step=Recording.PRESSURE_STEP, outputs=names, progress=False, watch=watch)
    kept = run.time >= 0.0155
    motion = np.column_stack([run[name] for name in names])
    one = AtSpeed(resampled(given, run.time[kept], motion[kept], watch.rates[kept]))
    caption = f"Error motion of the nose of the shaft against the ground over {one.revolutions} revolutions"
    head, *rows = page.tables[caption]
    assert head[:4] == ["direction", "unit", "asynchronous", "synchronous, averaged"]
    for row, values in zip(rows, one.values, strict=True):
        assert row[0] == values.direction
        # 4 digits are printed; splines of the page begin and end 1.7 ms before these, as pressures do
        wanted = (values.asynchronous, values.synchronous, values.synchronous_by_line)
        for cell, value in zip(row[2:5], wanted, strict=True):
            assert float(cell) == pytest.approx(1e6 * value, rel=1e-3, abs=1e-4)
    assert float(rows[2][2]) > 0.01  # um: surfaces of a grade move the nose
    lines = page.tables["Largest lines of the error motion, amplitudes"]
    assert lines[1][0] == one.lines[0].origin.name
    assert len(page.tables["Asynchronous error motion that the lines of each bearing make alone"]) == 3
    assert {t["meta"]["direction"] for t in page.traces("error-motion")} == {
        "fixed y", "fixed z", "rotating", "axial"
    }  # fmt: skip


def test_nine_bearings_have_nine_curves():
    """More bearings than colours: dashes."""
    lines = [look.series(k) for k in range(9)]
    assert len({(one["color"], one["dash"]) for one in lines}) == 9
    assert {one["dash"] for one in lines[:7]} == {"solid"} and lines[7]["dash"] == "dash"


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
