"""Local defects in a scene: what is read, what is refused with the way out, whose they are in a set."""

import math

import pytest

from fmu_bearing.scene import SceneError, read_scene, read_scene_text
from fmu_bearing.scene.defect_conflicts import race_radius
from fmu_bearing.scene.template import new_scene
from tests.conftest import GATES, ROOT
from tests.messages import says

BARE = read_scene(GATES / "7003C-bare.toml")  # 12 balls of 4.5 mm, pitch 26 mm
PAIR = read_scene(ROOT / "examples" / "spindle_set" / "7003C-DB.toml")
SPALL = {"on": "outer", "shape": "spall", "length_mm": 1.2, "depth_um": 100.0}
DENT = {"on": "inner", "shape": "dent", "length_mm": 0.5, "depth_um": 5.0}
BALL = {"on": "ball", "shape": "pit", "length_mm": 0.5, "depth_um": 50.0, "ball": 3}
SCRATCH = {"on": "outer", "shape": "scratch", "width_mm": 0.1, "depth_um": 5.0}
P4 = {"imperfections": {"grade": "P4", "seed": 1}}


def with_defects(*defects, scene=BARE):
    return scene.replace({"imperfections.defect": list(defects)})


def refused(*defects, scene=BARE):
    with pytest.raises(SceneError) as caught:
        with_defects(*defects, scene=scene)
    return [line.removeprefix(f"{scene.name}: ") for line in caught.value.problems]


def test_a_file_may_have_defects():
    lines = "\n[[imperfections.defect]]\n" + "\n".join(
        f"{key} = {value!r}".replace("'", '"') for key, value in SPALL.items()
    )
    scene = read_scene_text(BARE.to_toml().replace("defect = []\n", "") + lines)
    assert scene.imperfections.defect == with_defects(SPALL).imperfections.defect
    assert read_scene_text(scene.to_toml()) == scene
    assert BARE.imperfections.defect == ()


def test_what_is_absent_is_as_documented():
    spall, dent, scratch = with_defects(SPALL, DENT, SCRATCH | {"angle_deg": 90.0}).imperfections.defect
    assert (spall.along_mm, spall.across_mm, spall.edge, spall.turn) == (1.2, 1.2, 1e-5, 0.0)
    assert spall.angle == pytest.approx(math.pi) and dent.angle == 0.0
    assert (dent.edge, dent.along_mm, dent.across_mm) == (0.0, 0.5, 0.5)
    assert (scratch.along_mm, scratch.across_mm) == (0.1, None)
    assert with_defects(SCRATCH | {"width_mm": 0.02}).imperfections.defect[0].edge == pytest.approx(1e-5)


def test_a_rim_and_a_turn_lengthen_what_it_takes_along_rolling():
    dent, scratch = with_defects(
        DENT | {"rim_um": 1.0}, SCRATCH | {"length_mm": 2.0, "turn_deg": 30.0}
    ).imperfections.defect
    assert dent.span_mm == pytest.approx(0.75)
    assert scratch.span_mm == pytest.approx(0.1 * math.cos(math.pi / 6) + 1.0)


def test_words_name_it():
    defects = with_defects(SPALL | {"width_mm": 3.0}, BALL, SCRATCH | {"angle_deg": 0.0}).imperfections.defect
    assert [one.words for one in defects] == [
        "spall of 1.2 x 3 mm, 100 um deep, on the outer race at 180 deg",
        "pit of 0.5 mm, 50 um deep, on ball 3",
        "scratch of 0.1 mm, 5 um deep, on the outer race at 0 deg",
    ]


