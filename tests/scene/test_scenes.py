"""Example scenes, catalogue, ranges, microphones, and the way back to TOML."""

import math
import tomllib

import pytest
from hypothesis import given, strategies as st

from fmu_bearing.scene import Scene, read_scene, read_scene_text, si
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.lubricant import Lubricant
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.read import catalogue
from fmu_bearing.scene.sound import cylindrical
from fmu_bearing.scene.units import split_unit, symbol
from fmu_bearing.scene.values import limits
from tests.conftest import EXAMPLES, OWN_OIL

CATALOGUED = ["7003C-spindle", "7003C-bare", "7009C-full-ceramic", "7009C-steel"]
NAMES = [*CATALOGUED, "7003C-impact"]
MATERIALS = {
    "7003C-spindle": ("GCr15", "GCr15", "Si3N4", "bakelite"),
    "7003C-bare": ("GCr15", "GCr15", "Si3N4", "bakelite"),
    "7009C-full-ceramic": ("ZrO2", "ZrO2", "Si3N4", "PEEK"),
    "7009C-steel": ("GCr15", "GCr15", "GCr15", "PEEK"),
}
# what a scene of few lines still has to say
SHORT = """
name = "short"
[bearing]
catalogue = "7003C"
{bearing}
[materials]
inner_ring = "GCr15"
outer_ring = "GCr15"
balls = "Si3N4"
cage = "bakelite"
[lubricant]
catalogue = "spindle-oil"
{lubricant}
"""


