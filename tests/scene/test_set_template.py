"""New scenes of sets: places, directions, preload or load, shaft; what is marked as assumed; refusals."""

import pytest

from fmu_bearing.scene import SceneError, read_scene_text
from fmu_bearing.scene.entries import entries, entry_text, using
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.own_bearing import Dimensions
from fmu_bearing.scene.spindle import DIRECTIONS
from fmu_bearing.scene.template import new_scene

WIDTH, OUTSIDE = 16.0, 80.0  # mm: of the 7010C


def made(arrangement, bearing="NSK-7010C", **given):
    given = {"kind": "hybrid"} | given
    return new_scene("a", bearing, arrangement=arrangement, **given)


@pytest.mark.parametrize("arrangement", DIRECTIONS)
def test_every_arrangement_has_its_directions_side_by_side(arrangement):
    found = read_scene_text(made(arrangement, preload_class="medium", speed_rpm=18e3))
    spindle, places = found.spindle, [one.position_mm for one in found.spindle.bearing]
    assert spindle.arrangement.split()[0] == arrangement and spindle.directions == DIRECTIONS[arrangement]
    assert [b - a for a, b in zip(places, places[1:], strict=False)] == [WIDTH] * (len(places) - 1)
    # seats of the bore's diameter under all rings, a nose ahead of them
    (nose, _, _), (seats, diameter, bore), _ = spindle.shaft.sections_mm
    assert nose <= places[0] - WIDTH / 2 and places[-1] + WIDTH / 2 <= nose + seats
    assert (diameter, bore) == (50.0, 0.0) and spindle.shaft.flexible
    one_way = len(set(spindle.directions)) == 1
    assert (spindle.preload is None) == one_way
    assert spindle.load.force_x_N == (len(places) * 390.0 if one_way else 0.0)
    if not one_way and spindle.directions.count("+") == spindle.directions.count("-"):
        assert spindle.preload.preload_N == 390.0


def test_the_names_are_those_of_makers():
    assert [DIRECTIONS[name] for name in ("DB", "DF", "DT", "TBT", "QBC")] == [
        "+-",
        "-+",
        "++",
        "++-",
        "++--",
    ]


def test_distance_and_springs():
    found = read_scene_text(made("QBC", distance_mm=40.0, spring_N=200.0, speed_rpm=18e3)).spindle
    assert [one.position_mm for one in found.bearing] == [24.0, 64.0, 104.0, 144.0]
    assert [one.seat for one in found.bearing] == ["fixed", "fixed", "sliding", "sliding"]
    assert (found.preload.kind, found.preload.force_N, found.preload.preload_N) == ("spring", 200.0, None)
    assert found.shaft.length_mm == 24.0 - 8.0 + (3 * 40.0 + WIDTH) + 2 * WIDTH


@pytest.mark.parametrize(
    ("given", "force", "remark"),
    [
        ({"preload_class": "light"}, 300.0, "2 bearings, light class of NSK: 150 N"),
        ({"preload_N": 80.0}, 160.0, "2 bearings, 80 N each, as given"),
    ],
)
def test_bearings_that_carry_one_way_get_the_force_of_their_class(tmp_path, given, force, remark):
    path = tmp_path / "a.toml"
    path.write_text(made("DT", speed_rpm=18e3, **given), "utf-8")
    one = {one.key: one for one in origins(path)}["spindle.load.force_x_N"]
    assert (one.value, one.assumed, one.remark) == (force, True, remark)


def test_an_offset_loads_bearings_of_one_way_as_a_pair():
    tandem = read_scene_text(made("DT", preload_offset_um=5.0)).spindle.load.force_x_N
    assert tandem == 2 * read_scene_text(made("DB", preload_offset_um=5.0)).spindle.preload.preload_N > 100.0


