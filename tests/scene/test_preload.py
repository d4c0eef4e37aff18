"""Preload by a maker's class and by an offset of the ring faces."""

import re

import pytest

from fmu_bearing.formulas.axial import axial, axial_displacement, axial_load, axial_stiffness
from fmu_bearing.identification.files import _set
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import SceneError, read_scene_text
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.template import new_scene
from tests.messages import says


def scene_with(line, bearing="NSK-7003C", kind="steel"):
    text = new_scene("a", bearing, kind=kind, sound=False, preload_N=123.0)
    return text.replace("preload_N = 123.0", line)


def read(line, **keys):
    return read_scene_text(scene_with(line, **keys), "a")


def refused(line, **keys):
    with pytest.raises(SceneError) as caught:
        read(line, **keys)
    (problem,) = caught.value.problems
    return problem


@pytest.mark.parametrize(
    ("name", "force"), [("extra light", 14), ("light", 29), ("medium", 69), ("heavy", 150)]
)
def test_classes_of_nsk_are_the_printed_newtons(name, force):
    scene = read(f'preload_class = "{name}"')
    assert scene.mounting.preload_N == force and f"preload_N = {force}.0" in scene.to_toml()
    assert "preload_class" not in scene.to_toml()


@pytest.mark.parametrize(("name", "share"), [("light", 0.005), ("medium", 0.015), ("heavy", 0.030)])
def test_other_classes_are_shares_of_the_rating(name, share):
    """C of the papers' 7003C, 12 balls of 4.5 mm, is 5956 N; three digits are kept."""
    assert read(f'preload_class = "{name}"', bearing="7003C").mounting.preload_N == pytest.approx(
        share * 5956.0, rel=5e-3
    )


def test_refusals_name_the_keys():
    assert says(
        refused('preload_class = "heavy"\npreload_N = 100.0'),
        "a: mounting.preload_class = 'heavy' ... preload_N, preload_class and preload_offset_um ... keep one",
    )
    assert "preload_offset_um = 3 cannot be given with preload_class" in refused(
        'preload_class = "heavy"\npreload_offset_um = 3'
    )
    assert "allowed: light, medium, heavy; extra light is a class of NSK's sizes" in refused(
        'preload_class = "extra light"', bearing="7003C"
    )
    assert "allowed: extra light, light, medium, heavy" in refused("preload_class = 3")
    for wrong in ('"5"', "-1", "true", "201", "nan"):
        assert "is refused; allowed: 0 to 200 um" in refused(f"preload_offset_um = {wrong}")
    assert re.search(
        r"preload_offset_um = 190 gives a preload of \d+\.?\d*(e\+\d+)? N; allowed: up to 10000 N",
        refused("preload_offset_um = 190"),
    )
    missing = refused("")
    assert "mounting.preload_N is missing" in missing and 'or preload_class = "light"' in missing
    steep = scene_with('preload_class = "light"', bearing="7003C").replace(
        "designation", "contact_angle_deg = 40.0\ndesignation"
    )
    with pytest.raises(SceneError, match="known for contact angles of 15 to 25 deg, not for 40"):
        read_scene_text(steep)


@pytest.mark.parametrize("bearing", ["NSK-7003C", "NSK-7008AC", "7009C"])
@pytest.mark.parametrize("kind", ["steel", "full-ceramic"])
@pytest.mark.parametrize(
    ("force", "weight", "error"), [(5.0, False, 1e-8), (500.0, False, 1e-8), (60.0, True, 5e-3)]
)
def test_offset_and_force_are_those_of_the_model_at_rest(bearing, kind, force, weight, error):
    """Without weight the model solves the same equations; the weight of a ring loads its balls unequally."""
    text = new_scene("a", bearing, kind=kind, sound=False, preload_N=force)
    changed = {"imperfections": None, "operation.speed_rpm": 0.0, "fidelity.terms.gravity": weight}
    # an offset is that of the bearing at 20 degC
    cold = ("oil", "inner_ring", "outer_ring")
    changed |= {f"operation.{part}_temperature_degC": 20.0 for part in cold}
    scene = read_scene_text(text).replace(changed)
    model = Instance(prepare(scene))
    model.initialise()
    offset = model.get("inner_ring.displacement.x") - model.get("outer_ring.displacement.x")
    found = scene.replace({"mounting.preload_offset_um": 1e6 * offset})
    assert found.mounting.preload_N == pytest.approx(force, rel=error)
    b, m = scene.bearing, scene.materials
    elastic = tuple(
        (1e9 * x.youngs_modulus_GPa, x.poisson_ratio) for x in (m.inner_ring, m.outer_ring, m.balls)
    )
    shape = axial(b.ball_count, b.ball_diameter_mm, b.pitch_diameter_mm, b.contact_angle_deg,
                  (b.inner_conformity, b.outer_conformity), elastic)  # fmt: skip
    assert axial_displacement(shape, force) == pytest.approx(1e3 * offset, rel=error)
    # differences in the formula err by 1e-8
    assert axial_stiffness(shape, force) == pytest.approx(
        1e-6 * model.get("stiffness.axial"), rel=error + 1e-7
    )
    assert axial_load(shape, axial_displacement(shape, force)) == pytest.approx(force, rel=1e-9)
    assert axial_load(shape, 0.0) == axial_load(shape, -1.0) == axial_displacement(shape, 0.0) == 0.0


def test_replace_takes_classes_and_offsets():
    scene = read("preload_N = 300.0")
    assert scene.replace({"mounting.preload_class": "heavy"}).mounting.preload_N == 150.0
    other = scene.replace({"mounting.preload_class": "heavy", "bearing.catalogue": "NSK-7008AC"})
    assert other.mounting.preload_N == 880.0
    assert 20.0 < scene.replace({"mounting.preload_offset_um": 5}).mounting.preload_N < 80.0
    assert scene.replace({"mounting.preload_class": None}) == scene
    with pytest.raises(SceneError, match="preload_class = 'heavy' cannot be given with preload_N"):
        scene.replace({"mounting.preload_class": "heavy", "mounting.preload_N": 3.0})


def test_origin_is_reported_in_words(tmp_path):
    file = tmp_path / "a.toml"
    for line, bearing, words in (
        ('preload_class = "heavy"', "NSK-7003C", "heavy class of NSK: 150 N"),
        ('preload_class = "medium"', "7003C", "medium class of GMN: 0.015 of C = 5958 N, 89.4 N"),
        ("preload_offset_um = 10", "NSK-7003C", "offset of 10 um: 116.5 N"),
    ):
        file.write_text(scene_with(line, bearing=bearing))
        (one,) = [one for one in origins(file) if one.key == "mounting.preload_N"]
        assert one.origin == "file" and one.remark == words and not one.assumed


def test_an_identified_preload_takes_the_place_of_a_class():
    document = {"mounting": {"preload_class": "heavy"}}
    _set(document, "mounting.preload_N", 140.0, "")
    assert document == {"mounting": {"preload_N": 140.0}}
