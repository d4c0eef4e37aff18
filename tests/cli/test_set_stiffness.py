"""stiffness of a set: table, picture, and the refusals of what belongs to one bearing."""

import pytest

from fmu_bearing import shaft_statics
from tests.conftest import EXAMPLES

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


def test_table_picture_and_numbers(run, tmp_path):
    out, picture = tmp_path / "k.csv", tmp_path / "k.png"
    words = ("--speeds", "0:15000:2", "--preloads", "100,150", "-o", out, "--picture", picture)
    told = run("stiffness", DB, *words)
    assert told.exit_code == 0, told.output
    assert picture.stat().st_size > 10_000 and len(out.read_text("utf-8").splitlines()) == 5
    assert "7003C-DB at the nose" in told.stdout and "set spindle.shaft.flexible = true" in told.stderr
    data = run("stiffness", DB, "-o", out, "--json").data
    assert data["nose_stiffness"] == [[pytest.approx(shaft_statics(DB).nose_stiffness)]]
    assert data["preloads_N"] == [150.0] and data["speeds_rpm"] == [15000.0]
    changed = run("stiffness", DB, "--set", "spindle.preload.preload_N=300", "-o", out, "--json").data
    assert changed["nose_stiffness"][0][0] > data["nose_stiffness"][0][0]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--frequencies", "100"), "--frequencies is for one bearing"),
        (("--format", "ross"), "--format ross is for one bearing"),
        (("--spacing", "free"), "--spacing is for one bearing"),
        (("--set", "nose.force.z=-80"), "--set of an input is for one bearing"),
        (("-o", "k.nc"), "writes files that end in .csv"),
    ],
)
def test_what_belongs_to_one_bearing_is_refused(run, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    told = run("stiffness", DB, *arguments)
    assert told.exit_code == 2 and words in told.stderr
    assert not list(tmp_path.iterdir())
