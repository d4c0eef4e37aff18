"""A greased bearing: its limit of speed, what its balls go through, what the words say."""

import pytest

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.verdicts import verdicts
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.words import conditions_words, materials_words
from tests.conftest import EXAMPLES


def point(supply, **more):
    scene = read_scene(EXAMPLES / "7003C-spindle.toml")
    return operating_point(scene.replace({"lubricant.supply": supply} | more))


def test_the_limit_of_speed_is_that_of_grease():
    by_supply = {}
    for supply in ("oil-air", "grease"):
        found = point(supply, **{"operation.speed_rpm": 50_000.0})
        by_supply[supply] = next(one for one in verdicts(found) if one.key == "speed")
    # 1.15e6 and 1.75e6 mm r/min, 1.25 times as much with ceramic balls: n d_m is 1.3e6
    assert by_supply["oil-air"].limit == "2.19" and by_supply["oil-air"].judgement == "good"
    assert by_supply["grease"].limit == "1.44" and by_supply["grease"].source.startswith("NSK: grease")
    fast = next(v for v in verdicts(point("grease", **{"operation.speed_rpm": 60e3})) if v.key == "speed")
    assert fast.judgement == "change" and "or oil in place of grease" in fast.advice


def test_its_balls_go_through_air():
    oil, grease = (point(supply).bearings[0].heat for supply in ("oil-air", "grease"))
    # the scene's mist has 5 kg/m3, air 1.2; drag goes with the density
    assert grease.drag / oil.drag == pytest.approx(1.2 / 5.0, rel=1e-3)
    # SKF has one constant for both: what the inlets find is the same
    assert grease.rolling == pytest.approx(oil.rolling, rel=1e-3)


def test_words_of_a_scene():
    scene = read_scene(EXAMPLES / "7003C-spindle.toml")
    assert materials_words(scene) == "hybrid: rings GCr15, balls Si3N4, cage bakelite"
    assert conditions_words(scene) == "supply oil-air; oil 40, inner ring 40, outer ring 40 degC"
    own = scene.replace(
        {"materials.balls": {**scene.materials.balls.model_dump(), "youngs_modulus_GPa": 300}}
    )
    assert "balls own material of 300 GPa" in materials_words(own)
