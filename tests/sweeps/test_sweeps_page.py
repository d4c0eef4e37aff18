"""docs/sweeps.md: Python, file and commands run, figures are those of the table."""

import csv
import pathlib
import re
import shlex

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import cli, simulate
from fmu_bearing.sweeps.description import read_description

pytestmark = pytest.mark.pages

ROOT = pathlib.Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "sweeps.md").read_text("utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)


def test_python_of_the_page_runs(tmp_path, monkeypatch):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks("python"):
        exec(compile(block, "docs/sweeps.md", "exec"), names)
    assert {path.name for path in (tmp_path / "out" / "friction").iterdir()} == {
        "sweep.nc", "sweep.csv", "sweep.png",
    }  # fmt: skip
    torque = names["torque"].values
    assert torque.shape == (4, 3) and (np.diff(torque, axis=1) > 0.0).all()  # more preload, more friction
    # one point by a run of its own: N mm, mean over the window of 10 ms
    alone = names["scene"].replace({"operation.speed_rpm": 10e3, "mounting.preload_N": 500.0})
    run = simulate(alone, 0.015, step=1e-3, outputs=["friction_torque_mean"], progress=False)
    wanted = 1e3 * run["friction_torque_mean"][run.time > 0.0055].mean()
    assert names["torque"].sel(speed_rpm=10e3, preload_N=500) == pytest.approx(wanted, rel=5e-3)
    with (tmp_path / "out" / "friction" / "sweep.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [1e3 * float(row["friction_torque [N.m]"]) for row in rows] == pytest.approx(list(torque.ravel()))


def test_the_file_of_the_page_is_a_sweep(tmp_path):
    (text,) = blocks("toml")
    (tmp_path / "sweep.toml").write_text(text)
    assert set(read_description(tmp_path / "sweep.toml").axes) == {"speed", "mounting.preload_N"}


@pytest.mark.parametrize("line", [s for s in blocks("sh")[0].splitlines() if "--dry-run" in s])
def test_the_dry_run_of_the_page(tmp_path, monkeypatch, scene, line):
    monkeypatch.chdir(tmp_path)
    silent = scene("7003C-spindle").model_copy(update={"sound": None})
    (tmp_path / "my-scene.toml").write_text(silent.to_toml(), "utf-8")
    result = CliRunner().invoke(cli.app, shlex.split(line)[1:] + ["--window", "0.001", "--settle", "0"])
    assert result.exit_code == 0 and result.stdout.startswith("85 points, 0 kept")


def test_figures_of_the_page_are_those_of_the_table():
    with (ROOT / "docs" / "results" / "sweep.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = list(csv.reader(file))
    assert [float(row[0]) for row in rows] == sorted(float(row[0]) for row in rows) and len(rows) == 9
    modes, turn, received = (np.array([float(row[k]) for row in rows]) for k in (1, 3, 5))
    text = " ".join(PAGE.split())
    assert f"{turn.min():.1f} to {turn.max():.1f} % above" in text
    assert f"{received.min():.1f} to {received.max():.1f} % above" in text
    assert f"{round(modes[0], -2):,.0f} to {round(modes[-1], -2):,.0f} r/min" in text
    scaled = modes / np.sqrt([float(row[0]) for row in rows])
    # the root of the pedestal's stiffness, in series with balls that are 1.1 to 4.6 times as stiff
    assert np.abs(scaled / scaled[4] - 1.0).max() < 6e-3
    assert "within 0.6 %" in text
