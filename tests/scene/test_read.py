"""Scene files: what is read, and what is reported when something is wrong."""

import pytest

from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import SceneError, read_scene, read_scene_text
from fmu_bearing.scene.read import catalogue
from tests.conftest import EXAMPLES, GATES, OWN_OIL

NAMES = ["7003C-spindle", "7003C-bare", "7009C-full-ceramic"]


def text(name="7003C-bare"):
    return (GATES / f"{name}.toml").read_text()


def refused(changed):
    with pytest.raises(SceneError) as caught:
        read_scene_text(changed, "my.toml")
    message = str(caught.value)
    assert all(line.startswith("my.toml: ") for line in message.splitlines())
    assert "Traceback" not in message and "pydantic" not in message
    return message


@pytest.mark.parametrize("name", NAMES)
def test_examples_read_and_survive_the_way_through_toml(name):
    scene = read_scene(EXAMPLES / f"{name}.toml")
    assert scene.name == name
    assert read_scene_text(scene.to_toml()) == scene
    assert read_scene_text(scene.to_toml()).to_toml() == scene.to_toml()


@pytest.mark.parametrize("name", NAMES)
def test_examples_agree_with_the_catalogue(name):
    scene = read_scene(EXAMPLES / f"{name}.toml")
    entry = {"kind": "angular-contact"} | catalogue("bearings")[name.split("-")[0]]
    assert scene.bearing.model_dump(exclude_none=True) == entry
    materials, ceramic = catalogue("materials"), name == "7009C-full-ceramic"
    ring, cage = ("ZrO2", "PEEK") if ceramic else ("GCr15", "bakelite")
    for part, material in (("inner_ring", ring), ("outer_ring", ring), ("balls", "Si3N4"), ("cage", cage)):
        assert getattr(scene.materials, part).model_dump(exclude_none=True) == materials[material], part
    assert scene.lubricant.model_dump(exclude_none=True) == catalogue("lubricants")["spindle-oil"] | OWN_OIL


def test_materials_of_the_catalogue_have_these_values():
    """Modulus (GPa), Poisson's ratio, density (kg/m3), expansion (1e-6/K), W/(m K), J/(kg K)."""
    values = {
        "GCr15": (208.0, 0.3, 7800.0, 11.8, 46.0, 460.0),
        "Si3N4": (310.0, 0.26, 3200.0, 3.2, 25.0, 700.0),
        "ZrO2": (210.0, 0.3, 6000.0, 10.5, 2.5, 450.0),
        "aluminium": (70.0, 0.33, 2700.0, 23.4),
        "bakelite": (8.0, 0.35, 1400.0, 30.0),
        "PEEK": (3.8, 0.39, 1310.0, 47.0),
        "tungsten-carbide": (580.0, 0.22, 14400.0, 5.5),
    }
    keys = ("youngs_modulus_GPa", "poisson_ratio", "density_kg_m3", "expansion_1e6_K")
    keys += ("conductivity_W_mK", "specific_heat_J_kgK")
    # zip ends with the shorter one: bodies that no ball touches have four
    wanted = {name: dict(zip(keys, row, strict=False)) for name, row in values.items()}
    assert catalogue("materials") == wanted


def test_table_1_of_the_papers(example):
    b = example("7003C-bare").bearing
    assert (b.bore_mm, b.outside_diameter_mm, b.width_mm, b.pitch_diameter_mm) == (17.0, 35.0, 10.0, 26.0)
    assert (b.ball_diameter_mm, b.ball_count, b.contact_angle_deg) == (4.5, 12, 15.0)
    c = b.cage
    assert (c.outside_diameter_mm, c.bore_mm, c.width_mm, c.pocket_diameter_mm) == (27.6, 23.4, 9.1, 4.6)
    b = example("7009C-full-ceramic").bearing
    assert (b.bore_mm, b.outside_diameter_mm, b.width_mm) == (45.0, 75.0, 16.0)
    assert (b.ball_diameter_mm, b.ball_count, b.contact_angle_deg) == (8.731, 17, 15.0)
    c = b.cage
    assert (c.outside_diameter_mm, c.width_mm, c.pocket_diameter_mm) == (63.5, 14.0, 8.9)


def test_microphones_of_the_papers(example):
    points = dict(example("7003C-spindle").microphones)
    assert points == {
        "P1": pytest.approx((0.0, 0.105, 0.0)),
        "P2": pytest.approx((0.0, 0.150, 0.0)),
        "P3": pytest.approx((0.0, 0.0, 0.105)),
        "P4": pytest.approx((-0.0805, 0.0, 0.0)),
    }
    circle = example("7009C-full-ceramic").microphones
    assert len(circle) == 24
    assert circle[0][1] == pytest.approx((0.05, 0.0, 0.21))  # 12 o'clock
    assert circle[6][1] == pytest.approx((0.05, -0.21, 0.0))  # 90 degrees with positive rotation: -Y


