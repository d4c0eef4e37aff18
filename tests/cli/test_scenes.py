"""scene new, check, show, catalogue."""

import re

import numpy as np
import pytest

from fmu_bearing import operating_point
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.entries import entries, entry_text
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.template import MATERIALS, new_scene
from tests.marks import heavy_but

KNOWN = ("--bearing", "7003C")
DIMENSIONS = ("--bore", 40, "--outside-diameter", 68, "--width", 15)


@pytest.mark.parametrize("bearing", heavy_but(["7003C", "7009C", "NSK-7008AC"], 0))
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


@pytest.mark.heavy
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
    assert "ball_diameter_mm = 8.12 # assumed: 0.29 of outside diameter minus bore" in text
    assert "inner_conformity = 0.52 # assumed" in text and "outer_conformity = 0.525 # assumed" in text
    shown = run("scene", "show", path, "--assumed", "--json").data
    assumed = {one["key"] for one in shown["values"]}
    assert {"bearing.ball_diameter_mm", "bearing.cage.bore_mm", "lubricant.viscosity_Pa_s"} <= assumed
    assert {"operation.speed_rpm", "mounting.preload_N", "operation.oil_temperature_degC"} <= assumed
    assert not {"bearing.bore_mm", "bearing.contact_angle_deg"} & assumed
    assert run("scene", "check", path).exit_code == 0


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("--bearing", "7003D"), "did you mean '7003C'"),
        (("--bearing", "7010C"), "did you mean 'NSK-7010C'? known: "),
        (("--bore", 40), "needs --bore, --outside-diameter and --width"),
        (("--bearing", "7003C", *DIMENSIONS), "not both"),
        (("--bore", 70, "--outside", 68, "--width", 15), "the outside diameter must exceed the bore"),
        ((), "give --bearing NAME (`fmu-bearing scene catalogue` lists them), or --bore,"),
        ((*KNOWN, "--kind", "glass"), "choose from steel, hybrid, full-ceramic"),
        ((*KNOWN, "--speed", 2e5), "speed_rpm = 200000.0 is refused; allowed: -100000 to 100000 r/min"),
        (
            (*DIMENSIONS, "--designation", "7008DU"),
            "'DU' is in no table of makers' signs: give them as",
        ),
        ((*KNOWN, "--grade", "P1"), "imperfections.grade"),
        ((*KNOWN, "--distance", 50), "--distance and --spring are of a set: give its --arrangement, as DB"),
        ((*KNOWN, "--arrangement", "db"), "there is no arrangement 'db': choose from DB, DF, DT, TBT"),
        ((*KNOWN, "--arrangement", "DB", "--distance", 5), "allowed: 10 (the width of a bearing) to 1000 mm"),
        ((*KNOWN, "--lubricant", "honey"), "spindle-oil"),
        ((*KNOWN, "--lubricant", "grease"), 'keep the oil, and give lubricant.supply = "grease" (`scene new'),
        ((*KNOWN, "--supply", "oil bath"), "there is no supply 'oil bath': did you mean"),
    ],
)
def test_new_refuses_in_a_line(run, tmp_path, arguments, reason):
    refused = run("scene", "new", tmp_path / "my.toml", *arguments)
    assert refused.exit_code == 2 and reason in refused.stderr
    assert refused.stderr.startswith("error: ") and refused.stderr.count("\n") == 1
    assert not (tmp_path / "my.toml").exists()


@pytest.mark.parametrize("arrangement", heavy_but(["DB", "DF", "DT", "QBC", "TBT"], "DB"))
def test_a_set_from_one_line_is_ready(run, tmp_path, monkeypatch, arrangement):
    """From an empty folder: written, checked, its figures those of the library, run, built."""
    monkeypatch.chdir(tmp_path)
    asked = ("--bearing", "NSK-7010C", "--arrangement", arrangement, "--preload-class", "medium")
    made = run("scene", "new", *asked, "--kind", "hybrid", "--speed", 18_000, "--no-sound")
    path = tmp_path / f"NSK-7010C-{arrangement}.toml"
    assert made.exit_code == 0 and f"written: {path.name}; " in made.stdout, made.output
    assert "assumed: spindle.shaft.sections_mm = [[16.0, 60.0, 0.0], " in made.stdout
    assert ("assumed: spindle.load.force_x_N = 780 N: 2 bearings, medium" in made.stdout) == (
        arrangement == "DT"
    )
    checked = run("scene", "check", path.name)
    assert checked.exit_code == 0 and "with an equilibrium at its operating point" in checked.stdout
    shown = run("info", path.name, "--json").data
    found = operating_point(read_scene(path))
    preloads = shown["statics"]["preloads_N"]
    assert preloads.keys() == found.statics.preloads.keys()
    for state, loads in found.statics.preloads.items():
        assert preloads[state] == pytest.approx(loads)
    assert shown["life_h"] == pytest.approx(found.life) and found.life > 20_000.0
    arguments = ("-t", 2e-4, "--step", 1e-4, "-v", "friction_torque", "-o", "r.csv")
    assert run("simulate", path.name, *arguments).exit_code == 0
    torque = np.genfromtxt("r.csv", delimiter=",", names=True)["friction_torque"]
    assert len(torque) == 3 and np.all(torque > 0.0)
    assert run("build", path.name, "--output", "set.fmu").exit_code == 0
    assert (tmp_path / "set.fmu").stat().st_size > 100_000


