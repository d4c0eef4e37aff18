"""build, choose, tradeoff, sensitivity: what they print, write and refuse."""

import math
import zipfile

import pytest

from fmu_bearing.run import choose as choosing
from fmu_bearing.run.choose import Choice, Probe
from fmu_bearing.run.metrics import Errors
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import GATES


@pytest.fixture
def auto_file(scene, tmp_path, monkeypatch):
    """A scene of fidelity auto whose choice is given, not probed."""
    found = with_fidelity(scene("7003C-spindle").model_copy(update={"sound": None}), model="auto")
    probe = Probe("full", "esdirk4", 1e-4, 1e-5, (Errors(0.0, 0.0, 0.0, 0.0, math.nan),), 1.0)
    choice = Choice(found.name, 1.0, 0.1, (probe, probe), 0)
    monkeypatch.setattr(choosing, "chosen", lambda scene: choice)
    path = tmp_path / "auto.toml"
    path.write_text(found.to_toml(), "utf-8")
    return path


@pytest.mark.parametrize(
    "command",
    ["build", "choose", "scene show", "sensitivity", "tradeoff", "simulate", "sound"],
)
def test_an_unknown_file_is_reported_in_one_line(run, command, tmp_path):
    result = run(*command.split(), tmp_path / "none.toml")
    assert result.exit_code == 2
    assert result.output.startswith("error: ") and "there is no such scene file" in result.output
    assert "Traceback" not in result.output and result.output.count("\n") == 1


def test_a_faulty_scene_is_reported_by_key(run, tmp_path):
    path = tmp_path / "faulty.toml"
    path.write_text((GATES / "7003C-bare.toml").read_text().replace("ball_count = 12", "ball_count = -3"))
    result = run("scene", "show", path)
    assert result.exit_code == 2 and "ball_count" in result.output and "Traceback" not in result.output


def test_what_a_scene_is_computed_with(run, silent_file, auto_file):
    reported = run("scene", "show", silent_file)
    assert reported.exit_code == 0
    assert "fidelity   full, method esdirk4" in reported.output and "sound      none" in reported.output
    assert "fidelity   auto, within 1 dB and 0.1" in run("scene", "show", auto_file).output


def test_build_of_a_scene_of_fidelity_auto_notes_the_choice(run, auto_file, tmp_path):
    result = run("build", auto_file, "-o", tmp_path / "auto.fmu")
    assert result.exit_code == 0, result.output
    assert "fidelity auto: full / esdirk4, internal steps up to 10 us" in result.output
    with zipfile.ZipFile(tmp_path / "auto.fmu") as fmu:
        assert b"fidelity auto: full / esdirk4" in fmu.read("documentation/index.html")
        assert b'model = "full"' in fmu.read("resources/scene.toml")


def test_choose_prints_table_and_reason(run, auto_file):
    result = run("choose", auto_file)
    assert result.exit_code == 0, result.output
    assert "chosen" in result.output and "fidelity auto: full / esdirk4" in result.output
    assert choosing.LEGEND in result.output
    data = run("choose", auto_file, "--json").data
    assert data["chosen"].startswith("fidelity auto: full / esdirk4") and len(data["candidates"]) == 2


@pytest.mark.heavy
def test_quick_studies_write_their_tables(run, silent_file, tmp_path):
    result = run("sensitivity", silent_file, "--quick", "-o", tmp_path, "--json")
    assert result.exit_code == 0, result.output
    assert {row["key"] for row in result.data["moves"]} >= {"lubricant.traction_max"}
    assert (tmp_path / "sensitivity.md").exists() and (tmp_path / "sensitivity.csv").exists()
    result = run("tradeoff", silent_file, "--quick", "-o", tmp_path)
    assert result.exit_code == 0, result.output
    assert {path.name for path in tmp_path.glob("tradeoff.*")} == {
        "tradeoff.csv",
        "tradeoff.md",
        "tradeoff.png",
    }


SEVERAL = (
    "--method", "morris", "--vary", "preload=100..300", "--vary", "viscosity=0.004..0.016log", "--quick",
    "--settle", "0", "--window", "0.001", "--workers", "1", "-v", "friction_torque,contact.inner.load_mean",
)  # fmt: skip


def test_sensitivity_to_several_values_writes_table_and_picture(run, silent_file, tmp_path):
    words = ("sensitivity", silent_file, *SEVERAL, "--set", "fidelity.model=rings", "-o", tmp_path)
    found = run(*words, "--plot", tmp_path / "bars.svg", "--json").data
    assert (found["method"], found["samples"]) == ("morris", 4)
    assert "fidelity rings" in found["conditions"] and "0.004 to 0.016 Pa s" in found["conditions"]
    rows = found["indices"]
    assert [row["figure"] for row in rows] == ["friction_torque"] * 2 + ["contact.inner.load_mean"] * 2
    assert rows[2]["key"] == "mounting.preload_N" and float(rows[2]["mu*"]) > 0.0
    assert b"mu*" in (tmp_path / "bars.svg").read_bytes()
    assert {path.name for path in tmp_path.iterdir()} == {
        "bars.svg", "points", "sensitivity.csv", "sensitivity.md",
    }  # fmt: skip
    again = run(*words, "--force")  # its runs are kept
    assert again.exit_code == 0, again.output
    assert "what friction_torque rests on, N.m" in again.output
    assert (tmp_path / "sensitivity.png").stat().st_size > 1000


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (("--vary", "preload=1..2"), "--vary needs --method morris or --method sobol"),
        (("--samples", "8"), "--samples needs --method"),
        (("--plot", "a.png"), "--plot needs --method"),
        (("--method", "fast"), "allowed are morris and sobol"),
        (("--method", "sobol", "--vary", "preload=1..2"), "give two ranges or more"),
        (("--method", "sobol", "--vary", "preload"), "write KEY=LOW..HIGH"),
        (("--method", "sobol", *["--vary", "preload=1..2"] * 2), "give each --vary once"),
    ],
)
def test_sensitivity_to_several_values_refuses_in_one_line(run, silent_file, tmp_path, words, answer):
    result = run("sensitivity", silent_file, *words, "-o", tmp_path / "new")
    assert result.exit_code == 2 and answer in result.output and result.output.count("\n") == 1
    assert not (tmp_path / "new").exists()


def test_sensitivity_to_several_values_keeps_its_runs_on_ctrl_c(run, silent_file, tmp_path, monkeypatch):
    from fmu_bearing.sweeps import local

    whole = local.here

    def stopped(tasks, *more):
        for number, found in enumerate(whole(tasks, *more)):
            if number == 3:
                raise KeyboardInterrupt
            yield found

    monkeypatch.setattr("fmu_bearing.sweeps.runs.here", stopped)
    words = ("sensitivity", silent_file, *SEVERAL, "--set", "fidelity.model=rings", "-o", tmp_path)
    result = run(*words)
    assert result.exit_code == 130
    assert "interrupted" in result.output and "the same command runs the " in result.output
    assert len(list((tmp_path / "points").iterdir())) == 3 and not (tmp_path / "sensitivity.md").exists()
    monkeypatch.setattr("fmu_bearing.sweeps.runs.here", whole)
    kept = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "points").iterdir()}
    assert run(*words).exit_code == 0
    assert all((tmp_path / "points" / name).stat().st_mtime_ns == time for name, time in kept.items())
