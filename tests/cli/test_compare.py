"""compare: tables within 80 columns, files, JSON, refusals in a line."""

import csv

import pytest

from fmu_bearing.scene import read_scene

SHORT = ("-t", 0.05, "--settle", 0.02)


@pytest.fixture(scope="module")
def light_file(rings_file, tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "light.toml"
    path.write_text(read_scene(rings_file).replace({"mounting.preload_N": 200}).to_toml(), "utf-8")
    return path


def test_tables_picture_and_files(run, rings_file, light_file, tmp_path):
    done = run(
        "compare", rings_file, light_file, *SHORT, "--plot", tmp_path / "both.png", "-m", "P2", "-o",
        tmp_path / "tables",
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    for words in ("what differs in the scenes", "levels", "loads, angles, torque", "third octaves at P2"):
        assert words in done.stdout
    assert "mounting.preload_N" in done.stdout and "differences are B minus A" in done.stdout
    tables = [line for line in done.stdout.splitlines() if line[:1] in "┏┃┡│└"]
    assert len(tables) > 50 and max(map(len, tables)) <= 80
    assert "A: running 7003C-bare, fidelity rings" in done.stderr and "written:" in done.stderr
    assert (tmp_path / "both.png").read_bytes().startswith(b"\x89PNG")
    with (tmp_path / "tables" / "levels.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0][:4] == ["microphone", "A, dB", "B, dB", "B - A"]
    assert [row[0] for row in rows[1:]] == ["P1", "P2", "P3", "P4"]


def test_machines(run, rings_file, light_file):
    done = run("compare", rings_file, light_file, *SHORT, "--fidelity", "response", "--json")
    assert done.exit_code == 0, done.output
    assert done.data["keys"] == {"mounting.preload_N": {"a": 500.0, "b": 200.0, "unit": "N"}}
    assert set(done.data["a"]["levels"]) == {"P1", "P2", "P3", "P4"} and done.data["files"] == []
    assert "fidelity response" in done.stderr


def test_scenes_that_are_equal(run, rings_file):
    done = run("compare", rings_file, rings_file, *SHORT)
    assert done.exit_code == 0 and "the scenes do not differ" in done.stdout


def test_refusals(run, rings_file, tmp_path):
    (tmp_path / "run.csv").write_text("time,friction_torque\n0,1\n1,1\n")
    (tmp_path / "file").write_text("")
    for arguments, reason in (
        ((rings_file, tmp_path / "none.toml"), "none.toml: there is no such scene file"),
        ((rings_file, tmp_path / "none.npz"), "none.npz: there is no such file"),
        ((tmp_path / "run.csv", rings_file, "--fidelity", "full"), "A is a finished run"),
        ((rings_file, rings_file, "--plot", "both.txt"), "pictures are written as .png, .svg, .pdf"),
        ((rings_file, rings_file, "-m", "P9"), "there is no microphone 'P9'; there are P1, P2, P3, P4"),
        ((rings_file, rings_file, "--fidelity", "best"), "fidelity.model = 'best' is refused"),
        ((rings_file, rings_file, "-t", -1), "duration = -1.0 s"),
        ((rings_file, rings_file, "-o", tmp_path / "file"), "file is a file; name another folder"),
        ((rings_file, rings_file, "-o", tmp_path / "out", "-t", -1), "duration = -1.0 s"),
    ):
        done = run("compare", *arguments)
        assert done.exit_code == 2 and reason in done.stderr, done.output
    assert not (tmp_path / "out").exists()  # a refusal leaves no trace