def test_new_fits_conformities_to_a_printed_stiffness(run, tmp_path):
    path = tmp_path / "fitted.toml"
    size = (
        "--bore",
        40,
        "--outside",
        68,
        "--width",
        15,
        "--kind",
        "steel",
        "--preload",
        300,
        "--speed",
        9000,
    )
    printed = ("--stiffness", 26.5, "--stiffness-preload", 125, "--stiffness-of", "bearing")
    result = run("scene", "new", path, *size, *printed)
    assert result.exit_code == 0
    words = "fitted to the stiffness given, 26.5 N/um of a bearing at 125 N"
    for race in ("inner", "outer"):
        assert re.search(rf"assumed: bearing.{race}_conformity = 0.5\d+: {words}", result.stdout)
    assert path.read_text("utf-8").count(words) == 2
    # a pair has twice the stiffness: the same grooves
    pair = tmp_path / "pair.toml"
    assert run("scene", "new", pair, *size, "--stiffness", 53, "--stiffness-preload", 125).exit_code == 0
    grooves = [read_scene(one).bearing.inner_conformity for one in (path, pair)]
    assert grooves[0] == grooves[1]
    for wrong, reason in (
        (("--stiffness", 53), "give --stiffness and --stiffness-preload together"),
        (("--stiffness-preload", 125), "give --stiffness and --stiffness-preload together"),
        (("--stiffness", 530, "--stiffness-preload", 125), "conformities of 0.505 to 0.6 give 34."),
        ((*printed[:-1], "trio"), "a stiffness is of a pair or a bearing, not of 'trio'"),
    ):
        refused = run("scene", "new", tmp_path / "no.toml", *size, *wrong)
        assert refused.exit_code == 2 and reason in refused.stderr
    assert not (tmp_path / "no.toml").exists()


def test_new_replaces_nothing_unasked(run, tmp_path):
    path = tmp_path / "my.toml"
    path.write_text("mine")
    refused = run("scene", "new", path, *KNOWN)
    assert refused.exit_code == 2 and "--force" in refused.stderr and path.read_text() == "mine"
    given = ("--speed", 20000, "--preload", 100)  # what is not given is searched for: a second
    made = run("scene", "new", path, "--force", "--json", *KNOWN, *given)
    assert made.exit_code == 0 and made.data["file"] == str(path) and made.data["cautions"] == []
    assumed = {one.key: one.value for one in origins(path) if one.assumed}
    assert {one["key"]: one["value"] for one in made.data["assumed"]} == assumed and assumed


@pytest.mark.heavy
def test_new_says_what_is_not_good(run, tmp_path):
    """A quarter of the least preload at this speed is written, for it was asked for, and cautioned of."""
    path = tmp_path / "my.toml"
    asked = ("--bearing", "NSK-7010C", "--no-sound", "--speed", 20000)
    made = run("scene", "new", path, *asked, "--preload", 20)
    assert made.exit_code == 0
    assert path.exists()
    cautions = [line for line in made.stderr.splitlines() if line.startswith("caution: ")]
    assert any("preload" in line for line in cautions), made.stderr
    good = run("scene", "new", tmp_path / "good.toml", *asked[:3])
    assert good.exit_code == 0
    assert "caution" not in good.stderr


def test_check_reports_every_problem_and_ends_with_one(run, silent_file, tmp_path):
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
        "contact pressure", "rating life L10r", "preload 500 N (0.084 C)",
    ]  # fmt: skip
    assert not data[str(faulty)]["ok"] and len(data[str(faulty)]["findings"]) == 2


def test_check_reports_a_scene_without_equilibrium_and_one_to_look_at(run, silent_file, tmp_path):
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


