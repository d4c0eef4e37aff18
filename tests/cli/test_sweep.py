"""sweep: what it prints, writes and refuses."""

import re
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from fmu_bearing import cli
from fmu_bearing.extras import MissingExtra
from fmu_bearing.results.picture_parts import single
from fmu_bearing.sweeps import SweepError, local, runs, sweep

QUICK = ("--settle", 0, "--window", 0.002, "-v", "friction_torque,contact.*.load_mean", "--workers", 1)


@pytest.mark.parametrize(
    ("scheduler", "words"),
    [
        ("tcp://host:8786", "needs the package distributed: pip install 'fmu-bearing[cluster]'"),
        ("somewhere", "scheduler = 'somewhere' is refused: write its address, such as tcp://host:8786"),
    ],
)
def test_a_scheduler_is_refused_before_anything_is_written(
    scheduler, words, run, silent_file, tmp_path, monkeypatch
):
    if "package" in words:
        monkeypatch.setitem(sys.modules, "distributed", None)  # as if it were not installed
    else:
        pytest.importorskip("distributed")
    folder = tmp_path / "out"
    result = run("sweep", silent_file, "-a", "speed=5000", "--scheduler", scheduler, "-o", folder)
    assert result.exit_code == 2
    assert words in result.stderr
    assert not folder.exists()
    with pytest.raises((MissingExtra, SweepError), match=re.escape(words)):
        sweep(silent_file, {"speed": [5000]}, scheduler=scheduler, folder=folder)
    assert not folder.exists()


def test_a_sweep_writes_its_results_and_goes_on_from_its_own_file(run, silent_file, tmp_path):
    first = run(
        "sweep", silent_file, "-a", "speed=5000:9000:2", "-a", "fidelity=rings", *QUICK, "-o", tmp_path
    )
    assert first.exit_code == 0 and "2 of 2 points, 0 refused" in first.stdout
    assert {path.name for path in tmp_path.iterdir()} == {
        "points", "scene.toml", "sweep.toml", "sweep.nc", "sweep.csv", "sweep.png",
    }  # fmt: skip
    kept = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "points").iterdir()}
    more = run(
        "sweep",
        tmp_path / "sweep.toml",
        "-a",
        "speed=5000,7000,9000",
        "-w",
        1,
        "-o",
        tmp_path,
        "--force",
        "--json",
    )
    assert more.data["points"] == more.data["finished"] == 3 and more.data["reasons"] == []
    assert more.data["axes"] == {"operation.speed_rpm": [5000, 7000, 9000], "fidelity.model": ["rings"]}
    torque = more.data["figures"]["friction_torque"]
    assert torque["unit"] == "N.m" and 0.0 < torque["least"] < torque["largest"] < 0.1
    now = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "points").iterdir()}
    assert len(now) == 3 and kept.items() <= now.items()  # two were not run again


def test_the_picture_has_the_figures_asked(run, silent_file, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(
        "fmu_bearing.sweeps.picture.sweep_picture",
        lambda data, names=None: drawn.append(names) or single((1, 1))[0],
    )
    axes = (
        "-a",
        "speed=5000:9000:2",
        "-a",
        "fidelity.tolerance=0.01",
        "--settle",
        0,
        "--window",
        0.002,
        "-w",
        1,
    )
    asked = ("-v", "friction_torque", "-v", "heat.*,contact.*.load_mean")
    assert run("sweep", silent_file, *axes, *asked, "-o", tmp_path / "asked").exit_code == 0
    assert run("sweep", silent_file, *axes, "-o", tmp_path / "usual").exit_code == 0
    heats = [f"heat.{name}" for name in ("inner_ring", "outer_ring", "oil")]
    loads = [f"contact.{name}.load_mean" for name in ("inner", "outer")]
    assert drawn == [["friction_torque", *heats, *loads], None]


@pytest.mark.heavy
def test_a_dry_run_runs_one_point_and_writes_nothing(run, silent_file, tmp_path):
    folder = tmp_path / "none"
    axes = ("-a", "fidelity=response", "-a", "preload=100:1000:10", "-a", "speed=1000:9000:100")
    result = run("sweep", silent_file, *axes, *QUICK, "-o", folder, "--dry-run", "--json")
    assert result.exit_code == 0 and not folder.exists()
    data = result.data
    assert data["points"] == 1000 and data["workers"] == 1 and data["sounds"] == 0
    assert data["estimate_s"] == pytest.approx(1000 * data["probe_s"]) and data["probe_s"] > 0


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (("-a", "spede=1,2"), "no key of a scene 'spede'; did you mean 'speed'?"),
        (("-a", "speed=2e5,3e5"), "operation.speed_rpm = 200000.0 is refused; allowed: -100000 to 1"),
        (("-a", "speed=1,2", "-a", "speed=3"), "an axis is given twice"),
        ((), "a sweep needs an axis, for example --axis speed=8000:40000:9"),
        (("-a", "speed=1,2", "-v", "frction_torque"), "did you mean 'friction_torque'?"),
        (("-a", "fidelity=rings", "-a", "speed=1,2", "--scheduler", "here"), "such as tcp://host:8786"),
    ],
)  # fmt: skip
def test_refusals_are_one_line(run, silent_file, tmp_path, arguments, reported):
    result = run("sweep", silent_file, *arguments, "-o", tmp_path / "out")
    assert result.exit_code == 2 and result.stdout == ""
    assert (
        result.stderr.startswith("error: ") and reported in result.stderr and result.stderr.count("\n") == 1
    )
    assert not list(tmp_path.rglob("*.json"))  # nothing was run


def test_refused_points_are_counted_with_their_reason(run, silent_file, tmp_path):
    axes = ("-a", "fidelity=rings", "-a", "mounting.radial_load_z_N=0,-3000", "-a", "pedestal=1e4")
    result = run("sweep", silent_file, *axes, *QUICK, "-o", tmp_path, "--json")
    assert result.exit_code == 0
    assert result.data["finished"] == 2 and result.data["refused"] >= 1
    assert result.data["reasons"][0].startswith("initialisation: ")


@pytest.mark.heavy
def test_ctrl_c_ends_with_130_and_says_how_to_go_on(silent_file, tmp_path, monkeypatch):
    def one_then_ctrl_c(tasks, run):
        yield next(local.here(tasks, run))
        raise KeyboardInterrupt

    monkeypatch.setattr(runs, "here", one_then_ctrl_c)
    arguments = [
        "sweep",
        silent_file,
        "-a",
        "speed=5000,9000",
        "-a",
        "fidelity=rings",
        *QUICK,
        "-o",
        tmp_path,
    ]
    result = CliRunner().invoke(cli.app, [str(argument) for argument in arguments])
    assert result.exit_code == 130
    again = f"fmu-bearing sweep {tmp_path / 'sweep.toml'} -o {tmp_path}"
    assert f"`{again}` runs the 1 of 2 points that are left" in result.stderr
    assert (tmp_path / "sweep.csv").read_text().count("not run") == 1
    monkeypatch.undo()
    result = CliRunner().invoke(cli.app, again.split()[1:] + ["-w", "1"])
    assert result.exit_code == 0 and "2 of 2 points, 0 refused" in result.stdout


@pytest.mark.heavy
def test_help_loads_nothing_heavy():
    code = (
        "import sys; from fmu_bearing import cli\n"
        "loaded = {'distributed', 'xarray', 'matplotlib', 'numba'} & set(sys.modules)\n"
        "assert not loaded, loaded"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=600)
