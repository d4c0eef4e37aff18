"""What is wrong with keys and values is reported in its own words, all of it, one line each."""

import re
import tomllib

import pytest

from fmu_bearing.engine.layout import MAX_BALLS
from fmu_bearing.scene import Scene, SceneError, read_scene_text
from fmu_bearing.scene.bearing import Bearing, most_balls
from tests.messages import says
from tests.scene.refusals import TEXT, problems

# --- one key -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "shown", "allowed"),
    [
        ("preload_N = 500.0", "preload_N = -1", "-1", "0 to 10000 N, twice the static rating"),
        ("preload_N = 500.0", "preload_N = 1000001", "1000001", "-1e+06 to 1e+06 N"),
        ("preload_N = 500.0", "preload_N = nan", "nan", "-1e+06 to 1e+06 N"),
        ("preload_N = 500.0", "preload_N = -inf", "-inf", "-1e+06 to 1e+06 N"),
        ("preload_N = 500.0", 'preload_N = "500"', "'500'", "-1e+06 to 1e+06 N"),
        ("preload_N = 500.0", "preload_N = true", "true", "-1e+06 to 1e+06 N"),
        ("preload_N = 500.0", "preload_N = [500.0]", "an array", "-1e+06 to 1e+06 N"),
        ("preload_N = 500.0", "preload_N = 2020-01-01", "2020-01-01", "-1e+06 to 1e+06 N"),
        ("preload_N = 500.0", f"preload_N = 1{'0' * 400}", "1" + "0" * 56 + "...", "-1e+06 to"),
        ("speed_rpm = 20000.0", "speed_rpm = 100001", "100001", "-100000 to 100000 r/min"),
        ("ball_count = 12", "ball_count = 37", "37", "3 to 36, whole numbers only"),
        ("ball_count = 12", "ball_count = 12.5", "12.5", "3 to 36, whole numbers only"),
        ("seed = 1", "seed = 2147483648", "2147483648", "0 to 2147483647, whole numbers only"),
        ("gravity = true", "gravity = 1", "1", "true or false"),
        (
            'radiation_model = "bem"',
            'radiation_model = "fem"',
            "'fem'",
            "paper, paper_vector, paper_contacts, compact, bem",
        ),
        ('radiation_model = "bem"', "radiation_model = 2", "2", "paper, paper_vector"),
        ('model = "full"', 'model = "ring"', "'ring'", "full, rings, response, auto"),
        ('method = "esdirk4"', 'method = "bdf"', "'bdf'", "esdirk4, trbdf2, rk4"),
        ('race_control = "shared"', 'race_control = "both"', "'both'", "shared, outer, inner"),
        ("level_dB = 1.0", "level_dB = 0", "0", "0.01 to 40 dB"),
        ("relative = 0.1", "relative = 2", "2", "0.001 to 1"),
        ("rolling_reduction = true", "rolling_reduction = 0.5", "0.5", "true or false"),
        ("contact_damping = true", 'contact_damping = "yes"', "'yes'", "true or false"),
        ("pocket_friction = true", "pocket_friction = 0.05", "0.05", "true or false"),
        (
            'traction_law = "regularised"',
            'traction_law = "coulomb"',
            "'coulomb'",
            "regularised, eyring, paper",
        ),
        ("eyring_stress_MPa = 5.0", "eyring_stress_MPa = 0", "0", "0.1 to 100 MPa"),
        ('viscosity_law = "vogel"', 'viscosity_law = "roelands"', "'roelands'", "vogel, walther"),
        ("walther_slope = 5.53", "walther_slope = 9", "9", "0 to 8"),
        ('preload_mode = "force"', 'preload_mode = "soft"', "'soft'", "force, rigid"),
        ("misalignment_y_mrad = 0.0", "misalignment_y_mrad = 11", "11", "-10 to 10 mrad"),
        ("misalignment_z_mrad = 0.0", "misalignment_z_mrad = nan", "nan", "-10 to 10 mrad"),
        ("ball_waviness_nm = 0.0", "ball_waviness_nm = -1", "-1", "0 to 5000 nm"),
        ("ball_waviness_order = 2", "ball_waviness_order = 9", "9", "1 to 8, whole numbers only"),
        ("lowest_order = 2", "lowest_order = 2.5", "2.5", "1 to 1000, whole numbers only"),
        ("density_kg_m3 = 870.0", "density_kg_m3 = 0", "0", "500 to 2000 kg/m3"),
        ("expansion_1e6_K = 11.8", "expansion_1e6_K = 1e9", "1000000000.0", "0 to 200 1e-6/K"),
        ("x_mm = -80.5", "x_mm = 1e9", "1000000000.0", "-100000 to 100000 mm"),
        ('name = "P1"', 'name = "P\\n1"', r"'P\n1'", "text of 1 to 40 letters"),
        ('name = "P1"', 'name = ""', "''", "text of 1 to 40 letters"),
        ('name = "7003C-spindle"', 'name = "a/b"', "'a/b'", "text of 1 to 60 letters"),
        ('name = "7003C-spindle"', "name = 3", "3", "text of 1 to 60 letters"),
    ],
)
def test_value_is_repeated_with_what_is_allowed(old, new, shown, allowed):
    (line,) = problems((old, new))
    key = new.split(" = ")[0]
    assert re.match(rf"(\w+(\[\d\])?\.)*{key} = ", line)
    assert f"{key} = {shown} is refused; allowed: {allowed}" in line


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("bearing = 3\n", "bearing = 3 is refused; allowed: a table [bearing]"),
        ("[materials]\nballs = 3\n", "balls = 3 is refused; allowed: a table [materials.balls], or the name"),
        ("[sound]\nmicrophone = 3\n", "microphone = 3 is refused; allowed: at most 360 tables"),
        ("[[sound.microphone]]\n", "sound.microphone[1].name is missing, for example name = "),
    ],
)
def test_tables_of_the_wrong_shape(text, expected):
    assert any(expected in line for line in problems(text=text))