def test_show_reports_where_values_come_from(run, tmp_path):
    path = tmp_path / "my.toml"
    run("scene", "new", path, "--bearing", "7003C", "--preload", 300)
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
    rows = run("scene", "catalogue", "--json").data
    assert len(rows) == 95 and rows["NSK-7003C"]["ball_count"] == 12
    one = run("scene", "catalogue", "bearings", "NSK-7003C").stdout
    assert "ball_count = 12 # assumed: derived from C, C0 and f0" in one
    assert "# preload heavy: 150 N, pair 45 N/um" in one and "# C_N = 6600" in one
    large = run("scene", "catalogue", "bearings", "NSK-7913C").stdout
    assert "ball_count = 25 # assumed: derived from C, C0 and f0" in large and "# C_N = 20200" in large
    data = run("scene", "catalogue", "bearings", "NSK-7003AC", "--json").data
    assert data["values"]["contact_angle_deg"] == 25.0 and "f0" not in data["printed"]
    assert data["printed"]["preload"]["light"] == {"force_N": 49.0, "pair_stiffness_N_um": 52.0}
    deep = run("scene", "catalogue", "bearings", "6205").stdout
    assert 'kind = "deep-groove"' in deep and "# C_N = 14000" in deep and "# C0_N = 7850" in deep
    refused = run("scene", "catalogue", "bearings", "NSK-7003")
    assert refused.exit_code == 2 and "lists them" in refused.stderr
    assert run("scene", "catalogue", "materials", "--json").data["Si3N4"]["density_kg_m3"] == 3200.0
    refused = run("scene", "catalogue", "cars")
    assert refused.exit_code == 2 and "bearings, materials, lubricants, grades" in refused.stderr


def test_a_makers_size_says_what_of_it_is_print(run, tmp_path):
    path = tmp_path / "my.toml"
    run("scene", "new", path, "--bearing", "NSK-7003C", "--preload-class", "heavy", "--kind", "steel")
    assert "# sizes and angle are NSK's print; balls are derived, all else is assumed" in path.read_text()
    values = {one["key"]: one for one in run("scene", "show", path, "--json").data["values"]}
    bore, balls = values["bearing.bore_mm"], values["bearing.ball_count"]
    assert bore["remark"] == "maker's print (NSK)" and not bore["assumed"]
    assert balls["assumed"] and balls["remark"].startswith("derived from C, C0 and f0 (NSK)")
    assert balls["origin"] == "catalogue NSK-7003C"
    assert values["mounting.preload_N"]["value"] == 150.0
    assert values["mounting.preload_N"]["remark"] == "heavy class of NSK: 150 N"
    # the maker's heaviest class lies within makers' limits: at its limiting speed there is nothing to caution
    found = run("scene", "check", path)
    assert found.exit_code == 0 and "shoulder" not in found.stdout and "GMN" not in found.stdout
    show = run("scene", "show", path, "--assumed").stdout
    assert "bearing.ball_count" in show and "bearing.cage.bore_mm" in show and "bearing.bore_mm" not in show


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (
            (*KNOWN, "--preload", 100, "--preload-class", "light"),
            "give one of --preload, --preload-class, --preload-offset and --spring",
        ),
        ((*KNOWN, "--preload-class", "enormous"), "allowed: light, medium, heavy"),
        ((*KNOWN, "--preload-offset", -1), "allowed: 0 to 200 um"),
    ],
)
def test_new_refuses_preloads(run, tmp_path, arguments, reason):
    refused = run("scene", "new", tmp_path / "my.toml", *arguments)
    assert refused.exit_code == 2 and reason in refused.stderr and refused.stderr.count("\n") == 1


@pytest.fixture
def own(tmp_path):
    """A catalogue of one's own, and a scene that names its bearing but not the file."""
    text = entry_text(entries("bearings")["NSK-7003C"], "NSK-7003C")
    file, scene = tmp_path / "own.toml", tmp_path / "scenes" / "my.toml"
    file.write_text(text.replace("NSK-7003C", "OWN").replace("ball_count = 12", "ball_count = 11"))
    scene.parent.mkdir()
    scene.write_text(new_scene("my", "NSK-7003C", sound=False).replace("NSK-7003C", "OWN"))
    return file, scene