def test_shaft_and_housing_are_of_steel_and_assumed(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(made("DB", kind="full-ceramic", preload_N=100.0, speed_rpm=9e3), "utf-8")
    found = {one.key: one for one in origins(path)}
    for key, value in (
        ("spindle.shaft.flexible", True),
        ("spindle.shaft.material.density_kg_m3", 7800.0),
        ("spindle.housing.material.density_kg_m3", 7800.0),
        ("spindle.shaft.sections_mm", [[16.0, 60.0, 0.0], [32.0, 50.0, 0.0], [32.0, 45.0, 0.0]]),
    ):
        assert found[key].value == value, key
    assert found["spindle.shaft.sections_mm"].assumed and found["spindle.shaft.flexible"].assumed
    for key in ("spindle.preload.preload_N", "operation.speed_rpm", "spindle.bearing[2].position_mm"):
        assert found[key].origin == "file" and not found[key].assumed, key


def test_microphones_are_around_the_set():
    found = read_scene_text(made("QBC", distance_mm=100.0, preload_N=100.0))
    x = {place.name: 1e3 * place.position_m[0] for place in found.microphones}
    first, last = 24.0, 324.0
    assert x == pytest.approx(
        {"right": 174.0, "top": 174.0, "front": first - 3 * OUTSIDE, "back": last + 3 * OUTSIDE}
    )


def test_own_dimensions_and_own_catalogues_make_sets(tmp_path):
    own = read_scene_text(made("TBT", Dimensions(40.0, 68.0, 15.0), preload_class="light"))
    assert own.spindle.bearing[1].position_mm - own.spindle.bearing[0].position_mm == 15.0
    assert own.spindle.shaft.sections_mm[1][1] == 40.0
    entry = entry_text(entries("bearings")["NSK-7010C"], "NSK-7010C").replace("NSK-7010C", "OWN")
    (tmp_path / "own.toml").write_text(entry.replace("width_mm = 16.0", "width_mm = 20.0"), "utf-8")
    with using([tmp_path / "own.toml"]):
        text = made("DT", "OWN", preload_N=50.0, folder=tmp_path)
    assert 'catalogues = ["own.toml"]' in text
    found = read_scene_text(text, folder=tmp_path).spindle
    assert [one.position_mm for one in found.bearing] == [30.0, 50.0] and found.load.force_x_N == 100.0


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        ({"arrangement": "OB"}, "there is no arrangement 'OB': choose from DB, DF, DT, TBT, TFT, QBC, QFC"),
        ({"arrangement": "DB", "distance_mm": 15.9}, "15.9 mm is refused; allowed: 16 .* to 1000 mm"),
        ({"arrangement": "DB", "distance_mm": float("nan")}, "nan mm is refused; allowed: 16 "),
        ({"arrangement": "DB", "spring_N": -1.0}, "spindle.preload.force_N = -1.0 is refused; allowed: 0 to"),
        ({"arrangement": "DT", "spring_N": 90.0}, "a spring of 90 N is refused for DT: all carry one way"),
        (
            {"arrangement": "DT", "preload_class": "no"},
            "preload_class = 'no' is refused; allowed: extra light",
        ),
        (
            {"arrangement": "DB", "preload_N": -5.0},
            "spindle.preload.preload_N = -5.0 is refused; allowed: 0 to",
        ),
        ({"distance_mm": 50.0}, "are of a set: give its arrangement, as 'DB'"),
        ({"spring_N": 50.0}, "are of a set: give its arrangement, as 'DB'"),
        ({"arrangement": "DB", "spring_N": 5.0, "preload_class": "light"}, "give one of preload_class, pre"),
        ({"bearing": "7010C", "arrangement": "DB", "distance_mm": 2.0}, "did you mean 'NSK-7010C'?"),
    ],
)
def test_refusals_name_value_range_and_way_out(arguments, reason):
    with pytest.raises(SceneError, match=reason) as caught:
        new_scene("a", **{"bearing": "NSK-7010C", "preload_N": 100.0, **arguments})
    assert len(caught.value.problems) == 1
