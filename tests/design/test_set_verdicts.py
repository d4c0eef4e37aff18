"""Verdicts on a set: each bearing by its own loads, bearings that carry nothing, life, lift-off."""

import numpy as np
import pytest

from fmu_bearing import operating_point, read_scene, verdicts
from fmu_bearing.design.rating import reference_life
from fmu_bearing.design.verdicts import cautions, side_by_side
from fmu_bearing.reports.sections.summary import tiles
from fmu_bearing.reports.sections.verdict_table import judged
from tests.conftest import EXAMPLES, GATES
from tests.oracles import B7003C
from tests.oracles.jones_harris import JonesHarris
from tests.reports.reading import not_run
from tests.spindle.sets import scene

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
QBC = DB.with_name("7003C-QBC.toml")


def by_key(point, bearing=None):
    """Verdicts on a bearing, from 1, or on the whole."""
    return {one.key: one for one in verdicts(point) if one.bearing == bearing}


def pushed(force, **keys):
    return scene(load={"force_x_N": force, "position_mm": 0.0}, **keys)


def test_a_pushed_set_of_one_is_the_single_bearing():
    set_of_one = operating_point(pushed(500.0, signs="+", positions=(40.0,), preload=None, rpm=12e3))
    single = read_scene(GATES / "7003C-bare.toml").replace(
        {
            "operation.speed_rpm": 12e3,
            "operation.oil_temperature_degC": 20.0,
            "operation.inner_ring_temperature_degC": 20.0,
            "operation.outer_ring_temperature_degC": 20.0,
            "mounting.preload_N": 500.0,
            "fidelity.race_control": "outer",
            "fidelity.terms.gravity": False,
            "fidelity.terms.rolling_hysteresis": True,  # as of a scene that does not say otherwise
        }
    )
    alone = operating_point(single)
    (one,), (other,) = set_of_one.bearings, alone.bearings
    for ring in ("inner", "outer"):
        # one solves for the force within 1e-8 of it, the other for the place
        assert one.contacts[ring] == pytest.approx(other.contacts[ring], rel=1e-6)
    assert one.rating.factors == pytest.approx(other.rating.factors, rel=1e-6)
    assert one.rating[:-1] == pytest.approx(other.rating[:-1], rel=1e-6)
    ours, theirs = by_key(set_of_one, 1), by_key(alone, 1)
    assert ours.keys() == theirs.keys()
    # its name of the load differs, and no preload loads it
    assert (ours["preload_class"].judgement, ours["preload_class"].source) == ("not judged", "no preload")
    for key in ours.keys() - {"least_preload", "preload_class"}:
        assert (ours[key].text, ours[key].judgement) == (theirs[key].text, theirs[key].judgement), key


def test_life_of_each_bearing_is_that_of_independent_ball_loads():
    rpm = 12e3
    points = operating_point(pushed(200.0, rpm=rpm)).bearings
    model = JonesHarris(B7003C, "outer", control="outer")
    for one in points:
        solved = model.solve((one.axial, 0.0, 0.0), rpm * np.pi / 30.0, moment=(0.0, 0.0))
        loads = [
            np.array([getattr(ball, f"{race}_load") for ball in solved.balls]) for race in ("inner", "outer")
        ]
        # loads agree within 5e-5, by the friction across that the start has; life goes with their third power
        assert one.reference_life == pytest.approx(reference_life(one.scene, *loads), rel=5e-4)


def test_a_set_lives_as_long_as_all_of_its_bearings_survive():
    found = operating_point(QBC)
    points, rpm = found.bearings, found.scene.operation.speed_rpm
    lives = np.array([one.reference_life * 1e6 / (60.0 * rpm) for one in points])
    # the chance of each at the life of the set: exp(-ln(1/0.9) (L / L_i)^e)
    survive = np.prod(0.9 ** ((found.life / lives) ** (10.0 / 9.0)))
    assert survive == pytest.approx(0.9, rel=1e-12)


