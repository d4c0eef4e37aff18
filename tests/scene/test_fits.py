"""Fits of the rings in a scene: interferences by class, defaults of the partners, every refusal."""

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
from tests.messages import says

SINGLE = new_scene("a", "7003C", kind="steel", sound=False, preload_N=150.0)
RIGID = SINGLE.replace("preload_N = 150.0", 'preload_N = 150.0\npreload_mode = "rigid"')
PAIR = (EXAMPLES.parent / "spindle_set" / "7003C-DB.toml").read_text("utf-8")
PORT = """
[spindle.shaft]
external = true
"""
JS4 = '\n[mounting.fit.shaft]\nshaft_class = "js4"\n'
HOUSING = """
[mounting.fit.housing]
housing_class = "M4"
outside_diameter_mm = 60
material = "aluminium"
"""
#: A fit of the pair without a seat.
SET = '\n[spindle.fit]\nbearing_class = "P4"\npreload = "unmounted"\n'
SET_JS4 = f'{SET}[spindle.fit.shaft]\nshaft_class = "js4"\n'


def seat(lines, where="mounting.fit.shaft"):
    return f"\n[{where}]\n{lines}\n"


def read(fit, text=SINGLE):
    return read_scene_text(text + fit, "a")


def refused(fit, text=SINGLE):
    """The one line about a scene, without the name of the file."""
    with pytest.raises(SceneError) as caught:
        read(fit, text)
    (line,) = caught.value.problems
    return line.removeprefix("a: ")


def ported(text=PAIR):
    """The pair on another model's shaft."""
    begin, end = text.index("[spindle.shaft]"), text.index("[spindle.housing]")
    return text[:begin] + PORT + text[end : text.index("[spindle.load]")]


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


# --- refusals --------------------------------------------------------------------------------------