def test_a_catalogue_name_fills_what_the_file_leaves_out():
    short = text().replace('designation = "7003C"\n', 'catalogue = "7003C"\nbore_mm = 16.0\n', 1)
    begin, end = short.index("bore_mm = 17.0"), short.index("[materials")
    scene = read_scene_text(short[:begin] + short[end:])
    assert scene.bearing.bore_mm == 16.0 and scene.bearing.ball_count == 12
    assert scene.bearing.cage.pocket_diameter_mm == 4.6


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("bore_mm = 17.0", "boer_mm = 17.0", ["bearing.boer_mm", "did you mean 'bore_mm'?"]),
        ("bore_mm = 17.0\n", "", ["bearing.bore_mm is missing, for example bore_mm = 17.0"]),
        ("ball_count = 12", "ball_count = 99", ["bearing.ball_count = 99", "allowed: 3 to 36"]),
        ("ball_count = 12", "ball_count = 12.5", ["bearing.ball_count = 12.5", "allowed: 3 to 36"]),
        ("preload_N = 500.0", "preload_N = nan", ["mounting.preload_N = nan", "allowed: -1e+06 to 1e+06"]),
        ("preload_N = 500.0", "preload_N = inf", ["mounting.preload_N = inf", "allowed: -1e+06 to 1e+06"]),
        ("preload_N = 500.0", 'preload_N = "x"', ["mounting.preload_N = 'x'", "allowed: -1e+06 to 1e+06"]),
        ("= 1e8 #", "= 0 #", ["mounting.pedestal_stiffness_N_m = 0", "allowed: 10000 to 1e+12"]),
        (
            'radiation_model = "bem"',
            'radiation_model = "fem"',
            ["sound.radiation_model = 'fem'", "allowed: paper, paper_vector"],
        ),
        (
            'radiation_model = "bem"',
            'radiation_model = "table"',
            ["sound.table_file is missing", '"housing.npz"'],
        ),
        (
            'radiation_model = "bem"',
            'radiation_model = "bem"\ntable_file = "a.npz"',
            ["sound.table_file = 'a.npz' is read", 'radiation_model = "table" only'],
        ),
        (
            'radiation_model = "bem"\nradiator = "bare"',
            'radiation_model = "compact"\nradiator = "baffle"',
            [
                "sound.radiator = 'baffle' is refused",
                'give `sound.radiation_model` = "bem"',
                "only boundary elements have rigid planes",
            ],
        ),
        (
            'radiation_model = "bem"\nradiator = "bare"',
            'radiation_model = "compact"\nradiator = "bare"\nreflecting_plane_mm = -50.0',
            ["sound.reflecting_plane_mm = -50.0 is refused", '`sound.radiation_model` = "bem"'],
        ),
        (
            'radiation_model = "bem"',
            'radiation_model = "bem"\nreflecting_plane_mm = -50.0',
            ["sound.reflecting_plane_mm = -50.0 is between", "microphone 'P4' at x = -80.5 mm"],
        ),
        (
            'radiation_model = "bem"',
            'radiation_model = "bem"\nreflecting_plane_mm = 4.0',
            ["sound.reflecting_plane_mm = 4.0 cuts the bearing", "x = -5 to 5 mm"],
        ),
        (
            "third_octaves = false",
            "third_octaves = 1",
            ["sound.third_octaves = 1", "true or false"],
        ),
        ("[mounting]", "[mountin]", ["did you mean 'mounting'?", "mounting is missing"]),
        ("ball_diameter_mm = 4.5", "ball_diameter_mm = 9.0", ["ball_count = 12 does not fit", "at most 8"]),
        ("z_mm = 105.0", "z_mm = 1.0", ["microphone 'P3'", "inside the bearing", "r = 17.5 mm"]),
        ('name = "P2"\nx_mm', 'name = "P2"\nl_mm', ["microphone 'P2'", "theta_deg, r_mm, l_mm"]),
        ('name = "P2"', 'name = "P1"', ["microphone names must differ: P1"]),
        ('radiator = "bare"', 'radiator = "housing"', ["needs a table [mounting.housing]"]),
        ("[materials.balls]", "[materials.bals]", ["did you mean 'balls'?", "materials.balls is missing"]),
    ],
)
def test_errors_name_key_value_range_and_the_way_out(old, new, expected):
    assert old in text()
    message = refused(text().replace(old, new))
    for part in expected:
        assert part in message


def test_unknown_catalogue_names_offer_the_nearest():
    message = refused(text().replace('designation = "7003C"', 'catalogue = "7003c"'))
    assert "bearing.catalogue = '7003c'" in message and "did you mean '7003C'?" in message


def test_broken_toml_and_missing_files():
    assert "not valid TOML" in refused(text() + "\n= 3")
    with pytest.raises(SceneError, match="nowhere.toml: there is no such scene file"):
        read_scene("nowhere.toml")


def test_scenes_are_frozen(scene):
    with pytest.raises(ValueError, match="frozen"):
        scene("7003C-bare").bearing.bore_mm = 18.0


def test_a_table_is_sought_beside_the_scene(tmp_path):
    """Its path counts from the scene file, and one that is not there is refused in one line."""
    new = text().replace(
        'radiation_model = "bem"', 'radiation_model = "table"\ntable_file = "sub/housing.npz"'
    )
    file = tmp_path / "scene.toml"
    file.write_text(new, "utf-8")
    found = read_scene(file)
    assert found.sound.table_file == str((tmp_path / "sub" / "housing.npz").resolve())
    assert read_scene_text(found.to_toml()) == found
    with pytest.raises(SceneError, match="table_file .*housing.npz: there is no such file") as refusal:
        prepare(found)
    assert len(str(refusal.value).splitlines()) == 1
