"""compare: tables within 80 columns, files, JSON, refusals in a line."""

import csv
import math

import pytest

from fmu_bearing.scene import read_scene

SHORT = ("-t", 0.05, "--settle", 0.02)


@pytest.fixture(scope="module")
def light_file(rings_file, tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "light.toml"
    path.write_text(read_scene(rings_file).replace({"mounting.preload_N": 300}).to_toml(), "utf-8")
    return path


@pytest.fixture(scope="module")
def quiet_cages(rings_file, light_file, tmp_path_factory):
    """Files of both scenes without cage: draws of a loud one need fidelity full."""
    folder, found = tmp_path_factory.mktemp("caged"), []
    for path in (rings_file, light_file):
        found.append(folder / path.name)
        found[-1].write_text(read_scene(path).replace({"bearing.cage": None}).to_toml(), "utf-8")
    return found


def cells(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def test_tables_picture_and_files(run, rings_file, light_file, tmp_path):
    done = run(
        "compare", rings_file, light_file, *SHORT, "--plot", tmp_path / "both.png", "-m", "P2", "-o",
        tmp_path / "tables",
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    for words in (
        "what differs in the scenes",
        "levels, fidelity rings, radiation model ",
        "loads, angles, torque",
        "third octaves at P2",
    ):
        assert words in done.stdout
    assert "mounting.preload_N" in done.stdout and "differences are B minus A" in done.stdout
    tables = [line for line in done.stdout.splitlines() if line[:1] in "┏┃┡│└"]
    assert len(tables) > 50 and max(map(len, tables)) <= 80
    assert "A: running 7003C-bare, fidelity rings" in done.stderr and "written:" in done.stderr
    assert (tmp_path / "both.png").read_bytes().startswith(b"\x89PNG")
    head, *levels = cells(tmp_path / "tables" / "levels.csv")
    assert head[:4] == ["microphone", "A, dB", "B, dB", "B - A, dB"]
    assert [row[0] for row in levels] == ["P1", "P2", "P3", "P4"]
    _, *bands = cells(tmp_path / "tables" / "third-octaves.csv")
    for row in levels + bands:  # each of the three is rounded to 0.1 dB
        assert float(row[3]) == pytest.approx(float(row[2]) - float(row[1]), abs=0.151), row
    for column in (1, 2):  # filters overlap at their edges
        total = 10.0 * math.log10(sum(10.0 ** (0.1 * float(row[column])) for row in bands))
        assert total == pytest.approx(float(levels[1][column]), abs=0.5)
    _, *means = cells(tmp_path / "tables" / "loads-angles-torque.csv")
    by_name = {row[0]: [float(cell) for cell in row[2:5]] for row in means}
    for k, preload in enumerate((500.0, 300.0)):  # twelve balls carry the preload at their contact angle
        angle = math.radians(by_name["contact.inner.angle_mean"][k])
        load = by_name["contact.inner.load_mean"][k]
        assert load == pytest.approx(preload / (12.0 * math.sin(angle)), rel=5e-3)


@pytest.mark.heavy
def test_machines(run, rings_file, quiet_cages):
    done = run("compare", *quiet_cages, *SHORT, "--fidelity", "response", "--seeds", 2, "--json")
    assert done.exit_code == 0, done.output
    changed = {"key": "mounting.preload_N", "a": 500.0, "b": 300.0, "unit": "N"}
    assert done.data["keys"] == {"mounting.preload_N": changed}
    assert set(done.data["a"]["levels"]) == {"P1", "P2", "P3", "P4"} and done.data["files"] == []
    assert "fidelity response" in done.stderr
    model = read_scene(rings_file).sound.radiation_model
    for side in "ab":
        assert done.data[side]["fidelity"] == "response" and done.data[side]["radiation_model"] == model
    finding = done.data["finding"]
    at = finding["microphone"]
    assert at == max(done.data["a"]["levels"], key=lambda name: done.data["a"]["levels"][name]["laeq_dB"])
    a, b = (done.data[side]["levels"][at]["laeq_dB"] for side in "ab")
    assert finding["measured_dBA"] == pytest.approx(b - a) and len(finding["drawn_dBA"]) == 2
    every = [b - a, *finding["drawn_dBA"]]
    assert finding["is_finding"] is (min(every) > 0.0 or max(every) < 0.0)


@pytest.mark.heavy
def test_scenes_that_are_equal(run, quiet_cages):
    done = run("compare", quiet_cages[0], quiet_cages[0], *SHORT, "--seeds", 1)
    assert done.exit_code == 0 and "the scenes do not differ" in done.stdout
    assert "+0.0 dB(A) at P4 is no finding: draws of the surfaces with 1 seed, " in done.stdout


def test_refusals(run, rings_file, tmp_path):
    (tmp_path / "run.csv").write_text("time,friction_torque\n0,1\n1,1\n")
    (tmp_path / "file").write_text("")
    for arguments, reason in (
        ((rings_file, tmp_path / "none.toml"), "none.toml: there is no such scene file"),
        ((rings_file, tmp_path / "none.npz"), "none.npz: there is no such file"),
        ((tmp_path / "run.csv", rings_file, "--fidelity", "full"), "A is a finished run"),
        ((rings_file, rings_file, "--plot", "both.txt"), "a picture is written as .png, .svg or .pdf"),
        ((rings_file, rings_file, "-m", "P9"), "there is no microphone 'P9'; there are P1, P2, P3, P4"),
        ((rings_file, rings_file, "--fidelity", "best"), "fidelity.model = 'best' is refused"),
        ((rings_file, rings_file, "-t", -1), "duration = -1.0 s"),
        ((rings_file, rings_file, "-o", tmp_path / "file"), "file is a file; name another folder"),
        ((rings_file, rings_file, "-o", tmp_path / "out", "-t", -1), "duration = -1.0 s"),
    ):
        done = run("compare", *arguments)
        assert done.exit_code == 2 and reason in done.stderr, done.output
    assert not (tmp_path / "out").exists()  # a refusal leaves no trace