def text_of(name):
    return (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")


def short(bearing="", lubricant=""):
    """A scene from the catalogue, with the mounting and the rest of the bare example."""
    rest = text_of("7003C-bare")
    return SHORT.format(bearing=bearing, lubricant=lubricant) + rest[rest.index("[mounting]") :]


def fields(model=Scene, path=()):
    """Every field of a scene with its place."""
    for key, field in model.model_fields.items():
        yield (*path, key), field
        for kind in (field.annotation, *getattr(field.annotation, "__args__", ())):
            if isinstance(kind, type) and hasattr(kind, "model_fields"):
                yield from fields(kind, (*path, key))


# --- models --------------------------------------------------------------------------------------


def test_every_field_is_described_and_bounded():
    found = list(fields())
    assert len(found) > 100
    for path, field in found:
        name, words = ".".join(path), field.description
        assert words and words.endswith(".") and words[0].isupper(), name
        if field.annotation in (int, float, float | None, int | None):
            rules = {end for rule in field.metadata for end in ("ge", "le") if hasattr(rule, end)}
            assert rules == {"ge", "le"}, name
            suffix = split_unit(path[-1])[1]
            if suffix:
                assert words.removesuffix(".").endswith(symbol(path[-1])), name
            (low,) = [rule.ge for rule in field.metadata if hasattr(rule, "ge")]
            (high,) = [rule.le for rule in field.metadata if hasattr(rule, "le")]
            assert all(low <= example <= high for example in field.examples), name
            assert limits(field) == (low, high), name
        elif field.annotation is str:
            assert limits(field) == (-math.inf, math.inf), name


# --- example scenes ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_example_pins_every_value(name):
    written = tomllib.loads(text_of(name))
    written["sound"].setdefault("microphone", [])
    for race in ("inner", "outer"):
        written["imperfections"].setdefault(f"{race}_race_harmonic", [])
    written["imperfections"].setdefault("defect", [])
    resolved = tomllib.loads(read_scene(EXAMPLES / f"{name}.toml").to_toml())
    assert written == resolved


@pytest.mark.parametrize("name", CATALOGUED)
def test_example_agrees_with_the_catalogue(name, example):
    read = example(name)
    assert read.name == name
    entry = catalogue("bearings")[read.bearing.designation]
    assert read.bearing == Bearing.model_validate(entry)
    assert read.lubricant == Lubricant.model_validate(catalogue("lubricants")["spindle-oil"] | OWN_OIL)
    made_of = (
        read.materials.inner_ring,
        read.materials.outer_ring,
        read.materials.balls,
        read.materials.cage,
    )
    entries = catalogue("materials")
    assert made_of == tuple(Material.model_validate(entries[material]) for material in MATERIALS[name])


def test_first_lateral_mode_of_the_spindle(example):
    # one mass on the pedestal: 467 Hz = 28,000 r/min, the paper's critical speed. 1 %: the scene's stiffness
    # is rounded, and the bearing's own radial stiffness is in series.
    spindle = example("7003C-spindle")
    b, mounting = si(spindle.bearing), si(spindle.mounting)
    section = math.pi / 4 * (b.outside_diameter**2 - b.outer_ring_inner_diameter**2)
    section += math.pi / 4 * (b.inner_ring_outer_diameter**2 - b.bore**2)
    rings = section * b.width * si(spindle.materials.inner_ring).density
    mass = rings + si(spindle.mounting.housing).mass + si(spindle.mounting.rotor).mass
    assert math.sqrt(mounting.pedestal_stiffness / mass) / (2 * math.pi) == pytest.approx(467.0, rel=0.01)


def test_rotor_of_the_spindle_is_a_steel_cylinder(example):
    rotor = si(example("7003C-spindle").mounting.rotor)
    density = rotor.mass / (math.pi / 4 * rotor.diameter**2 * rotor.length)
    assert density == pytest.approx(7850.0, rel=0.01)  # the diameter is rounded to 0.1 mm


def test_shaft_of_the_spindle_weighs_about_half_a_kilogram(example):
    # thirds of 28, 23 and 15 mm thickness (the paper's Table 1); the rest of the rotor is the motor's
    shaft = 7850.0 * 0.1795 * math.pi / 4 * (0.028**2 + 0.023**2 + 0.015**2) / 3
    assert shaft == pytest.approx(0.5, abs=0.1)
    assert 1.0 <= example("7003C-spindle").mounting.rotor.mass_kg <= 1.5


def test_points_of_the_multi_source_paper(example):
    spindle = example("7003C-spindle")
    assert [tuple(place) for place in spindle.microphones] == [
        ("P1", (0.0, 0.105, 0.0)),
        ("P2", (0.0, 0.15, 0.0)),
        ("P3", (0.0, 0.0, 0.105)),
        ("P4", (-0.0805, 0.0, 0.0)),
    ]
    # section 4.1: P4 is 75.5 mm from the bearing's end face; section 4.2: 60 mm from the spindle's front
    bearing, housing = spindle.bearing, spindle.mounting.housing
    face = -bearing.width_mm / 2
    assert face - spindle.sound.microphone[3].x_mm == pytest.approx(75.5)
    assert face - housing.front_face_mm - spindle.sound.microphone[3].x_mm == pytest.approx(60.0)
    # section 4.2: P1 is 55 mm from the spindle's outer surface
    assert spindle.sound.microphone[0].y_mm - housing.diameter_mm / 2 == pytest.approx(55.0)


def test_points_of_the_sound_field_paper(example):
    places = example("7009C-full-ceramic").microphones
    assert [place.name for place in places] == [f"{15 * k} deg" for k in range(24)]
    assert places[0].position_m == (0.05, 0.0, 0.21)
    assert places[6].position_m == (0.05, -0.21, 0.0)  # y = -r sin(theta): no rounding left at 90 degrees
    assert places[12].position_m == (0.05, 0.0, -0.21)
    assert {round(math.hypot(*place.position_m[1:]), 12) for place in places} == {0.21}


def test_what_the_scenes_leave_out(example):
    bare, spindle, ceramic = (example(name) for name in ("7003C-bare", "7003C-spindle", "7009C-full-ceramic"))
    for lone in (bare, ceramic):
        assert lone.mounting.rotor is lone.mounting.housing is lone.mounting.tilt_support is None
        assert lone.sound.radiator == "bare"
        assert lone.mounting.pedestal_stiffness_N_m == 1e8
    assert bare.mounting.flexure is spindle.mounting.flexure is None
    flexure = ceramic.mounting.flexure
    assert (flexure.outer_ring, flexure.inner_ring) == ((2, 3, 4, 5), (2, 3))
    assert bare.bearing == spindle.bearing
    assert bare.sound.microphone == spindle.sound.microphone
    assert bare.imperfections == spindle.imperfections == ceramic.imperfections


def test_steel_twin_differs_in_name_and_materials_alone(example):
    ceramic, steel = example("7009C-full-ceramic"), example("7009C-steel")
    assert steel.materials.cage == ceramic.materials.cage
    same = {"name": ceramic.name, "materials": ceramic.materials}
    assert steel.model_copy(update=same) == ceramic


def test_assumptions_of_the_impact_paper(example):
    bare, impact = example("7003C-bare"), example("7003C-impact")
    assert impact.bearing.cage is None and impact.materials.cage is None
    assert impact.bearing.ball_springs.stiffness_N_m == 2.5e7  # what the paper keeps
    assert impact.bearing.ball_springs.damping_N_s_m == 0.0
    same = {"cage": bare.bearing.cage, "ball_springs": None}
    assert impact.bearing.model_copy(update=same) == bare.bearing
    assert impact.materials.balls == bare.materials.balls
    assert impact.lubricant.traction_max == 0.0  # no friction
    on = {name for name, value in impact.fidelity.terms if value}
    assert on == {"contact_damping"}
    assert impact.imperfections.unbalance_um == 0.0
    # the outer ring is held: its own mass on the pedestal swings beyond all sound
    b, mounting = si(impact.bearing), si(impact.mounting)
    section = math.pi / 4 * (b.outside_diameter**2 - b.outer_ring_inner_diameter**2)
    mass = section * b.width * si(impact.materials.outer_ring).density
    assert math.sqrt(mounting.pedestal_stiffness / mass) / (2 * math.pi) > 1e5
    assert [tuple(place) for place in impact.microphones] == [("above", (0.0, 0.0, 0.1))]


# --- catalogue -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "model"), [("bearings", Bearing), ("materials", Material), ("lubricants", Lubricant)]
)
def test_every_catalogue_entry_is_valid(kind, model):
    for name, entry in catalogue(kind).items():
        assert model.model_validate(entry), name


