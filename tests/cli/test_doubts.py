"""Where a ring whirls by itself, all that shows figures of fidelities rings and response says so."""

import warnings
import zipfile

import pytest

from fmu_bearing import changes, compare, record
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.sections.summary import warnings_of
from fmu_bearing.scene.read import with_fidelity

WORDS = "fidelity rings: the ring whirls by itself, figures are of the unstable point, and only fidelity full"


@pytest.fixture(scope="module")
def whirling(example):
    """The 7009C with steel balls at 18,000 r/min: its tilt grows by 395 1/s."""
    return with_fidelity(example("7009C-steel").with_rigid_rings(), model="rings")


@pytest.fixture(scope="module")
def whirling_file(whirling, tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "whirling.toml"
    path.write_text(whirling.to_toml(), "utf-8")
    return path


def test_simulate_says_so_beside_torque_too(run, whirling_file, tmp_path):
    shown = run("simulate", whirling_file, "-t", "1e-3", "-v", "friction_torque", "-o", tmp_path / "a.csv")
    assert WORDS in shown.stdout
    data = run(
        "simulate", whirling_file, "-t", "1e-3", "-v", "friction_torque", "-o", tmp_path / "b.csv", "--json"
    ).data
    assert data["doubt"].startswith(WORDS)
    firm = run(
        "simulate", whirling_file, "-t", "1e-3", "-v", "friction_torque", "-o", tmp_path / "c.csv",
        "--set", "preload=3000", "--speed", "9000", "--json",
    )  # fmt: skip
    assert firm.data["doubt"] == ""


@pytest.mark.heavy
def test_sound_and_compare_say_so(run, whirling_file, tmp_path):
    quick = ("-t", "0.05", "--settle", "0.01")
    recorded = run(
        "sound", whirling_file, *quick, "--no-wav", "--no-directivity", "--no-spread", "-o", tmp_path
    )
    assert WORDS in recorded.output and recorded.output.count("whirls by itself") == 1
    assert "in doubt, see below: levels" in " ".join(recorded.output.split())
    beside = run("compare", whirling_file, whirling_file, *quick)
    assert f"A: {WORDS}" in beside.output and f"B: {WORDS}" in beside.output
    assert beside.output.count(WORDS) == 2


@pytest.mark.heavy
def test_compare_keeps_it(whirling):
    found = compare(
        whirling, with_fidelity(whirling, model="full"), duration=5e-3, settle=1e-3, progress=False
    )
    assert [line[:3] for line in found.doubts()] == ["A: "]
    assert found.summary()["a"]["doubt"].startswith(WORDS) and found.summary()["b"]["doubt"] == ""
    assert "whirls by itself" in found._repr_html_()


def test_record_warns_once(whirling):
    with pytest.warns(UserWarning, match="^fidelity rings: the ring whirls by itself") as caught:
        record(whirling, 1e-3, settle=0.0, progress=False)
    assert sum("whirls" in str(one.message) for one in caught) == 1
    assert next(one for one in caught if "whirls" in str(one.message)).filename == __file__
    with pytest.warns(UserWarning, match="grows by itself at the present inputs, 2.. 1/s"):
        record(whirling, 1e-3, settle=0.0, progress=False, speed=lambda t: 1800.0 + t)
    silent = whirling.model_copy(update={"sound": None})  # of which no level is in doubt
    for quiet in ({"warn": False}, {"speed": 900.0, "inputs": {"preload": 3000.0}}):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            record(silent, 1e-3, settle=0.0, progress=False, **quiet)


@pytest.mark.heavy
def test_changes_and_report_say_so(whirling):
    found = changes(whirling, levels=False)
    assert sum("Unchanged: the ring whirls by itself" in line for line in found.remarks()) == 1
    # said once, not again for each change that whirls too
    assert sum("whirls by itself" in line for line in found.remarks()) == 1
    made = record(whirling, 0.01, settle=0.0, progress=False, warn=False, radiation_model="compact")
    notes = warnings_of(Subject(made, "compact", "a run"))
    assert sum(note.startswith("F" + WORDS[1:]) for note in notes) == 1


def test_build_says_so(run, whirling, tmp_path):
    path = tmp_path / "whirling.toml"
    path.write_text(whirling.replace({"sound": None}).to_toml(), "utf-8")
    built = run("build", path, "-o", tmp_path / "a.fmu", "--flavour", "python")
    assert built.exit_code == 0 and f"caution: {WORDS}" in built.output.replace("\n", " ")
    with zipfile.ZipFile(tmp_path / "a.fmu") as fmu:
        assert f"F{WORDS[1:]}" in fmu.read("documentation/index.html").decode()


@pytest.mark.heavy
def test_a_level_of_a_run_that_restarted_is_in_doubt(run, example, tmp_path):
    """The outer race leaves the balls: its ring is 180 K warmer at once. No mode is weak here."""
    scene = with_fidelity(example("7003C-bare"), model="rings").replace({"mounting.preload_N": 500.0})
    push = {"outer_ring_temperature": lambda t: 240.0 if t < 5e-3 else 420.0}
    quick = {"settle": 2e-3, "progress": False, "warn": False, "outputs": ()}
    with pytest.warns(UserWarning, match="restarted from rest"):
        made = record(scene, 0.05, inputs=push, **quick)
    count = made.doubts["solver.restarts"]
    assert count >= 1
    path = tmp_path / "restarted.npz"
    made.save(path)
    shown = run("sound", path, "--no-wav", "--no-directivity", "--no-spread", "--json", "-o", tmp_path / "a")
    words = f"restarted from rest where no step was possible (solver.restarts = {count:.0f})"
    assert words in shown.data["doubt"]
    found = compare(made, record(scene, 0.02, **quick))
    assert words in found.summary()["a"]["doubt"] and "restarted" not in found.summary()["b"]["doubt"]
    names = "friction_torque,solver.restarts"
    table = tmp_path / "loads.csv"
    table.write_text("time,outer_ring_temperature\n0,240\n0.005,240\n0.0051,420\n0.05,420\n")
    ended = run(
        "simulate", _written(scene, tmp_path), "-t", "0.02", "-i", table, "-v", names, "--json",
        "-o", tmp_path / "b.csv",
    )  # fmt: skip
    assert "restarted from rest" in ended.data["doubt"]


def _written(scene, folder):
    path = folder / "scene.toml"
    path.write_text(scene.to_toml(), "utf-8")
    return path