@pytest.mark.parametrize("number", [17, 17.0])
def test_whole_numbers_serve_as_numbers(number):
    scene = read_scene_text(TEXT.replace("bore_mm = 17.0", f"bore_mm = {number}"))
    assert isinstance(scene.bearing.bore_mm, float)


def test_missing_key_shows_an_example_and_its_meaning():
    (line,) = problems(("preload_N = 500.0", ""))
    assert line.startswith("mounting.preload_N is missing, for example preload_N = 500.0 (Axial force")


def test_missing_key_of_a_bearing_points_to_the_catalogue():
    (line,) = problems(("width_mm = 10.0", ""))
    assert "bearing.width_mm is missing" in line
    assert 'catalogue = "7003C"' in line


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        (
            "preload_N = ",
            "prelaod_N = ",
            "mounting.prelaod_N is not a key of a scene; did you mean 'preload_N'?",
        ),
        ("bore_mm = 17.0", "bore = 17.0", "bearing.bore is not a key of a scene; did you mean 'bore_mm'?"),
        ("[operation]", "[operatoin]", "operatoin is not a key of a scene; did you mean 'operation'?"),
        ("[bearing.cage]", "[bearing.cagee]", "bearing.cagee is not a key of a scene; did you mean 'cage'?"),
        (
            "bore_mm = 23.4",
            "bore_m = 23.4",
            "bearing.cage.bore_m is not a key of a scene; did you mean 'bore_mm'?",
        ),
    ],
)
def test_misspelt_key_names_the_nearest(old, new, hint):
    assert hint in problems((old, new))


def test_key_in_the_wrong_table_is_sent_home():
    lines = problems(("preload_N = 500.0", "preload_N = 500.0\nspeed_rpm = 3.0"))
    assert lines == ["mounting.speed_rpm is not a key of a scene; it belongs in [operation]"]


def test_key_like_no_other_lists_the_known_ones():
    (line,) = problems(("seed = 1", "seed = 1\nqqq = 2"))
    assert "imperfections.qqq is not a key of a scene; known here: seed, unbalance_um" in line


def test_every_problem_has_its_line():
    lines = problems(
        ("bore_mm = 17.0", "bore_mm = -1"),
        ("ball_count = 12", "ball_count = 99"),
        ("preload_N = 500.0", "preload = 500.0"),
        ("speed_rpm = 20000.0", ""),
    )
    assert len(lines) == 5
    assert [line.split()[0] for line in lines[:2]] == ["bearing.bore_mm", "bearing.ball_count"]


# --- catalogue -----------------------------------------------------------------------------------