def test_new_writes_a_deep_groove_bearing(run, tmp_path):
    path = tmp_path / "motor.toml"
    made = run("scene", "new", path, "--bearing", "6205", "--clearance", "C3", "--radial-load", 500)
    assert made.exit_code == 0 and "preload = 0" not in made.stdout + made.stderr
    values = {one["key"]: one["value"] for one in run("scene", "show", path, "--json").data["values"]}
    assert values["bearing.kind"] == "deep-groove" and values["bearing.clearance"] == "C3"
    assert (values["mounting.radial_load_z_N"], values["mounting.preload_N"]) == (-500.0, 0.0)
    for given, words in (
        (("--bearing", "NSK-7008C", "--clearance", "C3"), "is of a deep groove bearing"),
        (("--bearing", "6205-2RS"), "did you mean '6205'"),
    ):
        refused = run("scene", "new", tmp_path / "other.toml", *given)
        assert refused.exit_code == 2 and words in refused.stderr


def test_new_writes_the_supply(run, tmp_path):
    """NSK prints limits of a 7010C with grease and with oil: half of each is the assumed speed."""
    printed = sizes()["NSK-7010C"]
    for given, supply, limit in (
        ((), "oil-air", printed.oil_speed),
        (("grease",), "grease", printed.grease_speed),
    ):
        path = tmp_path / f"{supply}.toml"
        made = run(
            "scene",
            "new",
            path,
            "--bearing",
            "NSK-7010C",
            "--no-sound",
            *(("--supply", *given) if given else ()),
        )
        assert made.exit_code == 0
        assert ("assumed: lubricant.supply = oil-air" in made.stdout) == (not given)
        values = {one["key"]: one for one in run("scene", "show", path, "--json").data["values"]}
        assert values["lubricant.supply"]["value"] == supply
        assert values["lubricant.supply"]["assumed"] == (not given)
        assert values["operation.speed_rpm"]["value"] == pytest.approx(0.5 * limit, rel=5e-3)


def test_catalogue_suggests_the_nearest(run):
    refused = run("scene", "catalogue", "bearings", "7010C")
    assert refused.exit_code == 2 and refused.stderr == (
        "error: there is no '7010C' among the bearings: did you mean 'NSK-7010C'? "
        "`fmu-bearing scene catalogue bearings` lists them\n"
    )


def test_commands_take_catalogues_of_ones_own(run, own, tmp_path):
    file, scene = own
    refused = run("info", scene)
    assert refused.exit_code == 2 and "bearing.catalogue = 'OWN' is not in the catalogue" in refused.stderr
    found = run("info", scene, "--catalogue", file)
    assert found.exit_code == 0 and "OWN" in found.stdout
    values = {
        one["key"]: one for one in run("scene", "show", scene, "--catalogue", file, "--json").data["values"]
    }
    assert values["bearing.ball_count"]["value"] == 11
    assert values["bearing.ball_count"]["origin"] == "catalogue OWN of own.toml"
    assert run("scene", "check", scene, "--catalogue", file).exit_code == 0
    assert "OWN" in run("scene", "catalogue", "--catalogue", file, "--json").data
    result = tmp_path / "r.csv"
    arguments = ("-t", 2e-4, "--step", 1e-4, "-v", "friction_torque", "-o", result)
    assert run("simulate", scene, "--catalogue", file, *arguments).exit_code == 0
    # an option holds for its command alone
    assert run("scene", "check", scene).exit_code == 1


def test_a_new_scene_names_the_file_of_its_bearing(run, own):
    file, scene = own
    made = run("scene", "new", scene, "--force", "--catalogue", file, "--bearing", "OWN")
    assert made.exit_code == 0, made.output
    assert 'catalogues = ["../own.toml"]' in scene.read_text()
    assert run("scene", "check", scene).exit_code == 0 and read_scene(scene).bearing.ball_count == 11


def test_a_catalogue_that_is_not_there_is_refused(run, own):
    _, scene = own
    for command in (("info", scene), ("scene", "catalogue"), ("scene", "new", scene, *KNOWN, "--force")):
        refused = run(*command, "--catalogue", "nowhere.toml")
        assert refused.exit_code == 2 and refused.stderr.count("\n") == 1
        assert "nowhere.toml: there is no such catalogue file" in refused.stderr


