"""Operating points of the bearings of a set: each as by itself under its load, and the life of all."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import operating_point, read_scene, statics, stiffness, verdicts
from fmu_bearing.cli import app
from fmu_bearing.formulas import iso76
from tests.conftest import ROOT
from tests.spindle.sets import scene

PAIR = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"


def test_a_pair_under_preload_alone_is_two_bearings_by_themselves():
    given = scene("+-", (40.0, 70.0), 500.0, 15e3)
    pair = operating_point(given)
    front, rear = pair.bearings
    running = float(f"{statics(given).preloads['running'][0]:.4g}")
    (single,) = operating_point(
        front.scene.replace({"mounting.preload_mode": "force", "mounting.preload_N": running})
    ).bearings
    for point in (front, rear):
        for race in ("inner", "outer"):
            for key in ("load_mean", "load_max", "angle_mean", "pressure_max"):
                # the preload of the single bearing has four digits
                assert point.contacts[race][key] == pytest.approx(single.contacts[race][key], rel=2e-4)
        assert point.stiffness == pytest.approx(single.stiffness, rel=2e-4, abs=100.0)
        assert point.reference_life == pytest.approx(single.reference_life, rel=1e-3)
        assert point.rating.life == pytest.approx(single.rating.life, rel=1e-3)
        assert point.frequencies.f_c == pytest.approx(single.frequencies.f_c, rel=1e-5)
    # two equal ones live 2^(-9/10) as long as one
    one = 1e6 * single.reference_life / (60.0 * 15e3)
    assert pair.life == pytest.approx(2.0**-0.9 * one, rel=1e-3)


def test_each_bearing_carries_its_own_load():
    pair, found = operating_point(PAIR), statics(PAIR)
    points = pair.bearings
    for point, one in zip(points, found.bearings, strict=True):
        carried = point.rating
        assert np.array_equal(point.ball_loads[0], one.ball_loads[0])
        wanted = iso76.static_load(read_scene(PAIR).bearing.contact_angle_deg, one.axial, one.radial)
        assert carried.static_load == pytest.approx(wanted, rel=1e-9)
    assert points[0].reference_life < points[1].reference_life
    # the preload judged is that of the loose bearing: at standstill and 20 degC
    carried = [p.scene.mounted.preload_N for p in points]
    assert carried == pytest.approx(found.preloads["cold"], rel=5e-4)  # four digits
    for number in (1, 2):
        keys = {one.key for one in verdicts(pair) if one.bearing == number}
        assert keys >= {"pressure", "least_preload", "speed", "life"}
    assert {one.key for one in verdicts(pair) if one.bearing is None} == {"set_life", "lift_off", "whirl"}


@pytest.mark.heavy
@pytest.mark.parametrize("rpm", [0.0, 15e3])
def test_waves_ask_for_nothing_here(rpm):
    """The lowest speed decides the orders of waves, which statics leaves out."""
    wavy = {"imperfections": {"grade": "P4", "seed": 1}, "operation.lowest_speed_rpm": 3000.0}
    given = read_scene(PAIR).replace(wavy | {"operation.speed_rpm": rpm})
    plain = read_scene(PAIR).replace({"operation.speed_rpm": rpm})
    for one, other in zip(operating_point(given).bearings, operating_point(plain).bearings, strict=True):
        assert one.friction_torque == other.friction_torque
        assert np.array_equal(one.ball_loads[0], other.ball_loads[0])
    speeds = [0.0, 10e3]
    found = stiffness(given, speeds, [1e3]).named("axial_stiffness")
    assert np.array_equal(found, stiffness(plain, speeds, [1e3]).named("axial_stiffness"))


def test_temperatures_are_those_of_each_bearing():
    given = read_scene(PAIR).replace({"spindle.bearing[2].inner_ring_temperature_degC": 60.0})
    cool, warm = (
        point.scene.operation.inner_ring_temperature_degC for point in operating_point(given).bearings
    )
    assert (cool, warm) == (42.0, 60.0)


@pytest.mark.heavy
def test_info_shows_all_bearings_side_by_side(tmp_path):
    given = read_scene(PAIR).replace({"operation.required_life_h": 1e7})
    file = tmp_path / "pair.toml"
    file.write_text(given.to_toml(), encoding="utf-8")
    shown = CliRunner().invoke(app, ["info", str(file)])
    assert shown.exit_code == 0 and "bearing 2" in shown.output
    assert "L10r of all bearings together" in shown.output
    found = json.loads(CliRunner().invoke(app, ["info", str(file), "--json"]).output)
    assert len(found["bearings"]) == 2 and found["life_h"] > 0.0
    lives = [one for one in found["verdicts"] if one["key"] == "life"]
    assert [(one["bearing"], one["judgement"]) for one in lives] == [(1, "change"), (2, "change")]


def test_a_single_bearing_is_a_set_of_one():
    """One door: the same figures by name, and verdicts on the whole where there is one."""
    single, pair = operating_point(ROOT / "examples" / "scenes" / "7003C-spindle.toml"), operating_point(PAIR)
    assert single.summary().keys() == pair.summary().keys()
    for part in ("statics", "bearings"):
        one, other = single.summary()[part], pair.summary()[part]
        assert (one[0].keys() == other[0].keys()) if part == "bearings" else one.keys() == other.keys()
    (one,) = single.bearings
    assert single.life == pytest.approx(one.life) and not one.on_shaft
    assert single.statics.bearings[0] is one.load and single.statics.arrangement == "single"
    assert {one.key for one in verdicts(single) if one.bearing is None} == {"whirl"}
