"""A set as a whole: labels and waveforms are those of single runs; kills and workers change no byte."""

import csv
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import scipy

from fmu_bearing import record
from fmu_bearing.dataset import dataset, lay_out, read_plan
from fmu_bearing.dataset.run import computed
from fmu_bearing.engine.layout import SD
from fmu_bearing.scene.read import read_scene_text
from fmu_bearing.scene.values import value_at
from tests.conftest import ROOT
from tests.dataset import plans

FILES = ("waveforms.nc", "labels.csv", "README.md")


@pytest.fixture(scope="module")
def bare(scene):
    return scene("7003C-bare")


@pytest.fixture(scope="module")
def made(bare, tmp_path_factory):
    """Folder with a plan and its set in ``out``, made by this process alone."""
    folder = tmp_path_factory.mktemp("set")
    dataset(plans.file(folder, bare), folder / "out", workers=1)
    return folder


def rows(folder):
    with (folder / "labels.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def opened(folder):
    return pytest.importorskip("xarray").open_dataset(folder / "waveforms.nc", engine="h5netcdf")


def test_labels_are_those_of_each_runs_own_scene(made):
    scenes, labels = opened(made / "out")["scene"].values, rows(made / "out")
    assert len(labels) == len(scenes) == 6
    keys = [name for name in labels[0] if value_at(read_scene_text(scenes[0]), name) is not None]
    assert set(keys) >= {
        "operation.speed_rpm", "mounting.preload_N", "mounting.radial_load_z_N", "imperfections.seed",
        "fidelity.model",
    }  # fmt: skip
    for number, (text, row) in enumerate(zip(scenes, labels, strict=True)):
        one = read_scene_text(text)
        for key in keys:
            value = value_at(one, key)
            assert row[key] == value if isinstance(value, str) else float(row[key]) == value, key
        assert int(row["run"]) == number and row["reason"] == ""
        across = -100.0 <= float(row["mounting.radial_load_z_N"]) <= -10.0
        assert row["class"] == ("across" if across else "along")
        # of the run: the shaft exactly, races by the cage that turned
        f = {name: float(row[f"f_{name}_Hz"]) for name in "rcbio"}
        assert f["r"] == pytest.approx(float(row["operation.speed_rpm"]) / 60.0, rel=1e-9)
        balls = one.bearing.ball_count
        assert f["o"] == pytest.approx(balls * f["c"], rel=1e-12)
        assert f["i"] == pytest.approx(balls * (f["r"] - f["c"]), rel=1e-12)


def test_a_repeated_run_equals_the_kept_waveform_to_the_bit(made):
    data, labels = opened(made / "out"), rows(made / "out")
    sensors = tuple(data["sensor"].values)
    assert sensors == ("outer_ring.acceleration.z", "P1") and list(data["unit"].values) == ["m/s2", "Pa"]
    for k in (0, 5):
        one = read_scene_text(data["scene"].values[k])
        again, waveforms = computed(one, 0.03, 0.04, 12_800, sensors)
        assert np.array_equal(waveforms, data["waveforms"].values[k])
        assert all(float(labels[k][name]) == value for name, value in again.items())


def test_waveforms_are_those_of_a_recording(made):
    """Every fourth sample of what `record` keeps, through another low-pass; levels by SciPy."""
    data, labels = opened(made / "out"), rows(made / "out")
    one = read_scene_text(data["scene"].values[2])
    whole = record(one, 0.06, settle=0.02, warn=False, progress=False)
    low = scipy.signal.firwin(801, 5700.0, fs=SD.RATE)
    for sensor, signal_ in enumerate(
        (whole.signal("outer_ring.acceleration.z").values, whole.pressure(["P1"])[0])
    ):
        beside = scipy.signal.oaconvolve(signal_, low, "same")[512 : 512 + 2048 : 4]
        kept = data["waveforms"].values[2, sensor].astype(np.float64)
        # both fall from 5.1 to 6.4 kHz, in different ways
        both = [scipy.signal.sosfiltfilt(scipy.signal.butter(8, 4e3, fs=12_800.0, output="sos"), x)
                for x in (kept, beside)]  # fmt: skip
        assert np.abs(both[0] - both[1])[60:-60].max() < 2e-3 * np.abs(both[1]).max()
        name = data["sensor"].values[sensor]
        unit = data["unit"].values[sensor]
        assert float(labels[2][f"rms.{name} [{unit}]"]) == pytest.approx(kept.std(), rel=1e-12)
        assert float(labels[2][f"kurtosis.{name}"]) == pytest.approx(
            scipy.stats.kurtosis(kept, fisher=False), rel=1e-9
        )


@pytest.mark.heavy
def test_workers_change_no_byte(made, tmp_path):
    dataset(made / "plan.toml", tmp_path, workers=2)
    for name in FILES:
        assert (tmp_path / name).read_bytes() == (made / "out" / name).read_bytes(), name


@pytest.mark.heavy
def test_a_killed_set_resumes_to_equal_files(made, tmp_path):
    command = [sys.executable, "-m", "fmu_bearing", "dataset", made / "plan.toml", "-o", tmp_path, "-w", "1"]
    process = subprocess.Popen(command, cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT)})
    runs = tmp_path / "runs"
    late = time.monotonic() + 120.0
    while len(list(runs.glob("[!.]*.npz")) if runs.is_dir() else []) < 2 and time.monotonic() < late:
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.wait(60)
    before = {path: path.stat().st_mtime_ns for path in runs.glob("[!.]*.npz")}
    assert 2 <= len(before) < 6 and not (tmp_path / "labels.csv").exists()
    damaged = next(iter(before))
    damaged.write_bytes(damaged.read_bytes()[:-200])  # as a power cut may leave it
    done = subprocess.run(
        command, cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, timeout=600
    )
    assert done.returncode == 0
    assert f"{len(before)} of 6 runs are kept in {tmp_path}" in done.stderr.decode()
    for name in FILES:
        assert (tmp_path / name).read_bytes() == (made / "out" / name).read_bytes(), name
    same = [path for path, at in before.items() if path.stat().st_mtime_ns == at]
    assert len(same) == len(before) - 1  # only the damaged one was run again
    again = {path: path.stat().st_mtime_ns for path in runs.iterdir()}
    dataset(made / "plan.toml", tmp_path, workers=1)
    assert again == {path: path.stat().st_mtime_ns for path in runs.iterdir()}


