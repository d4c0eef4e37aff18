"""The report of a set of bearings: a run of the whole, each bearing's part in it, what statics add."""

import json
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import operating_point, statics, with_fidelity
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.cli import app
from fmu_bearing.design.heat import heat_table
from fmu_bearing.design.torque_range import CAPTION
from fmu_bearing.design.verdict import overall
from fmu_bearing.design.verdicts import side_by_side, verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.metrology.at_speed import AtSpeed
from fmu_bearing.metrology.axis_watch import AxisWatch
from fmu_bearing.metrology.nose import resampled
from fmu_bearing.recording.measurements.measure import planes
from fmu_bearing.recording.record import record
from fmu_bearing.recording.studies.spread import spread
from fmu_bearing.reports import make
from fmu_bearing.reports.data.observed_run import STEP
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.modes import modes_section
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent
from fmu_bearing.reports.sections.arrangement import axial, warmth
from fmu_bearing.results.balls import RACES, name_of
from fmu_bearing.run.simulate import simulate
from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.words import materials_words
from tests.conftest import ROOT, SHARES
from tests.reports.reading import Page, not_run, numbers
from tests.spindle.sets import scene, tables

PAIR = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"
QBC = PAIR.with_name("7003C-QBC.toml")
SECTIONS = [
    "conditions", "arrangement", "axial", "warmth", "levels", "modes", "spectra", "audio", "waterfall",
    "directivity", "velocities", "orbits", "error-motion", "contacts", "friction", "assumptions",
]  # fmt: skip
SILENT = ["levels", "spectra", "audio", "waterfall"]


def brief_page(source, path, **options):
    """A report with three speeds of its modes and without changes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(modes_section, "_SHARES", SHARES)
        made = make(source, path, changes=False, **options)
    return made, Page(made.path)


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """Report and page of the example pair, which has no microphones, with a run of fidelity full."""
    return brief_page(PAIR, tmp_path_factory.mktemp("pair") / "pair.html", duration=0.1, settle=0.02)


@pytest.mark.heavy
def test_the_page_of_a_pair_has_all_sections_and_the_figures_of_statics(pair):
    made, page = pair
    assert list(made.sections) == SECTIONS
    assert [key for key, why in made.sections.items() if why] == SILENT
    assert all("no microphones" in made.sections[key] for key in SILENT)
    assert "2 x 7003C, DB (O) at 15,000 r/min, preload 150 N" in page.text and "Spindle report" in page.text
    point = operating_point(PAIR)
    found = point.statics
    assert made.figures["axial_stiffness"] == pytest.approx(1e-6 * found.axial_stiffness)
    assert made.figures["nose_stiffness"] == pytest.approx(1e-6 * found.nose_stiffness)
    assert made.figures["lift_off_N"] == pytest.approx(min(abs(x.load) for x in found.lift_off.values()))
    assert made.figures["life_h"] == pytest.approx(point.life)
    _, *rows = page.tables["Friction and heat of the settled bearings, without waviness"]
    assert rows == heat_table(point.bearings, point.torque_range)[1]
    _, *rows = page.tables[f"F{CAPTION[1:]}"]
    assert rows == point.torque_range.table()[1]
    assert len(page.tables["What each bearing carries, in the axes of the shaft"]) == 3
    assert {"arrangement", "axial", "warmth", "campbell"} <= set(page.figures)
    assert set(page.ids) and len(set(page.ids)) == len(page.ids) and made.size < 3e6


@pytest.mark.heavy
def test_the_first_screen_of_a_set_has_the_overall_verdict_and_a_card_for_each_bearing(pair):
    """Figures of a card are of the run, else of the operating point; verdicts take the run's extremes."""
    made, page = pair
    point, kept = operating_point(PAIR), Subject(made.recording, "compact").output
    summary, bearings = page.sections["summary"], []
    for number, one in enumerate(point.bearings, start=1):
        own = f"bearing[{number}]."
        extremes = {
            race: {
                "pressure_max": kept(f"{own}contact.{race}.pressure_max").max(),
                "shoulder_margin": kept(f"{own}contact.{race}.shoulder_margin").min(),
            }
            for race in RACES
        }
        contacts = {race: one.contacts[race] | extremes[race] for race in RACES}
        film = kept(f"{own}film.lambda_min").min()
        bearings.append(replace(one, contacts=contacts, film=film))
        torque = kept(f"{own}friction_torque").mean()
        radial = 0.5 * (one.stiffness[1, 1] + one.stiffness[2, 2])
        shown = {key.removeprefix(own): value for key, value in made.figures.items() if key.startswith(own)}
        assert shown == pytest.approx({
            "torque_N_mm": 1e3 * torque, "loss_W": torque * 15e3 * RPM,
            "pressure_GPa": 1e-9 * max(extremes[race]["pressure_max"] for race in RACES), "lambda": film,
            "axial_N": one.axial, "radial_N": one.radial,
            "preload_at_speed_N": point.statics.preloads["running"][number - 1],
            "axial_stiffness": 1e-6 * one.stiffness[0, 0], "radial_stiffness": 1e-6 * radial,
            "life_h": one.life,
        }, rel=1e-9)  # fmt: skip
        assert f"{one.axial:.1f} N" in summary and f"{1e-6 * radial:.1f} N/um" in summary
    found = verdicts(replace(point, bearings=tuple(bearings)))
    assert made.verdict == overall(found)
    judged = [one for one in found if one.judgement != "not judged"]
    assert f"Overall verdict: {made.verdict}; of {len(judged)} figures with a limit" in summary
    for number in (1, 2):
        assert f"Bearing {number} {overall(v for v in found if v.bearing == number)}" in summary
    assert summary.index("Overall verdict") < summary.index("shaft speed") < summary.index("Bearing 1 ")
    (table,) = [rows for caption, rows in page.tables.items() if caption.startswith("Verdicts at 15,000")]
    assert table[0] == ["", "bearing 1", "bearing 2", "all together", "limit", "source of the limit"]
    for row, same in zip(table[1:], side_by_side(found), strict=False):
        assert row[1:3] == ["" if one is None else f"{one.text} ({one.judgement})" for one in same]
    whole = [row[3] for row in table[1:] if row[3]]
    assert whole == [f"{one.text} ({one.judgement})" for one in found if one.bearing is None]


