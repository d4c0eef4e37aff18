"""What a fit cannot be is refused with the way out: classes, sizes, preloads, springs, sets."""

import pytest

from fmu_bearing.scene import SceneError
from fmu_bearing.scene.fit import (
    interferences,
    shaft_partner,
)
from fmu_bearing.scene.template import new_scene
from tests.messages import says
from tests.scene.fits import JS4, PAIR, RIGID, SET, SET_JS4, SINGLE, ported, read, refused, seat

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
