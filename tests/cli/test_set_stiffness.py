"""stiffness of a set: tables of the shaft and of its bearings, picture, elements for ROSS."""

import tomllib

import pytest

from fmu_bearing import statics
from tests.conftest import EXAMPLES

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


def test_table_picture_and_numbers(run, tmp_path):
    out, picture = tmp_path / "k.csv", tmp_path / "k.png"
    words = ("--speeds", "0:15000:2", "--preloads", "100,150", "-o", out, "--plot", picture)
    result = run("stiffness", DB, *words)
    assert result.exit_code == 0, result.output
    assert picture.stat().st_size > 10_000 and len(out.read_text("utf-8").splitlines()) == 5
    assert "7003C-DB at the nose" in result.stdout and "set spindle.shaft.flexible = true" in result.stderr
    data = run("stiffness", DB, "-o", out, "--force", "--json").data
    assert data["nose"]["nose_stiffness"] == [[pytest.approx(statics(DB).nose_stiffness)]]
    assert data["preloads_N"] == [150.0] and data["speeds_rpm"] == [15000.0]
    changed = run(
        "stiffness", DB, "--set", "spindle.preload.preload_N=300", "-o", out, "--force", "--json"
    ).data
    assert changed["nose"]["nose_stiffness"][0][0] > data["nose"]["nose_stiffness"][0][0]


def test_tables_of_the_bearings_are_written_too(run, tmp_path):
    out = tmp_path / "k.csv"
    words = ("--speeds", "15000", "--frequencies", "100,1000", "--set", "nose.force.z=-80")
    result = run("stiffness", DB, *words, "-o", out)
    assert result.exit_code == 0, result.output
    assert {path.name for path in tmp_path.iterdir()} == {"k.csv", "k-1.csv", "k-2.csv"}
    shown = " ".join(result.stdout.split())
    assert "7003C-DB at the nose" in shown and "7003C-DB at 1000 Hz" in shown and "│ 2 │ 15000" in shown
    data = run("stiffness", DB, *words, "-o", out, "--force", "--json").data
    assert [one["bearing"] for one in data["bearings"]] == [1, 2]
    assert len(data["bearings"][0]["K"][0][0]) == 2


def test_elements_for_ross_are_mirrored_where_a_bearing_is(run, tmp_path):
    words = ("--speeds", "15000", "--frequencies", "1000", "--format", "ross", "-o", tmp_path / "k.toml")
    assert run("stiffness", DB, *words).exit_code == 0
    assert {path.name for path in tmp_path.iterdir()} == {
        f"k-{b}-{part}.toml" for b in (1, 2) for part in (1, 2, 3)
    }
    # the load centres are outside: behind the balls of the first and ahead of those of the second
    texts = {path.stem: tomllib.loads(path.read_text("utf-8")) for path in tmp_path.iterdir()}
    radial = {stem: next(iter(text.values()))["kxx"] for stem, text in texts.items()}
    assert radial["k-1-1"] > radial["k-1-3"] and radial["k-2-1"] < radial["k-2-3"]


def test_a_set_says_which_way_each_bearing_carries(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("stiffness", DB, "--format", "ross", "--mirrored")
    assert result.exit_code == 2 and "--mirrored is for one bearing" in result.stderr
    assert not list(tmp_path.iterdir())
