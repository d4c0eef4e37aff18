"""``fmu-bearing identify``: what it prints, writes and refuses."""

import pytest

from fmu_bearing.cli.base import INTERRUPTED, REFUSED
from fmu_bearing.identification import search as module
from fmu_bearing.identification.data import read_data
from fmu_bearing.identification.model import Levels
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import ROOT

KEY = "imperfections.*_race_amplitude_um"
SETTINGS = ("--starts", 1, "--seeds", 2)


@pytest.fixture(scope="module")
def scene_of(scene, tmp_path_factory):
    """Scene file whose bearing and grade come from the catalogue, with remarks, at fidelity response."""
    made = with_fidelity(scene("7003C-spindle"), model="response")
    path = tmp_path_factory.mktemp("scene") / "start.toml"
    text = made.to_toml().replace(
        "inner_race_amplitude_um = 0.1", "inner_race_amplitude_um = 0.1 # assumed: why"
    )
    path.write_text(text.replace("[mounting]", "# The mounting.\n[mounting]"), "utf-8")
    return path


@pytest.fixture(scope="module")
def measured(scene_of, tmp_path_factory):
    """Levels of a machine whose races are half as wavy, exactly."""
    scene = read_scene(scene_of)
    rows = [
        {"microphone": name, "speed_rpm": speed, "quantity": "leq_a", "value_dB": 60.0}
        for name in ("P1", "P3", "P4")
        for speed in (12000.0, 18000.0)
    ]
    halved = {f"imperfections.{race}_race_amplitude_um": 0.05 for race in ("inner", "outer")}
    levels = Levels(scene.replace(halved), read_data(rows, scene), ())
    exact = levels.at([], [1, 2], "response").mean(axis=0)
    path = tmp_path_factory.mktemp("data") / "measured.csv"
    lines = [",".join(rows[0])]
    for row, value in zip(rows, exact, strict=True):
        lines.append(",".join(map(str, (row | {"value_dB": round(float(value), 3)}).values())))
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture(scope="module")
def output(tmp_path_factory):
    """Scene that the first test writes; later ones take its kept runs."""
    return tmp_path_factory.mktemp("found") / "identified.toml"


@pytest.mark.heavy
def test_it_finds_writes_and_goes_on(run, scene_of, measured, output):
    arguments = ("identify", scene_of, measured, "--free", KEY, *SETTINGS, "-o", output, "--json")
    result = run(*arguments)
    assert result.exit_code == 0, result.output
    value = result.data["values"][KEY]
    assert value["value"] == pytest.approx(0.05, rel=0.01)
    # a level rises by 20 lg of the amplitude: 8.69 dB per ln; six values of 2 dB, phases add to that
    assert 2.0 / 8.69 / 6**0.5 < value["std_ln"] < 0.2
    assert result.data["rms_dB"]["fit_after"] < 0.1 < 5.0 < result.data["rms_dB"]["fit_before"]
    text = output.read_text("utf-8")
    assert "# The mounting." in text
    (line,) = [line for line in text.splitlines() if line.startswith("inner_race_amplitude_um")]
    assert "# identified: " in line and "before: 0.1" in line and "assumed" not in line
    found = read_scene(output)
    assert found.imperfections.outer_race_amplitude_um == pytest.approx(0.05, rel=0.01)
    assert found.mounting == read_scene(scene_of).mounting
    names = {path.name for path in output.with_suffix("").iterdir()}
    assert names >= {"levels.csv", "values.csv", "jacobian.csv", "report.md", "levels.png", "runs.jsonl"}
    assert "## Correlation" in (output.with_suffix("") / "report.md").read_text("utf-8")
    again = run(*arguments, "--force")
    assert again.data["runs"] == 0 and again.data["values"] == result.data["values"]


@pytest.mark.heavy
def test_tables_on_the_terminal(run, scene_of, measured, output):
    result = run("identify", scene_of, measured, "--free", KEY, *SETTINGS, "-o", output, "--force")
    assert result.exit_code == 0, result.output
    for word in (
        "Measured and computed levels",
        "Identified values",
        KEY,
        "6 fitted values",
        "identified.toml",
    ):
        assert word in result.stdout


