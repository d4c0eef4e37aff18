"""sound --run-up: levels over order and speed, of scenes and of what was recorded."""

import csv
import math

import numpy as np
import pytest

from fmu_bearing.recording.measurements import measure
from fmu_bearing.recording.record import Recording
from fmu_bearing.scene import read_scene

QUICK = ("--no-wav", "--no-spread", "--no-directivity", "--radiation-model", "compact")
RUN = ("-t", 0.3, "--settle", 0.02, "--run-up", "6000:24000", *QUICK)


def table(folder):
    with (folder / "orders.csv").open(newline="") as file:
        columns, *rows = csv.reader(file)
    return [float(name.split()[1].rstrip(",")) for name in columns[2:]], np.array(rows, dtype=float)


@pytest.fixture(scope="module")
def made(run, rings_file, tmp_path_factory):
    out = tmp_path_factory.mktemp("run-up")
    done = run("sound", rings_file, *RUN, "-o", out, "--force", "--at", 2000)
    assert done.exit_code == 0, done.output
    return out, done


@pytest.mark.heavy
def test_speed_and_lines_of_a_run_up(made, rings_file):
    """Balls pass the outer race at one order, Z/2 (1 - D cos a/d_m) but for the angles at speed: 2 %."""
    out, _ = made
    orders, rows = table(out)
    time, speed, levels = rows[:, 0], rows[:, 1], rows[:, 2:]
    # blocks of ten turns, whose mean speed is that in the middle but for the curve of time over angle
    assert speed == pytest.approx(6000.0 + 18000.0 / 0.3 * time, rel=0.05)
    assert (orders[0], orders[1], orders[-1]) == (0.0, pytest.approx(0.2, abs=0.12), 40.0)
    scene = read_scene(rings_file)
    bearing = scene.bearing
    ratio = bearing.ball_diameter_mm / bearing.pitch_diameter_mm
    passing = bearing.ball_count / 2.0 * (1.0 - ratio * math.cos(math.radians(bearing.contact_angle_deg)))
    near = np.abs(np.array(orders) - passing) < 0.5
    found = np.array(orders)[near][levels[:, near].argmax(axis=1)]
    assert np.median(found) == pytest.approx(passing, rel=0.03)


def test_the_table_is_that_of_python(made):
    out, done = made
    recording = Recording.load(out / "recording.npz")
    orders, rows = table(out)
    found = measure.run_up(recording, "P1", resolution=orders[1])
    assert rows[:, 2:] == pytest.approx(found.levels, abs=0.0051)
    assert (out / "orders.png").stat().st_size > 10_000
    # no line has one frequency
    assert not (out / "lines.md").exists() and "orders.csv" in done.stderr
    assert "2000 Hz: no line stands out" not in done.stdout and "kinematic" not in done.stdout


@pytest.mark.heavy
def test_a_new_run_leaves_nothing_of_an_older_one(run, rings_file, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    for name in ("orders.csv", "planes.png", "a.wav", "mine.txt"):
        (out / name).write_text("old")
    done = run("sound", rings_file, "-t", 0.05, "--settle", 0.01, *QUICK, "-o", out, "--force")
    assert done.exit_code == 0, done.output
    assert not {"orders.csv", "planes.png", "a.wav"} & {path.name for path in out.iterdir()}
    assert (out / "mine.txt").read_text() == "old"


@pytest.mark.heavy
def test_a_recording_has_its_own_speed(made, run, tmp_path):
    out, _ = made
    again = run("sound", out / "recording.npz", *QUICK, "-o", tmp_path / "again")
    assert again.exit_code == 0, again.output
    assert (tmp_path / "again" / "orders.csv").read_bytes() == (out / "orders.csv").read_bytes()
    refused = run("sound", out / "recording.npz", *RUN, "-o", tmp_path / "no")
    assert refused.exit_code == 2 and "recording.npz has a speed of its own" in refused.stderr


@pytest.mark.parametrize(
    ("text", "more", "said"),
    [
        ("4000", (), "write two speeds in r/min with a colon between"),
        ("4000:x", (), "write two speeds in r/min with a colon between"),
        ("4000:5000:6000", (), "write two speeds in r/min with a colon between"),
        ("4000:900000", (), "allowed are -100000 to 100000 r/min"),
        ("4000:5000", ("--speed", 4000), "give one of them"),
    ],
)
def test_what_is_no_run_up_is_refused(run, rings_file, tmp_path, text, more, said):
    refused = run("sound", rings_file, "--run-up", text, *more, "-o", tmp_path / "out")
    assert refused.exit_code == 2 and refused.stderr.count("\n") == 1
    assert said in refused.stderr and not (tmp_path / "out").exists()


@pytest.mark.heavy
def test_a_shaft_that_turns_back_has_no_order_map(run, rings_file, tmp_path):
    out = tmp_path / "out"
    there = ("-t", 0.1, "--settle", 0.02, "--run-up", "3000:-3000", *QUICK)
    made = run("sound", rings_file, *there, "-o", out)
    assert made.exit_code == 0 and "no order map: the shaft stops or turns back" in made.stderr
    assert not (out / "orders.csv").exists()