def test_unknown_catalogue_names_are_all_reported_and_nothing_beneath_them():
    data = tomllib.loads(TEXT)
    for name in "bearing materials lubricant".split():
        assert name in data
    text = (
        'name = "a"\n[bearing]\ncatalogue = "7003D"\n[lubricant]\ncatalogue = 3\n'
        '[materials]\ninner_ring = "gcr15"\nouter_ring = "GCr15"\nballs = "glass"\n'
        + TEXT[TEXT.index("[mounting]") :]
    )
    lines = problems(text=text)
    expected = (
        "bearing.catalogue = '7003D' ... '7003C' ... 7003C, 7009C, 60 from NSK-7900C on ... scene catalogue`",
        "lubricant.catalogue = 3 ... spindle-oil",
        "materials.inner_ring = 'gcr15' ... 'GCr15' ... GCr15, Si3N4, ZrO2, bakelite, PEEK, aluminium",
        "materials.balls = 'glass' ... GCr15, Si3N4, ZrO2, bakelite, PEEK, aluminium",
    )
    assert all(map(says, lines, expected)) and len(lines) == len(expected), lines


def test_misspelt_catalogue_key():
    lines = problems(("[lubricant]", '[lubricant]\ncatalog = "spindle-oil"'))
    assert lines == ["lubricant.catalog is not a key of a scene; did you mean 'catalogue'?"]


# --- what does not fit together ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("bore_mm = 23.4", "bore_mm = 22.6", "bearing.cage.bore_mm = 22.6 must exceed 22.68"),
        ("bore_mm = 23.4", "bore_mm = 27.7", "bearing.cage.bore_mm = 27.7 must be below outside"),
        ("e_diameter_mm = 27.6", "e_diameter_mm = 29.6", "must be below outer_ring_inner_diameter_mm = 29.6"),
        # of the ring that guides the cage the clearance counts
        (
            'guidance = "inner"\noutside_diameter_mm = 27.6\n',
            'guidance = "outer"\noutside_diameter_mm = 29.55\n',
            "29.55 must be below outer_ring_inner_diameter_mm less twice the land's clearance, 29.52",
        ),
        (
            'guidance = "inner"\n',
            'guidance = "balls"\n',
            'cage.land_clearance_mm = 0.04 is of lands, which a cage with guidance = "balls" does not have',
        ),
        ("pocket_diameter_mm = 4.6", "pocket_diameter_mm = 4.5", "must exceed ball_diameter_mm = 4.5"),
        ("pocket_diameter_mm = 4.6", "pocket_diameter_mm = 9.2", "must be below width_mm = 9.1"),
        ("pocket_diameter_mm = 4.6", "pocket_diameter_mm = 6.8", "makes 12 pockets overlap"),
        # 23.4 sin(15 deg) = 6.056: apart on the pitch circle, where 6.73 mm fit, and one at the bore
        (
            "pocket_diameter_mm = 4.6",
            "pocket_diameter_mm = 6.2",
            "12 pockets ... 23.4 mm ... 6.056 mm apart ... smaller than 6.056 ... cage.bore_mm above 23.95 "
            "... at most 11 balls",
        ),
        ("width_mm = 9.1", "width_mm = 10.1", "bearing.cage.width_mm = 10.1 must not exceed"),
        (
            "pitch_diameter_mm = 26.0",
            "pitch_diameter_mm = 22.6",
            "inner_ring_outer_diameter_mm = 22.6 mu",
        ),
        ("pitch_diameter_mm = 26.0", "pitch_diameter_mm = 28.0", "between the cage's bore and outside diam"),
        ("bore_mm = 17.0", "bore_mm = 22.0", "bearing.ball_diameter_mm = 4.5 must be below 4"),
        ("outside_diameter_mm = 35.0", "outside_diameter_mm = 29.0", "outer_ring_inner_diameter_mm = 29.6"),
        ("ball_count = 12", "ball_count = 19", "ball_count = 19 ... at most 18 balls of 4.5 mm"),
        ("highest_order = 20", "highest_order = 1", "must not be below lowest_order = 2"),
        ("traction_strips = 5", "traction_strips = 4", "traction_strips = 4 must be 1, 3 or 5"),
        ("diameter_mm = 100.0", "diameter_mm = 35.0", "must exceed bearing.outside_diameter_mm = 35"),
        ("[materials.cage]", "[materials.nothing]", "materials.nothing is not a key of a scene"),
        ('name = "P1"', 'name = "P2"', "sound ... names must differ ... P2"),
        ("y_mm = 105.0\n", "", "sound.microphone[1] ... 'P1' has x_mm, z_mm ... give x_mm, y_mm, z_mm"),
        (
            "y_mm = 105.0\n",
            "y_mm = 105.0\nr_mm = 1.0\n",
            "microphone 'P1' has x_mm, y_mm, z_mm, r_mm: give",
        ),
        ("y_mm = 105.0\n", "y_mm = 49.9\n", "'P1' ... r = 49.9 mm ... inside the housing"),
        ("y_mm = 105.0\n", "y_mm = 50.0\n", "'P1' ... r = 50 mm ... on the housing"),
        (
            "y_mm = 105.0\n",
            "y_mm = 49.0\n",
            "1 mm below ... r above 50, or to x below -20.5 or above 139.5",
        ),
        (
            "x_mm = -80.5\n",
            "x_mm = -20.4\n",
            "'P4' at x = -20.4, r = 0 mm ... inside the housing",
        ),
    ],
)
def test_values_that_do_not_fit_each_other(old, new, expected):
    lines = problems((old, new))
    assert any(says(line, expected) for line in lines), lines