@pytest.mark.heavy
def test_quantities_of_bearing_and_shaft_are_those_of_the_run(pair):
    """One run by `simulate` at the same points, from which each section has what it shows."""
    made, page = pair
    names = ["shaft.nose.velocity.z", "bearing[2].inner_ring.velocity.z", "bearing[2].friction_torque"]
    names += ["friction_torque", "heat.oil", "bearing[2].contact.outer.load_max"]
    run = simulate(PAIR, 0.12, step=STEP, outputs=names, progress=False)
    kept = run.time >= 0.02 - 1e-9
    found = {name: run[name][kept] for name in names}
    bodies = [row[0] for row in page.tables["Velocity of the centres about its mean, mm/s"][1:]]
    rings = [f"{body} of bearing {k}" for k in (1, 2) for body in ("inner ring", "cage")]
    assert bodies == ["nose of the shaft", *rings]  # outer rings in a housing at rest do not move
    for key, body in (("shaft.nose", "shaft.nose"), ("bearing[2].inner_ring", "bearing[2].inner_ring")):
        traces = [t for t in page.traces("velocity-time", body=key) if t["name"].startswith("z")]
        shown = np.concatenate([numbers(trace["y"]) for trace in traces])
        assert shown == pytest.approx(1e3 * found[f"{body}.velocity.z"][: len(shown)], rel=2e-5, abs=1e-7)
        assert page.traces("velocity-spectrum", body=key)
    assert {t["meta"]["orbit"] for t in page.traces("orbits")} == {
        "shaft.nose", "bearing[1].inner_ring", "bearing[1].cage",
    }  # fmt: skip
    assert {t["meta"]["orbit"] for t in page.traces("orbits-3")} == {
        "bearing[2].inner_ring", "bearing[2].cage",
    }  # fmt: skip
    rows = {row[0]: row for row in page.tables["Friction and heat, means over the recording"]}
    torque = 1e3 * found["friction_torque"].mean()
    assert float(rows["torque taken from the shaft"][1]) == pytest.approx(torque, abs=6e-4)
    torque = 1e3 * found["bearing[2].friction_torque"].mean()
    assert float(rows["of it by bearing 2"][1]) == pytest.approx(torque, abs=6e-4)
    assert float(rows["heat to oil and balls"][2]) == pytest.approx(found["heat.oil"].mean(), abs=6e-4)
    contacts = page.tables["Contacts over the recording, bearing 2"]
    (largest,) = [row for row in contacts if row[0] == "largest load of a ball"]
    assert float(largest[7]) == pytest.approx(found["bearing[2].contact.outer.load_max"].max(), rel=6e-4)


