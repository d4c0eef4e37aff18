"""simulate, plot, sound: files, exit codes, refusals; and what all commands share."""

import csv
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
import xarray
from scipy.io import wavfile

from fmu_bearing import Run, build_fmu
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.instance import Instance
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.scene.read import with_fidelity
from tests.native_builds import no_native_fmu


@pytest.fixture(scope="module")
def fmu(rings_file, tmp_path_factory):
    try:
        return build_fmu(rings_file, tmp_path_factory.mktemp("fmu") / "rings.fmu", "native").path
    except BuildError as problem:
        no_native_fmu(problem)


def test_simulate_scene_and_fmu_write_the_same(run, rings_file, fmu, tmp_path):
    (tmp_path / "speed.csv").write_text("time,shaft_speed\n0,1900\n0.01,2100\n")
    found = {}
    for name, source in (("scene", rings_file), ("fmu", fmu)):
        result = tmp_path / f"{name}.csv"
        done = run(
            "simulate", source, "-t", 0.01, "--step", 1e-3, "-i", tmp_path / "speed.csv", "-s", "preload=400",
            "-v", "friction_torque, mic[*].leq", "-o", result,
        )  # fmt: skip
        assert done.exit_code == 0 and "11 points to 0.01 s, 5 variables" in done.stdout, done.output
        found[name] = result.read_bytes()
    assert found["scene"] == found["fmu"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--set", "preload=-5"), "preload = -5 is refused: allowed are 0 to 10000 N"),
        (("--set", "preload=nan"), "preload = nan is refused: allowed are 0 to 10000 N"),
        (("--set", "tolerance=7"), "tolerance = 7 is refused"),
        (("--speed", 9549297), "--speed 9.5493e+06 r/min is refused: allowed are -100000 to 100000 r/min"),
        (
            ("--set", "shaft_speed_rpm=3e6"),
            "--set shaft_speed_rpm 3e+06 r/min is refused: allowed are -100000",
        ),
    ],
)
def test_start_values_of_an_fmu_are_refused_before_the_run(run, fmu, tmp_path, options, words):
    refused = run("simulate", fmu, *options, "-t", 0.01, "-o", tmp_path / "run.csv")
    assert refused.exit_code == 2 and words in refused.stderr and not (tmp_path / "run.csv").exists()


def test_a_step_longer_than_the_run_is_a_caution(run, rings_file, tmp_path):
    done = run("simulate", rings_file, "--step", 10, "-t", 0.01, "-o", tmp_path / "run.csv")
    assert done.exit_code == 0 and "2 points to 0.01 s" in done.stdout
    assert "caution: step = 10 s is longer than the run, which takes one step of 0.01 s" in done.stderr
    done = run("simulate", rings_file, "--step", 0.01, "-t", 0.01, "-o", tmp_path / "other.csv")
    assert done.exit_code == 0 and "longer than the run" not in done.stderr


