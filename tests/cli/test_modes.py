"""``fmu-bearing modes``: tables, files, settings and refusals."""

import csv

import pytest

from tests.conftest import EXAMPLES, GATES

SPINDLE = GATES / "7003C-spindle.toml"


def test_table_of_modes(run):
    result = run("modes", SPINDLE)
    assert result.exit_code == 0
    assert (
        "7003C, 20,000 r/min" in result.stdout
        and "inner tilt" in result.stdout
        and "forward" in result.stdout
    )
    assert "the cage and its films are left out" in result.stderr
    assert max(map(len, result.stdout.splitlines())) <= 80


def test_modes_for_machines(run):
    found = run("modes", SPINDLE, "--speed", 10_000, "--json").data
    assert found["speed_rpm"] == pytest.approx(10_000.0)
    (axial,) = [row for row in found["modes"] if row["name"] == "inner axial"]
    assert axial["order"] == 0 and axial["direction"] == "" and 0.0 < axial["damping_ratio"] < 0.1
    assert "campbell" not in found and found["apart"] and found["files"] == []


def test_campbell_and_its_files(run, tmp_path):
    out = tmp_path / "modes"
    result = run("modes", SPINDLE, "--speeds", "16000:24000:5", "--output", out)
    assert result.exit_code == 0
    assert "Nearest: " in result.stdout and "crossings" in result.stdout
    with (out / "crossings.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert any(row["line"] == "f_i" and row["mode"] == "inner axial" for row in rows)
    assert (out / "campbell.png").stat().st_size > 20_000
    assert "inner axial" in (out / "modes.html").read_text("utf-8")
    with (out / "campbell.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert {float(row["speed_rpm"]) for row in rows} == {16e3, 18e3, 20e3, 22e3, 24e3}
    assert {row["name"] for row in csv.DictReader((out / "modes.csv").open(encoding="utf-8"))} >= {
        "inner axial"
    }


def test_keys_of_the_scene_and_inputs_can_be_set(run):
    one = run("modes", SPINDLE, "-s", "mounting.preload_N=300", "--json").data
    other = run("modes", SPINDLE, "-s", "preload=300", "--json").data
    assert [row["frequency_Hz"] for row in one["modes"]] == pytest.approx(
        [row["frequency_Hz"] for row in other["modes"]], rel=1e-6
    )
    assert one["modes"] != run("modes", SPINDLE, "--json").data["modes"]


def test_standstill_is_given_both_ways(run):
    result = run("modes", SPINDLE, "--speed", 0)
    assert result.exit_code == 0
    assert "contacts stick" in result.stdout and "without friction" in result.stdout


def test_instability_is_told(run):
    result = run("modes", EXAMPLES / "7009C-full-ceramic.toml", "--speed", 18_000)
    assert result.exit_code == 0 and "instability: 'inner tilt forward'" in result.stderr
    assert "(unstable)" in result.stdout


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--speeds", "fast"], "speeds"),
        (["--speeds", "0:100:2"], "at least 3 different ones"),
        (["--speed", "1e9"], "--speed"),
        (["--set", "preload"], "write KEY=VALUE"),
        (["--set", "preload=much"], "write a number, as preload=300"),
        (["--set", "mounting.preload_N=-1"], "preload_N"),
        (["--set", "mounting.preloud_N=1"], "preload_N"),
        (["--highest", "-1", "--speeds", "1e4,2e4,3e4"], "positive number of hertz"),
    ],
)
def test_refusals(run, options, words):
    result = run("modes", SPINDLE, *options)
    assert result.exit_code == 2 and words in result.stderr and result.stderr.startswith("error: ")
    assert result.stdout == ""
