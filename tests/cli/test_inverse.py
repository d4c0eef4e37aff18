"""vibration --measured: what it prints, writes and refuses, and what sound makes of the file."""

import pytest

from fmu_bearing.scene.surface_file import read_surface
from tests.vibration_test import known


@pytest.fixture
def quick(monkeypatch):
    """The table of energies in the place of runs."""
    known.play(monkeypatch)


def test_the_command_writes_a_surface(quick, run, tmp_path):
    path = tmp_path / "surface.toml"
    words = ("vibration", "7003C", "--measured", "L=41, M=42,H=54", "-o", path)
    shown = run(*words)
    assert shown.exit_code == 0, shown.output
    assert "surfaces of 7003C with L = 41, M = 42, H = 54 um/s" in shown.stdout
    assert "order 12 of the races, nm" in shown.stdout and "Ask for the lines f_i - f_r" in shown.stdout
    found = read_surface(path)
    assert len(found) == 1000 and found.order_scatter_seed is not None
    refused = run(*words)
    assert refused.exit_code == 2 and "--force" in refused.stderr
    data = run(
        "vibration", "7003C", "--measured", "L=41,H=54", "--line", "f_i-f_r=9", "--std", "15%", "--exact-law",
        "-o", tmp_path / "folder", "--json",
    ).data  # fmt: skip
    assert data["measured"] == "L = 41, H = 54, f_i - f_r = 9 um/s"
    assert data["law"]["exponent"]["low"] < data["law"]["exponent"]["median"]
    assert read_surface(tmp_path / "folder" / "surface.toml").order_scatter_seed is None


@pytest.mark.parametrize(
    ("words", "refusal"),
    [
        (("--measured", "L=41"), "L alone: amplitude and exponent are two numbers"),
        (("--measured", "L=41,K=3"), "--measured K: bands are L, M, H; lines are given with --line"),
        (("--measured", "L=41,L=3"), "--measured L is given twice"),
        (("--measured", "41,42,54"), '--measured 41: write name and number, as "L=41,M=42,H=54"'),
        (("--measured", "L=41,H=54", "--line", "f_i"), '--line f_i: write name and number, as "f_i - f_r=9"'),
        (("--measured", "L=41,H=54", "--std", "x"), "--std x: write percent, as 10%"),
        (("--measured", "L=41,H=54", "--std", "1%"), "a standard deviation of 1 %: give 3 to 100 %"),
        (("--measured", "L=41,H=54", "--limits", "1,2,3"), "--limits has no use beside --measured"),
        (("--measured", "L=41,H=54", "--rigid"), "--rigid has no use beside --measured"),
        (("--measured", "L=41,H=54", "--fidelity", "rings"), "cannot have a vibration test"),
        (("--line", "f_o=3"), "--line belongs to --measured"),
        (("--at-most",), "--at-most belongs to --measured"),
    ],
)
def test_the_command_refuses_in_one_line(quick, run, words, refusal, tmp_path):
    refused = run("vibration", "7003C", *words, "-o", tmp_path / "a.toml")
    assert refused.exit_code == 2 and refusal in refused.stderr and refused.stderr.count("\n") == 1
    assert not (tmp_path / "a.toml").exists()


def test_sound_takes_the_surface(run, tmp_path):
    refused = run("sound", "examples/scenes/7003C-bare.toml", "--surface", tmp_path / "none.toml")
    assert refused.exit_code == 2 and "there is no such file of a surface" in refused.stderr
