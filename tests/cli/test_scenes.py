"""scene new, check, show, catalogue."""

import pytest

from fmu_bearing.scene import read_scene
from fmu_bearing.scene.read import catalogue
from fmu_bearing.scene.template import MATERIALS

DIMENSIONS = ("--bore", 40, "--outside-diameter", 68, "--width", 15)


@pytest.mark.parametrize("bearing", sorted(catalogue("bearings")))
@pytest.mark.parametrize("kind", sorted(MATERIALS))
def test_new_from_the_catalogue(run, tmp_path, bearing, kind):
    path = tmp_path / "my.toml"
    made = run(
        "scene", "new", path, "--bearing", bearing, "--kind", kind, "--speed", 9000, "--preload", 250,
        "--grade", "P5",
    )  # fmt: skip
    assert made.exit_code == 0 and "values are assumed" in made.stdout
    scene = read_scene(path)
    assert scene.bearing.designation == bearing and scene.operation.speed_rpm == 9000.0
    assert scene.mounting.preload_N == 250.0 and len(scene.microphones) == 4
    density = 3200.0 if kind != "steel" else 7800.0
    assert scene.materials.balls.density_kg_m3 == density


def test_new_from_dimensions_estimates_the_rest_and_says_so(run, tmp_path):
    path = tmp_path / "my-7008C.toml"
    made = run("scene", "new", path, *DIMENSIONS, "--designation", "7008C", "--no-sound")
    assert made.exit_code == 0, made.output
    scene = read_scene(path)
    bearing = scene.bearing
    assert bearing.designation == "7008C" and scene.sound is None
    # a maker's 7008C has balls of 7.9 mm and 17 to 19 of them: the rules are no better than this
    assert bearing.pitch_diameter_mm == 54.0
    assert bearing.ball_diameter_mm == pytest.approx(7.938, rel=0.1)
    assert 14 <= bearing.ball_count <= 19
    text = path.read_text()
    assert "ball_diameter_mm = 7.56 # assumed: 0.27 of outside diameter less bore" in text
    shown = run("scene", "show", path, "--assumed", "--json").data
    assumed = {one["key"] for one in shown["values"]}
    assert {"bearing.ball_diameter_mm", "bearing.cage.bore_mm", "lubricant.viscosity_Pa_s"} <= assumed
    assert not {"bearing.bore_mm", "bearing.contact_angle_deg", "operation.speed_rpm"} & assumed
    assert run("scene", "check", path).exit_code == 0


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("--bearing", "7003D"), "did you mean '7003C'"),
        (("--bore", 40), "needs --bore, --outside-diameter and --width"),
        (("--bearing", "7003C", *DIMENSIONS), "not both"),
        (("--bore", 70, "--outside", 68, "--width", 15), "the outside diameter must exceed the bore"),
        (("--kind", "glass"), "choose from steel, hybrid, full-ceramic"),
        (("--speed", 2e5), "operation.speed_rpm = 200000.0 is refused; allowed: -100000 to 100000 r/min"),
        (("--grade", "P1"), "imperfections.grade"),
        (("--lubricant", "honey"), "spindle-oil"),
    ],
)
def test_new_refuses_in_a_line(run, tmp_path, arguments, reason):
    refused = run("scene", "new", tmp_path / "my.toml", *arguments)
    assert refused.exit_code == 2 and reason in refused.stderr
    assert refused.stderr.startswith("error: ") and refused.stderr.count("\n") == 1
    assert not (tmp_path / "my.toml").exists()


def test_new_replaces_nothing_unasked(run, tmp_path):
    path = tmp_path / "my.toml"
    path.write_text("mine")
    refused = run("scene", "new", path)
    assert refused.exit_code == 2 and "--force" in refused.stderr and path.read_text() == "mine"
    assert run("scene", "new", path, "--force").exit_code == 0


def test_check_tells_every_problem_and_ends_with_one(run, silent_file, tmp_path):
    faulty = tmp_path / "faulty.toml"
    text = silent_file.read_text()
    faulty.write_text(
        text.replace("ball_count = 12", "ball_count = 99").replace("bore_mm = 17", "bore_mm = -1")
    )
    found = run("scene", "check", silent_file, faulty)
    assert found.exit_code == 1
    assert "silent.toml: a scene, with an equilibrium" in found.stdout
    assert "bearing.ball_count = 99" in found.stderr and "bearing.bore_mm = -1" in found.stderr
    data = run("scene", "check", silent_file, faulty, "--json").data
    # 500 N on a 7003C passes makers' limits: cautions, not errors
    good = data[str(silent_file)]
    assert good["ok"] and [line.split(": ")[1].split(" 1")[0] for line in good["findings"]] == [
        "contact pressure", "preload 500 N",
    ]  # fmt: skip
    assert not data[str(faulty)]["ok"] and len(data[str(faulty)]["findings"]) == 2


def test_check_tells_a_scene_without_equilibrium_and_one_to_look_at(run, silent_file, tmp_path):
    text = silent_file.read_text()
    loose, full = tmp_path / "loose.toml", tmp_path / "full.toml"
    loose.write_text(
        text.replace("radial_load_z_N = 0.0", "radial_load_z_N = 3e3").replace(
            "pedestal_stiffness_N_m = 19700000.0", "pedestal_stiffness_N_m = 1e4"
        )
    )
    found = run("scene", "check", loose)
    assert found.exit_code == 1 and "give a stiffer pedestal or less radial load" in found.stderr
    full.write_text(text.replace("preload_N = 500.0", "preload_N = 5000.0"))
    found = run("scene", "check", full)
    assert found.exit_code == 0 and "beyond its shoulder" in found.stdout


def test_show_tells_where_values_come_from(run, tmp_path):
    path = tmp_path / "my.toml"
    run("scene", "new", path, "--bearing", "7003C")
    values = {one["key"]: one for one in run("scene", "show", path, "--json").data["values"]}
    assert values["bearing.ball_count"]["origin"] == "catalogue 7003C"
    assert values["imperfections.unbalance_um"]["origin"] == "grade P4"
    assert values["fidelity.tolerance"]["origin"] == "default"
    assert values["mounting.preload_N"] == {
        "key": "mounting.preload_N", "value": 300.0, "unit": "N", "origin": "file", "assumed": False,
        "remark": "", "allowed": "0 to 10000 N",
    }  # fmt: skip
    assert values["bearing.inner_conformity"]["assumed"] and values["imperfections.seed"]["assumed"]
    assert not values["materials.balls.density_kg_m3"]["assumed"]
    plain = run("scene", "show", path)
    assert "300 N" in plain.stdout and "catalogue 7003C" in plain.stdout and "memory" in plain.stdout


def test_catalogue(run):
    assert "7009C" in run("scene", "catalogue").stdout
    assert run("scene", "catalogue", "materials", "--json").data["Si3N4"]["density_kg_m3"] == 3200.0
    refused = run("scene", "catalogue", "cars")
    assert refused.exit_code == 2 and "bearings, materials, lubricants, grades" in refused.stderr
