"""Local defects of a scene as the engine's numbers: whose they are, where, and how short steps have to be."""

import math

import numpy as np
import pytest

from fmu_bearing.engine.layout import DE, P
from fmu_bearing.prepare import defect_blocks
from fmu_bearing.prepare.contacts import surfaces
from fmu_bearing.prepare.defects import Table
from fmu_bearing.prepare.model import pack
from fmu_bearing.prepare.surfaces import frequencies, mean_patches
from fmu_bearing.scene import SceneError, read_scene
from tests.conftest import GATES, ROOT
from tests.engine.defects import smooth
from tests.messages import says

BARE = read_scene(GATES / "7003C-bare.toml").replace({"imperfections": None})
PAIR = read_scene(ROOT / "examples" / "spindle_set" / "7003C-DB.toml")
SPALL = {"on": "outer", "shape": "spall", "length_mm": 1.0, "width_mm": 2.0, "depth_um": 100.0}
PIT = {"on": "ball", "shape": "pit", "length_mm": 0.5, "depth_um": 50.0, "ball": 3, "tilt_deg": 30.0}
NONE = {
    "seed": 1, "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0, "waviness_exponent": 1.0,
}  # fmt: skip


@pytest.fixture
def asked(monkeypatch):
    """What tables are asked for; each is a smooth one of the shape's length."""
    calls = []

    def table(shape, *surface):
        calls.append((shape, *surface))
        return smooth(shape.length)

    monkeypatch.setattr(defect_blocks, "defect_table", table)
    return calls


def flawed(*defects, scene=BARE):
    return scene.replace({"imperfections": NONE | {"defect": list(defects)}})


def packed(scene):
    return pack(scene, np.empty(0))


def head(p, k):
    return p[int(p[P.AT_DEFECTS]) + k * DE.SIZE :][: DE.SIZE]


def test_a_scene_without_defects_has_no_number_more(asked):
    p = packed(BARE)
    assert p[P.DEFECTS] == p[P.BALL_DEFECTS] == p[P.AT_DEFECTS] == p[P.PASS_RATE] == 0.0
    assert not asked


def test_races_and_balls_that_meet_a_defect_have_a_table_of_their_contact(asked):
    scene = flawed(SPALL, PIT)
    p = packed(scene)
    assert (p[P.DEFECTS], p[P.BALL_DEFECTS]) == (2, 1)
    assert [one[1:] for one in asked] == [surfaces(scene, race) for race in (1, 0, 1)]
    spall, pit = asked[0][0], asked[1][0]
    assert (spall.kind, pit.kind) == ("rectangle", "ellipse")
    assert (spall.length, spall.width, spall.depth) == pytest.approx((1e-3, 2e-3, 1e-4))
    assert (pit.length, pit.width) == pytest.approx((5e-4, 5e-4))
    outer, ball = head(p, 0), head(p, 1)
    assert (outer[DE.NUMBER], outer[DE.ON], ball[DE.NUMBER], ball[DE.ON]) == (0, DE.OUTER, 1, DE.BALL)
    assert outer[DE.ANGLE] == pytest.approx(math.pi)
    assert outer[DE.RADIUS + 1] == mean_patches(scene)[1].radius
    assert outer[DE.AT_TABLE] == 0.0
    assert ball[DE.RADIUS] == ball[DE.RADIUS + 1] == pytest.approx(scene.bearing.ball_diameter_mm / 2e3)
    assert ball[DE.OF_BALL] == 2
    # out of the rolling circle towards +X and inwards, across the track of a contact at 15 deg
    turn = math.radians(scene.bearing.contact_angle_deg)
    wanted = 0.5 * math.cos(turn), -0.5 * math.sin(turn), math.cos(math.radians(30.0))
    assert ball[DE.DIRECTION : DE.DIRECTION + DE.VECTOR] == pytest.approx(wanted)


def test_tables_are_behind_the_heads(asked):
    p = packed(flawed(SPALL, PIT))
    for k, race, length in ((0, 1, 1e-3), (1, 0, 5e-4), (1, 1, 5e-4)):
        one = smooth(length)
        first = int(p[P.AT_DEFECTS] + head(p, k)[DE.AT_TABLE + race])
        assert (p[first + DE.PLACES], p[first + DE.APPROACHES]) == (one.places.size, one.approaches.size)
        numbers = p[first + DE.TABLE_HEAD :]
        assert (numbers[: one.places.size] == one.places).all()
        node = one.places.size + one.approaches.size + one.places.size * DE.TOUCH_ROW
        drop = numbers[node:].copy()[: one.drop.size * DE.DROP_ROW].reshape(*one.drop.shape, DE.DROP_ROW)
        assert (drop[..., DE.DROP] == one.drop).all() and (drop[..., DE.DROP_XE] == one.drop_xe).all()


def test_a_ball_s_defect_acts_wholly_where_it_covers_the_ellipse_or_this_covers_it(asked):
    p = packed(flawed(PIT))
    full, end = head(p, 0)[DE.ACROSS : DE.ACROSS + 2]
    half = 0.5 * (end - full)  # the smaller of the ellipse's and the pit's
    assert half == pytest.approx(smooth(5e-4).across)
    assert 1e-4 < end - half < 1e-3  # the ellipse's


def test_steps_are_at_most_half_the_contact_and_a_tenth_of_the_length(asked):
    scene = flawed(SPALL)
    p, speed = packed(scene), 100.0
    patch = mean_patches(scene)[1]
    moved = frequencies(scene, 2.0 * math.pi).f_c * speed * patch.radius / p[P.PASS_RATE] / speed
    assert moved == pytest.approx(patch.half_width + 0.5 * 1e-4)
    assert p[P.TURN_RATE] == 0.0


def test_a_defect_belongs_to_one_bearing_of_a_set(asked):
    scene = flawed(SPALL | {"bearing": 2}, SPALL | {"bearing": 1, "angle_deg": 90.0}, scene=PAIR)
    p = packed(scene.with_rigid_rings())
    first = p[: p.size]
    assert (first[P.DEFECTS], head(first, 0)[DE.NUMBER]) == (1, 1)
    assert head(first, 0)[DE.ANGLE] == pytest.approx(math.pi / 2)
    alone = packed(scene.bearings()[1].scene.with_rigid_rings())
    assert (alone[P.DEFECTS], head(alone, 0)[DE.ANGLE]) == (1, pytest.approx(math.pi))


def test_a_defect_longer_than_its_ball_is_refused(asked, monkeypatch):
    long = smooth(8e-3)
    monkeypatch.setattr(defect_blocks, "defect_table", lambda *_: long)
    assert isinstance(long, Table)
    with pytest.raises(SceneError) as caught:
        packed(flawed(PIT))
    assert says(str(caught.value), "acts on 8.00 mm of a track of 14.14 mm ... give a shorter one")
