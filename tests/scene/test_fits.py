"""Fits of the rings in a scene: interferences by class, defaults of the partners."""

import itertools

import pytest

from fmu_bearing.formulas.tolerances import BEARING_CLASSES, TAKES
from fmu_bearing.scene import Scene, SceneError, read_scene, read_scene_text, seats
from fmu_bearing.scene.fit import (
    fit_of_member,
    held_loose,
    housing_partner,
    interferences,
    partner_temperatures,
    shaft_partner,
)
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.template import new_scene
from fmu_bearing.sweeps.axes import axes_of
from tests.conftest import EXAMPLES
from tests.scene.fits import (
    HOUSING,
    JS4,
    PAIR,
    RIGID,
    SET,
    SET_JS4,
    SINGLE,
    read,
    refused,
    seat,
)

# --- interferences ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("bearing", "wanted", "mean", "low", "high"),
    [
        ("7003C", "js4", 2.0, -2.5, 6.5),
        ("7003C", "js5", 2.0, -4.0, 8.0),
        ("7003C", "k5", 7.0, 1.0, 13.0),
        ("7009C", "k5", 10.5, 2.0, 19.0),
    ],
)
def test_classes_give_the_interference_of_their_zones(bearing, wanted, mean, low, high):
    """P4, um on diameter: bores of 17 and 45 mm are 0 to -4 and 0 to -6 um, IT4 5 and 7, IT5 8 and 11."""
    text = new_scene("a", bearing, kind="steel", sound=False, preload_N=150.0)
    scene = read(seat(f'shaft_class = "{wanted}"'), text)
    found = {take: interferences(scene, take)[0].um for take in TAKES}
    assert (found["min"], found["mean"], found["max"]) == (low, mean, high)
    # the halves of both zones, added as the root of the sum of squares
    shaft, bore = {"js4": (5, 4), "js5": (8, 4), "k5": (8, 4)}[wanted] if bearing == "7003C" else (11, 6)
    half = ((shaft / 2) ** 2 + (bore / 2) ** 2) ** 0.5
    assert found["probable max"] - mean == pytest.approx(half, rel=1e-12)
    assert mean - found["probable min"] == pytest.approx(half, rel=1e-12)
    assert interferences(scene) == (
        (mean, f"{wanted} on P4, mean {mean:.1f} um of {low:.1f} to {high:.1f}"),
        None,
    )


def test_a_housing_of_a_larger_bore_is_looser():
    """35 mm: outside 0 to -6 um, JS5 +-5.5: mean -3, tightest 5.5, loosest -11.5."""
    text = seat('housing_class = "JS5"\noutside_diameter_mm = 60', "mounting.fit.housing")
    assert [interferences(read(text), take)[1].um for take in ("min", "mean", "max")] == [-11.5, -3.0, 5.5]


def test_the_scene_says_which_interference_is_run():
    scene = read('\n[mounting.fit]\ntake = "max"' + JS4)
    assert interferences(scene)[0].um == 6.5
    assert interferences(scene, "min")[0].um == -2.5
    assert interferences(scene.replace({"mounting.fit.take": "probable min"}))[0].um == pytest.approx(
        2.0 - 10.25**0.5, rel=1e-12
    )


def test_roughness_is_lost_where_diameters_were_measured():
    """0.4 Rz of an interference by classes; none of one that is given."""
    rough = "\nroughness_Rz_um = 1.5"
    shaft, _ = interferences(read(seat('shaft_class = "js4"' + rough)))
    assert shaft.um == pytest.approx(1.4, rel=1e-12)
    assert shaft.words.endswith("mean 2.0 um of -2.5 to 6.5, less by 0.6 um of roughness")
    assert interferences(read(seat("interference_um = 2.0" + rough)))[0] == (2.0, "2 um as given")


def test_without_a_fit_rings_have_no_seat():
    scene = read("")
    assert scene.fit is None and interferences(scene) == (None, None)
    assert "fit" not in scene.to_toml()


def test_the_classes_of_a_scene_are_those_of_the_tables():
    assert BEARING_CLASSES == seats.BEARING_CLASSES
    assert seats.Fit.model_fields["take"].annotation == seats.Take
    assert seats.Take.__args__ == TAKES


# --- what follows from other tables ----------------------------------------------------------------


@pytest.mark.parametrize("grade", ["P5", "P4", "P2"])
def test_the_grade_is_the_bearing_class(grade):
    text = SINGLE.replace('grade = "P4"', f'grade = "{grade}"')
    assert read(JS4, text).fit.bearing_class == grade
    assert read('\n[mounting.fit]\nbearing_class = "P2"' + JS4, text).fit.bearing_class == "P2"


