"""fmu-bearing envelope: lines, files, and what it refuses."""

import csv

import numpy as np
import pytest

from fmu_bearing import Recording
from fmu_bearing.results.uff import Place, signal
from tests.conftest import EXAMPLES

SCENE = EXAMPLES / "7003C-bare.toml"
RUN = (SCENE, "--fidelity", "rings", "--duration", "0.1")


@pytest.fixture(scope="module")
def folder(run, tmp_path_factory):
    path = tmp_path_factory.mktemp("envelope") / "out"
    done = run("envelope", *RUN, "-o", path, "--plot", path / "first.png")
    assert done.exit_code == 0 and "f_o" in done.stdout and "outer race" in done.stdout
    assert "first.png" in done.stderr and "give --duration" not in done.stderr
    return path


def test_files_of_both_radial_accelerations(folder):
    names = {path.name for path in folder.iterdir()}
    kinds = {"envelope": ("csv", "png"), "kurtogram": ("csv", "png"), "lines": ("csv",)}
    wanted = {
        f"{kind}-outer_ring.acceleration.{way}.{ending}"
        for kind, endings in kinds.items()
        for ending in endings
        for way in "yz"
    }
    assert names == wanted | {"recording.npz", "signals.uff", "first.png"}
    with (folder / "lines-outer_ring.acceleration.z.csv").open(encoding="utf-8", newline="") as file:
        lines = {row["name"]: row for row in csv.DictReader(file)}
    recording = Recording.load(folder / "recording.npz")
    assert float(lines["f_o"]["frequency_Hz"]) == pytest.approx(recording.kinematics().f_o, rel=1e-8)
    text = (folder / "signals.uff").read_text("ascii")
    assert text.count("\n    58\n") == 2 and "\n    15\n" in text


def test_a_recording_gives_the_same_lines_and_takes_names_and_a_band(run, folder):
    one = run(
        "envelope",
        folder / "recording.npz",
        "--signal",
        "*ring.acceleration.z",
        "--band",
        "4000:9000",
        "--json",
    )
    found = one.data["envelopes"]
    assert [each["signal"] for each in found] == [
        f"{ring}_ring.acceleration.z" for ring in ("inner", "outer")
    ]
    assert all((each["low_Hz"], each["high_Hz"]) == (4000.0, 9000.0) for each in found)
    assert run("envelope", folder / "recording.npz", "--signal", "P1").stdout.count("P1, ") == 1


def test_variables_of_a_scene_are_recorded_at_close_points(run):
    found = run("envelope", *RUN, "--signal", "outer_ring.velocity.z", "--json").data["envelopes"]
    assert found[0]["unit"] == "m/s" and found[0]["high_Hz"] > 5000.0


def test_results_of_runs_are_taken(run, tmp_path):
    result = tmp_path / "run.csv"
    kept = "outer_ring.velocity.z,cage.speed_ratio"
    run("simulate", SCENE, "--fidelity", "rings", "-t", "0.1", "--step", "5e-5", "-v", kept, "-o", result)
    bare = run("envelope", result, "--signal", "outer_ring.velocity.z", "--settle", "0.02")
    assert bare.exit_code == 0 and "--scene names its lines" in bare.stdout
    known = run("envelope", result, "--signal", "outer_ring.velocity.z", "--settle", "0.02", "--scene", SCENE)
    assert "f_o" in known.stdout or "no line of the bearing" in known.stdout
    refused = run("envelope", result, "--settle", "0.02")
    assert refused.exit_code == 2 and "there are outer_ring.velocity.z, cage" in refused.stderr


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("--signal", "outer_ring.acceleraton.z"), "did you mean 'outer_ring.acceleration"),
        (("--band", "4000"), "write two frequencies in Hz"),
        (("--band", "4000:400000"), "a band from 4000 to 400000 Hz is refused"),
        (("-o", "."), "--force"),
    ],
)
def test_what_it_refuses(run, folder, more, words, monkeypatch):
    monkeypatch.chdir(folder)
    refused = run("envelope", folder / "recording.npz", *more)
    assert refused.exit_code == 2 and words in refused.stderr and refused.stdout == ""
    assert refused.stderr.count("\n") == 1


def test_a_recording_is_saved_as_a_universal_file(folder):
    recording = Recording.load(folder / "recording.npz")
    recording.save(folder / "all.uff")
    text = (folder / "all.uff").read_text("ascii")
    # four microphones, and three accelerations of two rings and the cage
    assert text.count("\n    58\n") == 13
    values = recording.signal("P2")
    made = signal(Place("P2", "Pa", 3), values.time, values.values)
    assert (made.start, made.spacing) == pytest.approx((recording.start, 1.0 / recording.rate))
    assert np.array_equal(made.values, recording.pressure(["P2"])[0])
    (folder / "all.uff").unlink()