@pytest.mark.heavy
def test_the_scene_of_a_set_is_written_as_a_set(run, tmp_path):
    """A heavy spot of the example's shaft: its line rises by 20 lg of the amount."""
    key = "spindle.shaft.unbalance[1].amount_g_mm"
    text = (ROOT / "examples" / "spindle_set" / "7003C-DB.toml").read_text("utf-8")
    path, output, table = (tmp_path / name for name in ("set.toml", "identified.toml", "measured.csv"))
    path.write_text(
        'fidelity.model = "response"\n' + text.replace("[spindle.housing]", (
            "[[spindle.shaft.unbalance]]\nposition_mm = 100.0\namount_g_mm = 0.2 # assumed\n\n"
            "[spindle.housing]"
        ))
    )  # fmt: skip
    scene = read_scene(path)
    names = [f"velocity_line[bearing[{number}].inner_ring.{axis} f_r]" for number in (1, 2) for axis in "yz"]
    rows = [{"quantity": name, "value_dB": 100.0} for name in names]
    truth = scene.replace({key: 0.5})
    exact = Levels(truth, read_data(rows, truth), ()).at([], [0], "response")[0]
    lines = [f"{name},{value:.3f}" for name, value in zip(names, exact, strict=True)]
    table.write_text("\n".join(("quantity,value_dB", *lines)) + "\n")
    result = run("identify", path, table, "--free", key, "--starts", 1, "-o", output, "--json")
    assert result.exit_code == 0, result.output
    # levels are given to 1e-3 dB, 1e-4 of the amount; the search ends where its cost changes by 1e-3
    assert result.data["values"][key]["value"] == pytest.approx(0.5, rel=0.005)
    found = read_scene(output)
    assert found.spindle.shaft.unbalance[0].amount_g_mm == pytest.approx(0.5, rel=0.005)
    assert found.spindle.bearing == scene.spindle.bearing and found.spindle.arrangement == "DB (O)"
    assert "# Two hybrid 7003C back to back" in output.read_text("utf-8")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((), "no key is free: give KEY or KEY=LOW:HIGH"),
        (("--free", "imperfections.unbalance"), "did you mean 'imperfections.unbalance_um'"),
        (
            ("--free", KEY, "--free", "mounting.housing.mass_kg", "--free", "mounting.rotor.mass_kg"),
            "carry 2 free",
        ),
        (("--free", KEY, "-o", "identified.csv"), "the identified scene is written as .toml"),
        (("--free", KEY, "--background", "none.csv"), "there is no such file"),
        (("--free", KEY, "--fidelity", "best"), "fidelity 'best' is unknown"),
    ],
)
def test_refusals_are_one_line(arguments, message, run, scene_of, measured, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("identify", scene_of, measured, *arguments)
    assert result.exit_code == REFUSED
    assert message in result.stderr and len(result.stderr.strip().splitlines()) == 1
    assert not list(tmp_path.glob("*.toml"))


@pytest.mark.heavy
def test_ctrl_c_writes_the_best_so_far(run, scene_of, measured, tmp_path, monkeypatch):
    plain, calls = module.Levels.at, []

    def stop(self, *arguments, **options):
        calls.append(1)
        if len(calls) > 8:
            raise KeyboardInterrupt
        return plain(self, *arguments, **options)

    monkeypatch.setattr(module.Levels, "at", stop)
    output = tmp_path / "identified.toml"
    result = run("identify", scene_of, measured, "--free", KEY, *SETTINGS, "-o", output)
    assert result.exit_code == INTERRUPTED
    assert "the same command with --force goes on" in result.stderr
    assert "uncertainty unknown" in output.read_text("utf-8")


@pytest.mark.heavy
def test_what_contradicts_itself_is_not_written_unless_asked_for(run, scene_of, measured, tmp_path):
    lines = measured.read_text().splitlines()
    *row, value = lines[-1].split(",")
    wrong = tmp_path / "wrong.csv"
    wrong.write_text("\n".join((*lines[:-1], ",".join((*row, f"{float(value) + 40.0:.1f}")))) + "\n")
    output = tmp_path / "identified.toml"
    arguments = ("identify", scene_of, wrong, "--free", KEY, *SETTINGS, "-o", output)
    result = run(*arguments)
    assert result.exit_code == REFUSED and not output.exists()
    assert (
        "P4 speed_rpm 18000 leq_a (fitted" in result.stderr and "standard deviations apart" in result.stderr
    )
    assert "is not written" in result.stderr and "--anyway" in result.stderr
    assert "Measured and computed levels" in result.stdout
    as_json = run(*arguments, "--json")
    assert as_json.exit_code == REFUSED and as_json.data["files"] == [] and len(as_json.data["doubts"]) >= 1
    forced = run(*arguments, "--anyway")
    assert forced.exit_code == 0 and output.exists()
    assert "standard deviations apart" in forced.stdout
    assert "standard deviations apart" in (output.with_suffix("") / "report.md").read_text("utf-8")


@pytest.mark.heavy
def test_unusual_data_are_asked_about(run, scene_of, measured, tmp_path):
    dead = tmp_path / "dead.csv"
    lines = measured.read_text().splitlines()
    dead.write_text("\n".join((*lines[:-1], ",".join((*lines[-1].split(",")[:-1], "0.0")))) + "\n")
    output = tmp_path / "identified.toml"
    arguments = ("identify", scene_of, dead, "--free", KEY, *SETTINGS, "-o", output)
    result = run(*arguments)
    assert result.exit_code == REFUSED and "is this microphone dead?" in result.stderr
    accepted = run(*arguments, "--accept")
    assert "is this microphone dead" not in accepted.stderr and "standard deviations apart" in accepted.stderr
    assert accepted.exit_code == REFUSED and not output.exists()
