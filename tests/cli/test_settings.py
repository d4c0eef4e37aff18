"""--set, --speed and --fidelity: keys and inputs of the model, in every command that takes a scene."""

import json
import math
import re

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import cli, operating_point, read_scene
from fmu_bearing.cli.base import Refusal
from fmu_bearing.cli.settings import changed, source_of, start_of
from fmu_bearing.interface.inputs import input_values, inputs_of
from fmu_bearing.run.simulate import simulate
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import EXAMPLES, GATES, ROOT

FILES = {"one": EXAMPLES / "7003C-spindle.toml", "set": ROOT / "examples" / "spindle_set" / "7003C-DB.toml"}
#: Values in SI units that every input of the two scenes allows.
VALUES = {"rad/s": 1234.5, "N": 123.0, "N/m": 2.5e7, "K": 311.0}
#: Inputs of a set that no key holds: the load is given at a place of its own, the oil for all bearings.
WITHOUT_KEY = {
    "nose.force.x", "nose.force.y", "nose.force.z", "nose.moment.y", "nose.moment.z",
    "bearing[1].oil_temperature", "bearing[2].oil_temperature",
}  # fmt: skip


@pytest.mark.parametrize("kind", FILES)
def test_an_input_becomes_the_key_behind_it(kind):
    scene = read_scene(FILES[kind])
    for one in inputs_of(scene):
        value, name = VALUES.get(one.unit, 0.0), one.name
        if one.unit == "rad/s":  # speeds are given in r/min
            value, name = value * 30.0 / math.pi, f"{name}_rpm"
        setting = [f"{name}={value!r}"]
        if one.name in WITHOUT_KEY:
            with pytest.raises(Refusal, match="no key of the scene holds this input; simulate, modes"):
                source_of(FILES[kind], setting)
            continue
        made = input_values(source_of(FILES[kind], setting))
        assert made[one.index] == pytest.approx(VALUES[one.unit], rel=1e-12), one.name
    assert kind == "one" or WITHOUT_KEY < {one.name for one in inputs_of(scene)}


def test_a_load_at_the_nose_has_its_key():
    settings = ["spindle.load.position_mm=0", "nose.force.z=-77"]
    made = source_of(FILES["set"], settings)
    assert made.spindle.load.force_z_N == -77.0
    (place,) = [one.index for one in inputs_of(made) if one.name == "nose.force.z"]
    assert input_values(made)[place] == -77.0


def test_inputs_take_the_units_of_input_files():
    scene = read_scene(FILES["one"])
    _, found = changed(scene, ["shaft_speed_rpm=9000", "oil_temperature_degC=30", "preload=200"])
    assert found == pytest.approx(
        {"shaft_speed": 9000 * np.pi / 30, "oil_temperature": 303.15, "preload": 200}
    )
    kept, none = changed(scene, ["operation.speed_rpm=9000", "lubricant.catalogue='spindle-oil'"])
    assert kept.operation.speed_rpm == 9000 and none == {}


def test_without_any_the_file_is_taken_as_it_is():
    assert source_of(FILES["one"], None) == FILES["one"]
    assert source_of(FILES["one"], [], "rings").fidelity.model == "rings"


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("shaft_speed_rmp=9000", "did you mean shaft_speed_rpm?"),
        ("shaft_spede=900", "did you mean shaft_speed_rpm?"),
        ("shaft_speed=900", "speeds are given in r/min here: shaft_speed_rpm=900 or --speed 900"),
        ("preload_class=light", "did you mean mounting.preload_class?"),
        ("prelaod=3", "did you mean preload (N)?"),
        ("radial_laod.z=3", "did you mean radial_load.z (N)?"),
        ("speed_rpm=3", "did you mean operation.speed_rpm?"),
        ("speed=9000", "did you mean operation.speed_rpm?"),
        ("n=9000", "did you mean operation.speed_rpm?"),
        ("xyz=3", "keys have their table, as mounting.preload_N"),
        ("preload=much", "write a number, as preload=300"),
        ("preload", "write KEY=VALUE"),
        ("fmu.outputs=[torque]", '--set \'fmu.outputs=["first", "second"]\', numbers as [1.0, 2.0]'),
        ("=3", "write KEY=VALUE"),
    ],
)
def test_a_name_that_is_none_is_refused_with_the_nearest(setting, words):
    with pytest.raises(Refusal) as refused:
        source_of(FILES["one"], [setting])
    assert str(refused.value).startswith(f"--set {setting}: ") and words in str(refused.value)


