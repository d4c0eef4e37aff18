"""info --temperatures: what it prints and refuses."""

import pytest

from fmu_bearing.design.temperatures import temperatures
from fmu_bearing.scene import read_scene
from tests.conftest import EXAMPLES


def test_cooling_and_ambient_are_taken(run):
    path = EXAMPLES / "7003C-spindle.toml"
    made = run("info", path, "--temperatures", "--ambient", 30, "--cooling", 2, "--json").data
    warm = made["temperatures"]
    assert warm["ambient_degC"] == 30.0 and warm["conductances_W_K"]["housing-ambient"] == 2.0
    assert warm["degC"]["bearing[1].oil"] == pytest.approx(
        temperatures(read_scene(path), 30.0, 2.0).places[1, "oil"], abs=1e-9
    )
    shown = run("info", path, "--temperatures")
    assert "steady temperatures in 22 degC" in shown.stdout and "oil 43.5, inner ring 42.28" in " ".join(
        shown.stdout.split()
    )
    for words, reason in (
        (("--ambient", 20), "give --temperatures"),
        (("--temperatures", "--cooling", 0), "allowed: above 0 to 1e6 W/K"),
        (("--temperatures", "--ambient", 200), "allowed: -40 to 100 degC"),
    ):
        refused = run("info", path, *words)
        assert refused.exit_code == 2 and reason in refused.stderr and refused.stderr.count("\n") == 1
