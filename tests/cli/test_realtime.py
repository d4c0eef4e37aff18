"""realtime: its table, its files, its options and what it refuses."""

import csv

import pytest

from fmu_bearing.run.step_times import COLUMNS, SHORT

SHORT_RUN = ("--step", 1e-3, "--duration", 5e-3)


def test_a_table_the_machine_and_advice(run, rings_file, tmp_path):
    target = tmp_path / "out" / "steps.csv"
    done = run("realtime", rings_file, *SHORT_RUN, "--microphones", 1, "-o", target)
    assert done.exit_code == 0
    words = " ".join(done.stdout.split())
    assert "7003C-bare: 5 steps of 1 ms, us of the processor" in words
    assert all(name in words for name in SHORT)
    assert "Python" in words and "the step of 1 ms: " in words and str(target) in done.stderr
    with target.open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert rows[0] == list(COLUMNS)
    assert [row[:4] for row in rows[1:]] == [
        [name, count, phase, "5"]
        for name in ("full", "rings", "response") for count in ("none", "1") for phase in ("run-up", "held")
    ]  # fmt: skip


def test_json_of_a_held_speed_without_sound(run, rings_file):
    done = run(
        "realtime",
        rings_file,
        *SHORT_RUN,
        "--speed",
        9000,
        "--silent",
        "--fidelity",
        "rings,response",
        "--json",
    )
    assert done.exit_code == 0
    found = [(one["fidelity"], one["microphones"], one["phase"], one["steps"]) for one in done.data["steps"]]
    assert found == [("rings", 0, "held", 5), ("response", 0, "held", 5)]
    assert 0.0 < done.data["steps"][0]["p50_s"] <= done.data["steps"][0]["worst_s"]
    assert done.data["step_s"] == 1e-3 and done.data["files"] == [] and done.data["advice"].endswith(".")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--step", 0), "step = 0 s is refused: give a finite time above 0"),
        (("--speed", 2e5), "--speed 200000 r/min is refused: allowed are -100000 to 100000 r/min"),
        (("--run-up", "fast"), "--run-up fast: write two speeds in r/min with a colon between"),
        (("--run-up", "1:2", "--speed", 3), "--speed and --run-up are refused together"),
        (("--silent", "--microphones", 1), "--silent and --microphones are refused together"),
        (("--microphones", 9), "microphones = 9 is refused: the scene has 4"),
        (("--fidelity", "auto"), "fidelity = 'auto' is refused: known are full, rings, response"),
        (("-o", "a.txt"), "a.txt: the table is written as .csv"),
    ],
)
def test_refusals_leave_no_trace(options, words, run, rings_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("realtime", rings_file, *options)
    assert done.exit_code == 2
    assert words in " ".join(done.stderr.split())
    assert not list(tmp_path.iterdir())


def test_a_scene_that_is_not_there(run, tmp_path):
    done = run("realtime", tmp_path / "no.toml", *SHORT_RUN)
    assert done.exit_code == 2 and "there is no such scene file" in " ".join(done.stderr.split())
