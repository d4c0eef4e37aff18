"""info --temperatures: what it prints and refuses."""

import pytest

from fmu_bearing.design.temperatures import temperatures
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.words import conditions_words
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


def test_the_header_has_the_settled_temperatures_of_each_ring(run):
    path = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
    places = temperatures(read_scene(path)).places
    header = " ".join(run("info", path, "--temperatures").stdout.partition("┏")[0].split())
    for ring in ("inner", "outer"):
        each = [f"{places[number, f'{ring}_ring']:.4g}" for number in (1, 2)]
        words = f"ring {each[0]}" if len(set(each)) == 1 else f"rings {' / '.join(each)}"
        assert f"{ring} {words}" in header


def test_rings_of_one_temperature_are_one_figure():
    scene = read_scene(EXAMPLES.parent / "spindle_set" / "7003C-DB.toml")
    one, other = ("spindle.bearing[1].inner_ring_temperature_degC",
                  "spindle.bearing[2].inner_ring_temperature_degC")  # fmt: skip
    assert "inner rings 50 / 42, outer ring 37 degC" in conditions_words(scene.replace({one: 50.0}))
    assert "inner ring 50, outer ring 37 degC" in conditions_words(scene.replace({one: 50.0, other: 50.0}))