REFUSED = [
    (
        seat('shaft_class = "js4"\ninterference_um = 2.0'),
        'mounting.fit.shaft.interference_um = 2.0 cannot be given with shaft_class = "js4"',
        "leave out one of the two",
    ),
    (
        seat("bore_mm = 8.0"),
        'mounting.fit.shaft.shaft_class is missing, for example shaft_class = "js4"',
        "or give interference_um = 2.0",
    ),
    (
        seat("outside_diameter_mm = 60", "mounting.fit.housing"),
        'mounting.fit.housing.housing_class is missing, for example housing_class = "JS5"',
        "or give interference_um = 2.0",
    ),
    (
        seat('shaft_class = "JS4"'),
        "mounting.fit.shaft.shaft_class = 'JS4' is refused; allowed: g4, g5, g6, h4",
        "m6; or give interference_um",
    ),
    (
        seat('housing_class = "x4"\noutside_diameter_mm = 60', "mounting.fit.housing"),
        "mounting.fit.housing.housing_class = 'x4' is refused; allowed: H4",
        "or give interference_um",
    ),
    (
        seat('shaft_class = "js4"\nbore_mm = 17'),
        "mounting.fit.shaft.bore_mm = 17 must be below",
        "bearing.bore_mm = 17",
    ),
    (
        seat("interference_um = -3\noutside_diameter_mm = 35", "mounting.fit.housing"),
        "mounting.fit.housing.outside_diameter_mm = 35 must exceed",
        "bearing.outside_diameter_mm = 35",
    ),
    (
        seat("interference_um = -3", "mounting.fit.housing"),
        "mounting.fit.housing.outside_diameter_mm is missing, for example outside_diameter_mm = 60",
        "mounting.housing.diameter_mm serves, too",
    ),
    (
        seat("interference_um = 34.1"),
        "mounting.fit.shaft.interference_um = 34.1 is beyond 1/500",
        "allowed: -34 to 34 um",
    ),
    (
        seat("interference_um = -70.1\noutside_diameter_mm = 60", "mounting.fit.housing"),
        "mounting.fit.housing.interference_um = -70.1 is beyond 1/500",
        "allowed: -70 to 70 um",
    ),
    ("\n[mounting.fit]\n", "mounting.fit: has no seat", "shaft.interference_um = 2.0"),
    (
        '\n[mounting.fit]\nbearing_class = "P6"' + JS4,
        "mounting.fit.bearing_class = 'P6' is refused; allowed: P5, P4, P2",
        "",
    ),
    (
        seat("shaft_class = 4"),
        "mounting.fit.shaft.shaft_class = 4 is refused",
        "it is a number, and text in quotes is due",
    ),
    (
        seat('housing_class = "JS5"'),
        "mounting.fit.shaft.housing_class is not a key of a scene",
        "it belongs in [mounting.fit.housing]",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("fit", "begin", "way_out"), REFUSED)
def test_what_a_fit_cannot_be_is_refused_with_the_way_out(fit, begin, way_out):
    with pytest.raises(SceneError) as caught:
        read(fit)
    line = caught.value.problems[0].removeprefix("a: ")
    assert line.startswith(begin) and way_out in line


@pytest.mark.parametrize("grade", ["P6", "P0"])
def test_a_grade_without_tolerances_asks_for_a_class(grade):
    line = refused(JS4, SINGLE.replace('grade = "P4"', f'grade = "{grade}"'))
    assert line.startswith(
        'mounting.fit.bearing_class is missing, for example bearing_class = "P4": shaft_class'
    )
    assert line.endswith("or give interference_um in the place of shaft_class")
    # an interference needs no class
    assert read(seat("interference_um = 2"), SINGLE.replace('grade = "P4"', f'grade = "{grade}"')).fit


def large(bore, outside):
    """A bearing of any size from its dimensions."""
    from fmu_bearing.scene.own_bearing import Dimensions

    size = Dimensions(bore=bore, outside=outside, width=0.25 * (outside - bore) + 4.0)
    return new_scene("a", size, kind="steel", sound=False, preload_N=150.0)


def test_sizes_outside_the_tables_ask_for_the_interference():
    text = large(5.0, 16.0)
    line = refused(JS4, text)
    assert line.startswith("mounting.fit.shaft.shaft_class = 'js4' is refused: ")
    assert "5 mm" in line and line.endswith("give interference_um")
    assert interferences(read(seat("interference_um = 5"), text))[0].um == 5.0


def test_classes_that_no_ring_bears_are_refused():
    """8 mm: m6 is 6 to 15 um, P5 0 to -5: up to 20 um, where 16 are 1/500."""
    line = refused(seat('shaft_class = "m6"'), large(8.0, 24.0).replace('grade = "P4"', 'grade = "P5"'))
    words = "mounting.fit.shaft.shaft_class = 'm6' on P5 ... 20 um ... 16 um ... give interference_um"
    assert says(line, words)


def test_a_rigid_preload_in_newtons_asks_when_it_was_there():
    line = refused(JS4, RIGID)
    assert line.startswith("mounting.fit.preload is missing beside mounting.preload_N = 150")
    assert says(line, 'preload = "unmounted" ... "mounted"')
    asked = refused(
        f'{SET}[spindle.fit.shaft]\nshaft_class = "js4"\n'.replace('preload = "unmounted"\n', ""), PAIR
    )
    assert asked.startswith("spindle.fit.preload is missing beside spindle.preload.preload_N = 150")


def test_springs_are_not_asked():
    text = PAIR.replace('kind = "spacer"\npreload_N', 'kind = "spring"\nforce_N')
    text = text.replace('carries = "-x"', 'carries = "-x"\nseat = "sliding"')
    assert read(SET_JS4.replace('preload = "unmounted"\n', ""), text).fit.preload is None


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_a_ring_that_bends_on_a_loose_seat_has_no_fit(ring):
    fit = (
        JS4
        if ring == "inner"
        else seat("interference_um = 1\noutside_diameter_mm = 60", "mounting.fit.housing")
    )
    name = "shaft" if ring == "inner" else "housing"
    bending = f"\n[mounting.flexure]\n{ring}_ring = [2]\n"
    line = refused(fit + bending)
    assert line.startswith(f"mounting.flexure.{ring}_ring: cannot bend on the seat of [mounting.fit.{name}]")
    assert f"{ring}_seat_stiffness_N_m above 0" in line
    assert read(fit + bending + f"{ring}_seat_stiffness_N_m = 1e8\n").bends
    other = "outer" if ring == "inner" else "inner"
    assert read(fit + bending.replace(ring, other)).bends  # the other ring is free to


@pytest.mark.parametrize(
    ("key", "value", "fit", "words"),
    [
        ("inner_ring_outer_diameter_mm", 21.5, JS4, "must exceed that of the race's bottom, 21.5 mm"),
        (
            "outer_ring_inner_diameter_mm",
            30.5,
            seat("interference_um = 1\noutside_diameter_mm = 60", "mounting.fit.housing"),
            "must be below that of the race's bottom, 30.5 mm",
        ),
    ],
)
def test_an_effective_diameter_leaves_a_wall(key, value, fit, words):
    text = SINGLE.replace("[bearing]\n", f"[bearing]\n{key} = {value}\n")
    assert read("", text)
    line = refused(fit, text)
    assert line.startswith(f"bearing.{key} = {value} leaves no wall around the race: with [mounting.fit.")
    assert line.endswith(words)


def test_another_models_shaft_has_no_bore_of_its_own():
    with pytest.raises(SceneError) as caught:
        read(SET_JS4, ported())
    bore, material = (line.removeprefix("a: ") for line in caught.value.problems)
    assert bore.startswith("spindle.fit.shaft.bore_mm is missing, for example bore_mm = 0.0 of a solid shaft")
    assert material.startswith('spindle.fit.shaft.material is missing, for example material = "GCr15"')
    scene = read(SET_JS4 + 'bore_mm = 6\nmaterial = "GCr15"\n', ported())
    assert shaft_partner(scene, 1) == (scene.materials.inner_ring, 6.0)


def test_a_bore_of_the_sections_leaves_a_shaft():
    text = PAIR.replace("[70.0, 17.0, 0.0]", "[70.0, 18.0, 17.0]")
    with pytest.raises(SceneError) as caught:
        read(SET_JS4, text)
    first, second = (line.removeprefix("a: ") for line in caught.value.problems)
    way_out = "correct the section, or give spindle.fit.shaft.bore_mm"
    words = f"spindle.shaft.sections_mm ... 17 mm at bearing 1 ... bearing.bore_mm = 17 ... {way_out}"
    assert says(first, words)
    assert "at bearing 2" in second
    assert read(SET_JS4 + "bore_mm = 8\n", text).fit


def test_interferences_of_bearings_need_the_table():
    text = PAIR.replace('carries = "-x"', 'carries = "-x"\nshaft_interference_um = 2')
    line = refused("", text)
    assert says(
        line, "spindle.bearing[2].shaft_interference_um = 2 ... [spindle.fit.shaft] ... leave the key out"
    )
    fit = f"{SET}[spindle.fit.housing]\ninterference_um = 1\noutside_diameter_mm = 60\n"
    assert "needs the table [spindle.fit.shaft]" in refused(fit, text)
    beyond = refused(SET_JS4, text.replace("interference_um = 2", "interference_um = -35"))
    assert beyond.startswith("spindle.bearing[2].shaft_interference_um = -35 is beyond 1/500")
    partly = refused(f"{SET}[spindle.fit.shaft]\n", text)
    assert partly.startswith("spindle.fit.shaft.shaft_class is missing")
    assert partly.endswith("or shaft_interference_um to every [[spindle.bearing]]")


@pytest.mark.parametrize(
    ("fit", "text", "message"),
    [
        (SET_JS4, SINGLE, "spindle.fit ... [mounting.fit] ... rename the table"),
        (JS4, PAIR, "mounting.fit ... [spindle.fit] ... rename the table"),
        (
            seat("temperature_degC = 40\ninterference_um = 1", "spindle.fit.shaft") + SET,
            PAIR,
            "spindle.fit.shaft.temperature_degC = 40 ... spindle.shaft.temperature_degC",
        ),
    ],
)
def test_sets_and_single_bearings_have_tables_of_their_own(fit, text, message):
    assert says(refused(fit, text), message)


def test_changes_of_the_other_kind_are_directed():
    pair = read("", PAIR)
    with pytest.raises(SceneError, match=r"a set of bearings has its fits in \[spindle.fit\]"):
        pair.replace({"mounting.fit.shaft.interference_um": 1.0})


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ('bearing_class = "P4"', "it belongs in [mounting.fit]"),
        ('shaft_class = "js4"', "it belongs in [mounting.fit.shaft]"),
        ("preload = 3.0", "one bearing has preload_N in [mounting]"),  # not the word of a fit
        ("shaft = 3.0", "one bearing has [mounting.rotor]"),
    ],
)
def test_keys_of_fits_are_named_where_no_other_table_has_them(line, hint):
    text = SINGLE.replace("[operation]\n", f"[operation]\n{line}\n")
    assert refused("", text) == f"operation.{line.split()[0]} is not a key of a scene; {hint}"


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_examples_have_no_fit(path):
    scene = read_scene(path)
    assert scene.fit is None and interferences(scene) == (None, None)