@pytest.mark.heavy
def test_balls_of_each_bearing_add_up_to_it(pair):
    made, page = pair
    outputs = made.recording.outputs
    for number in (1, 2):
        own, balls = f"bearing[{number}].", range(1, made.recording.scene.bearing.ball_count + 1)
        for race in RACES:
            load = np.array([outputs[own + name_of(j, "load", race)] for j in balls])
            assert load.mean(0) == pytest.approx(outputs[f"{own}contact.{race}.load_mean"], rel=1e-12)
            assert load.max(0) == pytest.approx(outputs[f"{own}contact.{race}.load_max"], rel=1e-12)
        (trace,) = [
            one
            for one in page.traces("contacts-balls", bearing=f"bearing {number}", what="load")
            if one["name"] == "outer race"
        ]
        kept = Subject(made.recording, "compact").mean
        wanted = [kept(own + name_of(j, "load", "outer")) for j in balls]
        assert numbers(trace["y"]) == pytest.approx(wanted, rel=2e-5)
        assert trace["visible"] == (number == 1)


@pytest.mark.heavy  # runs of four bearings
@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_a_set_of_four_has_its_run_in_every_fidelity(fidelity, tmp_path):
    made, page = brief_page(
        with_fidelity(QBC, model=fidelity), tmp_path / "qbc.html", duration=0.1, settle=0.02
    )
    assert list(made.sections) == SECTIONS
    assert [key for key, why in made.sections.items() if why] == SILENT
    bodies = [row[0] for row in page.tables["Velocity of the centres about its mean, mm/s"]]
    assert sum(body.startswith("cage of bearing") for body in bodies) == (4 if fidelity == "full" else 0)
    for k in range(1, 5):
        assert page.traces("contacts-around", bearing=f"bearing {k}", what="angle")
        assert f"Contacts over the recording, bearing {k}" in page.tables
    again = make(made.recording, tmp_path / "again.html", changes=False)
    assert again.figures == pytest.approx(made.figures)


