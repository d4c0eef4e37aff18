"""A command whose output is redirected says now and then what goes on, on standard error."""

import re

import pytest

from fmu_bearing import progress


@pytest.mark.parametrize("as_json", [(), ("--json",)], ids=["tables", "json"])
def test_lines_of_a_run(run, rings_file, tmp_path, monkeypatch, as_json):
    monkeypatch.setattr(progress, "EVERY", 0.02)
    done = run(
        "simulate", rings_file, "-t", 0.1, "--step", 1e-4, "-v", "friction_torque",
        "-o", tmp_path / "run.csv",
        *as_json,
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    told = [line for line in done.stderr.splitlines() if "7003C-bare: " in line]
    assert told
    form = (
        r"fmu-bearing: after \d+ s; 7003C-bare: [\d.e-]+ of 0\.1 s, ([\d.e+-]+ simulated/wall, )?after \d+ s"
    )
    assert all(re.fullmatch(form, line) for line in told), told
    assert not as_json or done.data["points"] == 1001


def test_a_short_run_is_silent(run, rings_file, tmp_path):
    done = run("simulate", rings_file, "-t", 1e-3, "-o", tmp_path / "run.csv")
    assert done.exit_code == 0 and done.stderr == ""


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (("modes", "{set}"), "modes of 7003C-DB: after 0 s"),
        (("modes", "{set}", "--speeds", "9000,12000,15000"), "Campbell diagram: 1 of 3 speeds, after "),
        (("stiffness", "{set}", "--speeds", "0,9000", "-o", "{folder}/k.csv"), "stiffness: 0 of 2 speeds"),
    ],
)
def test_lines_of_modes_and_stiffness_of_a_set(run, words, what, tmp_path, monkeypatch):
    from tests.conftest import ROOT

    monkeypatch.setattr(progress, "EVERY", 0.01)
    file = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"
    done = run(*(word.format(set=file, folder=tmp_path) for word in words))
    assert done.exit_code == 0, done.output
    assert any(what in line for line in done.stderr.splitlines()), done.stderr
