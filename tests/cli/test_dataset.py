"""dataset: what it prints, writes and refuses."""

import pytest

from fmu_bearing.sweeps import local, runs
from tests.dataset import plans


@pytest.fixture(scope="module")
def plan(scene, tmp_path_factory):
    """Plan of two silent runs of an acceleration."""
    head = plans.HEAD.replace("runs = 6", "runs = 2").replace(', "P1"', "")
    folder = tmp_path_factory.mktemp("plan")
    return plans.file(folder, scene("7003C-bare").replace({"sound": None}), head=head)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--set", "preload=1e9"), "preload"),
        (("--scheduler", "somewhere"), "scheduler = 'somewhere' is refused"),
    ],
)
def test_it_refuses_before_anything_is_written(run, plan, tmp_path, options, words):
    if "--scheduler" in options:
        pytest.importorskip("distributed")
    refused = run("dataset", plan, *options, "-o", tmp_path / "out")
    assert refused.exit_code == 2 and words in refused.stderr and not (tmp_path / "out").exists()


def test_a_scene_in_its_place_is_named(run, silent_file):
    refused = run("dataset", silent_file)
    assert refused.exit_code == 2 and refused.stderr.count("\n") == 1
    assert "is not a plan of a data set, but a scene" in refused.stderr


def test_ctrl_c_ends_with_130_and_the_command_that_it_names_goes_on(run, plan, tmp_path, monkeypatch):
    def one_then_ctrl_c(tasks, what):
        yield next(local.here(tasks, what))
        raise KeyboardInterrupt

    monkeypatch.setattr(runs, "here", one_then_ctrl_c)
    stopped = run("dataset", plan, "-o", tmp_path, "-w", 1)
    again = f"fmu-bearing dataset {tmp_path / 'plan.toml'} -o {tmp_path}"
    assert stopped.exit_code == 130 and f"`{again}` runs the 1 of 2 runs that are left" in stopped.stderr
    assert (tmp_path / "labels.csv").read_text().count("not run") == 1
    assert "1 of them have waveforms" in (tmp_path / "README.md").read_text()
    monkeypatch.undo()
    done = run(*again.split()[1:], "-w", 1, "--json")
    assert done.exit_code == 0 and f"1 of 2 runs are kept in {tmp_path}" in done.stderr
    assert done.data["finished"] == 2 and done.data["reasons"] == [] and done.data["kept"] == 1
    assert done.data["sensors"] == {"outer_ring.acceleration.z": "m/s2"}
    assert {path.name for path in tmp_path.iterdir()} == {
        "runs", "scene.toml", "plan.toml", "waveforms.nc", "labels.csv", "README.md",
    }  # fmt: skip
    other = run("dataset", plan, "--set", "preload=400", "-o", tmp_path)
    assert other.exit_code == 2 and "--force" in other.stderr