def test_preload_of_a_class_or_an_offset_is_of_the_loose_bearing():
    for key, value in (("preload_class", '"light"'), ("preload_offset_um", "10.0")):
        text = RIGID.replace("preload_N = 150.0", f"{key} = {value}")
        scene = read(JS4, text)
        assert scene.fit.preload == "unmounted" and held_loose(scene)
        line = refused('\n[mounting.fit]\npreload = "mounted"' + JS4, text)
        assert line.startswith(
            f"mounting.fit.preload = 'mounted' contradicts mounting.{key}, which is of the"
        )
        assert 'give "unmounted"' in line and "preload_N" in line
    assert read(JS4).fit.preload is None  # a constant force asks for nothing
    assert not held_loose(read('\n[mounting.fit]\npreload = "mounted"' + JS4, RIGID))


def test_partners_of_a_single_bearing():
    scene = read(JS4 + seat("interference_um = -3\noutside_diameter_mm = 60", "mounting.fit.housing"))
    rings = scene.materials
    assert shaft_partner(scene) == (rings.inner_ring, 0.0)
    assert housing_partner(scene) == (rings.outer_ring, 60.0)
    warm = scene.replace({"operation.inner_ring_temperature_degC": 47.0})
    assert partner_temperatures(warm) == (47.0, 40.0)
    changes = {
        "shaft.bore_mm": 8.0,
        "housing.material": "aluminium",
        "shaft.temperature_degC": 35.0,
        "housing.temperature_degC": 30.0,
    }
    other = scene.replace({f"mounting.fit.{key}": value for key, value in changes.items()})
    assert shaft_partner(other) == (rings.inner_ring, 8.0)
    assert (housing_partner(other)[0].youngs_modulus_GPa, housing_partner(other)[0].expansion_1e6_K) == (
        70.0,
        23.4,
    )
    assert partner_temperatures(other) == (35.0, 30.0)


def test_the_housing_that_moves_is_the_partner():
    body = "\n[mounting.housing]\nmass_kg = 2\ndiameter_mm = 90\nlength_mm = 100\nfront_face_mm = 10\n"
    fit = seat('housing_class = "H5"', "mounting.fit.housing")
    assert housing_partner(read(body + fit))[1] == 90.0
    assert housing_partner(read(body + fit + "outside_diameter_mm = 70\n"))[1] == 70.0


def test_partners_of_a_set_are_its_bodies():
    text = PAIR.replace("[70.0, 17.0, 0.0]", "[50.0, 17.0, 6.0], [20.0, 17.0, 4.0]")
    text = text.replace(
        'material = "GCr15"\ntemperature_degC = 37.0', 'material = "ZrO2"\ntemperature_degC = 37.0'
    )
    fit = seat("interference_um = 1\noutside_diameter_mm = 60", "spindle.fit.housing")
    scene = read(SET_JS4 + fit, text)
    # bearings at 40 and 90 mm; the sections end at 30, 80 and 100 mm
    assert [shaft_partner(scene, k) for k in (0, 1)] == [
        (scene.spindle.shaft.material, 6.0),
        (scene.spindle.shaft.material, 4.0),
    ]
    assert housing_partner(scene) == (scene.spindle.housing.material, 60.0)
    assert partner_temperatures(scene) == (42.0, 37.0)
    cold = scene.replace(
        {"spindle.shaft.temperature_degC": None, "operation.inner_ring_temperature_degC": 55.0}
    )
    assert partner_temperatures(cold) == (55.0, 37.0)
    own = scene.replace({"spindle.fit.shaft.bore_mm": 5.0, "spindle.fit.shaft.material": "ZrO2"})
    assert shaft_partner(own, 1) == (scene.spindle.housing.material, 5.0)


def test_a_bearing_of_a_set_may_have_its_own_interference():
    text = PAIR.replace('carries = "-x"', 'carries = "-x"\nshaft_interference_um = -1.5')
    scene = read(SET_JS4, text)
    assert [interferences(scene, member=k)[0].um for k in (0, 1)] == [2.0, -1.5]
    assert [interferences(scene, "max", k)[0].um for k in (0, 1)] == [6.5, -1.5]
    # of its own in every bearing: the table needs none
    every = text.replace('carries = "+x"', 'carries = "+x"\nshaft_interference_um = 3')
    bare = read(SET + "[spindle.fit.shaft]\n", every)
    assert [interferences(bare, member=k)[0].um for k in (0, 1)] == [3.0, -1.5]


