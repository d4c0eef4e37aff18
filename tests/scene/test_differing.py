"""Bearings of a set that differ: their tables in a scene, and the scene of each alone."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import SP, P
from fmu_bearing.prepare.bodies import inner_ring, rings_at_port, rotor_inertia
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import SceneError, read_scene
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.read import read_scene_text
from fmu_bearing.scene.words import bearings_words, materials_words
from tests.conftest import ROOT
from tests.messages import says

FILE = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"
PAIR = read_scene(FILE)
SMALL = {"spindle.bearing[2].bearing": "NSK-7002C"}
STEEL = {"spindle.bearing[2].materials.balls": "GCr15"}


def numbers(scene):
    """Parameters of a silent run of full."""
    return prepare(scene, fidelity="full").parameters


def test_each_bearing_has_its_own_tables_and_the_scenes_otherwise():
    found = PAIR.replace(SMALL | STEEL)
    first, second = (one.scene for one in found.bearings())
    assert [one.designation for one in found.geometries] == ["7003C", "NSK-7002C"]
    assert (first.bearing, first.materials) == (PAIR.bearing, PAIR.materials)
    assert second.bearing == read_scene(FILE).replace({"bearing.catalogue": "NSK-7002C"}).bearing
    assert second.materials.kind == "steel" and second.materials.inner_ring == PAIR.materials.inner_ring
    assert found.differing and not PAIR.differing
    # what a file has and what replaces another entry
    assert read_scene_text(found.to_toml()) == found
    other = found.replace({"spindle.bearing[2].bearing.catalogue": "NSK-7902C"})
    assert other.geometries[1].designation == "NSK-7902C" and other.geometries[1].width_mm == 7.0


def test_own_tables_that_are_equal_to_the_scenes_change_no_number():
    own = {f"spindle.bearing[2].{key}": getattr(PAIR, key).model_dump() for key in ("bearing", "materials")}
    found = PAIR.replace(own)
    assert not found.differing and np.array_equal(numbers(found), numbers(PAIR))
    names = [[one.name for one in prepare(one).variables] for one in (found, PAIR)]
    assert names[0] == names[1]


def test_parameters_of_each_are_those_of_its_own_size():
    p = numbers(PAIR.replace(SMALL))
    alone = numbers(PAIR.replace({"bearing.catalogue": "NSK-7002C"}))
    parts = []
    for one in (p, alone):
        row = one[SP.first(one, SP.AT_ROWS) + SP.ROW :]
        parts.append(one[int(row[SP.ROW_P]) :][: int(row[SP.ROW_P_SIZE])])
    # all of the bearing's own numbers: balls, contacts, masses, cage
    assert parts[0].size == parts[1].size and np.array_equal(parts[0], parts[1])
    assert p[P.BALLS] == 12 and parts[0][P.BALLS] == PAIR.replace(SMALL).geometries[1].ball_count


def test_inertia_adds_up_over_rings_that_differ():
    found = PAIR.replace(SMALL)
    first, second = (inner_ring(one.scene) for one in found.bearings())
    mass, static, about = rings_at_port(found)
    # sums of two products: rounding
    assert mass == pytest.approx(first.mass + second.mass, rel=1e-14)
    assert static == pytest.approx(0.04 * first.mass + 0.09 * second.mass, rel=1e-14)
    turned = sum(one.transverse for one in (first, second)) + 0.04**2 * first.mass + 0.09**2 * second.mass
    assert about == pytest.approx(turned, rel=1e-14)
    without = rotor_inertia(PAIR) - 2.0 * first.polar
    assert rotor_inertia(found) == pytest.approx(without + first.polar + second.polar, rel=1e-13)


def test_words_name_each_kind_once():
    found = PAIR.replace(SMALL | STEEL)
    assert bearings_words(PAIR) == "2 x 7003C, DB (O)"
    assert bearings_words(found) == "1 x 7003C + 1 x NSK-7002C, DB (O)"
    assert materials_words(found).startswith("bearing 1 hybrid: ") and "bearing 2 steel: " in materials_words(
        found
    )


def test_origins_name_the_entry_of_a_bearings_own_table(tmp_path):
    text = FILE.read_text().replace(
        'carries = "-x"', 'carries = "-x"\nbearing = "NSK-7002C"\nmaterials.balls = "GCr15"'
    )
    (tmp_path / "a.toml").write_text(text)
    known = {one.key: one.origin for one in origins(tmp_path / "a.toml")}
    assert known["spindle.bearing[2].bearing.bore_mm"] == "catalogue NSK-7002C"
    assert known["spindle.bearing[2].materials.balls.density_kg_m3"] == "catalogue GCr15"
    assert known["bearing.bore_mm"] == "catalogue 7003C"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"spindle.bearing[2].bearing": "NSK-700C"}, "spindle.bearing[2].bearing.catalogue = 'NSK-700C'"),
        ({"spindle.bearing[1].bearing": "NSK-7002C", **SMALL}, "spindle.bearing: all have a geometry"),
        (
            {"spindle.bearing[1].materials.balls": "GCr15", **STEEL},
            "spindle.bearing: all have their own materials.balls",
        ),
        (
            {**SMALL, "spindle.preload.preload_class": "light"},
            "spindle.preload.preload_class is of equal bearings ... give preload_N",
        ),
        (
            {**SMALL, "spindle.bearing[2].position_mm": 49.0},
            "spindle.bearing[2].position_mm = 49 is 9 mm behind ... they are 10 and 9 mm wide",
        ),
        (
            {"spindle.bearing[2].bearing": {"catalogue": "NSK-7002C", "ball_count": 30}},
            "spindle.bearing[2].bearing.ball_count = 30 ... at most",
        ),
        (
            {
                **SMALL, "spindle.fit": {"preload": "unmounted", "shaft": {"interference_um": 33.0}},
                "spindle.bearing[2].shaft_interference_um": None,
            },
            "spindle.fit.shaft.interference_um ... spindle.bearing[2].bearing.bore_mm = 15",
        ),
        ({**SMALL, "operation.speed_rpm": 1.2e5}, "operation.speed_rpm = 120000"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_at_its_key(changes, words):
    with pytest.raises(SceneError) as caught:
        PAIR.replace(changes)
    assert any(says(line.removeprefix("7003C-DB: "), words) for line in str(caught.value).splitlines())
