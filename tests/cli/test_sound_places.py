"""sound --microphone-at, what it lists, and a refused value that is said once."""

import csv

import pytest

from fmu_bearing.recording.record import Recording
from fmu_bearing.run.simulate_fmu import _Watch

QUICK = (
    "-t",
    0.05,
    "--settle",
    0.02,
    "--no-wav",
    "--no-spread",
    "--no-directivity",
    "--radiation-model",
    "compact",
)


@pytest.mark.heavy
def test_a_place_that_no_scene_has(run, rings_file, tmp_path):
    out = tmp_path / "out"
    made = run("sound", rings_file, *QUICK, "--microphone-at", "0,1000,0", "-o", out)
    assert made.exit_code == 0, made.output
    assert "(0, 1000, 0) mm" in made.stdout and "P1" not in made.stdout
    assert "written: " in made.stderr and "recording.npz" in made.stderr
    assert (out / "lines.md").read_text().startswith("Strongest lines at (0, 1000, 0) mm\n")
    with (out / "levels.csv").open(newline="") as file:
        ((row),) = csv.DictReader(file)
    kept = Recording.load(out / "recording.npz")
    level = kept.levels([(0.0, 1.0, 0.0)], weighting="A")[0]
    assert float(row["LAeq, dB(A)"]) == pytest.approx(level, abs=0.051)
    both = run("sound", out / "recording.npz", *QUICK[4:7], "-m", "P1", "--microphone-at", "0,1000,0", "-o",
               tmp_path / "both")  # fmt: skip
    assert "P1" in both.stdout and "(0, 1000, 0) mm" in both.stdout


@pytest.mark.parametrize("text", ["0,1000", "a,b,c", "1,2,3,4", ""])
def test_what_is_no_place_is_refused(run, rings_file, tmp_path, text):
    refused = run("sound", rings_file, *QUICK, "--microphone-at", text, "-o", tmp_path / "out")
    assert refused.exit_code == 2 and refused.stderr.count("\n") == 1
    assert "write three numbers in mm, as 0,1000,0" in refused.stderr


def test_a_value_is_refused_once():
    watch = _Watch(lambda done: True, 1.0)
    watch.lines = [
        "value not taken yet: preload = -1.0 is refused: allowed are 0 to 10000 N",
        "step refused: preload = -1.0 is refused: allowed are 0 to 10000 N", "another line",
    ]  # fmt: skip
    watch.refused("fmi2SetReal failed with status 2 (discard).")
    assert watch.note.startswith("fmi2SetReal failed with status 2 (discard); value not taken yet: ")
    assert watch.note.count("preload = -1.0") == 1 and watch.note.endswith("another line")