def test_life_asked_for_is_judged_of_the_set_and_of_each_bearing():
    found = operating_point(DB)
    life = by_key(found)["set_life"]
    # 20,400 h
    assert (life.judgement, life.limit) == ("good", "20000 assumed") and life.value == found.life
    shortest = min(by_key(found, number)["life"].value for number in (1, 2))
    assert life.value < shortest
    # between both: each bearing lives long enough, the set does not
    asked = read_scene(DB).replace({"operation.required_life_h": 0.5 * (life.value + shortest)})
    found = operating_point(asked)
    assert all(by_key(found, number)["life"].judgement == "good" for number in (1, 2))
    life = by_key(found)["set_life"]
    assert life.judgement == "change" and "relieve the bearing with the shortest life" in life.advice


def test_a_life_of_a_set_that_says_no_more_is_capped():
    given = scene(preload=30.0, rpm=3e3)
    found = operating_point(given)
    life = by_key(found)["set_life"]
    assert life.value > 1e6 and (life.text, life.judgement) == ("> 1e6", "good")
    (shown,) = [one for one in tiles(not_run(given), None) if one["key"] == "life_h"]
    assert shown["text"] == "> 1e6" and shown["value"] == pytest.approx(life.value)


def test_lift_off_over_the_load_that_is_given():
    def judged(force):
        given = pushed(force, preload=500.0)
        return by_key(operating_point(given)).get("lift_off")

    # a pair of 7003C with 500 N lifts off at 4.387 times the preload (design study)
    one = judged(1000.0)
    assert one.value == pytest.approx(4.387 * 500.0 / 1000.0, rel=5e-4) and one.judgement == "good"
    one = judged(-2500.0)
    assert one.value == pytest.approx(4.387 * 500.0 / 2500.0, rel=5e-4) and one.judgement == "change"
    assert "unload bearing 1 at standstill: raise the preload" in one.advice
    assert judged(0.0) is None


def test_a_bearing_skids_by_the_load_that_it_carries():
    """The preload alone would be enough: the load takes it from the rear bearing."""
    given = pushed(700.0, preload=100.0, rpm=3e4)
    found = operating_point(given)
    points = found.bearings
    front, rear = (by_key(found, number)["least_preload"] for number in (1, 2))
    assert [front.value, rear.value] == pytest.approx([max(one.load.axial, 0.0) for one in points])
    # 106 N of preload, 12 N against skidding, 7 N are left
    assert points[1].scene.mounting.preload_N > 5.0 * points[1].least_preload > 7.0 * rear.value
    assert (front.judgement, rear.judgement) == ("good", "change")
    assert any(line.startswith("bearing 2: axial load") for line in cautions(found))


def test_a_bearing_without_load_has_figures_missing_and_all_are_told(tmp_path):
    given = pushed(2500.0, preload=500.0)
    found = operating_point(given)
    assert found.bearings[1].axial == pytest.approx(0.0, abs=1e-9)
    rows = list(side_by_side(verdicts(found)))
    missing = {row[0].key for row in rows if row[1] is None}
    assert missing == {"static_safety", "static_safety_pressure"}
    assert {row[0].key for row in rows} == by_key(found, 1).keys()
    table = judged(not_run(given)).table
    assert "2194 N" in table.note and [row[2] for row in table.rows].count("") > len(missing)


def test_what_holds_for_several_bearings_is_said_once():
    """A pair under 3 kN of preload: its cautions name both bearings, and the figures of each."""
    found = operating_point(pushed(0.0, preload=3000.0))
    lines = cautions(found)
    both = [line for line in lines if line.startswith("bearings 1 and 2: ")]
    kinds = {line.partition(": ")[2].split()[0] for line in both}
    assert {"contact", "static", "preload"} <= kinds
    assert not any(line.startswith(("bearing 1: ", "bearing 2: ")) for line in lines)
    (pressure,) = (line for line in both if "contact pressure" in line)
    first, second = (one for one in verdicts(found) if one.key == "pressure")
    assert first.text in pressure and f"(bearing 2: {second.text})" in pressure or first.text == second.text
