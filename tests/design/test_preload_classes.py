"""Preload classes: every printed load of NSK reads its own name, of a single bearing and of one of a set."""

from dataclasses import replace

import pytest

from fmu_bearing import operating_point
from fmu_bearing.design.verdicts import bearing_verdicts
from fmu_bearing.formulas import makers
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.preload import classes, nsk_size
from fmu_bearing.scene.template import new_scene
from tests.spindle.sets import scene as set_scene

SIZES = list(sizes().values())
#: Of makers' loads on hybrid bearings, which carry the same classes as steel ones.
KINDS = ("steel", "hybrid")


def judged(point):
    return {one.key: one for one in bearing_verdicts(point)}


def bearings_at(scene):
    return operating_point(scene).bearings


def bearing_at(scene):
    return bearings_at(scene)[0]


@pytest.fixture(scope="module")
def single(scene):
    return bearing_at(scene("7003C-spindle"))


@pytest.fixture(scope="module")
def member():
    return bearings_at(set_scene(rpm=12e3))[0]


#: GMN 4000 0813 EN: share of a single bearing's speed for rigid pairs; NSK's lightest class counts as light.
RIGID_SPEED = {"extra light": 0.8, "light": 0.8, "medium": 0.7, "heavy": 0.5}


def of_size(point, size, force):
    """The point with a size's bearing."""
    values = {
        "designation": size.name, "bore_mm": size.bore, "outside_diameter_mm": size.outside,
        "width_mm": size.width, "contact_angle_deg": size.angle, "ball_count": size.balls,
        "ball_diameter_mm": size.ball, "pitch_diameter_mm": size.pitch,
    }  # fmt: skip
    bearing = point.scene.bearing.model_copy(update=values)
    mounting = point.scene.mounted.model_copy(update={"preload_N": force, "preload_mode": "rigid"})
    return replace(point, scene=point.scene.model_copy(update={"bearing": bearing, "mounting": mounting}))


@pytest.mark.parametrize("size", SIZES, ids=lambda size: size.name)
def test_every_printed_load_reads_its_own_class(single, member, size):
    for point in (single, member):
        for name, one in size.preload.items():
            by_key = judged(of_size(point, size, one.force))
            verdict = by_key["preload_class"]
            assert (verdict.text, verdict.judgement) == (f"{one.force:g}: {name}", "good")
            assert "NSK" in verdict.source
            # and a rigid pair the speed of its own class
            limit = RIGID_SPEED[name] * point.speed_limit
            assert by_key["speed"].limit == f"{1e-6 * limit:.2f}"
            # one tenth more is the slack, beyond it the next class begins
            assert makers.preload_class(1.0999 * one.force, classes_of(size)) == name
            assert makers.preload_class(1.1001 * one.force, classes_of(size)) != name


def classes_of(size):
    return {name: one.force for name, one in size.preload.items()}


def test_the_case_that_was_judged_one_class_too_heavy():
    """NSK-7010C, medium 390 N, rigid: 0.7 of 1.25 x 1.75e6, not 0.5 of it."""
    text = new_scene("a", "NSK-7010C", kind="hybrid", sound=False, preload_class="medium", speed_rpm=10e3)
    by_key = judged(bearing_at(read_scene_text(text).replace({"mounting.preload_mode": "rigid"})))
    assert by_key["preload_class"].text == "390: medium" and by_key["speed"].limit == "1.53"
    assert "as a rigid medium pair" in by_key["speed"].source


def a_set(name, force, **keys):
    """Two bearings of a size on spacers, warm and at speed: as the classes of loose ones must not be read."""
    warm = {
        "operation.inner_ring_temperature_degC": 50.0, "operation.oil_temperature_degC": 40.0,
        "bearing.catalogue": name, "spindle.preload.preload_N": force,
    }  # fmt: skip
    width = sizes()[name].width
    return set_scene(rpm=keys.pop("rpm", 8e3), positions=(40.0, 40.0 + 3.0 * width), changes=warm, **keys)


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["NSK-7003C", "NSK-7010C", "NSK-7914AC"])
@pytest.mark.parametrize("preload", ["extra light", "light", "medium", "heavy"])
def test_one_of_a_set_is_judged_as_a_loose_bearing(name, preload):
    force = sizes()[name].preload[preload].force
    points = bearings_at(a_set(name, force))
    for point in points:
        by_key = judged(point)
        assert by_key["preload_class"].text == f"{force:g}: {preload}"
        assert f"as a rigid {preload} pair" in by_key["speed"].source
    # warmth and speed have changed what it carries, which pressure and life judge
    assert points[0].axial != pytest.approx(force, rel=0.02)


@pytest.mark.heavy
# every third size, at both angles: `test_every_printed_load_reads_its_own_class` reads the loads of all
@pytest.mark.parametrize("name", list(sizes())[::3])
def test_every_class_of_a_size_by_itself_and_in_a_set(name):
    size = sizes()[name]
    speed = 0.3 * size.oil_speed
    for k, (preload, one) in enumerate(size.preload.items()):
        text = new_scene(
            "a", name, kind=KINDS[k % 2], sound=False, preload_class=preload, speed_rpm=speed
        )  # fmt: skip
        alone = bearing_at(read_scene_text(text))
        for point in (alone, *bearings_at(a_set(name, one.force, rpm=speed))):
            assert judged(point)["preload_class"].text == f"{one.force:g}: {preload}"


def test_a_set_that_carries_one_way_has_no_class():
    pushed = set_scene(
        "+", (40.0,), None, 12e3, load={"force_x_N": 500.0}, changes={"bearing.catalogue": "NSK-7003C"}
    )
    verdict = judged(bearings_at(pushed)[0])["preload_class"]
    assert (verdict.judgement, verdict.source) == ("not judged", "no preload")


def test_a_size_is_known_by_its_name_or_its_inside(scene):
    base = scene("7003C-spindle")
    size = base.replace({"bearing.catalogue": "NSK-7009C"})
    assert nsk_size(size.bearing).name == "NSK-7009C"
    renamed = size.replace({"bearing.designation": "front"})
    assert nsk_size(renamed.bearing).name == "NSK-7009C"
    # a size of NSK's with grooves or an angle as measured stays one, and one of no printed angle does not
    measured = size.replace({"bearing.inner_conformity": 0.515, "bearing.contact_angle_deg": 15.6})
    assert nsk_size(measured.bearing).name == "NSK-7009C"
    assert nsk_size(size.replace({"bearing.contact_angle_deg": 25.0}).bearing).name == "NSK-7009AC"
    assert nsk_size(size.replace({"bearing.contact_angle_deg": 20.0}).bearing) is None
    # the papers' bearings are not NSK's
    for name in ("7003C", "7009C"):
        own = base.replace({"bearing.catalogue": name}).bearing
        assert nsk_size(own) is None and classes(own).maker == "GMN"


def test_a_key_and_its_verdict_read_the_same_class(scene):
    """Three digits of a share of C, once: what preload_class gives is what the table and the advice name."""
    base = scene("7003C-spindle")
    for values in ({}, {"bearing.designation": "front", "bearing.catalogue": "NSK-7003C"}):
        for name in ("light", "medium", "heavy"):
            asked = base.replace(values | {"mounting.preload_class": name})
            verdict = judged(bearing_at(asked))["preload_class"]
            force = asked.mounting.preload_N
            assert verdict.text == f"{force:g}: {name}" and f"{name} {force:g}" in verdict.limit
