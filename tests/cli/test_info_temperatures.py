"""info --temperatures: what it prints and refuses."""

import pytest

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.temperatures import HALVES, temperatures
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


def test_assumed_temperatures_far_below_those_of_the_heat_are_said_once(run):
    path, words = EXAMPLES / "7009C-spindle.toml", "temperatures are assumed (oil 40"
    said = run("info", path).stderr
    # 196 W, into oil that the supply hardly cools: 63 degC by the network, 23 K above what is assumed
    assert said.count(words) == 1 and "would bring oil to 6" in said and "`--temperatures` finds" in said
    assert any(words in line for line in run("info", path, "--json").data["cautions"])
    for given in (("--set", "operation.oil_temperature_degC=40"), ("--temperatures",)):
        assert words not in run("info", path, *given).stderr
    # 42 and 43 degC: within the 20 K by which oil has about half the viscosity
    assert words not in run("info", EXAMPLES / "7003C-spindle.toml").stderr


def test_oil_has_half_the_viscosity_20_K_above():
    scene = read_scene(EXAMPLES / "7003C-spindle.toml")
    warm = scene.replace({"operation.oil_temperature_degC": 40.0 + HALVES})
    cold, hot = (operating_point(one).bearings[0].viscosity for one in (scene, warm))
    assert 0.4 < hot / cold < 0.6  # "about half": 11.1 and 4.8 mm2/s