def test_a_bearing_of_a_set_has_its_fit_as_a_single_one():
    text = PAIR.replace('carries = "-x"', 'carries = "-x"\nshaft_interference_um = -1.5')
    scene = read(SET_JS4, text)
    for k, one in enumerate(scene.bearings()):
        alone = one.scene
        assert alone.fit == fit_of_member(scene, k)
        assert interferences(alone) == interferences(scene, member=k)
        assert shaft_partner(alone) == shaft_partner(scene, k)
        assert partner_temperatures(alone)[0] == partner_temperatures(scene)[0] == 42.0
    assert all(one.scene.fit is None for one in read("", PAIR).bearings())


# --- the way to TOML and back, changes, sweeps -----------------------------------------------------


@pytest.mark.parametrize(
    ("fit", "text"),
    [
        ('\n[mounting.fit]\ncontact_angle = "mounted"' + JS4, SINGLE),
        (JS4 + HOUSING, SINGLE),
        (JS4, RIGID.replace("preload_N = 150.0", 'preload_class = "light"')),
        (SET_JS4, PAIR.replace('carries = "-x"', 'carries = "-x"\nshaft_interference_um = -1.5')),
    ],
)  # fmt: skip
def test_a_fit_survives_the_way_through_toml(fit, text):
    scene = read(fit, text)
    again = read_scene_text(scene.to_toml())
    assert again == scene and again.to_toml() == scene.to_toml()
    assert Scene.from_dict(scene.model_dump()) == scene
    assert interferences(again) == interferences(scene)


def test_a_new_class_or_interference_replaces_the_other():
    scene = read(JS4)
    given = scene.replace({"mounting.fit.shaft.interference_um": 3.0})
    assert given.fit.shaft.shaft_class is None and interferences(given)[0].um == 3.0
    assert given.replace({"mounting.fit.shaft.shaft_class": "js4"}) == scene
    with pytest.raises(SceneError, match=r"shaft\.shaft_class is missing, for example"):
        scene.replace({"mounting.fit.shaft.shaft_class": None})
    with pytest.raises(SceneError, match="cannot be given with shaft_class"):
        scene.replace({"mounting.fit.shaft.interference_um": 3.0, "mounting.fit.shaft.shaft_class": "k4"})


def test_fits_are_axes_of_sweeps():
    scene = read(JS4)
    takes, classes = axes_of(
        scene, {"mounting.fit.take": "min,probable max", "mounting.fit.shaft.shaft_class": "js4,k5"}
    )
    found = [
        interferences(scene.replace({takes.key: take, classes.key: one}))[0].um
        for take, one in itertools.product(takes.values, classes.values)
    ]
    assert found[:2] == [-2.5, 1.0] and found[2:] == pytest.approx([2 + 10.25**0.5, 7 + 20**0.5])
    (axis,) = axes_of(read("", SINGLE), {"mounting.fit.shaft.interference_um": "0:6:4"})
    assert axis.unit == "um"
    assert interferences(read("").replace({axis.key: axis.values[1]}))[0].um == 2.0


def test_origins_say_what_the_classes_give(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(
        RIGID.replace("preload_N = 150.0", 'preload_class = "light"')
        + '\n[mounting.fit.shaft]\nshaft_class = "js4" # assumed: as NSK asks\nmaterial = "GCr15"\n',
        encoding="utf-8",
    )
    known = {one.key.removeprefix("mounting.fit."): one for one in origins(path)}
    shaft = known["shaft.shaft_class"]
    assert (shaft.origin, shaft.assumed) == ("file", True)
    assert shaft.remark == "as NSK asks; js4 on P4, mean 2.0 um of -2.5 to 6.5"
    assert known["bearing_class"].origin == "grade P4"
    assert known["shaft.material.expansion_1e6_K"].origin == "catalogue GCr15"
    assert known["preload"].value == "unmounted" and "of the loose bearing" in known["preload"].remark
    assert known["take"].origin == "default"


def test_strength_of_a_ceramic_is_given_by_its_maker():
    strong = SINGLE.replace('inner_ring = "GCr15"', "") + (
        '\n[materials.inner_ring]\ncatalogue = "Si3N4"\nbending_strength_MPa = 900\nweibull_modulus = 12\n'
    )
    material = read(JS4, strong).materials.inner_ring
    assert (material.bending_strength_MPa, material.weibull_modulus) == (900.0, 12.0)
    assert read(JS4).materials.inner_ring.bending_strength_MPa is None
    line = refused("", strong.replace("bending_strength_MPa = 900", "bending_strength_MPa = 0"))
    assert line == "materials.inner_ring.bending_strength_MPa = 0 is refused; allowed: 1 to 10000 MPa"


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_examples_have_no_fit(path):
    scene = read_scene(path)
    assert scene.fit is None and interferences(scene) == (None, None)