def test_the_nearest_is_of_such_a_scene():
    """A set has no mounting: its preload is in another table."""
    with pytest.raises(Refusal, match=r"did you mean spindle\.preload\.preload_N\?"):
        source_of(FILES["set"], ["preload=300"])
    with pytest.raises(Refusal, match=r"did you mean spindle\.preload\.preload_class\?"):
        source_of(FILES["set"], ["preload_class=light"])


def test_an_fmu_takes_the_names_that_its_scene_takes():
    units = {"shaft_speed": "rad/s", "preload": "N"}
    found = start_of(["shaft_speed_rpm=9000", "preload=300", "rough=2"], units, ["rough"])
    assert found == pytest.approx({"shaft_speed": 9000.0 * math.pi / 30.0, "preload": 300.0, "rough": 2.0})
    with pytest.raises(Refusal, match=r"shaft_speed_rpm=9000 or --speed 9000"):
        start_of(["shaft_speed=9000"], units, [])
    with pytest.raises(ValueError, match="did you mean 'shaft_speed_rpm'"):
        start_of(["shaft_spede=9000"], units, [])


def test_a_list_is_written_as_in_a_file():
    scene = source_of(FILES["one"], ['fmu.outputs=["friction_torque", "mic[1].leq"]'])
    assert scene.fmu.outputs == ("friction_torque", "mic[1].leq")
    sections = source_of(
        FILES["set"], ["spindle.shaft.sections_mm=[[300, 40.0, 0.0]]"]
    ).spindle.shaft.sections_mm
    assert [list(one) for one in sections] == [[300.0, 40.0, 0.0]]


def test_a_key_that_is_none_is_refused_by_the_scene():
    with pytest.raises(SceneError, match="did you mean 'preload_N'"):
        source_of(FILES["one"], ["mounting.prelaod_N=300"])


@pytest.mark.parametrize("option", [("--set", "preload=3"), ("--fidelity", "rings")])
def test_a_finished_run_cannot_be_changed(option, run, tmp_path):
    for name in ("a.npz", "a.csv"):
        refused = run("sound", tmp_path / name, *option, "-o", tmp_path / "out")
        assert refused.exit_code == 2 and f"{option[0]} is refused: " in refused.stderr
    refused = run("simulate", tmp_path / "a.fmu", "--fidelity", "rings", "-o", tmp_path / "run.csv")
    assert refused.exit_code == 2 and "was settled when it was built" in refused.stderr


