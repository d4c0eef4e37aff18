"""Options that commands share: the version, speeds in r/min."""

import pytest

import fmu_bearing


def test_version(run):
    reported = run("--version")
    assert reported.exit_code == 0 and reported.stdout == f"fmu-bearing {fmu_bearing.__version__}\n"
    assert "--version" in run("--help").stdout and "scenes, runs, FMUs" in run("--help").stdout


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (("simulate", "--speed", 2e5), "--speed 200000 r/min"),
        (("simulate", "--speed", "nan"), "--speed nan r/min"),
        (("sound", "--speed", -2e5), "--speed -200000 r/min"),
        (("report", "--speed", 2e5), "--speed 200000 r/min"),
        (("report", "--run-up", "5000:200000"), "--run-up 200000 r/min"),
    ],
)
def test_a_speed_is_refused_in_the_unit_it_was_given_in(
    run, rings_file, tmp_path, monkeypatch, words, option
):
    monkeypatch.chdir(tmp_path)
    refused = run(words[0], rings_file, *words[1:])
    assert refused.exit_code == 2
    assert refused.stderr == f"error: {option} is refused: allowed are -100000 to 100000 r/min\n"
    assert not list(tmp_path.iterdir())


def test_the_range_of_speeds_is_the_inputs_own(run, rings_file, tmp_path):
    """A speed at the bound passes the engine too: 1e5 r/min is 10472 rad/s, rounded."""
    done = run("simulate", rings_file, "-t", 1e-5, "--step", 1e-5, "--speed", 1e5, "-o", tmp_path / "a.csv")
    assert "is refused" not in done.stderr