def test_a_run_that_fails_is_a_row_with_its_reason(bare, tmp_path):
    classes = """[[class]]
name = "loose"
share = 1
draw = { preload = 0.0, "mounting.radial_load_z_N" = -2000.0, pedestal = [1e4, 1e8] }
"""
    head = plans.HEAD.replace("runs = 6", "runs = 2")
    dataset(plans.file(tmp_path, bare, head=head, classes=classes), tmp_path / "out", workers=1)
    labels, data = rows(tmp_path / "out"), opened(tmp_path / "out")["waveforms"].values
    failed = [row["reason"] for row in labels]
    assert sorted(reason[:14] for reason in failed) == ["", "initialisation"]
    for row, waves in zip(labels, data, strict=True):
        assert np.isnan(waves).all() == bool(row["reason"])
        assert (row["f_r_Hz"] == "") == bool(row["reason"]) if "f_r_Hz" in row else row["reason"]
        assert float(row["mounting.pedestal_stiffness_N_m"]) in (1e4, 1e8) and row["class"] == "loose"
    assert "initialisation at t = 0" in (tmp_path / "out" / "README.md").read_text("utf-8")


def test_a_lost_worker_loses_no_other_run(made):
    """What is lasting is kept; a fault of the program is a row that is run again."""
    from fmu_bearing.dataset.run import RunOutcome
    from fmu_bearing.dataset.store import Runs
    from fmu_bearing.sweeps.local import nothing

    layout, store = lay_out(read_plan(made / "plan.toml")), Runs(made / "other")
    task = layout.tasks[0]
    assert store.keep(task, nothing(task, "failed: its worker process died 3 times")).reason
    assert store.load(task) is None
    store.keep(task, RunOutcome((), "no equilibrium", 0.1))
    assert store.load(task).reason == "no equilibrium" and store.read(task)[1].size == 0


def test_accelerometers_are_kept_with_their_noise(bare, tmp_path):
    """By default, in the place of microphones; of a set each bearing's rings have names of their own."""
    sensor = {"name": "DE", "angle_deg": 0.0, "resonance_kHz": 20.0, "noise_m_s2": 0.2}
    head = plans.HEAD.replace("runs = 6", "runs = 2").replace("sensors", "#").replace("12800", "51200")
    path = plans.file(tmp_path, bare.replace({"accelerometer": [sensor]}), head=head)
    dataset(path, tmp_path / "out", workers=1)
    data, labels = opened(tmp_path / "out"), rows(tmp_path / "out")
    assert list(data["sensor"].values) == ["DE"] and "rms.DE [m/s2]" in labels[0]
    one = read_scene_text(data["scene"].values[0])
    whole = record(one, 0.04, settle=0.03, warn=False, progress=False)
    assert np.array_equal(data["waveforms"].values[0, 0], whole.acceleration("DE").astype(np.float32))
    assert not np.allclose(whole.acceleration("DE", noise=False), whole.acceleration("DE"), atol=0.1)