def test_simulate_sets_keys_inputs_parameters_and_leaves_out_what_settles(run, rings_file, tmp_path):
    target, settings = tmp_path / "run.csv", ("mounting.preload_N=300", "radial_load.z=-20", "tolerance=2e-3")
    done = run(
        "simulate", rings_file, "-t", 4e-3, "--settle", 2e-3, "-v", "friction_torque", "-o", target, "--json",
        "--plot", tmp_path / "run.png", *(word for one in settings for word in ("--set", one)),
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    scene = read_scene(rings_file).replace({"mounting.preload_N": 300})
    own = simulate(
        scene, 4e-3, start_values={"radial_load.z": -20.0, "tolerance": 2e-3}, outputs=["friction_torque"]
    )
    assert done.data["points"] == 3 and done.data["files"] == [str(target), str(tmp_path / "run.png")]
    assert done.data["last"]["friction_torque"]["value"] == own["friction_torque"][-1]
    assert (tmp_path / "run.png").read_bytes().startswith(b"\x89PNG")
    refused = run("simulate", rings_file, "-t", 1e-3, "--settle", 1e-3, "-o", tmp_path / "new.csv")
    assert refused.exit_code == 2 and "--settle 0.001 s is refused" in refused.stderr


def test_info_at_another_point_has_the_librarys_figures():
    file = GATES / "7003C-bare.toml"
    words = ["info", str(file), "--speed", "9000", "--set", "preload=300", "--json"]
    done = CliRunner().invoke(cli.app, words)
    assert done.exit_code == 0, done.output
    own = operating_point(
        read_scene(file).replace({"mounting.preload_N": 300, "operation.speed_rpm": 9000})
    ).summary()
    found = json.loads(done.stdout)["bearings"][0]
    assert found["friction_torque_N_m"] == own["bearings"][0]["friction_torque_N_m"]
    assert found["friction_torque_N_m"] > 0.0


@pytest.mark.heavy
def test_what_is_computed_of_a_scene_is_of_what_was_set(run, rings_file, tmp_path, monkeypatch):
    """Each command hands the scene with the values set to the library; the library is not run here."""
    expected = with_fidelity(
        read_scene(rings_file).replace({"mounting.preload_N": 300, "operation.speed_rpm": 9000}), model="full"
    )
    words = ["--set", "preload=300", "--set", "operation.speed_rpm=9000"]
    seen = []

    def stop(source, *arguments, **options):
        seen.append(source)
        raise ValueError("seen")

    folder = ["-o", tmp_path / "out"]
    plain = with_fidelity(expected, model="rings")
    measured = tmp_path / "measured.csv"
    measured.write_text("microphone\n")
    for place, command, scene in (
        ("fmu_bearing.run.choose.chosen", ["choose"], plain),
        ("fmu_bearing.accuracy.tradeoff.tradeoff", ["tradeoff", *folder], plain),
        ("fmu_bearing.accuracy.sensitivity.sensitivity", ["sensitivity", *folder], plain),
        ("fmu_bearing.run.realtime.realtime", ["realtime"], plain),
        ("fmu_bearing.design.operating_point.operating_point", ["info"], plain),
        ("fmu_bearing.identification.identify", ["identify", measured, "-o", tmp_path / "i.toml"], plain),
        ("fmu_bearing.accuracy.changes.changes", ["changes", "--fidelity", "full"], expected),
        ("fmu_bearing.run.build.build_fmu", ["build", "--fidelity", "full"], expected),
        ("fmu_bearing.reports.make", ["report", "--fidelity", "full", "-o", tmp_path / "r.html"], expected),
        ("fmu_bearing.recording.record.record", ["sound", "--fidelity", "full", *folder], expected),
        (
            "fmu_bearing.sweeps.plan.plan",
            ["sweep", "-a", "seed=1,2", "--fidelity", "full", *folder],
            expected,
        ),
        ("fmu_bearing.recording.studies.compare.compare", ["compare", rings_file], plain),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(place, stop)
            refused = run(command[0], rings_file, *command[1:], *words)
        assert refused.stderr == "error: seen\n", (command, refused.output)
        assert seen.pop() == scene, command
    assert {path.name for path in tmp_path.iterdir()} == {"measured.csv"}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ("--set", "mounting.preload_N=150,5"),
            "--set mounting.preload_N=150,5: .* write mounting.preload_N=150.5",
        ),
        (
            ("--stop-time", "0,5"),
            "'--stop-time' / '-t': .*valid number, with a point where it is decimal, as 0.5",
        ),
        (
            ("--speed", "20000,0"),
            "'--speed': .*valid number, with a point where it is decimal, as 0.5",
        ),
    ],
)
def test_decimal_commas_are_named(run, rings_file, words, said):
    found = run("simulate", rings_file, *words)
    assert found.exit_code == 2 and re.search(said, found.stderr)