@pytest.mark.heavy  # statics and two runs
def test_the_sound_of_a_set_is_that_of_a_run(tmp_path):
    """Levels of pressures, of bearings alone, over directions, and the loudest one on the first screen."""
    places = [
        {"name": "P1", "x_mm": 60.0, "y_mm": 105.0, "z_mm": 0.0},
        {"name": "P2", "x_mm": -100.0, "y_mm": 0.0, "z_mm": 0.0},
    ]
    given = Scene.from_dict(tables(rpm=15e3) | {
        "sound": {"radiation_model": "compact", "microphone": places},
        "imperfections": {"grade": "P4", "seed": 1, "unbalance_um": 0.0},
    })  # fmt: skip
    made, page = brief_page(given, tmp_path / "set.html", duration=0.06, settle=0.02, radius=0.5)
    # 0.06 s are 15 revolutions
    assert [key for key, why in made.sections.items() if why] == ["error-motion"]
    assert "error motion needs 20" in made.sections["error-motion"]
    kept = record(given, 0.06, settle=0.02, step=STEP, progress=False, warn=False)
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
    (table,) = [rows for caption, rows in page.tables.items() if caption.startswith("Verdicts at")]
    assert {"pressure, GPa", "n d_m, 1e6 mm r/min"} <= {row[0] for row in table}
    # directions are counted from the middle of the bearings, as those of the function
    for plane, found in planes(kept, 0.5, count=36, weighting="A", resolution=2.0 / 0.06).items():
        (trace,) = [t for t in page.traces("planes", band="A-weighted") if t["name"].startswith(plane)]
        quarters = numbers(trace["r"])[:: (len(trace["r"]) - 1) // 4]
        assert quarters == pytest.approx([*found.levels[::9], found.levels[0]], abs=0.02)
    # outer rings in a housing at rest make no sound
    assert {row[head.index("outer ring, dB(A)")] for row in rows} == {"-"}
    assert len(page.sounds) == 2 and made.size < 3e6


def page_loudest(recording):
    """Name of the loudest microphone."""
    return recording.microphones[int(np.argmax(recording.levels(weighting="A")))][0]


@pytest.mark.heavy  # statics and two runs
def test_the_error_motion_of_a_set_is_that_of_its_nose(tmp_path):
    """The section has the figures that the functions of `error_motion` find on a run of the same points."""
    given = with_fidelity(Scene.from_dict(tables(rpm=15e3) | {
        "imperfections": {"grade": "P4", "seed": 1, "unbalance_um": 0.0},
    }), model="rings")  # fmt: skip
    # 21 whole revolutions to the 25th
    made, page = brief_page(given, tmp_path / "set.html", duration=0.087625, settle=0.0155)
    assert made.sections["error-motion"] == ""
    names = [f"shaft.nose.{name}" for name in ("displacement.x", "displacement.y", "displacement.z")]
    names += ["shaft.nose.tilt.y", "shaft.nose.tilt.z"]
    watch = AxisWatch()
    run = simulate(given, 0.103, step=STEP, outputs=names, progress=False, watch=watch)
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


def test_page_of_a_tandem_says_what_it_lacks():
    given = not_run(scene("++", (40.0, 70.0), None, 5e3, load={"force_x_N": 300.0}))
    with pytest.raises(Absent, match="^a set that carries one way has no preload$"):
        warmth(given)
    with pytest.raises(Absent, match="^no axial load unloads a bearing of this set$"):
        axial(given)


@pytest.mark.heavy
@pytest.mark.usefixtures("brief")
def test_options_of_a_run_act_and_the_run_is_kept(tmp_path):
    """Speed, settings, run-up and the kept run, as of a single bearing; statics are at the speed, too."""
    page, kept = tmp_path / "p.html", tmp_path / "r.npz"
    words = ["report", PAIR, "-o", page, "--keep", kept, "--fidelity", "rings", "--speed", 9000, "--json"]
    words += ["--duration", 0.05, "--settle", 0.02, "--run-up", "8000:9000", "--run-up-time", 0.1]
    shown = CliRunner().invoke(app, [*map(str, words), "--no-changes"])
    assert shown.exit_code == 0, shown.output
    reported = json.loads(shown.stdout)
    assert reported["figures"]["speed_rpm"] == pytest.approx(9000.0)
    slower = operating_point(read_scene(PAIR).replace({"operation.speed_rpm": 9000.0}))
    assert reported["figures"]["life_h"] == pytest.approx(slower.life, rel=1e-6)
    again = make(kept, tmp_path / "again.html", changes=False)
    assert again.figures == pytest.approx(reported["figures"])


def test_inner_rings_of_their_own_temperature_become_warmer_too():
    given = scene(bearings=[{"inner_ring_temperature_degC": 45.0}, {}])
    curves = {one.name: one.y for one in warmth(not_run(given)).blocks[0].figure.data}
    warmer = given.replace(
        {"operation.inner_ring_temperature_degC": given.operation.inner_ring_temperature_degC + 20.0}
        | {"spindle.bearing[1].inner_ring_temperature_degC": 65.0}
        | {"spindle.shaft.temperature_degC": given.operation.inner_ring_temperature_degC}
    )
    wanted = statics(warmer).preloads["running"][0]
    assert curves["inner rings warmer"][-1] == pytest.approx(wanted, rel=1e-9)
    assert curves["inner rings warmer"][-1] > 1.2 * curves["inner rings warmer"][0]


def test_a_page_lacks_temperatures_that_no_scene_may_have():
    given = scene(changes={"operation.inner_ring_temperature_degC": 185.0})
    with pytest.raises(Absent, match="allowed: -40 to 199"):
        warmth(not_run(given))
