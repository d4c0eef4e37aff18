"""docs/datasets.md: its plan is laid out, the Python runs, figures are those of the table."""

import csv
import re
import shlex

import pytest
from typer.testing import CliRunner

from fmu_bearing import cli, new_scene
from fmu_bearing.dataset import lay_out, read_plan
from fmu_bearing.dataset.plan import Class, Plan
from tests.conftest import ROOT

pytestmark = pytest.mark.pages

PAGE = (ROOT / "docs" / "datasets.md").read_text("utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty folder with the plan of the page and the scene of its first command."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plan.toml").write_text(blocks("toml")[0], "utf-8")
    first = blocks("sh")[0].splitlines()[0]
    assert CliRunner().invoke(cli.app, shlex.split(first)[1:]).exit_code == 0
    return tmp_path


def test_the_plan_of_the_page_is_laid_out(folder):
    made = lay_out(read_plan(folder / "plan.toml"))
    assert len(made.tasks) == 100 and made.sensors == {"outer_ring.acceleration.z": "m/s2"}
    assert [run.label for run in made.runs].count("outer") == 30
    assert (folder / "6205.toml").read_text("utf-8") == new_scene("6205", "6205", speed_rpm=1797.0)


def test_the_dry_run_of_the_page(folder):
    (line,) = [one for one in blocks("sh")[0].splitlines() if "--dry-run" in one]
    done = CliRunner().invoke(cli.app, shlex.split(line)[1:])
    assert done.exit_code == 0 and done.stdout.startswith("100 runs, 0 kept; one took ")


def test_the_python_of_the_page_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(compile(blocks("python")[0], "docs/datasets.md", "exec"), names)
    assert names["waveforms"].shape == (4, 1, 2560)
    middle = names["labels"].groupby("class")["f_r_Hz"].mean()
    assert 16.0 < middle["slow"] < 25.5 and 41.0 < middle["fast"] < 50.5


def test_every_key_of_a_plan_is_on_the_page():
    keys = {field.alias or name for model in (Plan, Class) for name, field in model.model_fields.items()}
    assert all(f"`{key}`" in PAGE or f"[{key}]" in PAGE for key in keys), keys


def test_figures_of_the_page_are_those_of_the_table():
    with (ROOT / "docs" / "results" / "dataset.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = list(csv.reader(file))
    assert head[2:] == ["CPU s per labelled second", "of full"]
    spent = {(row[0], row[1]): float(row[2]) for row in rows}
    one, both = "one acceleration", "one acceleration, one microphone"
    text = " ".join(PAGE.split())
    assert f"{spent['full', one]:.1f} with fidelity `full`, half of that" in text
    assert 0.3 < spent["rings", one] / spent["full", one] < 0.55
    assert f"adds {spent['full', both] - spent['full', one]:.1f}" in text
    # hours of 10,000 runs
    assert round(spent["full", one] / 0.36) == 5 and round(spent["rings", one] / 0.36) == 2