def test_scene_from_the_catalogue_equals_the_example():
    bare = read_scene(EXAMPLES / "7003C-bare.toml")
    own = "\n".join(f"{key} = {value!r}" for key, value in OWN_OIL.items())
    assert read_scene_text(short(lubricant=own)) == bare.model_copy(update={"name": "short"})


def test_keys_of_the_file_win():
    scene = read_scene_text(short("cage = { width_mm = 9.0 }\nball_count = 11", "density_kg_m3 = 900"))
    assert scene.bearing.cage.width_mm == 9.0
    assert scene.bearing.cage.bore_mm == 23.4
    assert scene.bearing.ball_count == 11
    assert scene.lubricant.density_kg_m3 == 900.0


def test_material_may_start_from_an_entry():
    text = short().replace('balls = "Si3N4"', 'balls = { catalogue = "Si3N4", density_kg_m3 = 3250 }')
    balls = read_scene_text(text).materials.balls
    assert (balls.density_kg_m3, balls.youngs_modulus_GPa) == (3250.0, 310.0)


@pytest.mark.parametrize("bearing", ["cage = false", ""])
def test_the_catalogues_cage_can_be_left_out(bearing):
    scene = read_scene_text(short(bearing))
    assert (scene.bearing.cage is None) == bool(bearing)
    assert read_scene_text(scene.to_toml()) == scene


# --- microphones ---------------------------------------------------------------------------------


@given(st.floats(-720, 720), st.floats(0, 1e4), st.floats(-1e4, 1e4))
def test_cylindrical_places(theta, r, length):
    x, y, z = cylindrical(theta, r, length)
    assert x == length / 1e3
    # sine and cosine are rounded at 15 decimals
    assert y == pytest.approx(-r / 1e3 * math.sin(math.radians(theta)), abs=2e-15 * r + 1e-300)
    assert z == pytest.approx(r / 1e3 * math.cos(math.radians(theta)), abs=2e-15 * r + 1e-300)


def test_both_ways_to_give_a_place():
    text = text_of("7003C-bare")
    other = text.replace("x_mm = 0.0\ny_mm = 105.0\nz_mm = 0.0", "theta_deg = -90\nr_mm = 105\nl_mm = 0")
    assert other != text
    assert read_scene_text(other).microphones == read_scene_text(text).microphones


def test_points_and_circle_add_up():
    text = (
        text_of("7009C-full-ceramic")
        + '\n[[sound.microphone]]\nname = "front"\nx_mm = 100\ny_mm = 0\nz_mm = 0\n'
    )
    names = [place.name for place in read_scene_text(text).microphones]
    assert names[:2] == ["front", "0 deg"]
    assert len(names) == 25


@pytest.mark.parametrize("count", [1, 7, 360])
def test_names_on_a_circle_differ(count):
    text = text_of("7009C-full-ceramic").replace("count = 24", f"count = {count}")
    assert len({place.name for place in read_scene_text(text).microphones}) == count


# --- the way back --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_written_scene_reads_back_equal(name, example):
    text = example(name).to_toml()
    again = read_scene_text(text, name)
    assert again == example(name)
    assert again.to_toml() == text


@given(
    st.floats(1.0, 1e4),
    st.floats(1e4, 1e12),
    st.integers(0, 2**31 - 1),
    st.text("aZ09_.,+()/ -éß", min_size=1, max_size=40),
    st.booleans(),
)
def test_written_scene_keeps_every_bit(preload, stiffness, seed, microphone, gravity):
    data = tomllib.loads(text_of("7003C-bare"))
    data["mounting"] |= {"preload_N": preload, "pedestal_stiffness_N_m": stiffness}
    data["imperfections"]["seed"] = seed
    data["sound"]["microphone"][0]["name"] = microphone
    data["fidelity"]["terms"]["gravity"] = gravity
    scene = Scene.model_validate(data)
    assert read_scene_text(scene.to_toml()) == scene


def test_scene_without_optional_tables(example):
    perfect = example("7003C-bare").model_copy(update={"imperfections": None, "sound": None})
    again = read_scene_text(perfect.to_toml())
    assert again == perfect
    assert again.microphones == []