def test_cage_needs_a_material():
    start, end = TEXT.index("[materials.cage]"), TEXT.index("[lubricant]")
    lines = problems(text=TEXT[:start] + TEXT[end:])
    assert lines == ['materials.cage is missing, for example cage = "bakelite"; the bearing has one']


def test_radiating_housing_must_exist():
    start, end = TEXT.index("[mounting.housing]"), TEXT.index("# Standard imperfections")
    lines = problems(text=TEXT[:start] + TEXT[end:])
    assert lines == ["sound.radiator = 'housing' needs a table [mounting.housing]"]


def test_bare_bearing_is_its_own_envelope():
    bare = TEXT.replace('radiator = "housing"', 'radiator = "bare"').replace("y_mm = 105.0", "y_mm = 17.4")
    (line,) = problems(text=bare)
    assert "inside the bearing, which reaches to r = 17.5 mm from x = -5 to 5 mm" in line
    read_scene_text(bare.replace("y_mm = 17.4", "y_mm = 17.6"))


def test_sound_without_microphones_is_refused():
    (line,) = problems(text=TEXT[: TEXT.index("[[sound.microphone]]")])
    assert line.startswith("sound: no microphone is given: add [[sound.microphone]] or [sound.circle]")


def test_conflicts_of_several_tables_come_together():
    lines = problems(
        ("ball_count = 12", "ball_count = 19"),
        ("traction_strips = 5", "traction_strips = 2"),
        ("highest_order = 20", "highest_order = 1"),
    )
    assert len(lines) == 3


def test_most_balls_a_pitch_circle_takes():
    # six discs around a seventh touch each other: chord = ball at 30 degrees half angle
    assert most_balls(2.0, 1.0) == 6
    assert most_balls(2.0, 1.0001) == 5
    assert most_balls(1.0, 1.0) == 1


def test_engine_has_room_for_as_many_balls_as_a_scene():
    (limit,) = [rule.le for rule in Bearing.model_fields["ball_count"].metadata if hasattr(rule, "le")]
    assert limit == MAX_BALLS


def test_scene_is_frozen(scene):
    with pytest.raises(ValueError, match="frozen"):
        scene("7003C-bare").name = "other"
    assert isinstance(scene("7003C-bare"), Scene)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("preload_N = 150,0 # light", "preload_N = 150,0: .*: write 150.0"),
        ("x = 1.000,5", "x = 1.000,5: .*: write 1000.5"),
        ("x = -1,5e3", "x = -1,5e3: .*: write -1.5e3"),
        ("x = ,5", "x = ,5: .*: write 0.5"),
        ("x = 20,000", "x = 20,000: .* write 20.000, or 20000"),
        ("t = { x = 1,5, y = 2 }", "x = 1,5: .*: write 1.5"),
        ("x = 20 000", "x = 20 000: .*: write 20000"),
        ("x = 1 250 000 # by blanks", "x = 1 250 000: .*: write 1250000"),
        ("x = 50 mm", "x = 50 mm: .* unit .* write 50"),
        ("x = 5%", "x = 5 %: .* unit"),
        ("x = 40 degC # warm", "x = 40 degC: .* unit"),
    ],
)
def test_numbers_as_people_write_them(line, words):
    with pytest.raises(SceneError, match=f"not valid TOML: line 2: {words}"):
        read_scene_text(f"# 1,5 mm = 2 mm\n{line}\n")


@pytest.mark.parametrize("line", ["x = hello", "x = 1.5.2", "x =", "x = 07"])
def test_what_is_no_number_keeps_the_message_of_its_place(line):
    with pytest.raises(SceneError, match=r"not valid TOML: .* \(at line 1, column \d+\)"):
        read_scene_text(f"{line}\n")