def test_check_reads_the_table_of_transfer_functions(run, scene_file, tmp_path):
    """Also one outside the scene's folder; it is compared with the scene as a run does."""
    table, file = tmp_path / "elsewhere" / "housing.npz", tmp_path / "scenes" / "scene.toml"
    table.parent.mkdir(), file.parent.mkdir()
    places = np.array([place for _, place in read_scene(scene_file).microphones])
    good = {
        "frequencies": np.linspace(0.0, 20_000.0, 201),
        "inputs": np.array(["outer_ring.acceleration.y"]),
        "microphones": np.array([f"P{k}" for k in range(1, len(places) + 1)]),
        "positions": places,
        "H": np.ones((len(places), 1, 201), dtype=complex),
    }
    scene = read_scene(scene_file).replace({"sound.radiation_model": "table", "sound.table_file": "t.npz"})
    file.write_text(scene.to_toml().replace('"t.npz"', '"../elsewhere/housing.npz"'))
    for changes, said in (
        (None, f"sound.table_file {table}: there is no such file"),
        ({"H": good["H"][:1]}, f"sound.table_file {table}: H has the shape"),
        ({"positions": places + 0.1}, "microphone 'P1' is at"),
        ({"inputs": np.array(["outer_rng.acceleration.y"])}, "'outer_rng.acceleration.y' is not an input"),
        ({}, "a scene, with an equilibrium"),
    ):
        if changes is not None:
            np.savez(table, **good | changes)
        done = run("scene", "check", file)
        assert done.exit_code == (0 if changes == {} else 1), done.output
        assert said in done.output
    table.write_text("root:x:0:0")
    assert "is not a NumPy archive" in run("scene", "check", file).output


@pytest.mark.parametrize(
    ("designation", "file"), [("轴承/1", "轴承-1.toml"), ("...", "bearing.toml"), ("Öl", "Öl.toml")]
)
def test_new_names_the_file_after_a_designation_in_any_letters(run, tmp_path, monkeypatch, designation, file):
    monkeypatch.chdir(tmp_path)
    size = ("--bore", 17, "--outside", 35, "--width", 10, "--designation", designation)
    found = run("scene", "new", *size, "--speed", 20000, "--preload", 100)
    assert found.exit_code == 0, found.stderr
    assert read_scene(file).bearing.designation == designation


def test_new_takes_any_name_of_a_file(run, tmp_path):
    """What a scene's name cannot have becomes a dash."""
    file = tmp_path / "_my+scene (2).toml"
    options = ("--bearing", "7003C", "--speed", 20000, "--preload", 200)
    assert run("scene", "new", file, *options).exit_code == 0
    assert read_scene(file).name == "my-scene -2-"


@pytest.mark.heavy
@pytest.mark.parametrize("speed", [0, 50, -50, 99.9, 100])
@pytest.mark.parametrize(
    "more", [(), ("--arrangement", "DB"), ("--no-sound",)], ids=["one", "pair", "silent"]
)
def test_a_slow_scene_that_new_writes_passes_the_check(run, tmp_path, speed, more):
    """Where the speed does not decide the order of waves, the file says which one does."""
    path = tmp_path / "slow.toml"
    made = run("scene", "new", path, *KNOWN, f"--speed={speed}", "--preload", 200, *more)
    assert made.exit_code == 0, made.output
    found = run("scene", "check", path)
    assert found.exit_code == 0, found.output
    assert ("lowest_speed_rpm = 3000.0 # assumed" in path.read_text("utf-8")) == (abs(speed) < 100.0)


def test_new_from_ratings(run, tmp_path):
    """NSK's 7205BEA: 12 balls of 8.731 mm; by its dimensions alone 12 of 8.64 mm."""
    path = tmp_path / "my-7205B.toml"
    size = ("--bore", 25, "--outside-diameter", 52, "--width", 15, "--contact-angle", 40, "--kind", "steel")
    operation = ("--speed", 5000, "--preload", 300, "--json")
    made = run("scene", "new", path, *size, "--dynamic-rating", 16_700, "--static-rating", 10_200, *operation)
    assert made.exit_code == 0, made.output
    bearing = read_scene(path).bearing
    assert (bearing.ball_count, bearing.ball_diameter_mm) == (12, 8.731)
    refused = run("scene", "new", tmp_path / "b.toml", *size, "--dynamic-rating", 16_700, *operation)
    assert refused.exit_code == 2 and "--static-rating" in refused.stderr
    refused = run("scene", "new", tmp_path / "b.toml", *KNOWN, "--dynamic-rating", 16_700)
    assert refused.exit_code == 2 and "are for --bore" in refused.stderr
    refused = run("scene", "new", tmp_path / "b.toml", *KNOWN, "--contact-angle", 25)
    assert refused.exit_code == 2 and "--contact-angle is for --bore" in refused.stderr


@pytest.mark.heavy
def test_new_outside_the_data_of_its_rule(run, tmp_path):
    size = ("--bore", 40, "--outside-diameter", 52, "--width", 7)
    made = run("scene", "new", tmp_path / "a.toml", *size, "--speed", 5000, "--preload", 100)
    assert made.exit_code == 0 and "caution: the balls of a bearing of dimension series 18" in made.stderr