@pytest.mark.heavy
def test_simulate_loads_only_what_a_first_run_needs(rings_file, tmp_path):
    """A first run is mostly loading: SciPy's signal and statistics would take half a second more.

    The sound block and the points inside bodies are made whatever the cache holds.
    """
    code = f"""
import sys
from fmu_bearing.acoustics.radiation.bem.meridian import cylinder
from fmu_bearing.acoustics.radiation.bem.solver import inner_points
from fmu_bearing.cli import app
from fmu_bearing.prepare.sound_block import Block, sound_parameters
from fmu_bearing.scene import read_scene

app({["simulate", str(rings_file), "-t", "0.001", "-o", str(tmp_path / "run.csv")]}, standalone_mode=False)
assert len(sound_parameters(read_scene({str(rings_file)!r}), Block()))
assert len(inner_points([cylinder("housing", 1, 0.1, 0.0, 0.1)], 300.0))
strangers = {{"scipy.signal", "scipy.stats", "matplotlib", "plotly", "pandas", "xarray", "distributed"}}
assert not strangers & set(sys.modules), strangers & set(sys.modules)
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=600)


def test_simulate_reports_machines_and_writes_netcdf(run, rings_file, tmp_path):
    result = tmp_path / "run.nc"
    done = run(
        "simulate", rings_file, "-t", 2e-3, "--speed", 12000, "-v", "friction_torque", "-o", result, "--json"
    )
    assert done.exit_code == 0
    assert done.data["ended"] == "complete" and done.data["points"] == 3
    assert done.data["last"]["friction_torque"]["unit"] == "N.m" and done.data["files"] == [str(result)]
    with xarray.open_dataset(result) as data:
        assert data["friction_torque"].attrs["units"] == "N.m"


def test_a_refused_run_writes_what_it_has(run, silent_file, tmp_path):
    result = tmp_path / "short.csv"
    (tmp_path / "load.csv").write_text(
        "time,pedestal_stiffness\n0,1e4\n2e-3,1e4\n2e-3,1e12\n"  # 50 mm times as much: 5e10 N
    )
    done = run("simulate", silent_file, "-t", 0.05, "-i", tmp_path / "load.csv", "-o", result)
    assert done.exit_code == 3 and "could not be solved" in done.stderr and "written" in done.stdout
    assert 2e-3 <= Run.load(result).time[-1] < 0.05


def test_an_interrupted_run_writes_what_it_has(run, rings_file, tmp_path):
    result = tmp_path / "short.csv"
    words = ("simulate", rings_file, "-v", "friction_torque", "-o")
    assert run(*words, tmp_path / "first.csv", "-t", 1e-3).exit_code == 0  # what is loaded once takes no part
    timer = threading.Timer(0.6, signal.raise_signal, (signal.SIGINT,))
    timer.start()
    done = run(*words, result, "-t", 1e4)
    timer.join()
    assert done.exit_code == 130 and "interrupted at t =" in done.stderr
    assert len(Run.load(result)) > 1


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("-s", "preload"), "write KEY=VALUE"),
        (("-s", "preload=much"), "write a number"),
        (("-s", "preloads=1"), "did you mean preload (N)?"),
        (("-s", "preload=-1"), "preload = -1.0 is refused: allowed are 0 to 10000 N"),
        (("-o", "run.mat"), "written as .csv, .nc or .uff"),
        (("-t", "-1"), "stop_time = -1.0 s"),
        (("-i", "none.csv"), "none.csv: there is no such file"),
        (("-v", "frictiontorque"), "did you mean 'friction_torque'"),
    ],
)
def test_simulate_refuses_in_a_line(run, rings_file, tmp_path, monkeypatch, arguments, reason):
    monkeypatch.chdir(tmp_path)
    refused = run("simulate", rings_file, *arguments)
    assert refused.exit_code == 2 and reason in refused.stderr, refused.output
    assert refused.stderr.startswith("error: ") and refused.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_netcdf_without_its_packages_is_refused_before_the_run(run, rings_file, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5netcdf", None)
    monkeypatch.setattr(Instance, "initialise", lambda *arguments: pytest.fail("the run has begun"))
    refused = run("simulate", rings_file, "-o", tmp_path / "run.nc")
    assert refused.exit_code == 2 and "pip install 'fmu-bearing[results]'" in refused.stderr
    (tmp_path / "folder.csv").mkdir()
    refused = run("simulate", rings_file, "-o", tmp_path / "folder.csv")
    assert refused.exit_code == 2 and "is a folder: name the file" in refused.stderr


@pytest.mark.heavy
def test_plot(run, rings_file, tmp_path):
    result = tmp_path / "run.csv"
    run("simulate", rings_file, "-t", 3e-3, "-o", result)
    assert run("plot", result).exit_code == 0
    assert (tmp_path / "run.png").read_bytes().startswith(b"\x89PNG")
    for picture in ("one.svg", "two.svg"):
        done = run("plot", result, "-v", "heat.*,mic[*].spl_a", "-o", tmp_path / picture)
        assert done.exit_code == 0, done.output
    first = (tmp_path / "one.svg").read_bytes()
    assert first.startswith(b"<?xml") and first == (tmp_path / "two.svg").read_bytes()
    for arguments, reason in (
        ((result, "-o", tmp_path / "run.bmp"), "written as .png, .svg or .pdf"),
        ((result, "-v", "heat.oils", "-o", tmp_path / "new.png"), "did you mean 'heat.oil'"),
        ((tmp_path / "none.csv",), "there is no such file"),
    ):
        refused = run("plot", *arguments)
        assert refused.exit_code == 2 and reason in refused.stderr


@pytest.fixture(scope="module")
def recorded(run, rings_file, tmp_path_factory):
    folder = tmp_path_factory.mktemp("sound")
    return folder, run("sound", rings_file, "-t", 0.1, "-o", folder, "--json")


def test_sound_writes_what_is_usually_asked(recorded):
    folder, done = recorded
    assert done.exit_code == 0, done.output
    names = {path.name for path in folder.iterdir()}
    assert names >= {
        "recording.npz", "levels.csv", "spectrum.csv", "spectrum.png", "third-octaves.csv", "lines.md",
        "planes.csv", "planes.png", "spectra.nc", "P1.wav", "P4.wav",
    }  # fmt: skip
    assert {str(folder / name) for name in names} == set(done.data["files"])
    with (folder / "levels.csv").open() as file:
        table = {row["microphone"]: row for row in csv.DictReader(file)}
    for name, levels in done.data["levels"].items():
        assert float(table[name]["LAeq, dB(A)"]) == pytest.approx(levels["laeq_dB"], abs=0.051)
    with xarray.open_dataset(folder / "spectra.nc") as data:
        assert data["spectrum"].dims == ("source", "microphone", "frequency")
        assert data["frequency"].attrs["units"] == "Hz"
        # Bins add up to the level of the signal, over 3.77: the noise bandwidth of the flat-top window, in
        # bins. Within 1 dB: the window weights 0.1 s of an unsteady sound unevenly.
        total = data["spectrum"].sel(source="total", microphone="P1").values
        summed = 10.0 * np.log10(np.sum(10.0 ** (total / 10.0)) / 3.77)
        assert summed == pytest.approx(done.data["levels"]["P1"]["leq_dB"], abs=1.0)


def test_sound_plays_in_pascals(recorded, run):
    folder, done = recorded
    rate, signal_ = wavfile.read(folder / "P1.wav")
    other = wavfile.read(folder / "P4.wav")[1]
    apart = done.data["levels"]["P4"]["leq_dB"] - done.data["levels"]["P1"]["leq_dB"]
    assert rate == 48000 and len(signal_) == pytest.approx(0.1 * rate, abs=2)
    # one scale for all: microphones compare by ear as they do by level
    ratio = 20.0 * np.log10(np.std(other) / np.std(signal_))
    assert ratio == pytest.approx(apart, abs=0.2)


@pytest.mark.heavy
def test_sound_of_a_recording_is_that_of_the_scene(recorded, run, tmp_path):
    folder, done = recorded
    again = run(
        "sound",
        folder / "recording.npz",
        "-o",
        tmp_path,
        "-m",
        "P2",
        "--no-wav",
        "--no-directivity",
        "--json",
    )
    assert again.exit_code == 0, again.output
    assert again.data["levels"] == {"P2": done.data["levels"]["P2"]}
    assert {path.name for path in tmp_path.iterdir()} == {
        "levels.csv", "spectrum.csv", "spectrum.png", "third-octaves.csv", "third-octaves.png", "lines.md",
        "spectra.nc",
    }  # fmt: skip


def test_sound_refuses_in_a_line(run, rings_file, recorded, silent_file, tmp_path):
    folder = recorded[0]
    for arguments, reason in (
        ((folder / "recording.npz", "-m", "P9"), "there is no microphone 'P9'; there are P1, P2, P3, P4"),
        ((rings_file, "-t", 0.05, "--resolution", 5), "needs --duration 0.2 s or more"),
        ((folder / "levels.csv",), "levels.csv: the first column must be 'time' (s), not 'microphone'"),
        ((folder / "third-octaves.csv",), "third-octaves.csv: the first column must be 'time' (s), not"),
        ((rings_file, "--radiation-model", "loud"), "loud"),
        ((rings_file, "--fidelity", "best"), "fidelity.model"),
        ((silent_file, "-t", 0.01), "give the scene [sound]"),
    ):
        refused = run("sound", *arguments, "-o", tmp_path)
        assert refused.exit_code == 2 and reason in refused.stderr, refused.output
        assert refused.stderr.splitlines()[-1].startswith("error: ")


@pytest.mark.heavy
def test_listening_to_pressures_alone(scene):
    whole = record(with_fidelity(scene("7003C-bare"), model="rings"), 0.05)
    recorded = analyse_sound(whole)
    alone = Recording(
        whole.scene, "recorded", whole.rate, whole.start, whole.size, whole.output_time, whole.speed_points,
        recorded=whole.pressure(), microphones=whole.microphones,
    )  # fmt: skip
    again = analyse_sound(alone)
    np.testing.assert_allclose(again.levels[:, 0], recorded.levels[:, 0], atol=1e-9)
    assert set(recorded.parts) == {"inner_ring", "outer_ring", "cage", "balls"} and again.parts == {}


@pytest.mark.heavy
def test_levels_of_a_papers_radiation_model_add_energies(scene):
    """As the paper does (eqs. 43 and 46); the pressures of its sources added would read 0.3 dB more here."""
    whole = record(with_fidelity(scene("7003C-bare"), model="rings"), 0.05, radiation_model="paper")
    recorded = analyse_sound(whole)
    np.testing.assert_array_equal(recorded.levels[:, 1], whole.levels(weighting="A"))
    added = level(whole.mean_square(whole.pressure()))
    assert np.all(np.abs(added - recorded.levels[:, 0]) > 0.1)


def test_help_names_every_command_and_the_exit_codes(run):
    reported = run("--help").stdout
    for command in ("scene", "build", "simulate", "plot", "sound", "choose", "tradeoff", "sensitivity"):
        assert command in reported
    assert "--install-completion" in reported and "130 interrupted" in reported


def test_plot_draws_every_variable_asked(run, rings_file, tmp_path):
    """With commas or one option each; the last of several options used to win."""
    result = tmp_path / "run.csv"
    names = ["friction_torque", "heat.oil", "heat.inner_ring", "heat.outer_ring", "mic[1].pressure"]
    options = [word for name in names[:3] for word in ("-v", name)] + ["-v", ",".join(names[3:])]
    assert run("simulate", rings_file, "-t", 2e-3, *options, "-o", result).exit_code == 0
    assert Run.load(result).names == names
    done = run("plot", result, *options, "--scene", rings_file, "-o", tmp_path / "a.svg")
    assert done.exit_code == 0, done.output
    text = (tmp_path / "a.svg").read_text()
    assert all(f"<!-- {name} -->" in text for name in (*names[:4], "P1: pressure"))


def test_levels_in_doubt_are_named(run, example, tmp_path):
    """The dry 7003C has a mode with a damping ratio of 0.0002."""
    for fidelity in ("rings", "full"):
        file = tmp_path / f"{fidelity}.toml"
        scene = with_fidelity(example("7003C-impact"), model=fidelity)
        file.write_text(scene.to_toml(), "utf-8")
        result = run("simulate", file, "-t", "0.001", "-o", tmp_path / "run.csv", "--force")
        assert ("of fidelity rings are in doubt" in result.stdout) == (fidelity == "rings")
        options = ("-o", tmp_path / "run.csv", "--force", "-v", "friction_torque")
        result = run("simulate", file, "-t", "0.001", *options)
        assert result.exit_code == 0
        assert "in doubt" not in result.stdout