@pytest.mark.parametrize(
    ("defect", "words"),
    [
        (SPALL | {"length_mm": None}, "length_mm is missing, for example length_mm = 1.2"),
        (SCRATCH | {"width_mm": None}, "width_mm is missing, for example width_mm = 0.1"),
        (DENT | {"width_mm": 1.0}, 'width_mm = 1.0 has no meaning with shape = "dent": leave it out, or'),
        (SPALL | {"rim_um": 1.0}, 'rim_um = 1.0 ... shape = "spall" ... give shape = "dent"'),
        (DENT | {"edge_mm": 0.01}, 'edge_mm ... shape = "dent" ... "spall" or "pit" or "scratch"'),
        (SPALL | {"turn_deg": 10.0}, 'turn_deg = 10.0 ... give shape = "scratch"'),
        (SPALL | {"ball": 1}, 'ball = 1 has no meaning with on = "outer" ... give on = "ball"'),
        (SPALL | {"tilt_deg": 1.0}, 'tilt_deg ... give on = "ball"'),
        (BALL | {"angle_deg": 1.0}, 'angle_deg ... on = "ball" ... give on = "inner" or "outer"'),
        (BALL | {"offset_mm": 1.0}, 'offset_mm ... on = "ball"'),
        (BALL | {"ball": None}, "ball is missing, for example ball = 1"),
        (BALL | {"ball": 13}, "ball = 13 is refused; allowed: 1 to 12, the balls of the bearing"),
        (SPALL | {"edge_mm": 0.7}, "edge_mm = 0.7 must not exceed half of the shorter side, 0.6 mm"),
        (SPALL | {"bearing": 1}, "bearing is of sets of bearings: this scene has one; leave it out"),
        (SPALL | {"length_mm": 9.0, "width_mm": 1.0}, "length_mm takes 9 mm ... up to 7.945, the distance"),
        (SPALL | {"width_mm": 4.6}, "width_mm is 4.6 mm across the track; allowed: up to 4.5"),
        (SPALL | {"offset_mm": -2.3}, "offset_mm = -2.3 is refused; allowed: -2.25 to 2.25 mm"),
        (SPALL | {"length_mm": 0.04}, "length_mm = 0.04 is refused; allowed: 0.05 to 20 mm"),
        (SPALL | {"on": "cage"}, "on = 'cage' is refused; allowed: inner, outer, ball"),
        (SPALL | {"size": 1.0}, "size is not a key of a scene; ... known here: on, shape"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_with_the_way_out(defect, words):
    (line,) = refused(defect)
    assert says(line, f"imperfections.defect[1].{words}"), line


def test_at_most_eight():
    spalls = [SPALL | {"length_mm": 0.1, "angle_deg": 10.0 * k} for k in range(9)]
    assert len(with_defects(*spalls[:8]).imperfections.defect) == 8
    (line,) = refused(*spalls)
    assert says(line, "imperfections.defect has 9 members; allowed: at most 8 tables")


def test_two_on_a_race_are_apart_by_both_lengths():
    radius = race_radius(BARE.bearing, "outer")
    assert radius == pytest.approx(0.5 * (26.0 + 4.5 * math.cos(math.radians(15.0))))
    step = math.degrees(2.0 / radius)  # of 1.2 and 0.8 mm
    other = SPALL | {"length_mm": 0.8, "angle_deg": 180.0 - step * 1.001}
    with_defects(SPALL, other)
    (line,) = refused(SPALL, other | {"angle_deg": 180.0 - step * 0.99})
    assert says(line, "imperfections.defect[2].angle_deg puts it 1.98 mm from defect 1 on the outer race; "
                      "allowed: 2 mm or more ... move one of them, or give one defect")  # fmt: skip
    # across 12 o'clock, too
    assert refused(SPALL | {"angle_deg": 1.0}, SPALL | {"angle_deg": 359.0})
    # on another race, or another ball, it is nothing
    with_defects(SPALL, SPALL | {"on": "inner", "angle_deg": 180.0})
    with_defects(BALL, BALL | {"ball": 4})
    assert refused(BALL, BALL | {"tilt_deg": 5.0})


def test_in_a_set_each_names_its_bearing():
    pair = PAIR.replace(P4)
    (line,) = refused(SPALL, scene=pair)
    assert says(line, "imperfections.defect[1].bearing is missing, for example bearing = 1: ... 2 bearings")
    (line,) = refused(SPALL | {"bearing": 3}, scene=pair)
    assert says(line, "imperfections.defect[1].bearing = 3 is refused; allowed: 1 to 2")
    scene = with_defects(SPALL | {"bearing": 2}, DENT | {"bearing": 1}, BALL | {"bearing": 2}, scene=pair)
    each = [one.scene.imperfections.defect for one in scene.bearings()]
    assert [[one.shape for one in own] for own in each] == [["dent"], ["spall", "pit"]]
    assert not [one for own in each for one in own if one.bearing is not None]


def test_a_defect_is_a_source_and_no_seed_moves_it():
    flaws = with_defects(SPALL).imperfections
    assert flaws.sources == (*BARE.imperfections.sources, "defects")
    assert flaws.alone("defects").sources == ("defects",)
    assert flaws.alone("defects").defect == flaws.defect
    assert flaws.alone("outer race").defect == ()
    assert flaws.reseeded(5).defect == flaws.defect


def test_its_size_can_be_an_axis_of_a_sweep():
    scene = with_defects(SPALL).replace({"imperfections.defect[1].length_mm": 0.6})
    assert scene.imperfections.defect[0].length_mm == 0.6


@pytest.mark.parametrize("arrangement", [None, "DB"])
def test_a_new_scene_may_have_a_spall(arrangement):
    text = new_scene("a", "7003C", arrangement=arrangement, sound=False, spall_mm=1.2)
    scene = read_scene_text(text)
    (spall,) = scene.imperfections.defect
    assert (spall.on, spall.shape, spall.length_mm, spall.angle_deg) == ("outer", "spall", 1.2, 180.0)
    assert spall.bearing == (None if arrangement is None else 1)
    assert "depth_um = 100.0 # assumed" in text and "width_mm = 1.2 # assumed: as long as it is" in text
    assert not read_scene_text(new_scene("a", "7003C", sound=False)).imperfections.defect
    with pytest.raises(SceneError, match="length_mm takes 9 mm along rolling; allowed: up to"):
        new_scene("a", "7003C", sound=False, spall_mm=9.0)
